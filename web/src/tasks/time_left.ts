// The time that something still takes, by its pace of late: a slow end is not promised to be as quick as the
// beginning, and nothing is promised where nothing moves.

/** The pace is that of the last seconds, or of this share of all the time where that is longer. */
const LATELY_S = 2;
const LATELY_SHARE = 0.25;
/** Nothing is promised before so many seconds. */
const SOONEST_S = 0.5;

export class TimeLeft {
  /** The seconds left; null: nobody can tell. */
  seconds: number | null = null;
  private samples: { at: number; fraction: number }[] = [];
  private begun: number | null = null;

  /** @param at seconds of any clock */
  take(at: number, fraction: number): void {
    this.begun ??= at;
    const last = this.samples.at(-1);
    if (last && fraction < last.fraction) this.samples = []; // the work has begun again
    this.samples.push({ at, fraction });
    const window = Math.max(LATELY_S, LATELY_SHARE * (at - this.begun));
    while (this.samples.length > 2 && this.samples[1]!.at <= at - window) this.samples.shift();
    const first = this.samples[0]!;
    const pace = (fraction - first.fraction) / (at - first.at);
    this.seconds = at - this.begun >= SOONEST_S && pace > 0 ? (1 - fraction) / pace : null;
  }
}
