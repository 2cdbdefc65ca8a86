// Recordings: written as they come, whole after a crash, replayed, compared; and the support file.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { chromium, test as bare } from '@playwright/test';
import { at, expect, expectLink, number, test, until } from './page.js';
import { Encoder, options } from './encoder.js';
import config from './playwright.config.js';

let encoder;
let folder;
test.beforeEach(() => {
  folder = mkdtempSync(join(tmpdir(), 'recordings-'));
});
test.afterEach(async () => {
  await encoder?.unplug();
  encoder = undefined;
  rmSync(folder, { recursive: true });
});

const T485 = 'format=t485&angle-bits=23';

/** Reads the demo encoder. */
const demo = async (page, query = T485) => {
  await page.goto(`/#/console?${query}`);
  await at(page, 'demo').click();
  await expectLink(page, 'reading');
};

const plug = async (page, query, ...settings) => {
  encoder = await Encoder.start(...options(query), ...settings);
  await page.goto(`/#/console?${query}`);
  await at(page, 'connect').click();
  await expectLink(page, 'reading');
};

const record = async (page) => {
  await at(page, 'record').click();
  await expect(at(page, 'record')).toHaveText('Stop recording');
  await until(page, 'recorded', (size) => size > 0);
};

/** Records a link from before its first byte on. */
const recordAll = async (page, query, ...settings) => {
  encoder = await Encoder.start(...options(query), ...settings);
  await demo(page, query);
  await at(page, 'disconnect').click();
  await expectLink(page, 'closed');
  await at(page, 'record').click();
  await at(page, 'connect').click();
};

const stop = async (page) => {
  await at(page, 'record').click();
  await expect(at(page, 'record')).toHaveText('Record');
  await expect(at(page, 'recording').first()).toHaveAttribute('data-whole', 'true');
};

/** Saves what a button hands out; returns its path. */
const saved = async (page, button) => {
  const [download] = await Promise.all([page.waitForEvent('download'), button.click()]);
  const path = join(folder, download.suggestedFilename());
  await download.saveAs(path);
  return path;
};

/** What Wireshark makes of a file: for each packet its time, event, bytes and comment. */
const wireshark = (path) => {
  const fields = ['frame.time_epoch', 'rtacser.eventtype', 'data.data', 'frame.comment', 'frame.interface_name'];
  const words = ['-r', path, '-T', 'fields', ...fields.flatMap((field) => ['-e', field])];
  const out = execFileSync('tshark', words, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'], maxBuffer: Infinity });
  const lines = out.split('\n').filter((line) => line);
  return lines.map((line) => {
    const [time, event, data, comment, adapter] = line.split('\t');
    return { time: Number(time), event: Number(event), bytes: (data ?? '').length / 2, comment, adapter };
  });
};

const [MARK, SENT, RECEIVED, END] = [0, 1, 2, 6];

/** The counts of the link. */
const counts = async (page) => {
  const ids = ['frames-ok', 'frames-bad', 'silent', 'bytes-in', 'bytes-framed', 'bytes-skipped'];
  const found = await Promise.all(ids.map((id) => number(page, id)));
  return Object.fromEntries(ids.map((id, index) => [id, found[index]]));
};

const play = async (page, speed) => {
  await at(page, 'replay-speed').selectOption({ label: speed });
};

const ended = (page) => expect(at(page, 'replay-time')).toContainText('the end');

test('a recording opens in Wireshark, with notes, directions and the adapter', async ({ page }) => {
  await demo(page);
  const began = Date.now() / 1000;
  await record(page);
  await page.getByLabel('Note').fill('the cable is moved');
  await at(page, 'record-mark').click();
  await page.waitForTimeout(1_500);
  await stop(page);
  const path = await saved(page, at(page, 'save').first());
  expect(path).toMatch(/encoderscope-\d{4}-\d\d-\d\d-\d\d-\d\d-\d\d\.pcapng$/);
  const packets = wireshark(path);
  expect(packets.at(-1)).toMatchObject({ event: END, comment: 'stopped' });
  expect(packets.find(({ event }) => event === MARK).comment).toBe('the cable is moved');
  expect(packets[0].adapter).toBe('built-in encoder');
  const sent = packets.filter(({ event }) => event === SENT);
  const received = packets.filter(({ event }) => event === RECEIVED);
  expect(sent.length).toBeGreaterThan(200);
  expect(Math.abs(sent.length - received.length)).toBeLessThan(5);
  expect(new Set(sent.map(({ bytes }) => bytes))).toEqual(new Set([1]));
  expect(new Set(received.map(({ bytes }) => bytes))).toEqual(new Set([11]));
  expect(packets[0].time).toBeGreaterThan(began - 1);
  expect(packets.at(-1).time).toBeLessThan(Date.now() / 1000 + 1);
});

for (const [name, query, settings] of [
  ['T485 with faults', T485, ['turning=0.3', 'flip=3', 'drop=2', 'insert=2', 'lose=2']],
  ['a stream with noise', 'format=asi1&angle-bits=14&baud=230400', ['turning=0.3', 'flip=5', 'interval=2000']],
]) {
  test(`a replay of ${name} counts what was counted @serial`, async ({ page }) => {
    await recordAll(page, query, ...settings);
    await page.waitForTimeout(5_000);
    await until(page, 'frames-bad', (frames) => frames > 5);
    await at(page, 'disconnect').click();
    await expectLink(page, 'closed');
    const live = await counts(page);
    expect(live['bytes-framed'] + live['bytes-skipped']).toBe(live['bytes-in']);
    await stop(page);

    await at(page, 'replay').first().click();
    await expect(at(page, 'replay-bar')).toBeVisible();
    await play(page, 'at once');
    await ended(page);
    await expect.poll(() => counts(page)).toEqual(live);
    await expect(at(page, 'replay-lost')).toHaveCount(0);
    expect(await number(page, 'angle')).toBeGreaterThan(0);
  });
}

test('a full line is recorded to the last byte @serial', async ({ page }) => {
  test.setTimeout(60_000);
  const query = 'format=period&angle-bits=24&baud=2500000';
  await recordAll(page, query, 'turning=0.3', 'interval=28');
  await expectLink(page, 'reading');
  await page.waitForTimeout(5_000);
  await at(page, 'disconnect').click();
  await expectLink(page, 'closed');
  const all = await number(page, 'bytes-in');
  expect(all).toBeGreaterThan(300_000);
  await stop(page);
  const packets = wireshark(await saved(page, at(page, 'save').first()));
  const sum = packets.filter(({ event }) => event === RECEIVED).reduce((sum, { bytes }) => sum + bytes, 0);
  expect(sum).toBe(all);
});

test('a replay is held, goes on, jumps, and begins once more', async ({ page }) => {
  await demo(page);
  await record(page);
  await page.waitForTimeout(4_000);
  await stop(page);
  await at(page, 'replay').first().click();
  await expectLink(page, 'reading');
  await expect(page.locator('.angle h2')).toHaveText('Recording · angle');
  await at(page, 'replay-play').click();
  await expect(at(page, 'replay-play')).toHaveText('Play');
  await page.waitForTimeout(500);
  const held = await number(page, 'frames-ok');
  const place = await at(page, 'replay-place').inputValue();
  await page.waitForTimeout(500);
  expect(await number(page, 'frames-ok')).toBe(held);
  await play(page, '1/10');
  await at(page, 'replay-play').click();
  await until(page, 'frames-ok', (frames) => frames > held);
  await play(page, '10×');
  await ended(page);
  const all = await number(page, 'frames-ok');
  // The end is still shown for a moment.
  await at(page, 'replay-play').click();
  await until(page, 'frames-ok', (frames) => frames < all / 2);
  await ended(page);
  expect(Math.abs((await number(page, 'frames-ok')) - all)).toBeLessThanOrEqual(1);
  // What is behind the middle is about half of it.
  await at(page, 'replay-place').evaluate((input) => {
    input.value = '500';
    input.dispatchEvent(new Event('change'));
  });
  await until(page, 'frames-ok', (frames) => frames < all / 2);
  await ended(page);
  const half = await number(page, 'frames-ok');
  expect(half).toBeGreaterThan(all * 0.1);
  expect(half).toBeLessThan(all * 0.7);
  expect(Number(place)).toBeLessThan(1000);
  // A recording cannot be changed.
  await expect(page.locator('.panel.setting')).toHaveCount(0);
  await expect(at(page, 'record')).toHaveCount(0);
  await at(page, 'demo').click();
  await expectLink(page, 'reading');
  await expect(at(page, 'replay-bar')).toHaveCount(0);
});

test('a recording goes on while the plug is pulled and put back @serial', async ({ page }) => {
  await plug(page, T485, 'still=0.5');
  await record(page);
  await encoder.unplug();
  await expectLink(page, 'lost');
  encoder = await Encoder.start(...options(T485), 'still=0.25');
  await at(page, 'connect').click();
  await until(page, 'angle', (angle) => angle === 2 ** 21);
  await page.waitForTimeout(700);
  await stop(page);
  await at(page, 'replay').first().click();
  await play(page, 'at once');
  await ended(page);
  await until(page, 'angle', (angle) => angle === 2 ** 21);
  const packets = wireshark(await saved(page, at(page, 'save').first()));
  expect(packets.filter(({ event }) => event === RECEIVED).length).toBeGreaterThan(100);
});

test('all devices of a BUS are in a replay @serial', async ({ page }) => {
  const query = 'format=bus&address=3&angle-bits=17';
  encoder = await Encoder.start(...options(query), 'still=0.5', 'device=9', 'still=0.25');
  await page.goto(`/#/console?${query}`);
  await at(page, 'connect').click();
  await expectLink(page, 'reading');
  await at(page, 'scan').click();
  await expect(at(page, 'device')).toHaveCount(2);
  await record(page);
  await page.waitForTimeout(1_000);
  await stop(page);
  await at(page, 'replay').first().click();
  await play(page, 'at once');
  await ended(page);
  await expect(at(page, 'device')).toHaveCount(2);
  await until(page, 'angle', (angle) => angle === 2 ** 16);
});

test('a recording that was deleted comes back when that is undone', async ({ page }) => {
  await demo(page);
  for (const count of [1, 2]) {
    await record(page);
    await stop(page);
    await expect(at(page, 'recording')).toHaveCount(count);
  }
  const [newer, older] = await at(page, 'recording').evaluateAll((rows) => rows.map((row) => row.dataset.name));
  const row = (name) => page.locator(`[data-testid="recording"][data-name="${name}"]`);
  await row(newer).getByTestId('delete').click();
  await expect(row(newer)).toHaveCount(0);
  await expect(at(page, 'undelete')).toBeFocused();
  await page.keyboard.press('Enter');
  await expect(row(newer)).toHaveCount(1);
  await expect(at(page, 'deleted')).toHaveCount(0);
  // The next deletion ends the one before; what a closed page had not ended is there again.
  await row(newer).getByTestId('delete').click();
  await row(older).getByTestId('delete').click();
  await expect(at(page, 'deleted')).toContainText(older);
  await expect(at(page, 'recording')).toHaveCount(0);
  await page.reload();
  await at(page, 'demo').click();
  await expect(row(older)).toHaveCount(1);
  await expect(row(newer)).toHaveCount(0);
});

test('a deletion is done after a while, on a phone too', async ({ page }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await page.clock.install();
  await demo(page);
  await record(page);
  await stop(page);
  await at(page, 'delete').click();
  await expect(at(page, 'deleted')).toBeVisible();
  await page.clock.runFor(21_000);
  await expect(at(page, 'deleted')).toHaveCount(0);
  await expect(at(page, 'recording')).toHaveCount(0);
  await page.reload();
  await at(page, 'demo').click();
  await expectLink(page, 'reading');
  await expect(page.locator('.recordings .hint')).toContainText('A recording keeps every byte');
});

test('two recordings are compared', async ({ page }) => {
  await demo(page);
  await record(page);
  await until(page, 'recorded', (size) => size > 60_000);
  await stop(page);
  await page.getByText('Demo status and faults').click();
  await page.locator('input[name="demo-flip"]').fill('5');
  await until(page, 'frames-bad', (frames) => frames > 5);
  await record(page);
  await until(page, 'recorded', (size) => size > 60_000);
  await stop(page);
  await expect(at(page, 'recording')).toHaveCount(2);
  for (const box of await page.getByLabel('Compare').all()) await box.check();
  await at(page, 'compare').click();
  const row = (name) => page.locator(`[data-testid="compared"][data-name="${name}"] td`).allTextContents();
  await expect(at(page, 'comparison')).toBeVisible();
  const bad = (await row('bad frames')).map((text) => Number(text.replaceAll(/\D/g, '')));
  // Newest first.
  expect(bad[0]).toBeGreaterThan(10);
  expect(bad[1]).toBe(0);
  const good = (await row('good frames')).map((text) => Number(text.replaceAll(/\D/g, '')));
  expect(Math.min(...good)).toBeGreaterThan(200);
  for (const path of await page.locator('.overlay path').all()) {
    expect((await path.getAttribute('d')).length).toBeGreaterThan(100);
  }
});

test('what a browser does not keep is recorded in memory', async ({ page }) => {
  await page.addInitScript(() => {
    window.Worker = class {
      constructor() {
        throw new Error('no workers here');
      }
    };
  });
  await demo(page);
  await record(page);
  await expect(at(page, 'record-memory')).toBeVisible();
  await page.waitForTimeout(1_000);
  await stop(page);
  const packets = wireshark(await saved(page, at(page, 'save').first()));
  expect(packets.at(-1).event).toBe(END);
  expect(packets.length).toBeGreaterThan(100);
  await at(page, 'replay').first().click();
  await play(page, 'at once');
  await ended(page);
  await until(page, 'frames-ok', (frames) => frames > 50);
});

test('a recording goes to a file on disk as well', async ({ page }) => {
  // The dialogue of the system cannot be driven; what it would return is a handle like this one.
  await page.addInitScript(() => {
    window.showSaveFilePicker = async ({ suggestedName }) => {
      const root = await navigator.storage.getDirectory();
      window.chosen = suggestedName;
      return root.getFileHandle('on-disk.pcapng', { create: true });
    };
  });
  await demo(page);
  await record(page);
  await page.waitForTimeout(800);
  await at(page, 'record-to-disk').click();
  await expect(at(page, 'record-copy')).toContainText('on-disk.pcapng');
  await page.waitForTimeout(800);
  await stop(page);
  const copied = () =>
    page.evaluate(async () => {
      const root = await navigator.storage.getDirectory();
      const file = await (await root.getFileHandle('on-disk.pcapng')).getFile();
      return [...new Uint8Array(await file.arrayBuffer())];
    });
  await expect.poll(async () => (await copied()).length).toBeGreaterThan(1_000);
  const path = join(folder, 'on-disk.pcapng');
  writeFileSync(path, Buffer.from(await copied()));
  const kept = await saved(page, at(page, 'save').first());
  expect(wireshark(path)).toEqual(wireshark(kept));
  expect(kept).toContain(await page.evaluate(() => window.chosen));
});

test('a file that is no recording is refused in words', async ({ page }) => {
  await demo(page);
  const open = (name, text) =>
    at(page, 'recording-file').setInputFiles({ name, mimeType: 'application/octet-stream', buffer: Buffer.from(text) });
  await open('notes.pcapng', 'these are notes and no recording at all');
  await expect(at(page, 'recordings-fault')).toHaveText('this is no pcapng file.');
  await open('empty.pcapng', '');
  await ended(page);
});

test('a recording dropped on the decoder is replayed', async ({ page }) => {
  await demo(page);
  await record(page);
  await page.waitForTimeout(800);
  await stop(page);
  const path = await saved(page, at(page, 'save').first());
  await page.goto('/#/decode');
  await at(page, 'file-input').setInputFiles(path);
  await expectLink(page, 'reading');
  await expect(at(page, 'replay-bar')).toContainText('built-in encoder');
});

test('a support file shows the page that it was made of, and carries no names', async ({ page, context }) => {
  await plug(page, T485, 'still=0.5', 'status=2');
  await page.locator('[name="port-name"]').fill('Line 4, Ivan');
  await page.locator('[name="port-name"]').blur();
  await until(page, 'frames-ok', (frames) => frames > 200);
  encoder.set('silent=1');
  await expectLink(page, 'silent');
  await at(page, 'report').click();
  const preview = at(page, 'report-preview');
  await expect(preview).toContainText('serial port');
  await page.locator('[name="remark"]').fill('no answer since noon');
  await expect(preview).toContainText('no answer since noon');
  await preview.getByText('Every word of it').click();
  const text = await at(page, 'report-text').textContent();
  expect(text).not.toContain('Ivan');
  expect(text).not.toMatch(/localhost|\d+\.\d+\.\d+\.\d+|https?:/);
  const report = JSON.parse(text);
  expect(report.history.some((line) => line.endsWith('link silent'))).toBe(true);
  expect(report.browser).toMatch(/Chrom/);
  expect(report.system).toBe('Linux');
  expect(report.seconds).toBeGreaterThan(0);
  const path = await saved(page, at(page, 'report-save'));
  const before = await counts(page);
  await encoder.unplug();
  encoder = undefined;
  expect(execFileSync('strings', ['-el', path]).toString() + execFileSync('strings', [path]).toString()).not.toContain('Ivan');

  const other = await context.newPage();
  await demo(other);
  await at(other, 'recording-file').setInputFiles(path);
  await expect(at(other, 'report-opened')).toContainText('no answer since noon');
  await expectLink(other, 'silent');
  const after = await counts(other);
  expect(after['frames-ok']).toBe(before['frames-ok']);
  await until(other, 'angle', (angle) => angle === 2 ** 22);
  // It is held where it begins.
  await expect(at(other, 'replay-play')).toHaveText('Play');
  await at(other, 'replay-play').click();
  await play(other, 'at once');
  await ended(other);
  expect((await counts(other))['frames-ok']).toBeGreaterThan(200);
  const packets = wireshark(path);
  expect(packets.length).toBeGreaterThan(200);
});

/** Starts a browser that keeps what it has in a folder. */
const launch = (folder) =>
  chromium.launchPersistentContext(folder, {
    ...config.use.launchOptions,
    baseURL: config.use.baseURL,
    acceptDownloads: true,
  });

bare('a disk that is full ends a recording, and what is there stays good', async () => {
  bare.setTimeout(90_000);
  const disk = mkdtempSync(join(tmpdir(), 'disk-'));
  execFileSync('mount', ['-t', 'tmpfs', '-o', 'size=256m', 'tmpfs', disk]);
  try {
    const context = await launch(join(disk, 'profile'));
    const page = context.pages()[0];
    await demo(page);
    await record(page);
    await page.waitForTimeout(1_500);
    // To the last byte.
    execFileSync('bash', ['-c', `cat /dev/zero >${disk}/filler 2>/dev/null || true`]);
    await expect(at(page, 'record-fault')).toContainText('The recording has ended: ');
    await expect(at(page, 'record-fault')).toContainText('is kept');
    await expectLink(page, 'reading');
    rmSync(join(disk, 'filler'));
    folder = mkdtempSync(join(tmpdir(), 'recordings-'));
    const packets = wireshark(await saved(page, at(page, 'save').first()));
    expect(packets.length).toBeGreaterThan(500);
    await at(page, 'replay').first().click();
    await play(page, 'at once');
    await ended(page);
    await until(page, 'frames-ok', (frames) => frames > 250);
    await expect(at(page, 'replay-lost')).toHaveCount(0);
    await context.close();
  } finally {
    execFileSync('umount', ['--lazy', disk]);
  }
});

bare('killing the browser in the middle of a recording takes a second at most', async () => {
  bare.setTimeout(90_000);
  const profile = mkdtempSync(join(tmpdir(), 'profile-'));
  try {
    const first = await launch(profile);
    const page = first.pages()[0];
    await demo(page);
    await record(page);
    await page.waitForTimeout(3_000);
    // Every process of the browser, at once.
    const ids = execFileSync('pgrep', ['-f', profile], { encoding: 'utf8' }).split('\n').filter(Boolean);
    expect(ids.length).toBeGreaterThan(1);
    const killed = Date.now() / 1000;
    execFileSync('kill', ['-KILL', ...ids]);
    await first.close().catch(() => {});

    const second = await launch(profile);
    const again = second.pages()[0];
    await again.goto('/');
    await expect(at(again, 'remains')).toContainText('was cut off');
    const path = join(profile, 'saved.pcapng');
    const [download] = await Promise.all([again.waitForEvent('download'), at(again, 'remains-save').click()]);
    await download.saveAs(path);
    const packets = wireshark(path).filter(({ event }) => event !== END);
    const lost = killed - packets.at(-1).time;
    bare.info().annotations.push({ type: 'lost', description: `${lost.toFixed(2)} s` });
    expect(lost).toBeLessThan(1);
    expect(packets.at(-1).time - packets[0].time).toBeGreaterThan(2);
    // It is offered once.
    await expect(at(again, 'remains')).toHaveCount(0);
    await again.reload();
    await until(again, 'angle', (angle) => angle > 0);
    await again.waitForTimeout(2_000);
    await expect(at(again, 'remains')).toHaveCount(0);
    await second.close();
  } finally {
    rmSync(profile, { recursive: true, force: true });
  }
});
