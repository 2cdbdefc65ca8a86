// What tests have measured, a file each, until it becomes a table.
import { mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';

export class Records {
  constructor(name) {
    this.folder = new URL(`../../target/${name}/`, import.meta.url).pathname;
  }

  /** Keeps what was measured under a name, instead of what was measured under it before. */
  keep(name, figures) {
    mkdirSync(this.folder, { recursive: true });
    const file = name.replace(/[^a-z0-9]+/gi, '-').toLowerCase();
    writeFileSync(`${this.folder}${file}.json`, JSON.stringify({ ...figures, at: Date.now() }));
  }

  /** All of it, in the order in which it was measured. */
  kept() {
    return readdirSync(this.folder)
      .filter((name) => name.endsWith('.json'))
      .map((name) => JSON.parse(readFileSync(`${this.folder}${name}`, 'utf8')))
      .sort((one, other) => one.at - other.at);
  }
}
