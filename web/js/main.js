// Starts the page; the engine's worker is made here because the bundler finds it only in JavaScript.
import init, { start } from '../pkg/page.js';
import { chart } from './plot.js';

// A browser that keeps nothing has no stored theme; reading it may even be forbidden.
let stored;
try {
  stored = localStorage.getItem('theme');
} catch {}
const dark = matchMedia('(prefers-color-scheme: dark)').matches;
document.documentElement.dataset.theme = stored ?? (dark ? 'dark' : 'light');

await init();
start(() => new Worker(new URL('./worker.js', import.meta.url), { type: 'module' }), { chart });
