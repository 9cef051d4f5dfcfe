// A photograph in the picture: where it lies is a similarity, set by hand. The first pull moves it and pins the
// point; every later one turns and scales it about the pin until the pulled point is where the hand is.

import type { Point } from './document';
import type { Box } from './model';

export class Photo {
  /// A pixel (u, v), v downwards, lies at (x + a u + b v, y + b u - a v).
  a: number;
  b = 0;
  x: number;
  y: number;
  private pinned: Point | null = null;
  private at: Point | null = null;
  private start: { a: number; b: number; x: number; y: number } | null = null;

  constructor(readonly image: ImageBitmap, over: Box) {
    this.a = Math.min((over.right - over.left) / image.width, (over.top - over.bottom) / image.height);
    this.x = over.left;
    this.y = over.top;
  }

  /// Brings what lay at \p from when the pull began to \p to.
  pull(from: Point, to: Point): void {
    this.start ??= { a: this.a, b: this.b, x: this.x, y: this.y };
    this.at = to;
    const { a, b, x, y } = this.start;
    if (!this.pinned) {
      [this.x, this.y] = [x + to[0] - from[0], y + to[1] - from[1]];
      return;
    }
    const [px, py] = this.pinned;
    const [fx, fy] = [from[0] - px, from[1] - py];
    const [tx, ty] = [to[0] - px, to[1] - py];
    const d = fx * fx + fy * fy;
    if (!(d > 0) || !(tx * tx + ty * ty > 0)) return;
    // The complex ratio t / f turns and scales.
    const [c, s] = [(tx * fx + ty * fy) / d, (ty * fx - tx * fy) / d];
    const turned = (u: number, v: number): Point => [c * u - s * v, s * u + c * v];
    [this.a, this.b] = turned(a, b);
    const [ox, oy] = turned(x - px, y - py);
    [this.x, this.y] = [px + ox, py + oy];
  }
  /// The pull has ended.
  pin(): void {
    this.pinned ??= this.at;
    this.start = this.at = null;
  }
  /// The next pull moves again.
  unpin(): void {
    this.pinned = null;
  }
}
