#include "region_reader.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "io/text/decimal.hpp"
#include "lekalo/geom/chain.hpp"

namespace lekalo::io::detail {

using geom::Contour;
using geom::Edge;
using geom::EdgeKind;
using geom::Point;
using geom::Region;

Result<Point> read_point(JsonValue json, const std::string& where, const char* key, double scale) {
  const auto value = json.find(key);
  const auto point = value ? two_numbers(*value) : std::nullopt;
  if (!point) return refuse(where, fmt::format("\"{}\" must be a point [x, y] of two numbers", key));
  const Point mm = scale * *point;
  if (!(std::abs(mm.x) <= kLargestMillimetres && std::abs(mm.y) <= kLargestMillimetres))
    return refuse(where, fmt::format("\"{}\" is ({:.10g}, {:.10g}) mm; coordinates go up to {:g} mm", key,
                                     mm.x, mm.y, kLargestMillimetres));
  return mm;
}

namespace {

class Reader {
 public:
  Reader(double scale, std::vector<Edge>* open) : scale_(scale), open_(open) {}

  [[nodiscard]] Result<Region> region(JsonValue json, const std::string& where) const {
    const auto outline = json.find("outer"), said_holes = json.find("holes"), islands = json.find("islands");
    if (!outline) return refuse(where, "\"outer\", the list of edges of the outline, is missing");
    if (said_holes && islands)
      return refuse(where, "\"holes\" and \"islands\" mean the same; use one of them");
    LEKALO_TRY(auto outer, contour(*outline, where + ", outer contour"));
    std::vector<Contour> holes;
    if (const auto lists = islands ? islands : said_holes) {
      if (lists->kind() != JsonKind::list)
        return refuse(where, fmt::format("\"{}\" is not a list of contours", lists->key()));
      for (const JsonValue list : *lists) {
        LEKALO_TRY(auto hole, contour(list, fmt::format("{}, hole {}", where, holes.size())));
        holes.push_back(std::move(hole));
      }
    }
    return geom::make_region(std::move(outer), std::move(holes)).map_error([&](Error error) {
      return Error{error.code, where + ", " + error.message};
    });
  }

  [[nodiscard]] Result<Contour> contour(JsonValue json, const std::string& where) const {
    if (json.kind() != JsonKind::list) return refuse(where, "a list of edges is needed");
    Contour edges;
    for (const JsonValue item : json) {
      LEKALO_TRY(const auto read, edge(item, fmt::format("{}, edge {}", where, edges.size())));
      edges.push_back(read);
      if (const auto open = item.find("open"); open && open->truth()) open_->push_back(read);
    }
    return edges;
  }

 private:
  [[nodiscard]] Result<Edge> edge(JsonValue json, const std::string& where) const {
    LEKALO_CHECK(open_ != nullptr ? expect_object(json, where, {"line", "arc", "open"})
                                  : expect_object(json, where, {"line", "arc"}));
    const auto open = json.find("open");
    if (open && open->kind() != JsonKind::boolean) return refuse(where, "\"open\" must say true or false");
    if (json.size() != (open ? 2 : 1)) return refuse(where, "an edge is one \"line\" or one \"arc\"");
    const auto straight = json.find("line");
    return straight ? line(*straight, where) : arc(*json.find("arc"), where);
  }

  [[nodiscard]] Result<Edge> line(JsonValue json, const std::string& where) const {
    LEKALO_CHECK(expect_object(json, where, {"from", "to"}));
    Edge edge;
    LEKALO_CHECK(points(json, where, {{"from", &edge.from}, {"to", &edge.to}}));
    return edge;
  }

  [[nodiscard]] Result<Edge> arc(JsonValue json, const std::string& where) const {
    LEKALO_CHECK(expect_object(json, where, {"from", "to", "centre", "ccw"}));
    const auto ccw = json.find("ccw");
    if (!ccw || ccw->kind() != JsonKind::boolean)
      return refuse(where, "\"ccw\" must say true (counter-clockwise) or false");
    Edge edge;
    edge.kind = ccw->truth() ? EdgeKind::arc_ccw : EdgeKind::arc_cw;
    LEKALO_CHECK(points(json, where, {{"from", &edge.from}, {"to", &edge.to}, {"centre", &edge.centre}}));
    return edge;
  }

  [[nodiscard]] Result<void> points(JsonValue json, const std::string& where,
                                    std::initializer_list<std::pair<const char*, Point*>> wanted) const {
    for (const auto& [key, point] : wanted) {
      LEKALO_TRY(*point, read_point(json, where, key, scale_));
    }
    return {};
  }

  double scale_;
  std::vector<Edge>* open_;
};

}  // namespace

Result<Region> read_region(JsonValue json, const std::string& where, double scale, std::vector<Edge>* open) {
  return Reader(scale, open).region(json, where);
}

Result<geom::Contour> read_chain(JsonValue json, const std::string& where) {
  LEKALO_TRY(Contour edges, Reader(1, nullptr).contour(json, where));
  return geom::make_chain(std::move(edges)).map_error([&](Error error) {
    return Error{error.code, where + ", " + error.message};
  });
}

}  // namespace lekalo::io::detail
