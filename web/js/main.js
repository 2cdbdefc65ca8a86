// Starts the page; what the bundler finds only in JavaScript is made here and in `site.js`.
import { start } from '../pkg/page/page.js';
import { desk, engine, page, recording, styled } from './site.js';

// A browser that keeps nothing has no stored theme; reading it may even be forbidden.
let stored;
try {
  stored = localStorage.getItem('theme');
} catch {}
const dark = matchMedia('(prefers-color-scheme: dark)').matches;
document.documentElement.dataset.theme = stored ?? (dark ? 'dark' : 'light');

const first = /^#?\/?(console|$)/.test(location.hash);

await Promise.all([page, first || styled]);
start({
  engine,
  desk,
  recording,
  engineHere: async () => {
    const { default: initModule, serve } = await import('../pkg/encoderscope.js');
    await initModule();
    const { port1, port2 } = new MessageChannel();
    serve(port1);
    return port2;
  },
  charts: () => import('./plot.js'),
});
