// A photograph of a stock. A similarity lays it on the stock, set by hand: the first pull moves it and pins the point,
// every later one turns and scales it about the pin until the pulled point is where the hand is.

import type { Point } from '../layout/document';
import type { Box } from '../layout/model';

/** Two points of the image (pixels, right and down from the upper left) and where they are on the stock (mm). */
export interface PhotoScale {
  pixels: [number, number, number, number];
  mm: [number, number, number, number];
}
interface Place {
  a: number;
  b: number;
  x: number;
  y: number;
}

export class Photo {
  /** A pixel (u, v), v downwards, lies at (x + a u + b v, y + b u - a v) of the stock's frame. */
  a = 1;
  b = 0;
  x = 0;
  y = 0;
  /** The point that turning and scaling leave where it is. */
  pinned: Point | null = null;
  private at: Point | null = null;
  private start: Place | null = null;

  constructor(
    readonly stock: string,
    readonly image: ImageBitmap,
  ) {}

  /** Lays it over a box from the upper left corner, as large as it fits. */
  cover(over: Box): this {
    this.a = Math.min((over.right - over.left) / this.image.width, (over.top - over.bottom) / this.image.height);
    [this.b, this.x, this.y] = [0, over.left, over.top];
    return this;
  }
  /** The scale that lays it where it is, by two corners of the image. */
  get scale(): PhotoScale {
    const w = this.image.width;
    return { pixels: [0, 0, w, 0], mm: [this.x, this.y, this.x + this.a * w, this.y + this.b * w] };
  }
  set scale({ pixels: [u0, v0, u1, v1], mm: [x0, y0, x1, y1] }: PhotoScale) {
    // In complex numbers: mm = place + (a + i b) (u - i v).
    const [du, dv, dx, dy] = [u1 - u0, -(v1 - v0), x1 - x0, y1 - y0];
    const d = du * du + dv * dv;
    this.a = (dx * du + dy * dv) / d;
    this.b = (dy * du - dx * dv) / d;
    this.x = x0 - this.a * u0 - this.b * v0;
    this.y = y0 - this.b * u0 + this.a * v0;
  }
  get pulled(): boolean {
    return this.start !== null;
  }

  /** Brings the point that lay at `from` when the pull began to `to`, both in the stock's frame. */
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
  /**
   * Ends the pull.
   *
   * @returns whether it has moved anything
   */
  pin(): boolean {
    const moved = this.start !== null;
    this.pinned ??= this.at;
    this.start = this.at = null;
    return moved;
  }
  /** Makes the next pull move it again. */
  unpin(): void {
    this.pinned = null;
  }
}
