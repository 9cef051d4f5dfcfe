// The parts, each with a thumbnail, the number still to place, and a button that puts one where it fits.

import * as line from '../layout/commands';
import type { Part } from '../layout/document';
import type { Editor } from '../editor/editor';
import { h } from '../html/elements';
import { thumbnail } from '../html/thumbnail';
import { t } from '../i18n';

export function tray(
  editor: Editor,
  colour: (part: Part) => string,
  draggable: (button: HTMLElement, part: Part, mirrored: boolean) => void,
): HTMLElement {
  const counts = editor.model.counts();
  const sheet = () => {
    const first = editor.placementsOf(editor.chosen())[0];
    return (first && editor.model.sheet(first.stock, first.copy)) ?? editor.model.sheets[0];
  };
  const put = (part: Part, hand?: 'upright' | 'mirrored') => {
    const to = sheet();
    if (to) void editor.command(line.fit(part.id, to, hand));
  };
  return h(
    'ul',
    { class: 'tray' },
    ...[...editor.model.parts.values()].map((part) => {
      const n = counts.get(part.id)!;
      const placed = n.upright + n.mirrored;
      const wanted = editor.model.wanted(part.id);
      const left = wanted - placed;
      const piece = h(
        'button',
        { class: 'piece', title: t('tray.fit'), click: () => put(part, part.mirror ? 'upright' : undefined) },
        thumbnail(part.outline.polygon, colour(part)),
        h(
          'span',
          { class: 'grow' },
          h('b', {}, part.name ?? part.id),
          h(
            'small',
            {},
            wanted === 0 ? t('tray.any', { n: placed }) : left > 0 ? t('tray.left', { n: left }) : t('tray.done'),
          ),
        ),
        h('span', { class: 'count' }, wanted ? `${placed}/${wanted}` : String(placed)),
      );
      draggable(piece, part, false);
      const other = part.mirror
        ? h(
            'button',
            {
              class: 'icon',
              title: t('tray.fit.mirrored'),
              'aria-label': t('tray.fit.mirrored'),
              click: () => put(part, 'mirrored'),
            },
            '⇋',
          )
        : null;
      if (other) draggable(other, part, true);
      return h('li', { 'data-id': `part-${part.id}`, class: left > 0 ? 'open' : 'full' }, piece, other);
    }),
  );
}
