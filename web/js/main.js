// Starts the page; what the bundler finds only in JavaScript is made here and in `site.js`.
import { start } from '../pkg/page/page.js';
import { language, load, speak } from './language.js';
import { desk, engine, page, recording, styled } from './site.js';

// A browser that keeps nothing has no stored theme; reading it may even be forbidden.
let stored;
try {
  stored = localStorage.getItem('theme');
} catch {}
const dark = matchMedia('(prefers-color-scheme: dark)').matches;
document.documentElement.dataset.theme = stored ?? (dark ? 'dark' : 'light');

const first = /^#?\/?(console|$)/.test(location.hash);

// A language whose texts do not come is English.
const texts = load(language).catch(() => undefined);
speak(await texts);
await Promise.all([page, first || styled]);
start({
  language: (await texts) ? language : 'en',
  texts: await texts,
  speak: async (name) => {
    const texts = await load(name);
    speak(texts);
    const address = new URL(location.href);
    address.searchParams.set('lang', name);
    history.replaceState(null, '', address);
    try {
      localStorage.setItem('language', name);
    } catch {}
    return texts;
  },
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
