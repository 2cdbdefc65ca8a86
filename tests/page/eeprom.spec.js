// EEPROM and errors of a Tamagawa encoder: with the demo, and over real Web Serial.
import {
  at,
  expect,
  expectLink,
  expectOnlyLateBytes,
  expectOnlyLateFrames,
  number,
  test,
  until,
} from './page.js';
import { Encoder, options } from './encoder.js';

let encoder;
test.afterEach(async () => {
  await encoder?.unplug();
  encoder = undefined;
});

const QUERY = 'format=t485&angle-bits=17&dialect=tamagawa';

const demo = async (page) => {
  await page.goto(`/#/console?${QUERY}`);
  await at(page, 'demo').click();
  await expectLink(page, 'reading');
};

const wire = async (page, ...settings) => {
  const words = options(QUERY);
  encoder = await Encoder.start(...words, ...settings);
  await page.goto(`/#/console?${QUERY}`);
  await at(page, 'connect').click();
  await expectLink(page, 'reading');
};

const cell = (page) => page.locator('input[name=memory-address]');
const byte = (page) => page.locator('input[name=memory-byte]');
const expectCell = (page, data) =>
  expect(at(page, 'memory-cell')).toHaveAttribute('data-value', data);
const expectOutcome = (page, changed) =>
  expect(at(page, 'zero-outcome')).toHaveAttribute('data-value', changed, { timeout: 15_000 });

const readAndWrite = async (page) => {
  await cell(page).fill('0x10');
  await byte(page).fill('0xA5');
  // What is not known is not overwritten.
  await expect(at(page, 'memory-write')).toBeDisabled();
  await at(page, 'memory-read').click();
  await expectCell(page, '0');
  await expect(at(page, 'memory-cell')).toContainText('0x10 holds 0x00 · 0 · 00000000');
  await at(page, 'memory-write').click();
  await expect(at(page, 'memory-change')).toContainText('Cell 0x10: 0x00');
  await expect(at(page, 'memory-change')).toContainText('becomes 0xA5 · 165 · 10100101');
  await at(page, 'zero-confirm').click();
  await expectOutcome(page, 'yes');
  await expect(at(page, 'setting-before')).toContainText('0x00');
  await expect(at(page, 'setting-now')).toContainText('0xA5');
  await page.getByRole('button', { name: 'Done' }).click();
  // It is in the encoder, and its neighbour is as it was.
  for (const [address, data] of [
    ['17', '0'],
    ['16', '165'],
  ]) {
    await cell(page).fill(address);
    await at(page, 'memory-read').click();
    await expectCell(page, data);
  }
  await expectOnlyLateFrames(page);
};

test('a byte of the EEPROM is read and written in the demo', async ({ page }) => {
  await demo(page);
  await readAndWrite(page);
  const first = await number(page, 'angle');
  await until(page, 'angle', (angle) => angle !== first && angle > 0);
});

test('cells and bytes that do not exist cannot be asked for', async ({ page }) => {
  await demo(page);
  for (const text of ['128', '0x80', '-1', 'x', '']) {
    await cell(page).fill(text);
    await expect(at(page, 'memory-read')).toBeDisabled();
  }
  await cell(page).fill('0x7f');
  await at(page, 'memory-read').click();
  await expectCell(page, '0');
  for (const text of ['256', '0x100', '', 'a5']) {
    await byte(page).fill(text);
    await expect(at(page, 'memory-write')).toBeDisabled();
  }
  await byte(page).fill('255');
  await expect(at(page, 'memory-write')).toBeEnabled();
  await cell(page).fill('0x7e');
  await expect(at(page, 'memory-write')).toBeDisabled();
});

test('encoders without an EEPROM offer none', async ({ page }) => {
  await page.goto('/#/console?format=t485&dialect=mpp');
  await at(page, 'demo').click();
  await expectLink(page, 'reading');
  await expect(page.getByText('Set the encoder')).toBeVisible();
  await expect(page.getByText('EEPROM')).toHaveCount(0);
  await expect(page.getByRole('button', { name: 'Reset errors…' })).toHaveCount(0);
});

test('a byte of the EEPROM is read and written over the wire @serial', async ({ page }) => {
  await wire(page, 'still=5.25');
  await until(page, 'angle', (angle) => angle === 2 ** 15);
  await readAndWrite(page);
  await expectOnlyLateBytes(page);
  // The angle was shown all the while, and the byte outlives the power.
  await until(page, 'angle', (angle) => angle === 2 ** 15);
  encoder.set('power=off');
  await expectLink(page, 'silent');
  encoder.set('power=on');
  await expectLink(page, 'reading');
  await cell(page).fill('17');
  await at(page, 'memory-read').click();
  await expectCell(page, '0');
  await cell(page).fill('0x10');
  await at(page, 'memory-read').click();
  await expectCell(page, '165');
});

test('a cell that is not answered for is not shown, and a lost reply stops the write @serial', async ({ page }) => {
  await wire(page, 'still=5.25');
  await cell(page).fill('5');
  await byte(page).fill('7');
  await at(page, 'memory-read').click();
  await expectCell(page, '0');
  encoder.set('silent=1');
  await at(page, 'memory-read').click();
  await expect(at(page, 'memory-cell')).toContainText('no answer yet');
  await expect(at(page, 'memory-write')).toBeDisabled();
  encoder.set('silent=0');
  await expectLink(page, 'reading');
  await at(page, 'memory-read').click();
  await expectCell(page, '0');
  await at(page, 'memory-write').click();
  encoder.set('lose=1000');
  await at(page, 'zero-confirm').click();
  await expectOutcome(page, 'no');
  await expect(at(page, 'zero-outcome')).toContainText('no reply came');
});

test('errors of a Tamagawa encoder are reset over the wire @serial', async ({ page }) => {
  await wire(page, 'still=5.25', 'error=1', 'status=4');
  await until(page, 'status', (status) => status === 0x20);
  await page.getByRole('button', { name: 'Reset errors…' }).click();
  await expect(page.getByText('The errors that the encoder keeps are cleared.')).toBeVisible();
  await at(page, 'zero-confirm').click();
  await expectOutcome(page, 'yes');
  await until(page, 'status', (status) => status === 0);
  await until(page, 'angle', (angle) => angle === 2 ** 15);
});
