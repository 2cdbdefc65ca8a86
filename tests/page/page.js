// What the page tests share.
import { test as base, expect } from '@playwright/test';

/** A browser without service workers: what tests do to the page's requests is not kept from them. */
export const bare = base.extend({
  context: async ({ context }, use) => {
    await context.addInitScript(() => delete Navigator.prototype.serviceWorker);
    await use(context);
  },
});

/** A page whose errors fail the test, and that may talk to nobody but its own server. */
export const test = bare.extend({
  page: async ({ page }, use) => {
    const errors = [];
    page.on('pageerror', (error) => errors.push(`${error}`));
    page.on('console', (message) => {
      if (message.type() === 'error' || message.type() === 'warning') errors.push(message.text());
    });
    page.on('request', (request) => {
      if (!/^(http:\/\/(localhost|encoderscope\.test):8089\/|data:)/.test(request.url())) {
        errors.push(`asked for ${request.url()}`);
      }
    });
    await use(page);
    expect(errors).toEqual([]);
  },
});

export { expect };

/** The formats, as programs call them. */
export const FORMATS = ['ssi', 'biss-c', 'rs485', 't485', 'bus', 'period', 'asi1', 'asi4', 'ssi7', 'ssi-tree', 'as5048'];

/** The element of a `data-testid`. */
export const at = (page, id) => page.locator(`[data-testid="${id}"]`);

/** The number in an element's `data-value`. */
export const number = async (page, id) => Number(await at(page, id).getAttribute('data-value'));

/** The state of the link. */
export const link = (page) => at(page, 'link-state');

/** Waits for a link state. */
export const expectLink = (page, state) => expect(link(page)).toHaveAttribute('data-value', state);

/** Waits until a number satisfies a condition. */
export const until = (page, id, holds) =>
  expect.poll(async () => holds(await number(page, id)), { message: id }).toBe(true);

/** Frames are bad only where a reply came so late that it was missed: the one behind it is not sure. */
export const expectOnlyLateFrames = async (page) =>
  expect(await number(page, 'frames-bad')).toBeLessThanOrEqual(await number(page, 'silent'));

/** Bytes are skipped only where a reply came so late that nobody waited for it any more. */
export const expectOnlyLateBytes = async (page) =>
  expect(await number(page, 'bytes-skipped')).toBeLessThanOrEqual(64 * (await number(page, 'silent')));

/** The bytes that came, by what has become of them. */
export const bytes = (page) =>
  page.evaluate(() => {
    const of = (id) => Number(document.querySelector(`[data-testid="${id}"]`)?.dataset.value ?? 0);
    return { all: of('bytes-in'), framed: of('bytes-framed'), skipped: of('bytes-skipped'), beside: of('bytes-set') };
  });

/** Once a link has ended, every byte that came is in a frame, skipped, or came beside reading. */
export const expectAllAccounted = async (page) => {
  const { all, framed, skipped, beside } = await bytes(page);
  expect(all).toBeGreaterThan(0);
  expect(framed + skipped + beside).toBe(all);
  return all;
};

/** Ends reading. */
export const disconnect = async (page) => {
  await at(page, 'disconnect').click();
  await expectLink(page, 'closed');
};

/** Reads what a link describes, at the port. */
export const connect = async (page, query) => {
  await page.goto(`/#/console?${query}`);
  await at(page, 'connect').click();
};

/** The file that a button gives: its name and its text. */
export const download = async (page, id) => {
  const [saved] = await Promise.all([page.waitForEvent('download'), at(page, id).click()]);
  const chunks = [];
  for await (const chunk of await saved.createReadStream()) chunks.push(chunk);
  return { name: saved.suggestedFilename(), text: Buffer.concat(chunks).toString() };
};
