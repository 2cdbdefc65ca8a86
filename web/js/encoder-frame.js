// The custom element: import it, and every <encoder-frame> shows its frame. Until its WASM is
// there, and where that is not allowed, the page shows what stands inside the element.
import init, { Paper, parameters } from '../pkg/encoder-frame.js';
import css from 'virtual:encoder-frame-style';
import { coming, voice } from './encoder-frame/words.js';

// Importing it where there are no elements, as when pages are rendered by Node, does nothing.
const { HTMLElement = class {}, customElements } = globalThis;

// What changes the frame, beside the parameters of its profile, and what only its looks.
const CONTENT = ['frame', 'direction'];
const LOOKS = ['checks', 'lang', 'readonly'];

let sheet;

/** The style sheet that all elements share; made by script, it needs no 'unsafe-inline'. */
function style() {
  if (!sheet) {
    sheet = new CSSStyleSheet();
    sheet.replaceSync(css);
  }
  return sheet;
}

/** An element with attributes, classes and children; text is never read as HTML. */
function make(tag, properties, ...children) {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
}

export class EncoderFrame extends HTMLElement {
  static get observedAttributes() {
    return [...parameters().split(' '), ...CONTENT, ...LOOKS];
  }

  #paper;
  #view;
  // What says a text in the language of the element.
  #t;
  #late = false;
  // The index of the bit that the tabulator key leads to.
  #here = 0;
  // For every bit its field's index.
  #owner = [];
  #cells = [];
  #rows = [];
  #verdict;
  #toggle = make('input', { type: 'checkbox' });

  constructor() {
    super();
    this.attachShadow({ mode: 'open' }).adoptedStyleSheets = [style()];
    this.#toggle.addEventListener('change', () => {
      this.setAttribute('checks', this.#toggle.checked ? 'follow' : 'stay');
      if (!this.#toggle.checked || this.#view.record.ok) return;
      this.#paper.mend();
      this.#changed();
    });
  }

  connectedCallback() {
    // What was set before the element was defined hides the accessor.
    if (Object.hasOwn(this, 'frame')) {
      const digits = this.frame;
      delete this.frame;
      this.frame = digits;
    }
    if (!this.#paper) this.#read();
  }

  attributeChangedCallback(name) {
    if (!this.#paper) return;
    if (name === 'checks') {
      this.#toggle.checked = this.checks === 'follow';
    } else if (LOOKS.includes(name)) {
      this.#renew();
    } else if (!this.#late) {
      // One frame for all attributes that change together.
      this.#late = true;
      queueMicrotask(() => {
        this.#late = false;
        this.#read();
      });
    }
  }

  /** The frame as it is now, in digits; setting it sets the attribute. */
  get frame() {
    return this.#view?.frame ?? this.getAttribute('frame') ?? '';
  }

  set frame(digits) {
    this.setAttribute('frame', digits);
  }

  /** The frame as `change` events tell it; null where the attributes are wrong. */
  get record() {
    const view = this.#view;
    return view ? { ...view.record, frame: view.frame } : null;
  }

  /** Turns a bit over, as a click does. */
  flip(index) {
    if (!this.#view || this.readOnly || !(index in this.#cells)) return;
    this.#paper.flip(index, this.checks);
    this.#changed();
  }

  get readOnly() {
    return this.hasAttribute('readonly');
  }

  /** Whether checks `follow` what is changed, or `stay` as they are and fail. */
  get checks() {
    return this.getAttribute('checks') === 'stay' ? 'stay' : 'follow';
  }

  #changed() {
    this.#show();
    this.dispatchEvent(new CustomEvent('change', { bubbles: true, composed: true, detail: this.record }));
  }

  /** Makes the frame that the attributes say. */
  #read() {
    const pairs = [...parameters().split(' '), ...CONTENT]
      .filter((name) => this.hasAttribute(name))
      .flatMap((name) => [name, this.getAttribute(name)]);
    this.#speak();
    this.#paper?.free();
    this.#paper = new Paper(pairs.join('\0'));
    this.#build();
  }

  get #lang() {
    return this.lang || this.closest('[lang]')?.lang;
  }

  #speak() {
    this.#t = voice(this.#lang);
  }

  /** The same frame once more, in another look or language. */
  #renew() {
    if (this.#view) this.#build();
    else this.#read();
  }

  #look() {
    this.#speak();
    return JSON.parse(this.#paper.view());
  }

  /** The name of a field for people. */
  #title(note) {
    return this.#t(note.name).replaceAll('_', ' ');
  }

  #build() {
    coming(this.#lang)?.then(() => this.#renew());
    const view = this.#look();
    const t = this.#t;
    this.#view = undefined;
    if (view.error) {
      const wrong = make('p', { className: 'box wrong', role: 'alert' }, view.error);
      this.shadowRoot.replaceChildren(make('slot'), wrong);
      return;
    }
    const notes = view.notes;
    this.#owner = Array.from(view.bits, () => -1);
    notes.forEach((note, index) => {
      for (const { start, len } of note.spans) this.#owner.fill(index, start, start + len);
    });
    this.#here = 0;
    this.#cells = Array.from(view.bits, (_, at) => this.#cell(at, notes));
    this.#rows = notes.map((note, index) => this.#row(note, index));
    this.#verdict = make('p', { className: 'verdict', role: 'status' });
    const bits = make('div', { className: 'bits', role: 'group', ariaLabel: t('Bits of the frame, in order of transmission') });
    if (view.clocked) {
      bits.append(...this.#cells);
    } else {
      for (let at = 0; at < this.#cells.length; at += 8) {
        bits.append(make('span', { className: 'octet' }, ...this.#cells.slice(at, at + 8)));
      }
    }
    bits.addEventListener('keydown', (event) => this.#walk(event));
    const fields = make('ul', { className: 'fields', ariaLabel: t('Fields of the frame') }, ...this.#rows.map((row) => row.item));
    const box = make('div', { className: 'box' }, make('p', { className: 'title' }, view.title), bits);
    this.#toggle.checked = this.checks === 'follow';
    if (!this.readOnly && notes.some((note) => note.class === 'check')) {
      box.append(make('label', { className: 'checks' }, this.#toggle, t('checks follow')));
    }
    box.append(this.#verdict, fields);
    box.addEventListener('pointerleave', () => this.#light());
    box.addEventListener('focusout', () => this.#light());
    this.shadowRoot.replaceChildren(box);
    this.#show();
  }

  #cell(at, notes) {
    const note = notes[this.#owner[at]];
    const cell = make('button', {
      type: 'button',
      className: `bit ${note?.class ?? ''}${this.#owner[at - 1] === this.#owner[at] ? '' : ' first'}`,
      tabIndex: at ? -1 : 0,
    });
    if (this.readOnly) cell.ariaDisabled = 'true';
    cell.addEventListener('pointerenter', () => this.#light(this.#owner[at]));
    cell.addEventListener('focus', () => {
      this.#cells[this.#here].tabIndex = -1;
      this.#here = at;
      cell.tabIndex = 0;
      this.#light(this.#owner[at]);
    });
    cell.addEventListener('click', () => this.flip(at));
    return cell;
  }

  #row(note, index) {
    const says = make('span', { className: 'says' });
    const fault = make('p', { className: 'fault' });
    // Leads from a field to its bits.
    const name = make('button', { type: 'button', className: 'name' }, this.#title(note));
    name.addEventListener('click', () => this.#cells[note.spans[0].start].focus());
    name.addEventListener('focus', () => this.#light(index));
    const bits = note.bits.map((bit) => {
      const item = make('li', {}, make('b', {}, this.#t(bit.name)));
      if (bit.doc) item.append(make('span', { className: 'doc' }, ` – ${bit.doc}`));
      return item;
    });
    const list = make('ul', {}, ...bits);
    const width = note.spans.reduce((sum, span) => sum + span.len, 0);
    const item = make(
      'li',
      { className: `field ${note.class}` },
      name,
      make('small', {}, [width, this.#t('bit')].join(' ')),
      make('div', {}, says, list, fault, make('p', { className: 'doc' }, note.doc)),
    );
    item.addEventListener('pointerenter', () => this.#light(index));
    return { item, says, list, fault, bits };
  }

  /** Writes what can change while bits do: elements stay, and so does the focus. */
  #show() {
    const view = (this.#view = this.#look());
    const t = this.#t;
    this.#cells.forEach((cell, at) => {
      const note = view.notes[this.#owner[at]];
      cell.textContent = view.bits[at];
      cell.ariaLabel = [[t('bit'), at].join(' '), note && this.#title(note), view.bits[at]].join(', ');
    });
    this.#rows.forEach(({ item, says, list, fault, bits }, index) => {
      const note = view.notes[index];
      says.textContent = note.text;
      // Bits that explain themselves say it again, and what to do.
      says.hidden = note.bits.some((bit) => bit.set && bit.doc);
      fault.textContent = note.fault ?? '';
      item.classList.toggle('faulty', note.fault !== null);
      bits.forEach((bit, place) => (bit.hidden = !note.bits[place].set));
      list.hidden = bits.every((bit) => bit.hidden);
    });
    const { ok, error, warning, degrees, turns } = view.record;
    const said = ok
      ? [
          t('good frame'),
          degrees !== null && `${degrees}°`.replace('.', t('.')),
          turns !== null && [t('turns'), turns].join(': '),
          error && t('the encoder says that the position is not valid'),
          warning && t('the encoder warns'),
        ]
      : [t('refused by a receiver'), ...view.faults];
    this.#verdict.textContent = said.filter(Boolean).join('; ');
    this.#verdict.className = `verdict ${!ok ? 'bad' : error || warning ? 'warn' : 'good'}`;
  }

  /** Shows which bits and which field belong together. */
  #light(field) {
    const light = (element, lit) => {
      element.classList.toggle('lit', lit);
      element.ariaCurrent = lit ? 'true' : null;
    };
    this.#cells.forEach((cell, at) => light(cell, field !== undefined && this.#owner[at] === field));
    this.#rows.forEach(({ item }, index) => light(item, index === field));
  }

  #walk(event) {
    const last = this.#cells.length - 1;
    const to = {
      ArrowLeft: this.#here - 1,
      ArrowRight: this.#here + 1,
      Home: 0,
      End: last,
    }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    this.#cells[Math.max(0, Math.min(to, last))].focus();
  }
}

if (customElements) {
  try {
    await init();
    if (!customElements.get('encoder-frame')) customElements.define('encoder-frame', EncoderFrame);
  } catch (why) {
    console.warn(`encoder-frame: ${why}`);
  }
}
