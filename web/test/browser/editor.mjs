// The editor as a person uses it: the real server, the real kernel, a real browser.

import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { open, ready, run, tabOf } from './harness.mjs';
import { heapLayout } from './heap_layout.mjs';
import { longLayout } from './long_layout.mjs';
import { assertPictureDiffers, comparePicture } from './pictures.mjs';
import { nestLayout } from './nest_layout.mjs';
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
  live,
  message,
  picture,
  placed,
  placementOf,
  press,
  scaleOf,
  settled,
} from './steps.mjs';

inEditor('opens with its parts, its rules checked by the kernel, and looks as it did', async (page) => {
  assert.equal(await placed(page), 3);
  assert.equal(await page.locator('.tray li').count(), 2);
  assert.match(await page.textContent('.body'), /No rule is broken/);
  assert.match(
    await page.getAttribute('[data-id="placement-3"]', 'aria-label'),
    /^Bracket 3, 20.00 120.00 mm, 0.0°, clear$/,
  );
  await comparePicture(page, 'small');
});

inEditor('refuses a forbidden place in strict mode, after showing its depth', async (page, server) => {
  await hold(page, 2, -100, 0);
  await page.waitForFunction(() => /depth \d/.test(document.querySelector('.status .live').textContent));
  assert.equal(await picture(page).getAttribute('data-level'), 'forbidden');
  assert.match(await live(page), /forbidden.*depth 30\.\d+ mm/);
  await drop(page);
  assert.match(await message(page), /not admitted/);
  assert.equal((await placementOf(server, 2)).x, 200);
  assert.match(await page.getAttribute('[data-id="placement-2"]', 'aria-label'), /200.00 40.00 mm/);
});

inEditor('says while dragging when a part is nearer than the gap, and how far it is when clear', async (page) => {
  await hold(page, 2, -69, 0);
  assert.equal(await picture(page).getAttribute('data-level'), 'gap');
  await page.mouse.move(...(await at(page, 2)).slice(0, 2));
  const k = await scaleOf(page);
  const [x, y] = await at(page, 2);
  await page.mouse.move(x - 55 * k, y);
  assert.equal(await picture(page).getAttribute('data-level'), 'clear');
  assert.match(await live(page), /clear.*nearest 1[45]\.\d+ mm/);
  await page.keyboard.press('Escape');
  await drop(page);
  assert.match(await page.getAttribute('[data-id="placement-2"]', 'aria-label'), /200.00 40.00 mm/);
});

inEditor(
  'puts it there in free mode, red, with the depth the program measures; undo and redo',
  async (page, server) => {
    await command(page, 'mode.free');
    await hold(page, 2, -100, 0);
    await drop(page);
    assert.equal(await broken(page), 1);
    const said = await checked(server);
    assert.equal(said.exit, 1);
    assert.equal(said.violations.length, 1);
    const shown = await page.textContent('[data-id="violation-overlap-1-2"] small');
    assert.equal(shown, `${said.violations[0].amount_mm.toFixed(3)} mm`);
    assert.equal(await page.getAttribute('[data-id="placement-2"]', 'data-level'), 'forbidden');
    await page.click('[data-id="violation-overlap-1-2"] button');
    await page.keyboard.press('Escape');
    await command(page, 'fit');
    await settled(page);
    await comparePicture(page, 'overlap');
    await command(page, 'undo');
    await settled(page);
    assert.equal(await broken(page), 0);
    assert.equal((await placementOf(server, 2)).x, 200);
    await assertPictureDiffers(page, 'overlap');
    await command(page, 'redo');
    await settled(page);
    assert.equal(await broken(page), 1);
    await command(page, 'undo');
    await settled(page);
    assert.equal((await checked(server)).exit, 0);
  },
);

inEditor('slides to contact by an arrow, by a flick and by a button', async (page, server) => {
  const step = 2 ** -20;
  await press(page, 2);
  await keys(page, 'Control+ArrowLeft');
  assert.ok(Math.abs((await placementOf(server, 2)).x - 132) <= 2 * step);
  await command(page, 'slide.right');
  await settled(page);
  assert.ok(Math.abs((await placementOf(server, 2)).x - 355) <= 2 * step);
  await command(page, 'tool.slide');
  await hold(page, 2, 0, 60);
  await drop(page);
  // The plate goes up to the knot, whose lower edge is at 190, less a gap of 1 and half a plate.
  assert.ok(Math.abs((await placementOf(server, 2)).y - 164) <= 2 * step);
  assert.equal((await checked(server)).exit, 0);
});

inEditor('keeps everything over a reload, undo too', async (page, server) => {
  await press(page, 3);
  await keys(page, 'ArrowUp', 'Shift+ArrowRight');
  assert.equal((await placementOf(server, 3)).x, 30);
  await page.reload();
  await ready(page);
  await settled(page);
  assert.match(await page.getAttribute('[data-id="placement-3"]', 'aria-label'), /30.00 121.00 mm/);
  await command(page, 'undo');
  await command(page, 'undo');
  await settled(page);
  assert.equal((await placementOf(server, 3)).x, 20);
  assert.equal((await placementOf(server, 3)).y, 120);
});

inEditor(
  'goes on where it was when the server was killed and is there again',
  async (page, server) => {
    await press(page, 3);
    await keys(page, 'ArrowUp');
    await server.kill();
    await page.waitForFunction(() => /No connection/.test(document.querySelector('.status').textContent), null, {
      polling: 20,
    });
    await keys(page, 'ArrowUp');
    assert.match(await message(page), /The connection broke/);
    await server.start();
    await page.waitForFunction(() => /Saved/.test(document.querySelector('.status').textContent), null, {
      polling: 20,
    });
    await settled(page);
    assert.match(await page.getAttribute('[data-id="placement-3"]', 'aria-label'), /20.00 121.00 mm/);
    await keys(page, 'ArrowUp', 'Control+z');
    assert.equal((await placementOf(server, 3)).y, 121);
  },
  { expected: ['ERR_CONNECTION', 'WebSocket'] },
);

inEditor('keeps two tabs in step, and undoes only its own', async (page, server) => {
  const other = await tabOf(page.context());
  await open(other, server.page);
  await settled(other);
  await press(page, 3);
  await keys(page, 'ArrowUp');
  await other.waitForFunction(
    () => /20.00 121.00/.test(document.querySelector('[data-id="placement-3"]').ariaLabel),
    null,
    { polling: 20 },
  );
  assert.match(await other.textContent('.status'), /1 other here/);
  await other.bringToFront();
  await press(other, 3);
  await keys(other, 'ArrowUp');
  await page.waitForFunction(
    () => /20.00 122.00/.test(document.querySelector('[data-id="placement-3"]').ariaLabel),
    null,
    { polling: 20 },
  );
  await page.bringToFront();
  await command(page, 'undo');
  await settled(page);
  assert.match(await message(page), /move 3 by 0 1/);
  assert.equal((await placementOf(server, 3)).y, 122);
  await command(other, 'undo');
  await settled(other);
  await command(page, 'undo');
  await settled(page);
  assert.equal((await placementOf(server, 3)).y, 120);
  assert.deepEqual(other.problems, []);
  await other.close();
});

inEditor('is whole by the keyboard alone', async (page, server) => {
  const focus = () => page.evaluate(() => document.activeElement.className);
  for (let i = 0; i < 80 && (await focus()) !== 'picture'; ++i) await page.keyboard.press('Tab');
  assert.equal(await focus(), 'picture');
  await keys(page, 'Tab', 'Tab');
  assert.equal(await page.getAttribute('.picture', 'aria-activedescendant'), 'placement-2');
  await keys(page, 'ArrowRight', 'Shift+ArrowUp');
  let p = await placementOf(server, 2);
  assert.deepEqual([p.x, p.y], [201, 50]);
  await keys(page, 'm');
  p = await placementOf(server, 2);
  assert.equal(p.mirrored, true);
  await keys(page, 'l');
  assert.equal((await placementOf(server, 2)).locked, true);
  await keys(page, 'l', 'Control+d');
  assert.equal(await placed(page), 4);
  await keys(page, 'Delete');
  assert.equal(await placed(page), 3);
  for (let i = 0; i < 7; ++i) await keys(page, 'Control+z');
  assert.deepEqual(
    JSON.parse(await export_(server)).placements,
    smallLayout.placements.map((q) => ({ ...q })),
  );
  await page.keyboard.press('?');
  assert.equal(await page.locator('dialog').count(), 1);
});

inEditor(
  'is used by touch: drag, pinch',
  async (page, server) => {
    const cdp = await page.context().newCDPSession(page);
    const touch = (type, ...points) =>
      cdp.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    const [x, y] = await at(page, 3);
    const k = await scaleOf(page);
    await touch('touchStart', [x, y]);
    await touch('touchMove', [x + 20 * k, y]);
    await touch('touchMove', [x + 40 * k, y]);
    await touch('touchEnd');
    await settled(page);
    assert.ok(Math.abs((await placementOf(server, 3)).x - 60) < 0.5);
    const middle = await page.locator('.picture').evaluate((e) => e.getBoundingClientRect().toJSON());
    const [cx, cy] = [middle.x + middle.width / 2, middle.y + 60];
    await touch('touchStart', [cx - 50, cy], [cx + 50, cy]);
    await touch('touchMove', [cx - 100, cy], [cx + 100, cy]);
    await touch('touchEnd');
    await settled(page);
    const now = await scaleOf(page);
    assert.ok(now > 1.8 * k && now < 2.2 * k, `${now} after ${k}`);
  },
  { options: { hasTouch: true } },
);

inEditor('takes a part out of the tray by hand, and puts one where it fits by a press', async (page, server) => {
  const piece = await page.locator('[data-id="part-plate"] .piece').boundingBox();
  const [x, y, box] = await at(page, 2);
  const k = box.width / 80;
  await page.mouse.move(piece.x + 20, piece.y + 20);
  await page.mouse.down();
  await page.mouse.move(x, y + 2, { steps: 3 });
  assert.equal(await picture(page).getAttribute('data-level'), 'forbidden');
  await page.mouse.move(x, y - 100 * k, { steps: 3 });
  assert.equal(await picture(page).getAttribute('data-level'), 'clear');
  await drop(page);
  assert.equal(await placed(page), 4);
  const p = await placementOf(server, 4);
  assert.ok(p.part === 'plate' && Math.hypot(p.x - 200, p.y - 140) < 1, JSON.stringify(p));
  await page.click('[data-id="part-bracket"] .piece');
  await settled(page);
  assert.equal(await placed(page), 5);
  assert.equal((await checked(server)).exit, 0);
});

inEditor(
  'turns by the handle: freely, by steps with Shift, from one allowed angle to the next',
  async (page, server) => {
    const degrees = async (id) => {
      const p = await placementOf(server, id);
      return (Math.atan2(p.s, p.c) * 180) / Math.PI;
    };
    /** Turns the chosen parts by hand about the middle of a box. */
    const turn = async (box, by, key) => {
      const [mx, my] = [box.x + box.width / 2, box.y + box.height / 2];
      const r = box.height / 2 + 26;
      await page.mouse.move(mx, my - r);
      await page.mouse.down();
      if (key) await page.keyboard.down(key);
      const a = (by * Math.PI) / 180;
      await page.mouse.move(mx - r * Math.sin(a), my - r * Math.cos(a), { steps: 4 });
      if (key) await page.keyboard.up(key);
      await drop(page);
    };
    await press(page, 3);
    await keys(page, 'Shift+ArrowRight', 'Shift+ArrowRight', 'Shift+ArrowUp');
    await turn((await at(page, 3))[2], 20);
    assert.ok(Math.abs((await degrees(3)) - 20) < 0.6, `${await degrees(3)}; ${await message(page)}`);
    await keys(page, 'Control+z');
    await turn((await at(page, 3))[2], 40, 'Shift');
    assert.ok(Math.abs((await degrees(3)) - 45) < 1e-9, `${await degrees(3)}; ${await message(page)}`);
    await press(page, 2);
    await keys(page, 'Shift+ArrowUp', 'Shift+ArrowUp');
    await turn((await at(page, 2))[2], 70);
    assert.ok(Math.abs((await degrees(2)) - 90) < 1e-9, `${await degrees(2)}; ${await message(page)}`);
    assert.equal((await checked(server)).exit, 0);
  },
);

inEditor('moves several parts as one, chosen by a box', async (page, server) => {
  const [x1, y1, a] = await at(page, 1);
  const [x2, , b] = await at(page, 2);
  await page.mouse.move(a.x - 8, a.y - 8);
  await page.mouse.down();
  await page.mouse.move(b.x + b.width + 8, b.y + b.height + 8, { steps: 3 });
  await drop(page);
  assert.match(await live(page), /2 parts/);
  const k = a.width / 80;
  await page.mouse.move(x1, y1);
  await page.mouse.down();
  await page.mouse.move(x1 + 30 * k, y1 - 15 * k, { steps: 3 });
  await drop(page);
  const [p, q] = [await placementOf(server, 1), await placementOf(server, 2)];
  assert.ok(x2 > x1 && Math.abs(q.x - p.x - 150) < 1e-9 && p.y === q.y && Math.abs(p.x - 80) < 1);
  await keys(page, 'Control+z');
  assert.equal((await placementOf(server, 1)).x, 50);
});

inEditor('paints what changed, moved or was zoomed exactly as if all were painted', async (page) => {
  const same = () =>
    page.evaluate(() => {
      const canvas = document.querySelector('.picture canvas');
      const pixels = () => canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
      const shown = pixels();
      window.lekaloBench.paintAll();
      const all = pixels();
      const off = [];
      for (let i = 0; i < all.length; ++i)
        if (Math.abs(all[i] - shown[i]) > 2)
          off.push([(i >> 2) % canvas.width, Math.floor((i >> 2) / canvas.width), i % 4, shown[i], all[i]].join(' '));
      return off.slice(0, 20).join('; ');
    });
  await press(page, 3);
  await keys(page, 'ArrowRight', 'Shift+ArrowUp');
  assert.equal(await same(), '');
  await command(page, 'mode.free');
  await hold(page, 2, -100, 20);
  await drop(page);
  assert.equal(await same(), '');
  await command(page, 'undo');
  await settled(page);
  assert.equal(await same(), '');
  await page.mouse.move(700, 400);
  await page.mouse.down({ button: 'middle' });
  for (const [x, y] of [
    [720, 390],
    [651, 431],
    [500, 300],
    [610, 377],
  ])
    await page.mouse.move(x, y);
  await page.mouse.up({ button: 'middle' });
  await settled(page);
  assert.equal(await same(), '');
  const [, , before] = await at(page, 2);
  await page.mouse.wheel(0, -300);
  // The stretched picture itself is no sign: it may be gone before anyone looks.
  await page.waitForFunction(
    (width) => document.querySelector('[data-id="placement-2"]').getBoundingClientRect().width > 1.1 * width,
    before.width,
  );
  await settled(page);
  assert.equal(await same(), '');
});

inEditor('draws, moves, grades and removes defects and zones, and says what lies on them', async (page, server) => {
  const defects = async () => JSON.parse(await export_(server)).stocks[0].defects;
  const [x, y, box] = await at(page, 2);
  const k = box.width / 80;
  /** A point by millimetres from the middle of the second plate, at (200, 40). */
  const to = (dx, dy) => [x + dx * k, y - dy * k];
  await command(page, 'tool.defect');
  await page.click('[data-action="side.sheets"]');
  await page.fill('[data-action="grade.defect"]', '3');
  await page.keyboard.press('Tab');
  for (const p of [to(30, 100), to(60, 100), to(60, 130)]) await page.mouse.click(...p);
  await page.keyboard.press('Enter');
  await settled(page);
  let made = (await defects()).at(-1);
  assert.deepEqual([made.id, made.severity, made.outline.polygon.outer.length], ['defect 2', 3, 3]);
  assert.ok(Math.hypot(made.outline.polygon.outer[0][0] - 230, made.outline.polygon.outer[0][1] - 140) < 1);
  // It is dragged onto the plate and admitted; the plate is on a defect from then on, as the program says, too.
  await page.mouse.move(...to(55, 110));
  await page.mouse.down();
  await page.mouse.move(...to(0, 5), { steps: 4 });
  await drop(page);
  await page.click('[data-action="side.violations"]');
  assert.equal(await page.locator('[data-id="violation-defect-2-defect 2"]').count(), 1);
  const said = await checked(server);
  assert.equal(said.exit, 1);
  assert.equal(
    await page.textContent('[data-id="violation-defect-2-defect 2"] small'),
    `${said.violations[0].amount_mm.toFixed(3)} mm`,
  );
  await command(page, 'undo');
  await settled(page);
  assert.equal(await broken(page), 0);
  // The next is drawn in one stroke.
  await page.mouse.move(...to(-150, 180));
  await page.mouse.down();
  for (const p of [to(-120, 180), to(-110, 200), to(-140, 210), to(-155, 195)])
    await page.mouse.move(...p, { steps: 4 });
  await drop(page);
  assert.equal((await defects()).length, 3);
  await command(page, 'tool.zone');
  for (const p of [to(-195, -35), to(-100, -35), to(-100, 20), to(-195, 20)]) await page.mouse.click(...p);
  await page.keyboard.press('Enter');
  await settled(page);
  assert.equal(JSON.parse(await export_(server)).stocks[0].zones.at(-1).id, 'zone 2');
  await page.click('[data-action="side.sheets"]');
  await comparePicture(page, 'features');
  await page.click('[data-id="zone-board-zone 2"] button');
  await settled(page);
  assert.equal(JSON.parse(await export_(server)).stocks[0].zones.length, 1);
  await page.fill('[data-id="defect-board-defect 2"] input', '7');
  await page.keyboard.press('Tab');
  await settled(page);
  made = (await defects()).find((d) => d.id === 'defect 2');
  assert.equal(made.severity, 7);
});

inEditor(
  'lays a photograph beneath, to scale by two points, kept for every tab and after a reload',
  async (page, server) => {
    const picked = join(server.folder, 'hide.png');
    writeFileSync(picked, await page.screenshot({ clip: { x: 300, y: 300, width: 400, height: 300 } }));
    const photos = (tab) => tab.evaluate(() => window.lekaloBench.photos());
    /** Waits until the tab shows a first photograph of which this function says yes. */
    const lies = async (tab, where) => {
      for (let i = 0; !where((await photos(tab))[0]); ++i) {
        assert.ok(i < 500, `${JSON.stringify(await photos(tab))} after ${where}; ${await message(tab)}`);
        await tab.waitForTimeout(20);
      }
    };
    const other = await tabOf(page.context());
    await open(other, server.page);
    await page.bringToFront();
    await page.setInputFiles('[data-action="photo.file"]', picked);
    await lies(page, (p) => p?.stock === 'board' && p.a === 1); // 400 pixels over 400 mm
    await command(page, 'tool.photo');
    const [before] = await photos(page);
    const k = await scaleOf(page);
    const pull = async (from, to) => {
      await page.mouse.move(...from);
      await page.mouse.down();
      await page.mouse.move(...to, { steps: 3 });
      await drop(page);
    };
    const [x, y] = await at(page, 1);
    await pull([x, y], [x + 20 * k, y]);
    assert.ok(Math.abs((await photos(page))[0].x - before.x - 20) < 0.5);
    // The pin is at x + 20. A point 100 mm to its right goes to 150 mm: the photograph is half as large again.
    await pull([x + 120 * k, y], [x + 170 * k, y]);
    const [after] = await photos(page);
    assert.ok(Math.abs(after.a - 1.5) < 0.01 && Math.abs(after.b) < 0.01, JSON.stringify(after));
    assert.equal((await checked(server)).exit, 0);
    // The other tab shows it in the same place, and so does this one when it comes anew.
    await lies(other, (p) => p?.a > 1.4);
    assert.deepEqual(await photos(other), [after]);
    await page.reload();
    await ready(page);
    await lies(page, (p) => p?.a > 1.4);
    assert.deepEqual(await photos(page), [after]);
    await settled(page);
    await comparePicture(page, 'photograph');
    await command(page, 'side.sheets');
    await page.click('[data-id="photo-board"] [aria-label="Remove"]');
    await lies(other, (p) => !p);
    await lies(page, (p) => !p);
    assert.equal(await page.locator('[data-id="photo-board"]').count(), 0);
    assert.equal(await page.locator('[data-action="tool.photo"]').count(), 0);
    await other.close();
  },
);

inEditor('prints each sheet in use with its parts', async (page) => {
  await command(page, 'mode.free');
  await keys(page, 'Escape');
  const box = await page.evaluate(() => {
    dispatchEvent(new Event('beforeprint'));
    const said = [...document.querySelectorAll('.paper section')].map((s) => [
      s.textContent,
      s.querySelector('canvas').width,
    ]);
    dispatchEvent(new Event('afterprint'));
    return said;
  });
  assert.deepEqual(box, [['SmallPlate2Bracket1', 2200]]);
  assert.equal((await page.pdf()).subarray(0, 5).toString(), '%PDF-');
  assert.equal(await page.locator('.paper section').count(), 0);
});

inEditor('exports what the program reads again', async (page, server) => {
  for (const form of ['layout', 'svg', 'pdf']) {
    await command(page, 'menu.export');
    const [download] = await Promise.all([page.waitForEvent('download'), command(page, `export.${form}`)]);
    const file = join(server.folder, download.suggestedFilename());
    await download.saveAs(file);
    if (form === 'layout') {
      const done = run('check', file, '--json');
      assert.equal(done.status, 0, done.stderr);
      assert.deepEqual(JSON.parse(readFileSync(file, 'utf8')).placements, smallLayout.placements);
    }
    if (form === 'svg') assert.match(readFileSync(file, 'utf8'), /<svg/);
    if (form === 'pdf') assert.equal(readFileSync(file).subarray(0, 5).toString(), '%PDF-');
  }
});

inEditor(
  'checks in the background what takes long, with a stop, and says what is not checked',
  async (page) => {
    const bar = page.locator('[data-work="check"]');
    await command(page, 'check.stop');
    assert.equal(await bar.count(), 0);
    const left = async () => Number(/^(\d+) parts are not checked yet/.exec(await page.textContent('.body .note'))[1]);
    const first = await left();
    assert.ok(first > 0 && first < 2500, String(first));
    assert.ok((await broken(page)) > 0); // what was found by then
    await command(page, 'check.resume');
    await page.waitForFunction(
      () => /^\d+ % · \d+ (s|min) left$/.test(document.querySelector('[data-work="check"] .says')?.textContent),
      null,
      { polling: 20 },
    );
    // The hand is free meanwhile, and what it holds is checked.
    const [x, y] = await at(page, 1, 0.5, 0.97);
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 5, y + 5, { steps: 2 });
    assert.equal(await picture(page).getAttribute('data-level'), 'forbidden');
    await page.keyboard.press('Escape');
    await page.mouse.up();
    await command(page, 'check.stop');
    assert.ok((await left()) < first);
  },
  { layout: heapLayout(2500), whole: false },
);

inEditor(
  'lists what the program lists, checked slice by slice',
  async (page, server) => {
    const said = await checked(server);
    assert.ok(said.violations.length > 500);
    assert.match(await page.textContent('.body .note'), new RegExp(`^${said.violations.length} rules broken`));
    const shown = await page
      .locator('.body li[data-id^="violation-"]')
      .evaluateAll((list) => list.map((e) => `${e.dataset.id} ${e.querySelector('small').textContent}`));
    assert.equal(shown.length, 500);
    assert.deepEqual(
      shown,
      said.violations.slice(0, 500).map((v) => `violation-${v.kind}-${v.a}-${v.b} ${v.amount_mm.toFixed(3)} mm`),
    );
  },
  { layout: heapLayout(120) },
);

inEditor(
  'shows a long command on its way, takes what is dropped meanwhile, and keeps the best when it is stopped',
  async (page, server) => {
    const bar = page.locator('[data-work="compact"]');
    const says = (pattern) =>
      page.waitForFunction(
        (p) =>
          document.querySelector('[data-work="compact"]')?.hidden === false &&
          new RegExp(p).test(document.querySelector('[data-work="compact"] .says').textContent),
        pattern,
        { polling: 20 },
      );
    assert.equal(await bar.isVisible(), false);
    const before = JSON.parse(await export_(server));
    await command(page, 'compact');
    await says('\\d+ % · \\d+ (s|min) left · \\d+ parts better placed');
    const share = Number(await page.locator('[data-work="compact"] progress').getAttribute('value'));
    assert.ok(share > 0 && share < 1, String(share));
    // Dashed outlines lie over the parts, which stand where they were.
    assert.ok(
      await page
        .locator('.picture canvas')
        .nth(1)
        .evaluate((c) =>
          c
            .getContext('2d')
            .getImageData(0, 0, c.width, c.height)
            .data.some((v) => v > 0),
        ),
    );
    const [x, y, box] = await at(page, 1);
    const k = box.width / 13;
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 500 * k, y - 500 * k);
    await page.mouse.move(x + 1000 * k, y - 1000 * k);
    await page.mouse.up();
    await says('1 step waits');
    assert.equal(await picture(page).getAttribute('data-moving'), 'false');
    assert.deepEqual(JSON.parse(await export_(server)).placements, before.placements);
    await keys(page, 'Escape');
    assert.equal(await bar.isVisible(), false);
    const after = JSON.parse(await export_(server)).placements;
    assert.ok(Math.hypot(after[0].x - 1005, after[0].y - before.placements[0].y - 1000) < 2, JSON.stringify(after[0])); // where it was dropped
    assert.ok(after[1].x < before.placements[1].x - 10, JSON.stringify(after[1])); // compacted
    assert.equal((await checked(server)).exit, 0);

    await keys(page, 'Escape');
    assert.match(await live(page), /Nothing selected/);
    await command(page, 'compact');
    await says('%');
    await command(page, 'language');
    assert.equal(await page.textContent('[data-action="compact.stop"]'), 'Зупинити');
    await says('\\d+ % · ще \\d+ (с|хв)');
    await command(page, 'language');
    await command(page, 'compact.stop');
    await settled(page);
    assert.match(await message(page), /best so far is kept/);
    assert.equal(await bar.isVisible(), false);
    assert.equal((await checked(server)).exit, 0);
  },
  { layout: longLayout },
);

inEditor(
  'nests from a button: watched, stopped, undone as one step, corrected, and improved again around two locked parts',
  async (page, server) => {
    const stateOf = async () => JSON.parse(await export_(server)).placements;
    const says = (pattern) =>
      page.waitForFunction(
        (p) =>
          !!document.querySelector('.long:not([hidden])') &&
          new RegExp(p).test(document.querySelector('.long .says').textContent),
        pattern,
        { polling: 20 },
      );
    const before = await stateOf();
    assert.equal(before.length, 2);
    // It is started on the whole layout and watched: the better places appear before it is carried out.
    await command(page, 'nest');
    await says('parts better placed');
    assert.deepEqual(await stateOf(), before);
    await command(page, 'nest.stop');
    await settled(page);
    assert.match(await message(page), /best so far is kept/);
    const nested = await stateOf();
    assert.equal(nested.length, 12);
    assert.equal(await placed(page), 12);
    assert.equal((await checked(server)).exit, 0);
    // The run is one step.
    await command(page, 'undo');
    await settled(page);
    assert.deepEqual(await stateOf(), before);
    await command(page, 'redo');
    await settled(page);
    assert.deepEqual(await stateOf(), nested);
    // A hand corrects it: the uppermost is moved to the far end of the sheet, where nothing is in its way; two are locked.
    const tops = await Promise.all(nested.map(async (p) => [(await at(page, p.id))[2].top, p.id]));
    const moved = tops.sort((a, b) => a[0] - b[0])[0][1];
    const [first, second] = nested.map((p) => p.id).filter((id) => id !== moved);
    await page.mouse.click(...(await at(page, moved)).slice(0, 2));
    await settled(page);
    await keys(page, 'Control+ArrowUp');
    await page.mouse.click(...(await at(page, first)).slice(0, 2));
    await page.keyboard.down('Shift');
    await page.mouse.click(...(await at(page, second)).slice(0, 2));
    await page.keyboard.up('Shift');
    await settled(page);
    await command(page, 'lock');
    await settled(page);
    const corrected = await stateOf();
    assert.deepEqual(
      corrected.filter((p) => p.locked).map((p) => p.id),
      [first, second],
    );
    assert.notDeepEqual(
      corrected.find((p) => p.id === moved),
      nested.find((p) => p.id === moved),
    );
    // It is improved again: the locked ones stay, the others keep their ids.
    await keys(page, 'Escape');
    await command(page, 'nest');
    await says('parts? better placed');
    await command(page, 'nest.stop');
    await settled(page);
    const improved = await stateOf();
    assert.deepEqual(
      improved.map((p) => p.id),
      corrected.map((p) => p.id),
    );
    for (const id of [first, second])
      assert.deepEqual(
        improved.find((p) => p.id === id),
        corrected.find((p) => p.id === id),
      );
    assert.notDeepEqual(improved, corrected);
    assert.equal((await checked(server)).exit, 0);
    // On a selection that is all locked there is nothing to do.
    await page.mouse.click(...(await at(page, first)).slice(0, 2));
    await command(page, 'nest');
    assert.match(await message(page), /locked/);
  },
  { layout: nestLayout },
);

inEditor(
  'asks what an export needs, shows what the server says against it, and saves G-code and DXF',
  async (page, server) => {
    const field = (name) => page.locator(`dialog [data-field="${name}"]`);
    const begin = async (form) => {
      await command(page, 'menu.export');
      await command(page, `export.${form}`);
    };
    const saved = async (notes) => {
      const [download] = await Promise.all([page.waitForEvent('download'), command(page, 'export.save')]);
      // G-code comes with the notes of its proof; the dialog stays until they are read.
      if (notes) {
        await page.waitForFunction(
          (p) => new RegExp(p).test(document.querySelector('dialog .notes').textContent),
          notes,
          { polling: 20 },
        );
        await command(page, 'export.cancel');
      }
      await page.waitForSelector('dialog', { state: 'detached' });
      const file = join(server.folder, download.suggestedFilename());
      await download.saveAs(file);
      return [file, readFileSync(file, 'utf8')];
    };
    const refused = async (pattern) => {
      await command(page, 'export.save');
      await page.waitForFunction(
        (p) => new RegExp(p).test(document.querySelector('dialog .trouble').textContent),
        pattern,
        { polling: 20 },
      );
    };
    const numbers = (text, letter) =>
      [...text.replace(/\([^)]*\)/g, '').matchAll(new RegExp(`${letter}(-?[\\d.]+)`, 'g'))].map((m) => Number(m[1]));

    await begin('gcode');
    await refused('^kerf is missing');
    await field('kerf').fill('0,2');
    await field('feed').fill('fast');
    await refused('^feed fast: has to be a number');
    await field('feed').fill('2000');
    await field('lead-in').fill('2');
    await field('post').selectOption('grbl');
    await refused('^speed is missing: the power of the beam');
    await field('post').selectOption('linuxcnc');
    assert.equal(await field('depth').isVisible(), false);
    await field('process').selectOption('router');
    assert.equal(await field('depth').isVisible(), true);
    assert.equal(await field('pierce').isVisible(), false);
    await field('process').selectOption('laser');
    await field('sheet').selectOption('board#2');
    let [file, text] = await saved('^Saved.*1 cuts.*the kerf enters no part by more than');
    assert.match(file, /\.nc$/);
    assert.match(text, /G21/);
    assert.match(text, /F2000/);
    // The program holds the plate of the second sheet alone, 80 x 50 about 200, 150: half a kerf outside, and a lead of
    // at most 2 further out.
    const [right, upper] = [Math.max(...numbers(text, 'X')), Math.max(...numbers(text, 'Y'))];
    assert.ok(right >= 240.1 - 1e-3 && right <= 242.2 && upper >= 175.1 - 1e-3 && upper <= 177.2, `${right} ${upper}`);
    await begin('gcode');
    assert.equal(await field('kerf').inputValue(), '0.2'); // as the last time
    await page.keyboard.press('Escape');
    await page.waitForSelector('dialog', { state: 'detached' });

    const extent = async (unit) => {
      await begin('dxf');
      await field('unit').selectOption(unit);
      [file, text] = await saved();
      assert.match(file, /\.dxf$/);
      assert.match(text, unit === 'inch' ? /\$INSUNITS\s+70\s+1\s/ : /\$INSUNITS\s+70\s+4\s/);
      const lines = text.split(/\r?\n/);
      return Math.max(...lines.filter((_, i) => i % 2 === 1 && lines[i - 1].trim() === '10').map(Number));
    };
    const [mm, inch] = [await extent('mm'), await extent('inch')];
    assert.ok(mm > 400 && Math.abs(mm / 25.4 - inch) < 1e-3, `${mm} ${inch}`);
    const read = run('check', file, '--layers', 'CUT', '--json');
    assert.equal(read.status, 0, read.stderr);
  },
  {
    layout: {
      ...smallLayout,
      placements: [
        ...smallLayout.placements,
        { id: 4, part: 'plate', stock: 'board', copy: 1, c: 1, s: 0, x: 200, y: 150 },
      ],
    },
    expected: ['400'],
  },
);

inEditor('speaks Ukrainian, and remembers it', async (page) => {
  await command(page, 'language');
  assert.equal(await page.getAttribute('html', 'lang'), 'uk');
  assert.match(await page.textContent('.left'), /Розмістити/);
  await page.reload();
  await ready(page);
  await settled(page);
  assert.equal(await page.getAttribute('html', 'lang'), 'uk');
  assert.match(await page.textContent('.body'), /правил/i);
});

inEditor(
  'shows what a server says of a file that is none',
  async (page, server) => {
    const file = join(server.folder, 'broken.json');
    writeFileSync(file, '{"format": "lekalo-layout/1", "units": "mm", "parts": [{}]}');
    await page.setInputFiles('input[type=file]', file);
    await page.waitForFunction(() => document.querySelector('.status .message').textContent.length > 10);
    assert.match(await message(page), /parts/);
  },
  { expected: ['400'] },
);
