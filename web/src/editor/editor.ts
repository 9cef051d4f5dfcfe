// The state of the page, and what a gesture does to it. Drawing and panels look at it and are told when it changes.

import { Checking } from '../work/checking';
import type { FeatureChange, LayoutDocument, Placement, Violation } from '../layout/document';
import { snapToGrid } from '../layout/grid';
import { UNKNOWN, type Kernel, type LiveState } from '../kernel/kernel';
import type { Mode } from '../layout/commands';
import { Model, type Change } from '../layout/model';
import { Photos } from './photos';
import type { Client, Connection, Course } from '../server/socket';
import { t } from '../i18n';
import { Transfer, type Answer } from '../work/transfer';

export type Tool = 'select' | 'slide' | 'push' | 'nearest' | 'measure' | 'pan' | 'defect' | 'zone' | 'photo';
export type Topic =
  | 'layout'
  | 'selection'
  | 'moving'
  | 'mode'
  | 'connection'
  | 'message'
  | 'show'
  | 'photo'
  | 'long'
  | 'check'
  | 'transfer';
export interface Feature {
  stock: string;
  kind: 'defect' | 'zone';
  id: string;
}
/// A command that runs beside the layout.
export interface Long {
  verb: LongVerb;
  seq: number;
  /// Share done; null: nothing heard yet.
  fraction: number | null;
  secondsLeft: number | null;
  /// What stopping it now would keep.
  best: Placement[];
  stopping: boolean;
  ended: Promise<void>;
}
/// What was dropped and waits for its turn.
export interface Queued {
  placements: Placement[];
}
/// A line for the server, or how to make one of the layout as it is when its turn comes; null: it means nothing any more.
export type Line = string | (() => string | null);

const LONG_VERBS = ['compact', 'fit', 'nest'] as const;
export type LongVerb = (typeof LONG_VERBS)[number];
const longVerb = (text: string): LongVerb | undefined => LONG_VERBS.find((verb) => text.startsWith(`${verb} `));

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
  moving = new Map<number, Placement>();
  live: LiveState | null = null;
  rotateStep = 15;
  /// Severity of the next defect, quality of the next zone.
  grades = { defect: 1, zone: 1 };
  readonly photos = new Photos(this);
  show = { labels: true, grain: true, gap: true, zones: true };
  message = '';
  pending = 0;
  long: Long | null = null;
  /// Dropped while a long command runs: carried out, one after the other, when it has ended.
  queued: Queued[] = [];
  /// What the last change put on a sheet.
  private fresh = new Set<number>();
  private listeners: ((topic: Topic) => void)[] = [];
  private asking = false;
  private next: { text: string } | null = null;
  private held: symbol | null = null;
  private resting: ReturnType<typeof setTimeout> | null = null;
  /// Files on their way from or to the server.
  readonly transfers = new Set<Transfer>();
  readonly checking = new Checking(
    () => this.kernel,
    () => this.model,
    (whole) => this.tell(whole ? 'layout' : 'check'),
  );

  constructor(public kernel: Kernel) {}

  /// What is known of them; null: not here.
  get violations(): readonly Violation[] | null {
    return this.checking.found;
  }

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
      this.checking.begin();
    } catch (error) {
      this.checking.fail();
      this.say(error instanceof Error ? error.message : String(error));
    }
    this.tell('layout');
  }

  apply(changes: readonly Change[], nextId: number, features: readonly FeatureChange[] = []): void {
    this.fresh = new Set(
      changes.filter(({ id, after }) => after && !this.model.placements.has(id)).map(({ id }) => id),
    );
    this.model.apply(changes, nextId, features);
    this.kernel.apply(changes, nextId, features);
    this.checking.changed(changes.map(({ id }) => id));
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
    this.held = null; // what was dropped before is not what is in hand
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

  /// Asks the server for what may take a while. \return null: cancelled. Throws where there is no answer
  async transfer(
    kind: Transfer['kind'],
    name: string,
    method: string,
    address: string,
    body?: Blob,
  ): Promise<Answer | null> {
    const one = new Transfer(kind, name, () => this.tell('transfer'));
    this.transfers.add(one);
    this.tell('transfer');
    try {
      return await one.send(method, address, body);
    } finally {
      this.transfers.delete(one);
      this.tell('transfer');
    }
  }

  /// Sends a command; what is in hand stays shown where it is until the server has decided.
  async command(line: Line): Promise<boolean> {
    return this.ask('command', line);
  }
  undo(): Promise<boolean> {
    return this.ask('undo');
  }
  redo(): Promise<boolean> {
    return this.ask('redo');
  }

  /// Ends the long command with the best it has. \return whether there is one
  stopLong(): boolean {
    if (!this.long) return false;
    this.client?.endEarly(this.long.seq);
    this.long.stopping = true;
    this.tell('long');
    return true;
  }

  private async ask(type: 'command' | 'undo' | 'redo', line: Line = ''): Promise<boolean> {
    const client = this.client;
    if (!client) return false;
    this.pending += 1;
    const queued = this.long ? this.enqueue() : null;
    while (this.long) await this.long.ended; // those before this one may be long too
    const text = typeof line === 'string' ? line : line();
    if (text === null) {
      this.pending -= 1;
      this.say(t('changed.meanwhile'));
      if (queued) this.leaveQueue(queued);
      else this.release();
      this.tell('connection');
      return false;
    }
    // What waited is no longer in hand: the hand may hold something else.
    const held = !queued && this.moving.size > 0 ? (this.held = Symbol()) : null;
    this.tell('connection');
    const verb = type === 'command' ? longVerb(text) : undefined;
    const course = verb && this.beginLong(verb);
    const answer = await client.ask(type === 'command' ? { type, mode: this.mode, text } : { type }, course);
    this.pending -= 1;
    if (answer.type === 'refused') {
      this.say(answer.message);
      const first = answer.violations?.[0];
      if (first && first.b !== null && this.model.placements.has(first.b)) this.others.set(-1, [first.b]);
    } else if (answer.type === 'lost') {
      this.say(t('lost.gesture'));
    } else if (answer.type === 'done') {
      this.say(answer.nothing ? t('nothing.moved') : answer.stopped ? t('long.stopped') : '');
      this.others.delete(-1);
      const fresh = (answer.placements ?? [])
        .filter(({ id, after }) => after && this.fresh.has(id))
        .map(({ id }) => id);
      if (fresh.length > 0 && type === 'command') this.select(fresh);
    }
    if (queued) this.leaveQueue(queued);
    if (held && this.held === held) this.release();
    course?.ended();
    this.tell('connection');
    return answer.type === 'done';
  }

  /// What is in hand stays in sight, and the hand is free for the next.
  private enqueue(): Queued {
    const mine: Queued = { placements: [...this.moving.values()] };
    this.queued.push(mine);
    this.release();
    this.tell('long');
    return mine;
  }
  private leaveQueue(one: Queued): void {
    this.queued = this.queued.filter((other) => other !== one);
    this.tell('long');
  }

  /// Where parts are going to be: what stopping now would keep, and what was dropped since.
  coming(): Map<number, Placement> {
    const all = [...(this.long?.best ?? []), ...this.queued.flatMap((one) => one.placements)];
    return new Map(all.map((p) => [p.id, p]));
  }

  private beginLong(verb: LongVerb): Course & { ended(): void } {
    let end = (): void => undefined;
    const long: Long = {
      verb,
      seq: 0,
      fraction: null,
      secondsLeft: null,
      best: [],
      stopping: false,
      ended: new Promise((resolve) => (end = resolve)),
    };
    this.long = long;
    this.tell('long');
    return {
      begun: (seq) => (long.seq = seq),
      progress: (fraction, secondsLeft) => {
        // Less than before: others have changed its parts, and it begins again.
        if (fraction < (long.fraction ?? 0)) long.best = [];
        [long.fraction, long.secondsLeft] = [fraction, secondsLeft];
        this.tell('long');
      },
      improved: (changes) => {
        long.best = changes.flatMap(({ after }) => after ?? []);
        this.tell('long');
      },
      ended: () => {
        this.long = null;
        end();
        this.tell('long');
      },
    };
  }
}

/// Placements moved by a vector on the grid, to another sheet where one is named.
export function movedBy(
  placements: readonly Placement[],
  dx: number,
  dy: number,
  to?: { stock: string; copy: number },
): Placement[] {
  const [x, y] = [snapToGrid(dx), snapToGrid(dy)];
  return placements.map((p) => ({ ...p, x: p.x + x, y: p.y + y, ...(to ?? {}) }));
}
