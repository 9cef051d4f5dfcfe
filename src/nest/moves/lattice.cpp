#include "lattice.hpp"

namespace lekalo::nest {

bool Lattice::enter(Search& search) {
  const double length = unit_ / (1 << halvings_);
  halvings_ = (halvings_ + 1) % tuning::kLatticeSizes;
  is_on_ = search.separator.use_lattice(length);
  until_ = search.work() + tuning::kLatticeWork;
  return is_on_;
}

Outcome Lattice::leave(Search& search) {
  is_on_ = false;
  search.separator.use_lattice(0);
  return Outcome::over;
}

bool Lattice::begin(Search& search) {
  if (!is_on_ && !enter(search)) return false;
  inner_ = insert_.begin(search) ? static_cast<Move*>(&insert_) : &explore_;
  return inner_ == &insert_ || explore_.begin(search);
}

Outcome Lattice::attempt(Search& search) {
  const Outcome outcome = inner_->attempt(search);
  return outcome == Outcome::over ? leave(search) : outcome;
}

Outcome Lattice::step(Search& search) {
  return search.work() > until_ ? leave(search) : inner_->step(search);
}

Outcome Lattice::on_valid(Search& search) {
  const Outcome outcome = inner_->on_valid(search);
  if (outcome == Outcome::failed) return outcome;
  until_ = search.work() + tuning::kLatticeWork;
  if (outcome == Outcome::over) begin(search);
  return Outcome::under_way;
}

}  // namespace lekalo::nest
