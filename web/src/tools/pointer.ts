// Mouse, pen and fingers on the picture.

import * as line from '../layout/commands';
import type { Placement, Point } from '../layout/document';
import { movedBy, type Editor, type Tool } from '../editor/editor';
import { FeatureTool } from './features';
import { boxesMeet, boxOf, contains, placedAt, placedLoops, type Box, type Sheet } from '../layout/model';
import type { View } from '../picture/view';

export interface Overlay {
  draft: Point[];
  band: Box | null;
  ruler: { from: Point; to: Point } | null;
  arrow: { from: Point; to: Point } | null;
}

/** Pixels from the box of the chosen parts to the handle that turns them, and those by which a hand may miss it. */
const HANDLE = 26;
const NEAR = { mouse: 10, touch: 22 };

export interface Handle {
  at: Point;
  middle: Point;
  top: Point;
  ids: number[];
}

/** The handle that turns the chosen parts: it stands above their common box, pixels. */
export function turningHandle(editor: Editor, view: View): Handle | null {
  const chosen = editor.placementsOf(editor.chosen()).filter((p) => !p.locked);
  const first = chosen[0];
  const sheet = first && editor.model.sheet(first.stock, first.copy);
  if (!sheet || chosen.length > 200 || !['select', 'slide', 'push', 'nearest'].includes(editor.tool)) return null;
  const box = { left: Infinity, bottom: Infinity, right: -Infinity, top: -Infinity };
  for (const p of chosen) {
    if (editor.model.sheet(p.stock, p.copy) !== sheet) return null;
    const b = editor.model.box(p);
    box.left = Math.min(box.left, b.left);
    box.right = Math.max(box.right, b.right);
    box.bottom = Math.min(box.bottom, b.bottom);
    box.top = Math.max(box.top, b.top);
  }
  const x = sheet.x + (box.left + box.right) / 2;
  const top = view.toScreen(x, sheet.y + box.top);
  return {
    top,
    at: [top[0], top[1] - HANDLE],
    middle: view.toScreen(x, sheet.y + (box.bottom + box.top) / 2),
    ids: chosen.map((p) => p.id),
  };
}

/** The part at a point of the picture; the last drawn of several. */
export function pick(editor: Editor, x: number, y: number): Placement | null {
  let found: Placement | null = null;
  for (const p of editor.model.placements.values()) {
    const sheet = editor.model.sheet(p.stock, p.copy);
    if (!sheet) continue;
    const [px, py] = [x - sheet.x, y - sheet.y];
    const box = editor.model.box(p);
    if (px < box.left || px > box.right || py < box.bottom || py > box.top) continue;
    if (contains(placedLoops(editor.model.part(p), p), px, py)) found = p;
  }
  return found;
}

/** The corner of a part or of the material near a point, or the point itself: measures go from corner to corner. */
function cornerNear(editor: Editor, view: View, world: Point): Point {
  const { model } = editor;
  const sheet = model.sheetAt(...world);
  if (!sheet) return world;
  const at: Point = [world[0] - sheet.x, world[1] - sheet.y];
  const reach = NEAR.mouse / view.scale;
  let best = reach;
  let found = at;
  const take = (loops: readonly Point[][]): void => {
    for (const loop of loops) {
      for (const corner of loop) {
        const d = Math.hypot(corner[0] - at[0], corner[1] - at[1]);
        if (d < best) [best, found] = [d, corner];
      }
    }
  };
  const around = { left: at[0] - reach, right: at[0] + reach, bottom: at[1] - reach, top: at[1] + reach };
  for (const p of model.placements.values()) {
    if (p.stock === sheet.stock.id && (p.copy ?? 0) === sheet.copy && boxesMeet(model.box(p), around))
      take(placedLoops(model.part(p), p));
  }
  if (sheet.stock.outline) take([sheet.stock.outline.polygon.outer, ...(sheet.stock.outline.polygon.holes ?? [])]);
  return [found[0] + sheet.x, found[1] + sheet.y];
}

/** Makes a direction near one of eight that one: a slide along a border that is a hair off would end at once. */
function straightened(from: Point, to: Point): Point {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const turn = Math.round(Math.atan2(dy, dx) / (Math.PI / 4));
  if (Math.abs(Math.atan2(dy, dx) - (turn * Math.PI) / 4) > 0.14) return to;
  const [ux, uy] = [
    [1, 0],
    [1, 1],
    [0, 1],
    [-1, 1],
    [-1, 0],
    [-1, -1],
    [0, -1],
    [1, -1],
  ][(turn + 8) % 8] as Point;
  const length = (dx * ux + dy * uy) / (ux * ux + uy * uy);
  return [from[0] + ux * length, from[1] + uy * length];
}

/** Shifts are whole steps, so two that differ by less than half a step are the same. */
const near = (a: number, b: number): boolean => Math.abs(a - b) < 2 ** -21;

/** The command that brings the parts in hand where they are shown, from wherever they are when its turn comes. */
export function droppedLine(editor: Editor, tool: Tool): () => string | null {
  const dropped = [...editor.moving.values()];
  return () => {
    const ids = dropped.map((p) => p.id);
    const now = editor.placementsOf(ids);
    const [to, from] = [dropped[0], now[0]];
    if (!to || !from || now.length !== dropped.length) return null;
    const [dx, dy] = [to.x - from.x, to.y - from.y];
    const together = now.every((p, i) => {
      const d = dropped[i]!;
      return (
        near(d.x - p.x, dx) &&
        near(d.y - p.y, dy) &&
        d.c === p.c &&
        d.s === p.s &&
        Boolean(d.mirrored) === Boolean(p.mirrored) &&
        p.stock === from.stock &&
        (p.copy ?? 0) === (from.copy ?? 0)
      );
    });
    if (!together) return null;
    const other =
      to.stock === from.stock && (to.copy ?? 0) === (from.copy ?? 0)
        ? undefined
        : editor.model.sheet(to.stock, to.copy);
    return tool === 'push' && !other
      ? line.push(ids, dx, dy)
      : tool === 'nearest'
        ? line.nearest(ids, dx, dy, other)
        : line.move(ids, dx, dy, other);
  };
}

type Gesture =
  | { kind: 'drag'; from: Point; ids: number[]; origin: Sheet; moved: boolean }
  | { kind: 'band' | 'pan' | 'measure'; from: Point }
  | { kind: 'flick'; from: Point; ids: number[] }
  | { kind: 'turn'; about: Point; from: number; ids: number[]; degrees: number };

export class PointerTool {
  readonly features: FeatureTool;
  readonly overlay: Overlay = { draft: [], band: null, ruler: null, arrow: null };
  private gesture: Gesture | null = null;
  private last: Point = [0, 0];
  private readonly fingers = new Map<number, Point>();
  spaceDown = false;

  constructor(
    private readonly element: HTMLElement,
    private readonly editor: Editor,
    private readonly view: View,
    private readonly redraw: (what: 'top' | 'view' | 'all') => void,
  ) {
    this.features = new FeatureTool(editor, view);
    element.addEventListener('dblclick', () => this.finishDraft());
    element.addEventListener('pointerdown', (e) => this.down(e));
    element.addEventListener('pointermove', (e) => this.move(e));
    element.addEventListener('pointerup', (e) => this.up(e));
    element.addEventListener('pointercancel', (e) => {
      this.fingers.delete(e.pointerId);
      this.cancel();
    });
    element.addEventListener(
      'wheel',
      (e) => {
        e.preventDefault();
        const [x, y] = this.at(e);
        if (e.shiftKey) view.pan(-e.deltaY, 0);
        else view.zoomAt(x, y, Math.exp(-e.deltaY * (e.deltaMode === 1 ? 0.05 : 0.0016)));
        redraw('view');
      },
      { passive: false },
    );
    element.addEventListener('contextmenu', (e) => e.preventDefault());
  }

  finishDraft(): void {
    this.features.finish();
    this.showDraft();
  }
  private showDraft(): void {
    const { moved } = this.features;
    const sheet = moved && this.editor.model.sheets.find((s) => s.stock.id === moved.feature.stock);
    const of =
      sheet && [...(sheet.stock.defects ?? []), ...(sheet.stock.zones ?? [])].find((f) => f.id === moved.feature.id);
    this.overlay.draft = of
      ? [...of.outline.polygon.outer, of.outline.polygon.outer[0]!].map(([x, y]): Point => [
          x + sheet.x + moved.by[0],
          y + sheet.y + moved.by[1],
        ])
      : this.features.shown();
    this.redraw('top');
  }

  cancel(): void {
    this.features.cancel();
    this.overlay.draft = [];
    if (this.gesture?.kind === 'drag' || this.gesture?.kind === 'turn') this.editor.release();
    this.gesture = null;
    this.overlay.band = this.overlay.ruler = this.overlay.arrow = null;
    this.redraw('top');
  }

  private at(e: MouseEvent): Point {
    const box = this.element.getBoundingClientRect();
    return [e.clientX - box.left, e.clientY - box.top];
  }

  private down(e: PointerEvent): void {
    this.element.focus();
    this.element.setPointerCapture(e.pointerId);
    const at = this.at(e);
    this.fingers.set(e.pointerId, at);
    this.last = at;
    if (this.fingers.size > 1) return this.cancel();
    const world = this.view.toWorld(...at);
    if (e.button === 1 || e.button === 2 || this.spaceDown || this.editor.tool === 'pan') {
      this.gesture = { kind: 'pan', from: at };
      return;
    }
    if (this.features.down(world)) return this.showDraft();
    if (this.editor.tool === 'measure') {
      const from = e.altKey ? world : cornerNear(this.editor, this.view, world);
      this.gesture = { kind: 'measure', from };
      this.overlay.ruler = { from, to: from };
      return;
    }
    const handle = turningHandle(this.editor, this.view);
    if (
      handle &&
      Math.hypot(at[0] - handle.at[0], at[1] - handle.at[1]) <= NEAR[e.pointerType === 'touch' ? 'touch' : 'mouse']
    ) {
      this.gesture = {
        kind: 'turn',
        about: handle.middle,
        from: Math.atan2(handle.middle[1] - at[1], at[0] - handle.middle[0]),
        ids: handle.ids,
        degrees: 0,
      };
      return;
    }
    const hit = pick(this.editor, ...world);
    if (!hit) {
      if (!e.shiftKey) this.editor.select([]);
      this.gesture = { kind: e.pointerType === 'touch' ? 'pan' : 'band', from: e.pointerType === 'touch' ? at : world };
      return;
    }
    const { selection } = this.editor;
    if (e.shiftKey || e.ctrlKey || e.metaKey) {
      const ids = new Set(selection);
      if (!ids.delete(hit.id)) ids.add(hit.id);
      this.editor.select(ids);
      return;
    }
    if (!selection.has(hit.id)) this.editor.select([hit.id]);
    const same = (p: Placement) => p.stock === hit.stock && (p.copy ?? 0) === (hit.copy ?? 0) && !p.locked;
    const ids = this.editor
      .placementsOf(this.editor.chosen())
      .filter(same)
      .map((p) => p.id);
    if (ids.length === 0) return;
    if (this.editor.tool === 'slide') this.gesture = { kind: 'flick', from: world, ids };
    else
      this.gesture = {
        kind: 'drag',
        from: world,
        ids,
        origin: this.editor.model.sheet(hit.stock, hit.copy)!,
        moved: false,
      };
  }

  private move(e: PointerEvent): void {
    const at = this.at(e);
    const before = this.fingers.get(e.pointerId);
    if (!before) return;
    if (this.fingers.size === 2) this.pinch(e.pointerId, before, at);
    this.fingers.set(e.pointerId, at);
    const gesture = this.gesture;
    const world = this.view.toWorld(...at);
    if (!gesture && this.fingers.size === 1) {
      this.features.move(world);
      this.showDraft();
    }
    switch (gesture?.kind) {
      case 'pan':
        this.view.pan(at[0] - this.last[0], at[1] - this.last[1]);
        this.redraw('view');
        break;
      case 'measure':
        this.overlay.ruler = { from: gesture.from, to: e.altKey ? world : cornerNear(this.editor, this.view, world) };
        this.redraw('top');
        break;
      case 'band':
        this.overlay.band = boxOf([gesture.from, world]);
        this.redraw('top');
        break;
      case 'flick':
        this.overlay.arrow = { from: gesture.from, to: e.altKey ? world : straightened(gesture.from, world) };
        this.redraw('top');
        break;
      case 'turn': {
        const angle = Math.atan2(gesture.about[1] - at[1], at[0] - gesture.about[0]) - gesture.from;
        gesture.degrees = this.turnOf(gesture.ids, (angle * 180) / Math.PI, e.shiftKey);
        try {
          const turned = this.editor.kernel.turned(gesture.ids, gesture.degrees);
          if (turned) this.editor.hold(turned, line.rotate(gesture.ids, gesture.degrees));
        } catch (error) {
          this.editor.say(error instanceof Error ? error.message : String(error));
        }
        break;
      }
      case 'drag': {
        if (!gesture.moved && Math.hypot(...this.offset(gesture.from, world)) * this.view.scale < 3) break;
        gesture.moved = true;
        const to = this.editor.model.sheetAt(...world) ?? gesture.origin;
        const dx = world[0] - gesture.from[0] + gesture.origin.x - to.x;
        const dy = world[1] - gesture.from[1] + gesture.origin.y - to.y;
        const other = to === gesture.origin ? undefined : to;
        const moved = movedBy(this.editor.placementsOf(gesture.ids), dx, dy, { stock: to.stock.id, copy: to.copy });
        this.editor.hold(moved, line.move(gesture.ids, dx, dy, other));
        break;
      }
    }
    this.last = at;
  }

  /**
   * Rounds a turn to tenths of a degree, or to the step of the toolbar. A part of few angles turns from one to the
   * next.
   */
  private turnOf(ids: readonly number[], degrees: number, stepped: boolean): number {
    const whole = ((((degrees + 180) % 360) + 360) % 360) - 180;
    const [first] = this.editor.placementsOf(ids);
    const angles = ids.length === 1 && first ? this.editor.model.part(first).rotations : undefined;
    if (first && angles && angles.every((a) => typeof a === 'number')) {
      const now = (Math.atan2(first.s, first.c) * 180) / Math.PI;
      const turns = angles.map((a) => Math.round((((((a - now + 540) % 360) + 360) % 360) - 180) * 1e6) / 1e6);
      const apart = (turn: number): number => Math.abs(((((turn - whole + 540) % 360) + 360) % 360) - 180);
      return turns.reduce((best, turn) => (apart(turn) < apart(best) ? turn : best), 0);
    }
    const step = stepped ? this.editor.rotateStep : 0.1;
    return Math.round(Math.round(whole / step) * step * 1e6) / 1e6;
  }

  private offset(a: Point, b: Point): Point {
    return [b[0] - a[0], b[1] - a[1]];
  }

  private pinch(id: number, before: Point, at: Point): void {
    const other = [...this.fingers].find(([key]) => key !== id)?.[1];
    if (!other) return;
    const [was, is] = [Math.hypot(...this.offset(other, before)), Math.hypot(...this.offset(other, at))];
    this.view.pan((at[0] - before[0]) / 2, (at[1] - before[1]) / 2);
    if (was > 1) this.view.zoomAt((other[0] + at[0]) / 2, (other[1] + at[1]) / 2, is / was);
    this.redraw('view');
  }

  private up(e: PointerEvent): void {
    this.fingers.delete(e.pointerId);
    this.features.up();
    this.showDraft();
    const gesture = this.gesture;
    this.gesture = null;
    const { band, arrow } = this.overlay;
    this.overlay.band = this.overlay.arrow = null;
    if (gesture?.kind === 'drag' && gesture.moved) void this.editor.command(droppedLine(this.editor, this.editor.tool));
    if (gesture?.kind === 'turn') {
      if (gesture.degrees !== 0) void this.editor.command(line.rotate(gesture.ids, gesture.degrees));
      else this.editor.release();
    }
    if (gesture?.kind === 'flick' && arrow) {
      const [dx, dy] = this.offset(arrow.from, arrow.to);
      const d = Math.hypot(dx, dy);
      if (d * this.view.scale > 6) void this.editor.command(line.slide(gesture.ids, dx / d, dy / d));
    }
    if (gesture?.kind === 'band' && band) {
      const inside = [...this.editor.model.placements.values()].filter((p) => {
        const sheet = this.editor.model.sheet(p.stock, p.copy);
        if (!sheet) return false;
        const b = this.editor.model.box(p);
        return boxesMeet(placedAt(b, sheet), band);
      });
      this.editor.select([...(e.shiftKey ? this.editor.selection : []), ...inside.map((p) => p.id)]);
    }
    this.redraw(gesture?.kind === 'pan' ? 'view' : 'top');
  }
}
