// What was measured on the page as a table; with --write it goes into docs/performance.md.
import { put } from '../document.js';
import { recorded } from './measured.js';

const lines = [
  '| | what | limit | measured | |',
  '|---|---|--:|---|---|',
  ...recorded().map(({ area, what, limit, measured, met }) => `| ${area} | ${what} | ${limit} | ${measured} | ${met ? 'met' : 'missed'} |`),
];
console.log(lines.join('\n'));

if (process.argv.includes('--write')) await put('docs/performance.md', 'measured on the page', lines);
