// A walk through the whole page, for tests that watch what it asks for.
import { readFileSync } from 'node:fs';
import { at, expect, expectLink, until } from './page.js';

const file = (name) => readFileSync(new URL(`../${name}`, import.meta.url));
const good = '1a 20 29 c0 3b 17 00 00 00 c8 37';
const bad = '1a 20 29 c0 3b 17 00 00 00 c8 38';

/** Goes to another view as a link on the page does. */
const go = (page, fragment) => page.evaluate((fragment) => (location.hash = fragment), fragment);

/** Presses a button that gives a file. */
const save = async (page, id) => {
  const [saved] = await Promise.all([page.waitForEvent('download'), at(page, id).first().click()]);
  await saved.delete();
};

/** The demo reads, with plots and a log. */
const demo = async (page) => {
  await go(page, '#/console?format=t485');
  if ((await at(page, 'disconnect').count()) === 0) await at(page, 'demo').click();
  await expectLink(page, 'reading');
  await until(page, 'frames-ok', (frames) => frames > 200);
  await expect(at(page, 'chart-angle').locator('canvas')).toBeVisible();
  await expect(page.locator('.frames tr').nth(1)).toBeVisible();
};

/** Text and a recording are decoded, drawn, saved and shared. */
const decode = async (page) => {
  await go(page, '#/decode?format=t485');
  await at(page, 'dump-input').fill(`${good}\n${bad}\n${good}`);
  await expect(at(page, 'dump-row')).toHaveCount(3);
  await at(page, 'dump-row').first().click();
  await expect(at(page, 'explain-field').first()).toBeVisible();
  for (const id of ['save-csv', 'save-json']) await save(page, id);
  await at(page, 'share').click();
  await expect.poll(() => page.url()).toContain('frames=1.');
  await at(page, 'file-input').setInputFiles({
    name: 'ssi.vcd',
    mimeType: 'text/plain',
    buffer: file('captures/ssi-17m.sigrok.vcd'),
  });
  await expect(at(page, 'dump-row').first()).toBeVisible();
  await page.getByRole('button', { name: 'Close' }).click();
};

/** Frames of every format are taken apart. */
const explain = async (page) => {
  for (const format of ['ssi', 'biss-c', 'rs485', 't485', 'bus', 'period', 'asi1', 'asi4', 'ssi7', 'ssi-tree']) {
    await go(page, `#/explain?format=${format}`);
    await expect(at(page, 'profile')).toHaveAttribute('data-value', new RegExp(`format=${format}(&|$)`));
    await at(page, 'explain-bit').first().click();
  }
};

/** Every page of the reference is opened. */
const reference = async (page) => {
  await go(page, '#/reference');
  const links = page.locator('.reference .list > div > ul > li > a');
  await expect(links.first()).toBeVisible();
  const count = await links.count();
  expect(count).toBeGreaterThan(20);
  for (let index = 0; index < count; index += 1) {
    await links.nth(index).click();
    await expect(links.nth(index)).toHaveAttribute('aria-current', 'page');
    await expect(page.locator('.reference article h1').first()).toBeVisible();
  }
};

/** Every area, every page of the reference, the demo, a dump and a recording. */
export const tour = async (page) => {
  for (const part of [demo, decode, explain, reference]) await part(page);
};
