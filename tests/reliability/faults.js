// The matrix: every fault as a row. `meanwhile` lets it happen; `sees` is what the page must say
// meanwhile, whatever else it says. Rows that are `final` leave a page that is not as before.
import { freeze, hide, jump, sleep, unhide } from '../page/away.js';
import { at, expect, expectLink, number, until } from '../page/page.js';
import { ALL, POLLED } from './formats.js';

const READING = ['Reading'];
const SECONDS = 3;
const AWAY = 3_000;

/** Sets a fault for a while. */
const faulty = (settings) => async ({ page, encoder }) => {
  for (const setting of settings) encoder.set(setting);
  await page.waitForTimeout(SECONDS * 1_000);
  for (const setting of settings) encoder.set(setting.replace(/=.*/, '=0'));
};

const noise = [1, 5, 20].map((percent) => ({
  fault: `${percent} % of the bytes with a bit turned over`,
  settings: [`flip=${percent * 10}`],
}));

const late = [0, 5, 20, 50, 100, 150, 200].map((milliseconds) => ({
  fault: `replies late by ${milliseconds} ms`,
  settings: [`delay=${milliseconds * 1000}`],
  formats: POLLED,
}));

/** What goes wrong on the line. */
export const FAULTS = [
  { fault: 'none', settings: [] },
  ...noise,
  { fault: '2 % of the bytes dropped', settings: ['drop=20'] },
  { fault: '2 % of the bytes doubled', settings: ['double=20'] },
  { fault: '2 % of the bytes followed by a stray one', settings: ['insert=20'] },
  { fault: 'the adapter echoes', settings: ['echo=1'], formats: POLLED },
  ...late,
  { fault: 'replies late by 0 to 200 ms, at random', settings: ['jitter=200000'], formats: POLLED },
  { fault: 'a reply in ten lost', settings: ['lose=100'], formats: POLLED },
  { fault: 'a reply in ten comes twice', settings: ['twice=100'], formats: POLLED },
  { fault: 'silence', settings: ['silent=1'], sees: ['No answer'] },
].map(({ settings, ...row }) => ({ formats: ALL, sees: READING, meanwhile: faulty(settings), ...row }));

/** Reads on: more good frames have come. */
const expectMore = async (page) => {
  const frames = await number(page, 'frames-ok');
  await until(page, 'frames-ok', (now) => now > frames + 50);
};

const boots = [4, 7, 64].map((zeros) => ({
  fault: `power off and on, ${zeros} zero bytes before the first frame`,
  sees: ['No answer', 'Reading'],
  meanwhile: async (trial) => {
    const { page, encoder, format } = trial;
    trial.extra += format.zeros ? Math.floor(zeros / format.zeros) : 0;
    encoder.set(`zeros=${zeros}`);
    encoder.set('power=off');
    await expectLink(page, 'silent');
    encoder.set('power=on');
    await expectLink(page, 'reading');
    await expectMore(page);
  },
}));

/** Ends the worker in a way; the page says so, and reads on when it is told to. */
const deaths = [
  ['breaks down', () => setTimeout(() => { throw new Error('a test breaks the worker down'); })],
  ['is ended without a word', () => self.close()],
].map(([how, end]) => ({
  fault: `the worker ${how}`,
  formats: ['t485', 'period'],
  sees: ['No port', 'Reading'],
  final: true,
  meanwhile: async (trial) => {
    const { page } = trial;
    await page.workers()[0].evaluate(end);
    await expect(at(page, 'link-state')).toHaveAttribute('data-value', 'broke-down', { timeout: 30_000 });
    await expect(page.getByRole('alert')).toContainText('Connect again');
    await trial.encoder.unplug();
    await trial.plug();
    await at(page, 'connect').click();
    await trial.listen();
    await expectMore(page);
  },
}));

/** What happens to the encoder, the plug, the page and its machine. */
export const EVENTS = [
  ...boots,
  {
    fault: 'unplugged while reading, and plugged in again, three times',
    sees: ['The port is gone', 'Reading'],
    meanwhile: async (trial) => {
      for (let time = 0; time < 3; time += 1) {
        await trial.unplug();
        await trial.page.waitForTimeout(300);
        await trial.replug();
        await expectMore(trial.page);
      }
    },
  },
  {
    fault: 'hidden tab, which draws nothing for 3 s',
    meanwhile: async ({ page }) => {
      await hide(page);
      await page.waitForTimeout(AWAY);
      await unhide(page);
      await expectMore(page);
    },
  },
  {
    fault: 'frozen tab, 3 s',
    meanwhile: async ({ page }) => {
      await freeze(page, AWAY);
      await expectMore(page);
    },
  },
  {
    fault: 'sleep: nothing runs for 3 s',
    meanwhile: async (trial) => {
      // A stream goes on into buffers, which may become full.
      trial.mayLose = true;
      await sleep(trial.page, AWAY);
      await expectMore(trial.page);
    },
  },
  {
    fault: 'sleep: the clock jumps by an hour',
    final: true,
    meanwhile: async ({ page }) => {
      await jump(page, 3_600_000);
      await page.waitForTimeout(1_000);
      await expectMore(page);
    },
  },
  ...deaths,
].map((row) => ({ formats: ALL, sees: READING, ...row }));
