#include "strand.hpp"

#include <utility>

#include "lekalo/base/stop.hpp"
#include "nest/separator/lattice_unit.hpp"
#include "nest/tuning/tuning.hpp"

namespace lekalo::nest {
namespace {

Schedule usual_schedule(const Problem& problem, const Items& items, std::uint64_t stream) {
  if (!problem.is_strip()) return sheet_schedule();
  return strip_schedule(stream == 1 ? lattice_unit(problem, items) : 0);
}

}  // namespace

Strand::Strand(const Problem& problem, const Items& items, std::uint64_t seed, std::uint64_t stream)
    : Strand(problem, items, Random(seed, stream + 1), usual_schedule(problem, items, stream)) {}

Strand::Strand(const Problem& problem, const Items& items, Random random, Schedule schedule)
    : search_(problem, items, random), schedule_(std::move(schedule)) {}

void Strand::start(const State& state) {
  if (is_done() || !search_.problem.is_strip())
    go_on_from(state);
  else
    offered_ = state;
}

void Strand::go_on_from(const State& state) {
  offered_.reset();
  search_.best.state = state;
  search_.tidy(search_.best.state);
  search_.best.merit = search_.merit_of(search_.best.state);
  search_.turns = 0;
  ++search_.cheaper;
  ++search_.fuller;
  begin_turn(nullptr);
  next_attempt(Outcome::under_way);
}

bool Strand::take_offered() {
  if (!offered_) return false;
  const State state = *std::exchange(offered_, std::nullopt);
  if (!(search_.merit_of(state) < merit())) return false;
  go_on_from(state);
  return true;
}

void Strand::begin_turn(const Move* last) {
  search_.current = search_.best;
  ++search_.turns;
  move_ = schedule_.next(search_, last);
}

/// Begins attempts until there is something to separate.
void Strand::next_attempt(Outcome outcome) {
  for (int vain = 0;; ++vain) {
    ask();
    if (outcome == Outcome::over) begin_turn(move_);
    if (is_done()) return;
    outcome = move_->attempt(search_);
    if (outcome == Outcome::under_way) return;
    if (outcome == Outcome::finished || vain > tuning::kVainAttempts) {
      move_ = nullptr;
      return;
    }
    if (outcome == Outcome::failed) outcome = move_->on_failure(search_);
  }
}

void Strand::step() {
  Outcome outcome = move_->step(search_);
  if (outcome == Outcome::under_way) return;
  if (outcome == Outcome::valid) {
    // Drawings in whole units often close only where everything lies on whole units.
    if (const double unit = search_.problem.unit(); unit > 0) search_.separator.snap(unit);
    outcome = move_->on_valid(search_);
  }
  if (outcome == Outcome::failed) {
    if (take_offered()) return;
    outcome = move_->on_failure(search_);
  }
  next_attempt(outcome);
}

void Strand::run(std::uint64_t work, const std::function<void()>& stepped) {
  const std::uint64_t until = this->work() + work;
  while (!is_done() && this->work() < until) {
    step();
    if (stepped) stepped();
  }
}

}  // namespace lekalo::nest
