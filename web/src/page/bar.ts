// The toolbar above and the tools beside the picture.

import type { Editor, Tool } from '../editor/editor';
import { h } from '../html/elements';
import { CHOICES, type ChosenForm } from '../dialogs/export_choices';
import { icon } from '../html/icons';
import { currentLanguage, isKey, t, type Key } from '../i18n';
import { menu } from '../html/menu';
import { act, type Action } from '../tools/actions';

export interface BarEvents {
  openLayout(id: number): void;
  takeFiles(files: FileList | null): void;
  newLayout(): void;
  /** The parts and sheets of the layout that is open. */
  job(): void;
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

/** The short word of a button, which stands beside its sign where there is room. */
function word(label: Key): HTMLElement | null {
  const key = `word.${label}`;
  return isKey(key) ? h('span', { class: 'word' }, t(key)) : null;
}
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
    word(label),
  );
const space = (): HTMLElement => h('span', { class: 'gap' });
/** A line of a menu; a choice closes the menu. */
const item = (name: string, text: string, run: () => void, sign?: Key): HTMLButtonElement => {
  const click = (e: Event): void => {
    (e.currentTarget as HTMLElement).closest('details')!.open = false;
    run();
  };
  return h('button', { 'data-action': name, click }, sign ? icon(sign) : null, text);
};

export interface Shown {
  layouts: readonly { id: number; name: string }[];
  /** On a narrow screen the buttons that are used less are in menus. */
  folded: boolean;
}

/** Shows the bar and the tools anew. */
export function showBar(bar: HTMLElement, tools: HTMLElement, editor: Editor, shown: Shown, events: BarEvents): void {
  // The buttons are new: the focus goes back to the one that had it.
  const focused = (document.activeElement as HTMLElement | null)?.dataset.action;
  bar.replaceChildren(
    files(editor, shown, events),
    h('span', { class: 'ends' }, ...(shown.folded ? foldedEnds(editor, events) : ends(editor, events))),
    h('span', { class: 'commands' }, ...(shown.folded ? foldedCommands(editor) : commands(editor))),
  );
  const names: Tool[] = ['select', 'slide', 'push', 'nearest', 'measure', 'pan', 'defect', 'zone'];
  if (editor.photos.size > 0) names.push('photo');
  tools.setAttribute('aria-label', t('tools'));
  tools.replaceChildren(
    ...names.map((name) => button(`tool.${name}` as Key, () => editor.setTool(name), editor.tool === name)),
  );
  if (editor.layoutId === 0) sleep([bar, tools]);
  if (focused) document.querySelector<HTMLElement>(`[data-action="${focused}"]`)?.focus();
  showWords(bar);
}

/** The buttons that do something without a layout, and the menus that have some of them. */
const AWAKE = ['new.layout', 'open.file', 'language', 'help', 'theme', 'menu.main', 'menu.view'];
/** Without a layout most buttons have nothing to work on. */
function sleep(elements: readonly HTMLElement[]): void {
  for (const one of elements.flatMap((e) => [...e.querySelectorAll<HTMLElement>('button, input, select, summary')])) {
    if (AWAKE.includes(one.dataset.action ?? '')) continue;
    one.setAttribute('disabled', '');
    one.inert = one.tagName === 'SUMMARY';
  }
}

/** Shows the words of as many buttons as the line of the bar has room for, from its beginning. */
export function showWords(bar: HTMLElement): void {
  const [files, ends, commands] = [...bar.children] as [Element, Element, Element];
  const middle = (e: Element): number => (e.getBoundingClientRect().top + e.getBoundingClientRect().bottom) / 2;
  const isOneLine = (row: Element): boolean => {
    const seen = [...row.children].filter((e) => e.getBoundingClientRect().height > 0);
    return seen.every((e) => Math.abs(middle(e) - middle(seen[0]!)) < 8) && row.scrollWidth <= row.clientWidth + 1;
  };
  for (const line of [[files, ends], [commands]]) {
    const buttons = line.flatMap((row) => [...row.children]);
    for (const one of buttons) one.classList.add('worded');
    while (buttons.length > 0 && !line.every(isOneLine)) buttons.pop()!.classList.remove('worded');
  }
}

function languageButton(events: BarEvents): HTMLElement {
  return h(
    'button',
    { 'aria-label': t('language'), 'data-action': 'language', click: events.language },
    currentLanguage() === 'en' ? 'УКР' : 'ENG',
  );
}
const ends = (editor: Editor, events: BarEvents): HTMLElement[] => [
  button('fit', events.fit),
  viewMenu(editor, events),
  exportMenu(events),
  languageButton(events),
  button('help', events.help),
];
const foldedEnds = (editor: Editor, events: BarEvents): HTMLElement[] => [
  button('fit', events.fit),
  viewMenu(editor, events),
  exportMenu(events),
];

function files(editor: Editor, { layouts, folded }: Shown, events: BarEvents): HTMLElement {
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
  const open = (): void => file.click();
  if (folded) {
    const items = [
      item('new.layout', t('new.layout'), events.newLayout),
      item('job', t('job'), events.job, 'job'),
      item('open.file', t('open.file'), open, 'open.file'),
      item('copy.layout', t('copy.layout'), events.copyLayout, 'copy.layout'),
      item('name.layout', t('name.layout'), events.nameLayout, 'name.layout'),
      item('language', currentLanguage() === 'en' ? 'Українською' : 'English', events.language),
      item('help', t('help'), events.help, 'help'),
    ];
    const main = menu('main', '☰', ...items);
    main.querySelector('summary')!.setAttribute('aria-label', t('menu'));
    return h('span', { class: 'files' }, main, file, choice);
  }
  return h(
    'span',
    { class: 'files' },
    h('span', { class: 'brand' }, 'lekalo'),
    choice,
    h('button', { 'data-action': 'new.layout', click: events.newLayout }, t('new.layout')),
    button('job', events.job),
    button('open.file', open),
    file,
    button('copy.layout', events.copyLayout),
    button('name.layout', events.nameLayout),
  );
}

/** What is done to the parts: every action stands in one of the groups. */
const GROUPS: readonly (readonly Action[])[] = [
  ['undo', 'redo'],
  ['rotate.left', 'rotate.right', 'flip'],
  ['slide.left', 'slide.right', 'slide.up', 'slide.down', 'settle', 'snap', 'compact', 'nest'],
  ['lock', 'swap', 'copy', 'remove'],
];
/** The actions that have a button of their own on a narrow screen. */
const NEAREST: readonly Action[] = ['undo', 'redo', 'rotate.left', 'rotate.right', 'flip', 'settle', 'nest', 'remove'];

function modes(editor: Editor): HTMLElement {
  const choices = (['strict', 'free'] as const).map((mode) =>
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
  return h('span', { class: 'segment', role: 'group', title: t('mode.hint') }, ...choices);
}
function stepField(editor: Editor): HTMLInputElement {
  return h('input', {
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
}

function commands(editor: Editor): HTMLElement[] {
  const groups = GROUPS.map((group) =>
    group.flatMap((name) => [
      button(name, () => void act(editor, name)),
      ...(name === 'rotate.left' ? [stepField(editor)] : []),
    ]),
  );
  return [modes(editor), ...groups.flatMap((group) => [space(), ...group])];
}

function foldedCommands(editor: Editor): HTMLElement[] {
  const rest = GROUPS.flat().filter((name) => !NEAREST.includes(name));
  return [
    ...NEAREST.map((name) => button(name, () => void act(editor, name))),
    menu(
      'more',
      t('more'),
      modes(editor),
      h('label', {}, t('step'), stepField(editor)),
      ...rest.map((name) => item(name, t(name), () => void act(editor, name), name)),
    ),
  ];
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
