// The console without a port: first view, demo, and browsers that have no Web Serial.
import { at, expect, expectLink, number, test, until } from './page.js';

const expectDemo = async (page) => {
  await at(page, 'demo').click();
  await expectLink(page, 'reading');
  const first = await number(page, 'angle');
  await until(page, 'angle', (angle) => Math.abs(angle - first) > 100);
  await until(page, 'frames-ok', (frames) => frames > 500);
  expect(await number(page, 'frames-bad')).toBe(0);
};

const expectDecoder = async (page) => {
  await page.goto('/#/decode?format=t485');
  await at(page, 'dump-input').fill('02 20 b4 bd 1c 37');
  await expect(at(page, 'dump-row')).toHaveAttribute('data-angle', '1883572');
};

test('the first view has three doors, and the demo turns behind them', async ({ page }) => {
  await page.goto('/');
  for (const door of ['Connect an encoder', 'Try the demo', 'Paste a dump']) {
    await expect(page.getByText(door, { exact: true })).toBeVisible();
  }
  const first = await number(page, 'angle');
  await until(page, 'angle', (angle) => angle !== first && angle > 0);
  await expectDemo(page);
});

test('the demo speaks RS485 too, and goes on with another profile', async ({ page }) => {
  await page.goto('/#/console?format=rs485&command=s');
  await expectDemo(page);
  await expect(at(page, 'speed')).toBeVisible();
  await page.getByText('Encoder settings').click();
  await page.locator('select[name=command]').selectOption('t');
  await expect(at(page, 'temperature')).toHaveAttribute('data-value', '31.2');
  expect(page.url()).toContain('command=t');
  await page.locator('input[name=angle-bits]').fill('99');
  await page.locator('input[name=angle-bits]').blur();
  await expect(page.getByRole('alert')).toContainText('99 is not in 1…24');
});

for (const format of ['bus', 'period', 'asi1', 'asi4']) {
  test(`the demo speaks ${format}`, async ({ page }) => {
    await page.goto(`/#/console?format=${format}`);
    await expectDemo(page);
    await until(page, 'frames-ok', (frames) => frames > 100);
    expect(await number(page, 'frames-bad')).toBe(0);
    const first = await number(page, 'angle');
    await until(page, 'angle', (angle) => angle !== first);
  });
}

test('parameters that few need are one click away', async ({ page }) => {
  await page.goto('/#/decode?format=ssi-tree');
  await page.locator('input[name=turns-bits]').fill('0');
  await page.locator('input[name=turns-bits]').blur();
  await expect(page.locator('input[name=frame-bits]')).toHaveValue('13');
  await page.locator('select[name=code]').selectOption('binary');
  await page.getByText('More').click();
  await page.locator('select[name=justify]').selectOption('left');
  for (const part of ['turns-bits=0', 'code=binary', 'justify=left', 'frame-bits=13']) {
    expect(page.url()).toContain(part);
  }
});

test('an order code chooses the profile, and a wrong one is told where', async ({ page }) => {
  await page.goto('/#/console');
  await at(page, 'demo').click();
  await page.getByText('Encoder settings').click();
  const code = page.locator('input[name=model]');
  await code.fill('PT-15B-25H-A-19M-D-N-A-M');
  await code.blur();
  await expect(at(page, 'profile')).toContainText('BUS 19 bit + 16 turns');
  await expectLink(page, 'reading');
  await code.fill('PT-15B-25H-A-19M-X-N-A-M');
  await code.blur();
  await expect(page.getByRole('alert')).toContainText('part 6');
  await code.fill('PT-15B-25H-A-19M-S-N-A-M');
  await code.blur();
  await expect(page.getByRole('alert')).toContainText('SSI is clocked');
});

test('a link with a wrong parameter says what is wrong', async ({ page }) => {
  await page.goto('/#/console?format=t486');
  await expect(page.getByRole('alert')).toContainText('t486');
  await page.goto('/#/console?format=t485&angle-bits=x');
  await expect(page.getByRole('alert')).toContainText('angle-bits');
});

test('a browser without Web Serial is told so; demo and decoder work', async ({ page }) => {
  await page.addInitScript(() => {
    delete Navigator.prototype.serial;
  });
  await page.goto('/');
  await expectLink(page, 'no-api');
  await expect(page.getByText('has no Web Serial')).toBeVisible();
  await expect(at(page, 'connect')).toBeDisabled();
  await expectDemo(page);
  await expectDecoder(page);
});

test('a page over plain http is told so; demo and decoder work', async ({ page }) => {
  await page.goto('http://encoderscope.test:8089/');
  expect(await page.evaluate(() => isSecureContext)).toBe(false);
  await expectLink(page, 'insecure');
  await expect(page.getByText('plain http')).toBeVisible();
  await expect(at(page, 'connect')).toBeDisabled();
  await expectDemo(page);
  await page.goto('http://encoderscope.test:8089/#/decode?format=t485');
  await at(page, 'dump-input').fill('02 20 b4 bd 1c 37');
  await expect(at(page, 'dump-row')).toHaveAttribute('data-ok', 'true');
});

test('a browser without workers runs the engine on the page', async ({ page }) => {
  await page.addInitScript(() => {
    window.Worker = class {
      constructor() {
        throw new Error('no workers here');
      }
    };
  });
  await page.goto('/');
  await expectDemo(page);
  expect(page.workers()).toHaveLength(0);
});

test('it fits a phone and follows the theme', async ({ page }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  for (const area of ['console', 'decode']) {
    await page.goto(`/#/${area}`);
    await expect(page.locator('nav')).toBeInViewport();
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    expect(wide).toBeLessThanOrEqual(390);
  }
  const ground = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const light = await ground();
  await page.getByLabel('Light or dark').click();
  await expect.poll(ground).not.toBe(light);
  await page.reload();
  await expect.poll(ground).not.toBe(light);
});

test('what is shown and what runs are one profile', async ({ page }) => {
  await page.goto('/#/console?format=rs485&command=0');
  await expectDemo(page);
  await page.goto('/#/decode?format=t485&angle-bits=17');
  await page.getByRole('link', { name: 'Console', exact: true }).click();
  await expect(at(page, 'profile')).toContainText('17 bit');
  await expect(page.getByText('/ 131 072 counts')).toBeVisible();
});

test('a policy that forbids serial ports is named', async ({ page }) => {
  await page.route('**/', async (route) => {
    const response = await route.fetch();
    const headers = { ...response.headers(), 'permissions-policy': 'serial=()' };
    await route.fulfill({ response, headers });
  });
  await page.goto('/');
  await expectLink(page, 'blocked');
  await expect(at(page, 'connect')).toBeDisabled();
  await expectDemo(page);
});
