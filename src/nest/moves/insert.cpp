#include "insert.hpp"

namespace lekalo::nest {

bool Insert::begin(Search& search) {
  const State& best = search.best.state;
  if (best.open_bins.empty() || search.nowhere(best).empty()) return false;
  search.shorter = tuning::kFirstShorter;  // what is thrown in lies loosely
  failed_.clear();
  failures_ = 0;
  disrupts_ = false;
  return true;
}

Outcome Insert::attempt(Search& search) {
  if (disrupts_) {
    failed_.load_disrupted(search);
  } else {
    search.separator.load(search.best.state);
    const std::vector<std::uint32_t> missing = search.nowhere(search.best.state);
    search.separator.put_anywhere(missing[search.pick(missing.size())]);
  }
  begin_separation(search);
  return Outcome::under_way;
}

bool Insert::fits_wider(Search& search) {
  return !search.is_on_lattice() && search.separator.relax(tuning::kRelaxRounds);
}

Outcome Insert::on_valid(Search& search) {
  search.best = {search.separator.state(), search.merit_of(search.separator.state())};
  failed_.clear();
  failures_ = 0;
  disrupts_ = false;
  if (!search.nowhere(search.best.state).empty()) return Outcome::under_way;
  if (!search.is_on_lattice()) compact(search);
  return Outcome::over;
}

Outcome Insert::on_failure(Search& search) {
  ++failures_;
  disrupts_ = failures_ % 2 != 0 && search.attempt.least_overlap() > 0;
  if (disrupts_) failed_.add(search.attempt, tuning::kInsertPool);
  return Outcome::under_way;
}

}  // namespace lekalo::nest
