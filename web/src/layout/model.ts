// The layout as the page holds it: the document, its placements by id, and the place of every sheet in the picture.

import type { Defect, FeatureChange, LayoutDocument, Part, Placement, Point, Stock, Zone } from './document';
import { mmFromSteps, placedVertex, rotationFromPair, stepsFromMm } from './grid';

export interface Box {
  left: number;
  bottom: number;
  right: number;
  top: number;
}
export interface Change {
  id: number;
  after: Placement | null;
}
/** A copy of a stock, and the place of its frame's origin in the picture, mm. */
export interface Sheet {
  stock: Stock;
  copy: number;
  x: number;
  y: number;
  box: Box;
}

export function boxOf(points: Iterable<Point>): Box {
  const box = { left: Infinity, bottom: Infinity, right: -Infinity, top: -Infinity };
  for (const [x, y] of points) {
    box.left = Math.min(box.left, x);
    box.right = Math.max(box.right, x);
    box.bottom = Math.min(box.bottom, y);
    box.top = Math.max(box.top, y);
  }
  return box;
}
export const boxesMeet = (a: Box, b: Box): boolean =>
  a.left <= b.right && b.left <= a.right && a.bottom <= b.top && b.bottom <= a.top;
export const placedAt = (b: Box, s: { x: number; y: number }): Box => ({
  left: b.left + s.x,
  right: b.right + s.x,
  bottom: b.bottom + s.y,
  top: b.top + s.y,
});
export const sheetKey = (stock: string, copy: number): string => `${copy} ${stock}`;

/** The loops of a placed part by rule 4 of docs/design/layout.md, mm. They are exact: doubles hold steps below 2^40. */
export function placedLoops(part: Part, p: Placement): Point[][] {
  const rotation = rotationFromPair(p.c, p.s);
  const tx = stepsFromMm(p.x);
  const ty = stepsFromMm(p.y);
  const { outer, holes = [] } = part.outline.polygon;
  return [outer, ...holes].map((loop) =>
    loop.map(([x, y]) => {
      const [sx, sy] = placedVertex(stepsFromMm(x), stepsFromMm(y), rotation, tx, ty, p.mirrored ?? false);
      return [mmFromSteps(sx), mmFromSteps(sy)];
    }),
  );
}

/** The box of a placed part in doubles: for drawing and culling, never for a decision. */
export function placedBox(part: Part, p: Placement): Box {
  const flip = p.mirrored ? -1 : 1;
  return boxOf(
    part.outline.polygon.outer.map(([x, y]): Point => [p.c * flip * x - p.s * y + p.x, p.s * flip * x + p.c * y + p.y]),
  );
}

/** Says whether a point lies in loops by the even-odd rule, in doubles: for picking with the mouse. */
export function contains(loops: readonly Point[][], x: number, y: number): boolean {
  let inside = false;
  for (const loop of loops) {
    for (let i = 0, j = loop.length - 1; i < loop.length; j = i++) {
      const [ax, ay] = loop[i]!;
      const [bx, by] = loop[j]!;
      if (ay > y !== by > y && x < ((bx - ax) * (y - ay)) / (by - ay) + ax) inside = !inside;
    }
  }
  return inside;
}

/**
 * A point well within loops, for captions. Of a lattice over their box it takes a point far from every edge and not far
 * from the middle.
 *
 * @param within loops in which the point lies, too; none: the first alone count
 */
export function innerPoint(loops: readonly Point[][], within: readonly Point[][] = []): Point {
  const box = boxOf(loops[0]!);
  if (within.length > 0) {
    const other = boxOf(within[0]!);
    box.left = Math.max(box.left, other.left);
    box.right = Math.min(box.right, other.right);
    box.bottom = Math.max(box.bottom, other.bottom);
    box.top = Math.min(box.top, other.top);
  }
  const LATTICE = 20;
  const middle: Point = [(box.left + box.right) / 2, (box.bottom + box.top) / 2];
  let best = middle;
  let most = -Infinity;
  const edges = [...loops, ...within];
  for (let i = 1; i < LATTICE; ++i) {
    for (let j = 1; j < LATTICE; ++j) {
      const x = box.left + ((box.right - box.left) * i) / LATTICE;
      const y = box.bottom + ((box.top - box.bottom) * j) / LATTICE;
      if (!contains(loops, x, y) || (within.length > 0 && !contains(within, x, y))) continue;
      let near = Infinity;
      for (const loop of edges) {
        for (let k = 0, l = loop.length - 1; k < loop.length; l = k++) {
          const [ax, ay] = loop[l]!;
          const [dx, dy] = [loop[k]![0] - ax, loop[k]![1] - ay];
          const along = Math.max(0, Math.min(1, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1)));
          near = Math.min(near, (x - ax - along * dx) ** 2 + (y - ay - along * dy) ** 2);
        }
      }
      const good = Math.sqrt(near) - 0.12 * Math.hypot(x - middle[0], y - middle[1]);
      // The first of equally good points is taken: the slack keeps roundings from choosing.
      if (good > most + 1e-6) {
        most = good;
        best = [x, y];
      }
    }
  }
  return best;
}

export class Model {
  readonly parts = new Map<string, Part>();
  readonly stocks = new Map<string, Stock>();
  readonly placements = new Map<number, Placement>();
  sheets: Sheet[] = [];
  nextId: number;
  /** Counts the changes of defects and zones. */
  features = 0;
  private readonly boxes = new Map<number, { of: Placement; box: Box }>();
  private sheetOf = new Map<string, Sheet>();

  constructor(readonly document: LayoutDocument) {
    for (const part of document.parts ?? []) this.parts.set(part.id, part);
    for (const stock of document.stocks ?? []) this.stocks.set(stock.id, stock);
    for (const p of document.placements ?? []) this.placements.set(p.id, p);
    this.nextId = document.next_id ?? Math.max(0, ...[...this.placements.keys()]) + 1;
    this.arrangeSheets();
  }

  part(p: Placement): Part {
    const part = this.parts.get(p.part);
    if (!part) throw new Error(`placement ${p.id}: no part "${p.part}"`);
    return part;
  }

  /** The box of a placement in the frame of its sheet. */
  box(p: Placement): Box {
    const known = this.boxes.get(p.id);
    if (known?.of === p) return known.box;
    const box = placedBox(this.part(p), p);
    if (this.placements.get(p.id) === p) this.boxes.set(p.id, { of: p, box });
    return box;
  }

  gap(p: Placement): number {
    return this.part(p).gap ?? this.document.rules?.gap ?? 0;
  }

  sheet(stock: string, copy = 0): Sheet | undefined {
    return this.sheetOf.get(sheetKey(stock, copy));
  }

  sheetAt(x: number, y: number): Sheet | undefined {
    return this.sheets.find(
      (s) => x >= s.x + s.box.left && x <= s.x + s.box.right && y >= s.y + s.box.bottom && y <= s.y + s.box.top,
    );
  }

  apply(changes: readonly Change[], nextId?: number, features: readonly FeatureChange[] = []): void {
    let sheets = false;
    for (const change of features) this.applyFeature(change);
    for (const { id, after } of changes) {
      const before = this.placements.get(id);
      if (after) this.placements.set(id, after);
      else this.placements.delete(id);
      this.boxes.delete(id);
      if (
        before?.stock !== after?.stock ||
        before?.copy !== after?.copy ||
        this.stocks.get(after?.stock ?? '')?.kind === 'strip'
      )
        sheets = true;
    }
    if (nextId !== undefined) this.nextId = nextId;
    if (sheets) this.arrangeSheets();
  }

  private applyFeature({ stock: name, kind, id, index, after }: FeatureChange): void {
    const stock = this.stocks.get(name);
    if (!stock) return;
    const list: (Defect | Zone)[] = [...((kind === 'defect' ? stock.defects : stock.zones) ?? [])];
    const at = list.findIndex((f) => f.id === id);
    if (!after) list.splice(at, at < 0 ? 0 : 1);
    else if (at >= 0) list[at] = after;
    else list.splice(Math.min(index, list.length), 0, after);
    if (kind === 'defect') stock.defects = list;
    else stock.zones = list as Zone[];
    this.features += 1;
  }

  /**
   * Lays out the sheets in use, and one empty copy of each stock that has one left, side by side from left to right.
   */
  private arrangeSheets(): void {
    const used = new Map<string, number>();
    const reach = new Map<string, number>();
    for (const p of this.placements.values()) {
      used.set(p.stock, Math.max(used.get(p.stock) ?? -1, p.copy ?? 0));
      if (this.stocks.get(p.stock)?.kind === 'strip') {
        reach.set(p.stock, Math.max(reach.get(p.stock) ?? 0, this.box(p).right));
      }
    }
    this.sheets = [];
    this.sheetOf = new Map();
    let x = 0;
    for (const stock of this.stocks.values()) {
      const last = Math.max(used.get(stock.id) ?? -1, Math.min((stock.count ?? 1) - 1, (used.get(stock.id) ?? -1) + 1));
      for (let copy = 0; copy <= last; ++copy) {
        const box = stock.outline
          ? boxOf(stock.outline.polygon.outer)
          : {
              left: 0,
              bottom: 0,
              top: stock.height ?? 1,
              right: stock.length ?? Math.max(stock.height ?? 1, (reach.get(stock.id) ?? 0) * 1.1),
            };
        const sheet = { stock, copy, x: x - box.left, y: -box.bottom, box };
        this.sheets.push(sheet);
        this.sheetOf.set(sheetKey(stock.id, copy), sheet);
        x += (box.right - box.left) * 1.04 + 20;
      }
    }
  }

  /** The number of each part on the sheets, upright and mirrored. */
  counts(): Map<string, { upright: number; mirrored: number }> {
    const counts = new Map<string, { upright: number; mirrored: number }>();
    for (const id of this.parts.keys()) counts.set(id, { upright: 0, mirrored: 0 });
    for (const p of this.placements.values()) {
      const count = counts.get(p.part);
      if (count) count[p.mirrored ? 'mirrored' : 'upright'] += 1;
    }
    return counts;
  }

  /** The number of a part that is wanted, by itself and in kits. */
  wanted(part: string): number {
    let sum = this.parts.get(part)?.demand ?? 0;
    for (const kit of this.document.kits ?? []) {
      for (const piece of kit.pieces) if (piece.part === part) sum += (piece.count ?? 1) * (kit.demand ?? 1);
    }
    return sum;
  }

  extent(): Box {
    const box = { left: 0, bottom: 0, right: 1, top: 1 };
    for (const s of this.sheets) {
      box.left = Math.min(box.left, s.x + s.box.left);
      box.right = Math.max(box.right, s.x + s.box.right);
      box.bottom = Math.min(box.bottom, s.y + s.box.bottom);
      box.top = Math.max(box.top, s.y + s.box.top);
    }
    return box;
  }
}
