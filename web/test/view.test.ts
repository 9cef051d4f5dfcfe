import { describe, expect, it } from 'vitest';
import { contains, innerPoint } from '../src/layout/model';
import type { Point } from '../src/layout/document';
import { View } from '../src/picture/view';

describe('the view', () => {
  it('moves by whole pixels of the screen and loses nothing of what is left over', () => {
    const view = new View();
    view.ratio = 1.25;
    for (let i = 0; i < 100; ++i) {
      view.pan(1, -0.3);
      expect(Math.abs(view.x * 1.25 - Math.round(view.x * 1.25))).toBeLessThan(1e-9);
    }
    expect(Math.abs(view.x - 100)).toBeLessThanOrEqual(0.4 + 1e-9);
    expect(Math.abs(view.y + 30)).toBeLessThanOrEqual(0.4 + 1e-9);
  });
  it('keeps what is under the cursor there when it zooms', () => {
    const view = new View();
    [view.x, view.y, view.scale] = [13, 700, 0.7];
    const before = view.toWorld(321, 123);
    view.zoomAt(321, 123, 1.7);
    const after = view.toWorld(321, 123);
    expect(Math.hypot(before[0] - after[0], before[1] - after[1])).toBeLessThan(1e-9);
  });
});

describe('where a caption stands', () => {
  it('is the middle of a rectangle, and within what has a notch or a hole', () => {
    expect(
      innerPoint([
        [
          [0, 0],
          [100, 0],
          [100, 40],
          [0, 40],
        ],
      ]),
    ).toEqual([50, 20]);
    const ell: Point[] = [
      [0, 0],
      [90, 0],
      [90, 30],
      [30, 30],
      [30, 80],
      [0, 80],
    ];
    expect(contains([ell], ...innerPoint([ell]))).toBe(true);
    const ring: Point[][] = [
      [
        [0, 0],
        [100, 0],
        [100, 100],
        [0, 100],
      ],
      [
        [20, 20],
        [80, 20],
        [80, 80],
        [20, 80],
      ],
    ];
    expect(contains(ring, ...innerPoint(ring))).toBe(true);
  });
  it('is in what two outlines have in common', () => {
    const zone: Point[] = [
      [-500, -500],
      [500, -500],
      [500, 10],
      [-500, 10],
    ];
    const hide: Point[] = [
      [0, 0],
      [100, 0],
      [100, 80],
      [0, 80],
    ];
    const at = innerPoint([zone], [hide]);
    expect(contains([zone], ...at) && contains([hide], ...at)).toBe(true);
  });
});
