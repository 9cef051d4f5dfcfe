// Frame work on large layouts: node test/frames.mjs

import { ServerDouble } from './double.mjs';
import { openPage } from './browser.mjs';

for (const n of [1000, 10000]) {
  const side = Math.ceil(Math.sqrt(n));
  const outer = Array.from({ length: 48 }, (_, i) => {
    const a = (2 * Math.PI * i) / 48;
    const r = 40 + 8 * Math.sin(3 * a);
    return [r * Math.cos(a), r * Math.sin(a)];
  });
  const size = side * 100;
  const document = {
    format: 'lekalo-layout/1', units: 'mm', name: `${n} parts`, rules: { gap: 2 },
    stocks: [{ id: 's', kind: 'sheet', outline: { polygon: { outer: [[0, 0], [size, 0], [size, size], [0, size]] } } }],
    parts: Array.from({ length: 20 }, (_, i) => ({ id: `p${i}`, outline: { polygon: { outer } } })),
    placements: Array.from({ length: n }, (_, i) => ({ id: i + 1, part: `p${i % 20}`, stock: 's', c: 1, s: 0, x: 50 + 100 * (i % side), y: 50 + 100 * Math.floor(i / side) })),
  };
  const begin = Date.now();
  const { browser, page } = await openPage(new ServerDouble(document));
  const first = Date.now() - begin;
  const frames = await page.evaluate(() => window.lekaloBench.frames(30));
  const drag = await page.evaluate(() => window.lekaloBench.drag(500));
  const check = await page.evaluate(() => window.lekaloBench.check(5));
  const ms = ({ median, p99, worst }) => `median ${median.toFixed(2)}, 99 % ${p99.toFixed(2)}, worst ${worst.toFixed(2)} ms`;
  console.log(`${n} parts: first view ${first} ms, start of the browser included\n  full frame: ${ms(frames)}\n  whole check: ${ms(check)}\n  drag, check: ${ms(drag.check)}\n  drag, frame: ${ms(drag.frame)}`);
  await browser.close();
}
