#include "explore.hpp"

#include <algorithm>

namespace lekalo::nest {

bool Explore::begin(Search& search) {
  failed_.clear();
  return used_area(search.problem, search.items, search.best.state, kStrip) > 0;
}

Outcome Explore::attempt(Search& search) {
  if (failed_.count() == 0) return shorten(search, search.shorter, false);
  failed_.load_disrupted(search);
  begin_separation(search);
  return Outcome::under_way;
}

Patience Explore::patience(const Search& search) const {
  return search.shorter > tuning::kExploreShorter ? tuning::kHastyPatience : tuning::kExplorePatience;
}

Outcome Explore::on_valid(Search& search) {
  if (!take(search)) return Outcome::failed;
  failed_.clear();
  return Outcome::under_way;
}

Outcome Explore::on_failure(Search& search) {
  if (search.shorter > tuning::kExploreShorter) {
    search.shorter = std::max(tuning::kExploreShorter, 0.5 * search.shorter);
    return Outcome::under_way;
  }
  // On the lattice the turn is ended by the lattice's own budget.
  if (!search.is_on_lattice() && failed_.count() + 1 >= tuning::kFailuresToCompress) return Outcome::over;
  failed_.add(search.attempt, tuning::kFailuresToCompress);
  return Outcome::under_way;
}

}  // namespace lekalo::nest
