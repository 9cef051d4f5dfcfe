#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "grid_number.hpp"
#include "grid_outline.hpp"
#include "lekalo/base/error.hpp"
#include "lekalo/verify/verify.hpp"

namespace lekalo::verify {

/// The parts of a written layout that the rules speak of. Lengths are in steps, angles in degrees.

struct WrittenArea {
  int quality = 0;
  GridOutline outline;
};

struct WrittenAngles {
  double from = 0, to = 0;
};

struct WrittenGrain {
  double degrees = 0, tolerance = 0;
};

struct WrittenPart {
  std::string id;
  GridOutline outline;
  int quality = 0;
  std::vector<WrittenArea> areas;
  /// An empty list allows any angle.
  std::vector<WrittenAngles> rotations;
  bool may_mirror = false;
  std::optional<WrittenGrain> grain;
  std::int64_t tolerated_severity = 0;
  /// The gaps of the part itself where it has any, else those of the document.
  std::int64_t gap = 0, border_gap = 0, defect_gap = 0;
};

/// A defect with its severity or a zone with its quality.
struct WrittenStockFeature {
  std::string id;
  std::int64_t grade = 0;
  GridOutline outline;
};

struct WrittenStock {
  std::string id;
  std::int64_t count = 1;
  GridOutline outline;
  std::optional<double> grain;
  std::vector<WrittenStockFeature> defects, zones;
};

struct WrittenPiece {
  std::uint64_t id = 0;
  std::size_t part = 0, stock = 0;
  std::int64_t copy = 0;
  GridTurn turn;
  GridPoint at;
  bool mirrored = false;
};

struct WrittenLayout {
  std::vector<WrittenStock> stocks;
  std::vector<WrittenPart> parts;
  std::vector<WrittenPiece> placements;
};

/// Reads a layout. bad_input names the field. Cost: O(n log n).
[[nodiscard]] Result<WrittenLayout> read_layout(const Document& document);

}  // namespace lekalo::verify
