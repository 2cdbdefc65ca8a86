// What was measured under faults as the tables of docs/reliability.md.
import { put } from '../bench/document.js';
import { ALL } from './formats.js';
import { records } from './trial.js';

const kept = records.kept();
const page = 'docs/reliability.md';
const grouped = (number) => `${number}`.replace(/\B(?=(\d{3})+$)/g, ' ');

/** The rows that share what `of` says of them, in the order of the first of each. */
const groups = (rows, of) => {
  const found = new Map();
  for (const row of rows) found.set(of(row), [...(found.get(of(row)) ?? []), row]);
  return [...found];
};

/** What the page said, and for how much of the time where it said several things. */
const said = (rows) => {
  const shares = new Map();
  for (const { states } of rows) {
    const all = Object.values(states).reduce((sum, count) => sum + count, 0);
    for (const [state, count] of Object.entries(states)) {
      if (state === 'undefined') continue;
      shares.set(state, [...(shares.get(state) ?? []), Math.round((count / all) * 100)]);
    }
  }
  const range = (each) => {
    const [least, most] = [each.length < rows.length ? 0 : Math.min(...each), Math.max(...each)];
    return least === most ? `${most} %` : `${least}–${most} %`;
  };
  const texts = [...shares].map(([state, each]) => `${state} ${range(each)}`);
  return shares.size === 1 ? [...shares.keys()][0] : texts.join('; ');
};

const cell = (row) => {
  if (!row) return '–';
  const { good, whole, wrong, damaged, passing } = row;
  const found = `${grouped(good)}/${grouped(whole)}`;
  return damaged > 0 ? `${found}, ${wrong} of ${grouped(damaged)} (${passing})` : found;
};

const matrix = kept.filter(({ fault }) => fault);
await put(page, 'matrix', [
  `| fault | what the page says | ${ALL.map((name) => `\`${name}\``).join(' | ')} |`,
  `|---|---|${'--:|'.repeat(ALL.length)}`,
  ...groups(matrix, ({ fault }) => fault).map(([fault, rows]) => {
    const cells = ALL.map((name) => cell(rows.find((row) => row.name === name)));
    return `| ${fault} | ${said(rows)} | ${cells.join(' | ')} |`;
  }),
  '',
  `${grouped(matrix.reduce((sum, { all }) => sum + all, 0))} bytes in ${matrix.length} runs: every byte that was sent came, and is in a frame, skipped, or beside reading.`,
]);

const unplugged = kept.filter(({ setting }) => setting);
const outcome = (rows, name) => rows.reduce((sum, { outcomes }) => sum + outcomes[name], 0);
await put(page, 'unplugged', [
  '| setting | commands | states | nothing has changed | may have acted or not | the change was made | “Done” |',
  '|---|--:|--:|--:|--:|--:|--:|',
  ...groups(unplugged, ({ setting }) => setting).map(([setting, rows]) => {
    const states = rows.reduce((sum, row) => sum + row.states, 0);
    const each = ['no', 'unknown', 'yes'].map((name) => outcome(rows, name));
    return `| ${setting} | ${rows[0].total} | ${states} | ${each.join(' | ')} | 0 |`;
  }),
]);

const [soak] = kept.filter(({ soak }) => soak);
await put(page, 'soak', soak ? soak.soak : ['Not run.']);
