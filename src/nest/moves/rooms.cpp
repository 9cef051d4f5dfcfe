#include "rooms.hpp"

#include <algorithm>

namespace lekalo::nest {

void Rooms::begin(const Search& search) {
  left_ = std::clamp<std::size_t>(tuning::kSlides / (tuning::kSweeps * search.items.movable()), 1,
                                  tuning::kRooms);
}

bool Rooms::try_one(Search& search) {
  Random& random = search.random();
  Separator& separator = search.separator;
  State& current = search.current.state;
  --left_;
  separator.load(current);
  const std::uint32_t bin = current.open_bins[random.below(current.open_bins.size())];
  const Box& box = search.problem.bins()[bin].box;
  const geom::Point at = {random.uniform(box.x0, box.x1), random.uniform(box.y0, box.y1)};
  for (int k = 0; k < tuning::kSweeps; ++k) separator.make_room(bin, at);
  current.spots = separator.state().spots;
  State slid = separator.state();
  search.tidy(slid);
  if (!slid.open_bins.empty())
    search.current.merit.reach =
        -leftover_of(search.problem, search.items, slid, emptiest(search.problem, search.items, slid));
  const std::vector<std::uint32_t> missing = search.nowhere(current);
  separator.put_near(missing[search.pick(missing.size())], bin, at);
  return separator.relax(tuning::kRoomRelaxRounds);
}

}  // namespace lekalo::nest
