// What was measured on the page as a table; with --write it goes into docs/performance.md.
import { readFile, writeFile } from 'node:fs/promises';
import { recorded } from './measured.js';

const lines = [
  '| | what | limit | measured | |',
  '|---|---|--:|---|---|',
  ...recorded().map(({ area, what, limit, measured, met }) => `| ${area} | ${what} | ${limit} | ${measured} | ${met ? 'met' : 'missed'} |`),
];
console.log(lines.join('\n'));

if (process.argv.includes('--write')) {
  const path = 'docs/performance.md';
  const [start, end] = ['<!-- measured on the page -->', '<!-- end of measured on the page -->'];
  const text = await readFile(path, 'utf8');
  const [before, rest] = text.split(start);
  await writeFile(path, `${before}${start}\n\n${lines.join('\n')}\n\n${end}${rest.split(end)[1]}`);
}
