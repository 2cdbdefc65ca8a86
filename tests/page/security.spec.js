// What the page promises about strangers: it asks nobody but its own server, what a link or a file
// says is never run and never stops the page, and no link sends a byte to a port.
import { test as base, chromium } from '@playwright/test';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { deflateRawSync } from 'node:zlib';
import config from './playwright.config.js';
import { Encoder } from './encoder.js';
import { at, expect, expectLink, test as plain, until } from './page.js';
import { tour } from './tour.js';

const origin = 'http://localhost:8089';
const good = '1a 20 29 c0 3b 17 00 00 00 c8 37';

/** Every address that a whole browser has asked for, as its network log says. */
const asked = (log) => {
  const { constants, events } = JSON.parse(log);
  const begun = constants.logEventTypes.URL_REQUEST_START_JOB;
  return events.filter(({ type, params }) => type === begun && params?.url).map(({ params }) => params);
};

base('the whole page asks nobody but its own server', async () => {
  base.setTimeout(120_000);
  const folder = mkdtempSync(join(tmpdir(), 'encoderscope-'));
  const log = join(folder, 'net.json');
  const { launchOptions } = config.use;
  // What the browser itself asks for is not the page's doing, and is told by its initiator.
  const browser = await chromium.launch({ ...launchOptions, args: [...launchOptions.args, `--log-net-log=${log}`] });
  const page = await browser.newPage({ baseURL: origin, acceptDownloads: true });
  const complaints = [];
  page.on('console', (message) => {
    if (['error', 'warning'].includes(message.type())) complaints.push(message.text());
  });
  page.on('pageerror', (error) => complaints.push(`${error}`));
  await page.exposeFunction('violated', (what) => complaints.push(what));
  await page.addInitScript(() => {
    document.addEventListener('securitypolicyviolation', ({ violatedDirective, blockedURI }) =>
      window.violated(`${violatedDirective} ${blockedURI}`),
    );
  });
  await page.goto('/');
  await until(page, 'angle', (angle) => angle > 0);
  await tour(page);
  await expect
    .poll(() => page.evaluate(async () => (await navigator.serviceWorker.getRegistration())?.active?.state))
    .toBe('activated');
  // Once more, through the service worker.
  await page.goto('about:blank');
  await page.goto('/');
  await tour(page);
  await browser.close();
  expect(complaints).toEqual([]);

  const all = asked(readFileSync(log, 'utf8'));
  rmSync(folder, { recursive: true });
  const mine = all.map(({ url }) => url).filter((url) => url.startsWith(`${origin}/`));
  // The log has the page's files, its parts, its workers and its service worker.
  for (const file of [/page_bg/, /encoderscope_bg/, /split_reference/, /worker-/, /plot-/, /sw\.js/, /encoder-frame/]) {
    expect(mine.some((url) => file.test(url)), `${file}`).toBe(true);
  }
  const others = all.filter(({ url, initiator }) => !url.startsWith(`${origin}/`) && initiator !== 'not an origin');
  expect(others.filter(({ url }) => !/^(data|blob|about|chrome)/.test(url))).toEqual([]);
});

/** Ways in which code that has crept in would run, or tell somebody; each is stopped. */
const ways = {
  'script-src-elem': () => document.body.append(Object.assign(document.createElement('script'), { text: 'window.ran = 1' })),
  'script-src-attr': () => document.body.insertAdjacentHTML('beforeend', '<i onclick="window.ran = 1"></i>'),
  'script-src': () => {
    try {
      window.setTimeout('window.ran = 1');
    } catch {}
  },
  'img-src': () => (new Image().src = 'https://example.com/pixel'),
  'connect-src': () => navigator.sendBeacon('https://example.com/'),
  'style-src-elem': () => document.head.insertAdjacentHTML('beforeend', '<style>a { color: red }</style>'),
  'frame-src': () => document.body.insertAdjacentHTML('beforeend', '<iframe src="https://example.com/"></iframe>'),
  'font-src': () => new FontFace('x', 'url(https://example.com/font)').load().catch(() => {}),
  'form-action': () => {
    document.body.insertAdjacentHTML('beforeend', '<form action="https://example.com/"></form>');
    document.forms[0].submit();
  },
  'worker-src': () => new Worker('data:text/javascript,'),
  'base-uri': () => document.head.insertAdjacentHTML('beforeend', '<base href="https://example.com/">'),
};

for (const [name, address] of [
  ['the page', `${origin}/`],
  ['the page in one file', `file://${new URL('../../dist/encoderscope.html', import.meta.url).pathname}`],
]) {
  base(`the policy of ${name} stops what has crept in`, async ({ page }) => {
    await page.goto(address);
    await until(page, 'angle', (angle) => angle > 0);
    for (const [directive, way] of Object.entries(ways)) {
      const stopped = page.evaluate(
        (directive) =>
          new Promise((resolve) => {
            document.addEventListener('securitypolicyviolation', ({ effectiveDirective }) => {
              if (effectiveDirective === directive) resolve(true);
            });
            setTimeout(resolve, 3_000, false);
          }),
        directive,
      );
      await page.evaluate(way);
      expect(await stopped, directive).toBe(true);
    }
    expect(await page.evaluate(() => window.ran)).toBeUndefined();
  });
}

const hostile = `"'><img src=x onerror="window.ran=1"><script>window.ran=1</script><svg onload="window.ran=1">\${window.ran=1}`;

const test = plain.extend({
  page: async ({ page }, use) => {
    await page.addInitScript(() => {
      // How long the page has been deaf at most.
      window.deaf = 0;
      let last = performance.now();
      setInterval(() => {
        const now = performance.now();
        window.deaf = Math.max(window.deaf, now - last);
        last = now;
      }, 20);
    });
    await use(page);
  },
});

/** Whether nothing of it has run, nothing was made of it, and the page has listened all the time. */
const expectUnharmed = async (page, what, most = 1_000) => {
  const { ran, made, deaf } = await page.evaluate(() => ({
    ran: window.ran,
    made: document.querySelectorAll('body :is(script, img, iframe, object, embed, base, [onerror], [onload])').length,
    deaf: window.deaf,
  }));
  expect.soft(ran, what).toBeUndefined();
  expect.soft(made, what).toBe(0);
  expect.soft(deaf, what).toBeLessThan(most);
};

/** Follows a link on a fresh page. */
const open = async (page, fragment) => {
  await page.goto('about:blank');
  await page.goto(`/${fragment}`);
  await expect(page.locator('main :is(.console, .decode, .explain, .reference)')).toBeVisible({ timeout: 15_000 });
  await page.waitForTimeout(300);
};

const areas = ['console', 'decode', 'explain', 'reference'];

test('nothing in a link is run, whatever parameter it is', async ({ page }) => {
  test.setTimeout(240_000);
  await page.goto('/');
  const known = await page.evaluate(async () => {
    const { formats } = await import('./encoderscope.js');
    const kebab = (name) => name.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);
    return [...new Set(formats().flatMap(({ parameters }) => parameters.map(kebab)))];
  });
  expect(known).toContain('angle-bits');
  const more = 'format model layout frame direction dump frames change show bits range sort row page section erratum field frame-kind';
  for (const area of areas) {
    for (const name of new Set([...known, ...more.split(' ')])) {
      await page.evaluate((fragment) => (location.hash = fragment), `#/${area}?format=t485&${name}=${encodeURIComponent(hostile)}`);
      await page.waitForTimeout(30);
    }
    const all = [...known, ...more.split(' ')].map((name) => `${name}=${encodeURIComponent(hostile)}`);
    await open(page, `#/${area}?${all.join('&')}`);
    await expectUnharmed(page, area);
  }
  // The pages of the reference have inputs of their own, which links fill in.
  await open(page, '#/reference');
  const pages = await page
    .locator('.reference .list > div > ul > li > a')
    .evaluateAll((links) => links.map((link) => link.getAttribute('href')));
  for (const href of pages) {
    await page.evaluate((href) => (location.hash = href), href);
    await page.waitForTimeout(50);
    const inputs = await page
      .locator('.reference :is(input, select, textarea)[name]')
      .evaluateAll((all) => all.map(({ name }) => name));
    const filled = inputs.map((name) => `${name}=${encodeURIComponent(hostile)}`).join('&');
    await page.evaluate((link) => (location.hash = link), `${href}${href.includes('?') ? '&' : '?'}${filled}`);
    await page.waitForTimeout(50);
    await expectUnharmed(page, href);
  }
  await open(page, `#/${encodeURIComponent(hostile)}?${encodeURIComponent(hostile)}=1`);
  await expectUnharmed(page, 'area');
  // Where what a stranger wrote is shown, it is text.
  await open(page, `#/decode?format=own&layout=${encodeURIComponent('<img src=x>;line;angle:16,crc:8:0x07')}&dump=12%2034%2056`);
  await expect(at(page, 'profile')).toContainText('<img src=x>');
  await expectUnharmed(page, 'title');
});

test('gigantic links do not stop the page', async ({ page }) => {
  test.setTimeout(180_000);
  const million = 1_000_000;
  const links = {
    dump: `#/decode?format=t485&dump=${'1a+'.repeat(million / 3)}`,
    'bits of a dump': `#/decode?format=biss-c&dump=${'01'.repeat(million / 2)}`,
    frame: `#/explain?format=t485&frame=${'1a'.repeat(million / 2)}`,
    bits: `#/explain?format=ssi&frame=${'10'.repeat(million / 2)}`,
    frames: `#/decode?format=t485&frames=1.${'A'.repeat(million)}`,
    format: `#/console?format=${'x'.repeat(million)}`,
    number: `#/console?format=t485&angle-bits=${'9'.repeat(million)}`,
    layout: `#/decode?format=own&layout=${'angle:1,'.repeat(million / 8)}`,
    title: `#/decode?format=own&layout=${'x'.repeat(million)};line;angle:8`,
    model: `#/console?model=${'MPP-'.repeat(million / 4)}`,
    parameters: `#/reference?${'a=1&'.repeat(million / 4)}`,
    'the same parameter': `#/console?${'angle-bits=9&'.repeat(million / 13)}`,
    page: `#/reference?page=${'x'.repeat(million)}`,
    area: `#/${'x'.repeat(million)}`,
    escapes: `#/decode?dump=${'%25'.repeat(million / 3)}`,
  };
  for (const [name, link] of Object.entries(links)) {
    await test.step(name, async () => {
      await open(page, link);
      await expectUnharmed(page, name);
      await page.getByRole('link', { name: 'Explain', exact: true }).click();
      await expect(page.locator('main .explain')).toBeVisible();
    });
  }
});

/** CRC-32, as a link carries it. */
const crc32 = (bytes) => {
  let crc = -1;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; bit += 1) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
};

/** The payload of a link, right in every respect. */
const payload = (kind, data) => {
  const body = Buffer.concat([Buffer.from(kind), data]);
  const sum = Buffer.alloc(4);
  sum.writeUInt32BE(crc32(body));
  return `1.${deflateRawSync(Buffer.concat([body, sum]), { level: 9 }).toString('base64url')}`;
};

test('frames in a link that unpack to more than a page can hold are refused', async ({ page }) => {
  test.setTimeout(180_000);
  const bombs = {
    'a gigabyte of text': `1.${deflateRawSync(Buffer.alloc(1e9, 0x30), { level: 9 }).toString('base64url')}`,
    'bytes beyond the limit': payload('B', Buffer.alloc(80e6)),
  };
  for (const [name, bomb] of Object.entries(bombs)) {
    await open(page, `#/decode?format=t485&frames=${bomb}`);
    await expect(at(page, 'refusal'), name).toContainText('damaged', { timeout: 20_000 });
    await expectUnharmed(page, name);
  }
  // What is within the limit is read, and the page listens.
  const heavy = {
    'one line': payload('T', Buffer.alloc(30e6, 0x30)),
    'empty lines': payload('T', Buffer.alloc(30e6, 0x0a)),
    'nothing but zeros': payload('B', Buffer.alloc(30e6)),
  };
  for (const [name, load] of Object.entries(heavy)) {
    await open(page, `#/decode?format=t485&frames=${load}`);
    await page.waitForTimeout(3_000);
    await expectUnharmed(page, name);
    await page.getByRole('link', { name: 'Reference', exact: true }).click();
    await expect(page.locator('main .reference')).toBeVisible();
  }
});

test('layouts with absurd numbers are refused in words', async ({ page }) => {
  test.setTimeout(120_000);
  const layouts = [
    'x;line;angle:4294967295',
    'x;line;angle:99999999999999999999',
    'x;line;angle:-1',
    'x;line;angle:1e9',
    'x;line;angle:0',
    'x;line;angle:NaN',
    `x;line;${'angle:64,'.repeat(1000)}crc:8:0x07`,
    'x;line;angle:16,crc:4294967295:0x07',
    'x;line;angle:16,crc:8:0xffffffffffffffffffff',
    'x;line;const:64:0xffffffffffffffffffffff,angle:8',
    'x;poll:fffff;angle:8',
    'x;poll:c2;angle:8',
    'x;poll:30;angle:8',
    `${'x'.repeat(5000)};line;angle:8`,
    ';;;;;;;',
    'x;line;',
  ];
  for (const layout of layouts) {
    await open(page, `#/decode?format=own&layout=${encodeURIComponent(layout)}&dump=12+34`);
    await expect(page.getByRole('alert').first(), layout).toContainText('The link is not right');
    await expectUnharmed(page, layout);
  }
  for (const number of ['-1', '0', '99', '4294967296', '1e3', 'NaN', 'Infinity', '0x10', '9'.repeat(400)]) {
    await open(page, `#/console?format=t485&angle-bits=${number}`);
    await expect(page.getByRole('alert').first(), number).toContainText('The link is not right');
  }
});

test('files are read as data, whatever they are called', async ({ page }) => {
  test.setTimeout(120_000);
  const head = '$timescale 1 ns $end\n$var wire 1 ! clk $end\n$var wire 1 " data $end\n$enddefinitions $end\n';
  const files = {
    'page.csv': `<!doctype html>${hostile}<meta http-equiv="refresh" content="0;url=https://example.com/">`,
    'picture.svg': `<svg xmlns="http://www.w3.org/2000/svg" onload="window.ran=1"><script>window.ran=1</script></svg>`,
    'formula.csv': '=cmd|\' /C calc\'!A0,1a 20 29\n'.repeat(1000),
    'elf.bin': readFileSync('/proc/self/exe').subarray(0, 5e6),
    'times.vcd': `${head}${'#99999999999999999999999999\n0!\n'.repeat(1000)}`,
    'back.vcd': `${head}#1000000000000\n0!\n#0\n1!\n`,
    'wide.vcd': `$timescale 1 ns $end\n$var wire 4294967295 ! clk $end\n$enddefinitions $end\n#0\nb${'1'.repeat(1e6)} !\n`,
    'scale.vcd': `$timescale 99999999999999999999 s $end\n$var wire 1 ! clk $end\n$enddefinitions $end\n#0\n0!\n`,
    'names.vcd': `$timescale 1 ns $end\n$var wire 1 ! ${hostile.replaceAll(' ', '')} $end\n$var wire 1 " data $end\n$enddefinitions $end\n#0\n0!\n#5\n1!\n`,
    'recording.encoderscope.txt': `# Encoderscope recording 1 · format=own&layout=${'x'.repeat(1e6)};line;angle:4294967295\n${good}\n`,
    'hostile.encoderscope.txt': `# Encoderscope recording 1 · format=t485&angle-bits=${encodeURIComponent(hostile)}\n${good}\n`,
    [`<img src=x onerror=window.ran=1>.txt`]: good,
    'many-commas.csv': `${','.repeat(5e6)}\n`,
    'table.csv': `Time [s],Channel 0,Channel 1\n${'1e308,1,0\n-1e308,0,1\nNaN,1,1\nInfinity,0,0\n'.repeat(1000)}`,
  };
  const folder = mkdtempSync(join(tmpdir(), 'encoderscope-'));
  await page.goto('/#/decode');
  for (const [name, text] of Object.entries(files)) {
    await test.step(name, async () => {
      writeFileSync(join(folder, name), text);
      await at(page, 'file-input').setInputFiles(join(folder, name));
      // It is said what became of it: rows, what it was read as, or why it was not.
      const said = at(page, 'dump-row').or(at(page, 'refusal')).or(at(page, 'read-note')).or(at(page, 'no-row'));
      await expect(said.first(), name).toBeVisible({ timeout: 20_000 });
      await expect(at(page, 'progress')).toHaveCount(0, { timeout: 20_000 });
      await expectUnharmed(page, name);
    });
  }
  rmSync(folder, { recursive: true });
  expect(page.url()).toContain(`${origin}/`);
});

test('100 MB of one line do not stop the page', async ({ page }) => {
  test.setTimeout(120_000);
  for (const letter of ['0', 'x', 'a', ' ', '\\u0000', ',']) {
    await page.goto('about:blank');
    await page.goto('/#/decode');
    await expect(page.locator('.drop')).toBeVisible();
    await page.evaluate(async (letter) => {
      const piece = JSON.parse(`"${letter}"`).repeat(1e6);
      const data = new DataTransfer();
      data.items.add(new File(Array(100).fill(piece), 'line.txt'));
      // Making the file was work of the test, not of the page.
      await new Promise((resolve) => setTimeout(resolve, 500));
      window.deaf = 0;
      document.querySelector('.drop').dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }));
    }, letter);
    await page.waitForTimeout(4_000);
    await expectUnharmed(page, letter);
    await page.getByRole('link', { name: 'Explain', exact: true }).click();
    await expect(page.locator('main .explain')).toBeVisible();
  }
});

test('what is imported into the explainer may be nested as deep as it likes', async ({ page }) => {
  await page.goto('/#/explain?format=t485');
  const bombs = [
    '['.repeat(200_000),
    `{"signal":${'['.repeat(100_000)}${']'.repeat(100_000)}}`,
    `{"reg":[{"bits":4294967295,"name":${JSON.stringify(hostile)}}]}`,
    `{"reg":[{"bits":1e308}]}`,
    `{"signal":[{"name":"data","wave":"${'01'.repeat(500_000)}"}]}`,
    hostile,
  ];
  await page.locator('summary', { hasText: 'Read a WaveDrom description' }).click();
  for (const bomb of bombs) {
    await at(page, 'import-text').fill(bomb);
    await at(page, 'import').click();
    await page.waitForTimeout(200);
    await expectUnharmed(page, bomb.slice(0, 30));
  }
  await expect(at(page, 'explain-bit').first()).toBeVisible();
});

test.describe('a port', () => {
  const query = 'format=t485&angle-bits=23&baud=2500000';
  // What is asked of a T485 encoder to read it.
  const reading = 0x1a;
  /** Links that name what changes an encoder, or would make it hear something else. */
  const links = [
    '#/console?format=rs485&command=0',
    '#/console?format=rs485&command=d',
    '#/console?format=bus&address=9',
    '#/console?format=t485&baud=9600',
    '#/console?format=own&layout=x;poll:c2;angle:8',
    '#/console?format=own&layout=x;poll:30;angle:8',
    '#/console?format=own&layout=x;poll:31;angle:8',
    '#/console?format=t485&dialect=tamagawa',
    '#/explain?format=t485&direction=sent&frame=c2',
    '#/explain?format=rs485&direction=sent&frame=30',
    '#/decode?format=rs485&dump=30+30+30+30',
    '#/reference?format=rs485&section=commands',
  ];
  let encoder;
  /** The bytes that the encoder has heard, each once. */
  const kinds = async () => (await encoder.tell()).kinds;
  test.beforeEach(async () => {
    encoder = await Encoder.start('--format', 't485', '--angle-bits', '23', 'still=0.5');
  });
  test.afterEach(async () => {
    await encoder.unplug();
  });

  const connect = async (page) => {
    await page.evaluate((query) => (location.hash = `#/console?${query}`), query);
    await expect(at(page, 'profile')).toHaveAttribute('data-value', /format=t485/);
    await at(page, 'connect').click();
    await expectLink(page, 'reading');
    await until(page, 'angle', (angle) => angle === 2 ** 22);
  };

  test('is not opened by a link, and no link sends to one that is open @serial', async ({ page }) => {
    test.setTimeout(120_000);
    for (const link of links) {
      await open(page, link);
      await page.waitForTimeout(200);
      expect(await kinds(), link).toEqual([]);
    }
    await page.goto('/');
    await connect(page);
    expect(await kinds()).toEqual([reading]);
    for (const link of links) {
      await page.evaluate((link) => (location.hash = link), link);
      await page.waitForTimeout(300);
      // Back on the console, whose settings are the link's by now.
      await page.getByRole('link', { name: 'Console', exact: true }).click();
      await page.waitForTimeout(300);
      expect(await kinds(), link).toEqual([reading]);
      if ((await page.getByTestId('disconnect').count()) === 0) {
        await expect(at(page, 'link-state'), link).toContainText('Connect to read with them');
        await connect(page);
      }
    }
    expect(await kinds()).toEqual([reading]);
    await until(page, 'angle', (angle) => angle === 2 ** 22);
  });

  test('is not opened with the settings of a link when it is plugged in again @serial', async ({ page }) => {
    await page.goto('/');
    await connect(page);
    await encoder.unplug();
    await expectLink(page, 'lost');
    await page.evaluate(() => (location.hash = '#/console?format=rs485&command=d'));
    await expect(at(page, 'profile')).toHaveAttribute('data-value', /format=rs485/);
    encoder = await Encoder.start('--format', 't485', '--angle-bits', '23', 'still=0.5');
    await page.evaluate(() => navigator.serial.dispatchEvent(new Event('connect')));
    await page.waitForTimeout(1_500);
    expect(await kinds()).toEqual([]);
  });

  test('is sent no command that a link has filled in, though it is opened @serial', async ({ page }) => {
    await page.goto('/#/console?format=rs485&command=0');
    await at(page, 'connect').click();
    await expectLink(page, 'unfit');
    await page.waitForTimeout(500);
    expect(await kinds()).toEqual([]);
  });
});
