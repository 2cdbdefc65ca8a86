// Starts the page; what the bundler finds only in JavaScript is made here.
import init, { start } from '../pkg/page/page.js';
import parts from '../style/parts.css?url';

// A browser that keeps nothing has no stored theme; reading it may even be forbidden.
let stored;
try {
  stored = localStorage.getItem('theme');
} catch {}
const dark = matchMedia('(prefers-color-scheme: dark)').matches;
document.documentElement.dataset.theme = stored ?? (dark ? 'dark' : 'light');

// The first view is there without the style of the others.
const style = Object.assign(document.createElement('link'), { rel: 'stylesheet', href: parts });
const styled = new Promise((resolve) => Object.assign(style, { onload: resolve, onerror: resolve }));
document.head.append(style);
const first = /^#?\/?(console|$)/.test(location.hash);

await Promise.all([init(), first || styled]);
start({
  engine: () => new Worker(new URL('./worker.js', import.meta.url), { type: 'module', name: 'engine' }),
  desk: () => new Worker(new URL('./worker.js', import.meta.url), { type: 'module', name: 'desk' }),
  engineHere: async () => {
    const { default: initModule, serve } = await import('../pkg/encoderscope.js');
    await initModule();
    const { port1, port2 } = new MessageChannel();
    serve(port1);
    return port2;
  },
  charts: () => import('./plot.js'),
});
