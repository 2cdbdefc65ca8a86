// The page at a port: how fast it asks, and a line that is full for minutes.
import { Encoder } from '../../page/encoder.js';
import { at, expect, expectLink, number, test } from '../../page/page.js';
import { Busy, percent, record, resident, watch } from './measured.js';

let encoder;
test.afterEach(async () => {
  await encoder?.unplug();
  encoder = undefined;
});

/** A loop that writes a request and reads until its reply is whole, in the worker that has the port otherwise. */
const bareLoop = (worker, seconds) =>
  worker.evaluate(async (seconds) => {
    const [port] = await navigator.serial.getPorts();
    await port.open({ baudRate: 2_500_000, bufferSize: 65_536 });
    const writer = port.writable.getWriter();
    const reader = port.readable.getReader();
    const request = new Uint8Array([0x1a]);
    let replies = 0;
    const start = performance.now();
    while (performance.now() < start + seconds * 1_000) {
      await writer.write(request);
      for (let missing = 11; missing > 0; ) missing -= (await reader.read()).value.length;
      replies += 1;
    }
    const rate = (replies / (performance.now() - start)) * 1_000;
    await reader.cancel();
    writer.releaseLock();
    reader.releaseLock();
    await port.close();
    return rate;
  }, seconds);

const middle = (values) => [...values].sort((one, other) => one - other)[values.length >> 1];

test('requests are answered as often as a bare loop would have it @serial', async ({ page }) => {
  const [rounds, seconds] = [5, 4];
  encoder = await Encoder.start('--format', 't485', '--angle-bits', '23', '--baud', '2500000', 'turning=0.2');
  await page.goto('/#/console?format=t485&angle-bits=23&baud=2500000');
  const ratios = [];
  const rates = [];
  for (let round = 0; round < rounds; round += 1) {
    await at(page, 'connect').click();
    await expectLink(page, 'reading');
    await page.waitForTimeout(1_000);
    const [before, since] = [await number(page, 'frames-ok'), Date.now()];
    await page.waitForTimeout(seconds * 1_000);
    const rate = ((await number(page, 'frames-ok')) - before) / ((Date.now() - since) / 1_000);
    await at(page, 'disconnect').click();
    await expectLink(page, 'closed');
    const bare = await bareLoop(page.workers()[0], seconds);
    ratios.push(rate / bare);
    rates.push([rate, bare].map(Math.round));
  }
  const ratio = middle(ratios);
  const text = `${ratio.toFixed(2)}: ${rates.map(([rate, bare]) => `${rate}/${bare}`).join(', ')} a second`;
  record('Live', 'requests answered, to a bare loop of JavaScript', '≥ 0.95', text, ratio >= 0.95);
});

test('a full line is read for minutes @serial', async ({ page, browser }) => {
  const minutes = Number(process.env.BENCH_MINUTES ?? 5);
  test.setTimeout(minutes * 60_000 + 120_000);
  // A frame of seven bytes takes 28 µs at 2.5 Mbaud.
  encoder = await Encoder.start(
    ...['--format', 'period', '--angle-bits', '24', '--baud', '2500000'],
    ...['turning=0.2', 'interval=28', 'patient=1'],
  );
  await page.goto('/#/console?format=period&angle-bits=24&baud=2500000');
  await at(page, 'connect').click();
  await expectLink(page, 'reading');
  await page.waitForTimeout(20_000);
  await watch(page);
  const busy = await Busy.begin(page, browser);
  const memory = [await resident(browser)];
  // What had waited in the pty came at its first baud rate, and is no frame.
  const lost = async () => (await number(page, 'bytes-skipped')) + (await number(page, 'frames-bad'));
  const [before, since, lostBefore] = [await number(page, 'bytes-in'), Date.now(), await lost()];
  for (let half = 0; half < minutes * 2; half += 1) {
    await page.waitForTimeout(30_000);
    memory.push(await resident(browser));
  }
  const rate = ((await number(page, 'bytes-in')) - before) / ((Date.now() - since) / 1_000);
  const gone = (await lost()) - lostBefore;
  const shares = await busy.shares();
  const { frames, tasks } = await page.evaluate(() => ({ frames: window.frames, tasks: window.tasks }));
  const drawn = (frames.length - 1) / ((frames.at(-1) - frames[0]) / 1_000);
  await at(page, 'disconnect').click();
  await expectLink(page, 'closed');
  const [all, framed, skipped, bad] = await Promise.all(
    ['bytes-in', 'bytes-framed', 'bytes-skipped', 'frames-bad'].map((id) => number(page, id)),
  );
  record('Live', 'a full line at 2.5 Mbaud, bytes a second', '≥ 245 000', rate.toFixed(0), rate >= 245_000);
  record('Live', `of ${(all / 1e6).toFixed(0)} MB, bytes skipped and frames bad`, '0', `${gone}`, gone === 0);
  record('Live', 'pictures a second', '≥ 59', drawn.toFixed(1), drawn >= 59);
  const busyText = `${percent(shares.processor)} of a processor; its tasks lasted ${percent(shares.tasks)} of the time`;
  record('Live', 'main thread busy', '< 20 %', busyText, shares.processor < 0.2);
  const longest = Math.max(0, ...tasks).toFixed(0);
  record('Live', 'longest task of the main thread', '< 50 ms', `${longest} ms`, longest < 50);
  const [first, last] = [memory[1], memory.at(-1)];
  const growth = last / first - 1;
  const text = `${percent(growth)}: ${memory.map((bytes) => (bytes / 1e6).toFixed(0)).join(', ')} MB each half minute`;
  record('Live', 'growth of the renderer’s memory', '< 10 %', text, growth < 0.1);
  expect(all - framed - skipped).toBeLessThan(64);
});
