// The toolbar above and the tools beside the picture.

import type { Editor, Tool } from '../editor/editor';
import { h } from '../html/elements';
import { CHOICES, type ChosenForm } from '../dialogs/export_choices';
import { icon } from '../html/icons';
import { currentLanguage, t, type Key } from '../i18n';
import { menu } from '../html/menu';
import { act, type Action } from '../tools/actions';

export interface BarEvents {
  openLayout(id: number): void;
  takeFiles(files: FileList | null): void;
  newLayout(): void;
  copyLayout(): void;
  nameLayout(): void;
  save(form: string): void;
  /** Exports a form that leaves something to choose. */
  choose(form: ChosenForm): void;
  print(): void;
  fit(): void;
  photo(file: File): void;
  theme(): void;
  language(): void;
  help(): void;
}

/** The forms without choices that the server exports, with the names people know them by. */
const FORMS: readonly [string, string][] = [
  ['layout', 'lekalo JSON'],
  ['placements', 'Placements JSON'],
  ['svg', 'SVG'],
  ['pdf', 'PDF'],
  ['png', 'PNG'],
];

const button = (label: Key, run: () => void, pressed?: boolean): HTMLButtonElement =>
  h(
    'button',
    {
      class: 'icon',
      title: t(label),
      'aria-label': t(label),
      'aria-pressed': pressed === undefined ? undefined : String(pressed),
      'data-action': label,
      click: run,
    },
    icon(label),
  );
const space = (): HTMLElement => h('span', { class: 'gap' });
/** A line of a menu; a choice closes the menu. */
const item = (name: string, text: string, run: () => void): HTMLButtonElement => {
  const click = (e: Event): void => {
    (e.currentTarget as HTMLElement).closest('details')!.open = false;
    run();
  };
  return h('button', { 'data-action': name, click }, text);
};

type Layouts = readonly { id: number; name: string }[];

/** Shows the bar and the tools anew. */
export function showBar(
  bar: HTMLElement,
  tools: HTMLElement,
  editor: Editor,
  layouts: Layouts,
  events: BarEvents,
): void {
  // The buttons are new: the focus goes back to the one that had it.
  const focused = (document.activeElement as HTMLElement | null)?.dataset.action;
  bar.replaceChildren(
    files(editor, layouts, events),
    commands(editor),
    h('span', { class: 'push' }),
    h(
      'span',
      { class: 'ends' },
      button('fit', events.fit),
      viewMenu(editor, events),
      exportMenu(events),
      h(
        'button',
        { 'aria-label': t('language'), 'data-action': 'language', click: events.language },
        currentLanguage() === 'en' ? 'УКР' : 'ENG',
      ),
      button('help', events.help),
    ),
  );
  const names: Tool[] = ['select', 'slide', 'push', 'nearest', 'measure', 'pan', 'defect', 'zone'];
  if (editor.photos.size > 0) names.push('photo');
  tools.setAttribute('aria-label', t('tools'));
  tools.replaceChildren(
    ...names.map((name) => button(`tool.${name}` as Key, () => editor.setTool(name), editor.tool === name)),
  );
  if (focused) document.querySelector<HTMLElement>(`[data-action="${focused}"]`)?.focus();
}

function files(editor: Editor, layouts: Layouts, events: BarEvents): HTMLElement {
  const choice = h(
    'select',
    {
      'aria-label': t('open'),
      class: 'layouts',
      change: (e) => events.openLayout(Number((e.target as HTMLSelectElement).value)),
    },
    ...layouts.map((l) => h('option', { value: l.id, selected: l.id === editor.layoutId }, l.name || String(l.id))),
  );
  const file = h('input', {
    type: 'file',
    multiple: true,
    hidden: true,
    'aria-label': t('open.file'),
    change: (e) => events.takeFiles((e.target as HTMLInputElement).files),
  });
  const begin = h('button', { 'data-action': 'new.layout', click: events.newLayout }, t('new.layout'));
  return h(
    'span',
    { class: 'files' },
    h('span', { class: 'brand' }, 'lekalo'),
    choice,
    begin,
    button('open.file', () => file.click()),
    file,
    button('copy.layout', events.copyLayout),
    button('name.layout', events.nameLayout),
  );
}

function commands(editor: Editor): HTMLElement {
  const actions = (...names: Action[]): HTMLButtonElement[] =>
    names.map((name) => button(name, () => void act(editor, name)));
  const modes = (['strict', 'free'] as const).map((mode) =>
    h(
      'button',
      {
        'aria-pressed': String(editor.mode === mode),
        'data-action': `mode.${mode}`,
        click: () => editor.setMode(mode),
      },
      t(mode),
    ),
  );
  const step = h('input', {
    type: 'number',
    class: 'step',
    value: editor.rotateStep,
    min: 0.1,
    max: 180,
    step: 'any',
    'aria-label': t('step'),
    title: t('step'),
    'data-action': 'step',
    change: (e) => {
      const value = Number((e.target as HTMLInputElement).value);
      if (value > 0 && value <= 180) editor.rotateStep = value;
    },
  });
  return h(
    'span',
    { class: 'commands' },
    space(),
    h('span', { class: 'segment', role: 'group', title: t('mode.hint') }, ...modes),
    space(),
    ...actions('undo', 'redo'),
    space(),
    ...actions('rotate.left'),
    step,
    ...actions('rotate.right', 'flip'),
    space(),
    ...actions('slide.left', 'slide.right', 'slide.up', 'slide.down', 'settle', 'snap', 'compact', 'nest'),
    space(),
    ...actions('lock', 'swap', 'copy', 'remove'),
  );
}

function viewMenu(editor: Editor, events: BarEvents): HTMLElement {
  const shown = (['labels', 'grain', 'gap', 'zones'] as const).map((name) => {
    const change = (e: Event): void => {
      editor.show[name] = (e.target as HTMLInputElement).checked;
      // The picture is painted anew; the bar stays, as its menu is open.
      editor.tell('moving');
      editor.tell('selection');
    };
    const box = h('input', { type: 'checkbox', checked: editor.show[name], 'data-action': `show.${name}`, change });
    return h('label', {}, box, t(name));
  });
  const picked = h('input', {
    type: 'file',
    accept: 'image/*',
    hidden: true,
    'data-action': 'photo.file',
    'aria-label': t('photo'),
    change: (e) => {
      const file = (e.target as HTMLInputElement).files?.[0];
      if (file) events.photo(file);
    },
  });
  return menu(
    'view',
    t('view'),
    ...shown,
    picked,
    item('photo', t('photo'), () => picked.click()),
    item('theme', t('theme'), events.theme),
  );
}

function exportMenu(events: BarEvents): HTMLElement {
  return menu(
    'export',
    t('export'),
    ...FORMS.map(([form, name]) => item(`export.${form}`, name, () => events.save(form))),
    ...(Object.keys(CHOICES) as ChosenForm[]).map((form) =>
      item(`export.${form}`, `${CHOICES[form].name}…`, () => events.choose(form)),
    ),
    item('print', t('print'), events.print),
  );
}
