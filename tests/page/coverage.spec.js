// Every table of the manuals is where docs/coverage.md says.
import { readFileSync } from 'node:fs';
import { at, expect, test } from './page.js';

const text = readFileSync(new URL('../../docs/coverage.md', import.meta.url), 'utf8');
const rows = text.split('\n').filter((line) => line.startsWith('| ') && !line.startsWith('| table'));
const links = [...new Set([...text.matchAll(/`(#\/[^`]+)`/g)].map(([, link]) => link))];

test('every table has a page or a reason', () => {
  // MPP 31, PT 25, IP-75 12, P+F 7.
  expect(rows.length).toBe(75);
  for (const row of rows) expect(row, row).toMatch(/`#\/reference\?[^`]+`|\| none: .{20,}/);
});

test('every page that is named is there', async ({ page }) => {
  test.setTimeout(120_000);
  expect(links.length).toBeGreaterThan(35);
  await page.goto('/#/reference');
  for (const link of links) {
    const asked = new URLSearchParams(link.split('?')[1]);
    // A link followed on the page, as a reader would; the address is set, nothing is loaded.
    await page.evaluate((link) => (location.hash = link), link);
    const [name, format, section, erratum] = ['page', 'format', 'section', 'erratum'].map((key) => asked.get(key));
    if (format) {
      await expect(at(page, 'reference-format'), link).toHaveAttribute('data-format', format);
      await expect(page.locator(`#section-${section}`).locator('tr:visible, li:visible, dl:visible').first(), link).toBeVisible();
    } else if (name === 'errata') {
      await expect(page.locator(`#erratum-${erratum}`), link).toBeVisible();
    } else {
      const sheet = page.locator('[data-testid="reference-topic"], [data-testid="calculator"]');
      await expect(sheet, link).toHaveAttribute('data-name', name);
      await expect(sheet.locator('tr:visible, li:visible, dl:visible').first(), link).toBeVisible();
      for (const [key, value] of asked) expect(page.url()).toContain(`${key}=${value}`);
    }
    await expect(page.getByRole('alert'), link).toHaveCount(0);
  }
});
