#include "contour_mending.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/offset.hpp"
#include "lekalo/geom/region_check.hpp"
#include "near_edges.hpp"

namespace lekalo::io {
namespace {

using geom::Contour;
using geom::Edge;
using geom::EdgeKind;
using geom::Point;

struct PointOrder {
  bool operator()(const Point& a, const Point& b) const { return std::tie(a.x, a.y) < std::tie(b.x, b.y); }
};

Point direction_at(const Edge& edge, Point at) {
  Point along = edge.to - edge.from;
  if (edge.kind != EdgeKind::line) {
    along = perpendicular(at - edge.centre);
    if (edge.kind == EdgeKind::arc_cw) along = -along;
  }
  return (1 / norm(along)) * along;
}

/// A neck with a smaller angle than this at its corner counts as closed, radians.
constexpr double kLeastAngle = 0.1;

/// Says whether two edges leave their common corner side by side, so that chords beside them would meet.
bool turns_back(const Edge& in, const Edge& out) {
  const Point arriving = direction_at(in, in.to), leaving = direction_at(out, out.from);
  return norm(arriving + leaving) < kLeastAngle;
}

/// The loops that come too near to something are found this many times; after that all are cut off.
constexpr int kMostMendings = 4;
constexpr std::size_t kNoLoop = static_cast<std::size_t>(-1);

/// The right-hand side of the way through a corner, where the material is not.
Point right_of(const Edge& in, const Edge& out) {
  const Point arriving = direction_at(in, in.to), leaving = direction_at(out, out.from);
  const Point sum = arriving + leaving;
  // A way that turns back has its right-hand side ahead.
  if (!(norm(sum) > 1e-3)) return arriving;
  return (-1 / norm(sum)) * perpendicular(sum);
}

double size_of(const Contour& contour) {
  const geom::Box box = geom::bounds(contour);
  return norm(box.high - box.low);
}

/// The width of a strip of the same area and circumference, if it is long.
double mean_width(const Contour& contour) {
  double around = 0;
  for (const Edge& edge : contour) around += 2 * bisected(edge).half_length;
  return 2 * std::abs(geom::signed_area(contour)) / around;
}

class Mender {
 public:
  Mender(const std::vector<LooseContour>& contours, geom::FillRule rule, const MendLimits& limits)
      : given_(contours), rule_(rule), speck_(limits.speck), repair_(limits.repair) {}

  std::optional<Mended> run() {
    std::vector<Contour> contours;
    for (const LooseContour& one : given_) {
      contours.push_back(one.edges);
      curves_.insert(curves_.end(), one.curves.begin(), one.curves.end());
    }
    auto cut = geom::contours_around(contours, rule_);
    if (!cut || !(cut->corner_error <= repair_)) return std::nullopt;
    cut_ = *std::move(cut);
    if (cut_.contours.empty()) {
      for (const geom::CutEdge& one : cut_.left) left_.push_back({one.edge, curves_[one.origin]});
      return marks_alone();
    }
    for (const geom::CutContour& loop : cut_.contours) area_.push_back(geom::signed_area(loop.contour));
    find_small();
    // A neck may close something near it, and then its loop is cut off instead: those that are seen to do so
    // first, then all.
    cut_off_loop_.assign(cut_.contours.size(), 0);
    for (int round = 0;; ++round) {
      narrow_.clear();
      auto made = attempt();
      if (made && narrow_.empty()) return made;
      if (narrow_.empty() || round >= kMostMendings)
        for (std::size_t i = 0; i < kind_.size(); ++i)
          if (kind_[i] == Kind::joined) narrow_.push_back(i);
      if (narrow_.empty()) return std::nullopt;
      for (const std::size_t i : narrow_) cut_off_loop_[i] = 1;
    }
  }

 private:
  [[nodiscard]] std::optional<Mended> attempt() {
    made_ = {};
    joined_loop_.clear();
    left_.clear(), cut_off_.clear();
    for (const geom::CutEdge& one : cut_.left) left_.push_back({one.edge, curves_[one.origin]});
    sort_loops();
    for (std::size_t i = 0; i < cut_.contours.size(); ++i) {
      if (kind_[i] == Kind::stays) {
        if (!add(i)) return std::nullopt;
      } else if (kind_[i] == Kind::dropped) {
        const geom::CutContour& loop = cut_.contours[i];
        // A sliver is a spike whose ways out and back are not quite the same, and a crack is lines to be cut.
        const bool is_loop = size_of(loop.contour) <= 2 * repair_ && !is_sliver(loop.contour);
        std::vector<LooseEdge>& to = is_loop ? cut_off_ : left_;
        for (std::size_t k = 0; k < loop.contour.size(); ++k)
          to.push_back({loop.contour[k], curves_[loop.origins[k]]});
      }
    }
    if (made_.contours.empty()) return marks_alone();
    if (!retreat_holes() || !find_narrow()) return std::nullopt;
    for (const LooseContour& one : made_.contours) {
      ask(one.edges.size());
      const bool hole = !(geom::signed_area(one.edges) > 0);
      const auto region = geom::make_region(hole ? geom::reversed(one.edges) : one.edges);
      if (!region || geom::fault_of({*region})) return std::nullopt;
    }
    return settle() ? std::optional(std::move(made_)) : std::nullopt;
  }

  /// Lines that enclose nothing, or cracks that nobody would cut.
  [[nodiscard]] std::optional<Mended> marks_alone() {
    for (const std::vector<LooseEdge>& list : {left_, cut_off_})
      made_.marks.insert(made_.marks.end(), list.begin(), list.end());
    add_corner_error();
    return std::move(made_);
  }

  enum class Kind { stays, joined, dropped };

  /// Finds the loops that do not stay as they are.
  void find_small() {
    const std::vector<geom::CutContour>& loops = cut_.contours;
    std::size_t largest = 0;
    double most = 0;
    for (std::size_t i = 0; i < loops.size(); ++i) {
      const double size = size_of(loops[i].contour);
      small_.push_back(is_by_product(loops[i].contour, {speck_, repair_}) ? 1 : 0);
      if (size > most) most = size, largest = i;
    }
    // Something stays of what is small as a whole, unless it is a sliver.
    if (!is_sliver(loops[largest].contour)) small_[largest] = 0;
  }

  /// Says which loops stay, which are joined to another at a corner, and which are dropped.
  void sort_loops() {
    const std::vector<geom::CutContour>& loops = cut_.contours;
    kind_.assign(loops.size(), Kind::stays);
    hung_.clear();
    std::map<Point, std::size_t, PointOrder> place;
    for (std::size_t i = 0; i < loops.size(); ++i)
      if (small_[i] == 0)
        for (const Edge& edge : loops[i].contour) place.emplace(edge.from, i);
    for (std::size_t i = 0; i < loops.size(); ++i) {
      if (small_[i] == 0) continue;
      const Contour& loop = loops[i].contour;
      std::size_t hangs = 0;  // the edge that begins in the corner by which it hangs
      while (hangs < loop.size() && place.count(loop[hangs].from) == 0) ++hangs;
      // A sliver, a loop that hangs on other small ones alone, and one that reaches too far from its corner
      // to be joined, as a crack does, is cut off: with its loss, or its lines are marks.
      kind_[i] = Kind::dropped;
      if (hangs == loop.size() || is_sliver(loop)) continue;
      const Point corner = loop[hangs].from;
      if (!lies_within(loop, corner, repair_)) continue;
      // A loop outside is joined through the material, one inside through what it leaves out.
      const bool inside = !(area_[i] > 0), joinable = area_[place.at(corner)] > 0;
      if (cut_off_loop_[i] == 0 && joinable && loop.size() > 1 &&
          hung_.emplace(corner, Hung{i, hangs, inside}).second)
        kind_[i] = Kind::joined;
    }
  }

  /// Says whether a loop is nowhere much wider than a speck.
  [[nodiscard]] bool is_sliver(const Contour& loop) const {
    return mean_width(loop) <= speck_ || lies_within(loop, loop.front().from, speck_);
  }

  [[nodiscard]] static bool lies_within(const Contour& loop, Point of, double reach) {
    return std::all_of(loop.begin(), loop.end(), [&](const Edge& edge) {
      const Bisected halves = bisected(edge);
      return norm(edge.from - of) <= reach && norm(halves.middle - of) <= reach;
    });
  }

  /// Adds a loop that stays, with the loops that hang on its corners.
  [[nodiscard]] bool add(std::size_t i) {
    const geom::CutContour& loop = cut_.contours[i];
    LooseContour made;
    std::vector<std::size_t> joined_loop;
    struct Joint {
      std::size_t after;  ///< an edge
      double aside;       ///< how far to the right its end is pulled
    };
    std::vector<Joint> joints;
    const auto append = [&](std::size_t from, std::size_t k) {
      made.edges.push_back(cut_.contours[from].contour[k]);
      made.curves.push_back(curves_[cut_.contours[from].origins[k]]);
      joined_loop.push_back(from == i ? kNoLoop : from);
    };
    for (std::size_t k = 0; k < loop.contour.size(); ++k) {
      append(i, k);
      const auto hung = hung_.find(loop.contour[k].to);
      if (hung == hung_.end() || !(area_[i] > 0)) continue;
      const double aside = hung->second.inside ? -kNeck : kNeck;
      joints.push_back({made.edges.size() - 1, aside});
      const geom::CutContour& other = cut_.contours[hung->second.loop];
      for (std::size_t n = 0; n < other.contour.size(); ++n)
        append(hung->second.loop, (hung->second.from + n) % other.contour.size());
      joints.push_back({made.edges.size() - 1, aside});
      hung_.erase(hung);
    }
    for (const Joint& joint : joints)
      if (!pull(made, joint.after, joint.aside)) return false;
    made_.contours.push_back(std::move(made));
    joined_loop_.insert(joined_loop_.end(), joined_loop.begin(), joined_loop.end());
    return true;
  }

  /// Finds the joined loops that come too near to something. Returns false where nobody can look at all that
  /// is near.
  [[nodiscard]] bool find_narrow() {
    std::vector<geom::Region> alone;
    for (const LooseContour& one : made_.contours) alone.push_back({one.edges, {}});
    const auto near = geom::all_meetings(alone, kNeck / 2);
    if (!near) return false;
    std::set<std::size_t> loops;
    const auto tell = [&](std::size_t edge) {
      if (joined_loop_[edge] != kNoLoop) loops.insert(joined_loop_[edge]);
    };
    for (const geom::MeetingEdges& one : *near) tell(one.a), tell(one.b);
    std::size_t first = 0;
    for (const LooseContour& one : made_.contours) {
      for (std::size_t k = 0; k < one.edges.size(); ++k) {
        const std::size_t next = k + 1 == one.edges.size() ? 0 : k + 1;
        if (turns_back(one.edges[k], one.edges[next])) tell(first + k), tell(first + next);
      }
      first += one.edges.size();
    }
    narrow_.assign(loops.begin(), loops.end());
    return true;
  }

  /// Moves the corner after an edge to the right of the way.
  [[nodiscard]] bool pull(LooseContour& contour, std::size_t joint, double aside) {
    const std::size_t next = joint + 1 == contour.edges.size() ? 0 : joint + 1;
    if (joint == next) return false;
    Edge &in = contour.edges[joint], &out = contour.edges[next];
    const Point to = in.to + aside * right_of(in, out);
    const auto one = move_end(in, true, to), other = move_end(out, false, to);
    if (!one || !other || !(std::max(*one, *other) <= repair_)) return false;
    made_.moved.push_back({contour.curves[joint], *one});
    made_.moved.push_back({contour.curves[next], *other});
    return true;
  }

  /// Pulls the corners of holes that lie on other contours.
  [[nodiscard]] bool retreat_holes() {
    std::vector<geom::Region> alone;
    std::vector<std::pair<std::size_t, std::size_t>> place;  // contour and edge, by number
    std::vector<char> is_hole;
    for (std::size_t c = 0; c < made_.contours.size(); ++c) {
      alone.push_back({made_.contours[c].edges, {}});
      is_hole.push_back(geom::signed_area(made_.contours[c].edges) > 0 ? 0 : 1);
      for (std::size_t k = 0; k < made_.contours[c].edges.size(); ++k) place.emplace_back(c, k);
    }
    const auto meetings = geom::all_meetings(alone);
    if (!meetings) return false;
    std::set<std::pair<std::size_t, std::size_t>> joints;
    for (const geom::MeetingEdges& one : *meetings)
      for (const auto& [c, k] : {place[one.a], place[one.b]}) {
        const std::vector<Edge>& edges = made_.contours[c].edges;
        if (place[one.a].first == place[one.b].first || is_hole[c] == 0) continue;
        if (norm(edges[k].to - one.at) <= kNeck / 8) joints.emplace(c, k);
        if (norm(edges[k].from - one.at) <= kNeck / 8) joints.emplace(c, (k == 0 ? edges.size() : k) - 1);
      }
    return std::all_of(joints.begin(), joints.end(), [this](const auto& joint) {
      return pull(made_.contours[joint.first], joint.second, kNeck);
    });
  }

  /// Measures how far what was left is from what stays: that is loss, or the stretch is a mark.
  [[nodiscard]] bool settle() {
    std::vector<Edge> kept;
    if (!left_.empty() || !cut_off_.empty())
      for (const LooseContour& one : made_.contours)
        kept.insert(kept.end(), one.edges.begin(), one.edges.end());
    const NearEdges outline(kept);
    const auto measure = [&](const LooseEdge& one, double limit) {
      ask();
      if (const auto far = outline.farthest(one.edge, limit, work_))
        made_.moved.push_back({one.curve, *far});
      else
        made_.marks.push_back(one);
    };
    for (const LooseEdge& one : left_) measure(one, std::min(speck_, repair_));
    for (const LooseEdge& one : cut_off_) measure(one, repair_);
    add_corner_error();
    return true;
  }

  /// Corners where edges cross may be off by this, and edges as a whole by no more.
  void add_corner_error() {
    for (const std::uint32_t curve : curves_) made_.moved.push_back({curve, cut_.corner_error});
  }

  struct Hung {
    std::size_t loop = 0, from = 0;  ///< the edge of the loop that begins in the corner
    bool inside = false;             ///< a hole
  };

  const std::vector<LooseContour>& given_;
  geom::FillRule rule_;
  double speck_, repair_;
  std::vector<std::uint32_t> curves_;  ///< by given edge
  geom::CutFaces cut_;
  std::vector<double> area_;  ///< by loop, with its sign
  std::vector<char> small_;   ///< by loop: it does not stay as it is
  std::vector<Kind> kind_;
  std::map<Point, Hung, PointOrder> hung_;
  std::vector<char> cut_off_loop_;        ///< by loop: not to be joined
  std::vector<std::size_t> joined_loop_;  ///< by edge of all made contours: the joined loop that it is of
  std::vector<std::size_t> narrow_;
  std::vector<LooseEdge> left_;     ///< stretches that bound nothing
  std::vector<LooseEdge> cut_off_;  ///< of loops
  std::size_t work_ = kMostWork;
  Mended made_;
};

}  // namespace

bool is_by_product(const Contour& contour, const MendLimits& limits) {
  const double width = limits.repair + limits.speck;
  if (size_of(contour) <= 2 * limits.repair) return true;
  // A disc as wide as the contour in the mean fits into it.
  if (mean_width(contour) > width) return false;
  const auto region = geom::make_region(geom::signed_area(contour) > 0 ? contour : geom::reversed(contour));
  if (!region) return false;
  const auto shrunk = geom::offset({*region}, -width / 2);
  return shrunk && shrunk->regions.empty();
}

std::optional<Mended> mended(const std::vector<LooseContour>& contours, geom::FillRule rule,
                             const MendLimits& limits) {
  return Mender(contours, rule, limits).run();
}

}  // namespace lekalo::io
