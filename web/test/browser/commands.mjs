// Every command by mouse and by key: its effect stands in the export, and the program finds nothing against it.

import assert from 'node:assert/strict';
import {
  at,
  checked,
  command,
  drop,
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

const STEP = 2 ** -20;
const near = (a, b, by = 2 * STEP) => assert.ok(Math.abs(a - b) <= by, `${a} instead of ${b}`);
const degrees = ({ c, s }) => (Math.atan2(s, c) * 180) / Math.PI;

inEditor('turns by the step of the toolbar, by buttons and keys', async (page, server) => {
  await press(page, 3);
  await keys(page, 'Shift+ArrowRight', 'Shift+ArrowRight', 'Shift+ArrowRight');
  await command(page, 'rotate.left');
  await settled(page);
  near(degrees(await placementOf(server, 3)), 15, 1e-9);
  await page.fill('[data-action="step"]', '40');
  await page.keyboard.press('Enter');
  await page.click('.picture', { position: { x: 5, y: 5 } });
  await press(page, 3);
  await keys(page, ']');
  near(degrees(await placementOf(server, 3)), -25, 1e-9);
  await keys(page, '[');
  near(degrees(await placementOf(server, 3)), 15, 1e-9);
  // A plate lies at right angles alone, and the sentence says so.
  await press(page, 2);
  await keys(page, 'Shift+ArrowUp', '[');
  assert.match(await message(page), /not admitted: placement 2: rotation/);
  assert.equal((await checked(server)).exit, 0);
});

inEditor('flips, settles, snaps and locks by buttons and keys', async (page, server) => {
  await press(page, 2);
  await command(page, 'flip');
  await settled(page);
  assert.equal((await placementOf(server, 2)).mirrored, true);
  await keys(page, 'g');
  let p = await placementOf(server, 2);
  // It goes down to the border's gap of 5, then left to the gap of 2 to the other plate, 90 wide from the left.
  near(p.y, 30);
  near(p.x, 132);
  await keys(page, 'Control+z', 'ArrowUp', 'ArrowUp', 'ArrowUp');
  await command(page, 'settle');
  await settled(page);
  near((await placementOf(server, 2)).y, 30);
  await keys(page, 'Control+z');
  // It lies 5 mm from where the left border's gap lets it, and snaps to that.
  await press(page, 1);
  await keys(page, 's');
  near((await placementOf(server, 1)).x, 45);
  await command(page, 'lock');
  await settled(page);
  assert.equal((await placementOf(server, 1)).locked, true);
  await keys(page, 'ArrowRight');
  assert.match(await message(page), /locked/);
  await command(page, 'lock');
  await settled(page);
  p = await placementOf(server, 1);
  assert.equal(p.locked ?? false, false);
  assert.equal((await checked(server)).exit, 0);
});

inEditor('swaps two, copies, takes away; by buttons and keys', async (page, server) => {
  await press(page, 1);
  await keys(page, 'ArrowUp', 'ArrowUp');
  await page.keyboard.down('Shift');
  await press(page, 2);
  await page.keyboard.up('Shift');
  await command(page, 'swap');
  await settled(page);
  assert.deepEqual([(await placementOf(server, 1)).x, (await placementOf(server, 2)).x], [200, 50]);
  await keys(page, 'x');
  assert.deepEqual([(await placementOf(server, 1)).x, (await placementOf(server, 2)).x], [50, 200]);
  await command(page, 'copy');
  await settled(page);
  assert.equal(await placed(page), 5);
  await command(page, 'remove');
  await settled(page);
  await command(page, 'undo');
  await settled(page);
  assert.equal((await checked(server)).exit, 0);
});

inEditor('pushes neighbours along', async (page, server) => {
  await command(page, 'tool.push');
  await hold(page, 1, 80, 0);
  await drop(page);
  const { x } = await placementOf(server, 1);
  near(x, 130, 1e-4); // where the hand let it go: pixels are rounded
  near((await placementOf(server, 2)).x, x + 82);
  assert.equal((await checked(server)).exit, 0);
});

inEditor('drops at the nearest valid place', async (page, server) => {
  await keys(page, '4');
  await hold(page, 2, -140, 3);
  await drop(page);
  const p = await placementOf(server, 2);
  assert.notEqual(p.x, 200);
  // The place is nearer than the one that sliding there would give, and clear.
  assert.ok(Math.hypot(p.x - 60, p.y - 43) < 90, JSON.stringify(p));
  assert.equal((await checked(server)).exit, 0);
});

inEditor('slides in all four directions by buttons', async (page, server) => {
  await press(page, 2);
  // The four pushes end at the border, the border, the bracket and the knot, each with its gap.
  for (const [action, x, y] of [
    ['up', 200, 270],
    ['left', 45, 270],
    ['down', 45, 227],
    ['right', 259, 227],
  ]) {
    await command(page, `slide.${action}`);
    await settled(page);
    const p = await placementOf(server, 2);
    near(p.x, x);
    near(p.y, y);
    assert.equal((await checked(server)).exit, 0);
  }
});

inEditor('moves a part to another sheet, and several at once', async (page, server) => {
  const k = await scaleOf(page);
  const sheets = 400 * 1.04 + 20; // from one sheet to the next
  await hold(page, 2, sheets, 60);
  await drop(page);
  let p = await placementOf(server, 2);
  assert.equal(p.copy, 1);
  near(p.x, 200, 1 / k);
  near(p.y, 100, 1 / k);
  await keys(page, 'Control+a');
  assert.match(await page.textContent('.status .live'), /3 parts selected/);
  await keys(page, 'Escape');
  await press(page, 1);
  await page.keyboard.down('Shift');
  await press(page, 3);
  await page.keyboard.up('Shift');
  const before = [await placementOf(server, 1), await placementOf(server, 3)];
  await hold(page, 1, sheets + 5, -2);
  await drop(page);
  const after = [await placementOf(server, 1), await placementOf(server, 3)];
  assert.deepEqual(
    after.map((q) => q.copy),
    [1, 1],
    await message(page),
  );
  near(after[0].x - before[0].x, after[1].x - before[1].x);
  near(after[0].y - before[0].y, after[1].y - before[1].y);
  assert.equal((await checked(server)).exit, 0);
  await command(page, 'undo');
  await settled(page);
  p = await placementOf(server, 3);
  assert.equal(p.copy ?? 0, 0);
});

inEditor('compacts a sheet, one undo takes it back', async (page, server) => {
  await press(page, 2);
  await keys(page, 'c');
  near((await placementOf(server, 2)).x, 127);
  await keys(page, 'Control+z');
  near((await placementOf(server, 2)).x, 200);
  await keys(page, 'Control+Shift+z');
  near((await placementOf(server, 2)).x, 127);
  assert.equal((await checked(server)).exit, 0);
});

inEditor('undoes without limit, beyond a reload', async (page, server) => {
  await press(page, 3);
  for (let i = 0; i < 30; ++i) await keys(page, i % 2 === 0 ? 'ArrowRight' : 'ArrowUp');
  near((await placementOf(server, 3)).x, 35);
  for (let i = 0; i < 15; ++i) await keys(page, 'Control+z');
  await page.reload();
  await page.waitForSelector('.tray li');
  await settled(page);
  for (let i = 0; i < 15; ++i) await keys(page, 'Control+z');
  const p = await placementOf(server, 3);
  assert.deepEqual([p.x, p.y], [20, 120]);
  await keys(page, 'Control+z');
  assert.match(await message(page), /nothing to undo/);
});

inEditor(
  'picks, drags and flicks by touch',
  async (page, server) => {
    const cdp = await page.context().newCDPSession(page);
    const touch = (type, ...points) =>
      cdp.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    const stroke = async (from, by) => {
      await touch('touchStart', from);
      for (const part of [0.3, 0.7, 1]) await touch('touchMove', [from[0] + by[0] * part, from[1] + by[1] * part]);
      await touch('touchEnd');
      await settled(page);
    };
    await page.touchscreen.tap(...(await at(page, 2)).slice(0, 2));
    await settled(page);
    assert.equal(await page.getAttribute('[data-id="placement-2"]', 'aria-selected'), 'true');
    await page.touchscreen.tap(
      ...(await page
        .locator('[data-action="tool.slide"]')
        .boundingBox()
        .then((b) => [b.x + 10, b.y + 10])),
    );
    await stroke((await at(page, 2)).slice(0, 2), [-40, 1]);
    near((await placementOf(server, 2)).x, 132);
    // The material beside the parts moves the view.
    const [x0] = await at(page, 1);
    await stroke([(await at(page, 2))[2].right + 60, (await at(page, 2))[1]], [30, 0]);
    near((await at(page, 1))[0], x0 + 30, 1.5);
    assert.equal((await checked(server)).exit, 0);
  },
  { options: { hasTouch: true } },
);
