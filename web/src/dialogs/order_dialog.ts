// Asks for a new layout: drawings with how many of each, and what they are cut from.

import { h } from '../html/elements';
import { t } from '../i18n';
import { drawingPicture, type ReadDrawing } from './drawing_picture';
import { drawingAdder, option, remover, SendingRow, tableHead, textField, type Sent } from './fields';
import { formOf, ROTATIONS, type OrderedFile, type OrderTerms, type Stock, type StockKind } from './order_form';

export interface OrderEvents {
  /** Gives the reason why the server refused, or null. */
  make(name: string, form: FormData, watched: { told(one: Sent): void; signal: AbortSignal }): Promise<string | null>;
  read: ReadDrawing;
}

const KINDS: readonly StockKind[] = ['sheet', 'strip', 'drawing'];

class OrderDialog {
  readonly element: HTMLDialogElement;
  private readonly name = textField('name', '', t('order.name'));
  private readonly parts = h('tbody');
  private readonly stocks = h('tbody');
  /** A picture is made once, as the rows are shown anew at every change. */
  private readonly pictures = new Map<File, HTMLElement>();
  private readonly closed = new AbortController();
  /** The order on its way; null: none is. */
  private sending: AbortController | null = null;
  private readonly row = new SendingRow(t('order.making'));
  private readonly trouble = h('p', { class: 'trouble', role: 'alert' });
  private readonly ok = h('button', { type: 'submit', 'data-action': 'order.make' }, t('order.make'));

  constructor(
    private readonly files: OrderedFile[],
    private readonly terms: OrderTerms,
    private readonly events: OrderEvents,
  ) {
    this.element = h(
      'dialog',
      { class: 'order', 'aria-label': t('order.title') },
      h('h2', {}, t('order.title')),
      h(
        'form',
        { submit: (e) => this.submit(e) },
        ...this.rows(),
        h('div', { class: 'footer' }, this.trouble, this.row.element, this.buttons()),
      ),
    );
    // The browser may close a dialog at the second Escape whatever is said to its `cancel`.
    const giveUp = (e: Event): void => {
      if (!this.sending || (e instanceof KeyboardEvent && e.key !== 'Escape')) return;
      e.preventDefault();
      this.sending.abort();
    };
    this.element.addEventListener('keydown', giveUp);
    this.element.addEventListener('cancel', giveUp);
    this.element.addEventListener('close', () => {
      this.closed.abort();
      this.element.remove();
    });
    this.showParts();
    this.showStocks();
  }

  private rows(): HTMLElement[] {
    return [
      h('label', { class: 'wide' }, h('span', {}, t('order.name')), this.name),
      h('h3', {}, t('order.parts')),
      h('table', {}, tableHead('order.file', 'order.quantity', 'order.rotations', 'order.mirror'), this.parts),
      drawingAdder('order', (files) => this.addFiles(files)),
      h('h3', {}, t('order.stock')),
      h('table', {}, tableHead('order.kind', 'order.width', 'order.height', 'order.count'), this.stocks),
      h(
        'button',
        { type: 'button', 'data-action': 'order.stock.add', click: () => this.addStock() },
        t('order.stock.add'),
      ),
      h(
        'div',
        { class: 'fields' },
        ...(['gap', 'border', 'kerf'] as const).map((key) => {
          const input = textField(key, this.terms[key], t(`order.${key}`));
          input.addEventListener('input', () => (this.terms[key] = input.value));
          return h('label', {}, h('span', {}, `${t(`order.${key}`)}, ${t('job.mm')}`), input);
        }),
      ),
    ];
  }

  private buttons(): HTMLElement {
    return h(
      'div',
      { class: 'buttons' },
      h(
        'button',
        {
          type: 'button',
          'data-action': 'order.cancel',
          click: () => (this.sending ? this.sending.abort() : this.element.close()),
        },
        t('export.cancel'),
      ),
      this.ok,
    );
  }

  private addFiles(files: FileList | null): void {
    const first = this.files.length;
    for (const file of files ?? [])
      this.files.push({ file, quantity: '1', rotations: this.files[0]?.rotations ?? 'any', mirror: false });
    this.showParts();
    if (this.files.length > first) this.focus(`quantity.${first}`);
  }

  private addStock(): void {
    this.terms.stocks.push({ kind: 'sheet', width: '', height: '', count: '', file: null });
    this.showStocks();
    this.focus(`width.${this.terms.stocks.length - 1}`);
  }

  /** Rows are made anew where one changes: the focus goes to the field where it goes on, or to what adds a row. */
  private focus(field: string, adder?: string): void {
    const found =
      this.element.querySelector<HTMLElement>(`[data-field="${field}"]`) ??
      this.element.querySelector<HTMLElement>(`[data-action="${adder}"]`);
    found?.focus();
    if (found instanceof HTMLInputElement) found.select();
  }

  private showParts(): void {
    // A layout that nobody has named is called after its first drawing.
    this.name.placeholder = this.files[0]?.file.name.replace(/\.[^.]*$/, '') ?? '';
    const row = (one: OrderedFile, i: number): HTMLElement => {
      const quantity = textField(`quantity.${i}`, one.quantity, t('order.quantity'));
      quantity.inputMode = 'numeric';
      quantity.addEventListener('input', () => (one.quantity = quantity.value));
      const rotations = h(
        'select',
        {
          'aria-label': t('order.rotations'),
          'data-field': `rotations.${i}`,
          change: () => (one.rotations = rotations.value),
        },
        ...ROTATIONS.map((value) => option(value, value === 'any' ? t('order.any') : value, one.rotations)),
      );
      const mirror = h('input', {
        type: 'checkbox',
        checked: one.mirror,
        'aria-label': t('order.mirror'),
        'data-field': `mirror.${i}`,
        change: () => (one.mirror = mirror.checked),
      });
      const cells = [this.drawing(one.file), quantity, rotations, mirror].map((cell) => h('td', {}, cell));
      return h(
        'tr',
        {},
        ...cells,
        remover(`remove.${i}`, t('order.remove'), () => {
          this.files.splice(i, 1);
          this.showParts();
          this.focus(`remove.${Math.min(i, this.files.length - 1)}`, 'order.add');
        }),
      );
    };
    this.parts.replaceChildren(...this.files.map(row));
    if (this.files.length === 0) this.parts.replaceChildren(h('tr', {}, h('td', { colspan: 5 }, t('order.empty'))));
  }

  private drawing(file: File): HTMLElement {
    let picture = this.pictures.get(file);
    if (!picture) this.pictures.set(file, (picture = drawingPicture(file, this.events.read, this.closed.signal)));
    return h('div', { class: 'of' }, h('span', {}, file.name), picture);
  }

  private showStocks(): void {
    this.stocks.replaceChildren(...this.terms.stocks.map((stock, i) => this.stockRow(stock, i)));
  }

  private stockRow(stock: Stock, i: number): HTMLElement {
    const kind = h(
      'select',
      {
        'aria-label': t('order.kind'),
        'data-field': `kind.${i}`,
        change: () => {
          stock.kind = kind.value as StockKind;
          this.showStocks();
          this.focus(`kind.${i}`);
        },
      },
      ...KINDS.map((value) => option(value, t(`order.kind.${value}`), stock.kind)),
    );
    const field = (key: 'width' | 'height' | 'count'): HTMLInputElement => {
      const input = textField(`${key}.${i}`, stock[key], t(`order.${key}`));
      input.inputMode = 'decimal';
      if (key === 'count') input.placeholder = t('order.count.any');
      input.addEventListener('input', () => (stock[key] = input.value));
      return input;
    };
    const drawing = h('input', {
      type: 'file',
      'data-field': `drawing.${i}`,
      'aria-label': t('order.kind.drawing'),
      change: () => (stock.file = drawing.files?.[0] ?? null),
    });
    const cells =
      stock.kind === 'sheet'
        ? [h('td', {}, field('width')), h('td', {}, field('height')), h('td', {}, field('count'))]
        : stock.kind === 'strip'
          ? [h('td'), h('td', {}, field('height')), h('td')]
          : [h('td', { colspan: 2 }, drawing), h('td', {}, field('count'))];
    const remove = (): void => {
      this.terms.stocks.splice(i, 1);
      this.showStocks();
      this.focus(`stock.remove.${Math.min(i, this.terms.stocks.length - 1)}`, 'order.stock.add');
    };
    return h('tr', {}, h('td', {}, kind), ...cells, remover(`stock.remove.${i}`, t('order.remove'), remove));
  }

  private submit(e: Event): void {
    e.preventDefault();
    if (this.sending) return;
    const { signal } = (this.sending = new AbortController());
    void (async () => {
      this.ok.setAttribute('aria-disabled', 'true'); // a disabled button would lose the focus
      this.trouble.textContent = '';
      this.row.tell({ fraction: 0, since: 0 });
      const name = this.name.value.trim() || this.name.placeholder || t('order.title');
      const watched = { told: (one: Sent) => this.row.tell(one), signal };
      const refused = await this.events.make(name, formOf(this.files, this.terms), watched);
      this.sending = null;
      this.row.hide();
      this.ok.removeAttribute('aria-disabled');
      if (refused === null) return this.element.close();
      this.trouble.textContent = refused;
      this.ok.focus();
    })();
  }
}

/** @param terms are those of the last order, and are changed as they are typed */
export function orderDialog(files: readonly File[], terms: OrderTerms, events: OrderEvents): HTMLDialogElement {
  const ordered = files.map((file) => ({ file, quantity: '1', rotations: 'any', mirror: false }));
  return new OrderDialog(ordered, terms, events).element;
}
