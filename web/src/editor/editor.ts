// The state of the page, and the gestures that change it. Drawing and panels look at it and are told when it changes.

import { Checking } from '../tasks/checking';
import type { FeatureChange, Kit, LayoutDocument, Placement, Violation } from '../layout/document';
import { snapToGrid } from '../layout/grid';
import { UNKNOWN, type Kernel, type LiveState } from '../kernel/kernel';
import type { Mode } from '../layout/commands';
import { Model, type Change } from '../layout/model';
import { Photos } from './photos';
import type { Client, Connection, Course, Done } from '../server/socket';
import { t } from '../i18n';
import { Transfer, type Answer } from '../tasks/transfer';

export type Tool = 'select' | 'slide' | 'push' | 'nearest' | 'measure' | 'pan' | 'defect' | 'zone' | 'photo';
export type Topic =
  'layout' | 'selection' | 'moving' | 'mode' | 'connection' | 'message' | 'photo' | 'long' | 'check' | 'transfer';
export interface Feature {
  stock: string;
  kind: 'defect' | 'zone';
  id: string;
}
/** A command that takes long: the server works at it beside the layout. */
export interface Long {
  verb: LongVerb;
  seq: number;
  /** The share done; null: the server has not said anything yet. */
  fraction: number | null;
  secondsLeft: number | null;
  /** The placements that stopping it now would keep. */
  best: Placement[];
  stopping: boolean;
  ended: Promise<void>;
}
/** Who watches a request from its own place, as a dialog does that lies over the rows of the page. */
export interface Watched {
  told(one: Transfer): void;
  signal: AbortSignal;
}
/** A gesture that waits for its turn, with the placements that were dropped. */
export interface Queued {
  placements: Placement[];
}

/**
 * What went with a part or a sheet, in words.
 *
 * @param before the kits as they were
 */
function goneWith({ taken_off = 0, kits = [], kits_gone = [] }: Done, before: readonly Kit[] = []): string {
  const names = (ids: readonly string[]): string =>
    ids.map((id) => before.find((kit) => kit.id === id)?.name ?? id).join(', ');
  return [
    taken_off > 0 ? t('job.taken', { n: taken_off }) : '',
    kits.length > 0 ? t('job.kits', { kits: names(kits) }) : '',
    kits_gone.length > 0 ? t('job.kits.gone', { kits: names(kits_gone) }) : '',
  ]
    .filter((one) => one !== '')
    .join(' · ');
}

/**
 * A line for the server, or a function that makes one of the layout as it is when its turn comes; the function gives
 * null where the gesture has lost its meaning.
 */
export type Line = string | (() => string | null);

const LONG_VERBS = ['compact', 'fit', 'nest'] as const;
export type LongVerb = (typeof LONG_VERBS)[number];
const longVerb = (text: string): LongVerb | undefined => LONG_VERBS.find((verb) => text.startsWith(`${verb} `));

/** The line to the nearest part looks so far, mm. */
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
  /** The severity of the next defect, and the quality of the next zone. */
  grades = { defect: 1, zone: 1 };
  readonly photos = new Photos(this);
  show = { labels: true, grain: true, gap: true, zones: true };
  message = { text: '', isNote: false };
  /** A layout is on its way from the server, as it is from the beginning on. */
  loading = true;
  pending = 0;
  long: Long | null = null;
  /** Gestures made while a long command runs; they are carried out one after the other when it has ended. */
  queued: Queued[] = [];
  /** The placements that the last change added. */
  private fresh = new Set<number>();
  private listeners: ((topic: Topic) => void)[] = [];
  private asking = false;
  private next: { text: string } | null = null;
  private held: symbol | null = null;
  private resting: ReturnType<typeof setTimeout> | null = null;
  /** The files on their way from or to the server. */
  readonly transfers = new Set<Transfer>();
  readonly checking = new Checking(
    () => this.kernel,
    () => this.model,
    (whole) => this.tell(whole ? 'layout' : 'check'),
  );

  constructor(public kernel: Kernel) {}

  /** The broken rules that are known; null: nobody here can tell. */
  get violations(): readonly Violation[] | null {
    return this.checking.found;
  }

  on(listener: (topic: Topic) => void): void {
    this.listeners.push(listener);
  }
  tell(topic: Topic): void {
    for (const listener of this.listeners) listener(topic);
  }
  /** Says what went wrong. */
  say(text: string): void {
    this.message = { text, isNote: false };
    this.tell('message');
  }
  /** Says what is good to know, and nobody's fault. */
  note(text: string): void {
    this.message = { text, isNote: true };
    this.tell('message');
  }
  /** Says whether leaving the page now would lose something: a long command, a file on its way, a step to be saved. */
  get isAtWork(): boolean {
    return this.long !== null || this.pending > 0 || this.transfers.size > 0;
  }

  open(document: LayoutDocument, name: string): void {
    this.loading = false;
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

  /** The selection as commands name it: ascending. */
  chosen(): number[] {
    return [...this.selection].sort((a, b) => a - b);
  }
  placementsOf(ids: Iterable<number>): Placement[] {
    return [...ids].map((id) => this.model.placements.get(id)).filter((p): p is Placement => p !== undefined);
  }

  /**
   * Shows placements in hand, and asks the kernel about them.
   *
   * @param text the command that would bring them there
   */
  hold(placements: readonly Placement[], text: string): void {
    this.held = null; // the parts that were dropped before are no longer in hand
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

  /** Asks how deep the parts in hand overlap; this is for a hand that rests. */
  deepen(): void {
    if (!this.kernel.immediate || this.moving.size === 0 || this.live?.level !== 'forbidden') return;
    this.live = this.kernel.state([...this.moving.values()], '', REACH, true) as LiveState;
    this.tell('moving');
  }

  /** Asks the server, one question at a time. An answer about an older place than the shown one is dropped. */
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

  /**
   * Asks the server for something that may take a while. Throws where there is no answer.
   *
   * @param watched is told how far it is, and can give it up
   * @returns null: it was cancelled
   */
  async transfer(
    kind: Transfer['kind'],
    name: string,
    method: string,
    address: string,
    body?: Blob | FormData,
    watched?: Watched,
  ): Promise<Answer | null> {
    const one = new Transfer(kind, name, () => {
      watched?.told(one);
      this.tell('transfer');
    });
    watched?.signal.addEventListener('abort', () => one.abort());
    this.transfers.add(one);
    this.tell('transfer');
    try {
      return await one.send(method, address, body);
    } finally {
      this.transfers.delete(one);
      this.tell('transfer');
    }
  }

  /** Sends a command. The parts in hand stay shown where they are until the server has decided. */
  async command(line: Line): Promise<boolean> {
    return this.ask('command', line);
  }
  undo(): Promise<boolean> {
    return this.ask('undo');
  }
  redo(): Promise<boolean> {
    return this.ask('redo');
  }

  /**
   * Ends the long command with the best it has.
   *
   * @returns whether there is one
   */
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
    while (this.long) await this.long.ended; // a gesture before this one may be long, too
    const text = typeof line === 'string' ? line : line();
    if (text === null) {
      this.pending -= 1;
      this.say(t('changed.meanwhile'));
      if (queued) this.leaveQueue(queued);
      else this.release();
      this.tell('connection');
      return false;
    }
    // A gesture that waited is no longer in hand: the hand may hold something else.
    const held = !queued && this.moving.size > 0 ? (this.held = Symbol()) : null;
    this.tell('connection');
    const verb = type === 'command' ? longVerb(text) : undefined;
    const course = verb && this.beginLong(verb);
    const { kits } = this.model.document;
    const answer = await client.ask(type === 'command' ? { type, mode: this.mode, text } : { type }, course);
    this.pending -= 1;
    if (answer.type === 'refused') {
      this.say(answer.message);
      const first = answer.violations?.[0];
      if (first && first.b !== null && this.model.placements.has(first.b)) this.others.set(-1, [first.b]);
    } else if (answer.type === 'lost') {
      this.say(t('lost.gesture'));
    } else if (answer.type === 'done') {
      const said = answer.nothing ? t('nothing.moved') : answer.stopped ? t('long.stopped') : '';
      this.note(goneWith(answer, kits) || said);
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

  /** Puts the parts in hand into the queue: they stay in sight, and the hand is free for the next. */
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

  /** The places that parts are going to have: those that stopping now would keep, and those dropped since. */
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
        // The share falls when others have changed its parts, and it begins again.
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

/** Placements moved by a vector on the grid, to another sheet where one is named. */
export function movedBy(
  placements: readonly Placement[],
  dx: number,
  dy: number,
  to?: { stock: string; copy: number },
): Placement[] {
  const [x, y] = [snapToGrid(dx), snapToGrid(dy)];
  return placements.map((p) => ({ ...p, x: p.x + x, y: p.y + y, ...(to ?? {}) }));
}
