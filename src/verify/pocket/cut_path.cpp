#include "cut_path.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/stop.hpp"
#include "verify/number/span.hpp"

namespace lekalo::verify {
namespace {

/// A program has at most this many cuts, and so many more for each of its moves.
constexpr std::size_t kMostCuts = 1'500'000, kMostCutsAMove = 4;

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
  const std::size_t most = kMostCuts + kMostCutsAMove * moves.size();
  for (const Move& move : moves) {
    ask();
    if (!(move.from_z < top) && !(move.to_z < top)) {
      down = false;
      continue;
    }
    if (!(whole_length(move) / longest < static_cast<double>(most - std::min(most, path.cuts.size()))))
      return failure(ErrorCode::bad_input,
                     fmt::format("{}:{}: the path in the stock is longer than {} half radii of the tool; "
                                 "give the tool's diameter in mm, or simulate a part of the program",
                                 name, move.line, most));
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
  struct Deepest {
    double z, radius;
  };
  // The ends of a stroke, in either order, and its centre tell it: an arc turns by at most a quarter.
  std::map<std::array<double, 7>, Deepest> known;
  std::vector<bool> found(cuts.size(), false);
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    if (!cuts[i].level()) continue;
    const Stroke& s = cuts[i].stroke;
    const auto [a, b] = std::minmax({std::pair(s.from.x, s.from.y), std::pair(s.to.x, s.to.y)});
    const Place centre = s.arc ? s.centre : Place{};
    const std::array<double, 7> key{
        static_cast<double>(s.arc), a.first, a.second, b.first, b.second, centre.x, centre.y};
    const auto [at, is_new] = known.try_emplace(key, Deepest{cuts[i].to_z, cuts[i].radius});
    if (is_new) continue;
    found[i] = at->second.z <= cuts[i].to_z && at->second.radius >= cuts[i].radius;
    if (cuts[i].to_z <= at->second.z && cuts[i].radius >= at->second.radius)
      at->second = {cuts[i].to_z, cuts[i].radius};
  }
  return found;
}

}  // namespace lekalo::verify
