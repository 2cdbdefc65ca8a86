// The plot and the standstill panel.
import { at, expect, expectLink, number, test, until } from './page.js';
import { Encoder } from './encoder.js';

let encoder;
test.afterEach(async () => {
  await encoder?.unplug();
  encoder = undefined;
});

const demo = async (page, query = 'format=t485') => {
  await page.goto('about:blank');
  await page.goto(`/#/console?${query}`);
  await at(page, 'demo').click();
  await expectLink(page, 'reading');
  await expect.poll(() => shown(page)).toMatchObject({ paused: 'false' });
  await expect.poll(async () => (await shown(page)).points).toBeGreaterThan(20);
};

/** What the plot shows. */
const shown = async (page) => {
  const { from, to, points, paused } = await at(page, 'plot').evaluate((plot) => ({ ...plot.dataset }));
  return { from: Number(from), to: Number(to), points: Number(points), paused };
};

const length = async (page) => {
  const { from, to } = await shown(page);
  return to - from;
};

/** How many pixels of a chart have the colour of its line. */
const drawn = (page, chart, token) =>
  at(page, `chart-${chart}`).locator('canvas').evaluate((canvas, token) => {
    const copy = document.createElement('canvas');
    Object.assign(copy, { width: canvas.width, height: canvas.height });
    const probe = copy.getContext('2d', { willReadFrequently: true });
    probe.fillStyle = getComputedStyle(document.documentElement).getPropertyValue(token).trim();
    probe.fillRect(0, 0, 1, 1);
    const [red, green, blue] = probe.getImageData(0, 0, 1, 1).data;
    probe.clearRect(0, 0, 1, 1);
    probe.drawImage(canvas, 0, 0);
    const { data } = probe.getImageData(0, 0, canvas.width, canvas.height);
    let count = 0;
    for (let at = 0; at < data.length; at += 4) {
      const apart = Math.abs(data[at] - red) + Math.abs(data[at + 1] - green) + Math.abs(data[at + 2] - blue);
      if (data[at + 3] > 100 && apart < 60) count += 1;
    }
    return count;
  }, token);

/** A point of a chart, as a part of its width. */
const point = async (page, part, chart = 'angle') => {
  const over = at(page, `chart-${chart}`).locator('.u-over');
  await over.scrollIntoViewIfNeeded();
  const box = await over.boundingBox();
  return [box.x + box.width * part, box.y + box.height / 2];
};

test('the demo is drawn, goes on, pauses and comes back', async ({ page }) => {
  await page.goto('/');
  await expect(at(page, 'angle')).toBeVisible();
  await expect(at(page, 'plot')).toHaveCount(0);
  await demo(page);
  await expect(at(page, 'plot').locator('h2')).toContainText('Last 20 s');
  expect(await length(page)).toBeCloseTo(20, 3);
  await expect.poll(() => drawn(page, 'angle', '--angle')).toBeGreaterThan(30);
  const before = await shown(page);
  await expect.poll(async () => (await shown(page)).to).toBeGreaterThan(before.to);

  await at(page, 'plot-pause').click();
  await expect(at(page, 'plot')).toHaveAttribute('data-paused', 'true');
  const held = await shown(page);
  await until(page, 'frames-ok', (frames) => frames > 1_000);
  expect((await shown(page)).to).toBeCloseTo(held.to, 6);
  await at(page, 'plot-pause').click();
  await expect.poll(async () => (await shown(page)).to).toBeGreaterThan(held.to);
});

test('spans show more or less of the past', async ({ page }) => {
  await demo(page);
  for (const [title, seconds] of [['2 min', 120], ['1 h', 3_600], ['20 s', 20]]) {
    await at(page, 'plot-span').filter({ hasText: new RegExp(`^${title}$`) }).click();
    await expect.poll(() => length(page)).toBeCloseTo(seconds, 3);
    await expect(at(page, 'plot').locator('h2')).toContainText(`Last ${title}`);
  }
  await at(page, 'plot-span').filter({ hasText: 'All' }).click();
  await expect.poll(async () => (await shown(page)).from).toBeLessThan(0.5);
  expect(await length(page)).toBeLessThan(30);
});

test('dragging zooms and pauses, a double click comes back', async ({ page }) => {
  await demo(page);
  await page.mouse.move(...(await point(page, 0.9)));
  await page.mouse.down();
  await page.mouse.move(...(await point(page, 0.95)));
  await page.mouse.up();
  await expect(at(page, 'plot')).toHaveAttribute('data-paused', 'true');
  await expect.poll(() => length(page)).toBeLessThan(2);
  const zoomed = await length(page);
  expect(zoomed).toBeGreaterThan(0.5);
  await at(page, 'plot-zoom-in').click();
  await expect.poll(() => length(page)).toBeCloseTo(zoomed / 2, 6);
  await page.getByLabel('Zoom out').click();
  await expect.poll(() => length(page)).toBeCloseTo(zoomed, 6);
  const { from } = await shown(page);
  await page.getByLabel('Earlier').click();
  await expect.poll(async () => (await shown(page)).from).toBeCloseTo(from - zoomed / 2, 6);
  await page.mouse.dblclick(...(await point(page, 0.5)));
  await expect(at(page, 'plot')).toHaveAttribute('data-paused', 'false');
  await expect.poll(() => length(page)).toBeCloseTo(20, 3);
});

test('the cursor reads the charts, and a mark what is between', async ({ page }) => {
  await demo(page);
  await at(page, 'plot-speed').click();
  await expect.poll(() => drawn(page, 'speed', '--status')).toBeGreaterThan(10);
  await until(page, 'frames-ok', (frames) => frames > 1_500);
  await at(page, 'plot-pause').click();
  await page.mouse.click(...(await point(page, 0.95)));
  await page.mouse.move(...(await point(page, 0.97, 'speed')));
  const cursor = at(page, 'plot-cursor');
  await expect(cursor).toHaveAttribute('data-delta', /./);
  const read = async (name) => Number(await cursor.getAttribute(name));
  expect(await read('data-delta')).toBeGreaterThan(0.3);
  expect(await read('data-delta')).toBeLessThan(0.5);
  expect(await read('data-time') - (await read('data-mark'))).toBeCloseTo(await read('data-delta'), 6);
  expect(Math.abs(await read('data-value'))).toBeGreaterThan(0.1);
  await expect(cursor).toContainText('speed');

  // The same by keyboard.
  await at(page, 'chart-angle').focus();
  await page.keyboard.press('Escape');
  await expect(cursor).not.toHaveAttribute('data-mark', /./);
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('Enter');
  await page.keyboard.press('Shift+ArrowRight');
  await expect.poll(() => read('data-delta')).toBeGreaterThan(0.1);
});

test('what is drawn is chosen and remembered, and follows the theme', async ({ page }) => {
  await demo(page, 'format=rs485&command=t');
  await at(page, 'plot-temperature').click();
  await expect(at(page, 'chart-temperature').locator('..')).toContainText('31.2 °C');
  await demo(page, 'format=rs485&command=t');
  await expect(at(page, 'chart-temperature')).toBeVisible();
  await expect.poll(() => drawn(page, 'temperature', '--flags')).toBeGreaterThan(5);
  await page.getByLabel('Light or dark').click();
  await expect.poll(() => drawn(page, 'temperature', '--flags')).toBeGreaterThan(5);
  await at(page, 'plot-angle').click();
  await expect(at(page, 'chart-angle')).toHaveCount(0);
  await at(page, 'plot-angle').click();

  await demo(page, 'format=t485');
  await expect(at(page, 'plot-temperature')).toBeHidden();
  await expect(at(page, 'chart-temperature')).toHaveCount(0);
});

test('a moving shaft is said to move, a held one has no spread', async ({ page }) => {
  await demo(page);
  await expect(at(page, 'standstill')).toHaveAttribute('data-value', 'moves');
  await expect(at(page, 'standstill')).toContainText('the shaft moves');
  await at(page, 'demo-hold').click();
  await expect(at(page, 'standstill')).toHaveAttribute('data-value', 'rests');
  await until(page, 'standstill-sigma', (sigma) => sigma === 0);
  expect(await number(page, 'standstill-peak')).toBe(0);
});

test('the spread of a noisy encoder is measured over zero, and silence is counted @serial', async ({ page }) => {
  encoder = await Encoder.start('--format', 't485', '--angle-bits', '17', 'still=3.0', 'noise=2');
  await page.goto('/#/console?format=t485&angle-bits=17');
  await at(page, 'connect').click();
  await expectLink(page, 'reading');
  await expect(at(page, 'standstill')).toHaveAttribute('data-value', 'rests');
  await until(page, 'standstill-peak', (counts) => counts >= 1 && counts <= 5);
  await until(page, 'standstill-sigma', (counts) => counts > 0.5 && counts < 2.5);
  await at(page, 'plot-errors').click();
  encoder.set('silent=1');
  await expect(at(page, 'chart-errors').locator('..')).toContainText(/highest +[1-9]/);
  await expect(at(page, 'standstill')).toHaveAttribute('data-value', 'unknown');
});
