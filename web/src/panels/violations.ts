// The list of broken rules. A press on one shows its place.

import type { Violation } from '../layout/document';
import { isGap } from '../layout/document';
import type { Editor } from '../editor/editor';
import { h } from '../html/elements';
import { t, type Key } from '../i18n';

/** The name of a violation, which stays the same while the layout changes elsewhere. */
export const violationId = (v: Violation): string => `violation-${v.kind}-${v.a}-${v.b ?? v.feature ?? 0}`;

const MOST_SHOWN = 500;

export function violations(editor: Editor, show: (v: Violation) => void): HTMLElement {
  // Without a layout there is nothing to check yet.
  if (editor.layoutId === 0) return h('p');
  const list = editor.violations;
  if (editor.loading) return h('p', { class: 'note', role: 'status' }, t('loading'));
  if (list === null) return h('p', { class: 'note', role: 'status' }, t('violations.unknown'));
  const { checking } = editor;
  const unchecked =
    checking.left === 0
      ? null
      : h(
          'p',
          { class: 'note', role: 'status' },
          t('check.left', { n: checking.left }),
          ' ',
          checking.stopped
            ? h('button', { 'data-action': 'check.resume', click: () => checking.resume() }, t('check.resume'))
            : null,
        );
  if (list.length === 0)
    return unchecked ?? h('p', { class: 'note good', role: 'status' }, `✓ ${t('violations.none')}`);
  const name = (id: number): string => {
    const p = editor.model.placements.get(id);
    return p ? `${editor.model.part(p).name ?? p.part} ${id}` : String(id);
  };
  return h(
    'div',
    {},
    unchecked,
    h('p', { class: 'note', role: 'status' }, t('violations.count', { n: list.length })),
    h(
      'ol',
      { class: 'list' },
      ...list
        .slice(0, MOST_SHOWN)
        .map((v) =>
          h(
            'li',
            { 'data-id': violationId(v) },
            h(
              'button',
              { class: isGap(v.kind) ? 'near' : 'bad', click: () => show(v) },
              h('b', {}, `${isGap(v.kind) ? '◌' : '✕'} ${t(`kind.${v.kind}` as Key)}`),
              h(
                'span',
                {},
                v.b !== null ? `${name(v.a)} – ${name(v.b)}` : v.feature ? `${name(v.a)} – ${v.feature}` : name(v.a),
              ),
              v.amount_mm > 0 ? h('small', {}, `${v.amount_mm.toFixed(3)} ${t('job.mm')}`) : null,
            ),
          ),
        ),
    ),
  );
}
