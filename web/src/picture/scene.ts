// The contents of the picture, and its colours.

import type { Photos } from '../editor/photos';
import type { LiveState } from '../kernel/kernel';
import type { Placement, Point, Violation } from '../layout/document';
import type { Box, Model } from '../layout/model';
import type { View } from './view';

/** The colours of the picture. */
export interface Theme {
  back: string;
  material: string;
  edge: string;
  ink: string;
  faint: string;
  hole: string;
  defect: string;
  zone: string;
  select: string;
  bad: string;
  near: string;
  good: string;
  partLight: number;
  partSat: number;
  partInk: string;
  other: string;
}
export const LIGHT: Theme = {
  back: '#e9ebee',
  material: '#fbfaf7',
  edge: '#59616b',
  ink: '#1d232b',
  faint: '#8a929c',
  hole: '#d5d9de',
  defect: '#7d3c98',
  zone: '#a8793a',
  select: '#0b63ce',
  bad: '#c81e1e',
  near: '#b86e00',
  good: '#16794c',
  partLight: 84,
  partSat: 42,
  partInk: '#2c3540',
  other: '#7a4bd0',
};
export const DARK: Theme = {
  back: '#15181c',
  material: '#23282e',
  edge: '#8f99a5',
  ink: '#e8ecf1',
  faint: '#77818d',
  hole: '#15181c',
  defect: '#c58be0',
  zone: '#c79a5a',
  select: '#5aa7ff',
  bad: '#ff6b6b',
  near: '#ffb545',
  good: '#4cc38a',
  partLight: 36,
  partSat: 28,
  partInk: '#dfe5ec',
  other: '#b495f5',
};

/** Everything that the picture shows. */
export interface Scene {
  model: Model;
  view: View;
  theme: Theme;
  selection: ReadonlySet<number>;
  others: ReadonlySet<number>;
  violations: readonly Violation[];
  /** The placements in hand. */
  moving: ReadonlyMap<number, Placement>;
  /** The kernel's word on the placements in hand. */
  live: LiveState | null;
  /** The places that parts will have once a command has been carried out that is still under way. */
  coming: ReadonlyMap<number, Placement>;
  /** The box that a hand draws to choose parts. */
  band: Box | null;
  /** The outline that is being drawn. */
  draft: readonly Point[];
  photos: Pick<Photos, 'get' | 'count'>;
  /** The points about which photographs turn. */
  pins: readonly Point[];
  ruler: { from: Point; to: Point } | null;
  arrow: { from: Point; to: Point } | null;
  /** The handle that turns the chosen parts, pixels; null: they are in hand, or none is chosen. */
  handle: { at: Point; top: Point } | null;
  show: { labels: boolean; grain: boolean; gap: boolean; zones: boolean };
}
