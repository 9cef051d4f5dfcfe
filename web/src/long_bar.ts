// What a long command is doing, over the picture: share done, time left, and a button that ends it with the best so far.

import type { Editor, Long } from './editor';
import { h } from './elements';
import { t } from './i18n';

/// A command that is done before says nothing, ms.
const PATIENCE = 300;

export function timeLeft(seconds: number | null): string {
  if (seconds === null || !(seconds >= 0)) return '';
  return seconds < 90 ? t('long.seconds', { s: Math.ceil(seconds) }) : t('long.minutes', { m: Math.ceil(seconds / 60) });
}

export class LongBar {
  private readonly what = h('b');
  private readonly share = h('progress', { max: 1 });
  private readonly says = h('span', { class: 'says' });
  private readonly stop = h('button', { 'data-action': 'long.stop', click: () => void this.editor.stopLong() });
  readonly element = h('div', { class: 'long', hidden: true, role: 'group' }, this.what, this.share, this.says, this.stop);
  private of: Long | null = null;
  private timer: ReturnType<typeof setTimeout> | null = null;

  /// \param leave where the focus goes when the bar does
  constructor(private readonly editor: Editor, private readonly leave: () => void) {}

  show(): void {
    const { long, queued } = this.editor;
    if (this.of !== long) {
      this.of = long;
      if (this.timer) clearTimeout(this.timer);
      this.timer = long ? setTimeout(() => this.unfold(), PATIENCE) : null;
      if (this.element.contains(document.activeElement)) this.leave();
      this.element.hidden = true;
    }
    if (!long) return;
    if (long.fraction !== null || long.best.length > 0) this.unfold();
    const name = t(`long.${long.verb}`);
    this.what.textContent = name;
    this.element.setAttribute('aria-label', name);
    this.share.setAttribute('aria-label', name);
    if (long.fraction === null) this.share.removeAttribute('value');
    else this.share.value = long.fraction;
    this.says.textContent = [
      long.fraction === null ? t('long.turn') : `${Math.floor(long.fraction * 100)} %`, timeLeft(long.secondsLeft),
      long.best.length > 0 ? t('long.best', { n: long.best.length }) : '', queued.length > 0 ? t('long.queued', { n: queued.length }) : '',
    ].filter(Boolean).join(' · ');
    this.stop.textContent = t(long.stopping ? 'long.stopping' : 'long.stop');
    this.stop.title = t('long.stop.hint');
    this.stop.disabled = long.stopping;
  }

  private unfold(): void {
    this.element.hidden = false;
  }
}
