// Two tabs and one port, over real Web Serial.
import { at, expect, expectLink, number, test, until } from './page.js';
import { Encoder } from './encoder.js';
import config from './playwright.config.js';

test.use({
  launchOptions: {
    ...config.use.launchOptions,
    executablePath: new URL('./chromium-user.sh', import.meta.url).pathname,
  },
});

const QUERY = 'format=t485&angle-bits=23';

const connect = async (page) => {
  await page.goto(`/#/console?${QUERY}`);
  await at(page, 'connect').click();
};

test('a second tab is refused the port, and has it when the first lets go @serial', async ({ page, context }) => {
  const encoder = await Encoder.start('--format', 't485', '--angle-bits', '23', 'still=0.5');
  await connect(page);
  await expectLink(page, 'reading');
  const second = await context.newPage();
  await connect(second);
  await expectLink(second, 'refused');
  await expect(at(second, 'link-state')).toContainText('Close other tabs');
  // The first is not disturbed.
  const frames = await number(page, 'frames-ok');
  await page.bringToFront();
  await until(page, 'frames-ok', (now) => now > frames + 50);
  await at(page, 'disconnect').click();
  await expectLink(page, 'closed');
  encoder.set('exclusive=0');
  await second.bringToFront();
  await at(second, 'connect').click();
  await expectLink(second, 'reading');
  await until(second, 'angle', (angle) => angle === 2 ** 22);
  await at(page, 'connect').click();
  await expectLink(page, 'refused');
  await encoder.unplug();
});
