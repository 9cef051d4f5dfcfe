#pragma once

#include "move.hpp"

namespace lekalo::nest {

/// Makes the box smaller that holds what lies on the sheet used least: along one side, the other, or both.
/// docs/design/nest-sheets.md, step 6.
class SmallerBox final : public Move {
 public:
  bool begin(Search& search) override;
  Outcome attempt(Search& search) override;
  Outcome step(Search& search) override;
  Outcome on_valid(Search& search) override;
  Outcome on_failure(Search& search) override;

 private:
  struct Size {
    double w = 0, h = 0;  ///< mm
    double area() const noexcept { return w * h; }
  };
  Size size_of(const Search& search, const State& state) const;
  /// The box that is asked for next. \pre the separator holds the current state
  Size wanted(Search& search, Size now) const;

  std::uint32_t bin_ = 0;
  double smaller_ = 0;  ///< share of the box's area
  int failures_ = 0;
  bool is_kick_ = false;  ///< the box under way has a new proportion and is larger than it should be
};

}  // namespace lekalo::nest
