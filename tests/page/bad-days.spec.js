// Bad days over real Web Serial: a tab in the background, asleep, or closed, and noise.
import { at, expect, expectLink, expectOnlyLateFrames, number, test, until } from './page.js';
import { Encoder, options } from './encoder.js';

let encoder;
test.afterEach(async () => {
  await encoder?.unplug();
  encoder = undefined;
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

/** Ends reading; every byte is in a frame or skipped. */
const expectAllAccounted = async (page) => {
  await at(page, 'disconnect').click();
  await expectLink(page, 'closed');
  const { all, framed, skipped } = await counts(page);
  expect(all).toBeGreaterThan(0);
  expect(framed + skipped).toBe(all);
};

const T485 = 'format=t485&angle-bits=23';

test('a page that goes away lets go of the port @serial', async ({ page, context }) => {
  await plug(page, T485, 'still=0.5');
  await page.goto('about:blank');
  const second = await context.newPage();
  await connect(second, T485);
  await expectLink(second, 'reading');
  await until(second, 'angle', (angle) => angle === 2 ** 22);
});

/** Puts the worker to sleep, as a machine does whose lid is closed. */
const sleep = (page, milliseconds) =>
  page.workers()[0].evaluate((milliseconds) => {
    const end = performance.now() + milliseconds;
    while (performance.now() < end);
  }, milliseconds);

/** Freezes a page, as a browser does with tabs in the background. */
const freeze = async (page, context, milliseconds) => {
  const session = await context.newCDPSession(page);
  await session.send('Page.setWebLifecycleState', { state: 'frozen' });
  await new Promise((done) => setTimeout(done, milliseconds));
  await session.send('Page.setWebLifecycleState', { state: 'active' });
};

/** Lets `window.latest` be the newest snapshot of the worker. */
const spy = (page) =>
  page.addInitScript(() => {
    const Real = window.Worker;
    window.Worker = class extends Real {
      constructor(...words) {
        super(...words);
        this.addEventListener('message', ({ data }) => {
          window.latest = data.Snapshot ?? window.latest;
        });
      }
    };
  });

/** The time that 99 of 100 replies keep, in milliseconds. */
const slowest = (page) => page.evaluate(() => window.latest.latency_p99);

for (const [name, query, angle] of [
  ['a polled encoder', T485, 2 ** 22],
  ['a stream', 'format=period&angle-bits=24', 2 ** 23],
]) {
  test(`a tab that was frozen, and one that slept, reads ${name} on @serial`, async ({ page, context }) => {
    await plug(page, query, 'still=0.5');
    await until(page, 'frames-ok', (frames) => frames > 100);
    for (const away of [freeze, (page, _, milliseconds) => sleep(page, milliseconds)]) {
      await away(page, context, 3_000);
      await expectLink(page, 'reading');
      const frames = await number(page, 'frames-ok');
      await until(page, 'frames-ok', (now) => now > frames + 300);
      expect(await number(page, 'angle')).toBe(angle);
    }
    await expectOnlyLateFrames(page);
    await expectAllAccounted(page);
  });
}

test('a reply that waited while the tab slept does not count as a slow one @serial', async ({ page }) => {
  await spy(page);
  await plug(page, T485, 'still=0.5');
  // Few replies, so that one would show in the slowest of a hundred.
  for (const frames of [20, 40, 60]) {
    await until(page, 'frames-ok', (now) => now > frames);
    await sleep(page, 1_500);
  }
  await expectLink(page, 'reading');
  const latency = await slowest(page);
  expect(latency).toBeGreaterThan(0);
  expect(latency).toBeLessThan(1_000);
  await expectAllAccounted(page);
});

test('a setting does not go on after a sleep, for the shaft may have moved @serial', async ({ page }) => {
  await plug(page, 'format=rs485&angle-bits=24&command=d', 'still=5.25');
  await until(page, 'angle', (angle) => angle === 2 ** 22);
  await at(page, 'zero-start').click();
  await expect(at(page, 'gate')).toHaveAttribute('data-value', 'true');
  await at(page, 'zero-confirm').click();
  await until(page, 'zero-count', (count) => count >= 2 && count < 9);
  await sleep(page, 3_000);
  await expect(at(page, 'zero-outcome')).toHaveAttribute('data-value', 'no');
  await page.getByRole('button', { name: 'Done' }).click();
  await expectLink(page, 'reading');
  await until(page, 'angle', (angle) => angle === 2 ** 22);
});

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

// Of 1000 reply bytes 50 have a bit turned over. A CRC of eight bits finds every single wrong bit,
// and lets 1 of 256 frames pass in which more bytes are hit; two or more are hit in 1 of 10 frames
// or fewer. So a wrong angle among a few thousand good ones is to be expected, and shows for a
// frame's time. The text of ASI4 has no check at all: a digit that becomes another one is a
// number like any other, which is the case in 1 of 10 lines.
for (const [name, query, angle, wrong] of [
  ['T485', T485, 2 ** 22, 0.02],
  ['RS485', 'format=rs485&angle-bits=24&command=d', 2 ** 23, 0.02],
  ['BUS', 'format=bus&angle-bits=24', 2 ** 23, 0.02],
  ['PERIOD', 'format=period&angle-bits=24', 2 ** 23, 0.02],
  ['ASI1', 'format=asi1', 2 ** 13, 0],
  ['ASI4', 'format=asi4', 2 ** 13, 0.25],
]) {
  test(`5 % of noise on ${name}: good frames are found, and the angle is right @serial`, async ({ page }) => {
    await plug(page, query, 'still=5.5');
    await until(page, 'angle', (now) => now === angle);
    encoder.set('flip=50');
    const before = await number(page, 'frames-ok');
    const seen = await page.evaluate(
      (wanted) =>
        new Promise((done) => {
          const seen = { right: 0, wrong: [] };
          const shown = document.querySelector('[data-testid="angle"]');
          const look = () => {
            const value = Number(shown.dataset.value);
            if (value === wanted) seen.right += 1;
            else seen.wrong.push(value);
          };
          const timer = setInterval(look, 10);
          setTimeout(() => {
            clearInterval(timer);
            done(seen);
          }, 5_000);
        }),
      angle,
    );
    const good = (await number(page, 'frames-ok')) - before;
    expect(good).toBeGreaterThan(10);
    expect(seen.right).toBeGreaterThan(100);
    expect(seen.wrong.length, `${seen.wrong}`).toBeLessThanOrEqual(seen.right * wrong);
    encoder.set('flip=0');
    await expectLink(page, 'reading');
    await until(page, 'angle', (now) => now === angle);
    await expectAllAccounted(page);
  });
}
