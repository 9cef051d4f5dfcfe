// Mouse, pen and fingers on the picture.

import * as line from '../commands';
import type { Placement, Point } from '../document';
import { movedBy, type Editor } from '../editor';
import { boxesMeet, boxOf, contains, placedLoops, type Box, type Sheet } from '../model';
import type { View } from '../view';

export interface Overlay { band: Box | null; ruler: { from: Point; to: Point } | null; arrow: { from: Point; to: Point } | null }

/// The part at a point of the picture; the last drawn of several.
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

type Gesture =
  | { kind: 'drag'; from: Point; ids: number[]; origin: Sheet; text: string; moved: boolean }
  | { kind: 'band' | 'pan' | 'measure'; from: Point }
  | { kind: 'flick'; from: Point; ids: number[] };

export class PointerTool {
  readonly overlay: Overlay = { band: null, ruler: null, arrow: null };
  private gesture: Gesture | null = null;
  private last: Point = [0, 0];
  private readonly fingers = new Map<number, Point>();
  spaceDown = false;

  constructor(private readonly element: HTMLElement, private readonly editor: Editor, private readonly view: View, private readonly redraw: (all: boolean) => void) {
    element.addEventListener('pointerdown', (e) => this.down(e));
    element.addEventListener('pointermove', (e) => this.move(e));
    element.addEventListener('pointerup', (e) => this.up(e));
    element.addEventListener('pointercancel', (e) => {
      this.fingers.delete(e.pointerId);
      this.cancel();
    });
    element.addEventListener('wheel', (e) => {
      e.preventDefault();
      const [x, y] = this.at(e);
      if (e.shiftKey) view.pan(-e.deltaY, 0);
      else view.zoomAt(x, y, Math.exp(-e.deltaY * (e.deltaMode === 1 ? 0.05 : 0.0016)));
      redraw(true);
    }, { passive: false });
    element.addEventListener('contextmenu', (e) => e.preventDefault());
  }

  cancel(): void {
    if (this.gesture?.kind === 'drag') this.editor.release();
    this.gesture = null;
    this.overlay.band = this.overlay.ruler = this.overlay.arrow = null;
    this.redraw(true);
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
    if (this.editor.tool === 'measure') {
      this.gesture = { kind: 'measure', from: world };
      this.overlay.ruler = { from: world, to: world };
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
    const ids = this.editor.placementsOf(this.editor.chosen()).filter(same).map((p) => p.id);
    if (ids.length === 0) return;
    if (this.editor.tool === 'slide') this.gesture = { kind: 'flick', from: world, ids };
    else this.gesture = { kind: 'drag', from: world, ids, origin: this.editor.model.sheet(hit.stock, hit.copy)!, text: '', moved: false };
  }

  private move(e: PointerEvent): void {
    const at = this.at(e);
    const before = this.fingers.get(e.pointerId);
    if (!before) return;
    if (this.fingers.size === 2) this.pinch(e.pointerId, before, at);
    this.fingers.set(e.pointerId, at);
    const gesture = this.gesture;
    const world = this.view.toWorld(...at);
    switch (gesture?.kind) {
      case 'pan':
        this.view.pan(at[0] - this.last[0], at[1] - this.last[1]);
        this.redraw(true);
        break;
      case 'measure':
        this.overlay.ruler = { from: gesture.from, to: world };
        this.redraw(false);
        break;
      case 'band':
        this.overlay.band = boxOf([gesture.from, world]);
        this.redraw(false);
        break;
      case 'flick':
        this.overlay.arrow = { from: gesture.from, to: world };
        this.redraw(false);
        break;
      case 'drag': {
        if (!gesture.moved && Math.hypot(...this.offset(gesture.from, world)) * this.view.scale < 3) break;
        gesture.moved = true;
        const to = this.editor.model.sheetAt(...world) ?? gesture.origin;
        const dx = world[0] - gesture.from[0] + gesture.origin.x - to.x;
        const dy = world[1] - gesture.from[1] + gesture.origin.y - to.y;
        const other = to === gesture.origin ? undefined : to;
        gesture.text = this.editor.tool === 'push' && !other ? line.push(gesture.ids, dx, dy)
          : this.editor.tool === 'nearest' ? line.nearest(gesture.ids, dx, dy, other) : line.move(gesture.ids, dx, dy, other);
        const moved = movedBy(this.editor.placementsOf(gesture.ids), dx, dy, { stock: to.stock.id, copy: to.copy });
        this.editor.hold(moved, line.move(gesture.ids, dx, dy, other));
        break;
      }
    }
    this.last = at;
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
    this.redraw(true);
  }

  private up(e: PointerEvent): void {
    this.fingers.delete(e.pointerId);
    const gesture = this.gesture;
    this.gesture = null;
    const { band, arrow } = this.overlay;
    this.overlay.band = this.overlay.arrow = null;
    if (gesture?.kind === 'drag' && gesture.moved) void this.editor.command(gesture.text);
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
        return boxesMeet({ left: b.left + sheet.x, right: b.right + sheet.x, bottom: b.bottom + sheet.y, top: b.top + sheet.y }, band);
      });
      this.editor.select([...(e.shiftKey ? this.editor.selection : []), ...inside.map((p) => p.id)]);
    }
    this.redraw(gesture?.kind === 'pan');
  }
}
