// The page of a placed solid in a real browser: it turns, zooms, cuts, and runs nothing that a name says. SOLID_PAGES
// names the program that writes the pages; LEKALO_SHOTS a folder for pictures of them.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { newTab, root, startBrowser } from './harness.mjs';

const writer = process.env.SOLID_PAGES ?? join(root, 'build/dev/tests/solid_pages');
const folder = mkdtempSync(join(tmpdir(), 'lekalo-solid-'));
const wide = { timeout: 120_000 };
let browser;
before(async () => {
  execFileSync(writer, [folder]);
  browser = await startBrowser(['--use-angle=swiftshader', '--enable-unsafe-swiftshader']);
}, wide);
after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

/** Opens a page that must neither complain nor ask for anything. */
async function opened(t, name, options, script) {
  const page = await newTab(browser, { viewport: { width: 1400, height: 900 }, ...options });
  t.after(() => page.context().close());
  const asked = [];
  page.on('request', (request) => asked.push(request.url()));
  if (script) await page.addInitScript(script);
  const url = `file://${folder}/${name}.html`;
  await page.goto(url);
  page.done = async () => {
    assert.deepEqual(page.problems, []);
    assert.deepEqual(asked, [url]);
    assert.equal(await page.evaluate('window.ran'), undefined);
    // Nothing reaches out of the window at its side.
    assert.ok(await page.evaluate('document.documentElement.scrollWidth <= innerWidth'));
  };
  return page;
}
/** The canvas, when it has been painted. */
async function pixels(page) {
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  return page.locator('#view').screenshot();
}
/** Pictures take most of the time: the one after an act is the one before the next. */
async function changes(page, what, act) {
  const earlier = page.seen ?? (await pixels(page));
  await act();
  page.seen = await pixels(page);
  assert.ok(!earlier.equals(page.seen), `${what} changes the picture`);
}
const shot = async (page, name) => {
  if (process.env.LEKALO_SHOTS) await page.screenshot({ path: join(process.env.LEKALO_SHOTS, `${name}.png`) });
};
const scaleBar = (page) => page.evaluate(() => document.getElementById('bar').outerHTML);

// Each size and each scheme once; all pairs with LEKALO_FULL.
for (const [width, height, colorScheme] of [
  [1400, 900, 'light'],
  [390, 844, 'dark'],
  ...(process.env.LEKALO_FULL
    ? [
        [1400, 900, 'dark'],
        [390, 844, 'light'],
      ]
    : []),
])
  test(`a placed solid turns, zooms and is cut at ${width} x ${height}, ${colorScheme}`, wide, async (t) => {
    const name = `solid-${width}-${colorScheme}`;
    const page = await opened(t, 'wavy', { viewport: { width, height }, colorScheme, hasTouch: width < 500 });
    const empty = await page.evaluate(() => document.querySelector('canvas').getContext('webgl2').isContextLost());
    assert.equal(empty, false);
    await shot(page, name);
    const { x, y, width: w, height: h } = await page.locator('#view').boundingBox();
    const middle = [x + w / 2, y + h / 2];
    const drag = async (dx, dy) => {
      await page.mouse.move(...middle);
      await page.mouse.down();
      await page.mouse.move(middle[0] + dx / 2, middle[1] + dy / 2);
      await page.mouse.move(middle[0] + dx, middle[1] + dy);
      await page.mouse.up();
    };
    await changes(page, 'a drag', () => drag(60, 30));
    const before = await scaleBar(page);
    await changes(page, 'the wheel', async () => {
      await page.mouse.move(...middle);
      await page.mouse.wheel(0, -600);
    });
    assert.notEqual(await scaleBar(page), before);
    await changes(page, 'hiding the blank', () => page.uncheck('#show-blank'));
    await changes(page, 'showing the blank', () => page.check('#show-blank'));
    await changes(page, 'a view', () => page.click('#views button:has-text("front")'));
    await changes(page, 'a section', () => page.click('#planes button:has-text("x")'));
    await changes(page, 'its slider', () => page.fill('#plane', '300'));
    await changes(page, 'leaving the part whole', () => page.uncheck('#cut-part'));
    await shot(page, `${name}-section`);
    await changes(page, 'cutting the part', () => page.check('#cut-part'));
    await changes(page, 'a contact', () => page.click('#contacts li:nth-child(2) button'));
    assert.equal(await page.getAttribute('#contacts li:nth-child(2) button', 'aria-pressed'), 'true');
    assert.equal(await page.getAttribute('#planes button:has-text("contact")', 'aria-pressed'), 'true');
    await shot(page, `${name}-contact`);
    // The keys alone do the same.
    await page.focus('#view');
    page.seen = await pixels(page);
    for (const key of ['ArrowLeft', 'ArrowUp', 'Shift+ArrowRight', '+', '-', ']', 's', 'b', '0', '1'])
      await changes(page, `the key ${key}`, () => page.keyboard.press(key));
    await page.done();
  });

test('two fingers zoom and move, and one turns', wide, async (t) => {
  const page = await opened(t, 'wavy', { viewport: { width: 390, height: 844 }, hasTouch: true });
  const touch = await page.context().newCDPSession(page);
  const fingers = (type, ...places) =>
    touch.send('Input.dispatchTouchEvent', { type, touchPoints: places.map(([x, y], id) => ({ x, y, id })) });
  await changes(page, 'a finger', async () => {
    await fingers('touchStart', [180, 200]);
    await fingers('touchMove', [240, 220]);
    await fingers('touchEnd');
  });
  const before = await scaleBar(page);
  await changes(page, 'two fingers', async () => {
    await fingers('touchStart', [180, 200], [220, 240]);
    await fingers('touchMove', [100, 120], [300, 320]);
    await fingers('touchEnd');
  });
  assert.notEqual(await scaleBar(page), before);
  await page.done();
});

// A mark lies over the canvas: two fingers of which one was on a mark once zoomed nothing.
test('a mark is in the way of no finger, and a tap on it chooses its contact', wide, async (t) => {
  const page = await opened(t, 'wavy', { viewport: { width: 390, height: 844 }, hasTouch: true });
  const touch = await page.context().newCDPSession(page);
  const fingers = (type, ...places) =>
    touch.send('Input.dispatchTouchEvent', { type, touchPoints: places.map(([x, y], id) => ({ x, y, id })) });
  // Marks may lie over one another: the foremost is meant.
  const chosen = page.locator('#contacts button[aria-pressed=true]');
  const mark = async () => {
    const { x, y, width, height } = await page.locator('#marks button').first().boundingBox();
    return [x + width / 2, y + height / 2];
  };
  const [x, y] = await mark();
  assert.ok(await page.evaluate(([x, y]) => document.elementFromPoint(x, y).closest('#marks button'), [x, y]));
  const before = await scaleBar(page);
  await changes(page, 'a finger on a mark and one beside it', async () => {
    await fingers('touchStart', [x, y], [x + 60, y + 60]);
    await fingers('touchMove', [x, y], [x + 120, y + 120]);
    await fingers('touchEnd');
  });
  assert.notEqual(await scaleBar(page), before);
  await page.keyboard.press('0');
  page.seen = await pixels(page);
  const [left, top] = await mark();
  await changes(page, 'a drag that begins on a mark', async () => {
    await page.mouse.move(left, top);
    await page.mouse.down();
    await page.mouse.move(left + 40, top + 20);
    await page.mouse.up();
  });
  assert.equal(await chosen.count(), 0);
  await page.touchscreen.tap(...(await mark()));
  await chosen.waitFor({ timeout: 10_000 });
  await page.done();
});

test('what is missing and what nobody measured is said, and a name is only a name', wide, async (t) => {
  const page = await opened(t, 'cored');
  assert.equal(await page.textContent('#part'), '<!--<script><b>"&Корпус');
  assert.equal(await page.title(), '<!--<script><b>"&Корпус in casting.ply');
  assert.match(await page.textContent('#notes'), /^<\/script><script>window.ran = 1<\/script><img src=x/);
  assert.match(await page.textContent('#key'), /less than 2 mm.*not measured/);
  await changes(page, 'a mark', () => page.locator('#marks button').first().click());
  await shot(page, 'solid-missing');
  await page.done();
});

test('a part without allowances and contacts is shown', wide, async (t) => {
  const page = await opened(t, 'bare');
  assert.equal(await page.textContent('#contacts-title'), 'No contacts');
  assert.equal(await page.isVisible('#scale'), false);
  await changes(page, 'a section', () => page.click('#planes button:has-text("z")'));
  await shot(page, 'solid-bare');
  await page.done();
});

test('without WebGL2 a sentence says so, and the figures stand', wide, async (t) => {
  const page = await opened(t, 'wavy', {}, () => (HTMLCanvasElement.prototype.getContext = () => null));
  assert.ok(await page.isVisible('#no-webgl'));
  assert.equal(await page.isVisible('#view'), false);
  assert.match(await page.textContent('#figures'), /turned by/);
  await page.click('#contacts button >> nth=0');
  await shot(page, 'solid-without');
  await page.done();
});
