// The JavaScript module in Node, whose fetch reads no files.
import { readFile } from 'node:fs/promises';
import init, {
  ColumnReader,
  decode,
  decodeColumns,
  detect,
  encode,
  explain,
  formats,
  parseModel,
} from '../pkg/encoderscope.js';

await init({ module_or_path: await readFile(new URL('../pkg/encoderscope_bg.wasm', import.meta.url)) });

export { ColumnReader, decode, decodeColumns, detect, encode, explain, formats, parseModel };
