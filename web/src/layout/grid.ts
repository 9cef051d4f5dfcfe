// The grid of layout documents (docs/design/layout.md, rules 1, 3 and 4), computed as the C++ program does, bit for bit.

/** Grid steps in a millimetre. */
export const STEPS_PER_MM = 2 ** 20;

/** The nearest integer, ties to even; exact below 2^52. */
export function roundTiesToEven(value: number): number {
  const low = Math.floor(value);
  const rest = value - low;
  if (rest !== 0.5) return rest < 0.5 ? low : low + 1;
  return low % 2 === 0 ? low : low + 1;
}

/** The nearest step to a length in mm; multiplying by a power of two is exact. */
export const stepsFromMm = (mm: number): number => roundTiesToEven(mm * STEPS_PER_MM);
export const mmFromSteps = (steps: number): number => steps / STEPS_PER_MM;
/** The length on the grid nearest to a length. */
export const snapToGrid = (mm: number): number => mmFromSteps(stepsFromMm(mm));

/** The integer nearest to value / 2^52, ties to even. */
function roundedShift(value: bigint): bigint {
  const low = value >> 52n;
  const rest = value & 0xfffffffffffffn;
  const half = 0x8000000000000n;
  if (rest < half || (rest === half && (low & 1n) === 0n)) return low;
  return low + 1n;
}

/** A rotation: cosine and sine in steps of 2^-52. */
export interface Rotation {
  readonly c: bigint;
  readonly s: bigint;
}

export const rotationFromPair = (c: number, s: number): Rotation => ({
  c: BigInt(roundTiesToEven(c * 2 ** 52)),
  s: BigInt(roundTiesToEven(s * 2 ** 52)),
});

/** The place of a part's vertex, in steps, where the placement puts it (rule 4). */
export function placedVertex(
  px: number,
  py: number,
  rotation: Rotation,
  tx: number,
  ty: number,
  mirrored: boolean,
): [number, number] {
  const x = BigInt(mirrored ? -px : px);
  const y = BigInt(py);
  return [
    Number(roundedShift(rotation.c * x - rotation.s * y)) + tx,
    Number(roundedShift(rotation.s * x + rotation.c * y)) + ty,
  ];
}

/** A decimal without an exponent, which reads back to the same step. */
export function textOfMm(mm: number): string {
  const value = snapToGrid(mm);
  if (value === 0) return '0';
  const text = String(value);
  return text.includes('e') ? value.toFixed(20).replace(/0+$/, '') : text;
}
