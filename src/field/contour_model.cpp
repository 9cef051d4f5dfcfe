#include "lekalo/field/contour_model.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <span>
#include <tuple>

#include "lekalo/geom/trig.hpp"

namespace lekalo::field {
namespace {

constexpr double kMostSegments = 1e6;

Jet fold(std::span<const Jet> values, Logic logic) {
  if (values.size() == 1) return values[0];
  const std::size_t half = values.size() / 2;
  return conjunction(fold(values.first(half), logic), fold(values.subspan(half), logic), logic);
}

Jet fold(std::span<const FlozSegment> segments, geom::Point x, const ContourModelOptions& o) {
  if (segments.size() == 1) return floz(segments[0], x, o.form);
  const std::size_t half = segments.size() / 2;
  return conjunction(fold(segments.first(half), x, o), fold(segments.subspan(half), x, o), o.logic);
}

void add_pieces(const geom::Edge& edge, double step, std::vector<ContourModel::Chord>& chords) {
  const bool arc = edge.kind != geom::EdgeKind::line;
  const double sweep = arc ? arc_sweep(edge) : 0;
  const double length = arc ? sweep * arc_radius(edge) : norm(edge.to - edge.from);
  // A full circle needs two chords at least.
  const double pieces = std::max(arc ? std::ceil(sweep / 3) : 1.0, std::ceil(length / step));
  geom::Point at = edge.from;
  for (double i = 1; i <= pieces; ++i) {
    geom::Point next = edge.to;
    if (i < pieces) {
      if (arc) {
        const auto [sine, cosine] =
            geom::sincos(edge.kind == geom::EdgeKind::arc_ccw ? sweep * i / pieces : -sweep * i / pieces);
        const geom::Point out = edge.from - edge.centre;
        next = edge.centre + cosine * out + sine * perpendicular(out);
      } else {
        next = edge.from + (i / pieces) * (edge.to - edge.from);
      }
    }
    if (!(next == at)) chords.push_back({at, next});
    at = next;
  }
}

}  // namespace

Jet folded(const std::vector<Jet>& values, Logic logic) { return fold(values, logic); }

Result<ContourModel> ContourModel::make(const std::vector<geom::Region>& regions,
                                        const ContourModelOptions& o) {
  if (!(o.step > 0))
    return failure(ErrorCode::bad_input,
                   fmt::format("a sampling step of {:g} mm: it is to be above 0", o.step));
  ContourModel model;
  model.options_ = o;
  double length = 0;
  const auto each_edge = [&](const auto& act) {
    for (const geom::Region& region : regions) {
      for (const geom::Edge& edge : region.outer) act(edge);
      for (const geom::Contour& hole : region.holes)
        for (const geom::Edge& edge : hole) act(edge);
    }
  };
  each_edge([&](const geom::Edge& edge) {
    length +=
        edge.kind == geom::EdgeKind::line ? norm(edge.to - edge.from) : arc_sweep(edge) * arc_radius(edge);
  });
  if (!(length / o.step < kMostSegments))
    return failure(
        ErrorCode::bad_input,
        fmt::format("a sampling step of {:g} mm makes more than a million segments of an outline of {:g} mm; "
                    "take a larger one",
                    o.step, length));
  each_edge([&](const geom::Edge& edge) { add_pieces(edge, o.step, model.chords_); });
  if (model.chords_.empty())
    return failure(ErrorCode::bad_input, "a model of no outline: there are no regions");
  for (Chord& c : model.chords_)
    if (std::tie(c.b.x, c.b.y) < std::tie(c.a.x, c.a.y)) std::swap(c.a, c.b);
  std::sort(model.chords_.begin(), model.chords_.end(), [](const Chord& c, const Chord& d) {
    return std::tie(c.a.x, c.a.y, c.b.x, c.b.y) < std::tie(d.a.x, d.a.y, d.b.x, d.b.y);
  });
  for (const Chord& c : model.chords_) model.segments_.push_back(floz_segment(c.a, c.b));
  return model;
}

bool ContourModel::inside(geom::Point x) const {
  bool in = false;
  for (const Chord& c : chords_) {
    if ((c.a.y <= x.y) == (c.b.y <= x.y)) continue;
    if (c.a.x + (x.y - c.a.y) / (c.b.y - c.a.y) * (c.b.x - c.a.x) > x.x) in = !in;
  }
  return in;
}

Jet ContourModel::unsigned_at(geom::Point x) const {
  return fold(std::span<const FlozSegment>(segments_), x, options_);
}

Jet ContourModel::operator()(geom::Point x) const {
  const Jet value = unsigned_at(x);
  return inside(x) ? value : -value;
}

}  // namespace lekalo::field
