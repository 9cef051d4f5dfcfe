#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/io/drawing/drawing.hpp"

namespace lekalo::cases {

/// Makes drawings by hand: every curve is an entity of its own, on line 10, 20, ...
class Sketch {
 public:
  explicit Sketch(std::string name = "sketch.dxf") { drawing_.name = std::move(name); }

  Sketch& layer(const std::string& name, bool hidden = false) {
    for (std::uint32_t i = 0; i < drawing_.layers.size(); ++i)
      if (drawing_.layers[i].name == name) return layer_ = i, *this;
    layer_ = static_cast<std::uint32_t>(drawing_.layers.size());
    drawing_.layers.push_back({name, hidden});
    return *this;
  }
  Sketch& add(io::Shape shape, const std::string& type, double error = 0) {
    if (drawing_.layers.empty()) layer("0");
    const auto entity = static_cast<std::uint32_t>(drawing_.entities.size());
    drawing_.entities.push_back({type, "", 10 * (entity + std::size_t{1})});
    drawing_.curves.push_back({std::move(shape), entity, layer_, error});
    return *this;
  }
  Sketch& line(geom::Point from, geom::Point to) {
    return add(geom::Edge{geom::EdgeKind::line, from, to, {}}, "LINE");
  }
  Sketch& arc(geom::Point from, geom::Point to, geom::Point centre, bool ccw = true) {
    return add(geom::Edge{ccw ? geom::EdgeKind::arc_ccw : geom::EdgeKind::arc_cw, from, to, centre}, "ARC");
  }
  Sketch& circle(geom::Point centre, double radius) {
    const geom::Point at = centre + geom::Point{radius, 0};
    return add(geom::Edge{geom::EdgeKind::arc_ccw, at, at, centre}, "CIRCLE");
  }
  Sketch& edge(const geom::Edge& e) { return add(e, e.kind == geom::EdgeKind::line ? "LINE" : "ARC"); }
  Sketch& edges(const geom::Contour& contour) {
    for (const geom::Edge& e : contour) edge(e);
    return *this;
  }
  Sketch& polyline(const std::vector<geom::Point>& points, bool closed = true) {
    for (std::size_t i = 0; i + (closed ? 0 : 1) < points.size(); ++i)
      line(points[i], points[(i + 1) % points.size()]);
    return *this;
  }
  [[nodiscard]] io::Drawing& drawing() { return drawing_; }
  [[nodiscard]] const io::Drawing& drawing() const { return drawing_; }

 private:
  io::Drawing drawing_;
  std::uint32_t layer_ = 0;
};

/// The same order on every machine (std::shuffle's is the library's).
template <class T>
void shuffle(std::vector<T>& items, Random& random) {
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random.below(i)]);
}

}  // namespace lekalo::cases
