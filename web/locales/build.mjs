// The texts of the page in other languages: `node web/locales/build.mjs` checks that each is there
// and writes web/pkg/LANGUAGE.json for the page.
//
// What is said stands in the source in English, in t("…"), msg("…"), said("…"), text!("…") and
// say!(out, "…"), and in t('…') of scripts (crate/src/language.rs). The docs of layout! and choice!
// are said too, as are the names of the rows. A file of this directory has English texts as names
// and the others as values; names.json may have names that only the tests know
// (tests/tests/language).
//
//   node web/locales/build.mjs --missing crate/src/detect      what has no translation, as JSON
import { mkdir, readFile, readdir, writeFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';

const top = fileURLToPath(new URL('../..', import.meta.url));
const SOURCES = ['crate/src', 'web/src', 'web/js'];
const LANGUAGES = ['ru'];
/** What is in a catalogue beside texts: the decimal mark. */
const MARK = '.';
const NAMES = 'names.json';
/** Where choice! has docs that nothing shows. */
const KINDS = 'crate/src/format/own/draft.rs';

const ESCAPES = { n: '\n', r: '\r', t: '\t', 0: '\0', '\\': '\\', '"': '"', "'": "'" };

/** What stands between the quotes of a string of Rust or JavaScript. */
const unescaped = (text) =>
  text.replace(/\\(?:\n\s*|u\{([0-9a-fA-F_]+)\}|x([0-9a-fA-F]{2})|(.))/g, (_, wide, byte, one) =>
    wide || byte ? String.fromCodePoint(parseInt(wide ?? byte, 16)) : one ? ESCAPES[one] : '',
  );

// Comments, characters and raw strings, so that nothing in them is taken for a string.
const RUST = /\/\/[^\n]*|\/\*[^]*?\*\/|r(#*)"[^]*?"\1|b?'(?:\\[^]+?|[^\\'])'|"((?:\\[^]|[^"\\])*)"/g;
const SCRIPT = /\/\/[^\n]*|\/\*[^]*?\*\/|`(?:\\[^]|[^`\\])*`|'((?:\\[^]|[^'\\])*)'/g;
const ASKED = /(?:(?<![.\w])(?:t|msg|said)\(|\btext!\(|\bsay!\([^"']*,)\s*$/;

/** The texts of a source that are said to people. */
const texts = (source, rust) =>
  [...source.matchAll(rust ? RUST : SCRIPT)]
    .filter((found) => ASKED.test(source.slice(Math.max(0, found.index - 120), found.index)))
    .map((found) => found.at(-1))
    .filter((text) => text !== undefined)
    .map(unescaped);

// What layout! and choice! make of docs, and the names of the rows.
const TABLES = /\b(?:layout|choice)! \{\n([^]*?)\n\}/g;
const ROW = /((?:^ *\/\/\/.*\n)+) *(?:(\w+): [A-Z]\w*\[|\w+ = "|(pub) static)/gm;
const line = (doc) => doc.replace(/^ *\/\/\/ ?/gm, '').trim().split('\n').map((part) => part.trim()).join(' ');
const title = (doc) => line(doc).replace(/\.*$/, '').replace(/[`*]/g, '');

/** The docs of tables, and the names of their rows. */
const docs = (source) =>
  [...source.matchAll(TABLES)]
    .flatMap(([, table]) => [...table.matchAll(ROW)])
    .flatMap(([, doc, name, isTable]) => (isTable ? [title(doc)] : name ? [line(doc), name] : [line(doc)]));

/** The files below a directory. */
const below = async (path) => {
  const entries = await readdir(top + path, { withFileTypes: true });
  const found = entries.map((entry) =>
    entry.isDirectory() ? below(`${path}/${entry.name}`) : [`${path}/${entry.name}`],
  );
  return (await Promise.all(found)).flat();
};

/** What is said, with the file that says it. */
const said = async () => {
  const files = (await Promise.all(SOURCES.map(below))).flat().filter((file) => /\.(rs|js)$/.test(file));
  const found = new Map();
  for (const file of files) {
    // The module itself names what others say.
    if (file === 'crate/src/language.rs') continue;
    const source = await readFile(top + file, 'utf8');
    const tables = file === KINDS ? [] : docs(source);
    for (const text of [...texts(source, file.endsWith('.rs')), ...tables]) {
      if (text && !found.has(text)) found.set(text, file);
    }
  }
  return found;
};

/** What a language has, as [English, other, file]. */
const translations = async (language) => {
  const found = [];
  for (const name of (await readdir(new URL(`${language}/`, import.meta.url))).sort()) {
    const text = await readFile(new URL(`${language}/${name}`, import.meta.url), 'utf8');
    const file = JSON.parse(text);
    // JSON.parse would keep one of two entries with the same name.
    const keys = [...text.matchAll(/^ *("(?:\\.|[^"\\])*"): /gm)].map(([, key]) => JSON.parse(key));
    found.push(...keys.map((key) => [key, file[key], name]));
  }
  return found;
};

/** The places for values in a text, in order of their index. */
const places = (text) => {
  let next = 0;
  const all = [...text.matchAll(/\{(\d*)(?:\|[^}]*)?\}/g)].map(([, index]) => (index === '' ? next++ : Number(index)));
  return [...new Set(all)].sort((one, other) => one - other).join();
};

const faults = [];
const english = await said();
for (const language of LANGUAGES) {
  const list = await translations(language);
  const known = new Map();
  for (const [key, value, file] of list) {
    if (known.has(key)) faults.push(`${language}/${file}: ${JSON.stringify(key)} is there twice`);
    known.set(key, value);
    if (key !== MARK && file !== NAMES && !english.has(key)) {
      faults.push(`${language}/${file}: nothing says ${JSON.stringify(key)}`);
    }
    if (!value) faults.push(`${language}/${file}: ${JSON.stringify(key)} is empty`);
    if (places(key) !== places(value)) {
      faults.push(`${language}/${file}: ${JSON.stringify(key)} has other values than ${JSON.stringify(value)}`);
    }
  }
  const missing = [...english].filter(([text]) => !known.has(text));
  const wanted = process.argv.indexOf('--missing') + 1;
  if (wanted) {
    const of = missing.filter(([, file]) => file.startsWith(process.argv[wanted] ?? ''));
    console.log(JSON.stringify(Object.fromEntries(of.map(([text]) => [text, ''])), null, 2));
    process.exit();
  }
  for (const [text, file] of missing) faults.push(`${file}: ${JSON.stringify(text)} is not in ${language}`);
  await mkdir(`${top}web/pkg`, { recursive: true });
  // Texts are looked for by halves (crate/src/language.rs).
  const sorted = [...known].sort(([one], [other]) => Buffer.compare(Buffer.from(one), Buffer.from(other)));
  await writeFile(`${top}web/pkg/${language}.json`, JSON.stringify(sorted));
}
for (const fault of faults) console.error(fault);
if (faults.length) console.error(`${faults.length} texts are not right.`);
process.exitCode = faults.length ? 1 : 0;
