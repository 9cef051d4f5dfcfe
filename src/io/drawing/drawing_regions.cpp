#include "lekalo/io/drawing/drawing_regions.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "bezier.hpp"
#include "contour_closing.hpp"
#include "curve_edges.hpp"
#include "curve_joins.hpp"
#include "curve_overlaps.hpp"
#include "layers.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/boolean.hpp"
#include "lekalo/geom/edge_distance.hpp"
#include "lekalo/geom/region_check.hpp"

namespace lekalo::io {
namespace {

using geom::Edge;
using geom::Point;

/// Rounds a sum of a few terms up.
constexpr double kUp = 1 + 0x1p-48;
/// The most rounds of joining again after something was dropped or cut. Every round needs a new reason, so
/// that more than a few mean a drawing in which everything lies on everything.
constexpr int kMostRounds = 8;
/// The most curves that the sentence about a crowded place names.
constexpr std::size_t kMostNamed = 4;

std::string text(Point p) { return fmt::format("({:.9g}, {:.9g}) mm", p.x, p.y); }

/// One drawn curve after step 1: its edges, and what reading and moving did to it.
struct Worked {
  std::vector<Edge> edges;
  double curve_error = 0, moved = 0, coordinate_error = 0;
  bool taken = false;   ///< on a layer that counts, and more than a point
  bool closed = false;  ///< a contour by itself
  [[nodiscard]] double total() const { return (curve_error + moved + coordinate_error) * kUp; }
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
    make_chains();
    LEKALO_CHECK(sort_out_open_chains());
    close_contours();
    LEKALO_CHECK(nest());
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
    return {};
  }

  // Step 1 of docs/design/drawing-regions.md: curves become edges.

  [[nodiscard]] Result<void> work_curves(const std::vector<bool>& taken) {
    worked_.resize(drawing_.curves.size());
    std::size_t edges = 0;
    for (std::uint32_t i = 0; i < worked_.size(); ++i) {
      const DrawnCurve& drawn = drawing_.curves[i];
      if (!taken[drawn.layer]) continue;
      auto made = edges_of(drawn.shape, options_.curve_tolerance);
      if (!made) return refuse(fmt::format("{} {}", name(i), made.error().message));
      if (!(drawn.error >= 0) || !std::isfinite(drawn.error))
        return refuse(fmt::format("{} has no known error", name(i)));
      edges += made->edges.size();
      if (edges > 2 * kMostCurves)
        return refuse(
            fmt::format("more than {} lines and arcs; use a larger curve tolerance", 2 * kMostCurves));
      Worked& curve = worked_[i];
      curve.edges = std::move(made->edges);
      curve.curve_error = made->curve_error;
      curve.coordinate_error = (drawn.error + made->rounding) * kUp;
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
      if (joins_.crowded)
        return refuse(
            fmt::format("more than {} loose ends of curves lie close together at {}, among them {}; use a "
                        "smaller join tolerance than {} mm",
                        kMostEndsNearby, text(end_point(*joins_.crowded)), name(*joins_.crowded / 2),
                        options_.join_tolerance));
      if (!drop_specks() && !cut_overlaps()) break;
    }
    if (!joins_.undecided.empty()) return refuse(crowd_sentence(end_point(joins_.undecided.front())));
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

  [[nodiscard]] Result<void> sort_out_open_chains() {
    const auto open = static_cast<std::size_t>(
        std::count_if(chains_.begin(), chains_.end(), [](const Chain& c) { return !c.closed; }));
    if (open > 0 && !options_.leave_open_chains) {
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
      OpenChain listed{loose_end(chain, false), loose_end(chain, true), {}};
      for (const Link& link : chain.links) {
        listed.curves.push_back(link.curve);
        worked_[link.curve].taken = false;
      }
      result_.open_chains.push_back(std::move(listed));
    }
    std::erase_if(chains_, [](const Chain& chain) { return !chain.closed; });
    if (!chains_.empty()) return {};
    if (drawing_.curves.empty()) return refuse("there are no curves in the drawing" + unread_sentence());
    return refuse(fmt::format("none of the {} curves closes a contour{}", drawing_.curves.size(),
                              result_.notices.empty() ? "" : "; " + result_.notices.front()));
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
        dropped > 0 ? fmt::format("; {} curves that lie on others or are too short were dropped", dropped)
                    : "");
  }

  // Steps 4 and 5: gaps are closed, contours are nested and checked.

  void close_contours() {
    for (const Chain& chain : chains_) {
      LooseContour contour;
      for (const Link& link : chain.links) {
        const std::vector<Edge>& edges = worked_[link.curve].edges;
        if (link.backwards) {
          const geom::Contour turned = geom::reversed(edges);
          contour.edges.insert(contour.edges.end(), turned.begin(), turned.end());
        } else {
          contour.edges.insert(contour.edges.end(), edges.begin(), edges.end());
        }
        contour.curves.resize(contour.edges.size(), link.curve);
      }
      const Closing closing = close_gaps(contour);
      for (const MovedCurve& one : closing.moved)
        worked_[one.curve].moved = std::max(worked_[one.curve].moved, one.moved);
      for (const ClosedGap& gap : closing.gaps) {
        // Decimals of 16 digits do not meet better than this even where they mean the same point.
        const double digits = geom::kEdgeDistanceError * (std::abs(gap.at.x) + std::abs(gap.at.y));
        if (gap.size > worked_[gap.before].coordinate_error + worked_[gap.after].coordinate_error + digits)
          result_.gaps.push_back({gap.at, gap.size, {gap.before, gap.after}});
      }
      contours_.push_back(std::move(contour));
    }
  }

  [[nodiscard]] Result<void> nest() {
    std::vector<geom::Contour> contours;
    for (const LooseContour& contour : contours_) {
      contours.push_back(contour.edges);
      auto made = geom::make_region(contour.edges);
      if (made) continue;
      const std::uint32_t first = chains_[contours.size() - 1].links.front().curve;
      return refuse(fmt::format("the contour of {} curves that begins with {} is none: {}",
                                chains_[contours.size() - 1].links.size(), name(first),
                                made.error().message));
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

  // Step 6: the account is drawn up.

  void account() {
    const auto count = [this](const Worked& curve) {
      result_.curve_tolerance = std::max(result_.curve_tolerance, curve.curve_error);
      result_.moved = std::max(result_.moved, curve.moved);
      result_.coordinate_error = std::max(result_.coordinate_error, curve.coordinate_error);
      result_.tolerance = std::max(result_.tolerance, curve.total());
    };
    for (const Worked& curve : worked_)
      if (curve.taken) count(curve);
    for (const LyingOn& one : lying_) {
      // A copy of something that was left out is no part of the outlines.
      if (!worked_[one.on].taken) continue;
      Worked copy = worked_[one.curve];
      copy.moved = (one.distance + worked_[one.on].moved) * kUp;
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
      notices.push_back(fmt::format("{} gaps closed, the widest of {:.3g} mm at {} after {}",
                                    result_.gaps.size(), widest->size, text(widest->at),
                                    name(widest->curves[0])));
    }
    if (!result_.duplicates.empty())
      notices.push_back(fmt::format("{} curves that lie on others dropped or cut, the first {}",
                                    result_.duplicates.size(), name(result_.duplicates.front())));
    if (!result_.specks.empty())
      notices.push_back(fmt::format(
          "{} curves that are no longer than the join tolerance and belong to no contour dropped, "
          "the first {}",
          result_.specks.size(), name(result_.specks.front())));
    if (!result_.open_chains.empty())
      notices.push_back(fmt::format("{} chains of curves that do not close left out, the first from {} to {}",
                                    result_.open_chains.size(), text(result_.open_chains.front().from),
                                    text(result_.open_chains.front().to)));
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
  std::vector<LooseContour> contours_;
};

}  // namespace

Result<DrawnRegions> make_regions(const Drawing& drawing, const DrawingOptions& options) {
  return Assembly(drawing, options).run();
}

DrawingRecord record_of(const Drawing& drawing, const DrawingOptions& how, const DrawnRegions& drawn) {
  DrawingRecord record{how.take, how.join_tolerance, {}};
  for (const std::uint32_t curve : drawn.specks) {
    const Shape& shape = drawing.curves[curve].shape;
    if (const auto* edge = std::get_if<geom::Edge>(&shape)) record.set_aside.push_back(edge->from);
    if (const auto* arc = std::get_if<EllipseArc>(&shape)) record.set_aside.push_back(arc->from);
    if (const auto* spline = std::get_if<Spline>(&shape)) record.set_aside.push_back(spline->poles.front());
  }
  return record;
}

}  // namespace lekalo::io
