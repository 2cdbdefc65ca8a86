// What the tests of the custom element share.
import { test as base, expect } from '@playwright/test';

/** A page whose errors fail the test, and that may talk to nobody but the servers of the tests. */
export const test = base.extend({
  page: async ({ page }, use) => {
    const errors = [];
    page.on('pageerror', (error) => errors.push(`${error}`));
    page.on('console', (message) => {
      if (message.type() === 'error' || message.type() === 'warning') errors.push(message.text());
    });
    page.on('request', (request) => {
      if (!/^(http:\/\/localhost:809[123]\/|data:)/.test(request.url())) errors.push(`asked for ${request.url()}`);
    });
    await use(page);
    expect(errors).toEqual([]);
  },
});

export { expect };

/** A bare page with an element, and nothing else; gives the element. */
export async function show(page, html) {
  await page.goto('/empty.html');
  await page.evaluate((html) => {
    document.body.innerHTML = html;
  }, html);
  const element = page.locator('encoder-frame').first();
  await expect(element.locator('.box')).toBeVisible();
  return element;
}

export const bits = (element) => element.locator('.bit');

/** The field of a name. */
export const field = (element, name) =>
  element.getByRole('listitem').filter({ has: element.page().getByRole('button', { name, exact: true }) });

/** All bits, as they are shown. */
export const shown = async (element) => (await bits(element).allTextContents()).join('');

export const verdict = (element) => element.getByRole('status');

/** Notes the details of the `change` events that reach the document. */
export async function listen(page) {
  await page.evaluate(() => {
    window.changes = [];
    document.addEventListener('change', (event) => window.changes.push(event.detail));
  });
  return () => page.evaluate(() => window.changes);
}
