// What the measurements of the page share.
import { readFileSync } from 'node:fs';
import { Records } from '../records.js';

const records = new Records('bench/page');

/** Writes a line of the table: what was measured, the limit as text, the value as text, and whether it is met. */
export const record = (area, what, limit, measured, met) => {
  records.keep(`${area}-${what}`, { area, what, limit, measured, met });
  console.log(`${area}: ${what}: ${measured} (${limit}) ${met ? 'met' : 'missed'}`);
};

/** All lines, in the order in which they were measured. */
export const recorded = () => records.kept();

/** The processes of the browser's renderers. */
const ofRenderers = async (browser) => {
  const session = await browser.newBrowserCDPSession();
  const { processInfo } = await session.send('SystemInfo.getProcessInfo');
  await session.detach();
  return processInfo.filter(({ type }) => type === 'renderer').map(({ id }) => id);
};

/** Resident memory of the browser's renderers, in bytes. */
export const resident = async (browser) => {
  const kilobytes = (await ofRenderers(browser)).map((id) =>
    Number(/^RssAnon:\s*(\d+)/m.exec(readFileSync(`/proc/${id}/status`, 'utf8'))?.[1] ?? 0),
  );
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

/** Seconds of processor time that the main thread of a process has had. */
const processor = (id) => {
  const stat = readFileSync(`/proc/${id}/task/${id}/stat`, 'utf8');
  const [user, system] = stat.slice(stat.lastIndexOf(')') + 2).split(' ').slice(11, 13);
  return (Number(user) + Number(system)) / 100;
};

/**
 * The share of the time in which the main thread was busy, between two looks: the processor time it took,
 * and how long its tasks lasted, waiting for a processor included.
 */
export class Busy {
  static async begin(page, browser) {
    const busy = new Busy();
    busy.session = await page.context().newCDPSession(page);
    await busy.session.send('Performance.enable', { timeDomain: 'timeTicks' });
    const renderers = await ofRenderers(browser);
    busy.id = renderers.sort((one, other) => processor(other) - processor(one))[0];
    busy.before = await busy.look();
    return busy;
  }

  async look() {
    const { metrics } = await this.session.send('Performance.getMetrics');
    const of = (name) => metrics.find((metric) => metric.name === name).value;
    return { tasks: of('TaskDuration'), at: of('Timestamp'), processor: processor(this.id) };
  }

  async shares() {
    const now = await this.look();
    const share = (of) => (now[of] - this.before[of]) / (now.at - this.before.at);
    return { processor: share('processor'), tasks: share('tasks') };
  }
}

export const percent = (share) => `${(share * 100).toFixed(1)} %`;
