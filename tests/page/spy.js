// What the engine says to a page, and what the page shows of it.

/** Lets a page remember: `window.spied`. */
export const spy = (page) =>
  page.addInitScript(() => {
    const spied = { engine: null, latest: null, posted: 0, wanted: 0, total: 0, shown: [], states: {} };
    window.spied = spied;
    /** A reading that is not the one before it. */
    const show = (reading) => {
      const last = spied.shown.at(-1);
      if (!reading || (last?.angle === reading.angle && last?.turns === reading.turns)) return;
      spied.shown.push({ angle: reading.angle, turns: reading.turns, error: reading.error });
    };
    const Real = window.Worker;
    window.Worker = class extends Real {
      constructor(...words) {
        super(...words);
        spied.engine = this;
        this.addEventListener('message', ({ data }) => {
          show(data.Reading);
          if (!data.Snapshot) return;
          spied.latest = data.Snapshot;
          spied.posted += 1;
          spied.total = data.Snapshot.progress?.total || spied.total;
          show(data.Snapshot.reading);
        });
      }

      postMessage(message) {
        if (message === 'Next') spied.wanted += 1;
        super.postMessage(message);
      }
    };
    setInterval(() => {
      const state = document.querySelector('[data-testid="link-state"] p')?.textContent;
      spied.states[state] = (spied.states[state] ?? 0) + 1;
    }, 50);
  });

/** Forgets what was seen up to now. */
export const forget = (page) =>
  page.evaluate(() => {
    window.spied.shown = [];
    window.spied.states = {};
  });

/** Every reading shown that differs from the one before it, and how often each state of the link was seen. */
export const seen = (page) =>
  page.evaluate(() => ({ shown: window.spied.shown, states: window.spied.states }));
