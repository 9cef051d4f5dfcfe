// The fields that the dialogs about parts and material have in common.

import { h } from '../html/elements';
import { t, type Key } from '../i18n';

/** How far a form is: the share that is sent or, when the server is at work, the seconds since it began. */
export interface Sent {
  fraction: number | null;
  since: number;
}

export const option = (value: string, text: string, chosen: string): HTMLOptionElement =>
  h('option', { value, selected: value === chosen }, text);

export const textField = (field: string, value: string, label: string): HTMLInputElement =>
  h('input', { 'data-field': field, 'aria-label': label, autocomplete: 'off', value });

/** A heading that is too long for a phone has a sign there. */
const heading = (key: Key): HTMLElement =>
  key === 'order.mirror'
    ? h('th', { title: t(key) }, h('span', { class: 'in-full' }, t(key)), h('span', { class: 'short' }, '⇋'))
    : h('th', {}, t(key));
export const tableHead = (...keys: Key[]): HTMLElement => h('thead', {}, h('tr', {}, ...keys.map(heading), h('th')));

/** The last cell of a row: a button that takes the row away. */
export const remover = (field: string, label: string, remove: () => void): HTMLElement =>
  h(
    'td',
    {},
    h(
      'button',
      { type: 'button', class: 'icon', 'data-field': field, title: label, 'aria-label': label, click: remove },
      '×',
    ),
  );

/** A button for drawings, which may be dropped on it, too. */
export function drawingAdder(action: string, add: (files: FileList | null) => void): HTMLElement {
  const chosen = h('input', {
    type: 'file',
    multiple: true,
    hidden: true,
    'data-action': `${action}.file`,
    'aria-label': t('order.add'),
    change: () => {
      add(chosen.files);
      chosen.value = ''; // the same file may be chosen once more
    },
  });
  const drop = (e: Event): void => {
    e.preventDefault();
    e.stopPropagation();
    if (e.type === 'drop') add((e as DragEvent).dataTransfer?.files ?? null);
  };
  return h(
    'div',
    { class: 'adder', dragover: drop, drop },
    h('button', { type: 'button', 'data-action': `${action}.add`, click: () => chosen.click() }, t('order.add')),
    chosen,
  );
}

/** The row that shows how far a form is. */
export class SendingRow {
  private readonly share: HTMLProgressElement;
  private readonly far = h('span');
  readonly element: HTMLElement;

  constructor(private readonly what: string) {
    this.share = h('progress', { max: 1, 'aria-label': what });
    this.element = h('div', { class: 'sending', hidden: true, role: 'status' }, this.share, this.far);
  }
  tell({ fraction, since }: Sent): void {
    this.element.hidden = false;
    if (fraction === null) this.share.removeAttribute('value');
    else this.share.value = fraction;
    const far = fraction === null ? t('transfer.since', { s: since }) : `${Math.floor(fraction * 100)} %`;
    this.far.textContent = `${this.what} ${far}`;
  }
  hide(): void {
    this.element.hidden = true;
  }
}
