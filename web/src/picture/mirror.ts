// The picture for those who cannot see it, screen readers and tests: every part as an element over its place, with
// its name, its place and the rules it breaks. Boxes are in millimetres, so that moving the view is one transform.

import { isGap, type Placement, type Violation } from '../layout/document';
import { h } from '../html/elements';
import { t, type Key } from '../i18n';
import { boxesMeet, placedAt, type Model } from '../layout/model';
import type { View } from './view';

/**
 * Elements cost time. A larger layout has those of the chosen parts, of the parts with a broken rule and of those in
 * view.
 */
const MOST = 1000;

type Level = 'clear' | 'gap' | 'forbidden' | 'unknown';
interface Shown {
  item: HTMLLIElement;
  says: string;
  place: string;
}

export const mirrorId = (id: number): string => `placement-${id}`;

export class Mirror {
  readonly element = h('ul', { class: 'mirror', role: 'listbox', 'aria-multiselectable': 'true' });
  private shown = new Map<number, Shown>();
  private of: Model | null = null;

  /** Follows the view, at the cost of one style. */
  place(view: View): void {
    this.element.style.transform = `matrix(${view.scale}, 0, 0, ${view.scale}, ${view.x}, ${view.y})`;
  }

  /** @param whole all parts have been checked: one that no violation names breaks no rule */
  update(
    model: Model,
    view: View,
    selection: ReadonlySet<number>,
    violations: readonly Violation[] | null,
    whole: boolean,
  ): void {
    if (this.of !== model) {
      this.of = model;
      this.shown.clear();
      this.element.replaceChildren();
    }
    this.element.setAttribute('aria-label', t('canvas'));
    const broken = new Map<number, Violation[]>();
    for (const v of violations ?? []) {
      for (const id of [v.a, v.b]) if (id !== null) broken.set(id, [...(broken.get(id) ?? []), v]);
    }
    const wanted = this.wanted(model, view, selection, broken);
    for (const [id, { item }] of this.shown) {
      if (wanted.has(id)) continue;
      item.remove();
      this.shown.delete(id);
    }
    for (const p of wanted.values()) this.show(model, p, selection.has(p.id), broken.get(p.id) ?? (whole ? [] : null));
  }

  private wanted(
    model: Model,
    view: View,
    selection: ReadonlySet<number>,
    broken: ReadonlyMap<number, unknown>,
  ): Map<number, Placement> {
    if (model.placements.size <= MOST) return model.placements;
    const wanted = new Map<number, Placement>();
    const take = (p: Placement | undefined): void => {
      if (p && wanted.size < MOST) wanted.set(p.id, p);
    };
    for (const id of selection) take(model.placements.get(id));
    for (const id of broken.keys()) take(model.placements.get(id));
    const seen = view.visible();
    for (const p of model.placements.values()) {
      if (wanted.size === MOST) break;
      const sheet = model.sheet(p.stock, p.copy);
      const b = model.box(p);
      if (sheet && boxesMeet(placedAt(b, sheet), seen)) take(p);
    }
    return wanted;
  }

  private show(model: Model, p: Placement, chosen: boolean, broken: readonly Violation[] | null): void {
    let shown = this.shown.get(p.id);
    const level: Level = !broken
      ? 'unknown'
      : broken.length === 0
        ? 'clear'
        : broken.every((v) => isGap(v.kind))
          ? 'gap'
          : 'forbidden';
    const part = model.part(p);
    const degrees = (Math.atan2(p.s, p.c) * 180) / Math.PI;
    const says = [
      `${part.name ?? part.id} ${p.id}`,
      `${p.x.toFixed(2)} ${p.y.toFixed(2)} ${t('job.mm')}`,
      `${degrees.toFixed(1)}°`,
      p.mirrored ? t('kits.mirrored') : '',
      p.locked ? t('locked') : '',
      t(`live.${level}`),
      ...(broken ?? []).map((v) => `${t(`kind.${v.kind}` as Key)} ${v.amount_mm.toFixed(3)} ${t('job.mm')}`),
    ]
      .filter(Boolean)
      .join(', ');
    if (!shown) {
      const item = h('li', { role: 'option', id: mirrorId(p.id), 'data-id': mirrorId(p.id) });
      this.element.append(item);
      shown = { item, says: '', place: '' };
      this.shown.set(p.id, shown);
    }
    const { item } = shown;
    if (shown.says !== says) {
      shown.says = says;
      item.setAttribute('aria-label', says);
      item.dataset.level = level;
    }
    if (item.getAttribute('aria-selected') !== String(chosen)) item.setAttribute('aria-selected', String(chosen));
    const sheet = model.sheet(p.stock, p.copy);
    if (!sheet) return;
    // A sheet can move while its placements stay: the box is written anew where it differs.
    const b = model.box(p);
    const place = `left:${b.left + sheet.x}px;top:${-(b.top + sheet.y)}px;width:${b.right - b.left}px;height:${b.top - b.bottom}px`;
    if (shown.place !== place) {
      shown.place = place;
      item.style.cssText = place;
    }
  }
}
