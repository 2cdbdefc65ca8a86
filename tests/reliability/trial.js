// A trial: a format read under faults, what was seen of it, and the proof that nothing was lost or
// made up.
import { Records } from '../bench/records.js';
import { Encoder, options } from '../page/encoder.js';
import { bytes, connect, disconnect, expect, expectAllAccounted, expectLink, number, until } from '../page/page.js';
import { forget, seen } from '../page/spy.js';
import { FORMATS } from './formats.js';

export const records = new Records('reliability');

export class Trial {
  /** Reads a format, its shaft at rest. The page must have a spy. */
  static async begin(page, name) {
    const trial = new Trial();
    const format = FORMATS[name];
    // What the shaft has been at, what was sent by encoders that are unplugged, and frames that are
    // good though the encoder has not sent them as such.
    Object.assign(trial, { page, name, format, truths: [format.shows], before: { passing: 0, damaged: 0 }, extra: 0, mayLose: false });
    await trial.plug();
    await connect(page, format.query);
    await trial.listen();
    await forget(page);
    return trial;
  }

  /** Plugs an encoder in. A stream says nothing before the port is open: nobody would hear it. */
  async plug() {
    const { query, streams } = this.format;
    const quiet = streams ? ['silent=1'] : [];
    // Its turns stay without power.
    this.encoder = await Encoder.start(...options(query), 'counter=flash', 'still=5.5', ...quiet);
  }

  /** Lets an encoder speak whose port is open, and waits until it is read. */
  async listen() {
    if (this.format.streams) {
      await expectLink(this.page, 'silent');
      this.encoder.set('silent=0');
    }
    await this.expectRead();
  }

  /** Reads the shaft as it is now. */
  async expectRead() {
    await expectLink(this.page, 'reading');
    await until(this.page, 'angle', (now) => now === this.truths.at(-1).angle);
  }

  /** Pulls the plug; every byte that came is accounted for. */
  async unplug() {
    const { passing, damaged } = await this.encoder.unplug();
    this.before = { passing: this.before.passing + passing, damaged: this.before.damaged + damaged };
    await expectLink(this.page, 'lost');
    await expectAllAccounted(this.page);
  }

  /** The browser says that it is back; what was set in the encoder before is as it was. */
  async replug() {
    await this.plug();
    this.truths.push(this.format.shows);
    await this.page.evaluate(() => navigator.serial.dispatchEvent(new Event('connect')));
    await this.listen();
  }

  isTrue(reading) {
    return this.truths.some(
      ({ angle, turns }) => reading.angle === angle && (reading.turns ?? null) === (turns ?? null),
    );
  }

  /**
   * Ends the trial: reads on, then every byte that was sent has come and is accounted for, and no
   * more was shown for good than was sent so, or cannot be told from it.
   */
  async end() {
    const { page, encoder, format, before, extra } = this;
    const { shown, states } = await seen(page);
    await this.expectRead();
    encoder.set('silent=1');
    // What is on its way still comes.
    await page.waitForTimeout(300);
    let told;
    const missing = async () => {
      told = await encoder.tell();
      return told.sent - (await bytes(page)).all;
    };
    await expect.poll(missing, { message: 'bytes that have not come' }).toBe(0);
    await disconnect(page);
    const good = await number(page, 'frames-ok');
    const all = await expectAllAccounted(page);
    expect(all).toBe(told.sent);
    if (!this.mayLose || !format.streams) expect(told.unread).toBe(0);
    const most = (passing, damaged) => passing + Math.ceil(damaged * (format.passes ?? 0));
    expect(good, 'good frames').toBeLessThanOrEqual(told.whole + extra + most(told.passing, told.damaged));
    const passing = told.passing + before.passing;
    const damaged = told.damaged + before.damaged;
    const wrong = shown.filter((reading) => !reading.error && !this.isTrue(reading));
    expect(wrong.length, JSON.stringify(wrong)).toBeLessThanOrEqual(most(passing, damaged));
    return { states, good, wrong: wrong.length, all, whole: told.whole, changing: told.changing, damaged, passing };
  }

  /** Ends the trial of a row of the matrix, in which nothing that changes an encoder is sent. */
  async record(fault) {
    const figures = await this.end();
    console.log(`${fault}, ${this.name}: ${JSON.stringify(figures)}`);
    expect(figures.changing).toBe(0);
    records.keep(`matrix-${fault}-${this.name}`, { fault, name: this.name, ...figures });
    return figures;
  }

  async close() {
    await this.encoder.unplug();
  }
}
