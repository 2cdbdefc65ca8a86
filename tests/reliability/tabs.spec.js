// Two tabs and one port, over real Web Serial.
import { at, connect, disconnect, expect, expectLink, number, test, until } from '../page/page.js';
import config from '../page/playwright.config.js';
import { spy } from '../page/spy.js';
import { ALL } from './formats.js';
import { Trial } from './trial.js';

test.use({
  launchOptions: {
    ...config.use.launchOptions,
    executablePath: new URL('../page/chromium-user.sh', import.meta.url).pathname,
  },
});

let trial;
test.afterEach(async () => {
  await trial?.close();
  trial = undefined;
});

for (const name of ALL) {
  test(`two tabs: the second is refused the port, and has it when the first lets go: ${name} @serial`, async ({ page, context }) => {
    await spy(page);
    trial = await Trial.begin(page, name);
    const { encoder, format } = trial;
    const second = await context.newPage();
    await connect(second, format.query);
    await expectLink(second, 'refused');
    await expect(at(second, 'link-state')).toContainText('Close other tabs');
    // The first is not disturbed.
    const frames = await number(page, 'frames-ok');
    await page.bringToFront();
    await until(page, 'frames-ok', (now) => now > frames + 50);
    await trial.record('two tabs: a second one wants the port');
    // It is held open here, as no real port is.
    encoder.set('exclusive=0');
    encoder.set('silent=0');
    await second.bringToFront();
    await at(second, 'connect').click();
    await expectLink(second, 'reading');
    await until(second, 'angle', (angle) => angle === format.shows.angle);
    await at(page, 'connect').click();
    await expectLink(page, 'refused');
    await disconnect(second);
  });
}
