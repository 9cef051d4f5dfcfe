#include "lekalo/io/region_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "lekalo/base/assert.hpp"

namespace lekalo::io {

namespace {

using geom::Contour;
using geom::Edge;
using geom::EdgeKind;
using geom::Point;
using geom::Region;
using Json = nlohmann::json;

tl::unexpected<Error> refuse(const std::string& where, const std::string& why) {
  return failure(ErrorCode::bad_input, where + ": " + why);
}

/// Parses JSON in which no object says a key twice (the standard leaves open which one counts).
Result<Json> parse_json(std::string_view bytes, const std::string& name) {
  std::vector<std::set<std::string>> keys;
  std::string repeated;
  const auto watch = [&](int, Json::parse_event_t event, Json& value) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second) {
      repeated = value.get<std::string>();
    }
    return true;
  };
  try {
    Json json = Json::parse(bytes.begin(), bytes.end(), watch);
    if (!repeated.empty())
      return refuse(name, fmt::format("the key \"{}\" stands twice in one object", repeated));
    return json;
  } catch (const Json::parse_error& error) {
    const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, bytes.size()));
    return refuse(fmt::format("{}, line {}", name, 1 + std::count(bytes.begin(), end, '\n')),
                  "this is not JSON from here on");
  } catch (const Json::exception& error) {
    return refuse(name, fmt::format("this JSON cannot be read: {}", error.what()));
  }
}

/// Refuses values that are not objects, and words nobody here knows.
Result<void> expect_object(const Json& json, const std::string& where,
                           std::initializer_list<std::string_view> known) {
  if (!json.is_object()) return refuse(where, fmt::format("an object is needed, not {}", json.type_name()));
  for (const auto& item : json.items()) {
    if (std::find(known.begin(), known.end(), item.key()) != known.end()) continue;
    return refuse(where,
                  fmt::format("unknown word \"{}\"; known here: {}", item.key(), fmt::join(known, ", ")));
  }
  return {};
}

class Reader {
 public:
  explicit Reader(LengthUnit unit) : scale_(millimetres_per(unit)) {}

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
    }
    return edges;
  }

  [[nodiscard]] Result<Edge> edge(const Json& json, const std::string& where) const {
    if (const auto known = expect_object(json, where, {"line", "arc"}); !known)
      return tl::unexpected(known.error());
    if (json.size() != 1) return refuse(where, "an edge is one \"line\" or one \"arc\"");
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
      const Json nothing;
      const Json& value = json.contains(key) ? json[key] : nothing;
      if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number()) {
        return refuse(where, fmt::format("\"{}\" must be a point [x, y] of two numbers", key));
      }
      *point = {scale_ * value[0].get<double>(), scale_ * value[1].get<double>()};
    }
    return {};
  }

  double scale_;
};

Result<LengthUnit> unit_of(const Json& json, const std::string& name, std::optional<LengthUnit> said) {
  if (!json.contains("units")) return said.value_or(LengthUnit::millimetre);
  const Json& units = json["units"];
  if (units != "mm" && units != "inch") {
    return refuse(name, fmt::format("\"units\" is {}; \"mm\" and \"inch\" are known", units.dump()));
  }
  const LengthUnit unit = units == "mm" ? LengthUnit::millimetre : LengthUnit::inch;
  if (said && *said != unit) {
    return refuse(
        name, fmt::format("the file says \"units\": {}, which contradicts the unit asked for", units.dump()));
  }
  return unit;
}

double largest_coordinate(const std::vector<Region>& regions) {
  double largest = 0;
  const auto look = [&largest](const Contour& contour) {
    for (const Edge& e : contour) {
      for (const Point p : {e.from, e.centre}) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
    }
  };
  for (const Region& region : regions) {
    look(region.outer);
    for (const Contour& hole : region.holes) look(hole);
  }
  return largest;
}

/// Half a unit in the last place for reading; for inches as much again for 25.4, the product and the first
/// two together.
double coordinate_error(const std::vector<Region>& regions, LengthUnit unit) {
  return largest_coordinate(regions) * (unit == LengthUnit::inch ? 0x4p-53 : 0x1p-53);
}

// "-0" would be read back as the integer 0.
std::string number(double v) { return v == 0 && std::signbit(v) ? "-0.0" : fmt::format("{}", v); }

std::string point(Point p) { return fmt::format("[{}, {}]", number(p.x), number(p.y)); }

std::string edge_json(const Edge& e) {
  if (e.kind == EdgeKind::line) {
    return fmt::format(R"({{"line": {{"from": {}, "to": {}}}}})", point(e.from), point(e.to));
  }
  return fmt::format(R"({{"arc": {{"from": {}, "to": {}, "centre": {}, "ccw": {}}}}})", point(e.from),
                     point(e.to), point(e.centre), e.kind == EdgeKind::arc_ccw);
}

template <class T, class Write>
std::string list_json(const std::vector<T>& items, const std::string& indent, const Write& write) {
  if (items.empty()) return "[]";
  std::string text = "[";
  for (std::size_t i = 0; i < items.size(); ++i) {
    text += (i == 0 ? "\n" : ",\n") + indent + " " + write(items[i]);
  }
  return text + "\n" + indent + "]";
}

std::string region_json(const Region& region, const std::string& indent) {
  const auto contour = [&indent](const std::string& more) {
    return [inner = indent + more](const Contour& c) { return list_json(c, inner, edge_json); };
  };
  return fmt::format("{0}\"outer\": {1},\n{0}\"holes\": {2}", indent, contour("")(region.outer),
                     list_json(region.holes, indent, contour(" ")));
}

}  // namespace

Result<RegionFile> parse_regions(std::string_view bytes, const std::string& name,
                                 std::optional<LengthUnit> unit) {
  const auto json = parse_json(bytes, name);
  if (!json) return tl::unexpected(json.error());
  const bool several = json->is_object() && json->contains("pieces");
  const auto known =
      several ? expect_object(*json, name, {"name", "source", "units", "pieces"})
              : expect_object(*json, name, {"name", "source", "units", "outer", "holes", "islands"});
  if (!known) return tl::unexpected(known.error());
  const auto file_unit = unit_of(*json, name, unit);
  if (!file_unit) return tl::unexpected(file_unit.error());

  RegionFile file{name, *file_unit, {}, 0};
  const Reader reader(*file_unit);
  const auto add = [&](const Json& piece, const std::string& where) -> Result<void> {
    auto region = reader.region(piece, where);
    if (!region) return tl::unexpected(std::move(region.error()));
    file.regions.push_back(std::move(*region));
    return {};
  };
  if (several) {
    const Json& pieces = (*json)["pieces"];
    if (!pieces.is_array() || pieces.empty())
      return refuse(name, "\"pieces\" must be a list of at least one region");
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const std::string where = fmt::format("{}, piece {}", name, i);
      auto done = expect_object(pieces[i], where, {"outer", "holes", "islands"});
      if (done) done = add(pieces[i], where);
      if (!done) return tl::unexpected(std::move(done.error()));
    }
  } else if (auto done = add(*json, name); !done) {
    return tl::unexpected(std::move(done.error()));
  }
  file.coordinate_error = coordinate_error(file.regions, file.unit);
  return file;
}

std::string regions_json(const std::vector<Region>& regions) {
  LEKALO_ASSERT(!regions.empty());
  const auto piece = [](const Region& r) { return "{\n" + region_json(r, "   ") + "\n  }"; };
  const std::string body =
      regions.size() == 1 ? region_json(regions[0], " ") : " \"pieces\": " + list_json(regions, " ", piece);
  return "{\n \"units\": \"mm\",\n" + body + "\n}\n";
}

}  // namespace lekalo::io
