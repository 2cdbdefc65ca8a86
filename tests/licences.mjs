// Whether everything that the program is made of, and built and tested with, has a licence that
// deny.toml allows and comes from the public registries, with a checksum; and whether
// docs/licences.md lists what is shipped. With --write it is written.
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';

const top = new URL('..', import.meta.url);
const read = (path) => readFileSync(new URL(path, top), 'utf8');
const wrong = [];

const allowed = new Set(
  /^\[licenses\][^[]*allow = \[(.*?)\]/ms
    .exec(read('deny.toml'))[1]
    .match(/"[^"]+"/g)
    .map((quoted) => quoted.slice(1, -1)),
);
// Of what only builds and tests, these too: nothing of it is in what is shipped.
const tools = new Set([...allowed, 'BlueOak-1.0.0', 'CC-BY-4.0', 'MPL-2.0']);
// The benches compare with it, as a program of its own.
const exceptions = new Map([['kaitai-struct-compiler', 'GPL-3.0-or-later']]);

/** Whether a set of licences satisfies an expression: OR binds less than AND; `/` is an old OR. */
const satisfies = (expression, licences) => {
  const tokens = (expression ?? '').replaceAll('/', ' OR ').match(/[()]|[^\s()]+/g) ?? [];
  let at = 0;
  const one = () => {
    if (tokens[at] === '(') {
      at += 1;
      const holds = either();
      at += 1;
      return holds;
    }
    const name = [tokens[at++]];
    while (tokens[at] === 'WITH') name.push(tokens[at++], tokens[at++]);
    return licences.has(name.join(' '));
  };
  const both = () => {
    let holds = one();
    while (tokens[at] === 'AND') {
      at += 1;
      holds = one() && holds;
    }
    return holds;
  };
  const either = () => {
    let holds = both();
    while (tokens[at] === 'OR') {
      at += 1;
      holds = both() || holds;
    }
    return holds;
  };
  return tokens.length > 0 && either();
};

const check = ({ name, version, licence }, licences) => {
  if (exceptions.get(name) === licence || satisfies(licence, licences)) return;
  wrong.push(`${name} ${version}: ${licence ?? 'no licence'} is not allowed`);
};

/** The crates that a `cargo tree` has, without those of this repository. */
const crates = (...words) =>
  execFileSync('cargo', ['tree', '--locked', '--prefix', 'none', '--no-dedupe', '--format', '{p}|{l}', ...words], {
    cwd: top,
    encoding: 'utf8',
    stdio: ['ignore', 'pipe', 'inherit'],
    maxBuffer: 1e8,
  })
    .split('\n')
    .map((line) => /^(\S+) v(\S+?)(?: \(proc-macro\))?\|(.*)$/.exec(line))
    .filter(Boolean)
    .map(([, name, version, licence]) => ({ name, version, licence }));

const wasm = ['--target', 'wasm32-unknown-unknown'];
const shippedCrates = crates('-p', 'encoderscope-web', ...wasm, '--edges', 'normal,no-proc-macro');
for (const crate of shippedCrates) check(crate, allowed);
for (const target of [[], wasm]) for (const crate of crates('--workspace', ...target)) check(crate, tools);

const PUBLIC = 'registry+https://github.com/rust-lang/crates.io-index';
for (const entry of read('Cargo.lock').split('[[package]]').slice(1)) {
  const value = (key) => new RegExp(`^${key} = "(.*)"$`, 'm').exec(entry)?.[1];
  const source = value('source');
  const mine = source === undefined && value('name').startsWith('encoderscope');
  if (!mine && (source !== PUBLIC || !value('checksum'))) {
    wrong.push(`${value('name')}: ${source ?? 'no source'}, checksum ${value('checksum')}`);
  }
}

const packages = Object.entries(JSON.parse(read('package-lock.json')).packages)
  .filter(([path]) => path)
  .map(([path, entry]) => ({ ...entry, name: path.replace(/.*node_modules\//, ''), licence: entry.license }));
// The service worker is made of Workbox, which is a tool as far as npm knows.
const isShipped = ({ name, dev }) => !dev || /^workbox-(core|precaching|routing|strategies)$/.test(name);
for (const found of packages) {
  check(found, isShipped(found) ? allowed : tools);
  // npm leaves out where it has a package from where that is its own registry.
  if (!/^(https:\/\/registry\.npmjs\.org\/|$)/.test(found.resolved ?? '') || !found.integrity) {
    wrong.push(`${found.name}: from ${found.resolved}, integrity ${found.integrity}`);
  }
}

const rows = (list) =>
  [...new Set(list.map(({ name, version, licence }) => `| ${name} | ${version} | ${licence.replaceAll('/', ' OR ')} |`))]
    .sort((one, two) => (one < two ? -1 : 1))
    .join('\n');
const head = '| name | version | licence |\n|---|---|---|';
const table = `# Licences

What the page, its workers, the JavaScript module and the custom element are made of, beside this
repository's own code. \`node tests/licences.mjs --write\` writes it; \`make test\` compares.

## Rust

What the linker may take code from; of many it takes none.

${head}
${rows(shippedCrates)}

## JavaScript

${head}
${rows(packages.filter(isShipped))}
`;

const path = 'docs/licences.md';
if (process.argv.includes('--write')) writeFileSync(new URL(path, top), table);
else if (read(path) !== table) wrong.push(`${path} is out of date: node tests/licences.mjs --write`);

for (const line of new Set(wrong)) console.error(line);
console.log(`${new Set(shippedCrates.map(({ name }) => name)).size} crates and ${packages.filter(isShipped).length} packages are shipped.`);
process.exitCode = wrong.length ? 1 : 0;
