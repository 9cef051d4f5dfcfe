#include "lekalo/io/shape/region_json.hpp"

#include <fmt/core.h>

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

/// Reading errs by half a unit in the last place; inches by as much again for 25.4, for the product, and for
/// the first two together.
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
  LEKALO_TRY(const auto tree, JsonTree::parse(bytes, name));
  const JsonValue root = tree.root();
  const auto pieces = root.find("pieces");
  LEKALO_CHECK(pieces ? expect_object(root, name, {"name", "source", "units", "pieces"})
                      : expect_object(root, name, {"name", "source", "units", "outer", "holes", "islands"}));
  LEKALO_TRY(const auto file_unit, unit_of(root, name, unit));

  RegionFile file{name, file_unit, {}, 0};
  const auto add = [&](JsonValue piece, const std::string& where) -> Result<void> {
    LEKALO_TRY(auto region, read_region(piece, where, millimetres_per(file_unit), open));
    file.regions.push_back(std::move(region));
    return {};
  };
  if (pieces) {
    if (pieces->kind() != JsonKind::list || pieces->size() == 0)
      return refuse(name, "\"pieces\" must be a list of at least one region");
    for (const JsonValue piece : *pieces) {
      const std::string where = fmt::format("{}, piece {}", name, file.regions.size());
      LEKALO_CHECK(expect_object(piece, where, {"outer", "holes", "islands"}));
      LEKALO_CHECK(add(piece, where));
    }
  } else {
    LEKALO_CHECK(add(root, name));
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
