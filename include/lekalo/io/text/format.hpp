#pragma once

#include <string>
#include <string_view>

namespace lekalo::io {

/// The forms of files that hold outlines. One table (src/io/text/format.cpp) says how each is told apart; who
/// reads a file asks here and then calls the reader of the form.
enum class Format {
  points,  ///< lines of numbers: .csv, .txt, .xyz
  json,    ///< regions, trees of primitives, points, layouts and jobs
  dxf,
  svg,
  ply,    ///< measured points
  unknown
};

/// By the ending of the name, in any case.
[[nodiscard]] Format format_by_ending(const std::string& name);

/// By the first byte after blanks and a byte order mark. Points and PLY are not told apart so: `unknown`.
[[nodiscard]] Format format_by_content(std::string_view bytes);

}  // namespace lekalo::io
