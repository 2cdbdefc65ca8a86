// The reference: every format out of the same tables that the JavaScript module decodes with.
import { FORMATS, at, expect, test } from './page.js';

const ERRATA = 24;
const kebab = (name) => name.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);
const query = (profile) =>
  Object.entries(profile)
    .map(([name, value]) => `${kebab(name)}=${encodeURIComponent(value)}`)
    .join('&');

/** What the module says of the example frame that the page's first reply links to. */
const module = (page, profile, frame) =>
  page.evaluate(
    async ([profile, frame]) => {
      const scope = await import('./encoderscope.js');
      const decoded = scope.decode(profile, frame).frames[0];
      return {
        fields: scope.explain(profile, frame).map(({ name }) => name),
        check: decoded.crc ?? decoded.parity,
        ok: decoded.ok,
      };
    },
    [profile, frame],
  );

/** Opens the page of a format, and waits until it is there. */
const open = async (page, parameters) => {
  await page.goto(`/#/reference?${parameters}`);
  const format = new URLSearchParams(parameters).get('format');
  await expect(at(page, 'reference-format')).toHaveAttribute('data-format', format);
};

const formats = async (page) => {
  await page.goto('/');
  return page.evaluate(async () => (await import('./encoderscope.js')).formats());
};

/** The frame in a link to the explainer. */
const frameOf = async (link) => new URLSearchParams((await link.getAttribute('href')).split('?')[1]).get('frame');

const columns = (rows) =>
  rows.evaluateAll((all) => all.map((row) => ({ kind: row.dataset.kind, field: row.dataset.field })));

test('every format has the fields that the module explains, and its check worked out', async ({ page }) => {
  test.setTimeout(90_000);
  const all = await formats(page);
  expect(all.length).toBe(FORMATS.length);
  for (const { format, title, profile } of all) {
    await open(page, query({ ...profile, format }));
    const sheet = at(page, 'reference-format');
    await expect(sheet.locator('h1')).toHaveText(title);
    const rows = await columns(at(page, 'reference-row'));
    const frame = await frameOf(page.getByRole('link', { name: 'Take this frame apart' }));
    const said = await module(page, { ...profile, format }, frame);
    expect(said.ok, format).toBe(true);
    const main = rows.find(({ kind }) => !kind.startsWith('request')).kind;
    const mine = rows.filter(({ kind }) => kind === main).map(({ field }) => field);
    expect(mine, format).toEqual(said.fields);
    if (said.check) {
      const name = mine.includes('crc') ? 'crc' : 'parity';
      const check = page.locator(`[data-testid=reference-check][data-field=${name}]`).first();
      await expect(check).toHaveAttribute('data-value', String(said.check.expected));
      await expect(check).toHaveAttribute('data-received', String(said.check.received));
      await expect(check.locator('.outcome')).toContainText('= received');
    } else {
      await expect(at(page, 'reference-check')).toHaveCount(0);
    }
    // Every row has its doc, and every parameter of the module its line.
    await expect(at(page, 'reference-row').locator('td:nth-child(5):empty')).toHaveCount(0);
  }
});

test('every kind of frame is there, and its example is one', async ({ page }) => {
  const kinds = {
    'format=t485': ['request-all', 'all', 'request-angle', 'angle', 'request-turns', 'turns', 'request-reset-angle', 'reset-angle', 'request-reset-turns', 'reset-turns'],
    'format=rs485&command=t': ['request-t', 't', 'request-0', '0', 'request-1', '1', 'request-d', 'd', 'request-s', 's'],
    'format=bus': ['request-get', 'get', 'request-set-zero', 'set-zero', 'request-set-address', 'set-address'],
    'format=own&layout=rls-orbis-serial': ['request', 'reply'],
  };
  for (const [profile, expected] of Object.entries(kinds)) {
    await open(page, profile);
    await expect.poll(async () => [...new Set((await columns(at(page, 'reference-row'))).map(({ kind }) => kind))]).toEqual(expected);
  }
  // The link of a kind opens its frame in the explainer.
  await page.goto('/#/reference?format=rs485&command=d');
  const row = page.locator('[data-testid=reference-row][data-kind=s][data-field=speed]');
  await row.getByRole('link').last().click();
  await expect(page.locator('[data-testid=explain-field][data-field=speed]')).toHaveAttribute('data-value', '125');
});

test('a link to a field opens marked, and a click on a field is such a link', async ({ page }) => {
  await page.goto('/#/reference?format=t485&angle-bits=17&field=alarm');
  const marked = page.locator('[data-testid=reference-row].marked');
  await expect(marked).toHaveCount(1);
  await expect(marked).toHaveAttribute('data-field', 'alarm');
  await expect(marked).toHaveAttribute('aria-current', 'true');
  await expect(marked).toBeInViewport();
  await page
    .locator('[data-testid=reference-row][data-kind=turns][data-field=turns]')
    .getByRole('link', { name: 'turns', exact: true })
    .click();
  await expect(marked).toHaveAttribute('data-kind', 'turns');
  await expect(marked).toBeInViewport();
  await expect(page).toHaveURL(/angle-bits=17.*&frame-kind=turns&field=turns$/);
  await page.reload();
  await expect(marked).toHaveAttribute('data-kind', 'turns');
  await expect(marked).toBeInViewport();
  await page.goto('/#/reference?format=t485&field=nothing');
  await expect(at(page, 'reference-row').first()).toBeVisible();
  await expect(marked).toHaveCount(0);
});

test('all errata are reachable, each by a link of its own', async ({ page }) => {
  await page.goto('/#/reference');
  await at(page, 'reference-overview').getByRole('link', { name: `${ERRATA} places` }).click();
  const errata = at(page, 'erratum');
  await expect(errata).toHaveCount(ERRATA);
  const numbers = await errata.evaluateAll((all) => all.map((item) => Number(item.dataset.value)));
  expect(numbers).toEqual(Array.from({ length: ERRATA }, (_, index) => index + 1));
  await errata.nth(17).getByRole('link', { name: 'Erratum 18' }).click();
  await expect(page).toHaveURL(/page=errata&erratum=18$/);
  await page.reload();
  await expect(page.locator('[data-testid=erratum].marked')).toHaveAttribute('data-value', '18');
  await expect(page.locator('[data-testid=erratum].marked')).toBeInViewport();
  // Those of a format stand on its page too.
  await page.goto('/#/reference?format=biss-c&erratum=22');
  await expect(page.locator('[data-testid=erratum].marked')).toBeInViewport();
  await expect(errata).toHaveCount(6);
});

test('the overview leads to every format and to the layouts of other makers', async ({ page }) => {
  const all = await formats(page);
  await page.getByRole('link', { name: 'Reference' }).click();
  await expect(page.locator('h1')).toHaveText('Reference');
  const entries = at(page, 'reference-entry');
  const listed = await entries.evaluateAll((rows) => rows.map((row) => row.dataset.format));
  expect(listed.filter((format) => format !== 'own')).toEqual(all.map(({ format }) => format));
  expect(listed.filter((format) => format === 'own').length).toBeGreaterThan(10);
  await entries.getByRole('link', { name: 'IncOder SSI6' }).click();
  await expect(page.locator('h1')).toHaveText('IncOder SSI6');
  await expect(at(page, 'reference-format')).toContainText('IncOder product guide, SSI6');
  const names = (await columns(at(page, 'reference-row'))).map(({ field }) => field);
  expect(names).toEqual(['crc', 'valid', 'zero-default', 'angle']);
});

test('checks show their parameters and the whole table', async ({ page }) => {
  await open(page, 'format=rs485');
  const check = at(page, 'reference-check');
  await expect(check).toHaveCount(1);
  await expect(check).toContainText('0x97');
  await expect(check).toContainText('0x94');
  const table = at(page, 'reference-table');
  await table.locator('summary').click();
  const cells = await table.locator('tbody td').allTextContents();
  expect(cells.length).toBe(256);
  // One of those that are wrong in a manual.
  expect(cells[0xdc]).toBe('F1');
  await open(page, 'format=biss-c');
  const six = await at(page, 'reference-table').locator('tbody td').allTextContents();
  expect([six.length, ...six.slice(0, 4)]).toEqual([64, '00', '03', '06', '05']);
  await expect(at(page, 'reference-check').locator('.worked tbody tr')).toHaveCount(6);
});

test('requests, sequences, status bits and times are those of the tables', async ({ page }) => {
  await open(page, 'format=t485&dialect=mpp');
  const bytes = await at(page, 'reference-request').evaluateAll((rows) => rows.map((row) => Number(row.dataset.value)));
  expect(bytes).toEqual([0x02, 0x8a, 0x92, 0x1a, 0x32, 0xba, 0xc2, 0x62, 0xea]);
  await expect(page.locator('[data-testid=reference-request][data-value="194"]')).toContainText('yes');
  const titles = await at(page, 'reference-sequence').evaluateAll((all) => all.map((one) => one.dataset.value));
  expect(titles).toEqual(['reset angle', 'reset turns']);
  const low = page.locator('[data-testid=reference-status][data-name="battery low"]');
  await expect(low).toContainText('replace the battery');
  await expect(low).toContainText('blinks');
  await open(page, 'format=bus&angle-bits=24&turns-bits=16');
  await expect(page.locator('[data-testid=reference-time][data-name=suspend]')).toContainText('36 µs');
  const steps = page.locator('[data-testid=reference-sequence][data-value="set address"] tbody tr');
  await expect(steps).toHaveCount(12);
  await open(page, 'format=ssi');
  const clock = page.locator('[data-testid=reference-time][data-name=clock]');
  await expect(clock).toContainText('110 kHz…1.5 MHz, up to 10 MHz');
  await expect(clock).toContainText('MPP and PT, SSI timing');
});

test('printed, there is no navigation and no table is cut off', async ({ page }) => {
  await open(page, 'format=t485');
  await expect(at(page, 'reference-row').first()).toBeVisible();
  await page.emulateMedia({ media: 'print' });
  await expect(page.getByRole('navigation')).toHaveCount(0);
  await expect(page.locator('nav')).toBeHidden();
  await expect(page.locator('h1')).toBeVisible();
  const boxes = await page.locator('.wide').evaluateAll((all) => all.map((box) => getComputedStyle(box).overflowX));
  expect(boxes.length).toBeGreaterThan(10);
  expect(new Set(boxes)).toEqual(new Set(['visible']));
});

for (const width of [390, 768]) {
  test(`at ${width} pixels only tables scroll sideways`, async ({ page }) => {
    await page.setViewportSize({ width, height: 844 });
    const all = await formats(page);
    const places = all.map(({ format, profile }) => `#/reference?${query({ ...profile, format })}`);
    for (const place of ['#/reference', '#/reference?page=errata', ...places]) {
      await page.goto(`/${place}`);
      await expect(page.locator('.sheet h1')).toBeVisible();
      const over = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
      expect(over, place).toBeLessThanOrEqual(0);
    }
  });
}

test('the reference needs no mouse, and its tables name their rows and columns', async ({ page }) => {
  await open(page, 'format=biss-c');
  await expect(at(page, 'reference-row').first()).toBeVisible();
  const nameless = await page.locator('.sheet table').evaluateAll((tables) =>
    tables.filter((table) => !table.caption?.textContent || [...table.querySelectorAll('th')].some((head) => !head.scope)).length,
  );
  expect(nameless).toBe(0);
  const link = page.locator('[data-testid=reference-row][data-field=nError]').getByRole('link').first();
  await link.focus();
  await page.keyboard.press('Enter');
  await expect(page.locator('[data-testid=reference-row].marked')).toHaveAttribute('data-field', 'nError');
});

test('a profile that is changed there changes the page', async ({ page }) => {
  await page.goto('/#/reference?format=biss-c&angle-bits=17');
  await expect(at(page, 'reference-row').filter({ hasText: 'Angle within one turn' })).toContainText('17');
  await page.locator('input[name=angle-bits]').fill('20');
  await page.locator('input[name=angle-bits]').press('Enter');
  await expect(at(page, 'reference-row').filter({ hasText: 'Angle within one turn' })).toContainText('20');
  await expect(page).toHaveURL(/reference\?.*angle-bits=20/);
});
