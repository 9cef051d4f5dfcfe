// The kernel of a page without WebAssembly: it asks the server for a preview.

import type { Placement } from '../layout/document';
import { isGap } from '../layout/document';
import { UNKNOWN, type Kernel, type LiveState } from '../kernel/kernel';
import type { Client } from './socket';

const QUARTERS: Record<number, { c: number; s: number }> = {
  0: { c: 1, s: 0 },
  90: { c: 0, s: 1 },
  180: { c: -1, s: 0 },
  270: { c: 0, s: -1 },
};

export class ServerKernel implements Kernel {
  readonly immediate = false;
  constructor(private readonly client: () => Client | null) {}
  open(): void {}
  apply(): void {}
  rotation(degrees: number): { c: number; s: number } | null {
    return QUARTERS[degrees] ?? null;
  }
  turned(): null {
    return null;
  }
  check(): null {
    return null;
  }
  checkSome(): null {
    return null;
  }
  kits(): null {
    return null;
  }
  async state(_placements: readonly Placement[], text: string): Promise<LiveState> {
    const client = this.client();
    if (!client) return UNKNOWN;
    const answer = await client.ask({ type: 'preview', mode: 'free', text });
    if (answer.type !== 'preview') return UNKNOWN;
    const violations = answer.violations;
    const level = violations.length === 0 ? 'clear' : violations.every((v) => isGap(v.kind)) ? 'gap' : 'forbidden';
    return { level, violations, nearest: null };
  }
}
