// The picture in the page: its canvases and what lies over them, the view, and the hand on it.

import type { Editor } from '../editor/editor';
import { h } from '../html/elements';
import { t } from '../i18n';
import type { Point, Violation } from '../layout/document';
import { placedAt, type Box, type Sheet } from '../layout/model';
import { Picture } from '../picture/draw';
import { Mirror, mirrorId } from '../picture/mirror';
import type { Scene, Theme } from '../picture/scene';
import { View } from '../picture/view';
import { PointerTool, turningHandle } from '../tools/pointer';
import { printFigures, type Bench } from './benchmark';
import { Frames, SLICE_MS, type Duty } from './frames';

/** A broken rule is shown with so much around it: of its amount, and at least so many mm. */
const AROUND_AMOUNT = 4;
const LEAST_AROUND_MM = 60;
const MARGIN = 28;

export class PicturePane {
  readonly view = new View();
  readonly drawing: Picture;
  readonly pointer: PointerTool;
  readonly element: HTMLElement;
  readonly bench: Bench;
  private readonly legend = h('div', { class: 'legend' });
  private readonly mirror = new Mirror();
  private readonly frames: Frames;
  /** The view has been fitted to the layout that is open. */
  private fitted = false;

  /**
   * @param theme the colours that hold now
   * @param measuring the measure in hand is another
   */
  constructor(
    private readonly editor: Editor,
    private readonly theme: () => Theme,
    private readonly measuring: () => void,
  ) {
    const base = h('canvas', { 'aria-hidden': 'true' });
    const top = h('canvas', { 'aria-hidden': 'true' });
    this.element = h(
      'main',
      { class: 'picture', tabindex: 0, role: 'application' },
      base,
      top,
      this.mirror.element,
      this.legend,
    );
    this.drawing = new Picture(base, top);
    this.frames = new Frames(this.drawing, this.element.dataset, {
      scene: () => this.scene(),
      pulled: () => [...editor.photos].some((photo) => photo.pulled),
      moved: () => this.mirror.place(this.view),
      rested: () => this.updateMirror(),
      painted: (duty) => this.painted(duty),
    });
    this.pointer = new PointerTool(this.element, editor, this.view, (duty) => this.later(duty));
    const { view, drawing, element: picture } = this;
    this.bench = { editor, view, drawing, picture, base, top, scene: () => this.scene(), sliceMs: SLICE_MS };
    new ResizeObserver(() => this.resized()).observe(this.element);
  }

  later(duty: Duty): void {
    this.frames.later(duty);
  }
  focus(): void {
    this.element.focus();
  }
  /** Words in another language. */
  showWords(): void {
    this.element.setAttribute('aria-label', t('canvas'));
    this.element.dataset.drop = t('drop');
    const signs = ['zone', 'defect', 'bad', 'near'] as const;
    this.legend.replaceChildren(...signs.map((sign) => h('span', { class: sign }, h('i'), t(`legend.${sign}`))));
  }

  /** Another layout is going to be shown whole. */
  begin(): void {
    this.fitted = false;
  }
  /** The layout is there, or has changed. */
  take(): void {
    this.drawing.take(this.editor.model);
    if (this.fitted) return;
    this.fitted = true;
    this.fitView();
  }
  fitAll(): void {
    this.fitView();
    this.later('view');
  }
  showSheet(sheet: Sheet): void {
    this.showBox(placedAt(sheet.box, sheet));
  }
  reveal(v: Violation): void {
    const sheet = this.editor.model.sheet(v.stock, v.copy);
    if (!sheet) return;
    this.editor.select(v.b === null ? [v.a] : [v.a, v.b]);
    const [x, y] = [v.at[0] + sheet.x, v.at[1] + sheet.y];
    const around = Math.max(LEAST_AROUND_MM, v.amount_mm * AROUND_AMOUNT);
    this.showBox({ left: x - around, right: x + around, bottom: y - around, top: y + around });
  }
  /** Moves the view to a part that lies beside it. */
  revealPart(id: number): void {
    const { editor, view } = this;
    const p = editor.model.placements.get(id);
    const sheet = p && editor.model.sheet(p.stock, p.copy);
    if (!p || !sheet) return;
    const b = editor.model.box(p);
    const seen = view.visible();
    const [x, y] = [(b.left + b.right) / 2 + sheet.x, (b.bottom + b.top) / 2 + sheet.y];
    if (x < seen.left || x > seen.right || y < seen.bottom || y > seen.top) {
      const [sx, sy] = view.toScreen(x, y);
      view.pan(view.width / 2 - sx, view.height / 2 - sy);
      this.later('view');
    }
  }
  /** Zooms about the middle of the picture. */
  zoom(factor: number): void {
    this.view.zoomAt(this.view.width / 2, this.view.height / 2, factor);
    this.later('view');
  }
  /** The place of a pointer, in the picture's mm. */
  worldAt(e: MouseEvent): Point {
    const box = this.element.getBoundingClientRect();
    return this.view.toWorld(e.clientX - box.left, e.clientY - box.top);
  }

  private showBox(box: Box): void {
    this.view.fit(box);
    this.later('view');
  }
  private fitView(): void {
    this.view.fit(this.editor.model.extent(), MARGIN, true);
  }
  private resized(): void {
    const { element, editor } = this;
    this.drawing.resize(this.view, element.clientWidth, element.clientHeight);
    if (editor.model.sheets.length > 0 && this.view.isFitted) this.fitView();
    this.later('all');
  }

  private scene(): Scene {
    const { editor, view } = this;
    return {
      model: editor.model,
      view,
      theme: this.theme(),
      selection: editor.selection,
      others: new Set([...editor.others.values()].flat()),
      violations: editor.violations ?? [],
      moving: editor.moving,
      coming: editor.coming(),
      live: editor.live,
      ...this.pointer.overlay,
      photos: editor.photos,
      pins: this.pins(),
      show: editor.show,
      handle: editor.moving.size === 0 ? turningHandle(editor, view) : null,
    };
  }
  /** The pinned points of the photographs, while the tool that pulls them is in hand. */
  private pins(): Point[] {
    const { editor } = this;
    if (editor.tool !== 'photo') return [];
    return editor.model.sheets.flatMap((sheet): Point[] => {
      const pinned = editor.photos.get(sheet.stock.id)?.pinned;
      return pinned ? [[pinned[0] + sheet.x, pinned[1] + sheet.y]] : [];
    });
  }

  private updateMirror(): void {
    const { editor, element } = this;
    const whole = editor.violations !== null && editor.checking.left === 0;
    this.mirror.update(editor.model, this.view, editor.selection, editor.violations, whole);
    const first = editor.chosen()[0];
    if (first === undefined) element.removeAttribute('aria-activedescendant');
    else element.setAttribute('aria-activedescendant', mirrorId(first));
  }

  private painted(duty: Duty): void {
    // An opaque canvas is black before it is painted for the first time.
    if (duty === 'all') this.element.dataset.painted = 'true';
    if (duty === 'top' && this.editor.tool === 'measure') this.measuring();
    if (!this.fitted || !this.drawing.backdrop.isWhole || performance.getEntriesByName('first view').length > 0) return;
    performance.mark('first view');
    if (new URL(location.href).searchParams.has('benchmark')) void printFigures(this.bench);
  }
}
