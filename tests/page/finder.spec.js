// Find it for me, and the doctor's ladder.
import { at, expect, expectLink, number, test, until } from './page.js';
import { Encoder, options } from './encoder.js';
import { count, script } from './scripted.js';

let encoder;
test.afterEach(async () => {
  await encoder?.unplug();
  encoder = undefined;
});

/** The parameters of the best candidate. */
const best = async (page) => {
  await expect(at(page, 'search')).toHaveAttribute('data-done', 'true', { timeout: 20_000 });
  const found = at(page, 'found').first();
  return {
    found,
    profile: new URLSearchParams(await found.getAttribute('data-value')),
    verdict: await found.getAttribute('data-verdict'),
  };
};

for (const query of [
  'format=t485&angle-bits=23&baud=2500000',
  'format=t485&angle-bits=17&baud=2500000',
  'format=rs485&angle-bits=24&turns-bits=16&baud=2500000',
  'format=rs485&angle-bits=16&turns-bits=0&baud=115200',
  'format=bus&angle-bits=24&turns-bits=16&address=9&baud=2500000',
  'format=period&angle-bits=24&turns-bits=16&baud=2500000',
  'format=period&angle-bits=24&turns-bits=0&baud=115200',
  'format=asi1&angle-bits=14&baud=230400',
  'format=asi4&angle-bits=14&baud=230400',
]) {
  test(`${query} is found and read @serial`, async ({ page }) => {
    encoder = await Encoder.start(...options(query), 'turning=2');
    // Nothing is known of the encoder.
    await page.goto('/#/console?format=t485&angle-bits=20');
    await at(page, 'find').click();
    // A stream may be found before anyone sees the search.
    const { found, profile, verdict } = await best(page);
    for (const [name, value] of new URLSearchParams(query)) {
      expect(profile.get(name), name).toBe(value);
    }
    expect(['certain', 'likely']).toContain(verdict);
    await found.getByTestId('read-found').click();
    await expectLink(page, 'reading');
    const first = await number(page, 'angle');
    await until(page, 'angle', (angle) => angle !== first);
  });
}

test('what a still shaft leaves open is said, and can be chosen @serial', async ({ page }) => {
  encoder = await Encoder.start(...options('format=rs485&angle-bits=20'), 'still=1.25');
  await page.goto('/');
  await at(page, 'find').click();
  const { found, profile } = await best(page);
  expect(profile.get('format')).toBe('rs485');
  await expect(found).toContainText('order code');
  await found.locator('select').selectOption('20');
  await found.getByTestId('read-found').click();
  await expectLink(page, 'reading');
  await until(page, 'angle', (angle) => angle === 2 ** 18);
  await expect(page).toHaveURL(/angle-bits=20/);
});

test('a search that finds nothing says what was tried, and can be broken off @serial', async ({ page }) => {
  encoder = await Encoder.start('--format', 't485', 'silent=1');
  await page.goto('/');
  await at(page, 'find').click();
  await expectLink(page, 'searching');
  await at(page, 'disconnect').click();
  await expectLink(page, 'closed');
  await expect(at(page, 'search')).toHaveAttribute('data-done', 'true');
  await at(page, 'find').click();
  await expect(at(page, 'search')).toHaveAttribute('data-done', 'true', { timeout: 20_000 });
  await expect(at(page, 'found')).toHaveCount(0);
  await expect(at(page, 'search')).toContainText('Nothing was found');
  await page.getByText('What was tried').click();
  for (const text of ['115 200 baud · listened · silent', 'BUS, asked 32 ×', '230 400 baud']) {
    await expect(at(page, 'search')).toContainText(text.replaceAll(/(\d) (\d)/g, '$1\u2009$2'));
  }
  await expectLink(page, 'closed');
  encoder.set('silent=0');
  await at(page, 'connect').click();
  await expectLink(page, 'reading');
});

test('the plug pulled in the middle of a search ends in a named state @serial', async ({ page }) => {
  encoder = await Encoder.start('--format', 't485', 'silent=1');
  await page.goto('/');
  await at(page, 'find').click();
  await expect(at(page, 'search')).toContainText('asked');
  await encoder.unplug();
  await expectLink(page, 'lost');
  await expect(at(page, 'search')).toHaveAttribute('data-done', 'true');
});

test('the demo encoder is found too', async ({ page }) => {
  await page.goto('/#/console?format=bus&angle-bits=24&address=5');
  await at(page, 'demo').click();
  await expectLink(page, 'reading');
  await at(page, 'find').click();
  const { found, profile } = await best(page);
  expect(profile.get('format')).toBe('bus');
  expect(profile.get('address')).toBe('5');
  await found.getByTestId('read-found').click();
  await expectLink(page, 'reading');
});

/** The tones of the ladder, from the bottom up. */
const ladder = (page) => at(page, 'rung').evaluateAll((rungs) => rungs.map((rung) => rung.dataset.value));

test('the ladder shows how far a link has come @serial', async ({ page }) => {
  encoder = await Encoder.start('--format', 't485', 'still=0.5', 'silent=1');
  await page.goto('/#/console?format=t485');
  await at(page, 'connect').click();
  await expectLink(page, 'silent');
  expect(await ladder(page)).toEqual(['good', 'bad', 'idle', 'idle', 'idle']);
  await expect(at(page, 'link-help')).toHaveAttribute('href', '#/reference?page=wiring&series=mpp&interface=t485');
  encoder.set('silent=0');
  await expectLink(page, 'reading');
  await expect(at(page, 'link-help')).toHaveCount(0);
  await expect.poll(() => ladder(page)).toEqual(['good', 'good', 'good', 'good', 'good']);
  await expect(at(page, 'rung').nth(0)).toContainText('2\u2009500\u2009000 baud');
  await expect(at(page, 'rung').nth(1)).toContainText('ms');
  encoder.set('flip=900');
  await expectLink(page, 'failing');
  expect((await ladder(page))[3]).toBe('bad');
  await expect(at(page, 'error-rate')).toContainText('%');
  await until(page, 'error-rate', (rate) => rate > 0.5);
});

test('a wrong baud rate is garbage, and the bytes a second say why @serial', async ({ page }) => {
  encoder = await Encoder.start('--format', 'asi1', 'turning=0.3');
  await page.goto('/#/console?format=asi1&baud=115200');
  await at(page, 'connect').click();
  await expectLink(page, 'garbage');
  await expect(at(page, 'rung').nth(2)).toContainText('another baud rate');
});

test('a free-running encoder is named while another is asked @serial', async ({ page }) => {
  encoder = await Encoder.start('--format', 'period', 'turning=0.3');
  await page.goto('/#/console?format=t485');
  await at(page, 'connect').click();
  await expectLink(page, 'unasked');
  await expect(at(page, 'suggestion')).toHaveAttribute('data-value', /format=period/);
  await at(page, 'suggestion').getByRole('button').click();
  await expectLink(page, 'reading');
});

test('an adapter that cannot make the rate is named, and nothing is sent through it', async ({ page }) => {
  await script(page, { vendor: 0x0403, product: 0x6001 });
  await page.goto('/#/console?format=t485');
  await at(page, 'connect').click();
  await expectLink(page, 'rate-not-made');
  await expect(page.getByRole('alert')).toContainText('3\u2009000\u2009000');
  await expect(at(page, 'link-help')).toHaveAttribute('href', '#/reference?page=adapters&rate=2500000');
  expect(await count(page, 'opened')).toBe(0);
  await at(page, 'find').click();
  await expect(at(page, 'search')).toHaveAttribute('data-done', 'true', { timeout: 20_000 });
  await page.getByText('What was tried').click();
  await expect(at(page, 'search')).toContainText('left out: this adapter does not make it');
  await at(page, 'connect').click();
  await expectLink(page, 'rate-not-made');
  await at(page, 'all-the-same').click();
  await expectLink(page, 'reading');
  await expect(at(page, 'rung').first()).toHaveAttribute('data-value', 'warn');
  await expect(at(page, 'rung').first()).toContainText('does not make');
});

test('a search that is broken off while the port opens says so', async ({ page }) => {
  await script(page, { vendor: 0x0403, product: 0x6014, opening: 'never' });
  await page.goto('/');
  await at(page, 'find').click();
  await expectLink(page, 'searching');
  await at(page, 'disconnect').click();
  await expectLink(page, 'closed');
  await expect(at(page, 'search')).toHaveAttribute('data-done', 'true');
  await expect(at(page, 'search')).toContainText('broken off');
});

test('another port that is chosen while one is read is read instead', async ({ page }) => {
  await script(page, { vendor: 0x0403, product: 0x6014 }, { vendor: 0x1a86, product: 0x55d3 });
  await page.goto('/#/console?format=t485');
  await at(page, 'connect').click();
  await expectLink(page, 'reading');
  const writes = await count(page, 'writes', 0);
  expect(writes).toBeGreaterThan(0);
  await at(page, 'port').selectOption({ label: 'CH343' });
  await expect.poll(() => count(page, 'opened', 1)).toBe(1);
  await expect.poll(() => count(page, 'writes', 1)).toBeGreaterThan(2);
  const before = await count(page, 'writes', 0);
  await expectLink(page, 'reading');
  expect(await count(page, 'writes', 0)).toBe(before);
});
