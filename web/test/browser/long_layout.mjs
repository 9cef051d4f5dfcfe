// Two sheets of loose parts: the first is compacted at once, the second takes its time.

const side = (mm) => ({
  polygon: {
    outer: [
      [0, 0],
      [mm, 0],
      [mm, mm],
      [0, mm],
    ],
  },
});
const rows = (copy, n, across) =>
  Array.from({ length: n }, (_, i) => ({
    part: 'chip',
    stock: 'board',
    copy,
    c: 1,
    s: 0,
    x: 5 + 33 * (i % across),
    y: 5 + 33 * Math.floor(i / across) + ((i * 7) % 19),
  }));
export const longLayout = {
  format: 'lekalo-layout/1',
  units: 'mm',
  name: 'Many',
  rules: { gap: 1 },
  stocks: [{ id: 'board', kind: 'sheet', count: 2, outline: side(2000) }],
  parts: [
    {
      id: 'chip',
      name: 'Chip',
      outline: {
        polygon: {
          outer: [
            [0, 0],
            [10, 0],
            [13, 4],
            [10, 10],
            [4, 7],
            [0, 10],
          ],
        },
      },
      demand: 4000,
    },
  ],
  placements: [...rows(0, 40, 10), ...rows(1, 3600, 60)].map((p, i) => ({ id: i + 1, ...p })),
};
