#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/geom/grid_region.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::layout {

/// A cutting layout: what is cut, from what, by which rules, and where it lies. These are values only;
/// docs/design/layout.md and docs/formats.md say what they mean and how they are written. Outlines and
/// lengths are on the grid of geom/grid.hpp.

/// An outline as it counts (`polygon`) and as it was drawn. A placed outline is its polygon, turned and
/// moved.
struct Outline {
  geom::GridRegion polygon;
  /// The drawn outline where it has arcs, in the same place, within chord_tolerance_mm of `polygon`. The
  /// polygon holds it (parts, defects, zones) or lies in it (stock). Empty where the polygon is the drawing.
  std::vector<geom::Region> curves;  ///< none or one
  double chord_tolerance_mm = 0;
  friend bool operator==(const Outline&, const Outline&) = default;
};

/// The angles from `from` counter-clockwise to `to`, degrees, ends included. from == to is one angle, to >=
/// from + 360 is every angle.
/// \pre from <= to
struct AngleRange {
  double from = 0, to = 0;
  friend bool operator==(const AngleRange&, const AngleRange&) = default;
};

/// The quality that a part or one of its areas needs. Zones of the stock carry a quality, and higher is
/// better. Material outside every zone is the best; where zones overlap, the worst counts.
inline constexpr int kBestQuality = std::numeric_limits<int>::max();
inline constexpr int kAnyQuality = 0;

/// An area of a part with a demand of its own, which takes the place of the part's demand there. Where areas
/// overlap, the highest counts.
struct PartArea {
  int quality = kAnyQuality;
  /// In the part's frame; the area may reach beyond the part.
  Outline outline;
  friend bool operator==(const PartArea&, const PartArea&) = default;
};

/// A role says what is done with a line or a text on a part. Machines cut along `mark` and `engrave` where
/// they have words for it, before they cut out the part; the others are shown only. docs/design/marks.md.
enum class MarkRole : std::uint8_t {
  mark,     ///< nobody said more about it
  engrave,  ///< said to be engraved
  bend,     ///< folded there, never cut
  cut       ///< said to be cut through; as it bounds no area, no contour of the part
};

/// A line on a part that bounds no area: a hinge, a bend, an engraving, a cut within the part. It takes no
/// room and no rule asks for it; it moves with the part.
struct PartMark {
  std::string layer;  ///< of the drawing; may be empty
  /// In the part's frame, as drawn, made by make_chain; closed where the last ends where the first begins.
  geom::Contour edges;
  std::string colour{};  ///< as the drawing shows it, "#rrggbb"; empty where it does not say
  MarkRole role = MarkRole::mark;
  friend bool operator==(const PartMark&, const PartMark&) = default;
};

/// An anchor is the point of a line of letters that stands at the place of its text.
enum class TextAnchor : std::uint8_t { left, middle, right };

/// A text on a part, one line of it. It takes no room and moves with the part like a drawn line: turned with
/// it, and written backwards where the part lies mirrored.
struct PartText {
  std::string text;         ///< one line of UTF-8, not empty
  geom::Point at;           ///< on the baseline, in the part's frame, mm
  double height = 1;        ///< of capitals, mm, > 0
  double degrees = 0;       ///< of the baseline, counter-clockwise
  double width_factor = 1;  ///< letters are as many times wider than the font has them, > 0
  bool mirrored = false;    ///< written backwards, to the left of `at` (before it is turned)
  TextAnchor anchor = TextAnchor::left;
  std::string layer{}, colour{};  ///< as of a mark
  MarkRole role = MarkRole::mark;
  friend bool operator==(const PartText&, const PartText&) = default;
};

/// A direction in the material or the part: grain, stretch. After half a turn it is the same one.
struct Grain {
  double degrees = 0;            ///< in the part's frame
  double tolerance_degrees = 0;  ///< in [0, 90]
  friend bool operator==(const Grain&, const Grain&) = default;
};

/// The material of stock, and what a part is to be cut from. No rule asks for it: whoever makes the layout of
/// an order puts parts beside stock of their material (jobs/order.hpp).
struct Material {
  std::string name;            ///< empty where nobody said it
  std::int64_t thickness = 0;  ///< grid steps; 0 where nobody said it
  [[nodiscard]] bool is_said() const noexcept { return !name.empty() || thickness != 0; }
  friend bool operator==(const Material&, const Material&) = default;
};

/// For whom and for when a part is, as labels and quotes say it; any of them may be empty. No rule asks for
/// it.
struct Purpose {
  std::string customer;
  std::string due;  ///< a day as is_day takes it
  std::string label;
  friend bool operator==(const Purpose&, const Purpose&) = default;
};

struct Part {
  std::string id;    ///< unique among parts, not empty
  std::string name;  ///< for people; may be empty
  Outline outline;
  int quality = kAnyQuality;
  std::vector<PartArea> areas;
  std::vector<PartMark> marks;
  std::vector<PartText> texts{};
  /// The allowed angles of the part as placed, after mirroring; an empty list allows any.
  std::vector<AngleRange> rotations;
  bool may_mirror = false;
  std::optional<Grain> grain;
  /// Defects of this severity or less may lie in the part.
  int tolerated_severity = 0;
  int priority = 0;  ///< higher first
  /// The pieces wanted beside those of kits.
  std::int64_t demand = 0;
  /// The part's own gaps in grid steps; the larger of two parts' gaps counts between them. Without a value
  /// the rules' gap counts.
  std::optional<std::int64_t> gap, border_gap, defect_gap;
  Material material{};
  Purpose purpose{};
  friend bool operator==(const Part&, const Part&) = default;
};

enum class StockKind : std::uint8_t {
  strip,  ///< a rectangle from (0, 0), `height` across; its length is open up to the outline's
  sheet,  ///< alike in all copies, usually a rectangle
  hide    ///< irregular, with defects and zones
};

struct Defect {
  std::string id;    ///< unique within its stock
  int severity = 1;  ///< >= 1
  Outline outline;
  friend bool operator==(const Defect&, const Defect&) = default;
};

struct QualityZone {
  std::string id;  ///< unique within its stock
  int quality = 0;
  Outline outline;
  friend bool operator==(const QualityZone&, const QualityZone&) = default;
};

struct Stock {
  std::string id;
  std::string name;
  StockKind kind = StockKind::sheet;
  /// The copies that are there, >= 1; a strip has one.
  std::int64_t count = 1;
  double cost = 1;  ///< of one copy, >= 0
  /// The material with holes; a strip's reaches to its longest length.
  Outline outline;
  /// True for a strip whose length nobody limits: the outline ends at kLongestStrip.
  bool open_length = false;
  std::optional<double> grain_degrees;
  std::vector<Defect> defects;
  std::vector<QualityZone> zones;
  Material material{};
  friend bool operator==(const Stock&, const Stock&) = default;
};
/// A strip of open length ends here, in steps: 262,144 mm.
inline constexpr std::int64_t kLongestStrip = geom::kGridLimit / 4;

/// The pieces of one part in a kit.
struct KitPiece {
  std::uint32_t part = 0;  ///< index into Document::parts
  std::int64_t count = 1;  ///< >= 1
  /// Left or right; without a value either serves.
  std::optional<bool> mirrored;
  friend bool operator==(const KitPiece&, const KitPiece&) = default;
};

/// The pieces that make one product.
struct Kit {
  std::string id;
  std::string name;
  std::int64_t demand = 1;  ///< kits wanted, >= 0
  double value = 1;         ///< of one kit, >= 0
  std::vector<KitPiece> pieces;
  friend bool operator==(const Kit&, const Kit&) = default;
};

/// Gaps in grid steps, >= 0; 0 lets edges touch.
struct Rules {
  std::int64_t gap = 0;         ///< part to part
  std::int64_t border_gap = 0;  ///< part to the border of the stock and of its holes
  std::int64_t defect_gap = 0;  ///< part to defects it does not tolerate
  /// The width of the cut, 0 where nobody said it. Orders and commands keep `gap` no smaller; the rules ask
  /// for `gap` alone.
  std::int64_t kerf = 0;
  friend bool operator==(const Rules&, const Rules&) = default;
};

struct Placement {
  std::uint64_t id = 0;     ///< unique in the document, > 0, never used again
  std::uint32_t part = 0;   ///< index into Document::parts
  std::uint32_t stock = 0;  ///< index into Document::stocks
  std::int64_t copy = 0;    ///< which of the stock's copies, in [0, count)
  geom::GridRotation rotation;
  bool mirrored = false;
  /// Added to the turned outline; |at| <= kGridLimit / 2.
  geom::GridPoint at;
  bool locked = false;
  friend bool operator==(const Placement&, const Placement&) = default;
};

struct Document {
  std::string name;
  std::vector<Stock> stocks;
  std::vector<Part> parts;
  std::vector<Kit> kits;
  Rules rules;
  std::vector<Placement> placements;  ///< ascending by id
  std::uint64_t next_id = 1;          ///< above every placement's id
  friend bool operator==(const Document&, const Document&) = default;
};

/// Says whether the text is a day of the calendar as ISO 8601 writes it: "2026-12-01".
[[nodiscard]] bool is_day(std::string_view text);

/// Returns the outline where it lies: turned, mirrored, moved.
[[nodiscard]] geom::GridRegion placed_outline(const Part& part, const Placement& placement);

/// Says whether a part may lie at this rotation: whether its set of angles holds it, decided on the exact
/// pairs of the ends.
[[nodiscard]] bool rotation_allowed(const Part& part, geom::GridRotation rotation);
/// Says whether the part's grain follows the stock's closely enough; true where either has none. A mirrored
/// part's grain is mirrored with it.
[[nodiscard]] bool grain_allowed(const Part& part, const Stock& stock, geom::GridRotation rotation,
                                 bool mirrored);

/// Returns the pieces of a part that are wanted: its own demand and those of all kits wanted.
[[nodiscard]] std::int64_t wanted(const Document& document, std::uint32_t part);

}  // namespace lekalo::layout
