// The lower canvas, the layout at rest. No more of it is painted than has changed: parts that look otherwise than
// before are painted anew, a picture that moves is moved along, one that is zoomed is stretched, and a whole picture
// is painted aside in slices that leave a frame its time.

import { isGap, type Placement, type Violation } from '../layout/document';
import type { Scene } from './scene';
import { boxesMeet, placedAt, type Box, type Model, type Sheet } from '../layout/model';

export interface Painter {
  take(model: Model): void;
  drawSheet(ctx: CanvasRenderingContext2D, scene: Scene, sheet: Sheet): void;
  drawPart(ctx: CanvasRenderingContext2D, scene: Scene, p: Placement, mark: 'bad' | 'near' | null): void;
  drawViolation(ctx: CanvasRenderingContext2D, scene: Scene, v: Violation): void;
}

/** Captions and tags stand out from their part or mark by so many pixels at most. */
const OUT = 60;
/** More rectangles than these are painted as one picture. */
const MOST_RECTANGLES = 48;
/** Parts between two looks at the clock. */
const AT_A_TIME = 32;
/** A picture that changes faster than it can be painted is painted at once after so long, ms. */
const LONGEST_STALE_MS = 300;

interface Rectangle {
  left: number;
  top: number;
  right: number;
  bottom: number;
}
/** The state that a canvas shows. */
interface Painted {
  x: number;
  y: number;
  scale: number;
  model: Model;
  theme: unknown;
  show: string;
  sheets: string;
  looks: Map<number, { p: Placement; look: number }>;
  violations: Map<string, Violation>;
}

export class Backdrop {
  private readonly ctx: CanvasRenderingContext2D;
  private ratio = 1;
  private painted: Painted | null = null;
  /** The canvas has been old or stretched since then; null: it shows what it should. */
  private stale: number | null = null;
  /** The last sharp picture, while a stretched copy of it is shown. */
  private sharp: HTMLCanvasElement | null = null;
  private aside: CanvasRenderingContext2D | null = null;
  private coming: { ctx: CanvasRenderingContext2D; of: Painted; steps: Generator<void> } | null = null;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly painter: Painter,
  ) {
    this.ctx = canvas.getContext('2d', { alpha: false })!;
  }

  /** Says whether the canvas shows what it should. */
  get isWhole(): boolean {
    return this.stale === null && this.painted !== null;
  }

  /** Resizes the canvas. The old picture stays until draw() has painted the new one. */
  resize(width: number, height: number, ratio: number): void {
    const old = this.painted ? copyOf(this.canvas) : null;
    this.ratio = ratio;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    if (old) this.ctx.drawImage(old, 0, 0);
    this.painted = this.sharp = this.coming = null;
  }

  /**
   * Paints the picture exactly, in `ms` or less.
   *
   * @returns false: the time was too short, and sharpen() has to follow
   */
  draw(scene: Scene, ms = Infinity): boolean {
    this.painter.take(scene.model);
    const now = described(scene);
    const rectangles =
      this.painted && this.stale === null && sameView(this.painted, now)
        ? this.changed(scene, this.painted, now)
        : null;
    if (!rectangles && ms < Infinity) {
      this.stale ??= performance.now();
      return this.sharpen(scene, ms);
    }
    for (const one of rectangles ?? [this.whole()]) this.paint(scene, one);
    this.painted = now;
    this.stale = this.sharp = this.coming = null;
    return true;
  }

  /**
   * Follows the view alone.
   *
   * @returns false: the picture is stretched, and sharpen() has to follow
   */
  follow(scene: Scene, ms = Infinity): boolean {
    const { view } = scene;
    const { ctx, canvas, painted } = this;
    if (!painted || painted.model !== scene.model) return this.draw(scene, ms);
    const k = view.scale / painted.scale;
    const dx = (view.x - painted.x * k) * this.ratio;
    const dy = (view.y - painted.y * k) * this.ratio;
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    if (this.stale === null && k === 1) {
      const [right, down] = [Math.round(dx), Math.round(dy)];
      if (
        Math.abs(dx - right) > 1e-3 ||
        Math.abs(dy - down) > 1e-3 ||
        Math.abs(right) >= canvas.width ||
        Math.abs(down) >= canvas.height
      ) {
        this.stale = performance.now();
        return this.sharpen(scene, ms);
      }
      ctx.globalCompositeOperation = 'copy';
      ctx.drawImage(canvas, right, down);
      ctx.globalCompositeOperation = 'source-over';
      const { right: w, bottom: h } = this.whole();
      if (right !== 0)
        this.paint(
          scene,
          right > 0 ? { left: 0, top: 0, right, bottom: h } : { left: w + right, top: 0, right: w, bottom: h },
        );
      if (down !== 0)
        this.paint(
          scene,
          down > 0 ? { left: 0, top: 0, right: w, bottom: down } : { left: 0, top: h + down, right: w, bottom: h },
        );
      [painted.x, painted.y] = [view.x, view.y];
      return true;
    }
    this.sharp ??= copyOf(canvas);
    this.stale = performance.now();
    ctx.fillStyle = scene.theme.back;
    ctx.fillRect(0, 0, canvas.width, canvas.height);
    ctx.imageSmoothingQuality = 'low';
    ctx.setTransform(k, 0, 0, k, dx, dy);
    ctx.drawImage(this.sharp, 0, 0);
    return false;
  }

  /**
   * Paints the picture aside for some milliseconds and shows it when it is whole.
   *
   * @returns whether it is; if not, the next frame calls again
   */
  sharpen(scene: Scene, ms: number): boolean {
    if (this.stale === null) return true;
    const begun = performance.now();
    const until = begun - this.stale > LONGEST_STALE_MS ? Infinity : begun + ms;
    const now = described(scene);
    if (!this.coming || !sameView(this.coming.of, now) || !sameParts(this.coming.of, now)) {
      const ctx = this.asideContext();
      this.coming = { ctx, of: now, steps: this.steps(ctx, scene, this.whole()) };
    }
    do {
      const { done } = this.coming.steps.next();
      // The rasteriser works when a pixel is read: else it would do all of it with the last slice.
      this.coming.ctx.getImageData(0, 0, 1, 1);
      if (!done) continue;
      this.ctx.setTransform(1, 0, 0, 1, 0, 0);
      this.ctx.drawImage(this.coming.ctx.canvas, 0, 0);
      this.painted = this.coming.of;
      this.stale = this.sharp = this.coming = null;
      return true;
    } while (performance.now() < until);
    return false;
  }

  /** An empty canvas as large as this one. It is always the same one, as making one takes milliseconds. */
  private asideContext(): CanvasRenderingContext2D {
    const { width, height } = this.canvas;
    if (this.aside?.canvas.width !== width || this.aside.canvas.height !== height) {
      const canvas = document.createElement('canvas');
      [canvas.width, canvas.height] = [width, height];
      this.aside = canvas.getContext('2d', { alpha: false, willReadFrequently: true })!;
    }
    this.aside.reset();
    return this.aside;
  }

  private whole(): Rectangle {
    return { left: 0, top: 0, right: this.canvas.width, bottom: this.canvas.height };
  }

  private paint(scene: Scene, rectangle: Rectangle): void {
    const steps = this.steps(this.ctx, scene, rectangle);
    while (!steps.next().done);
  }

  /** Paints a rectangle, in pixels of the canvas, a few parts at a time. */
  private *steps(
    ctx: CanvasRenderingContext2D,
    scene: Scene,
    { left, top, right, bottom }: Rectangle,
  ): Generator<void> {
    const { model, view, theme } = scene;
    const world = (out: number): Box => {
      const [l, t] = view.toWorld(left / this.ratio - out, top / this.ratio - out);
      const [r, b] = view.toWorld(right / this.ratio + out, bottom / this.ratio + out);
      return { left: l, right: r, bottom: b, top: t };
    };
    ctx.save();
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.beginPath();
    ctx.rect(left, top, right - left, bottom - top);
    ctx.clip();
    ctx.fillStyle = theme.back;
    ctx.fillRect(left, top, right - left, bottom - top);
    const around = world(OUT);
    for (const sheet of model.sheets) {
      if (!boxesMeet(placedAt(sheet.box, sheet), around)) continue;
      this.painter.drawSheet(ctx, scene, sheet);
      yield;
    }
    const marks = marksOf(scene);
    const seen = world(3);
    let n = 0;
    for (const p of model.placements.values()) {
      const sheet = model.sheet(p.stock, p.copy);
      if (!sheet || scene.moving.has(p.id)) continue;
      const gap = scene.selection.has(p.id) ? model.gap(p) : 0;
      const b = model.box(p);
      if (
        b.left + sheet.x - gap > seen.right ||
        b.right + sheet.x + gap < seen.left ||
        b.bottom + sheet.y - gap > seen.top ||
        b.top + sheet.y + gap < seen.bottom
      )
        continue;
      this.painter.drawPart(ctx, scene, p, marks.get(p.id) ?? null);
      if (++n % AT_A_TIME === 0) yield;
    }
    for (const v of restingViolations(scene)) this.painter.drawViolation(ctx, scene, v);
    ctx.restore();
  }

  /** The rectangles that have changed; null: all is to be painted. */
  private changed(scene: Scene, was: Painted, now: Painted): Rectangle[] | null {
    if (was.model !== now.model || was.theme !== now.theme || was.show !== now.show || was.sheets !== now.sheets)
      return null;
    const rectangles: Rectangle[] = [];
    const { view, model } = scene;
    const add = (left: number, top: number, right: number, bottom: number, out: number): void => {
      const k = this.ratio;
      const one = {
        left: Math.max(0, Math.floor((left - out) * k)),
        top: Math.max(0, Math.floor((top - out) * k)),
        right: Math.min(this.canvas.width, Math.ceil((right + out) * k)),
        bottom: Math.min(this.canvas.height, Math.ceil((bottom + out) * k)),
      };
      if (one.left < one.right && one.top < one.bottom) rectangles.push(one);
    };
    const addPart = (p: Placement): void => {
      const sheet = model.sheet(p.stock, p.copy);
      if (!sheet) return;
      const b = model.box(p);
      const [l, t] = view.toScreen(b.left + sheet.x, b.top + sheet.y);
      const [r, d] = view.toScreen(b.right + sheet.x, b.bottom + sheet.y);
      add(l, t, r, d, model.gap(p) * view.scale + 4);
    };
    for (const [id, before] of was.looks) {
      const after = now.looks.get(id);
      if (after?.p === before.p && after.look === before.look) continue;
      addPart(before.p);
      if (after && after.p !== before.p) addPart(after.p);
      if (rectangles.length > MOST_RECTANGLES) return null;
    }
    for (const [id, { p }] of now.looks) if (!was.looks.has(id)) addPart(p);
    for (const [some, others] of [
      [was.violations, now.violations],
      [now.violations, was.violations],
    ] as const) {
      for (const [key, v] of some) {
        const sheet = others.has(key) ? undefined : model.sheet(v.stock, v.copy);
        if (!sheet) continue;
        const [x, y] = view.toScreen(v.at[0] + sheet.x, v.at[1] + sheet.y);
        add(x, y, x, y, OUT);
      }
    }
    return rectangles.length > MOST_RECTANGLES ? null : rectangles;
  }
}

function copyOf(canvas: HTMLCanvasElement): HTMLCanvasElement {
  const copy = document.createElement('canvas');
  [copy.width, copy.height] = [canvas.width, canvas.height];
  copy.getContext('2d', { alpha: false })!.drawImage(canvas, 0, 0);
  return copy;
}

function marksOf(scene: Scene): Map<number, 'bad' | 'near'> {
  const marks = new Map<number, 'bad' | 'near'>();
  for (const v of scene.violations) {
    for (const id of [v.a, v.b])
      if (id !== null && marks.get(id) !== 'bad') marks.set(id, isGap(v.kind) ? 'near' : 'bad');
  }
  return marks;
}

/** The broken rules at rest: those of parts in hand are no longer there. */
const restingViolations = (scene: Scene): Violation[] =>
  scene.violations.filter((v) => !scene.moving.has(v.a) && !(v.b !== null && scene.moving.has(v.b)));

function described(scene: Scene): Painted {
  const marks = marksOf(scene);
  const looks = new Map<number, { p: Placement; look: number }>();
  for (const p of scene.model.placements.values()) {
    if (scene.moving.has(p.id)) continue;
    const mark = marks.get(p.id);
    looks.set(p.id, {
      p,
      look:
        (mark === 'bad' ? 2 : mark === 'near' ? 1 : 0) +
        (scene.selection.has(p.id) ? 4 : 0) +
        (scene.others.has(p.id) ? 8 : 0),
    });
  }
  const { x, y, scale } = scene.view;
  return {
    x,
    y,
    scale,
    model: scene.model,
    theme: scene.theme,
    show: JSON.stringify(scene.show),
    looks,
    sheets:
      `${scene.model.features} ${scene.photos.count} ` +
      scene.model.sheets.map((s) => `${s.x} ${s.y} ${s.box.right} ${s.box.top}`).join(),
    violations: new Map(
      restingViolations(scene).map((v) => [
        `${v.kind} ${v.a} ${v.b} ${v.copy} ${v.at[0]} ${v.at[1]} ${v.amount_mm}`,
        v,
      ]),
    ),
  };
}
const sameView = (a: Painted, b: Painted): boolean => a.x === b.x && a.y === b.y && a.scale === b.scale;
function sameParts(a: Painted, b: Painted): boolean {
  if (
    a.model !== b.model ||
    a.theme !== b.theme ||
    a.show !== b.show ||
    a.sheets !== b.sheets ||
    a.looks.size !== b.looks.size
  )
    return false;
  for (const [id, look] of a.looks) {
    const other = b.looks.get(id);
    if (other?.p !== look.p || other.look !== look.look) return false;
  }
  return a.violations.size === b.violations.size && [...a.violations.keys()].every((key) => b.violations.has(key));
}
