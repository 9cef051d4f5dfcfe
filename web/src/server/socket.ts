// The client's side of docs/protocol.md. It knows messages and their order, nothing of drawing.

import type { FeatureChange, LayoutDocument, Placement, Violation } from '../layout/document';
import type { Mode } from '../layout/commands';
import type { Change } from '../layout/model';

export interface LayoutMessage {
  type: 'layout';
  client: number;
  revision: number;
  name: string;
  document: LayoutDocument;
}
export interface ChangeMessage {
  type: 'change';
  revision: number;
  client: number;
  text: string;
  kind: 'command' | 'undo' | 'redo' | 'restore';
  placements: Change[];
  features?: FeatureChange[];
  next_id: number;
}
export interface Refusal {
  message: string;
  violations: Violation[];
}
export interface Done {
  type: 'done';
  seq: number;
  revision: number;
  nothing?: boolean;
  stopped?: boolean;
  /** The pieces that went with their part or sheet. */
  taken_off?: number;
  /** The kits that are made without a part that was removed, and those that were made of nothing else. */
  kits?: string[];
  kits_gone?: string[];
  /** The changes of the command, where this client saw them. */
  placements?: Change[];
}
export type Answer =
  | Done
  | ({ type: 'refused'; seq: number } & Refusal)
  | { type: 'preview'; seq: number; placements: Change[]; violations: Violation[] }
  | { type: 'lost' };
/** The messages about a long command before its answer. */
export interface Course {
  begun(seq: number): void;
  progress(fraction: number, secondsLeft: number | null): void;
  improved(placements: Change[]): void;
}
export type Connection = 'connecting' | 'open' | 'lost' | 'stopped';

export interface SocketEvents {
  layout(message: LayoutMessage): void;
  change(message: ChangeMessage): void;
  selections(clients: { client: number; ids: number[] }[]): void;
  name?(name: string): void;
  /** The photograph of a stock lies elsewhere or, where `image` is true, is another one. */
  photos?(stock: string, image: boolean): void;
  error(message: string): void;
  connection(state: Connection): void;
}
/** The part of a WebSocket that this client uses; tests bring their own. */
export interface Wire {
  send(text: string): void;
  close(): void;
  onopen: (() => void) | null;
  onmessage: ((event: { data: unknown }) => void) | null;
  onclose: (() => void) | null;
}
interface Gesture {
  type: 'command' | 'preview' | 'undo' | 'redo';
  mode?: Mode;
  text?: string;
}

export class Client {
  revision = -1;
  id = 0;
  private wire: Wire | null = null;
  private seq = 0;
  private readonly waiting = new Map<number, (answer: Answer) => void>();
  private readonly courses = new Map<number, Course>();
  private ahead: { revision: number; tell: (change?: ChangeMessage) => void }[] = [];
  private retries = 0;
  private timer: ReturnType<typeof setTimeout> | null = null;
  private ended = false;

  constructor(
    private readonly connect: () => Wire,
    private readonly events: SocketEvents,
  ) {}

  start(): void {
    this.ended = false;
    this.events.connection('connecting');
    const wire = (this.wire = this.connect());
    wire.onopen = () => undefined;
    wire.onmessage = (event) => {
      if (this.wire === wire) this.take(String(event.data));
    };
    wire.onclose = () => {
      if (this.wire === wire) this.lose();
    };
  }

  stop(): void {
    this.ended = true;
    if (this.timer) clearTimeout(this.timer);
    const wire = this.wire;
    this.wire = null;
    wire?.close();
    this.answerAllLost();
  }

  get connected(): boolean {
    return this.wire !== null && this.revision >= 0;
  }

  /** Sends a message. There is always an answer: 'lost' where the connection broke before the server gave one. */
  ask(gesture: Gesture, course?: Course): Promise<Answer> {
    if (!this.wire || this.revision < 0) return Promise.resolve({ type: 'lost' });
    const seq = ++this.seq;
    return new Promise((resolve) => {
      this.waiting.set(seq, resolve);
      if (course) this.courses.set(seq, course);
      course?.begun(seq);
      this.wire!.send(JSON.stringify({ ...gesture, seq }));
    });
  }

  /** Ends a long command early; its answer tells the result. */
  endEarly(seq: number): void {
    if (this.connected && this.courses.has(seq)) this.wire!.send(JSON.stringify({ type: 'stop', seq }));
  }

  select(ids: readonly number[]): void {
    if (this.connected) this.wire!.send(JSON.stringify({ type: 'select', ids }));
  }

  private take(text: string): void {
    let message: { type: string; [key: string]: unknown };
    try {
      message = JSON.parse(text);
    } catch {
      this.events.error('The server sent something that is no message.');
      return;
    }
    switch (message.type) {
      case 'layout': {
        const layout = message as unknown as LayoutMessage;
        this.revision = layout.revision;
        this.id = layout.client;
        this.retries = 0;
        this.events.layout(layout);
        this.tellAhead(layout.revision);
        this.events.connection('open');
        break;
      }
      case 'change': {
        const change = message as unknown as ChangeMessage;
        if (change.revision <= this.revision) break;
        if (change.revision !== this.revision + 1) {
          this.resync();
          break;
        }
        this.revision = change.revision;
        this.events.change(change);
        this.tellAhead(change.revision, change);
        break;
      }
      case 'done':
      case 'refused':
      case 'preview': {
        const answer = message as unknown as Exclude<Answer, { type: 'lost' }>;
        const resolve = this.waiting.get(answer.seq);
        this.waiting.delete(answer.seq);
        this.courses.delete(answer.seq);
        // The change comes after its `done`: the caller is told when the layout has followed it.
        if (answer.type === 'done' && answer.revision > this.revision) {
          this.ahead.push({
            revision: answer.revision,
            tell: (change) =>
              resolve?.(change?.revision === answer.revision ? { ...answer, placements: change.placements } : answer),
          });
        } else resolve?.(answer);
        break;
      }
      case 'progress':
        this.courses
          .get(Number(message.seq))
          ?.progress(Number(message.fraction), typeof message.seconds_left === 'number' ? message.seconds_left : null);
        break;
      case 'improved':
        this.courses.get(Number(message.seq))?.improved(message.placements as Change[]);
        break;
      case 'selections':
        this.events.selections(
          (message.clients as { client: number; ids: number[] }[]).filter((c) => c.client !== this.id),
        );
        break;
      case 'name':
        this.events.name?.(String(message.name));
        break;
      case 'photos':
        this.events.photos?.(String(message.stock), message.image === true);
        break;
      case 'error':
        this.events.error(String(message.message));
        break;
      case 'bye':
        this.events.error(String(message.message));
        this.events.connection('stopped');
        break;
    }
  }

  /** Connects anew and reads everything, as a revision is missing. */
  private resync(): void {
    const wire = this.wire;
    this.wire = null;
    wire?.close();
    this.lose();
  }

  private lose(): void {
    this.wire = null;
    this.revision = -1;
    this.answerAllLost();
    if (this.ended) return;
    this.events.connection('lost');
    this.timer = setTimeout(() => this.start(), Math.min(10_000, 250 * 2 ** this.retries++));
  }

  private tellAhead(revision: number, change?: ChangeMessage): void {
    const told = this.ahead.filter((one) => one.revision <= revision);
    this.ahead = this.ahead.filter((one) => one.revision > revision);
    for (const one of told) one.tell(change);
  }

  private answerAllLost(): void {
    this.tellAhead(Infinity); // the server had acknowledged them
    const waiting = [...this.waiting.values()];
    this.waiting.clear();
    this.courses.clear();
    for (const resolve of waiting) resolve({ type: 'lost' });
  }
}

export const changesOf = (placements: readonly Placement[]): Change[] =>
  placements.map((after) => ({ id: after.id, after }));
