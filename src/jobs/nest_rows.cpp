#include "nest_rows.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "lekalo/geom/grid_region.hpp"
#include "lekalo/layout/completeness.hpp"

namespace lekalo::jobs {
namespace {

using geom::GridPoint;
using layout::Document;
using layout::Part;
using layout::Placement;

/// Rows of up to so many parts are tried.
constexpr std::array<std::size_t, 4> kRowLengths{1, 2, 4, 1000};
/// Each trial is a search of so many candidate places, enough for a first layout and some of its faults.
constexpr std::uint64_t kTrialWork = 100'000;
/// Rows may take so much more of the stock than no rows.
constexpr double kMostMaterial = 1.01;

geom::GridRotation quarter_turns(int quarters) { return geom::rotation_from_degrees(90.0 * (quarters % 4)); }

std::vector<GridPoint> outer_loop(const Part& part) {
  const geom::GridRegion& polygon = part.outline.polygon;
  return {polygon.points.begin(), polygon.points.begin() + polygon.loop_starts[1]};
}

struct Extent {
  std::int64_t width = 0, height = 0;
};

geom::GridBox box_of_points(const std::vector<GridPoint>& points) {
  geom::GridBox box{points.front(), points.front()};
  for (const GridPoint p : points) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  }
  return box;
}

/// The sides of a part that is a rectangle along the axes, with or without holes.
std::optional<Extent> rectangle_of(const Part& part) {
  const std::vector<GridPoint> loop = outer_loop(part);
  if (loop.size() != 4) return std::nullopt;
  const geom::GridBox box = box_of_points(loop);
  for (std::size_t i = 0; i < 4; ++i) {
    const GridPoint side = loop[(i + 1) % 4] - loop[i];
    if (side.x != 0 && side.y != 0) return std::nullopt;
  }
  return Extent{box.high.x - box.low.x, box.high.y - box.low.y};
}

/// A part of a row: turned by quarters, then moved.
struct RowMember {
  std::uint32_t part = 0;
  int quarters = 0;
  GridPoint at;
};

struct Row {
  std::vector<RowMember> members;
  Extent size;
  double shared_mm = 0;
};

/// A document in which rows stand for their parts.
struct RowsDocument {
  Document document;
  std::map<std::uint32_t, Row> rows;  ///< by the part that stands for them
};

class RowMaker {
 public:
  RowMaker(const Document& document, std::size_t longest) : longest_(longest), made_{document, {}} {}

  RowsDocument make() {
    if (longest_ > 1 && made_.document.placements.empty()) {
      pair_triangles();
      line_up_rectangles();
    }
    return std::move(made_);
  }

 private:
  /// Says whether a part asks for nothing but to lie somewhere, which is then true of its row, too.
  [[nodiscard]] bool is_plain(std::uint32_t index) const {
    const Part& part = made_.document.parts[index];
    const bool is_of_kit =
        std::any_of(made_.document.kits.begin(), made_.document.kits.end(), [&](const layout::Kit& kit) {
          return std::any_of(kit.pieces.begin(), kit.pieces.end(),
                             [&](const layout::KitPiece& piece) { return piece.part == index; });
        });
    return !is_of_kit && part.demand > 0 && part.quality == layout::kAnyQuality && part.areas.empty() &&
           !part.grain && !part.gap && !part.border_gap && !part.defect_gap && part.tolerated_severity == 0;
  }

  [[nodiscard]] std::int64_t kerf() const { return made_.document.rules.kerf; }

  /// The quarter turns at which a row may lie.
  [[nodiscard]] std::vector<layout::AngleRange> turns_of(const std::vector<RowMember>& members) const {
    std::vector<layout::AngleRange> turns;
    for (int quarters = 0; quarters < 4; ++quarters)
      if (std::all_of(members.begin(), members.end(), [&](const RowMember& member) {
            return layout::rotation_allowed(made_.document.parts[member.part],
                                            quarter_turns(quarters + member.quarters));
          }))
        turns.push_back({90.0 * quarters, 90.0 * quarters});
    return turns;
  }

  /// The longest row of this height that fits on some stock. Of a strip, its width counts in both directions.
  [[nodiscard]] std::int64_t room_for(std::int64_t height) const {
    std::int64_t longest = 0;
    for (const layout::Stock& stock : made_.document.stocks) {
      const geom::GridBox box = geom::bounds(stock.outline.polygon);
      const std::int64_t border = 2 * made_.document.rules.border_gap, high = box.high.y - box.low.y - border,
                         wide =
                             stock.kind == layout::StockKind::strip ? high : box.high.x - box.low.x - border;
      if (height <= high) longest = std::max(longest, wide);
      if (height <= wide) longest = std::max(longest, high);
    }
    return longest;
  }

  /// Takes pieces out of the demand of parts, and adds that of the row that they make.
  void add(Row row, std::int64_t count) {
    std::vector<layout::AngleRange> turns = turns_of(row.members);
    const std::int64_t room = room_for(row.size.height);
    if (turns.empty() || row.size.width > room || count == 0) return;
    auto outline = geom::make_grid_region(
        {{{0, 0}, {row.size.width, 0}, {row.size.width, row.size.height}, {0, row.size.height}}});
    if (!outline) return;
    for (const RowMember& member : row.members) made_.document.parts[member.part].demand -= count;
    Part part;
    part.id = free_id();
    part.outline.polygon = *std::move(outline);
    part.rotations = std::move(turns);
    part.priority = made_.document.parts[row.members.front().part].priority;
    part.demand = count;
    made_.rows.emplace(static_cast<std::uint32_t>(made_.document.parts.size()), std::move(row));
    made_.document.parts.push_back(std::move(part));
  }

  [[nodiscard]] std::string free_id() const {
    for (std::size_t number = made_.rows.size() + 1;; ++number) {
      std::string id = fmt::format("row {}", number);
      if (std::none_of(made_.document.parts.begin(), made_.document.parts.end(),
                       [&](const Part& part) { return part.id == id; }))
        return id;
    }
  }

  /// Two right triangles of one part, turned by half a turn, face each other with their longest sides.
  void pair_triangles() {
    const auto count = static_cast<std::uint32_t>(made_.document.parts.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::vector<GridPoint> loop = outer_loop(made_.document.parts[i]);
      if (loop.size() != 3 || !is_plain(i)) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const GridPoint corner = loop[k], one = loop[(k + 1) % 3], other = loop[(k + 2) % 3];
        const GridPoint u = one - corner, v = other - corner;
        const bool first_lies = u.y == 0 && v.x == 0;
        if (!first_lies && !(u.x == 0 && v.y == 0)) continue;
        const GridPoint along_x = first_lies ? u : v, along_y = first_lies ? v : u;
        const auto a = static_cast<double>(std::abs(along_x.x)), b = static_cast<double>(std::abs(along_y.y));
        const double longest = std::sqrt(a * a + b * b);
        // Rounded away from the first, so that the kerf has room; the step is for the rounding of doubles.
        const auto out = [&](double leg, std::int64_t towards) {
          const auto steps =
              static_cast<std::int64_t>(std::ceil(static_cast<double>(kerf()) * leg / longest + 1e-3));
          return towards > 0 ? steps : -steps;
        };
        const GridPoint to = one + other + GridPoint{out(b, along_x.x), out(a, along_y.y)};
        std::vector<GridPoint> both = loop;
        for (const GridPoint p : loop) both.push_back(to - p);
        const geom::GridBox box = box_of_points(both);
        Row row{{{i, 0, -box.low}, {i, 2, to - box.low}},
                {box.high.x - box.low.x, box.high.y - box.low.y},
                geom::mm_from_grid(static_cast<std::int64_t>(longest))};
        add(std::move(row), made_.document.parts[i].demand / 2);
        break;
      }
    }
  }

  /// Rectangles of one longer side stand side by side.
  void line_up_rectangles() {
    std::map<std::pair<int, std::int64_t>, std::vector<std::uint32_t>> classes;  // by priority and height
    const auto count = static_cast<std::uint32_t>(made_.document.parts.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      if (made_.rows.contains(i) || !is_plain(i)) continue;
      const std::optional<Extent> size = rectangle_of(made_.document.parts[i]);
      // Beyond the next part of a row the gap has to hold again.
      if (!size || std::min(size->width, size->height) + 2 * kerf() < made_.document.rules.gap) continue;
      const Part& part = made_.document.parts[i];
      classes[{-part.priority, std::max(size->width, size->height)}].push_back(i);
    }
    for (const auto& [key, members] : classes) line_up(key.second, members);
  }

  void line_up(std::int64_t height, const std::vector<std::uint32_t>& parts) {
    std::vector<std::uint32_t> pieces;
    for (const std::uint32_t part : parts) {
      constexpr std::int64_t kMostPieces = 5000;
      const std::int64_t demand = std::min(made_.document.parts[part].demand, kMostPieces);
      pieces.insert(pieces.end(), static_cast<std::size_t>(demand), part);
    }
    const std::size_t rows = (pieces.size() + longest_ - 1) / longest_,
                      each = rows == 0 ? 0 : (pieces.size() + rows - 1) / rows;
    const std::int64_t room = room_for(height);
    std::map<std::vector<std::uint32_t>, std::int64_t> counts;
    for (std::size_t first = 0; first < pieces.size();) {
      std::vector<std::uint32_t> row;
      std::int64_t length = -kerf();
      while (first < pieces.size() && row.size() < each) {
        const std::int64_t longer = length + kerf() + thickness(pieces[first]);
        if (longer > room) break;
        length = longer;
        row.push_back(pieces[first++]);
      }
      if (row.empty()) return;
      if (row.size() > 1) ++counts[row];
    }
    for (const auto& [row, count] : counts) add(row_of(row, height), count);
  }

  [[nodiscard]] std::int64_t thickness(std::uint32_t part) const {
    const Extent size = *rectangle_of(made_.document.parts[part]);
    return std::min(size.width, size.height);
  }

  [[nodiscard]] Row row_of(const std::vector<std::uint32_t>& parts, std::int64_t height) const {
    Row row;
    std::int64_t at = 0;
    for (const std::uint32_t part : parts) {
      const Extent size = *rectangle_of(made_.document.parts[part]);
      const int quarters = size.height >= size.width ? 0 : 1;
      std::vector<GridPoint> turned;
      for (const GridPoint p : outer_loop(made_.document.parts[part]))
        turned.push_back(geom::turned(p, quarter_turns(quarters), false));
      row.members.push_back({part, quarters, GridPoint{at, 0} - box_of_points(turned).low});
      at += thickness(part) + kerf();
    }
    row.size = {at - kerf(), height};
    row.shared_mm = geom::mm_from_grid(height) * static_cast<double>(parts.size() - 1);
    return row;
  }

  std::size_t longest_;
  RowsDocument made_;
};

/// The layout of parts that a layout of rows is, with the rules of the given document.
nest::Nested unrolled(const RowsDocument& rows, const Document& given, nest::Nested found) {
  Document made = given;
  made.placements.clear();
  made.next_id = 1;
  for (const Placement& placement : found.document.placements) {
    const auto row = rows.rows.find(placement.part);
    if (row == rows.rows.end()) {
      made.placements.push_back(placement);
      // Rows become several placements, so that ids are counted anew; locked ones come with no rows.
      if (!rows.rows.empty()) made.placements.back().id = made.next_id;
      made.next_id = std::max(made.next_id, made.placements.back().id) + 1;
      continue;
    }
    int quarters = 0;
    while (quarters < 3 && !(quarter_turns(quarters) == placement.rotation)) ++quarters;
    for (const RowMember& member : row->second.members) {
      Placement piece = placement;
      piece.id = made.next_id++;
      piece.part = member.part;
      piece.rotation = quarter_turns(quarters + member.quarters);
      piece.at = placement.at + geom::turned(member.at, placement.rotation, false);
      made.placements.push_back(piece);
    }
  }
  made.next_id = std::max(made.next_id, found.document.next_id);
  std::map<std::uint32_t, nest::Unplaced> unplaced;
  const auto miss = [&](std::uint32_t part, std::int64_t count, nest::Reason reason) {
    unplaced.try_emplace(part, nest::Unplaced{part, 0, reason}).first->second.count += count;
  };
  for (const nest::Unplaced& missing : found.unplaced) {
    const auto row = rows.rows.find(missing.part);
    if (row == rows.rows.end()) {
      miss(missing.part, missing.count, missing.reason);
      continue;
    }
    for (const RowMember& member : row->second.members) miss(member.part, missing.count, missing.reason);
  }
  found.unplaced.clear();
  for (const auto& [part, missing] : unplaced) found.unplaced.push_back(missing);
  found.document = std::move(made);
  return found;
}

/// The figures of a trial.
struct RowTrial {
  double missing_mm2 = 0, material_mm2 = 0, shared_mm = 0;
};

RowTrial trial_of(const RowsDocument& rows, const nest::Nested& found) {
  RowTrial trial;
  for (const nest::Unplaced& missing : found.unplaced)
    trial.missing_mm2 += static_cast<double>(missing.count) *
                         geom::area_mm2(found.document.parts[missing.part].outline.polygon);
  for (const Placement& placement : found.document.placements)
    if (const auto row = rows.rows.find(placement.part); row != rows.rows.end())
      trial.shared_mm += row->second.shared_mm;
  // All of a sheet is used up but that on the last one, what lies beyond the parts, is left.
  double left = 0;
  for (const layout::SheetUse& use : layout::completeness(found.document).sheets) {
    trial.material_mm2 += use.material_area;
    const layout::Stock& stock = found.document.stocks[use.sheet.stock];
    if (stock.kind != layout::StockKind::sheet) continue;
    const geom::GridBox box = geom::bounds(stock.outline.polygon);
    const double beyond = geom::mm_from_grid(box.high.x) - use.used_length_mm;
    left = std::max(left, beyond * geom::mm_from_grid(box.high.y - box.low.y));
  }
  trial.material_mm2 -= left;
  return trial;
}

}  // namespace

Result<nest::Nested> nest_in_rows(const Document& document, std::int64_t gap, const nest::Options& options,
                                  const RunControl& control, CommonRows& figures) {
  Document wide = document;
  wide.rules.gap = std::max(gap, document.rules.gap);
  std::vector<RowsDocument> choices;
  for (const std::size_t longest : kRowLengths) {
    RowsDocument rows = RowMaker(wide, longest).make();
    if (choices.empty() || !(rows.document == choices.back().document)) choices.push_back(std::move(rows));
  }
  std::size_t best = 0;
  if (choices.size() > 1) {
    nest::Options trying = options;
    trying.improved = nullptr;
    RunControl shortly;
    shortly.stop = control.stop;
    shortly.work_limit = std::min(kTrialWork, control.work_limit);
    std::vector<RowTrial> trials;
    for (const RowsDocument& rows : choices) {
      LEKALO_TRY(const nest::Nested found, nest::nest(rows.document, trying, shortly));
      trials.push_back(trial_of(rows, found));
      if (control.stop_requested()) break;
    }
    for (std::size_t k = 1; k < trials.size(); ++k)
      if (trials[k].missing_mm2 <= trials[0].missing_mm2 &&
          trials[k].material_mm2 <= kMostMaterial * trials[0].material_mm2 &&
          trials[k].shared_mm > trials[best].shared_mm)
        best = k;
    if (trials[0].material_mm2 > 0)
      figures.material_share = trials[best].material_mm2 / trials[0].material_mm2;
  }
  const RowsDocument& chosen = choices[best];
  for (const auto& [part, row] : chosen.rows)
    figures.most_in_row = std::max(figures.most_in_row, row.members.size());
  nest::Options searching = options;
  if (options.improved)
    searching.improved = [&](const nest::Nested& better) {
      options.improved(unrolled(chosen, document, better));
    };
  LEKALO_TRY(nest::Nested found, nest::nest(chosen.document, searching, control));
  figures.shared_mm = trial_of(chosen, found).shared_mm;
  return unrolled(chosen, document, std::move(found));
}

}  // namespace lekalo::jobs
