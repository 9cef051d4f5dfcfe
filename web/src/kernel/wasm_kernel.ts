// The WebAssembly kernel (kernel.ts, lekalo.wasm) behind the page's interface.

import { rotate } from '../layout/commands';
import type { FeatureChange, LayoutDocument, Placement, Stock, Violation, ViolationKind } from '../layout/document';
import { UNKNOWN, type Kernel, type KitCount, type Level, type LiveState, type Looked } from './kernel';
import type { Change } from '../layout/model';

interface KernelViolation {
  kind: ViolationKind;
  a: number;
  b: number;
  stock: number;
  copy: number;
  feature: number;
  amount: number;
  at: [number, number];
  direction: [number, number];
}
interface KernelPlacement {
  id: number;
  part: number;
  stock: number;
  copy: number;
  c: number;
  s: number;
  x: number;
  y: number;
  mirrored: boolean;
  locked: boolean;
}
interface LoadedKernel {
  open(document: string): KernelLayout;
  rotation(degrees: number): { c: number; s: number };
}
interface KernelLayout {
  close(): void;
  apply(change: { placements: readonly Change[]; features: readonly FeatureChange[]; next_id: number }): void;
  placementOf(p: Placement): unknown;
  stateAt(
    p: unknown[],
    options: { reach: number; depths: boolean },
  ): {
    level: Exclude<Level, 'unknown'>;
    violations: KernelViolation[];
    nearest: { distance: number; onOther: [number, number]; onPart: [number, number] } | null;
  };
  check(): KernelViolation[];
  checkSome(most: number): { left: number; ids: number[]; violations: KernelViolation[] };
  kits(): KitCount[];
  plan(line: string, mode: 'strict' | 'free'): { changed: KernelPlacement[] };
}
interface KernelModule {
  Kernel: { load(source: Response): Promise<LoadedKernel> };
}

const modules = import.meta.glob<KernelModule>('./wasm_module.ts');

/// Null where the page was built without the kernel or the server has none.
export async function loadWasmKernel(): Promise<Kernel | null> {
  const load = modules['./wasm_module.ts'];
  if (!load) return null;
  const answer = await fetch('lekalo.wasm');
  if (!answer.ok) return null;
  const kernel = await (await load()).Kernel.load(answer);
  return new WasmKernel(kernel);
}

class WasmKernel implements Kernel {
  readonly immediate = true;
  private layout: KernelLayout | null = null;
  private stocks: Stock[] = [];
  private parts: string[] = [];
  constructor(private readonly kernel: LoadedKernel) {}

  open(document: LayoutDocument): void {
    this.layout?.close();
    this.layout = null;
    this.stocks = document.stocks ?? [];
    this.parts = (document.parts ?? []).map((p) => p.id);
    this.layout = this.kernel.open(JSON.stringify(document));
  }
  apply(changes: readonly Change[], nextId: number, features: readonly FeatureChange[]): void {
    this.layout?.apply({ placements: changes, features, next_id: nextId });
  }
  rotation(degrees: number): { c: number; s: number } {
    return this.kernel.rotation(degrees);
  }
  turned(ids: readonly number[], degrees: number): Placement[] | null {
    if (!this.layout) return null;
    return this.layout
      .plan(rotate(ids, degrees), 'free')
      .changed.map((p) => ({
        id: p.id,
        part: this.parts[p.part]!,
        stock: this.stocks[p.stock]!.id,
        copy: p.copy,
        c: p.c,
        s: p.s,
        x: p.x,
        y: p.y,
        mirrored: p.mirrored,
        locked: p.locked,
      }));
  }
  check(): Violation[] | null {
    return this.layout ? this.layout.check().map((v) => this.violation(v)) : null;
  }
  checkSome(most: number): Looked | null {
    const looked = this.layout?.checkSome(most);
    return looked ? { ...looked, violations: looked.violations.map((v) => this.violation(v)) } : null;
  }
  kits(): KitCount[] | null {
    return this.layout?.kits() ?? null;
  }
  state(placements: readonly Placement[], _text: string, reach: number, depths: boolean): LiveState {
    const layout = this.layout;
    if (!layout) return UNKNOWN;
    const { level, violations, nearest } = layout.stateAt(
      placements.map((p) => layout.placementOf(p)),
      { reach, depths },
    );
    return {
      level,
      violations: violations.map((v) => this.violation(v)),
      nearest: nearest && { distance: nearest.distance, from: nearest.onPart, to: nearest.onOther },
    };
  }
  private violation(v: KernelViolation): Violation {
    const stock = this.stocks[v.stock]!;
    const features =
      v.kind === 'quality' ? stock.zones : v.kind === 'defect' || v.kind === 'defect-gap' ? stock.defects : undefined;
    return {
      kind: v.kind,
      a: v.a,
      b: v.b || null,
      stock: stock.id,
      copy: v.copy,
      amount_mm: v.amount,
      at: v.at,
      direction: v.direction,
      feature: features?.[v.feature]?.id,
    };
  }
}
