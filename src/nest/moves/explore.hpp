#pragma once

#include "failed_states.hpp"
#include "strip_move.hpp"

namespace lekalo::nest {

/// Shortens the strip by ever smaller shares, and tries other arrangements where the smallest share fails.
/// docs/design/nest.md, step 6.
class Explore final : public StripMove {
 public:
  bool begin(Search& search) override;
  Outcome attempt(Search& search) override;
  Outcome on_valid(Search& search) override;
  Outcome on_failure(Search& search) override;

 protected:
  Patience patience(const Search& search) const override;

 private:
  FailedStates failed_;  ///< at the smallest share; the next attempt is a rearrangement of one of these
};

}  // namespace lekalo::nest
