// Guided setting: with the demo encoder in any browser, and over real Web Serial.
import { at, expect, expectLink, number, test, until } from './page.js';
import { Encoder, options } from './encoder.js';
import { spy } from './spy.js';

let encoder;
test.afterEach(async () => {
  await encoder?.unplug();
  encoder = undefined;
});

const plug = async (page, query, ...settings) => {
  const words = options(query);
  encoder = await Encoder.start(...words, ...settings);
  await page.goto(`/#/console?${query}`);
  await at(page, 'connect').click();
  await expectLink(page, 'reading');
};

/** Opens the gate, waits until the shaft is known to stand still, and confirms. */
const confirm = async (page, start) => {
  await start.click();
  await expect(at(page, 'gate')).toHaveAttribute('data-value', 'true');
  await at(page, 'zero-confirm').click();
};

const expectOutcome = (page, changed) =>
  expect(at(page, 'zero-outcome')).toHaveAttribute('data-value', changed, { timeout: 15_000 });

test('the demo encoder is zeroed when it stands still, and not while it moves', async ({ page }) => {
  await page.goto('/#/console?format=rs485');
  await at(page, 'demo').click();
  await expectLink(page, 'reading');
  await at(page, 'zero-start').click();
  await expect(at(page, 'gate')).toContainText('moves');
  await expect(at(page, 'zero-confirm')).toBeDisabled();
  await page.getByText('Cancel').click();
  await at(page, 'demo-hold').click();
  await confirm(page, at(page, 'zero-start'));
  await until(page, 'zero-count', (count) => count >= 1 && count <= 10);
  await expectOutcome(page, 'yes');
  expect(await number(page, 'zero-count')).toBe(10);
  await until(page, 'angle', (angle) => angle === 0);
  await until(page, 'turns', (turns) => turns === 0);
  expect(await number(page, 'frames-bad')).toBe(0);
  expect(await number(page, 'silent')).toBe(0);
  await page.getByRole('button', { name: 'Done' }).click();
  await expect(at(page, 'zero-start')).toBeVisible();
});

test('the demo encoder takes a new address and is read at it', async ({ page }) => {
  await page.goto('/#/console?format=bus');
  await at(page, 'demo').click();
  await expectLink(page, 'reading');
  await at(page, 'setting-start').click();
  await expect(page.getByText('connect only one')).toBeVisible();
  await page.locator('input[name=new-address]').fill('32');
  await expect(at(page, 'zero-confirm')).toBeDisabled();
  await page.locator('input[name=new-address]').fill('7');
  await at(page, 'zero-confirm').click();
  await expectOutcome(page, 'yes');
  await expect(page).toHaveURL(/address=7/);
  const frames = await number(page, 'frames-ok');
  await until(page, 'frames-ok', (now) => now > frames + 50);
});

test('free-running encoders offer nothing to set', async ({ page }) => {
  await page.goto('/#/console?format=period');
  await at(page, 'demo').click();
  await expectLink(page, 'reading');
  await expect(page.getByText('Set the encoder')).toHaveCount(0);
});

for (const [name, query] of [
  ['RS485', 'format=rs485&angle-bits=24&command=d'],
  ['BUS', 'format=bus&angle-bits=24'],
]) {
  test(`${name} is zeroed over the wire, and counts to ten @serial`, async ({ page }) => {
    await plug(page, query, 'still=5.25');
    await until(page, 'angle', (angle) => angle === 2 ** 22);
    await confirm(page, at(page, 'zero-start'));
    await expectOutcome(page, 'yes');
    expect(await number(page, 'zero-count')).toBe(10);
    await until(page, 'angle', (angle) => angle === 0);
    await until(page, 'turns', (turns) => turns === 0);
  });
}

for (const [name, query, setting, angle] of [
  ['RS485', 'format=rs485&angle-bits=24&command=d', 'Zero', 2 ** 22],
  ['BUS', 'format=bus&angle-bits=24', 'Zero', 2 ** 22],
  ['T485', 'format=t485&angle-bits=23', 'ResetAngle', 2 ** 21],
]) {
  test(`${name} is not set while the shaft moves, whoever asks @serial`, async ({ page }) => {
    await spy(page);
    await plug(page, query, 'turning=0.5');
    await at(page, 'zero-start').click();
    await expect(at(page, 'gate')).toContainText('moves');
    await expect(at(page, 'zero-confirm')).toBeDisabled();
    // A message that no button has sent.
    await page.evaluate((setting) => window.spied.engine.postMessage([{ Set: setting }]), setting);
    await expectOutcome(page, 'no');
    await expect(at(page, 'zero-outcome')).toContainText('Nothing was sent');
    expect(await at(page, 'zero-count').count()).toBe(0);
    await expect(at(page, 'bytes-set')).toHaveCount(0);
    encoder.set('still=5.25');
    await until(page, 'angle', (now) => now === angle);
    expect(await number(page, 'turns')).toBe(5);
  });
}

test('T485 angle and turns are reset over the wire @serial', async ({ page }) => {
  await plug(page, 'format=t485&angle-bits=23', 'still=5.25');
  await until(page, 'angle', (angle) => angle === 2 ** 21);
  await confirm(page, at(page, 'zero-start'));
  await expectOutcome(page, 'yes');
  await until(page, 'angle', (angle) => angle === 0);
  expect(await number(page, 'turns')).toBe(5);
  await page.getByRole('button', { name: 'Done' }).click();
  await page.getByRole('button', { name: 'Reset turns…' }).click();
  await at(page, 'zero-confirm').click();
  await expectOutcome(page, 'yes');
  await until(page, 'turns', (turns) => turns === 0);
});

test('an echoing adapter does not disturb a setting @serial', async ({ page }) => {
  await plug(page, 'format=rs485&angle-bits=24&command=d', 'still=5.25', 'echo=1');
  await confirm(page, at(page, 'zero-start'));
  await expectOutcome(page, 'yes');
  await until(page, 'angle', (angle) => angle === 0);
});

test('a setting that is stopped, or loses a reply, changes nothing @serial', async ({ page }) => {
  await plug(page, 'format=rs485&angle-bits=24&command=d', 'still=5.25');
  await confirm(page, at(page, 'zero-start'));
  await until(page, 'zero-count', (count) => count >= 2);
  // A finger is not quick, and what runs must leave the button alone meanwhile.
  await page.getByRole('button', { name: 'Stop' }).click({ delay: 80 });
  await expectOutcome(page, 'no');
  await page.getByRole('button', { name: 'Done' }).click();
  await expectLink(page, 'reading');
  await until(page, 'angle', (angle) => angle === 2 ** 22);

  await confirm(page, at(page, 'zero-start'));
  await until(page, 'zero-count', (count) => count >= 2);
  encoder.set('silent=1');
  await expectOutcome(page, 'no');
  await expect(at(page, 'zero-outcome')).toContainText('no reply came');
  encoder.set('silent=0');
  await expectLink(page, 'reading');
  await until(page, 'angle', (angle) => angle === 2 ** 22);
});
