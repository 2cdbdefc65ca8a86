// Bad days over real Web Serial: a tab in the background, asleep, or closed. tests/reliability has
// the matrix of faults.
import { at, connect, disconnect, expect, expectAllAccounted, expectLink, number, test, until } from './page.js';
import { hide, hideable, sleep, unhide } from './away.js';
import { Encoder, options } from './encoder.js';
import { spy } from './spy.js';

let encoder;
test.afterEach(async () => {
  await encoder?.unplug();
  encoder = undefined;
});

const plug = async (page, query, ...settings) => {
  encoder = await Encoder.start(...options(query), ...settings);
  await connect(page, query);
  await expectLink(page, 'reading');
};

const T485 = 'format=t485&angle-bits=23';

test('a page that goes away lets go of the port @serial', async ({ page, context }) => {
  await plug(page, T485, 'still=0.5');
  await page.goto('about:blank');
  const second = await context.newPage();
  await connect(second, T485);
  await expectLink(second, 'reading');
  await until(second, 'angle', (angle) => angle === 2 ** 22);
});

test('a reply that waited while the tab slept does not count as a slow one @serial', async ({ page }) => {
  await spy(page);
  await plug(page, T485, 'still=0.5');
  // Few replies, so that one would show in the slowest of a hundred.
  for (const frames of [20, 40, 60]) {
    await until(page, 'frames-ok', (now) => now > frames);
    await sleep(page, 1_500);
  }
  await expectLink(page, 'reading');
  const latency = await page.evaluate(() => window.spied.latest.latency_p99);
  expect(latency).toBeGreaterThan(0);
  expect(latency).toBeLessThan(1_000);
  await disconnect(page);
  await expectAllAccounted(page);
});

test('a setting does not go on after a sleep, for the shaft may have moved @serial', async ({ page }) => {
  await plug(page, 'format=rs485&angle-bits=24&command=d', 'still=5.25');
  await until(page, 'angle', (angle) => angle === 2 ** 22);
  await at(page, 'zero-start').click();
  await expect(at(page, 'gate')).toHaveAttribute('data-value', 'true');
  await at(page, 'zero-confirm').click();
  await until(page, 'zero-count', (count) => count >= 2 && count < 9);
  await sleep(page, 3_000);
  await expect(at(page, 'zero-outcome')).toHaveAttribute('data-value', 'no');
  await page.getByRole('button', { name: 'Done' }).click();
  await expectLink(page, 'reading');
  await until(page, 'angle', (angle) => angle === 2 ** 22);
});

test('a tab in the background reads on, and at most one snapshot is on its way @serial', async ({ page }) => {
  await spy(page);
  await hideable(page);
  await plug(page, 'format=period&angle-bits=24', 'still=0.5');
  await until(page, 'frames-ok', (frames) => frames > 300);
  await hide(page);
  await page.waitForTimeout(500);
  const posted = await page.evaluate(() => window.spied.posted);
  await page.waitForTimeout(3_000);
  const [later, wanted] = await page.evaluate(() => [window.spied.posted, window.spied.wanted]);
  expect(later).toBe(posted);
  expect(later).toBeLessThanOrEqual(wanted + 1);
  const before = await number(page, 'frames-ok');
  await unhide(page);
  // It has been reading all the while: a frame every millisecond.
  await until(page, 'frames-ok', (frames) => frames > before + 2_000);
  await disconnect(page);
  await expectAllAccounted(page);
});
