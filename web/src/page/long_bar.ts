// A row over the picture for everything that takes its time: the share done, the time left, a button that ends it.

import type { Editor } from '../editor/editor';
import { h } from '../html/elements';
import { t } from '../i18n';

/** Work that is done before shows no row, ms. */
const PATIENCE = 300;

/** Work that has a row. */
export interface Work {
  /** The object that stands for this work as long as it lasts. */
  of: object;
  kind: string;
  name: string;
  /** The share done; null: nobody can tell. */
  fraction: number | null;
  secondsLeft: number | null;
  says: string[];
  stop: { label: string; hint: string; done: boolean; run(): void };
}

export function timeLeft(seconds: number | null): string {
  if (seconds === null || !(seconds >= 0)) return '';
  return seconds < 90
    ? t('long.seconds', { s: Math.ceil(seconds) })
    : t('long.minutes', { m: Math.ceil(seconds / 60) });
}

/** The work that an editor is at. */
function worksOf(editor: Editor): Work[] {
  const { long, queued, checking, transfers } = editor;
  const works: Work[] = [];
  if (long) {
    works.push({
      of: long,
      kind: long.verb,
      name: t(`long.${long.verb}`),
      fraction: long.fraction,
      secondsLeft: long.secondsLeft,
      says: [
        long.fraction === null ? t('long.turn') : '',
        long.best.length > 0 ? t('long.best', { n: long.best.length }) : '',
        queued.length > 0 ? t('long.queued', { n: queued.length }) : '',
      ],
      stop: {
        label: t(long.stopping ? 'long.stopping' : 'long.stop'),
        hint: t('long.stop.hint'),
        done: long.stopping,
        run: () => void editor.stopLong(),
      },
    });
  }
  if (checking.left > 0 && !checking.stopped) {
    works.push({
      of: checking,
      kind: 'check',
      name: t('check.running'),
      fraction: checking.fraction,
      secondsLeft: checking.secondsLeft,
      says: [],
      stop: { label: t('check.stop'), hint: t('check.stop.hint'), done: false, run: () => checking.stop() },
    });
  }
  for (const one of transfers) {
    works.push({
      of: one,
      kind: one.kind,
      name: one.name,
      fraction: one.fraction,
      secondsLeft: one.secondsLeft,
      says: one.fraction === null ? [t('transfer.since', { s: one.since })] : [],
      stop: { label: t('transfer.cancel'), hint: t('transfer.cancel'), done: false, run: () => one.abort() },
    });
  }
  return works;
}

class Row {
  private readonly what = h('b');
  private readonly share = h('progress', { max: 1 });
  private readonly says = h('span', { class: 'says' });
  private readonly stop = h('button', { click: () => this.end() });
  readonly element = h(
    'div',
    { class: 'long', hidden: true, role: 'group' },
    this.what,
    this.share,
    this.says,
    this.stop,
  );
  private readonly timer = setTimeout(() => (this.element.hidden = false), PATIENCE);
  private end: () => void = () => undefined;

  constructor(kind: string) {
    this.element.dataset.work = kind;
    this.stop.dataset.action = `${kind}.stop`;
  }
  show(work: Work): void {
    this.what.textContent = work.name;
    this.element.setAttribute('aria-label', work.name);
    this.share.setAttribute('aria-label', work.name);
    if (work.fraction === null) this.share.removeAttribute('value');
    else this.share.value = work.fraction;
    this.says.textContent = [
      work.fraction === null ? '' : `${Math.floor(work.fraction * 100)} %`,
      timeLeft(work.secondsLeft),
      ...work.says,
    ]
      .filter(Boolean)
      .join(' · ');
    this.stop.textContent = work.stop.label;
    this.stop.title = work.stop.hint;
    this.stop.disabled = work.stop.done;
    this.end = work.stop.run;
  }
  close(): void {
    clearTimeout(this.timer);
    this.element.remove();
  }
}

export class LongBar {
  readonly element = h('div', { class: 'works' });
  private readonly rows = new Map<object, Row>();

  /** @param leave takes the focus when a row that has it goes */
  constructor(
    private readonly editor: Editor,
    private readonly leave: () => void,
  ) {}

  show(): void {
    const works = worksOf(this.editor);
    const there = new Set(works.map((work) => work.of));
    for (const [of, row] of this.rows) {
      if (there.has(of)) continue;
      if (row.element.contains(document.activeElement)) this.leave();
      row.close();
      this.rows.delete(of);
    }
    for (const work of works) {
      let row = this.rows.get(work.of);
      if (!row) {
        this.rows.set(work.of, (row = new Row(work.kind)));
        this.element.append(row.element);
      }
      row.show(work);
    }
  }
}
