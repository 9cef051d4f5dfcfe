// Complete kits and what the next one misses.

import type { Kit } from '../document';
import type { Editor } from '../editor';
import { h } from '../elements';
import { t } from '../i18n';
import type { KitState, Missing, Model } from '../model';

/// Pieces for `complete` kits of each kind exist: pieces of either hand take what the others leave. The kits share
/// the parts in the order of the document.
export function kitStates(model: Model): KitState[] {
  const left = model.counts();
  /// What lacks for `n` kits; takes the pieces when nothing does and `take` is set.
  const lacking = (kit: Kit, n: number, take: boolean): Missing[] => {
    const missing: Missing[] = [];
    const used = new Map<string, { upright: number; mirrored: number }>();
    const sorted = [...kit.pieces].sort((a, b) => Number(a.mirrored === undefined) - Number(b.mirrored === undefined));
    for (const piece of sorted) {
      const have = used.get(piece.part) ?? { ...(left.get(piece.part) ?? { upright: 0, mirrored: 0 }) };
      used.set(piece.part, have);
      let need = (piece.count ?? 1) * n;
      for (const hand of piece.mirrored === undefined ? (['upright', 'mirrored'] as const) : [piece.mirrored ? 'mirrored' as const : 'upright' as const]) {
        const got = Math.min(need, have[hand]);
        have[hand] -= got;
        need -= got;
      }
      if (need > 0) missing.push({ part: piece.part, count: need, mirrored: piece.mirrored });
    }
    if (take) for (const [part, counts] of used) left.set(part, counts);
    return missing;
  };
  return (model.document.kits ?? []).map((kit) => {
    const wanted = kit.demand ?? 1;
    let complete = 0;
    while (complete < wanted && lacking(kit, complete + 1, false).length === 0) ++complete;
    const missing = complete < wanted ? lacking(kit, complete + 1, false) : [];
    lacking(kit, complete, true);
    return { id: kit.id, name: kit.name ?? kit.id, wanted, complete, missing };
  });
}

export function kits(editor: Editor): HTMLElement {
  const states = kitStates(editor.model);
  if (states.length === 0) return h('p', { class: 'note' }, t('kits.none'));
  return h('table', {}, h('thead', {}, h('tr', {}, ...(['kits.kit', 'kits.complete', 'kits.missing'] as const).map((k) => h('th', { scope: 'col' }, t(k))))),
    h('tbody', {}, ...states.map((kit) => h('tr', { 'data-id': `kit-${kit.id}` }, h('th', { scope: 'row' }, kit.name),
      h('td', {}, `${kit.complete} / ${kit.wanted}`),
      h('td', {}, ...kit.missing.map((m) => h('div', {}, `${m.count} × ${editor.model.parts.get(m.part)?.name ?? m.part}${
        m.mirrored === undefined ? '' : ` (${t(m.mirrored ? 'kits.mirrored' : 'kits.upright')})`}`)))))));
}
