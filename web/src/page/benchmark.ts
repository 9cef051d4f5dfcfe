// The figures of how quick the page is on the layout that it shows. Opened with `benchmark` in its address, it prints the figures;
// bench/speed.mjs does so for layouts of its own, with processor times.

import type { Picture } from '../picture/draw';
import type { Scene } from '../picture/scene';
import { movedBy, type Editor } from '../editor/editor';
import type { Photo } from '../editor/photo';
import { h } from '../html/elements';
import type { View } from '../picture/view';

export interface Timed {
  median: number;
  p99: number;
  worst: number;
}
/** The parts of the page that the benchmark works on. */
export interface Bench {
  editor: Editor;
  view: View;
  drawing: Picture;
  picture: HTMLElement;
  base: HTMLCanvasElement;
  top: HTMLCanvasElement;
  scene: () => Scene;
  sliceMs: number;
}

/** Times `work` n times, each by itself, ms. */
function timed(n: number, work: (i: number) => void): Timed {
  const times = Array.from({ length: n }, (_, i) => {
    const begin = performance.now();
    work(i);
    return performance.now() - begin;
  }).sort((a, b) => a - b);
  return { median: times[n >> 1]!, p99: times[Math.min(n - 1, Math.floor(n * 0.99))]!, worst: times[n - 1]! };
}

/** Reading a pixel waits until it is painted. */
const painted = (canvas: HTMLCanvasElement): void => void canvas.getContext('2d')!.getImageData(0, 0, 1, 1);

export function paintAll({ drawing, view, picture, scene }: Bench): void {
  drawing.resize(view, picture.clientWidth, picture.clientHeight);
  drawing.backdrop.draw(scene());
}

/** The timed work by name; each takes how often it is done. One part at least lies on the layout. */
export function benchmark(bench: Bench) {
  const { editor, view, drawing, picture, base, top, scene, sliceMs } = bench;
  return {
    /** The frames after the layout was opened, the picture resized or the theme changed. */
    frames: (n: number) => {
      let whole = true;
      return timed(n, () => {
        if (whole) {
          drawing.resize(view, picture.clientWidth, picture.clientHeight);
          whole = drawing.backdrop.draw(scene(), sliceMs);
        } else whole = drawing.backdrop.sharpen(scene(), sliceMs);
        painted(base);
      });
    },
    /** The whole picture at once. */
    whole: (n: number) =>
      timed(n, () => {
        paintAll(bench);
        painted(base);
      }),
    /** The slices in which the picture turns sharp after zooming. */
    sharpen: (n: number) => {
      let whole = true;
      return timed(n, (i) => {
        if (whole) {
          view.zoomAt(400, 300, i % 2 === 0 ? 1.1 : 1 / 1.1);
          whole = drawing.backdrop.follow(scene());
        } else whole = drawing.backdrop.sharpen(scene(), sliceMs);
        painted(base);
      });
    },
    /** The frame after a part is chosen or let go. */
    choose: (n: number) =>
      timed(n, (i) => {
        editor.selection = new Set([[...editor.model.placements.keys()][(i * 7) % editor.model.placements.size]!]);
        drawing.backdrop.draw(scene());
        painted(base);
      }),
    /** The frames while the view moves a few pixels. */
    pan: (n: number) =>
      timed(n, (i) => {
        view.pan(i % 40 < 20 ? 7 : -7, i % 40 < 20 ? 4 : -4);
        drawing.backdrop.follow(scene());
        painted(base);
      }),
    zoom: (n: number) =>
      timed(n, (i) => {
        view.zoomAt(400, 300, i % 20 < 10 ? 1.1 : 1 / 1.1);
        drawing.backdrop.follow(scene());
        painted(base);
      }),
    /** The check of the whole layout, after each change. */
    check: (n: number) => timed(n, () => void editor.kernel.check()),
    /** The check of one part in hand at n places across the sheet. */
    dragCheck: (n: number) => {
      const p = editor.placementsOf([...editor.model.placements.keys()].slice(0, 1));
      const made = timed(n, (i) => editor.hold(movedBy(p, (i * 37) % 900, (i * 53) % 700), ''));
      editor.release();
      return made;
    },
    dragFrame: (n: number) => {
      const p = editor.placementsOf([...editor.model.placements.keys()].slice(0, 1));
      const made = timed(n, (i) => {
        editor.moving = new Map(movedBy(p, i, i).map((q) => [q.id, q]));
        drawing.drawTop(scene());
        painted(top);
      });
      editor.release();
      return made;
    },
    /** A loop that never changes: its spread is what the machine itself does to such figures. */
    loop: (n: number) =>
      timed(n, () => {
        let sum = 0;
        for (let i = 0; i < 1e6; ++i) sum += i ^ (i >> 3);
        if (sum === 1) throw new Error('never');
      }),
  };
}

type Work = ReturnType<typeof benchmark>;
/** Every work with its name for people, and how often it is timed. */
export const ROWS: readonly (readonly [keyof Work, string, number])[] = [
  ['loop', 'a loop that never changes, for comparison', 1000],
  ['dragCheck', 'check while dragging', 1000],
  ['dragFrame', 'frame while dragging', 500],
  ['pan', 'frame while panning', 300],
  ['zoom', 'frame while zooming', 200],
  ['sharpen', 'frame while it turns sharp after zooming', 300],
  ['choose', 'frame after a part is chosen', 200],
  ['frames', 'frame while all is painted anew', 300],
  ['whole', 'all painted anew at once, as for printing', 50],
  ['check', 'whole layout checked', 20],
];

/** Runs all rows, with a pause for the browser between two, and shows them as a table as it goes. */
export async function printFigures(bench: Bench): Promise<void> {
  const work = benchmark(bench);
  const firstView = performance.getEntriesByName('first view')[0]?.startTime ?? NaN;
  const rows = h('tbody');
  const head = h('tr', {}, ...['ms', 'median', '99 %', 'worst'].map((text) => h('th', {}, text)));
  const dialog: HTMLDialogElement = h(
    'dialog',
    { class: 'benchmark', 'data-id': 'benchmark' },
    h('button', { 'aria-label': 'Close', click: () => dialog.remove() }, '×'),
    h(
      'p',
      {},
      `${bench.editor.model.placements.size} parts; first view ${firstView.toFixed(0)} ms after the page began to load`,
    ),
    h('table', {}, h('thead', {}, head), rows),
  );
  document.body.append(dialog);
  dialog.show();
  if (bench.editor.model.placements.size === 0) {
    dialog.append(h('p', {}, 'Nothing lies on this layout: place a part, and load the page again.'));
    return;
  }
  for (const [name, what, times] of ROWS) {
    await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
    const { median, p99, worst } = work[name](times);
    rows.append(
      h(
        'tr',
        { 'data-id': `benchmark-${name}` },
        h('td', {}, what),
        ...[median, p99, worst].map((ms) => h('td', {}, ms.toFixed(2))),
      ),
    );
  }
  bench.view.fit(bench.editor.model.extent(), 28, true);
  paintAll(bench);
  dialog.dataset.done = 'true';
}

/** Gives bench/speed.mjs and the tests a hold on the page: `window.lekaloBench`. */
export function offerBenchmark(bench: Bench): void {
  const placed = ({ stock, a, b, x, y, image: { width, height } }: Photo) => ({ stock, a, b, x, y, width, height });
  Object.assign(window, {
    lekaloBench: {
      ...benchmark(bench),
      rows: ROWS,
      paintAll: () => paintAll(bench),
      photos: () => [...bench.editor.photos].map(placed),
    },
  });
}
