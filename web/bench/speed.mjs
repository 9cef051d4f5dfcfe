// How quick the page is on large layouts, against the real server: node bench/speed.mjs [PARTS...]
// LEKALO names the program (build/release/lekalo).

import { newTab, open, serve, startBrowser } from '../test/browser/harness.mjs';

/// Parts of 48 corners side by side on one sheet.
function crowd(n) {
  const side = Math.ceil(Math.sqrt(n));
  const outer = Array.from({ length: 48 }, (_, i) => {
    const a = (2 * Math.PI * i) / 48;
    const r = 40 + 8 * Math.sin(3 * a);
    return [r * Math.cos(a), r * Math.sin(a)];
  });
  const size = side * 100;
  return {
    format: 'lekalo-layout/1', units: 'mm', name: `${n} parts`, rules: { gap: 2 },
    stocks: [{ id: 's', kind: 'sheet', outline: { polygon: { outer: [[0, 0], [size, 0], [size, size], [0, size]] } } }],
    parts: Array.from({ length: 20 }, (_, i) => ({ id: `p${i}`, outline: { polygon: { outer } } })),
    placements: Array.from({ length: n }, (_, i) => ({ id: i + 1, part: `p${i % 20}`, stock: 's', c: 1, s: 0, x: 50 + 100 * (i % side), y: 50 + 100 * Math.floor(i / side) })),
  };
}

const ms = ({ median, p99, worst }) => `median ${median.toFixed(2)}, 99 % ${p99.toFixed(2)}, worst ${worst.toFixed(2)} ms`;
const sizes = process.argv.slice(2).map(Number);
const browser = await startBrowser();
for (const n of sizes.length > 0 ? sizes : [1000, 10000]) {
  const server = await serve(crowd(n));
  const page = await newTab(browser);
  await open(page, server.page);
  await page.waitForFunction(() => performance.getEntriesByName('first view').length > 0);
  const first = await page.evaluate(() => performance.getEntriesByName('first view')[0].startTime);
  await page.waitForTimeout(500);
  const said = await page.evaluate(() => {
    const bench = window.lekaloBench;
    return { pan: bench.pan(200), zoom: bench.zoom(100), sharpen: bench.sharpen(200), full: bench.frames(50), choose: bench.choose(100), drag: bench.drag(1000), check: bench.check(10) };
  });
  console.log(`${n} parts in view
  first view, from the start of the page's loading: ${first.toFixed(0)} ms
  check while dragging: ${ms(said.drag.check)}
  frame while dragging: ${ms(said.drag.frame)}
  frame while panning:  ${ms(said.pan)}
  frame while zooming:  ${ms(said.zoom)}
  slice of the sharp picture after zooming: ${ms(said.sharpen)}
  frame after choosing: ${ms(said.choose)}
  all painted anew:     ${ms(said.full)}
  whole layout checked: ${ms(said.check)}`);
  await page.context().close();
  await server.stop();
}
await browser.close();
