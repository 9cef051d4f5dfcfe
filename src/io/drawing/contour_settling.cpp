#include "contour_settling.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "contour_relation.hpp"
#include "lekalo/base/disjoint_sets.hpp"
#include "lekalo/base/limits.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/box_tree.hpp"
#include "lekalo/geom/region_check.hpp"
#include "near_edges.hpp"

namespace lekalo::io {
namespace {

using geom::Contour;
using geom::Point;

/// Mending may bring contours to meet that did not. After this many rounds they are set aside instead.
constexpr int kMostSettlings = 6;
/// Steps that may be spent on how contours lie to each other, at least, and how many more for each edge. Real
/// drawings take a few for each edge that lies along another, and long curves some dozens.
constexpr std::size_t kLeastRelationWork = 10'000, kRelationWorkOfEdge = 500;
/// A contour of no more than this share of the area of another that it crosses is lines on it.
constexpr double kMostOfLines = 0.25;
/// A contour of which no more than this share lies in a far larger one is a part that was drawn too near to
/// it.
constexpr double kMostShared = 0.1;

/// A closed contour on its way to a region.
struct Candidate {
  LooseContour contour;
  std::uint32_t first = 0;  ///< its first curve in the file
  bool mended = false;      ///< it came out of a mend, and meets nothing but in corners
  bool small = false;       ///< no larger than a loop that may be cut off
  std::size_t id = 0;       ///< the same in all rounds
  /// Made when it is first asked about others.
  std::unique_ptr<const PlacedContour> placed = {};
};

std::uint32_t first_curve(const LooseContour& contour) {
  return *std::min_element(contour.curves.begin(), contour.curves.end());
}

class Settling {
 public:
  Settling(std::vector<LooseContour> contours, const std::vector<CurveOrigin>& origins,
           const MendLimits& limits)
      : origins_(origins), limits_(limits), repair_(limits.repair) {
    for (LooseContour& contour : contours) {
      relation_work_ += kRelationWorkOfEdge * contour.edges.size();
      enter(std::move(contour), false);
    }
  }

  std::optional<Settled> run() {
    for (int round = 0;; ++round) {
      // From the last round on contours only go, so that the rounds end.
      const bool last = round >= kMostSettlings;
      if (!find_meetings()) return std::nullopt;
      if (!last && mend_groups(groups_that_meet())) continue;
      relate();
      if (!nest()) return std::nullopt;
      tell_neighbours();
      if (!last && mend_crossing_holes()) continue;
      if (leave_lines_on_larger()) continue;
      if (set_aside_crossing()) continue;
      const auto faulty = faulty_regions();
      if (faulty.empty()) break;
      // All that cannot be mended is set aside, one shape at a time.
      if (last || !mend_groups(faulty)) set_aside(faulty);
    }
    make_regions();
    return std::move(made_);
  }

 private:
  using Group = std::vector<std::size_t>;
  /// The answers about two contours that have been asked for.
  struct Known {
    std::optional<Relation> relation;
    std::optional<double> shared;
  };

  void enter(LooseContour contour, bool mended) {
    const auto region = geom::make_region(contour.edges);
    if (!region) {
      // A figure of eight may have the area 0; what goes back along itself encloses nothing.
      if (auto parted =
              mended ? std::nullopt : io::mended({contour}, origins_[first_curve(contour)].fill, limits_)) {
        made_.marks.insert(made_.marks.end(), parted->marks.begin(), parted->marks.end());
        made_.moved.insert(made_.moved.end(), parted->moved.begin(), parted->moved.end());
        for (LooseContour& part : parted->contours) enter(std::move(part), true);
        return;
      }
      for (std::size_t k = 0; k < contour.edges.size(); ++k)
        made_.marks.push_back({contour.edges[k], contour.curves[k]});
      return;
    }
    const geom::Box box = geom::bounds(contour.edges);
    const std::uint32_t first = first_curve(contour);
    candidates_.push_back(
        {std::move(contour), first, mended, norm(box.high - box.low) <= 2 * repair_, next_id_++});
  }

  [[nodiscard]] bool find_meetings() {
    std::stable_sort(candidates_.begin(), candidates_.end(),
                     [](const Candidate& a, const Candidate& b) { return a.first < b.first; });
    std::vector<geom::Region> alone;
    std::vector<std::uint32_t> contour_of;
    for (std::uint32_t c = 0; c < candidates_.size(); ++c) {
      alone.push_back({candidates_[c].contour.edges, {}});
      contour_of.resize(contour_of.size() + candidates_[c].contour.edges.size(), c);
    }
    const auto all = geom::all_meetings(alone);
    if (!all) return false;
    itself_.assign(candidates_.size(), std::nullopt);
    meetings_.clear();
    for (const geom::MeetingEdges& one : *all) {
      const std::uint32_t a = contour_of[one.a], b = contour_of[one.b];
      if (a == b && !itself_[a]) itself_[a] = one.at;
      if (a != b) meetings_.emplace(std::minmax(a, b), Meeting{one.at, Relation::beside});
    }
    return true;
  }

  /// Returns the entity that drew all of a contour.
  [[nodiscard]] std::optional<std::uint32_t> entity_of(const LooseContour& contour) const {
    const std::uint32_t entity = origins_[contour.curves.front()].entity;
    for (const std::uint32_t curve : contour.curves)
      if (origins_[curve].entity != entity) return std::nullopt;
    return entity;
  }

  [[nodiscard]] const PlacedContour& placed(std::size_t c) {
    Candidate& one = candidates_[c];
    if (!one.placed) one.placed = std::make_unique<const PlacedContour>(one.contour.edges);
    return *one.placed;
  }

  /// Two contours that stay lie to each other in every round as they do in the first. Those that stay keep
  /// their order, so that `first_in` and `second_in` keep their sense.
  [[nodiscard]] Known& known(std::size_t a, std::size_t b) {
    return known_[{candidates_[std::min(a, b)].id, candidates_[std::max(a, b)].id}];
  }

  [[nodiscard]] Relation relation(std::size_t a, std::size_t b) {
    std::optional<Relation>& relation = known(a, b).relation;
    if (!relation)
      relation = relation_of(placed(std::min(a, b)), placed(std::max(a, b)), repair_, relation_work_);
    return *relation;
  }

  [[nodiscard]] double shared(std::size_t a, std::size_t b) {
    std::optional<double>& part = known(a, b).shared;
    if (!part) part = shared_part(placed(a), placed(b));
    return *part;
  }

  /// Contours that cross or touch themselves, those with the loops beside them that are small, and those that
  /// one element draws across each other.
  [[nodiscard]] std::vector<Group> groups_that_meet() {
    DisjointSets sets(candidates_.size());
    std::vector<char> wanted(candidates_.size(), 0);
    for (std::size_t c = 0; c < candidates_.size(); ++c)
      if (itself_[c]) wanted[c] = 1;
    const auto join = [&](std::size_t a, std::size_t b) {
      wanted[a] = wanted[b] = 1;
      sets.join(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
    };
    // A small loop goes with one larger contour, that of its own entity before others, so that it does not
    // make one shape of two parts that share a corner.
    const auto is_loop = [&](std::size_t c) { return candidates_[c].small && !candidates_[c].mended; };
    std::vector<std::size_t> larger(candidates_.size(), kNone);
    std::vector<char> is_own(candidates_.size(), 0);
    for (const auto& [pair, meeting] : meetings_)
      for (const auto& [loop, other] : {pair, std::pair(pair.second, pair.first)}) {
        if (!is_loop(loop) || is_loop(other)) continue;
        const auto entity = entity_of(candidates_[loop].contour);
        const bool own = entity && entity == entity_of(candidates_[other].contour);
        if (larger[loop] == kNone || (own && is_own[loop] == 0)) larger[loop] = other, is_own[loop] = own;
      }
    for (std::size_t c = 0; c < candidates_.size(); ++c)
      if (larger[c] != kNone) join(c, larger[c]);
    for (const auto& [pair, meeting] : meetings_) {
      const auto [a, b] = pair;
      if (is_loop(a) || is_loop(b)) {
        if (is_loop(a) && is_loop(b) && larger[a] == kNone && larger[b] == kNone) join(a, b);
        continue;
      }
      if (itself_[a] || itself_[b]) continue;
      const auto entity = entity_of(candidates_[a].contour);
      if (entity && entity == entity_of(candidates_[b].contour) && relation(a, b) == Relation::crossing)
        join(a, b);
    }
    std::map<std::size_t, Group> groups;
    for (std::size_t c = 0; c < candidates_.size(); ++c)
      if (wanted[c] != 0) groups[sets.of(static_cast<std::uint32_t>(c))].push_back(c);
    std::vector<Group> found;
    for (auto& [first, group] : groups) found.push_back(std::move(group));
    return found;
  }

  /// Mends groups of contours; one that cannot be is set aside. Returns whether there were any.
  bool mend_groups(const std::vector<Group>& groups) {
    if (groups.empty()) return false;
    std::vector<char> gone(candidates_.size(), 0);
    std::vector<LooseContour> entered;
    for (const Group& group : groups) {
      ask();
      std::vector<LooseContour> contours;
      for (const std::size_t c : group) contours.push_back(candidates_[c].contour), gone[c] = 1;
      auto made = mended(contours, origins_[first_curve(contours.front())].fill, limits_);
      if (!made) {
        for (const std::size_t c : group) put_aside(c, AsideReason::crosses_itself, group);
        continue;
      }
      ++made_.mends;
      made_.marks.insert(made_.marks.end(), made->marks.begin(), made->marks.end());
      made_.moved.insert(made_.moved.end(), made->moved.begin(), made->moved.end());
      for (LooseContour& contour : made->contours) entered.push_back(std::move(contour));
    }
    keep_all_but(gone);
    for (LooseContour& contour : entered) enter(std::move(contour), true);
    return true;
  }

  void put_aside(std::size_t c, AsideReason reason, const Group& with) {
    std::optional<std::uint32_t> other;
    Point at = itself_[c].value_or(candidates_[c].contour.edges.front().from);
    for (const std::size_t d : with)
      if (d != c && !other) {
        other = candidates_[d].contour.curves.front();
        if (const auto met = meetings_.find(std::minmax(c, d)); met != meetings_.end()) at = met->second.at;
      }
    if (other) reason = AsideReason::crosses_another;
    made_.aside.push_back({candidates_[c].contour, reason, at, other});
  }

  void relate() {
    for (auto& [pair, meeting] : meetings_) meeting.relation = relation(pair.first, pair.second);
  }

  /// Holes that cross each other are one hole, whatever their size. Returns whether there were any.
  bool mend_crossing_holes() {
    DisjointSets sets(candidates_.size());
    std::vector<char> crosses(candidates_.size(), 0);
    for (const auto& [pair, meeting] : meetings_) {
      const auto [a, b] = pair;
      if (meeting.relation != Relation::crossing || depth_[a] != depth_[b] || depth_[a] % 2 == 0) continue;
      crosses[a] = crosses[b] = 1;
      sets.join(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
    }
    std::map<std::size_t, Group> groups;
    for (std::size_t c = 0; c < candidates_.size(); ++c)
      if (crosses[c] != 0) groups[sets.of(static_cast<std::uint32_t>(c))].push_back(c);
    std::vector<char> gone(candidates_.size(), 0);
    std::vector<LooseContour> entered;
    for (const auto& [first, group] : groups) {
      ask();
      std::vector<LooseContour> contours;
      for (const std::size_t c : group) {
        LooseContour& one = contours.emplace_back(candidates_[c].contour);
        if (geom::signed_area(one.edges) > 0) continue;
        one.edges = geom::reversed(one.edges);
        std::reverse(one.curves.begin(), one.curves.end());
      }
      auto made = mended(contours, geom::FillRule::nonzero, limits_);
      if (!made) continue;
      ++made_.mends;
      for (const std::size_t c : group) gone[c] = 1;
      made_.marks.insert(made_.marks.end(), made->marks.begin(), made->marks.end());
      made_.moved.insert(made_.moved.end(), made->moved.begin(), made->moved.end());
      for (LooseContour& contour : made->contours) entered.push_back(std::move(contour));
    }
    if (entered.empty()) return false;
    keep_all_but(gone);
    for (LooseContour& contour : entered) enter(std::move(contour), true);
    return true;
  }

  /// A contour that crosses a far larger one becomes lines on it. Whether it is to be cut off, or only drawn
  /// there, nobody can tell, and lines leave both open. Returns whether there were any.
  bool leave_lines_on_larger() {
    std::vector<char> gone(candidates_.size(), 0);
    for (const auto& [pair, meeting] : meetings_) {
      const auto [a, b] = pair;
      if (meeting.relation != Relation::crossing || depth_[a] != depth_[b] || depth_[a] % 2 != 0) continue;
      const std::size_t small = placed(a).area() < placed(b).area() ? a : b, large = small == a ? b : a;
      if (!(kMostOfLines * placed(large).area() >= placed(small).area()) ||
          std::exchange(gone[small], 1) != 0)
        continue;
      const LooseContour& lines = candidates_[small].contour;
      for (std::size_t k = 0; k < lines.edges.size(); ++k)
        made_.marks.push_back({lines.edges[k], lines.curves[k]});
      made_.lines_on_others.push_back(
          {lines.curves.front(), candidates_[large].contour.curves.front(), meeting.at});
    }
    if (std::find(gone.begin(), gone.end(), 1) == gone.end()) return false;
    keep_all_but(gone);
    return true;
  }

  void keep_all_but(const std::vector<char>& gone) {
    std::vector<Candidate> kept;
    for (std::size_t c = 0; c < candidates_.size(); ++c)
      if (gone[c] == 0) kept.push_back(std::move(candidates_[c]));
    candidates_ = std::move(kept);
  }

  /// Drops contours that run along others, and sets aside those that overlap. Returns whether any went.
  bool set_aside_crossing() {
    std::vector<char> gone(candidates_.size(), 0);
    for (const auto& [pair, meeting] : meetings_) {
      const auto [a, b] = pair;
      if (meeting.relation == Relation::crossing) {
        for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)})
          if (std::exchange(gone[one], 1) == 0) put_aside(one, AsideReason::crosses_another, {other});
      }
    }
    for (const auto& [pair, meeting] : meetings_) {
      const auto [a, b] = pair;
      if (meeting.relation != Relation::same || gone[a] != 0 || gone[b] != 0) continue;
      const std::size_t copy = placed(a).area() < placed(b).area() ? a : b, kept = copy == a ? b : a;
      gone[copy] = 1;
      drop_copy(candidates_[copy].contour, candidates_[kept].contour);
    }
    if (std::find(gone.begin(), gone.end(), 1) == gone.end()) return false;
    keep_all_but(gone);
    return true;
  }

  void drop_copy(const LooseContour& copy, const LooseContour& kept) {
    const NearEdges outline(kept.edges);
    for (std::size_t k = 0; k < copy.edges.size(); ++k) {
      made_.dropped.push_back(copy.curves[k]);
      if (const auto far = outline.farthest(copy.edges[k], repair_, work_))
        made_.moved.push_back({copy.curves[k], *far});
      else
        made_.marks.push_back({copy.edges[k], copy.curves[k]});
    }
  }

  /// Finds what is around each contour, by a tree of boxes and the relations of those that meet.
  [[nodiscard]] bool nest() {
    std::vector<geom::Box> boxes;
    for (const Candidate& one : candidates_) boxes.push_back(geom::bounds(one.contour.edges));
    const geom::BoxTree tree(boxes);
    by_.assign(candidates_.size(), kNone);
    depth_.assign(candidates_.size(), 0);
    std::vector<char> crosses(candidates_.size(), 0);
    for (const auto& [pair, meeting] : meetings_)
      if (meeting.relation == Relation::crossing) crosses[pair.first] = crosses[pair.second] = 1;
    in_common_.clear();
    std::vector<std::size_t> around;  // of those that cross others
    std::size_t left = limits::most_meeting_boxes(candidates_.size());
    for (std::size_t c = 0; c < candidates_.size(); ++c) {
      around.clear();
      const Point p = candidates_[c].contour.edges.front().from;
      const bool all = tree.visit_meeting_while(geom::grown({p, p}, 2 * repair_), [&](std::uint32_t d) {
        if (left-- == 0) return false;
        if (d == c || !holds(d, c, p)) return true;
        ++depth_[c];
        if (crosses[d] != 0) around.push_back(d);
        if (by_[c] == kNone || placed(d).area() < placed(by_[c]).area()) by_[c] = d;
        return true;
      });
      if (!all) return false;
      ask(around.size() * around.size());
      for (std::size_t i = 0; i < around.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) in_common_.insert(std::minmax(around[i], around[j]));
    }
    return true;
  }

  /// Tells parts that were drawn over each other from a shape and lines on it. Whatever both hold would be a
  /// hole of one and covered by the other, so that two with such a thing in common cross.
  void tell_neighbours() {
    for (auto& [pair, meeting] : meetings_) {
      const auto [a, b] = pair;
      if (meeting.relation != Relation::crossing || depth_[a] != depth_[b] || depth_[a] % 2 != 0 ||
          in_common_.count(pair) > 0)
        continue;
      const double one = placed(a).area(), other = placed(b).area();
      if (std::min(one, other) > kMostOfLines * std::max(one, other) || shared(a, b) <= kMostShared)
        meeting.relation = Relation::neighbours;
    }
  }

  [[nodiscard]] bool holds(std::size_t d, std::size_t c, Point p) {
    const auto met = meetings_.find(std::minmax(c, d));
    if (met == meetings_.end()) return placed(d).contains(p);
    const bool d_first = d < c;
    return met->second.relation == (d_first ? Relation::second_in : Relation::first_in);
  }

  [[nodiscard]] bool is_hole(std::size_t c) const { return depth_[c] % 2 != 0 && depth_[by_[c]] % 2 == 0; }

  /// Returns the contours of each region, the outer one first.
  [[nodiscard]] std::vector<Group> shapes() const {
    std::vector<Group> of_outer(candidates_.size());
    for (std::size_t c = 0; c < candidates_.size(); ++c)
      if (!is_hole(c)) of_outer[c].push_back(c);
    for (std::size_t c = 0; c < candidates_.size(); ++c)
      if (is_hole(c)) of_outer[by_[c]].push_back(c);
    std::erase_if(of_outer, [](const Group& group) { return group.empty(); });
    return of_outer;
  }

  [[nodiscard]] Result<geom::Region> region_of(const Group& shape) const {
    std::vector<Contour> holes;
    for (std::size_t k = 1; k < shape.size(); ++k) holes.push_back(candidates_[shape[k]].contour.edges);
    return geom::make_region(candidates_[shape.front()].contour.edges, std::move(holes));
  }

  [[nodiscard]] std::vector<Group> faulty_regions() const {
    std::vector<char> meets(candidates_.size(), 0);
    for (const auto& [pair, meeting] : meetings_) meets[pair.first] = meets[pair.second] = 1;
    std::vector<Group> faulty;
    for (const Group& shape : shapes()) {
      // Contours that meet nothing were nested by their boxes and points alone, and lie as they seem to.
      if (std::count_if(shape.begin(), shape.end(), [&](std::size_t c) { return meets[c] != 0; }) == 0)
        continue;
      const auto region = region_of(shape);
      if (!region || geom::fault_of({*region})) faulty.push_back(shape);
    }
    return faulty;
  }

  void set_aside(const std::vector<Group>& shapes) {
    std::vector<char> gone(candidates_.size(), 0);
    for (const Group& shape : shapes)
      for (const std::size_t c : shape) put_aside(c, AsideReason::crosses_itself, shape), gone[c] = 1;
    keep_all_but(gone);
  }

  void make_regions() {
    for (const auto& [pair, meeting] : meetings_)
      if (meeting.relation == Relation::neighbours)
        made_.neighbours.push_back({candidates_[pair.first].contour.curves.front(),
                                    candidates_[pair.second].contour.curves.front(), meeting.at});
    for (const Group& shape : shapes()) {
      auto region = region_of(shape);
      if (!region) continue;
      const auto number = [&](const Contour& made, const LooseContour& from) {
        auto& curves = made_.curve_of_edge;
        if (made.front().to == from.edges.front().to && made.front().kind == from.edges.front().kind)
          curves.insert(curves.end(), from.curves.begin(), from.curves.end());
        else
          curves.insert(curves.end(), from.curves.rbegin(), from.curves.rend());
      };
      number(region->outer, candidates_[shape.front()].contour);
      for (std::size_t k = 1; k < shape.size(); ++k)
        number(region->holes[k - 1], candidates_[shape[k]].contour);
      made_.regions.push_back(*std::move(region));
    }
  }

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  struct Meeting {
    Point at;
    Relation relation = Relation::beside;
  };

  const std::vector<CurveOrigin>& origins_;
  MendLimits limits_;
  double repair_;
  std::vector<Candidate> candidates_;
  /// By contour: where it meets itself.
  std::vector<std::optional<Point>> itself_;
  std::map<std::pair<std::size_t, std::size_t>, Meeting> meetings_;
  /// By the ids of two contours.
  std::map<std::pair<std::size_t, std::size_t>, Known> known_;
  std::size_t next_id_ = 0;
  std::vector<std::size_t> by_, depth_;
  /// Pairs of contours that cross others and hold something together.
  std::set<std::pair<std::size_t, std::size_t>> in_common_;
  std::size_t work_ = kMostWork, relation_work_ = kLeastRelationWork;
  Settled made_;
};

}  // namespace

std::optional<Settled> settled_contours(std::vector<LooseContour> contours,
                                        const std::vector<CurveOrigin>& origins, const MendLimits& limits) {
  return Settling(std::move(contours), origins, limits).run();
}

}  // namespace lekalo::io
