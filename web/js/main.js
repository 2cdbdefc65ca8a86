// Starts the page; what the bundler finds only in JavaScript is made here and in `site.js`.
import { speak as told, start } from '../pkg/page/page.js';
import { language, load, speak } from './language.js';
import { keep, kept } from './kept.js';
import { desk, engine, page, recording, styled } from './site.js';

const { dataset } = document.documentElement;
const dark = matchMedia('(prefers-color-scheme: dark)').matches;
dataset.theme = kept('theme') ?? (dark ? 'dark' : 'light');

function turn() {
  dataset.theme = dataset.theme === 'dark' ? 'light' : 'dark';
  keep('theme', dataset.theme);
}

let wanted;

async function choose(name) {
  wanted = name;
  const pairs = await load(name).catch(() => undefined);
  // Another one may have been chosen meanwhile.
  if (wanted !== name) return;
  if (pairs || name === 'en') {
    const address = new URL(location.href);
    address.searchParams.set('lang', name);
    history.replaceState(null, '', address);
    keep('language', name);
    told(name, speak(pairs));
    // The button that was pressed is gone with the rest.
    document.querySelector(`.languages [lang=${name}]`)?.focus();
  } else {
    told(name);
  }
}

// The buttons are made anew with the language.
addEventListener('click', ({ target }) => {
  if (target.closest('.theme')) turn();
  const chosen = target.closest('.languages button');
  if (chosen) choose(chosen.lang);
});

const first = /^#?\/?(console|$)/.test(location.hash);

// A language whose texts do not come is English.
const texts = speak(await load(language).catch(() => undefined));
await Promise.all([page, first || styled]);
start({
  language: texts ? language : 'en',
  texts,
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
