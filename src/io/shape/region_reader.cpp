#include "region_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "io/text/decimal.hpp"

namespace lekalo::io::detail {

using geom::Contour;
using geom::Edge;
using geom::EdgeKind;
using geom::Point;
using geom::Region;

Result<Point> read_point(const Json& json, const std::string& where, const char* key, double scale) {
  const Json nothing;
  const Json& value = json.contains(key) ? json[key] : nothing;
  if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number()) {
    return refuse(where, fmt::format("\"{}\" must be a point [x, y] of two numbers", key));
  }
  return Point{scale * value[0].get<double>(), scale * value[1].get<double>()};
}

namespace {

class Reader {
 public:
  Reader(double scale, std::vector<Edge>* open) : scale_(scale), open_(open) {}

  [[nodiscard]] Result<Region> region(const Json& json, const std::string& where) const {
    if (!json.contains("outer"))
      return refuse(where, "\"outer\", the list of edges of the outline, is missing");
    if (json.contains("holes") && json.contains("islands")) {
      return refuse(where, "\"holes\" and \"islands\" mean the same; use one of them");
    }
    auto outer = contour(json["outer"], where + ", outer contour");
    if (!outer) return tl::unexpected(std::move(outer.error()));
    std::vector<Contour> holes;
    const char* const key = json.contains("islands") ? "islands" : "holes";
    const Json none = Json::array();
    const Json& lists = json.contains(key) ? json[key] : none;
    if (!lists.is_array()) return refuse(where, fmt::format("\"{}\" is not a list of contours", key));
    for (std::size_t i = 0; i < lists.size(); ++i) {
      auto hole = contour(lists[i], fmt::format("{}, hole {}", where, i));
      if (!hole) return tl::unexpected(std::move(hole.error()));
      holes.push_back(std::move(*hole));
    }
    return geom::make_region(std::move(*outer), std::move(holes)).map_error([&](Error error) {
      return Error{error.code, where + ", " + error.message};
    });
  }

 private:
  [[nodiscard]] Result<Contour> contour(const Json& json, const std::string& where) const {
    if (!json.is_array()) return refuse(where, "a list of edges is needed");
    Contour edges;
    for (std::size_t i = 0; i < json.size(); ++i) {
      auto read = edge(json[i], fmt::format("{}, edge {}", where, i));
      if (!read) return tl::unexpected(std::move(read.error()));
      edges.push_back(*read);
      if (json[i].contains("open") && json[i]["open"].get<bool>()) open_->push_back(*read);
    }
    return edges;
  }

  [[nodiscard]] Result<Edge> edge(const Json& json, const std::string& where) const {
    const auto known = open_ != nullptr ? expect_object(json, where, {"line", "arc", "open"})
                                        : expect_object(json, where, {"line", "arc"});
    if (!known) return tl::unexpected(known.error());
    const bool says_open = json.contains("open");
    if (says_open && !json["open"].is_boolean()) return refuse(where, "\"open\" must say true or false");
    if (json.size() != (says_open ? 2 : 1)) return refuse(where, "an edge is one \"line\" or one \"arc\"");
    return json.contains("line") ? line(json["line"], where) : arc(json["arc"], where);
  }

  [[nodiscard]] Result<Edge> line(const Json& json, const std::string& where) const {
    if (const auto known = expect_object(json, where, {"from", "to"}); !known)
      return tl::unexpected(known.error());
    Edge edge;
    if (const auto got = points(json, where, {{"from", &edge.from}, {"to", &edge.to}}); !got) {
      return tl::unexpected(got.error());
    }
    return edge;
  }

  [[nodiscard]] Result<Edge> arc(const Json& json, const std::string& where) const {
    if (const auto known = expect_object(json, where, {"from", "to", "centre", "ccw"}); !known) {
      return tl::unexpected(known.error());
    }
    if (!json.contains("ccw") || !json["ccw"].is_boolean()) {
      return refuse(where, "\"ccw\" must say true (counter-clockwise) or false");
    }
    Edge edge;
    edge.kind = json["ccw"].get<bool>() ? EdgeKind::arc_ccw : EdgeKind::arc_cw;
    const auto got = points(json, where, {{"from", &edge.from}, {"to", &edge.to}, {"centre", &edge.centre}});
    if (!got) return tl::unexpected(got.error());
    return edge;
  }

  [[nodiscard]] Result<void> points(const Json& json, const std::string& where,
                                    std::initializer_list<std::pair<const char*, Point*>> wanted) const {
    for (const auto& [key, point] : wanted) {
      const auto read = read_point(json, where, key, scale_);
      if (!read) return tl::unexpected(read.error());
      *point = *read;
    }
    return {};
  }

  double scale_;
  std::vector<Edge>* open_;
};

}  // namespace

Result<Region> read_region(const Json& json, const std::string& where, double scale,
                           std::vector<Edge>* open) {
  return Reader(scale, open).region(json, where);
}

}  // namespace lekalo::io::detail
