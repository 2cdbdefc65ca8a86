// Decodes one workload in a way of doing it, in a worker of its own, so that no other has made the
// engine's guesses worse: once to see what comes out, then against the clock.
import init, { ColumnReader } from '/web/pkg/encoderscope.js';

const CHUNK = 65_536;
/** Bytes of a frame, for those that join nothing and get chunks of whole frames. */
const WHOLE = { period: 7, t485: 11, asi1: 6, 'biss-c': 8 };
const wholeFrames = (frame) => CHUNK - (CHUNK % frame);
const STEPS = { tuned: wholeFrames, kaitai: wholeFrames, 'kaitai-file': (_, length) => length };

/** Each gives a function that opens a decoder for one pass. */
const sides = {
  wasm: async ({ profile }) => {
    await init();
    const reader = new ColumnReader(profile);
    return () => columns(reader, () => reader.length);
  },
  /** The readings become typed arrays of JavaScript. */
  taken: async ({ profile }) => {
    await init();
    const reader = new ColumnReader(profile);
    let taken = reader.take();
    const take = () => {
      taken = reader.take();
      return taken.angle.length;
    };
    return () => ({ ...columns(reader, take), angles: () => added(taken.angle) });
  },
  idiomatic: async ({ workload }) => {
    const { open } = await import('./peers/idiomatic.js');
    return () => open(workload);
  },
  tuned: async () => {
    const { open } = await import('./peers/tuned.js');
    return open;
  },
  kaitai,
  /** The whole file at once. */
  'kaitai-file': kaitai,
  sum: async () => () => adding,
};

async function kaitai({ workload, kaitai }) {
  const { open } = await import('./peers/kaitai.js');
  const decoder = await open(workload, kaitai);
  return () => decoder;
}

const added = (numbers) => numbers.reduce((sum, each) => sum + each, 0);

/** The core: every chunk is copied into its memory, and the readings stay there. */
function columns(reader, count) {
  const counted = (work) => (chunk) => {
    reader.clear();
    work(chunk);
    return count();
  };
  return {
    push: counted((chunk) => (typeof chunk === 'string' ? reader.pushText(chunk) : reader.push(chunk))),
    end: counted(() => reader.finish()),
    angles: () => added(reader.take().angle),
  };
}

async function chunks({ url, side, workload, text }) {
  const bytes = new Uint8Array(await (await fetch(url)).arrayBuffer());
  const input = text ? new TextDecoder().decode(bytes) : bytes;
  const step = STEPS[side]?.(WHOLE[workload], input.length) ?? CHUNK;
  const cut = (at) => (text ? input.slice(at, at + step) : input.subarray(at, at + step));
  return Array.from({ length: Math.ceil(input.length / step) }, (_, index) => cut(index * step));
}

/** Seconds of a pass over all chunks. */
function pass(open, input) {
  const start = performance.now();
  const decoder = open();
  let frames = 0;
  for (const chunk of input) frames += decoder.push(chunk);
  frames += decoder.end?.() ?? 0;
  return { frames, seconds: (performance.now() - start) / 1000 };
}

function sums(open, input) {
  const decoder = open();
  let frames = 0;
  let angles = 0;
  for (const chunk of input) {
    frames += decoder.push(chunk);
    angles += decoder.angles();
  }
  if (decoder.end) {
    frames += decoder.end();
    angles += decoder.angles();
  }
  return { frames, angles };
}

/** The fastest of as many passes as fit, each long enough for a coarse clock. */
function fastest(open, input, { frames }, least) {
  let best = Infinity;
  for (let spent = 0; spent < least; ) {
    let taken = 0;
    let passes = 0;
    while (taken < Math.min(0.05, least)) {
      const once = pass(open, input);
      if (once.frames !== frames) throw new Error(`${once.frames} frames, and ${frames} before`);
      taken += once.seconds;
      passes += 1;
    }
    best = Math.min(best, taken / passes);
    spent += taken;
  }
  return best;
}

/** What adding up the bytes takes. */
const adding = {
  push: (chunk) => {
    let sum = 0;
    for (let at = 0; at < chunk.length; at += 1) sum = (sum + chunk[at]) | 0;
    return sum;
  },
  angles: () => 0,
};

self.onmessage = async ({ data: task }) => {
  try {
    const input = await chunks(task);
    const open = await sides[task.side](task);
    const found = sums(open, input);
    self.postMessage({ ...found, seconds: fastest(open, input, found, task.seconds) });
  } catch (error) {
    self.postMessage({ error: String(error?.stack ?? error) });
  }
};
