// The language of the page: the one of its address, else the one that was chosen last, else the
// browser's. What is said stands in English in the source; another language has the same texts.
import { texts } from './site.js';

const LANGUAGES = ['en', 'ru'];

// A browser that keeps nothing has no stored language; reading it may even be forbidden.
let stored;
try {
  stored = localStorage.getItem('language');
} catch {}
const asked = new URLSearchParams(location.search).get('lang');
const found = [asked, stored, ...navigator.languages.map((name) => name.split('-')[0])];

/** The language that the page begins with. */
export const language = found.find((name) => LANGUAGES.includes(name)) ?? 'en';

let spoken;

/** The texts of a language; none for English. */
export const load = async (name) => (name === 'en' ? undefined : texts(name));

/** Speaks a language from now on. */
export const speak = (texts) => (spoken = texts);

/** A text in the language that is spoken. */
export const t = (text) => spoken?.[text] ?? text;
