// The language of the page: the one of its address, else the one that was chosen last, else the
// browser's. What is said stands in English in the source; another language has the same texts.
import { kept } from './kept.js';
import { texts } from './site.js';

const LANGUAGES = ['en', 'ru'];

const asked = new URLSearchParams(location.search).get('lang');
const found = [asked, kept('language'), ...navigator.languages.map((name) => name.split('-')[0])];

/** The language that the page begins with. */
export const language = found.find((name) => LANGUAGES.includes(name)) ?? 'en';

let spoken;

/** The texts of a language, as pairs with the English ones; none for English. */
export const load = async (name) => (name === 'en' ? undefined : texts(name));

/** Speaks a language from now on; returns its texts as the core reads them (`Catalogue::read`). */
export const speak = (pairs) => {
  spoken = pairs && Object.fromEntries(pairs);
  return pairs && pairs.flat().join('\0');
};

/** A text in the language that is spoken. */
export const t = (text) => spoken?.[text] ?? text;
