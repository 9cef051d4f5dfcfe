#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "groups.hpp"
#include "io/drawing/exact_arcs.hpp"
#include "lekalo/io/drawing/drawing.hpp"

namespace lekalo::io {

/// The entry of the named objects whose XRECORD holds the exact arcs of our own files, and its first text;
/// the others are "handle arc", exact_arcs.hpp.
inline constexpr const char* kExactArcsName = "LEKALO_EXACT_ARCS";

class DxfExactArcs {
 public:
  /// A text (group 1) of that XRECORD. Others are counted as arcs that do not fit.
  void add(std::string_view text);
  /// Restores the stated arcs in the curves of the entities with their handles. Returns how many do not fit,
  /// as restore_exact_arcs does, with those of entities that are gone. Curves keep their order. Cost:
  /// O(curves + n log n).
  [[nodiscard]] std::size_t restore(std::vector<DrawnCurve>& curves,
                                    const std::vector<DrawnEntity>& entities);

 private:
  std::map<std::string, std::vector<ExactArc>, std::less<>> arcs_;  ///< by handle
  std::size_t unfit_ = 0;
};

}  // namespace lekalo::io
