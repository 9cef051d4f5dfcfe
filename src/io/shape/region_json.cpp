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

/// The fields of a region, on lines of their own after so many blanks, and their items after one more.
void write_fields(JsonWriter& json, const Region& region, std::size_t indent, const std::vector<Edge>& open) {
  const auto write_contour = [&](const Contour& contour, std::size_t inside) {
    json.list_of_lines(contour, inside + 1, inside, [&](const Edge& e) {
      detail::write_edge(json, e, std::find(open.begin(), open.end(), e) != open.end());
    });
  };
  json.line(indent).key("outer");
  write_contour(region.outer, indent);
  json.line(indent).key("holes").list_of_lines(region.holes, indent + 1, indent,
                                               [&](const Contour& hole) { write_contour(hole, indent + 1); });
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
  JsonWriter json(JsonLayout::spaced);
  json.begin_object().line(1).field("units", "mm");
  if (regions.size() == 1) {
    write_fields(json, regions[0], 1, open);
  } else {
    json.line(1).key("pieces").list_of_lines(regions, 2, 1, [&](const Region& region) {
      write_fields(json.begin_object(), region, 3, open);
      json.line(2).end();
    });
  }
  json.line(0).end();
  return json.take() + "\n";
}

}  // namespace lekalo::io
