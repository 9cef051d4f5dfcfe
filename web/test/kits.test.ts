import { describe, expect, it } from 'vitest';
import type { LayoutDocument, Placement } from '../src/document';
import { Model } from '../src/model';
import { kitStates } from '../src/panels/kits';

const outline = { polygon: { outer: [[0, 0], [1, 0], [0, 1]] as [number, number][] } };
const placed = (hands: boolean[]): Placement[] => hands.map((mirrored, i) => ({ id: i + 1, part: 'p', stock: 's', c: 1, s: 0, x: 0, y: 0, mirrored }));
const layout = (hands: boolean[]): LayoutDocument => ({
  format: 'lekalo-layout/1', units: 'mm', stocks: [{ id: 's', kind: 'strip', height: 10 }], parts: [{ id: 'p', outline, mirror: true }],
  kits: [{ id: 'k', demand: 2, pieces: [{ part: 'p', count: 1 }, { part: 'p', count: 1, mirrored: true }] }], placements: placed(hands),
});

describe('kits', () => {
  it('give a piece of either hand what the others leave', () => {
    expect(kitStates(new Model(layout([false, true])))[0]).toMatchObject({ complete: 1 });
    expect(kitStates(new Model(layout([true, true, true, true])))[0]).toMatchObject({ complete: 2, missing: [] });
  });
  it('say what the next one misses, with its hand', () => {
    expect(kitStates(new Model(layout([false, false])))[0]).toMatchObject({ complete: 0, missing: [{ part: 'p', count: 1, mirrored: true }] });
  });
});
