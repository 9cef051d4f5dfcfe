// Parts and sheets of an open layout: added, changed and removed with the mouse and by the keyboard alone, undone, seen
// by others, and cut at the end. LEKALO_SHOTS names a folder for pictures of the dialog.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { newTab } from './harness.mjs';
import { smallLayout } from './small_layout.mjs';
import { checked, command, export_, inEditor, placed, settled } from './steps.mjs';

const lid =
  '<svg xmlns="http://www.w3.org/2000/svg" width="70mm" height="40mm" viewBox="0 0 70 40"><rect x="5" y="5" width="60" height="30"/></svg>';
const drawing = (name, text = lid) => ({ name, mimeType: 'image/svg+xml', buffer: Buffer.from(text) });
const document_ = async (server) => JSON.parse(await export_(server));
const shot = async (page, name) => {
  const folder = process.env.LEKALO_SHOTS;
  if (folder) await page.screenshot({ path: join(folder, `${name}.png`) });
};
const field = (name) => `dialog [data-field="${name}"]`;
const until = (page, text) =>
  page.waitForFunction((wanted) => document.querySelector('dialog.job .footer p').textContent.includes(wanted), text);
/** Waits until the server has the layout that was asked for. */
const becomes = async (server, holds) => {
  for (let i = 0; i < 100; ++i) {
    const now = await document_(server);
    if (holds(now)) return now;
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
  assert.fail(`never: ${holds} of ${JSON.stringify(await document_(server)).slice(0, 800)}`);
};
/** The fields and buttons of the dialog that reach out of the window at its side. */
const cutOff = (page) =>
  page.evaluate(() => {
    const dialog = document.querySelector('dialog.job');
    const out = [...dialog.querySelectorAll('button, input, select')].filter((e) => {
      const { left, right } = e.getBoundingClientRect();
      return right > left && (left < 0 || right > innerWidth + 0.5);
    });
    const wide = dialog.scrollWidth > dialog.clientWidth + 1 ? ['the dialog is wider than its place'] : [];
    return [...wide, ...out.map((e) => e.outerHTML.slice(0, 80))];
  });

for (const [width, height] of [
  [1400, 900],
  [390, 844],
])
  inEditor(
    `changes the parts and sheets of an open layout, and cuts them, at ${width} x ${height}`,
    async (page, server, t) => {
      const other = await newTab(page.context().browser());
      t.after(() => other.context().close());
      await other.goto(server.page);
      await settled(other);
      const open = async () => {
        if (width < 861) await command(page, 'menu.main');
        await command(page, 'job');
        await page.waitForSelector('dialog.job');
      };
      await open();
      assert.equal(await page.inputValue(field('quantity.plate')), '4');
      await shot(page, `job-${width}`);
      assert.deepEqual(await cutOff(page), []);
      // A quantity, the angles, the mirror.
      await page.fill(field('quantity.plate'), '6');
      await page.keyboard.press('Enter');
      await becomes(server, (d) => d.parts[0].demand === 6);
      await page.selectOption(field('rotations.bracket'), '0,180');
      await becomes(server, (d) => String(d.parts[1].rotations) === '0,180');
      await page.uncheck(field('mirror.plate'));
      await becomes(server, (d) => d.parts[0].mirror === undefined);
      // A drawing, a sheet by its size, a drawn one.
      await page.setInputFiles('dialog [data-action="job.file"]', [drawing('lid.svg')]);
      await page.waitForSelector(field('quantity.lid'));
      await page.fill(field('quantity.lid'), '3');
      await page.keyboard.press('Tab');
      await becomes(server, (d) => d.parts[2]?.demand === 3);
      await command(page, 'job.stock.add');
      await until(page, 'Say how large the material is first.');
      await page.fill(field('new.width'), '2ft');
      await page.fill(field('new.height'), '300,5 mm');
      await page.fill(field('new.count'), '2');
      await command(page, 'job.stock.add');
      await page.waitForSelector(field('count.609.6x300.5'));
      await page.selectOption(field('new.kind'), 'drawing');
      await page.setInputFiles(field('new.drawing'), [drawing('hide.svg')]);
      await command(page, 'job.stock.add');
      await page.waitForSelector('[data-id="job-stock-hide"]');
      await page.selectOption(field('new.kind'), 'strip');
      await page.fill(field('new.height'), '500');
      await page.keyboard.press('Enter');
      await page.waitForSelector('[data-id="job-stock-strip-500"]');
      // The gaps.
      await page.fill(field('rule.gap'), '3,5');
      await page.keyboard.press('Enter');
      await becomes(server, (d) => d.rules.gap === 3.5);
      await page.fill(field('rule.kerf'), '4');
      await page.keyboard.press('Tab');
      await becomes(server, (d) => d.rules.gap === 4);
      await page.waitForFunction(() => document.querySelector('[data-field="rule.gap"]').value === '4');
      await until(page, 'The gap is no narrower than the cut: it is 4 mm');
      // The cut is kept, and a gap that would be narrower than it is not.
      assert.equal(await page.inputValue(field('rule.kerf')), '4');
      await page.fill(field('rule.gap'), '1');
      await page.keyboard.press('Tab');
      await page.waitForFunction(() => document.querySelector('[data-field="rule.gap"]').value === '4');
      await page.fill(field('rule.kerf'), '0,2');
      await page.keyboard.press('Tab');
      await becomes(server, (d) => d.rules.kerf === 0.2 && d.rules.gap === 4);
      // A gap that is deleted is not 0.
      await page.fill(field('rule.gap'), '');
      await page.keyboard.press('Tab');
      await page.waitForSelector('[data-field="rule.gap"][aria-invalid]');
      await page.fill(field('rule.gap'), '4');
      await page.keyboard.press('Tab');
      await page.waitForSelector('[data-field="rule.gap"]:not([aria-invalid])');
      assert.deepEqual(await cutOff(page), []);
      await shot(page, `job-${width}-full`);
      // What is wrong is said in one sentence, and stays to be mended.
      await page.fill(field('quantity.lid'), 'many');
      await page.keyboard.press('Enter');
      await until(page, "'many' is no whole number");
      assert.equal(await page.inputValue(field('quantity.lid')), 'many');
      assert.equal(await page.getAttribute(field('quantity.lid'), 'aria-invalid'), '');
      await shot(page, `job-${width}-wrong`);
      await page.fill(field('quantity.lid'), '2');
      await page.keyboard.press('Enter');
      await becomes(server, (d) => d.parts[2].demand === 2);
      await page.setInputFiles('dialog [data-action="job.file"]', [drawing('broken.svg', '<svg><rect')]);
      await until(page, 'broken.svg');
      // A part goes with what is placed of it, and comes back.
      await page.click(field('remove.plate'));
      await until(page, '2 pieces were taken off with it');
      assert.equal((await becomes(server, (d) => d.parts.length === 2)).placements.length, 1);
      await other.waitForFunction(() => document.querySelectorAll('.mirror li').length === 1);
      assert.equal(await other.locator('[data-id="part-plate"]').count(), 0);
      await command(page, 'job.undo');
      await page.waitForSelector(field('quantity.plate'));
      const back = await becomes(server, (d) => d.parts.length === 3);
      assert.deepEqual(
        [back.parts.map(({ id }) => id), back.placements.length, back.parts[0].demand],
        [['plate', 'bracket', 'lid'], 3, 6],
      );
      await page.click(field('stock.remove.strip-500'));
      await page.waitForSelector('[data-id="job-stock-strip-500"]', { state: 'detached' });
      await command(page, 'job.close');
      await page.waitForSelector('dialog', { state: 'detached' });
      await settled(page);
      // The other page has followed all of it.
      await other.waitForSelector('[data-id="part-lid"]');
      await settled(other);
      assert.equal(await placed(other), 3);
      // What came is placed, checked and cut.
      await page.click('[data-id="part-lid"] .piece');
      await settled(page);
      assert.equal(await placed(page), 4);
      assert.equal((await checked(server)).violations.filter(({ a }) => a === 4).length, 0);
      await command(page, 'side.history');
      await page.waitForSelector('[data-id="revision-2"]');
      const history = await page.textContent('.body');
      for (const words of ['Plate: 6 wanted', 'added lid', 'added hide', 'gap 3.5 mm', 'undone: removed part Plate'])
        assert.ok(history.includes(words), `${words} in ${history}`);
      await shot(page, `job-${width}-after`);
      await command(page, 'menu.export');
      await command(page, 'export.gcode');
      assert.equal(await page.inputValue('dialog [data-field="kerf"]'), '0.2');
      await page.fill('dialog [data-field="feed"]', '2000');
      const sheets = page.locator('dialog select[data-field="sheet"]');
      if ((await sheets.count()) > 0) await sheets.selectOption({ index: 0 });
      const [download] = await Promise.all([page.waitForEvent('download'), command(page, 'export.save')]);
      const file = join(server.folder, 'out.nc');
      await download.saveAs(file);
      assert.match(readFileSync(file, 'utf8'), /F2000/);
    },
    { options: { viewport: { width, height }, hasTouch: width < 861 }, expected: ['400'] },
  );

const withKits = {
  ...smallLayout,
  kits: [
    { id: 'set', name: 'Set', pieces: [{ part: 'plate', count: 2 }, { part: 'bracket' }] },
    {
      id: 'pair',
      name: 'Pair',
      pieces: [
        { part: 'plate', mirrored: true },
        { part: 'plate', mirrored: false },
      ],
    },
  ],
};
inEditor(
  'removes a part from its kits too, names them, and brings all of it back in one step',
  async (page, server) => {
    await page.click('[data-action="tray.job"]');
    await page.waitForSelector('dialog.job');
    await page.click(field('mirror.plate'));
    await until(page, "kit 'pair' is made with part 'plate' turned over");
    assert.ok(await page.isChecked(field('mirror.plate')));
    await page.click(field('remove.plate'));
    await until(page, '2 pieces were taken off with it · Taken out of kits: Set · Removed with it');
    await until(page, 'nothing else was in them: Pair');
    assert.deepEqual((await becomes(server, (d) => d.parts.length === 1)).kits, [
      { id: 'set', name: 'Set', demand: 1, pieces: [{ part: 'bracket' }] },
    ]);
    await shot(page, 'job-kits');
    await command(page, 'job.undo');
    await page.waitForSelector(field('quantity.plate'));
    const back = await becomes(server, (d) => d.parts.length === 2);
    assert.deepEqual([back.kits.length, back.kits[0].pieces.length, back.placements.length], [2, 2, 3]);
    await page.keyboard.press('Escape');
    await page.waitForSelector('dialog', { state: 'detached' });
    await settled(page);
  },
  { layout: withKits, options: {} },
);

inEditor(
  'changes parts and sheets by the keyboard alone, in Ukrainian, on a phone',
  async (page, server) => {
    const focus = () =>
      page.evaluate(() => {
        const { dataset } = document.activeElement;
        return dataset.field ?? dataset.action ?? '';
      });
    const tabTo = async (name, back = false) => {
      for (let i = 0; i < 90 && (await focus()) !== name; ++i) await page.keyboard.press(back ? 'Shift+Tab' : 'Tab');
      assert.equal(await focus(), name);
    };
    page.on('filechooser', (chooser) => chooser.setFiles([drawing('lid.svg')]));
    await command(page, 'menu.main');
    await command(page, 'language');
    await page.focus('[data-action="tray.job"]');
    await page.keyboard.press('Enter');
    await page.waitForSelector('dialog.job');
    assert.match(await page.textContent('dialog.job h2'), /Деталі й аркуші/);
    await tabTo('quantity.plate');
    await page.keyboard.press('Control+a');
    await page.keyboard.type('9');
    await page.keyboard.press('Tab');
    await becomes(server, (d) => d.parts[0].demand === 9);
    await page.waitForFunction(() => document.activeElement?.dataset.field === 'rotations.plate'); // not lost
    await tabTo('job.add');
    await page.keyboard.press('Enter');
    await page.waitForSelector(field('quantity.lid'));
    await tabTo('new.width');
    await page.keyboard.type('500');
    await page.keyboard.press('Tab');
    await page.keyboard.type('400');
    await page.keyboard.press('Enter');
    await page.waitForSelector(field('count.500x400'));
    assert.equal((await document_(server)).stocks[1].count, 9 + 2 + 1); // one for every piece
    await shot(page, 'job-390-uk');
    assert.deepEqual(await cutOff(page), []);
    await tabTo('remove.bracket', true);
    await page.keyboard.press('Enter');
    await until(page, 'Разом знято 1 деталь');
    await page.waitForFunction(() => document.querySelector('dialog').contains(document.activeElement));
    await tabTo('job.undo');
    await page.keyboard.press('Enter');
    await page.waitForSelector(field('quantity.bracket'));
    await page.keyboard.press('Escape');
    await page.waitForSelector('dialog', { state: 'detached' });
    await settled(page);

    assert.equal(await placed(page), 3);
  },
  { layout: smallLayout, options: { viewport: { width: 390, height: 844 }, hasTouch: true } },
);
