// Combs in a heap: every one lies over its neighbours, and measuring how deep takes long.

const teeth = 40;
const top = Array.from({ length: teeth }, (_, i) => [
  [2 * i + 0.5, 4],
  [2 * i + 1, 20 + (i % 5)],
])
  .flat()
  .reverse();
const comb = { polygon: { outer: [[0, 0], [2 * teeth, 0], ...top] } };

/** @returns a layout of n of them, 40 a row */
export function heapLayout(n) {
  const rows = Math.ceil(n / 40);
  return {
    format: 'lekalo-layout/1',
    units: 'mm',
    name: 'Heap',
    rules: { gap: 1 },
    stocks: [
      {
        id: 'board',
        kind: 'sheet',
        outline: {
          polygon: {
            outer: [
              [0, 0],
              [1320, 0],
              [1320, 10 * rows + 60],
              [0, 10 * rows + 60],
            ],
          },
        },
      },
    ],
    parts: [{ id: 'comb', name: 'Comb', outline: comb, demand: n }],
    placements: Array.from({ length: n }, (_, i) => ({
      id: i + 1,
      part: 'comb',
      stock: 'board',
      c: 1,
      s: 0,
      x: 10 + 30 * (i % 40),
      y: 10 + 10 * Math.floor(i / 40),
    })),
  };
}
