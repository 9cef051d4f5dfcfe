#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/limits.hpp"
#include "lekalo/io/text/format.hpp"
#include "lekalo/solid/mesh.hpp"

namespace lekalo::io {

/// Most vertices, and most triangles, of the file of a solid; more are refused.
inline constexpr std::size_t kMostSolidVertices = limits::kMostSolidItems,
                             kMostSolidTriangles = limits::kMostSolidItems;

/// The unit of the numbers in a file of a solid; of the formats only 3MF says it, and may say the last three.
enum class SolidUnit : std::uint8_t { millimetre, inch, metre, micron, centimetre, foot };
/// The word for it: mm, inch, m, micron, cm or foot.
[[nodiscard]] const char* name_of(SolidUnit unit) noexcept;

struct SolidOptions {
  /// Millimetres without, with a notice.
  std::optional<SolidUnit> units;
};

/// The triangles of a file, or its points, as they stand there: nothing is joined, turned or left out
/// (solid::closed_mesh does). Millimetres.
struct SolidFile {
  std::string name;
  std::string_view format;  ///< "STL", "OBJ", "PLY", "3MF" or "points"
  SolidUnit unit = SolidUnit::millimetre;
  solid::Mesh mesh;  ///< no triangles: the file holds points
  /// The direction beside each point, of any length but 0 and without a unit; empty where the file gives
  /// none.
  std::vector<solid::Vector> directions;
  /// The names that the file gives to parts of the surface, each once, and which of them each triangle has;
  /// both empty where it gives none. A triangle before the first name has the name "".
  std::vector<std::string> groups;
  std::vector<std::uint32_t> group_of_triangle;
  /// Every coordinate is within this of the number in the file, mm.
  double coordinate_error = 0;
  /// A mesh by lekalo-step has one: no point of a triangle is farther from the body that it stands for, and
  /// back, mm.
  std::optional<double> deviation;
  /// The number of each triangle's face in the STEP file, of a mesh by lekalo-step; else empty.
  std::vector<std::uint32_t> face_of_triangle;
  /// The colour of each face there, by its number: 65536 red + 256 green + blue, each from 0 to 255;
  /// kNoColour of one without. Empty of other meshes, and where an older lekalo-step made it.
  static constexpr std::uint32_t kNoColour = 0x1000000;
  std::vector<std::uint32_t> colour_of_face;
  std::vector<std::string> notices;
};

/// The format of a solid or of points in space by what is in the bytes, however their file is called: STL,
/// OBJ, PLY, 3MF or points; nullptr for anything else. It looks at the beginning and at the number of the
/// bytes, and of an archive for the name of a model.
[[nodiscard]] const FileFormat* solid_format_by_content(std::string_view bytes);

/// Says whether a file holds a solid and can hold nothing else: STL, OBJ or 3MF by its content, or by its
/// name where the content fits no format; by that, too, models that are not read (STEP, IGES, OFF). PLY and
/// points may also be measured outlines.
[[nodiscard]] bool is_only_solid(std::string_view bytes, const std::string& name);

/// Reads STL (text and binary), OBJ, PLY (text and binary, either order), 3MF and text of points "x y z",
/// maybe with a direction "nx ny nz" (docs/formats.md), told apart by their content. The ending of the name
/// says what was meant where the content fits none.
///
/// Fails with bad_input and one sentence that names file, line, triangle or row, what stands there and the
/// way out. Cost: O(bytes), and for faces with dents the square of their corners, 2,000 at most. Memory: at
/// most 100 bytes for a byte of the file; of a 3MF for a byte of its models, which are at most 100 times as
/// long as they are packed.
[[nodiscard]] Result<SolidFile> parse_solid(std::string_view bytes, const std::string& name,
                                            const SolidOptions& options = {});

/// A number and a colour at each vertex of a mesh, for other viewers.
struct PlyLook {
  std::vector<double> quality;
  std::vector<std::array<std::uint8_t, 3>> colours;  ///< red, green, blue
};

/// The mesh as binary PLY, little-endian: every coordinate is the double itself. \pre at most 2^31 vertices;
/// a look has one entry of each kind for each of them, or none
[[nodiscard]] std::string ply_text(const solid::Mesh& mesh, const PlyLook& look = {});

}  // namespace lekalo::io
