#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lekalo/layout/document.hpp"
#include "lekalo/layout/workspace.hpp"

namespace lekalo::layout {

/// This header says what a layout amounts to: kits and parts complete, material used. Placements count
/// wherever they lie; whether they lie well is the check's matter.

/// Pieces of a part, upright and mirrored ones.
struct PieceCount {
  std::int64_t upright = 0, mirrored = 0;
  [[nodiscard]] std::int64_t total() const noexcept { return upright + mirrored; }
  friend bool operator==(const PieceCount&, const PieceCount&) = default;
};

struct MissingPiece {
  std::uint32_t part = 0;
  std::int64_t count = 0;
  std::optional<bool> mirrored;  ///< absent: either serves
  friend bool operator==(const MissingPiece&, const MissingPiece&) = default;
};

struct KitCount {
  std::int64_t complete = 0;          ///< at most the kits wanted
  std::vector<MissingPiece> missing;  ///< for all those wanted that are not complete
};

/// One copy of a stock with something on it. Areas mm^2.
struct SheetUse {
  Sheet sheet;
  std::size_t parts = 0;
  double parts_area = 0;
  double material_area = 0;   ///< less holes; of a strip, up to the length used
  double defect_area = 0;     ///< of that, lost to defects (each point once)
  double used_length_mm = 0;  ///< from x = 0 to the last part; of strips and sheets of any kind
  geom::GridBox remnant;      ///< a large rectangle free of parts, defects and holes; proved free, empty
                              ///< (low == high) where none was found. Of a strip: up to its length, or up to
                              ///< the length used where it is open.
  [[nodiscard]] double density() const noexcept { return material_area > 0 ? parts_area / material_area : 0; }
};

struct Completeness {
  std::vector<PieceCount> placed;     ///< by part
  std::vector<std::int64_t> missing;  ///< by part: of all that are wanted
  std::vector<std::int64_t> surplus;  ///< by part: beyond all that are wanted
  std::vector<KitCount> kits;         ///< by kit
  std::vector<SheetUse> sheets;       ///< those in use, by stock and copy
  double density = 0;                 ///< of all sheets in use together
  double cost = 0;                    ///< of the copies in use
};

/// Kits that pieces make, and what is left of the pieces then.
struct KitsMade {
  std::vector<std::int64_t> complete;  ///< by kit, at most the kits wanted
  std::vector<PieceCount> left;        ///< by part
};
/// Whole kits that are worth most together; of equals, as many as can be of the first, then of the second.
/// Proved the best unless kits compete in thousands of ways: then the best found. Cost: O(pieces of all kits)
/// where they do not compete.
/// \param placed  by part
[[nodiscard]] KitsMade kits_made(const Document& document, std::vector<PieceCount> placed);

/// The kits that the placements serve.
struct KitsServed {
  std::vector<PieceCount> placed;  ///< by part
  std::vector<KitCount> kits;      ///< by kit
  std::vector<PieceCount> left;    ///< by part: in no kit, not even in one begun
};
/// Pieces serve the kits that are worth most (kits_made), then those begun in the document's order. Cheap
/// enough for every change of a layout: no geometry.
/// Cost: O(placements) and that of kits_made.
[[nodiscard]] KitsServed kits_served(const Document& document);

/// Kits first (kits_served), then the parts' own demand.
/// Cost: O(n log n), and for every sheet a raster of at most 192 by 192 cells for its remnant.
[[nodiscard]] Completeness completeness(const Workspace& workspace);

}  // namespace lekalo::layout
