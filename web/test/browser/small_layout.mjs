// A layout where every place is known: on a sheet of 400 x 300 with a knot, two plates in line, a bracket above.

const outline = (...outer) => ({ polygon: { outer } });
export const smallLayout = {
  format: 'lekalo-layout/1',
  units: 'mm',
  name: 'Small',
  rules: { gap: 2, border_gap: 5, defect_gap: 1 },
  stocks: [
    {
      id: 'board',
      kind: 'sheet',
      count: 2,
      outline: outline([0, 0], [400, 0], [400, 300], [0, 300]),
      defects: [{ id: 'knot', severity: 2, outline: outline([300, 190], [330, 190], [330, 220], [300, 220]) }],
      zones: [{ id: 'edge', quality: 1, outline: outline([0, 270], [400, 270], [400, 300], [0, 300]) }],
    },
  ],
  parts: [
    {
      id: 'plate',
      name: 'Plate',
      outline: outline([-40, -25], [40, -25], [40, 25], [-40, 25]),
      rotations: [0, 90, 180, 270],
      mirror: true,
      demand: 4,
      grain: { deg: 0, tolerance_deg: 90 },
    },
    {
      id: 'bracket',
      name: 'Bracket',
      outline: outline([0, 0], [90, 0], [90, 30], [30, 30], [30, 80], [0, 80]),
      demand: 2,
    },
  ],
  placements: [
    { id: 1, part: 'plate', stock: 'board', c: 1, s: 0, x: 50, y: 40 },
    { id: 2, part: 'plate', stock: 'board', c: 1, s: 0, x: 200, y: 40 },
    { id: 3, part: 'bracket', stock: 'board', c: 1, s: 0, x: 20, y: 120 },
  ],
};
