// The print: each sheet in use on a page of its own, with the names of its parts and a table of them.

import { Picture } from './draw';
import { LIGHT } from './scene';
import type { Editor } from '../editor/editor';
import { h } from '../html/elements';
import { t } from '../i18n';
import { placedAt, type Sheet } from '../layout/model';
import { View } from './view';

/** A page is this many pixels wide, each of which is 0.25 mm on A4. */
const ACROSS = 1100;
/** Each pixel is painted as FINE x FINE, because a printer is finer than a screen. */
const FINE = 2;
/** The empty border of a page, in pixels. */
const MARGIN = 26;

export function printed(editor: Editor): HTMLElement[] {
  const { model } = editor;
  const used = new Map<Sheet, Map<string, { upright: number; mirrored: number }>>();
  for (const p of model.placements.values()) {
    const sheet = model.sheet(p.stock, p.copy);
    if (!sheet) continue;
    const counts = used.get(sheet) ?? new Map<string, { upright: number; mirrored: number }>();
    const count = counts.get(p.part) ?? { upright: 0, mirrored: 0 };
    count[p.mirrored ? 'mirrored' : 'upright'] += 1;
    used.set(sheet, counts.set(p.part, count));
  }
  return model.sheets
    .filter((sheet) => used.has(sheet))
    .map((sheet) =>
      h(
        'section',
        {},
        h('h1', {}, editor.name),
        picture(editor, sheet),
        h(
          'table',
          {},
          h(
            'tbody',
            {},
            ...[...used.get(sheet)!].map(([id, n]) =>
              h(
                'tr',
                {},
                h('th', { scope: 'row' }, model.parts.get(id)?.name ?? id),
                h('td', {}, String(n.upright + n.mirrored)),
                h('td', {}, n.mirrored > 0 ? `${t('kits.mirrored')} ${n.mirrored}` : ''),
              ),
            ),
          ),
        ),
      ),
    );
}

function picture(editor: Editor, sheet: Sheet): HTMLCanvasElement {
  const canvas = h('canvas', {});
  const view = new View();
  const { box } = sheet;
  const scale = (ACROSS - 2 * MARGIN) / (box.right - box.left);
  const drawing = new Picture(canvas, h('canvas', {}));
  drawing.resize(view, ACROSS, Math.min(4 * ACROSS, (box.top - box.bottom) * scale + 2 * MARGIN), FINE);
  view.fit(placedAt(box, sheet), MARGIN);
  drawing.backdrop.draw({
    model: editor.model,
    view,
    theme: { ...LIGHT, back: '#fff' },
    selection: new Set(),
    others: new Set(),
    violations: editor.violations ?? [],
    moving: new Map(),
    coming: new Map(),
    live: null,
    band: null,
    ruler: null,
    arrow: null,
    draft: [],
    photos: editor.photos,
    pins: [],
    handle: null,
    show: { ...editor.show, labels: true },
  });
  return canvas;
}
