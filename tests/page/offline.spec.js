// The page without the network, and new versions of it.
import { test as base } from '@playwright/test';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { build, preview } from 'vite';
import { at, expect, until } from './page.js';
import { tour } from './tour.js';

const top = new URL('../..', import.meta.url).pathname;
const configFile = join(top, 'vite.config.js');
const port = 8090;

/** Serves a built page until it is stopped. */
const serve = async (outDir) => {
  const server = await preview({ root: top, configFile, logLevel: 'warn', preview: { port }, build: { outDir } });
  return async () => {
    server.httpServer.closeAllConnections();
    await server.close();
  };
};

/** The page is kept: a service worker is active. */
const kept = async (page) => {
  await expect
    .poll(() => page.evaluate(async () => (await navigator.serviceWorker.getRegistration())?.active?.state), {
      timeout: 20_000,
    })
    .toBe('activated');
};

const test = base.extend({
  baseURL: `http://localhost:${port}`,
  /** `serve(folder)` instead of the folder that is served. */
  site: async ({}, use) => {
    let stop = await serve('dist');
    await use({
      stop: () => stop(),
      change: async (folder) => {
        await stop();
        stop = await serve(folder);
      },
    });
    await stop();
  },
  page: async ({ page, site }, use) => {
    const errors = [];
    page.on('pageerror', (error) => errors.push(`${error}`));
    page.on('console', (message) => {
      if (message.type() === 'error' || message.type() === 'warning') errors.push(message.text());
    });
    await use(page);
    expect(errors).toEqual([]);
  },
});

test('after one visit every view is there without the network', async ({ page, context, site }) => {
  test.setTimeout(120_000);
  await page.goto('/');
  await until(page, 'angle', (angle) => angle > 0);
  await kept(page);

  await context.setOffline(true);
  await page.reload();
  await tour(page);
  await context.setOffline(false);

  await site.stop();
  const later = await context.newPage();
  await later.goto('/');
  await tour(later);
  // What other programs import is kept too.
  const frame = await later.evaluate(async () => {
    const { decode } = await import('./encoderscope.js');
    await import('./encoder-frame.js');
    await customElements.whenDefined('encoder-frame');
    return decode({ format: 't485', angleBits: 23 }, '1a 20 29 c0 3b 17 00 00 00 c8 37').frames[0].angle;
  });
  expect(frame).toBe(3915817);
});

test('the page can be installed', async ({ page, context }) => {
  await page.goto('/');
  await kept(page);
  const session = await context.newCDPSession(page);
  const { errors, url } = await session.send('Page.getAppManifest');
  expect(url).toContain('manifest.webmanifest');
  expect(errors).toEqual([]);
  const { installabilityErrors } = await session.send('Page.getInstallabilityErrors');
  // The browser of the tests keeps nothing.
  expect(installabilityErrors.filter(({ errorId }) => errorId !== 'in-incognito')).toEqual([]);
});

test.describe('a new version', () => {
  const title = 'Encoderscope, renewed';
  let folder;

  test.beforeAll(async () => {
    folder = mkdtempSync(join(tmpdir(), 'encoderscope-'));
    await build({
      root: top,
      configFile,
      logLevel: 'warn',
      build: { outDir: folder, emptyOutDir: true },
      plugins: [
        {
          name: 'renewed',
          transformIndexHtml: (html) => html.replace('<title>Encoderscope<', `<title>${title}<`),
        },
      ],
    });
  });
  test.afterAll(() => rmSync(folder, { recursive: true }));

  /** A visit, and another one when the server has the new version. */
  const visits = async (page, site) => {
    await page.goto('/');
    await kept(page);
    await expect(at(page, 'update')).toHaveCount(0);
    await site.change(folder);
    await page.reload();
    await expect(at(page, 'update')).toContainText('A new version is ready.', { timeout: 20_000 });
    await expect(page).toHaveTitle('Encoderscope');
  };

  test('waits until it is wanted', async ({ page, site }) => {
    test.setTimeout(90_000);
    await visits(page, site);
    // Not pressing keeps the old one, and all of it.
    await page.reload();
    await expect(page).toHaveTitle('Encoderscope');
    await tour(page);
    await expect(at(page, 'update')).toBeVisible();

    let loads = 0;
    page.on('load', () => (loads += 1));
    await at(page, 'update-now').click();
    await expect(page).toHaveTitle(title);
    // It is where the old one was.
    await expect(page.locator('main .reference')).toBeVisible();
    await page.waitForTimeout(3_000);
    expect(loads).toBe(1);
    await expect(at(page, 'update')).toHaveCount(0);
  });

  const record = async (page) => {
    await at(page, 'record').click();
    await expect(at(page, 'record')).toHaveText('Stop recording');
  };
  const end = async (page) => {
    await at(page, 'record').click();
    await expect(at(page, 'record')).toHaveText('Record');
  };

  test('waits for a recording, in whatever tab it runs', async ({ page, context, site }) => {
    test.setTimeout(90_000);
    const other = await context.newPage();
    await other.goto('/');
    await at(other, 'demo').click();
    await record(other);
    await visits(page, site);
    await expect(at(page, 'update-now')).toBeDisabled();
    await expect(at(page, 'update')).toContainText('Not while a recording runs.');
    await end(other);
    await expect(at(page, 'update-now')).toBeEnabled();
    await expect(at(page, 'update')).not.toContainText('recording');

    // One that has begun since, and that nobody has told this page of.
    await record(other);
    await at(page, 'update-now').click();
    await expect(at(page, 'update-now')).toBeDisabled();
    await page.waitForTimeout(1_000);
    await expect(page).toHaveTitle('Encoderscope');
    await end(other);
    await at(page, 'update-now').click();
    await expect(page).toHaveTitle(title);
  });
});
