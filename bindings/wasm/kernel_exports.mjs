// Makes the page's table of the exports of lekalo.wasm, web/src/kernel/exports.ts, from kernel.hpp:
//
//   node bindings/wasm/kernel_exports.mjs
//
// Tests hold the file against kernel.hpp (web/test/kernel.test.ts) and lekalo.wasm against both (tests/parity).

import { readFileSync, writeFileSync } from 'node:fs';
import { argv } from 'node:process';
import { fileURLToPath } from 'node:url';

export const header = fileURLToPath(new URL('kernel.hpp', import.meta.url));
export const made = fileURLToPath(new URL('../../web/src/kernel/exports.ts', import.meta.url));

/** The type in WebAssembly of a type in C++. */
function wasmType(cpp) {
  if (cpp.endsWith('*') || cpp === 'std::int32_t' || cpp === 'std::uint32_t') return 'i32';
  if (cpp === 'double') return 'f64';
  throw new Error(`kernel.hpp: the page has no number for ${cpp}`);
}

/** Every export: its name, its parameters with names and types, the type of its result. */
export function exportsOf(text) {
  const declared = [...text.matchAll(/LEKALO_EXPORT\((lekalo_\w+)\)\s+([\w:\s]+?[\s*]+?)\1\(([^)]*)\);/g)];
  const named = [...text.matchAll(/^LEKALO_EXPORT\(/gm)];
  if (declared.length !== named.length) throw new Error(`kernel.hpp: ${named.length} exports, ${declared.length} read`);
  return declared.map(([, name, result, list]) => ({
    name,
    result: wasmType(result.trim()),
    parameters: (list.trim() === '' ? [] : list.split(',')).map((parameter) => {
      const [, type, word] = /^\s*(.*?)\s*(\w+)\s*$/.exec(parameter);
      return { name: word, type: wasmType(type) };
    }),
  }));
}

/** `(i32, f64) -> i32` */
export const signatureOf = ({ parameters, result }) =>
  `(${parameters.map(({ type }) => type).join(', ')}) -> ${result}`;

const WIDTH = 120;
/** A method of the interface, broken as Prettier breaks it. */
function method({ name, parameters }) {
  const words = parameters.map((one) => `${one.name}: number`);
  const line = `  ${name}(${words.join(', ')}): number;`;
  return line.length <= WIDTH ? line : `  ${name}(\n${words.map((word) => `    ${word},\n`).join('')}  ): number;`;
}

/** The source for the page. */
export function sourceOf(text) {
  const all = exportsOf(text);
  const sizes = [...text.matchAll(/constexpr std::uint32_t k(\w+)Size = (\d+);/g)];
  return `// Made from bindings/wasm/kernel.hpp by kernel_exports.mjs beside it; to be changed there.

/** The exports of lekalo.wasm. */
export interface KernelExports {
  memory: WebAssembly.Memory;
  _initialize(): void;
${all.map(method).join('\n')}
}

/** The number of parameters of each function. */
export const PARAMETERS = {
${all.map(({ name, parameters }) => `  ${name}: ${parameters.length},`).join('\n')}
} as const;

${sizes.map(([, name, size]) => `/** The numbers of a ${name.toUpperCase()}. */\nexport const ${name.toUpperCase()}_SIZE = ${size};`).join('\n')}
`;
}

if (argv[1] === fileURLToPath(import.meta.url)) writeFileSync(made, sourceOf(readFileSync(header, 'utf8')));
