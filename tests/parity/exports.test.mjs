// lekalo.wasm exports what bindings/wasm/kernel.hpp declares, with the same types:
//
//   LEKALO_WASM=lekalo.wasm node --test exports.test.mjs

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { exportsOf, header, signatureOf } from '../../bindings/wasm/kernel_exports.mjs';
import { signaturesOf } from './signatures.mjs';

const text = readFileSync(header, 'utf8');
const actual = signaturesOf(readFileSync(process.env.LEKALO_WASM));
actual.delete('_initialize'); // the start of a module without main
const declared = (source) => new Map(exportsOf(source).map((one) => [one.name, signatureOf(one)]));

test('lekalo.wasm exports what kernel.hpp declares, type by type, and nothing else', () => {
  assert.deepEqual(new Map([...actual].sort()), new Map([...declared(text)].sort()));
});

test('a declaration that differs in a type, a parameter or a name is noticed', () => {
  for (const [from, to] of [
    ['lekalo_erase(std::int32_t handle, double id)', 'lekalo_erase(std::int32_t handle, std::uint32_t id)'],
    ['lekalo_kits(std::int32_t handle)', 'lekalo_kits(std::int32_t handle, double most)'],
    ['LEKALO_EXPORT(lekalo_check) std::int32_t lekalo_check(', 'LEKALO_EXPORT(lekalo_look) std::int32_t lekalo_look('],
  ]) {
    assert.ok(text.includes(from), from);
    assert.notDeepEqual(new Map([...actual].sort()), new Map([...declared(text.replace(from, to))].sort()));
  }
});

test('an export that the reader of kernel.hpp does not understand is an error', () => {
  assert.throws(() => exportsOf(`${text}\nLEKALO_EXPORT(lekalo_new) lekalo_new(int a);`), /exports/);
});
