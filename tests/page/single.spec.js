// The page in one file, opened from the disk with the network off.
import { test as base } from '@playwright/test';
import { copyFileSync, mkdtempSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { at, expect, expectLink, number, until } from './page.js';
import { Encoder, options } from './encoder.js';
import { tour } from './tour.js';

const built = new URL('../../dist/encoderscope.html', import.meta.url).pathname;
let folder;
let address;

// Nothing that lies beside it can help.
base.beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), 'encoderscope-'));
  copyFileSync(built, join(folder, 'encoderscope.html'));
  address = `file://${folder}/encoderscope.html`;
});
base.afterAll(() => rmSync(folder, { recursive: true }));

const test = base.extend({
  page: async ({ page, context }, use) => {
    const errors = [];
    page.on('pageerror', (error) => errors.push(`${error}`));
    page.on('console', (message) => {
      if (message.type() === 'error' || message.type() === 'warning') errors.push(message.text());
    });
    context.on('request', (request) => {
      if (request.url().split('#')[0] !== address && !/^(data|blob):/.test(request.url())) {
        errors.push(`asked for ${request.url()}`);
      }
    });
    await context.setOffline(true);
    await use(page);
    expect(errors).toEqual([]);
  },
});

test('every view is there', async ({ page }) => {
  test.setTimeout(120_000);
  await page.goto(address);
  await until(page, 'angle', (angle) => angle > 0);
  await tour(page);
  expect(page.workers().length).toBe(2);
  console.log(`the page in one file: ${statSync(built).size} bytes`);
  // A link leads into it too.
  await page.goto('about:blank');
  await page.goto(`${address}#/explain?format=t485&direction=received&frame=1a2029c03b17000000c837`);
  await expect(at(page, 'explain-frame')).toHaveValue('1A2029C03B17000000C837');
});

test('nothing else can run in it, and it can ask nobody', async ({ page }) => {
  await page.goto(address);
  await until(page, 'angle', (angle) => angle > 0);
  const policy = await page.locator('meta[http-equiv]').getAttribute('content');
  expect(policy).toContain("connect-src 'none'");
  expect(policy).not.toContain('unsafe-inline');
  expect(policy).not.toMatch(/'unsafe-eval'|https?:|\*/);
});

test('an encoder is read over Web Serial @serial', async ({ page }) => {
  const query = 'format=t485&angle-bits=23&baud=2500000';
  const encoder = await Encoder.start(...options(query), 'turning=0.2');
  await page.goto(`${address}#/console?${query}`);
  await at(page, 'connect').click();
  await expectLink(page, 'reading');
  const first = await number(page, 'angle');
  await until(page, 'angle', (angle) => Math.abs(angle - first) > 100_000);
  await until(page, 'frames-ok', (frames) => frames > 300);
  // The worker reads it, as from a server.
  const held = await page.workers()[0].evaluate(async () => {
    const [port] = await navigator.serial.getPorts();
    return port.readable.locked;
  });
  expect(held).toBe(true);
  await encoder.unplug();
  await expectLink(page, 'lost');
});
