// Calculators and the registers of the APCI-1710: filled in, sent as a link, refused where impossible.
import { at, download, expect, test } from './page.js';

const input = (page, name) => page.locator(`[data-testid=calculator-input][data-name="${name}"]`);
const answer = (page, name) => page.locator(`[data-testid=calculator-answer][data-name="${name}"]`);
const value = async (page, name) => Number(await answer(page, name).getAttribute('data-value'));

/** A calculator, an entry with what it changes, and one that is impossible. */
const calculators = {
  resolution: { name: 'value', text: '14', changes: ['arc-seconds', 79.1015625], wrong: '-3' },
  'ssi-line': { name: 'length', text: '100', changes: ['delay', 1600], wrong: 'far' },
  'bus-timing': { name: 'angle-bits', text: '16', changes: ['suspend', 32], wrong: '25' },
  'apci-1710': { name: 'clock', text: '330', changes: ['frq', 50], wrong: '1100' },
};

test('a calculator keeps what is entered in its link, and refuses what is impossible', async ({ page }) => {
  for (const [calculator, { name, text, changes, wrong }] of Object.entries(calculators)) {
    await page.goto(`/#/reference?page=${calculator}`);
    await expect(at(page, 'calculator')).toHaveAttribute('data-name', calculator);
    const [changed, expected] = changes;
    expect(await value(page, changed)).not.toBeCloseTo(expected, 3);
    await input(page, name).fill(text);
    await expect.poll(() => value(page, changed)).toBeCloseTo(expected, 3);
    await expect(page).toHaveURL(new RegExp(`page=${calculator}&${name}=${text}$`));
    await page.reload();
    await expect(input(page, name)).toHaveValue(text);
    await expect.poll(() => value(page, changed)).toBeCloseTo(expected, 3);

    await input(page, name).fill(wrong);
    await expect(at(page, 'calculator-fault')).toHaveAttribute('data-input', name);
    await expect(at(page, 'calculator-fault')).toHaveText(/^[A-Z0-9].*[^.]\.$/);
    await expect(at(page, 'calculator-answer')).toHaveCount(0);
    await expect(at(page, 'calculator-code')).toHaveCount(0);
    await expect(input(page, name)).toHaveAttribute('aria-invalid', 'true');
    await input(page, name).fill(text);
    await expect(at(page, 'calculator-fault')).toHaveCount(0);
  }
});

test('every calculator is in the contents', async ({ page }) => {
  await page.goto('/#/reference');
  const contents = page.getByRole('navigation', { name: 'Reference' });
  for (const title of ['Resolution', 'SSI line', 'BUS timing', 'APCI-1710', 'USB adapters']) {
    await contents.getByRole('link', { name: title, exact: true }).click();
    await expect(at(page, 'calculator').locator('h1')).toHaveText(title);
    await expect(at(page, 'calculator-fault')).toHaveCount(0);
    expect(await at(page, 'calculator-answer').count()).toBeGreaterThan(4);
  }
});

test('a filled calculator opens from its link', async ({ page }) => {
  await page.goto('/#/reference?page=ssi-line&length=200&clock=300&format=ssi7&bits=30');
  await expect(input(page, 'format')).toHaveValue('ssi7');
  expect(await value(page, 'delay')).toBe(2900);
  expect(await value(page, 'clocks')).toBe(31);
  await expect(answer(page, 'verdict')).toContainText('wrong bits');
  await input(page, 'format').selectOption('biss-c');
  await expect.poll(() => value(page, 'clocks')).toBe(32);
  await expect(page).toHaveURL(/format=biss-c/);
  // The profile that is shared has not followed.
  await expect(at(page, 'profile')).toHaveAttribute('data-value', /format=t485/);
});

test('the program for the board has the numbers filled in', async ({ page, context }) => {
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  await page.goto('/#/reference?page=apci-1710&base=0xD000&module=2&clock=330');
  const code = at(page, 'calculator-code');
  await expect(code).toContainText('#define FRQ         (BOARD + 0x80u) /* write */');
  await expect(code).toContainText('port_out(50u, FRQ); /* 33 MHz / 100 */');
  await expect(code).toContainText('0xD000u');
  await at(page, 'copy-code').click();
  await expect(page.getByText('Program copied.')).toBeVisible();
  const text = await code.textContent();
  expect(await page.evaluate(() => navigator.clipboard.readText())).toBe(text);
  const saved = await download(page, 'save-code');
  expect(saved).toEqual({ name: 'apci1710.c', text });
});

const register = (page, name) => page.locator(`[data-testid=register][data-name=${name}]`);
const bit = (page, name, index) =>
  register(page, name).locator(`[data-testid=register-bit][data-index="${index}"]`);
const field = (page, name, wanted) =>
  register(page, name).locator(`[data-testid=register-field][data-name=${wanted}]`);

test('registers say what their bits mean, and the link keeps them', async ({ page }) => {
  await page.goto('/#/reference?page=apci-1710-registers');
  await expect(at(page, 'reference-topic')).toHaveAttribute('data-name', 'apci-1710-registers');
  await expect(at(page, 'register-row')).toHaveCount(10);
  await expect(field(page, 'frq', 'divider')).toContainText('through 100');
  await expect(field(page, 'counts', 'bits')).toContainText('26 clocks');
  await expect(field(page, 'identity', 'function')).toContainText('Synchronous Serial Interface');

  await expect(field(page, 'status', 'busy')).toContainText('done');
  await bit(page, 'status', 0).click();
  await expect(field(page, 'status', 'busy')).toContainText('on its way');
  await expect(bit(page, 'status', 0)).toHaveAttribute('data-value', '1');
  await expect(bit(page, 'status', 0)).toBeFocused();
  await bit(page, 'status', 4).click();
  await expect(field(page, 'status', 'input_1')).toContainText('is low');
  const entered = register(page, 'status').getByTestId('register-value');
  await expect(entered).toHaveValue('0x0000001F');
  await expect(page).toHaveURL(/status=0x0000001F/);
  await page.reload();
  await expect(register(page, 'status')).toHaveAttribute('data-value', '31');

  await entered.fill('0b111');
  await bit(page, 'status', 3).click();
  await expect(entered).toHaveValue(/^0b0{28}1111$/);
  await entered.fill('busy');
  await expect(register(page, 'status').getByTestId('register-fault')).toContainText('no value');
  await expect(register(page, 'status').getByTestId('register-field')).toHaveCount(0);
  await expect(bit(page, 'status', 0)).toBeDisabled();
});

test('SHIFT is read as the encoder of the link writes it', async ({ page }) => {
  // The article's encoder of 8 + 10 bits in a word of 25, binary and not converted.
  const encoder = 'format=ssi-tree&angle-bits=10&turns-bits=8&code=binary';
  const word = '0b0000_10100101_1100001111_000';
  await page.goto(`/#/reference?page=apci-1710-registers&control=0&shift=${word}&${encoder}`);
  await expect(at(page, 'shift-turns')).toHaveAttribute('data-value', String(0b10100101));
  await expect(at(page, 'shift-angle')).toHaveAttribute('data-value', String(0b1100001111));
  const names = register(page, 'shift').getByTestId('register-field');
  expect(await names.evaluateAll((all) => all.map((row) => row.dataset.name))).toEqual(['above', 'leading', 'turns', 'angle', 'trailing']);
  await expect(at(page, 'shift-profile')).toHaveCount(0);
  await bit(page, 'shift', 3).click();
  await expect(at(page, 'shift-angle')).toHaveAttribute('data-value', String(0b1100001110));
  await bit(page, 'shift', 24).click();
  await expect(at(page, 'shift-bad')).toBeVisible();
  await page.reload();
  await expect(at(page, 'shift-angle')).toHaveAttribute('data-value', String(0b1100001110));
  await expect(at(page, 'profile')).toHaveAttribute('data-value', /angle-bits=10&turns-bits=8/);
});

test('what the module converts is read the same, channel by channel', async ({ page }) => {
  await page.goto('/#/reference?page=apci-1710-registers&format=ssi-tree');
  const angle = at(page, 'shift-angle');
  await expect(at(page, 'shift-form')).toContainText('has converted');
  const converted = await angle.getAttribute('data-value');
  const held = await register(page, 'shift').getAttribute('data-value');
  await at(page, 'register-channel').selectOption('2');
  await expect(at(page, 'shift-form')).toContainText('D1 of CONTROL is 0');
  // The example is the same position, and stands in SHIFT as Gray code now.
  await expect(angle).toHaveAttribute('data-value', converted);
  expect(await register(page, 'shift').getAttribute('data-value')).not.toBe(held);
  await bit(page, 'control', 1).click();
  await expect(at(page, 'shift-form')).toContainText('D1 of CONTROL is 1');
  await expect(register(page, 'shift')).toHaveAttribute('data-value', held);
});

test('an encoder that no SSI module reads is said, and a link takes one that it does', async ({ page }) => {
  await page.goto('/#/reference?page=apci-1710-registers&frq=7');
  await expect(at(page, 'shift-profile')).toContainText('T485');
  await expect(at(page, 'shift-angle')).toBeVisible();
  await at(page, 'shift-profile').getByRole('link').click();
  await expect(at(page, 'profile')).toHaveAttribute('data-value', /format=ssi-tree/);
  await expect(at(page, 'shift-profile')).toHaveCount(0);
  await expect(register(page, 'frq')).toHaveAttribute('data-value', '7');
  await page.goto('/#/reference?page=apci-1710-registers&format=ssi');
  await expect(at(page, 'shift-fault')).toContainText('48 bits');
  await expect(at(page, 'shift-angle')).toHaveCount(0);
});
