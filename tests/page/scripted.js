// A scripted `navigator.serial`: ports that answer, fail, hang and go away as a test says.
// The engine runs on the page, where the script is; a worker has a `navigator` of its own.

/** A good reply of a T485 encoder to "all": 23 bits, angle 1 818 665. */
const REPLY = [0x1a, 0x20, 0x29, 0xc0, 0x3b, 0x17, 0, 0, 0, 0xc8, 0x37];

const install = ({ described, reply }) => {
  window.Worker = class {
    constructor() {
      throw new Error('no workers here');
    }
  };
  const never = () => new Promise(() => {});
  const raised = (name) => new DOMException(`scripted ${name}`, name);

  class Port {
    /** What happens: 'never', or the name of the error; nothing where all goes well. */
    opening = null;
    closing = null;
    cancelling = null;
    writing = null;
    /** The error that every new stream fails with at once. */
    storm = null;
    /** What is answered to a write, and whether anything is. */
    reply = reply;
    mute = false;
    opened = 0;
    writes = 0;
    streams = 0;
    ondisconnect = null;
    #open = false;
    #dead = false;
    #readable = null;
    #writable = null;
    #out = null;

    constructor(options) {
      Object.assign(this, options);
    }

    getInfo() {
      return { usbVendorId: this.vendor, usbProductId: this.product };
    }

    async open() {
      this.opened += 1;
      if (this.opening === 'never') await never();
      if (this.opening) throw raised(this.opening);
      if (this.#open) throw raised('InvalidStateError');
      this.#open = true;
      this.#dead = false;
    }

    async close() {
      if (this.#readable?.locked || this.#writable?.locked) throw new TypeError('locked');
      if (this.closing === 'never') await never();
      this.#open = false;
      this.#readable = null;
      this.#writable = null;
    }

    get readable() {
      if (!this.#open || this.#dead) return null;
      if (this.#readable) return this.#readable;
      this.streams += 1;
      const stream = new ReadableStream({
        start: (controller) => {
          this.#out = controller;
        },
        cancel: () => {
          this.#out = null;
          return this.cancelling === 'never' ? never() : undefined;
        },
      });
      this.#readable = stream;
      if (this.storm) this.fail(this.storm);
      return stream;
    }

    get writable() {
      if (!this.#open || this.#dead) return null;
      this.#writable ??= new WritableStream({ write: (bytes) => this.#take(bytes) });
      return this.#writable;
    }

    #take() {
      this.writes += 1;
      if (this.writing === 'never') return never();
      if (this.writing) {
        this.#writable = null;
        throw raised(this.writing);
      }
      if (!this.mute) setTimeout(() => this.say(this.reply), 1);
      return undefined;
    }

    /** The encoder says something. */
    say(bytes) {
      this.#out?.enqueue(new Uint8Array(bytes));
    }

    /** The stream fails; unless the error is fatal, another takes its place. */
    fail(name) {
      if (name === 'NetworkError') this.#dead = true;
      this.#readable = null;
      this.#out?.error(raised(name));
      this.#out = null;
    }

    /** The stream ends, as if the port had been closed. */
    end() {
      this.#dead = true;
      this.#readable = null;
      this.#out?.close();
      this.#out = null;
    }

    /** The device goes away; how the streams take it is another matter. */
    disconnect() {
      ports.splice(ports.indexOf(this), 1);
      this.ondisconnect?.(new Event('disconnect'));
    }

    /** The plug is pulled. */
    unplug() {
      this.fail('NetworkError');
      this.#open = false;
      this.#writable = null;
      this.disconnect();
    }

    /** The plug is put back. */
    plug() {
      ports.push(this);
      serial.onconnect?.(new Event('connect'));
    }
  }

  const ports = described.map((options) => new Port(options));
  const serial = {
    onconnect: null,
    getPorts: async () => [...ports],
    requestPort: async () => {
      throw raised('NotFoundError');
    },
  };
  Object.defineProperty(Navigator.prototype, 'serial', { get: () => serial });
  window.scripted = [...ports];
};

/** Gives a page ports of its own; `window.scripted` has them. */
export const script = (page, ...described) =>
  page.addInitScript(install, { described, reply: REPLY });

/** Lets a scripted port do something, or sets what it is to do. */
export const tell = (page, act, argument = null, index = 0) =>
  page.evaluate(
    ([act, argument, index]) => {
      const port = window.scripted[index];
      if (typeof port[act] === 'function') port[act](argument);
      else port[act] = argument;
    },
    [act, argument, index],
  );

/** A count of a scripted port: `opened`, `writes`, `streams`. */
export const count = (page, what, index = 0) =>
  page.evaluate(([what, index]) => window.scripted[index][what], [what, index]);
