// Large recordings of clock and data: read in pieces, stopped, and framed again without reading.
import { rmSync, writeFileSync } from 'node:fs';
import { at, expect, number, test } from './page.js';

const good = '1a 20 29 c0 3b 17 00 00 00 c8 37';

/** Drops a VCD of so many words of 25 bits, made in the page, and watches what becomes of it. */
const drop = (page, words, name) =>
  page.evaluate(
    async ({ words, name }) => {
      const head = '$timescale 1 ns $end\n$var wire 1 ! clk $end\n$var wire 1 " data $end\n$enddefinitions $end\n#0\n1!\n1"\n';
      // Each word is behind a pause; the data line follows the clock.
      const parts = [head];
      let time = 100_000;
      let noise = 1;
      for (let word = 0; word < words; word += 1) {
        let text = '';
        // No checksum holds over it.
        noise ^= noise << 13;
        noise ^= noise >>> 17;
        noise ^= noise << 5;
        for (let clock = 0; clock < 26; clock += 1) {
          text += `#${time}\n0!\n#${time + 500}\n1!\n${(noise >>> clock) & 1}"\n`;
          time += 1_000;
        }
        time += 50_000;
        parts.push(`${text}#${time - 30_000}\n1"\n`);
      }
      const file = new File(parts, name);
      const data = new DataTransfer();
      data.items.add(file);
      window.tasks = [];
      window.seen = [];
      // Making the file was work of the test, not of the page.
      await new Promise((resolve) => setTimeout(resolve, 500));
      new PerformanceObserver((list) => window.tasks.push(...list.getEntries().map(({ duration }) => duration))).observe({
        type: 'longtask',
      });
      const look = () => {
        const progress = document.querySelector('[data-testid=progress]')?.dataset.value;
        if (progress !== undefined && progress !== window.seen.at(-1)) window.seen.push(progress);
        requestAnimationFrame(look);
      };
      look();
      document.querySelector('.drop').dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }));
      return file.size;
    },
    { words, name },
  );

test.describe('where the machine may have been busy, once more', () => {
  test.describe.configure({ retries: 1 });

  test('a large recording opens with progress, and the page stays awake', async ({ page }) => {
    test.setTimeout(120_000);
    await page.goto('/#/decode');
    await expect(page.locator('.drop')).toBeVisible();
    const start = Date.now();
    const size = await drop(page, 35_000, 'large.vcd');
    expect(size).toBeGreaterThan(20e6);
    await expect(at(page, 'progress')).toBeVisible();
    await expect(at(page, 'progress')).toHaveCount(0, { timeout: 60_000 });
    const { seen, tasks } = await page.evaluate(() => ({ seen: window.seen.map(Number), tasks: window.tasks }));
    console.log(`${(size / 1e6).toFixed(0)} MB of VCD: ${Date.now() - start} ms with making them, progress ${seen}, long tasks ${tasks}`);
    expect(await number(page, 'rows')).toBe(35_000);
    expect(seen.length).toBeGreaterThan(4);
    expect(seen).toEqual([...seen].sort((one, two) => one - two));
    // One hiccup may be the test machine's; a page that is busy has many.
    expect(tasks.filter((duration) => duration > 100).length).toBeLessThan(2);
    await expect(at(page, 'profile')).toContainText('SSI');
    await expect(page.getByText('clk: by its name')).toBeVisible();
  });
});

test('reading a recording can be stopped, what has come is framed, and other input is read then', async ({ page }) => {
  test.setTimeout(120_000);
  await page.goto('/#/decode');
  await expect(page.locator('.drop')).toBeVisible();
  await drop(page, 120_000, 'long.vcd');
  // Half a second is enough for some words and too little for all.
  await expect.poll(() => page.evaluate(() => Number(window.seen.at(-1) ?? 0))).toBeGreaterThan(2);
  await at(page, 'cancel').click();
  await expect(at(page, 'progress')).toHaveCount(0);
  await expect(at(page, 'refusal')).toHaveCount(0);
  await expect(at(page, 'dump-row').first()).toBeVisible();
  const rows = await number(page, 'rows');
  expect(rows).toBeGreaterThan(500);
  expect(rows).toBeLessThan(119_000);
  // What was kept is framed by another profile: 25 bits are one too few for 26.
  await expect(page.locator('.tally').filter({ hasText: 'wrong number of clocks' })).toHaveCount(0);
  await page.goto('/#/decode?format=ssi-tree&turns-bits=0&angle-bits=13&frame-bits=26');
  await expect(page.locator('.tally').filter({ hasText: 'Timing' })).toContainText('wrong number of clocks');
  expect(Math.abs((await number(page, 'rows')) - rows)).toBeLessThan(2);
  await page.getByRole('button', { name: 'Close' }).click();
  await at(page, 'dump-input').fill(good);
  await expect(at(page, 'rows')).toHaveAttribute('data-value', '1');
});

test('another profile frames a recording anew without reading it again', async ({ page }, info) => {
  await page.goto('/#/decode?format=ssi-tree&turns-bits=0&angle-bits=13');
  const path = info.outputPath('gone.csv');
  const rows = ['Time [us],clk,data', '0,1,1'];
  for (let word = 0; word < 40; word += 1) {
    for (let clock = 0; clock < 14; clock += 1) {
      const at = 100 + word * 100 + clock;
      rows.push(`${at},0,1`, `${at + 0.5},1,1`);
    }
  }
  writeFileSync(path, `${rows.join('\n')}\n`);
  await at(page, 'file-input').setInputFiles(path);
  await expect(at(page, 'rows')).toHaveAttribute('data-value', '40');
  const timing = page.locator('.tally').filter({ hasText: 'Timing' });
  await expect(timing).not.toContainText('wrong number of clocks');
  // A file that is gone cannot be read any more.
  rmSync(path);
  await page.goto('/#/decode?format=ssi-tree&turns-bits=0&angle-bits=12&frame-bits=12');
  await expect(timing).toContainText('wrong number of clocks');
  await expect(at(page, 'rows')).toHaveAttribute('data-value', '40');
  // A layout of one's own reads the frames as they are.
  await page.goto(`/#/decode?format=own&layout=${encodeURIComponent('Mine;line;angle:13')}`);
  await expect(at(page, 'profile')).toContainText('Mine');
  await expect(at(page, 'dump-row').first()).toHaveAttribute('data-angle', '8191');
  await expect(at(page, 'rows')).toHaveAttribute('data-value', '40');
  await expect(at(page, 'refusal')).toHaveCount(0);
});
