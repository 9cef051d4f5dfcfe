#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/rounding.hpp"
#include "lekalo/io/text/words.hpp"
#include "report_page.hpp"

namespace lekalo::draw {
double draw_numbers(const Report& report, const ReportLook& look, const Rect& column, double top,
                    Sheet& sheet) {
  const io::LocateDocument& d = report.document;
  const locate::Placement& p = d.placement;
  ReportRows rows(column, sheet.heading(column, top, "Placement"), sheet);
  rows.add("minimum allowance", length_text(p.clearance, look.decimals, Rounding::down), "clearance",
           p.clearance < 0 ? kOutside : kInk, true);
  if (d.upper_bound) {
    const double gap = difference_rounded_up(*d.upper_bound, p.clearance);
    rows.add("proven upper bound", length_text(*d.upper_bound, look.decimals, Rounding::up), "upper-bound");
    rows.add("gap", short_number_up(gap) + (std::isfinite(gap) ? " mm" : ""), "gap");
  } else if (report.margin) {
    rows.add("margin of the demands", decimal(*report.margin, look.decimals, Rounding::down), "margin");
    rows.add("proven bound of it", decimal(*report.margin_bound, look.decimals, Rounding::up),
             "margin-bound");
  } else {
    rows.add("proven upper bound", "not proved", "upper-bound");
  }
  if (d.min_allowance > 0) rows.add("demanded", length_text(d.min_allowance, look.decimals), "min-allowance");
  if (d.shortfall > 0)
    rows.add("missing", length_text(d.shortfall, look.decimals, Rounding::up), "shortfall", kOutside, true);
  rows.add("x", length_text(p.x, look.decimals), "x");
  rows.add("y", length_text(p.y, look.decimals), "y");
  // The angle has as many digits as move the rim of the part by less than the last digit of x.
  rows.add("angle", decimal(p.theta * kDegreesPerRadian, 7) + "°", "theta-deg");
  if (report.document.mirrored) rows.add("mirrored", "in x, before turning", "mirrored");
  return rows.end();
}

double draw_contacts(const Report& report, const ReportLook& look, const Rect& column, double top,
                     std::size_t most_rows, Sheet& sheet) {
  if (report.contacts.empty()) return top;
  double y = sheet.heading(column, top, "Contacts, mm: where the part is nearest");
  ReportTable table({{"", 0.5, false},
                     {report.contacts_at_vertices ? "part vertex" : "part edge", 2},
                     {"blank edge", 2},
                     {"distance", 2},
                     {"x in blank", 2.1},
                     {"y", 1.9}},
                    column, sheet);
  y = table.titles(y);
  const std::size_t shown = std::min(report.contacts.size(), most_rows);
  for (std::size_t k = 0; k < shown; ++k) {
    const locate::Touch& contact = report.contacts[k];
    y = table.row(
        y,
        {contact_letter(k), fmt::format("{}", contact.part_edge), fmt::format("{}", contact.blank_edge),
         decimal(contact.distance, look.table_decimals), decimal(contact.blank.x, look.table_decimals - 1),
         decimal(contact.blank.y, look.table_decimals - 1)},
        {.size = kReportSmall, .kind = "contact-row"});
  }
  if (shown < report.contacts.size()) {
    sheet.text(column.x, y + kReportLine - 1, column.width,
               fmt::format("and {} more", report.contacts.size() - shown),
               {.size = kReportSmall, .colour = kGrey, .kind = "more-contacts"});
    y += kReportLine;
  }
  return y;
}

double draw_features(const Report& report, const ReportLook& look, const Rect& column, double top,
                     std::size_t most_rows, Sheet& sheet) {
  const std::vector<FeatureRow>& rows = report.features;
  double y = sheet.heading(column, top, "Allowance by feature, mm");
  const bool demands = std::any_of(rows.begin(), rows.end(), [](const FeatureRow& row) {
    return row.feature.minimum || row.feature.target || row.feature.maximum;
  });
  std::vector<ReportColumn> columns{{"feature", 4, false}, {"edges", 1},  {"length", 1.7},
                                    {"minimum", 1.7},      {"mean", 1.7}, {"maximum", 1.7}};
  if (demands) columns.insert(columns.end(), {{"demanded", 1.4}, {"target", 1.4}, {"at most", 1.4}});
  columns.push_back({"", 2.2});
  ReportTable table(columns, column, sheet);
  y = table.titles(y);
  // If not all find room, those that lack something are kept first and then the thinnest. The rows that are
  // kept stay in their own order.
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (rows.size() > most_rows) {
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      if (rows[a].met != rows[b].met) return !rows[a].met;
      return rows[a].minimum < rows[b].minimum;
    });
    order.resize(most_rows - 1);
    std::sort(order.begin(), order.end());
  }
  const auto optional = [&](const std::optional<double>& value) {
    return value ? decimal(*value, look.table_decimals) : std::string("–");
  };
  for (const std::size_t k : order) {
    const FeatureRow& row = rows[k];
    std::vector<std::string> cells{row.feature.name,
                                   fmt::format("{}", row.feature.edges.size()),
                                   decimal(row.length, look.table_decimals - 2),
                                   decimal(row.minimum, look.table_decimals, Rounding::down),
                                   decimal(row.mean, look.table_decimals - 1),
                                   decimal(row.maximum, look.table_decimals, Rounding::up)};
    if (demands) {
      for (const auto& value : {row.feature.minimum, row.feature.target, row.feature.maximum})
        cells.push_back(optional(value));
    }
    cells.push_back(row.verdict);
    y = table.row(y, cells, {.size = kReportSmall, .kind = "feature"}, row.met ? kGood : kOutside);
  }
  if (order.size() < rows.size()) {
    sheet.text(
        column.x, y + kReportLine - 1, column.width,
        fmt::format(
            "and {} more with no less than the thinnest here; every edge is in the file of --allowances",
            rows.size() - order.size()),
        {.size = kReportSmall, .colour = kGrey, .kind = "more-features"});
    y += kReportLine;
  }
  return y;
}

}  // namespace lekalo::draw
