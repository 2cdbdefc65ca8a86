// Bare pages that import the package: without a bundler, from elsewhere, under policies.
import { test as quiet } from '@playwright/test';
import { FORMATS } from '../page/page.js';
import { expect, field, shown, test, verdict } from './element.js';

test('a bare page imports both modules from node_modules', async ({ page }) => {
  await page.goto('/bare.html');
  await expect(page.locator('output')).toHaveText(`168.0486345 ${FORMATS.length}`);
  await expect(verdict(page.locator('#biss'))).toHaveText('good frame; 180°; turns: 5');
  await expect(page.getByText('seven bytes')).toBeHidden();
  await expect(verdict(page.locator('#reply'))).toContainText('обороты: 0');
  await expect(page.locator('#wrong').getByRole('alert')).toBeVisible();
  await expect(page.getByText('eleven bytes', { exact: true })).toBeVisible();
});

test('from another origin, under a policy without unsafe-inline', async ({ page }) => {
  await page.goto('http://localhost:8092/elsewhere.html');
  const element = page.locator('encoder-frame');
  await expect(field(element, 'angle')).toContainText('123.4');
  const before = await shown(element);
  await element.getByRole('button', { name: /, angle, / }).first().click();
  await expect.poll(() => shown(element)).not.toBe(before);
  await expect(verdict(element)).toHaveClass(/good/);
  // The style sheet is in force.
  await expect(element.locator('.bits')).toHaveCSS('display', 'flex');
});

// Their consoles say what is missing.
quiet('what stands in the element stays where WASM is not allowed', async ({ page }) => {
  const said = page.waitForEvent('console', (message) => message.text().startsWith('encoder-frame: '));
  await page.goto('/no-wasm.html');
  await said;
  await expect(page.getByText('a word in print')).toBeVisible();
});

quiet('what stands in the element stays where the WASM cannot be fetched', async ({ page }) => {
  await page.route('**/*.wasm', (route) => route.abort());
  const said = page.waitForEvent('console', (message) => message.text().startsWith('encoder-frame: '));
  await page.goto('/bare.html');
  await said;
  await expect(page.getByText('seven bytes')).toBeVisible();
});
