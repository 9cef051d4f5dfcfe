#include "common_lines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/box_tree.hpp"
#include "lekalo/geom/edge_distance.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::nc {
namespace {

using geom::EdgeKind;
using geom::Point;

/// A line goes over a gap of so many kerfs between two stretches: the middle of a crossing is one kerf wide
/// for right angles, and wider where parts meet aslant.
constexpr double kBridgeKerfs = 2.5;
/// Both lines at the end of a corner free it, if its arc turns by no more than this: half a kerf remains
/// between the corner and what is left of the sheet. A little above 120 degrees.
constexpr double kFreedTurn = 2.1;
/// A line that ends so near to another kerf goes on to its middle.
constexpr double kReachKerfs = 0.75;
constexpr double kAlongCosine = 0.9999;

constexpr std::size_t kNoRun = static_cast<std::size_t>(-1);

WrittenEdge line_of(WrittenPoint from, WrittenPoint to) { return {EdgeKind::line, from, to, {}}; }

WrittenEdge turned_round(WrittenEdge edge) {
  std::swap(edge.from, edge.to);
  return edge;
}

/// In units of the last decimal.
Point difference(WrittenPoint from, WrittenPoint to) {
  return {static_cast<double>(to.x - from.x), static_cast<double>(to.y - from.y)};
}

/// Joins lines that lie on one line to the last decimal. Products of whole numbers above 2^53 may be rounded
/// to the same one, when the lines are as good as one.
std::vector<WrittenEdge> straightened(const std::vector<WrittenEdge>& path) {
  std::vector<WrittenEdge> joined;
  for (const WrittenEdge& edge : path) {
    if (!joined.empty() && edge.kind == EdgeKind::line && joined.back().kind == EdgeKind::line) {
      WrittenEdge& last = joined.back();
      const Point along = difference(last.from, last.to), on = difference(edge.from, edge.to);
      if (along.x * on.y == along.y * on.x && geom::dot(along, on) > 0) {
        last.to = edge.to;
        continue;
      }
    }
    joined.push_back(edge);
  }
  return joined;
}

class CommonDrawer {
 public:
  CommonDrawer(const std::vector<Cut>& cuts, const CommonStretches& common, const KerfProof& proof,
               const ProfileOptions& options)
      : cuts_(cuts), common_(common), proof_(proof), options_(options), resolution_(resolution_of(options)) {}

  CommonDrawing draw() {
    make_rims();
    make_lines();
    extend_lines();
    return std::move(drawing_);
  }

 private:
  struct Run {
    std::size_t outline = 0, piece = 0, rim = kNoRun;
  };
  [[nodiscard]] const DividedOutline::Piece& piece(const Run& run) const {
    return common_.outlines[run.outline].pieces[run.piece];
  }
  [[nodiscard]] const DividedOutline::Piece& piece_after(const Run& run) const {
    const auto& pieces = common_.outlines[run.outline].pieces;
    return pieces[(run.piece + 1) % pieces.size()];
  }
  [[nodiscard]] std::size_t part_of(std::size_t outline) const {
    return cuts_[common_.outlines[outline].cut].part;
  }

  /// Follows the runs from part to part: where one ends at a stretch, the run of the other part begins that
  /// comes behind this stretch.
  void make_rims() {
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> run_behind;  // by stretch and outline
    for (std::size_t o = 0; o < common_.outlines.size(); ++o)
      for (std::size_t k = 0; k < common_.outlines[o].pieces.size(); ++k) {
        run_behind[{common_.outlines[o].pieces[k].stretch, o}] = runs_.size();
        runs_.push_back({o, k, kNoRun});
      }
    std::map<std::size_t, std::size_t> outline_of;  // by cut
    for (std::size_t o = 0; o < common_.outlines.size(); ++o) outline_of[common_.outlines[o].cut] = o;
    for (std::size_t first = 0; first < runs_.size(); ++first) {
      if (runs_[first].rim != kNoRun) continue;
      std::vector<std::size_t> chain;
      for (std::size_t r = first; runs_[r].rim == kNoRun;) {
        ask();
        runs_[r].rim = drawing_.rims.size();
        chain.push_back(r);
        const std::size_t stretch = piece_after(runs_[r]).stretch;
        const auto& both = common_.stretches[stretch].cuts;
        const std::size_t own = common_.outlines[runs_[r].outline].cut;
        r = run_behind.at({stretch, outline_of.at(both[0] == own ? both[1] : both[0])});
      }
      drawing_.rims.push_back(rim_of(chain));
    }
  }

  [[nodiscard]] bool is_corner(const WrittenEdge& edge) const {
    if (edge.kind != EdgeKind::arc_cw) return false;
    const geom::Edge arc = edge_mm(edge, resolution_);
    return std::abs(geom::arc_radius(arc) - 0.5 * options_.kerf_mm) <= options_.tolerance_mm &&
           geom::arc_sweep(arc) <= kFreedTurn;
  }

  [[nodiscard]] Point way_of(const WrittenEdge& edge) const {
    const Point along = resolution_.mm(edge.to) - resolution_.mm(edge.from);
    return (1 / geom::norm(along)) * along;
  }
  [[nodiscard]] double length_of_line(const WrittenEdge& edge) const {
    return geom::norm(resolution_.mm(edge.to) - resolution_.mm(edge.from));
  }
  [[nodiscard]] double longest_bridge() const { return kBridgeKerfs * options_.kerf_mm; }

  /// A run that goes straight from a stretch to the next on the same edge.
  [[nodiscard]] bool is_bridge(const Run& run) const {
    const std::vector<WrittenEdge>& edges = piece(run).run;
    return edges.size() == 1 && edges[0].kind == EdgeKind::line && edges[0].from == piece(run).edge.to &&
           edges[0].to == piece_after(run).edge.from && length_of_line(edges[0]) <= longest_bridge() &&
           geom::dot(way_of(edges[0]), way_of(piece(run).edge)) > kAlongCosine &&
           geom::dot(way_of(edges[0]), way_of(piece_after(run).edge)) > kAlongCosine;
  }
  [[nodiscard]] bool needs_no_cut(const Run& run) const {
    const std::vector<WrittenEdge>& edges = piece(run).run;
    return edges.empty() || (edges.size() == 1 && is_corner(edges[0])) || is_bridge(run);
  }

  [[nodiscard]] bool holds(const std::vector<WrittenEdge>& edges) const {
    return std::any_of(edges.begin(), edges.end(), [&](const WrittenEdge& edge) {
      return length_of_line({EdgeKind::line, edges.front().from, edge.to, {}}) >=
             kHoldingKerfs * options_.kerf_mm;
    });
  }

  CommonRim rim_of(const std::vector<std::size_t>& chain) const {
    CommonRim rim;
    std::vector<bool> ends_run;
    for (std::size_t k = 0; k < chain.size(); ++k) {
      const Run& run = runs_[chain[k]];
      rim.parts.push_back(part_of(run.outline));
      if (holds(piece(run).run)) rim.held.push_back(rim.parts.back());
      // A run begins where its own stretch ends, the run before where the other part's stretch begins; the
      // two are one place within the tolerance.
      const WrittenPoint begin = piece(run).edge.to;
      const WrittenPoint before = piece_after(runs_[chain[k == 0 ? chain.size() - 1 : k - 1]]).edge.from;
      if (before != begin) {
        rim.path.push_back(line_of(before, begin));
        ends_run.push_back(false);
      }
      for (const WrittenEdge& edge : piece(run).run) {
        rim.path.push_back(edge);
        ends_run.push_back(false);
      }
      if (!ends_run.empty()) ends_run.back() = true;
    }
    geom::Contour contour;
    for (const WrittenEdge& edge : rim.path) contour.push_back(edge_mm(edge, resolution_));
    rim.area = contour.empty() ? 0 : geom::signed_area(contour);
    rim.is_covered =
        std::all_of(chain.begin(), chain.end(), [&](std::size_t r) { return needs_no_cut(runs_[r]); });
    if (!rim.is_covered) cut_straight_over_ends(rim.path, ends_run);
    return rim;
  }

  /// The rim of two parts that end level would dip into the end of the line between them. It goes straight
  /// over it instead.
  void cut_straight_over_ends(std::vector<WrittenEdge>& path, std::vector<bool>& ends_run) const {
    const std::size_t n = path.size();
    std::vector<bool> gone(n, false);
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t next = (i + 1) % n;
      if (!ends_run[i] || gone[i] || gone[next] || !is_corner(path[i]) || !is_corner(path[next])) continue;
      const WrittenEdge over = line_of(path[i].from, path[next].to);
      const geom::Edge first = edge_mm(path[i], resolution_), second = edge_mm(path[next], resolution_);
      const Point into = -geom::perpendicular(first.from - first.centre),
                  out = -geom::perpendicular(second.to - second.centre);
      if (over.from == over.to || !(length_of_line(over) <= longest_bridge())) continue;
      if (!(geom::dot(way_of(over), into) > kAlongCosine * geom::norm(into)) ||
          !(geom::dot(way_of(over), out) > kAlongCosine * geom::norm(out)) || !proof_.stays_out({over}))
        continue;
      path[i] = over;
      gone[next] = true;
    }
    std::vector<WrittenEdge> kept;
    for (std::size_t i = 0; i < n; ++i)
      if (!gone[i]) kept.push_back(path[i]);
    path = straightened(kept);
  }

  /// All lines look one way, so that what goes on in a line is found ahead of it.
  [[nodiscard]] WrittenEdge looking_ahead(const WrittenEdge& edge) const {
    // Lines across this way would be told apart by rounding. No drawing has them.
    constexpr Point kAhead{0.9284767, 0.3713906};
    return geom::dot(way_of(edge), kAhead) >= 0 ? edge : turned_round(edge);
  }

  void make_lines() {
    std::vector<WrittenEdge> edges;
    std::vector<geom::Box> boxes;
    for (const CommonStretch& stretch : common_.stretches) {
      edges.push_back(looking_ahead(stretch.edge));
      const Point from = resolution_.mm(edges.back().from);
      boxes.push_back({from, from});
    }
    std::vector<WrittenEdge> rim_lines;
    std::vector<geom::Box> rim_boxes;
    for (const CommonRim& rim : drawing_.rims)
      for (const WrittenEdge& edge : rim.path) {
        if (rim.is_covered || edge.kind != EdgeKind::line) continue;
        rim_lines.push_back(edge);
        rim_boxes.push_back(geom::grown(geom::box_of(resolution_.mm(edge.from), resolution_.mm(edge.to)),
                                        options_.tolerance_mm));
      }
    const geom::BoxTree rim_tree(rim_boxes);
    // A rim that is cut anyway has the way between two stretches, so that no line goes over it.
    const auto goes_along_rim = [&](const WrittenEdge& bridge) {
      const Point from = resolution_.mm(bridge.from), to = resolution_.mm(bridge.to), way = way_of(bridge);
      return !rim_tree.visit_meeting_while(geom::box_of(from, to), [&](std::uint32_t i) {
        const Point a = resolution_.mm(rim_lines[i].from), b = resolution_.mm(rim_lines[i].to);
        if (!(std::abs(geom::cross(way, a - from)) <= 2 * options_.tolerance_mm) ||
            !(std::abs(geom::cross(way, b - from)) <= 2 * options_.tolerance_mm))
          return true;
        const double first = geom::dot(a - from, way), last = geom::dot(b - from, way);
        return !(std::min(std::max(first, last), geom::norm(to - from)) -
                     std::max(std::min(first, last), 0.0) >
                 0.25 * options_.kerf_mm);
      });
    };
    const geom::BoxTree tree(boxes);
    std::vector<std::size_t> next(edges.size(), kNoRun);
    std::vector<bool> follows(edges.size(), false);
    for (std::size_t s = 0; s < edges.size(); ++s) {
      const Point end = resolution_.mm(edges[s].to), way = way_of(edges[s]);
      double least = longest_bridge();
      tree.visit_meeting(geom::grown({end, end}, longest_bridge()), [&](std::uint32_t t) {
        if (t == s || follows[t]) return;
        const Point gap = resolution_.mm(edges[t].from) - end;
        const double ahead = geom::dot(gap, way);
        if (!(std::abs(geom::cross(way, gap)) <= options_.tolerance_mm) ||
            !(geom::dot(way, way_of(edges[t])) > kAlongCosine) || !(ahead >= -options_.tolerance_mm) ||
            !(ahead <= least))
          return;
        const WrittenEdge bridge = line_of(edges[s].to, edges[t].from);
        if (bridge.from != bridge.to && (!proof_.stays_out({bridge}) || goes_along_rim(bridge))) return;
        least = ahead, next[s] = t;
      });
      if (next[s] != kNoRun) follows[next[s]] = true;
    }
    for (std::size_t s = 0; s < edges.size(); ++s) {
      if (follows[s]) continue;
      CommonLine line;
      for (std::size_t at = s; at != kNoRun; at = next[at]) {
        const auto& both = common_.stretches[at].cuts;
        line.links.push_back({{edges[at]}, {cuts_[both[0]].part, cuts_[both[1]].part}, holds({edges[at]})});
        if (next[at] != kNoRun && edges[at].to != edges[next[at]].from)
          line.links.back().path.push_back(line_of(edges[at].to, edges[next[at]].from));
      }
      drawing_.lines.push_back(std::move(line));
    }
  }

  /// A line of the drawing, for what another runs into.
  struct Obstacle {
    WrittenEdge edge;
    std::size_t line = kNoRun;  ///< of a rim otherwise
  };

  /// Lines go on to the middle of the kerf that they run into, so that they begin in it.
  void extend_lines() {
    std::vector<Obstacle> obstacles;
    for (const CommonRim& rim : drawing_.rims)
      if (!rim.is_covered)
        for (const WrittenEdge& edge : rim.path)
          if (edge.kind == EdgeKind::line) obstacles.push_back({edge, kNoRun});
    for (std::size_t l = 0; l < drawing_.lines.size(); ++l)
      for (const CommonLine::Link& link : drawing_.lines[l].links)
        for (const WrittenEdge& edge : link.path) obstacles.push_back({edge, l});
    std::vector<geom::Box> boxes;
    for (const Obstacle& o : obstacles)
      boxes.push_back(geom::grown(geom::box_of(resolution_.mm(o.edge.from), resolution_.mm(o.edge.to)),
                                  options_.tolerance_mm));
    const geom::BoxTree tree(boxes);
    for (std::size_t l = 0; l < drawing_.lines.size(); ++l) {
      CommonLine& line = drawing_.lines[l];
      for (const bool at_end : {false, true}) {
        const WrittenEdge last =
            at_end ? line.links.back().path.back() : turned_round(line.links.front().path.front());
        const std::optional<WrittenPoint> on = end_in_kerf(l, last, obstacles, tree, line.runs_into[at_end]);
        if (!on || *on == last.to) continue;
        if (at_end)
          line.links.back().path.push_back(line_of(last.to, *on));
        else
          line.links.front().path.insert(line.links.front().path.begin(), line_of(*on, last.to));
      }
    }
  }

  /// The place on the nearest other cut ahead of this edge's end.
  [[nodiscard]] std::optional<WrittenPoint> end_in_kerf(std::size_t own, const WrittenEdge& last,
                                                        const std::vector<Obstacle>& obstacles,
                                                        const geom::BoxTree& tree,
                                                        std::vector<std::size_t>& runs_into) const {
    const Point end = resolution_.mm(last.to), way = way_of(last);
    const double reach = kReachKerfs * options_.kerf_mm, near = options_.tolerance_mm;
    double least = reach;
    std::optional<WrittenPoint> place;
    std::vector<std::pair<double, std::size_t>> met;
    tree.visit_meeting(geom::grown(geom::box_of(end, end + reach * way), near), [&](std::uint32_t i) {
      if (obstacles[i].line == own) return;
      const Point from = resolution_.mm(obstacles[i].edge.from),
                  along = resolution_.mm(obstacles[i].edge.to) - from;
      const double aslant = geom::cross(way, along) / geom::norm(along);
      if (!(std::abs(aslant) > 0.3)) return;
      const double ahead = geom::cross(from - end, along) / geom::cross(way, along);
      const double share = geom::cross(from - end, way) / geom::cross(way, along) * geom::norm(along);
      if (!(ahead >= -near && ahead <= reach && share >= -near && share <= geom::norm(along) + near)) return;
      if (obstacles[i].line != kNoRun) met.emplace_back(ahead, obstacles[i].line);
      if (ahead < least) least = ahead, place = resolution_.rounded(end + std::max(0.0, ahead) * way);
    });
    if (!place) return place;
    if (*place != last.to && !proof_.stays_out({line_of(last.to, *place)})) return std::nullopt;
    for (const auto& [ahead, line] : met)
      if (ahead <= least + near) runs_into.push_back(line);
    std::sort(runs_into.begin(), runs_into.end());
    runs_into.erase(std::unique(runs_into.begin(), runs_into.end()), runs_into.end());
    return place;
  }

  const std::vector<Cut>& cuts_;
  const CommonStretches& common_;
  const KerfProof& proof_;
  const ProfileOptions& options_;
  Resolution resolution_;
  std::vector<Run> runs_;
  CommonDrawing drawing_;
};

}  // namespace

std::vector<WrittenEdge> CommonLine::path() const {
  std::vector<WrittenEdge> all;
  for (const Link& link : links) all.insert(all.end(), link.path.begin(), link.path.end());
  return straightened(all);
}

void CommonLine::reverse() {
  std::reverse(links.begin(), links.end());
  for (Link& link : links) {
    std::reverse(link.path.begin(), link.path.end());
    for (WrittenEdge& edge : link.path) edge = turned_round(edge);
  }
  std::swap(runs_into[0], runs_into[1]);
}

CommonDrawing common_drawing(const std::vector<Cut>& cuts, const CommonStretches& common,
                             const KerfProof& proof, const ProfileOptions& options) {
  return CommonDrawer(cuts, common, proof, options).draw();
}

}  // namespace lekalo::nc
