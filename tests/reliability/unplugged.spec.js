// The plug pulled in every state of every guided setting: when a command has been heard and its
// answer is still to come, and when the answer has been read, for each command until the sequence
// gets through.
import { Encoder, options } from '../page/encoder.js';
import { at, connect, expect, expectAllAccounted, expectLink, number, test, until } from '../page/page.js';
import { spy } from '../page/spy.js';
import { SETTINGS } from './settings.js';
import { records } from './trial.js';

let encoder;
test.afterEach(async () => {
  await encoder?.unplug();
  encoder = undefined;
});

const plug = async (query) => {
  encoder = await Encoder.start(...options(query), 'still=5.25', 'error=1');
};

/** Reads on, and sends nothing by itself that changes an encoder. */
const expectReadingOn = async (page) => {
  await expectLink(page, 'reading');
  const frames = await number(page, 'frames-ok');
  await until(page, 'frames-ok', (now) => now > frames + 100);
  expect((await encoder.tell()).changing).toBe(0);
};

const outcome = async (page) => {
  const ended = at(page, 'zero-outcome');
  await expect(ended).toBeVisible({ timeout: 15_000 });
  return { value: await ended.getAttribute('data-value'), text: await ended.textContent() };
};

/** Whether the words say what the encoder may hold. */
const HOLDS = /nothing has changed|the change was made|may have acted or not|Nothing was sent/;

for (const { setting, query, open, made } of SETTINGS) {
  for (const moment of ['heard', 'answered']) {
    test(`unplugged when a command is ${moment}: ${setting} @serial`, async ({ page }) => {
      test.setTimeout(600_000);
      await spy(page);
      await plug(query);
      await connect(page, query);
      await expectReadingOn(page);
      const outcomes = { no: 0, unknown: 0, yes: 0 };
      let states = 0;
      for (;;) {
        await open(page);
        encoder.set(`unplug-${moment}=${states + 1}`);
        await at(page, 'zero-confirm').click();
        const { value, text } = await outcome(page);
        if (text.startsWith('Done')) break;
        // A machine that is busy for long answers too late, and the sequence stops by itself: that
        // state is tried once more.
        const pulled = await Promise.race([
          encoder.ended.then(() => true),
          page.waitForTimeout(2_000).then(() => false),
        ]);
        const held = await encoder.unplug();
        await expectLink(page, 'lost');
        await expectAllAccounted(page);
        const said = `${moment} ${states + 1}: ${value}, ${text}; ${JSON.stringify({ ...held, memory: undefined })}`;
        expect(text, said).toMatch(HOLDS);
        // What is said to be so is so.
        if (value !== 'unknown') expect(made(held), said).toBe(value === 'yes');
        states += Number(pulled);
        outcomes[value] += Number(pulled);
        await page.getByRole('button', { name: 'Done' }).click();
        await plug(query);
        await page.evaluate(() => navigator.serial.dispatchEvent(new Event('connect')));
        await expectReadingOn(page);
      }
      // As many as the sequence has commands, and before it those of a scan.
      const total = await page.evaluate(() => window.spied.total);
      console.log(`${setting}, ${moment}: ${states} states, ${total} commands, ${JSON.stringify(outcomes)}`);
      expect(total).toBeGreaterThan(0);
      expect(states).toBeGreaterThanOrEqual(total);
      // Once the encoder may have acted, and nobody knows.
      expect(outcomes.unknown).toBeGreaterThan(0);
      records.keep(`unplugged-${setting}-${moment}`, { setting, moment, states, total, outcomes });
    });
  }
}
