// The JavaScript module: import it and call; the WASM is loaded by then.
import init, { decode, detect, encode, explain, formats, parseModel } from '../pkg/encoderscope.js';

await init();

export { decode, detect, encode, explain, formats, parseModel };
