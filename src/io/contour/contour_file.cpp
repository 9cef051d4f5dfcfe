#include "lekalo/io/contour/contour_file.hpp"

#include <fmt/core.h>

#include "contour_points.hpp"
#include "lekalo/io/dxf/dxf.hpp"
#include "lekalo/io/text/format.hpp"
#include "lekalo/io/text/words.hpp"

namespace lekalo::io {

namespace {

Result<ContourFile> dispatch(std::string_view bytes, const std::string& name,
                             std::optional<LengthUnit> unit) {
  if (kPointsFormat.is_named_so(name))
    return read_text_contour(bytes, name, unit.value_or(LengthUnit::millimetre));
  if (kJsonFormat.is_named_so(name)) return read_json_contour(bytes, name, unit);
  if (drawing_dxf().file.is_named_so(name)) return read_dxf_contour(bytes, name, unit);
  const std::string ending = ending_of(name);
  return refuse(name,
                fmt::format("contours are read from .csv, .txt, .xyz, .json and .dxf files, not from {}",
                            ending.empty() ? "a name without ending" : excerpt(ending)));
}

}  // namespace

Result<ContourFile> parse_contour(std::string_view bytes, const std::string& name,
                                  std::optional<LengthUnit> unit) {
  if (const std::string fault = wrong_encoding(bytes); !fault.empty()) return refuse(name, fault);
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  Result<ContourFile> file = dispatch(bytes, name, unit);
  if (file && file->points.empty()) return refuse(name, "there are no points in this file");
  return file;
}

}  // namespace lekalo::io
