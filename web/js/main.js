// Starts the page; the workers are made here because the bundler finds them only in JavaScript.
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
const workers = {
  engine: () => new Worker(new URL('./worker.js', import.meta.url), { type: 'module', name: 'engine' }),
  desk: () => new Worker(new URL('./worker.js', import.meta.url), { type: 'module', name: 'desk' }),
};
start(workers, { chart });
