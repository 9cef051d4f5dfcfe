// Defects and zones by hand: they are drawn point by point or in one stroke, and moved by dragging. The photograph of a
// hide beneath them is brought to scale by two points.

import * as line from '../layout/commands';
import type { Point } from '../layout/document';
import type { Editor, Feature } from '../editor/editor';
import { contains, type Sheet } from '../layout/model';
import type { Photo } from '../editor/photo';
import type { View } from '../picture/view';

/**
 * Pixels between two points of a stroke; about the first point, where a press closes the outline; of the shortest
 * movement that is a stroke and no press.
 */
const STROKE_STEP = 4;
const CLOSE = 9;
const LEAST_STROKE = 24;

export class FeatureTool {
  /** The corners of the outline so far, in the picture's mm. */
  draft: Point[] = [];
  private sheet: Sheet | null = null;
  private stroke: Point[] | null = null;
  private moving: { feature: Feature; from: Point; by: Point } | null = null;
  private pulling: { photo: Photo; sheet: Sheet; from: Point } | null = null;

  constructor(
    private readonly editor: Editor,
    private readonly view: View,
  ) {}

  get draws(): 'defect' | 'zone' | null {
    const { tool } = this.editor;
    return tool === 'defect' || tool === 'zone' ? tool : null;
  }
  /** The feature in hand, and how far it has been moved. */
  get moved(): { feature: Feature; by: Point } | null {
    return this.moving;
  }

  /** @returns whether the press is for this tool */
  down(world: Point): boolean {
    if (this.editor.tool === 'photo') {
      const sheet =
        this.editor.model.sheetAt(...world) ??
        this.editor.model.sheets.find((one) => this.editor.photos.get(one.stock.id));
      const photo = sheet && this.editor.photos.get(sheet.stock.id);
      if (photo) this.pulling = { photo, sheet, from: [world[0] - sheet.x, world[1] - sheet.y] };
      return true;
    }
    const kind = this.draws;
    if (!kind) return false;
    if (this.draft.length === 0) {
      this.sheet = this.editor.model.sheetAt(...world) ?? null;
      if (!this.sheet) return true;
      const hit = this.hit(kind, this.sheet, world);
      if (hit) {
        this.moving = { feature: hit, from: world, by: [0, 0] };
        return true;
      }
    }
    if (this.draft.length >= 3 && this.pixels(this.draft[0]!, world) < CLOSE) {
      this.finish();
      return true;
    }
    this.stroke = [world];
    return true;
  }

  move(world: Point): void {
    if (this.pulling) {
      const { photo, sheet, from } = this.pulling;
      photo.pull(from, [world[0] - sheet.x, world[1] - sheet.y]);
      this.editor.photos.changed();
    }
    if (this.moving) this.moving.by = [world[0] - this.moving.from[0], world[1] - this.moving.from[1]];
    if (this.stroke && this.pixels(this.stroke.at(-1)!, world) >= STROKE_STEP) this.stroke.push(world);
  }

  up(): void {
    if (this.pulling) {
      const { photo } = this.pulling;
      this.pulling = null;
      if (photo.pin()) void this.editor.photos.keep(photo);
    }
    if (this.moving) {
      const { feature, by } = this.moving;
      this.moving = null;
      if (Math.hypot(...by) * this.view.scale > 3) void this.editor.command(line.moveFeature(feature, ...by));
    }
    if (!this.stroke) return;
    const stroke = this.stroke;
    this.stroke = null;
    const length = stroke.reduce((sum, p, i) => (i === 0 ? 0 : sum + this.pixels(stroke[i - 1]!, p)), 0);
    if (length < LEAST_STROKE) {
      this.draft.push(stroke[0]!);
      return;
    }
    this.draft.push(...stroke);
    this.finish();
  }

  /** The outline so far, with the stroke under way. */
  shown(): Point[] {
    return [...this.draft, ...(this.stroke ?? [])];
  }

  finish(): void {
    const kind = this.draws;
    const { sheet, draft } = this;
    this.draft = [];
    if (!kind || !sheet || draft.length < 3) return;
    const list = (kind === 'defect' ? sheet.stock.defects : sheet.stock.zones) ?? [];
    let n = list.length + 1;
    while (list.some((f) => f.id === `${kind} ${n}`)) ++n;
    const outline = draft.map(([x, y]): Point => [x - sheet.x, y - sheet.y]);
    void this.editor.command(
      line.addFeature({ stock: sheet.stock.id, kind, id: `${kind} ${n}` }, this.editor.grades[kind], outline),
    );
  }
  back(): boolean {
    return this.draft.pop() !== undefined;
  }
  cancel(): void {
    this.draft = [];
    this.stroke = this.moving = this.pulling = null;
  }

  private hit(kind: 'defect' | 'zone', sheet: Sheet, [x, y]: Point): Feature | null {
    const list = (kind === 'defect' ? sheet.stock.defects : sheet.stock.zones) ?? [];
    const at: Point = [x - sheet.x, y - sheet.y];
    for (const f of [...list].reverse()) {
      const { outer, holes = [] } = f.outline.polygon;
      // A zone is taken by its edge, as others are drawn within it.
      if (kind === 'defect' ? contains([outer, ...holes], ...at) : this.nearEdge(outer, at))
        return { stock: sheet.stock.id, kind, id: f.id };
    }
    return null;
  }
  private nearEdge(loop: readonly Point[], [x, y]: Point): boolean {
    return loop.some(([bx, by], i) => {
      const [ax, ay] = loop.at(i - 1)!;
      const [dx, dy] = [bx - ax, by - ay];
      const along = Math.max(0, Math.min(1, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1)));
      return Math.hypot(x - ax - along * dx, y - ay - along * dy) * this.view.scale < CLOSE;
    });
  }
  private pixels(a: Point, b: Point): number {
    return Math.hypot(a[0] - b[0], a[1] - b[1]) * this.view.scale;
  }
}

/** Lays a photograph beneath the sheet in the middle of the view. */
export async function photoBeneath(editor: Editor, view: View, file: File): Promise<void> {
  const sheet = editor.model.sheetAt(...view.toWorld(view.width / 2, view.height / 2)) ?? editor.model.sheets[0];
  if (sheet) await editor.photos.add(sheet.stock.id, sheet.box, file);
}
