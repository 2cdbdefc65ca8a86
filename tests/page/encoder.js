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
  /**
   * Starts an encoder: profile parameters as options, then settings; with `tell=1` the bytes that
   * come in are in `heard`.
   */
  static async start(...words) {
    const encoder = new Encoder();
    encoder.process = spawn(binary, words, { stdio: ['pipe', 'pipe', 'inherit'] });
    encoder.ended = new Promise((resolve) => encoder.process.once('exit', resolve));
    const lines = createInterface({ input: encoder.process.stdout });
    encoder.heard = [];
    const [pty] = await Promise.race([
      new Promise((resolve) => lines.once('line', (line) => resolve([line]))),
      encoder.ended.then((code) => {
        throw new Error(`the encoder ended with ${code}`);
      }),
    ]);
    lines.on('line', (line) => encoder.heard.push(...Buffer.from(line, 'hex')));
    execFileSync('mount', ['--bind', pty, port]);
    encoder.bound = true;
    return encoder;
  }

  /** Changes a setting, `name=value`. */
  set(setting) {
    this.process.stdin.write(`${setting}\n`);
  }

  /** Pulls the plug: the other end of the pty is gone. */
  async unplug() {
    this.process.stdin.end();
    await this.ended;
    if (this.bound) execFileSync('umount', ['--lazy', port]);
    this.bound = false;
  }
}
