// What was measured, as Markdown that is also legible in a terminal.

const COLUMNS = [
  ['native', 'native'],
  ['wasm', 'WASM'],
  ['idiomatic', 'idiomatic JS'],
  ['tuned', 'tuned JS'],
  ['kaitai', 'Kaitai'],
  ['construct', 'construct'],
  ['limit-sum', 'sum bytes'],
  ['limit-memcpy', 'memcpy'],
];

const TITLES = Object.fromEntries(COLUMNS);

/** A number in about two digits, and no exponent. */
export function short(value) {
  if (value >= 10) return value.toFixed(0);
  if (value >= 1) return value.toFixed(1);
  return value.toFixed(Math.min(6, 1 - Math.floor(Math.log10(value))));
}

/** The cells of the table, its head first. */
export function rows(workloads, rates) {
  const head = ['GB/s (of native)', ...COLUMNS.map(([, title]) => title)];
  const body = workloads.map(({ name, title }) => [
    title,
    ...COLUMNS.map(([side]) => {
      const rate = rates[name][side];
      if (!rate) return '–';
      const speed = short(rate / 1e9);
      return side === 'native' ? speed : `${speed} (${short(rate / rates[name].native)})`;
    }),
  ]);
  return [head, ...body];
}

/** The lines of a table, in columns. */
export function table([head, ...body]) {
  const widths = head.map((_, column) => Math.max(...[head, ...body].map((row) => row[column].length)));
  const line = (row) => `| ${row.map((cell, column) => (column ? cell.padStart(widths[column]) : cell.padEnd(widths[column]))).join(' | ')} |`;
  const rule = `|${widths.map((width, column) => '-'.repeat(width + 1) + (column ? ':' : '-')).join('|')}|`;
  return [line(head), rule, ...body.map(line)];
}

/** What has no column. */
export function sentences({ rates, stray, growth }) {
  const { period } = rates;
  const times = growth.map((step) => ['native', 'wasm'].map((side) => 1e9 / step[side]));
  const spread = (side) => {
    const each = times.map((pair) => pair[side]);
    return `${short(Math.min(...each))} to ${short(Math.max(...each))} ns`;
  };
  return [
    `- WASM hands the readings of \`period\` over to JavaScript, as typed arrays, at ${short(period.taken / 1e9)} GB/s of input (${short(period.taken / period.wasm)} of leaving them in its columns); JavaScript adds bytes up at ${short(period.sum / 1e9)} GB/s.`,
    `- Kaitai Struct that parses the file of \`period\` at once, not in chunks of 64 kB, reads ${short(period['kaitai-file'] / 1e9)} GB/s.`,
    `- In noise the loop in JavaScript takes ${stray.loop} frames for good, the core ${stray.core}.`,
    `- A byte of \`period\` takes ${spread(0)} natively and ${spread(1)} in WASM, whatever the length.`,
  ];
}

/** Each aim, and whether it was met. */
export function targets({ rates }) {
  const { period } = rates;
  const aim = (what, value, least) => `| ${what} | ${short(least)} | ${short(value)} | ${value >= least ? 'met' : 'missed'} |`;
  const beside = ['wasm', 'native'].flatMap((side) => {
    const to = (what, other, least) => aim(`\`period\`, ${TITLES[side]} to ${what}`, period[side] / period[other], least);
    return [
      to('idiomatic JS', 'idiomatic', 10),
      to('tuned JS', 'tuned', 1),
      to('Kaitai', 'kaitai', 20),
      to('Kaitai, whole file', 'kaitai-file', 20),
    ];
  });
  const others = Object.entries(rates).filter(([name]) => name !== 'period');
  return [
    '| aim | at least | measured | |',
    '|---|--:|--:|---|',
    aim('`period`, native, GB/s', period.native / 1e9, 1),
    aim('`period`, WASM to native', period.wasm / period.native, 0.4),
    ...beside,
    ...others.map(([name, each]) => aim(`\`${name}\`, native, to \`period\``, each.native / period.native, 1 / 3)),
  ];
}
