// The surroundings of the picture: tray, lists, measure, view, files, and the messages about all of it.

import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { run } from './harness.mjs';
import { smallLayout } from './small_layout.mjs';
import {
  at,
  broken,
  checked,
  command,
  drop,
  export_,
  hold,
  inEditor,
  keys,
  message,
  placed,
  placementOf,
  press,
  scaleOf,
  settled,
} from './steps.mjs';

const kits = {
  ...smallLayout,
  parts: smallLayout.parts.map(({ demand, ...part }) => part),
  kits: [
    {
      id: 'box',
      name: 'Box',
      demand: 2,
      pieces: [
        { part: 'plate', count: 2 },
        { part: 'bracket', count: 1 },
      ],
    },
  ],
};

inEditor(
  'counts in the tray and in the table of kits what is placed and what is missing',
  async (page) => {
    const tray = (part) => page.textContent(`[data-id="part-${part}"]`);
    assert.match(await tray('plate'), /Plate.*2 left.*2\/4/);
    assert.match(await tray('bracket'), /Bracket.*1 left.*1\/2/);
    assert.equal(
      await page
        .locator('[data-id="part-plate"] svg path')
        .first()
        .evaluate((e) => e.getBBox().width),
      80,
    );
    await command(page, 'side.kits');
    assert.match(await page.textContent('.body table'), /Box.*1 ?\/ ?2/s);
    await page.click('[data-id="part-plate"] .piece');
    await settled(page);
    await page.click('[data-id="part-plate"] .piece');
    await settled(page);
    assert.match(await tray('plate'), /all placed.*4\/4/);
    assert.match(await page.textContent('.body table'), /1 ?\/ ?2.*Bracket/s);
    await page.click('[data-id="part-bracket"] .piece');
    await settled(page);
    assert.match(await page.textContent('.body table'), /2 ?\/ ?2/s);
  },
  { layout: kits },
);

const sharing = {
  ...smallLayout,
  parts: kits.parts,
  kits: [
    { id: 'cheap', demand: 2, value: 1, pieces: [{ part: 'plate', count: 2 }] },
    {
      id: 'dear',
      demand: 2,
      value: 5,
      pieces: [
        { part: 'plate', count: 1 },
        { part: 'bracket', count: 1 },
      ],
    },
  ],
};
inEditor(
  'counts kits that share parts as lekalo show does: the dear one takes them, not the first one',
  async (page, server) => {
    const agreed = async () => {
      const file = join(server.folder, 'kits.json');
      writeFileSync(file, await export_(server));
      const { kits: counted } = JSON.parse(run('show', file, '--json').stdout);
      const name = (part) => smallLayout.parts.find(({ id }) => id === part).name;
      const rows = await page
        .locator('.body tbody tr')
        .evaluateAll((list) =>
          list.map((row) => [
            row.dataset.id,
            row.cells[1].textContent,
            ...[...row.cells[2].children].map((e) => e.textContent),
          ]),
        );
      assert.deepEqual(
        rows,
        counted.map((k) => [
          `kit-${k.kit}`,
          `${k.complete} / ${k.wanted}`,
          ...k.missing.map((m) => `${m.count} × ${name(m.part)}`),
        ]),
      );
      return counted.map(({ complete }) => complete);
    };
    await command(page, 'side.kits');
    assert.deepEqual(await agreed(), [0, 1]); // two plates, a bracket: in the document's order 1 and 0
    await page.click('[data-id="part-plate"] .piece');
    await settled(page);
    assert.deepEqual(await agreed(), [1, 1]);
    await page.click('[data-id="part-bracket"] .piece');
    await settled(page);
    assert.deepEqual(await agreed(), [0, 2]);
  },
  { layout: sharing },
);

inEditor(
  'counts no kits by itself where the kernel is missing',
  async (page) => {
    await page.route('**/lekalo.wasm', (route) => route.fulfill({ status: 404 }));
    await page.reload();
    await page.waitForSelector('.tray li');
    await command(page, 'side.kits');
    assert.match(await page.textContent('.body'), /Not counted in this browser/);
    assert.equal(await page.locator('.body table').count(), 0);
  },
  { layout: sharing, options: {}, expected: ['404'] },
);

inEditor('puts parts in by the keyboard alone', async (page, server) => {
  await page.focus('[data-id="part-bracket"] .piece');
  await page.keyboard.press('Enter');
  await settled(page);
  assert.equal(await placed(page), 4);
  assert.equal((await checked(server)).exit, 0);
});

inEditor('finds a part by its name and by its number', async (page) => {
  await page.keyboard.press('/');
  await page.keyboard.type('brack');
  assert.deepEqual(await page.locator('.body li').evaluateAll((list) => list.map((e) => e.dataset.id)), ['found-3']);
  await page.keyboard.press('Tab');
  await page.keyboard.press('Enter');
  await settled(page);
  assert.equal(await page.getAttribute('[data-id="placement-3"]', 'aria-selected'), 'true');
  await page.fill('.body input', '2');
  assert.deepEqual(await page.locator('.body li').evaluateAll((list) => list.map((e) => e.dataset.id)), ['found-2']);
});

inEditor('shows where a rule is broken', async (page) => {
  await command(page, 'mode.free');
  await hold(page, 2, -100, 0);
  await drop(page);
  const before = await scaleOf(page);
  await page.click('[data-id="violation-overlap-1-2"] button');
  await settled(page);
  assert.ok((await scaleOf(page)) > 1.5 * before);
  const view = await page.locator('.picture').boundingBox();
  const [x] = await at(page, 1, 1);
  assert.ok(Math.abs(x - view.x - view.width / 2) < view.width / 4); // the overlap is in the middle
  assert.deepEqual(
    await page.locator('.mirror [aria-selected="true"]').evaluateAll((list) => list.map((e) => e.dataset.id).sort()),
    ['placement-1', 'placement-2'],
  );
});

inEditor('measures', async (page) => {
  await keys(page, '5');
  const k = await scaleOf(page);
  const [x, y] = await at(page, 2);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 60 * k, y - 80 * k, { steps: 3 });
  assert.match(await page.textContent('.status .live'), /^100\.\d+ mm  \((59|60)\.\d+, (79|80)\.\d+\)$/);
  await page.mouse.up();
  assert.match(await page.textContent('.status .live'), /^100\./);
  await page.keyboard.press('Escape');
  assert.match(await page.textContent('.status .live'), /Nothing selected/);
});

inEditor('zooms at the cursor, pans, and shows all again', async (page) => {
  const k = await scaleOf(page);
  const [x, y] = await at(page, 2);
  await page.mouse.move(x, y);
  await page.mouse.wheel(0, -600);
  await settled(page);
  const [x1, y1] = await at(page, 2);
  assert.ok((await scaleOf(page)) > 2 * k && Math.hypot(x1 - x, y1 - y) < 1.5);
  await page.keyboard.down(' ');
  await page.mouse.down();
  await page.mouse.move(x + 40, y + 30, { steps: 3 });
  await page.mouse.up();
  await page.keyboard.up(' ');
  await settled(page);
  const [x2, y2] = await at(page, 2);
  assert.ok(Math.hypot(x2 - x1 - 40, y2 - y1 - 30) < 1.5, `${x2 - x1} ${y2 - y1}`);
  await page.focus('.picture');
  await keys(page, '-', '+', 'f');
  assert.ok(Math.abs((await scaleOf(page)) - k) < 1e-6);
  await command(page, 'side.sheets');
  await page.click('[data-id="sheet-board-1"] button');
  await settled(page);
  assert.ok((await scaleOf(page)) > 1.5 * k); // one sheet of two
});

inEditor('shows labels, grain, gaps and zones, or not', async (page) => {
  await press(page, 2);
  const seen = () =>
    page
      .locator('.picture canvas')
      .first()
      .evaluate((canvas) => canvas.toDataURL());
  await command(page, 'menu.view');
  for (const name of ['labels', 'grain', 'gap', 'zones']) {
    const before = await seen();
    await command(page, `show.${name}`);
    await settled(page);
    assert.ok(before !== (await seen()), name);
    await command(page, `show.${name}`);
    await settled(page);
    assert.ok(before === (await seen()), `${name} again`);
  }
});

inEditor('goes back to any state, and to that before', async (page, server) => {
  await press(page, 3);
  await keys(page, 'ArrowUp', 'ArrowUp', 'ArrowUp');
  await command(page, 'side.history');
  assert.match(await page.textContent('[data-id="revision-3"]'), /moved Bracket 3/);
  await page.click('[data-id="revision-1"] button');
  await page.waitForFunction(
    () => /20.00 121.00/.test(document.querySelector('[data-id="placement-3"]').ariaLabel),
    null,
    { polling: 20 },
  );
  assert.equal((await placementOf(server, 3)).y, 121);
  await page.waitForSelector('[data-id="revision-4"]');
  assert.match(await page.textContent('[data-id="revision-4"]'), /went back to 1/);
  await command(page, 'language');
  await page.waitForFunction(() =>
    /пересунуто Bracket 3/.test(document.querySelector('[data-id="revision-3"]')?.textContent),
  );
  await command(page, 'language');
  await page.click('[data-id="revision-3"] button');
  await page.waitForFunction(
    () => /20.00 123.00/.test(document.querySelector('[data-id="placement-3"]').ariaLabel),
    null,
    { polling: 20 },
  );
});

inEditor('has several layouts: a copy, another name, another one, none', async (page) => {
  await command(page, 'copy.layout');
  await page.waitForFunction(() => document.querySelectorAll('.layouts option').length === 2);
  await command(page, 'name.layout');
  await page.fill('dialog [data-field="name"]', 'Second');
  await command(page, 'name.save');
  await page.waitForFunction(() => /Second/.test(document.querySelector('.layouts').selectedOptions[0].textContent));
  await press(page, 3);
  await keys(page, 'ArrowUp');
  await page.selectOption('.layouts', { index: 1 });
  await page.waitForFunction(
    () => /20.00 120.00/.test(document.querySelector('[data-id="placement-3"]')?.ariaLabel),
    null,
    { polling: 20 },
  );
  await page.selectOption('.layouts', { label: 'Second' });
  await page.waitForFunction(
    () => /20.00 121.00/.test(document.querySelector('[data-id="placement-3"]')?.ariaLabel),
    null,
    { polling: 20 },
  );
  await command(page, 'name.layout');
  await command(page, 'name.delete');
  await command(page, 'name.delete'); // sure
  await page.waitForFunction(() => document.querySelectorAll('.layouts option').length === 1);
  await page.waitForFunction(
    () => /20.00 120.00/.test(document.querySelector('[data-id="placement-3"]')?.ariaLabel),
    null,
    { polling: 20 },
  );
});

/** Drops a file on the page as a hand does. */
async function dropFile(page, name, text) {
  const data = await page.evaluateHandle(
    ([n, t]) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([t], n));
      return transfer;
    },
    [name, text],
  );
  await page.dispatchEvent('.picture', 'dragover', { dataTransfer: data });
  assert.ok(await page.locator('.picture.dropping').count());
  await page.dispatchEvent('.picture', 'drop', { dataTransfer: data });
}

const tray =
  '<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="100mm" viewBox="0 0 200 100"><rect id="lid" x="5" y="5" width="60" height="30"/><circle id="disc" cx="120" cy="50" r="20"/></svg>';

inEditor(
  'takes a dropped layout, and a drawing with the material that it asks for',
  async (page, server) => {
    await dropFile(
      page,
      'again.json',
      JSON.stringify({ ...smallLayout, name: 'Again', placements: smallLayout.placements.slice(0, 1) }),
    );
    await page.waitForFunction(() => document.querySelectorAll('.mirror li').length === 1);
    await dropFile(page, 'parts.svg', tray);
    await page.waitForSelector('dialog [data-field="width.0"]');
    await page.fill('dialog [data-field="gap"]', 'wide');
    await command(page, 'order.make');
    await page.waitForFunction(() => /gap: "wide"/.test(document.querySelector('dialog .trouble').textContent));
    await page.fill('dialog [data-field="gap"]', '2,5');
    await page.fill('dialog [data-field="width.0"]', '300,5');
    await page.fill('dialog [data-field="height.0"]', '200');
    await page.fill('dialog [data-field="count.0"]', '2');
    await command(page, 'order.make');
    await page.waitForSelector('dialog', { state: 'detached' });
    await page.waitForSelector('[data-id="part-parts-2"]');
    await page.click('[data-id="part-parts-2"] .piece');
    await settled(page);
    assert.equal(await placed(page), 1);
    await command(page, 'side.sheets');
    assert.equal(await page.locator('[data-id^="sheet-300.5x200-"]').count(), 2);
    // The layout without a sheet is gone.
    assert.equal((await (await fetch(new URL('/api/layouts', server.url))).json()).layouts.length, 3);
  },
  { expected: ['400'] },
);

inEditor(
  'says in the dialog which drawing cannot be read, and reads the others',
  async (page) => {
    await page.setViewportSize({ width: 390, height: 844 });
    await command(page, 'menu.main');
    await command(page, 'new.layout');
    await page.setInputFiles('dialog [data-action="order.file"]', [
      { name: 'broken.svg', mimeType: 'image/svg+xml', buffer: Buffer.from('<svg><rect') },
      { name: 'lid.svg', mimeType: 'image/svg+xml', buffer: Buffer.from(tray.replace(/<circle.*\/>/, '')) },
    ]);
    await page.waitForFunction(() => /60 × 30 mm/.test(document.querySelectorAll('dialog .drawing')[1]?.textContent));
    assert.match(await page.textContent('dialog .drawing .trouble'), /broken\.svg/);
    assert.deepEqual(await cutOff(page, ['dialog table']), []);
    await command(page, 'order.cancel');
    // Each part of the tray has the colour that it has in the picture.
    const colours = await page.locator('.tray path').evaluateAll((all) => all.map((e) => getComputedStyle(e).fill));
    assert.equal(new Set(colours).size, smallLayout.parts.length);
    // The longer words of the other language leave every button in its place, too.
    await command(page, 'menu.main');
    await command(page, 'language');
    await command(page, 'menu.main');
    await command(page, 'new.layout');
    await page.setInputFiles('dialog [data-action="order.file"]', [
      { name: 'lid.svg', mimeType: 'image/svg+xml', buffer: Buffer.from(tray) },
    ]);
    await page.waitForSelector('dialog .drawing .thumbnail');
    assert.deepEqual(await cutOff(page, ['dialog table']), []);
  },
  { options: {}, expected: ['400'] },
);

inEditor(
  'makes one job of five dropped drawings, from an empty page to G-code',
  async (page, server) => {
    for (const { id } of (await (await fetch(new URL('/api/layouts', server.url))).json()).layouts)
      await page.evaluate((one) => fetch(`/api/layouts/${one}`, { method: 'DELETE' }), id);
    await page.goto(server.url);
    await page.waitForSelector('.welcome');
    assert.equal(await page.locator('.welcome [data-action^="sample."]').count(), 3);
    // What would have nothing to work on cannot be pressed; what begins something can.
    for (const name of ['job', 'undo', 'nest', 'copy.layout', 'tool.defect', 'tray.job'])
      assert.ok(await page.locator(`[data-action="${name}"]`).isDisabled(), name);
    for (const name of ['new.layout', 'open.file', 'language', 'help'])
      assert.ok(await page.locator(`.bar [data-action="${name}"]`).isEnabled(), name);
    // Each of several files that are refused is named.
    await page.setInputFiles('.bar .files input[type="file"]', [
      { name: 'photo.jpg', mimeType: 'image/jpeg', buffer: Buffer.from([0xff, 0xd8, 0xff, 0xe0]) },
      { name: 'part.dwg', mimeType: '', buffer: Buffer.from('AC1027\0\0') },
    ]);
    await page.waitForFunction(() =>
      /photo\.jpg.* · part\.dwg.*DXF/.test(document.querySelector('.message').textContent),
    );
    const data = await page.evaluateHandle((text) => {
      const transfer = new DataTransfer();
      for (let i = 1; i <= 5; ++i) transfer.items.add(new File([text], `tray${i}.svg`));
      return transfer;
    }, tray);
    await page.dispatchEvent('.picture', 'drop', { dataTransfer: data });
    await page.waitForSelector('dialog [data-field="quantity.4"]');
    // Each drawing is shown in small, with its parts: a wide lid and a disc.
    await page.waitForFunction(() => document.querySelectorAll('dialog .drawing .thumbnail').length === 10);
    const small = (i) => page.locator('dialog .drawing path').nth(i);
    const box = (e) => [e.getBBox().width, e.getBBox().height].map(Math.round);
    assert.deepEqual(
      [await small(0).evaluate(box), await small(1).evaluate(box)],
      [
        [60, 30],
        [40, 40],
      ],
    );
    assert.match(await page.textContent('dialog .drawing'), /2 parts/);
    await page.fill('dialog [data-field="quantity.1"]', '3');
    await page.selectOption('dialog [data-field="rotations.0"]', '0');
    await page.fill('dialog [data-field="width.0"]', '600');
    await page.fill('dialog [data-field="height.0"]', '400');
    await page.fill('dialog [data-field="count.0"]', '');
    await command(page, 'order.make');
    await page.waitForSelector('dialog', { state: 'detached' });
    await page.waitForSelector('[data-id="part-tray5-2"]');
    assert.equal(await page.locator('.welcome').count(), 0);
    assert.match(await page.textContent('[data-id="part-tray2"]'), /0\/3/);
    await page.click('[data-id="part-tray1"] .piece');
    await settled(page);
    await command(page, 'menu.export');
    await command(page, 'export.gcode');
    await page.fill('dialog [data-field="kerf"]', '0,2');
    await page.fill('dialog [data-field="feed"]', '2000');
    const [download] = await Promise.all([page.waitForEvent('download'), command(page, 'export.save')]);
    const file = join(server.folder, 'out.nc');
    await download.saveAs(file);
    assert.match(readFileSync(file, 'utf8'), /F2000/);
  },
  { expected: ['400'] },
);

/** What of the bar, the tools and the tabs cannot be seen, or reaches out of the window. */
const cutOff = (page, rows) =>
  page.evaluate(
    (list) =>
      list.flatMap((selector) =>
        [...document.querySelectorAll(selector)].flatMap((row) => {
          const wide = row.scrollWidth > row.clientWidth + 1 ? [`${selector} is wider than its place`] : [];
          const out = [...row.querySelectorAll('button, summary, select, input')].filter((e) => {
            const { left, right, top, bottom } = e.getBoundingClientRect();
            return right > left && (left < 0 || right > innerWidth + 0.5 || top < 0 || bottom > innerHeight);
          });
          return [...wide, ...out.map((e) => `${selector}: ${e.dataset.action ?? e.outerHTML.slice(0, 80)}`)];
        }),
      ),
    rows,
  );
const rowsOfThePage = ['.files', '.ends', '.commands', '.tools', '.tabs', '.status', '.menu[open] .items'];

for (const [width, height] of [
  [390, 844],
  [861, 700],
  [1400, 900],
])
  inEditor(
    `shows every button whole at ${width} x ${height}, in both languages, and does what it says`,
    async (page) => {
      const narrow = width < 861;
      for (const language of ['en', 'uk']) {
        await page.waitForFunction((wanted) => document.documentElement.lang === wanted, language);
        assert.deepEqual(await cutOff(page, rowsOfThePage), []);
        for (const menu of narrow ? ['main', 'view', 'export', 'more'] : ['view', 'export']) {
          await command(page, `menu.${menu}`);
          assert.deepEqual(await cutOff(page, rowsOfThePage), [], menu);
          await command(page, `menu.${menu}`);
        }
        const words = await page.locator('.bar .word:visible').count();
        if (narrow) assert.equal(words, 0);
        // The words of the last buttons may have no room; those of what is hard to guess have.
        if (width >= 1400)
          for (const name of ['job', 'open.file', 'undo', 'snap', 'nest'])
            assert.ok(await page.locator(`.bar [data-action="${name}"] .word`).isVisible(), `${language} ${name}`);
        if (narrow && language === 'en') await command(page, 'menu.main');
        if (language === 'en') await command(page, 'language');
      }
      // The action lies in the menu on a narrow screen, and does there what the button does.
      await press(page, 2);
      if (narrow) await command(page, 'menu.more');
      await command(page, 'lock');
      await settled(page);
      assert.match(await page.getAttribute('[data-id="placement-2"]', 'aria-label'), /закріплена/);
    },
    { options: { viewport: { width, height }, hasTouch: width < 861 } },
  );

inEditor('reads the drawing that it has exported: parts and sheets, no labels', async (page, server) => {
  await command(page, 'menu.export');
  await command(page, 'export.dxf');
  const [download] = await Promise.all([page.waitForEvent('download'), command(page, 'export.save')]);
  const file = join(server.folder, 'out.dxf');
  await download.saveAs(file);
  await dropFile(page, 'out.dxf', readFileSync(file, 'utf8'));
  await page.waitForSelector('[data-id="part-CUT"]');
  assert.equal(await page.locator('.tray li').count(), 3);
  assert.match(await message(page), /its parts are on CUT and its sheets on SHEET/);
  await page.click('[data-id="part-CUT-2"] .piece');
  await settled(page);
  assert.equal(await placed(page), 1);
  assert.equal(await broken(page), 0);
  const read = run('check', file, '--json');
  assert.equal(read.status, 0, read.stderr);
});

inEditor('prints how quick it is on this layout when asked in the address', async (page, server) => {
  await page.goto(`${server.page}${server.page.includes('?') ? '&' : '?'}benchmark`);
  await page.waitForSelector('dialog.benchmark[data-done]', { timeout: 50_000 });
  const rows = await page
    .locator('dialog.benchmark tbody tr')
    .evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)));
  assert.equal(rows.length, await page.evaluate(() => window.lekaloBench.rows.length));
  for (const [what, ...figures] of rows)
    for (const figure of figures) assert.ok(Number(figure) >= 0, `${what}: ${figure}`);
  assert.match(await page.textContent('dialog.benchmark p'), /first view \d+ ms/);
  await page.click('dialog.benchmark button');
  assert.equal(await page.locator('dialog.benchmark').count(), 0);
});

inEditor('says every key, and closes again', async (page) => {
  await command(page, 'help');
  const text = await page.textContent('dialog');
  for (const key of ['Tab', 'Ctrl + ← ↑ → ↓', '[ ]', 'Ctrl+Z', 'Esc', '/', '?']) assert.ok(text.includes(key), key);
  await page.keyboard.press('Escape');
  await page.waitForSelector('dialog', { state: 'detached' });
});

inEditor('has every word in Ukrainian', async (page) => {
  await command(page, 'language');
  await command(page, 'side.sheets');
  const words = await page.evaluate(() =>
    [...document.querySelectorAll('button, summary, h2, label, th')]
      .flatMap((e) => [e.textContent, e.title, e.ariaLabel])
      .filter(Boolean),
  );
  const latin = words.filter(
    (word) =>
      /[A-Za-z]{4}/.test(word) &&
      !/JSON|lekalo|DXF|HPGL|G-code|Plate|Bracket|Small|edge|knot|board|Shift|Enter/.test(word),
  );
  assert.deepEqual(latin, []);
  await command(page, 'language');
});
