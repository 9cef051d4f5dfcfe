#include "lekalo/io/shape/region_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lekalo/base/assert.hpp"
#include "region_reader.hpp"
#include "region_text.hpp"

namespace lekalo::io {

namespace {

using geom::Contour;
using geom::Edge;
using geom::Point;
using geom::Region;

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

template <class T, class Write>
std::string list_json(const std::vector<T>& items, const std::string& indent, const Write& write) {
  if (items.empty()) return "[]";
  std::string text = "[";
  for (std::size_t i = 0; i < items.size(); ++i) {
    text += (i == 0 ? "\n" : ",\n") + indent + " " + write(items[i]);
  }
  return text + "\n" + indent + "]";
}

std::string region_json(const Region& region, const std::string& indent, const std::vector<Edge>& open) {
  const auto edge = [&](const Edge& e) {
    std::string text = detail::edge_text(e);
    if (std::find(open.begin(), open.end(), e) != open.end())
      text.insert(text.size() - 1, ", \"open\": true");
    return text;
  };
  const auto contour = [&](const std::string& more) {
    return [&edge, inner = indent + more](const Contour& c) { return list_json(c, inner, edge); };
  };
  return fmt::format("{0}\"outer\": {1},\n{0}\"holes\": {2}", indent, contour("")(region.outer),
                     list_json(region.holes, indent, contour(" ")));
}

}  // namespace

Result<RegionFile> parse_regions(std::string_view bytes, const std::string& name,
                                 std::optional<LengthUnit> unit, std::vector<Edge>* open) {
  using namespace detail;
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
  const auto add = [&](const Json& piece, const std::string& where) -> Result<void> {
    auto region = read_region(piece, where, millimetres_per(*file_unit), open);
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

std::string regions_json(const std::vector<Region>& regions, const std::vector<Edge>& open) {
  LEKALO_ASSERT(!regions.empty());
  const auto piece = [&](const Region& r) { return "{\n" + region_json(r, "   ", open) + "\n  }"; };
  const std::string body = regions.size() == 1 ? region_json(regions[0], " ", open)
                                               : " \"pieces\": " + list_json(regions, " ", piece);
  return "{\n \"units\": \"mm\",\n" + body + "\n}\n";
}

}  // namespace lekalo::io
