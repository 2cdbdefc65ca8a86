// English and Russian: all of it, remembered, in the address, and changed while it runs.
import { at, expect, expectLink, number, test, until } from './page.js';
import { views } from './views.js';

/** Words that are the same in every language: names of formats, makers, programs, keys, units and code. */
const SAME = /^(?:Encoderscope|Wireshark|Enter|Esc|Synchronous|Serial|Interface|Latency|Timer|[A-Z0-9+/-]+|[a-z-]+=.*|0x[0-9A-Fa-f]+)$/;

/** Texts on the page with two English words in a row, beside what is data. */
const english = (page) =>
  page.evaluate((same) => {
    const data = 'pre, code, textarea, option[lang], [lang="en"], .bytes, .source, svg style, script, style';
    const names = new RegExp(same);
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    const found = [];
    for (let node = walker.nextNode(); node; node = walker.nextNode()) {
      if (node.parentElement.closest(data)) continue;
      const words = node.data.split(/[\s,.:;()«»"„“”!?·…]+/).map((word) => /^[A-Za-z][a-z'’-]+$/.test(word) && !names.test(word));
      if (words.some((word, index) => word && words[index + 1])) found.push(node.data.trim());
    }
    for (const element of document.querySelectorAll('[title], [aria-label], [placeholder]')) {
      for (const name of ['title', 'aria-label', 'placeholder']) {
        const text = element.getAttribute(name) ?? '';
        if (/[a-z]{3,} [a-z]{3,}/.test(text) && !element.closest(data)) found.push(`${name}: ${text}`);
      }
    }
    return [...new Set(found)];
  }, SAME.source);

for (const [name, open] of Object.entries(views)) {
  test(`Russian is complete: ${name}`, async ({ page }) => {
    test.setTimeout(60_000);
    await open(page, 'ru');
    expect(await english(page)).toEqual([]);
  });
}

test('every page of the reference is in Russian', async ({ page }) => {
  test.setTimeout(120_000);
  await views.reference(page, 'ru');
  const links = page.locator('.reference .list > div > ul > li > a');
  const count = await links.count();
  expect(count).toBeGreaterThan(20);
  const found = [];
  for (let index = 0; index < count; index += 1) {
    await links.nth(index).click();
    await expect(links.nth(index)).toHaveAttribute('aria-current', 'page');
    await expect(page.locator('.reference article h1').first()).toBeVisible();
    found.push(...(await english(page)));
  }
  expect([...new Set(found)]).toEqual([]);
});

test('the language changes while an encoder is read, and nothing is lost', async ({ page }) => {
  await page.goto('/#/console?format=t485');
  await at(page, 'demo').click();
  await expectLink(page, 'reading');
  await until(page, 'frames-ok', (frames) => frames > 500);
  await at(page, 'language-ru').click();
  await expect(page.locator('nav a').first()).toHaveText('Консоль');
  expect(await number(page, 'frames-ok')).toBeGreaterThan(500);
  await expectLink(page, 'reading');
  await expect(page).toHaveURL(/[?&]lang=ru.*#\/console\?format=t485/);
  await expect(page.locator('html')).toHaveAttribute('lang', 'ru');
  await at(page, 'language-en').click();
  await expect(page.locator('nav a').first()).toHaveText('Console');
  expect(await number(page, 'frames-ok')).toBeGreaterThan(500);
});

test('what the user did since the link stays when the language changes', async ({ page }) => {
  const cable = page.locator('[data-testid="calculator-input"][data-name="length"]');
  const dump = '1a 20 83 c1 52 17 00 00 00 c8 f5';
  await page.goto('/?lang=en#/reference?page=ssi-line');
  await cable.fill('77');
  await at(page, 'language-ru').click();
  await expect(page.locator('nav a').first()).toHaveText('Консоль');
  await expect(cable).toHaveValue('77');
  // The button that was pressed is another one now.
  await expect(at(page, 'language-ru')).toBeFocused();

  await page.goto('/?lang=en#/decode?format=t485&dump=1a2029c03b17000000c837');
  await expect(at(page, 'dump-row')).toHaveCount(1);
  await at(page, 'dump-input').fill(dump);
  await at(page, 'language-ru').click();
  await expect(at(page, 'dump-input')).toHaveValue(dump);
  await expect(at(page, 'dump-row')).toContainText('232,7509');
});

test('the built-in encoder and the plot stay as they were set', async ({ page }) => {
  await views.console(page, 'en');
  await at(page, 'demo-hold').click();
  await page.getByText('Demo status and faults').click();
  await page.locator('input[name="demo-error"]').check();
  await page.getByRole('button', { name: '2 min' }).click();
  await at(page, 'language-ru').click();
  await expect(page.locator('.shaft small').first()).toHaveText('стоит');
  await expect(page.locator('input[name="demo-error"]')).toBeChecked();
  await expect(page.getByRole('button', { name: '2 мин' })).toHaveAttribute('aria-pressed', 'true');
  await expect(at(page, 'led')).toHaveClass(/bad/);
});

test('what was decoded is said again in the other language', async ({ page }) => {
  await views.decode(page, 'en');
  await expect(at(page, 'candidate').first()).toContainText('the check holds');
  await at(page, 'language-ru').click();
  await expect(at(page, 'candidate').first()).toContainText('контроль сходится');
  await expect(at(page, 'dump-row')).toHaveCount(2);
});

test('the language is remembered, and a link brings its own', async ({ page }) => {
  await page.goto('/');
  await at(page, 'language-ru').click();
  await expect(page.locator('nav a').first()).toHaveText('Консоль');
  await page.goto('/#/reference');
  await page.reload();
  await expect(page.locator('nav a').first()).toHaveText('Консоль');
  await page.goto('/?lang=en#/console');
  await expect(page.locator('nav a').first()).toHaveText('Console');
});

test.describe('a Russian browser', () => {
  test.use({ locale: 'ru-RU' });
  test('gets Russian, with decimal commas', async ({ page }) => {
    await page.goto('/');
    await expect(page.locator('nav a').first()).toHaveText('Консоль');
    await expect(at(page, 'angle')).toContainText(/\d,\d{3}/);
  });
});

test('without the texts the page is English', async ({ page }) => {
  await page.route('**/*.json', (route) => route.abort());
  page.removeAllListeners('console');
  await page.goto('/?lang=ru');
  await expect(page.locator('nav a').first()).toHaveText('Console');
});
