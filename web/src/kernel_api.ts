// Who decides what is allowed while a part is dragged. The WebAssembly kernel answers at once; without it the
// server is asked (its `preview`), and until it has answered the state is 'unknown', never 'clear'.

import type { FeatureChange, LayoutDocument, Placement, Point, Violation } from './document';
import type { Change } from './model';

export type Mode = 'strict' | 'free';
export type Level = 'clear' | 'gap' | 'forbidden' | 'unknown';
export interface Nearest { distance: number; from: Point; to: Point }
export interface LiveState { level: Level; violations: Violation[]; nearest: Nearest | null }
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
}
