#include "common_stretch.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/box_tree.hpp"

namespace lekalo::nc {
namespace {

using geom::Point;

/// Lines that face each other run in opposite directions but for this.
constexpr double kOpposite = -0.999;

/// A straight edge of an outline's path.
struct OutlineSegment {
  std::size_t cut = 0, edge = 0, part = 0;
  Point from, way;  ///< mm; a unit vector
  double length = 0;
};

/// A part of a segment, by the distance from its beginning.
struct SharedInterval {
  double from = 0, to = 0;
};

struct SharedPair {
  std::size_t a = 0, b = 0;  ///< segments
  SharedInterval on_a, on_b;
};

class StretchFinder {
 public:
  StretchFinder(const std::vector<Cut>& cuts, const ProfileOptions& options)
      : cuts_(cuts), options_(options), resolution_(resolution_of(options)) {
    for (std::size_t cut = 0; cut < cuts.size(); ++cut) {
      if (!cuts[cut].outline) continue;
      for (std::size_t e = 0; e < cuts[cut].path.size(); ++e) {
        const WrittenEdge& edge = cuts[cut].path[e];
        if (edge.kind != geom::EdgeKind::line) continue;
        const Point from = resolution_.mm(edge.from), along = resolution_.mm(edge.to) - from;
        const double length = geom::norm(along);
        segments_.push_back({cut, e, cuts[cut].part, from, (1 / length) * along, length});
      }
    }
  }

  CommonStretches find() {
    std::vector<geom::Box> boxes;
    for (const OutlineSegment& s : segments_)
      boxes.push_back(geom::grown(geom::box_of(s.from, s.from + s.length * s.way), options_.tolerance_mm));
    geom::BoxTree(boxes).visit_pairs([&](std::uint32_t i, std::uint32_t j) { look(i, j); });
    std::sort(pairs_.begin(), pairs_.end(), [](const SharedPair& x, const SharedPair& y) {
      return std::tie(x.a, x.on_a.from, x.b) < std::tie(y.a, y.on_a.from, y.b);
    });
    return divided();
  }

 private:
  /// Distances below this along an edge are none: an end that is so near to an end of the edge is that end.
  [[nodiscard]] double snap() const { return options_.tolerance_mm + 2 * resolution_.step_mm(); }

  void look(std::size_t i, std::size_t j) {
    const OutlineSegment &a = segments_[i], &b = segments_[j];
    if (a.part == b.part || !(geom::dot(a.way, b.way) < kOpposite)) return;
    const Point end = b.from + b.length * b.way;
    const double first = geom::dot(end - a.from, a.way), last = geom::dot(b.from - a.from, a.way);
    SharedInterval on{std::max(0.0, first), std::min(a.length, last)};
    if (!(on.to - on.from >= options_.kerf_mm)) return;
    const auto off = [&](double s) {
      return std::abs(geom::cross(b.way, a.from + s * a.way - b.from)) <= options_.tolerance_mm;
    };
    if (!off(on.from) || !off(on.to)) return;
    // The other line runs the other way: where the stretch ends on one it begins on the other.
    SharedInterval on_b{geom::dot(a.from + on.to * a.way - b.from, b.way),
                        geom::dot(a.from + on.from * a.way - b.from, b.way)};
    pairs_.push_back({i, j, snapped(on, a.length), snapped(on_b, b.length)});
  }

  [[nodiscard]] SharedInterval snapped(SharedInterval on, double length) const {
    if (on.from < snap()) on.from = 0;
    if (on.to > length - snap()) on.to = length;
    return on;
  }

  struct Mark {
    SharedInterval on;
    std::size_t stretch = 0;
  };
  using Marks = std::map<std::size_t, std::vector<Mark>>;  ///< by edge

  [[nodiscard]] CommonStretches divided() const {
    CommonStretches found;
    std::map<std::size_t, Marks> marks;  // by cut
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const SharedPair& pair = pairs_[k];
      const OutlineSegment &a = segments_[pair.a], &b = segments_[pair.b];
      marks[a.cut][a.edge].push_back({pair.on_a, k});
      marks[b.cut][b.edge].push_back({pair.on_b, k});
      found.stretches.push_back({{a.cut, b.cut}, {}});
      found.length_mm += pair.on_a.to - pair.on_a.from;
    }
    for (auto& [cut, of_cut] : marks) {
      for (auto& [edge, list] : of_cut)
        std::sort(list.begin(), list.end(),
                  [](const Mark& x, const Mark& y) { return x.on.from < y.on.from; });
      found.outlines.push_back(divided(cut, of_cut));
    }
    for (const DividedOutline& outline : found.outlines)
      for (const DividedOutline::Piece& piece : outline.pieces)
        if (found.stretches[piece.stretch].cuts[0] == outline.cut)
          found.stretches[piece.stretch].edge = piece.edge;
    return found;
  }

  [[nodiscard]] DividedOutline divided(std::size_t cut, const Marks& marks) const {
    DividedOutline made{cut, {}};
    std::vector<WrittenEdge> before;
    const auto add = [&](const WrittenEdge& edge) {
      (made.pieces.empty() ? before : made.pieces.back().run).push_back(edge);
    };
    for (std::size_t e = 0; e < cuts_[cut].path.size(); ++e) {
      ask();
      const WrittenEdge& edge = cuts_[cut].path[e];
      const auto its = marks.find(e);
      if (its == marks.end()) {
        add(edge);
        continue;
      }
      const Point from = resolution_.mm(edge.from), along = resolution_.mm(edge.to) - from;
      const double length = geom::norm(along);
      const auto point = [&](double s) {
        if (s <= 0) return edge.from;
        if (s >= length) return edge.to;
        return resolution_.rounded(from + (s / length) * along);
      };
      WrittenPoint at = edge.from;
      double reached = 0;
      for (const Mark& mark : its->second) {
        const WrittenPoint begin = point(std::max(reached, mark.on.from)),
                           end = point(std::max(reached, mark.on.to));
        if (begin != at) add({geom::EdgeKind::line, at, begin, {}});
        made.pieces.push_back({mark.stretch, {geom::EdgeKind::line, begin, end, {}}, {}});
        at = end;
        reached = std::max(reached, mark.on.to);
      }
      if (at != edge.to) add({geom::EdgeKind::line, at, edge.to, {}});
    }
    std::vector<WrittenEdge>& last = made.pieces.back().run;
    last.insert(last.end(), before.begin(), before.end());
    return made;
  }

  const std::vector<Cut>& cuts_;
  const ProfileOptions& options_;
  Resolution resolution_;
  std::vector<OutlineSegment> segments_;
  std::vector<SharedPair> pairs_;
};

}  // namespace

CommonStretches common_stretches(const std::vector<Cut>& cuts, const ProfileOptions& options) {
  return StretchFinder(cuts, options).find();
}

}  // namespace lekalo::nc
