// The keys for every command, for the view, and for going from part to part.

import * as line from '../layout/commands';
import type { Editor } from '../editor/editor';
import type { Key } from '../i18n';
import { act, type Action } from './actions';

export const SHORTCUTS: readonly (readonly [keys: string, what: Key])[] = [
  ['Tab / Shift+Tab', 'key.next'],
  ['← ↑ → ↓', 'key.move'],
  ['Ctrl + ← ↑ → ↓', 'key.slide'],
  ['[ ]', 'key.turn'],
  ['M', 'flip'],
  ['G', 'settle'],
  ['S', 'snap'],
  ['L', 'lock'],
  ['X', 'swap'],
  ['Del', 'remove'],
  ['Ctrl+D', 'copy'],
  ['C', 'compact'],
  ['N', 'nest'],
  ['Ctrl+Z', 'undo'],
  ['Ctrl+Y', 'redo'],
  ['Ctrl+A', 'key.all'],
  ['Esc', 'key.cancel'],
  ['+ −', 'key.zoom'],
  ['Space', 'key.pan'],
  ['F', 'fit'],
  ['1', 'tool.select'],
  ['2', 'tool.slide'],
  ['3', 'tool.push'],
  ['4', 'tool.nearest'],
  ['5', 'tool.measure'],
  ['/', 'find'],
  ['?', 'help'],
];
const PLAIN: Record<string, Action> = {
  '[': 'rotate.left',
  ']': 'rotate.right',
  KeyM: 'flip',
  KeyG: 'settle',
  KeyS: 'snap',
  KeyL: 'lock',
  KeyX: 'swap',
  Delete: 'remove',
  Backspace: 'remove',
  KeyC: 'compact',
  KeyN: 'nest',
};
const ARROWS: Record<string, [number, number, Action]> = {
  ArrowLeft: [-1, 0, 'slide.left'],
  ArrowRight: [1, 0, 'slide.right'],
  ArrowUp: [0, 1, 'slide.up'],
  ArrowDown: [0, -1, 'slide.down'],
};
const TOOLS = ['select', 'slide', 'push', 'nearest', 'measure'] as const;

export interface ViewActions {
  fit(): void;
  zoom(factor: number): void;
  find(): void;
  help(): void;
  cancel(): void;
  reveal(id: number): void;
}

/** @returns whether the key was for the picture */
export function key(e: KeyboardEvent, editor: Editor, view: ViewActions): boolean {
  const ctrl = e.ctrlKey || e.metaKey;
  const arrow = ARROWS[e.key];
  if (arrow && editor.selection.size > 0) {
    if (ctrl) void act(editor, arrow[2]);
    else {
      const step = e.shiftKey ? 10 : e.altKey ? 0.1 : 1;
      void editor.command(line.move(editor.chosen(), arrow[0] * step, arrow[1] * step));
    }
    return true;
  }
  if (ctrl) {
    switch (e.code) {
      case 'KeyZ':
        void act(editor, e.shiftKey ? 'redo' : 'undo');
        return true;
      case 'KeyY':
        void act(editor, 'redo');
        return true;
      case 'KeyD':
        void act(editor, 'copy');
        return true;
      case 'KeyA':
        editor.select(editor.model.placements.keys());
        return true;
      default:
        return false;
    }
  }
  if (e.key === 'Tab' && editor.model.placements.size > 0) {
    const ids = [...editor.model.placements.keys()].sort((a, b) => a - b);
    const at = ids.indexOf(editor.chosen()[0] ?? -1);
    const to = at + (e.shiftKey ? -1 : 1);
    // Past either end the focus goes on to the rest of the page.
    if (to < 0 || to >= ids.length) {
      editor.select([]);
      return false;
    }
    editor.select([ids[to]!]);
    view.reveal(ids[to]!);
    return true;
  }
  const action = PLAIN[e.key] ?? PLAIN[e.code];
  if (action) {
    void act(editor, action);
    return true;
  }
  const tool = TOOLS[Number(e.key) - 1];
  if (tool) {
    editor.setTool(tool);
    return true;
  }
  switch (e.key) {
    case 'Escape':
      // Escape first drops the parts in hand, then stops a long command, then chooses none.
      if (editor.moving.size > 0 || !editor.stopLong()) {
        view.cancel();
        editor.select([]);
      }
      return true;
    case '+':
    case '=':
      view.zoom(1.25);
      return true;
    case '-':
      view.zoom(0.8);
      return true;
    case '/':
      view.find();
      return true;
    case '?':
      view.help();
      return true;
  }
  if (e.code === 'KeyF') {
    view.fit();
    return true;
  }
  return false;
}
