#include "lekalo/locate/guaranteed_blank.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "lekalo/base/limits.hpp"
#include "lekalo/geom/predicates.hpp"
#include "lekalo/geom/region_index.hpp"
#include "point_hash.hpp"
#include "scan_band.hpp"
#include "scan_order.hpp"

namespace lekalo::locate {
namespace {

using geom::Point;

/// Neighbours are at most this many median spacings apart, when the user does not say.
constexpr double kStepInSpacings = 3;
/// The points that give an order to points without one are this many guards apart, and at least an eighth of
/// the step. So noise does not change the order: for k = 2 this is 12 standard uncertainties.
constexpr double kSpreadInGuards = 6;
constexpr double kSpreadInSteps = 0.125;
/// The step of points without order is at least this many guards, because noise hides what happens on a
/// smaller scale.
constexpr double kStepInGuards = 8;
/// Slabs are made wider by this times the largest coordinate: 1.5e-8 mm for 1 m, far above the rounding of
/// the Booleans and of the check.
constexpr double kMargin = 0x1p-36;

tl::unexpected<Error> bad(std::string sentence) { return failure(ErrorCode::bad_input, std::move(sentence)); }

Result<void> check_options(const ScanOptions& o) {
  const auto refuse = [](const char* what, double value, const char* range) {
    return failure(ErrorCode::usage, fmt::format("{} {} is not {}", what, value, range));
  };
  const auto finite = [](double v) { return v <= limits::kLargestCoordinate; };
  if (!(o.uncertainty >= 0 && finite(o.uncertainty)))
    return refuse("the probe's uncertainty", o.uncertainty, "a length of 0 mm or more");
  if (!(o.coverage_factor > 0 && o.coverage_factor <= 1000))
    return refuse("the coverage factor", o.coverage_factor, "above 0 and at most 1000");
  if (!(o.reading_error >= 0 && finite(o.reading_error)))
    return refuse("the reading error", o.reading_error, "a length of 0 mm or more");
  const double guard = o.coverage_factor * o.uncertainty + o.reading_error;
  if (o.min_radius && !(*o.min_radius > guard && finite(*o.min_radius))) {
    return failure(
        ErrorCode::usage,
        fmt::format("a min-radius of {} mm is not above the guard of {:.4g} mm (coverage factor times "
                    "uncertainty)",
                    *o.min_radius, guard));
  }
  if (o.max_dip && !(*o.max_dip >= 0 && finite(*o.max_dip)))
    return refuse("max-dip", *o.max_dip, "a length of 0 mm or more");
  if (o.step && !(*o.step > 0 && finite(*o.step))) return refuse("step", *o.step, "a length above 0 mm");
  if (o.drop_outliers && !(*o.drop_outliers > 0 && finite(*o.drop_outliers)))
    return refuse("drop-outliers", *o.drop_outliers, "a length above 0 mm");
  if (!(o.simplify > 0 && finite(o.simplify)))
    return refuse("the simplification", o.simplify, "a length above 0 mm");
  return {};
}

Result<void> check_points(const ScanPoints& scan) {
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Point p = scan.points[i];
    if (!geom::is_exact(p) || !(std::max(std::abs(p.x), std::abs(p.y)) <= limits::kLargestCoordinate)) {
      return bad(
          fmt::format("point {} at ({}, {}) is out of range: coordinates are finite, up to {:g} mm and not "
                      "below {:g} mm other than 0",
                      i, p.x, p.y, limits::kLargestCoordinate, limits::kSmallestCoordinate));
    }
  }
  return {};
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

class Maker {
 public:
  Maker(const ScanPoints& scan, const ScanOptions& options)
      : scan_(scan), points_(scan.points), options_(options) {
    made_.guard = options.coverage_factor * options.uncertainty + options.reading_error;
  }

  Result<GuaranteedBlank> make() {
    LEKALO_CHECK(leave_out());
    LEKALO_CHECK(find_order());
    turn_material_left(points_, loops_);
    guard_loops();
    LEKALO_CHECK(cut_out());
    measure_loss();
    state_assumptions();
    made_.outlines = std::move(loops_);
    return std::move(made_);
  }

 private:
  Result<void> leave_out() {
    keep_.assign(points_.size(), true);
    if (options_.drop_outliers) {
      made_.dropped = lonely_points(points_, *options_.drop_outliers);
      for (const std::uint32_t i : made_.dropped) keep_[i] = false;
    }
    return {};
  }

  Result<void> find_order() {
    if (options_.order != PointOrder::none) {
      LEKALO_TRY(const auto crossing, use_given_order());
      if (!crossing) {
        made_.ordered = true;
        return {};
      }
      const Crossing c = *crossing;
      const Point a = points_[loops_[c.loop_a][c.edge_a]], b = points_[loops_[c.loop_b][c.edge_b]];
      const std::string where = fmt::format(
          "the outline through the points in file order meets itself: the edges that begin at {} and "
          "{} cross or touch",
          place_of(a), place_of(b));
      if (options_.order == PointOrder::given)
        return bad(where + "; read the points as points in no order, or leave out the faulty ones");
      made_.notices.push_back(where + "; the points are taken as points in no order");
    }
    return use_no_order();
  }

  /// Returns a place where the outlines meet, if the given order is no good.
  Result<std::optional<Crossing>> use_given_order() {
    loops_.clear();
    std::vector<double> spacing;
    for (std::size_t c = 0; c < scan_.contour_starts.size(); ++c) {
      const std::size_t begin = scan_.contour_starts[c], end = c + 1 < scan_.contour_starts.size()
                                                                   ? scan_.contour_starts[c + 1]
                                                                   : points_.size();
      Loop loop;
      for (std::size_t i = begin; i < end; ++i) {
        if (!keep_[i] || (!loop.empty() && points_[loop.back()] == points_[i])) continue;
        loop.push_back(static_cast<std::uint32_t>(i));
      }
      while (loop.size() > 1 && points_[loop.front()] == points_[loop.back()]) loop.pop_back();
      if (loop.size() < 3) {
        if (options_.order == PointOrder::automatic && scan_.contour_starts.size() > 1) return no_contours();
        return bad(fmt::format("contour {} has {} different points; three are needed to enclose material", c,
                               loop.size()));
      }
      for (std::size_t i = 0; i < loop.size(); ++i)
        spacing.push_back(norm(points_[loop[(i + 1) % loop.size()]] - points_[loop[i]]));
      loops_.push_back(std::move(loop));
    }
    if (loops_.empty()) return no_contours();
    made_.median_spacing = median_of(std::move(spacing));
    made_.step = options_.step.value_or(kStepInSpacings * made_.median_spacing);
    return first_crossing(points_, loops_);
  }

  static tl::unexpected<Error> no_contours() {
    return bad("there are fewer than three different points in a contour; an empty line ends a contour");
  }

  Result<void> use_no_order() {
    std::vector<std::uint32_t> sorted;
    for (std::uint32_t i = 0; i < points_.size(); ++i)
      if (keep_[i]) sorted.push_back(i);
    const auto key = [&](std::uint32_t i) { return std::pair(points_[i].x, points_[i].y); };
    std::sort(sorted.begin(), sorted.end(),
              [&](std::uint32_t a, std::uint32_t b) { return std::pair(key(a), a) < std::pair(key(b), b); });
    sorted.erase(std::unique(sorted.begin(), sorted.end(),
                             [&](std::uint32_t a, std::uint32_t b) { return points_[a] == points_[b]; }),
                 sorted.end());
    if (sorted.size() < 3)
      return bad(fmt::format("{} different points; three are needed to enclose material", sorted.size()));
    made_.median_spacing = median_nearest(points_, sorted);
    made_.step =
        options_.step.value_or(std::max(kStepInSpacings * made_.median_spacing, kStepInGuards * made_.guard));
    const double spread = std::max(kSpreadInGuards * made_.guard, kSpreadInSteps * made_.step);
    LEKALO_TRY(loops_, order_points(points_, sorted, spread, made_.step + 2 * spread));
    if (const auto c = first_crossing(points_, loops_)) {
      return bad(
          fmt::format("the contours cannot be told from each other near {}: outlines through neighbouring "
                      "points meet there; give the points in order, or a smaller step",
                      place_of(points_[loops_[c->loop_a][c->edge_a]])));
    }
    attach(sorted, spread);
    return {};
  }

  /// Notes for every point that is no corner of the outlines the edge that it was measured beside.
  void attach(const std::vector<std::uint32_t>& sorted, double spread);

  void guard_loops() {
    for (std::uint32_t l = 0; l < loops_.size(); ++l) {
      GuardedLoop loop;
      loop.vertices = loops_[l];
      loop.beside_starts.push_back(0);
      for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
        take_points_beside(loop, i);
        loop.beside_starts.push_back(static_cast<std::uint32_t>(loop.beside.size()));
        loop.reach.push_back(reach_of(l, loop, i));
      }
      guarded_.push_back(std::move(loop));
    }
  }

  void take_points_beside(GuardedLoop& loop, std::size_t i) {
    if (beside_.empty()) return;
    const std::uint32_t a = loop.vertex(i), b = loop.vertex(i + 1);
    const auto key = std::pair(std::min(a, b), std::max(a, b));
    auto at = std::lower_bound(beside_.begin(), beside_.end(), std::pair(key, std::uint32_t{0}));
    for (; at != beside_.end() && at->first == key; ++at) loop.beside.push_back(at->second);
  }

  /// Returns the widest stretch along the edge that has no point.
  UnknownStretch widest_gap(std::uint32_t l, const GuardedLoop& loop, std::size_t i) const {
    const std::uint32_t a = loop.vertex(i), b = loop.vertex(i + 1);
    const Point chord = points_[b] - points_[a];
    const double length = norm(chord);
    std::vector<std::pair<double, std::uint32_t>> along{{0, a}, {length, b}};
    for (std::size_t k = loop.beside_starts[i]; k < loop.beside.size(); ++k) {
      const double t = dot(points_[loop.beside[k]] - points_[a], chord) / length;
      if (t > 0 && t < length) along.push_back({t, loop.beside[k]});
    }
    std::sort(along.begin(), along.end());
    UnknownStretch gap;
    gap.contour = l;
    for (std::size_t k = 0; k + 1 < along.size(); ++k) {
      const double width = along[k + 1].first - along[k].first;
      if (width > gap.width) {
        gap.width = width;
        gap.from = along[k].second;
        gap.to = along[k + 1].second;
      }
    }
    gap.from_at = points_[gap.from];
    gap.to_at = points_[gap.to];
    return gap;
  }

  /// Returns w_i of the header. Where nothing bounds the contour that is the guard, and `unknown` gets an
  /// entry.
  double reach_of(std::uint32_t l, const GuardedLoop& loop, std::size_t i) {
    const double g = made_.guard;
    const double c = norm(points_[loop.vertex(i + 1)] - points_[loop.vertex(i)]);
    double reach = std::numeric_limits<double>::infinity();
    if (options_.min_radius) {
      const double r = *options_.min_radius, inner = r - g, half = 0.5 * c * (1 + 0x1p-40);
      if (half < inner * (1 - 0x1p-40)) reach = r - std::sqrt((inner - half) * (inner + half));
    }
    if (options_.max_dip) reach = std::min(reach, g + *options_.max_dip);
    UnknownStretch gap;
    if (!std::isfinite(reach)) {
      gap = c > made_.step || options_.min_radius ? widest_gap(l, loop, i) : UnknownStretch{};
      if (options_.min_radius || gap.width > made_.step) {
        made_.unknown.push_back(gap);
        return g;
      }
      reach = g;
    }
    made_.widest = std::max(made_.widest, c);
    made_.deepest = std::max(made_.deepest, reach - g);
    return reach;
  }

  Result<void> cut_out() {
    double margin = kMargin * geom::largest_coordinate(points_);
    // Booleans that had to snap coarsely need a wider margin. No case is known that needs the third round.
    for (int round = 0; round < 4; ++round, margin *= 64) {
      std::vector<Slab> slabs;
      for (const GuardedLoop& loop : guarded_) {
        // Step 3.
        const auto cover = cover_by_slabs(points_, loop, made_.guard, 0.5 * options_.simplify);
        slabs.insert(slabs.end(), cover.begin(), cover.end());
      }
      // Step 4.
      LEKALO_TRY(const auto regions, inside_of_slabs(points_, guarded_, slabs, margin));
      // Step 5.
      made_.regions = cut_corners(regions, 0.5 * options_.simplify);
      if (made_.regions.empty()) {
        return bad(
            fmt::format("nothing of the blank is proved to be material: the outline loses up to {:.4g} mm on "
                        "every side (guard {:.4g} mm and dip {:.4g} mm)",
                        made_.guard + made_.deepest, made_.guard, made_.deepest));
      }
      // Step 6: the claim rests on this check alone.
      if (keeps_out(points_, guarded_, made_.guard, made_.regions)) return {};
    }
    return bad(
        fmt::format("the outlines run too close to themselves to be cut apart by rounded numbers; near {}",
                    place_of(points_[loops_.front().front()])));
  }

  void measure_loss() {
    const geom::RegionIndex index(made_.regions);
    std::uint32_t likely = 0;
    for (const Loop& loop : loops_)
      for (const std::uint32_t i : loop) {
        const auto near = index.nearest(points_[i], likely);
        likely = near.edge;
        made_.loss = std::max(made_.loss, near.distance);
      }
  }

  void state_assumptions();

  const ScanPoints& scan_;
  const geom::Ring& points_;
  const ScanOptions& options_;
  GuaranteedBlank made_;
  std::vector<bool> keep_;
  std::vector<Loop> loops_;
  /// Points and the edges they were measured beside, sorted; an edge is named by its ends, the lower index
  /// first.
  std::vector<std::pair<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>> beside_;
  std::vector<GuardedLoop> guarded_;
};

void Maker::attach(const std::vector<std::uint32_t>& sorted, double spread) {
  std::vector<std::uint32_t> loop_of(points_.size(), 0), place_of(points_.size(), 0);
  std::vector<bool> corner(points_.size(), false);
  PointHash hash(spread, 1024, geom::largest_coordinate(points_));
  for (std::uint32_t l = 0; l < loops_.size(); ++l)
    for (std::uint32_t k = 0; k < loops_[l].size(); ++k) {
      const std::uint32_t i = loops_[l][k];
      corner[i] = true;
      loop_of[i] = l;
      place_of[i] = k;
      hash.insert(i, points_[i]);
    }
  const auto squared_from = [&](Point p, std::uint32_t a, std::uint32_t b) {
    const Point chord = points_[b] - points_[a];
    const double t = std::clamp(dot(p - points_[a], chord) / dot(chord, chord), 0.0, 1.0);
    const Point off = p - (points_[a] + t * chord);
    return dot(off, off);
  };
  for (const std::uint32_t i : sorted) {
    if (corner[i]) continue;
    const Point p = points_[i];
    std::pair<double, std::uint32_t> near{std::numeric_limits<double>::infinity(), 0};
    hash.visit_near(p, spread, [&](std::uint32_t j) {
      near = std::min(near, std::pair(dot(points_[j] - p, points_[j] - p), j));
    });
    const Loop& loop = loops_[loop_of[near.second]];
    const std::size_t n = loop.size(), at = place_of[near.second];
    const std::uint32_t a = near.second, before = loop[(at + n - 1) % n], next = loop[(at + 1) % n];
    const std::uint32_t b = squared_from(p, before, a) < squared_from(p, a, next) ? before : next;
    beside_.push_back({{std::min(a, b), std::max(a, b)}, i});
  }
  std::sort(beside_.begin(), beside_.end());
}

void Maker::state_assumptions() {
  auto& say = made_.assumptions;
  const double ku = options_.coverage_factor * options_.uncertainty;
  std::string guard = fmt::format(
      "each measured point lies within {:.4g} mm of the true surface point it stands for ({:g} times the "
      "probe's "
      "standard uncertainty of {:.4g} mm",
      made_.guard, options_.coverage_factor, options_.uncertainty);
  if (options_.reading_error > 0)
    guard += fmt::format(", and {:.2g} mm for reading the file", options_.reading_error);
  if (options_.factor_covers_all) {
    guard += "), all points together at the confidence the coverage factor was chosen for";
  } else {
    // The share outside is the two-sided probability of the normal distribution.
    const double outside = std::erfc(options_.coverage_factor / std::sqrt(2.0));
    guard += fmt::format(
        "); for errors with a normal distribution that is {:.4g} % for each point by itself, not for all "
        "{} together",
        100 * (1 - outside), points_.size());
  }
  if (options_.uncertainty == 0)
    guard = "the points lie exactly on the true surface (no uncertainty was stated)" +
            std::string(ku + options_.reading_error > 0
                            ? fmt::format(", but for {:.2g} mm of reading the file", options_.reading_error)
                            : "");
  say.push_back(std::move(guard));
  say.push_back(
      made_.ordered
          ? fmt::format(
                "the points stand in order along {} closed contour{}, and there are no other contours",
                loops_.size(), loops_.size() == 1 ? "" : "s")
          : fmt::format(
                "the blank has {} closed contour{}, measured all round but for the unknown "
                "stretches, and walls and slots wider than {:.3g} mm",
                loops_.size(), loops_.size() == 1 ? "" : "s",
                made_.step + 2 * std::max(kSpreadInGuards * made_.guard, kSpreadInSteps * made_.step)));
  if (options_.min_radius) {
    say.push_back(fmt::format(
        "a disc of radius {:g} mm rolls along the whole contour from outside (no dent, and no hole, is "
        "sharper or narrower): between points up to {:.4g} mm apart the contour lies at most "
        "{:.3g} mm further in than their chord",
        *options_.min_radius, made_.widest, made_.deepest));
  }
  if (options_.max_dip) {
    say.push_back(fmt::format(
        "between neighbouring points the contour dips at most {:g} mm below their chord", *options_.max_dip));
  }
  if (!options_.min_radius && !options_.max_dip) {
    say.push_back(fmt::format(
        "between neighbouring points up to {:.4g} mm apart ({}) the contour does not dip below {}",
        made_.step,
        options_.step ? "the step stated"
                      : fmt::format("chosen from the median spacing of {:.3g} mm", made_.median_spacing),
        made_.ordered ? "their chord" : "the innermost of them and their chords"));
  }
  if (!made_.unknown.empty()) {
    double width = 0;
    for (const UnknownStretch& u : made_.unknown) width += u.width;
    say.push_back(fmt::format(
        "NOT PROVED: {} stretch{} of contour, {:.4g} mm in all, {} not measured; the outline goes straight "
        "across, and no clearance is proved until it is measured or bounded (--max-dip)",
        made_.unknown.size(), made_.unknown.size() == 1 ? "" : "es", width,
        made_.unknown.size() == 1 ? "is" : "are"));
  }
  if (!made_.dropped.empty()) {
    say.push_back(fmt::format("{} point{} without another within {:g} mm {} left out on request",
                              made_.dropped.size(), made_.dropped.size() == 1 ? "" : "s",
                              *options_.drop_outliers, made_.dropped.size() == 1 ? "is" : "are"));
  }
}

}  // namespace

Result<GuaranteedBlank> guaranteed_blank(const ScanPoints& scan, const ScanOptions& options) {
  LEKALO_CHECK(check_options(options));
  LEKALO_CHECK(check_points(scan));
  if (scan.points.size() < 3)
    return bad(fmt::format("{} points; three are needed to enclose material", scan.points.size()));
  return Maker(scan, options).make();
}

}  // namespace lekalo::locate
