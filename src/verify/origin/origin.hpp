#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "lekalo/base/units.hpp"
#include "lekalo/verify/verify.hpp"
#include "verify/read/json.hpp"
#include "verify/shape/shape.hpp"

namespace lekalo::verify {

/// The claim of a result about one of its regions, that it is what its file means.
struct RegionClaim {
  const Document& file;
  const Shape& used;
  /// How far the outlines of the two may lie apart, mm.
  double tolerance = 0;
  /// The field `scan` of the result where the file holds measured points, else null.
  Json scan;
  /// The result's own word on how a drawing was read; null or nothing for other files.
  Json drawing = {};
  /// Regions that are taken off what the file means, and their unit where it is said.
  std::vector<Json> ignored = {};
  std::optional<LengthUnit> unit_of_ignored = std::nullopt;
};

/// The answer: a fault is a reason to refuse, an open question one to say so.
struct Origin {
  std::optional<std::string> fault, open;
  /// The names that each written edge of the region may have; empty where the file gives none.
  std::vector<std::set<std::string>> labels;
  /// The edges of a region file, or of points, along which each edge of the region runs; empty where
  /// something else was read, and where nothing was taken off.
  std::vector<std::set<std::size_t>> edges;
  /// The region in such a file.
  std::optional<Shape> in_file;
};

/// Rechecks by its own reading of the file that the region used is what the file means: regions, points along
/// an outline, a tree of primitives, a drawing, a scan; the ending of its name and its content say which.
[[nodiscard]] Origin check_origin(const RegionClaim& claim);

}  // namespace lekalo::verify
