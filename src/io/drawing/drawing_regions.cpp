#include "lekalo/io/drawing/drawing_regions.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "bezier.hpp"
#include "branches.hpp"
#include "contour_closing.hpp"
#include "contour_relation.hpp"
#include "contour_settling.hpp"
#include "curve_edges.hpp"
#include "curve_joins.hpp"
#include "curve_overlaps.hpp"
#include "io/text/decimal.hpp"
#include "layers.hpp"
#include "lekalo/base/counted.hpp"
#include "lekalo/base/disjoint_sets.hpp"
#include "lekalo/base/limits.hpp"
#include "lekalo/base/parallel.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/boolean.hpp"
#include "lekalo/geom/box_tree.hpp"
#include "lekalo/geom/curve_faces.hpp"
#include "lekalo/geom/edge_distance.hpp"
#include "lekalo/geom/region_check.hpp"
#include "near_edges.hpp"
#include "touching_ends.hpp"

namespace lekalo::io {
namespace {

using geom::Edge;
using geom::Point;

/// Rounds a sum of a few terms up.
constexpr double kSumsUp = 1 + 0x1p-48;
/// The most rounds of joining again after something was dropped or cut. Every round needs a new reason, so
/// that more than a few mean a drawing in which everything lies on everything.
constexpr int kMostRounds = 8;
/// The most curves that the sentence about a crowded place names.
constexpr std::size_t kMostNamed = 4;
/// The most kinds of curves, and shapes that were set aside, that are told one by one.
constexpr std::size_t kMostKinds = 8;
/// A chain whose ends are this near, mm, and far nearer than it is large, was meant to close.
constexpr double kWidestGap = 2;

std::string text(Point p) { return fmt::format("({:.9g}, {:.9g}) mm", p.x, p.y); }

/// One drawn curve after step 1: its edges, and what reading and moving did to it.
struct Worked {
  std::vector<Edge> edges;
  double curve_error = 0, moved = 0, repaired = 0, coordinate_error = 0;
  bool taken = false;   ///< on a layer that counts, and more than a point
  bool closed = false;  ///< a contour by itself
  [[nodiscard]] double total() const { return (curve_error + moved + repaired + coordinate_error) * kSumsUp; }
};

/// A curve of a chain, and whether the chain goes along it backwards.
struct Link {
  std::uint32_t curve = 0;
  bool backwards = false;
};
struct Chain {
  std::vector<Link> links;
  bool closed = false;
};

class Assembly {
 public:
  Assembly(const Drawing& drawing, const DrawingOptions& options) : drawing_(drawing), options_(options) {}

  Result<DrawnRegions> run() {
    LEKALO_CHECK(check_options());
    LEKALO_TRY(auto layers, choose_layers(drawing_, options_));
    result_.notices = std::move(layers.notices);
    LEKALO_CHECK(work_curves(layers.taken));
    drop_duplicates();
    LEKALO_CHECK(join());
    if (!options_.strict) resolve_branchings();
    make_chains();
    if (!options_.strict) bridge_gaps();
    LEKALO_CHECK(sort_out_open_chains());
    close_contours();
    if (!options_.strict) {
      trace_branches();
      close_at_touching_ends();
      list_covered();
    }
    if (contours_.empty()) return refuse(empty_sentence());
    LEKALO_CHECK(nest());
    if (!options_.strict) mark_small_faces();
    set_aside_contents();
    if (result_.regions.empty()) return refuse(empty_sentence());
    place_marks();
    account();
    report();
    return std::move(result_);
  }

 private:
  [[nodiscard]] tl::unexpected<Error> refuse(const std::string& sentence) const {
    return failure(ErrorCode::bad_input, fmt::format("{}: {}", drawing_.name, sentence));
  }
  [[nodiscard]] std::string name(std::uint32_t curve) const { return curve_name(drawing_, curve); }

  [[nodiscard]] Result<void> check_options() const {
    if (!(options_.join_tolerance >= 0) || !std::isfinite(options_.join_tolerance))
      return failure(ErrorCode::usage,
                     fmt::format("the join tolerance is {} mm; it must be 0 or more, and finite",
                                 options_.join_tolerance));
    if (!(options_.curve_tolerance > 0) || !std::isfinite(options_.curve_tolerance))
      return failure(ErrorCode::usage,
                     fmt::format("the curve tolerance is {} mm; it must be above 0, and finite",
                                 options_.curve_tolerance));
    if (!(options_.repair >= 0) || !std::isfinite(options_.repair))
      return failure(
          ErrorCode::usage,
          fmt::format("the size of repairs is {} mm; it must be 0 or more, and finite", options_.repair));
    return {};
  }

  // Step 1 of docs/design/drawing-regions.md: curves become edges.

  [[nodiscard]] Result<void> work_curves(const std::vector<bool>& taken) {
    worked_.resize(drawing_.curves.size());
    // Some curves are worked side by side, and looked at in order before the next are.
    constexpr std::size_t kAtATime = 4096;
    std::vector<std::optional<Result<CurveEdges>>> made_of(std::min(kAtATime, worked_.size()));
    std::atomic<std::size_t> edges = 0;
    const auto too_many = [&] { return edges > 2 * kMostCurves; };
    const auto work_from = [&](std::size_t first) {
      share_out(std::min(kAtATime, worked_.size() - first), kUsualThreads, [&](std::size_t k) {
        const DrawnCurve& drawn = drawing_.curves[first + k];
        if (!taken[drawn.layer] || too_many()) return;
        made_of[k] = edges_of(drawn.shape, options_.curve_tolerance);
        if (*made_of[k]) edges += (*made_of[k])->edges.size();
      });
    };
    for (std::uint32_t i = 0; i < worked_.size(); ++i) {
      const DrawnCurve& drawn = drawing_.curves[i];
      if (i % kAtATime == 0) work_from(i);
      if (too_many())
        return refuse(
            fmt::format("more than {} lines and arcs; use a larger curve tolerance", 2 * kMostCurves));
      if (!taken[drawn.layer]) continue;
      Result<CurveEdges> made = *std::move(made_of[i % kAtATime]);
      if (made && (!(drawn.error >= 0) || !std::isfinite(drawn.error)))
        made = failure(ErrorCode::bad_input, "has no known error");
      if (!made && options_.strict) return refuse(fmt::format("{} {}", name(i), made.error().message));
      if (!made) {
        result_.set_aside.push_back(
            {AsideReason::no_curve, {i}, {}, 0, {}, fmt::format("{} {}", name(i), made.error().message)});
        continue;
      }
      Worked& curve = worked_[i];
      curve.edges = std::move(made->edges);
      curve.curve_error = made->curve_error;
      curve.coordinate_error = (drawn.error + made->rounding) * kSumsUp;
      curve.taken = !curve.edges.empty();
      if (!curve.taken) {
        result_.specks.push_back(i);
        continue;
      }
      curve.closed = curve.edges.front().from == curve.edges.back().to;
    }
    return {};
  }

  void drop_duplicates() {
    std::vector<LaidCurve> laid(worked_.size());
    double largest = 0;
    for (std::size_t i = 0; i < worked_.size(); ++i) {
      laid[i].used = worked_[i].taken;
      if (!worked_[i].taken) continue;
      laid[i] = laid_curve(worked_[i].edges);
      const geom::Box& box = laid[i].box;
      largest = std::max(
          {largest, std::abs(box.low.x), std::abs(box.low.y), std::abs(box.high.x), std::abs(box.high.y)});
    }
    // Copies that are closer than rounding cannot be told apart, so the reach is never less than rounding.
    overlap_reach_ = std::max(options_.join_tolerance, geom::kEdgeDistanceError * largest);
    lying_ = curves_on_others(laid, overlap_reach_);
    // A way back along the curve before is a spike, which the outline needs to go on.
    if (!options_.strict)
      std::erase_if(lying_, [&](const LyingOn& one) {
        const Worked &curve = worked_[one.curve], &on = worked_[one.on];
        return drawing_.curves[one.curve].entity == drawing_.curves[one.on].entity && !curve.closed &&
               !on.closed &&
               (curve.edges.front().from == on.edges.back().to ||
                on.edges.front().from == curve.edges.back().to);
      });
    for (const LyingOn& one : lying_) {
      worked_[one.curve].taken = false;
      result_.duplicates.push_back(one.curve);
    }
    reach_.resize(worked_.size());
    for (std::size_t i = 0; i < worked_.size(); ++i) reach_[i] = laid[i].size;
  }

  // Steps 2 and 3: copies are removed, and ends are joined.

  [[nodiscard]] const Point& end_point(EndNumber end) const {
    const std::vector<Edge>& edges = worked_[end / 2].edges;
    return end % 2 == 0 ? edges.front().from : edges.back().to;
  }
  [[nodiscard]] bool is_open(std::size_t curve) const {
    return worked_[curve].taken && !worked_[curve].closed;
  }

  [[nodiscard]] Result<void> join() {
    for (int round = 0; round < kMostRounds; ++round) {
      ask(worked_.size());
      std::vector<OpenCurve> open(worked_.size());
      for (std::size_t i = 0; i < open.size(); ++i) {
        open[i].used = is_open(i);
        if (open[i].used)
          open[i] = {worked_[i].edges.front().from, worked_[i].edges.back().to, reach_[i], true};
      }
      joins_ = join_ends(open, options_.join_tolerance);
      if (joins_.crowded && !options_.strict) {
        // Whatever is drawn to meet is joined all the same; gaps stay.
        joins_ = join_ends(open, 0);
        break;
      }
      if (joins_.crowded)
        return refuse(
            fmt::format("more than {} loose ends of curves lie close together at {}, among them {}; use a "
                        "smaller join tolerance than {} mm",
                        kMostEndsNearby, text(end_point(*joins_.crowded)), name(*joins_.crowded / 2),
                        options_.join_tolerance));
      if (!drop_specks() && !cut_overlaps()) break;
    }
    if (!joins_.undecided.empty() && options_.strict)
      return refuse(crowd_sentence(end_point(joins_.undecided.front())));
    return {};
  }

  /// Drops curves that are no longer than the join tolerance and with which nothing is joined. Returns
  /// whether there were any.
  bool drop_specks() {
    bool dropped = false;
    for (std::uint32_t i = 0; i < worked_.size(); ++i) {
      if (!is_open(i) || !(reach_[i] <= options_.join_tolerance)) continue;
      if (joins_.partner[2 * i] != kNoEnd || joins_.partner[2 * i + 1] != kNoEnd) continue;
      worked_[i].taken = false;
      result_.specks.push_back(i);
      dropped = true;
    }
    return dropped;
  }

  bool cut_overlaps() {
    std::vector<LooseEnd> loose;
    for (std::uint32_t i = 0; i < worked_.size(); ++i) {
      if (!is_open(i) || worked_[i].edges.size() != 1 || worked_[i].edges[0].kind != geom::EdgeKind::line)
        continue;
      for (const bool at_end : {false, true})
        if (joins_.partner[2 * i + (at_end ? 1 : 0)] == kNoEnd)
          loose.push_back({i, at_end, worked_[i].edges[0]});
    }
    const auto overlaps = overlapping_ends(loose, overlap_reach_);
    for (const Overlap& overlap : overlaps) {
      const Point meet = end_point(2 * overlap.kept + (overlap.kept_at_end ? 1 : 0));
      Edge& cut = worked_[overlap.cut].edges[0];
      (overlap.cut_at_end ? cut.to : cut.from) = meet;
      worked_[overlap.cut].moved = std::max(worked_[overlap.cut].moved, overlap.distance);
      result_.duplicates.push_back(overlap.cut);
    }
    return !overlaps.empty();
  }

  [[nodiscard]] std::vector<EndNumber> ends_near(Point at) const {
    std::vector<EndNumber> found;
    for (EndNumber e = 0; e < 2 * worked_.size(); ++e)
      if (is_open(e / 2) && norm(end_point(e) - at) <= options_.join_tolerance) found.push_back(e);
    return found;
  }

  /// Returns the sentence for a place with ends of which it cannot be told which belong together.
  [[nodiscard]] std::string crowd_sentence(Point at) const {
    const auto ends = ends_near(at);
    std::string names;
    for (std::size_t i = 0; i < ends.size() && i < kMostNamed; ++i)
      names += (i > 0 ? "; " : "") + name(ends[i] / 2);
    if (ends.size() > kMostNamed) names += "; ...";
    return fmt::format(
        "{} ends of curves lie within {} mm of {}, where two belong to a contour: {}; remove what is too "
        "much, or leave "
        "out its layer, or use a smaller join tolerance",
        ends.size(), options_.join_tolerance, text(at), names);
  }

  // Step 3, continued: where three ends and more meet, curves that one element draws in a row belong
  // together, then two ends of one layer; the rest is a node, which the faces about it decide.

  void resolve_branchings() {
    const std::size_t n = worked_.size();
    std::vector<OpenCurve> open(n);
    for (std::size_t i = 0; i < n; ++i) {
      open[i].used = is_open(i);
      if (open[i].used)
        open[i] = {worked_[i].edges.front().from, worked_[i].edges.back().to, reach_[i], true};
    }
    const auto places = branchings(open, joins_, options_.join_tolerance);
    node_of_end_.assign(places.empty() ? 0 : 2 * n, kNoNode);
    if (places.empty()) return;
    const auto follows = [&](std::uint32_t i, std::uint32_t j) {
      return is_open(i) && is_open(j) && drawing_.curves[i].entity == drawing_.curves[j].entity &&
             end_point(2 * i + 1) == end_point(2 * j);
    };
    // By curve: the first of the row of curves that it stands in.
    std::vector<std::uint32_t> row(n);
    for (std::uint32_t i = 0; i < n; ++i) row[i] = i > 0 && follows(i - 1, i) ? row[i - 1] : i;
    const auto is_last = [&](std::uint32_t i) { return i + 1 == n || row[i + 1] != row[i]; };
    const auto goes_on = [&](EndNumber a, EndNumber b) {
      if (a % 2 == 0) std::swap(a, b);
      if (a % 2 == 0 || b % 2 != 0 || row[a / 2] != row[b / 2] || !(end_point(a) == end_point(b)))
        return false;
      return a / 2 + 1 == b / 2 || (b / 2 == row[a / 2] && is_last(a / 2));
    };
    for (std::uint32_t place = 0; place < places.size(); ++place) {
      ask(places[place].size());
      std::vector<EndNumber> left = places[place];
      for (const EndNumber end : left) joins_.partner[end] = kNoEnd;
      const auto join_if = [&](auto&& belong) {
        // A stable sort has brought those that may belong together next to each other.
        std::vector<EndNumber> rest;
        for (std::size_t i = 0; i < left.size();) {
          std::size_t end = i + 1;
          while (end < left.size() && belong(left[i], left[end])) ++end;
          if (end == i + 2)
            joins_.partner[left[i]] = left[i + 1], joins_.partner[left[i + 1]] = left[i];
          else
            rest.insert(rest.end(), left.begin() + static_cast<std::ptrdiff_t>(i),
                        left.begin() + static_cast<std::ptrdiff_t>(end));
          i = end;
        }
        left = std::move(rest);
      };
      std::stable_sort(left.begin(), left.end(),
                       [&](EndNumber a, EndNumber b) { return row[a / 2] < row[b / 2]; });
      // The ends of a row are in order: the last of one curve, the first of the next. What closes the row
      // stands at its ends.
      join_if(goes_on);
      for (std::size_t i = 0; i < left.size(); ++i) {
        std::size_t last = i;
        while (last + 1 < left.size() && row[left[last + 1] / 2] == row[left[i] / 2]) ++last;
        if (last > i && goes_on(left[i], left[last])) {
          joins_.partner[left[i]] = left[last], joins_.partner[left[last]] = left[i];
          left.erase(left.begin() + static_cast<std::ptrdiff_t>(last));
          left.erase(left.begin() + static_cast<std::ptrdiff_t>(i--));
        } else {
          i = last;
        }
      }
      const auto layer = [&](EndNumber end) { return drawing_.curves[end / 2].layer; };
      std::stable_sort(left.begin(), left.end(),
                       [&](EndNumber a, EndNumber b) { return layer(a) < layer(b); });
      join_if([&](EndNumber a, EndNumber b) { return layer(a) == layer(b); });
      if (left.size() == 2)
        joins_.partner[left[0]] = left[1], joins_.partner[left[1]] = left[0];
      else if (left.size() > 2)
        for (const EndNumber end : left) node_of_end_[end] = place;
    }
  }

  [[nodiscard]] std::uint32_t node_of(const Chain& chain, bool last) const {
    if (node_of_end_.empty()) return kNoNode;
    const Link& link = last ? chain.links.back() : chain.links.front();
    return node_of_end_[2 * link.curve + (link.backwards != last ? 1 : 0)];
  }

  /// The edges of a chain in its direction, gaps closed, and its ends moved to those of the node.
  [[nodiscard]] BranchChain branch_of(const Chain& chain) {
    BranchChain branch{{}, {}, node_of(chain, false), node_of(chain, true)};
    const auto moved = [this](std::uint32_t curve, double by) {
      worked_[curve].moved = std::max(worked_[curve].moved, by);
    };
    const auto bridge = [&](Point from, Point to, std::uint32_t curve, bool at_front) {
      moved(curve, norm(to - from) * kSumsUp);
      const Edge line{geom::EdgeKind::line, from, to, {}};
      branch.edges.insert(at_front ? branch.edges.begin() : branch.edges.end(), line);
      branch.curves.insert(at_front ? branch.curves.begin() : branch.curves.end(), curve);
    };
    for (const Link& link : chain.links) {
      const std::vector<Edge>& own = worked_[link.curve].edges;
      geom::Contour edges = link.backwards ? geom::reversed(own) : own;
      if (!branch.edges.empty() && !(branch.edges.back().to == edges.front().from)) {
        const Point to = branch.edges.back().to;
        if (const auto by = move_end(edges.front(), false, to))
          moved(link.curve, *by);
        else
          bridge(to, edges.front().from, link.curve, false);
      }
      branch.edges.insert(branch.edges.end(), edges.begin(), edges.end());
      branch.curves.resize(branch.edges.size(), link.curve);
    }
    for (const bool last : {false, true}) {
      const std::uint32_t node = last ? branch.end : branch.begin;
      if (node == kNoNode) continue;
      Edge& edge = last ? branch.edges.back() : branch.edges.front();
      const Point at = last ? edge.to : edge.from;
      const Point to = node_points_.emplace(node, at).first->second;
      if (at == to) continue;
      const std::uint32_t curve = last ? branch.curves.back() : branch.curves.front();
      if (const auto by = move_end(edge, last, to))
        moved(curve, *by);
      else if (last)
        bridge(at, to, curve, false);
      else
        bridge(to, at, curve, true);
    }
    std::size_t kept = 0;
    for (std::size_t k = 0; k < branch.edges.size(); ++k) {
      if (branch.edges[k].kind == geom::EdgeKind::line && branch.edges[k].from == branch.edges[k].to)
        continue;
      branch.edges[kept] = branch.edges[k], branch.curves[kept++] = branch.curves[k];
    }
    branch.edges.resize(kept), branch.curves.resize(kept);
    return branch;
  }

  void trace_branches() {
    if (branches_.empty()) return;
    Branches made = faces_of_branches(branches_, options_.repair, kWidestGap);
    for (const MovedCurve& one : made.bridged)
      worked_[one.curve].repaired = std::max(worked_[one.curve].repaired, one.moved);
    for (LooseContour& contour : made.contours) contours_.push_back(std::move(contour));
    add_marks(made.left);
    for (const std::vector<LooseEdge>& unclosed : made.unclosed) {
      SetAside aside{AsideReason::does_not_close, {}, {}, 0, unclosed.front().edge.from, {}};
      for (const LooseEdge& one : unclosed) {
        aside.edges.push_back(one.edge);
        aside.curves.push_back(one.curve);
        aside.tolerance = std::max(aside.tolerance, worked_[one.curve].total());
        worked_[one.curve].taken = false;
      }
      std::sort(aside.curves.begin(), aside.curves.end());
      aside.curves.erase(std::unique(aside.curves.begin(), aside.curves.end()), aside.curves.end());
      aside.sentence = fmt::format(
          "{} curves that hang together, the first {}, enclose nothing, though ends of them are within {:g} "
          "mm "
          "of each other; close the gap, or use a larger --join",
          aside.curves.size(), name(aside.curves.front()), kWidestGap);
      result_.set_aside.push_back(std::move(aside));
    }
  }

  /// Edges that follow each other become one mark.
  void add_marks(const std::vector<LooseEdge>& loose) {
    Mark* open = nullptr;
    for (const LooseEdge& one : loose) {
      if (open == nullptr || !(open->edges.back().to == one.edge.from)) open = &result_.marks.emplace_back();
      open->edges.push_back(one.edge);
      open->curve_of_edge.push_back(one.curve);
      open->tolerance = std::max(open->tolerance, worked_[one.curve].total());
    }
  }

  // Step 3, continued: joined curves make chains.

  [[nodiscard]] Point loose_end(const Chain& chain, bool last) const {
    const Link& link = last ? chain.links.back() : chain.links.front();
    return end_point(2 * link.curve + (link.backwards != last ? 1 : 0));
  }

  void make_chains() {
    std::vector<bool> chained(worked_.size(), false);
    for (std::uint32_t first = 0; first < worked_.size(); ++first) {
      if (!worked_[first].taken || chained[first]) continue;
      Chain chain;
      if (worked_[first].closed) {
        chain = {{{first, false}}, true};
      } else {
        const auto walk = [&](Link link, std::vector<Link>& links) {
          for (;;) {
            const EndNumber next = joins_.partner[2 * link.curve + (link.backwards ? 0 : 1)];
            if (next == kNoEnd) return false;
            link = {next / 2, next % 2 == 1};
            if (link.curve == first) return true;
            links.push_back(link);
          }
        };
        chain.links.push_back({first, false});
        chain.closed = walk({first, false}, chain.links);
        if (!chain.closed) {
          std::vector<Link> before;
          walk({first, true}, before);
          std::reverse(before.begin(), before.end());
          for (Link& link : before) link.backwards = !link.backwards;
          chain.links.insert(chain.links.begin(), before.begin(), before.end());
        }
      }
      for (const Link& link : chain.links) chained[link.curve] = true;
      chains_.push_back(std::move(chain));
    }
  }

  [[nodiscard]] bool is_whole(const Chain& chain) const {
    return !chain.closed && node_of(chain, false) == kNoNode && node_of(chain, true) == kNoNode;
  }
  [[nodiscard]] double reach_of(const Chain& chain) const {
    geom::Box box{loose_end(chain, false), loose_end(chain, false)};
    for (const Link& link : chain.links)
      for (const Edge& edge : worked_[link.curve].edges) box = joined(box, curve_box(geom::make_curve(edge)));
    return norm(box.high - box.low);
  }

  /// Closes chains over gaps of up to `repair`, one by itself or several in a ring, by the rule for ends that
  /// are near; a ring that does not close stays as it is. The gaps stay until contours are closed.
  void bridge_gaps() {
    std::vector<OpenCurve> open(chains_.size());
    for (std::size_t c = 0; c < chains_.size(); ++c) {
      open[c].used = is_whole(chains_[c]);
      if (open[c].used)
        open[c] = {loose_end(chains_[c], false), loose_end(chains_[c], true), reach_of(chains_[c]), true};
    }
    const CurveJoins joins = join_ends(open, options_.repair);
    if (joins.crowded) return;
    std::vector<char> gone(chains_.size(), 0);
    for (std::uint32_t first = 0; first < chains_.size(); ++first) {
      if (!open[first].used || gone[first] != 0) continue;
      std::vector<Link> ring{{first, false}};
      for (;;) {
        const EndNumber next = joins.partner[2 * ring.back().curve + (ring.back().backwards ? 0 : 1)];
        if (next == kNoEnd) ring.clear();
        if (next == kNoEnd || next / 2 == first) break;
        ring.push_back({next / 2, next % 2 == 1});
      }
      if (ring.empty()) continue;
      std::vector<Link> links;
      for (const Link& one : ring) {
        std::vector<Link> part = chains_[one.curve].links;
        if (one.backwards) {
          std::reverse(part.begin(), part.end());
          for (Link& link : part) link.backwards = !link.backwards;
        }
        links.insert(links.end(), part.begin(), part.end());
        gone[one.curve] = 1;
      }
      gone[first] = 0;
      chains_[first] = {std::move(links), true};
      open[first].used = false;
    }
    std::size_t kept = 0;
    for (std::size_t c = 0; c < chains_.size(); ++c)
      if (gone[c] == 0) std::swap(chains_[kept++], chains_[c]);
    chains_.resize(kept);
  }

  /// An outline with a gap that is small for it is set aside, rather than taken for a line on a part.
  [[nodiscard]] bool is_unclosed_outline(const Chain& chain) const {
    const double gap = norm(loose_end(chain, true) - loose_end(chain, false));
    return chain.links.size() > 1 && gap <= kWidestGap && 8 * gap <= reach_of(chain);
  }

  /// Closes an outline whose ends run past each other where they cross; what is behind are marks.
  bool close_where_ends_cross(const Chain& chain) {
    std::vector<Edge> edges;
    std::vector<std::uint32_t> curves;
    for (const Link& link : chain.links) {
      const std::vector<Edge>& own = worked_[link.curve].edges;
      edges.insert(edges.end(), own.begin(), own.end());
      curves.resize(edges.size(), link.curve);
    }
    const auto cut = geom::faces_between(edges);
    if (!cut || !(cut->corner_error <= options_.repair)) return false;
    // Beside the outline there may be the loops that its corners have, and what the ends make behind.
    const auto is_large = [](const geom::CutContour& one) {
      const geom::Box box = geom::bounds(one.contour);
      return norm(box.high - box.low) > kWidestGap;
    };
    if (std::count_if(cut->contours.begin(), cut->contours.end(), is_large) != 1) return false;
    double behind = 0;
    for (const geom::CutEdge& one : cut->left) behind += 2 * bisected(one.edge).half_length;
    if (!(behind <= 2 * kWidestGap)) return false;
    const auto number = [&](std::uint32_t edge) {
      worked_[curves[edge]].repaired = std::max(worked_[curves[edge]].repaired, cut->corner_error);
      return curves[edge];
    };
    std::vector<LooseEdge> left;
    for (const geom::CutContour& one : cut->contours) {
      if (!is_large(one)) {
        for (std::size_t k = 0; k < one.contour.size(); ++k)
          left.push_back({one.contour[k], number(one.origins[k])});
        continue;
      }
      LooseContour& closed = contours_.emplace_back(LooseContour{one.contour, {}});
      for (const std::uint32_t origin : one.origins) closed.curves.push_back(number(origin));
    }
    for (const geom::CutEdge& one : cut->left) left.push_back({one.edge, number(one.origin)});
    add_marks(left);
    return true;
  }

  void set_aside_unclosed(const Chain& chain) {
    const Point from = loose_end(chain, false), to = loose_end(chain, true);
    SetAside aside{AsideReason::does_not_close, {}, {}, 0, to, {}};
    for (const Link& link : chain.links) {
      Worked& curve = worked_[link.curve];
      const geom::Contour edges = link.backwards ? geom::reversed(curve.edges) : curve.edges;
      aside.edges.insert(aside.edges.end(), edges.begin(), edges.end());
      aside.curves.push_back(link.curve);
      aside.tolerance = std::max(aside.tolerance, curve.total());
      curve.taken = false;
    }
    aside.sentence = fmt::format(
        "the chain of {} curves that begins with {} does not close: from {} to {} there is a gap; --join "
        "{:.3g} "
        "would take it in",
        chain.links.size(), name(aside.curves.front()), text(to), text(from), norm(to - from) * 1.01 + 1e-6);
    std::sort(aside.curves.begin(), aside.curves.end());
    result_.set_aside.push_back(std::move(aside));
  }

  static geom::Contour frame_of(const geom::Contour& edges) {
    geom::Box box = curve_box(geom::make_curve(edges.front()));
    for (const Edge& edge : edges) box = joined(box, curve_box(geom::make_curve(edge)));
    const Point corners[] = {box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}};
    geom::Contour frame;
    for (std::size_t k = 0; k < 4; ++k)
      frame.push_back({geom::EdgeKind::line, corners[k], corners[(k + 1) % 4], {}});
    return frame;
  }

  /// Returns the boxes of marks of which loose ends are so near to each other that together they may be an
  /// outline that does not close: then nobody can tell a part in them from a hole.
  [[nodiscard]] std::vector<geom::Box> frames_of_marks() const {
    std::vector<geom::Box> ends, whole;
    for (const Mark& mark : result_.marks) {
      for (const Point end : {mark.edges.front().from, mark.edges.back().to})
        ends.push_back(geom::grown({end, end}, kWidestGap / 2));
      whole.push_back(curve_box(geom::make_curve(mark.edges.front())));
      for (const Edge& edge : mark.edges)
        whole.back() = joined(whole.back(), curve_box(geom::make_curve(edge)));
    }
    DisjointSets sets(whole.size());
    std::vector<char> meant(whole.size(), 0);
    std::size_t left = limits::most_meeting_boxes(ends.size());
    geom::BoxTree(ends).visit_pairs_while([&](std::uint32_t i, std::uint32_t j) {
      meant[i / 2] = meant[j / 2] = 1;
      sets.join(i / 2, j / 2);
      return --left > 0;
    });
    std::vector<geom::Box> frames;
    for (std::uint32_t i = 0; i < whole.size(); ++i)
      if (const std::uint32_t set = sets.of(i); set != i)
        whole[set] = joined(whole[set], whole[i]), meant[set] = 1;
    for (std::uint32_t i = 0; i < whole.size(); ++i)
      if (sets.of(i) == i && meant[i] != 0) frames.push_back(whole[i]);
    return frames;
  }

  /// Whatever lies in a contour that was set aside goes with it: its holes are no parts.
  void set_aside_contents() {
    std::vector<PlacedContour> contours;
    std::vector<geom::Box> boxes;
    for (const SetAside& aside : result_.set_aside) {
      if (aside.edges.empty()) continue;
      geom::Contour around;
      for (const Edge& edge : aside.edges) {
        // The gaps of an outline that does not close matter little here.
        if (!around.empty() && !(around.back().to == edge.from))
          around.push_back({geom::EdgeKind::line, around.back().to, edge.from, {}});
        around.push_back(edge);
      }
      if (!(around.back().to == around.front().from))
        around.push_back({geom::EdgeKind::line, around.back().to, around.front().from, {}});
      // Whatever is no contour at all counts with its box.
      if (!geom::make_region(around) || geom::fault_of({geom::Region{around, {}}})) around = frame_of(around);
      if (!geom::make_region(around)) continue;
      contours.emplace_back(around);
      boxes.push_back(contours.back().box());
    }
    const std::vector<geom::Box> frames = frames_of_marks();
    if (contours.empty() && frames.empty()) return;
    const geom::BoxTree tree(boxes), framed(frames);
    std::vector<geom::Region> kept;
    std::vector<std::uint32_t> curve_of_edge;
    std::size_t edge = 0;
    for (geom::Region& region : result_.regions) {
      const std::size_t first = edge;
      edge += geom::edges_in({region});
      const Point p = region.outer.front().from;
      const geom::Box box = geom::bounds(region.outer);
      const auto in_frame = [&](std::uint32_t i) {
        const geom::Box& frame = frames[i];
        return frame.low.x <= box.low.x && frame.low.y <= box.low.y && box.high.x <= frame.high.x &&
               box.high.y <= frame.high.y;
      };
      const bool outside = tree.visit_meeting_while({p, p}, [&](std::uint32_t i) {
        return !contours[i].contains(p);
      }) && framed.visit_meeting_while({p, p}, [&](std::uint32_t i) { return !in_frame(i); });
      const auto begin = result_.curve_of_edge.begin() + static_cast<std::ptrdiff_t>(first),
                 end = result_.curve_of_edge.begin() + static_cast<std::ptrdiff_t>(edge);
      if (outside) {
        curve_of_edge.insert(curve_of_edge.end(), begin, end);
        kept.push_back(std::move(region));
        continue;
      }
      SetAside aside{AsideReason::lies_in_another, {begin, end}, region.outer, 0, p, {}};
      for (const geom::Contour& hole : region.holes)
        aside.edges.insert(aside.edges.end(), hole.begin(), hole.end());
      std::sort(aside.curves.begin(), aside.curves.end());
      aside.curves.erase(std::unique(aside.curves.begin(), aside.curves.end()), aside.curves.end());
      for (const std::uint32_t curve : aside.curves) {
        aside.tolerance = std::max(aside.tolerance, worked_[curve].total());
        worked_[curve].taken = false;
      }
      aside.sentence =
          fmt::format("the contour that begins with {} lies at {} in one that does not close or is set aside",
                      name(aside.curves.front()), text(p));
      result_.set_aside.push_back(std::move(aside));
    }
    result_.regions = std::move(kept);
    result_.curve_of_edge = std::move(curve_of_edge);
  }

  [[nodiscard]] Result<void> sort_out_open_chains() {
    const auto open = static_cast<std::size_t>(
        std::count_if(chains_.begin(), chains_.end(), [](const Chain& c) { return !c.closed; }));
    if (open > 0 && options_.strict) {
      const Chain& chain =
          *std::find_if(chains_.begin(), chains_.end(), [](const Chain& c) { return !c.closed; });
      // A chain also stays open where its end would belong to a joint that is complete without it. Then the
      // crowd at that joint is the reason to name.
      for (const bool last : {false, true})
        if (ends_near(loose_end(chain, last)).size() > 1)
          return refuse(crowd_sentence(loose_end(chain, last)));
      return refuse(open_sentence(chain, open));
    }
    for (const Chain& chain : chains_) {
      ask(1 + chain.links.size());
      if (chain.closed) continue;
      if (node_of(chain, false) != kNoNode || node_of(chain, true) != kNoNode) {
        branches_.push_back(branch_of(chain));
        if (branches_.back().edges.empty()) branches_.pop_back();
        continue;
      }
      if (!options_.strict && is_unclosed_outline(chain)) {
        if (!close_where_ends_cross(chain)) set_aside_unclosed(chain);
        continue;
      }
      Mark mark;
      for (const Link& link : chain.links) {
        Worked& curve = worked_[link.curve];
        const geom::Contour edges = link.backwards ? geom::reversed(curve.edges) : curve.edges;
        mark.edges.insert(mark.edges.end(), edges.begin(), edges.end());
        mark.curve_of_edge.resize(mark.edges.size(), link.curve);
        mark.tolerance = std::max(mark.tolerance, curve.total());
        curve.taken = false;
      }
      result_.marks.push_back(std::move(mark));
    }
    std::erase_if(chains_, [](const Chain& chain) { return !chain.closed; });
    if (!result_.marks.empty() && !options_.strict) hang_loops_on_marks();
    return {};
  }

  /// Marks that lie in no contour, and of which ends lie on the inside of others, are contours around what
  /// they enclose together. In a contour they stay lines on it: strokes of letters enclose something too, and
  /// a bend from edge to edge cuts no part in two.
  void close_at_touching_ends() {
    if (result_.marks.empty()) return;
    std::vector<PlacedContour> around;
    std::vector<geom::Box> boxes;
    for (const LooseContour& contour : contours_) {
      if (!geom::make_region(contour.edges)) continue;
      around.emplace_back(contour.edges);
      boxes.push_back(around.back().box());
    }
    const geom::BoxTree tree(boxes);
    std::vector<OpenLine> lines;
    std::vector<std::size_t> mark_of_line;
    for (std::size_t i = 0; i < result_.marks.size(); ++i) {
      const Mark& mark = result_.marks[i];
      const Point p = bisected(mark.edges.front()).middle;
      if (!tree.visit_meeting_while({p, p}, [&](std::uint32_t c) { return !around[c].contains(p); }))
        continue;
      lines.push_back({mark.edges, mark.curve_of_edge, {}});
      for (const std::uint32_t curve : mark.curve_of_edge)
        lines.back().layers.push_back(drawing_.curves[curve].layer);
      mark_of_line.push_back(i);
    }
    std::vector<char> closed(result_.marks.size(), 0);
    std::vector<LooseEdge> left;
    for (TouchingLines& group :
         touching_lines(lines, std::min(options_.join_tolerance, options_.repair), 2 * options_.repair)) {
      for (const std::uint32_t line : group.lines) {
        closed[mark_of_line[line]] = 1;
        for (const std::uint32_t curve : lines[line].curves) {
          worked_[curve].taken = true;
          touching_.push_back(curve);
        }
      }
      for (const MovedCurve& one : group.moved)
        worked_[one.curve].repaired = std::max(worked_[one.curve].repaired, one.moved * kSumsUp);
      for (LooseContour& contour : group.contours) contours_.push_back(std::move(contour));
      left.insert(left.end(), group.left.begin(), group.left.end());
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < result_.marks.size(); ++i)
      if (closed[i] == 0) std::swap(result_.marks[kept++], result_.marks[i]);
    result_.marks.resize(kept);
    add_marks(left);
  }

  /// One of the curves that run along each other bounds a face; the others are listed as copies.
  void list_covered() {
    std::vector<char> covered(worked_.size(), 0);
    for (const BranchChain& branch : branches_)
      for (const std::uint32_t curve : branch.curves) covered[curve] = 1;
    for (const std::uint32_t curve : touching_) covered[curve] = 1;
    for (const LooseContour& contour : contours_)
      for (const std::uint32_t curve : contour.curves) covered[curve] = 0;
    for (const Mark& mark : result_.marks)
      for (const std::uint32_t curve : mark.curve_of_edge) covered[curve] = 0;
    for (std::uint32_t i = 0; i < worked_.size(); ++i) {
      if (covered[i] == 0 || !worked_[i].taken) continue;
      worked_[i].taken = false;
      result_.duplicates.push_back(i);
    }
  }

  /// Small loops that begin on a mark, and on no outline, are of the mark.
  void hang_loops_on_marks() {
    const auto less = [](const Point& a, const Point& b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); };
    const auto is_loop = [&](const Chain& chain) {
      return chain.links.size() == 1 && reach_[chain.links.front().curve] <= 2 * options_.repair;
    };
    std::vector<Point> of_marks, of_outlines;
    for (const Mark& mark : result_.marks) {
      of_marks.push_back(mark.edges.back().to);
      for (const Edge& edge : mark.edges) of_marks.push_back(edge.from);
    }
    for (const Chain& chain : chains_)
      if (!is_loop(chain))
        for (const Link& link : chain.links)
          for (const Edge& edge : worked_[link.curve].edges)
            of_outlines.push_back(edge.from), of_outlines.push_back(edge.to);
    for (const BranchChain& branch : branches_)
      for (const Edge& edge : branch.edges) of_outlines.push_back(edge.from), of_outlines.push_back(edge.to);
    std::sort(of_marks.begin(), of_marks.end(), less);
    std::sort(of_outlines.begin(), of_outlines.end(), less);
    std::erase_if(chains_, [&](const Chain& chain) {
      if (!is_loop(chain)) return false;
      Worked& curve = worked_[chain.links.front().curve];
      const Point at = curve.edges.front().from;
      if (!std::binary_search(of_marks.begin(), of_marks.end(), at, less) ||
          std::binary_search(of_outlines.begin(), of_outlines.end(), at, less))
        return false;
      result_.marks.push_back({curve.edges, {}, curve.total(), std::nullopt});
      result_.marks.back().curve_of_edge.assign(curve.edges.size(), chain.links.front().curve);
      curve.taken = false;
      return true;
    });
  }

  /// Returns the sentence for a drawing in which nothing is enclosed: what there is, by kind and layer.
  [[nodiscard]] std::string empty_sentence() const {
    if (drawing_.curves.empty()) return "there are no curves in the drawing" + unread_sentence();
    if (!result_.set_aside.empty())
      return fmt::format("nothing that the {} curves enclose can be taken: {}{}", drawing_.curves.size(),
                         result_.set_aside.front().sentence, unread_sentence());
    std::map<std::pair<std::uint32_t, std::string>, std::size_t> kinds;
    for (const DrawnCurve& curve : drawing_.curves)
      ++kinds[{curve.layer, drawing_.entities[curve.entity].type}];
    std::string counts;
    std::size_t named = 0;
    for (const auto& [kind, count] : kinds) {
      if (++named > kMostKinds) break;
      counts += fmt::format("{}{} of {} on layer {}", named > 1 ? ", " : "", count, kind.second,
                            excerpt(drawing_.layers[kind.first].name));
    }
    if (named > kMostKinds) counts += ", ...";
    std::string sentence =
        fmt::format("none of the {} curves closes a contour: {}", drawing_.curves.size(), counts);
    for (const std::string& notice : result_.notices) sentence += "; " + notice;
    return sentence + unread_sentence();
  }

  [[nodiscard]] std::string open_sentence(const Chain& chain, std::size_t count) const {
    const Point at = loose_end(chain, true), begin = loose_end(chain, false);
    const Link last = chain.links.back();
    const EndNumber end = 2 * last.curve + (last.backwards ? 0 : 1);
    double nearest = std::numeric_limits<double>::infinity();
    for (EndNumber e = 0; e < 2 * worked_.size(); ++e)
      if (is_open(e / 2) && e != end && joins_.partner[e] == kNoEnd)
        nearest = std::min(nearest, norm(end_point(e) - at));
    const auto dropped = result_.duplicates.size() + result_.specks.size();
    return fmt::format(
        "the chain of {} curves from {} to {} does not close: it ends with {}, and the nearest loose end is "
        "{:.6g} mm "
        "away (join tolerance {} mm){}{}; complete the drawing, use a larger join tolerance or leave open "
        "chains out",
        chain.links.size(), text(begin), text(at), name(last.curve), nearest, options_.join_tolerance,
        count > 1 ? fmt::format("; {} chains are open", count) : "",
        dropped > 0 ? "; dropped: " + counted(dropped, "curve that lies on another or is too short",
                                              "curves that lie on others or are too short")
                    : "");
  }

  // Steps 4 and 5: gaps are closed, contours are nested and checked.

  /// Draws a line across a gap that is a mend. Its points are no further than half of it from the curves.
  void bridge(LooseContour& contour, Point to) {
    const Point from = contour.edges.back().to;
    const double gap = norm(to - from) * kSumsUp;
    if (!(gap > options_.join_tolerance * kSumsUp) || options_.strict) return;
    const std::uint32_t curve = contour.curves.back();
    contour.edges.push_back({geom::EdgeKind::line, from, to, {}});
    contour.curves.push_back(curve);
    worked_[curve].repaired = std::max(worked_[curve].repaired, 0.5 * gap);
    result_.gaps.push_back({0.5 * (from + to), gap, {curve, curve}});
  }

  void close_contours() {
    for (const Chain& chain : chains_) {
      LooseContour contour;
      for (const Link& link : chain.links) {
        const std::vector<Edge>& edges = worked_[link.curve].edges;
        const geom::Contour turned = link.backwards ? geom::reversed(edges) : edges;
        if (!contour.edges.empty()) bridge(contour, turned.front().from);
        contour.edges.insert(contour.edges.end(), turned.begin(), turned.end());
        contour.curves.resize(contour.edges.size(), link.curve);
      }
      bridge(contour, contour.edges.front().from);
      const Closing closing = close_gaps(contour);
      for (const MovedCurve& one : closing.moved)
        worked_[one.curve].moved = std::max(worked_[one.curve].moved, one.moved);
      for (const ClosedGap& gap : closing.gaps) {
        // Decimals of 16 digits do not meet better than this even where they mean the same point.
        const double digits = geom::kEdgeDistanceError * (std::abs(gap.at.x) + std::abs(gap.at.y));
        if (gap.size > worked_[gap.before].coordinate_error + worked_[gap.after].coordinate_error + digits)
          result_.gaps.push_back({gap.at, gap.size, {gap.before, gap.after}});
      }
      if (contour.edges.empty()) {  // it was no longer than its gaps
        for (const Link& link : chain.links) {
          worked_[link.curve].taken = false;
          result_.specks.push_back(link.curve);
        }
        continue;
      }
      contours_.push_back(std::move(contour));
    }
  }

  [[nodiscard]] Result<void> nest() {
    if (options_.strict) return nest_as_they_are();
    // A drawing without a fault needs no more than this.
    std::vector<geom::Contour> contours;
    for (const LooseContour& contour : contours_) contours.push_back(contour.edges);
    if (auto nested = geom::nest_contours(std::move(contours))) {
      result_.regions = *std::move(nested);
      number_edges();
      return {};
    }
    std::vector<CurveOrigin> origins;
    for (const DrawnCurve& curve : drawing_.curves)
      origins.push_back({curve.entity, drawing_.entities[curve.entity].fill});
    auto settled = settled_contours(contours_, origins, {options_.join_tolerance, options_.repair});
    if (!settled) return nest_as_they_are();
    for (const MovedCurve& one : settled->moved)
      worked_[one.curve].repaired = std::max(worked_[one.curve].repaired, one.moved * kSumsUp);
    add_marks(settled->marks);
    for (AsideContour& one : settled->aside) set_aside(std::move(one));
    result_.duplicates.insert(result_.duplicates.end(), settled->dropped.begin(), settled->dropped.end());
    result_.regions = std::move(settled->regions);
    result_.curve_of_edge = std::move(settled->curve_of_edge);
    mends_ = settled->mends;
    neighbours_ = std::move(settled->neighbours);
    for (const Neighbours& one : settled->lines_on_others)
      result_.doubtful.push_back(
          fmt::format("the contour that begins with {} crosses that of {} at {}, and is taken for lines on "
                      "it; if it is to be "
                      "cut off, draw the outline so",
                      name(one.first), name(one.second), text(one.at)));
    std::vector<char> kept(worked_.size(), 0);
    for (const std::uint32_t curve : result_.curve_of_edge) kept[curve] = 1;
    for (const Mark& mark : result_.marks)
      for (const std::uint32_t curve : mark.curve_of_edge) kept[curve] = 1;
    for (const SetAside& aside : result_.set_aside)
      for (const std::uint32_t curve : aside.curves) kept[curve] = 1;
    for (const std::uint32_t curve : settled->dropped) kept[curve] = 1;
    for (std::uint32_t i = 0; i < worked_.size(); ++i)
      if (worked_[i].taken && kept[i] == 0) result_.cut_off.push_back(i);
    return {};
  }

  /// Contours that lines enclose only together are by-products of lines that run past each other where they
  /// are no larger or no wider than what is mended: their lines are marks. A circle of that size is a hole as
  /// it is drawn.
  void mark_small_faces() {
    std::vector<char> of_faces(worked_.size(), 0);
    for (const BranchChain& branch : branches_)
      for (const std::uint32_t curve : branch.curves) of_faces[curve] = 1;
    for (const std::uint32_t curve : touching_) of_faces[curve] = 1;
    std::vector<LooseEdge> marks;
    std::vector<std::uint32_t> curve_of_edge;
    std::vector<geom::Region> regions;
    std::size_t edge = 0;
    const auto stays = [&](const geom::Contour& contour, bool on_what_stays) {
      const std::size_t first = edge;
      edge += contour.size();
      bool of_faces_alone = true;
      for (std::size_t k = first; k < edge; ++k)
        of_faces_alone = of_faces_alone && of_faces[result_.curve_of_edge[k]] != 0;
      const bool kept =
          on_what_stays &&
          !(of_faces_alone && is_by_product(contour, {options_.join_tolerance, options_.repair}));
      for (std::size_t k = first; k < edge; ++k) {
        if (kept)
          curve_of_edge.push_back(result_.curve_of_edge[k]);
        else
          marks.push_back({contour[k - first], result_.curve_of_edge[k]});
      }
      return kept;
    };
    for (geom::Region& region : result_.regions) {
      const bool outer_stays = stays(region.outer, true);
      std::vector<geom::Contour> holes;
      for (geom::Contour& hole : region.holes)
        if (stays(hole, outer_stays)) holes.push_back(std::move(hole));
      if (outer_stays) regions.push_back({std::move(region.outer), std::move(holes)});
    }
    result_.regions = std::move(regions);
    result_.curve_of_edge = std::move(curve_of_edge);
    add_marks(marks);
  }

  void set_aside(AsideContour&& one) {
    SetAside aside{one.reason, one.contour.curves, std::move(one.contour.edges), 0, one.at, {}};
    std::sort(aside.curves.begin(), aside.curves.end());
    aside.curves.erase(std::unique(aside.curves.begin(), aside.curves.end()), aside.curves.end());
    const std::string which = fmt::format("the contour of {} curves that begins with {}", aside.curves.size(),
                                          name(aside.curves.front()));
    aside.sentence =
        one.other ? fmt::format(
                        "{} overlaps that of {} at {} by more than {:g} mm; move them apart, take them by "
                        "layers, or use a larger --repair",
                        which, name(*one.other), text(one.at), options_.repair)
                  : fmt::format(
                        "{} crosses itself at {} in a way that mends of up to {:g} mm do not undo; use a "
                        "larger --repair, or draw it anew there",
                        which, text(one.at), options_.repair);
    for (const std::uint32_t curve : aside.curves) {
      worked_[curve].taken = false;
      aside.tolerance = std::max(aside.tolerance, worked_[curve].total());
    }
    result_.set_aside.push_back(std::move(aside));
  }

  [[nodiscard]] Result<void> nest_as_they_are() {
    std::vector<geom::Contour> contours;
    for (const LooseContour& contour : contours_) {
      contours.push_back(contour.edges);
      auto made = geom::make_region(contour.edges);
      if (made) continue;
      return refuse(fmt::format("the contour of {} curves that begins with {} is none: {}",
                                contour.curves.size(), name(contour.curves.front()), made.error().message));
    }
    auto nested = geom::nest_contours(std::move(contours));
    if (!nested) return refuse(meeting_sentence(nested.error().message));
    result_.regions = *std::move(nested);
    number_edges();
    return {};
  }

  /// Returns the same fault in the drawing's words.
  [[nodiscard]] std::string meeting_sentence(const std::string& otherwise) const {
    std::vector<geom::Region> alone;
    std::vector<std::uint32_t> curves;
    for (const LooseContour& contour : contours_) {
      alone.push_back({contour.edges, {}});
      curves.insert(curves.end(), contour.curves.begin(), contour.curves.end());
    }
    const auto meeting = geom::first_meeting(alone);
    if (!meeting) return otherwise;
    const std::uint32_t a = curves[meeting->a], b = curves[meeting->b];
    if (a == b) return fmt::format("{} crosses or touches itself at {}", name(a), text(meeting->at));
    return fmt::format("{} and {} cross or touch at {}; outlines must be apart", name(a), name(b),
                       text(meeting->at));
  }

  /// Finds the contours again by their first points, which no two share.
  void number_edges() {
    struct Start {
      Point at;
      std::size_t contour = 0;
    };
    const auto less = [](const Point& a, const Point& b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); };
    std::vector<Start> starts;
    for (std::size_t c = 0; c < contours_.size(); ++c) starts.push_back({contours_[c].edges.front().from, c});
    std::sort(starts.begin(), starts.end(), [&](const Start& a, const Start& b) { return less(a.at, b.at); });
    const auto append = [&](const geom::Contour& contour) {
      const auto found = std::lower_bound(starts.begin(), starts.end(), contour.front().from,
                                          [&](const Start& s, const Point& p) { return less(s.at, p); });
      const LooseContour& loose = contours_[found->contour];
      auto& curves = result_.curve_of_edge;
      if (loose.edges.front() == contour.front())
        curves.insert(curves.end(), loose.curves.begin(), loose.curves.end());
      else
        curves.insert(curves.end(), loose.curves.rbegin(), loose.curves.rend());
    };
    for (const geom::Region& region : result_.regions) {
      append(region.outer);
      for (const geom::Contour& hole : region.holes) append(hole);
    }
  }

  /// Finds the region that each mark is on.
  void place_marks() {
    if (result_.marks.empty()) return;
    std::vector<geom::Box> boxes;
    for (const geom::Region& region : result_.regions) boxes.push_back(geom::bounds(region.outer));
    const geom::BoxTree tree(boxes);
    std::map<std::uint32_t, PlacedContour> placed;
    for (Mark& mark : result_.marks) {
      const Point p = bisected(mark.edges.front()).middle;
      tree.visit_meeting({p, p}, [&](std::uint32_t i) {
        auto at = placed.find(i);
        if (at == placed.end()) at = placed.emplace(i, PlacedContour(result_.regions[i].outer)).first;
        if (!at->second.contains(p)) return;
        if (!mark.region || at->second.area() < placed.at(*mark.region).area()) mark.region = i;
      });
    }
  }

  // Step 6: the account is drawn up.

  void account() {
    const auto count = [this](const Worked& curve) {
      result_.curve_tolerance = std::max(result_.curve_tolerance, curve.curve_error);
      result_.moved = std::max(result_.moved, curve.moved);
      result_.repaired = std::max(result_.repaired, curve.repaired);
      result_.coordinate_error = std::max(result_.coordinate_error, curve.coordinate_error);
      result_.tolerance = std::max(result_.tolerance, curve.total());
    };
    for (const Worked& curve : worked_)
      if (curve.taken) count(curve);
    for (const LyingOn& one : lying_) {
      // A copy of something that was left out is no part of the outlines.
      if (!worked_[one.on].taken) continue;
      Worked copy = worked_[one.curve];
      copy.moved = (one.distance + worked_[one.on].moved) * kSumsUp;
      count(copy);
    }
  }

  [[nodiscard]] std::string unread_sentence() const {
    std::string listed;
    for (std::size_t i = 0; i < drawing_.unread.size() && i < kMostNamed; ++i)
      listed += fmt::format("{}{} {}", i > 0 ? ", " : "", drawing_.unread[i].count, drawing_.unread[i].name);
    if (drawing_.unread.size() > kMostNamed) listed += ", ...";
    return listed.empty() ? "" : "; not read: " + listed;
  }

  void report() {
    std::sort(result_.duplicates.begin(), result_.duplicates.end());
    result_.duplicates.erase(std::unique(result_.duplicates.begin(), result_.duplicates.end()),
                             result_.duplicates.end());
    std::sort(result_.specks.begin(), result_.specks.end());
    auto& notices = result_.notices;
    if (!result_.gaps.empty()) {
      const auto widest = std::max_element(result_.gaps.begin(), result_.gaps.end(),
                                           [](const auto& a, const auto& b) { return a.size < b.size; });
      notices.push_back(fmt::format("{} closed, the widest of {:.3g} mm at {} after {}",
                                    counted(result_.gaps.size(), "gap"), widest->size, text(widest->at),
                                    name(widest->curves[0])));
    }
    if (!result_.duplicates.empty())
      notices.push_back(fmt::format(
          "{} dropped or cut, the first {}",
          counted(result_.duplicates.size(), "curve that lies on another", "curves that lie on others"),
          name(result_.duplicates.front())));
    if (!result_.specks.empty())
      notices.push_back(
          fmt::format("{} no longer than the join tolerance and in no contour dropped, the first {}",
                      counted(result_.specks.size(), "curve"), name(result_.specks.front())));
    if (mends_ > 0)
      notices.push_back(fmt::format(
          "{} mended; that moved outlines by {:.3g} mm at most",
          counted(mends_, "shape that crosses or touches itself", "shapes that cross or touch themselves"),
          result_.repaired));
    if (!neighbours_.empty())
      notices.push_back(fmt::format(
          "{}, and each is a part as it is drawn, the first that of {} and that of {} at {}",
          counted(neighbours_.size(), "pair of contours overlaps", "pairs of contours overlap"),
          name(neighbours_.front().first), name(neighbours_.front().second), text(neighbours_.front().at)));
    if (!result_.marks.empty())
      notices.push_back(fmt::format("{}, the first from {} to {}",
                                    counted(result_.marks.size(), "line that encloses nothing is a mark",
                                            "lines that enclose nothing are marks"),
                                    text(result_.marks.front().edges.front().from),
                                    text(result_.marks.front().edges.back().to)));
    for (std::size_t i = 0; i < result_.doubtful.size() && i < kMostKinds; ++i)
      notices.push_back(result_.doubtful[i]);
    if (result_.doubtful.size() > kMostKinds)
      notices.push_back(counted(result_.doubtful.size() - kMostKinds, "contour more crosses a far larger one",
                                "contours more cross far larger ones"));
    if (!drawing_.unread.empty()) notices.push_back(unread_sentence().substr(2));
  }

  const Drawing& drawing_;
  const DrawingOptions& options_;
  DrawnRegions result_;
  std::vector<Worked> worked_;
  std::vector<double> reach_;  ///< of every curve, mm
  double overlap_reach_ = 0;
  std::vector<LyingOn> lying_;
  CurveJoins joins_;
  std::vector<Chain> chains_;
  /// By end: the place where it meets two others and more; empty where there is none.
  std::vector<std::uint32_t> node_of_end_;
  std::map<std::uint32_t, Point> node_points_;
  std::vector<BranchChain> branches_;
  std::vector<std::uint32_t> touching_;  ///< curves of lines that close where they touch
  std::vector<LooseContour> contours_;
  std::size_t mends_ = 0;  ///< groups of contours that were mended
  std::vector<Neighbours> neighbours_;
};

}  // namespace

const char* word_of(AsideReason reason) noexcept {
  switch (reason) {
    case AsideReason::crosses_itself:
      return "crosses itself";
    case AsideReason::crosses_another:
      return "crosses another";
    case AsideReason::does_not_close:
      return "does not close";
    case AsideReason::lies_in_another:
      return "lies in another";
    case AsideReason::no_curve:
      break;
  }
  return "no curve";
}

void tell_set_aside(const std::vector<std::string>& sentences, std::vector<std::string>& notices) {
  constexpr std::size_t kMostTold = 1000;
  for (std::size_t i = 0; i < sentences.size() && i < kMostTold; ++i)
    notices.push_back("set aside: " + sentences[i]);
  if (sentences.size() > kMostTold)
    notices.push_back(fmt::format("set aside: {} more", sentences.size() - kMostTold));
}

Result<DrawnRegions> make_regions(const Drawing& drawing, const DrawingOptions& options) {
  return Assembly(drawing, options).run();
}

DrawingRecord record_of(const Drawing& drawing, const DrawingOptions& how, const DrawnRegions& drawn) {
  DrawingRecord record{how.take, how.join_tolerance, {}, {}, {}, 0};
  for (const Mark& mark : drawn.marks) {
    record.marks.insert(record.marks.end(), mark.edges.begin(), mark.edges.end());
    record.loose_error = std::max(record.loose_error, mark.tolerance);
  }
  for (const SetAside& aside : drawn.set_aside) {
    record.set_aside.insert(record.set_aside.end(), aside.edges.begin(), aside.edges.end());
    record.loose_error = std::max(record.loose_error, aside.tolerance);
  }
  for (const std::uint32_t curve : drawn.specks) {
    const Shape& shape = drawing.curves[curve].shape;
    if (const auto* edge = std::get_if<geom::Edge>(&shape)) record.specks.push_back(edge->from);
    if (const auto* arc = std::get_if<EllipseArc>(&shape)) record.specks.push_back(arc->from);
    if (const auto* spline = std::get_if<Spline>(&shape)) record.specks.push_back(spline->poles.front());
  }
  return record;
}

}  // namespace lekalo::io
