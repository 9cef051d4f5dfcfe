#pragma once

#include <cstdint>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::geom {

/// Contours out of curves that cross, touch or overlap, on the arrangement of boolean.hpp.
/// docs/design/boolean.md, "Faces".

/// Says which points contours hold that wind around them several times.
enum class FillRule : std::uint8_t { even_odd, nonzero };

/// A contour that meets itself nowhere, and for every edge the number of the given edge that it is part of.
struct CutContour {
  Contour contour;
  std::vector<std::uint32_t> origins;
};
/// A stretch of a given edge.
struct CutEdge {
  Edge edge;
  std::uint32_t origin = 0;
};
struct CutFaces {
  /// In the order of their first edges, counter-clockwise around what they enclose but for holes.
  std::vector<CutContour> contours;
  /// Stretches along which none of the contours runs, one of several that coincide, in order.
  std::vector<CutEdge> left;
  /// As of BooleanResult.
  double edge_error = 0, corner_error = 0;
};

/// Returns the contours around the points that the rule says are inside: outer ones, and holes clockwise. Two
/// of them may share corners. Edges are numbered through the list. Fails as combine() does.
/// \pre every contour by itself is accepted by make_region
[[nodiscard]] Result<CutFaces> contours_around(const std::vector<Contour>& contours, FillRule rule);

/// Returns the outer contours of all bounded faces that the edges cut the plane into; neighbours share edges.
/// What bounds no face, because one face lies on both its sides, is left. Fails as combine() does.
/// Cost: O((n + k) log n), k pairs of edges whose boxes meet.
[[nodiscard]] Result<CutFaces> faces_between(const std::vector<Edge>& edges);

}  // namespace lekalo::geom
