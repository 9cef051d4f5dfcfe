#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lekalo/layout/document.hpp"
#include "lekalo/layout/workspace.hpp"

namespace lekalo::layout {

/// The sums of a layout: kits and parts complete, material used. Placements count wherever they lie;
/// whether they lie well is the check's matter.

/// The upright and the mirrored pieces of a part.
struct PieceCount {
  std::int64_t upright = 0, mirrored = 0;
  [[nodiscard]] std::int64_t total() const noexcept { return upright + mirrored; }
  friend bool operator==(const PieceCount&, const PieceCount&) = default;
};

struct MissingPiece {
  std::uint32_t part = 0;
  std::int64_t count = 0;
  /// Without a value either serves.
  std::optional<bool> mirrored;
  friend bool operator==(const MissingPiece&, const MissingPiece&) = default;
};

struct KitCount {
  /// At most the kits wanted.
  std::int64_t complete = 0;
  /// The pieces missing for all kits that are wanted and not complete.
  std::vector<MissingPiece> missing;
};

/// One copy of a stock with something on it. Areas are in mm^2.
struct SheetUse {
  Sheet sheet;
  std::size_t parts = 0;
  double parts_area = 0;
  /// The material without holes; of a strip, up to the length used.
  double material_area = 0;
  /// The part of the material that is lost to defects, each point once.
  double defect_area = 0;
  /// From x = 0 to the last part, of strips and sheets of any kind.
  double used_length_mm = 0;
  /// A large rectangle free of parts, defects and holes, proved free; empty (low == high) where none was
  /// found. On a strip it reaches up to the strip's length, or up to the length used where the length is
  /// open.
  geom::GridBox remnant;
  [[nodiscard]] double density() const noexcept { return material_area > 0 ? parts_area / material_area : 0; }
};

struct Completeness {
  std::vector<PieceCount> placed;  ///< by part
  /// By part: the pieces missing of all that are wanted.
  std::vector<std::int64_t> missing;
  /// By part: the pieces beyond all that are wanted.
  std::vector<std::int64_t> surplus;
  std::vector<KitCount> kits;  ///< by kit
  /// The sheets in use, by stock and copy.
  std::vector<SheetUse> sheets;
  /// The density of all sheets in use together.
  double density = 0;
  /// The cost of the copies in use.
  double cost = 0;
};

/// The kits that pieces make, and what is left of the pieces then.
struct KitsMade {
  /// By kit, at most the kits wanted.
  std::vector<std::int64_t> complete;
  std::vector<PieceCount> left;  ///< by part
};
/// Returns the whole kits that are worth most together; of equals, as many as can be of the first, then of
/// the second. The result is proved the best unless kits compete in thousands of ways; then it is the best
/// found. Cost: O(pieces of all kits) where they do not compete.
/// \param placed  by part
[[nodiscard]] KitsMade kits_made(const Document& document, std::vector<PieceCount> placed);

/// The kits that the placements serve.
struct KitsServed {
  std::vector<PieceCount> placed;  ///< by part
  std::vector<KitCount> kits;      ///< by kit
  /// By part: the pieces in no kit, not even in one begun.
  std::vector<PieceCount> left;
};
/// Assigns pieces to the kits that are worth most (kits_made), then to those begun, in the document's order.
/// This needs no geometry and is cheap enough for every change of a layout. Cost: O(placements) and that of
/// kits_made.
[[nodiscard]] KitsServed kits_served(const Document& document);

/// Counts kits first (kits_served), then the parts' own demand. Cost: O(n log n), and for every sheet a
/// raster of at most 192 by 192 cells for its remnant.
[[nodiscard]] Completeness completeness(const Document& document);

}  // namespace lekalo::layout
