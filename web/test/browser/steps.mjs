// The steps of the tests in the editor, as a person does them, and the looks at the result.

import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { newTab, open, run, serve, startBrowser } from './harness.mjs';
import { smallLayout } from './small_layout.mjs';

const wide = { timeout: 60_000 };
let browser;
/** The page of all tests that need no other. Every server is an origin of its own, so nothing is left from the last. */
let usual;
before(async () => {
  browser = await startBrowser();
  usual = await newTab(browser);
}, wide);
after(async () => browser?.close());

/** A test with a server of its own and a page that must not complain. */
export function inEditor(name, work, { layout = smallLayout, options = null, expected = [], whole = true } = {}) {
  test(name, wide, async (t) => {
    const server = await serve(layout);
    const page = options ? await newTab(browser, options) : usual;
    t.after(async () => {
      await (options ? page.context().close() : page.goto('about:blank')); // before its server goes
      await server.stop();
    });
    page.problems.length = 0;
    await open(page, server.page);
    if (whole) await settled(page);
    await work(page, server, t);
    assert.deepEqual(
      page.problems.filter((p) => !expected.some((e) => p.includes(e))),
      [],
    );
  });
}

export const picture = (page) => page.locator('.picture');
export const settled = async (page) => {
  await page.waitForFunction(
    () =>
      document.querySelector('.status').dataset.pending === '0' &&
      document.querySelector('.picture').dataset.moving === 'false' &&
      document.querySelector('.picture').dataset.mirror === 'true' &&
      document.querySelector('.picture').dataset.sharp !== 'false' &&
      document.querySelector('.status').dataset.unchecked === '0',
    null,
    { polling: 20 },
  );
};
export const message = (page) => page.textContent('.status .message');
export const live = (page) => page.textContent('.status .live');
export const placed = (page) => page.locator('.mirror li').count();
export const broken = (page) => page.locator('[data-id^="violation-"]').count();
/** A point of a part by fractions of its box. The middle of the bracket is beside it. */
export async function at(page, id, fx = id === 3 ? 0.15 : 0.5, fy = 0.5) {
  const box = await page.locator(`[data-id="placement-${id}"]`).evaluate((e) => e.getBoundingClientRect().toJSON());
  return [box.x + box.width * fx, box.y + box.height * fy, box];
}
/** Screen pixels a millimetre. */
export const scaleOf = async (page) => (await at(page, 1))[2].width / 80;
export const export_ = async (server, form = 'layout') => {
  const answer = await fetch(new URL(`/api/layouts/1/export?form=${form}`, server.url));
  assert.equal(answer.status, 200);
  return answer.text();
};
export const placementOf = async (server, id) => JSON.parse(await export_(server)).placements.find((p) => p.id === id);
/** The answer of `lekalo check` about the layout as it stands. */
export async function checked(server) {
  const file = join(server.folder, 'exported.json');
  writeFileSync(file, await export_(server));
  const done = run('check', file, '--json');
  return { ...JSON.parse(done.stdout), exit: done.status };
}
export async function press(page, id) {
  const [x, y] = await at(page, id);
  await page.mouse.click(x, y);
}
/** Drags a part by millimetres and stops before letting it go. */
export async function hold(page, id, dx, dy) {
  const [x, y] = await at(page, id);
  const k = await scaleOf(page);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + (dx * k) / 2, y - (dy * k) / 2);
  await page.mouse.move(x + dx * k, y - dy * k);
}
export async function drop(page) {
  await page.mouse.up();
  await settled(page);
}
export const command = (page, name) => page.click(`[data-action="${name}"]`);
export async function keys(page, ...names) {
  for (const name of names) {
    await page.keyboard.press(name);
    await settled(page);
  }
}
