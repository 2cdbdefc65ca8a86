// Several devices on one BUS.
import { at, expect, expectLink, number, test, until } from './page.js';
import { Encoder, options } from './encoder.js';

let encoder;
test.afterEach(async () => {
  await encoder?.unplug();
  encoder = undefined;
});

const plug = async (page, query, ...settings) => {
  encoder = await Encoder.start(...options(query), ...settings);
  await page.goto(`/#/console?${query}`);
  await at(page, 'connect').click();
};

test('a scan finds the devices, and each has a tile @serial', async ({ page }) => {
  await plug(page, 'format=bus&address=3', 'still=1.25', 'device=7', 'still=2.5', 'device=31', 'still=3.75');
  await expectLink(page, 'reading');
  await at(page, 'scan').click();
  await expect(at(page, 'device')).toHaveCount(3);
  await expect(at(page, 'scan-result')).toContainText('3 devices');
  const angles = () =>
    at(page, 'device').evaluateAll((tiles) => tiles.map((tile) => [tile.dataset.address, tile.dataset.value]));
  await expect.poll(angles).toEqual([
    ['3', String(2 ** 22)],
    ['7', String(2 ** 23)],
    ['31', String(3 * 2 ** 22)],
  ]);
  await until(page, 'angle', (angle) => angle === 2 ** 22);
  await at(page, 'device').nth(1).click();
  await until(page, 'angle', (angle) => angle === 2 ** 23);
  expect(await number(page, 'turns')).toBe(2);
  await expect(page).toHaveURL(/address=7/);
  await expectLink(page, 'reading');
  for (const tile of await at(page, 'device').all()) {
    await expect(tile).toHaveAttribute('data-fresh', 'true');
  }
});

test('where the address of the settings does not answer, a scan finds the one that does @serial', async ({ page }) => {
  await plug(page, 'format=bus&address=9', 'still=1.25');
  await expectLink(page, 'reading');
  // A link does not go on with a port that is open.
  await page.goto('/#/console?format=bus&address=4');
  await expectLink(page, 'other-settings');
  await at(page, 'connect').click();
  await expectLink(page, 'silent');
  await at(page, 'scan').click();
  await expect(at(page, 'device')).toHaveCount(1);
  await expectLink(page, 'reading');
  await expect(page).toHaveURL(/address=9/);
  await until(page, 'angle', (angle) => angle === 2 ** 22);
});

const setAddress = async (page, address) => {
  await page.getByRole('button', { name: 'Set address…' }).click();
  await page.locator('input[name=new-address]').fill(address);
  await at(page, 'zero-confirm').click();
};

test('the address is set over the wire, and the device is read at it @serial', async ({ page }) => {
  await plug(page, 'format=bus&address=3', 'still=1.25');
  await expectLink(page, 'reading');
  await setAddress(page, '12');
  await expect(at(page, 'zero-outcome')).toHaveAttribute('data-value', 'yes', { timeout: 15_000 });
  await expect(page).toHaveURL(/address=12/);
  const frames = await number(page, 'frames-ok');
  await until(page, 'frames-ok', (now) => now > frames + 50);
});

test('the address is not set while two devices are on the wire @serial', async ({ page }) => {
  await plug(page, 'format=bus&address=3', 'still=1.25', 'device=7', 'still=2.5');
  await expectLink(page, 'reading');
  await setAddress(page, '12');
  await expect(at(page, 'zero-outcome')).toHaveAttribute('data-value', 'no', { timeout: 15_000 });
  await expect(at(page, 'zero-outcome')).toContainText('2 devices');
  await page.getByRole('button', { name: 'Done' }).click();
  await expectLink(page, 'reading');
  await at(page, 'scan').click();
  await expect(at(page, 'device')).toHaveCount(2);
});

test('two devices with one address are named @serial', async ({ page }) => {
  await plug(page, 'format=bus&address=3', 'still=1.25', 'device=9', 'still=2.5', 'device=9', 'still=7.1');
  await expectLink(page, 'reading');
  await at(page, 'scan').click();
  await expect(at(page, 'scan-result')).toContainText('at 9 is damaged');
  await setAddress(page, '12');
  await expect(at(page, 'zero-outcome')).toHaveAttribute('data-value', 'no', { timeout: 15_000 });
});

test('a device that goes away is not shown as read, and spoils nothing of the others @serial', async ({ page }) => {
  await plug(page, 'format=bus&address=3', 'still=1.25', 'device=7', 'still=2.5');
  await expectLink(page, 'reading');
  await at(page, 'scan').click();
  await expect(at(page, 'device')).toHaveCount(2);
  await at(page, 'device').nth(1).click();
  await until(page, 'angle', (angle) => angle === 2 ** 23);
  encoder.set('silent=1');
  await expect(at(page, 'device').nth(1)).toHaveAttribute('data-fresh', 'false');
  await expect(page.getByText('last reading before the link stopped')).toBeVisible();
  await expect(at(page, 'device').nth(0)).toHaveAttribute('data-fresh', 'true');
  encoder.set('silent=0');
  await expect(at(page, 'device').nth(1)).toHaveAttribute('data-fresh', 'true');
  await expect(page.getByText('last reading before the link stopped')).toHaveCount(0);
});

test('what was to be set on one encoder is not set on another', async ({ page }) => {
  await page.goto('/#/console?format=bus&address=3');
  await at(page, 'demo').click();
  await expectLink(page, 'reading');
  await page.getByRole('button', { name: 'Set address…' }).click();
  await expect(page.getByText('address 3')).toBeVisible();
  await page.goto('/#/console?format=bus&address=4');
  await expectLink(page, 'reading');
  await expect(at(page, 'zero-confirm')).toHaveCount(0);
  await expect(page.getByRole('button', { name: 'Set address…' })).toBeVisible();
});
