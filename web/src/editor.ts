// The state of the page, and what a gesture does to it. Drawing and panels look at it and are told when it changes.

import type { FeatureChange, LayoutDocument, Placement, Violation } from './document';
import { snapToGrid } from './grid';
import { UNKNOWN, type Kernel, type LiveState, type Mode } from './kernel_api';
import { Model, type Change } from './model';
import type { Photo } from './photo';
import type { Client, Connection } from './socket';
import { t } from './i18n';

export type Tool = 'select' | 'slide' | 'push' | 'nearest' | 'measure' | 'pan' | 'defect' | 'zone' | 'photo';
export type Topic = 'layout' | 'selection' | 'moving' | 'mode' | 'connection' | 'message' | 'show' | 'photo';
export interface Feature { stock: string; kind: 'defect' | 'zone'; id: string }

/// How far the nearest-distance line looks, mm.
const REACH = 50;

export class Editor {
  model = new Model({ format: 'lekalo-layout/1', units: 'mm' });
  name = '';
  layoutId = 0;
  client: Client | null = null;
  connection: Connection = 'connecting';
  mode: Mode = 'strict';
  tool: Tool = 'select';
  selection = new Set<number>();
  others = new Map<number, readonly number[]>();
  violations: Violation[] | null = null;
  moving = new Map<number, Placement>();
  live: LiveState | null = null;
  rotateStep = 15;
  /// Severity of the next defect, quality of the next zone.
  grades = { defect: 1, zone: 1 };
  photo: Photo | null = null;
  show = { labels: true, grain: true, gap: true, zones: true };
  message = '';
  pending = 0;
  private listeners: ((topic: Topic) => void)[] = [];
  private asking = false;
  private next: { text: string } | null = null;
  private held: symbol | null = null;
  private resting: ReturnType<typeof setTimeout> | null = null;

  constructor(public kernel: Kernel) {}

  on(listener: (topic: Topic) => void): void {
    this.listeners.push(listener);
  }
  tell(topic: Topic): void {
    for (const listener of this.listeners) listener(topic);
  }
  say(text: string): void {
    this.message = text;
    this.tell('message');
  }

  open(document: LayoutDocument, name: string): void {
    this.model = new Model(document);
    this.name = name;
    this.selection = new Set([...this.selection].filter((id) => this.model.placements.has(id)));
    this.release();
    try {
      this.kernel.open(document);
      this.violations = this.kernel.check();
    } catch (error) {
      this.violations = null;
      this.say(error instanceof Error ? error.message : String(error));
    }
    this.tell('layout');
  }

  apply(changes: readonly Change[], nextId: number, features: readonly FeatureChange[] = []): void {
    this.model.apply(changes, nextId, features);
    this.kernel.apply(changes, nextId, features);
    this.violations = this.kernel.check();
    for (const { id, after } of changes) if (!after) this.selection.delete(id);
    this.tell('layout');
  }

  select(ids: Iterable<number>): void {
    this.selection = new Set(ids);
    this.client?.select([...this.selection]);
    this.tell('selection');
  }

  setMode(mode: Mode): void {
    this.mode = mode;
    this.tell('mode');
  }
  setTool(tool: Tool): void {
    this.tool = tool;
    this.tell('mode');
  }

  /// Those of the selection that a command may take: ascending.
  chosen(): number[] {
    return [...this.selection].sort((a, b) => a - b);
  }
  placementsOf(ids: Iterable<number>): Placement[] {
    return [...ids].map((id) => this.model.placements.get(id)).filter((p): p is Placement => p !== undefined);
  }

  /// Shows placements in hand and finds out what is to be said about them. \p text: the command that would do it.
  hold(placements: readonly Placement[], text: string): void {
    this.moving = new Map(placements.map((p) => [p.id, p]));
    if (this.kernel.immediate) {
      try {
        this.live = this.kernel.state(placements, text, REACH, false) as LiveState;
      } catch (error) {
        this.live = UNKNOWN;
        this.say(error instanceof Error ? error.message : String(error));
      }
    } else {
      this.live = UNKNOWN;
      this.next = { text };
      void this.askLater();
    }
    if (this.resting) clearTimeout(this.resting);
    this.resting = setTimeout(() => this.deepen(), 40);
    this.tell('moving');
  }

  /// When the hand rests: how deep what is in hand overlaps.
  deepen(): void {
    if (!this.kernel.immediate || this.moving.size === 0 || this.live?.level !== 'forbidden') return;
    this.live = this.kernel.state([...this.moving.values()], '', REACH, true) as LiveState;
    this.tell('moving');
  }

  /// One question under way at a time; an answer to an older place than the shown one says nothing.
  private async askLater(): Promise<void> {
    if (this.asking) return;
    this.asking = true;
    while (this.next) {
      const { text } = this.next;
      this.next = null;
      const state = await this.kernel.state([...this.moving.values()], text, REACH, true);
      if (!this.next && this.moving.size > 0) {
        this.live = state;
        this.tell('moving');
      }
    }
    this.asking = false;
  }

  release(): void {
    if (this.resting) clearTimeout(this.resting);
    this.held = null;
    this.next = null;
    this.moving = new Map();
    this.live = null;
    this.tell('moving');
  }

  /// Sends a command; what is in hand stays shown where it is until the server has decided.
  async command(text: string): Promise<boolean> {
    return this.ask({ type: 'command', mode: this.mode, text });
  }
  undo(): Promise<boolean> {
    return this.ask({ type: 'undo' });
  }
  redo(): Promise<boolean> {
    return this.ask({ type: 'redo' });
  }

  private async ask(gesture: { type: 'command' | 'undo' | 'redo'; mode?: Mode; text?: string }): Promise<boolean> {
    if (!this.client) return false;
    const held = (this.held = Symbol());
    const before = new Set(this.model.placements.keys());
    this.pending += 1;
    this.tell('connection');
    const answer = await this.client.ask(gesture);
    this.pending -= 1;
    if (answer.type === 'refused') {
      this.say(answer.message);
      const first = answer.violations?.[0];
      if (first && first.b !== null && this.model.placements.has(first.b)) this.others.set(-1, [first.b]);
    } else if (answer.type === 'lost') {
      this.say(t('lost.gesture'));
    } else {
      this.say(answer.type === 'done' && answer.nothing ? t('nothing.moved') : '');
      this.others.delete(-1);
      const fresh = [...this.model.placements.keys()].filter((id) => !before.has(id));
      if (fresh.length > 0 && gesture.type === 'command') this.select(fresh);
    }
    if (this.held === held) this.release();
    this.tell('connection');
    return answer.type === 'done';
  }
}

/// Placements moved by a vector on the grid, to another sheet where one is named.
export function movedBy(placements: readonly Placement[], dx: number, dy: number, to?: { stock: string; copy: number }): Placement[] {
  const [x, y] = [snapToGrid(dx), snapToGrid(dy)];
  return placements.map((p) => ({ ...p, x: p.x + x, y: p.y + y, ...(to ?? {}) }));
}
