// The check of the whole layout, a little at a time, so that it holds up no hand however much there is to do.

import { VIOLATION_KINDS, type Violation } from '../layout/document';
import type { Kernel } from '../kernel/kernel';
import type { Model } from '../layout/model';
import { TimeLeft } from './time_left';

/** The time that the check takes of a frame's 16 ms. */
const SLICE_MS = 8;
/** The most placements between two looks at the clock; as a rule so many that they take a quarter of a slice. */
const MOST_AT_A_TIME = 512;

export class Checking {
  /** The broken rules that are known so far, in the order of `lekalo check`; null: nobody here can tell. */
  found: Violation[] | null = null;
  /** The number of placements that have not been looked at since they changed. */
  left = 0;
  /** A person has stopped the check. Placements that change are looked at all the same. */
  stopped = false;
  private most = 0;
  private atATime = 16;
  private timer: ReturnType<typeof setTimeout> | null = null;
  private time = new TimeLeft();

  /** @param tell is called when some of it is done; `whole`: all of it */
  constructor(
    private readonly kernel: () => Kernel,
    private readonly model: () => Model,
    private readonly tell: (whole: boolean) => void,
  ) {}

  get fraction(): number {
    return this.most > 0 ? 1 - this.left / this.most : 1;
  }
  get secondsLeft(): number | null {
    return this.time.seconds;
  }

  /** Begins with a layout that was opened. */
  begin(): void {
    this.halt();
    this.stopped = false;
    this.found = [];
    this.left = this.model().placements.size;
    this.goOn();
  }
  /** Gives up, as the kernel cannot check. */
  fail(): void {
    this.halt();
    this.found = null;
    this.left = 0;
  }
  /** Looks again at placements that have changed, as the kernel knows. A first slice is done before this returns. */
  changed(ids: readonly number[]): void {
    this.drop(new Set(ids));
    if (!this.stopped) return this.goOn();
    // A check that was stopped looks at these alone; the rest waits until a person resumes it.
    const { kernel, model } = { kernel: this.kernel(), model: this.model() };
    const there = ids.map((id) => model.placements.get(id)).filter((p) => p !== undefined);
    const state = there.length > 0 ? kernel.state(there, '', 0, true) : null;
    if (!this.found || !state || !('violations' in state)) return;
    this.found.push(...state.violations);
    this.sort();
  }
  stop(): void {
    this.halt();
    this.sort();
    this.stopped = this.left > 0;
    this.tell(true);
  }
  resume(): void {
    this.stopped = false;
    this.goOn();
    this.tell(this.left === 0);
  }

  private goOn(): void {
    if (this.timer) return;
    this.most = 0;
    this.time = new TimeLeft();
    this.slice();
  }
  private slice(): void {
    this.timer = null;
    const until = performance.now() + SLICE_MS;
    let now: number;
    do {
      const begun = performance.now();
      const looked = this.kernel().checkSome(this.atATime);
      if (!looked) return this.fail();
      this.drop(new Set(looked.ids));
      this.found?.push(...looked.violations);
      this.left = looked.left;
      this.most = Math.max(this.most, this.left + looked.ids.length);
      now = performance.now();
      if (looked.ids.length === this.atATime)
        this.atATime = Math.max(
          1,
          Math.min(MOST_AT_A_TIME, Math.round((this.atATime * SLICE_MS) / 4 / Math.max(now - begun, 0.1))),
        );
    } while (this.left > 0 && now < until);
    this.time.take(now / 1000, this.fraction);
    if (this.left === 0) return this.sort();
    this.timer = setTimeout(() => {
      this.slice();
      this.tell(this.left === 0);
    });
  }
  private halt(): void {
    if (this.timer) clearTimeout(this.timer);
    this.timer = null;
  }
  private drop(ids: ReadonlySet<number>): void {
    if (this.found?.some((v) => ids.has(v.a) || (v.b !== null && ids.has(v.b))))
      this.found = this.found.filter((v) => !ids.has(v.a) && !(v.b !== null && ids.has(v.b)));
  }
  private sort(): void {
    this.found = this.found && [...this.found].sort(this.order());
  }
  private order(): (a: Violation, b: Violation) => number {
    const stocks = [...this.model().stocks.values()];
    const stock = new Map(stocks.map((s, i) => [s.id, i]));
    const feature = (v: Violation): number => {
      const of = stocks[stock.get(v.stock)!];
      return ((v.kind === 'quality' ? of?.zones : of?.defects) ?? []).findIndex((f) => f.id === v.feature);
    };
    return (a, b) =>
      stock.get(a.stock)! - stock.get(b.stock)! ||
      a.copy - b.copy ||
      a.a - b.a ||
      VIOLATION_KINDS.indexOf(a.kind) - VIOLATION_KINDS.indexOf(b.kind) ||
      (a.b ?? 0) - (b.b ?? 0) ||
      (a.feature !== undefined && b.feature !== undefined ? feature(a) - feature(b) : 0);
  }
}
