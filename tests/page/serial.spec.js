// Real Web Serial in real Chromium, against the emulated encoder.
import {
  at,
  connect,
  disconnect,
  expect,
  expectAllAccounted,
  expectLink,
  expectOnlyLateBytes,
  expectOnlyLateFrames,
  number,
  test,
  until,
} from './page.js';
import { blockPort, Encoder, options } from './encoder.js';

let encoder;
const plug = async (...words) => {
  encoder = await Encoder.start(...words);
};
test.afterEach(async () => {
  await encoder?.unplug();
  encoder = undefined;
});

for (const [name, query] of [
  ['T485', 'format=t485&angle-bits=23&baud=2500000'],
  ['RS485', 'format=rs485&angle-bits=24&command=d&baud=2500000'],
]) {
  test(`${name} is read through the worker, the angle moves, unplugging is said @serial`, async ({ page }) => {
    const words = options(query);
    await plug(...words, 'turning=0.2');
    await connect(page, query);
    await expectLink(page, 'reading');
    const first = await number(page, 'angle');
    await until(page, 'angle', (angle) => Math.abs(angle - first) > 100_000);
    await until(page, 'frames-ok', (frames) => frames > 300);
    await until(page, 'rate', (rate) => rate > 100);
    await expectOnlyLateFrames(page);
    await expectOnlyLateBytes(page);

    expect(page.workers()).toHaveLength(1);
    const held = await page.workers()[0].evaluate(async () => {
      const [port] = await navigator.serial.getPorts();
      return port.readable !== null && port.readable.locked;
    });
    expect(held).toBe(true);

    await encoder.unplug();
    await expectLink(page, 'lost');
    await expect(at(page, 'link-state')).toContainText('unplugged');
    await expect(at(page, 'connect')).toHaveText('Reconnect');

    // The browser says that it is back, and nobody needs to ask again.
    await plug(...words, 'still=0.25');
    await page.evaluate(() => navigator.serial.dispatchEvent(new Event('connect')));
    await expectLink(page, 'reading');
    await until(page, 'angle', (angle) => angle === 2 ** (name === 'T485' ? 21 : 22));
  });
}

for (const [name, query, angle] of [
  ['PERIOD', 'format=period&angle-bits=24&baud=2500000', 2 ** 22],
  ['ASI1', 'format=asi1&angle-bits=14&baud=230400', 2 ** 12],
  ['ASI4', 'format=asi4&angle-bits=14&baud=230400', 2 ** 12],
]) {
  test(`${name} is joined while it streams @serial`, async ({ page }) => {
    const words = options(query);
    await plug(...words, 'turning=0.2');
    await connect(page, query);
    await expectLink(page, 'reading');
    const first = await number(page, 'angle');
    await until(page, 'angle', (angle) => angle !== first);
    await until(page, 'rate', (rate) => rate > 200);
    encoder.set('still=3.25');
    await until(page, 'angle', (now) => now === angle);
    encoder.set('silent=1');
    await expectLink(page, 'silent');
    encoder.set('silent=0');
    await expectLink(page, 'reading');
    await disconnect(page);
    await expectAllAccounted(page);
    await encoder.unplug();
  });
}

test('an adapter keeps its name and the encoder behind it @serial', async ({ page }) => {
  await plug('--format', 'rs485', '--command', 's', 'still=0.5');
  await connect(page, 'format=rs485&command=s');
  await expectLink(page, 'reading');
  await page.locator('input[name=port-name]').fill('Bench adapter');
  await page.locator('input[name=port-name]').blur();
  await expect(at(page, 'port')).toContainText('Bench adapter');
  await page.goto('about:blank');
  await page.goto('/');
  await expect(at(page, 'profile')).toContainText('RS485');
  await expect(page).toHaveURL(/command=s/);
  await at(page, 'connect').click();
  await expectLink(page, 'reading');
  await expect(page.getByText('Bench adapter').first()).toBeVisible();
});

test('a BUS device is read at its own address @serial', async ({ page }) => {
  await plug('--format', 'bus', '--address', '5', 'still=7.5', 'status=4');
  await connect(page, 'format=bus&address=5');
  await expectLink(page, 'reading');
  await until(page, 'angle', (angle) => angle === 2 ** 23);
  expect(await number(page, 'turns')).toBe(7);
  await expect(at(page, 'status').locator('[data-now=true]')).toContainText('field too weak');
  await page.goto('/#/console?format=bus&address=6');
  await at(page, 'connect').click();
  await expectLink(page, 'silent');
});

test('the angle, the turns and the status are those of the encoder @serial', async ({ page }) => {
  await plug('--format', 't485', '--angle-bits', '17', 'still=7.5', 'status=16');
  await connect(page, 'format=t485&angle-bits=17');
  await until(page, 'angle', (angle) => angle === 65_536);
  await expect(at(page, 'angle')).toContainText('180.000');
  expect(await number(page, 'turns')).toBe(7);
  const lit = at(page, 'status').locator('[data-now=true]');
  await expect(lit).toHaveCount(1);
  await expect(lit).toContainText('battery low');
  expect(await number(page, 'status')).toBe(0);
  encoder.set('error=1');
  await until(page, 'status', (status) => status === 0x20);
  await expect(lit).toHaveCount(2);
  await expect(at(page, 'status')).toContainText('red');
});

test('an echoing adapter is read and named @serial', async ({ page }) => {
  await plug('--format', 't485', 'still=0.5', 'echo=1');
  await connect(page, 'format=t485');
  await expectLink(page, 'reading');
  await until(page, 'angle', (angle) => angle === 2 ** 22);
  await expect(page.getByText('the adapter echoes requests')).toBeVisible();
  await expectOnlyLateFrames(page);
  await disconnect(page);
  await expectAllAccounted(page);
});

test('noise is counted, and no wrong angle is shown as good @serial', async ({ page }) => {
  await plug('--format', 't485', 'still=0.5', 'flip=15', 'drop=15', 'insert=15');
  await connect(page, 'format=t485');
  await until(page, 'frames-bad', (bad) => bad >= 15);
  await until(page, 'bytes-skipped', (bytes) => bytes > 15);
  await until(page, 'frames-ok', (good) => good > 5);
  expect(await number(page, 'angle')).toBe(2 ** 22);
  const verdicts = await at(page, 'frame-row').evaluateAll((rows) =>
    rows.map((row) => [row.dataset.ok === 'true', row.lastElementChild.textContent.includes('✓')]),
  );
  expect(verdicts.length).toBeGreaterThan(0);
  for (const [ok, ticked] of verdicts) expect(ticked).toBe(ok);
  await disconnect(page);
  await expectAllAccounted(page);
});

test('silence, an echo alone and a wrong profile have names and remedies @serial', async ({ page }) => {
  await plug('--format', 't485', 'silent=1');
  await connect(page, 'format=t485');
  await expectLink(page, 'silent');
  await expect(at(page, 'link-state')).toContainText('supply');
  encoder.set('echo=1');
  await expectLink(page, 'echo-only');
  encoder.set('silent=0');
  await expectLink(page, 'reading');
  // A T485 encoder answers an unknown operation, but not with what RS485 expects.
  await page.goto('/#/console?format=rs485&turns-bits=0&command=1');
  await at(page, 'connect').click();
  await expectLink(page, 'garbage');
  await expect(at(page, 'link-state')).toContainText('order code');
});

test('a wrong width is not read as a wrong angle @serial', async ({ page }) => {
  await plug('--format', 't485', '--angle-bits', '23', 'still=0.9');
  await connect(page, 'format=t485&angle-bits=17');
  await expectLink(page, 'other-profile');
  await expect(at(page, 'angle')).not.toHaveAttribute('data-value', /./);
  expect(await number(page, 'frames-ok')).toBe(0);
  await expect(at(page, 'suggestion')).toHaveAttribute('data-value', /angle-bits=23/);
  await at(page, 'suggestion').getByRole('button').click();
  await expectLink(page, 'reading');
  await expect(page).toHaveURL(/angle-bits=23/);
});

test('a port that cannot be opened says so, and the demo is one click away @serial', async ({ page }) => {
  const unblock = blockPort();
  await connect(page, 'format=t485');
  await expectLink(page, 'refused');
  await expect(at(page, 'link-state')).toContainText('other programs');
  await at(page, 'demo').click();
  await expectLink(page, 'reading');
  unblock();
  await plug('--format', 't485', 'still=0.5');
  await at(page, 'connect').click();
  await expectLink(page, 'reading');
  await until(page, 'angle', (angle) => angle === 2 ** 22);
});

test('nothing that changes the encoder is ever sent @serial', async ({ page }) => {
  await plug('--format', 't485', 'still=3.25');
  await connect(page, 'format=t485');
  await until(page, 'frames-ok', (frames) => frames > 500);
  await at(page, 'disconnect').click();
  await expectLink(page, 'closed');
  await at(page, 'connect').click();
  await until(page, 'angle', (angle) => angle === 2 ** 21);
  expect(await number(page, 'turns')).toBe(3);
});
