#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "grid_number.hpp"
#include "grid_outline.hpp"
#include "lekalo/base/error.hpp"
#include "lekalo/verify/verify.hpp"
#include "verify/shape/shape.hpp"

namespace lekalo::verify {

/// The parts of a written layout that the rules speak of. Lengths are in steps, angles in degrees.

struct WrittenOutline : GridOutline {
  /// The drawing beside the polygon, or null where there is none.
  std::shared_ptr<const Shape> drawn;
  double chord_tolerance = 0.01;
  /// The place in the file of an outline with a drawing and no polygon, which has no edges then; else empty.
  std::string unmade;
};

struct WrittenArea {
  int quality = 0;
  WrittenOutline outline;
};

struct WrittenAngles {
  double from, to;
  friend bool operator==(const WrittenAngles&, const WrittenAngles&) = default;
};

struct WrittenGrain {
  double degrees = 0, tolerance = 0;
  friend bool operator==(const WrittenGrain&, const WrittenGrain&) = default;
};

/// A line on a part that no rule asks for: the numbers of its edges in their order, of an arc with its
/// centre, and whether it runs counter-clockwise.
struct WrittenMark {
  std::string layer, colour, role = "mark";
  std::vector<double> numbers;
  std::vector<bool> arcs;  ///< says which edges are arcs
  friend bool operator==(const WrittenMark&, const WrittenMark&) = default;
};

/// A text on a part that no rule asks for either.
struct WrittenText {
  std::string text, layer, colour, role = "mark", anchor = "left";
  double x = 0, y = 0, height = 0, degrees = 0, width_factor = 1;
  bool mirrored = false;
  friend bool operator==(const WrittenText&, const WrittenText&) = default;
};

/// The material of stock, or of a part. No rule asks for it.
struct WrittenMaterial {
  std::string name;
  std::int64_t thickness = 0;  ///< 0: not said
  friend bool operator==(const WrittenMaterial&, const WrittenMaterial&) = default;
};

struct WrittenPart {
  std::string id;
  WrittenMaterial material;
  std::string customer, due, label;
  WrittenOutline outline;
  int quality = 0;
  std::vector<WrittenArea> areas;
  std::vector<WrittenMark> marks;
  std::vector<WrittenText> texts;
  /// An empty list allows any angle.
  std::vector<WrittenAngles> rotations;
  bool may_mirror = false;
  std::optional<WrittenGrain> grain;
  std::int64_t tolerated_severity = 0, priority = 0, demand = 0;
  /// The gaps of the part itself where it has any, else those of the document.
  std::int64_t gap = 0, border_gap = 0, defect_gap = 0;
};

/// A defect with its severity or a zone with its quality.
struct WrittenStockFeature {
  std::string id;
  std::int64_t grade;
  WrittenOutline outline;
};

struct WrittenStock {
  std::string id, kind;
  WrittenMaterial material;
  std::int64_t count = 1;
  double cost = 1;
  /// True for a strip without a length; its outline is as long as any.
  bool open = false;
  WrittenOutline outline;
  std::optional<double> grain;
  std::vector<WrittenStockFeature> defects, zones;
};

struct WrittenPiece {
  std::uint64_t id = 0;
  std::size_t part{}, stock{};
  std::int64_t copy = 0;
  GridTurn turn;
  GridPoint at;
  bool mirrored = false, locked = false;
};

struct WrittenKitPiece {
  std::size_t part;
  std::int64_t count = 1;
  /// Without a value either serves.
  std::optional<bool> mirrored;
  friend bool operator==(const WrittenKitPiece&, const WrittenKitPiece&) = default;
};

struct WrittenKit {
  std::string id;
  std::int64_t demand = 1;
  double value = 1;
  std::vector<WrittenKitPiece> pieces;
  friend bool operator==(const WrittenKit&, const WrittenKit&) = default;
};

struct WrittenLayout {
  std::vector<WrittenStock> stocks;
  std::vector<WrittenPart> parts;
  std::vector<WrittenKit> kits;
  std::vector<WrittenPiece> placements;
  std::int64_t kerf = 0;  ///< no rule asks for it
};

/// Reads a layout. bad_input names the field. Cost: O(n log n).
/// \param unmade  takes outlines that are drawn and have no polygon yet
[[nodiscard]] Result<WrittenLayout> read_layout(const Document& document, bool unmade = false);

/// Returns an outline of a part where the piece lies on its sheet.
[[nodiscard]] GridOutline placed_outline(const GridOutline& outline, const WrittenPiece& piece);

}  // namespace lekalo::verify
