// A large file in the decoder.
import { createWriteStream, mkdirSync } from 'node:fs';
import { once } from 'node:events';
import { at, number, test } from '../../page/page.js';
import { record, resident, watch } from './measured.js';

const folder = new URL('../../../target/bench/', import.meta.url).pathname;
const megabytes = Number(process.env.BENCH_FILE_MEGABYTES ?? 256);

/** Writes `bytes` again and again until the file has its size. */
const fill = async (path, bytes) => {
  mkdirSync(folder, { recursive: true });
  const file = createWriteStream(path);
  const size = Math.floor((megabytes * 1e6) / bytes.length);
  const piece = Buffer.concat(Array(Math.ceil(1e6 / bytes.length)).fill(bytes));
  const times = Math.floor(size / (piece.length / bytes.length));
  for (let time = 0; time < times; time += 1) if (!file.write(piece)) await once(file, 'drain');
  file.end();
  await once(file, 'close');
  return times * piece.length;
};

const t485 = Buffer.from([0x1a, 0x20, 0xad, 0xd9, 0x24, 0x17, 0x00, 0x00, 0x00, 0x00]);
const crc = t485.reduce((sum, byte) => sum ^ byte, 0);
const frame = Buffer.from([...t485, crc]);
const line = Buffer.from(`${frame.toString('hex').replace(/(..)/g, '$1 ').trim()}\n`);

for (const [name, bytes] of [
  ['bytes.bin', frame],
  ['text.txt', line],
]) {
  test(`${name} of ${megabytes} MB`, async ({ page, browser }) => {
    const path = `${folder}${name}`;
    const size = await fill(path, bytes);
    await page.goto('/#/decode?format=t485');
    await page.locator('.drop').waitFor();
    await page.waitForTimeout(2_000);
    const before = await resident(browser);
    await watch(page);
    await page.evaluate(() => {
      const input = document.querySelector('input[type=file]');
      input.addEventListener('change', () => (window.chosen = performance.now()), { capture: true });
      const look = () => {
        const now = performance.now() - window.chosen;
        if (document.querySelector('[data-testid=dump-row]')) window.first ??= now;
        const reads = document.querySelector('[data-testid=progress]') !== null;
        if (reads) window.reads = true;
        if (window.reads && !reads) window.done ??= now;
        requestAnimationFrame(look);
      };
      look();
    });
    await page.locator('input[type=file]').setInputFiles(path);
    await page.waitForFunction(() => window.done !== undefined, undefined, { timeout: 300_000 });
    // Steady: what was garbage has been collected.
    await page.waitForTimeout(15_000);
    const memory = (await resident(browser)) - before;
    const { first, done, tasks } = await page.evaluate(() => ({ first: window.first, done: window.done, tasks: window.tasks }));
    const rows = await number(page, 'rows');
    const what = `${name.split('.')[1]} file of ${(size / 1e6).toFixed(0)} MB`;
    record('Files', `${what}: first rows`, '< 1 000 ms', `${first.toFixed(0)} ms`, first < 1_000);
    record('Files', `${what}: all read`, 'rows = frames', `${(done / 1_000).toFixed(1)} s`, rows === size / bytes.length);
    const share = memory / size;
    record('Files', `${what}: steady memory to its size`, '≤ 1.5', share.toFixed(2), share <= 1.5);
    const longest = Math.max(0, ...tasks);
    record('Files', `${what}: longest task on the page`, '≤ 50 ms', `${longest.toFixed(0)} ms`, longest <= 50);
    await at(page, 'dump-row').first().waitFor();
  });
}
