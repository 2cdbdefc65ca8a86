// What elements say in a language that is not English. The texts come once, when the first element
// of the language asks for them; until then, and where they cannot be had, it is English.
import { learn, speak } from '../../pkg/encoder-frame.js';
import ru from '../../pkg/ru.json?url';

let texts;
let request;

const isRussian = (lang) => /^ru\b/i.test(lang);

async function load() {
  try {
    const pairs = await (await fetch(ru)).json();
    learn(pairs.flat().join('\0'));
    texts = Object.fromEntries(pairs);
  } catch {
    texts = {};
  }
}

/** When the texts of a language such as `ru` or `ru-RU` are there; nothing where they are. */
export const coming = (lang) => (isRussian(lang) && !texts ? (request ??= load()) : undefined);

/** What says texts in a language. The core speaks it too, until it is told otherwise. */
export function voice(lang) {
  const other = isRussian(lang) ? texts : undefined;
  speak(!!other);
  return (text) => other?.[text] ?? text;
}
