#include "cut_path.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/stop.hpp"
#include "verify/number/span.hpp"

namespace lekalo::verify {
namespace {

/// A program may have so many cuts, and so many for each of its moves, up to a number that moves raise
/// slowly: a line of a few bytes costs no more than the tenth of a second.
constexpr std::size_t kCuts = 200'000, kCutsAMove = 10'000;
constexpr std::size_t kMostCuts = 1'500'000, kMoreCutsAMove = 4;

std::size_t most_cuts(std::size_t moves) {
  return std::min(kCuts + kCutsAMove * moves, kMostCuts + kMoreCutsAMove * moves);
}

bool is_below(const Move& move, double top) { return move.from_z < top || move.to_z < top; }

double whole_length(const Move& move) {
  return move.arc ? 2 * kPi * move.turns * length(move.from - move.centre) : length(move.to - move.from);
}

std::vector<Stroke> strokes_of(const Move& move, double longest) {
  std::vector<Stroke> strokes;
  if (!move.arc) {
    add_line(move.from, move.to, longest, strokes);
    return strokes;
  }
  for (int turn = 1; turn < move.turns; ++turn)
    add_arc(move.from, move.from, move.centre, move.ccw, longest, strokes);
  add_arc(move.from, move.to, move.centre, move.ccw, longest, strokes);
  return strokes;
}

/// Adds the part of the stroke between two shares of its length.
void add_part(const Stroke& stroke, double begin, double end, Cut cut, CutPath& path) {
  const Place from = at_share(stroke, begin), to = at_share(stroke, end);
  cut.stroke = beginning(until(stroke, to), from);
  const double whole = cut.end - cut.begin;
  cut.end = cut.begin + end * whole, cut.begin += begin * whole;
  if (!(length(to - from) > 0)) cut.stroke.arc = false;
  path.cuts.push_back(cut);
  path.strokes.push_back(cut.stroke);
  path.deepest = std::min({path.deepest, cut.from_z, cut.to_z});
}

}  // namespace

Result<CutPath> cut_path(const std::vector<Move>& moves, double top, double tool_radius, double longest,
                         const std::string& name) {
  CutPath path;
  path.deepest = top;
  // `down` is true while the tool is below `top`. A cut that begins while it is false is a new entry.
  bool down = false;
  std::size_t entries = 0;
  const std::size_t most = most_cuts(moves.size());
  double expected = 0;
  for (const Move& move : moves)
    if (is_below(move, top)) expected += 1 + std::ceil(whole_length(move) / longest);
  // Vectors that grow would take half as much again. An arc of more turns has a few more cuts.
  path.cuts.reserve(static_cast<std::size_t>(std::min(expected, static_cast<double>(most))));
  path.strokes.reserve(path.cuts.capacity());
  for (const Move& move : moves) {
    ask();
    if (!is_below(move, top)) {
      down = false;
      continue;
    }
    if (!(whole_length(move) / longest < static_cast<double>(most - std::min(most, path.cuts.size()))))
      return failure(
          ErrorCode::bad_input,
          fmt::format("{}:{}: the path in the stock is longer than {} half radii of the tool, which "
                      "is the most for {} moves; correct a place that lies too far off, give the "
                      "tool's diameter in mm, or simulate a part of the program",
                      name, move.line, most, moves.size()));
    const std::vector<Stroke> strokes = strokes_of(move, longest);
    double whole = 0;
    for (const Stroke& s : strokes) whole += length(s);
    double done = 0, z = move.from_z;
    for (const Stroke& s : strokes) {
      Cut cut;
      cut.from_z = z;
      cut.move = static_cast<std::size_t>(&move - moves.data());
      cut.begin = whole > 0 ? done / whole : 0;
      done += length(s);
      cut.end = &s == &strokes.back() ? 1 : done / whole;
      z = &s == &strokes.back() ? move.to_z : move.from_z + done / whole * (move.to_z - move.from_z);
      cut.to_z = z;
      cut.line = move.line, cut.rapid = move.rapid, cut.feed = move.feed, cut.radius = tool_radius;
      const double drop = cut.to_z - cut.from_z;
      if (!(cut.from_z < top) && !(cut.to_z < top)) {
        down = false;
        continue;
      }
      if (!down) ++entries;
      cut.entry = entries;
      double first = 0, last = 1;
      if (cut.from_z > top) first = (top - cut.from_z) / drop, cut.from_z = top;
      if (cut.to_z > top) last = (top - cut.to_z + drop) / drop, cut.to_z = top;
      add_part(s, first, last, cut, path);
      down = cut.to_z < top;
    }
  }
  path.retracts = std::max<std::size_t>(entries, 1) - 1;
  return path;
}

StrokeIndex index_over(const std::vector<Cut>& cuts, double cell) {
  Place low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  for (const Cut& cut : cuts) {
    Place a, b;
    box_of(cut.stroke, a, b);
    low = {std::min(low.x, a.x), std::min(low.y, a.y)};
    high = {std::max(high.x, b.x), std::max(high.y, b.y)};
  }
  return {low, high, cell};
}

std::vector<bool> repeated(const std::vector<Cut>& cuts) {
  // The ends of a stroke, in either order, and its centre tell it: an arc turns by at most a quarter.
  using Key = std::array<double, 7>;
  const auto key_of = [&](std::uint32_t i) {
    const Stroke& s = cuts[i].stroke;
    const auto [a, b] = std::minmax({std::pair(s.from.x, s.from.y), std::pair(s.to.x, s.to.y)});
    const Place centre = s.arc ? s.centre : Place{};
    return Key{static_cast<double>(s.arc), a.first, a.second, b.first, b.second, centre.x, centre.y};
  };
  std::vector<std::uint32_t> level;
  for (std::size_t i = 0; i < cuts.size(); ++i)
    if (cuts[i].level()) level.push_back(static_cast<std::uint32_t>(i));
  std::ranges::sort(level, {}, [&](std::uint32_t i) { return std::pair(key_of(i), i); });
  std::vector<bool> found(cuts.size(), false);
  double deepest = 0, widest = 0;
  for (std::size_t k = 0; k < level.size(); ++k) {
    const Cut& cut = cuts[level[k]];
    const bool is_first = k == 0 || key_of(level[k]) != key_of(level[k - 1]);
    found[level[k]] = !is_first && deepest <= cut.to_z && widest >= cut.radius;
    if (is_first || (cut.to_z <= deepest && cut.radius >= widest)) deepest = cut.to_z, widest = cut.radius;
  }
  return found;
}

}  // namespace lekalo::verify
