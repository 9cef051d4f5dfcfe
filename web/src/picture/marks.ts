// Marks of one size at any zoom. The canvas counts in pixels of the page.

import { t } from '../i18n';
import type { Point } from '../layout/document';
import type { Box } from '../layout/model';
import type { Scene, Theme } from './scene';

/** A distance and its two shares, in words. */
export function measured(from: Point, to: Point): string {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  return `${Math.hypot(dx, dy).toFixed(3)} ${t('job.mm')}  (${dx.toFixed(2)}, ${dy.toFixed(2)})`;
}

/** A double arrow along the grain. */
export function drawGrain(
  ctx: CanvasRenderingContext2D,
  theme: Theme,
  x: number,
  y: number,
  degrees: number,
  length: number,
): void {
  const a = (-degrees * Math.PI) / 180;
  const [dx, dy] = [(Math.cos(a) * length) / 2, (Math.sin(a) * length) / 2];
  ctx.strokeStyle = theme.faint;
  ctx.lineWidth = 1.2;
  ctx.beginPath();
  for (const k of [1, -1]) {
    const [ex, ey] = [x + k * dx, y + k * dy];
    ctx.moveTo(x, y);
    ctx.lineTo(ex, ey);
    for (const turn of [2.6, -2.6]) {
      ctx.moveTo(ex, ey);
      ctx.lineTo(ex + k * Math.cos(a + turn) * 5, ey + k * Math.sin(a + turn) * 5);
    }
  }
  ctx.stroke();
}

/** A line between two points, with what it measures. */
export function drawMeasure(
  ctx: CanvasRenderingContext2D,
  scene: Scene,
  from: Point,
  to: Point,
  text: string,
  colour: string,
): void {
  const [x0, y0] = scene.view.toScreen(...from);
  const [x1, y1] = scene.view.toScreen(...to);
  ctx.strokeStyle = colour;
  ctx.lineWidth = 1.5;
  ctx.beginPath();
  ctx.moveTo(x0, y0);
  ctx.lineTo(x1, y1);
  const d = Math.hypot(x1 - x0, y1 - y0) || 1;
  const [nx, ny] = [(-(y1 - y0) / d) * 5, ((x1 - x0) / d) * 5];
  for (const [x, y] of [
    [x0, y0],
    [x1, y1],
  ] as const) {
    ctx.moveTo(x - nx, y - ny);
    ctx.lineTo(x + nx, y + ny);
  }
  ctx.stroke();
  drawTag(ctx, scene.theme, text, (x0 + x1) / 2, (y0 + y1) / 2 - 14, colour);
}

/** The outline that is being drawn; the corners of a long one are not marked. */
export function drawDraft(ctx: CanvasRenderingContext2D, { draft, view, theme }: Scene): void {
  ctx.strokeStyle = ctx.fillStyle = theme.defect;
  ctx.lineWidth = 1.8;
  ctx.beginPath();
  draft.forEach((p, i) => (i === 0 ? ctx.moveTo(...view.toScreen(...p)) : ctx.lineTo(...view.toScreen(...p))));
  ctx.stroke();
  for (const p of draft.length > 40 ? draft.slice(0, 1) : draft) {
    const [x, y] = view.toScreen(...p);
    ctx.beginPath();
    ctx.arc(x, y, 3.5, 0, 7);
    ctx.fill();
  }
}

/** The point about which a photograph turns. */
export function drawPin(ctx: CanvasRenderingContext2D, theme: Theme, [x, y]: Point): void {
  ctx.strokeStyle = theme.select;
  ctx.fillStyle = theme.material;
  ctx.lineWidth = 2;
  ctx.beginPath();
  ctx.arc(x, y, 6, 0, 7);
  ctx.fill();
  ctx.stroke();
  ctx.beginPath();
  for (const [dx, dy] of [
    [1, 0],
    [-1, 0],
    [0, 1],
    [0, -1],
  ] as const) {
    ctx.moveTo(x + dx * 3, y + dy * 3);
    ctx.lineTo(x + dx * 11, y + dy * 11);
  }
  ctx.stroke();
}

/** The handle that turns the chosen parts. */
export function drawHandle(ctx: CanvasRenderingContext2D, theme: Theme, [x0, y0]: Point, [x, y]: Point): void {
  ctx.strokeStyle = theme.select;
  ctx.fillStyle = theme.material;
  ctx.lineWidth = 1.5;
  ctx.beginPath();
  ctx.moveTo(x0, y0);
  ctx.lineTo(x, y + 7);
  ctx.stroke();
  ctx.beginPath();
  ctx.arc(x, y, 7, 0, 7);
  ctx.fill();
  ctx.stroke();
  // An arrow that turns lies within the circle.
  ctx.beginPath();
  ctx.arc(x, y, 3.2, 0.6, 5.2);
  ctx.stroke();
}

/** The direction in which parts are flicked. */
export function drawArrow(
  ctx: CanvasRenderingContext2D,
  [x0, y0]: [number, number],
  [x1, y1]: [number, number],
  colour: string,
): void {
  const a = Math.atan2(y1 - y0, x1 - x0);
  ctx.strokeStyle = colour;
  ctx.lineWidth = 2.5;
  ctx.beginPath();
  ctx.moveTo(x0, y0);
  ctx.lineTo(x1, y1);
  for (const t of [2.6, -2.6]) {
    ctx.moveTo(x1, y1);
    ctx.lineTo(x1 + Math.cos(a + t) * 11, y1 + Math.sin(a + t) * 11);
  }
  ctx.stroke();
}

/** A word on a ground of its own, in a frame. */
export function drawTag(
  ctx: CanvasRenderingContext2D,
  theme: Theme,
  text: string,
  x: number,
  y: number,
  colour: string,
): void {
  ctx.font = '600 11px system-ui, sans-serif';
  ctx.textAlign = 'center';
  ctx.textBaseline = 'middle';
  const w = ctx.measureText(text).width + 10;
  ctx.fillStyle = theme.material;
  ctx.strokeStyle = colour;
  ctx.lineWidth = 1;
  ctx.beginPath();
  ctx.roundRect(x - w / 2, y - 9, w, 18, 4);
  ctx.fill();
  ctx.stroke();
  ctx.fillStyle = colour;
  ctx.fillText(text, x, y + 0.5);
}

/** The box that a hand draws to choose parts. */
export function drawBand(ctx: CanvasRenderingContext2D, { view, theme }: Scene, band: Box): void {
  const [x0, y0] = view.toScreen(band.left, band.top);
  const [x1, y1] = view.toScreen(band.right, band.bottom);
  ctx.strokeStyle = theme.select;
  ctx.setLineDash([5, 3]);
  ctx.lineWidth = 1;
  ctx.strokeRect(x0 + 0.5, y0 + 0.5, x1 - x0, y1 - y0);
  ctx.setLineDash([]);
  ctx.globalAlpha = 0.08;
  ctx.fillStyle = theme.select;
  ctx.fillRect(x0, y0, x1 - x0, y1 - y0);
  ctx.globalAlpha = 1;
}
