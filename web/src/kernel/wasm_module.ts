// lekalo.wasm as the page calls it: numbers as arguments, text or numbers as input and answer. What the calls do is
// written in bindings/wasm/kernel.hpp.

import { PARAMETERS, type KernelExports } from './exports';

/** The kernel's sentence against a request that it cannot carry out. */
export class Refusal extends Error {
  override name = 'Refusal';
}

/** Throws where lekalo.wasm is not the one that this page was made for: a call would read arguments it was not given. */
export function demandExports(exports: WebAssembly.Exports): asserts exports is WebAssembly.Exports & KernelExports {
  for (const [name, count] of Object.entries(PARAMETERS)) {
    const found = exports[name];
    if (typeof found !== 'function')
      throw new Error(`lekalo.wasm has no ${name}: it is of another build than the page`);
    if (found.length === count) continue;
    throw new Error(
      `lekalo.wasm: ${name} takes ${found.length} arguments, the page gives ${count}: they are of different builds`,
    );
  }
}

/** One instance: one thread, any number of layouts. */
export class WasmModule {
  private constructor(readonly exports: KernelExports) {}

  static async load(bytes: BufferSource): Promise<WasmModule> {
    const module = await WebAssembly.compile(bytes);
    const imports: Record<string, Record<string, (...args: number[]) => number>> = {};
    for (const { module: group, name } of WebAssembly.Module.imports(module)) {
      (imports[group] ??= {})[name] = () => 8; // EBADF: there is nothing to write to
    }
    const textAt = (at: number): string => {
      const all = new Uint8Array((instance.exports.memory as WebAssembly.Memory).buffer);
      return new TextDecoder().decode(all.subarray(at, all.indexOf(0, at)));
    };
    (imports['lekalo'] ??= {})['broken'] = (expression = 0, file = 0, line = 0) => {
      throw new Error(`lekalo: internal error: ${textAt(expression)} (${textAt(file)}:${line})`);
    };
    const instance = await WebAssembly.instantiate(module, imports);
    const { exports } = instance;
    demandExports(exports);
    exports._initialize();
    return new WasmModule(exports);
  }

  /** @returns how many bytes the text has */
  putText(text: string): number {
    const bytes = new TextEncoder().encode(text);
    const at = this.exports.lekalo_input(bytes.length);
    new Uint8Array(this.exports.memory.buffer, at, bytes.length).set(bytes);
    return bytes.length;
  }
  putNumbers(values: ArrayLike<number>): void {
    const at = this.exports.lekalo_input(8 * values.length);
    new Float64Array(this.exports.memory.buffer, at, values.length).set(values);
  }
  text(): string {
    const { memory, lekalo_text, lekalo_text_size } = this.exports;
    return new TextDecoder().decode(new Uint8Array(memory.buffer, lekalo_text(), lekalo_text_size()));
  }
  /** The numbers themselves, valid until the next call. */
  numbers(): Float64Array {
    const { memory, lekalo_numbers, lekalo_numbers_size } = this.exports;
    const size = lekalo_numbers_size();
    return size === 0 ? new Float64Array(0) : new Float64Array(memory.buffer, lekalo_numbers(), size);
  }
  /** The result of a call; throws a Refusal where it is a failure. */
  demand(result: number): number {
    if (result < 0) throw new Refusal(this.text());
    return result;
  }
}
