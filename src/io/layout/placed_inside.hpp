#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/nc/profile.hpp"
#include "sheet_shapes.hpp"

namespace lekalo::io::detail {

/// Lines and texts inside placed parts, as exports write them: docs/design/marks.md.

/// The layer on which a mark or text is written: its own, with "_" for characters that DXF cannot hold. What
/// has none, or one of kExportLayers, is on kInsideLayer.
inline constexpr const char* kInsideLayer = "INSIDE";
[[nodiscard]] std::string layer_of_inside(const std::string& layer);

/// The strokes of a text as chains of lines.
[[nodiscard]] std::vector<geom::Contour> stroke_chains(const layout::PartText& text);

/// The marks of a sheet's parts for a program, and what becomes of the others.
class SheetMarks {
 public:
  explicit SheetMarks(const SheetShapes& sheet);

  /// The parts with the marks that may be engraved.
  [[nodiscard]] const std::vector<nc::ProfilePart>& parts() const noexcept { return parts_; }
  /// A sentence about what a program does not engrave, by number, layer and reason; empty for nothing.
  /// \param engraves  whether there are words for engraving
  [[nodiscard]] std::string left_out(const nc::ProfileProgram& program, bool engraves) const;

 private:
  void add(std::size_t part, const std::string& layer, layout::MarkRole role, bool has_letters,
           std::vector<geom::Contour> lines);

  std::vector<nc::ProfilePart> parts_;
  std::vector<std::vector<std::string>> layers_;  ///< by part and mark
  /// Layers and reasons of those that are never engraved, and their number.
  std::map<std::pair<std::string, std::string>, std::size_t> never_;
};

}  // namespace lekalo::io::detail
