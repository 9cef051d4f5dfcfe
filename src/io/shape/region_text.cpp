#include "region_text.hpp"

#include <fmt/core.h>

#include <cmath>

namespace lekalo::io::detail {
namespace {

using geom::Contour;
using geom::Edge;
using geom::Point;

// A "-0" would be read back as the integer 0.
std::string number(double v) { return v == 0 && std::signbit(v) ? "-0.0" : fmt::format("{}", v); }

std::string point(Point p) { return fmt::format("[{}, {}]", number(p.x), number(p.y)); }

std::string contour_text(const Contour& contour) {
  std::string text = "[";
  for (const Edge& edge : contour) text += (text.size() == 1 ? "" : ", ") + edge_text(edge);
  return text + "]";
}

}  // namespace

std::string edge_text(const Edge& e) {
  if (e.kind == geom::EdgeKind::line) {
    return fmt::format(R"({{"line": {{"from": {}, "to": {}}}}})", point(e.from), point(e.to));
  }
  return fmt::format(R"({{"arc": {{"from": {}, "to": {}, "centre": {}, "ccw": {}}}}})", point(e.from),
                     point(e.to), point(e.centre), e.kind == geom::EdgeKind::arc_ccw);
}

std::string region_text(const geom::Region& region) {
  std::string text = "{\"outer\": " + contour_text(region.outer) + ", \"holes\": [";
  for (std::size_t h = 0; h < region.holes.size(); ++h)
    text += (h == 0 ? "" : ", ") + contour_text(region.holes[h]);
  return text + "]}";
}

}  // namespace lekalo::io::detail
