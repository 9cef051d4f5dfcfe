// Outlines become paths of a canvas.

import type { Mark, Part, PartText, Point } from '../layout/document';

/** A part's outline by level of detail, in its own frame: level n drops corners nearer than 2^n / 8 mm to the last. */
export class Shape {
  /** The distance of the farthest corner from the origin, mm. */
  readonly reach: number;
  private readonly levels = new Map<number, Path2D>();
  constructor(private readonly loops: Point[][]) {
    this.reach = Math.max(...loops[0]!.map(([x, y]) => Math.hypot(x, y)));
  }
  at(mmPerPixel: number): Path2D {
    const level = Math.max(-1, Math.floor(Math.log2(mmPerPixel * 0.35 * 8)));
    let path = this.levels.get(level);
    if (!path) {
      path = tracedPath(this.loops, level < 0 ? 0 : 2 ** level / 8);
      this.levels.set(level, path);
    }
    return path;
  }
}

/** Loops as a path, without the corners that are nearer than `apart` mm to the one before. */
export function tracedPath(loops: readonly Point[][], apart: number): Path2D {
  const path = new Path2D();
  for (const loop of loops) {
    let [lx, ly] = loop[0]!;
    path.moveTo(lx, ly);
    loop.forEach(([x, y], i) => {
      if (i === 0 || Math.hypot(x - lx, y - ly) < apart) return;
      path.lineTo(x, y);
      [lx, ly] = [x, y];
    });
    path.closePath();
  }
  return path;
}

/** Marks as a path in the frame of their part, where y runs upwards. */
export function marksPath(marks: readonly Mark[]): Path2D {
  const path = new Path2D();
  for (const mark of marks) {
    const first = mark.edges[0]?.line ?? mark.edges[0]?.arc;
    if (first) path.moveTo(...first.from);
    for (const { line, arc } of mark.edges) {
      if (line) path.lineTo(...line.to);
      if (arc) {
        const angle = ([x, y]: Point): number => Math.atan2(y - arc.centre[1], x - arc.centre[0]);
        const radius = Math.hypot(arc.from[0] - arc.centre[0], arc.from[1] - arc.centre[1]);
        const begin = angle(arc.from);
        const whole = arc.from[0] === arc.to[0] && arc.from[1] === arc.to[1];
        const end = whole ? begin + (arc.ccw ? 2 : -2) * Math.PI : angle(arc.to);
        path.arc(...arc.centre, radius, begin, end, !arc.ccw);
      }
    }
  }
  return path;
}

/** Writes a text of a part in the part's frame, in which y goes up. */
export function drawPartText(ctx: CanvasRenderingContext2D, text: PartText): void {
  ctx.save();
  ctx.translate(...text.at);
  ctx.rotate(((text.deg ?? 0) * Math.PI) / 180);
  ctx.scale((text.mirrored ? -1 : 1) * (text.width_factor ?? 1), -1);
  // Capitals are 0.72 of a font's size.
  ctx.font = `${text.height / 0.72}px sans-serif`;
  ctx.textBaseline = 'alphabetic';
  ctx.textAlign = text.anchor === 'middle' ? 'center' : (text.anchor ?? 'left');
  ctx.fillText(text.text, 0, 0);
  ctx.restore();
}

export type Outlined = { polygon: { outer: Point[]; holes?: Point[][] } };
export const loopsOf = (o: Outlined): Point[][] => [o.polygon.outer, ...(o.polygon.holes ?? [])];

/** The way one can go from a point of a part, to either side along a direction, without leaving the part, mm. */
export function roomAlong(part: Part, [x, y]: Point, [dx, dy]: Point): number {
  let room = Infinity;
  for (const loop of loopsOf(part.outline)) {
    let [ax, ay] = loop.at(-1)!;
    for (const [bx, by] of loop) {
      // The heights of both ends of the edge over the line.
      const [ha, hb] = [dx * (ay - y) - dy * (ax - x), dx * (by - y) - dy * (bx - x)];
      if (ha > 0 !== hb > 0) {
        const k = ha / (ha - hb);
        room = Math.min(room, Math.abs(dx * (ax + k * (bx - ax) - x) + dy * (ay + k * (by - ay) - y)));
      }
      [ax, ay] = [bx, by];
    }
  }
  return room;
}
