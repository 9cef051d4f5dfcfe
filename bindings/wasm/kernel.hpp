#pragma once

#include <cstdint>

/// The layout kernel behind a C interface, for WebAssembly (docs/design/wasm.md; web/src/kernel.ts is its
/// other side). Built natively too, so that tests compare both.
///
/// A call takes numbers, and bytes or an array of doubles that the caller has written to lekalo_input(); it
/// leaves its answer in the text (UTF-8) or the numbers (doubles), which hold until the next call. Results
/// below 0 are failures, their sentence is the text. Lengths are mm and are rounded to the grid as those of
/// layout files are; places that come back are exact.
///
/// A PLACEMENT is 10 doubles: id, part, stock (indices), copy, c, s (cosine and sine), x, y, mirrored, locked
/// (0 or 1). A VIOLATION is 11: kind (layout::ViolationKind), a, b, stock, copy, feature, amount, at x, y,
/// direction x, y.
#ifdef __wasm__
#define LEKALO_EXPORT(name) __attribute__((export_name(#name)))
#else
#define LEKALO_EXPORT(name)
#endif

extern "C" {

/// Room for `bytes` of input, at a multiple of 8. Grows and never shrinks.
LEKALO_EXPORT(lekalo_input) void* lekalo_input(std::uint32_t bytes);
LEKALO_EXPORT(lekalo_text) const char* lekalo_text();
LEKALO_EXPORT(lekalo_text_size) std::uint32_t lekalo_text_size();
LEKALO_EXPORT(lekalo_numbers) const double* lekalo_numbers();
LEKALO_EXPORT(lekalo_numbers_size) std::uint32_t lekalo_numbers_size();

/// A layout document (JSON, `bytes` of input). The answer is its handle, above 0; the text holds the reader's
/// notices, a line each.
LEKALO_EXPORT(lekalo_open) std::int32_t lekalo_open(std::uint32_t bytes);
LEKALO_EXPORT(lekalo_close) std::int32_t lekalo_close(std::int32_t handle);
/// Text: the document as JSON.
LEKALO_EXPORT(lekalo_document) std::int32_t lekalo_document(std::int32_t handle);

/// Adds or replaces a placement (input: one PLACEMENT); takes one away.
LEKALO_EXPORT(lekalo_set) std::int32_t lekalo_set(std::int32_t handle);
LEKALO_EXPORT(lekalo_erase) std::int32_t lekalo_erase(std::int32_t handle, double id);
LEKALO_EXPORT(lekalo_set_next_id) std::int32_t lekalo_set_next_id(std::int32_t handle, double id);

/// Adds or replaces a defect (kind 0) or a zone (kind 1) of a stock; input: it, as layout files have it, JSON
/// of `bytes`. A new one comes to lie at `index` of its list, or at the end of a shorter one. Takes one away
/// (input: its id, `bytes` of text). As change messages say it: docs/protocol.md.
LEKALO_EXPORT(lekalo_set_feature)
std::int32_t lekalo_set_feature(std::int32_t handle, double stock, std::int32_t kind, double index,
                                std::uint32_t bytes);
LEKALO_EXPORT(lekalo_erase_feature)
std::int32_t lekalo_erase_feature(std::int32_t handle, double stock, std::int32_t kind, std::uint32_t bytes);
/// Numbers: the VIOLATIONs of all parts with one defect or zone. \param depths as in lekalo_state \return how
/// many
LEKALO_EXPORT(lekalo_violations_with)
std::int32_t lekalo_violations_with(std::int32_t handle, double stock, std::int32_t kind, double index,
                                    std::int32_t depths);

/// What would be so if these `count` placements (input: ids) were turned about the middle of their box by
/// `degrees` and then moved by (dx, dy). Numbers: the NEAREST, then every VIOLATION in the order of check().
/// NEAREST is 8 doubles: distance (-1: nothing within `reach`, or not asked for because something is
/// forbidden), what it is to (0 a part, 1 the border, 2 a defect), id of the other placement or index of the
/// defect, id of the placement, the nearest points: x, y of the other, x, y of the placement.
/// \param depths  0: amounts and directions of overlap, outside, defect and quality are left out, which is
/// what makes it quick enough for every move of a hand (layout::Depths) \return 0 clear, 1 closer than a gap,
/// 2 forbidden otherwise
LEKALO_EXPORT(lekalo_state)
std::int32_t lekalo_state(std::int32_t handle, std::uint32_t count, double dx, double dy, double degrees,
                          double reach, std::int32_t depths);
/// The same of `count` PLACEMENTs in place of those with their ids, which need not be there.
LEKALO_EXPORT(lekalo_state_of)
std::int32_t lekalo_state_of(std::int32_t handle, std::uint32_t count, double reach, std::int32_t depths);
/// Numbers: every VIOLATION of the document. \return how many
LEKALO_EXPORT(lekalo_check) std::int32_t lekalo_check(std::int32_t handle);
/// The same bit by bit. All placements are unchecked at first, and again when they are set or a feature near
/// them changes. Looks at up to `most` of the unchecked, lowest ids first. Numbers: how many are left, how
/// many were looked at, their ids, then every VIOLATION that one of these has a part in, but for those with
/// an unchecked one, which come when its turn does. So who drops the violations of what was set, erased and
/// looked at, and adds these, has those of lekalo_check once nothing is left. \return how many
LEKALO_EXPORT(lekalo_check_some)
std::int32_t lekalo_check_some(std::int32_t handle, std::uint32_t most);

/// Plans a command line (`bytes` of input) without carrying it out. Numbers: the next id after it, then a
/// PLACEMENT for each that changes; part is -1 where it goes. Text: what becomes of defects and zones, the
/// list "features" of change messages, or nothing. \return 1, or 0 when nothing would change
LEKALO_EXPORT(lekalo_plan)
std::int32_t lekalo_plan(std::int32_t handle, std::uint32_t bytes, std::int32_t strict);

/// Numbers: ids of parts at a point, edges included; of parts whose boxes meet a box; ascending.
LEKALO_EXPORT(lekalo_pick)
std::int32_t lekalo_pick(std::int32_t handle, double stock, double copy, double x, double y);
LEKALO_EXPORT(lekalo_in_box)
std::int32_t lekalo_in_box(std::int32_t handle, double stock, double copy, double left, double bottom,
                           double right, double top);
/// Numbers: PLACEMENTs with id 0 (layout::fits_where). \param mirrored 1, 0, or -1 for either
LEKALO_EXPORT(lekalo_fits_where)
std::int32_t lekalo_fits_where(std::int32_t handle, double part, double stock, double copy,
                               std::uint32_t most, std::int32_t mirrored);

/// Numbers: all PLACEMENTs, ascending by id.
LEKALO_EXPORT(lekalo_placements) std::int32_t lekalo_placements(std::int32_t handle);
/// An outline in its own frame, not placed. Numbers: the count of its loops, where each begins among the
/// points (and the number of points), then x and y of every point. \param kind 0 part `a`, 1 stock `a`, 2
/// defect `b` of stock `a`, 3 zone `b` of stock `a`, 4 area `b` of part `a`
LEKALO_EXPORT(lekalo_outline)
std::int32_t lekalo_outline(std::int32_t handle, std::int32_t kind, double a, double b);
/// Text: JSON of layout::completeness, as `lekalo show --json` words it.
LEKALO_EXPORT(lekalo_completeness) std::int32_t lekalo_completeness(std::int32_t handle);
/// Text: the kits of it alone, for every change: sheets are what takes time.
LEKALO_EXPORT(lekalo_kits) std::int32_t lekalo_kits(std::int32_t handle);

/// Numbers: cosine and sine that the kernel takes for an angle. A browser's own are others in the last bit.
LEKALO_EXPORT(lekalo_rotation) std::int32_t lekalo_rotation(double degrees);
/// Numbers: the angle of a pair, in (-180, 180].
LEKALO_EXPORT(lekalo_degrees) std::int32_t lekalo_degrees(double c, double s);
}
