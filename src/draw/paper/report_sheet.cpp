#include "report_sheet.hpp"

#include <algorithm>

namespace lekalo::draw {

void Sheet::text(double x, double baseline, double width, const std::string& words, const TextStyle& style) {
  constexpr double kSmallest = 0.8;
  const double room = width / (style.bold ? kReportBoldWider : 1);
  const std::string shown = io::shortened(words, room / (kSmallest * style.size));
  if (shown.empty()) return;
  items_.push_back(TextItem{{x, baseline},
                            shown,
                            io::fitting_size(shown, style.size, room),
                            style.anchor,
                            style.colour,
                            style.bold,
                            {style.kind, ""}});
}

double Sheet::paragraph(const Rect& column, double baseline, const std::string& words, const TextStyle& style,
                        double line, std::size_t most_lines, std::size_t* used) {
  const std::vector<std::string> lines = io::wrapped(words, column.width / style.size, most_lines);
  for (const std::string& one : lines) {
    text(column.x, baseline, column.width, one, style);
    baseline += line;
  }
  if (used != nullptr) *used += lines.size();
  return baseline;
}

double Sheet::heading(const Rect& column, double y, const std::string& words) {
  text(column.x, y + 3.2, column.width, words, {.size = 3.2, .bold = true, .kind = "heading"});
  rule(column.x, column.right(), y + 4.6);
  return y + 4.8;
}

void Sheet::path(const geom::Ring& line, bool closed, const Paint& paint, const char* kind) {
  items_.push_back(PathItem{{line}, closed, paint, {kind, ""}});
}

void Sheet::rule(double from, double to, double y) {
  path({{from, y}, {to, y}}, false, stroked(kRule, 0.3), "rule");
}

}  // namespace lekalo::draw
