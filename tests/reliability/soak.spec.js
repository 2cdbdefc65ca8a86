// Mixed traffic with faults, for as long as SOAK_SECONDS says; SOAK_SEED repeats a run.
import { hideable } from '../page/away.js';
import { at, expect, test } from '../page/page.js';
import { forget, spy } from '../page/spy.js';
import { Busy, percent, resident } from '../bench/page/measured.js';
import { EVENTS, FAULTS } from './faults.js';
import { ALL } from './formats.js';
import { Trial, records } from './trial.js';

const seconds = Number(process.env.SOAK_SECONDS ?? 300);
const seed = Number(process.env.SOAK_SEED ?? Date.now() % 2 ** 31);
/** A format is read for so many faults, then another one. */
const ACTS = 4;
/** So much may what the page holds grow over the second half, which is what is left of the noise. */
const GROWTH = 0.1;
/** So many times as busy may its main thread be in the last quarter as in the first. */
const BUSIER = 1.5;

/** Numbers from 0 to 1, the same for the same seed (mulberry32). */
const chances = (state) => () => {
  state = (state + 0x6d2b79f5) | 0;
  let mixed = Math.imul(state ^ (state >>> 15), state | 1);
  mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
  return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
};

const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;

/** How much a line through the values rises from their first to their last, to their mean. */
const rise = (values) => {
  const middle = (values.length - 1) / 2;
  const average = mean(values);
  const product = values.reduce((sum, value, index) => sum + (index - middle) * (value - average), 0);
  const square = values.reduce((sum, _, index) => sum + (index - middle) ** 2, 0);
  return ((product / square) * (values.length - 1)) / average;
};

const megabytes = (bytes) => (bytes / 1e6).toFixed(1);

/** A setting that the encoder has, made: what it shows then. */
const SETTINGS = {
  rs485: { angle: 0, turns: 0 },
  bus: { angle: 0, turns: 0 },
  t485: { angle: 0, turns: 5 },
};

const set = async (trial) => {
  const { page, name } = trial;
  await at(page, 'zero-start').click();
  const outcome = at(page, 'zero-outcome');
  // After a fault the gate may close once more, just before the click.
  await expect(async () => {
    const confirm = at(page, 'zero-confirm');
    if (await confirm.isVisible()) await confirm.click({ timeout: 5_000 });
    await expect(outcome).toBeVisible({ timeout: 10_000 });
  }).toPass({ timeout: 60_000 });
  const made = (await outcome.getAttribute('data-value')) === 'yes';
  // A machine that is busy for long answers too late.
  if (made) trial.truths.push(SETTINGS[name]);
  else await expect(outcome).toContainText('nothing has changed');
  await page.getByRole('button', { name: 'Done' }).click();
  await trial.expectRead();
  return made;
};

let trial;
test.afterEach(async () => {
  await trial?.close();
  trial = undefined;
});

test('soak @serial', async ({ page, browser }) => {
  test.setTimeout(seconds * 1_000 + 180_000);
  console.log(`seed ${seed}, ${seconds} s`);
  const draw = chances(seed);
  const among = (list) => list[Math.floor(draw() * list.length)];
  const session = await page.context().newCDPSession(page);
  await session.send('Performance.enable');
  const heap = async () => {
    await session.send('HeapProfiler.collectGarbage');
    const { metrics } = await session.send('Performance.getMetrics');
    return metrics.find(({ name }) => name === 'JSHeapUsedSize').value;
  };
  await spy(page);
  await hideable(page);
  const sum = { legs: 0, acts: 0, settings: 0, tried: 0, bytes: 0, good: 0, whole: 0, damaged: 0, passing: 0, wrong: 0 };
  const samples = [];
  const begun = Date.now();
  const elapsed = () => (Date.now() - begun) / 1_000;
  let busy;
  const rows = [...FAULTS, ...EVENTS].filter(({ final }) => !final);
  const sample = async () => {
    samples.push({ at: elapsed(), heap: await heap(), resident: await resident(browser), ...(await busy.shares()) });
    busy.before = await busy.look();
    const { heap: held, resident: used, processor } = samples.at(-1);
    const text = [
      `${Math.round(elapsed())} s: ${JSON.stringify(sum)}`,
      `heap ${megabytes(held)} MB, renderer ${megabytes(used)} MB, main thread ${percent(processor)}`,
    ];
    console.log(text.join('; '));
  };
  const every = Math.min(60, seconds / 10);
  while (elapsed() < seconds) {
    const name = among(ALL);
    trial = await Trial.begin(page, name);
    await at(page, 'chart-angle').scrollIntoViewIfNeeded();
    const fitting = rows.filter(({ formats }) => formats.includes(name));
    for (let act = 0; act < ACTS && elapsed() < seconds; act += 1) {
      const { fault, meanwhile } = among(fitting);
      console.log(`${Math.round(elapsed())} s: ${name}: ${fault}`);
      await meanwhile(trial);
      await trial.expectRead();
      sum.acts += 1;
    }
    if (SETTINGS[name] && draw() < 0.5) {
      sum.tried += 1;
      sum.settings += Number(await set(trial));
    }
    const { good, whole, wrong, damaged, passing, all } = await trial.end();
    for (const [figure, more] of Object.entries({ good, whole, wrong, damaged, passing, bytes: all })) sum[figure] += more;
    sum.legs += 1;
    await trial.close();
    trial = undefined;
    await forget(page);
    expect(page.workers(), 'the worker').toHaveLength(1);
    // Its process is known by what it has done up to now.
    busy ??= await Busy.begin(page, browser);
    if (elapsed() >= every * (samples.length + 1)) await sample();
  }
  await sample();
  const half = samples.slice(Math.floor(samples.length / 2));
  const rises = { heap: rise(half.map(({ heap }) => heap)), resident: rise(half.map(({ resident }) => resident)) };
  const shares = samples.map(({ processor }) => processor);
  const quarter = Math.ceil(shares.length / 4);
  const busier = mean(shares.slice(-quarter)) / mean(shares.slice(0, quarter));
  const range = (values, write) => `${write(Math.min(...values))} to ${write(Math.max(...values))}`;
  const lines = [
    '| | |',
    '|---|---|',
    `| time, seed | ${Math.round(elapsed())} s, ${seed} |`,
    `| links opened, faults, guided settings | ${sum.legs}, ${sum.acts}, ${sum.settings} |`,
    `| bytes sent, and received and accounted for | ${sum.bytes} |`,
    `| replies sent whole, good frames | ${sum.whole}, ${sum.good} |`,
    `| replies damaged, that pass their check, wrong angles shown | ${sum.damaged}, ${sum.passing}, ${sum.wrong} |`,
    `| JavaScript heap of the page | ${range(samples.map(({ heap }) => heap), megabytes)} MB; over the second half ${percent(rises.heap)} |`,
    `| memory of the renderer: page, worker and WASM | ${range(samples.map(({ resident }) => resident), megabytes)} MB; over the second half ${percent(rises.resident)} |`,
    `| main thread | ${range(shares, percent)} of a processor; in the last quarter ${busier.toFixed(2)} times as much as in the first |`,
  ];
  console.log(lines.join('\n'));
  records.keep('soak', { soak: lines });
  expect(sum.settings, 'settings that were made').toBeGreaterThanOrEqual(sum.tried / 2);
  expect(rises.heap, 'growth of the heap').toBeLessThan(GROWTH);
  expect(rises.resident, 'growth of the renderer').toBeLessThan(GROWTH);
  expect(busier, 'main thread').toBeLessThan(BUSIER);
});
