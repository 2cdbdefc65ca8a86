// Every fault of the line, and what happens to a page, with every format, over real Web Serial.
import { hideable } from '../page/away.js';
import { expect, test } from '../page/page.js';
import { spy } from '../page/spy.js';
import { EVENTS, FAULTS } from './faults.js';
import { Trial } from './trial.js';

let trial;
test.afterEach(async () => {
  await trial?.close();
  trial = undefined;
});

for (const { fault, formats, sees, meanwhile } of [...FAULTS, ...EVENTS]) {
  for (const name of formats) {
    test(`${fault}: ${name} @serial`, async ({ page }) => {
      await spy(page);
      await hideable(page);
      trial = await Trial.begin(page, name);
      await meanwhile(trial);
      const { good, states } = await trial.record(fault);
      expect(good).toBeGreaterThan(0);
      expect(Object.keys(states)).toEqual(expect.arrayContaining(sees));
    });
  }
}
