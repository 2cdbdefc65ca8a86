// Runs in Node, in a project that has nothing but the package.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import test from 'node:test';
import {
  ColumnReader,
  decode,
  decodeColumns,
  detect,
  encode,
  explain,
  formats,
  parseModel,
} from 'encoderscope';

const reply = '1a 20 29 c0 3b 17 00 00 00 c8 37';
const profile = { format: 't485', angleBits: 23 };

test('decodes the reply of a real encoder', () => {
  const { frames, skips, unread, summary } = decode(profile, reply);
  const [{ start, hex, ok, turns, angle, degrees, error, warning, status, crc }] = frames;
  assert.deepEqual(
    { start, hex, ok, turns, angle, degrees, error, warning, status, crc },
    {
      start: 0,
      hex: '1a2029c03b17000000c837',
      ok: true,
      turns: 0,
      angle: 3915817,
      degrees: 168.0486345,
      error: true,
      warning: false,
      status: 32,
      crc: { expected: 55, received: 55, ok: true },
    },
  );
  assert.deepEqual([skips, unread], [[], []]);
  assert.deepEqual(summary, { bytes: 11, frames: 1, bad: 0, skipped: 0 });
});

test('the rest of the module is there too', () => {
  assert.equal(detect(reply)[0].format, 't485');
  assert.equal(encode(profile, { turns: 0, angle: 3915817, status: 32, enid: 0x17, alarm: 0xc8 }), reply.replaceAll(' ', ''));
  assert.deepEqual(explain(profile, reply).at(-1).raw, 55);
  assert.equal(parseModel('MPP-40-60-A-23BM-T-N-A-M').series, 'MPP');
  assert.throws(() => parseModel('MPP-40-60-A-23BM-Z-N-A-M'), /part 6/);
  assert.deepEqual(formats().map((known) => known.format).slice(0, 2), ['ssi', 'biss-c']);
});

const bytesOf = (hex) => Uint8Array.from(hex.match(/../g), (digits) => parseInt(digits, 16));

test('decodes bytes into columns', () => {
  const own = { format: 'period', angleBits: 24 };
  const hex = Array.from({ length: 1000 }, (_, index) =>
    encode(own, { turns: 300 + index, angle: 16_000_000 + index * 7, warning: index > 800, status: index > 800 ? 1 : 0 }),
  );
  const { angle, turns, status, health, runs, summary } = decodeColumns(own, bytesOf(`ff${hex.join('')}`));
  assert.ok(angle instanceof Float64Array && turns instanceof Float64Array);
  assert.deepEqual([...angle], Array.from({ length: 1000 }, (_, index) => 16_000_000 + index * 7));
  assert.deepEqual([...turns], Array.from({ length: 1000 }, (_, index) => 300 + index));
  assert.deepEqual([status[800], health[800], status[801], health[801]], [0, 0, 1, 1]);
  assert.equal(runs.start[0], 1);
  assert.deepEqual(new Set(runs.len), new Set([7]));
  assert.equal(runs.frames.reduce((sum, frames) => sum + frames), 1000);
  assert.deepEqual(summary, { bytes: 7001, frames: 1000, bad: 0, skipped: 1 });
});

test('decodes what comes in pieces into the same columns', () => {
  const bytes = bytesOf(reply.replaceAll(' ', '').repeat(500));
  const whole = decodeColumns(profile, bytes);
  const reader = new ColumnReader(profile);
  const taken = [];
  for (let at = 0; at < bytes.length; at += 100) {
    reader.push(bytes.subarray(at, at + 100));
    const { length } = reader;
    const { angle } = reader.take();
    assert.deepEqual([angle.length, reader.length], [length, 0]);
    taken.push(...angle);
  }
  reader.finish();
  const { angle, summary } = reader.take();
  taken.push(...angle);
  assert.deepEqual(taken, Array(500).fill(3915817));
  assert.deepEqual(taken, [...whole.angle]);
  assert.deepEqual(summary, whole.summary);
  reader.push(bytes);
  reader.clear();
  assert.equal(reader.length, 0);
  reader.free();
});

test('decodes words and pasted text into columns', () => {
  const biss = { format: 'biss-c', angleBits: 17, turnsBits: 16 };
  const word = '82 00 05 80 00 60 68';
  const read = ({ angle, turns, health, summary }) => ({ angle: [...angle], turns: [...turns], health: [...health], summary });
  const expected = {
    angle: [65_536, 65_536],
    turns: [5, 5],
    health: [0, 0],
    summary: { bytes: 14, frames: 2, bad: 0, skipped: 0 },
  };
  assert.deepEqual(read(decodeColumns(biss, `${word}\n${word}`)), expected);
  assert.deepEqual(read(decodeColumns(biss, bytesOf(word.replaceAll(' ', '').repeat(2)))), expected);
  assert.deepEqual(read(decodeColumns(profile, `${reply}\n${reply}`)).angle, [3915817, 3915817]);
  assert.equal(decodeColumns(profile, reply).health[0], 2);
  assert.throws(() => decodeColumns(profile, 7), /neither text nor a Uint8Array/);
  assert.throws(() => decodeColumns({ format: 'ssi8' }, ''), /format/);
});

test('the element may be imported where there are no elements', async () => {
  const { EncoderFrame } = await import('encoderscope/encoder-frame');
  assert.equal(typeof EncoderFrame, 'function');
});

test('its version is that of the program', async () => {
  const at = new URL('./node_modules/encoderscope/package.json', import.meta.url);
  assert.equal(JSON.parse(await readFile(at, 'utf8')).version, process.env.VERSION);
});
