// A button that opens a list under it. A choice, Escape and a press elsewhere close it.

import { h } from './elements';

export function menu(name: string, label: string, ...items: HTMLElement[]): HTMLElement {
  const list = h('div', { class: 'items' }, ...items);
  const summary = h('summary', { 'data-action': `menu.${name}` }, label);
  const details = h(
    'details',
    {
      class: 'menu',
      keydown: (e) => {
        if ((e as KeyboardEvent).key !== 'Escape') return;
        details.open = false;
        summary.focus();
      },
      focusout: (e) => {
        if (!details.contains((e as FocusEvent).relatedTarget as Node | null)) details.open = false;
      },
    },
    summary,
    list,
  );
  // A press on a label's text, which takes no focus, must not close the list before it is a click.
  list.addEventListener('mousedown', (e) => e.preventDefault());
  return details;
}
