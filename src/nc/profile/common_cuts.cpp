#include "common_cuts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "common_lines.hpp"
#include "common_stretch.hpp"
#include "lekalo/base/disjoint_sets.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/edge_distance.hpp"
#include "lekalo/geom/offset.hpp"

namespace lekalo::nc {
namespace {

using geom::Point;

/// Lines and rims of one cluster.
struct ClusterDrawing {
  std::vector<std::size_t> parts;  ///< ascending
  std::vector<CommonRim> rims;     ///< the outermost is the first
  std::vector<CommonLine> lines;
};

/// Finds an order in which nothing is cut of what is loose (step 5). It is found backwards: what is cut last
/// frees parts from the sheet, and before it only what borders on these may be cut, and so on inwards.
class ClusterOrder {
 public:
  ClusterOrder(ClusterDrawing& drawing, const Resolution& resolution)
      : drawing_(drawing), resolution_(resolution) {
    for (const std::size_t part : drawing.rims.front().held) is_held_[part] = true;
    split_parts_of_lines();
  }

  /// One cut: a line, or the rim of a pocket.
  struct Step {
    bool is_rim = false;
    std::size_t number = 0;  ///< among the rims or the lines of the drawing
    bool either_way = false;
  };

  std::vector<Step> find() {
    std::vector<bool> rim_left(drawing_.rims.size(), true);
    rim_left[0] = false;
    line_left_.assign(drawing_.lines.size(), true);
    std::vector<Step> backwards;
    while (true) {
      ask();
      std::optional<std::size_t> rim = next_rim(rim_left);
      std::optional<Step> line = rim ? std::nullopt : next_line();
      if (!rim && !line) {
        // All cuts that are left hang on by too little to be held: any order will do.
        const auto weak = std::find(line_left_.begin(), line_left_.end(), true);
        const auto pocket = std::find(rim_left.begin(), rim_left.end(), true);
        if (weak != line_left_.end())
          line = Step{false, static_cast<std::size_t>(weak - line_left_.begin()), true};
        else if (pocket != rim_left.end())
          rim = static_cast<std::size_t>(pocket - rim_left.begin());
        else
          break;
      }
      if (rim) {
        rim_left[*rim] = false;
        backwards.push_back({true, *rim, false});
        continue;
      }
      line_left_[line->number] = false;
      hold(drawing_.lines[line->number], is_held_);
      here_ = resolution_.mm(drawing_.lines[line->number].links.front().path.front().from);
      backwards.push_back(*line);
    }
    std::reverse(backwards.begin(), backwards.end());
    return backwards;
  }

 private:
  /// A line that frees parts in its middle that nothing else holds is cut stretch by stretch. Splitting is
  /// needed for all or none of the lines that cannot be held, so that it is tried before the search.
  void split_parts_of_lines() {
    std::map<std::size_t, bool> held = is_held_;
    std::vector<bool> left(drawing_.lines.size(), true);
    for (bool goes_on = true; goes_on;) {
      goes_on = false;
      std::optional<std::size_t> partly;
      for (std::size_t l = 0; l < drawing_.lines.size(); ++l) {
        if (!left[l]) continue;
        std::map<std::size_t, bool> then = held;
        if (can_be_last(drawing_.lines[l], then) || can_be_last(reversed_line(drawing_.lines[l]), then)) {
          left[l] = false, goes_on = true;
          hold(drawing_.lines[l], held);
          continue;
        }
        const auto& links = drawing_.lines[l].links;
        if (!partly && links.size() > 1 &&
            std::any_of(links.begin(), links.end(), [&](const CommonLine::Link& link) {
              return link.holds && (held[link.parts[0]] || held[link.parts[1]]);
            }))
          partly = l;
      }
      if (goes_on || !partly) continue;
      const CommonLine line = drawing_.lines[*partly];
      drawing_.lines[*partly].links.resize(1);
      for (std::size_t k = 1; k < line.links.size(); ++k)
        drawing_.lines.push_back({{line.links[k]}, line.runs_into});
      left.resize(drawing_.lines.size(), true);
      goes_on = true;
    }
  }

  static CommonLine reversed_line(CommonLine line) {
    line.reverse();
    return line;
  }

  /// Says whether each stretch borders on a part that is held when it is cut, if all that comes later is cut
  /// after it. Of the line itself, what comes later holds too.
  static bool can_be_last(const CommonLine& line, std::map<std::size_t, bool> held) {
    for (auto link = line.links.rbegin(); link != line.links.rend(); ++link) {
      if (!link->holds) continue;
      if (!held[link->parts[0]] && !held[link->parts[1]]) return false;
      held[link->parts[0]] = held[link->parts[1]] = true;
    }
    return true;
  }

  static void hold(const CommonLine& line, std::map<std::size_t, bool>& held) {
    for (const CommonLine::Link& link : line.links)
      if (link.holds) held[link.parts[0]] = held[link.parts[1]] = true;
  }

  /// A pocket comes as late as may be, because lines begin in it.
  [[nodiscard]] std::optional<std::size_t> next_rim(const std::vector<bool>& left) {
    std::optional<std::size_t> found;
    for (std::size_t r = 0; r < left.size() && !found; ++r) {
      const auto& parts = drawing_.rims[r].held;
      if (left[r] &&
          std::all_of(parts.begin(), parts.end(), [&](std::size_t part) { return is_held_[part]; }))
        found = r;
    }
    return found;
  }

  [[nodiscard]] std::optional<Step> next_line() {
    struct Rank {
      bool begins_in_scrap = true;
      std::size_t needed_by = 0;
      double way = 0;
      [[nodiscard]] bool operator<(const Rank& other) const {
        return std::tie(begins_in_scrap, needed_by, way) <
               std::tie(other.begins_in_scrap, other.needed_by, other.way);
      }
    };
    std::optional<Step> best;
    Rank least;
    for (std::size_t l = 0; l < drawing_.lines.size(); ++l) {
      if (!line_left_[l]) continue;
      ask();
      CommonLine& line = drawing_.lines[l];
      const bool forwards = can_be_last(line, is_held_),
                 backwards = can_be_last(reversed_line(line), is_held_);
      if (!forwards && !backwards) continue;
      if (!forwards) line.reverse();
      Rank rank{begins_in_scrap(line), 0, 0};
      for (std::size_t other = 0; other < drawing_.lines.size(); ++other)
        if (other != l && line_left_[other] && !begins_in_scrap(drawing_.lines[other]) &&
            runs_into(drawing_.lines[other], l))
          ++rank.needed_by;
      rank.way = std::min(geom::norm(resolution_.mm(line.links.front().path.front().from) - here_),
                          geom::norm(resolution_.mm(line.links.back().path.back().to) - here_));
      if (best && !(rank < least)) continue;
      best = Step{false, l, forwards && backwards};
      least = rank;
    }
    return best;
  }

  [[nodiscard]] static bool begins_in_scrap(const CommonLine& line) {
    return line.runs_into[0].empty() || line.runs_into[1].empty();
  }
  [[nodiscard]] static bool runs_into(const CommonLine& line, std::size_t other) {
    return std::any_of(line.runs_into.begin(), line.runs_into.end(), [&](const auto& into) {
      return std::find(into.begin(), into.end(), other) != into.end();
    });
  }

  ClusterDrawing& drawing_;
  Resolution resolution_;
  std::map<std::size_t, bool> is_held_;  ///< by part
  std::vector<bool> line_left_;
  Point here_;
};

std::vector<std::size_t> ascending(std::vector<std::size_t> parts) {
  std::sort(parts.begin(), parts.end());
  parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
  return parts;
}

std::vector<ClusterDrawing> clusters_of(CommonDrawing drawing, std::size_t parts) {
  DisjointSets together(parts);
  const auto number = [](std::size_t part) { return static_cast<std::uint32_t>(part); };
  for (const CommonLine& line : drawing.lines)
    for (const CommonLine::Link& link : line.links)
      together.join(number(link.parts[0]), number(link.parts[1]));
  std::map<std::uint32_t, ClusterDrawing> clusters;
  for (CommonRim& rim : drawing.rims) {
    ClusterDrawing& its = clusters[together.of(number(rim.parts.front()))];
    its.parts.insert(its.parts.end(), rim.parts.begin(), rim.parts.end());
    its.rims.push_back(std::move(rim));
  }
  std::map<std::size_t, std::pair<std::uint32_t, std::size_t>> new_number;
  for (std::size_t l = 0; l < drawing.lines.size(); ++l) {
    const std::uint32_t cluster = together.of(number(drawing.lines[l].links.front().parts[0]));
    new_number[l] = {cluster, clusters[cluster].lines.size()};
    clusters[cluster].lines.push_back(std::move(drawing.lines[l]));
  }
  std::vector<ClusterDrawing> made;
  for (auto& [first, cluster] : clusters) {
    for (CommonLine& line : cluster.lines)
      for (auto& into : line.runs_into) {
        std::vector<std::size_t> own;
        for (const std::size_t other : into)
          if (new_number.at(other).first == first) own.push_back(new_number.at(other).second);
        into = std::move(own);
      }
    cluster.parts = ascending(std::move(cluster.parts));
    // The outermost rim runs clockwise, and its area is the least, with its sign.
    const auto outermost =
        std::min_element(cluster.rims.begin(), cluster.rims.end(),
                         [](const CommonRim& a, const CommonRim& b) { return a.area < b.area; });
    std::iter_swap(cluster.rims.begin(), outermost);
    const auto covered = std::remove_if(cluster.rims.begin() + 1, cluster.rims.end(),
                                        [](const CommonRim& rim) { return rim.is_covered; });
    cluster.rims.erase(covered, cluster.rims.end());
    made.push_back(std::move(cluster));
  }
  return made;
}

/// The parts with the kerfs between them filled; pockets are holes.
Result<ProfilePart> filled(const std::vector<ProfilePart>& parts, const std::vector<std::size_t>& members,
                           const ProfileOptions& options) {
  std::vector<geom::Region> outlines;
  ProfilePart made;
  made.id = parts[members.front()].id;
  for (const std::size_t member : members) {
    outlines.push_back({parts[member].region.outer, {}});
    made.id = std::min(made.id, parts[member].id);
  }
  const double reach = 0.5 * options.kerf_mm + options.tolerance_mm;
  LEKALO_TRY(const auto grown, geom::offset(outlines, reach));
  LEKALO_TRY(const auto shrunk, geom::offset({{grown.regions.front().outer, {}}}, -reach));
  made.region = {shrunk.regions.front().outer, grown.regions.front().holes};
  return made;
}

std::vector<std::size_t> parts_along(const CommonLine& line) {
  std::vector<std::size_t> parts;
  for (const CommonLine::Link& link : line.links)
    parts.insert(parts.end(), link.parts.begin(), link.parts.end());
  return ascending(std::move(parts));
}

/// Says how far the ends of a common stretch are from half a kerf beside an outline. Between the ends it is
/// no more, because both are straight.
double off_half_kerf(const WrittenEdge& edge, const ProfilePart& part, const ProfileOptions& options) {
  const Resolution resolution = resolution_of(options);
  double off = 0;
  for (const WrittenPoint end : {edge.from, edge.to}) {
    double nearest = std::numeric_limits<double>::infinity();
    const Point at = resolution.mm(end);
    for (const geom::Edge& own : part.region.outer)
      nearest = std::min(nearest, geom::norm(geom::nearest_on(geom::make_curve(own), at) - at));
    off = std::max(off, std::abs(nearest - 0.5 * options.kerf_mm));
  }
  return off;
}

}  // namespace

Result<CommonCuts> take_common_cuts(std::vector<ProfilePart>& parts, std::vector<Cut>& cuts,
                                    const KerfProof& proof, const ProfileOptions& options) {
  CommonCuts made;
  const CommonStretches common = common_stretches(cuts, options);
  if (common.stretches.empty()) return made;
  made.shared_mm = common.length_mm;
  for (const CommonStretch& stretch : common.stretches)
    for (const std::size_t cut : stretch.cuts)
      made.off_mm = std::max(made.off_mm, off_half_kerf(stretch.edge, parts[cuts[cut].part], options));

  std::vector<bool> is_common(cuts.size(), false);
  for (const DividedOutline& outline : common.outlines) is_common[outline.cut] = true;
  std::vector<Cut> all;
  for (std::size_t c = 0; c < cuts.size(); ++c)
    if (!is_common[c]) all.push_back(cuts[c]);
  for (ClusterDrawing& cluster : clusters_of(common_drawing(cuts, common, proof, options), parts.size())) {
    LEKALO_TRY(ProfilePart whole, filled(parts, cluster.parts, options));
    const std::size_t part = parts.size();
    parts.push_back(std::move(whole));
    CommonCluster its;
    for (const ClusterOrder::Step& step : ClusterOrder(cluster, resolution_of(options)).find()) {
      its.inner.push_back(all.size());
      if (step.is_rim) {
        const CommonRim& rim = cluster.rims[step.number];
        all.push_back({part, false, 0, rim.path, ascending(rim.parts)});
        continue;
      }
      const CommonLine& line = cluster.lines[step.number];
      all.push_back({part, false, 0, line.path(), parts_along(line), true, step.either_way});
      ++made.lines;
    }
    its.outline = all.size();
    all.push_back({part, true, 0, cluster.rims.front().path, cluster.parts});
    made.clusters.push_back(std::move(its));
  }
  cuts = std::move(all);
  return made;
}

}  // namespace lekalo::nc
