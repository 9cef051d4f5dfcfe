// Finds placed parts by name or number, and shows a row for each.

import type { Editor } from '../editor/editor';
import { h } from '../html/elements';

const MOST_SHOWN = 300;

export function partRows(editor: Editor, wanted: string, show: (id: number) => void): HTMLElement {
  const word = wanted.trim().toLocaleLowerCase();
  const rows: HTMLElement[] = [];
  for (const p of editor.model.placements.values()) {
    const name = editor.model.part(p).name ?? p.part;
    if (
      word &&
      String(p.id) !== word &&
      !name.toLocaleLowerCase().includes(word) &&
      !p.part.toLocaleLowerCase().includes(word)
    )
      continue;
    if (rows.length === MOST_SHOWN) {
      rows.push(h('li', { class: 'note' }, '…'));
      break;
    }
    rows.push(
      h(
        'li',
        { 'data-id': `found-${p.id}` },
        h(
          'button',
          { 'aria-pressed': String(editor.selection.has(p.id)), click: () => show(p.id) },
          h('b', {}, `${p.id}`),
          h('span', {}, `${name}${p.mirrored ? ' ⇋' : ''}${p.locked ? ' 🔒' : ''}`),
          h(
            'small',
            {},
            `${p.x.toFixed(1)}  ${p.y.toFixed(1)}  ${((Math.atan2(p.s, p.c) * 180) / Math.PI).toFixed(1)}°`,
          ),
        ),
      ),
    );
  }
  return h('ul', { class: 'list' }, ...rows);
}
