// A picture of the editor at work: node bench/picture.mjs LAYOUT OUT.png
// A part is in hand over another, so that the picture shows the overlap, its depth and its place.

import { newTab, open, serve, startBrowser } from '../test/browser/harness.mjs';

const [layout, out] = process.argv.slice(2);
if (!out) {
  console.error('picture.mjs: it takes a layout and the PNG to write');
  process.exit(2);
}
const server = await serve(layout);
const browser = await startBrowser();
try {
  const page = await newTab(browser);
  await open(page, server.page);
  await page.waitForFunction(() => document.querySelectorAll('.mirror li').length > 1);
  await page.click('[data-action="side.kits"]');
  const box = (id) => page.locator(`[data-id="placement-${id}"]`).evaluate((e) => e.getBoundingClientRect().toJSON());
  const ids = await page
    .locator('.mirror li')
    .evaluateAll((items) => items.map((e) => Number(e.dataset.id.split('-')[1])));
  const [held, under] = [await box(ids.at(-1)), await box(ids[0])];
  const [x, y] = [held.x + held.width / 2, held.y + held.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(under.x + under.width * 0.9, under.y + under.height * 0.35, { steps: 4 });
  await page.waitForFunction(() => /\d mm/.test(document.querySelector('.status .live').textContent));
  await page.screenshot({ path: out });
} finally {
  await browser.close();
  await server.stop();
}
