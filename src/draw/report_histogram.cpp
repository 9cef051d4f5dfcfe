#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "report_page.hpp"

namespace lekalo::draw {
namespace {

constexpr std::size_t kBins = 32;
constexpr double kHeight = 22;  ///< of the bars, mm of paper

struct Histogram {
  double low = 0, high = 1;
  std::vector<double> share;  ///< of the length, sums to 1

  [[nodiscard]] double width() const { return (high - low) / static_cast<double>(share.size()); }
};

/// Sums the length over each range of allowances. Between samples the allowance is taken to run straight.
Histogram histogram_of(const Report& report, const ReportLook& look) {
  Histogram h{std::min(look.least, look.range.low), std::max(look.greatest, look.range.high),
              std::vector<double>(kBins)};
  double total = 0;
  const auto place = [&](double value) {
    const double bin = (value - h.low) / h.width();
    return std::clamp(bin, 0.0, static_cast<double>(kBins));
  };
  for (const locate::EdgeAllowance& edge : report.edges) {
    for (std::size_t k = 0; k + 1 < edge.samples.size(); ++k) {
      const double length = edge.samples[k + 1].along - edge.samples[k].along;
      const double a = place(edge.samples[k].allowance), b = place(edge.samples[k + 1].allowance);
      const double from = std::min(a, b), to = std::max(a, b);
      total += length;
      const auto first = std::min(static_cast<std::size_t>(from), kBins - 1);
      const auto last = std::min(static_cast<std::size_t>(to), kBins - 1);
      for (std::size_t bin = first; bin <= last; ++bin) {
        const double start = std::max(from, static_cast<double>(bin));
        const double end = bin + 1 == kBins ? to : std::min(to, static_cast<double>(bin + 1));
        h.share[bin] += first == last ? length : length * std::max(0.0, end - start) / (to - from);
      }
    }
  }
  if (total > 0)
    for (double& share : h.share) share /= total;
  return h;
}

}  // namespace

double draw_histogram(const Report& report, const ReportLook& look, const Rect& column, double top,
                      Sheet& sheet) {
  const Histogram h = histogram_of(report, look);
  const double step = tick_step(h.low, h.high, column.width, kReportSmall);
  const LengthScale unit = length_scale(step, std::max(std::abs(h.low), std::abs(h.high)));
  double y = sheet.heading(column, top, "Allowance along the outline, " + unit.unit_name);
  const double most = *std::max_element(h.share.begin(), h.share.end());
  y += kReportSmall + 0.8;
  const double demanded = report.document.min_allowance;
  const bool demand_shown = demanded > 0 && demanded > h.low && demanded < h.high;
  sheet.text(column.x, y, column.width,
             fmt::format("share of the outline's length; the highest bar is {:.0f} %{}", 100 * most,
                         demand_shown ? "; dashed: demanded" : ""),
             {.size = kReportSmall, .colour = kGrey, .kind = "histogram-title"});
  y += 1.2;
  const double base = y + kHeight;
  const double too_thin = *std::min_element(report.demanded.begin(), report.demanded.end());
  const auto x_of = [&](double value) {
    return column.x + column.width * std::clamp((value - h.low) / (h.high - h.low), 0.0, 1.0);
  };
  for (std::size_t k = 0; k < kBins; ++k) {
    if (!(h.share[k] > 0)) continue;
    const double from = h.low + static_cast<double>(k) * h.width(), middle = from + 0.5 * h.width();
    const Colour colour =
        middle < too_thin ? kOutside : scale_colour(scale_step(middle, look.range.low, look.range.high));
    const double height = std::max(0.15, kHeight * h.share[k] / most);
    const Rect bar{x_of(from), base - height, column.width / kBins, height};
    sheet.items().push_back(PathItem{
        {bar.ring()},
        true,
        filled(colour),
        {"histogram-bar", fmt::format("{} to {} mm: {} %", from, from + h.width(), 100 * h.share[k])}});
  }
  sheet.path({{column.x, base}, {column.right(), base}}, false, stroked(kInk, 0.25), "axis");
  // The bar below the histogram has the colours of the drawing.
  const double bar_top = base + 0.6, bar_bottom = bar_top + 2;
  const double from = x_of(look.range.low), to = x_of(look.range.high);
  if (h.low < 0) {
    const Rect outside{column.x, bar_top, x_of(std::min(0.0, h.high)) - column.x, bar_bottom - bar_top};
    sheet.path(outside.ring(), true, filled(kOutside), "scale-outside");
  }
  if (look.greatest >= 0) {
    for (int k = 0; k < kColourSteps; ++k) {
      // Each colour reaches to the end of the bar and is covered by the next one, so that there are no seams.
      const double x = from + (to - from) * k / kColourSteps;
      sheet.path({{x, bar_top}, {to, bar_top}, {to, bar_bottom}, {x, bar_bottom}}, true,
                 filled(scale_colour(k)), "scale");
    }
  }
  const double numbers = bar_bottom + 1 + kReportSmall;
  for (double k = std::ceil(h.low / step * (h.low > 0 ? 1 - 1e-12 : 1 + 1e-12));
       k * step <= h.high + 1e-12 * step; ++k) {
    const double value = k * step, x = x_of(value);
    sheet.path({{x, bar_bottom}, {x, bar_bottom + 0.8}}, false, stroked(kInk, 0.2), "tick");
    const std::string number = unit.text(value);
    const double half = 0.5 * kReportSmall * io::text_width(number);
    sheet.text(std::clamp(x, column.x + half, column.right() - half), numbers, column.width, number,
               {.size = kReportSmall, .anchor = Anchor::middle, .kind = "tick-label"});
  }
  if (demand_shown) {
    const double x = x_of(demanded);
    sheet.path({{x, y}, {x, base}}, false, stroked(kOutside, 0.3, 0.8), "demand");
  }
  return numbers + 1;
}

}  // namespace lekalo::draw
