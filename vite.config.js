import { readFile } from 'node:fs/promises';
import { basename } from 'node:path';
import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vite';
import { VitePWA } from 'vite-plugin-pwa';

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

const icons = ['icon-192.png', 'icon-512.png', 'icon-maskable.png'];

// Others ask for these by name: the custom element, which is bundled by itself, and the icons.
const named = {
  name: 'named-files',
  async generateBundle() {
    const paths = [
      'web/pkg/npm/encoder-frame.js',
      'web/pkg/npm/encoder-frame_bg.wasm',
      'web/pkg/npm/ru.json',
      ...icons.map((icon) => `web/icons/${icon}`),
    ];
    for (const path of paths) {
      this.emitFile({ type: 'asset', fileName: basename(path), source: await readFile(here(path)) });
    }
  },
};

// The whole page is kept, so that every view works without the network after one visit; a new
// version waits until `web/js/offline.js` lets it in.
const offline = VitePWA({
  injectRegister: null,
  manifest: {
    name: 'Encoderscope',
    short_name: 'Encoderscope',
    description: 'Reads absolute rotary encoders over Web Serial and explains every bit of their frames',
    id: './',
    start_url: './',
    scope: './',
    theme_color: '#fffefb',
    background_color: '#f5f4f0',
    icons: icons.map((src) => ({
      src,
      type: 'image/png',
      sizes: src === 'icon-192.png' ? '192x192' : '512x512',
      purpose: src === 'icon-maskable.png' ? 'maskable' : 'any',
    })),
  },
  workbox: {
    globPatterns: ['**/*.{html,css,js,json,wasm,svg,png}'],
    maximumFileSizeToCacheInBytes: 4_000_000,
    navigateFallback: null,
    ignoreURLParametersMatching: [/^lang$/],
    inlineWorkboxRuntime: true,
  },
});

export default defineConfig({
  base: './',
  plugins: [earlyWasm, named, offline],
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
