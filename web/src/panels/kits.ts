// The table of kits: how many are complete, and which pieces the others miss. The kernel counts: pieces go to the kit
// that is worth most.

import type { Editor } from '../editor/editor';
import { h } from '../html/elements';
import { t } from '../i18n';

export function kits(editor: Editor): HTMLElement {
  if (editor.loading) return h('p', { class: 'note', role: 'status' }, t('loading'));
  const { document, parts } = editor.model;
  const all = document.kits ?? [];
  if (all.length === 0) return h('p', { class: 'note' }, t('kits.none'));
  const counts = editor.kernel.kits();
  if (counts === null) return h('p', { class: 'note', role: 'status' }, t('kits.unknown'));
  return h(
    'table',
    {},
    h(
      'thead',
      {},
      h(
        'tr',
        {},
        ...(['kits.kit', 'kits.complete', 'kits.missing'] as const).map((k) => h('th', { scope: 'col' }, t(k))),
      ),
    ),
    h(
      'tbody',
      {},
      ...counts.map(({ kit, complete, wanted, missing }, i) =>
        h(
          'tr',
          { 'data-id': `kit-${kit}` },
          h('th', { scope: 'row' }, all[i]?.name ?? kit),
          h('td', {}, `${complete} / ${wanted}`),
          h(
            'td',
            {},
            ...missing.map((m) =>
              h(
                'div',
                {},
                `${m.count} × ${parts.get(m.part)?.name ?? m.part}${
                  m.mirrored === undefined ? '' : ` (${t(m.mirrored ? 'kits.mirrored' : 'kits.upright')})`
                }`,
              ),
            ),
          ),
        ),
      ),
    ),
  );
}
