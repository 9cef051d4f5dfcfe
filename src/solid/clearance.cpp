#include "lekalo/solid/clearance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lekalo/base/parallel.hpp"

namespace lekalo::solid {
namespace {

/// Points that one thread takes at a time.
constexpr std::size_t kLot = 8192;
/// Lots whose lowest point is measured before all others: one of them is nearly as near as any.
constexpr std::size_t kBeginners = 32;
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
        lots_((meter.cloud_.points().size() + kLot - 1) / kLot),
        lowest_(lots_) {
    const Vector shift = motion(meter.cloud_.middle()) - meter.field_.low();
    const double k = 1 / meter.field_.cell();
    for (const auto& [row, along] : {std::pair(0U, shift.x), {1U, shift.y}, {2U, shift.z}}) {
      const Vector r = motion.rotation[row];
      rows_[row] = {static_cast<float>(k * r.x), static_cast<float>(k * r.y), static_cast<float>(k * r.z),
                    static_cast<float>(k * along)};
    }
  }

  Clearance run() {
    find_bounds();
    begin_with_the_lowest();
    refine();
    measure_all_below();
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

  [[nodiscard]] std::pair<std::size_t, std::size_t> points_of(std::size_t lot) const {
    return {lot * kLot, std::min(bounds().size(), (lot + 1) * kLot)};
  }
  [[nodiscard]] std::vector<float>& bounds() const { return meter_.bounds_; }

  [[nodiscard]] DistanceField::Place place(std::size_t i) const {
    const auto& p = meter_.cloud_.from_middle()[i];
    const auto along = [&](const std::array<float, 4>& row) {
      return row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
    };
    return {along(rows_[0]), along(rows_[1]), along(rows_[2])};
  }

  void find_bounds() {
    share_out(lots_, meter_.threads_, [&](std::size_t lot) {
      const auto [begin, end] = points_of(lot);
      for (std::size_t i = begin; i < end; ++i) bounds()[i] = meter_.field_.bound(place(i));
      find_lowest(lot);
    });
  }

  void find_lowest(std::size_t lot) {
    const auto [begin, end] = points_of(lot);
    std::size_t lowest = begin;
    for (std::size_t i = begin; i < end; ++i)
      if (bounds()[i] < bounds()[lowest]) lowest = i;
    lowest_[lot] = lowest;
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
  void begin_with_the_lowest() {
    std::vector<std::size_t> order = lowest_;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::pair(bounds()[a], a) < std::pair(bounds()[b], b);
    });
    for (std::size_t k = 0; k < std::min(order.size(), kBeginners); ++k)
      if (bounds()[order[k]] < best_.high) best_.take(measure(order[k], best_.high));
  }

  /// Makes cells where the one bound of their brick leaves points to be measured.
  void refine() {
    std::vector<std::vector<std::uint32_t>> points(lots_);
    std::vector<std::uint64_t> cells;
    for (std::size_t lot = 0; lot < lots_; ++lot) {
      if (!(bounds()[lowest_[lot]] < best_.high)) continue;
      const auto [begin, end] = points_of(lot);
      for (std::size_t i = begin; i < end; ++i) {
        if (!(bounds()[i] < best_.high)) continue;
        const std::uint64_t cell = meter_.field_.unmade_at(place(i));
        if (cell == DistanceField::kNoCell) continue;
        points[lot].push_back(static_cast<std::uint32_t>(i));
        if (cells.empty() || cells.back() != cell) cells.push_back(cell);
      }
    }
    if (cells.empty()) return;
    meter_.field_.make_cells(std::move(cells), meter_.threads_);
    share_out(lots_, meter_.threads_, [&](std::size_t lot) {
      if (points[lot].empty()) return;
      for (const std::uint32_t i : points[lot]) bounds()[i] = meter_.field_.bound(place(i));
      find_lowest(lot);
    });
    begin_with_the_lowest();
  }

  void measure_all_below() {
    std::vector<Measured> found(lots_);
    const double most = best_.high;
    share_out(lots_, meter_.threads_, [&](std::size_t lot) {
      if (!(bounds()[lowest_[lot]] < most)) return;
      Measured least;
      least.high = most;
      const auto [begin, end] = points_of(lot);
      for (std::size_t i = begin; i < end; ++i)
        if (bounds()[i] < least.high) least.take(measure(i, least.high));
      found[lot] = least;
    });
    for (const Measured& one : found)
      if (one.low < best_.low || one.high < best_.high) best_.take(one);
  }

  ClearanceMeter& meter_;
  const Motion& motion_;
  std::size_t lots_;
  std::array<std::array<float, 4>, 3> rows_{};
  /// The point with the lowest bound in each lot.
  std::vector<std::size_t> lowest_;
  Measured best_;
};

ClearanceMeter::ClearanceMeter(const TriangleTree& tree, const std::vector<Vector>& points, double cell,
                               unsigned threads)
    : tree_(&tree),
      cloud_(points),
      field_(tree, cell, kMarginInCells * cell, cloud_.extent()),
      threads_(threads),
      bounds_(points.size()) {}

Clearance ClearanceMeter::at(const Motion& motion) { return Pass(*this, motion).run(); }

}  // namespace lekalo::solid
