// What one writes in an afternoon: an object for each frame, the CRC bit by bit as the manual has
// it, one byte further where it fails. A peer takes chunks and gives what it read in them.

/** CRC of `bytes`, most significant bit first, from 0, without reflection. */
function crc(bytes, polynomial, width) {
  const top = 1 << (width - 1);
  let sum = 0;
  for (const byte of bytes) {
    for (let bit = 7; bit >= 0; bit -= 1) {
      const out = ((sum & top) !== 0) !== (((byte >> bit) & 1) !== 0);
      sum = (sum << 1) & (top * 2 - 1);
      if (out) sum ^= polynomial;
    }
  }
  return sum;
}

/** Frames of `length` bytes in a stream; `read` gives a frame, or nothing where there is none. */
class Stream {
  constructor(length, read) {
    this.length = length;
    this.read = read;
    this.pending = new Uint8Array(0);
  }

  push(chunk) {
    const bytes = new Uint8Array(this.pending.length + chunk.length);
    bytes.set(this.pending);
    bytes.set(chunk, this.pending.length);
    const frames = [];
    let at = 0;
    while (at + this.length <= bytes.length) {
      const frame = this.read(bytes.subarray(at, at + this.length));
      if (frame) {
        frames.push(frame);
        at += this.length;
      } else {
        at += 1;
      }
    }
    this.pending = bytes.slice(at);
    return frames;
  }
}

function period(bytes) {
  if (crc(bytes.subarray(0, 6), 0x97, 8) !== bytes[6]) return null;
  return {
    turns: (bytes[0] << 8) | bytes[1],
    angle: (bytes[2] << 16) | (bytes[3] << 8) | bytes[4],
    error: (bytes[5] & 0x80) !== 0,
    warning: (bytes[5] & 0x40) !== 0,
    status: bytes[5] & 0x3f,
  };
}

function t485(bytes) {
  if (bytes[0] !== 0x1a || bytes.subarray(0, 10).reduce((sum, byte) => sum ^ byte, 0) !== bytes[10]) return null;
  return {
    turns: bytes[6] | (bytes[7] << 8) | (bytes[8] << 16),
    angle: bytes[2] | (bytes[3] << 8) | (bytes[4] << 16),
    error: (bytes[1] & 0x20) !== 0,
    status: bytes[1],
    enid: bytes[5],
    alarm: bytes[9],
  };
}

function asi1(bytes) {
  if (bytes[0] & 0x18) return null;
  const received = ((bytes[3] & 0x03) << 14) | ((bytes[4] & 0x7f) << 7) | (bytes[5] & 0x7f);
  const covered = [bytes[0], bytes[1], bytes[2], bytes[3] & 0xfc, bytes[4] & 0x80, bytes[5] & 0x80];
  if (crc(covered, 0x8005, 16) !== received) return null;
  const position = ((bytes[0] & 0x07) << 19) | ((bytes[1] & 0x7f) << 12) | ((bytes[2] & 0x7f) << 5) | ((bytes[3] >> 2) & 0x1f);
  if (position >= 1 << 14) return null;
  return { angle: position, error: (bytes[0] & 0x40) === 0, zeroDefault: (bytes[0] & 0x20) !== 0 };
}

/** A capture of eight bytes: 0x82, and 48 bits up to the CRC. */
function bissC(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const word = view.getBigUint64(0);
  const received = Number((word >> 2n) & 0x3fn);
  if (bytes[0] !== 0x82 || (crc(bytes.subarray(1, 7), 0x03, 6) ^ 0x3f) !== received) return null;
  return {
    turns: Number((word >> 40n) & 0xffffn),
    angle: Number((word >> 16n) & 0xffffffn),
    error: ((word >> 15n) & 1n) === 0n,
    warning: ((word >> 14n) & 1n) === 0n,
    status: Number((word >> 8n) & 0x3fn),
  };
}

/** Lines of hexadecimal digits; the frames of each. */
class Lines {
  constructor(read) {
    this.read = read;
    this.pending = '';
  }

  push(text) {
    const lines = (this.pending + text).split('\n');
    this.pending = lines.pop();
    return lines.map((line) => this.read(Uint8Array.from(line.split(' '), (digits) => parseInt(digits, 16)))).filter(Boolean);
  }
}

const peers = {
  period: () => new Stream(7, period),
  t485: () => new Stream(11, t485),
  asi1: () => new Stream(6, asi1),
  'asi1-noise': () => new Stream(6, asi1),
  'biss-c': () => new Stream(8, bissC),
  'biss-c-text': () => new Lines(bissC),
};

/** A decoder of a workload: `push` takes a chunk and counts frames; `add` sums their angles. */
export function open(workload) {
  const peer = peers[workload]();
  let frames = [];
  return {
    push: (chunk) => {
      frames = peer.push(chunk);
      return frames.length;
    },
    angles: () => frames.reduce((sum, frame) => sum + frame.angle, 0),
  };
}
