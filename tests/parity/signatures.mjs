// The functions that a WebAssembly module exports, with the types of their parameters and results, read from its
// bytes: the JavaScript interface tells only how many parameters there are.

const TYPES = { 0x7f: 'i32', 0x7e: 'i64', 0x7d: 'f32', 0x7c: 'f64' };
const [TYPE, IMPORT, FUNCTION, EXPORT] = [1, 2, 3, 7];

/** Reads numbers and names one after the other. */
class Reader {
  constructor(bytes, at = 0) {
    this.bytes = bytes;
    this.at = at;
  }
  byte() {
    return this.bytes[this.at++];
  }
  /** An unsigned number of variable length (LEB128). */
  number() {
    for (let value = 0, shift = 0; ; shift += 7) {
      const byte = this.byte();
      value += (byte & 0x7f) * 2 ** shift;
      if (byte < 0x80) return value;
    }
  }
  list(read) {
    return Array.from({ length: this.number() }, () => read());
  }
  name() {
    const size = this.number();
    this.at += size;
    return new TextDecoder().decode(this.bytes.subarray(this.at - size, this.at));
  }
  limits() {
    if (this.byte() & 1) this.number();
    this.number();
  }
}

/** The type of an imported function; null: the import is none. */
function importedType(reader) {
  reader.name();
  reader.name();
  const kind = reader.byte();
  if (kind === 0) return reader.number();
  if (kind === 3) reader.at += 2;
  else {
    if (kind === 1) reader.byte();
    reader.limits();
  }
  return null;
}

/** `(i32, f64) -> i32` by the name of each exported function. */
export function signaturesOf(bytes) {
  const sections = new Map();
  for (const reader = new Reader(bytes, 8); reader.at < bytes.length;) {
    const id = reader.byte();
    const size = reader.number();
    sections.set(id, new Reader(bytes, reader.at));
    reader.at += size;
  }
  const valueTypes = (reader) => reader.list(() => TYPES[reader.byte()]).join(', ');
  const types = sections.get(TYPE);
  const signatures = types.list(() => {
    types.byte(); // the mark of a function type
    const parameters = valueTypes(types);
    return `(${parameters}) -> ${valueTypes(types)}`;
  });
  const imports = sections.get(IMPORT);
  const imported = imports ? imports.list(() => importedType(imports)).filter((type) => type !== null) : [];
  const own = sections.get(FUNCTION);
  const functions = [...imported, ...own.list(() => own.number())];
  const exports = sections.get(EXPORT);
  const all = exports.list(() => ({ name: exports.name(), kind: exports.byte(), index: exports.number() }));
  return new Map(all.filter(({ kind }) => kind === 0).map(({ name, index }) => [name, signatures[functions[index]]]));
}
