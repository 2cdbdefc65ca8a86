// Order codes: read as they are typed, corrected, composed, and what follows from them.
import { at, expect, test } from './page.js';

const input = (page) => at(page, 'order-code');
const part = (page, position) => page.locator(`[data-testid="order-part"][data-position="${position}"]`);
const compose = (page, position) => page.locator(`[data-testid="order-compose"][data-position="${position}"]`);
const door = (page, name) => page.locator(`[data-testid="order-door"][data-name="${name}"]`);
const meaning = (page, name) => page.locator(`[data-testid="order-meaning"][data-name="${name}"] td`).first();

const open = async (page, code) => {
  await page.goto(`/#/reference?page=order-code${code ? `&code=${encodeURIComponent(code)}` : ''}`);
  await expect(at(page, 'reference-topic')).toHaveAttribute('data-name', 'order-code');
};

/** The parameters of a link. */
const asks = async (link) => Object.fromEntries(new URLSearchParams((await link.getAttribute('href')).split('?')[1]));

test('a good code says what every part means, and its links lead to the right profile', async ({ page }) => {
  await open(page);
  await expect(at(page, 'order-part')).toHaveCount(0);
  await input(page).fill('PT-15B-25H-A-24BM-R-N-B-A');
  await expect(at(page, 'order-part')).toHaveCount(9);
  await expect(page.locator('[data-testid="order-part"][data-ok="true"]')).toHaveCount(9);
  await expect(part(page, 2)).toContainText('15 mm, bonded rotor');
  await expect(part(page, 3)).toContainText('25 mm, mounted from the front or the back');
  await expect(part(page, 5)).toContainText('24 bits, turns are counted on a battery');
  await expect(part(page, 8)).toContainText('−40…105 °C');
  await expect(at(page, 'order-fault')).toHaveCount(0);
  await expect(meaning(page, 'baud rate')).toHaveText(/^115.200$/);
  await expect(meaning(page, 'frame')).toHaveText('7 bytes');
  await expect(meaning(page, 'current')).toHaveText('≈ 100 mA');
  await expect(meaning(page, 'connector')).toHaveText('SM06B-XSRS-ETB');
  const profile = { format: 'rs485', 'angle-bits': '24', 'turns-bits': '16', baud: '115200' };
  expect(await asks(door(page, 'console'))).toMatchObject(profile);
  expect(await asks(door(page, 'decode'))).toMatchObject(profile);
  expect(await asks(door(page, 'wiring'))).toEqual({ page: 'wiring', series: 'pt', interface: 'rs485', battery: 'yes' });
  await door(page, 'format').click();
  await expect(at(page, 'reference-format')).toHaveAttribute('data-format', 'rs485');
  await page.goBack();
  await expect(input(page)).toHaveValue('PT-15B-25H-A-24BM-R-N-B-A');
  await door(page, 'decode').click();
  await expect(page).toHaveURL(/#\/decode\?.*format=rs485/);
  await expect(page).toHaveURL(/baud=115200/);
});

test('a clocked encoder is not read over a serial port', async ({ page }) => {
  await open(page, 'MPP-40-60-A-17M-B-N-A-M');
  await expect(meaning(page, 'frame')).toHaveText('47 bits');
  await expect(door(page, 'decode')).toHaveCount(1);
  await expect(door(page, 'console')).toHaveCount(0);
});

test('every wrong part is marked with what fits there', async ({ page }) => {
  await open(page, 'MPP-x-60-A-24-Z-N-A-M');
  await expect(part(page, 2)).toHaveAttribute('data-ok', 'false');
  await expect(part(page, 6)).toHaveAttribute('data-ok', 'false');
  await expect(part(page, 6)).toContainText('S, B, R, A, T, D or P fit');
  await expect(part(page, 5)).toHaveAttribute('data-ok', 'true');
  await expect(at(page, 'order-fault')).toHaveText('Part 2: "X" is no rotor diameter; 1 to 999 mm fit.');
  await expect(at(page, 'order-meaning')).toHaveCount(0);
  await expect(input(page)).toHaveAttribute('aria-invalid', 'true');
  // What is not typed yet is missing, not wrong.
  await input(page).fill('MPP-40-60-A');
  await expect(page.locator('[data-testid="order-part"][data-ok="false"]')).toHaveCount(0);
  await expect(page.locator('[data-testid="order-part"][data-ok="missing"]')).toHaveCount(5);
  // What does not exist together.
  await input(page).fill('MPP-40-60-A-24BM-T-N-A-M');
  await expect(part(page, 5)).toHaveAttribute('data-ok', 'false');
  await expect(at(page, 'order-fault')).toContainText('T485 comes with 17M, 17BM, 17FM, 23M, 23BM or 23FM only');
});

test('a Russian label is read, and its link keeps it', async ({ page }) => {
  await open(page);
  await input(page).fill('мрр 40 60 а 24вм R N а м');
  await expect(at(page, 'order-fault')).toHaveCount(0);
  await expect(part(page, 1)).toContainText('MPP');
  await expect(meaning(page, 'turns')).toContainText('battery');
  const url = page.url();
  await page.goto('/#/reference');
  await page.goto(url);
  await expect(input(page)).toHaveValue('мрр 40 60 а 24вм R N а м');
  await expect(part(page, 5)).toContainText('24BM');
  await input(page).fill('ИП-75-ASI1');
  expect(await asks(door(page, 'console'))).toMatchObject({ format: 'asi1', baud: '230400' });
  expect(await asks(door(page, 'products'))).toEqual({ page: 'products', series: 'ip-75' });
});

test('the composer writes the code', async ({ page }) => {
  await open(page);
  // All letters of the order code, without any code: 1, 1, 1, 1, 5, 7, 1, 3 and 3.
  await expect(at(page, 'order-legend')).toHaveCount(23);
  await expect(at(page, 'order-legend').filter({ hasText: '115 200 baud' })).toHaveCount(1);
  await compose(page, 'series').selectOption('PT');
  await expect(input(page)).toHaveValue('PT-20-30-A-24BM-R-N-A-M');
  await compose(page, 2).selectOption('15B');
  await expect(input(page)).toHaveValue('PT-15B-25-A-24BM-R-N-A-M');
  await compose(page, 6).selectOption('T');
  await expect(at(page, 'order-fault')).toContainText('Part 5');
  await expect(compose(page, 5).locator('option[value="24BM"]')).toContainText('not with the rest');
  await expect(compose(page, 5).locator('option[value="23BM"]')).not.toContainText('not with the rest');
  await compose(page, 5).selectOption('23BM');
  await expect(at(page, 'order-fault')).toHaveCount(0);
  await expect(input(page)).toHaveValue('PT-15B-25-A-23BM-T-N-A-M');
  // What can be kept is kept.
  await compose(page, 'series').selectOption('MPP');
  await expect(input(page)).toHaveValue('MPP-40-60-A-23BM-T-N-A-M');
  await compose(page, 'series').selectOption('short');
  await expect(input(page)).toHaveValue('23BM-T');
  await compose(page, 'series').selectOption('ASM58');
  await expect(input(page)).toHaveValue('ASM58');
  await compose(page, 2).selectOption('H');
  await expect(input(page)).toHaveValue('ASM58-H');
  await compose(page, 'series').selectOption('IP-75');
  await compose(page, 2).selectOption('SSI7');
  await expect(input(page)).toHaveValue('IP-75-SSI7');
  await expect(page).toHaveURL(/code=IP-75-SSI7/);
  // Typing moves the composer.
  await input(page).fill('mpp-50-70-a-20m-p-n-c-m');
  await expect(compose(page, 'series')).toHaveValue('MPP');
  await expect(compose(page, 2)).toHaveValue('50');
  await expect(compose(page, 5)).toHaveValue('20M');
  await expect(compose(page, 8)).toHaveValue('C');
});

test('products: every size and characteristic with its source, filtered by link', async ({ page }) => {
  await page.goto('/#/reference?page=products');
  await expect(at(page, 'product')).toHaveCount(4);
  await expect(at(page, 'product-size')).toHaveCount(35);
  const facts = at(page, 'product-fact');
  expect(await facts.count()).toBeGreaterThan(70);
  await expect(facts.locator('td:empty')).toHaveCount(0);
  await page.goto('/#/reference?page=products&series=pt&inner=30');
  await expect(at(page, 'product')).toHaveCount(1);
  await expect(at(page, 'product-size')).toHaveCount(8);
  await at(page, 'product-inner').fill('33 mm');
  await expect(at(page, 'product-size')).toHaveCount(4);
  await expect(page).toHaveURL(/inner=33%20mm/);
  await at(page, 'product-inner').fill('wide');
  await expect(at(page, 'product-size')).toHaveCount(0);
  await expect(page.getByRole('alert')).toContainText('is not a number');
  await at(page, 'product-inner').fill('');
  await at(page, 'product-series').selectOption('mpp');
  await expect(at(page, 'product-size')).toHaveCount(7);
  await page.getByRole('link', { name: 'MPP-60-80' }).click();
  await expect(input(page)).toHaveValue('MPP-60-80-A-24-B-N-A-M');
  await expect(at(page, 'order-fault')).toHaveCount(0);
});
