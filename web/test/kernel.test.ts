import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { header, made, sourceOf } from '../../bindings/wasm/kernel_exports.mjs';
import { PARAMETERS } from '../src/kernel/exports';
import { demandExports } from '../src/kernel/wasm_module';
import { VIOLATION_KINDS } from '../src/layout/document';

/** A function of so many parameters, as WebAssembly exports have them. */
const taking = (count: number): (() => number) => Object.defineProperty(() => 0, 'length', { value: count });
const exported = (): WebAssembly.Exports =>
  Object.fromEntries(Object.entries(PARAMETERS).map(([name, count]) => [name, taking(count)]));

describe("the kernel's interface", () => {
  it('is made from kernel.hpp as it stands: node bindings/wasm/kernel_exports.mjs', () => {
    expect(readFileSync(made, 'utf8')).toBe(sourceOf(readFileSync(header, 'utf8')));
  });
  it('is demanded of lekalo.wasm when it is loaded', () => {
    expect(() => demandExports(exported())).not.toThrow();
    expect(() => demandExports({ ...exported(), lekalo_state_of: taking(5) })).toThrow(
      'lekalo.wasm: lekalo_state_of takes 5 arguments, the page gives 4',
    );
    const { lekalo_kits: _, ...rest } = exported();
    expect(() => demandExports(rest)).toThrow('lekalo.wasm has no lekalo_kits');
  });
  it('names kinds of violations by the numbers of layout::ViolationKind', () => {
    const check = readFileSync(new URL('../../include/lekalo/layout/check.hpp', import.meta.url), 'utf8');
    const [, body] = /enum class ViolationKind[^{]*\{([^}]*)\}/.exec(check)!;
    const kinds = [...body!.replace(/\/\/.*/g, '').matchAll(/\w+/g)].map(([word]) => word.replace('_', '-'));
    expect(kinds).toEqual([...VIOLATION_KINDS]);
  });
});
