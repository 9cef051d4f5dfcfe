#include "contours.hpp"

#include <numeric>

namespace lekalo::cli {
namespace {

Result<Contour> as_convex(io::ContourFile file) {
  Result<io::ConvexContour> convex = io::make_convex(file);
  if (!convex) return tl::unexpected(convex.error());
  const std::size_t size = convex->polygon.size();
  Contour contour{std::move(file), convex->polygon, convex->coordinate_error, {}, {}, {}, std::nullopt, {}};
  for (std::size_t k = 0; k < size; ++k) {
    contour.vertex_in_result.push_back(static_cast<std::uint32_t>(convex->file_index_of_vertex[k]));
    contour.edge_in_result.push_back(static_cast<std::uint32_t>(convex->file_edge(k)));
  }
  contour.dropped = std::move(convex->dropped);
  contour.notices = std::move(convex->notices);
  return contour;
}

/// File indices of points equal to the one before, and of closing points: what a contour drops that is not
/// made convex by dropping collinear points.
std::vector<std::size_t> repeated_points(const geom::Ring& points) {
  std::size_t end = points.size();  // before the closing points
  while (end > 1 && points[end - 1] == points[0]) --end;
  std::vector<std::size_t> repeated;
  for (std::size_t k = 1; k < points.size(); ++k) {
    if (k >= end || points[k] == points[k - 1]) repeated.push_back(k);
  }
  return repeated;
}

Result<Contour> as_trimmed(io::ContourFile file, double tolerance) {
  Result<io::TrimmedContour> trimmed = io::trim_to_convex(file, tolerance);
  if (!trimmed) return tl::unexpected(trimmed.error());
  const std::size_t size = trimmed->polygon.size();
  std::vector<std::size_t> repeated = repeated_points(file.points);
  Contour contour{std::move(file),
                  trimmed->polygon,
                  trimmed->coordinate_error,
                  std::vector<std::uint32_t>(size),
                  {},
                  std::move(repeated),
                  io::TrimRecord{tolerance, trimmed->loss, trimmed->polygon.vertices()},
                  std::move(trimmed->notices)};
  std::iota(contour.vertex_in_result.begin(), contour.vertex_in_result.end(), 0U);
  contour.edge_in_result = contour.vertex_in_result;
  return contour;
}

}  // namespace

Result<Contour> read_contour(std::string_view bytes, const std::string& path, std::optional<LengthUnit> unit,
                             std::optional<double> trim) {
  Result<io::ContourFile> file = io::parse_contour(bytes, path, unit);
  if (!file) return tl::unexpected(file.error());
  std::vector<std::string> notices = std::move(file->notices);
  Result<Contour> contour = trim ? as_trimmed(std::move(*file), *trim) : as_convex(std::move(*file));
  if (contour) contour->notices.insert(contour->notices.begin(), notices.begin(), notices.end());
  return contour;
}

}  // namespace lekalo::cli
