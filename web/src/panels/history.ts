// The list of all changes. Any state can be made the newest one again.

import type { Editor } from '../editor/editor';
import { h } from '../html/elements';
import { t } from '../i18n';
import { inWords, type Entry } from './history_words';

export function history(editor: Editor): HTMLElement {
  if (editor.loading) return h('p', { class: 'note', role: 'status' }, t('loading'));
  const list = h('ol', { class: 'list', reversed: true });
  if (editor.layoutId === 0) return list;
  const nameOf = (which: number | string): string => {
    const part = typeof which === 'string' ? editor.model.parts.get(which) : editor.model.document.parts?.[which];
    return part?.name ?? part?.id ?? String(which);
  };
  void (async () => {
    const answer = await fetch(`/api/layouts/${editor.layoutId}/history`);
    const body = (await answer.json()) as { entries?: Entry[]; error?: string };
    if (!answer.ok) return editor.say(body.error ?? String(answer.status));
    for (const e of [...(body.entries ?? [])].sort((a, b) => b.revision - a.revision)) {
      list.append(
        h(
          'li',
          { 'data-id': `revision-${e.revision}`, class: e.undone ? 'undone' : '' },
          h(
            'div',
            { class: 'row' },
            h('b', {}, String(e.revision)),
            h('span', { title: `${e.text}\n${e.at}` }, inWords(e, nameOf), e.undone ? ` (${t('history.undone')})` : ''),
            h('button', { class: 'small', click: () => void restore(editor, e.revision) }, t('history.restore')),
          ),
        ),
      );
    }
  })().catch((error: unknown) => editor.say(String(error)));
  return list;
}

async function restore(editor: Editor, revision: number): Promise<void> {
  const answer = await fetch(`/api/layouts/${editor.layoutId}/restore?revision=${revision}`, { method: 'POST' });
  if (!answer.ok) editor.say(((await answer.json()) as { error?: string }).error ?? String(answer.status));
}
