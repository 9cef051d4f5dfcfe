// Made from bindings/wasm/kernel.hpp by kernel_exports.mjs beside it; to be changed there.

/** The exports of lekalo.wasm. */
export interface KernelExports {
  memory: WebAssembly.Memory;
  _initialize(): void;
  lekalo_input(bytes: number): number;
  lekalo_text(): number;
  lekalo_text_size(): number;
  lekalo_numbers(): number;
  lekalo_numbers_size(): number;
  lekalo_open(bytes: number): number;
  lekalo_close(handle: number): number;
  lekalo_document(handle: number): number;
  lekalo_set(handle: number): number;
  lekalo_erase(handle: number, id: number): number;
  lekalo_set_next_id(handle: number, id: number): number;
  lekalo_set_feature(handle: number, stock: number, kind: number, index: number, bytes: number): number;
  lekalo_erase_feature(handle: number, stock: number, kind: number, bytes: number): number;
  lekalo_violations_with(handle: number, stock: number, kind: number, index: number, depths: number): number;
  lekalo_state(
    handle: number,
    count: number,
    dx: number,
    dy: number,
    degrees: number,
    reach: number,
    depths: number,
  ): number;
  lekalo_state_of(handle: number, count: number, reach: number, depths: number): number;
  lekalo_check(handle: number): number;
  lekalo_check_some(handle: number, most: number): number;
  lekalo_plan(handle: number, bytes: number, strict: number): number;
  lekalo_pick(handle: number, stock: number, copy: number, x: number, y: number): number;
  lekalo_in_box(
    handle: number,
    stock: number,
    copy: number,
    left: number,
    bottom: number,
    right: number,
    top: number,
  ): number;
  lekalo_fits_where(handle: number, part: number, stock: number, copy: number, most: number, mirrored: number): number;
  lekalo_placements(handle: number): number;
  lekalo_outline(handle: number, kind: number, a: number, b: number): number;
  lekalo_completeness(handle: number): number;
  lekalo_kits(handle: number): number;
  lekalo_rotation(degrees: number): number;
  lekalo_degrees(c: number, s: number): number;
}

/** The number of parameters of each function. */
export const PARAMETERS = {
  lekalo_input: 1,
  lekalo_text: 0,
  lekalo_text_size: 0,
  lekalo_numbers: 0,
  lekalo_numbers_size: 0,
  lekalo_open: 1,
  lekalo_close: 1,
  lekalo_document: 1,
  lekalo_set: 1,
  lekalo_erase: 2,
  lekalo_set_next_id: 2,
  lekalo_set_feature: 5,
  lekalo_erase_feature: 4,
  lekalo_violations_with: 5,
  lekalo_state: 7,
  lekalo_state_of: 4,
  lekalo_check: 1,
  lekalo_check_some: 2,
  lekalo_plan: 3,
  lekalo_pick: 5,
  lekalo_in_box: 7,
  lekalo_fits_where: 6,
  lekalo_placements: 1,
  lekalo_outline: 4,
  lekalo_completeness: 1,
  lekalo_kits: 1,
  lekalo_rotation: 1,
  lekalo_degrees: 2,
} as const;

/** The numbers of a PLACEMENT. */
export const PLACEMENT_SIZE = 10;
/** The numbers of a VIOLATION. */
export const VIOLATION_SIZE = 11;
/** The numbers of a NEAREST. */
export const NEAREST_SIZE = 8;
