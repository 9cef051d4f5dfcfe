#pragma once

#include "strip_move.hpp"

namespace lekalo::nest {

/// Shortens the strip by tiny shares at places chosen by chance, always from the best. docs/design/nest.md,
/// step 7.
class Compress final : public StripMove {
 public:
  bool begin(Search&) override {
    share_ = tuning::kCompressFrom;
    return true;
  }
  Outcome attempt(Search& search) override { return shorten(search, share_, true); }
  Outcome on_valid(Search& search) override { return take(search) ? Outcome::under_way : Outcome::failed; }
  Outcome on_failure(Search&) override {
    share_ *= tuning::kCompressDecay;
    return share_ < tuning::kCompressTo ? Outcome::over : Outcome::under_way;
  }

 protected:
  Patience patience(const Search&) const override { return tuning::kCompressPatience; }

 private:
  double share_ = 0;  ///< of the strip's length
};

}  // namespace lekalo::nest
