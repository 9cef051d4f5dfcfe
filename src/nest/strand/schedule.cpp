#include "schedule.hpp"

#include <utility>

#include "nest/moves/box.hpp"
#include "nest/moves/compress.hpp"
#include "nest/moves/explore.hpp"
#include "nest/moves/fill.hpp"
#include "nest/moves/insert.hpp"
#include "nest/moves/lattice.hpp"
#include "nest/moves/reduce.hpp"

namespace lekalo::nest {
namespace {

Schedule::When after(const Move& move) {
  return [&move](const Move* last) { return last == &move; };
}

/// At first, after every one of these turns, and as long as the lattice is on.
Schedule::When first_and_after(const Move& move, const Lattice& lattice) {
  return [&move, &lattice, is_first = true](const Move* last) mutable {
    return std::exchange(is_first, false) || last == &move || lattice.is_on();
  };
}

}  // namespace

Move* Schedule::next(Search& search, const Move* last) const {
  for (const Rule& rule : rules_)
    if ((!rule.when || rule.when(last)) && rule.move->begin(search)) return rule.move.get();
  return nullptr;
}

Schedule strip_schedule(double lattice_unit) {
  auto insert = std::make_unique<Insert>();
  auto explore = std::make_unique<Explore>();
  auto compress = std::make_unique<Compress>();
  auto lattice = std::make_unique<Lattice>(*insert, *explore, lattice_unit);
  const Schedule::When when_lattice = first_and_after(*compress, *lattice), when_compress = after(*explore);

  Schedule turns;
  if (lattice_unit > 0) turns.add(std::move(lattice), when_lattice);
  turns.add(std::move(insert));
  turns.add(std::move(compress), when_compress);
  turns.add(std::move(explore));
  return turns;
}

Schedule sheet_schedule() {
  Schedule turns;
  turns.add(std::make_unique<Fill>());
  turns.add(std::make_unique<Reduce>());
  turns.add(std::make_unique<SmallerBox>());
  return turns;
}

}  // namespace lekalo::nest
