#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lekalo/geom/polygon.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::io {

/// A curve of lines and arcs as it is compared with others.
struct LaidCurve {
  const std::vector<geom::Edge>* edges = nullptr;
  geom::Box box;
  double size = 0;   ///< mm, about the diagonal of the box
  bool used = true;  ///< false: left out
};

/// The box and size of edges. \pre edges is not empty
[[nodiscard]] LaidCurve laid_curve(const std::vector<geom::Edge>& edges);

/// A curve that lies on another one within `distance`.
struct LyingOn {
  std::uint32_t curve = 0, on = 0;
  double distance = 0;
};

/// Every used curve that lies within `reach` of another used one, along all its length and either way round:
/// a line on a line, an arc on an arc of nearly the same circle, or edge by edge the same curve in either
/// direction. `on` is a curve that lies on none itself: the longest such, the first of equals. A curve of
/// less than 16 `reach` must lie nearer, within a sixteenth of its size, so that short neighbours in a fine
/// outline are not taken for copies of each other. In ascending order of `curve`.
/// Cost: O((n + k) log n), k pairs of curves whose boxes come within reach, equal curves apart. The search
/// ends after limits::most_meeting_boxes of them, and copies may then be left.
[[nodiscard]] std::vector<LyingOn> curves_on_others(const std::vector<LaidCurve>& curves, double reach);

/// Two lines that lie on each other for a part, an end of each: where the second is to begin or end instead,
/// on the end of the first.
struct Overlap {
  std::uint32_t kept = 0, cut = 0;             ///< curves
  bool kept_at_end = true, cut_at_end = true;  ///< their `to`, else their `from`
  double distance = 0;                         ///< mm: how far they are apart along the part
};

/// A loose end of a curve that is a single line.
struct LooseEnd {
  std::uint32_t curve = 0;
  bool at_end = true;
  geom::Edge line;
};

/// The overlaps of lines at loose ends, each end in one of them at most, in the order of `ends`.
/// Cost: as curves_on_others.
[[nodiscard]] std::vector<Overlap> overlapping_ends(const std::vector<LooseEnd>& ends, double reach);

}  // namespace lekalo::io
