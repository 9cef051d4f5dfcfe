#pragma once

#include "explore.hpp"
#include "insert.hpp"

namespace lekalo::nest {

/// Inserts and explores with every item at multiples of one length, until that has gained nothing for some
/// time: puzzles and drawings on squared paper close this way. The length is the unit, then its half, then
/// its quarter, from turn to turn. docs/design/nest.md, step 8.
class Lattice final : public Move {
 public:
  /// \param unit  lattice_unit(), above 0
  Lattice(Insert& insert, Explore& explore, double unit) : insert_(insert), explore_(explore), unit_(unit) {}

  bool is_on() const noexcept { return is_on_; }
  bool begin(Search& search) override;
  Outcome attempt(Search& search) override;
  Outcome step(Search& search) override;
  Outcome on_valid(Search& search) override;
  Outcome on_failure(Search& search) override { return inner_->on_failure(search); }

 private:
  bool enter(Search& search);
  Outcome leave(Search& search);

  Insert& insert_;
  Explore& explore_;
  Move* inner_ = nullptr;  ///< the one of the two whose turn it is
  double unit_;            ///< mm
  int halvings_ = 0;
  bool is_on_ = false;
  std::uint64_t until_ = 0;  ///< work at which the turn is over unless something is gained before
};

}  // namespace lekalo::nest
