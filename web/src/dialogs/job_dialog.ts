// The parts and sheets of the layout that is open, and its rules. Every change is done at once, and can be undone.

import { h } from '../html/elements';
import { thumbnail } from '../html/thumbnail';
import { t } from '../i18n';
import * as line from '../layout/commands';
import type { Part, Stock } from '../layout/document';
import { boxOf, type Model } from '../layout/model';
import { drawingAdder, option, remover, SendingRow, tableHead, textField, type Sent } from './fields';
import { additionsOf, length, ROTATIONS, type Stock as NewStock, type StockKind } from './order_form';

/** What the server said to a change; an empty text: nothing. */
export interface Said {
  text: string;
  isNote: boolean;
}

export interface JobEvents {
  /** The layout as it is now. */
  model(): Model;
  command(text: string): Promise<Said>;
  undo(): Promise<Said>;
  /** Adds what a form brings. */
  add(form: FormData, watched: { told(one: Sent): void; signal: AbortSignal }): Promise<Said>;
}

const RULES = ['gap', 'border', 'kerf'] as const;
type Rule = (typeof RULES)[number];

const mm = (value: number): string => String(Number(value.toFixed(3)));

function sizeOf(part: Part): string {
  const { left, right, bottom, top } = boxOf(part.outline.polygon.outer);
  return `${mm(right - left)} × ${mm(top - bottom)} ${t('job.mm')}`;
}

/** The angles that a part may have, as a command has them. */
export function anglesOf(part: Part): string {
  const ranges = part.rotations ?? [];
  if (ranges.length === 0) return 'any';
  return ranges.map((one) => (typeof one === 'number' ? String(one) : `${one.from}..${one.to}`)).join(',');
}

class JobDialog {
  readonly element: HTMLDialogElement;
  private readonly parts = h('tbody');
  private readonly stocks = h('tbody');
  private readonly rules = h('div', { class: 'fields' });
  private readonly coming = h('div', { class: 'coming' });
  private readonly said = h('p', { role: 'status' });
  private readonly row = new SendingRow(t('job.adding'));
  private sending: AbortController | null = null;
  /** The material that the row at the end of its table would add. */
  private readonly next: NewStock = { kind: 'sheet', width: '', height: '', count: '', file: null };

  constructor(private readonly events: JobEvents) {
    this.element = h(
      'dialog',
      { class: 'order job', 'aria-label': t('job.title') },
      h('h2', {}, t('job.title')),
      h('h3', {}, t('order.parts')),
      h('table', {}, tableHead('job.part', 'order.quantity', 'order.rotations', 'order.mirror'), this.parts),
      drawingAdder('job', (files) => this.addDrawings(files)),
      h('h3', {}, t('order.stock')),
      h('table', {}, tableHead('order.kind', 'order.count'), this.stocks),
      this.coming,
      h('h3', {}, t('job.rules')),
      this.rules,
      h('div', { class: 'footer' }, this.said, this.row.element, this.buttons()),
    );
    const giveUp = (e: Event): void => {
      if (!this.sending || (e instanceof KeyboardEvent && e.key !== 'Escape')) return;
      e.preventDefault();
      this.sending.abort();
    };
    this.element.addEventListener('keydown', giveUp);
    this.element.addEventListener('cancel', giveUp);
    this.element.addEventListener('close', () => {
      this.sending?.abort();
      this.element.remove();
    });
    this.showComing();
    this.refresh();
  }

  /** Shows the layout as it is now. The field that has the focus keeps it. */
  refresh(): void {
    const model = this.events.model();
    const focused = (document.activeElement as HTMLElement | null)?.dataset.field;
    const had = this.element.contains(document.activeElement);
    const parts = [...model.parts.values()];
    const stocks = [...model.stocks.values()];
    this.parts.replaceChildren(...parts.map((part) => this.partRow(model, part)));
    if (parts.length === 0) this.parts.replaceChildren(h('tr', {}, h('td', { colspan: 5 }, t('order.empty'))));
    this.stocks.replaceChildren(...stocks.map((stock) => this.stockRow(stock)));
    if (stocks.length === 0) this.stocks.replaceChildren(h('tr', {}, h('td', { colspan: 3 }, t('job.no.stock'))));
    this.rules.replaceChildren(...RULES.map((name) => this.ruleField(model, name)));
    if (!had || this.element.contains(document.activeElement)) return;
    const again =
      focused === undefined ? null : this.element.querySelector<HTMLElement>(`[data-field="${CSS.escape(focused)}"]`);
    (again ?? this.element.querySelector<HTMLElement>('[data-action="job.add"]'))?.focus();
  }

  private partRow(model: Model, part: Part): HTMLElement {
    const quantity = textField(`quantity.${part.id}`, String(part.demand ?? 0), t('order.quantity'));
    quantity.inputMode = 'numeric';
    quantity.addEventListener('change', () => this.run(line.quantity(part.id, quantity.value), quantity));
    const angles = anglesOf(part);
    const offered = ROTATIONS.some((one) => one === angles) ? ROTATIONS : [...ROTATIONS, angles];
    const rotations = h(
      'select',
      {
        'aria-label': t('order.rotations'),
        'data-field': `rotations.${part.id}`,
        change: () => this.run(line.rotations(part.id, rotations.value), rotations),
      },
      ...offered.map((value) => option(value, value === 'any' ? t('order.any') : value, angles)),
    );
    const mirror = h('input', {
      type: 'checkbox',
      checked: part.mirror ?? false,
      'aria-label': t('order.mirror'),
      'data-field': `mirror.${part.id}`,
      change: () => this.run(line.mirror(part.id, mirror.checked), mirror),
    });
    const name = part.name ?? part.id;
    const inKits = model.wanted(part.id) - (part.demand ?? 0);
    const size = inKits > 0 ? `${sizeOf(part)} · ${t('job.in.kits', { n: inKits })}` : sizeOf(part);
    const what = h(
      'div',
      { class: 'drawing' },
      thumbnail(part.outline.polygon),
      h('span', { class: 'of' }, h('span', {}, name), h('small', {}, size)),
    );
    return h(
      'tr',
      { 'data-id': `job-part-${part.id}` },
      ...[what, quantity, rotations, mirror].map((cell) => h('td', {}, cell)),
      remover(`remove.${part.id}`, t('job.remove', { what: name }), () => this.run(line.removePart(part.id))),
    );
  }

  private stockRow(stock: Stock): HTMLElement {
    const count = textField(`count.${stock.id}`, String(stock.count ?? 1), t('order.count'));
    count.inputMode = 'numeric';
    count.addEventListener('change', () => this.run(line.count(stock.id, count.value), count));
    const name = stock.name ?? stock.id;
    const kind =
      stock.kind === 'strip' ? t('order.kind.strip') : t(stock.kind === 'hide' ? 'job.hide' : 'order.kind.sheet');
    const picture = stock.outline ? thumbnail(stock.outline.polygon) : null;
    return h(
      'tr',
      { 'data-id': `job-stock-${stock.id}` },
      h(
        'td',
        {},
        h('div', { class: 'drawing' }, picture, h('span', { class: 'of' }, h('span', {}, name), h('small', {}, kind))),
      ),
      h('td', {}, stock.kind === 'strip' ? null : count),
      remover(`stock.remove.${stock.id}`, t('job.remove', { what: name }), () => this.run(line.removeStock(stock.id))),
    );
  }

  private ruleField(model: Model, name: Rule): HTMLElement {
    const { gap = 0, border_gap = 0, kerf = 0 } = model.document.rules ?? {};
    const value = name === 'kerf' ? kerf : name === 'gap' ? gap : border_gap;
    const field = textField(`rule.${name}`, name === 'kerf' && kerf === 0 ? '' : mm(value), t(`order.${name}`));
    field.inputMode = 'decimal';
    if (name === 'kerf') field.placeholder = t('job.kerf');
    field.addEventListener('change', () => {
      // The cut may be unsaid again; a gap that is deleted is more likely a slip.
      const typed = length(field.value) || (name === 'kerf' ? '0' : '');
      const cut = name === 'kerf' ? Number(typed) : kerf;
      const raised = name !== 'border' && cut > (name === 'gap' ? Number(typed) : gap);
      this.run(line.rule(name, typed), field, raised ? t('job.raised', { mm: mm(cut) }) : undefined);
    });
    return h('label', {}, h('span', {}, `${t(`order.${name}`)}, ${t('job.mm')}`), field);
  }

  /** The fields of material that is to come. */
  private showComing(): void {
    const { next } = this;
    const kind = h(
      'select',
      {
        'aria-label': t('order.kind'),
        'data-field': 'new.kind',
        change: () => {
          next.kind = kind.value as StockKind;
          this.showComing();
          this.coming.querySelector<HTMLElement>('select')?.focus();
        },
      },
      ...(['sheet', 'strip', 'drawing'] as const).map((value) => option(value, t(`order.kind.${value}`), next.kind)),
    );
    const field = (key: 'width' | 'height' | 'count'): HTMLElement => {
      const input = textField(`new.${key}`, next[key], t(`order.${key}`));
      input.inputMode = 'decimal';
      input.placeholder = key === 'count' ? t('order.count.any') : t(`order.${key}`);
      input.addEventListener('input', () => (next[key] = input.value));
      return input;
    };
    const drawing = h('input', {
      type: 'file',
      'data-field': 'new.drawing',
      'aria-label': t('order.kind.drawing'),
      change: () => (next.file = drawing.files?.[0] ?? null),
    });
    const fields =
      next.kind === 'sheet'
        ? [field('width'), field('height'), field('count')]
        : next.kind === 'strip'
          ? [field('height')]
          : [drawing, field('count')];
    this.coming.replaceChildren(
      kind,
      ...fields,
      h(
        'button',
        { type: 'button', 'data-action': 'job.stock.add', click: () => this.addStock() },
        t('order.stock.add'),
      ),
    );
    // Enter in a field adds, as it would send a form.
    this.coming.onkeydown = (e) => {
      if (e.key !== 'Enter' || !(e.target instanceof HTMLInputElement) || e.target.type === 'file') return;
      e.preventDefault();
      this.addStock();
    };
  }

  private addDrawings(files: FileList | null): void {
    const all = [...(files ?? [])];
    if (all.length === 0) return;
    // A part that comes may lie as the first that is there.
    const first = [...this.events.model().parts.values()][0];
    const angles = first ? anglesOf(first) : 'any';
    const rotations = angles.includes('..') ? 'any' : angles;
    const ordered = all.map((file) => ({ file, quantity: '1', rotations, mirror: first?.mirror ?? false }));
    void this.add(additionsOf(ordered, []));
  }

  private addStock(): void {
    const { kind, width, height, file } = this.next;
    const lacks =
      kind === 'drawing'
        ? !file && t('job.no.file')
        : (height.trim() === '' || (kind === 'sheet' && width.trim() === '')) && t('job.no.size');
    if (lacks) return this.say({ text: lacks, isNote: false });
    void this.add(additionsOf([], [this.next]));
  }

  private async add(form: FormData): Promise<void> {
    if (this.sending) return;
    const { signal } = (this.sending = new AbortController());
    this.row.tell({ fraction: 0, since: 0 });
    this.say(await this.events.add(form, { told: (one) => this.sending && this.row.tell(one), signal }));
    this.sending = null;
    this.row.hide();
  }

  /**
   * Carries a line out. A field whose text is refused says so, and keeps it to be mended; what was chosen goes back.
   *
   * @param note what is said where it is done, as the layout will not be quite what was typed
   */
  private run(text: string, field?: HTMLElement, note?: string): void {
    void this.events.command(text).then((said) => {
      const isDone = said.text === '' || said.isNote;
      const differs = note !== undefined && isDone;
      const isText = field instanceof HTMLInputElement && field.type === 'text';
      if (differs || (!isDone && !isText)) this.refresh();
      this.say(differs ? { text: note, isNote: true } : said);
      const now = field?.dataset.field;
      const shown = now === undefined ? null : this.element.querySelector(`[data-field="${CSS.escape(now)}"]`);
      shown?.toggleAttribute('aria-invalid', !isDone && isText);
    });
  }

  private say({ text, isNote }: Said): void {
    this.said.textContent = text;
    this.said.className = isNote ? 'note' : 'trouble';
    this.said.setAttribute('role', isNote ? 'status' : 'alert');
  }

  private buttons(): HTMLElement {
    return h(
      'div',
      { class: 'buttons' },
      h(
        'button',
        {
          type: 'button',
          'data-action': 'job.undo',
          click: () => void this.events.undo().then((said) => this.say(said)),
        },
        t('undo'),
      ),
      h('span', { class: 'push' }),
      h(
        'button',
        {
          type: 'button',
          'data-action': 'job.close',
          click: () => (this.sending ? this.sending.abort() : this.element.close()),
        },
        t('job.close'),
      ),
    );
  }
}

export interface OpenJob {
  element: HTMLDialogElement;
  refresh(): void;
}
export const jobDialog = (events: JobEvents): OpenJob => new JobDialog(events);
