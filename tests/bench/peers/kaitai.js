// Kaitai Struct's JavaScript runtime on the declarations beside this file. It has no CRCs: they
// are checked here, with tables.
import '/node_modules/kaitai-struct/KaitaiStream.js';

function table(polynomial, width) {
  const top = 2 ** (width - 1);
  return Uint16Array.from({ length: 256 }, (_, byte) => {
    let sum = byte * 2 ** (width - 8);
    for (let bit = 0; bit < 8; bit += 1) sum = (sum & top ? (sum << 1) ^ polynomial : sum << 1) & (top * 2 - 1);
    return sum;
  });
}

// A sum of six bits at the top of a byte.
const CRC6 = table(0x03 << 2, 8);
const CRC8 = table(0x97, 8);
const CRC16 = table(0x8005, 16);

const formats = {
  period: {
    module: 'Period',
    length: 7,
    holds(bytes, at, frame) {
      let sum = 0;
      for (let index = at; index < at + 6; index += 1) sum = CRC8[sum ^ bytes[index]];
      return sum === frame.crc;
    },
  },
  t485: {
    module: 'T485',
    length: 11,
    holds(bytes, at, frame) {
      let sum = 0;
      for (let index = at; index < at + 10; index += 1) sum ^= bytes[index];
      return sum === frame.crc;
    },
  },
  asi1: {
    module: 'Asi1',
    length: 6,
    masks: [0xff, 0xff, 0xff, 0xfc, 0x80, 0x80],
    holds(bytes, at, frame) {
      let sum = 0;
      for (let index = 0; index < 6; index += 1) {
        const byte = bytes[at + index] & this.masks[index];
        sum = ((sum << 8) & 0xffff) ^ CRC16[(sum >> 8) ^ byte];
      }
      return sum === ((frame.crcHigh << 14) | (frame.crcMiddle << 7) | frame.crcLow);
    },
  },
  'biss-c': {
    module: 'BissC',
    length: 8,
    holds(bytes, at, frame) {
      let sum = 0;
      for (let index = at + 1; index < at + 7; index += 1) sum = CRC6[sum ^ bytes[index]];
      return ((sum >> 2) ^ 0x3f) === frame.crc;
    },
  },
};

/** A decoder of a workload, whose chunks are whole frames. */
export async function open(workload, folder) {
  const format = formats[workload];
  await import(`${folder}/${format.module}.js`);
  const Format = self[format.module][format.module];
  let frames = [];

  function push(chunk) {
    const { buffer, byteOffset, byteLength } = chunk;
    const parsed = new Format(new self.KaitaiStream(new DataView(buffer, byteOffset, byteLength)));
    frames = parsed.frames;
    for (let index = 0; index < frames.length; index += 1) {
      if (!format.holds(chunk, index * format.length, frames[index])) throw new Error(`wrong CRC in frame ${index}`);
    }
    return frames.length;
  }

  return { push, angles: () => frames.reduce((sum, frame) => sum + frame.angle, 0) };
}
