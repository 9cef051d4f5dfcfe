// Asks for the sheet, as a drawing holds parts and nothing to lay them on.

import { h } from '../html/elements';
import { t, type Key } from '../i18n';

export interface SheetSize {
  width: string;
  height: string;
  count: string;
}

/** @param give makes the layout with a sheet; gives the reason why it could not, or null */
export function sheetDialog(
  name: string,
  kept: SheetSize,
  give: (size: SheetSize) => Promise<string | null>,
): HTMLDialogElement {
  const inputs = (['width', 'height', 'count'] as const).map((key) => {
    const input = h('input', {
      name: key,
      'data-field': key,
      inputmode: 'decimal',
      autocomplete: 'off',
      value: kept[key],
    });
    return { key, input, row: h('label', {}, h('span', {}, t(`sheet.${key}` as Key)), input) };
  });
  const trouble = h('p', { class: 'trouble', role: 'alert' });
  const ok = h('button', { type: 'submit', 'data-action': 'sheet.give' }, t('sheet.give'));
  const dialog = h(
    'dialog',
    { class: 'export', 'aria-label': t('sheet.title') },
    h('h2', {}, t('sheet.title')),
    h('p', { class: 'note' }, t('sheet.why', { name })),
    h(
      'form',
      {
        submit: (e) => {
          e.preventDefault();
          void (async () => {
            ok.disabled = true;
            // A comma is what half of Europe writes; the server reads points.
            const size = Object.fromEntries(
              inputs.map(({ key, input }) => [key, input.value.trim().replace(',', '.')]),
            ) as unknown as SheetSize;
            trouble.textContent = '';
            const refused = await give(size);
            ok.disabled = false;
            if (refused === null) return dialog.close();
            trouble.textContent = refused;
          })();
        },
      },
      h('div', { class: 'fields' }, ...inputs.map(({ row }) => row)),
      trouble,
      h(
        'div',
        { class: 'buttons' },
        h('button', { type: 'button', 'data-action': 'sheet.cancel', click: () => dialog.close() }, t('sheet.none')),
        ok,
      ),
    ),
  );
  dialog.addEventListener('close', () => dialog.remove());
  return dialog;
}
