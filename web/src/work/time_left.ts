// How long something still takes, from how far it was when: by the pace of late, so that a slow end is not promised
// to be as quick as the beginning, and nothing is said where nothing moves.

/// Seconds of the past that count, or this share of all of it where that is more.
const LATELY_S = 2;
const LATELY_SHARE = 0.25;
/// Before that nothing is said.
const SOONEST_S = 0.5;

export class TimeLeft {
  /// null: nobody can tell.
  seconds: number | null = null;
  private samples: { at: number; fraction: number }[] = [];
  private begun: number | null = null;

  /// \param at  seconds of any clock
  take(at: number, fraction: number): void {
    this.begun ??= at;
    const last = this.samples.at(-1);
    if (last && fraction < last.fraction) this.samples = []; // it began again
    this.samples.push({ at, fraction });
    const window = Math.max(LATELY_S, LATELY_SHARE * (at - this.begun));
    while (this.samples.length > 2 && this.samples[1]!.at <= at - window) this.samples.shift();
    const first = this.samples[0]!;
    const pace = (fraction - first.fraction) / (at - first.at);
    this.seconds = at - this.begun >= SOONEST_S && pace > 0 ? (1 - fraction) / pace : null;
  }
}
