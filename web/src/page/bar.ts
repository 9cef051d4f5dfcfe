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

export function showBar(
  bar: HTMLElement,
  tools: HTMLElement,
  editor: Editor,
  layouts: readonly { id: number; name: string }[],
  events: BarEvents,
): void {
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
  const action = (name: Action): HTMLButtonElement => button(name, () => void act(editor, name));
  const tool = (name: Tool): HTMLButtonElement =>
    button(`tool.${name}` as Key, () => editor.setTool(name), editor.tool === name);
  const space = (): HTMLElement => h('span', { class: 'gap' });
  const item = (name: string, text: string, run: () => void): HTMLButtonElement =>
    h(
      'button',
      {
        'data-action': name,
        click: (e) => {
          (e.currentTarget as HTMLElement).closest('details')!.open = false;
          run();
        },
      },
      text,
    );

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
  const shown = (['labels', 'grain', 'gap', 'zones'] as const).map((k) =>
    h(
      'label',
      {},
      h('input', {
        type: 'checkbox',
        checked: editor.show[k],
        'data-action': `show.${k}`,
        change: (e) => {
          editor.show[k] = (e.target as HTMLInputElement).checked;
          editor.tell('moving'); // 'show' would make the bar anew and close the menu
          editor.tell('selection');
        },
      }),
      t(k),
    ),
  );

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
  // The buttons are new: the focus goes back to the one that had it.
  const focused = (document.activeElement as HTMLElement | null)?.dataset.action;
  bar.replaceChildren(
    h(
      'span',
      { class: 'files' },
      h('span', { class: 'brand' }, 'lekalo'),
      choice,
      button('open.file', () => file.click()),
      file,
      button('copy.layout', events.copyLayout),
      button('name.layout', events.nameLayout),
    ),
    h(
      'span',
      { class: 'commands' },
      space(),
      h(
        'span',
        { class: 'segment', role: 'group', title: t('mode.hint') },
        ...(['strict', 'free'] as const).map((m) =>
          h(
            'button',
            { 'aria-pressed': String(editor.mode === m), 'data-action': `mode.${m}`, click: () => editor.setMode(m) },
            t(m),
          ),
        ),
      ),
      space(),
      action('undo'),
      action('redo'),
      space(),
      action('rotate.left'),
      step,
      action('rotate.right'),
      action('flip'),
      space(),
      action('slide.left'),
      action('slide.right'),
      action('slide.up'),
      action('slide.down'),
      action('settle'),
      action('snap'),
      action('compact'),
      action('nest'),
      space(),
      action('lock'),
      action('swap'),
      action('copy'),
      action('remove'),
    ),
    h('span', { class: 'push' }),
    h(
      'span',
      { class: 'ends' },
      button('fit', events.fit),
      menu(
        'view',
        t('view'),
        ...shown,
        picked,
        item('photo', t('photo'), () => picked.click()),
        item('theme', t('theme'), events.theme),
      ),
      menu(
        'export',
        t('export'),
        ...FORMS.map(([form, name]) => item(`export.${form}`, name, () => events.save(form))),
        ...(Object.keys(CHOICES) as ChosenForm[]).map((form) =>
          item(`export.${form}`, `${CHOICES[form].name}…`, () => events.choose(form)),
        ),
        item('print', t('print'), events.print),
      ),
      h(
        'button',
        { 'aria-label': t('language'), 'data-action': 'language', click: events.language },
        currentLanguage() === 'en' ? 'УКР' : 'ENG',
      ),
      button('help', events.help),
    ),
  );
  tools.setAttribute('aria-label', t('tools'));
  tools.replaceChildren(
    tool('select'),
    tool('slide'),
    tool('push'),
    tool('nearest'),
    tool('measure'),
    tool('pan'),
    tool('defect'),
    tool('zone'),
    ...(editor.photos.size > 0 ? [tool('photo')] : []),
  );
  if (focused) document.querySelector<HTMLElement>(`[data-action="${focused}"]`)?.focus();
}
