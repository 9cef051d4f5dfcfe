#include "peels.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "lekalo/geom/boolean.hpp"
#include "opening.hpp"

namespace lekalo::mill {

using geom::Point;
using geom::Region;

namespace {

/// Fillets of the walls' corners, as shares of the tool's radius; the first is that of the pass along the
/// walls. Thinner peels have others between them.
constexpr double kPeels[] = {0.65, 0.57, 0.5, 0.43, 0.37, 0.3, 0.23, 0.16, 0.08, 0.04, 0.02};

}  // namespace

Peels::Peels(const std::vector<Region>& allowed, const std::vector<Point>& loops, std::vector<Region> cleared,
             double radius, double thinness)
    : allowed_(allowed), loops_(loops), cleared_(std::move(cleared)) {
  const double parts = std::ceil(1 / thinness - 1e-9);
  for (std::size_t k = 0; k < std::size(kPeels); ++k) {
    const double next = k + 1 < std::size(kPeels) ? kPeels[k + 1] : 0;
    for (double i = 0; i < parts; ++i)
      fillets_.push_back((kPeels[k] + (next - kPeels[k]) * i / parts) * radius);
  }
  fillets_.push_back(0);
}

Result<std::size_t> Peels::first() {
  for (std::size_t k = 0;; ++k) {
    LEKALO_TRY(const Round* const round, at(k));
    if (!round->regions.empty()) return k;
  }
}

Result<const Peels::Round*> Peels::at(std::size_t k) {
  if (const auto found = rounds_.find(k); found != rounds_.end()) return &found->second;
  std::vector<Region> regions = allowed_;
  if (k < last()) {
    LEKALO_TRY(auto opened, opened_by(allowed_, 0, fillets_[k]));
    regions = std::move(opened);
    if (!regions.empty() && !loops_.empty()) LEKALO_CHECK(add_corridors(k, regions));
    if (!cleared_.empty()) {
      LEKALO_TRY(auto all, geom::combine(regions, cleared_, geom::BooleanOperation::unite));
      regions = std::move(all.regions);
    }
  }
  geom::RegionIndex index(regions);
  return &rounds_.emplace(k, Round{std::move(regions), std::move(index)}).first->second;
}

Result<const std::vector<Front>*> Peels::between(std::size_t outer, std::size_t inner) {
  if (const auto found = made_.find({outer, inner}); found != made_.end()) return &found->second;
  LEKALO_TRY(const Round* const low, at(outer));
  LEKALO_TRY(const Round* const high, at(inner));
  return &made_.emplace(std::pair(outer, inner), fresh_stretches(high->regions, low->index)).first->second;
}

Result<void> Peels::add_corridors(std::size_t k, std::vector<Region>& opened) {
  LEKALO_TRY(auto lost, geom::combine(allowed_, opened, geom::BooleanOperation::subtract));
  std::erase_if(lost.regions, [&](const Region& piece) {
    const geom::RegionIndex index({piece});
    return std::none_of(loops_.begin(), loops_.end(), [&](Point p) { return index.contains(p); });
  });
  if (lost.regions.empty()) return {};
  LEKALO_TRY(const Round* const sharper, at(k + 1));
  LEKALO_TRY(auto narrow, geom::combine(lost.regions, sharper->regions, geom::BooleanOperation::intersect));
  LEKALO_TRY(auto all, geom::combine(opened, narrow.regions, geom::BooleanOperation::unite, lost.edge_error));
  opened = std::move(all.regions);
  return {};
}

}  // namespace lekalo::mill
