#include "problem.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>

#include "lekalo/geom/boolean.hpp"
#include "lekalo/layout/check.hpp"
#include "lekalo/phi/outline_relation.hpp"
#include "nest/tuning/tuning.hpp"
#include "simplify.hpp"

namespace lekalo::nest {
namespace {

using geom::GridRegion;
using geom::Point;

SearchOutline outline_of(const GridRegion& region) {
  SearchOutline outline;
  for (std::size_t l = 0; l < region.loops(); ++l) {
    std::vector<Point> loop;
    for (std::uint32_t k = region.loop_starts[l]; k < region.loop_starts[l + 1]; ++k)
      loop.push_back(geom::mm_from_grid(region.points[k]));
    outline.loops.push_back(std::move(loop));
  }
  outline.pieces = convex_pieces(region);
  return outline;
}

/// The region, or where it has very many corners one that holds it, larger by at most a share of a size, mm.
GridRegion with_few_corners(const GridRegion& region, double size) {
  return simplified(region, tuning::kSimplify * size, tuning::kMostCorners);
}

double hull_area(std::vector<Point> points) {
  std::sort(points.begin(), points.end(),
            [](Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<Point> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t base = hull.size();
    for (const Point p : points) {
      while (hull.size() >= base + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  double twice = 0;
  for (std::size_t k = 0; k < hull.size(); ++k) twice += cross(hull[k], hull[(k + 1) % hull.size()]);
  return 0.5 * twice;
}

/// A frame around a loop: a region whose only hole it is.
SearchOutline frame_around(const std::vector<geom::GridPoint>& loop, std::int64_t width) {
  geom::GridPoint low = loop[0], high = loop[0];
  for (const geom::GridPoint p : loop) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  low = {low.x - width, low.y - width};
  high = {high.x + width, high.y + width};
  GridRegion frame;
  frame.points = {low, {high.x, low.y}, high, {low.x, high.y}};
  frame.points.insert(frame.points.end(), loop.rbegin(), loop.rend());
  frame.loop_starts = {0, 4, static_cast<std::uint32_t>(frame.points.size())};
  return outline_of(with_few_corners(frame, geom::mm_from_grid(width)));
}

GridRegion region_of(std::vector<geom::GridPoint> loop) {
  GridRegion region;
  region.loop_starts = {0, static_cast<std::uint32_t>(loop.size())};
  region.points = std::move(loop);
  return region;
}

std::vector<geom::GridPoint> loop_of(const GridRegion& region, std::size_t l) {
  return {region.points.begin() + region.loop_starts[l], region.points.begin() + region.loop_starts[l + 1]};
}

bool is_rectangle(const std::vector<geom::GridPoint>& loop) {
  if (loop.size() != 4) return false;
  for (std::size_t k = 0; k < 4; ++k) {
    const geom::GridPoint d = loop[(k + 1) % 4] - loop[k];
    if (d.x != 0 && d.y != 0) return false;
  }
  return true;
}

void add(SearchOutline& to, SearchOutline more) {
  std::move(more.loops.begin(), more.loops.end(), std::back_inserter(to.loops));
  std::move(more.pieces.begin(), more.pieces.end(), std::back_inserter(to.pieces));
}

/// The areas of a part that need more than a quality. It is the whole part where that cannot be told, which
/// is the safe side.
SearchOutline demanding_more(const layout::Part& part, int than, bool mirrored) {
  std::vector<geom::Region> content, strict;
  for (const layout::PartArea& area : part.areas)
    (area.quality > than ? strict : content).push_back(geom::region_of_lines(area.outline.polygon));
  const std::vector<geom::Region> whole = {geom::region_of_lines(part.outline.polygon)};
  std::vector<geom::Region> pieces;
  const auto combined = [](const std::vector<geom::Region>& a, const std::vector<geom::Region>& b,
                           geom::BooleanOperation operation, std::vector<geom::Region>& to) {
    if (b.empty() && operation == geom::BooleanOperation::subtract) {
      to.insert(to.end(), a.begin(), a.end());
      return true;
    }
    auto result = geom::combine(a, b, operation);
    if (!result) return false;
    to.insert(to.end(), result->regions.begin(), result->regions.end());
    return true;
  };
  const auto oriented = [&](const GridRegion& region) {
    return outline_of(geom::turned(region, geom::GridRotation{}, mirrored));
  };
  bool fine = true;
  if (part.quality > than) fine = combined(whole, content, geom::BooleanOperation::subtract, pieces);
  if (fine && !strict.empty()) fine = combined(whole, strict, geom::BooleanOperation::intersect, pieces);
  SearchOutline outline;
  for (const geom::Region& piece : pieces) {
    if (!fine) break;
    std::vector<std::vector<geom::GridPoint>> loops;
    const auto add_loop = [&](const geom::Contour& contour) {
      std::vector<geom::GridPoint> loop;
      for (const geom::Edge& e : contour)
        loop.push_back({geom::grid_from_mm(e.from.x), geom::grid_from_mm(e.from.y)});
      loops.push_back(std::move(loop));
    };
    add_loop(piece.outer);
    for (const geom::Contour& hole : piece.holes) add_loop(hole);
    const auto region = geom::make_grid_region(std::move(loops));
    if (region)
      add(outline, oriented(*region));
    else if (geom::norm(piece.outer[0].to - piece.outer[0].from) > 1e-3)
      fine = false;
  }
  return fine ? outline : oriented(part.outline.polygon);
}

}  // namespace

Problem::Problem(const layout::Document& document, const layout::Document& searched,
                 const SearchOptions& options)
    : document_(&searched), given_(&document), options_(options) {
  // Obstacles come first, because a table is in the frame of the first of two shapes, and a border's window
  // is upright.
  add_bins();
  add_parts();
  add_locked();
  add_relative_angles();
  find_unit();
  find_grain();
  // If every table serves few looks, coarse ones do: depths near a border are exact in any.
  const double parts = static_cast<double>(by_part_.size());
  const double tables = 0.5 * parts * parts * static_cast<double>(relative_count_);
  cells_ = tables > tuning::kManyTables ? options_.cells / 4 : options_.cells;
}

void Problem::add_parts() {
  const layout::Document& document = *document_;
  int given_left = tuning::kMostGivenAngles;
  std::vector<int> qualities;
  for (const layout::Stock& stock : document.stocks)
    for (const layout::QualityZone& zone : stock.zones) qualities.push_back(zone.quality);
  std::sort(qualities.begin(), qualities.end());
  qualities.erase(std::unique(qualities.begin(), qualities.end()), qualities.end());
  for (std::uint32_t p = 0; p < document.parts.size(); ++p) {
    const layout::Part& part = document.parts[p];
    areas_.push_back(geom::area_mm2(part.outline.polygon));
    std::vector<Point> points;
    for (const geom::GridPoint q : loop_of(part.outline.polygon, 0)) points.push_back(geom::mm_from_grid(q));
    hull_areas_.push_back(hull_area(points));
    border_gaps_.push_back(geom::mm_from_grid(layout::border_gap_of(document, part)));
    widest_gap_ = std::max({widest_gap_, border_gaps_.back(),
                            geom::mm_from_grid(layout::gap_between(document, part, part)),
                            geom::mm_from_grid(layout::defect_gap_of(document, part))});
    std::vector<double> angles;
    const double step = 360.0 / static_cast<double>(options_.angles_of_any);
    const auto add_range = [&](double from, double to) {
      if (to - from >= 360) {
        for (std::size_t k = 0; k < options_.angles_of_any; ++k)
          angles.push_back(step * static_cast<double>(k));
        return;
      }
      // Angles are multiples of the step where the range holds some, so that parts share differences of
      // angles.
      bool any = false;
      for (double k = std::ceil(from / step); k * step <= to; ++k) {
        angles.push_back(k * step);
        any = true;
      }
      if (!any) angles.push_back(to == from ? from : 0.5 * (from + to));
    };
    if (part.rotations.empty()) add_range(0, 360);
    for (const layout::AngleRange& range : part.rotations) add_range(range.from, range.to);
    if (part.grain)  // the steps may miss the few angles that the grain allows
      for (const layout::Stock& stock : document.stocks)
        if (stock.grain_degrees)
          for (const double grain : {part.grain->degrees, 180.0 - part.grain->degrees})
            for (const double turn : {0.0, 180.0}) angles.push_back(*stock.grain_degrees - grain + turn);
    Forms forms;
    forms.first = static_cast<std::uint32_t>(forms_.size());
    for (int mirrored = 0; mirrored <= (part.may_mirror ? 1 : 0); ++mirrored) {
      SearchShape shape;
      shape.part = p;
      shape.whole =
          outline_of(outer_outline(geom::turned(part.outline.polygon, geom::GridRotation{}, mirrored == 1),
                                   std::sqrt(hull_areas_.back())));
      for (const int quality : qualities)
        shape.demanding.emplace_back(quality, demanding_more(part, quality, mirrored == 1));
      shapes_.push_back(std::move(shape));
      const auto index = static_cast<std::uint32_t>(shapes_.size() - 1);
      std::vector<geom::GridRotation> rotations, seen;
      for (const double degrees : angles) rotations.push_back(geom::rotation_from_degrees(degrees));
      if (options_.given_angles)
        for (const layout::Placement& p_given : document.placements)
          if (!p_given.locked && p_given.part == p && p_given.mirrored == (mirrored == 1) && given_left > 0 &&
              std::find(rotations.begin(), rotations.end(), p_given.rotation) == rotations.end()) {
            rotations.push_back(p_given.rotation);
            --given_left;
          }
      for (const geom::GridRotation rotation : rotations) {
        if (!layout::rotation_allowed(part, rotation)) continue;
        if (std::none_of(document.stocks.begin(), document.stocks.end(), [&](const layout::Stock& stock) {
              return layout::grain_allowed(part, stock, rotation, mirrored == 1);
            }))
          continue;
        if (std::find(seen.begin(), seen.end(), rotation) != seen.end()) continue;
        seen.push_back(rotation);
        add_form(index, rotation, mirrored == 1);
      }
    }
    forms.last = static_cast<std::uint32_t>(forms_.size());
    by_part_.push_back(forms);
  }
}

std::uint32_t Problem::obstacle_form(SearchShape::Kind kind, int level, SearchOutline shape) {
  SearchShape made;
  made.kind = kind;
  made.level = level;
  made.whole = std::move(shape);
  shapes_.push_back(std::move(made));
  add_form(static_cast<std::uint32_t>(shapes_.size() - 1), geom::GridRotation{}, false);
  return static_cast<std::uint32_t>(forms_.size() - 1);
}

/// Adds one obstacle of each kind and level, so that a part needs few tables for all of a stock
/// (nest-sheets.md, step 7).
void Problem::add_stock_obstacles(std::uint32_t s, Bin& bin) {
  using Kind = SearchShape::Kind;
  const layout::Stock& stock = document_->stocks[s];
  const auto outer = loop_of(stock.outline.polygon, 0);
  SearchOutline border;
  if (!is_rectangle(outer)) {
    const double size = std::max(bin.box.x1 - bin.box.x0, bin.box.y1 - bin.box.y0);
    border = frame_around(outer, geom::grid_from_mm(size));
  }
  for (std::size_t l = 1; l < stock.outline.polygon.loops(); ++l) {
    auto hole = loop_of(stock.outline.polygon, l);
    std::reverse(hole.begin(), hole.end());
    add(border, outline_of(with_few_corners(region_of(std::move(hole)), std::sqrt(bin.area))));
  }
  std::map<int, SearchOutline> defects, zones;
  for (const layout::Defect& defect : stock.defects)
    add(defects[defect.severity],
        outline_of(simplified(defect.outline.polygon, tuning::kSimplifyDefect, tuning::kEnoughCorners)));
  for (const layout::QualityZone& zone : stock.zones)
    add(zones[zone.quality], outline_of(with_few_corners(zone.outline.polygon, std::sqrt(bin.area))));
  const auto put = [&](Kind kind, int level, SearchOutline shape) {
    bin.obstacles.push_back({obstacle_form(kind, level, std::move(shape)), 0, 0});
    shapes_.back().window = bin.box;
  };
  if (!border.loops.empty()) put(Kind::border, 0, std::move(border));
  for (auto& [severity, shape] : defects) put(Kind::defect, severity, std::move(shape));
  for (auto& [quality, shape] : zones) put(Kind::zone, quality, std::move(shape));
}

void Problem::add_bins() {
  const layout::Document& document = *document_;
  std::int64_t pieces = 0;
  for (std::uint32_t p = 0; p < document.parts.size(); ++p) pieces += layout::wanted(document, p);
  for (std::uint32_t s = 0; s < document.stocks.size(); ++s) {
    const layout::Stock& stock = document.stocks[s];
    const geom::GridBox box = geom::bounds(stock.outline.polygon);
    Bin bin;
    bin.stock = s;
    bin.box = {geom::mm_from_grid(box.low.x), geom::mm_from_grid(box.low.y), geom::mm_from_grid(box.high.x),
               geom::mm_from_grid(box.high.y)};
    bin.open = stock.kind == layout::StockKind::strip;
    bin.area = geom::area_mm2(stock.outline.polygon);
    add_stock_obstacles(s, bin);
    for (std::int64_t copy = 0; copy < std::min(stock.count, std::max<std::int64_t>(pieces, 1)); ++copy) {
      bin.copy = copy;
      bins_.push_back(bin);
    }
  }
}

void Problem::add_locked() {
  const layout::Document& document = *document_;
  locked_pieces_.resize(document.parts.size());
  for (const layout::Placement& placement : document.placements) {
    if (!placement.locked) continue;
    layout::PieceCount& count = locked_pieces_[placement.part];
    ++(placement.mirrored ? count.mirrored : count.upright);
    for (Bin& bin : bins_) {
      if (bin.stock != placement.stock || bin.copy != placement.copy) continue;
      std::uint32_t form = form_of(placement.part, placement.rotation, placement.mirrored);
      if (form == forms_.size()) {
        SearchShape shape;
        shape.part = placement.part;
        shape.whole = outline_of(geom::turned(document.parts[placement.part].outline.polygon,
                                              geom::GridRotation{}, placement.mirrored));
        shapes_.push_back(std::move(shape));
        add_form(static_cast<std::uint32_t>(shapes_.size() - 1), placement.rotation, placement.mirrored);
      }
      bin.obstacles.push_back({form, geom::mm_from_grid(placement.at.x), geom::mm_from_grid(placement.at.y)});
      bin.holds_locked = true;
      bin.locked_reach = std::max(bin.locked_reach, geom::mm_from_grid(placement.at.x) + forms_[form].box.x1 +
                                                        border_gaps_[placement.part]);
      bin.locked_top = std::max(bin.locked_top, geom::mm_from_grid(placement.at.y) + forms_[form].box.y1 +
                                                    border_gaps_[placement.part]);
    }
  }
}

std::uint32_t Problem::form_of(std::uint32_t part, geom::GridRotation rotation,
                               bool mirrored) const noexcept {
  for (std::uint32_t f = by_part_[part].first; f < by_part_[part].last; ++f)
    if (forms_[f].rotation == rotation && forms_[f].mirrored == mirrored) return f;
  return static_cast<std::uint32_t>(forms_.size());
}

void Problem::add_relative_angles() {
  relative_.resize(angles_.size() * angles_.size());
  for (std::size_t i = 0; i < angles_.size(); ++i)
    for (std::size_t j = 0; j < angles_.size(); ++j) {
      const auto in = [](std::int64_t v) { return static_cast<double>(v) * 0x1p-52; };
      const double ci = in(angles_[i].c), si = in(angles_[i].s), cj = in(angles_[j].c), sj = in(angles_[j].s);
      const double c = ci * cj + si * sj, s = ci * sj - si * cj;
      std::size_t k = 0;
      while (k < relative_pairs_.size() && (std::abs(relative_pairs_[k].first - c) > 1e-12 ||
                                            std::abs(relative_pairs_[k].second - s) > 1e-12))
        ++k;
      if (k == relative_pairs_.size()) relative_pairs_.emplace_back(c, s);
      relative_[i * angles_.size() + j] = static_cast<std::uint32_t>(k);
    }
  relative_count_ = relative_pairs_.size();
  rows_ = std::vector<MadeOnce<Row>>(shapes_.size() * shapes_.size());
}

std::uint32_t Problem::angle_index(geom::GridRotation rotation) {
  const auto at = std::find(angles_.begin(), angles_.end(), rotation);
  if (at != angles_.end()) return static_cast<std::uint32_t>(at - angles_.begin());
  angles_.push_back(rotation);
  return static_cast<std::uint32_t>(angles_.size() - 1);
}

void Problem::add_form(std::uint32_t shape, geom::GridRotation rotation, bool mirrored) {
  Form form;
  form.shape = shape;
  form.angle = angle_index(rotation);
  form.c = static_cast<double>(rotation.c) * 0x1p-52;
  form.s = static_cast<double>(rotation.s) * 0x1p-52;
  form.rotation = rotation;
  form.mirrored = mirrored;
  const double far = std::numeric_limits<double>::infinity();
  form.box = {far, far, -far, -far};
  for (const auto& loop : shapes_[shape].whole.loops)
    for (const Point p : loop) {
      const double x = form.c * p.x - form.s * p.y, y = form.s * p.x + form.c * p.y;
      form.box = {std::min(form.box.x0, x), std::min(form.box.y0, y), std::max(form.box.x1, x),
                  std::max(form.box.y1, y)};
    }
  forms_.push_back(form);
}

void Problem::find_grain() {
  const layout::Document& document = *document_;
  bool all = true;
  std::vector<char> follows;
  for (const Form& form : forms_)
    for (const layout::Stock& stock : document.stocks) {
      const SearchShape& shape = shapes_[form.shape];
      const bool fine =
          shape.kind != SearchShape::Kind::part ||
          layout::grain_allowed(document.parts[shape.part], stock, form.rotation, form.mirrored);
      follows.push_back(fine ? 1 : 0);
      all = all && fine;
    }
  if (!all) follows_grain_ = std::move(follows);
}

void Problem::find_unit() {
  std::int64_t common = 0;
  for (const Form& form : forms_)
    if (form.rotation.c != 0 && form.rotation.s != 0) return;
  for (const layout::Part& part : document_->parts)
    for (const geom::GridPoint p : part.outline.polygon.points) common = std::gcd(std::gcd(common, p.x), p.y);
  for (const layout::Stock& stock : document_->stocks)
    for (const geom::GridPoint p : stock.outline.polygon.points)
      if (stock.kind == layout::StockKind::strip)
        common = std::gcd(common, p.y);
      else
        common = std::gcd(std::gcd(common, p.x), p.y);
  constexpr std::int64_t kLeast = 1024;  // steps, about a micrometre: finer units say nothing
  if (common >= kLeast) unit_ = geom::mm_from_grid(common);
}

Forms Problem::forms_of(std::uint32_t part, std::optional<bool> mirrored) const noexcept {
  Forms forms = by_part_[part];
  if (!mirrored) return forms;
  std::uint32_t turned_over = forms.first;
  while (turned_over < forms.last && !forms_[turned_over].mirrored) ++turned_over;
  (*mirrored ? forms.first : forms.last) = turned_over;
  return forms;
}

bool Problem::fits_somewhere(std::uint32_t part, const Forms& forms) const noexcept {
  const double gap = 2 * border_gaps_[part];
  for (std::uint32_t k = 0; k < bins_.size(); ++k)
    for (std::uint32_t f = forms.first; f < forms.last; ++f) {
      const Bin& bin = bins_[k];
      if (!follows_grain(f, k)) continue;
      const Box& b = forms_[f].box;
      if (b.x1 - b.x0 + gap <= bin.box.x1 - bin.box.x0 + 1e-9 &&
          b.y1 - b.y0 + gap <= bin.box.y1 - bin.box.y0 + 1e-9)
        return true;
    }
  return false;
}

NoFit::Way Problem::way_out(const Form& a, const Form& b, double dx, double dy) const {
  const bool swapped = a.shape > b.shape;
  const Form& f = swapped ? b : a;
  double x = f.c * dx + f.s * dy, y = f.c * dy - f.s * dx;
  if (swapped) {
    x = -x;
    y = -y;
  }
  NoFit::Way way = swapped ? table(b, a).way_out(x, y) : table(a, b).way_out(x, y);
  way.direction = {f.c * way.direction.x - f.s * way.direction.y,
                   f.s * way.direction.x + f.c * way.direction.y};
  if (swapped) way.direction = -way.direction;
  return way;
}

const NoFit& Problem::make_table(std::size_t pair, std::size_t relative, const Form& a, const Form& b) const {
  const SearchShape& p = shapes_[a.shape];
  const SearchShape& q = shapes_[b.shape];
  const auto [c, s] = relative_pairs_[relative];
  double gap = 0;
  const SearchOutline* of_p = &p.whole;
  const SearchOutline* of_q = &q.whole;
  static const SearchOutline nothing;
  const auto against = [&](const SearchShape& part, const SearchShape& other) {
    const layout::Part& rules = document_->parts[part.part];
    if (other.kind == SearchShape::Kind::border)
      gap = geom::mm_from_grid(layout::border_gap_of(*document_, rules));
    if (other.kind == SearchShape::Kind::defect)
      gap = geom::mm_from_grid(layout::defect_gap_of(*document_, rules));
    const SearchOutline* of_part = &part.whole;
    if (other.kind == SearchShape::Kind::defect && other.level <= rules.tolerated_severity)
      of_part = &nothing;
    if (other.kind == SearchShape::Kind::zone) {
      of_part = &nothing;
      for (const auto& [quality, demanding] : part.demanding)
        if (quality == other.level) of_part = &demanding;
    }
    return of_part;
  };
  if (p.kind == SearchShape::Kind::part && q.kind == SearchShape::Kind::part)
    gap = geom::mm_from_grid(
        layout::gap_between(*document_, document_->parts[p.part], document_->parts[q.part]));
  else if (p.kind == SearchShape::Kind::part)
    of_p = against(p, q);
  else if (q.kind == SearchShape::Kind::part)
    of_q = against(q, p);
  else
    of_p = &nothing;
  // Only the outlines themselves can tell that a slot is just wide enough.
  GridRegion region_p, region_q;
  NoFit::IsFree is_free;
  if (p.kind == SearchShape::Kind::part && q.kind == SearchShape::Kind::part) {
    const auto in_steps = [](double v) { return static_cast<std::int64_t>(std::llround(v * 0x1p52)); };
    region_p = geom::turned(document_->parts[p.part].outline.polygon, geom::GridRotation{}, a.mirrored);
    region_q =
        geom::turned(geom::turned(document_->parts[q.part].outline.polygon, geom::GridRotation{}, b.mirrored),
                     {in_steps(c), in_steps(s)}, false);
    is_free = [&](geom::Point shift) {
      return !phi::interiors_meet(region_p, region_q,
                                  {geom::grid_from_mm(shift.x), geom::grid_from_mm(shift.y)});
    };
  }
  const SearchOutline turned_q = turned(*of_q, c, s);
  const bool of_parts = p.kind == SearchShape::Kind::part && q.kind == SearchShape::Kind::part;
  // A table of something that belongs to the stock covers the stock, not only the part.
  const Box window = p.kind == SearchShape::Kind::part ? Box{} : p.window;
  const std::size_t cells = of_parts ? cells_ : tuning::kStockCells * cells_;
  auto made = std::make_unique<NoFit>(*of_p, turned_q, gap, cells, is_free, window, of_parts);
  Row* const row = rows_[pair].find();
  Row& kept = row != nullptr ? *row : rows_[pair].keep(std::make_unique<Row>(relative_count_));
  return kept[relative].keep(std::move(made));
}

}  // namespace lekalo::nest
