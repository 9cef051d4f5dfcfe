#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/run_control.hpp"
#include "lekalo/layout/document.hpp"

namespace lekalo::nest {

/// Automatic layouts: places what a document wants on its stock so that the strip gets short, or the sheets
/// and hides few and the last one empty from the right. Method and figures: docs/design/nest.md.

enum class Reason : std::uint8_t {
  no_angle,   ///< no angle is allowed for it, or its grain fits no stock
  too_large,  ///< it fits on none of the stock at any angle tried, even if that were whole and good
  no_zone,    ///< it would, but wherever it was tried zones or defects are too bad for it
  no_stock    ///< no stock is left with room for it: no place was found; not a proof that there is none
};
/// "no-angle", "too-large", "no-zone", "no-stock".
[[nodiscard]] std::string_view name_of(Reason reason) noexcept;

struct Unplaced {
  std::uint32_t part = 0;
  std::int64_t count = 0;
  Reason reason{};
  friend bool operator==(const Unplaced&, const Unplaced&) = default;
};

struct Nested {
  /// The given one with other placements, ascending by id; those that were locked are as they were. Passes
  /// layout::check().
  layout::Document document;
  std::vector<Unplaced> unplaced;  ///< by part
  std::uint64_t work =
      0;  ///< candidate places looked at; grids and relaxing count as the places that take as long
  std::uint64_t merges = 0;  ///< of the strands; only there a run ends
};

struct Options {
  std::uint64_t seed = 0;
  unsigned threads = 1;     ///< 1 or more; changes the speed and nothing else
  std::size_t angles = 24;  ///< that a part may have that may be turned anyhow; in [1, 360]
  /// Begins with the placements that are not locked: they keep their ids and are wanted, whatever the demand,
  /// so only better layouts take the place of a given one. Those that break a rule are placed anew. Otherwise
  /// they are dropped.
  bool from_given = true;
  /// Where positive: the left and the right piece of a part in one kit, or else two of its pieces, lie on one
  /// sheet with the middles of their boxes at most so far apart, mm (pieces that are both placed anew).
  double pair_distance = 0;
  /// Called at a merge with every better layout, from the calling thread; may be empty.
  std::function<void(const Nested&)> improved;
};

/// Places everything the document wants (layout::wanted) beside its locked placements.
///
/// Deterministic: the same document, options and control.work_limit give the same layout whatever the
/// threads and the stop flag's clock, as long as the run ends at the same merge; `work` of a run that was
/// stopped is the limit that repeats it.
///
/// Fails with bad_input where the document has no stock or wants nothing, where locked placements break a
/// rule, and for more than 100,000 pieces. Angles of ranges are tried in steps of 360 / angles degrees.
/// Memory: some tens of kilobytes for every pair of parts and difference of angles that meet.
[[nodiscard]] Result<Nested> nest(const layout::Document& document, const Options& options,
                                  const RunControl& control);

}  // namespace lekalo::nest
