// Asks for the name of a layout, or whether it is to be deleted.

import { h } from '../html/elements';
import { t } from '../i18n';

export interface LayoutEvents {
  /** Both give the reason why the server refused, or null. */
  rename(name: string): Promise<string | null>;
  remove(): Promise<string | null>;
}

export function layoutDialog(name: string, events: LayoutEvents): HTMLDialogElement {
  const input = h('input', { 'data-field': 'name', 'aria-label': t('layout.name'), autocomplete: 'off', value: name });
  const trouble = h('p', { class: 'trouble', role: 'alert' });
  const run = (work: Promise<string | null>): void =>
    void work.then((refused) => {
      if (refused === null) dialog.close();
      else trouble.textContent = refused;
    });
  let sure = false;
  const remove = h(
    'button',
    {
      type: 'button',
      class: 'danger',
      'data-action': 'name.delete',
      click: () => {
        // Nothing brings the layout back, so the button asks once more.
        if (sure) return run(events.remove());
        sure = true;
        remove.textContent = t('layout.delete.sure');
      },
    },
    t('layout.delete'),
  );
  const dialog = h(
    'dialog',
    { class: 'export', 'aria-label': t('name.layout') },
    h('h2', {}, t('name.layout')),
    h(
      'form',
      {
        submit: (e) => {
          e.preventDefault();
          run(events.rename(input.value.trim()));
        },
      },
      h('div', { class: 'fields' }, h('label', {}, h('span', {}, t('layout.name')), input)),
      trouble,
      h(
        'div',
        { class: 'buttons' },
        remove,
        h('span', { class: 'push' }),
        h('button', { type: 'button', click: () => dialog.close() }, t('export.cancel')),
        h('button', { type: 'submit', 'data-action': 'name.save' }, t('export.save')),
      ),
    ),
  );
  dialog.addEventListener('close', () => dialog.remove());
  return dialog;
}
