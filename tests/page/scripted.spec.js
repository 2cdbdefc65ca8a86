// Bad days: ports that fail, hang and go away, over a scripted Web Serial.
import { at, disconnect, expect, expectAllAccounted, expectLink, number, test, until } from './page.js';
import { count, script, tell } from './scripted.js';

const connect = async (page) => {
  await page.goto('/#/console?format=t485');
  await at(page, 'connect').click();
};

const read = async (page, ...described) => {
  await script(page, ...(described.length > 0 ? described : [{}]));
  await connect(page);
  // Until the port is opened it is the demo that is read.
  await expect.poll(() => count(page, 'opened')).toBeGreaterThan(0);
  await expectLink(page, 'reading');
};

/** Reads on: more good frames come. */
const expectReadingOn = async (page) => {
  await expectLink(page, 'reading');
  const frames = await number(page, 'frames-ok');
  await until(page, 'frames-ok', (now) => now > frames + 20);
};

for (const error of ['BreakError', 'FramingError', 'ParityError', 'BufferOverrunError']) {
  test(`a ${error} is counted, and reading goes on with the next stream`, async ({ page }) => {
    await read(page);
    await expect(at(page, 'line-errors')).toHaveCount(0);
    for (const errors of [1, 2, 3]) {
      await expectReadingOn(page);
      // In the middle of a reply.
      await tell(page, 'mute', true);
      await page.waitForTimeout(20);
      await tell(page, 'say', [0x1a, 0x20, 0x29]);
      await tell(page, 'fail', error);
      await until(page, 'line-errors', (counted) => counted === errors);
      await tell(page, 'mute', false);
    }
    await expectReadingOn(page);
    expect(await count(page, 'streams')).toBe(4);
    // The reply behind one that a busy machine delivers late is not sure.
    expect(await number(page, 'frames-bad')).toBeLessThanOrEqual(await number(page, 'silent'));
    expect(await number(page, 'bytes-skipped')).toBeGreaterThanOrEqual(9);
    await disconnect(page);
    await expectAllAccounted(page);
  });
}

test('a line that does nothing but fail neither hangs the page nor spins', async ({ page }) => {
  await read(page);
  await tell(page, 'storm', 'BreakError');
  await tell(page, 'fail', 'BreakError');
  await expectLink(page, 'silent');
  const before = await count(page, 'streams');
  await page.waitForTimeout(2_000);
  const streams = await count(page, 'streams');
  expect(streams).toBeGreaterThan(before);
  expect(streams - before).toBeLessThan(60);
  await tell(page, 'storm', null);
  await expectReadingOn(page);
  // Every stream but the one that is being read has failed.
  expect(await number(page, 'line-errors')).toBe((await count(page, 'streams')) - 1);
  await tell(page, 'storm', 'FramingError');
  await tell(page, 'fail', 'FramingError');
  await disconnect(page);
  await expectAllAccounted(page);
});

test('a fatal error of the stream is a lost port', async ({ page }) => {
  await read(page);
  await tell(page, 'fail', 'NetworkError');
  await expectLink(page, 'lost');
  await expect(at(page, 'connect')).toHaveText('Reconnect');
  await expectAllAccounted(page);
  await at(page, 'connect').click();
  await expectReadingOn(page);
});

test('a stream that ends by itself is a lost port', async ({ page }) => {
  await read(page);
  await tell(page, 'end');
  await expectLink(page, 'lost');
});

test('an error that nobody knows is a lost port', async ({ page }) => {
  await read(page);
  await tell(page, 'fail', 'UnknownError');
  await expectLink(page, 'lost');
});

test('a device that goes away is a lost port, even when reading does not end', async ({ page }) => {
  await read(page);
  await tell(page, 'mute', true);
  await tell(page, 'disconnect');
  await expectLink(page, 'lost');
  await expect(at(page, 'link-state')).toContainText('unplugged');
});

test('a plug pulled and put back reads on, however quickly', async ({ page }) => {
  await read(page);
  for (const pause of [300, 50, 10, 0, 0]) {
    await expectReadingOn(page);
    await page.evaluate(async (pause) => {
      const [port] = window.scripted;
      port.unplug();
      if (pause > 0) await new Promise((done) => setTimeout(done, pause));
      port.plug();
    }, pause);
  }
  await expect.poll(() => count(page, 'opened')).toBe(6);
  await expectReadingOn(page);
  await disconnect(page);
  await expectAllAccounted(page);
});

test('a plug pulled while the port is being opened is said, and another can be opened', async ({ page }) => {
  await script(page, { opening: 'never', vendor: 0x0403, product: 0x6014 });
  await connect(page);
  await expectLink(page, 'opening');
  await tell(page, 'disconnect');
  await expectLink(page, 'lost');
  await tell(page, 'opening', null);
  await tell(page, 'plug');
  await expectReadingOn(page);
});

for (const [error, remedy] of [
  ['InvalidStateError', 'plug it in again'],
  ['NetworkError', 'other programs'],
  ['SecurityError', 'settings'],
]) {
  test(`a port refused with ${error} says what to do`, async ({ page }) => {
    await script(page, { opening: error });
    await connect(page);
    await expectLink(page, 'refused');
    await expect(at(page, 'link-state')).toContainText(remedy);
    await tell(page, 'opening', null);
    await at(page, 'connect').click();
    await expectReadingOn(page);
  });
}

test('a permission that is withdrawn ends in a named state, and a port can be added', async ({ page }) => {
  await read(page);
  // The browser then treats the port as gone, and lists it no more.
  await tell(page, 'unplug');
  await expectLink(page, 'lost');
  await expect(at(page, 'link-state')).toContainText('permission');
  await at(page, 'connect').click();
  await expect(page.getByRole('alert')).toContainText('may no longer use it');
  await page.getByRole('button', { name: 'Add…' }).click();
  await expect(page.getByRole('alert')).toHaveText('No port was chosen.');
});

for (const hang of ['closing', 'cancelling']) {
  test(`${hang} that never ends holds nothing up`, async ({ page }) => {
    await read(page, { vendor: 0x0403, product: 0x6014 }, { vendor: 0x1a86, product: 0x55d3 });
    await tell(page, hang, 'never');
    await disconnect(page);
    await at(page, 'port').selectOption({ label: 'CH343' });
    await at(page, 'connect').click();
    await expectReadingOn(page);
    await at(page, 'demo').click();
    await expectLink(page, 'reading');
    await expect(page.getByText('Demo encoder')).toBeVisible();
  });
}

test('a port that has not closed cannot be opened again, and that is said', async ({ page }) => {
  await read(page, { closing: 'never' });
  await disconnect(page);
  await at(page, 'connect').click();
  await expectLink(page, 'refused');
  await expect(at(page, 'link-state')).toContainText('pull the adapter out');
});

test('writes that are not taken are silence, and do not pile up', async ({ page }) => {
  await read(page);
  const before = await count(page, 'writes');
  await tell(page, 'writing', 'never');
  await expectLink(page, 'silent');
  await page.waitForTimeout(1_500);
  // One that hangs; nothing is put behind it that would be sent long after it was meant.
  expect(await count(page, 'writes')).toBeLessThanOrEqual(before + 200);
  const hanging = await count(page, 'writes');
  await page.waitForTimeout(1_000);
  expect(await count(page, 'writes')).toBe(hanging);
  await disconnect(page);
  await expectAllAccounted(page);
});

test('a write that fails is one reply missing, and the next goes out', async ({ page }) => {
  await read(page);
  await tell(page, 'writing', 'UnknownError');
  await expectLink(page, 'silent');
  await tell(page, 'writing', null);
  await expectReadingOn(page);
});

test('a port that never opens can be given up', async ({ page }) => {
  await script(page, { opening: 'never' });
  await connect(page);
  await expectLink(page, 'opening');
  await disconnect(page);
  await at(page, 'demo').click();
  await expectLink(page, 'reading');
  const first = await number(page, 'angle');
  await until(page, 'angle', (angle) => angle !== first);
});

test('replies that become too short are not shown as reading', async ({ page }) => {
  await read(page);
  await tell(page, 'reply', [0x1a, 0x20, 0x29, 0xc0, 0x3b]);
  await expectLink(page, 'garbage');
  await expect(page.getByText('last reading before the link stopped')).toBeVisible();
});

test('when the chosen adapter is unplugged, another is not taken for it', async ({ page }) => {
  await read(page, { vendor: 0x0403, product: 0x6014 }, { vendor: 0x1a86, product: 0x55d3 });
  await expect(page.getByText('FT232H').first()).toBeVisible();
  await disconnect(page);
  await tell(page, 'disconnect');
  await at(page, 'connect').click();
  await expect(page.getByRole('alert')).toContainText('not plugged in');
  expect(await count(page, 'opened', 0)).toBe(1);
  expect(await count(page, 'opened', 1)).toBe(0);
  await expect(at(page, 'port').locator('option:checked')).toContainText('FT232H · not plugged in');
  await at(page, 'port').selectOption({ label: 'CH343' });
  await at(page, 'connect').click();
  await expectReadingOn(page);
  expect(await count(page, 'opened', 0)).toBe(1);
  expect(await count(page, 'opened', 1)).toBe(1);
});

test('no port chosen is said', async ({ page }) => {
  await script(page);
  await page.goto('/');
  await at(page, 'connect').click();
  await expect(page.getByRole('alert')).toHaveText('No port was chosen.');
});
