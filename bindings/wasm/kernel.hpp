#pragma once

#include <cstdint>

/// The layout kernel behind a C interface, for WebAssembly (docs/design/wasm.md). It is built natively too,
/// so that tests compare both. The page's side of it, web/src/kernel/exports.ts, is made from this file by
/// kernel_exports.mjs, which reads each LEKALO_EXPORT with its declaration and the sizes below.
///
/// A call takes numbers, and bytes or an array of doubles that the caller has written to lekalo_input(). It
/// leaves its answer in the text (UTF-8) or the numbers (doubles), which hold until the next call. A result
/// below 0 is a failure, and the text is its sentence. Lengths are mm and are rounded to the grid as those of
/// layout files are; places that come back are exact.
#ifdef __wasm__
#define LEKALO_EXPORT(name) __attribute__((export_name(#name)))
#else
#define LEKALO_EXPORT(name)
#endif

/// The doubles of a PLACEMENT: id, part, stock (indices), copy, c, s (cosine and sine), x, y, mirrored,
/// locked (0 or 1).
constexpr std::uint32_t kPlacementSize = 10;
/// The doubles of a VIOLATION: kind (layout::ViolationKind), a, b, stock, copy, feature, amount, x and y of
/// the place, x and y of the direction.
constexpr std::uint32_t kViolationSize = 11;
/// The doubles of a NEAREST: distance (-1: nothing within reach, or not asked for because something is
/// forbidden), what it is to (0 a part, 1 the border, 2 a defect), id of the other placement or index of the
/// defect, id of the placement, x and y of the nearest point of the other, x and y of that of the placement.
constexpr std::uint32_t kNearestSize = 8;

extern "C" {

/// Makes room for `bytes` of input, at a multiple of 8. The room grows and never shrinks.
LEKALO_EXPORT(lekalo_input) void* lekalo_input(std::uint32_t bytes);
LEKALO_EXPORT(lekalo_text) const char* lekalo_text();
LEKALO_EXPORT(lekalo_text_size) std::uint32_t lekalo_text_size();
LEKALO_EXPORT(lekalo_numbers) const double* lekalo_numbers();
LEKALO_EXPORT(lekalo_numbers_size) std::uint32_t lekalo_numbers_size();

/// Opens a layout document (JSON, `bytes` of input). The text holds the reader's notices, a line each.
/// \return its handle, above 0
LEKALO_EXPORT(lekalo_open) std::int32_t lekalo_open(std::uint32_t bytes);
LEKALO_EXPORT(lekalo_close) std::int32_t lekalo_close(std::int32_t handle);
/// Text: the document as JSON.
LEKALO_EXPORT(lekalo_document) std::int32_t lekalo_document(std::int32_t handle);

/// Adds a placement or replaces the one with its id (input: one PLACEMENT).
LEKALO_EXPORT(lekalo_set) std::int32_t lekalo_set(std::int32_t handle);
/// Takes a placement away.
LEKALO_EXPORT(lekalo_erase) std::int32_t lekalo_erase(std::int32_t handle, double id);
LEKALO_EXPORT(lekalo_set_next_id) std::int32_t lekalo_set_next_id(std::int32_t handle, double id);

/// Adds or replaces a defect (kind 0) or a zone (kind 1) of a stock, as change messages do
/// (docs/protocol.md). The input is JSON of `bytes`, as layout files have it. A new one comes to lie at
/// `index` of its list, or at the end of a shorter one.
LEKALO_EXPORT(lekalo_set_feature)
std::int32_t lekalo_set_feature(std::int32_t handle, double stock, std::int32_t kind, double index,
                                std::uint32_t bytes);
/// Takes a defect or zone away (input: its id, `bytes` of text).
LEKALO_EXPORT(lekalo_erase_feature)
std::int32_t lekalo_erase_feature(std::int32_t handle, double stock, std::int32_t kind, std::uint32_t bytes);
/// Numbers: the VIOLATIONs of all parts with one defect or zone.
/// \param depths  as in lekalo_state
/// \return how many there are
LEKALO_EXPORT(lekalo_violations_with)
std::int32_t lekalo_violations_with(std::int32_t handle, double stock, std::int32_t kind, double index,
                                    std::int32_t depths);

/// Tells what would be so if these `count` placements (input: ids) were turned about the middle of their box
/// by `degrees` and then moved by (dx, dy). Numbers: the NEAREST, then every VIOLATION in the order of
/// check().
///
/// \param depths  0: amounts and directions of overlap, outside, defect and quality are left out. That makes
///                the call quick enough for every move of a hand (layout::Depths).
/// \return        0 clear, 1 closer than a gap, 2 forbidden otherwise
LEKALO_EXPORT(lekalo_state)
std::int32_t lekalo_state(std::int32_t handle, std::uint32_t count, double dx, double dy, double degrees,
                          double reach, std::int32_t depths);
/// Tells the same of `count` PLACEMENTs in place of those with their ids, which need not be there.
LEKALO_EXPORT(lekalo_state_of)
std::int32_t lekalo_state_of(std::int32_t handle, std::uint32_t count, double reach, std::int32_t depths);
/// Numbers: every VIOLATION of the document.
/// \return how many there are
LEKALO_EXPORT(lekalo_check) std::int32_t lekalo_check(std::int32_t handle);
/// Checks the same bit by bit. All placements are unchecked at first, and again when they are set or a
/// feature near them changes. The call looks at up to `most` of the unchecked, lowest ids first. Numbers: how
/// many are left, how many were looked at, their ids, then every VIOLATION that one of these has a part in,
/// but for those with an unchecked one, which come when its turn does. A caller who drops the violations of
/// what was set, erased and looked at, and adds these, has those of lekalo_check once nothing is left.
/// \return how many VIOLATIONs there are
LEKALO_EXPORT(lekalo_check_some)
std::int32_t lekalo_check_some(std::int32_t handle, std::uint32_t most);

/// Plans a command line (`bytes` of input) without carrying it out. Numbers: the next id after it, then a
/// PLACEMENT for each that changes; its part is -1 where it goes. Text: the list "features" of change
/// messages, or nothing where no defect or zone changes.
///
/// \return  1, or 0 when nothing would change
LEKALO_EXPORT(lekalo_plan)
std::int32_t lekalo_plan(std::int32_t handle, std::uint32_t bytes, std::int32_t strict);

/// Numbers: the ids of the parts at a point, edges included, ascending.
LEKALO_EXPORT(lekalo_pick)
std::int32_t lekalo_pick(std::int32_t handle, double stock, double copy, double x, double y);
/// Numbers: the ids of the parts whose boxes meet a box, ascending.
LEKALO_EXPORT(lekalo_in_box)
std::int32_t lekalo_in_box(std::int32_t handle, double stock, double copy, double left, double bottom,
                           double right, double top);
/// Numbers: PLACEMENTs with id 0 (layout::fits_where).
/// \param mirrored  1, 0, or -1 for either
LEKALO_EXPORT(lekalo_fits_where)
std::int32_t lekalo_fits_where(std::int32_t handle, double part, double stock, double copy,
                               std::uint32_t most, std::int32_t mirrored);

/// Numbers: all PLACEMENTs, ascending by id.
LEKALO_EXPORT(lekalo_placements) std::int32_t lekalo_placements(std::int32_t handle);
/// Gives an outline in its own frame, not placed. Numbers: the count of its loops, the index of the point
/// with which each begins, the number of points, then x and y of every point.
///
/// \param kind  0 part `a`, 1 stock `a`, 2 defect `b` of stock `a`, 3 zone `b` of stock `a`, 4 area `b` of
///              part `a`
LEKALO_EXPORT(lekalo_outline)
std::int32_t lekalo_outline(std::int32_t handle, std::int32_t kind, double a, double b);
/// Text: JSON of layout::completeness, as `lekalo show --json` words it.
LEKALO_EXPORT(lekalo_completeness) std::int32_t lekalo_completeness(std::int32_t handle);
/// Text: the kits of it alone, which are quick enough for every change; sheets take the time.
LEKALO_EXPORT(lekalo_kits) std::int32_t lekalo_kits(std::int32_t handle);

/// Numbers: the cosine and sine that the kernel takes for an angle. A browser's own differ in the last bit.
LEKALO_EXPORT(lekalo_rotation) std::int32_t lekalo_rotation(double degrees);
/// Numbers: the angle of a pair, in (-180, 180].
LEKALO_EXPORT(lekalo_degrees) std::int32_t lekalo_degrees(double c, double s);
}
