// The right-hand side, which shows one of its panels at a time.

import * as line from '../layout/commands';
import type { Violation } from '../layout/document';
import type { Editor } from '../editor/editor';
import { h } from '../html/elements';
import { t, type Key } from '../i18n';
import type { Sheet } from '../layout/model';
import { partRows } from './find';
import { history } from './history';
import { kits } from './kits';
import { violations } from './violations';

export type Side = 'violations' | 'parts' | 'kits' | 'sheets' | 'history';
const LABELS: Record<Side, Key> = {
  violations: 'violations',
  parts: 'parts',
  kits: 'kits',
  sheets: 'sheets',
  history: 'history',
};

export interface SideEvents {
  choose(side: Side): void;
  violation(v: Violation): void;
  part(id: number): void;
  sheet(sheet: Sheet): void;
}

export function showSidePanel(into: HTMLElement, editor: Editor, side: Side, word: string, events: SideEvents): void {
  const broken = editor.violations?.length ?? 0;
  const tabs = h(
    'div',
    { class: 'tabs', role: 'tablist' },
    ...(Object.keys(LABELS) as Side[]).map((s) =>
      h(
        'button',
        { role: 'tab', 'aria-selected': String(s === side), 'data-action': `side.${s}`, click: () => events.choose(s) },
        t(LABELS[s]),
        s === 'violations' && broken > 0 ? h('span', { class: 'badge' }, String(broken)) : null,
      ),
    ),
  );
  const body = h('div', { class: 'body', role: 'tabpanel' });
  if (side === 'violations') body.append(violations(editor, (v) => events.violation(v)));
  if (side === 'kits') body.append(kits(editor));
  if (side === 'history') body.append(history(editor));
  if (side === 'sheets') body.append(sheets(editor, events));
  if (side === 'parts') {
    const rows = h(
      'div',
      {},
      partRows(editor, word, (id) => events.part(id)),
    );
    body.append(
      h('input', {
        type: 'search',
        value: word,
        placeholder: t('find'),
        'aria-label': t('find'),
        style: 'margin: 4px 10px; width: calc(100% - 20px)',
        input: (e) =>
          rows.replaceChildren(partRows(editor, (e.target as HTMLInputElement).value, (id) => events.part(id))),
      }),
      rows,
    );
  }
  into.replaceChildren(tabs, body);
}

function sheets(editor: Editor, events: SideEvents): HTMLElement {
  const counts = new Map<Sheet, number>();
  for (const p of editor.model.placements.values()) {
    const sheet = editor.model.sheet(p.stock, p.copy);
    if (sheet) counts.set(sheet, (counts.get(sheet) ?? 0) + 1);
  }
  return h(
    'div',
    {},
    h(
      'ul',
      { class: 'list' },
      ...editor.model.sheets.map((s) =>
        h(
          'li',
          { 'data-id': `sheet-${s.stock.id}-${s.copy}` },
          h(
            'button',
            { click: () => events.sheet(s) },
            h('b', {}, String(s.copy + 1)),
            h('span', {}, s.stock.name ?? s.stock.id),
            h('small', {}, t('sheets.parts', { n: counts.get(s) ?? 0 })),
          ),
        ),
      ),
    ),
    ...features(editor),
    ...photos(editor),
  );
}

/**
 * The defects and zones of every stock, with their grades and a button that takes each away. The tools draw new ones.
 */
function features(editor: Editor): HTMLElement[] {
  return (['defect', 'zone'] as const).map((kind) =>
    h(
      'section',
      {},
      h('h2', {}, t(`${kind}s`)),
      h(
        'label',
        { class: 'field' },
        t(`${kind}.next`),
        h('input', {
          type: 'number',
          class: 'grade',
          min: kind === 'defect' ? 1 : 0,
          step: 1,
          value: editor.grades[kind],
          'data-action': `grade.${kind}`,
          change: (e) => (editor.grades[kind] = Number((e.target as HTMLInputElement).value)),
        }),
      ),
      h(
        'ul',
        { class: 'list' },
        ...[...editor.model.stocks.values()].flatMap((stock) =>
          ((kind === 'defect' ? stock.defects : stock.zones) ?? []).map((f) => {
            const named = { stock: stock.id, kind, id: f.id };
            return h(
              'li',
              { 'data-id': `${kind}-${stock.id}-${f.id}`, class: 'field' },
              h('span', {}, f.id),
              h('input', {
                type: 'number',
                class: 'grade',
                step: 1,
                'aria-label': t(`${kind}.grade`),
                title: t(`${kind}.grade`),
                value: 'quality' in f ? f.quality : (f.severity ?? 1),
                change: (e) =>
                  void editor.command(line.gradeFeature(named, Number((e.target as HTMLInputElement).value))),
              }),
              h(
                'button',
                {
                  class: 'small',
                  'aria-label': `${t('feature.remove')} ${f.id}`,
                  click: () => void editor.command(line.removeFeature(named)),
                },
                '✕',
              ),
            );
          }),
        ),
      ),
    ),
  );
}

/** The photographs of the stocks, each with a button that begins its scale anew and one that takes it away. */
function photos(editor: Editor): HTMLElement[] {
  if (editor.photos.size === 0) return [];
  return [
    h(
      'section',
      {},
      h('h2', {}, t('photos')),
      h(
        'ul',
        { class: 'list' },
        ...[...editor.photos].map((photo) =>
          h(
            'li',
            { 'data-id': `photo-${photo.stock}`, class: 'field' },
            h('span', {}, editor.model.stocks.get(photo.stock)?.name ?? photo.stock),
            h(
              'button',
              {
                class: 'small',
                title: t('photo.unpin'),
                'data-action': 'photo.unpin',
                click: () => {
                  photo.unpin();
                  editor.setTool('photo');
                },
              },
              t('photo.unpin.short'),
            ),
            h(
              'button',
              {
                class: 'small',
                'aria-label': t('feature.remove'),
                click: () => void editor.photos.remove(photo.stock),
              },
              '✕',
            ),
          ),
        ),
      ),
    ),
  ];
}
