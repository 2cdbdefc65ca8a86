// Starts the page; the engine's worker is made here because the bundler finds it only in JavaScript.
import init, { start } from '../pkg/page.js';

await init();
start(() => new Worker(new URL('./worker.js', import.meta.url), { type: 'module' }));
