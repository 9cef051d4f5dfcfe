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
  /// The box that holds what lies on the sheet.
  BoxSize size_of(const Search& search, const State& state) const;
  /// The box that is asked for next. \pre the separator holds the current state
  BoxSize wanted(Search& search, BoxSize now) const;
  /// True where one cut is to free the rest, so that the box goes across the sheet.
  bool is_across(const Search& search) const;
  BoxSize wanted_across(Search& search, BoxSize now, BoxSize least, BoxSize most) const;

  std::uint32_t bin_ = 0;
  double smaller_ = 0;  ///< share of the box's area
  int failures_ = 0;
  bool is_kick_ = false;  ///< the box under way has a new proportion and is larger than it should be
};

}  // namespace lekalo::nest
