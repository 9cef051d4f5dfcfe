#pragma once

#include "move.hpp"
#include "nest/exact/builder.hpp"

namespace lekalo::nest {

/// Asks for a strip that is shorter by one millimetre, a few times.
class OneMillimetreLess final : public Move {
 public:
  bool begin(Search&) override { return failures_ < 3; }
  Outcome attempt(Search& search) override {
    const Box& strip = search.problem.bins()[kStrip].box;
    const double length = strip_length(search.problem, search.items, search.best.state);
    search.separator.load(search.best.state);
    search.separator.set_limits(kStrip, strip.x0 + length - 1, strip.y1);
    search.begin_separation();
    return Outcome::under_way;
  }
  Outcome step(Search& search) override { return search.after_pass(search.separator.pass(), {20, 1}); }
  Outcome on_valid(Search& search) override {
    search.current = {search.separator.state(), search.merit_of(search.separator.state())};
    if (!(search.current.merit < search.best.merit)) return Outcome::failed;
    search.keep_if_best();
    return Outcome::under_way;
  }
  Outcome on_failure(Search&) override { return ++failures_ < 3 ? Outcome::under_way : Outcome::over; }

 private:
  int failures_ = 0;
};

}  // namespace lekalo::nest
