// The WebAssembly kernel (kernel.ts, lekalo.wasm) behind the page's interface.

import type { LayoutDocument, Placement, Violation, ViolationKind } from './document';
import { UNKNOWN, type Kernel, type Level, type LiveState } from './kernel_api';
import type { Change } from './model';

interface KernelViolation {
  kind: ViolationKind; a: number; b: number; stock: number; copy: number; feature: number; amount: number;
  at: [number, number]; direction: [number, number];
}
interface KernelLayout {
  close(): void;
  apply(change: { placements: readonly Change[]; next_id: number }): void;
  placementOf(p: Placement): unknown;
  stateAt(p: unknown[], options: { reach: number; depths: boolean }): {
    level: Exclude<Level, 'unknown'>; violations: KernelViolation[];
    nearest: { distance: number; onOther: [number, number]; onPart: [number, number] } | null;
  };
  check(): KernelViolation[];
}
interface KernelModule {
  Kernel: { load(source: Response): Promise<{ open(document: string): KernelLayout }> };
}

const modules = import.meta.glob<KernelModule>('./kernel.ts');

/// Null where the page was built without the kernel or the server has none.
export async function loadWasmKernel(): Promise<Kernel | null> {
  const load = modules['./kernel.ts'];
  if (!load) return null;
  const answer = await fetch('lekalo.wasm');
  if (!answer.ok) return null;
  const kernel = await (await load()).Kernel.load(answer);
  return new WasmKernel(kernel);
}

class WasmKernel implements Kernel {
  readonly immediate = true;
  private layout: KernelLayout | null = null;
  private stocks: string[] = [];
  constructor(private readonly kernel: { open(document: string): KernelLayout }) {}

  open(document: LayoutDocument): void {
    this.layout?.close();
    this.layout = null;
    this.stocks = (document.stocks ?? []).map((s) => s.id);
    this.layout = this.kernel.open(JSON.stringify(document));
  }
  apply(changes: readonly Change[], nextId: number): void {
    this.layout?.apply({ placements: changes, next_id: nextId });
  }
  check(): Violation[] | null {
    return this.layout ? this.layout.check().map((v) => this.violation(v)) : null;
  }
  state(placements: readonly Placement[], _text: string, reach: number, depths: boolean): LiveState {
    const layout = this.layout;
    if (!layout) return UNKNOWN;
    const { level, violations, nearest } = layout.stateAt(placements.map((p) => layout.placementOf(p)), { reach, depths });
    return {
      level,
      violations: violations.map((v) => this.violation(v)),
      nearest: nearest && { distance: nearest.distance, from: nearest.onPart, to: nearest.onOther },
    };
  }
  private violation(v: KernelViolation): Violation {
    return { kind: v.kind, a: v.a, b: v.b || null, stock: this.stocks[v.stock] ?? '', copy: v.copy, amount_mm: v.amount, at: v.at, direction: v.direction };
  }
}
