// The raw log, bytes by hand, the live view's figures, the demo's knobs.
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
  await expectLink(page, 'reading');
};

const rows = (page) =>
  at(page, 'frame-row').evaluateAll((rows) =>
    rows.map((row) => ({
      direction: row.dataset.direction,
      ok: row.dataset.ok,
      bytes: [...row.querySelectorAll('.byte')].map((byte) => byte.textContent).join(' '),
      text: row.lastElementChild.textContent,
    })),
  );

const filter = (page, name) => at(page, 'log-filter').and(page.locator(`[data-value=${name}]`));

test('the log shows both directions, filters, and explains a frame @serial', async ({ page }) => {
  await plug(page, 'format=t485&angle-bits=23', 'still=0.5');
  await until(page, 'frames-ok', (frames) => frames > 50);
  const all = await rows(page);
  expect(new Set(all.map((row) => row.direction))).toEqual(new Set(['sent', 'received']));
  for (const row of all) {
    expect(row.bytes.startsWith('1A')).toBe(true);
    expect(row.ok).toBe(row.direction === 'sent' ? undefined : 'true');
  }
  await filter(page, 'sent').click();
  const only = (holds) => async () => {
    const shown = await rows(page);
    return shown.length > 0 && shown.every(holds);
  };
  await expect.poll(only((row) => row.bytes === '1A')).toBe(true);
  await filter(page, 'faults').click();
  await expect.poll(async () => (await rows(page)).every((row) => row.ok === 'false')).toBe(true);
  // A reply that a busy machine delivers late is a fault as well.
  const late = (await rows(page)).length;
  encoder.set('flip=100');
  await expect.poll(async () => (await rows(page)).length).toBeGreaterThan(Math.min(late + 2, 13));
  encoder.set('flip=0');
  for (const row of await rows(page)) expect(row.ok).toBe('false');
  await filter(page, 'received').click();
  await expect.poll(only((row) => row.direction === 'received')).toBe(true);
  await at(page, 'frame-row').first().click();
  const before = await rows(page);
  await expect(at(page, 'inspect').getByTestId('explain-field').first()).toBeVisible();
  expect(await rows(page)).toEqual(before);
  await page.getByText('Open in the decoder').click();
  await expect(at(page, 'dump-row')).toHaveCount(1);
  await expect(at(page, 'dump-row')).toHaveAttribute('data-angle', /\d/);
});

test('bytes by hand are sent, marked, and answered @serial', async ({ page }) => {
  await plug(page, 'format=t485&angle-bits=23', 'still=5.25');
  const hand = page.locator('input[name=by-hand]');
  await hand.fill('8a');
  await at(page, 'send').click();
  await expect
    .poll(() => rows(page))
    .toEqual([
      { direction: 'received', ok: 'true', bytes: '8A 00 05 00 00 8F', text: '✓' },
      { direction: 'sent', ok: undefined, bytes: '8A', text: 'by hand' },
    ]);
  await until(page, 'bytes-set', (bytes) => bytes >= 6);
  await expectLink(page, 'reading');
  await hand.fill('zz');
  await at(page, 'send').click();
  await expect(page.getByRole('alert')).toContainText('zz');
});

test('a byte that changes an encoder asks first @serial', async ({ page }) => {
  await plug(page, 'format=t485&angle-bits=23', 'still=5.25');
  const hand = page.locator('input[name=by-hand]');
  for (const byte of ['30', 'c2', '62', 'ba', '32 00 00 32']) {
    await hand.fill(byte);
    await at(page, 'send').click();
    await expect(at(page, 'danger')).toBeVisible();
    await page.getByText('Do not send').click();
    await expect(at(page, 'danger')).toHaveCount(0);
  }
  await hand.fill('c2');
  for (let time = 0; time < 10; time += 1) {
    await at(page, 'send').click();
    await at(page, 'send-anyway').click();
    await until(page, 'bytes-set', (bytes) => bytes >= 6 * (time + 1));
  }
  await expectLink(page, 'reading');
  // Polls stood between them, so that the encoder has not acted.
  await until(page, 'angle', (angle) => angle === 2 ** 21);
});

test('no link sends anything by hand', async ({ page }) => {
  await page.goto('/#/console?format=rs485&command=0&by-hand=30&send=30');
  await at(page, 'demo').click();
  await expectLink(page, 'reading');
  await filter(page, 'sent').click();
  await expect(at(page, 'frame-row').first()).toBeVisible();
  for (const row of await rows(page)) expect(row.bytes).toBe('64');
});

test('speed from the angle, arc-seconds, error rate, and the pace of asking @serial', async ({ page }) => {
  await plug(page, 'format=rs485&angle-bits=24&command=d', 'turning=1.5');
  await until(page, 'turning', (speed) => Math.abs(speed - 1.5) < 0.1);
  // The first requests may have met an encoder that was still coming up.
  await until(page, 'error-rate', (rate) => rate < 0.05);
  await page.locator('select[name=pace]').selectOption('10');
  await until(page, 'rate', (rate) => rate >= 5 && rate <= 12);
  encoder.set('still=0.25');
  await until(page, 'arc-seconds', (seconds) => seconds === 324_000);
  await until(page, 'turning', (speed) => speed === 0);
});

test('status lamps, their remedies and the blinking LED', async ({ page }) => {
  await page.goto('/#/console?format=rs485');
  await at(page, 'demo').click();
  await expectLink(page, 'reading');
  await page.getByText('Demo status and faults').click();
  await page.locator('input[name="demo-battery low"]').check();
  await page.locator('input[name=demo-warning]').check();
  const lit = at(page, 'status').locator('[data-now=true]');
  await expect(lit).toHaveCount(1);
  await expect(lit).toContainText('replace the battery');
  await expect(at(page, 'led')).toContainText('yellow');
  await expect(at(page, 'led')).toContainText('blinking');
  await page.locator('input[name="demo-battery low"]').uncheck();
  await expect(lit).toHaveCount(0);
  await expect(at(page, 'led')).not.toContainText('blinking');
  // Ever seen.
  await expect(at(page, 'status')).toContainText('replace the battery');
  await page.locator('input[name=demo-silent]').check();
  await expectLink(page, 'silent');
  await page.locator('input[name=demo-silent]').uncheck();
  await expectLink(page, 'reading');
  await page.locator('input[name=demo-flip]').fill('100');
  await until(page, 'frames-bad', (bad) => bad > 10);
  await until(page, 'error-rate', (rate) => rate > 0.2);
});

test('the dial follows every picture, figures and log a few times a second', async ({ page }) => {
  await page.goto('/#/console?format=t485&angle-bits=23');
  await at(page, 'demo').click();
  await expectLink(page, 'reading');
  await filter(page, 'received').click();
  await until(page, 'frames-ok', (frames) => frames > 500);
  const { angles, counts, stays } = await page.evaluate(async () => {
    const value = (id) => document.querySelector(`[data-testid=${id}]`).dataset.value;
    const row = document.querySelector('[data-testid=frame-row]');
    const [angles, counts] = [new Set(), new Set()];
    for (const end = performance.now() + 3_000; performance.now() < end; ) {
      await new Promise(requestAnimationFrame);
      angles.add(value('angle'));
      counts.add(value('frames-ok'));
    }
    return { angles: angles.size, counts: counts.size, stays: row.isConnected };
  });
  expect(counts).toBeGreaterThan(3);
  expect(counts).toBeLessThan(19);
  expect(angles).toBeGreaterThan(2 * counts);
  // What is in the rows changes, not the rows.
  expect(stays).toBe(true);
});
