// How the time grows with the input, as a picture: both axes logarithmic, so that what is linear
// rises by one decade a decade.

const [WIDTH, HEIGHT] = [640, 400];
const FRAME = { left: 72, right: 616, top: 24, bottom: 344 };
const SERIES = [
  { side: 'native', title: 'native', shape: (x, y) => `<circle cx="${x}" cy="${y}" r="5"/>` },
  { side: 'wasm', title: 'WASM in Chromium', shape: (x, y) => `<path d="M${x - 5} ${y - 5}h10v10h-10z"/>` },
];
const STYLE = `
  svg { color-scheme: light dark; font: 13px sans-serif; }
  text { fill: #222; } .rule { stroke: #d0d4da; } .native { stroke: #0b62c4; fill: #0b62c4; }
  .wasm { stroke: #b34700; fill: #b34700; } .line { fill: none; stroke-width: 2; } .ground { fill: #fff; }
  @media (prefers-color-scheme: dark) {
    text { fill: #ddd; } .rule { stroke: #3a4048; } .native { stroke: #6cb0ff; fill: #6cb0ff; }
    .wasm { stroke: #ff9f57; fill: #ff9f57; } .ground { fill: #16191d; }
  }
`;

const decades = (values) => [Math.floor(Math.log10(Math.min(...values))), Math.ceil(Math.log10(Math.max(...values)))];
const size = (bytes) => (bytes >= 1e6 ? `${Math.round(bytes / 1e6)} MB` : `${Math.round(bytes / 1e3)} kB`);

/** The time of a power of ten of seconds. */
function duration(power) {
  if (power >= 0) return `${10 ** power} s`;
  return power >= -3 ? `${10 ** (power + 3)} ms` : `${10 ** (power + 6)} µs`;
}

/** Steps of `bytes`, with bytes a second of each side. */
export function plot(steps) {
  const seconds = (step, side) => step.bytes / step[side];
  const all = steps.flatMap((step) => SERIES.map(({ side }) => seconds(step, side)));
  const [low, high] = decades(all);
  const [first, last] = [steps[0].bytes, steps.at(-1).bytes].map(Math.log10);
  const x = (bytes) => Math.round(FRAME.left + 24 + ((Math.log10(bytes) - first) / (last - first)) * (FRAME.right - FRAME.left - 48));
  const y = (time) => Math.round(FRAME.bottom - ((Math.log10(time) - low) / (high - low)) * (FRAME.bottom - FRAME.top));
  const rules = Array.from({ length: high - low + 1 }, (_, index) => low + index).map((power) => {
    const at = y(10 ** power);
    return `<path class="rule" d="M${FRAME.left} ${at}H${FRAME.right}"/><text x="${FRAME.left - 8}" y="${at + 4}" text-anchor="end">${duration(power)}</text>`;
  });
  const sizes = steps.map(({ bytes }) => `<text x="${x(bytes)}" y="${FRAME.bottom + 20}" text-anchor="middle">${size(bytes)}</text>`);
  const lines = SERIES.map(({ side, title, shape }, index) => {
    const points = steps.map((step) => [x(step.bytes), y(seconds(step, side))]);
    const key = FRAME.top + 16 + index * 22;
    return `<g class="${side}"><path class="line" d="M${points.map((point) => point.join(' ')).join('L')}"/>${points.map((point) => shape(...point)).join('')}${shape(FRAME.left + 24, key)}</g><text x="${FRAME.left + 38}" y="${key + 4}">${title}</text>`;
  });
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${WIDTH} ${HEIGHT}" width="${WIDTH}" height="${HEIGHT}" role="img" aria-label="Time to decode period, by length of input">
<style>${STYLE}</style>
<rect class="ground" width="${WIDTH}" height="${HEIGHT}"/>
${[...rules, ...sizes, ...lines].join('\n')}
<text x="${(FRAME.left + FRAME.right) / 2}" y="${HEIGHT - 12}" text-anchor="middle">length of the input</text>
</svg>
`;
}
