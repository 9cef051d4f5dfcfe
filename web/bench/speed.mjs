// Times the page on large layouts, against the real server: node bench/speed.mjs [PARTS...]
// LEKALO names the program (build/release/lekalo).

import { newTab, open, serve, startBrowser } from '../test/browser/harness.mjs';

/** Parts of 48 corners side by side on one sheet. */
function crowd(n) {
  const side = Math.ceil(Math.sqrt(n));
  const outer = Array.from({ length: 48 }, (_, i) => {
    const a = (2 * Math.PI * i) / 48;
    const r = 40 + 8 * Math.sin(3 * a);
    return [r * Math.cos(a), r * Math.sin(a)];
  });
  const size = side * 100;
  return {
    format: 'lekalo-layout/1',
    units: 'mm',
    name: `${n} parts`,
    rules: { gap: 2 },
    stocks: [
      {
        id: 's',
        kind: 'sheet',
        outline: {
          polygon: {
            outer: [
              [0, 0],
              [size, 0],
              [size, size],
              [0, size],
            ],
          },
        },
      },
    ],
    parts: Array.from({ length: 20 }, (_, i) => ({ id: `p${i}`, outline: { polygon: { outer } } })),
    placements: Array.from({ length: n }, (_, i) => ({
      id: i + 1,
      part: `p${i % 20}`,
      stock: 's',
      c: 1,
      s: 0,
      x: 50 + 100 * (i % side),
      y: 50 + 100 * Math.floor(i / side),
    })),
  };
}

const ms = ({ median, p99, worst }) =>
  `${median.toFixed(2).padStart(8)} ${p99.toFixed(2).padStart(8)} ${worst.toFixed(2).padStart(8)}`;
const sizes = process.argv.slice(2).map(Number);
const browser = await startBrowser();
for (const n of sizes.length > 0 ? sizes : [1000, 10000]) {
  const server = await serve(crowd(n));
  const page = await newTab(browser);
  await open(page, server.page);
  await page.waitForFunction(() => performance.getEntriesByName('first view').length > 0);
  const first = await page.evaluate(() => performance.getEntriesByName('first view')[0].startTime);
  await page.waitForTimeout(500);
  const cdp = await page.context().newCDPSession(page);
  await cdp.send('Performance.enable', { timeDomain: 'threadTicks' });
  /** Processor time of the page's thread, ms: what others do on the machine is not in it. */
  const processor = async () =>
    (await cdp.send('Performance.getMetrics')).metrics.find((m) => m.name === 'TaskDuration').value * 1000;
  console.log(
    `${n} parts in view; first view ${first.toFixed(0)} ms after the page began to load\n${''.padEnd(44)}processor   median     99 %    worst, ms`,
  );
  for (const [name, what, times] of await page.evaluate(() => window.lekaloBench.rows)) {
    const before = await processor();
    const said = await page.evaluate(([f, k]) => window.lekaloBench[f](k), [name, times]);
    const spent = ((await processor()) - before) / times;
    console.log(`  ${what.padEnd(42)}${spent.toFixed(2).padStart(9)} ${ms(said)}`);
  }
  await page.context().close();
  await server.stop();
}
await browser.close();
