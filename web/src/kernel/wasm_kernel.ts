// The WebAssembly kernel: the same C++ as the server's, so its answers are the server's. It knows parts, stocks,
// defects and zones by their index in the document, the page by their ids.

import { rotate } from '../layout/commands';
import {
  VIOLATION_KINDS,
  type FeatureChange,
  type LayoutDocument,
  type Part,
  type Placement,
  type Point,
  type Stock,
  type Violation,
} from '../layout/document';
import type { Change } from '../layout/model';
import { NEAREST_SIZE, PLACEMENT_SIZE, VIOLATION_SIZE } from './exports';
import { UNKNOWN, type Kernel, type KitCount, type LiveState, type Looked, type Nearest } from './kernel';
import { Refusal, WasmModule } from './wasm_module';

/** Null where the server has no lekalo.wasm: the page was built without it. */
export async function loadWasmKernel(): Promise<Kernel | null> {
  const answer = await fetch('lekalo.wasm');
  return answer.ok ? new WasmKernel(await WasmModule.load(await answer.arrayBuffer())) : null;
}

/** The layout that is open. */
interface OpenLayout {
  handle: number;
  parts: readonly Part[];
  stocks: readonly Stock[];
  partIndex: ReadonlyMap<string, number>;
  stockIndex: ReadonlyMap<string, number>;
}

export class WasmKernel implements Kernel {
  readonly immediate = true;
  private layout: OpenLayout | null = null;
  constructor(private readonly wasm: WasmModule) {}

  open(document: LayoutDocument): void {
    const { wasm, layout } = this;
    if (layout) wasm.exports.lekalo_close(layout.handle);
    this.layout = null;
    const handle = wasm.demand(wasm.exports.lekalo_open(wasm.putText(JSON.stringify(document))));
    const { parts = [], stocks = [] } = document;
    this.layout = { handle, parts, stocks, partIndex: indexOf(parts), stockIndex: indexOf(stocks) };
  }

  apply(changes: readonly Change[], nextId: number, features: readonly FeatureChange[]): void {
    const { wasm, layout } = this;
    if (!layout) return;
    for (const change of features) this.applyFeature(layout, change);
    for (const { id, after } of changes) {
      if (after) {
        wasm.putNumbers(numbersOf(layout, after));
        wasm.demand(wasm.exports.lekalo_set(layout.handle));
      } else wasm.demand(wasm.exports.lekalo_erase(layout.handle, id));
    }
    wasm.demand(wasm.exports.lekalo_set_next_id(layout.handle, nextId));
  }

  private applyFeature({ handle, stockIndex }: OpenLayout, { stock, kind, id, index, after }: FeatureChange): void {
    const { wasm } = this;
    const at = stockIndex.get(stock);
    if (at === undefined) throw new Refusal(`there is no stock ${stock}`);
    const which = kind === 'defect' ? 0 : 1;
    wasm.demand(
      after === null
        ? wasm.exports.lekalo_erase_feature(handle, at, which, wasm.putText(id))
        : wasm.exports.lekalo_set_feature(handle, at, which, index, wasm.putText(JSON.stringify(after))),
    );
  }

  state(placements: readonly Placement[], _text: string, reach: number, depths: boolean): LiveState {
    const { wasm, layout } = this;
    if (!layout) return UNKNOWN;
    wasm.putNumbers(placements.flatMap((one) => numbersOf(layout, one)));
    const { handle } = layout;
    const level = wasm.demand(wasm.exports.lekalo_state_of(handle, placements.length, reach, Number(depths)));
    const numbers = wasm.numbers();
    return {
      level: (['clear', 'gap', 'forbidden'] as const)[level]!,
      violations: violationsFrom(layout, numbers, NEAREST_SIZE),
      nearest: nearestFrom(numbers),
    };
  }

  rotation(degrees: number): { c: number; s: number } {
    this.wasm.demand(this.wasm.exports.lekalo_rotation(degrees));
    const [c, s] = this.wasm.numbers();
    return { c: c!, s: s! };
  }

  turned(ids: readonly number[], degrees: number): Placement[] | null {
    const { wasm, layout } = this;
    if (!layout) return null;
    wasm.demand(wasm.exports.lekalo_plan(layout.handle, wasm.putText(rotate(ids, degrees)), 0));
    return recordsFrom(wasm.numbers(), 1, PLACEMENT_SIZE, (record) => placementFrom(layout, record));
  }

  check(): Violation[] | null {
    const { wasm, layout } = this;
    if (!layout) return null;
    wasm.demand(wasm.exports.lekalo_check(layout.handle));
    return violationsFrom(layout, wasm.numbers(), 0);
  }

  checkSome(most: number): Looked | null {
    const { wasm, layout } = this;
    if (!layout) return null;
    wasm.demand(wasm.exports.lekalo_check_some(layout.handle, most));
    const numbers = wasm.numbers();
    const first = 2 + numbers[1]!;
    return {
      left: numbers[0]!,
      ids: [...numbers.subarray(2, first)],
      violations: violationsFrom(layout, numbers, first),
    };
  }

  kits(): KitCount[] | null {
    const { wasm, layout } = this;
    if (!layout) return null;
    wasm.demand(wasm.exports.lekalo_kits(layout.handle));
    return JSON.parse(wasm.text()) as KitCount[];
  }
}

const indexOf = (list: readonly { id: string }[]): Map<string, number> => new Map(list.map(({ id }, i) => [id, i]));

/** A PLACEMENT of kernel.hpp. */
function numbersOf({ partIndex, stockIndex }: OpenLayout, placement: Placement): number[] {
  const [part, stock] = [partIndex.get(placement.part), stockIndex.get(placement.stock)];
  if (part === undefined || stock === undefined)
    throw new Refusal(`there is no part ${placement.part} or no stock ${placement.stock}`);
  const { id, c, s, x, y, copy = 0, mirrored = false, locked = false } = placement;
  return [id, part, stock, copy, c, s, x, y, Number(mirrored), Number(locked)];
}

/** Reads the records of `size` numbers each, from an index on. */
function recordsFrom<T>(numbers: Float64Array, from: number, size: number, read: (record: Float64Array) => T): T[] {
  const made: T[] = [];
  for (let at = from; at < numbers.length; at += size) made.push(read(numbers.subarray(at, at + size)));
  return made;
}

function placementFrom({ parts, stocks }: OpenLayout, record: Float64Array): Placement {
  const [id, part, stock, copy, c, s, x, y, mirrored, locked] = record as unknown as number[];
  return {
    id: id!,
    part: parts[part!]!.id,
    stock: stocks[stock!]!.id,
    copy: copy!,
    c: c!,
    s: s!,
    x: x!,
    y: y!,
    mirrored: mirrored !== 0,
    locked: locked !== 0,
  };
}

function violationsFrom({ stocks }: OpenLayout, numbers: Float64Array, from: number): Violation[] {
  return recordsFrom(numbers, from, VIOLATION_SIZE, (record) => {
    const at = (index: number): number => record[index]!;
    const point = (index: number): Point => [at(index), at(index + 1)];
    const kind = VIOLATION_KINDS[at(0)]!;
    const stock = stocks[at(3)]!;
    const features = kind === 'quality' ? stock.zones : kind.startsWith('defect') ? stock.defects : undefined;
    return {
      kind,
      a: at(1),
      b: at(2) || null,
      stock: stock.id,
      copy: at(4),
      feature: features?.[at(5)]?.id,
      amount_mm: at(6),
      at: point(7),
      direction: point(9),
    };
  });
}

function nearestFrom(numbers: Float64Array): Nearest | null {
  const at = (index: number): number => numbers[index]!;
  return at(0) < 0 ? null : { distance: at(0), to: [at(4), at(5)], from: [at(6), at(7)] };
}
