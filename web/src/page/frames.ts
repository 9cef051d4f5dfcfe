// When the picture is painted: once a frame, no more than has changed, and nothing that holds up the hand.

import type { Picture } from '../picture/draw';
import type { Scene } from '../picture/scene';

/** A frame paints nothing, the upper canvas, also the moved view, or everything: each includes those before it. */
const DUTIES = ['none', 'top', 'view', 'all'] as const;
export type Duty = (typeof DUTIES)[number];

/** The painting that one frame may spend on the lower canvas. */
export const SLICE_MS = 6;
/** The hand rests when the view has stood still for so long. */
const REST_BEFORE_SHARP_MS = 70;
const REST_BEFORE_MIRROR_MS = 60;

export interface FrameEvents {
  scene(): Scene;
  /** Says whether a photograph is in hand: it is followed at every step, whatever that costs. */
  pulled(): boolean;
  /** Is called when the view may be another. */
  moved(): void;
  /** Is called when the view has stood still for a while. */
  rested(): void;
  painted(duty: Duty): void;
}

export class Frames {
  private due: Duty = 'none';
  private sharpenDue: ReturnType<typeof setTimeout> | null = null;
  private slicing = false;
  private restDue: ReturnType<typeof setTimeout> | null = null;

  /** @param flags of the picture's element; tests read there what is still to come */
  constructor(
    private readonly drawing: Picture,
    private readonly flags: DOMStringMap,
    private readonly events: FrameEvents,
  ) {}

  later(duty: Duty): void {
    if (this.due === 'none') requestAnimationFrame(() => this.frame());
    if (DUTIES.indexOf(duty) > DUTIES.indexOf(this.due)) this.due = duty;
    if (duty !== 'top') this.flags.mirror = 'false';
  }

  private frame(): void {
    const duty = this.due;
    this.due = 'none';
    const { backdrop } = this.drawing;
    const scene = this.events.scene();
    if (duty === 'all' && !backdrop.draw(scene, this.events.pulled() ? Infinity : SLICE_MS)) this.sharpenLater(0);
    if (duty === 'view' && !backdrop.follow(scene, SLICE_MS)) this.sharpenLater(REST_BEFORE_SHARP_MS);
    if (duty !== 'top') {
      this.events.moved();
      this.restLater();
    }
    this.drawing.drawTop(scene);
    this.events.painted(duty);
  }

  /** Paints slice by slice what is old or stretched; while the hand zooms, not before it rests. */
  private sharpenLater(wait: number): void {
    if (this.sharpenDue) clearTimeout(this.sharpenDue);
    this.flags.sharp = 'false';
    if (wait > 0) this.sharpenDue = setTimeout(() => this.nextSlice(), wait);
    else this.nextSlice();
  }
  private nextSlice(): void {
    this.sharpenDue = null;
    if (!this.slicing) requestAnimationFrame(() => this.slice());
    this.slicing = true;
  }
  private slice(): void {
    this.slicing = false;
    if (!this.drawing.backdrop.sharpen(this.events.scene(), SLICE_MS)) return this.nextSlice();
    this.flags.sharp = 'true';
    this.events.painted('none');
  }

  private restLater(): void {
    if (this.restDue) clearTimeout(this.restDue);
    this.restDue = setTimeout(() => {
      this.restDue = null;
      this.events.rested();
      this.flags.mirror = 'true';
    }, REST_BEFORE_MIRROR_MS);
  }
}
