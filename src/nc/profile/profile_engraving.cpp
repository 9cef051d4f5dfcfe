#include "profile_engraving.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <utility>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/box_tree.hpp"
#include "lekalo/geom/region_index.hpp"
#include "profile_words.hpp"

namespace lekalo::nc {
namespace {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;

/// Beyond so many lines of one part they stay in the order of the drawing.
constexpr std::size_t kMostLinesSorted = 2000;

/// An edge in two halves. Written arcs have at most half a turn.
struct HalvedEdge {
  Edge first, second;
  Point middle;
  double half_length = 0;  ///< no less than that of each half
};

HalvedEdge halved(const Edge& edge) {
  HalvedEdge halves{edge, edge, 0.5 * (edge.from + edge.to), 0.5 * geom::norm(edge.to - edge.from)};
  if (edge.kind != EdgeKind::line) {
    const double radius = geom::norm(edge.from - edge.centre);
    Point out = geom::perpendicular(edge.to - edge.from);
    if (edge.kind == EdgeKind::arc_ccw) out = -out;
    halves.middle = edge.centre + (radius / geom::norm(out)) * out;
    halves.half_length = radius * geom::arc_sweep(edge);
  }
  halves.first.to = halves.second.from = halves.middle;
  return halves;
}

/// Says whether every point of an edge lies on the wanted side of a contour, but for kMarkSlack. Edges are
/// halved until that is seen.
bool keeps_side(const geom::RegionIndex& index, const Edge& edge, bool inside) {
  std::vector<Edge> open{edge};
  while (!open.empty()) {
    ask();
    const HalvedEdge halves = halved(open.back());
    open.pop_back();
    const double apart = index.nearest(halves.middle).distance;
    const bool is_right = index.contains(halves.middle) == inside;
    if (!is_right && apart > kMarkSlack) return false;
    if ((is_right && apart > halves.half_length) || apart + halves.half_length <= kMarkSlack ||
        halves.half_length <= 0.25 * kMarkSlack)
      continue;
    open.push_back(halves.first);
    open.push_back(halves.second);
  }
  return true;
}

/// Knows where a mark may run: within the outline of its part, and in no other part that lies in a hole.
class MarkGround {
 public:
  explicit MarkGround(const std::vector<ProfilePart>& parts) : parts_(parts), outlines_(parts.size()) {
    std::vector<geom::Box> boxes;
    for (const ProfilePart& part : parts) boxes.push_back(geom::bounds(part.region.outer));
    tree_ = std::make_unique<geom::BoxTree>(boxes);
  }

  bool admits(std::size_t part, const Edge& edge) {
    if (!keeps_side(outline_of(part), edge, true)) return false;
    const geom::Box box = geom::curve_box(geom::make_curve(edge));
    return tree_->visit_meeting_while(box, [&](std::uint32_t other) {
      return other == part || keeps_side(material_of(other), edge, false);
    });
  }

 private:
  using Index = std::unique_ptr<geom::RegionIndex>;

  const geom::RegionIndex& outline_of(std::size_t part) {
    Index& index = outlines_[part];
    if (!index)
      index = std::make_unique<geom::RegionIndex>(std::vector<geom::Region>{{parts_[part].region.outer, {}}});
    return *index;
  }
  const geom::RegionIndex& material_of(std::size_t part) {
    if (materials_.empty()) materials_.resize(parts_.size());
    Index& index = materials_[part];
    if (!index) index = std::make_unique<geom::RegionIndex>(std::vector<geom::Region>{parts_[part].region});
    return *index;
  }

  const std::vector<ProfilePart>& parts_;
  std::vector<Index> outlines_, materials_;
  std::unique_ptr<geom::BoxTree> tree_;
};

std::vector<WrittenEdge> reversed_path(const std::vector<WrittenEdge>& path) {
  std::vector<WrittenEdge> back(path.rbegin(), path.rend());
  for (WrittenEdge& edge : back) {
    std::swap(edge.from, edge.to);
    if (edge.kind != EdgeKind::line)
      edge.kind = edge.kind == EdgeKind::arc_ccw ? EdgeKind::arc_cw : EdgeKind::arc_ccw;
  }
  return back;
}

/// Appends the lines of one part, each next the one that begins or ends nearest to where the tool is.
void append_by_nearness(std::vector<std::vector<WrittenEdge>> lines, const Resolution& resolution,
                        Point& here, std::vector<std::vector<WrittenEdge>>& to) {
  const bool is_sorted = lines.size() <= kMostLinesSorted;
  std::reverse(lines.begin(), lines.end());  // so that the first is taken off at the end
  while (!lines.empty()) {
    ask(1 + lines.size() / 16);
    std::size_t next = lines.size() - 1;
    bool from_end = false;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = is_sorted ? 0 : next; i < lines.size(); ++i) {
      const double begin = geom::norm(resolution.mm(lines[i].front().from) - here),
                   end = geom::norm(resolution.mm(lines[i].back().to) - here);
      if (begin < least) least = begin, next = i, from_end = false;
      if (end < least) least = end, next = i, from_end = true;
    }
    std::vector<WrittenEdge> line = from_end ? reversed_path(lines[next]) : std::move(lines[next]);
    here = resolution.mm(line.back().to);
    to.push_back(std::move(line));
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(next));
  }
}

}  // namespace

EngravedPaths engraved_paths(const std::vector<ProfilePart>& parts, const ProfileOptions& options) {
  EngravedPaths made;
  if (!options.engraving) return made;
  const Resolution resolution = resolution_of(options);
  MarkGround ground(parts);
  Point here;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    std::vector<std::vector<WrittenEdge>> lines;
    for (std::size_t m = 0; m < parts[p].marks.size(); ++m) {
      std::vector<std::vector<WrittenEdge>> of_mark;
      bool is_admitted = true;
      for (const geom::Contour& line : parts[p].marks[m].lines) {
        std::vector<WrittenEdge> path = written_edges(line, resolution);
        if (path.empty()) continue;
        is_admitted = is_admitted && std::all_of(path.begin(), path.end(), [&](const WrittenEdge& edge) {
                        return ground.admits(p, edge_mm(edge, resolution));
                      });
        of_mark.push_back(std::move(path));
      }
      if (!is_admitted) {
        made.left_out.push_back({p, m});
        continue;
      }
      ++made.marks;
      std::move(of_mark.begin(), of_mark.end(), std::back_inserter(lines));
    }
    std::vector<std::vector<WrittenEdge>> sorted;
    append_by_nearness(std::move(lines), resolution, here, sorted);
    std::move(sorted.begin(), sorted.end(), std::back_inserter(made.paths));
  }
  return made;
}

// The words of engravings stand here, beside what they are of.

void ProfileWriter::begin_engraving() {
  const double speed = options_.engraving->speed;
  comment(fmt::format("marks{}", out_.feed(options_.engraving->feed_mm_per_min, 2)));
  if (options_.process == Process::router && !has_tool_of_marks() && speed > 0 && speed != options_.speed)
    out_.line(fmt::format("M3 S{:.0f}", speed));
}

void ProfileWriter::engrave(const std::vector<WrittenEdge>& path) {
  const Engraving& how = *options_.engraving;
  rapid_to(path.front().from);
  if (options_.process == Process::router) {
    out_.line("G1 Z" + length(-how.depth_mm) + out_.feed(options_.plunge_mm_per_min, 2));
    follow(path, how.feed_mm_per_min, true);
    out_.line("G0 Z" + length(options_.safe_height_mm));
    return;
  }
  out_.line(
      fmt::format("{}{}", options_.post.laser_on, how.speed > 0 ? fmt::format(" S{:.0f}", how.speed) : ""));
  follow(path, how.feed_mm_per_min, true);
  out_.line("M5");
}

void ProfileWriter::end_engraving() {
  if (options_.process != Process::router) return;
  const double speed = options_.engraving->speed;
  if (has_tool_of_marks()) {
    out_.line("M5");
    start_router(options_.tool, options_.speed);
  } else if (speed > 0 && speed != options_.speed) {
    out_.line(fmt::format("M3 S{:.0f}", options_.speed));
  }
}

}  // namespace lekalo::nc
