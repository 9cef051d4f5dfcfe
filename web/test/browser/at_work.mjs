// What a person meets while something is on its way: a page that loads, an order that is read, a command that runs on; and
// the whole way from an empty page to a program by the keyboard alone.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { nestLayout } from './nest_layout.mjs';
import { command, inEditor, keys, message, placed, settled } from './steps.mjs';

const lid =
  '<svg xmlns="http://www.w3.org/2000/svg" width="70mm" height="40mm" viewBox="0 0 70 40"><rect x="5" y="5" width="60" height="30"/></svg>';
const drawing = (name) => ({ name, mimeType: 'image/svg+xml', buffer: Buffer.from(lid) });

async function emptied(page, server) {
  for (const { id } of (await (await fetch(new URL('/api/layouts', server.url))).json()).layouts)
    await page.evaluate((one) => fetch(`/api/layouts/${one}`, { method: 'DELETE' }), id);
  await page.goto(server.url);
  await page.waitForSelector('.welcome');
}

/** The share of the window that is nearly black. */
const black = async (page) => {
  const shot = (await page.screenshot()).toString('base64');
  return page.evaluate(async (png) => {
    const image = await createImageBitmap(new Blob([Uint8Array.from(atob(png), (c) => c.charCodeAt(0))]));
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    let count = 0;
    for (let i = 0; i < data.length; i += 4) if (data[i] + data[i + 1] + data[i + 2] < 90) ++count;
    return (4 * count) / data.length;
  }, shot);
};

inEditor(
  'shows nothing black and says nothing of missing things while it loads',
  async (page, server) => {
    // The kernel and the list of layouts come late, and the layout when it is let go.
    let letGo;
    const released = new Promise((resolve) => (letGo = resolve));
    await page.route(/\/lekalo\.wasm$|\/api\/layouts$/, async (route) => {
      await new Promise((resolve) => setTimeout(resolve, 600));
      await route.continue();
    });
    await page.routeWebSocket(/\/ws/, (socket) => {
      const upstream = socket.connectToServer();
      upstream.onMessage((text) => void released.then(() => socket.send(text)));
    });
    await page.goto('about:blank');
    await page.goto(server.page);
    const looks = [];
    for (const side of ['violations', 'kits', 'history', 'sheets', 'parts']) {
      await command(page, `side.${side}`);
      looks.push(await page.textContent('#page'));
      assert.ok((await black(page)) < 0.02, `${side}: ${await black(page)}`);
      await page.waitForTimeout(200);
    }
    for (const text of looks) assert.doesNotMatch(text, /missing|not checked|not counted|has no kits/i);
    await page.waitForSelector('[data-loading="Loading the layout…"]');
    await command(page, 'side.violations');
    assert.match(await page.textContent('.body'), /Loading the layout/);
    letGo();
    await page.waitForSelector('.mirror li');
    await settled(page);
    assert.match(await page.textContent('.body'), /No rule is broken/);
    assert.equal(await page.getAttribute('.picture', 'data-loading'), '');
  },
  { layout: nestLayout, options: {} },
);

const running = (page) => page.waitForSelector('[data-work="nest"]:not([hidden])');

inEditor(
  'asks before it leaves a command that runs, and goes without a word when nothing does',
  async (page) => {
    await command(page, 'copy.layout');
    await page.waitForFunction(() => document.querySelectorAll('.layouts option').length === 2);
    await settled(page);
    assert.match(await page.locator('.layouts option:checked').textContent(), / 2$/);
    const asked = [];
    let answer = 'dismiss';
    page.on('dialog', async (dialog) => {
      asked.push(`${dialog.type()}: ${dialog.message()}`);
      await dialog[answer]();
    });
    await command(page, 'nest');
    await running(page);
    // To another layout: it stays, the list too.
    const here = await page.inputValue('.layouts');
    await page.selectOption('.layouts', { index: 1 });
    await page.waitForFunction((id) => document.querySelector('.layouts').value === id, here);
    assert.match(asked.pop(), /^confirm: Nesting is still running/);
    // The window: the browser asks in its own words.
    await page.close({ runBeforeUnload: true });
    await page.waitForTimeout(300);
    assert.match(asked.pop(), /^beforeunload/);
    assert.equal(await page.locator('[data-work="nest"]:not([hidden])').count(), 1);
    await command(page, 'nest.stop');
    await settled(page);
    assert.ok((await placed(page)) > 2); // what it had found goes on to count
    // Who insists goes.
    answer = 'accept';
    await page.click('[data-id="part-plate"] .piece').catch(() => undefined);
    await settled(page);
    await command(page, 'nest');
    await running(page);
    await page.selectOption('.layouts', { index: 1 });
    await page.waitForFunction((id) => document.querySelector('.layouts').value !== id, here);
    assert.match(asked.pop(), /^confirm/);
    await settled(page);
    assert.equal(await placed(page), 2);
    // Nothing runs: nobody is asked.
    await page.selectOption('.layouts', here);
    await settled(page);
    const closed = page.waitForEvent('close');
    await page.close({ runBeforeUnload: true });
    await closed;
    assert.deepEqual(asked, []);
  },
  { layout: nestLayout, options: {} },
);

inEditor(
  'tells a note from an error',
  async (page) => {
    const look = () =>
      page.locator('.status .message').evaluate((e) => [e.getAttribute('role'), getComputedStyle(e).color]);
    const ink = await page.evaluate(() => getComputedStyle(document.body).color);
    await page.click('[data-id="placement-1"]', { force: true }).catch(() => undefined);
    await page.focus('.picture');
    await keys(page, 'Tab', 'g', 'g'); // the second time it rests already
    assert.match(await message(page), /Nothing moved/);
    assert.deepEqual(await look(), ['status', ink]);
    await keys(page, 'Shift+ArrowLeft', 'Shift+ArrowLeft'); // out of the sheet
    assert.match(await message(page), /not admitted/);
    const [role, colour] = await look();
    assert.equal(role, 'alert');
    assert.notEqual(colour, ink);
  },
  { layout: nestLayout, options: {} },
);

inEditor(
  'shows how far an order is, gives it up by a button or by Escape, and keeps what was typed',
  async (page, server) => {
    await emptied(page, server);
    let late = true;
    await page.route('**/api/layouts?*order=1', async (route) => {
      if (late) await new Promise((resolve) => setTimeout(resolve, 4000));
      await route.continue().catch(() => undefined); // it was given up
    });
    await page.click('.welcome [data-action="new.layout"]');
    await page.setInputFiles('dialog [data-action="order.file"]', [drawing('lid.svg')]);
    await page.fill('dialog [data-field="quantity.0"]', '7');
    for (const giveUp of [() => command(page, 'order.cancel'), () => page.keyboard.press('Escape')]) {
      await command(page, 'order.make');
      await page.waitForSelector('dialog .sending progress');
      assert.match(await page.textContent('dialog .sending'), /Making the layout….*\d+ (%|s)/);
      await giveUp();
      await page.waitForFunction(() => /Cancelled/.test(document.querySelector('dialog .trouble').textContent));
      assert.equal(await page.inputValue('dialog [data-field="quantity.0"]'), '7');
    }
    assert.equal((await (await fetch(new URL('/api/layouts', server.url))).json()).layouts.length, 0);
    late = false;
    await command(page, 'order.make');
    await page.waitForSelector('dialog', { state: 'detached' });
    await page.waitForSelector('[data-id="part-lid"]');
    assert.match(await page.textContent('[data-id="part-lid"]'), /0\/7/);
  },
  { options: {}, expected: [] },
);

for (const [width, height] of [
  [1400, 900],
  [390, 844],
])
  inEditor(
    `goes from an empty page to G-code by the keyboard alone at ${width} x ${height}`,
    async (page, server) => {
      const focus = () =>
        page.evaluate(() => {
          const e = document.activeElement;
          return e.dataset.action ?? e.dataset.field ?? e.className;
        });
      /** Presses Tab until the focus is there. */
      const tabTo = async (name, back = false) => {
        for (let i = 0; i < 90 && (await focus()) !== name; ++i) await page.keyboard.press(back ? 'Shift+Tab' : 'Tab');
        assert.equal(await focus(), name);
      };
      // What the browser's own window for files would give.
      page.on('filechooser', (chooser) => chooser.setFiles([drawing('lid.svg'), drawing('base.svg')]));
      await emptied(page, server);
      assert.equal(await focus(), 'new.layout');
      await page.keyboard.press('Enter');
      await page.waitForSelector('dialog');
      await tabTo('order.add');
      await page.keyboard.press('Enter');
      await page.waitForSelector('[data-field="quantity.1"]');
      // The focus is where one goes on, and stays there where rows are made anew.
      assert.equal(await focus(), 'quantity.0');
      await tabTo('quantity.1');
      await page.keyboard.type('3');
      await tabTo('order.stock.add');
      await page.keyboard.press('Enter');
      assert.equal(await focus(), 'width.1');
      await page.keyboard.press('Shift+Tab');
      await page.keyboard.press('ArrowDown'); // a strip
      await page.waitForSelector('[data-field="width.1"]', { state: 'detached' });
      assert.equal(await focus(), 'kind.1');
      await tabTo('stock.remove.1');
      await page.keyboard.press('Enter');
      assert.equal(await focus(), 'stock.remove.0');
      await tabTo('gap');
      await page.keyboard.press('Enter'); // makes the layout
      await page.waitForSelector('dialog', { state: 'detached' });
      await page.waitForSelector('[data-id="part-base"]');
      await settled(page);
      assert.equal(await focus(), 'picture');
      await page.keyboard.press('n');
      await running(page);
      await page.keyboard.press('Escape'); // keeps the best so far
      await settled(page);
      assert.equal(await placed(page), 4);
      await tabTo('menu.export', true);
      await page.keyboard.press('Enter');
      await tabTo('export.gcode');
      await page.keyboard.press('Enter');
      await page.waitForSelector('dialog');
      await tabTo('kerf');
      await page.keyboard.type('0,2');
      await page.keyboard.press('Tab');
      await page.keyboard.type('2000');
      const [download] = await Promise.all([page.waitForEvent('download'), page.keyboard.press('Enter')]);
      const file = join(server.folder, 'out.nc');
      await download.saveAs(file);
      assert.match(readFileSync(file, 'utf8'), /F2000/);
    },
    { layout: nestLayout, options: { viewport: { width, height }, hasTouch: width < 861 } },
  );
