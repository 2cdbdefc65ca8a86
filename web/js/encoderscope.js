// The JavaScript module: import it and call; the WASM is loaded by then.
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

await init();

export { ColumnReader, decode, decodeColumns, detect, encode, explain, formats, parseModel };
