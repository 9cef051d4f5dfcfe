#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/run_control.hpp"
#include "lekalo/layout/document.hpp"

namespace lekalo::nest {

/// Automatic layouts. nest() places the pieces that a document wants on its stock so that a strip gets
/// short, or so that sheets and hides are few and the last one has much left. How: docs/design/nest.md.

/// Why a piece is not placed.
enum class Reason : std::uint8_t {
  no_angle,   ///< no angle is allowed for it, or its grain fits no stock
  too_large,  ///< it fits on no stock at any angle tried, even if the stock were whole and good
  no_zone,    ///< it would fit, but zones or defects were too bad for it wherever it was tried
  no_stock,   ///< no place was found on the stock that is left, which is no proof that there is none
  not_tried   ///< the run ended before its turn came
};
/// The word for a reason: "no-angle", "too-large", "no-zone", "no-stock", "not-tried".
[[nodiscard]] std::string_view name_of(Reason reason) noexcept;

/// Pieces of a part that are not placed.
struct Unplaced {
  std::uint32_t part = 0;
  std::int64_t count = 0;
  Reason reason{};
  friend bool operator==(const Unplaced&, const Unplaced&) = default;
};

/// The rest of the sheet used least that is worth most; it decides between layouts that place as much on
/// stock as dear. Strips have one rest, whatever this says.
enum class Remnant : std::uint8_t {
  corner,     ///< all beyond a box at the lower left corner: two cuts free it, as two pieces or one angle
  rectangle,  ///< all beyond one cut across the sheet, parallel to either side, whichever frees more
  strip       ///< all beyond one cut parallel to y: a piece as high as the sheet
};

/// The result of nest().
struct Nested {
  /// The given document with other placements, ascending by id. Locked placements are as they were. It
  /// passes layout::check().
  layout::Document document;
  std::vector<Unplaced> unplaced;  ///< ascending by part
  /// Candidate places looked at. Grids and relaxing count as the places that take as long.
  std::uint64_t work = 0;
  /// How often the strands were merged; a run ends only at a merge.
  std::uint64_t merges = 0;
  /// False: there were too many pieces to look for a better layout than the first (more than 20,000).
  bool searched = true;
};

struct Options {
  std::uint64_t seed = 0;
  unsigned threads = 1;  ///< 1 or more; this changes the speed and nothing else
  /// The number of angles of a part that may be turned by any angle, in [1, 360].
  std::size_t angles = 24;
  /// True: the run begins with the placements that are not locked. They keep their ids and are wanted
  /// whatever the demand, so only a better layout takes the place of the given one; those that break a rule
  /// are placed anew. False: they are dropped.
  bool from_given = true;
  /// mm. Where this is positive, the left and the right piece of a part in one kit, or else two of its
  /// pieces, lie on one sheet with the middles of their boxes at most so far apart. It holds for pieces
  /// that are placed anew.
  double pair_distance = 0;
  Remnant remnant = Remnant::corner;
  /// Called at a merge with every better layout, from the calling thread; may be empty.
  std::function<void(const Nested&)> improved;
};

/// Places all pieces that the document wants (layout::wanted) beside its locked placements.
///
/// It is deterministic: the same document, options and control.work_limit give the same layout, whatever
/// the threads. A run that was stopped by its flag is repeated by its `work` as the limit, unless it was
/// stopped before its first layout was whole: then it has what lay there, or what was given, and beside it in
/// columns, by their boxes, the pieces whose turn had not come, as far as that breaks no rule.
///
/// It fails with bad_input where the document has no stock or wants nothing, where locked placements break
/// a rule, and for more than 100,000 pieces. Angles of ranges are tried in steps of 360 / angles degrees.
/// Memory: some tens of kilobytes for every pair of parts and difference of angles that meet.
[[nodiscard]] Result<Nested> nest(const layout::Document& document, const Options& options,
                                  const RunControl& control);

}  // namespace lekalo::nest
