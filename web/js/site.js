// Where the page's other files come from: its own server. Where they all are in the page itself,
// ../single/site.js stands in for this.
import init from '../pkg/page/page.js';
import ru from '../pkg/ru.json?url';
import parts from '../style/parts.css?url';

/** The texts of a language that is not English. */
export const texts = async (language) => (await fetch({ ru }[language])).json();

export const page = init();

// The first view is there without the style of the others.
const style = Object.assign(document.createElement('link'), { rel: 'stylesheet', href: parts });
export const styled = new Promise((resolve) => Object.assign(style, { onload: resolve, onerror: resolve }));
document.head.append(style);

export const engine = () => new Worker(new URL('./worker.js', import.meta.url), { type: 'module', name: 'engine' });
export const desk = () => new Worker(new URL('./worker.js', import.meta.url), { type: 'module', name: 'desk' });

const offline = () => import('./offline.js');
export const recording = async (runs) => (await offline()).recording(runs);
// What the page itself still fetches comes first.
setTimeout(offline, 2_000);
