import { describe, expect, it } from 'vitest';
import { TimeLeft } from '../src/tasks/time_left';

describe('the time left', () => {
  it('is not told before there is something to go by', () => {
    const left = new TimeLeft();
    expect(left.seconds).toBeNull();
    left.take(0, 0);
    left.take(0.2, 0.1);
    expect(left.seconds).toBeNull();
  });
  it('is right where the pace is even', () => {
    const left = new TimeLeft();
    for (let i = 0; i <= 50; ++i) {
      left.take(100 + 0.2 * i, i / 100);
      if (i >= 3) expect(left.seconds).toBeCloseTo(20 - 0.2 * i, 9);
    }
  });
  it('turns to the new pace where it slows down', () => {
    const left = new TimeLeft();
    for (let i = 0; i <= 25; ++i) left.take(0.2 * i, 0.02 * i);
    for (let i = 1; i <= 15; ++i) left.take(5 + 0.2 * i, 0.5 + 0.002 * i);
    expect(left.seconds).toBeGreaterThan(45); // the mean of all would say 5
  });
  it('is not told where nothing moves, and begins again with the work', () => {
    const left = new TimeLeft();
    for (let i = 0; i <= 5; ++i) left.take(0.2 * i, 0.1 * i);
    expect(left.seconds).not.toBeNull();
    for (let i = 6; i <= 30; ++i) left.take(0.2 * i, 0.5);
    expect(left.seconds).toBeNull();
    left.take(6.2, 0);
    left.take(6.4, 0.1);
    expect(left.seconds).toBeCloseTo(1.8, 9);
  });
});
