// Charts for the page; what is drawn and what a gesture means, the page decides.
import uPlot from 'uplot';
import { t } from './language.js';

const sync = uPlot.sync('plot');

const tenths = [1e-5, 1e-4, 1e-3, 1e-2, 1e-1].flatMap((unit) => [unit, 2 * unit, 5 * unit]);
const tens = [1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7].flatMap((unit) => [unit, 2 * unit, 5 * unit]);
const seconds = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 1800, 3600, 7200, 21600, 86400];
const degrees = [1, 2, 5, 10, 15, 30, 45, 90, 180, 360];

/** Steps of the axis of a quantity. */
const steps = { angle: [...tenths, ...degrees], errors: tens };

const token = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

const decimals = (step) => Math.max(0, Math.ceil(-Math.log10(step) - 1e-9));

/** With the decimal mark of the language. */
const figure = (value, step) =>
  value.toFixed(decimals(step)).replace(/^-(0\.?0*$)?/, (_, zero) => zero ?? '−').replace('.', t('.'));

/** Seconds below a minute, else minutes or hours as on a clock. */
const clock = (at, step, most) => {
  if (most < 60) return figure(at, step);
  const two = (number) => String(Math.floor(number)).padStart(2, '0');
  const rest = figure(at % 60, step).padStart(decimals(step) ? 3 + decimals(step) : 2, '0');
  const minutes = Math.floor(at / 60);
  return most < 3600 ? `${minutes}:${rest}` : `${Math.floor(minutes / 60)}:${two(minutes % 60)}:${rest}`;
};

/** Lines between neighbours, none over a gap, and a dot where a point stands alone. */
const paths = (u, index) => {
  const [times, values] = [u.data[0], u.data[index]];
  const stroke = new Path2D();
  let drawing = false;
  for (let at = 0; at < times.length; at += 1) {
    const value = values[at];
    if (value !== null) {
      const [x, y] = [u.valToPos(times[at], 'x', true), u.valToPos(value, 'y', true)];
      if (!drawing) stroke.moveTo(x, y);
      stroke.lineTo(x, y);
      const alone = !drawing && (values[at + 1] ?? null) === null;
      if (alone) stroke.arc(x, y, 1.5 * uPlot.pxRatio, 0, 2 * Math.PI);
    }
    drawing = value !== null;
  }
  return { stroke, fill: null, clip: null, band: null, gaps: null, flags: 0 };
};

const axis = (options) => ({
  stroke: () => token('--dim'),
  font: `11px ${token('--mono')}`,
  grid: { stroke: () => token('--line'), width: 1 },
  ticks: { show: false },
  ...options,
});

class Chart {
  #u;
  #x = [0, 1];
  #y = [0, 1];
  #mark = NaN;
  #tell;
  #watched;

  /** `tell(what, a, b)` is called with `zoom`, `cursor`, `mark`, `live` and `width`. */
  constructor(element, quantity, color, x, tell) {
    this.#tell = tell;
    this.#u = new uPlot(this.#options(element, quantity, color, x), [[0, 1], [null, null]], element);
    const over = this.#u.over;
    over.addEventListener('click', () => this.#tell('mark', this.#u.posToVal(this.#u.cursor.left, 'x'), 0));
    element.addEventListener('keydown', (event) => this.#key(event));
    const resized = new ResizeObserver(() => {
      this.#u.setSize({ width: element.clientWidth, height: element.clientHeight });
      this.#tell('width', this.columns(), 0);
    });
    resized.observe(element);
    const themed = new MutationObserver(() => this.#u.redraw(false));
    themed.observe(document.documentElement, { attributeFilter: ['data-theme'] });
    this.#watched = [resized, themed];
  }

  #options(element, quantity, color, x) {
    const axes = {
      time: {
        incrs: [...tenths, ...seconds],
        values: (u, splits, index, space, step) => splits.map((at) => (at < 0 ? '' : clock(at, step, u.scales.x.max))),
      },
      rows: {
        incrs: tens,
        values: (u, splits) => splits.map((at) => at.toLocaleString('en').replaceAll(',', '\u202f')),
      },
    };
    return {
      width: Math.max(element.clientWidth, 100),
      height: Math.max(element.clientHeight, 60),
      padding: [8, 6, 0, 0],
      legend: { show: false },
      scales: { x: { time: false, range: () => this.#x }, y: { range: () => this.#y } },
      series: [{}, { stroke: () => token(color), width: 1.4, cap: 'round', points: { show: false }, paths }],
      axes: [
        axis({
          size: 26,
          space: 70,
          ...axes[x],
        }),
        axis({
          size: 58,
          space: 28,
          incrs: steps[quantity] ?? [...tenths, ...tens],
          values: (u, splits, index, space, step) => splits.map((value) => figure(value, step)),
        }),
      ],
      cursor: {
        y: false,
        points: { show: false },
        drag: { x: true, y: false, setScale: false },
        ...(x === 'time' && { sync: { key: sync.key, setSeries: false, scales: ['x', null] } }),
        bind: { dblclick: () => () => this.#tell('live', 0, 0) },
      },
      hooks: {
        setCursor: [
          (u) => this.#tell('cursor', u.cursor.left >= 0 ? u.posToVal(u.cursor.left, 'x') : NaN, 0),
        ],
        setSelect: [
          (u) => {
            const { left, width } = u.select;
            if (width < 3) return;
            u.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
            this.#tell('zoom', u.posToVal(left, 'x'), u.posToVal(left + width, 'x'));
          },
        ],
        draw: [(u) => this.#drawMark(u)],
      },
    };
  }

  #drawMark({ ctx, bbox, valToPos }) {
    const x = valToPos(this.#mark, 'x', true);
    if (!(x >= bbox.left && x <= bbox.left + bbox.width)) return;
    ctx.save();
    ctx.strokeStyle = token('--ink');
    ctx.lineWidth = uPlot.pxRatio;
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
    ctx.restore();
  }

  #key(event) {
    const u = this.#u;
    const step = event.shiftKey ? 20 : 2;
    const move = { ArrowLeft: -step, ArrowRight: step }[event.key];
    const width = this.columns();
    if (move !== undefined) {
      const left = u.cursor.left >= 0 ? u.cursor.left + move : width / 2;
      u.setCursor({ left: Math.min(Math.max(left, 0), width), top: 0 }, true, true);
    } else if (event.key === 'Enter' && u.cursor.left >= 0) {
      this.#tell('mark', u.posToVal(u.cursor.left, 'x'), 0);
    } else if (event.key === 'Escape') {
      u.setCursor({ left: -10, top: -10 }, true, true);
      this.#tell('mark', NaN, 0);
    } else {
      return;
    }
    event.preventDefault();
  }

  /** Width of what is drawn, in CSS pixels. */
  columns() {
    return this.#u.over.clientWidth;
  }

  /** Draws values over times; what is no number is a gap. */
  draw(times, values, from, to, low, high) {
    this.#x = [from, to];
    this.#y = [low, high];
    const drawn = Array.from(values, (value) => (Number.isNaN(value) ? null : value));
    this.#u.setData(drawn.length ? [times.slice(), drawn] : [[from, to], [null, null]]);
  }

  /** Draws a line at a time; at none where it is no number. */
  mark(at) {
    this.#mark = at;
    this.#u.redraw(false);
  }

  remove() {
    // What uPlot has put off comes when nobody listens any more.
    this.#tell = () => {};
    for (const observer of this.#watched) observer.disconnect();
    this.#u.destroy();
  }
}

/** A chart in an element over `time` or `rows`; `color` is a token of the style sheet. */
export const chart = (element, quantity, color, x, tell) => new Chart(element, quantity, color, x, tell);
