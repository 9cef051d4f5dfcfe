#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "lekalo/geom/predicates.hpp"
#include "lekalo/io/contour/contour_file.hpp"
#include "support/ring_distance.hpp"

namespace lekalo::fuzz {

inline void must(bool condition) {
  if (!condition) std::abort();
}

inline void check_sentence(const Error& error, const std::string& name) {
  must(error.code == ErrorCode::bad_input);
  must(error.message.rfind(name, 0) == 0 && error.message.size() < 1000);
  must(std::all_of(error.message.begin(), error.message.end(),
                   [](char c) { return static_cast<unsigned char>(c) >= 0x20 && c != 0x7f; }));
}

inline void check_convex(const io::ContourFile& file, const io::ConvexContour& contour) {
  const std::size_t n = file.points.size(), m = contour.polygon.size();
  must(m >= 3 && contour.file_index_of_vertex.size() == m && m + contour.dropped.size() == n);
  std::vector<bool> seen(n, false);
  for (const auto* indices : {&contour.file_index_of_vertex, &contour.dropped}) {
    for (const std::size_t i : *indices) {
      must(i < n && !seen[i]);
      seen[i] = true;
    }
  }
  must(std::is_sorted(contour.dropped.begin(), contour.dropped.end()));
  for (std::size_t k = 0; k < m; ++k) {
    must(file.points[contour.file_index_of_vertex[k]] == contour.polygon[k]);
    const std::size_t next = contour.polygon.next(k);
    must(geom::orientation(contour.polygon[k], contour.polygon[next],
                           contour.polygon[contour.polygon.next(next)]) > 0);
    must(contour.file_edge(k) == contour.file_index_of_vertex[contour.reversed ? next : k]);
  }
  must(contour.coordinate_error >= file.coordinate_error);
  if (n * m > 100'000) return;
  const double size = geom::largest_coordinate(file.points);
  for (const geom::Point p : file.points) {
    must(cases::distance_to_boundary(p, contour.polygon.vertices()) <=
         contour.coordinate_error - file.coordinate_error + 4e-15 * size);
  }
}

inline void check_trimmed(const io::ContourFile& file, const io::TrimmedContour& trimmed) {
  const geom::Ring& inner = trimmed.polygon.vertices();
  must(trimmed.loss >= 0);
  if (file.points.size() * inner.size() > 100'000) return;
  for (const geom::Point v : inner) must(geom::locate_point(file.points, v) != geom::PointLocation::outside);
  for (std::size_t i = 0; i < file.points.size(); ++i) {
    const geom::Point a = file.points[i], b = file.points[(i + 1) % file.points.size()];
    must(geom::locate_point(inner, a) != geom::PointLocation::inside);
    for (std::size_t k = 0; k < inner.size(); ++k) {
      must(geom::segment_relation(a, b, inner[k], inner[trimmed.polygon.next(k)]) !=
           geom::SegmentRelation::cross);
    }
  }
}

/// Everything that must hold whatever the bytes are.
inline void check_contour(const std::uint8_t* data, std::size_t size, const std::string& name) {
  if (size == 0) return;
  const std::optional<LengthUnit> unit = data[0] % 2 == 0 ? std::nullopt : std::optional(LengthUnit::inch);
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const auto file = io::parse_contour(bytes, name, unit);
  if (!file) return check_sentence(file.error(), name);
  must(!file->points.empty() && file->places.size() == file->points.size());
  must(file->coordinate_error >= 0 && file->coordinate_error <= 0x1p-24);
  for (const geom::Point p : file->points) {
    must(std::max(std::abs(p.x), std::abs(p.y)) <= 1e9 && geom::is_exact(p));
  }
  if (const auto contour = io::make_convex(*file)) {
    check_convex(*file, *contour);
  } else {
    check_sentence(contour.error(), name);
  }
  if (const auto trimmed = io::trim_to_convex(*file, 1 + data[0])) {
    check_trimmed(*file, *trimmed);
  } else {
    check_sentence(trimmed.error(), name);
  }
}

}  // namespace lekalo::fuzz
