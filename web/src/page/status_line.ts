// The line below the picture: the place under the pointer, what is so where the parts in hand are, messages, and how
// the page stands with the server.

import type { Editor } from '../editor/editor';
import { h } from '../html/elements';
import { t } from '../i18n';
import type { LiveState } from '../kernel/kernel';
import type { Point } from '../layout/document';
import { measured } from '../picture/marks';
import type { Overlay } from '../tools/pointer';

export class StatusLine {
  private readonly where = h('span');
  private readonly live = h('span', { class: 'live', role: 'status', 'aria-live': 'polite' });
  private readonly message = h('span', { class: 'message', role: 'alert' });
  private readonly state = h('span', { role: 'status' });
  readonly element = h('footer', { class: 'status' }, this.where, this.live, this.message, this.state);

  constructor(
    private readonly editor: Editor,
    private readonly overlay: Overlay,
  ) {}

  showPlace([x, y]: Point): void {
    const sheet = this.editor.model.sheetAt(x, y);
    this.where.textContent = `${(x - (sheet?.x ?? 0)).toFixed(2)}  ${(y - (sheet?.y ?? 0)).toFixed(2)} ${t('job.mm')}`;
  }

  show(): void {
    const { editor, element } = this;
    const { ruler } = this.overlay;
    this.live.className = `live ${editor.live?.level ?? ''}`;
    this.live.textContent = ruler ? measured(ruler.from, ruler.to) : editor.live ? saidOf(editor.live) : this.chosen();
    const { text, isNote } = editor.message;
    this.message.textContent = this.message.title = text;
    this.message.className = isNote ? 'message note' : 'message';
    this.message.tabIndex = text ? 0 : -1;
    this.message.setAttribute('role', isNote ? 'status' : 'alert');
    element.dataset.pending = String(editor.pending);
    element.dataset.unchecked = String(editor.checking.left);
    this.state.textContent = this.connection();
  }

  private chosen(): string {
    const { size } = this.editor.selection;
    return size > 0 ? t('selected', { n: size }) : t('nothing');
  }
  private connection(): string {
    const { editor } = this;
    const others = [...editor.others.keys()].filter((client) => client >= 0).length;
    if (editor.layoutId === 0) return '';
    // Gestures that a long command keeps waiting are not being saved.
    const waiting = editor.long ? 1 + editor.queued.length : 0;
    const state = t(editor.pending > waiting ? 'state.saving' : `state.${editor.connection}`);
    return [others > 0 ? t('others', { n: others }) : '', state].filter(Boolean).join(' · ');
  }
}

function saidOf({ level, violations, nearest }: LiveState): string {
  const depth = violations.reduce((most, v) => Math.max(most, v.amount_mm), 0);
  const words = [
    t(`live.${level}`),
    depth > 0 ? t('live.depth', { mm: depth.toFixed(3) }) : '',
    nearest ? t('live.nearest', { mm: nearest.distance.toFixed(3) }) : '',
  ];
  return words.filter(Boolean).join(' · ');
}
