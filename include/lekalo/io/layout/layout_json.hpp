#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/layout/document.hpp"

namespace lekalo::io {

/// The layout document as JSON, "lekalo-layout/1": docs/formats.md, docs/design/layout.md and the schema
/// docs/schema/lekalo-layout-1.schema.json.

/// More of them are refused, each with a sentence.
inline constexpr std::size_t kMostPlacements = 1'000'000;
/// The most parts of a layout, and likewise the most stocks and the most kits.
inline constexpr std::size_t kMostParts = 100'000;
inline constexpr std::size_t kMostOutlinePoints = 100'000;
/// The most marks of a part, and the most edges of a mark.
inline constexpr std::size_t kMostMarkEdges = 100'000;
/// Chords where a file gives curves alone, or a drawing, and nobody says otherwise; mm.
inline constexpr double kUsualChordTolerance = 0.01;
/// The highest severity of a defect in a file: no part may say that it tolerates it.
inline constexpr int kNeverTolerated = 1'000'001;

struct LayoutFile {
  layout::Document document;
  /// Sentences about fields left out and about what was repaired.
  std::vector<std::string> notices;
};

/// Reads the bytes of a layout. Fails with ErrorCode::bad_input and one sentence that names the file
/// (`name`), the place as a JSON path ("parts[3].outline.polygon.outer[17]"), the number and the way out:
/// fields it does not know (but for those that begin with x_), ids given twice, parts and stocks that are not
/// there, outlines that meet themselves, numbers beyond the limits of docs/formats.md, files that are cut
/// off, larger than 256 MiB or deeper than 64. A copy beyond the stock's count is read: the check reports it.
/// Cost: O(bytes), and that of make_grid_region for every outline.
[[nodiscard]] Result<LayoutFile> read_layout(std::string_view bytes, const std::string& name);

/// The same document as text, one item a line; every number is the shortest decimal that reads back to the
/// same step, multiple of 2^-52, or double. Law: read_layout(write_layout(d)) gives d and no notices
/// (tests/property/io_layout_json_test.cpp), for documents within the limits above whose outlines are made
/// by make_grid_region and whose texts are UTF-8 without control characters. Cost: O(text).
[[nodiscard]] std::string write_layout(const layout::Document& document);

}  // namespace lekalo::io
