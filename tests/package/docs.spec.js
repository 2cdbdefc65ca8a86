// The built documents.
import { bits, expect, field, shown, test, verdict } from './element.js';

const at = (path) => `http://localhost:8093/${path}`;

/** A click on a bit of a field changes it, and the checks follow. */
async function isAlive(element, at) {
  const before = await shown(element);
  await bits(element).nth(at).click();
  await expect.poll(() => shown(element)).not.toBe(before);
  await expect(element.locator('.fault:visible')).toHaveCount(0);
}

test('the mdBook chapter on BiSS-C @book', async ({ page }) => {
  await page.goto(at('book/biss-c.html'));
  const element = page.locator('#biss-c');
  await expect(field(element, 'angle')).toContainText('180.0000°');
  await expect(field(element, 'crc')).toContainText('computed 0x34');
  for (const name of ['idle', 'ack', 'start', 'cds', 'turns', 'nError', 'nWarning', 'status']) {
    await expect(field(element, name)).toBeVisible();
  }
  await isAlive(element, 30);
  const misread = page.locator('encoder-frame').nth(1);
  await expect(verdict(misread)).toHaveText('good frame; 135°; turns: 1');
});

test('the mdBook chapter on T485 @book', async ({ page }) => {
  await page.goto(at('book/t485.html'));
  await expect(bits(page.locator('#request'))).toHaveCount(8);
  await expect(field(page.locator('#request'), 'sink')).toBeVisible();
  const element = page.locator('#reply');
  await expect(field(element, 'angle')).toContainText('168.0486°');
  for (const name of ['battery alarm', 'battery error', 'counter overflow']) {
    await expect(field(element, 'alarm')).toContainText(name);
  }
  await isAlive(element, 20);
  // What the chapter says of the checksum: the same bit of two bytes.
  await element.getByRole('checkbox').uncheck();
  await bits(element).nth(18).click();
  await expect(verdict(element)).toHaveClass(/bad/);
  await bits(element).nth(26).click();
  await expect(verdict(element)).toHaveClass(/warn/);
});

test('the book follows its reader\'s theme @book', async ({ page }) => {
  await page.goto(at('book/frames.html'));
  const box = page.locator('encoder-frame .box');
  await expect(box).toHaveCSS('background-color', 'rgb(255, 254, 251)');
  await page.evaluate(() => localStorage.setItem('mdbook-theme', 'navy'));
  await page.reload();
  await expect(box).toHaveCSS('background-color', 'rgb(27, 33, 37)');
});

test('the Sphinx page @sphinx', async ({ page }) => {
  await page.goto(at('sphinx/index.html'));
  const element = page.locator('encoder-frame').first();
  for (const name of ['turns', 'angle', 'error', 'warning', 'status']) {
    await expect(field(element, name)).toBeVisible();
  }
  await isAlive(element, 20);
  const classic = page.locator('encoder-frame').nth(1);
  await expect(field(classic, 'angle')).toContainText('Gray');
  await expect(bits(classic)).toHaveCount(25);
});
