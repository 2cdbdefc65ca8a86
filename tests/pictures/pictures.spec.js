// Pictures of every view, in both languages and themes, for docs/pictures: `make pictures`.
import { mkdirSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { test } from '@playwright/test';
import { views } from '../page/views.js';

const folder = new URL('../../docs/pictures/', import.meta.url);
const WIDE = { name: 'wide', width: 1440, height: 900 };
const SMALL = [
  { name: 'tablet', width: 1024, height: 768 },
  { name: 'phone', width: 390, height: 844 },
];
/** The views that are shown at every size. */
const EVERYWHERE = ['first', 'console', 'decode', 'explain', 'reference'];
const LOOKS = [
  ['en', 'light'],
  ['en', 'dark'],
  ['ru', 'light'],
  ['ru', 'dark'],
];

/** A picture, a third of the size that it has as PNG. */
const webp = async (page, png) => {
  const base64 = await page.evaluate(async (base64) => {
    const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${base64}`)).blob());
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
    canvas.getContext('2d').drawImage(bitmap, 0, 0);
    const blob = await canvas.convertToBlob({ type: 'image/webp', quality: 0.85 });
    const bytes = new Uint8Array(await blob.arrayBuffer());
    return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(''));
  }, png.toString('base64'));
  return Buffer.from(base64, 'base64');
};

test.beforeAll(() => {
  mkdirSync(folder, { recursive: true });
  if (process.env.ONLY) return;
  for (const name of readdirSync(folder)) if (name.endsWith('.webp')) rmSync(new URL(name, folder));
});

for (const [name, open] of Object.entries(views)) {
  for (const [language, theme] of LOOKS) {
    const small = EVERYWHERE.includes(name) && (language === 'ru') === (theme === 'dark') ? SMALL : [];
    for (const { name: size, width, height } of [WIDE, ...small]) {
      test(`${name} ${size} ${language} ${theme}`, async ({ browser }) => {
        const options = { viewport: { width, height }, colorScheme: theme, reducedMotion: 'reduce' };
        const context = await browser.newContext(options);
        const page = await context.newPage();
        await open(page, language);
        await page.waitForTimeout(1_000);
        const png = await page.screenshot();
        const plain = await context.newPage();
        writeFileSync(new URL(`${name}-${size}-${language}-${theme}.webp`, folder), await webp(plain, png));
        await context.close();
      });
    }
  }
}
