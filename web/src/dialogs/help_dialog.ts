// The keys and what they do.

import { h } from '../html/elements';
import { t, type Key } from '../i18n';

export function helpDialog(shortcuts: readonly (readonly [keys: string, what: Key])[]): HTMLDialogElement {
  const rows = shortcuts.flatMap(([keys, what]) => [h('dt', {}, keys), h('dd', {}, t(what))]);
  const dialog = h(
    'dialog',
    { 'aria-label': t('help') },
    h('h2', {}, t('help')),
    h('dl', {}, ...rows),
    h('form', { method: 'dialog' }, h('button', {}, t('close'))),
  );
  dialog.addEventListener('close', () => dialog.remove());
  return dialog;
}
