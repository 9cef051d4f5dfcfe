// A drawing of an order in small: its parts and their size, or why it cannot be read.

import { h } from '../html/elements';
import { thumbnail } from '../html/thumbnail';
import { t } from '../i18n';
import type { Part } from '../layout/document';
import { boxOf } from '../layout/model';

/** The parts of a drawing, or the sentence why there are none; null: nobody waits any more. */
export type ReadDrawing = (file: File, signal: AbortSignal) => Promise<Part[] | string | null>;

/** Of a drawing of many parts, the first are shown. */
const MOST_SHOWN = 3;

function sizeOf(part: Part): string {
  const { left, right, bottom, top } = boxOf(part.outline.polygon.outer);
  const mm = (value: number): string => String(Number(value.toFixed(1)));
  return `${mm(right - left)} × ${mm(top - bottom)} ${t('job.mm')}`;
}

/** An element that fills when the drawing has been read. */
export function drawingPicture(file: File, read: ReadDrawing, signal: AbortSignal): HTMLElement {
  const place = h('div', { class: 'drawing', role: 'status' }, h('small', {}, t('order.reading')));
  void read(file, signal).then((parts) => {
    if (parts === null) return;
    if (typeof parts === 'string') {
      place.replaceChildren(h('span', { class: 'trouble' }, parts));
      return;
    }
    place.replaceChildren(
      ...parts.slice(0, MOST_SHOWN).map((part) => thumbnail(part.outline.polygon)),
      h('small', {}, parts.length === 1 ? sizeOf(parts[0]!) : t('sheets.parts', { n: parts.length })),
    );
  });
  return place;
}
