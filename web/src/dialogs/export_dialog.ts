// Asks for the choices of a form of export. If the server cannot write the file, the dialog stays open and shows the
// server's sentence.

import { h } from '../html/elements';
import { CHOICES, isAsked, request, sheetsInUse, type ChosenForm, type Field, type Values } from './export_choices';
import { t, type Key } from '../i18n';
import type { Model } from '../layout/model';

/** The result of saving: the reason why it was refused, or null, and notes about the file. */
export interface Saved {
  refused: string | null;
  notes: string[];
}

export interface ExportEvents {
  download(fields: URLSearchParams): Promise<Saved>;
  /** Returns the values chosen last time, because a shop's machine seldom changes. */
  recall(form: ChosenForm): Values;
  keep(form: ChosenForm, values: Values): void;
}

export function exportDialog(form: ChosenForm, model: Model, events: ExportEvents): HTMLDialogElement {
  const { name, sheetEach, fields } = CHOICES[form];
  const kept = events.recall(form);
  const sheets = sheetsInUse(model);
  const words = (field: string, value: string): string => {
    if (field === 'only') return t(value === 'CUT' ? 'export.only.CUT' : 'export.only.all');
    return field === 'process' || field === 'lead' ? t(`export.${field}.${value}` as Key) : value;
  };
  const inputOf = (field: Field): HTMLInputElement | HTMLSelectElement =>
    field.of
      ? h(
          'select',
          { name: field.name, 'data-field': field.name },
          ...field.of.map((value) =>
            h('option', { value, selected: kept[field.name] === value }, words(field.name, value)),
          ),
        )
      : h('input', {
          name: field.name,
          'data-field': field.name,
          inputmode: 'decimal',
          'aria-required': field.required ? 'true' : undefined,
          autocomplete: 'off',
          value: (field.name === 'kerf' && model.document.rules?.kerf) || (kept[field.name] ?? field.value ?? ''),
        });
  const rows = fields.map((field) => {
    const input = inputOf(field);
    return {
      field,
      input,
      row: h('label', {}, h('span', {}, `${t(`export.${field.name}` as Key)}${field.required ? ' *' : ''}`), input),
    };
  });
  const sheet = h(
    'select',
    { 'data-field': 'sheet' },
    ...(sheetEach ? [] : [h('option', { value: '' }, t('export.sheet.all'))]),
    ...sheets.map((one) => h('option', { value: one }, one)),
  );
  const trouble = h('p', { class: 'trouble', role: 'alert' });
  const noteArea = h('div', { class: 'notes', role: 'status' });
  const cancel = h(
    'button',
    { type: 'button', 'data-action': 'export.cancel', click: () => dialog.close() },
    t('export.cancel'),
  );
  const save = h('button', { type: 'submit', 'data-action': 'export.save' }, t('export.save'));
  /** Commas become points, because much of Europe writes commas and the server reads points. */
  const values = (): Values =>
    Object.fromEntries(
      rows.map(({ field, input }) => [field.name, field.of ? input.value : input.value.trim().replace(',', '.')]),
    );
  const showAsked = (): void => {
    const now = values();
    for (const { field, row } of rows) row.hidden = !isAsked(field, now);
  };
  const title = t('export.as', { form: name });
  const dialog = h(
    'dialog',
    { class: 'export', 'aria-label': title },
    h('h2', {}, title),
    h(
      'form',
      {
        change: showAsked,
        submit: (e) => {
          e.preventDefault();
          void (async () => {
            save.disabled = true;
            trouble.textContent = '';
            noteArea.replaceChildren();
            const chosen = values();
            const { refused, notes } = await events.download(
              request(form, sheets.length > 1 ? sheet.value : '', chosen),
            );
            save.disabled = false;
            if (refused !== null) {
              trouble.textContent = refused;
              return save.focus();
            }
            events.keep(form, chosen);
            if (notes.length === 0) return dialog.close();
            // The dialog stays until its notes about the file have been read.
            noteArea.replaceChildren(
              h('p', {}, t('export.saved')),
              h('ul', {}, ...notes.map((note) => h('li', {}, note))),
            );
            cancel.textContent = t('close');
            cancel.focus();
          })();
        },
      },
      h(
        'div',
        { class: 'fields' },
        sheets.length > 1 ? h('label', {}, h('span', {}, t('export.sheet')), sheet) : null,
        ...rows.map((r) => r.row),
      ),
      trouble,
      noteArea,
      h('div', { class: 'buttons' }, cancel, save),
    ),
  );
  dialog.addEventListener('close', () => dialog.remove());
  showAsked();
  return dialog;
}
