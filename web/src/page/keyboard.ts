// Keys pressed anywhere in the page.

import type { Editor } from '../editor/editor';
import { key } from '../tools/keys';
import type { PicturePane } from './picture_pane';

export interface KeyboardEvents {
  find(): void;
  help(): void;
}

/**
 * A key acts wherever the focus is, but in a field or a dialog. The keys that go from part to part and the space bar
 * act in the picture alone: elsewhere they are the browser's.
 */
export function listenToKeys(editor: Editor, pane: PicturePane, events: KeyboardEvents): void {
  const { pointer } = pane;
  document.addEventListener('keydown', (e) => {
    const inPicture = e.target === pane.element;
    const idle = inPicture || e.target === document.body;
    const elsewhere = (e.target as HTMLElement).closest('input, select, dialog, details') !== null;
    if (elsewhere || (!inPicture && e.key === 'Tab') || (!idle && e.key === ' ')) return;
    if (e.code === 'Space') pointer.spaceDown = true;
    if (pointer.features.draws && (e.key === 'Enter' || (e.key === 'Backspace' && pointer.features.back()))) {
      if (e.key === 'Enter') pointer.finishDraft();
      else pane.later('top');
      return e.preventDefault();
    }
    const taken = key(e, editor, {
      fit: () => pane.fitAll(),
      zoom: (factor) => pane.zoom(factor),
      find: events.find,
      help: events.help,
      cancel: () => pointer.cancel(),
      reveal: (id) => pane.revealPart(id),
    });
    if (taken || e.code === 'Space') e.preventDefault();
  });
  document.addEventListener('keyup', (e) => {
    if (e.code === 'Space') pointer.spaceDown = false;
  });
}
