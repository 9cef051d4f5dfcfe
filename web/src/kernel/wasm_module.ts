// The layout kernel (lekalo.wasm): the same C++ as the server's, so its answers are the server's. What the calls
// do: bindings/wasm/kernel.hpp. Lengths are millimetres; stocks, parts, defects are indices into the document.

export interface Placement {
  id: number;
  part: number;
  stock: number;
  copy: number;
  /** Cosine and sine. Take them from a document or from Kernel.rotation, never from Math. */
  c: number;
  s: number;
  x: number;
  y: number;
  mirrored: boolean;
  locked: boolean;
}

/** A placement as layout files and the protocol write it. */
export interface PlacementMessage {
  id: number;
  part: string;
  stock: string;
  copy?: number;
  c: number;
  s: number;
  x: number;
  y: number;
  mirrored?: boolean;
  locked?: boolean;
}

export interface ChangeMessage {
  placements: { id: number; after: PlacementMessage | null }[];
  features?: readonly { stock: string; kind: 'defect' | 'zone'; id: string; index: number; after: object | null }[];
  next_id: number;
}

export const violationKinds = [
  'overlap',
  'gap',
  'outside',
  'border-gap',
  'defect',
  'defect-gap',
  'quality',
  'rotation',
  'mirror',
  'grain',
  'stock',
] as const;
export type ViolationKind = (typeof violationKinds)[number];

export interface Violation {
  kind: ViolationKind;
  a: number;
  /** 0 where there is none. */
  b: number;
  stock: number;
  copy: number;
  /** Index of the defect or zone. */
  feature: number;
  amount: number;
  at: [number, number];
  /** Unit vector in which to move a; (0, 0) where there is none. */
  direction: [number, number];
}

export interface Nearest {
  distance: number;
  to: 'part' | 'border' | 'defect';
  /** Id of the other placement, index of the defect. */
  other: number;
  /** Which of the placements asked about. */
  id: number;
  onOther: [number, number];
  onPart: [number, number];
}

export interface State {
  level: 'clear' | 'gap' | 'forbidden';
  nearest: Nearest | null;
  violations: Violation[];
}

/** What a look at some of the unchecked placements found. */
export interface Looked {
  /** How many are still unchecked. */
  left: number;
  /** Ids of those that were looked at. */
  ids: number[];
  violations: Violation[];
}

export interface Plan {
  changed: Placement[];
  removed: number[];
  nextId: number;
}

/** How many of a kit are complete, and what those lack that are wanted and not complete. */
export interface KitCount {
  kit: string;
  wanted: number;
  complete: number;
  /** Of either hand where `mirrored` is absent. */
  missing: { part: string; count: number; mirrored?: boolean }[];
}

/** Loops of points x, y, x, y, ...: outer loop counter-clockwise, holes clockwise, in the outline's own frame. */
export type Outline = Float64Array[];

/** What the kernel answers to a request that it cannot carry out. */
export class Refusal extends Error {
  override name = 'Refusal';
}

interface Exports {
  memory: WebAssembly.Memory;
  _initialize(): void;
  lekalo_input(bytes: number): number;
  lekalo_text(): number;
  lekalo_text_size(): number;
  lekalo_numbers(): number;
  lekalo_numbers_size(): number;
  lekalo_open(bytes: number): number;
  lekalo_close(layout: number): number;
  lekalo_document(layout: number): number;
  lekalo_set(layout: number): number;
  lekalo_erase(layout: number, id: number): number;
  lekalo_set_next_id(layout: number, id: number): number;
  lekalo_set_feature(layout: number, stock: number, kind: number, index: number, bytes: number): number;
  lekalo_erase_feature(layout: number, stock: number, kind: number, bytes: number): number;
  lekalo_state(
    layout: number,
    count: number,
    dx: number,
    dy: number,
    degrees: number,
    reach: number,
    depths: number,
  ): number;
  lekalo_state_of(layout: number, count: number, reach: number, depths: number): number;
  lekalo_check(layout: number): number;
  lekalo_check_some(layout: number, most: number): number;
  lekalo_plan(layout: number, bytes: number, strict: number): number;
  lekalo_pick(layout: number, stock: number, copy: number, x: number, y: number): number;
  lekalo_in_box(
    layout: number,
    stock: number,
    copy: number,
    left: number,
    bottom: number,
    right: number,
    top: number,
  ): number;
  lekalo_fits_where(layout: number, part: number, stock: number, copy: number, most: number, mirrored: number): number;
  lekalo_placements(layout: number): number;
  lekalo_outline(layout: number, kind: number, a: number, b: number): number;
  lekalo_completeness(layout: number): number;
  lekalo_kits(layout: number): number;
  lekalo_rotation(degrees: number): number;
  lekalo_degrees(c: number, s: number): number;
}

const placementSize = 10;
const violationSize = 11;
const nearestSize = 8;

/** One instance: one thread, any number of layouts. */
export class Kernel {
  private constructor(private readonly wasm: Exports) {}

  /** @param source the bytes of lekalo.wasm, or the answer to fetching it */
  static async load(source: BufferSource | Response | Promise<Response>): Promise<Kernel> {
    const from = await source;
    const bytes = from instanceof Response ? await from.arrayBuffer() : from;
    const module = await WebAssembly.compile(bytes);
    const imports: Record<string, Record<string, (...args: number[]) => number>> = {};
    for (const { module: group, name } of WebAssembly.Module.imports(module)) {
      (imports[group] ??= {})[name] = () => 8; // EBADF: there is nothing to write to
    }
    let wasm: Exports | undefined;
    const textAt = (at: number): string => {
      const all = new Uint8Array(wasm!.memory.buffer);
      return new TextDecoder().decode(all.subarray(at, all.indexOf(0, at)));
    };
    (imports['lekalo'] ??= {})['broken'] = (expression = 0, file = 0, line = 0) => {
      throw new Error(`lekalo: internal error: ${textAt(expression)} (${textAt(file)}:${line})`);
    };
    const instance = await WebAssembly.instantiate(module, imports);
    wasm = instance.exports as unknown as Exports;
    wasm._initialize();
    return new Kernel(wasm);
  }

  /** Opens a layout document. Throws a Refusal with the reader's sentence. */
  open(document: string): Layout {
    const handle = this.wasm.lekalo_open(this.putText(document));
    if (handle < 0) throw new Refusal(this.text());
    return new Layout(this, this.wasm, handle, this.text().split('\n').filter(Boolean));
  }

  /** The cosine and sine that the kernel takes for an angle. */
  rotation(degrees: number): { c: number; s: number } {
    this.demand(this.wasm.lekalo_rotation(degrees));
    const [c, s] = this.numbers() as unknown as [number, number];
    return { c, s };
  }

  /** The angle of a pair, in (-180, 180]. */
  degrees(c: number, s: number): number {
    this.demand(this.wasm.lekalo_degrees(c, s));
    return this.numbers()[0]!;
  }

  /** @internal */
  putText(text: string): number {
    const bytes = new TextEncoder().encode(text);
    const at = this.wasm.lekalo_input(bytes.length);
    new Uint8Array(this.wasm.memory.buffer, at, bytes.length).set(bytes);
    return bytes.length;
  }
  /** @internal */
  putNumbers(values: ArrayLike<number>): void {
    const at = this.wasm.lekalo_input(8 * values.length);
    new Float64Array(this.wasm.memory.buffer, at, values.length).set(values);
  }
  /** @internal */
  text(): string {
    return new TextDecoder().decode(
      new Uint8Array(this.wasm.memory.buffer, this.wasm.lekalo_text(), this.wasm.lekalo_text_size()),
    );
  }
  /** The numbers themselves, valid until the next call. @internal */
  numbers(): Float64Array {
    const size = this.wasm.lekalo_numbers_size();
    return size === 0
      ? new Float64Array(0)
      : new Float64Array(this.wasm.memory.buffer, this.wasm.lekalo_numbers(), size);
  }
  /** @internal */
  demand(result: number): number {
    if (result < 0) throw new Refusal(this.text());
    return result;
  }
}

/** A layout in the kernel. close() gives its memory back. */
export class Layout {
  private readonly partIndex = new Map<string, number>();
  private readonly stockIndex = new Map<string, number>();

  constructor(
    private readonly kernel: Kernel,
    private readonly wasm: Exports,
    private readonly handle: number,
    /** What the reader left out or repaired. */
    readonly notices: string[],
  ) {
    const { parts = [], stocks = [] } = JSON.parse(this.document()) as {
      parts?: { id: string }[];
      stocks?: { id: string }[];
    };
    parts.forEach(({ id }, i) => this.partIndex.set(id, i));
    stocks.forEach(({ id }, i) => this.stockIndex.set(id, i));
  }

  close(): void {
    this.wasm.lekalo_close(this.handle);
  }

  document(): string {
    this.kernel.demand(this.wasm.lekalo_document(this.handle));
    return this.kernel.text();
  }

  /** Follows the server: a "change" message of the protocol. */
  apply(change: ChangeMessage): void {
    for (const { stock, kind, id, index, after } of change.features ?? []) {
      const at = this.stockIndex.get(stock);
      if (at === undefined) throw new Refusal(`there is no stock ${stock}`);
      const which = kind === 'defect' ? 0 : 1;
      this.kernel.demand(
        after === null
          ? this.wasm.lekalo_erase_feature(this.handle, at, which, this.kernel.putText(id))
          : this.wasm.lekalo_set_feature(this.handle, at, which, index, this.kernel.putText(JSON.stringify(after))),
      );
    }
    for (const { id, after } of change.placements) {
      if (after === null) this.erase(id);
      else this.set(this.placementOf(after));
    }
    this.kernel.demand(this.wasm.lekalo_set_next_id(this.handle, change.next_id));
  }

  placementOf(message: PlacementMessage): Placement {
    const part = this.partIndex.get(message.part);
    const stock = this.stockIndex.get(message.stock);
    if (part === undefined || stock === undefined)
      throw new Refusal(`there is no part ${message.part} or no stock ${message.stock}`);
    const { id, c, s, x, y, copy = 0, mirrored = false, locked = false } = message;
    return { id, part, stock, copy, c, s, x, y, mirrored, locked };
  }

  set(placement: Placement): void {
    this.kernel.putNumbers(flat(placement));
    this.kernel.demand(this.wasm.lekalo_set(this.handle));
  }

  erase(id: number): void {
    this.kernel.demand(this.wasm.lekalo_erase(this.handle, id));
  }

  /**
   * What would be so if these placements were turned about the middle of their box and then moved.
   * Without depths it is quick enough for every move of a hand, and overlap, outside, defect and quality come with
   * amount and direction 0; ask again with them once a frame or when the hand rests.
   * @param reach how far the nearest-distance line looks; 0: not asked for
   */
  state(ids: ArrayLike<number>, dx: number, dy: number, { degrees = 0, reach = 50, depths = false } = {}): State {
    this.kernel.putNumbers(ids);
    return this.stateOf(this.wasm.lekalo_state(this.handle, ids.length, dx, dy, degrees, reach, Number(depths)));
  }

  /** The same of placements anywhere, also new ones (id 0), in place of those with their ids. */
  stateAt(placements: Placement[], { reach = 50, depths = false } = {}): State {
    this.kernel.putNumbers(placements.flatMap(flat));
    return this.stateOf(this.wasm.lekalo_state_of(this.handle, placements.length, reach, Number(depths)));
  }

  /** Every violation of the document. */
  check(): Violation[] {
    this.kernel.demand(this.wasm.lekalo_check(this.handle));
    return violationsFrom(this.kernel.numbers(), 0);
  }

  /**
   * The same a few placements at a time. All are unchecked at first, and again when they change or a feature near
   * them does. Who drops the violations of what changed and was looked at, and adds these, has those of check()
   * when none is left.
   */
  checkSome(most: number): Looked {
    this.kernel.demand(this.wasm.lekalo_check_some(this.handle, most));
    const n = this.kernel.numbers();
    const first = 2 + n[1]!;
    return { left: n[0]!, ids: [...n.subarray(2, first)], violations: violationsFrom(n, first) };
  }

  /** What a command line would change. Throws a Refusal with the reason. */
  plan(line: string, mode: 'strict' | 'free'): Plan {
    this.kernel.demand(this.wasm.lekalo_plan(this.handle, this.kernel.putText(line), mode === 'strict' ? 1 : 0));
    const numbers = this.kernel.numbers();
    const made: Plan = { changed: [], removed: [], nextId: numbers[0]! };
    for (const one of placementsFrom(numbers, 1)) {
      if (one.part < 0) made.removed.push(one.id);
      else made.changed.push(one);
    }
    return made;
  }

  /** Ids of the parts at a point, edges included. */
  pick(stock: number, copy: number, x: number, y: number): number[] {
    this.kernel.demand(this.wasm.lekalo_pick(this.handle, stock, copy, x, y));
    return [...this.kernel.numbers()];
  }

  /** Ids of the parts whose boxes meet a box. */
  inBox(stock: number, copy: number, left: number, bottom: number, right: number, top: number): number[] {
    this.kernel.demand(this.wasm.lekalo_in_box(this.handle, stock, copy, left, bottom, right, top));
    return [...this.kernel.numbers()];
  }

  /** Places where a part would lie clear, lowest and leftmost first; ids are 0. */
  fitsWhere(part: number, stock: number, copy: number, most: number, mirrored?: boolean): Placement[] {
    const side = mirrored === undefined ? -1 : Number(mirrored);
    this.kernel.demand(this.wasm.lekalo_fits_where(this.handle, part, stock, copy, most, side));
    return placementsFrom(this.kernel.numbers(), 0);
  }

  placements(): Placement[] {
    return placementsFrom(this.placementNumbers(), 0);
  }

  /** The same as numbers, ten each in the order of Placement: for drawing. A copy. */
  placementNumbers(): Float64Array {
    this.kernel.demand(this.wasm.lekalo_placements(this.handle));
    return this.kernel.numbers().slice();
  }

  partOutline(part: number): Outline {
    return this.outline(0, part, 0);
  }
  areaOutline(part: number, area: number): Outline {
    return this.outline(4, part, area);
  }
  stockOutline(stock: number): Outline {
    return this.outline(1, stock, 0);
  }
  defectOutline(stock: number, defect: number): Outline {
    return this.outline(2, stock, defect);
  }
  zoneOutline(stock: number, zone: number): Outline {
    return this.outline(3, stock, zone);
  }

  /** Kits, parts, sheets, density: as `lekalo show --json` words it. */
  completeness(): unknown {
    this.kernel.demand(this.wasm.lekalo_completeness(this.handle));
    return JSON.parse(this.kernel.text());
  }

  /** The kits of it alone, quick enough for every change. */
  kits(): KitCount[] {
    this.kernel.demand(this.wasm.lekalo_kits(this.handle));
    return JSON.parse(this.kernel.text()) as KitCount[];
  }

  private outline(kind: number, a: number, b: number): Outline {
    this.kernel.demand(this.wasm.lekalo_outline(this.handle, kind, a, b));
    const numbers = this.kernel.numbers();
    const loops = numbers[0]!;
    const first = loops + 2;
    return Array.from({ length: loops }, (_, i) =>
      numbers.slice(first + 2 * numbers[1 + i]!, first + 2 * numbers[2 + i]!),
    );
  }

  private stateOf(result: number): State {
    const level = (['clear', 'gap', 'forbidden'] as const)[this.kernel.demand(result)]!;
    const n = this.kernel.numbers();
    const nearest: Nearest | null =
      n[0]! < 0
        ? null
        : {
            distance: n[0]!,
            to: (['part', 'border', 'defect'] as const)[n[1]!]!,
            other: n[2]!,
            id: n[3]!,
            onOther: [n[4]!, n[5]!],
            onPart: [n[6]!, n[7]!],
          };
    return { level, nearest, violations: violationsFrom(n, nearestSize) };
  }
}

function flat(p: Placement): number[] {
  return [p.id, p.part, p.stock, p.copy, p.c, p.s, p.x, p.y, Number(p.mirrored), Number(p.locked)];
}

/** Records of `size` numbers each, from an index on. */
function recordsFrom<T>(n: Float64Array, from: number, size: number, read: (at: number) => T): T[] {
  const made: T[] = [];
  for (let at = from; at < n.length; at += size) made.push(read(at));
  return made;
}

function placementsFrom(n: Float64Array, from: number): Placement[] {
  return recordsFrom(n, from, placementSize, (i) => ({
    id: n[i]!,
    part: n[i + 1]!,
    stock: n[i + 2]!,
    copy: n[i + 3]!,
    c: n[i + 4]!,
    s: n[i + 5]!,
    x: n[i + 6]!,
    y: n[i + 7]!,
    mirrored: n[i + 8] !== 0,
    locked: n[i + 9] !== 0,
  }));
}

function violationsFrom(n: Float64Array, from: number): Violation[] {
  return recordsFrom(n, from, violationSize, (i) => ({
    kind: violationKinds[n[i]!]!,
    a: n[i + 1]!,
    b: n[i + 2]!,
    stock: n[i + 3]!,
    copy: n[i + 4]!,
    feature: n[i + 5]!,
    amount: n[i + 6]!,
    at: [n[i + 7]!, n[i + 8]!],
    direction: [n[i + 9]!, n[i + 10]!],
  }));
}
