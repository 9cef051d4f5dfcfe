// Two of twelve plates lie far apart on a sheet; the rest is wanted.

const outline = (...outer) => ({ polygon: { outer } });
export const nestLayout = {
  format: 'lekalo-layout/1',
  units: 'mm',
  name: 'To be nested',
  rules: { gap: 2, border_gap: 3 },
  stocks: [{ id: 'board', kind: 'sheet', outline: outline([0, 0], [600, 0], [600, 400], [0, 400]) }],
  parts: [
    {
      id: 'plate',
      name: 'Plate',
      outline: outline([0, 0], [80, 0], [95, 25], [80, 50], [0, 50]),
      rotations: [0, 90, 180, 270],
      demand: 12,
    },
  ],
  placements: [
    { id: 1, part: 'plate', stock: 'board', c: 1, s: 0, x: 300, y: 200 },
    { id: 2, part: 'plate', stock: 'board', c: 1, s: 0, x: 450, y: 330 },
  ],
};
