#include "curve_joins.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "lekalo/base/disjoint_sets.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/polygon.hpp"

namespace lekalo::io {
namespace {

using geom::Point;

/// Points in a row, each near the next, that lead farther than so many join tolerances are no place where
/// curves meet.
constexpr double kWidestPlace = 4;

struct End {
  Point at;
  EndNumber number = 0;
};

struct Pair {
  double distance = 0;
  EndNumber a = 0, b = 0;  ///< a < b
};

/// Sorts loose ends into square cells a little wider than the tolerance, in the order of the cells.
class EndGrid {
 public:
  EndGrid(const std::vector<End>& ends, double tolerance) : tolerance_(tolerance) {
    double largest = 0;
    for (const End& end : ends) largest = std::max({largest, std::abs(end.at.x), std::abs(end.at.y)});
    // At most 2^48 cells to a side, so that the division's rounding stays far below one cell.
    const double cell = std::max(2 * tolerance, largest * 0x1p-48);
    for (const End& end : ends)
      cells_.push_back({static_cast<std::int64_t>(std::floor(end.at.x / cell)),
                        static_cast<std::int64_t>(std::floor(end.at.y / cell)), end});
    std::sort(cells_.begin(), cells_.end(), [](const Cell& a, const Cell& b) {
      return std::tie(a.x, a.y, a.end.number) < std::tie(b.x, b.y, b.end.number);
    });
  }

  /// Calls visit(pair) for all pairs within the tolerance; the first crowded end stops it.
  template <class Visit>
  std::optional<EndNumber> visit_pairs(Visit&& visit) const {
    std::size_t next_column = 0;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      ask();
      const Cell& cell = cells_[i];
      std::size_t seen = 0;
      const auto look_at = [&](const Cell& other) {
        const double distance = norm(other.end.at - cell.end.at);
        const auto [a, b] = std::minmax(cell.end.number, other.end.number);
        if (distance <= tolerance_) visit(Pair{distance, a, b});
        return ++seen <= kMostEndsNearby;
      };
      for (std::size_t j = i + 1; j < cells_.size() && cells_[j].x == cell.x && cells_[j].y <= cell.y + 1;
           ++j)
        if (!look_at(cells_[j])) return cell.end.number;
      while (next_column < cells_.size() &&
             std::tie(cells_[next_column].x, cells_[next_column].y) < std::tuple(cell.x + 1, cell.y - 1))
        ++next_column;
      for (std::size_t j = next_column;
           j < cells_.size() && cells_[j].x == cell.x + 1 && cells_[j].y <= cell.y + 1; ++j)
        if (!look_at(cells_[j])) return cell.end.number;
    }
    return std::nullopt;
  }

 private:
  struct Cell {
    std::int64_t x = 0, y = 0;
    End end;
  };
  double tolerance_;
  std::vector<Cell> cells_;
};

class Joiner {
 public:
  Joiner(const std::vector<OpenCurve>& curves, double tolerance) : curves_(curves), tolerance_(tolerance) {
    joins_.partner.assign(2 * curves.size(), kNoEnd);
  }

  CurveJoins run() {
    join_near(join_equal());
    return std::move(joins_);
  }

 private:
  [[nodiscard]] bool free(EndNumber end) const { return joins_.partner[end] == kNoEnd; }
  void join(EndNumber a, EndNumber b) {
    joins_.partner[a] = b;
    joins_.partner[b] = a;
  }
  /// True for both ends of a curve that is not clearly longer than their distance.
  [[nodiscard]] bool too_short_to_close(const Pair& pair) const {
    return pair.a / 2 == pair.b / 2 && !(curves_[pair.a / 2].reach >= 4 * pair.distance);
  }

  /// Joins the ends that are alone in one place, the fast way to what the general rule says of distance 0;
  /// returns the others.
  std::vector<End> join_equal() {
    std::vector<End> ends, loose;
    ends.reserve(2 * curves_.size());
    for (EndNumber i = 0; i < curves_.size(); ++i) {
      if (!curves_[i].used) continue;
      ends.push_back({curves_[i].from, 2 * i});
      ends.push_back({curves_[i].to, 2 * i + 1});
    }
    std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) {
      return std::tie(a.at.x, a.at.y, a.number) < std::tie(b.at.x, b.at.y, b.number);
    });
    for (std::size_t i = 0, next = 0; i < ends.size(); i = next) {
      while (next < ends.size() && ends[next].at == ends[i].at) ++next;
      if (next == i + 2)
        join(ends[i].number, ends[i + 1].number);
      else
        loose.insert(loose.end(), ends.begin() + static_cast<std::ptrdiff_t>(i),
                     ends.begin() + static_cast<std::ptrdiff_t>(next));
    }
    return loose;
  }

  void join_near(const std::vector<End>& loose) {
    std::vector<Pair> pairs;
    joins_.crowded = EndGrid(loose, tolerance_).visit_pairs([&](const Pair& pair) {
      if (!too_short_to_close(pair)) pairs.push_back(pair);
    });
    if (joins_.crowded) return;
    std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
      return std::tie(a.distance, a.a, a.b) < std::tie(b.distance, b.a, b.b);
    });
    // The pairs of every end stand together, nearest first.
    std::vector<std::uint32_t> starts(joins_.partner.size() + 1, 0), of_end(2 * pairs.size());
    for (const Pair& pair : pairs) ++starts[pair.a + 1], ++starts[pair.b + 1];
    for (std::size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];
    std::vector<std::uint32_t> filled(starts.begin(), starts.end() - 1);
    for (std::uint32_t k = 0; k < pairs.size(); ++k)
      of_end[filled[pairs[k].a]++] = k, of_end[filled[pairs[k].b]++] = k;
    const auto other = [&](std::uint32_t k, EndNumber end) {
      return pairs[k].a == end ? pairs[k].b : pairs[k].a;
    };
    const auto rivalled = [&](EndNumber end, EndNumber partner, double distance) {
      for (std::uint32_t i = starts[end]; i < starts[end + 1]; ++i) {
        const Pair& pair = pairs[of_end[i]];
        if (pair.distance > 2 * distance) return false;
        const EndNumber rival = other(of_end[i], end);
        if (rival != partner && free(rival)) return true;
      }
      return false;
    };
    for (const Pair& pair : pairs) {
      if (!free(pair.a) || !free(pair.b)) continue;
      if (rivalled(pair.a, pair.b, pair.distance) || rivalled(pair.b, pair.a, pair.distance)) continue;
      join(pair.a, pair.b);
    }
    for (const End& end : loose) {
      const EndNumber e = end.number;
      if (!free(e) || starts[e] == starts[e + 1]) continue;
      const bool rival = std::any_of(of_end.begin() + starts[e], of_end.begin() + starts[e + 1],
                                     [&](std::uint32_t k) { return free(other(k, e)); });
      if (rival) joins_.undecided.push_back(e);
    }
    std::sort(joins_.undecided.begin(), joins_.undecided.end());
  }

  const std::vector<OpenCurve>& curves_;
  double tolerance_;
  CurveJoins joins_;
};

}  // namespace

std::vector<std::vector<EndNumber>> branchings(const std::vector<OpenCurve>& curves, const CurveJoins& joins,
                                               double tolerance) {
  std::vector<End> ends;
  for (EndNumber i = 0; i < curves.size(); ++i) {
    if (!curves[i].used) continue;
    ends.push_back({curves[i].from, 2 * i});
    ends.push_back({curves[i].to, 2 * i + 1});
  }
  std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) {
    return std::tie(a.at.x, a.at.y, a.number) < std::tie(b.at.x, b.at.y, b.number);
  });
  // Equal ends make a place; the number of an End is that of its place from here on.
  std::vector<End> places;
  std::vector<std::uint32_t> place_of(2 * curves.size(), kNoEnd);
  std::vector<char> free;
  for (const End& end : ends) {
    if (places.empty() || !(places.back().at == end.at)) {
      places.push_back({end.at, static_cast<EndNumber>(places.size())});
      free.push_back(0);
    }
    place_of[end.number] = places.back().number;
    if (joins.partner[end.number] == kNoEnd) free.back() = 1;
  }
  DisjointSets sets(places.size());
  std::vector<Pair> near;
  const auto crowded = EndGrid(places, tolerance).visit_pairs([&](const Pair& pair) {
    if (free[pair.a] != 0 || free[pair.b] != 0) near.push_back(pair);
  });
  if (!crowded) {
    DisjointSets rows(places.size());
    for (const Pair& pair : near) rows.join(pair.a, pair.b);
    std::vector<geom::Box> boxes;
    for (const End& place : places) boxes.push_back({place.at, place.at});
    for (std::uint32_t p = 0; p < places.size(); ++p)
      boxes[rows.of(p)] = joined(boxes[rows.of(p)], {places[p].at, places[p].at});
    for (const Pair& pair : near) {
      const geom::Box& box = boxes[rows.of(pair.a)];
      if (norm(box.high - box.low) <= kWidestPlace * tolerance) sets.join(pair.a, pair.b);
    }
  }
  std::vector<char> branches(places.size(), 0);
  for (std::uint32_t p = 0; p < places.size(); ++p)
    if (free[p] != 0) branches[sets.of(p)] = 1;
  for (const End& end : ends) {
    const EndNumber partner = joins.partner[end.number];
    if (partner == kNoEnd || partner < end.number) continue;
    const std::uint32_t a = sets.of(place_of[end.number]), b = sets.of(place_of[partner]);
    if (a == b || (branches[a] == 0 && branches[b] == 0)) continue;
    sets.join(a, b);
    branches[std::min(a, b)] = 1;
  }
  std::vector<std::vector<EndNumber>> of_place(places.size());
  for (const End& end : ends) {
    const std::uint32_t p = sets.of(place_of[end.number]);
    if (branches[p] != 0) of_place[p].push_back(end.number);
  }
  std::erase_if(of_place, [](const auto& place) { return place.size() < 3; });
  for (auto& place : of_place) std::sort(place.begin(), place.end());
  std::sort(of_place.begin(), of_place.end());
  return of_place;
}

CurveJoins join_ends(const std::vector<OpenCurve>& curves, double tolerance) {
  return Joiner(curves, tolerance).run();
}

}  // namespace lekalo::io
