#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "lekalo/base/error.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/layout/document.hpp"

namespace lekalo::io {

/// Job files of other nesting programs, as layout documents: docs/formats.md, "Nesting jobs of other
/// programs". Recognised by what is in them.

enum class NestingForm {
  strip,      ///< "strip_height" and "items": one strip of open length
  sheets,     ///< "bin_types" and "item_types": sheets in stated numbers
  hides,      ///< "Items" and "Objects": hides with holes and quality zones
  placements  ///< "placements" of the items of a strip file, their "instance"
};

/// Reads strips, sheets and hides. The files do not say their unit: `unit` does, millimetres if absent.
///
/// Repairs that leave the material as it is, each with a notice: points that stand twice; spikes, where an
/// outline runs back along itself; holes of a stock that meet its outline or each other become defects of the
/// severity kNeverTolerated, so that no part may lie there. Stocks that are alike become one with a count.
///
/// Fails with ErrorCode::bad_input, naming file, place and number: fields it does not know (but for those
/// that begin with _), outlines that meet themselves, items of several pieces, shapes it does not know.
[[nodiscard]] Result<LayoutFile> read_nesting(std::string_view bytes, const std::string& name,
                                              std::optional<LengthUnit> unit = std::nullopt);

/// The file that a file of placements belongs to, as it says.
[[nodiscard]] Result<std::string> instance_of_placements(std::string_view bytes, const std::string& name);

/// Places the items of `instance`, a document of one strip, as the file says: an item's outline is turned
/// about the origin by "rotation" degrees, then moved by (x, y). "item" is a part's id where all ids are
/// numbers, else its index. Fails as read_nesting does, and where the file's strip_height is not the strip's.
[[nodiscard]] Result<LayoutFile> read_placements(std::string_view bytes, const std::string& name,
                                                 layout::Document instance,
                                                 std::optional<LengthUnit> unit = std::nullopt);

/// The first strip that something lies on; ErrorCode::bad_input without one.
[[nodiscard]] Result<std::size_t> strip_in_use(const layout::Document& document);

/// The placements on one strip in the same form, mm. read_placements gives the same placed outlines again,
/// every point within a step: the angle is written in degrees, within 1e-12 of the pair. Lost are ids and
/// locks of placements, and everything that the instance has to say (parts, kits, rules). `length` is how far
/// the placed outlines reach, `density` their area in that length.
///
/// Fails with ErrorCode::bad_input for mirrored placements, which the form cannot say, for a stock that is no
/// strip or not there, and where nothing lies on it.
[[nodiscard]] Result<std::string> write_placements(const layout::Document& document, std::size_t stock,
                                                   const std::string& instance);

}  // namespace lekalo::io
