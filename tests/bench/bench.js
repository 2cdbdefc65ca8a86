// Measures one workload after the other in every way of doing it, round after round, so that what
// disturbs the machine disturbs them all; prints the table, and with --write puts it into
// docs/performance.md with the plot beside it.
//
// BENCH_MEGABYTES of each workload (64), BENCH_ROUNDS of it (3), BENCH_SECONDS of each in a round (1).
import { execFile, spawn } from 'node:child_process';
import { mkdir, readFile, rm, writeFile } from 'node:fs/promises';
import { cpus } from 'node:os';
import { promisify } from 'node:util';
import { chromium } from '@playwright/test';
import KaitaiStructCompiler from 'kaitai-struct-compiler';
import { parse } from 'yaml';
import page from '../page/playwright.config.js';
import { put } from './document.js';
import { plot } from './plot.js';
import { rows, sentences, table, targets } from './table.js';

const run = promisify(execFile);
const number = (name, usual) => Number(process.env[name] ?? usual);
const megabytes = number('BENCH_MEGABYTES', 64);
const rounds = number('BENCH_ROUNDS', 3);
const seconds = number('BENCH_SECONDS', 1);
const writes = process.argv.includes('--write');
const python = process.env.BENCH_PYTHON;

const PORT = 8094;
const ORIGIN = `http://localhost:${PORT}`;
const FOLDER = `target/bench/${megabytes}`;
const KAITAI = 'target/bench/kaitai';
/** Which of the peers in the browser read which workload. */
const PEERS = {
  period: ['idiomatic', 'tuned', 'kaitai', 'kaitai-file', 'taken', 'sum'],
  t485: ['idiomatic', 'kaitai'],
  asi1: ['idiomatic', 'kaitai'],
  'asi1-noise': ['idiomatic'],
  'biss-c': ['idiomatic', 'kaitai'],
  'biss-c-text': ['idiomatic'],
};
const DECLARED = ['period', 't485', 'asi1', 'biss-c'];
/** A loop that tries every byte takes a few frames more in noise than can be certain. */
const STRAY = 0.01;

const say = (text) => process.stderr.write(`${text}\n`);

/** The path of cargo's program for the bench. */
async function built() {
  const build = ['bench', '-q', '-p', 'encoderscope-tests', '--bench', 'throughput', '--no-run', '--message-format=json'];
  const { stdout } = await run('cargo', build, { maxBuffer: 2 ** 26 });
  const messages = stdout.split('\n').filter(Boolean).map((line) => JSON.parse(line));
  return messages.find(({ executable, target }) => executable && target.name === 'throughput').executable;
}

/** Seconds of the fastest sample of a bench of the core. */
async function native(program, id) {
  const home = 'target/bench/criterion';
  await rm(`${home}/${id}`, { recursive: true, force: true });
  await run(
    program,
    ['--bench', '--exact', id, '--warm-up-time', String(seconds / 5), '--measurement-time', String(seconds)],
    { env: { ...process.env, BENCH_MEGABYTES: String(megabytes), CRITERION_HOME: home } },
  );
  const { iters, times } = JSON.parse(await readFile(`${home}/${id}/new/sample.json`, 'utf8'));
  return Math.min(...times.map((time, index) => time / iters[index])) / 1e9;
}

async function declared(workload, part) {
  const program = 'tests/bench/peers/declared.py';
  const { stdout } = await run(python, [program, `${FOLDER}/${part.file}`, workload, String(seconds)]);
  return JSON.parse(stdout);
}

/** The declarations as JavaScript. */
async function compileKaitai() {
  await mkdir(KAITAI, { recursive: true });
  for (const name of ['period', 't485', 'asi1', 'biss_c']) {
    const source = parse(await readFile(`tests/bench/peers/${name}.ksy`, 'utf8'));
    const files = await KaitaiStructCompiler.compile('javascript', source, null, false);
    for (const [file, text] of Object.entries(files)) await writeFile(`${KAITAI}/${file}`, text);
  }
}

/** A page that runs tasks in workers. */
async function open() {
  const server = spawn('node', ['tests/package/server.js', String(PORT), '.'], { stdio: 'inherit' });
  process.once('exit', () => server.kill());
  const browser = await chromium.launch(page.use.launchOptions);
  const tab = await browser.newPage({ baseURL: ORIGIN });
  for (let tries = 0; ; tries += 1) {
    try {
      await tab.goto('/tests/bench/empty.html');
      break;
    } catch (error) {
      if (tries === 50) throw error;
      await new Promise((resolve) => setTimeout(resolve, 100));
    }
  }
  const ask = async (task) => {
    const answer = await tab.evaluate(
      (task) =>
        new Promise((resolve) => {
          const worker = new Worker('/tests/bench/worker.js', { type: 'module' });
          worker.onmessage = ({ data }) => {
            worker.terminate();
            resolve(data);
          };
          worker.onerror = (event) => resolve({ error: event.message || 'the worker did not start' });
          worker.postMessage(task);
        }),
      { ...task, kaitai: `/${KAITAI}`, seconds },
    );
    if (answer.error) throw new Error(`${task.workload}, ${task.side}: ${answer.error}`);
    return answer;
  };
  const close = async () => {
    await browser.close();
    server.kill();
  };
  return { ask, close, version: browser.version() };
}

/** Whoever reads something else is not measured. */
function check(workload, side, { frames, angles }, part) {
  const stray = workload === 'asi1-noise' && side === 'idiomatic' ? STRAY : 0;
  const near = (found, right) => Math.abs(found - right) <= right * stray;
  if (!near(frames, part.frames) || !near(angles, part.angles)) {
    throw new Error(`${workload}: ${side} reads ${frames} frames, angles ${angles}; the core ${part.frames}, ${part.angles}`);
  }
}

const { workloads, growth } = JSON.parse(await readFile(`${FOLDER}/workloads.json`, 'utf8'));
const program = await built();
await compileKaitai();
const chrome = await open();
const found = { rates: {}, growth: growth.map(({ bytes }) => ({ bytes })) };
/** Keeps the best of the rounds, in bytes a second. */
function keep(into, side, bytes, taken) {
  into[side] = Math.max(into[side] ?? 0, bytes / taken);
}

try {
  for (let round = 1; round <= rounds; round += 1) {
    for (const part of workloads) {
      const { name, profile } = part;
      const rates = (found.rates[name] ??= {});
      say(`round ${round} of ${rounds}: ${name}`);
      keep(rates, 'native', part.bytes, await native(program, `decode/${name}`));
      for (const side of ['wasm', ...PEERS[name]]) {
        const task = { workload: name, side, profile, url: `/${FOLDER}/${part.file}`, text: name.endsWith('-text') };
        const answer = await chrome.ask(task);
        if (side !== 'sum') check(name, side, answer, part);
        keep(rates, side, part.bytes, answer.seconds);
        if (name === 'asi1-noise' && side === 'idiomatic') found.stray = { loop: answer.frames, core: part.frames };
      }
      if (python && DECLARED.includes(name)) {
        const answer = await declared(name, part.short);
        check(name, 'construct', answer, part.short);
        keep(rates, 'construct', part.short.bytes, answer.seconds);
      }
    }
    say(`round ${round} of ${rounds}: limits`);
    const { bytes } = workloads[0];
    for (const limit of ['sum', 'memcpy']) {
      const taken = await native(program, `limit/${limit}`);
      for (const { name } of workloads) keep(found.rates[name], `limit-${limit}`, bytes, taken);
    }
    for (const [index, part] of growth.entries()) {
      say(`round ${round} of ${rounds}: ${part.bytes} bytes`);
      const step = found.growth[index];
      keep(step, 'native', part.bytes, await native(program, part.name.replace('-', '/')));
      const task = { workload: 'period', side: 'wasm', profile: workloads[0].profile, url: `/${FOLDER}/${part.file}` };
      const answer = await chrome.ask(task);
      check('period', 'wasm', answer, part);
      keep(step, 'wasm', part.bytes, answer.seconds);
    }
  }
} finally {
  await chrome.close();
}

const lines = table(rows(workloads, found.rates));
const machine = `${cpus().length} cores, ${process.arch}, Chromium ${chrome.version}, Node ${process.versions.node}; ${megabytes} MB a row, best of ${rounds} rounds.`;
const text = [...lines, '', machine, '', ...sentences(found), '', ...targets(found)];
if (!python) text.push('', 'Not measured: construct, which needs Python with pip.');
console.log(text.join('\n'));

if (writes) {
  await put('docs/performance.md', 'measured', text);
  await writeFile('docs/growth.svg', plot(found.growth));
}
