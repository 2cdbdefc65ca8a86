// ../js/site.js where all files are in the page itself.
import init from '../pkg/page/page.js';
import worker from 'virtual:worker';
import '../style/main.css';
import '../style/parts.css';

/** The bytes of a file: an element of the page has them as base64 of gzip. */
const bytes = (name) => {
  const packed = atob(document.getElementById(name).textContent);
  const stream = new Blob([Uint8Array.from(packed, (letter) => letter.charCodeAt())]).stream();
  return new Response(stream.pipeThrough(new DecompressionStream('gzip')), {
    headers: { 'Content-Type': 'application/wasm' },
  });
};

// What loads the WASM asks the server for it; here nobody may be asked for anything.
globalThis.fetch = async (url) => bytes(`${url}`.split('/').pop());

/** The texts of a language that is not English. */
export const texts = async (language) => (await fetch(`${language}.json`)).json();

export const page = init();
export const styled = page;

const script = URL.createObjectURL(new Blob([worker], { type: 'text/javascript' }));
const start = (name) => {
  const started = new Worker(script, { name });
  // The worker takes the code of the module as its first message.
  fetch('encoderscope_bg.wasm')
    .then((response) => response.arrayBuffer())
    .then((code) => started.postMessage(code, [code]));
  return started;
};
export const engine = () => start('engine');
export const desk = () => start('desk');

// Nobody makes the file new while it is open.
export const recording = () => {};
