#include "region_text.hpp"

#include <cmath>

namespace lekalo::io::detail {
namespace {

using geom::Contour;
using geom::Edge;
using geom::Point;

void write_coordinate(JsonWriter& json, double v) {
  // A "-0" would be read back as the integer 0.
  if (v == 0 && std::signbit(v))
    json.raw() += "-0.0";
  else
    json.value(v);
}

void write_point(JsonWriter& json, const char* key, Point p) {
  json.key(key).begin_list();
  write_coordinate(json, p.x);
  write_coordinate(json, p.y);
  json.end();
}

}  // namespace

void write_edge(JsonWriter& json, const Edge& e, bool open) {
  const bool line = e.kind == geom::EdgeKind::line;
  json.begin_object().key(line ? "line" : "arc").begin_object();
  write_point(json, "from", e.from);
  write_point(json, "to", e.to);
  if (!line) {
    write_point(json, "centre", e.centre);
    json.field("ccw", e.kind == geom::EdgeKind::arc_ccw);
  }
  json.end();
  if (open) json.field("open", true);
  json.end();
}

void write_edges(JsonWriter& json, const Contour& edges) {
  json.list(edges, [&](const Edge& edge) { write_edge(json, edge); });
}

void write_region(JsonWriter& json, const geom::Region& region) {
  write_edges(json.begin_object().key("outer"), region.outer);
  json.key("holes").list(region.holes, [&](const Contour& hole) { write_edges(json, hole); });
  json.end();
}

}  // namespace lekalo::io::detail
