// The parts of the page whose code comes when they are first wanted.
import { at, bare, expect, expectLink, test, until } from './page.js';

const part = (name) => `**/split_${name}-*.wasm`;
const frame = 'format=t485&direction=received&frame=1a2029c03b17000000c837';

/** Names of the parts that are fetched from now on. */
const fetched = (page) => {
  const names = [];
  page.on('request', (request) => {
    const found = /(split_\w+|plot)-[\w-]+\.(wasm|js)$/.exec(request.url());
    if (found) names.push(found[1].replace('split_', ''));
  });
  return names;
};

test('the first view fetches no other part, and each part comes when it is opened', async ({ page }) => {
  const names = fetched(page);
  await page.goto('/');
  await until(page, 'angle', (angle) => angle > 0);
  expect(names).toEqual([]);
  await page.getByText('Encoder settings').click();
  await expect(page.getByLabel('Angle bits')).toBeVisible();
  expect(names).toEqual(['live']);
  await at(page, 'demo').click();
  await expectLink(page, 'reading');
  await expect(at(page, 'chart-angle').locator('canvas')).toBeVisible();
  for (const area of ['Decode', 'Explain', 'Reference']) {
    await page.getByRole('link', { name: area, exact: true }).click();
    await expect(page.locator(`main .${area.toLowerCase()}`)).toBeVisible();
  }
  expect(names).toEqual(['live', 'plot', 'decode', 'explain', 'reference']);
});

test('a link is kept while the code that reads it is on its way', async ({ page }) => {
  await page.route(part('explain'), async (route) => {
    await new Promise((resolve) => setTimeout(resolve, 1_500));
    await route.continue();
  });
  await page.goto(`/#/explain?${frame}`);
  await expect(page.locator('main .coming')).toBeVisible();
  expect(page.url()).toContain(frame);
  await expect(at(page, 'explain-frame')).toHaveValue('1A2029C03B17000000C837');
  expect(page.url()).toContain('frame=');
});

test('a link is followed though the address is written before the browser says so', async ({ page }) => {
  await page.goto(`/#/explain?${frame}`);
  await expect(at(page, 'explain-frame')).toHaveValue('1A2029C03B17000000C837');
  await page.evaluate(() => {
    const before = location.hash;
    location.hash = '#/reference?page=order-code';
    history.replaceState(null, '', before);
  });
  await expect(at(page, 'reference-topic')).toHaveAttribute('data-name', 'order-code');
  expect(page.url()).toContain('#/reference?page=order-code');
});

test('the console waits with its doors until the profile of the link is read', async ({ page }) => {
  await page.route(part('live'), async (route) => {
    await new Promise((resolve) => setTimeout(resolve, 1_000));
    await route.continue();
  });
  await page.goto('/#/console?format=bus&address=9');
  await expect(at(page, 'demo')).toBeDisabled();
  expect(page.url()).toContain('address=9');
  await at(page, 'demo').click();
  await expectLink(page, 'reading');
  await expect(at(page, 'profile')).toHaveAttribute('data-value', /address=9/);
});

// The browser reports the failed request, which is what is tried here.
bare('a part that cannot be fetched says so, and comes when it can be', async ({ page }) => {
  await page.route(part('explain'), (route) => route.abort());
  await page.goto(`/#/explain?${frame}`);
  await expect(at(page, 'part-missing')).toBeVisible();
  expect(page.url()).toContain(frame);
  // The rest of the page works meanwhile.
  await page.getByRole('link', { name: 'Reference', exact: true }).click();
  await expect(page.locator('main .reference')).toBeVisible();
  await page.getByRole('link', { name: 'Explain', exact: true }).click();
  await expect(at(page, 'part-missing')).toBeVisible();
  await page.unroute(part('explain'));
  await at(page, 'part-missing').getByRole('button').click();
  await expect(at(page, 'explain-bit').first()).toBeVisible();
});
