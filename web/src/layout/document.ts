// The format lekalo-layout/1 of docs/formats.md.

export type Point = [number, number];
export interface Outline {
  polygon: { outer: Point[]; holes?: Point[][] };
}
export interface Defect {
  id: string;
  severity?: number;
  outline: Outline;
}
export interface Zone {
  id: string;
  quality: number;
  outline: Outline;
}
/** The change of a defect or zone in a change message (docs/protocol.md). */
export interface FeatureChange {
  stock: string;
  kind: 'defect' | 'zone';
  id: string;
  index: number;
  after: Defect | Zone | null;
}
export interface Stock {
  id: string;
  name?: string;
  material?: string;
  thickness?: number;
  kind: 'strip' | 'sheet' | 'hide';
  count?: number;
  height?: number;
  length?: number;
  outline?: Outline;
  grain_deg?: number;
  defects?: Defect[];
  zones?: Zone[];
}
/** An edge of a mark; arcs run about their centre from one end to the other. */
export interface Edge {
  line?: { from: Point; to: Point };
  arc?: { from: Point; to: Point; centre: Point; ccw: boolean };
}
/** A line on a part that bounds no area: engraving, a hinge, a bend. */
export interface Mark {
  layer?: string;
  /** As the drawing shows it, #rrggbb. */
  colour?: string;
  role?: 'mark' | 'engrave' | 'bend' | 'cut';
  edges: Edge[];
}
/** A line of text on a part, of capitals so high, written backwards where it is mirrored. */
export interface PartText {
  text: string;
  at: Point;
  height: number;
  deg?: number;
  width_factor?: number;
  mirrored?: boolean;
  anchor?: 'left' | 'middle' | 'right';
  layer?: string;
  colour?: string;
  role?: Mark['role'];
}
export interface Part {
  id: string;
  name?: string;
  material?: string;
  thickness?: number;
  customer?: string;
  due?: string;
  label?: string;
  outline: Outline;
  quality?: number | 'best';
  areas?: { quality: number | 'best'; outline: Outline }[];
  marks?: Mark[];
  texts?: PartText[];
  rotations?: (number | { from: number; to: number })[];
  mirror?: boolean;
  grain?: { deg: number; tolerance_deg?: number };
  tolerated_severity?: number;
  demand?: number;
  gap?: number;
  border_gap?: number;
  defect_gap?: number;
}
export interface Piece {
  part: string;
  count?: number;
  mirrored?: boolean;
}
export interface Kit {
  id: string;
  name?: string;
  demand?: number;
  value?: number;
  pieces: Piece[];
}
export interface Placement {
  id: number;
  part: string;
  stock: string;
  copy?: number;
  c: number;
  s: number;
  x: number;
  y: number;
  mirrored?: boolean;
  locked?: boolean;
}
export interface LayoutDocument {
  format: 'lekalo-layout/1';
  units: string;
  name?: string;
  rules?: { gap?: number; border_gap?: number; defect_gap?: number; kerf?: number };
  stocks?: Stock[];
  parts?: Part[];
  kits?: Kit[];
  placements?: Placement[];
  next_id?: number;
}
/** The kinds in the order of layout::ViolationKind, in which the check names them; a test holds the two together. */
export const VIOLATION_KINDS = [
  'overlap',
  'gap',
  'outside',
  'border-gap',
  'defect',
  'defect-gap',
  'quality',
  'rotation',
  'mirror',
  'grain',
  'stock',
] as const;
export type ViolationKind = (typeof VIOLATION_KINDS)[number];
export interface Violation {
  kind: ViolationKind;
  a: number;
  b: number | null;
  stock: string;
  copy: number;
  amount_mm: number;
  at: Point;
  direction?: Point | null;
  feature?: string;
}
/** Says whether a kind is "too near" rather than "forbidden". */
export const isGap = (kind: ViolationKind): boolean => kind === 'gap' || kind === 'border-gap' || kind === 'defect-gap';
