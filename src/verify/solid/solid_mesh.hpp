#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/verify/verify.hpp"
#include "verify/number/exact.hpp"
#include "verify/number/span.hpp"

namespace lekalo::verify {

/// Triangles over vertices, as a file has them: every coordinate is exactly what was written.
struct SolidMesh {
  std::vector<std::array<double, 3>> near;  ///< the nearest doubles
  /// The decimals of a text; empty where each coordinate is its double.
  std::vector<std::array<Decimal, 3>> written;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// The number of each triangle in the file, from 0 and ascending; closed() may leave some out.
  std::vector<std::uint32_t> numbers;
  /// Material may begin so far inside each triangle, enclosed (scan_widths.hpp); empty for a mesh taken as
  /// drawn.
  std::vector<Span> widths;

  /// Returns the triangle that has this number in the file; nothing where it is left out, or none.
  [[nodiscard]] std::optional<std::uint32_t> triangle_of_file(std::size_t number) const {
    const auto [found, end] = std::equal_range(numbers.begin(), numbers.end(), number);
    if (found == end) return std::nullopt;
    return static_cast<std::uint32_t>(found - numbers.begin());
  }
  [[nodiscard]] Span width(std::uint32_t triangle) const {
    return widths.empty() ? just(0) : widths[triangle];
  }
  [[nodiscard]] Span enclosed(std::uint32_t vertex, std::size_t axis) const {
    const double value = near[vertex][axis];
    return written.empty() ? just(value) : outwards(value, value);
  }
  [[nodiscard]] Fraction exact(std::uint32_t vertex, std::size_t axis) const {
    return written.empty() ? Fraction(near[vertex][axis]) : to_fraction(written[vertex][axis]);
  }
};

/// The unit of the numbers in a file; of the formats only 3MF says it.
enum class SolidUnit : std::uint8_t { millimetre, inch, metre, micron, centimetre, foot };
[[nodiscard]] Decimal millimetres_of(SolidUnit unit);

struct SolidReading {
  SolidMesh mesh;
  /// As the file says, or as it was asked to be read.
  SolidUnit unit = SolidUnit::millimetre;
  /// The names that a text STL, an OBJ or a 3MF gives its triangles, and of each triangle which one; both are
  /// empty where there are none.
  std::vector<std::string> groups;
  std::vector<std::uint32_t> group_of;
  /// The direction beside each point of a text; empty where there are none.
  std::vector<std::array<Decimal, 3>> directions;
  /// A mesh by lekalo-step says how far the body may be from the triangles at most, mm.
  std::optional<Decimal> deviation;
  /// The faces of its STEP file, of each triangle; else empty.
  std::vector<std::uint32_t> face_of;
  /// The colours that these have there, by their numbers, 65536 red + 256 green + blue; more where there is
  /// none. Empty where the file has no colours.
  std::vector<std::uint32_t> colours;
  /// Says what is not read here, and so not rechecked; the mesh is of no use then.
  std::optional<std::string> open;
};

/// Reads STL, OBJ, PLY or 3MF, told apart by content, as docs/formats.md says, with triangles alone.
/// bad_input names the line, or the triangle or row of a binary file. A millimetre is exactly so much of the
/// unit.
[[nodiscard]] Result<SolidReading> read_solid(const Document& document,
                                              SolidUnit unit = SolidUnit::millimetre);

/// Reads points: those of a text of points, or the vertices of one of these formats.
[[nodiscard]] Result<SolidReading> read_measured_points(const Document& document, SolidUnit unit);

/// Returns the mesh with one vertex at each place. Every edge belongs to an even number of triangles, else it
/// is refused with a place. Triangles with a corner twice are left out; those whose corners lie exactly on a
/// line, too, unless the surface closes along them.
[[nodiscard]] Result<SolidMesh> closed(SolidMesh mesh, const std::string& name);

}  // namespace lekalo::verify
