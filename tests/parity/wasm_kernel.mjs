// lekalo.wasm as it is: bindings/wasm/kernel.hpp says what the calls do. Node 18 or later.

export async function loadKernel(bytes) {
  const module = await WebAssembly.compile(bytes);
  const imports = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module)) (imports[from] ??= {})[name] = () => 8; // EBADF: there is nothing to write to
  let exports;
  const textAt = (at) => {
    const all = new Uint8Array(exports.memory.buffer);
    return Buffer.from(all.subarray(at, all.indexOf(0, at))).toString();
  };
  (imports.lekalo ??= {}).broken = (expression, file, line) => {
    throw new Error(`lekalo: internal error: ${textAt(expression)} (${textAt(file)}:${line})`);
  };
  ({ exports } = await WebAssembly.instantiate(module, imports));
  exports._initialize();
  const view = (at, size) => Buffer.from(exports.memory.buffer, at, size);
  return {
    exports,
    /** Writes the input, calls, and gives result, text and numbers (copies, as bytes). */
    call(name, args, input) {
      if (input.length > 0) {
        const at = exports.lekalo_input(input.length);
        view(at, input.length).set(input);
      }
      const result = exports[name](...args);
      return {
        result,
        text: Buffer.from(view(exports.lekalo_text(), exports.lekalo_text_size())),
        numbers: Buffer.from(view(exports.lekalo_numbers(), 8 * exports.lekalo_numbers_size())),
      };
    },
  };
}
