#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/locate/criterion.hpp"
#include "lekalo/locate/region.hpp"

namespace lekalo::locate {

/// Localisation by what each feature of the part needs, and by more than one criterion. How the demands
/// become one clearance, what is proved and what is not: docs/design/locate-demands.md.
///
/// The allowance of a point of the outline is its distance from the blank's boundary, inside the blank.
/// Largest allowances are decided to RegionOptions::gap or a 10,000th of the blank's size, the larger of the
/// two.

/// Edges of the part that have a demand of their own.
struct Feature {
  std::string name;
  std::vector<std::uint32_t> edges;  ///< their numbers (geom::Region)
  /// No point of the edges has less allowance, mm, >= 0.
  double minimum = 0;
  /// The allowance that the most even placement aims at, mm, >= 0.
  std::optional<double> target;
  /// No point of the edges has more allowance, mm, > minimum.
  std::optional<double> maximum;
  /// The margin is measured in this, > 0.
  double scale = 1;
  /// For edges that are already finished: their points lie within this of the blank's boundary, mm, > 0. Such
  /// a feature has no minimum, target or maximum. The rim of that width along it may stick out.
  std::optional<double> finished;
};

/// Holds what is asked for beside the largest clearance.
struct Demands {
  std::vector<Feature> features;
  double minimum = 0;  ///< of edges that belong to no feature, mm, >= 0
  Criterion criterion = criteria().front();
  double give_up = 0;         ///< of the margin, for criteria that go on from the largest, mm, >= 0
  std::size_t trade_off = 0;  ///< points of the curve to compute, 0 or at least 2
};

struct DemandProblem : Demands {
  RegionProblem shapes;  ///< without caps
};

/// A placement on the curve of smallest against largest allowance.
struct TradeOff {
  Placement at;
  bool mirrored = false;
  double margin = 0;  ///< at least that, mm
  /// The largest allowance there, rounded up, mm.
  double largest = 0;
  /// No placement with that margin has a smaller largest allowance, mm.
  double largest_bound = 0;
};

/// The certificate proves, for every placement in the window, that the least of
///   the clearance of `grown`, and what each cap has left when `shift` is added to it,
/// is at most `bound`. The caps are the features with a maximum or that are finished, in their order.
struct DemandProof {
  /// The part grown by what its edges demand for the margin `grown_for`. Every edge is grown by minimum +
  /// scale * grown_for, and the rims of finished ones are taken off. Within `tolerance` of the exact one.
  std::vector<geom::Region> grown;
  double grown_for = 0, tolerance = 0;
  double shift = 0, bound = 0;
  geom::Point pivot;
  std::vector<CoverTree> certificate;
};

/// The proof of a search with one more cap, the last: `most` on every edge that is not finished. So every
/// placement with a margin above grown_for + bound / (least scale) that keeps the maxima has a largest
/// allowance of at least most + shift - bound. (Maxima are kept where `bound` is below `shift`.)
struct LargestProof : DemandProof {
  double most = 0;
};

/// Holds what was found of the smallest largest allowance.
struct SmallestLargest {
  double margin = 0;  ///< placements with at least that were compared: the largest found less `give_up`
  double found = 0;   ///< the smallest largest allowance found among them, rounded up, mm
  double bound = 0;   ///< none of them that keeps the maxima has less, mm
  double gap = 0;     ///< what `found` - `bound` was to become, mm
  double kept = 0;    ///< later criteria go up to that: `bound` + `gap`, or `found` if that is more
  std::optional<LargestProof> proof;  ///< of `bound`; none where that is 0
};

struct DemandResult {
  /// optimal: the margin is within margin_gap of its bound and, if asked for, the smallest largest allowance
  /// within its own gap.
  Status status = Status::stopped;
  /// Its clearance is that of the part alone, rounded down.
  Placement best;
  bool mirrored = false;
  /// If every demand is met, this is the least of (allowance - minimum) / scale over the edges that are not
  /// finished, rounded down. Otherwise it is minus how much of the demanded material is missing, or allowance
  /// too large, mm.
  double margin = 0;
  /// No placement that keeps the maxima has a larger margin; rounded up.
  double margin_bound = 0;
  /// The largest margin found: `margin`, unless another criterion gave some up.
  double margin_found = 0;
  /// The difference of margin_bound and margin_found that was asked for.
  double margin_gap = 0;
  /// The largest allowance of an edge that is not finished, rounded up, mm.
  double largest = 0;
  std::optional<SmallestLargest> second;  ///< where the criterion asks for it and the demands are met
  /// The root of the mean square deviation of the allowance from its targets, mm, as measured.
  double deviation = 0;
  /// The contacts of the part itself, near or deep where the demands hold it.
  std::vector<Touch> contacts;
  DemandProof proof;
  /// The curve from the largest margin to none.
  std::vector<TradeOff> curve;
  std::uint64_t work = 0;
};

/// Status::infeasible: proved that no placement meets the demands; `best` is the one that misses least.
///
/// ErrorCode::usage for numbers out of range, edges that the part does not have or that two features claim,
/// and as locate_regions. bad_input where the grown part cannot be drawn (geom/offset.hpp).
/// Deterministic. Cost: one search of locate_regions; with scales three to eight of them; with maxima that
/// bind, or for the smallest largest allowance, about twelve that end early; every point of the curve as
/// many.
[[nodiscard]] Result<DemandResult> locate_demands(const DemandProblem& problem, const RegionOptions& options);

}  // namespace lekalo::locate
