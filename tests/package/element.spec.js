// The custom element: what it shows, and how it is changed.
import { FORMATS } from '../page/page.js';
import { bits, expect, field, listen, show, shown, test, verdict } from './element.js';

const BISS = '<encoder-frame format="biss-c" angle-bits="17" frame="82 00 05 80 00 60 68"></encoder-frame>';

test('bits and fields of a frame', async ({ page }) => {
  const element = await show(page, BISS);
  expect(await shown(element)).toBe('10000010000000000000010110000000000000000110000001101000');
  await expect(field(element, 'turns')).toContainText('5 turns');
  await expect(field(element, 'angle')).toContainText('180.0000°');
  await expect(field(element, 'nError')).toContainText('Active low');
  await expect(field(element, 'crc')).toContainText('holds');
  await expect(verdict(element)).toHaveText('good frame; 180°; turns: 5');
});

test('a click turns a bit over, checks follow, and the document is told', async ({ page }) => {
  const element = await show(page, BISS);
  const changes = await listen(page);
  await element.getByRole('button', { name: 'bit 24, angle, 1' }).click();
  await expect(element.getByRole('button', { name: 'bit 24, angle, 0' })).toBeVisible();
  await expect(verdict(element)).toHaveText('good frame; 0°; turns: 5');
  const [{ frame, ok, angle, turns, crc, ...rest }] = await changes();
  expect({ frame, ok, angle, turns }).toEqual({ frame: await shown(element), ok: true, angle: 0, turns: 5 });
  expect(crc.ok).toBe(true);
  expect(rest).toHaveProperty('status');
  expect(await element.evaluate((it) => it.frame)).toBe(frame);
  expect(await element.evaluate((it) => it.record.angle)).toBe(0);
});

test('a bit of a check stays turned over, and is refused', async ({ page }) => {
  const element = await show(page, BISS);
  const changes = await listen(page);
  await bits(element).nth(54).click();
  await expect(verdict(element)).toContainText('refused by a receiver; crc is 0x');
  await expect(field(element, 'crc')).toHaveClass(/faulty/);
  expect((await changes())[0]).toMatchObject({ ok: false, crc: { ok: false } });
});

test('checks that stay, by attribute and by hand', async ({ page }) => {
  const element = await show(page, BISS.replace('>', ' checks="stay">'));
  const follow = element.getByRole('checkbox', { name: 'checks follow' });
  await expect(follow).not.toBeChecked();
  await bits(element).nth(24).click();
  await expect(verdict(element)).toContainText('refused');
  const changes = await listen(page);
  await follow.check();
  await expect(verdict(element)).toHaveText('good frame; 0°; turns: 5');
  expect((await changes()).map((change) => change.ok)).toEqual([true]);
  await follow.uncheck();
  await bits(element).nth(24).click();
  await expect(verdict(element)).toContainText('refused');
});

test('in the language of the document, or its own', async ({ page }) => {
  const element = await show(page, `<div lang="ru">${BISS}</div>`);
  await expect(verdict(element)).toHaveText('годный кадр; 180°; обороты: 5');
  await bits(element).nth(24).click();
  await expect(verdict(element)).toHaveText('годный кадр; 0°; обороты: 5');
  await element.evaluate((it) => it.setAttribute('lang', 'en'));
  await expect(verdict(element)).toHaveText('good frame; 0°; turns: 5');
});

test('with the keyboard alone', async ({ page }) => {
  const element = await show(page, `<a href="#">before</a>${BISS}`);
  await page.getByRole('link').focus();
  await page.keyboard.press('Tab');
  await expect(bits(element).nth(0)).toBeFocused();
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('End');
  await expect(bits(element).nth(55)).toBeFocused();
  await page.keyboard.press('Home');
  for (let at = 0; at < 8; at += 1) await page.keyboard.press('ArrowRight');
  await expect(bits(element).nth(8)).toBeFocused();
  await page.keyboard.press('Space');
  await expect(bits(element).nth(8)).toHaveText('1');
  await page.keyboard.press('Enter');
  await expect(bits(element).nth(8)).toHaveText('0');
  await expect(bits(element).nth(8)).toBeFocused();
  // One stop for all bits, then the checks, then a stop a field.
  await page.keyboard.press('Tab');
  await expect(element.getByRole('checkbox')).toBeFocused();
  await page.keyboard.press('Tab');
  await expect(element.getByRole('button', { name: 'idle', exact: true })).toBeFocused();
  await page.keyboard.press('Enter');
  await expect(bits(element).nth(0)).toBeFocused();
});

test('bits and fields light each other', async ({ page }) => {
  const element = await show(page, BISS);
  const lit = element.locator('.bit.lit');
  await bits(element).nth(30).hover();
  await expect(lit).toHaveCount(17);
  await expect(field(element, 'angle')).toHaveClass(/lit/);
  await expect(field(element, 'angle')).toHaveAttribute('aria-current', 'true');
  await expect(bits(element).nth(24)).toHaveAttribute('aria-current', 'true');
  await field(element, 'status').hover();
  await expect(lit).toHaveCount(6);
  await expect(bits(element).nth(24)).not.toHaveAttribute('aria-current');
  await element.getByRole('button', { name: 'crc', exact: true }).focus();
  await expect(field(element, 'crc')).toHaveClass(/lit/);
});

test('parts of a number light up together', async ({ page }) => {
  const element = await show(page, '<encoder-frame format="t485" frame="1a2029c03b17000000c837"></encoder-frame>');
  await bits(element).nth(16).hover();
  await expect(field(element, 'angle')).toHaveClass(/lit/);
  const lit = await bits(element).evaluateAll((all) => all.flatMap((bit, at) => (bit.matches('.lit') ? [at] : [])));
  expect(lit).toEqual([...Array(16).keys()].map((at) => 16 + at).concat([33, 34, 35, 36, 37, 38, 39]));
  await expect(verdict(element)).toContainText('168.0486345°');
  await expect(verdict(element)).toContainText('the encoder says that the position is not valid');
});

test('a frame that is for reading alone', async ({ page }) => {
  const element = await show(page, BISS.replace('>', ' readonly>'));
  const changes = await listen(page);
  const before = await shown(element);
  await bits(element).nth(24).dispatchEvent('click');
  await element.evaluate((it) => it.flip(24));
  expect(await shown(element)).toBe(before);
  expect(await changes()).toEqual([]);
  await expect(bits(element).nth(24)).toHaveAttribute('aria-disabled', 'true');
  await expect(element.getByRole('checkbox')).toHaveCount(0);
});

test('attributes that change are followed, and keep what they do not concern', async ({ page }) => {
  const element = await show(page, BISS);
  await element.evaluate((it) => {
    it.setAttribute('angle-bits', '19');
    it.setAttribute('turns-bits', '14');
  });
  await expect(verdict(element)).toHaveText('good frame; 135°; turns: 1');
  await bits(element).nth(40).click();
  const changed = await shown(element);
  await element.evaluate((it) => it.setAttribute('lang', 'ru'));
  await expect(verdict(element)).toContainText('годный кадр');
  await element.evaluate((it) => document.body.prepend(it));
  expect(await shown(element)).toBe(changed);
  await element.evaluate((it) => {
    it.frame = '82 00 05 80 00 60 69';
  });
  await expect(verdict(element)).toContainText('135°; обороты: 1');
  await element.evaluate((it) => it.setAttribute('angle-bits', '99'));
  await expect(element.getByRole('alert')).toContainText('angle-bits: 99 вне пределов 1…64 для BiSS-C');
});

test('a frame that a script has set before the element was there', async ({ page }) => {
  let open;
  const gate = new Promise((resolve) => (open = resolve));
  await page.route('**/encoder-frame_bg.wasm', async (route) => {
    await gate;
    await route.continue();
  });
  await page.goto('/empty.html', { waitUntil: 'commit' });
  await page.waitForFunction(() => document.body);
  await page.evaluate(() => {
    const element = document.createElement('encoder-frame');
    element.setAttribute('format', 't485');
    element.frame = '02 20 b4 bd 1c 37';
    document.body.append(element);
  });
  open();
  await expect(bits(page.locator('encoder-frame'))).toHaveCount(48);
  expect(await page.locator('encoder-frame').getAttribute('frame')).toBe('02 20 b4 bd 1c 37');
});

test('in Russian, with the terms of the field', async ({ page }) => {
  const element = await show(page, `<section lang="ru-RU">${BISS}</section>`);
  await expect(element.getByRole('button', { name: 'бит 24, угол, 1' })).toBeVisible();
  await expect(element.getByRole('checkbox')).toHaveAccessibleName('контроль пересчитывается');
  const other = await show(page, `<section lang="fr">${BISS}</section>`);
  await expect(verdict(other)).toContainText('good frame');
});

test('the fallback stays beside the message where a frame is wrong', async ({ page }) => {
  const wrong = async (attributes, message) => {
    const element = await show(page, `<encoder-frame ${attributes}><p>in print</p></encoder-frame>`);
    await expect(element.getByRole('alert')).toHaveText(message);
    await expect(page.getByText('in print')).toBeVisible();
  };
  await wrong('format="t485" frame="1a 20 xyz"', 'frame: "x" is no digit, neither of hexadecimal numbers nor of bits');
  await wrong('format="t485" frame=""', 'frame: there are no digits');
  await wrong('format="t485" frame="1a 20 29"', /^frame: 24 bits are no frame of this profile/);
  await wrong('format="ssi" direction="sent"', 'direction: nothing is sent to such an encoder');
  await wrong('format="ssi" direction="up"', 'direction: "up" is not known; known: sent received');
  await wrong('frame="1a"', /^format: is missing; known: ssi biss-c/);
  await wrong('format="own" layout="&lt;img src=x onerror=alert(1)>"', /^layout: a layout is TITLE/);
  const element = await show(page, `${BISS.replace('</', '<p>in print</p></')}`);
  await expect(element).toBeVisible();
  await expect(page.getByText('in print')).toBeHidden();
});

test('text of a layout is never read as HTML', async ({ page }) => {
  const layout = '&lt;img src=x onerror=alert(1)>;line;angle:8:name=&lt;b>x&lt;/b>';
  const element = await show(page, `<encoder-frame format="own" layout="${layout}" frame="40"></encoder-frame>`);
  await expect(element.locator('.title')).toHaveText('<img src=x onerror=alert(1)>');
  await expect(field(element, '<b>x</b>')).toContainText('90.0000°');
  await expect(element.locator('img')).toHaveCount(0);
});

test('every format has an example whose checks hold', async ({ page }) => {
  await show(page, BISS);
  const said = await page.evaluate(async () => {
    const { formats } = await import('./node_modules/encoderscope/encoderscope.js');
    return formats().map(({ format }) => {
      const element = document.createElement('encoder-frame');
      element.setAttribute('format', format);
      document.body.append(element);
      const names = [...element.shadowRoot.querySelectorAll('.field .name')].map((name) => name.textContent);
      return [format, element.record?.ok, names.includes('angle'), Math.round(element.record?.degrees)];
    });
  });
  expect(said).toHaveLength(FORMATS.length);
  for (const one of said) expect(one.slice(1)).toEqual([true, true, 123]);
});

test('a request and its reply', async ({ page }) => {
  const element = await show(page, '<encoder-frame format="bus" direction="sent"></encoder-frame>');
  await expect(bits(element)).toHaveCount(8);
  await element.evaluate((it) => it.setAttribute('direction', 'received'));
  await expect(field(element, 'turns')).toBeVisible();
});

test('several share one WASM, and one style sheet', async ({ page }) => {
  const element = await show(page, `${BISS}<encoder-frame format="ssi7"></encoder-frame>`);
  await expect(page.locator('encoder-frame').nth(1).locator('.box')).toBeVisible();
  const loaded = await page.evaluate(() =>
    performance.getEntriesByType('resource').filter((entry) => entry.name.endsWith('encoder-frame_bg.wasm')).length,
  );
  expect(loaded).toBe(1);
  expect(
    await element.evaluate((it) => {
      const sheets = [it, it.nextElementSibling].map((each) => each.shadowRoot.adoptedStyleSheets[0]);
      return sheets[0] === sheets[1] && document.adoptedStyleSheets.length;
    }),
  ).toBe(0);
});

test('light, dark, and colours of the page', async ({ page }) => {
  const ground = (element) => element.locator('.box').evaluate((box) => getComputedStyle(box).backgroundColor);
  const light = 'rgb(255, 254, 251)';
  const dark = 'rgb(27, 33, 37)';
  await page.emulateMedia({ colorScheme: 'light' });
  const element = await show(page, BISS);
  expect(await ground(element)).toBe(light);
  await page.emulateMedia({ colorScheme: 'dark' });
  expect(await ground(element)).toBe(dark);
  await element.evaluate((it) => it.setAttribute('theme', 'light'));
  expect(await ground(element)).toBe(light);
  await element.evaluate((it) => it.setAttribute('theme', 'page'));
  expect(await ground(element)).toBe(light);
  await element.evaluate(() => (document.documentElement.style.colorScheme = 'dark'));
  expect(await ground(element)).toBe(dark);
  await element.evaluate(() => document.body.style.setProperty('--encoder-frame-panel', 'rgb(1, 2, 3)'));
  expect(await ground(element)).toBe('rgb(1, 2, 3)');
});

test('what a screen reader is told', async ({ page }) => {
  const element = await show(page, '<encoder-frame format="ssi" angle-bits="16" frame="0x0005400050"></encoder-frame>');
  await expect(element.getByRole('group', { name: 'Bits of the frame, in order of transmission' })).toBeVisible();
  // A word without a check.
  await expect(element.getByRole('checkbox')).toHaveCount(0);
  await expect(element.getByRole('list', { name: 'Fields of the frame' })).toMatchAriaSnapshot(`
    - list "Fields of the frame":
      - listitem:
        - button "turns"
        - text: /5 turns/
      - listitem:
        - button "angle"
        - text: /90.0000°/
      - listitem:
        - button "error"
        - text: /no error/
      - listitem:
        - button "warning"
        - text: /near its limit/
      - listitem:
        - button "status"
        - list:
          - listitem: /battery low/
  `);
});
