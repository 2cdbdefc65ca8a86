import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vite';

const here = (path) => fileURLToPath(new URL(path, import.meta.url));

// The tests use a name that is not localhost to get a page without a secure context.
const serve = { host: '127.0.0.1', port: 8080, strictPort: true, allowedHosts: ['encoderscope.test'] };

// The first WASM file is asked for with the script, not after it.
const earlyWasm = {
  name: 'early-wasm',
  transformIndexHtml: {
    order: 'post',
    handler: (html, { bundle }) =>
      Object.keys(bundle ?? {})
        .filter((file) => /page_bg-.*\.wasm$/.test(file))
        .map((file) => ({
          tag: 'link',
          attrs: { rel: 'preload', as: 'fetch', type: 'application/wasm', href: `./${file}`, crossorigin: true },
          injectTo: 'head',
        })),
  },
};

export default defineConfig({
  base: './',
  plugins: [earlyWasm],
  publicDir: here('./web/public'),
  worker: { format: 'es' },
  build: {
    target: 'esnext',
    outDir: 'dist',
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    rollupOptions: {
      input: { page: here('./index.html'), encoderscope: here('./web/js/encoderscope.js') },
      preserveEntrySignatures: 'strict',
      output: {
        // Other programs import the module by this name.
        entryFileNames: (chunk) =>
          chunk.name === 'encoderscope' ? '[name].js' : 'assets/[name]-[hash].js',
      },
    },
  },
  server: serve,
  preview: serve,
});
