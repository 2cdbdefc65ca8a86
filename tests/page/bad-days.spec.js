// Bad days over real Web Serial: two tabs, a tab asleep, a page that goes away, noise.
import { at, expect, expectLink, number, test, until } from './page.js';
import { Encoder } from './encoder.js';

let encoder;
test.afterEach(async () => {
  await encoder?.unplug();
  encoder = undefined;
});

const options = (query) =>
  query.split('&').flatMap((pair) => {
    const [key, value] = pair.split('=');
    return [`--${key}`, value];
  });

const connect = async (page, query) => {
  await page.goto(`/#/console?${query}`);
  await at(page, 'connect').click();
};

const plug = async (page, query, ...settings) => {
  encoder = await Encoder.start(...options(query), ...settings);
  await connect(page, query);
  await expectLink(page, 'reading');
};

const counts = async (page) => {
  const ids = ['bytes-in', 'bytes-framed', 'bytes-skipped'];
  const [all, framed, skipped] = await Promise.all(ids.map((id) => number(page, id)));
  return { all, framed, skipped };
};

/** Ends reading; what is in no frame and not skipped is what was still being weighed. */
const expectAllAccounted = async (page) => {
  await at(page, 'disconnect').click();
  await expectLink(page, 'closed');
  const { all, framed, skipped } = await counts(page);
  expect(all).toBeGreaterThan(0);
  expect(all - framed - skipped).toBeGreaterThanOrEqual(0);
  expect(all - framed - skipped).toBeLessThan(128);
};

const T485 = 'format=t485&angle-bits=23';

test('a second tab is refused the port, and has it when the first lets go @serial', async ({ page, context }) => {
  await plug(page, T485, 'still=0.5');
  const second = await context.newPage();
  await connect(second, T485);
  await expectLink(second, 'refused');
  await expect(at(second, 'link-state')).toContainText('Close other tabs');
  const frames = await number(page, 'frames-ok');
  await page.bringToFront();
  await until(page, 'frames-ok', (now) => now > frames + 50);
  await at(page, 'disconnect').click();
  await expectLink(page, 'closed');
  await second.bringToFront();
  await at(second, 'connect').click();
  await expectLink(second, 'reading');
  await until(second, 'angle', (angle) => angle === 2 ** 22);
});

test('a page that goes away lets go of the port @serial', async ({ page, context }) => {
  await plug(page, T485, 'still=0.5');
  await page.goto('about:blank');
  const second = await context.newPage();
  await connect(second, T485);
  await expectLink(second, 'reading');
  await until(second, 'angle', (angle) => angle === 2 ** 22);
});

/** Freezes a page for a while, as a browser does with tabs in the background. */
const freeze = async (page, context, milliseconds) => {
  const session = await context.newCDPSession(page);
  await session.send('Page.setWebLifecycleState', { state: 'frozen' });
  await new Promise((done) => setTimeout(done, milliseconds));
  await session.send('Page.setWebLifecycleState', { state: 'active' });
};

for (const [name, query] of [
  ['a polled encoder', T485],
  ['a stream', 'format=period&angle-bits=24'],
]) {
  test(`a tab that was frozen reads ${name} on, and its counters stay true @serial`, async ({ page, context }) => {
    await plug(page, query, 'still=0.5');
    await until(page, 'frames-ok', (frames) => frames > 300);
    await freeze(page, context, 4_000);
    await expectLink(page, 'reading');
    const frames = await number(page, 'frames-ok');
    await until(page, 'frames-ok', (now) => now > frames + 300);
    await until(page, 'angle', (angle) => angle === 2 ** (name === 'a stream' ? 23 : 22));
    // No reply is said to have taken as long as the sleep.
    const evidence = await at(page, 'link-state').locator('xpath=following-sibling::p').first().textContent();
    for (const [, latency] of evidence.matchAll(/([\d.]+) ms/g)) {
      expect(Number(latency)).toBeLessThan(1_000);
    }
    await expectAllAccounted(page);
  });
}

test('a tab in the background reads on, and at most one snapshot is on its way @serial', async ({ page, context }) => {
  await page.addInitScript(() => {
    // What the worker posts and what the page asks for, counted on the page.
    window.posted = 0;
    window.wanted = 0;
    const Real = window.Worker;
    window.Worker = class extends Real {
      constructor(...words) {
        super(...words);
        this.addEventListener('message', (event) => {
          if (event.data.Snapshot) window.posted += 1;
        });
      }

      postMessage(message) {
        if (message === 'Next') window.wanted += 1;
        super.postMessage(message);
      }
    };
    // A page that nobody sees draws nothing.
    window.hold = false;
    const draw = window.requestAnimationFrame.bind(window);
    window.held = [];
    window.requestAnimationFrame = (then) => (window.hold ? window.held.push(then) : draw(then));
  });
  await plug(page, 'format=period&angle-bits=24', 'still=0.5');
  await until(page, 'frames-ok', (frames) => frames > 300);
  await page.evaluate(() => {
    window.hold = true;
  });
  await page.waitForTimeout(500);
  const posted = await page.evaluate(() => window.posted);
  await page.waitForTimeout(3_000);
  const [later, wanted] = await page.evaluate(() => [window.posted, window.wanted]);
  expect(later).toBe(posted);
  expect(later).toBeLessThanOrEqual(wanted + 1);
  const before = await number(page, 'frames-ok');
  await page.evaluate(() => {
    window.hold = false;
    for (const then of window.held) requestAnimationFrame(then);
  });
  // It has been reading all the while: a frame every millisecond.
  await until(page, 'frames-ok', (frames) => frames > before + 2_000);
  await expectAllAccounted(page);
});

// Of 1000 reply bytes 50 have a bit turned over. A CRC of eight bits lets one of 256 damaged
// frames pass when several bits are wrong; a single wrong bit never passes. Frames in which two
// or more bytes are hit are 1 in 10, so among 100 good ones one wrong in a few hundred is to be
// expected: the angle may be wrong for a moment, and is so rarely.
for (const [name, query, turns] of [
  ['T485', T485, 2 ** 22],
  ['RS485', 'format=rs485&angle-bits=24&command=d', 2 ** 23],
  ['BUS', 'format=bus&angle-bits=24', 2 ** 23],
  ['PERIOD', 'format=period&angle-bits=24', 2 ** 23],
  ['ASI1', 'format=asi1', 2 ** 13],
  ['ASI4', 'format=asi4', 2 ** 13],
]) {
  test(`5 % of noise on ${name}: good frames are found, and the angle is right @serial`, async ({ page }) => {
    await plug(page, query, 'still=5.5');
    await until(page, 'angle', (angle) => angle === turns);
    encoder.set('flip=50');
    const before = await number(page, 'frames-ok');
    const seen = await page.evaluate(
      (wanted) =>
        new Promise((done) => {
          const seen = { right: 0, wrong: [] };
          const angle = document.querySelector('[data-testid="angle"]');
          const look = () => {
            const value = Number(angle.dataset.value);
            if (value === wanted) seen.right += 1;
            else seen.wrong.push(value);
          };
          const timer = setInterval(look, 10);
          setTimeout(() => {
            clearInterval(timer);
            done(seen);
          }, 5_000);
        }),
      turns,
    );
    const good = (await number(page, 'frames-ok')) - before;
    expect(good).toBeGreaterThan(10);
    expect(seen.right).toBeGreaterThan(100);
    expect(seen.wrong.length, `${seen.wrong}`).toBeLessThanOrEqual(seen.right / 50);
    encoder.set('flip=0');
    await expectLink(page, 'reading');
    await until(page, 'angle', (angle) => angle === turns);
    await expectAllAccounted(page);
  });
}
