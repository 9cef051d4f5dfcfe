// The way from millimetres (y up) to pixels of the page (y down).

import type { Box } from '../layout/model';

export class View {
  /** Pixels a millimetre. */
  scale = 1;
  /** The place of the picture's origin, pixels. */
  x = 0;
  y = 0;
  width = 1;
  height = 1;
  /** Pixels of the screen to one of the page. */
  ratio = 1;
  private rest: [number, number] = [0, 0];
  private fitted = '';

  toScreen(x: number, y: number): [number, number] {
    return [this.x + x * this.scale, this.y - y * this.scale];
  }
  toWorld(x: number, y: number): [number, number] {
    return [(x - this.x) / this.scale, (this.y - y) / this.scale];
  }
  /**
   * Moves by whole pixels of the screen, so that the painted picture can be moved along; the rest waits for the next
   * move.
   */
  pan(dx: number, dy: number): void {
    const [x, y] = [this.x + dx + this.rest[0], this.y + dy + this.rest[1]];
    const onPixel = (now: number, to: number): number => now + Math.round((to - now) * this.ratio) / this.ratio;
    [this.x, this.y] = [onPixel(this.x, x), onPixel(this.y, y)];
    this.rest = [x - this.x, y - this.y];
  }
  /** Zooms and keeps the point under the cursor where it is. */
  zoomAt(x: number, y: number, factor: number): void {
    const [wx, wy] = this.toWorld(x, y);
    this.scale = Math.min(2000, Math.max(1e-4, this.scale * factor));
    this.x = x - wx * this.scale;
    this.y = y + wy * this.scale;
  }
  fit(box: Box, margin = 28, whole = false): void {
    const w = Math.max(box.right - box.left, 1e-6);
    const h = Math.max(box.top - box.bottom, 1e-6);
    this.scale = Math.max(1e-4, Math.min((this.width - 2 * margin) / w, (this.height - 2 * margin) / h));
    this.x = (this.width - (box.left + box.right) * this.scale) / 2;
    this.y = (this.height + (box.bottom + box.top) * this.scale) / 2;
    if (whole) this.fitted = `${this.scale} ${this.x} ${this.y}`;
  }
  /** Says whether nobody has moved the view since fit() of everything. */
  get isFitted(): boolean {
    return this.fitted === `${this.scale} ${this.x} ${this.y}`;
  }
  visible(): Box {
    const [left, top] = this.toWorld(0, 0);
    const [right, bottom] = this.toWorld(this.width, this.height);
    return { left, bottom, right, top };
  }
}
