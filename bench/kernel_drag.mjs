// How long the page's kernel takes to answer while a part is dragged: lekalo.wasm in Node, on crowded sheets.
//
//   node bench/kernel_drag.mjs build/release/lekalo.wasm [parts...]     default: 1000 10000
import { readFileSync } from 'node:fs';
import { loadKernel } from '../tests/parity/wasm_kernel.mjs';

const [wasmPath, ...sizes] = process.argv.slice(2);
const kernel = await loadKernel(readFileSync(wasmPath));

// A generator of our own, so that every run asks the same.
let seed = 1;
const random = () => {
  seed = (Math.imul(seed, 1103515245) + 12345) >>> 0;
  return (seed >>> 8) / 2 ** 24;
};
const bytes = (text) => Buffer.from(text);
const doubles = (...values) => Buffer.from(new Float64Array(values).buffer);

/** Concave outlines of 24 points, the sheet nearly full: pitch 30 mm, parts 18 to 28 mm across, gap 1 mm. */
function crowded(count, kind) {
  const side = Math.ceil(Math.sqrt(count)),
    pitch = 30,
    size = side * pitch + 10;
  const star = (points, low, high, x = 0, y = 0) =>
    Array.from({ length: points }, (_, i) => {
      const angle = (2 * Math.PI * i) / points,
        radius = low + (high - low) * random();
      return [x + radius * Math.cos(angle), y + radius * Math.sin(angle)].map((v) => Number(v.toFixed(3)));
    });
  const parts = Array.from({ length: 20 }, (_, i) => ({
    id: `p${i}`,
    demand: count,
    outline: { polygon: { outer: star(24, 9, 14) } },
  }));
  const stock = {
    id: 's',
    kind,
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
  };
  if (kind === 'hide') {
    stock.outline.polygon.outer = star(400, 0.75 * size, 0.78 * size, size / 2, size / 2);
    stock.defects = Array.from({ length: 50 }, (_, i) => ({
      id: `d${i}`,
      severity: 1,
      outline: { polygon: { outer: star(12, 2, 6, random() * size, random() * size) } },
    }));
  }
  const placements = Array.from({ length: count }, (_, i) => ({
    id: i + 1,
    part: `p${i % 20}`,
    stock: 's',
    rotation_deg: 90 * Math.floor(4 * random()),
    x: 20 + pitch * (i % side),
    y: 20 + pitch * Math.floor(i / side),
  }));
  return JSON.stringify({
    format: 'lekalo-layout/1',
    units: 'mm',
    rules: { gap: 1, border_gap: 2, defect_gap: 1 },
    stocks: [stock],
    parts,
    placements,
  });
}

const milliseconds = (run) => {
  const start = process.hrtime.bigint();
  const value = run();
  return [Number(process.hrtime.bigint() - start) / 1e6, value];
};
const quantile = (sorted, q) => sorted[Math.min(sorted.length - 1, Math.floor(q * sorted.length))];
const shown = (v) => v.toFixed(3).padStart(8);

console.log(
  '| stock | parts | depths | open ms | calls | clear | gap | forbidden | median ms | 99 % | 99.9 % | largest |',
);
console.log('|---|---|---|---|---|---|---|---|---|---|---|---|');
for (const kind of ['sheet', 'hide'])
  for (const count of (sizes.length > 0 ? sizes : [1000, 10000]).map(Number)) {
    const document = bytes(crowded(count, kind));
    for (const depths of [0, 1]) {
      const [openTime, opened] = milliseconds(() => kernel.call('lekalo_open', [document.length], document));
      if (opened.result < 0) throw new Error(opened.text.toString());
      const handle = opened.result;
      kernel.call('lekalo_in_box', [handle, 0, 0, 0, 0, 1, 1], bytes('')); // the page draws before it drags
      const times = [],
        levels = [0, 0, 0];
      for (let drag = 0; drag < 200; ++drag) {
        // As a hand goes: about 2 mm from one event to the next, over neighbours and between them.
        const id = doubles(1 + Math.floor(random() * count)),
          heading = 2 * Math.PI * random();
        for (let step = 0; step < 50; ++step) {
          const dx = 2 * step * Math.cos(heading) + random(),
            dy = 2 * step * Math.sin(heading) + random();
          const [time, state] = milliseconds(() => kernel.call('lekalo_state', [handle, 1, dx, dy, 0, 50, depths], id));
          if (state.result < 0) throw new Error(state.text.toString());
          times.push(time);
          ++levels[state.result];
        }
      }
      kernel.call('lekalo_close', [handle], bytes(''));
      times.sort((a, b) => a - b);
      console.log(
        `| ${kind} | ${count} | ${depths === 0 ? 'left out' : 'measured'} | ${openTime.toFixed(0)} | ${times.length} | ${levels.join(' | ')} |${shown(quantile(times, 0.5))} |` +
          `${shown(quantile(times, 0.99))} |${shown(quantile(times, 0.999))} |${shown(times.at(-1))} |`,
      );
    }
  }
