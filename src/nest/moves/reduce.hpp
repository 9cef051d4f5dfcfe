#pragma once

#include "fill.hpp"

namespace lekalo::nest {

/// Fills stock that costs less than what is in use with everything that lies somewhere.
/// docs/design/nest-sheets.md, step 5.
class Reduce final : public Fill {
 public:
  bool begin(Search& search) override;

 protected:
  bool tries_rooms(const Search& search) const override {
    return search.nowhere(search.current.state).size() <= search.items.movable() / tuning::kFewMissing;
  }
  int most_failures() const override { return tuning::kFailuresToReduce; }

 private:
  /// Bins that cost less than those in use and may hold as much; empty where there are none.
  std::vector<std::uint32_t> cheaper_stock(Search& search) const;

  int turns_ = 0;    ///< turns offered and due since the best has cost as much as now
  int cheaper_ = 0;  ///< search.cheaper when that was counted
};

}  // namespace lekalo::nest
