#include "problem.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/layout/check.hpp"

namespace lekalo::nest {
namespace {

using geom::GridRegion;
using geom::Point;

Shape shape_of(const GridRegion& region) {
  Shape shape;
  for (std::size_t l = 0; l < region.loops(); ++l) {
    std::vector<Point> loop;
    for (std::uint32_t k = region.loop_starts[l]; k < region.loop_starts[l + 1]; ++k)
      loop.push_back(geom::mm_from_grid(region.points[k]));
    shape.loops.push_back(std::move(loop));
  }
  shape.pieces = convex_pieces(region);
  return shape;
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

}  // namespace

Problem::Problem(const layout::Document& document, const SearchOptions& options)
    : document_(&document), options_(options) {
  for (std::uint32_t p = 0; p < document.parts.size(); ++p) {
    const layout::Part& part = document.parts[p];
    areas_.push_back(geom::area_mm2(part.outline.polygon));
    std::vector<Point> points;
    for (std::uint32_t k = 0; k < part.outline.polygon.loop_starts[1]; ++k)
      points.push_back(geom::mm_from_grid(part.outline.polygon.points[k]));
    hull_areas_.push_back(hull_area(points));
    border_gaps_.push_back(geom::mm_from_grid(layout::border_gap_of(document, part)));
    widest_gap_ = std::max({widest_gap_, border_gaps_.back(),
                            geom::mm_from_grid(layout::gap_between(document, part, part)),
                            geom::mm_from_grid(layout::defect_gap_of(document, part))});
    Forms forms;
    forms.first = static_cast<std::uint32_t>(forms_.size());
    for (int mirrored = 0; mirrored <= (part.may_mirror ? 1 : 0); ++mirrored) {
      SearchShape shape;
      shape.part = p;
      shape.whole = shape_of(geom::turned(part.outline.polygon, geom::GridRotation{}, mirrored == 1));
      shapes_.push_back(std::move(shape));
      const auto index = static_cast<std::uint32_t>(shapes_.size() - 1);
      std::vector<double> angles;
      const auto add_range = [&](double from, double to) {
        if (to == from) {
          angles.push_back(from);
          return;
        }
        const double step = 360.0 / static_cast<double>(options_.angles_of_any);
        if (to - from >= 360) {
          for (std::size_t k = 0; k < options_.angles_of_any; ++k)
            angles.push_back(step * static_cast<double>(k));
          return;
        }
        // Multiples of the step as far as they lie in it: parts then share differences of angles.
        bool any = false;
        for (double k = std::ceil(from / step); k * step <= to; ++k) {
          angles.push_back(k * step);
          any = true;
        }
        if (!any) angles.push_back(0.5 * (from + to));
      };
      if (part.rotations.empty())
        add_range(0, 360);
      else
        for (const layout::AngleRange& range : part.rotations) add_range(range.from, range.to);
      std::vector<geom::GridRotation> seen;
      for (const double degrees : angles) {
        const geom::GridRotation rotation = geom::rotation_from_degrees(degrees);
        if (!layout::rotation_allowed(part, rotation)) continue;
        if (std::find(seen.begin(), seen.end(), rotation) != seen.end()) continue;
        seen.push_back(rotation);
        add_form(index, rotation, mirrored == 1);
      }
    }
    forms.last = static_cast<std::uint32_t>(forms_.size());
    by_part_.push_back(forms);
  }
  for (std::uint32_t s = 0; s < document.stocks.size(); ++s) {
    const layout::Stock& stock = document.stocks[s];
    const geom::GridBox box = geom::bounds(stock.outline.polygon);
    Bin bin;
    bin.stock = s;
    bin.box = {geom::mm_from_grid(box.low.x), geom::mm_from_grid(box.low.y), geom::mm_from_grid(box.high.x),
               geom::mm_from_grid(box.high.y)};
    bin.open = stock.kind == layout::StockKind::strip;
    bin.area = geom::area_mm2(stock.outline.polygon);
    bins_.push_back(std::move(bin));
  }
  // Differences of angles.
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
  const std::size_t count = shapes_.size() * shapes_.size() * relative_count_;
  tables_ = std::make_unique<std::atomic<const NoFit*>[]>(count);
  for (std::size_t k = 0; k < count; ++k) tables_[k].store(nullptr, std::memory_order_relaxed);
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
  for (const Point p : shapes_[shape].whole.loops[0]) {
    const double x = form.c * p.x - form.s * p.y, y = form.s * p.x + form.c * p.y;
    form.box = {std::min(form.box.x0, x), std::min(form.box.y0, y), std::max(form.box.x1, x),
                std::max(form.box.y1, y)};
  }
  forms_.push_back(form);
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
  way.direction = {f.c * way.direction.x - f.s * way.direction.y, f.s * way.direction.x + f.c * way.direction.y};
  if (swapped) way.direction = -way.direction;
  return way;
}

const NoFit& Problem::make_table(std::size_t at, const Form& a, const Form& b) const {
  const SearchShape& p = shapes_[a.shape];
  const SearchShape& q = shapes_[b.shape];
  const auto [c, s] = relative_pairs_[at % relative_count_];
  double gap = 0;
  const Shape* of_p = &p.whole;
  const Shape* of_q = &q.whole;
  static const Shape nothing;
  const auto against = [&](const SearchShape& part, const SearchShape& other) {
    const layout::Part& rules = document_->parts[part.part];
    if (other.kind == SearchShape::Kind::border)
      gap = geom::mm_from_grid(layout::border_gap_of(*document_, rules));
    if (other.kind == SearchShape::Kind::defect)
      gap = geom::mm_from_grid(layout::defect_gap_of(*document_, rules));
    const Shape* of_part = &part.whole;
    if (other.kind == SearchShape::Kind::defect && other.level <= rules.tolerated_severity) of_part = &nothing;
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
  auto made = std::make_unique<NoFit>(*of_p, turned(*of_q, c, s), gap, options_.cells);
  const std::lock_guard lock(making_);
  if (const NoFit* other = tables_[at].load(std::memory_order_acquire)) return *other;
  tables_[at].store(made.get(), std::memory_order_release);
  made_.fetch_add(1);
  owned_.push_back(std::move(made));
  return *owned_.back();
}

}  // namespace lekalo::nest
