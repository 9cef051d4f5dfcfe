#include "engraving.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <set>
#include <utility>

#include "io/drawing/layers.hpp"
#include "io/text/decimal.hpp"
#include "lekalo/base/counted.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/box_tree.hpp"
#include "lekalo/geom/containment.hpp"

namespace lekalo::io {
namespace {

using geom::Box;
using geom::Contour;
using geom::Point;
using geom::Region;

/// Letters are no higher and no wider than this, mm; a row of them has this many or more.
constexpr double kHighestLetter = 20;
constexpr std::size_t kFewestLetters = 3;
/// Letters of a row are no further apart than the higher one is high, and from a quarter to four times as
/// high as each other: full stops and capitals are among them.
constexpr double kHighestShare = 4;

bool holds(const Box& box, Point p) {
  return box.low.x <= p.x && p.x <= box.high.x && box.low.y <= p.y && p.y <= box.high.y;
}

/// An outer contour or a hole of one of the regions.
struct Loop {
  const Contour* contour = nullptr;
  std::uint32_t region = 0, curve = 0;
  bool is_hole = false, filled = false, engraved = false, is_cut = false;
  Box box;
  /// The innermost loop around it, -1 for none.
  std::ptrdiff_t around = -1;
};

class Rules {
 public:
  Rules(const Drawing& drawing, const DrawnRegions& drawn, const std::vector<bool>& said_to_be_cut)
      : drawing_(drawing), drawn_(drawn) {
    std::size_t edge = 0;
    for (std::uint32_t r = 0; r < drawn.regions.size(); ++r) {
      const auto add = [&](const Contour& contour, bool is_hole) {
        const std::uint32_t curve = drawn.curve_of_edge[edge];
        edge += contour.size();
        const bool is_cut = said_to_be_cut[drawing.curves[curve].layer];
        const bool filled = !is_cut && drawing.entities[drawing.curves[curve].entity].filled;
        loops_.push_back({&contour, r, curve, is_hole, filled, false, is_cut, geom::bounds(contour), -1});
      };
      outer_of_.push_back(loops_.size());
      add(drawn.regions[r].outer, false);
      for (const Contour& hole : drawn.regions[r].holes) add(hole, true);
    }
  }

  Engraved run() {
    find_surroundings();
    engrave_what_is_filled();
    engrave_rows_of_letters();
    // All that lies within an engraved line is engraved with it. Loops around others come to rest first.
    for (const std::size_t i : from_outside_)
      if (loops_[i].around >= 0 && loops_[static_cast<std::size_t>(loops_[i].around)].engraved)
        loops_[i].engraved = true;
    return sorted_out();
  }

 private:
  /// Says if an outer contour begins in the box of another, as most do not.
  [[nodiscard]] bool may_lie_in_others() const {
    std::vector<Box> boxes;
    for (const std::size_t outer : outer_of_) boxes.push_back(loops_[outer].box);
    const geom::BoxTree tree(boxes);
    for (std::uint32_t r = 0; r < outer_of_.size(); ++r) {
      const Point p = loops_[outer_of_[r]].contour->front().from;
      if (!tree.visit_meeting_while({p, p}, [&](std::uint32_t other) { return other == r; })) return true;
    }
    return false;
  }

  /// A hole lies in the outer contour of its region; an outer contour in the innermost hole around it.
  /// Contours that meet may seem to lie in each other, so other outer contours are passed on the way.
  void find_surroundings() {
    std::vector<geom::Enclosed> enclosed(loops_.size());
    if (may_lie_in_others()) {
      std::vector<const Contour*> contours;
      for (const Loop& loop : loops_) contours.push_back(loop.contour);
      enclosed = geom::enclosed_contours(contours);
    }
    for (std::size_t i = 0; i < loops_.size(); ++i) {
      Loop& loop = loops_[i];
      std::size_t around = loop.is_hole ? outer_of_[loop.region] : enclosed[i].by;
      while (!loop.is_hole && around != geom::kNoContour && !loops_[around].is_hole)
        around = enclosed[around].by;
      if (around != geom::kNoContour) loop.around = static_cast<std::ptrdiff_t>(around);
    }
    const auto size = [&](std::size_t i) {
      const Point d = loops_[i].box.high - loops_[i].box.low;
      return d.x * d.y;
    };
    for (std::size_t i = 0; i < loops_.size(); ++i) from_outside_.push_back(i);
    std::stable_sort(from_outside_.begin(), from_outside_.end(),
                     [&](std::size_t a, std::size_t b) { return size(a) > size(b); });
  }

  /// Rule 1: what is filled, beside lines that are not, and holds none of them.
  void engrave_what_is_filled() {
    if (std::all_of(loops_.begin(), loops_.end(), [](const Loop& l) { return l.filled; })) return;
    std::vector<bool> holds_line(loops_.size(), false);
    for (auto i = from_outside_.rbegin(); i != from_outside_.rend(); ++i) {
      const Loop& loop = loops_[*i];
      if (loop.around >= 0 && (!loop.filled || holds_line[*i]))
        holds_line[static_cast<std::size_t>(loop.around)] = true;
    }
    for (std::size_t i = 0; i < loops_.size(); ++i)
      if (loops_[i].filled && !holds_line[i]) loops_[i].engraved = true;
  }

  [[nodiscard]] bool may_be_letter(const Loop& loop) const {
    const Point size = loop.box.high - loop.box.low;
    return loop.is_hole && !loop.is_cut && !loop.engraved && size.x <= kHighestLetter &&
           size.y <= kHighestLetter;
  }

  [[nodiscard]] static bool are_neighbours(const Loop& a, const Loop& b) {
    const double high_a = a.box.high.y - a.box.low.y, high_b = b.box.high.y - b.box.low.y;
    const double higher = std::max(high_a, high_b);
    if (!(higher <= kHighestShare * std::min(high_a, high_b))) return false;
    const double beside = std::max(a.box.low.x - b.box.high.x, b.box.low.x - a.box.high.x);
    const double above = std::max(a.box.low.y - b.box.high.y, b.box.low.y - a.box.high.y);
    return beside <= higher && above <= 0;
  }

  /// Rule 2: a row of small cut-outs in one plate, one of which holds an island that would fall out.
  void engrave_rows_of_letters() {
    std::vector<std::vector<std::size_t>> letters(drawn_.regions.size());
    std::vector<bool> has_island(loops_.size(), false);
    for (const Loop& loop : loops_)
      if (!loop.is_hole && loop.around >= 0) has_island[static_cast<std::size_t>(loop.around)] = true;
    for (std::size_t i = 0; i < loops_.size(); ++i)
      if (may_be_letter(loops_[i])) letters[loops_[i].region].push_back(i);
    for (const auto& of_plate : letters) {
      std::vector<bool> seen(of_plate.size(), false);
      for (std::size_t seed = 0; seed < of_plate.size(); ++seed) {
        if (seen[seed] || !has_island[of_plate[seed]]) continue;
        std::deque<std::size_t> open{seed};
        std::vector<std::size_t> row;
        seen[seed] = true;
        for (; !open.empty(); open.pop_front()) {
          ask(of_plate.size());
          row.push_back(of_plate[open.front()]);
          for (std::size_t k = 0; k < of_plate.size(); ++k)
            if (!seen[k] && are_neighbours(loops_[row.back()], loops_[of_plate[k]]))
              seen[k] = true, open.push_back(k);
        }
        if (row.size() < kFewestLetters) continue;
        for (const std::size_t letter : row) loops_[letter].engraved = true;
      }
    }
  }

  /// The colour of a loop, or its layer where it has none.
  [[nodiscard]] const std::string& look(const Loop& loop) const {
    const Layer& layer = drawing_.layers[drawing_.curves[loop.curve].layer];
    return layer.colour.empty() ? layer.name : layer.colour;
  }

  [[nodiscard]] std::string doubt() const {
    std::vector<std::uint32_t> parts;  // their first curves
    std::set<std::string> looks;       // of the holes around them
    for (const std::size_t outer : outer_of_) {
      const Loop& part = loops_[outer];
      if (part.engraved || part.around < 0) continue;
      const std::string& hole = look(loops_[static_cast<std::size_t>(part.around)]);
      if (hole != look(part)) parts.push_back(part.curve), looks.insert(hole);
    }
    if (parts.empty()) return "";
    std::string words;
    for (const std::string& one : looks) words += (words.empty() ? "" : ", ") + excerpt(one);
    return fmt::format(
        "{}: {} drawn in {}, the first is {}; if that is only engraved, name the others as the layers to "
        "take",
        drawing_.name, counted(parts.size(), "part lies in a hole", "parts lie in holes"), words,
        curve_name(drawing_, parts.front()));
  }

  Engraved sorted_out() {
    Engraved out;
    out.doubt = doubt();
    std::size_t edge = 0, loop = 0;
    for (const Region& region : drawn_.regions) {
      const bool stays = !loops_[loop].engraved;
      out.new_number.push_back(stays ? static_cast<std::uint32_t>(out.regions.size()) : kNoRegion);
      if (stays) out.regions.push_back({region.outer, {}});
      for (std::size_t k = 0; k <= region.holes.size(); ++k, ++loop) {
        const Contour& contour = *loops_[loop].contour;
        const auto first = drawn_.curve_of_edge.begin() + static_cast<std::ptrdiff_t>(edge);
        edge += contour.size();
        if (loops_[loop].engraved) {
          out.lines.push_back({contour, loops_[loop].curve});
          continue;
        }
        if (k > 0) out.regions.back().holes.push_back(contour);
        out.curve_of_edge.insert(out.curve_of_edge.end(), first,
                                 first + static_cast<std::ptrdiff_t>(contour.size()));
      }
    }
    return out;
  }

  const Drawing& drawing_;
  const DrawnRegions& drawn_;
  std::vector<Loop> loops_;
  std::vector<std::size_t> outer_of_, from_outside_;
};

}  // namespace

Engraved without_engraving(const Drawing& drawing, const DrawnRegions& drawn,
                           const std::vector<bool>& said_to_be_cut) {
  return Rules(drawing, drawn, said_to_be_cut).run();
}

RegionsAround::RegionsAround(const std::vector<Region>& regions) {
  for (const Region& region : regions)
    outers_.push_back({geom::bounds(region.outer), std::abs(geom::signed_area(region.outer)),
                       geom::RegionIndex(std::vector<Region>{{region.outer, {}}})});
}

std::uint32_t RegionsAround::innermost(Point p) const {
  std::uint32_t found = kNoRegion;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < outers_.size(); ++i) {
    if (!holds(outers_[i].box, p) || !(outers_[i].area < least) || !outers_[i].index.contains(p)) continue;
    found = i;
    least = outers_[i].area;
  }
  return found;
}

}  // namespace lekalo::io
