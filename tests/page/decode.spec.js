// The decoder and the JavaScript module, with the frames of the vectors.
import { readFileSync } from 'node:fs';
import { FORMATS, at, expect, test } from './page.js';

const vectors = JSON.parse(readFileSync(new URL('../vectors.json', import.meta.url)));
const commands = { 30: '0', 31: '1', 64: 'd', 74: 't' };

/** Profile and expected record of a vector, or nothing where it is not a whole frame. */
const parse = ({ protocol, params, expected }) => {
  const low = (bit) => (bit === undefined ? undefined : bit === 0);
  switch (protocol) {
    case 'T485':
      return expected.meaning
        ? undefined
        : {
            profile: { format: 't485', angleBits: params.st_bits },
            ok: expected.crc_ok,
            angle: expected.abs,
            turns: expected.multiturn,
            status: expected.sf,
            error: expected.encoder_error,
            enid: expected.enid,
            alarm: expected.almc,
          };
    case 'BiSS-C': // the vectors write it in capitals
    case 'BISS-C': {
      const turnsBits = expected.mt_bits ?? 0;
      return {
        profile: {
          format: 'biss-c',
          angleBits: expected.st_bits ?? params.data_bits,
          turnsBits,
          statusBits: params.status_bits,
        },
        ok: expected.crc_ok,
        angle: turnsBits ? expected.singleturn : expected.position,
        turns: expected.multiturn,
        error: expected.error_active,
        warning: expected.warning_active,
      };
    }
    case 'BISS-C MPP/PT':
      return {
        profile: {
          format: 'biss-c',
          angleBits: params.X,
          turnsBits: params.mt_bits,
          statusBits: expected.status === undefined ? 0 : 6,
        },
        ok: true,
        angle: expected.singleturn,
        turns: expected.multiturn ?? undefined,
        error: low(expected.error_bit),
        warning: low(expected.warning_bit),
        status: expected.status,
      };
    case 'RS485':
      return {
        profile: { format: 'rs485', command: commands[params.cmd] },
        ok: true,
        angle: expected.singleturn,
        turns: expected.multiturn,
        count: expected.count,
        temperature: expected.temp_c,
        status: expected.status && expected.status & 0x3f,
        error: expected.error,
        warning: expected.warning,
      };
    case 'BUS':
      return {
        profile: { format: 'bus' },
        ok: expected.crc_ok,
        angle: expected.singleturn,
        turns: expected.multiturn,
        address: expected.addr,
        operation: expected.op,
        status: expected.status,
      };
    case 'ASI1':
      return {
        profile: { format: 'asi1', angleBits: 22 },
        ok: expected.crc_ok,
        angle: expected.pd,
        valid: expected.pv === 1,
        zeroDefault: expected.zpd === 1,
        error: expected.pv === 0,
      };
    case 'SSI7':
      return {
        profile: { format: 'ssi7' },
        ok: expected.parity_ok,
        angle: expected.pd,
        error: expected.alarm === 1,
      };
    case 'SSI fir-tree':
      return expected.bits_gray_whole_word
        ? {
            profile: {
              format: 'ssi-tree',
              angleBits: params.pos_bits,
              turnsBits: params.turn_bits,
            },
            text: expected.bits_gray_whole_word,
            ok: true,
            angle: expected.position,
            turns: expected.turns,
          }
        : undefined;
    default:
      return undefined;
  }
};

const cases = vectors
  .map((vector) => ({ id: vector.id, text: vector.hex || vector.bits, ...parse(vector) }))
  .filter((vector) => vector.profile);
const kebab = (name) => name.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);
const query = (profile) =>
  Object.entries(profile)
    .map(([name, value]) => `${kebab(name)}=${value}`)
    .join('&');

test('the vectors are all here', () => {
  expect(cases.length).toBe(6 + 12 + 5 + 4 + 1 + 8 + 3 + 3);
});

for (const { id, text, profile, ...expected } of cases) {
  test(`decodes ${id}`, async ({ page }) => {
    await page.goto(`/#/decode?${query(profile)}`);
    await at(page, 'dump-input').fill(text);
    const row = at(page, 'dump-row');
    await expect(row).toHaveCount(1);
    await expect(row).toHaveAttribute('data-ok', String(expected.ok));
    if (expected.angle !== undefined) {
      await expect(row).toHaveAttribute('data-angle', String(expected.angle));
    }
    if (expected.turns !== undefined && expected.turns !== null) {
      await expect(row).toHaveAttribute('data-turns', String(expected.turns));
    }
    await expect(at(page, 'dump-skip')).toHaveCount(0);

    const decoded = await page.evaluate(
      async ([profile, text]) => (await import('./encoderscope.js')).decode(profile, text),
      [profile, text],
    );
    expect(decoded.frames).toHaveLength(1);
    for (const [name, value] of Object.entries(expected)) {
      if (value !== undefined) expect(decoded.frames[0][name], name).toBe(value);
    }
  });
}

for (const format of FORMATS) {
  test(`the example of ${format} is read, explained and encoded again`, async ({ page }) => {
    await page.goto(`/#/decode?format=${format}`);
    await at(page, 'example').click();
    const rows = at(page, 'dump-row');
    await expect(rows.first()).toBeVisible();
    const oks = await rows.evaluateAll((rows) => rows.map((row) => row.dataset.ok));
    expect(oks.length).toBeGreaterThan(1);
    expect(new Set(oks)).toEqual(new Set(['true']));
    await expect(at(page, 'explain-field').first()).toBeVisible();
    const same = await page.evaluate(async (format) => {
      const scope = await import('./encoderscope.js');
      const values = { turns: 0, angle: 1234, error: false };
      const text = scope.encode({ format }, values);
      const [frame] = scope.decode({ format }, text).frames;
      return { ok: frame.ok, angle: frame.angle, notes: scope.explain({ format }, text).length };
    }, format);
    expect(same).toMatchObject({ ok: true, angle: 1234 });
    expect(same.notes).toBeGreaterThan(1);
  });
}

const good = '1a 20 29 c0 3b 17 00 00 00 c8 37';

test('pointing at a bit lights its field, and the other way round', async ({ page }) => {
  await page.goto('/#/decode?format=t485');
  await at(page, 'dump-input').fill(`${good}\n1a 20 83 c1 52 17 00 00 00 c8 f5`);
  await expect(at(page, 'explain-bit')).toHaveCount(88);
  await at(page, 'explain-bit').nth(20).hover();
  const lit = page.locator('.field.lit');
  await expect(lit).toHaveCount(1);
  await expect(lit).toHaveAttribute('data-field', 'angle');
  await expect(lit).toHaveAttribute('data-value', '3915817');
  await page.locator('[data-testid=explain-field][data-field=angle]').hover();
  await expect(page.locator('.bit.lit')).toHaveCount(23);
  await at(page, 'dump-row').nth(1).click();
  await expect(page.locator('[data-testid=explain-field][data-field=angle]')).toHaveAttribute('data-value', '5423491');
});

test('garbage, half frames and wrong CRCs are shown and counted, never as a good angle', async ({ page }) => {
  await page.goto('/#/decode?format=t485');
  await at(page, 'dump-input').fill(
    `${good}\nde ad be ef\n${good}\n1a 20 83 c1 53 17 00 00 00 c8 f5\n${good}\n1a 20 29`,
  );
  const rows = at(page, 'dump-row');
  await expect(rows).toHaveCount(4);
  const verdicts = await rows.evaluateAll((all) => all.map((row) => row.dataset.ok));
  expect(verdicts).toEqual(['true', 'true', 'false', 'true']);
  await expect(rows.nth(2)).toContainText('the data gives');
  await expect(rows.nth(2).locator('td.angle')).toHaveText('–');
  const skips = at(page, 'dump-skip');
  await expect(skips).toHaveCount(2);
  await expect(skips.first()).toContainText('4 bytes of no frame');
  await expect(skips.last()).toContainText('3 of 11 bytes');
  await expect(page.locator('.sums h2')).toContainText('3 good · 1 bad · 7 bytes skipped');
});

test('nonsense does no harm', async ({ page }) => {
  for (const format of ['t485', 'rs485', 'biss-c']) {
    await page.goto(`/#/decode?format=${format}`);
    for (const text of ['zz', '0x', '🙂 <b>1a</b>', '1'.repeat(5000), 'ff '.repeat(3000), '\u0000\u0001', '-1 9999999']) {
      await at(page, 'dump-input').fill(text);
      await expect(at(page, 'read-note')).toBeVisible();
      await expect(page.locator('[data-ok=true]')).toHaveCount(0);
    }
  }
  await at(page, 'dump-input').fill('82 zz 00');
  await expect(at(page, 'read-note')).toContainText('1 piece cannot be read');
  await expect(at(page, 'unread')).toHaveText('zz');
});

test('the JavaScript module keeps its names', async ({ page }) => {
  await page.goto('/');
  const seen = await page.evaluate(async () => {
    const scope = await import('./encoderscope.js');
    const profile = { format: 'rs485', angleBits: 24, command: 'd' };
    const hex = scope.encode(profile, { turns: 5, angle: 1193046, warning: true, status: 16 });
    const thrown = (run) => {
      try {
        run();
        return 'nothing';
      } catch (error) {
        return String(error.message);
      }
    };
    return {
      formats: scope.formats().map(({ format }) => format),
      hex,
      back: scope.decode(profile, hex).frames[0],
      notes: scope.explain(profile, hex).map(({ name }) => name),
      model: scope.parseModel('MPP-20-30-A-24BM-R-N-A-M'),
      wrongModel: thrown(() => scope.parseModel('MPP-20-30-A-24BM-Q-N-A-M')),
      wrongProfile: thrown(() => scope.decode({ format: 'nothing' }, '')),
    };
  });
  expect(seen.formats).toEqual(FORMATS);
  expect(seen.back).toMatchObject({ ok: true, turns: 5, angle: 1193046, warning: true, error: false, status: 16 });
  expect(seen.notes).toEqual(['turns', 'angle', 'error', 'warning', 'status', 'crc']);
  expect(seen.model).toMatchObject({ format: 'rs485', angleBits: 24, turnsBits: 16, series: 'MPP' });
  expect(seen.wrongModel).toContain('part 6');
  expect(seen.wrongProfile).toContain(`known: ${FORMATS.join(' ')}`);
});
