import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { placedVertex, rotationFromPair, roundTiesToEven, stepsFromMm, textOfMm } from '../src/layout/grid';

// Made by geom::turned and grid_from_mm of the C++ program: x, y, c, s, tx, ty, mirrored, placed x, y in steps.
type Row = [number, number, number, number, number, number, boolean, number, number];
const rows = JSON.parse(readFileSync(new URL('placing_vectors.json', import.meta.url), 'utf8')) as Row[];

describe('the placing rule', () => {
  it('gives the steps of the C++ program', () => {
    expect(rows.length).toBe(240);
    for (const [x, y, c, s, tx, ty, mirrored, px, py] of rows) {
      expect(
        placedVertex(
          stepsFromMm(x),
          stepsFromMm(y),
          rotationFromPair(c, s),
          stepsFromMm(tx),
          stepsFromMm(ty),
          mirrored,
        ),
      ).toEqual([px, py]);
    }
  });
  it('rounds ties to even on both sides of zero', () => {
    expect([0.5, 1.5, 2.5, -0.5, -1.5, -2.5, 3.49, -3.51].map((v) => roundTiesToEven(v) + 0)).toEqual([
      0, 2, 2, 0, -2, -2, 3, -4,
    ]);
  });
  it('writes lengths without an exponent, and they read back to the same step', () => {
    for (const steps of [0, 1, -1, 3, 1048577, -(2 ** 39) + 1]) {
      const text = textOfMm(steps / 2 ** 20);
      expect(text).toMatch(/^-?\d+(\.\d+)?$/);
      expect(stepsFromMm(Number(text)) + 0).toBe(steps);
    }
  });
});
