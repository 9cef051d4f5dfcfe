// Who decides what is allowed while a part is dragged. The WebAssembly kernel answers at once; without it the
// server is asked (its `preview`), and until it has answered the state is 'unknown', never 'clear'.

import type { FeatureChange, LayoutDocument, Placement, Point, Violation } from '../layout/document';
import type { Change } from '../layout/model';

export type Mode = 'strict' | 'free';
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
/// What a look at some placements found: every violation that one of them has a part in, but for those with one
/// that is still to be looked at.
export interface Looked {
  left: number;
  ids: number[];
  violations: Violation[];
}
/// How many of a kit are complete, and what those lack that are wanted and not complete; `mirrored` absent: either hand.
export interface KitCount {
  kit: string;
  wanted: number;
  complete: number;
  missing: { part: string; count: number; mirrored?: boolean }[];
}
export const UNKNOWN: LiveState = { level: 'unknown', violations: [], nearest: null };

export interface Kernel {
  /// Says whether `state` answers within the call.
  readonly immediate: boolean;
  open(document: LayoutDocument): void;
  apply(changes: readonly Change[], nextId: number, features: readonly FeatureChange[]): void;
  /// What would be so if these placements stood instead of those with their ids. \p text: the command that
  /// would bring it about.
  /// \p depths: how deep overlaps are, too; at each move of the pointer that would take too long.
  state(placements: readonly Placement[], text: string, reach: number, depths: boolean): LiveState | Promise<LiveState>;
  /// Cosine and sine on the grid; null: not known here.
  rotation(degrees: number): { c: number; s: number } | null;
  /// Where `rotate` would put these placements; null: not known here.
  turned(ids: readonly number[], degrees: number): Placement[] | null;
  /// Every violation of the layout; null: not known here.
  check(): Violation[] | null;
  /// The same a few placements at a time: of those that changed since they were looked at.
  checkSome(most: number): Looked | null;
  /// By kit, as `lekalo show` counts; null: not known here.
  kits(): KitCount[] | null;
}
