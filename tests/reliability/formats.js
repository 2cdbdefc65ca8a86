// The formats that are read under faults, with a shaft that stands still at 5.5 turns.

export const FORMATS = {
  t485: { query: 'format=t485&angle-bits=23', shows: { angle: 2 ** 22, turns: 5 } },
  rs485: { query: 'format=rs485&angle-bits=24&command=d', shows: { angle: 2 ** 23, turns: 5 } },
  bus: { query: 'format=bus&angle-bits=24', shows: { angle: 2 ** 23, turns: 5 } },
  // Damaged bytes of a stream can be cut into a frame anew at each of them: so many of those pass.
  period: { query: 'format=period&angle-bits=24', shows: { angle: 2 ** 23, turns: 5 }, streams: true, passes: 7 / 2 ** 8 },
  // A packet of zeros is good, and says that its position is not valid.
  asi1: { query: 'format=asi1', shows: { angle: 2 ** 13 }, streams: true, passes: 6 / 2 ** 16, zeros: 6 },
  // Digits have no check.
  asi4: { query: 'format=asi4', shows: { angle: 2 ** 13 }, streams: true, passes: 1 },
};

export const ALL = Object.keys(FORMATS);
export const POLLED = ALL.filter((name) => !FORMATS[name].streams);
