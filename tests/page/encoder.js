// The emulated encoder behind a pty, bound over the serial port that Chromium lists.
import { execFileSync, spawn } from 'node:child_process';
import { createInterface } from 'node:readline';

const binary = process.env.PTY_ENCODER ?? new URL('../../target/debug/pty-encoder', import.meta.url).pathname;
const port = '/dev/ttyS0';

/** Puts something over the port that is no serial line; returns what takes it away again. */
export const blockPort = () => {
  execFileSync('mount', ['--bind', '/dev/null', port]);
  return () => execFileSync('umount', ['--lazy', port]);
};

/** The options of an encoder from the parameters of a link. */
export const options = (query) =>
  [...new URLSearchParams(query)].flatMap(([name, value]) => [`--${name}`, value]);

export class Encoder {
  /** Starts an encoder: profile parameters as options, then settings. */
  static async start(...words) {
    const encoder = new Encoder();
    encoder.process = spawn(binary, words, { stdio: ['pipe', 'pipe', 'inherit'] });
    // It may have pulled its plug before it is told something.
    encoder.process.stdin.on('error', () => {});
    encoder.ended = new Promise((resolve) => encoder.process.once('exit', resolve));
    encoder.lines = createInterface({ input: encoder.process.stdout })[Symbol.asyncIterator]();
    const { value: pty, done } = await encoder.lines.next();
    if (done) throw new Error(`the encoder ended with ${await encoder.ended}`);
    execFileSync('mount', ['--bind', pty, port]);
    encoder.bound = true;
    return encoder;
  }

  /** Changes a setting, `name=value`. */
  set(setting) {
    this.process.stdin.write(`${setting}\n`);
  }

  /** What it has sent and heard so far, and what it holds. */
  async tell() {
    this.set('tell');
    return JSON.parse((await this.lines.next()).value);
  }

  /** Pulls the plug, if it is not out: the other end of the pty is gone. Returns what it tells in the end. */
  async unplug() {
    this.process.stdin.end();
    await this.ended;
    if (this.bound) execFileSync('umount', ['--lazy', port]);
    this.bound = false;
    this.last ??= (await this.lines.next()).value;
    return this.last && JSON.parse(this.last);
  }
}
