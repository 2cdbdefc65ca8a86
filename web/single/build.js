// Builds dist/encoderscope.html: the page in one file, which works wherever it lies and asks
// nobody for anything.
import { createHash } from 'node:crypto';
import { readFile, writeFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { build } from 'vite';

const here = (path) => fileURLToPath(new URL(path, import.meta.url));

/** What a script and all it imports become. */
const bundle = async (input, plugins) => {
  const { output } = await build({
    configFile: false,
    base: './',
    logLevel: 'warn',
    publicDir: false,
    plugins,
    build: {
      target: 'esnext',
      write: false,
      assetsInlineLimit: 0,
      cssCodeSplit: false,
      modulePreload: false,
      rollupOptions: { input, output: { codeSplitting: false, assetFileNames: '[name][extname]' } },
    },
  });
  return output;
};

const script = (output) => output.find(({ type }) => type === 'chunk').code;

// The worker is sent its WASM; and Chromium starts no module from the disk as a worker, so that
// nothing of one may be left in it.
const unnamed = {
  name: 'unnamed',
  enforce: 'pre',
  transform: (code, id) =>
    id.endsWith('/encoderscope.js') ? code.replace(/new URL\([^)]*, import\.meta\.url\)/, 'undefined') : null,
};

const ownFiles = {
  name: 'own-files',
  enforce: 'pre',
  resolveId: (id) => ({ './site.js': here('site.js'), 'virtual:worker': '\0worker' })[id],
  load: async (id) => {
    if (id !== '\0worker') return null;
    return `export default ${JSON.stringify(script(await bundle(here('worker.js'), [unnamed])))}`;
  },
};

const output = await bundle(here('../js/main.js'), [ownFiles]);
// No text of the script may look like the end of its element.
const code = script(output).replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');
const style = output.find(({ fileName }) => fileName.endsWith('.css')).source;
const wasm = output.filter(({ fileName }) => fileName.endsWith('.wasm'));

const hash = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;
const policy = [
  "default-src 'none'",
  `script-src ${hash(code)} 'wasm-unsafe-eval'`,
  `style-src ${hash(style)}`,
  'img-src data:',
  "connect-src 'none'",
  'worker-src blob:',
  "base-uri 'none'",
  "form-action 'none'",
].join('; ');
const icon = await readFile(here('../icon.svg'), 'base64');
const texts = { fileName: 'ru.json', source: await readFile(here('../pkg/ru.json')) };
const files = [...wasm, texts].map(
  ({ fileName, source }) =>
    `<script type="text/plain" id="${fileName}">${gzipSync(source, { level: 9 }).toString('base64')}</script>\n`,
);

/** Puts a text in the place of another, which must be there. */
const put = (text, from, to) => {
  if (!from.test(text)) throw new Error(`index.html has nothing like ${from}`);
  return text.replace(from, () => to);
};
let page = await readFile(here('../../index.html'), 'utf8');
page = put(page, /(?<=content=")default-src[^"]*/, policy);
page = put(page, /(?<=rel="icon" href=")[^"]*/, `data:image/svg+xml;base64,${icon}`);
page = put(page, /<link rel="stylesheet"[^>]*>/, `<style>${style}</style>`);
page = put(page, /<script type="module"[^>]*><\/script>/, `<script type="module">${code}</script>`);
page = put(page, /(?=<\/body>)/, files.join(''));
await writeFile(here('../../dist/encoderscope.html'), page);
