// Every view of the page, as pictures and tests look at them, in any language.
import { at, expect, expectLink, until } from './page.js';

const DUMP = `[14:02:11.512] TX> 1A
[14:02:11.513] RX< 1a 20 29 c0 3b 17 00 00 00 c8 37
[14:02:11.613] TX> 1A
[14:02:11.614] RX< 1a 20 83 c1 52 17 00 00 00 c8 f5
[14:02:11.714] RX< 1a 20 bf e1 0x 17 00 00 00 c8 c6`;

const go = async (page, fragment, language = 'en') => {
  await page.goto(`/?lang=${language}#/${fragment}`);
  await expect(page.locator('html')).toHaveAttribute('lang', language);
};

const demo = async (page, language) => {
  await go(page, 'console?format=t485', language);
  await at(page, 'demo').click();
  await expectLink(page, 'reading');
  await until(page, 'frames-ok', (frames) => frames > 2_000);
  await expect(at(page, 'chart-angle').locator('canvas')).toBeVisible();
};

/** A recording with a note in it. */
const record = async (page) => {
  await at(page, 'record').click();
  await until(page, 'recorded', (size) => size > 60_000);
  await page.locator('form.note input').fill('14:05');
  await at(page, 'record-mark').click();
  await at(page, 'record').click();
  await expect(at(page, 'record')).toHaveAttribute('aria-pressed', 'false');
  await expect(at(page, 'recording').first()).toHaveAttribute('data-whole', 'true');
};

const reference = (fragment) => async (page, language) => {
  await go(page, `reference${fragment}`, language);
  await expect(page.locator('.reference article h1, .reference h1').first()).toBeVisible();
};

/** Names, and what opens them with `page` in a language. */
export const views = {
  first: async (page, language) => {
    await go(page, 'console', language);
    // The log is full: no more rows come.
    await expect(at(page, 'frame-row')).toHaveCount(14);
  },
  console: demo,
  setting: async (page, language) => {
    await demo(page, language);
    await at(page, 'demo-hold').click();
    await at(page, 'zero-start').first().click();
    await expect(at(page, 'gate')).toHaveAttribute('data-value', 'true');
  },
  finder: async (page, language) => {
    await demo(page, language);
    await at(page, 'find').click();
    await expect(at(page, 'search')).toHaveAttribute('data-done', 'true', { timeout: 20_000 });
  },
  recordings: async (page, language) => {
    await demo(page, language);
    for (const count of [1, 2]) {
      await record(page);
      await expect(at(page, 'recording')).toHaveCount(count);
    }
    for (const box of await at(page, 'recording').locator('input').all()) await box.check();
    await at(page, 'compare').click();
    await expect(at(page, 'comparison')).toBeVisible();
    await at(page, 'comparison').scrollIntoViewIfNeeded();
  },
  replay: async (page, language) => {
    await demo(page, language);
    await record(page);
    await at(page, 'replay').first().click();
    await expectLink(page, 'reading');
  },
  support: async (page, language) => {
    await demo(page, language);
    await at(page, 'report').click();
    await expect(at(page, 'report-preview')).toBeVisible();
    await at(page, 'report-preview').scrollIntoViewIfNeeded();
  },
  decode: async (page, language) => {
    await go(page, 'decode?format=t485', language);
    await at(page, 'dump-input').fill(DUMP);
    await expect(at(page, 'dump-row')).toHaveCount(2);
    await at(page, 'dump-row').nth(1).click();
    await expect(at(page, 'explain-field').first()).toBeVisible();
    await expect(at(page, 'candidate').first()).toBeVisible();
  },
  'decode-empty': async (page, language) => {
    await go(page, 'decode', language);
    await expect(at(page, 'dump-input')).toBeVisible();
  },
  explain: async (page, language) => {
    await go(page, 'explain?format=biss-c&angle-bits=17&turns-bits=16', language);
    await expect(at(page, 'explain-bit').first()).toBeVisible();
  },
  reference: reference(''),
  'reference-format': reference('?format=t485'),
  'reference-order-code': reference('?page=order-code'),
  'reference-wiring': reference('?page=wiring'),
  'reference-ssi-line': reference('?page=ssi-line'),
};
