#pragma once

#include "failed_states.hpp"
#include "strip_move.hpp"

namespace lekalo::nest {

/// Throws one item that lies nowhere onto the strip at a time. docs/design/nest.md, step 5.
class Insert final : public StripMove {
 public:
  bool begin(Search& search) override;
  Outcome attempt(Search& search) override;
  Outcome on_valid(Search& search) override;
  Outcome on_failure(Search& search) override;

 protected:
  Patience patience(const Search&) const override { return tuning::kInsertPatience; }
  bool fits_wider(Search& search) override;

 private:
  FailedStates failed_;
  int failures_ = 0;
  bool disrupts_ = false;  ///< the next attempt is a rearrangement of one that failed
};

}  // namespace lekalo::nest
