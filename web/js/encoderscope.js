// The JavaScript module: import it and call; the WASM is loaded by then.
import init, { decode, encode, explain, formats, parseModel } from '../pkg/encoderscope.js';

await init();

export { decode, encode, explain, formats, parseModel };
