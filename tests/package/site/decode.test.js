// Runs in Node, in a project that has nothing but the package.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import test from 'node:test';
import { decode, detect, encode, explain, formats, parseModel } from 'encoderscope';

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

test('the element may be imported where there are no elements', async () => {
  const { EncoderFrame } = await import('encoderscope/encoder-frame');
  assert.equal(typeof EncoderFrame, 'function');
});

test('its version is that of the program', async () => {
  const at = new URL('./node_modules/encoderscope/package.json', import.meta.url);
  assert.equal(JSON.parse(await readFile(at, 'utf8')).version, process.env.VERSION);
});
