// Everybody can use the page: axe finds nothing, the keyboard reaches all, and nothing is cut off
// where letters are twice as large.
import { readFileSync } from 'node:fs';
import { at, expect, expectLink, test } from './page.js';
import { views } from './views.js';

const AXE = readFileSync(new URL('../../node_modules/axe-core/axe.min.js', import.meta.url), 'utf8');

/** What axe finds, in words. */
const violations = async (page) => {
  await page.evaluate(AXE);
  const { violations } = await page.evaluate(() => axe.run(document, { resultTypes: ['violations'] }));
  return violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target.join(' ')).join(', ')}`);
};

for (const [name, open] of Object.entries(views)) {
  for (const [theme, language] of [['light', 'en'], ['dark', 'ru']]) {
    test(`axe finds nothing: ${name}, ${theme}, ${language}`, async ({ page }) => {
      test.setTimeout(60_000);
      await page.emulateMedia({ colorScheme: theme });
      await open(page, language);
      expect(await page.locator('html').getAttribute('data-theme')).toBe(theme);
      expect(await violations(page)).toEqual([]);
    });
  }
}

/** Whatever gets the focus by Tab, from wherever it is, until it comes round again. */
const tabbed = async (page) => {
  const found = [];
  for (let step = 0; step < 400; step += 1) {
    await page.keyboard.press('Tab');
    const seen = await page.evaluate(() => {
      const element = document.activeElement;
      if (!element || element === document.body) return undefined;
      if (element.dataset.tabbed) return 'again';
      element.dataset.tabbed = 'yes';
      const { outlineStyle, outlineWidth } = getComputedStyle(element);
      const box = element.getBoundingClientRect();
      return {
        name: element.dataset.testid ?? element.textContent.trim().slice(0, 30),
        ringed: outlineStyle !== 'none' && parseFloat(outlineWidth) >= 1,
        shown: box.width > 0 && box.height > 0,
      };
    });
    if (seen === 'again') return found;
    if (seen) found.push(seen);
  }
  throw new Error('Tab never comes round');
};

for (const name of ['first', 'decode', 'explain', 'reference']) {
  test(`the keyboard reaches everything, with a ring to see: ${name}`, async ({ page }) => {
    test.setTimeout(60_000);
    await views[name](page, 'en');
    await page.evaluate(() => document.activeElement?.blur());
    const found = await tabbed(page);
    expect(found.length).toBeGreaterThan(8);
    expect(found.filter(({ ringed, shown }) => !ringed || !shown)).toEqual([]);
    const missed = await page.evaluate(() =>
      [...document.querySelectorAll('button, a[href], input, select, textarea, summary')]
        .filter((element) => element.checkVisibility() && !element.disabled && element.tabIndex >= 0)
        .filter((element) => !element.dataset.tabbed && element.type !== 'radio')
        .map((element) => element.outerHTML.slice(0, 100)),
    );
    expect(missed).toEqual([]);
  });
}

test('an encoder is read, its dump decoded and explained by keyboard alone', async ({ page }) => {
  await page.goto('/#/console');
  await at(page, 'demo').focus();
  await page.keyboard.press('Enter');
  await expectLink(page, 'reading');
  await page.locator('nav a').nth(1).focus();
  await page.keyboard.press('Enter');
  await at(page, 'dump-input').focus();
  await page.keyboard.type('1a 20 29 c0 3b 17 00 00 00 c8 37');
  await expect(at(page, 'explain-field').first()).toBeVisible();
});

test('lamps say in words what they show in colour, and readings are not read out', async ({ page }) => {
  await views.console(page, 'en');
  for (const lamp of await page.locator('.lamp, .rung').all()) expect((await lamp.textContent()).trim()).not.toBe('');
  const live = await page.locator('[aria-live]:not([aria-live="off"]), [role="status"], [role="alert"]').all();
  for (const region of live) expect(await region.locator('[data-testid="angle"], .frames').count()).toBe(0);
});

test('letters twice as large cut nothing off', async ({ page }) => {
  test.setTimeout(60_000);
  // What 200 % makes of a window of 1280 pixels.
  await page.setViewportSize({ width: 640, height: 450 });
  for (const name of ['console', 'decode', 'explain', 'reference']) {
    await views[name](page, 'ru');
    const wide = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
    expect(wide, name).toBeLessThanOrEqual(0);
  }
});

test('who wants less motion gets none', async ({ page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await views.console(page, 'en');
  const moving = await page.evaluate(() =>
    document.getAnimations().filter((animation) => animation.playState === 'running').length,
  );
  expect(moving).toBe(0);
});
