// PERIOD as fast as JavaScript reads it: it knows this layout only, a table has the CRC, the
// numbers go to typed arrays that are used again, and a frame that is wrong ends it all.

const CRC = Uint8Array.from({ length: 256 }, (_, byte) => {
  let sum = byte;
  for (let bit = 0; bit < 8; bit += 1) sum = sum & 0x80 ? (sum << 1) ^ 0x97 : sum << 1;
  return sum;
});

const LENGTH = 7;

export function open() {
  const most = Math.ceil(65_536 / LENGTH) + 1;
  const angle = new Uint32Array(most);
  const turns = new Uint16Array(most);
  const status = new Uint8Array(most);
  const flags = new Uint8Array(most);
  let count = 0;

  function push(bytes) {
    const end = bytes.length - LENGTH;
    let index = 0;
    for (let at = 0; at <= end; at += LENGTH) {
      const b0 = bytes[at];
      const b1 = bytes[at + 1];
      const b2 = bytes[at + 2];
      const b3 = bytes[at + 3];
      const b4 = bytes[at + 4];
      const b5 = bytes[at + 5];
      if (CRC[CRC[CRC[CRC[CRC[CRC[b0] ^ b1] ^ b2] ^ b3] ^ b4] ^ b5] !== bytes[at + 6]) throw new Error(`wrong CRC at ${at}`);
      turns[index] = (b0 << 8) | b1;
      angle[index] = (b2 << 16) | (b3 << 8) | b4;
      status[index] = b5 & 0x3f;
      flags[index] = b5 >> 6;
      index += 1;
    }
    count = index;
    return index;
  }

  return { push, angles: () => angle.subarray(0, count).reduce((sum, each) => sum + each, 0) };
}
