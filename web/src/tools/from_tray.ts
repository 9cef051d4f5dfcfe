// A part is pulled out of the tray by hand: it hangs at the pointer with its live state, and is placed where it is
// dropped.

import * as line from '../layout/commands';
import type { Part, Placement } from '../layout/document';
import type { Editor } from '../editor/editor';
import { snapToGrid } from '../layout/grid';
import { placedBox } from '../layout/model';
import type { View } from '../picture/view';

/** A press becomes a drag after so many pixels. */
const SLACK = 5;

/** @param onto the picture */
export function dragFromTray(
  button: HTMLElement,
  onto: HTMLElement,
  editor: Editor,
  view: View,
  part: Part,
  mirrored: boolean,
): void {
  let from: [number, number] | null = null;
  let held: Placement | null = null;
  let dragged = false;
  let turn: { c: number; s: number } | null = null;
  const end = (): void => {
    from = held = turn = null;
    editor.release();
  };
  button.addEventListener('pointerdown', (e) => {
    if (e.button !== 0) return;
    from = [e.clientX, e.clientY];
    dragged = false;
    button.setPointerCapture(e.pointerId);
  });
  button.addEventListener('pointermove', (e) => {
    if (!from || (!dragged && Math.hypot(e.clientX - from[0], e.clientY - from[1]) < SLACK)) return;
    dragged = true;
    const box = onto.getBoundingClientRect();
    const world = view.toWorld(e.clientX - box.left, e.clientY - box.top);
    const sheet = editor.model.sheetAt(...world);
    if (!sheet || e.clientX < box.left) {
      held = null;
      if (editor.moving.size > 0) editor.release();
      return;
    }
    const at = (rotation: { c: number; s: number }): Placement => {
      const there: Placement = {
        id: 0,
        part: part.id,
        stock: sheet.stock.id,
        copy: sheet.copy,
        ...rotation,
        x: 0,
        y: 0,
        mirrored,
      };
      const b = placedBox(part, there);
      return {
        ...there,
        x: snapToGrid(world[0] - sheet.x - (b.left + b.right) / 2),
        y: snapToGrid(world[1] - sheet.y - (b.bottom + b.top) / 2),
      };
    };
    turn ??= firstAllowed(editor, part, at);
    held = at(turn);
    editor.hold([held], line.place(held));
  });
  button.addEventListener('pointerup', () => {
    const dropped = held;
    from = held = turn = null;
    if (dropped) void editor.command(line.place(dropped));
  });
  // The click that ends a drag would put down one part more.
  button.addEventListener(
    'click',
    (e) => {
      if (dragged) e.stopImmediatePropagation();
      dragged = false;
    },
    { capture: true },
  );
  button.addEventListener('pointercancel', end);
  button.addEventListener('keydown', (e) => {
    if (e.key === 'Escape' && held) end();
  });
}

/** The first of the part's angles, or of the quarter turns, that neither its rotations nor the grain forbid. */
function firstAllowed(
  editor: Editor,
  part: Part,
  at: (rotation: { c: number; s: number }) => Placement,
): { c: number; s: number } {
  const named = (part.rotations ?? []).map((r) => (typeof r === 'number' ? r : r.from));
  let first: { c: number; s: number } | null = null;
  for (const degrees of [...named, 0, 90, 180, 270]) {
    const rotation = editor.kernel.rotation(degrees);
    if (!rotation) continue;
    first ??= rotation;
    if (!editor.kernel.immediate) break;
    const state = editor.kernel.state([at(rotation)], '', 0, false);
    if ('violations' in state && !state.violations.some((v) => v.kind === 'rotation' || v.kind === 'grain'))
      return rotation;
  }
  return first ?? { c: 1, s: 0 };
}
