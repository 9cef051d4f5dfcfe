// The picture: two canvases. The lower holds sheets and parts at rest, the upper what moves while a part is
// dragged, so that a drag costs as much as the parts in hand, not as the layout.

import { t } from '../i18n';
import { isGap, type Part, type Placement, type Point, type Violation } from '../layout/document';
import { boxesMeet, innerPoint, placedAt, placedBox, type Model, type Sheet } from '../layout/model';
import { Backdrop, type Painter } from './backdrop';
import {
  drawArrow,
  drawBand,
  drawDraft,
  drawGrain,
  drawHandle,
  drawMeasure,
  drawPin,
  drawTag,
  measured,
} from './marks';
import { drawPartText, loopsOf, marksPath, roomAlong, Shape, tracedPath, type Outlined } from './outlines';
import type { Scene, Theme } from './scene';
import type { View } from './view';

export class Picture implements Painter {
  readonly backdrop: Backdrop;
  private readonly top: CanvasRenderingContext2D;
  private shapes = new Map<Part, Shape>();
  private markPaths = new Map<Part, Path2D>();
  private paths = new WeakMap<object, Path2D>();
  private captions = new WeakMap<object, Point>();
  private hues = new Map<string, number>();
  private patterns = new Map<string, CanvasPattern>();
  private of: Model | null = null;
  private ratio = 1;

  constructor(base: HTMLCanvasElement, top: HTMLCanvasElement) {
    this.backdrop = new Backdrop(base, this);
    this.top = top.getContext('2d')!;
  }

  resize(view: View, width: number, height: number, ratio = Math.max(1, window.devicePixelRatio || 1)): void {
    this.ratio = view.ratio = ratio;
    view.width = width;
    view.height = height;
    this.backdrop.resize(width, height, this.ratio);
    this.top.canvas.width = Math.round(width * this.ratio);
    this.top.canvas.height = Math.round(height * this.ratio);
  }

  colour(part: Part, theme: Theme): string {
    const hue = this.hues.get(part.id) ?? 200;
    return `hsl(${hue} ${theme.partSat}% ${theme.partLight}%)`;
  }

  /** Gives the parts of this model their colours from now on. */
  take(model: Model): void {
    if (this.of === model) return;
    this.of = model;
    this.shapes = new Map();
    this.markPaths = new Map();
    this.hues = new Map();
    // Steps by the golden angle give neighbours in the list different hues, whatever their number.
    [...model.parts.keys()].forEach((id, i) => this.hues.set(id, Math.round(205 + i * 137.508) % 360));
  }

  private shape(part: Part): Shape {
    let shape = this.shapes.get(part);
    if (!shape) this.shapes.set(part, (shape = new Shape(loopsOf(part.outline))));
    return shape;
  }

  private marks(part: Part): Path2D {
    let path = this.markPaths.get(part);
    if (!path) this.markPaths.set(part, (path = marksPath(part.marks ?? [])));
    return path;
  }

  /** The place of an outline's name, in its own frame. */
  private captionOf(outline: Outlined, within?: Outlined): Point {
    let at = this.captions.get(outline);
    if (!at) this.captions.set(outline, (at = innerPoint(loopsOf(outline), within ? loopsOf(within) : [])));
    return at;
  }

  private path(outline: Outlined): Path2D {
    let path = this.paths.get(outline);
    if (!path) this.paths.set(outline, (path = tracedPath(loopsOf(outline), 0)));
    return path;
  }

  /** Hatching that a colour-blind eye tells apart: a cross is forbidden, dots are too near, lines are a hole or a defect. */
  private hatch(ctx: CanvasRenderingContext2D, colour: string, kind: 'cross' | 'dots' | 'lines'): CanvasPattern {
    const key = `${colour} ${kind} ${this.ratio}`;
    let pattern = this.patterns.get(key);
    if (!pattern) {
      const size = Math.round(8 * this.ratio);
      const tile = document.createElement('canvas');
      tile.width = tile.height = size;
      const t = tile.getContext('2d')!;
      t.strokeStyle = t.fillStyle = colour;
      t.lineWidth = this.ratio * 1.2;
      t.beginPath();
      if (kind === 'dots') t.arc(size / 2, size / 2, size * 0.18, 0, 7);
      for (const k of kind === 'dots' ? [] : [-size, 0, size]) {
        t.moveTo(k, size);
        t.lineTo(k + size, 0);
        if (kind === 'cross') {
          t.moveTo(k, 0);
          t.lineTo(k + size, size);
        }
      }
      if (kind === 'dots') t.fill();
      else t.stroke();
      pattern = ctx.createPattern(tile, 'repeat')!;
      this.patterns.set(key, pattern);
    }
    return pattern;
  }

  /**
   * Makes the canvas count in mm of a sheet or, with a placement, of its part.
   *
   * @returns mm of a pixel of the page
   */
  private frame(ctx: CanvasRenderingContext2D, view: View, sheet: Sheet, p?: Placement): number {
    const k = view.scale * this.ratio;
    const ox = (view.x + sheet.x * view.scale) * this.ratio;
    const oy = (view.y - sheet.y * view.scale) * this.ratio;
    if (!p) {
      ctx.setTransform(k, 0, 0, -k, ox, oy);
    } else {
      const m = p.mirrored ? -1 : 1;
      ctx.setTransform(k * p.c * m, -k * p.s * m, -k * p.s, -k * p.c, ox + k * p.x, oy - k * p.y);
    }
    return this.ratio / k;
  }

  /** Fills a path with a pattern of pixels that moves with the view, so that a picture can be scrolled. */
  private fillHatched(ctx: CanvasRenderingContext2D, view: View, path: Path2D, pattern: CanvasPattern): void {
    const tile = Math.round(8 * this.ratio);
    const [x, y] = [Math.round(view.x * this.ratio) % tile, Math.round(view.y * this.ratio) % tile];
    ctx.save();
    ctx.clip(path, 'evenodd');
    ctx.setTransform(1, 0, 0, 1, x, y);
    ctx.fillStyle = pattern;
    ctx.fillRect(-x, -y, ctx.canvas.width, ctx.canvas.height);
    ctx.restore();
  }

  drawTop(scene: Scene): void {
    const ctx = this.top;
    const { view, theme } = scene;
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.clearRect(0, 0, ctx.canvas.width, ctx.canvas.height);
    const level = scene.live?.level;
    for (const v of scene.live?.violations ?? []) {
      for (const id of [v.a, v.b]) {
        const met = id === null || scene.moving.has(id) ? undefined : scene.model.placements.get(id);
        if (met) this.drawPart(ctx, scene, met, isGap(v.kind) ? 'near' : 'bad');
      }
    }
    this.drawComing(ctx, scene);
    for (const p of scene.moving.values()) {
      this.drawPart(ctx, scene, p, level === 'forbidden' ? 'bad' : level === 'gap' ? 'near' : null, level === 'clear');
    }
    ctx.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    if (scene.live) {
      for (const v of scene.live.violations) this.drawViolation(ctx, scene, v);
      const first = scene.moving.values().next().value;
      const sheet = first && scene.model.sheet(first.stock, first.copy);
      if (scene.live.nearest && sheet) {
        const n = scene.live.nearest;
        drawMeasure(
          ctx,
          scene,
          [n.from[0] + sheet.x, n.from[1] + sheet.y],
          [n.to[0] + sheet.x, n.to[1] + sheet.y],
          `${n.distance.toFixed(3)} ${t('job.mm')}`,
          theme.good,
        );
      }
    }
    if (scene.ruler) {
      const { from, to } = scene.ruler;
      drawMeasure(ctx, scene, from, to, measured(from, to), theme.select);
    }
    if (scene.draft.length > 0) drawDraft(ctx, scene);
    for (const pin of scene.pins) drawPin(ctx, theme, view.toScreen(...pin));
    if (scene.handle) drawHandle(ctx, theme, scene.handle.top, scene.handle.at);
    if (scene.arrow) drawArrow(ctx, view.toScreen(...scene.arrow.from), view.toScreen(...scene.arrow.to), theme.select);
    if (scene.band) drawBand(ctx, scene, scene.band);
  }

  /** Dashed outlines: the parts themselves stand where they are until the command is carried out. */
  private drawComing(ctx: CanvasRenderingContext2D, scene: Scene): void {
    const { model, view, theme } = scene;
    const seen = view.visible();
    for (const p of scene.coming.values()) {
      const sheet = model.sheet(p.stock, p.copy);
      const part = model.parts.get(p.part);
      if (!sheet || !part || !boxesMeet(placedAt(placedBox(part, p), sheet), seen)) continue;
      const px = this.frame(ctx, view, sheet, p);
      const path = this.shape(part).at(px);
      ctx.globalAlpha = 0.12;
      ctx.fillStyle = theme.select;
      ctx.fill(path, 'evenodd');
      ctx.globalAlpha = 1;
      ctx.strokeStyle = theme.select;
      ctx.lineWidth = 1.2 * px;
      ctx.setLineDash(this.shape(part).reach / px < 5 ? [] : [5 * px, 3 * px]);
      ctx.stroke(path);
    }
    ctx.setLineDash([]);
  }

  drawSheet(ctx: CanvasRenderingContext2D, scene: Scene, sheet: Sheet): void {
    const { view, theme } = scene;
    const px = this.frame(ctx, view, sheet);
    const { stock, box } = sheet;
    let path: Path2D;
    if (stock.outline) path = this.path(stock.outline);
    else {
      path = new Path2D();
      path.rect(box.left, box.bottom, box.right - box.left, box.top - box.bottom);
    }
    ctx.fillStyle = theme.material;
    ctx.fill(path, 'evenodd');
    const photo = scene.photos.get(stock.id);
    if (photo) {
      const { image, a, b, x, y } = photo;
      ctx.save();
      ctx.clip(path, 'evenodd');
      ctx.transform(a, b, b, -a, x, y);
      ctx.drawImage(image, 0, 0);
      ctx.restore();
    }
    for (const hole of stock.outline?.polygon.holes ?? [])
      this.fillHatched(ctx, view, tracedPath([hole], 0), this.hatch(ctx, theme.faint, 'lines'));
    if (scene.show.zones) {
      ctx.save();
      ctx.clip(path, 'evenodd');
      for (const zone of stock.zones ?? []) {
        ctx.globalAlpha = Math.min(0.34, 0.1 + 0.06 * (3 - Math.min(3, zone.quality)));
        ctx.fillStyle = theme.zone;
        ctx.fill(this.path(zone.outline), 'evenodd');
        ctx.globalAlpha = 0.9;
        ctx.strokeStyle = theme.zone;
        ctx.lineWidth = px;
        ctx.setLineDash([6 * px, 4 * px]);
        ctx.stroke(this.path(zone.outline));
        ctx.setLineDash([]);
      }
      ctx.restore();
    }
    for (const defect of stock.defects ?? []) {
      this.fillHatched(ctx, view, this.path(defect.outline), this.hatch(ctx, theme.defect, 'lines'));
      ctx.strokeStyle = theme.defect;
      ctx.lineWidth = 1.4 * px;
      ctx.stroke(this.path(defect.outline));
    }
    ctx.strokeStyle = theme.edge;
    ctx.lineWidth = 1.5 * px;
    ctx.stroke(path);
    this.drawCaptions(ctx, scene, sheet);
  }

  /** The names of a sheet, of its zones and of its defects. */
  private drawCaptions(ctx: CanvasRenderingContext2D, scene: Scene, sheet: Sheet): void {
    const { view, theme } = scene;
    const { stock, box } = sheet;
    ctx.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    ctx.font = '600 12px system-ui, sans-serif';
    ctx.fillStyle = theme.ink;
    ctx.textAlign = 'left';
    ctx.textBaseline = 'alphabetic';
    const [tx, ty] = view.toScreen(sheet.x + box.left, sheet.y + box.top);
    if ((box.right - box.left) * view.scale > 60) {
      ctx.fillText(
        `${stock.name ?? stock.id}${(stock.count ?? 1) > 1 ? `  ${sheet.copy + 1} / ${stock.count}` : ''}`,
        tx,
        ty - 8,
      );
      if (stock.kind !== 'strip' || stock.grain_deg !== undefined)
        drawGrain(ctx, theme, tx + 18, ty + 12, stock.grain_deg ?? 0, 22);
    }
    if (scene.show.zones && view.scale > 0.12) {
      ctx.font = '11px system-ui, sans-serif';
      ctx.fillStyle = theme.zone;
      ctx.textAlign = 'center';
      for (const zone of stock.zones ?? []) {
        const [x, y] = this.captionOf(zone.outline, stock.outline);
        ctx.fillText(`${zone.id} · ${zone.quality}`, ...view.toScreen(sheet.x + x, sheet.y + y));
      }
      ctx.textAlign = 'left';
      ctx.fillStyle = theme.defect;
      for (const defect of stock.defects ?? []) {
        const b = defect.outline.polygon.outer[0]!;
        const [dx, dy] = view.toScreen(sheet.x + b[0], sheet.y + b[1]);
        ctx.fillText(`${defect.id} · ${defect.severity ?? 1}`, dx + 4, dy + 14);
      }
    }
  }

  drawPart(ctx: CanvasRenderingContext2D, scene: Scene, p: Placement, mark: 'bad' | 'near' | null, good = false): void {
    const { model, view, theme } = scene;
    const sheet = model.sheet(p.stock, p.copy);
    if (!sheet) return;
    const part = model.part(p);
    const shape = this.shape(part);
    const chosen = scene.selection.has(p.id);
    const px = this.frame(ctx, view, sheet, p);
    const path = shape.at(px);
    const small = shape.reach / px < 5;
    if ((chosen || scene.moving.has(p.id)) && scene.show.gap && model.gap(p) > 0) {
      ctx.globalAlpha = 0.2;
      ctx.strokeStyle = mark === 'bad' ? theme.bad : theme.select;
      ctx.lineJoin = 'round';
      ctx.lineWidth = 2 * model.gap(p);
      ctx.stroke(path);
      ctx.globalAlpha = 1;
    }
    ctx.fillStyle = this.colour(part, theme);
    ctx.fill(path, 'evenodd');
    if (mark) {
      const colour = mark === 'bad' ? theme.bad : theme.near;
      ctx.globalAlpha = 0.25;
      ctx.fillStyle = colour;
      ctx.fill(path, 'evenodd');
      ctx.globalAlpha = 1;
      if (!small) this.fillHatched(ctx, view, path, this.hatch(ctx, colour, mark === 'bad' ? 'cross' : 'dots'));
    }
    if (!small || chosen || mark) {
      ctx.strokeStyle =
        mark === 'bad'
          ? theme.bad
          : mark === 'near'
            ? theme.near
            : good
              ? theme.good
              : chosen
                ? theme.select
                : scene.others.has(p.id)
                  ? theme.other
                  : theme.partInk;
      ctx.lineWidth = (chosen || mark || good || scene.others.has(p.id) ? 2 : 0.8) * px;
      ctx.stroke(path);
    }
    if (!small && part.marks) {
      ctx.strokeStyle = theme.partInk;
      ctx.lineWidth = 0.5 * px;
      ctx.stroke(this.marks(part));
    }
    if (!small && part.texts) {
      ctx.fillStyle = theme.partInk;
      for (const text of part.texts) if (text.height / px >= 4) drawPartText(ctx, text);
    }
    if (shape.reach / px >= 18) this.drawLabel(ctx, scene, sheet, p, px, mark !== null);
  }

  /** The name, the number and the grain of a part. */
  private drawLabel(
    ctx: CanvasRenderingContext2D,
    scene: Scene,
    sheet: Sheet,
    p: Placement,
    px: number,
    hatched: boolean,
  ): void {
    const { view, theme } = scene;
    const part = scene.model.part(p);
    const size = this.shape(part).reach / px;
    const [ix, iy] = this.captionOf(part.outline);
    const mx = p.mirrored ? -ix : ix;
    const [sx, sy] = view.toScreen(sheet.x + p.x + p.c * mx - p.s * iy, sheet.y + p.y + p.s * mx + p.c * iy);
    ctx.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    if (scene.show.labels) {
      ctx.font = size > 40 ? '600 12px system-ui, sans-serif' : '10px system-ui, sans-serif';
      ctx.textAlign = 'center';
      ctx.textBaseline = 'middle';
      ctx.fillStyle = theme.partInk;
      const room = (2 * roomAlong(part, [ix, iy], p.mirrored ? [-p.c, -p.s] : [p.c, -p.s])) / px;
      const marks = `${p.mirrored ? ' ⇋' : ''}${p.locked ? ' 🔒' : ''}`;
      const name = part.name ?? part.id;
      // A text over hatching is read only where it has ground to stand on.
      const write = (text: string, y: number): void => {
        if (hatched) ctx.strokeText(text, sx, y);
        ctx.fillText(text, sx, y);
      };
      ctx.strokeStyle = theme.material;
      ctx.lineWidth = 3;
      ctx.lineJoin = 'round';
      if (size > 40 && ctx.measureText(name).width < room) {
        write(name, sy);
        ctx.font = '10px system-ui, sans-serif';
        write(`${p.id}${marks}`, sy + 13);
      } else if (ctx.measureText(`${p.id}${marks}`).width < room) {
        write(`${p.id}${marks}`, sy);
      }
    }
    if (scene.show.grain && part.grain && size > 26) {
      const deg = (p.mirrored ? 180 - part.grain.deg : part.grain.deg) + (Math.atan2(p.s, p.c) * 180) / Math.PI;
      drawGrain(ctx, theme, sx, sy - 13, deg, Math.min(26, size * 0.5));
    }
  }

  drawViolation(ctx: CanvasRenderingContext2D, scene: Scene, v: Violation): void {
    const sheet = scene.model.sheet(v.stock, v.copy);
    if (!sheet) return;
    const { theme, view } = scene;
    ctx.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    const [x, y] = view.toScreen(sheet.x + v.at[0], sheet.y + v.at[1]);
    if (x < -50 || y < -50 || x > view.width + 50 || y > view.height + 50) return;
    const colour = isGap(v.kind) ? theme.near : theme.bad;
    ctx.strokeStyle = colour;
    ctx.lineWidth = 2;
    ctx.beginPath();
    if (isGap(v.kind)) ctx.arc(x, y, 6, 0, 7);
    else {
      ctx.moveTo(x - 5, y - 5);
      ctx.lineTo(x + 5, y + 5);
      ctx.moveTo(x - 5, y + 5);
      ctx.lineTo(x + 5, y - 5);
    }
    ctx.stroke();
    if (v.amount_mm > 0) drawTag(ctx, theme, `${v.amount_mm.toFixed(3)} ${t('job.mm')}`, x, y - 16, colour);
  }
}
