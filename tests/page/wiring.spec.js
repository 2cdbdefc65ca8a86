// Wiring, zero and lamp: what the customer asks with the encoder in the hand.
import { at, download, expect, test } from './page.js';

const open = async (page, name, entries = {}) => {
  const query = new URLSearchParams({ page: name, ...entries });
  await page.goto(`/#/reference?${query}`);
  await expect(at(page, 'reference-topic')).toHaveAttribute('data-name', name);
};
const choose = (page, name, value) => page.locator(`select[data-name="${name}"]`).selectOption(value);
const wires = (page) =>
  at(page, 'wiring-row').evaluateAll((rows) =>
    rows.map(({ dataset }) => [dataset.pin, dataset.colour, dataset.signal, dataset.goes].join(' ')),
  );
const names = (locator) => locator.evaluateAll((all) => all.map(({ dataset }) => dataset.name));

test('a link gives picture, wires and warnings, and choices make such a link', async ({ page }) => {
  await open(page, 'wiring', { series: 'mpp', interface: 'rs485', battery: 'yes', adapter: 'rs485' });
  await expect(at(page, 'wiring-row')).toHaveCount(8);
  expect((await wires(page))[3]).toBe('4 green-black B adapter B (D−)');
  await expect(at(page, 'wiring-picture').locator('svg')).toBeVisible();
  expect(await names(at(page, 'wiring-warning'))).toEqual(
    expect.arrayContaining(['supply', 'battery', 'swap', 'terminator', 'rate', 'shield', 'connector']),
  );
  // Another series begins with what fits it.
  await choose(page, 'series', 'ip-75');
  await expect(at(page, 'wiring-row')).toHaveCount(6);
  expect((await wires(page))[4]).toBe('5 violet ZERO SET input at 0 V or open');
  await choose(page, 'interface', 'ssi7');
  await expect(at(page, 'wiring-row')).toHaveCount(8);
  await choose(page, 'adapter', 'apci-1710');
  await expect(page).toHaveURL(/page=wiring&series=ip-75&interface=ssi7&adapter=apci-1710/);
  expect((await wires(page))[4]).toBe('5 blue IN CLK+ adapter Ax+ CLOCK');
  const url = page.url();
  await page.goto('about:blank');
  await page.goto(url);
  await expect(at(page, 'wiring-row')).toHaveCount(8);
  expect((await wires(page))[4]).toBe('5 blue IN CLK+ adapter Ax+ CLOCK');
});

test('what does not exist gets a sentence, no picture, and what fits', async ({ page }) => {
  await open(page, 'wiring', { series: 'mpp', interface: 'ssi', adapter: 'rs485' });
  await expect(at(page, 'wiring-fault')).toContainText('A USB adapter cannot read SSI');
  await expect(at(page, 'wiring-picture')).toHaveCount(0);
  await expect(at(page, 'wiring-row')).toHaveCount(0);
  await page.getByRole('button', { name: 'SSI or BiSS master' }).click();
  await expect(at(page, 'wiring-row')).toHaveCount(6);
  await open(page, 'wiring', { series: 'ip-75', interface: 't485' });
  await expect(at(page, 'wiring-fault')).toHaveText('IP-75 does not come with T485, only with ASI1, ASI4, SSI7.');
  await expect(at(page, 'wiring-fault')).toHaveAttribute('data-input', 'interface');
  await open(page, 'wiring', { series: 'mp' });
  await expect(at(page, 'wiring-fault')).toHaveAttribute('data-input', 'series');
});

test('the picture is saved as a file that stands alone', async ({ page }) => {
  await open(page, 'wiring', { series: 'pt', interface: 'biss-c' });
  const { name, text } = await download(page, 'save-svg');
  expect(name).toBe('pt-biss-c-master.svg');
  const read = await page.evaluate((text) => {
    const file = new DOMParser().parseFromString(text, 'image/svg+xml');
    return {
      root: file.documentElement.nodeName,
      styled: file.querySelectorAll('style, [style]').length,
      words: [...file.querySelectorAll('text')].map((element) => element.textContent),
    };
  }, text);
  expect(read.root).toBe('svg');
  expect(read.styled).toBe(0);
  expect(read.words).toEqual(expect.arrayContaining(['MA+', 'SLO−', 'CLK+', 'DATA−', '120 Ω inside', '120 Ω add']));
});

test('on a phone the picture fits, in the dark its ink is light', async ({ page }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await page.emulateMedia({ colorScheme: 'dark' });
  await open(page, 'wiring', { series: 'mpp', interface: 'rs422', battery: 'yes' });
  const picture = at(page, 'wiring-picture').locator('svg');
  const box = await picture.boundingBox();
  expect(box.x).toBeGreaterThanOrEqual(0);
  expect(box.x + box.width).toBeLessThanOrEqual(390);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  expect(wide).toBeLessThanOrEqual(390);
  const light = (selector) =>
    picture.locator(selector).first().evaluate((element) => {
      const [red, green, blue] = getComputedStyle(element).fill.match(/\d+/g).map(Number);
      return (red + green + blue) / 3;
    });
  expect(await light('text.w-ink')).toBeGreaterThan(160);
  expect(await light('rect.w-paper')).toBeLessThan(80);
});

test('the zero is a checklist whose commands are those of the console', async ({ page }) => {
  await open(page, 'zero', { series: 'mpp', interface: 'rs485' });
  const pairs = at(page, 'zero-step').and(page.locator('[data-times="10"]'));
  await expect(pairs).toHaveAttribute('data-sends', '31 30');
  await expect(pairs).toContainText('C = 1, 2 … 10');
  await expect(at(page, 'zero-step').filter({ hasText: 'Wait 40 ms' })).toHaveCount(1);
  await choose(page, 'interface', 't485');
  await expect(at(page, 'zero-way')).toHaveCount(2);
  await expect(page.locator('[data-times="10"]').first()).toHaveAttribute('data-sends', 'c2');
  await choose(page, 'interface', 'ssi');
  await expect(at(page, 'zero-missing').first()).toContainText('no command');
  await expect(at(page, 'zero-console')).toHaveCount(0);
  await choose(page, 'series', 'ip-75');
  expect(await names(at(page, 'zero-way'))).toEqual(['zero-set', 'zero-reset']);
  await choose(page, 'series', 'avm58');
  await expect(at(page, 'zero-step').last()).toContainText('PRESET1');
  await open(page, 'zero', { series: 'mpp', interface: 'bus' });
  await at(page, 'zero-console').click();
  await expect(page).toHaveURL(/#\/console\?format=bus/);
  await open(page, 'zero', { series: 'pt', interface: 'asi1' });
  await expect(at(page, 'zero-fault')).toContainText('PT does not come with ASI1');
});

test('a lamp leads to bits, and a status byte to the lamp', async ({ page }) => {
  await open(page, 'lamp', { lamp: 'yellow', blinking: 'yes' });
  await expect(at(page, 'lamp-shows')).toHaveAttribute('data-value', 'yellow-blinking');
  expect(await names(at(page, 'lamp-bit'))).toEqual(['battery low']);
  await expect(at(page, 'lamp-bit')).toContainText('below 2.9 V');
  await choose(page, 'lamp', 'red');
  expect(await names(at(page, 'lamp-bit'))).toEqual(['battery disconnected', 'battery low']);
  await choose(page, 'lamp', 'green');
  await expect(at(page, 'lamp-fault')).toContainText('Green does not blink');
  await at(page, 'lamp-status').fill('1000 1000');
  await expect(at(page, 'lamp-shows')).toHaveAttribute('data-value', 'red');
  await expect(page).toHaveURL(/page=lamp&status=1000/);
  const set = at(page, 'lamp-bit').and(page.locator('[data-set="true"]'));
  expect(await names(set)).toEqual(['error', 'field too strong']);
  await expect(page.locator('select[data-name="lamp"]')).toHaveValue('red');
  await at(page, 'lamp-status').fill('zz');
  await expect(at(page, 'lamp-fault')).toContainText('eight bits, b7 first, or two hex digits');
  await expect(at(page, 'lamp-bit')).toHaveCount(0);
  await choose(page, 'lamp', 'dark');
  await expect(at(page, 'lamp-shows')).toHaveAttribute('data-value', 'dark');
  // The manuals' tables are there whatever is asked.
  const biss = at(page, 'lamp-place').and(page.locator('[data-name="biss-c"]'));
  await expect(biss.locator('[data-name="error"]')).toHaveText('b13 = 0');
  await expect(biss.locator('[data-name="status"]')).toHaveText('b11…b6');
  await expect(at(page, 'lamp-battery')).toHaveCount(2);
});
