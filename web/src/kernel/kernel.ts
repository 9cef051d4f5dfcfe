// The kernel decides what is allowed while a part is dragged. The WebAssembly kernel answers at once; without it the
// server is asked (its `preview`), and until it has answered the state is 'unknown', never 'clear'.

import type { FeatureChange, LayoutDocument, Placement, Point, Violation } from '../layout/document';
import type { Change } from '../layout/model';

export type Level = 'clear' | 'gap' | 'forbidden' | 'unknown';
export interface Nearest {
  distance: number;
  from: Point;
  to: Point;
}
export interface LiveState {
  level: Level;
  violations: Violation[];
  nearest: Nearest | null;
}
/** The answer to a look at some placements. */
export interface Looked {
  /** The number of placements that are still to be looked at. */
  left: number;
  /** The placements that were looked at. */
  ids: number[];
  /** Every violation that one of them has a part in, but for those with a placement still to be looked at. */
  violations: Violation[];
}
/** The complete kits of one kind, and the pieces that the wanted ones still lack. */
export interface KitCount {
  kit: string;
  wanted: number;
  complete: number;
  /** Either hand will do where `mirrored` is absent. */
  missing: { part: string; count: number; mirrored?: boolean }[];
}
export const UNKNOWN: LiveState = { level: 'unknown', violations: [], nearest: null };

export interface Kernel {
  /** Says whether `state` answers within the call. */
  readonly immediate: boolean;
  /** Throws the reader's sentence where the document is none. */
  open(document: LayoutDocument): void;
  apply(changes: readonly Change[], nextId: number, features: readonly FeatureChange[]): void;
  /**
   * Tells what would be so if these placements stood in place of those with their ids.
   *
   * @param text the command that would bring it about
   * @param reach how far the line to the nearest part looks, mm; 0: it is not asked for
   * @param depths whether overlaps are measured, too; at each move of the pointer that would take too long
   */
  state(placements: readonly Placement[], text: string, reach: number, depths: boolean): LiveState | Promise<LiveState>;
  /** Cosine and sine on the grid; null: this kernel does not know them. */
  rotation(degrees: number): { c: number; s: number } | null;
  /** The places that `rotate` would give these placements; null: this kernel does not know. */
  turned(ids: readonly number[], degrees: number): Placement[] | null;
  /** Every violation of the layout; null: this kernel does not know. */
  check(): Violation[] | null;
  /** Looks at up to `most` of the placements that have changed since they were looked at. */
  checkSome(most: number): Looked | null;
  /** The count of each kit, as `lekalo show` counts; null: this kernel does not know. */
  kits(): KitCount[] | null;
}
