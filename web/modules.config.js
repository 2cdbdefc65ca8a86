// Bundles the modules that other programs import, each with its WASM beside it under its own
// name: the npm package, and what dist/ has of it.
import { readFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vite';

const here = (path) => fileURLToPath(new URL(path, import.meta.url));

const declarations = (css) => [...css.matchAll(/(--[\w-]+):\s*([^;]+);/g)].map(([, name, value]) => [name, value]);

/** The style of the custom element, with those of the page's tokens that it uses. */
async function elementStyle() {
  const read = async (path) => (await readFile(here(path), 'utf8')).replace(/\/\*.*?\*\//gs, '');
  const style = await read('js/encoder-frame/style.css');
  const [light, dark] = (await read('style/tokens.css')).split(":root[data-theme='dark']");
  const night = new Map(declarations(dark));
  const tokens = declarations(light)
    .filter(([name]) => style.includes(`var(${name})`))
    .map(([name, value]) => {
      const both = night.has(name) ? `light-dark(${value},${night.get(name)})` : value;
      return `${name}:var(--encoder-frame-${name.slice(2)},${both})`;
    });
  return `.box{${tokens.join(';')}}${style}`.replace(/\s+/g, ' ').replace(/ ?([{};>]) ?|(:) /g, '$1$2');
}

const STYLE = 'virtual:encoder-frame-style';

export default defineConfig({
  base: './',
  publicDir: here('public'),
  plugins: [
    {
      name: 'encoder-frame-style',
      resolveId: (id) => (id === STYLE ? `\0${STYLE}` : null),
      load: async (id) => (id === `\0${STYLE}` ? `export default ${JSON.stringify(await elementStyle())}` : null),
    },
  ],
  build: {
    target: 'esnext',
    outDir: here('pkg/npm'),
    emptyOutDir: true,
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    rollupOptions: {
      input: {
        encoderscope: here('js/encoderscope.js'),
        'encoderscope.node': here('js/encoderscope.node.js'),
        'encoder-frame': here('js/encoder-frame.js'),
      },
      external: ['node:fs/promises'],
      preserveEntrySignatures: 'strict',
      output: {
        entryFileNames: '[name].js',
        chunkFileNames: 'encoderscope-[name].js',
        assetFileNames: '[name][extname]',
      },
    },
  },
});
