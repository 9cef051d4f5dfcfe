#pragma once

#include <optional>

#include "lekalo/geom/region_index.hpp"
#include "lekalo/jobs/heat_source.hpp"

namespace lekalo::jobs {

/// Says where a stock's border is, seen from above.
class StockBorder {
 public:
  explicit StockBorder(const HeatStock& stock) : box_(stock.box) {
    if (stock.read) index_.emplace(stock.read->outline.regions);
  }

  [[nodiscard]] bool is_block() const { return !index_; }
  /// Distance from the border, mm, positive inside.
  [[nodiscard]] double inside(double x, double y) const {
    if (!index_) return box_.inside(x, y);
    const double distance = index_->nearest({x, y}).distance;
    return index_->contains({x, y}) ? distance : -distance;
  }

 private:
  heat::StockBox box_;
  std::optional<geom::RegionIndex> index_;
};

}  // namespace lekalo::jobs
