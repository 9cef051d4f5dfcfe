#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "drawing.hpp"

namespace lekalo::verify {

/// How a result says that a drawing became a region.
struct WrittenDrawing {
  /// The layers that were taken; empty for all that are not hidden.
  std::vector<std::string> layers;
  /// Curves no longer than this that no outline needs were set aside, each at one of the places, mm.
  double join = 0;
  std::vector<Vec> set_aside;
  /// Lines that bound no area, and curves that were set aside; the file's lie within `loose_error` of them.
  std::vector<Side> marks, set_aside_curves;
  double loose_error = 0;
};
[[nodiscard]] WrittenDrawing read_written_drawing(Json value, const std::string& path,
                                                  std::string& complaint);

struct DrawingVerdict {
  std::string fault, open;
  /// The layers of the curves along which each written edge of the region runs.
  std::vector<std::set<std::string>> layers;
};

/// Says whether every point of the outline of `used`, and of every mark, lies within `reach` of a curve that
/// counts, and every such curve within it of the outline, of a mark, or of what was set aside by name.
[[nodiscard]] DrawingVerdict check_drawing(const WrittenDrawing& written, const ReadDrawing& drawing,
                                           const Shape& used, double reach);

}  // namespace lekalo::verify
