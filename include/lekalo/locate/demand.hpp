#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
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
  std::vector<std::uint32_t> edges;  ///< numbered through all pieces and contours as in RegionTouch
  double minimum = 0;                ///< no point has less allowance, mm, >= 0
  std::optional<double> target;      ///< what the most even placement aims at, mm, >= 0
  std::optional<double> maximum;     ///< no point has more, mm, > minimum
  double scale = 1;                  ///< what is left over is measured in this, > 0
  /// Already finished: its points lie within this of the blank's boundary, mm, > 0; it has no minimum, target
  /// or maximum then. The rim of that width along it may stick out.
  std::optional<double> finished;
};

enum class Criterion {
  smallest,  ///< the largest margin
  largest,   ///< then, of the placements that give up at most `give_up` of it, the smallest largest allowance
  even       ///< then the least mean square deviation of the allowance from its targets (or its mean)
};

struct DemandProblem {
  RegionProblem shapes;  ///< without caps
  std::vector<Feature> features;
  double minimum = 0;  ///< of edges that belong to no feature, mm, >= 0
  Criterion criterion = Criterion::smallest;
  double give_up = 0;         ///< of the margin, for the second and third criterion, mm, >= 0
  std::size_t trade_off = 0;  ///< points of the curve to compute, 0 or at least 2
};

/// A placement on the curve of smallest against largest allowance.
struct TradeOff {
  Placement at;
  bool mirrored = false;
  double margin = 0;         ///< at least that, mm
  double largest = 0;        ///< the largest allowance there, rounded up, mm
  double largest_bound = 0;  ///< no placement with more than `margin` + gap has less, mm
};

/// The certificate proves, for every placement in the window, that the least of
///   the clearance of `grown`, and what each cap has left when `shift` is added to it,
/// is at most `bound`. The caps are the features with a maximum or that are finished, in their order.
struct DemandProof {
  /// The part grown by what its edges demand for the margin `grown_for`: every edge by minimum + scale *
  /// grown_for, rims of finished ones taken off. Within `tolerance` of the exact one.
  std::vector<geom::Region> grown;
  double grown_for = 0, tolerance = 0;
  double shift = 0, bound = 0;
  geom::Point pivot;
  std::vector<CoverTree> certificate;
};

struct DemandResult {
  Status status = Status::stopped;
  Placement best;  ///< its clearance is that of the part alone, rounded down
  bool mirrored = false;
  /// Where every demand is met: the least of (allowance - minimum) / scale over the edges that are not
  /// finished, rounded down. Where not: minus how much of the demanded material is missing, or allowance too
  /// large, mm.
  double margin = 0;
  double margin_bound = 0;  ///< no placement that keeps the maxima has more; rounded up
  double largest = 0;       ///< largest allowance of an edge that is not finished, rounded up, mm
  /// Criterion::largest: no placement with more than the largest margin - give_up + gap has less; mm.
  std::optional<double> largest_bound;
  double deviation =
      0;  ///< root of the mean square deviation of the allowance from its targets, mm, as measured
  std::vector<RegionTouch> contacts;  ///< of the part itself, near or deep where the demands hold it
  DemandProof proof;
  std::vector<TradeOff> curve;  ///< from the largest margin to none
  std::uint64_t work = 0;
};

/// Status::infeasible: proved that no placement meets the demands; `best` is the one that misses least.
///
/// ErrorCode::usage for numbers out of range, edges that the part does not have or that two features claim,
/// and as locate_regions. bad_input where the grown part cannot be drawn (geom/offset.hpp).
/// Deterministic. Cost: one search of locate_regions; with scales three to eight of them; with maxima that
/// bind, or for the second criterion, about twelve that end early; every point of the curve as many.
[[nodiscard]] Result<DemandResult> locate_demands(const DemandProblem& problem, const RegionOptions& options);

}  // namespace lekalo::locate
