// Compiled, not run: the types say what the functions take and give.
import {
  ColumnReader,
  decode,
  decodeColumns,
  detect,
  encode,
  explain,
  formats,
  parseModel,
  type Candidate,
  type Format,
  type Profile,
} from 'encoderscope';
import { EncoderFrame, type FrameRecord } from 'encoderscope/encoder-frame';

const profile: Profile = { format: 't485', angleBits: 23, turnsCode: 'signed', dialect: 'mpp' };
const frame = decode(profile, '1a 20 29 c0 3b 17 00 00 00 c8 37').frames[0];
export const degrees: number | null | undefined = frame?.degrees;
export const sum: boolean | undefined = frame?.crc?.ok;
export const best: Candidate | undefined = detect('1a 20')[0];
export const certain: boolean = best?.verdict === 'certain';
export const digits: string = encode(profile, { angle: 1, zeroDefault: true });
export const starts: number[] = explain(profile, digits).flatMap((note) => note.spans.map((span) => span.start));
export const names: Format[] = formats().map((known) => known.format);
export const again: Profile[] = formats().map((known) => known.profile);
export const series: string = parseModel('MPP-40-60-A-23BM-T-N-A-M').series;

export const angles: Float64Array = decodeColumns(profile, '1a 20').angle;
const reader = new ColumnReader(profile);
reader.push(new Uint8Array([0x1a, 0x20]));
reader.finish();
export const bad: number = reader.take().summary.bad;

// @ts-expect-error: parameters are written in camelCase
decode({ format: 't485', 'angle-bits': 23 }, '');
// @ts-expect-error: there is no such format
decode({ format: 'ssi8' }, '');
// @ts-expect-error: text is text
decode(profile, [0x1a, 0x20]);
// @ts-expect-error: a candidate is no frame
export const angle = best?.angle;
// @ts-expect-error: a quantity may be missing
export const sure: number = decode(profile, '').frames[0]!.angle;

// @ts-expect-error: bytes are bytes
decodeColumns(profile, [0x1a, 0x20]);

const element: EncoderFrame = document.createElement('encoder-frame');
element.addEventListener('change', (event) => {
  const detail: FrameRecord = event.detail;
  console.log(detail.frame, detail.ok, detail.turns);
});
element.frame = digits;
element.flip(3);
// @ts-expect-error: it says what was read
element.record = null;
