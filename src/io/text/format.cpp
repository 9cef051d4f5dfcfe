#include "lekalo/io/text/format.hpp"

#include <array>

#include "lekalo/io/text/words.hpp"

namespace lekalo::io {
namespace {

struct FormatRow {
  Format format;
  std::array<std::string_view, 3> endings;
  std::string_view first_bytes;  ///< any of them begins such a file; empty: none is its own
};

constexpr std::array<FormatRow, 5> kFormats{{{Format::points, {".csv", ".txt", ".xyz"}, ""},
                                             {Format::json, {".json"}, "{["},
                                             {Format::dxf, {".dxf"}, "0123456789"},
                                             {Format::svg, {".svg"}, "<"},
                                             {Format::ply, {".ply"}, ""}}};

}  // namespace

Format format_by_ending(const std::string& name) {
  const std::string ending = ending_of(name);
  if (ending.empty()) return Format::unknown;
  for (const FormatRow& row : kFormats)
    for (const std::string_view one : row.endings)
      if (ending == one) return row.format;
  return Format::unknown;
}

Format format_by_content(std::string_view bytes) {
  const std::size_t begin = bytes.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  if (begin == std::string_view::npos) return Format::unknown;
  for (const FormatRow& row : kFormats)
    if (row.first_bytes.find(bytes[begin]) != std::string_view::npos) return row.format;
  return Format::unknown;
}

}  // namespace lekalo::io
