// The zero of an IP-75, which is set by its wires: the demo, and over real Web Serial.
import { at, expect, expectLink, number, test, until } from './page.js';
import { Encoder } from './encoder.js';

let encoder;
test.afterEach(async () => {
  await encoder?.unplug();
  encoder = undefined;
});

const expectSteps = (page, ...states) =>
  expect
    .poll(() => at(page, 'wire-step').evaluateAll((steps) => steps.map((step) => step.dataset.state)), {
      timeout: 12_000,
    })
    .toEqual(states);

const expectOutcome = (page, made) =>
  expect(at(page, 'zero-outcome')).toHaveAttribute('data-value', made, { timeout: 12_000 });

/** Goes through the checklist; `power` switches the supply. */
const follow = async (page, door, off, on) => {
  await at(page, door).click();
  await expectSteps(page, 'now', 'later', 'later', 'later');
  await off();
  await expectSteps(page, 'done', 'now', 'now', 'later');
  await expectLink(page, 'silent');
  await on();
  await expectSteps(page, 'done', 'done', 'now', 'later');
  await until(page, 'wire-hold', (seconds) => seconds >= 1);
};

test('the demo is zeroed by wire, and gets the zero of the factory back', async ({ page }) => {
  await page.goto('/#/console?format=asi1');
  await at(page, 'demo').click();
  await expectLink(page, 'reading');
  await at(page, 'demo-hold').click();
  await expect(at(page, 'zero-default')).toHaveAttribute('data-value', '1');
  await follow(
    page,
    'wire-set',
    () => at(page, 'demo-power-off').click(),
    () => at(page, 'demo-power-set').click(),
  );
  await expectOutcome(page, 'yes');
  await expectSteps(page, 'done', 'done', 'done', 'done');
  await expect(at(page, 'zero-default')).toHaveAttribute('data-value', '0');
  await until(page, 'angle', (angle) => angle === 0);
  await page.getByRole('button', { name: 'Done' }).click();
  await follow(
    page,
    'wire-reset',
    () => at(page, 'demo-power-off').click(),
    () => at(page, 'demo-power-reset').click(),
  );
  await expectOutcome(page, 'yes');
  await expect(at(page, 'zero-default')).toHaveAttribute('data-value', '1');
  expect(await number(page, 'frames-bad')).toBe(0);
});

test('a wire that was not at 0 V is told', async ({ page }) => {
  await page.goto('/#/console?format=asi1');
  await at(page, 'demo').click();
  await expectLink(page, 'reading');
  await follow(
    page,
    'wire-set',
    () => at(page, 'demo-power-off').click(),
    () => at(page, 'demo-power-on').click(),
  );
  await expectOutcome(page, 'no');
  await expectSteps(page, 'done', 'done', 'done', 'not seen');
  await expect(at(page, 'zero-outcome')).toContainText('was not at 0 V');
});

test('encoders without the wires have no such checklist', async ({ page }) => {
  await page.goto('/#/console?format=t485');
  await at(page, 'demo').click();
  await expectLink(page, 'reading');
  await expect(page.getByText('Zero by wire')).toHaveCount(0);
  await page.goto('/#/console?format=asi4');
  await expect(page.getByText('Zero by wire')).toBeVisible();
  await expect(page.getByText('Set the encoder')).toHaveCount(0);
});

for (const format of ['asi1', 'asi4']) {
  test(`${format} is zeroed by wire, and the supply that goes off too early is seen @serial`, async ({ page }) => {
    encoder = await Encoder.start('--format', format, 'still=5.25');
    await page.goto(`/#/console?format=${format}`);
    await at(page, 'connect').click();
    await until(page, 'angle', (angle) => angle === 2 ** 12);
    const says = format === 'asi1' ? '1' : null;
    if (says) await expect(at(page, 'zero-default')).toHaveAttribute('data-value', says);
    else await expect(at(page, 'zero-default')).not.toHaveAttribute('data-value', /./);
    const off = () => encoder.set('power=off');
    await follow(page, 'wire-set', off, () => encoder.set('power=set'));
    off();
    await expectSteps(page, 'done', 'now', 'now', 'later');
    encoder.set('power=set');
    await expectOutcome(page, 'yes');
    await until(page, 'angle', (angle) => angle === 0);
    await page.getByRole('button', { name: 'Done' }).click();
    await follow(page, 'wire-reset', off, () => encoder.set('power=reset'));
    await expectOutcome(page, 'yes');
    await until(page, 'angle', (angle) => angle === 2 ** 12);
  });
}
