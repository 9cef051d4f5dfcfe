#include "shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "lekalo/geom/region_check.hpp"
#include "lekalo/io/contour_file.hpp"
#include "lekalo/io/region_json.hpp"

namespace lekalo::cli {
namespace {

/// Points of curves move by no more than this many times what their edges' coordinates do: both coordinates
/// of an end, and what an arc's centre and radius add.
constexpr double kOutlinePerCoordinate = 4;

bool is_region_form(std::string_view bytes, const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".json" && (bytes.find("\"outer\"") != std::string_view::npos ||
                               bytes.find("\"pieces\"") != std::string_view::npos);
}

bool is_convex_polygon(const std::vector<geom::Region>& regions) {
  if (regions.size() != 1 || !regions[0].holes.empty()) return false;
  const geom::Contour& outer = regions[0].outer;
  for (std::size_t k = 0; k < outer.size(); ++k) {
    const geom::Edge &edge = outer[k], &next = outer[(k + 1) % outer.size()];
    if (edge.kind != geom::EdgeKind::line || geom::orientation(edge.from, edge.to, next.to) < 0) return false;
  }
  return true;
}

Result<std::vector<geom::Region>> region_of_points(const io::ContourFile& file) {
  geom::Ring ring;
  for (const geom::Point& p : file.points)
    if (ring.empty() || !(p == ring.back())) ring.push_back(p);
  while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
  if (ring.size() < 3)
    return failure(ErrorCode::bad_input, fmt::format("{}: fewer than three different points", file.name));
  geom::Contour outer;
  for (std::size_t k = 0; k < ring.size(); ++k)
    outer.push_back({geom::EdgeKind::line, ring[k], ring[(k + 1) % ring.size()], {}});
  Result<geom::Region> region = geom::make_region(std::move(outer));
  if (!region) return failure(region.error().code, file.name + ": " + region.error().message);
  return std::vector<geom::Region>{std::move(*region)};
}

Result<Shape> checked(Shape shape, const std::string& path) {
  if (const auto fault = geom::fault_of(shape.regions))
    return failure(ErrorCode::bad_input, fmt::format("{}: {}; outlines must not meet", path, *fault));
  return shape;
}

}  // namespace

bool needs_regions(std::string_view bytes, const std::string& path) {
  if (!is_region_form(bytes, path)) return false;
  const Result<io::RegionFile> file = io::parse_regions(bytes, path, std::nullopt);
  return !file || !is_convex_polygon(file->regions);
}

Result<Shape> read_shape(std::string_view bytes, const std::string& path, std::optional<LengthUnit> unit) {
  if (is_region_form(bytes, path)) {
    Result<io::RegionFile> file = io::parse_regions(bytes, path, unit);
    if (!file) return tl::unexpected(file.error());
    return checked({std::move(file->regions), kOutlinePerCoordinate * file->coordinate_error, {}}, path);
  }
  Result<io::ContourFile> file = io::parse_contour(bytes, path, unit);
  if (!file) return tl::unexpected(file.error());
  Result<std::vector<geom::Region>> regions = region_of_points(*file);
  if (!regions) return tl::unexpected(regions.error());
  return checked(
      {std::move(*regions), kOutlinePerCoordinate * file->coordinate_error, std::move(file->notices)}, path);
}

}  // namespace lekalo::cli
