#pragma once

#include <array>
#include <string>
#include <string_view>

namespace lekalo::io {

/// How the files of one format are told from others; whoever reads a file asks here and then calls the
/// reader. The formats of drawings stand with their readers (io/formats/drawing_formats.hpp has the list),
/// the other formats that hold outlines stand here.
struct FileFormat {
  std::string_view name;                      ///< for sentences: "DXF"
  std::array<std::string_view, 3> endings{};  ///< of file names, small letters with the point; unused: empty
  std::string_view first_bytes{};             ///< any of them begins such a file; empty: none is its own

  std::string_view signature{};  ///< how its binary form begins; empty: there is none

  /// By the ending of the file's name, in any case.
  [[nodiscard]] bool is_named_so(const std::string& file_name) const;
  /// By the signature, or by the first byte after blanks and a byte order mark.
  [[nodiscard]] bool begins_so(std::string_view bytes) const;
};

/// Lines of numbers.
inline constexpr FileFormat kPointsFormat{"points", {".csv", ".txt", ".xyz"}};
/// Regions, trees of primitives, points, layouts and jobs.
inline constexpr FileFormat kJsonFormat{"JSON", {".json"}, "{["};
/// Measured points.
inline constexpr FileFormat kPlyFormat{"PLY", {".ply"}};
/// Triangles of a solid; what is in the bytes of a PLY and of points says whether they are one, too
/// (io/solid/solid_file.hpp).
inline constexpr FileFormat kStlFormat{"STL", {".stl"}};
inline constexpr FileFormat kObjFormat{"OBJ", {".obj"}};
inline constexpr FileFormat kThreeMfFormat{"3MF", {".3mf"}};

}  // namespace lekalo::io
