#include "lekalo/solid/clearance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lekalo/base/parallel.hpp"

namespace lekalo::solid {
namespace {

/// Points that have one bound together until it leaves some of them to be looked at, and groups that one
/// thread takes at a time.
constexpr std::size_t kGroup = 32, kLot = 256;
/// Lots whose lowest group is looked at before all others: one of them has a point nearly as near as any.
constexpr std::size_t kBeginners = 32;
/// So many poses are remembered.
constexpr std::size_t kMostPoses = 4096;
/// Rounding adds less than this part of itself to a way or a radius.
constexpr double kOutwards = 1 + 0x1p-20;
/// Moving points and taking differences rounds a way by less than this part of the coordinates.
constexpr double kStepRounding = 0x1p-48;
/// A margin this many cells wide around the body has bounds of its own.
constexpr double kMarginInCells = 16;

/// Every third bit, from the lowest on, is one of these 21.
std::uint64_t spread_bits(std::uint64_t x) {
  x = (x | x << 32) & 0x001f00000000ffffU;
  x = (x | x << 16) & 0x001f0000ff0000ffU;
  x = (x | x << 8) & 0x100f00f00f00f00fU;
  x = (x | x << 4) & 0x10c30c30c30c30c3U;
  return (x | x << 2) & 0x1249249249249249U;
}

}  // namespace

PointCloud::PointCloud(const std::vector<Vector>& points) {
  const Box box = box_of(points);
  const Vector size = box.high - box.low;
  const double steps = 0x1p21 - 1, step = std::max({size.x, size.y, size.z, 1e-300}) / steps;
  const auto bits = [&](double v) {
    return spread_bits(static_cast<std::uint64_t>(std::clamp(v / step, 0.0, steps)));
  };
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  order.reserve(points.size());
  for (const Vector p : points) {
    const Vector at = p - box.low;
    order.emplace_back(bits(at.x) | bits(at.y) << 1 | bits(at.z) << 2,
                       static_cast<std::uint32_t>(order.size()));
  }
  std::sort(order.begin(), order.end());
  points_.reserve(points.size());
  numbers_.reserve(points.size());
  middle_ = 0.5 * (box.low + box.high);
  from_middle_.reserve(points.size());
  for (const auto& [place, number] : order) {
    points_.push_back(points[number]);
    numbers_.push_back(number);
    const Vector way = points[number] - middle_;
    from_middle_.push_back({static_cast<float>(way.x), static_cast<float>(way.y), static_cast<float>(way.z)});
  }
  extent_ = norm(size);
}

/// Measures at one pose.
class ClearanceMeter::Pass {
 public:
  Pass(ClearanceMeter& meter, const Motion& motion)
      : meter_(meter),
        motion_(motion),
        now_(meter.remembered(motion)),
        lots_((meter.groups_.size() + kLot - 1) / kLot),
        lowest_(lots_),
        candidates_(lots_) {
    const Vector shift = motion(meter.cloud_.middle()) - meter.field_.low();
    const double k = 1 / meter.field_.cell();
    for (const auto& [row, along] : {std::pair(0U, shift.x), {1U, shift.y}, {2U, shift.z}}) {
      const Vector r = motion.rotation[row];
      rows_[row] = {static_cast<float>(k * r.x), static_cast<float>(k * r.y), static_cast<float>(k * r.z),
                    static_cast<float>(k * along)};
    }
  }

  Clearance run() {
    // The nearest point of the pose before is nearly as near as any, as a rule.
    bounds()[meter_.last_] = meter_.field_.bound(place(cloud()[meter_.last_]));
    best_.take(measure(meter_.last_, best_.high));
    bound_groups();
    begin_with_the_lowest_groups();
    find_candidates();
    refine();
    begin_with_the_lowest();
    measure_all_below();
    meter_.last_ = best_.point;
    return {best_.low, best_.high, meter_.cloud_.number(best_.point), best_.triangle, best_.place};
  }

 private:
  struct Measured {
    double low = std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
    std::size_t point = 0;
    std::uint32_t triangle = 0;
    Vector place;

    void take(const Measured& other) {
      const double least = std::min(low, other.low);
      if (other.high < high) *this = other;
      low = least;
    }
  };

  [[nodiscard]] std::vector<float>& bounds() const { return meter_.bounds_; }
  [[nodiscard]] std::span<const std::array<float, 3>> cloud() const { return meter_.cloud_.from_middle(); }
  [[nodiscard]] std::pair<std::size_t, std::size_t> groups_of(std::size_t lot) const {
    return {lot * kLot, std::min(meter_.groups_.size(), (lot + 1) * kLot)};
  }
  [[nodiscard]] std::pair<std::size_t, std::size_t> points_of(std::size_t group) const {
    return {group * kGroup, std::min(bounds().size(), (group + 1) * kGroup)};
  }

  [[nodiscard]] DistanceField::Place place(const std::array<float, 3>& p) const {
    const auto along = [&](const std::array<float, 4>& row) {
      return row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
    };
    return {along(rows_[0]), along(rows_[1]), along(rows_[2])};
  }

  /// No point of the group has gone farther since it was looked at.
  [[nodiscard]] double way(const Group& group) const {
    const Step& step = meter_.steps_[group.seen];
    const Vector c{group.centre[0], group.centre[1], group.centre[2]};
    return kOutwards *
               (norm(step.shift + Vector{dot(step.turn[0], c), dot(step.turn[1], c), dot(step.turn[2], c)}) +
                step.most * static_cast<double>(group.radius)) +
           step.off;
  }

  /// A group's bound is what it had at an earlier pose less its way from there, and that of the field at its
  /// middle.
  void bound_groups() {
    meter_.find_steps(motion_);
    share_out(lots_, meter_.threads_, [&](std::size_t lot) {
      const auto [begin, end] = groups_of(lot);
      lowest_[lot] = begin;
      for (std::size_t g = begin; g < end; ++g) {
        Group& group = meter_.groups_[g];
        double bound = static_cast<double>(group.low) - way(group);
        if (bound < best_.high)
          bound = std::max(bound, static_cast<double>(meter_.field_.bound(place(group.centre))) -
                                      kOutwards * static_cast<double>(group.radius));
        group.bound = bound;
        if (bound < meter_.groups_[lowest_[lot]].bound) lowest_[lot] = g;
      }
    });
  }

  /// Finds the bounds of a group's points.
  void look_at(std::size_t g) {
    Group& group = meter_.groups_[g];
    const auto [begin, end] = points_of(g);
    float low = std::numeric_limits<float>::infinity();
    for (std::size_t i = begin; i < end; ++i)
      low = std::min(low, bounds()[i] = meter_.field_.bound(place(cloud()[i])));
    group.low = low, group.bound = low, group.seen = now_;
  }

  /// The signed distance of a point whose bound is known, if it can be below `most`.
  [[nodiscard]] Measured measure(std::size_t i, double most) const {
    const Vector p = motion_(meter_.cloud_.points()[i]);
    Measured measured;
    measured.point = i;
    if (bounds()[i] <= 0 && meter_.tree_->holds(p)) {
      const Nearest deep = *meter_.tree_->nearest(p);
      return {-deep.high, -deep.low, i, deep.triangle, deep.place};
    }
    if (const auto near = meter_.tree_->nearest(p, most))
      measured = {near->low, near->high, i, near->triangle, near->place};
    return measured;
  }

  /// The lowest of each lot, as long as one can be lower than those before, so that few others are looked at.
  template <class Bound, class Look>
  void begin_with(std::vector<std::size_t> order, const Bound& bound, const Look& look) {
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return std::pair(bound(a), a) < std::pair(bound(b), b); });
    for (std::size_t k = 0; k < std::min(order.size(), kBeginners); ++k)
      if (static_cast<double>(bound(order[k])) < best_.high) best_.take(measure(look(order[k]), best_.high));
  }

  void begin_with_the_lowest_groups() {
    begin_with(
        lowest_, [&](std::size_t g) { return meter_.groups_[g].bound; },
        [&](std::size_t g) {
          look_at(g);
          const auto [begin, end] = points_of(g);
          return static_cast<std::size_t>(
              std::min_element(bounds().begin() + static_cast<std::ptrdiff_t>(begin),
                               bounds().begin() + static_cast<std::ptrdiff_t>(end)) -
              bounds().begin());
        });
  }

  void begin_with_the_lowest() {
    std::vector<std::size_t> lowest;
    for (const std::vector<std::uint32_t>& points : candidates_)
      if (!points.empty())
        lowest.push_back(
            *std::min_element(points.begin(), points.end(),
                              [&](std::uint32_t a, std::uint32_t b) { return bounds()[a] < bounds()[b]; }));
    begin_with(
        std::move(lowest), [&](std::size_t i) { return bounds()[i]; }, [](std::size_t i) { return i; });
  }

  /// The points that can be nearer than what was measured.
  void find_candidates() {
    const double most = best_.high;
    share_out(lots_, meter_.threads_, [&](std::size_t lot) {
      const auto [first, last] = groups_of(lot);
      for (std::size_t g = first; g < last; ++g) {
        if (!(meter_.groups_[g].bound < most)) continue;
        look_at(g);
        const auto [begin, end] = points_of(g);
        for (std::size_t i = begin; i < end; ++i)
          if (bounds()[i] < most) candidates_[lot].push_back(static_cast<std::uint32_t>(i));
      }
    });
  }

  /// Makes cells where the one bound of their brick leaves points to be measured.
  void refine() {
    std::vector<std::uint64_t> cells;
    for (const std::vector<std::uint32_t>& points : candidates_)
      for (const std::uint32_t i : points) {
        const std::uint64_t cell = meter_.field_.unmade_at(place(cloud()[i]));
        if (cell == DistanceField::kNoCell) continue;
        if (cells.empty() || cells.back() != cell) cells.push_back(cell);
      }
    if (cells.empty()) return;
    meter_.field_.make_cells(std::move(cells), meter_.threads_);
    share_out(lots_, meter_.threads_, [&](std::size_t lot) {
      std::size_t before = meter_.groups_.size();
      for (const std::uint32_t i : candidates_[lot]) {
        if (i / kGroup == before) continue;
        before = i / kGroup;
        look_at(before);
      }
    });
  }

  void measure_all_below() {
    std::vector<Measured> found(lots_);
    const double most = best_.high;
    share_out(lots_, meter_.threads_, [&](std::size_t lot) {
      Measured least;
      least.high = most;
      for (const std::uint32_t i : candidates_[lot])
        if (bounds()[i] < least.high) least.take(measure(i, least.high));
      found[lot] = least;
    });
    for (const Measured& one : found)
      if (one.low < best_.low || one.high < best_.high) best_.take(one);
  }

  ClearanceMeter& meter_;
  const Motion& motion_;
  std::uint32_t now_;
  std::size_t lots_;
  std::array<std::array<float, 4>, 3> rows_{};
  /// The group with the lowest bound in each lot, and the points of each lot that may be the nearest.
  std::vector<std::size_t> lowest_;
  std::vector<std::vector<std::uint32_t>> candidates_;
  Measured best_;
};

ClearanceMeter::ClearanceMeter(const TriangleTree& tree, const std::vector<Vector>& points, double cell,
                               unsigned threads)
    : tree_(&tree),
      cloud_(points),
      field_(tree, cell, kMarginInCells * cell, cloud_.extent()),
      threads_(threads),
      bounds_(points.size()) {
  const std::span<const std::array<float, 3>> all = cloud_.from_middle();
  for (std::size_t begin = 0; begin < all.size(); begin += kGroup) {
    Box box;
    const std::span<const std::array<float, 3>> of_group =
        all.subspan(begin, std::min(kGroup, all.size() - begin));
    for (const auto& [x, y, z] : of_group) box.hold({x, y, z});
    const Vector middle = 0.5 * (box.low + box.high);
    Group group;
    group.centre = {static_cast<float>(middle.x), static_cast<float>(middle.y), static_cast<float>(middle.z)};
    double far = 0;
    for (const auto& [x, y, z] : of_group)
      far = std::max(far, norm(Vector{x, y, z} - Vector{group.centre[0], group.centre[1], group.centre[2]}));
    // Single precision has moved the points a little.
    group.radius = static_cast<float>(kOutwards * (far + 0x1p-22 * cloud_.extent()));
    groups_.push_back(group);
  }
}

/// Takes a pose among those that are remembered, and returns its number.
std::uint32_t ClearanceMeter::remembered(const Motion& motion) {
  if (poses_.size() >= kMostPoses) {
    poses_.clear();
    for (Group& group : groups_) group.low = -std::numeric_limits<float>::infinity(), group.seen = 0;
  }
  poses_.push_back(motion);
  return static_cast<std::uint32_t>(poses_.size() - 1);
}

/// Works out how points have moved since each of the poses.
void ClearanceMeter::find_steps(const Motion& motion) {
  const Vector middle = cloud_.middle();
  steps_.clear();
  for (const Motion& before : poses_) {
    Step step;
    step.shift = motion(middle) - before(middle);
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      step.turn[i] = motion.rotation[i] - before.rotation[i];
      square += dot(step.turn[i], step.turn[i]);
    }
    step.most = std::sqrt(square);
    step.off = kStepRounding * (norm(motion(middle)) + norm(before(middle)) + cloud_.extent());
    steps_.push_back(step);
  }
}

Clearance ClearanceMeter::at(const Motion& motion) { return Pass(*this, motion).run(); }

}  // namespace lekalo::solid
