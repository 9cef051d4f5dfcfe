#include <fmt/core.h>

#include <utility>

#include "contour_points.hpp"
#include "io/text/rows.hpp"

namespace lekalo::io {

Result<ContourFile> read_text_contour(std::string_view bytes, const std::string& name, LengthUnit unit) {
  ContourFile file;
  file.name = name;
  file.unit = unit;
  std::size_t third_numbers = 0;
  const auto take = [&](const TextRow& row) -> Result<void> {
    third_numbers += row.count - 2;
    if (!append_point(file, row.numbers[0], row.numbers[1], row.line))
      return refuse_line(name, row.line, too_many_points());
    return {};
  };
  LEKALO_CHECK(read_text_rows(bytes, name, decimal_factor(unit), take, file.notices));
  if (third_numbers > 0) {
    file.notices.push_back(fmt::format("{}: the third number of {} line{} (z) is ignored", name,
                                       third_numbers, third_numbers == 1 ? "" : "s"));
  }
  return file;
}

}  // namespace lekalo::io
