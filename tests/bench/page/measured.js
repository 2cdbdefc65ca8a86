// What the measurements of the page share.
import { mkdirSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';

const folder = new URL('../../../target/bench/page/', import.meta.url).pathname;

/** Writes a line of the table: what was measured, the limit as text, the value as text, and whether it is met. */
export const record = (area, what, limit, measured, met) => {
  mkdirSync(folder, { recursive: true });
  const name = `${area}-${what}`.replace(/[^a-z0-9]+/gi, '-').toLowerCase();
  writeFileSync(`${folder}${name}.json`, JSON.stringify({ area, what, limit, measured, met, at: Date.now() }));
  console.log(`${area}: ${what}: ${measured} (${limit}) ${met ? 'met' : 'missed'}`);
};

/** All lines, in the order in which they were measured. */
export const recorded = () =>
  readdirSync(folder)
    .filter((name) => name.endsWith('.json'))
    .map((name) => JSON.parse(readFileSync(`${folder}${name}`, 'utf8')))
    .sort((one, other) => one.at - other.at);

/** Resident memory of the browser's renderers, in bytes. */
export const resident = async (browser) => {
  const session = await browser.newBrowserCDPSession();
  const { processInfo } = await session.send('SystemInfo.getProcessInfo');
  await session.detach();
  const kilobytes = processInfo
    .filter(({ type }) => type === 'renderer')
    .map(({ id }) => Number(/^RssAnon:\s*(\d+)/m.exec(readFileSync(`/proc/${id}/status`, 'utf8'))?.[1] ?? 0));
  return kilobytes.reduce((sum, more) => sum + more, 0) * 1024;
};

/** Watches the page's main thread; what it returns tells the milliseconds of long tasks, and the frames drawn. */
export const watch = (page) =>
  page.evaluate(() => {
    window.tasks = [];
    window.frames = [];
    new PerformanceObserver((list) => window.tasks.push(...list.getEntries().map(({ duration }) => duration))).observe({
      type: 'longtask',
    });
    const frame = (now) => {
      window.frames.push(now);
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  });

/** The share of the time in which the main thread did something, between two looks. */
export class Busy {
  static async begin(page) {
    const busy = new Busy();
    busy.session = await page.context().newCDPSession(page);
    await busy.session.send('Performance.enable', { timeDomain: 'timeTicks' });
    busy.before = await busy.look();
    return busy;
  }

  async look() {
    const { metrics } = await this.session.send('Performance.getMetrics');
    const of = (name) => metrics.find((metric) => metric.name === name).value;
    return { tasks: of('TaskDuration'), at: of('Timestamp'), heap: of('JSHeapUsedSize') };
  }

  async share() {
    const now = await this.look();
    return (now.tasks - this.before.tasks) / (now.at - this.before.at);
  }
}

export const percent = (share) => `${(share * 100).toFixed(1)} %`;
