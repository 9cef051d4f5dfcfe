import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { Checking } from '../src/tasks/checking';
import type { LayoutDocument, Placement, Violation } from '../src/layout/document';
import type { Kernel, Looked } from '../src/kernel/kernel';
import { Model } from '../src/layout/model';

const overlap = (a: number, b: number): Violation => ({
  kind: 'overlap',
  a,
  b,
  stock: 's',
  copy: 0,
  amount_mm: 1,
  at: [0, 0],
});
let now = 0;
beforeEach(() => {
  vi.useFakeTimers({ toFake: ['setTimeout', 'clearTimeout'] });
  vi.spyOn(performance, 'now').mockImplementation(() => now);
});
afterEach(() => {
  vi.useRealTimers();
  vi.restoreAllMocks();
});

/** A kernel that says that every part lies over the next one, and takes its time. */
class Slow {
  unchecked = new Set<number>();
  constructor(
    readonly n: number,
    readonly msEach: number,
  ) {
    for (let i = 1; i <= n; ++i) this.unchecked.add(i);
  }
  checkSome(most: number): Looked {
    const ids = [...this.unchecked].sort((a, b) => a - b).slice(0, most);
    for (const id of ids) this.unchecked.delete(id);
    now += ids.length * this.msEach;
    const violations = ids
      .flatMap((id) => [id - 1, id])
      .filter((a) => a >= 1 && a < this.n && !this.unchecked.has(a) && !this.unchecked.has(a + 1));
    return { left: this.unchecked.size, ids, violations: [...new Set(violations)].map((a) => overlap(a, a + 1)) };
  }
  state(placements: readonly Placement[]): { level: string; violations: Violation[]; nearest: null } {
    return {
      level: 'forbidden',
      nearest: null,
      violations: placements.flatMap(({ id }) =>
        [id - 1, id].filter((a) => a >= 1 && a < this.n).map((a) => overlap(a, a + 1)),
      ),
    };
  }
}
function checkingOf(slow: Slow) {
  const document: LayoutDocument = {
    format: 'lekalo-layout/1',
    units: 'mm',
    stocks: [{ id: 's', kind: 'strip', height: 100 }],
    parts: [
      {
        id: 'p',
        outline: {
          polygon: {
            outer: [
              [0, 0],
              [9, 0],
              [9, 9],
            ],
          },
        },
      },
    ],
    placements: Array.from({ length: slow.n }, (_, i) => ({
      id: i + 1,
      part: 'p',
      stock: 's',
      c: 1,
      s: 0,
      x: 0,
      y: 0,
    })),
  };
  const told: boolean[] = [];
  const model = new Model(document);
  return {
    checking: new Checking(
      () => slow as unknown as Kernel,
      () => model,
      (whole) => told.push(whole),
    ),
    told,
  };
}
const all = (n: number): Violation[] => Array.from({ length: n - 1 }, (_, i) => overlap(i + 1, i + 2));

describe('the check of the whole', () => {
  it('is done at once where that is quick', () => {
    const { checking, told } = checkingOf(new Slow(100, 0));
    checking.begin();
    expect(checking.left).toBe(0);
    expect(checking.found).toEqual(all(100));
    expect(told).toEqual([]);
  });
  it('goes on in slices where it is not, and is the same in the end', () => {
    const { checking, told } = checkingOf(new Slow(1000, 1));
    checking.begin();
    expect(checking.left).toBeGreaterThan(900);
    const before = checking.fraction;
    vi.advanceTimersToNextTimer();
    expect(checking.fraction).toBeGreaterThan(before);
    expect(told).toEqual([false]);
    vi.runAllTimers();
    expect(checking.left).toBe(0);
    expect(told.at(-1)).toBe(true);
    expect(checking.found).toEqual(all(1000));
  });
  it('stops, looks at what changes all the same, and goes on where it was', () => {
    const slow = new Slow(1000, 1);
    const { checking } = checkingOf(slow);
    checking.begin();
    checking.stop();
    const { left } = checking;
    expect(checking.stopped && left > 900).toBe(true);
    slow.unchecked.add(500);
    checking.changed([500]);
    expect(checking.left).toBe(left);
    expect(checking.found!.filter((v) => v.a > 400)).toEqual([overlap(499, 500), overlap(500, 501)]);
    checking.resume();
    vi.runAllTimers();
    expect(checking.found).toEqual(all(1000)); // nothing twice
  });
});
