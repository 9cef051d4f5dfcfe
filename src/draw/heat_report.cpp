#include <algorithm>
#include <utility>

#include "draw/paper/colour.hpp"
#include "heat_layers.hpp"
#include "lekalo/draw/heat_scene.hpp"
#include "report_parts.hpp"

namespace lekalo::draw {
namespace {

constexpr double kHeatReportStrip = 22, kHeatReportMost = 62, kHeatReportLeast = 40;

class HeatReportPage {
 public:
  explicit HeatReportPage(const HeatReport& report) : report_(report) {}

  Scene compose() && {
    page_.width = kReportPage.width, page_.height = kReportPage.height;
    page_.title = "Heat report: " + report_.scene.name;
    page_.description = report_.scene.title[0];
    page_.items.push_back(PathItem{{kReportPage.ring()}, true, filled(kPaper), {"page", ""}});
    Sheet sheet(page_.items);
    const double top = draw_report_header(report_.title, report_.subtitle, report_.status, sheet);
    const double room = kReportFrame.bottom() - kReportFooter - top;
    // Notes that find no room are counted on the page.
    while (height(kHeatReportLeast) > room && lines_ > 3) --lines_;
    const double left = room - height(0);
    draw(top, std::clamp(left / 2, kHeatReportLeast, kHeatReportMost), sheet);
    draw_report_footer(report_.made, sheet);
    return std::move(page_);
  }

 private:
  [[nodiscard]] double height(double map) const {
    std::vector<Item> items;
    Sheet scratch(items);
    return draw(0, std::max(map, kHeatReportLeast), scratch) + (map > 0 ? 0 : -2 * kHeatReportLeast);
  }

  /// Draws all below the header with maps of this height, and returns where it ends.
  double draw(double top, double map, Sheet& sheet) const {
    const HeatScene& scene = report_.scene;
    double y = sheet.heading(kReportFrame, top, "What to do") + kReportBody + 0.8;
    for (const std::string& sentence : report_.decision)
      y = sheet.paragraph(kReportFrame, y, sentence, {.kind = "decision"}, kReportLine, 4);
    y += 1 - kReportBody;
    const double width = kReportLeft.width;
    draw_heat_layer(scene, scene.warmest, {kReportLeft.x, y, width, map}, sheet.items());
    draw_heat_layer(scene, scene.at_end, {kReportRight.x, y, width, map}, sheet.items());
    y += map + 1;
    draw_heat_layer(scene, scene.stress, {kReportLeft.x, y, width, map}, sheet.items());
    draw_heat_displacement(scene, {kReportRight.x, y, width, map}, sheet.items());
    y += map + 1;
    const double strips = kHeatReportStrip * static_cast<double>(scene.strips.size());
    draw_heat_strips(scene, {kReportFrame.x, y, kReportFrame.width, strips}, sheet.items());
    y += strips + 1;
    const double left = rows("Figures", report_.figures, kReportLeft, y, sheet),
                 right = rows("What the largest error hangs on, each by itself", report_.sensitivity,
                              kReportRight, y, sheet);
    y = std::max(left, right) + 1.5;
    std::vector<ReportFile> files;
    for (const HeatReport::Input& input : report_.inputs)
      files.push_back({input.role, input.words, input.sha256});
    y = draw_inputs(files, kReportFrame, y, sheet) + 1.5;
    return draw_notes(
        {report_.warnings, report_.assumptions,
         "All of this is computed and not proved; lekalo verify recomputes the work of the cuts, "
         "the places of walls and all that follows from their errors."},
        kReportFrame, y, lines_, sheet);
  }

  static double rows(const char* heading, const std::vector<HeatReport::Row>& figures, const Rect& column,
                     double top, Sheet& sheet) {
    ReportRows made(column, sheet.heading(column, top, heading), sheet);
    for (const HeatReport::Row& row : figures) made.add(row.what, row.value, "figure", kInk, row.strong);
    return made.end();
  }

  const HeatReport& report_;
  Scene page_;
  std::size_t lines_ = 10;
};

}  // namespace

std::string heat_report_svg(const HeatReport& report) { return scene_svg(HeatReportPage(report).compose()); }

Result<std::string> heat_report_png(const HeatReport& report, int width_px) {
  return scene_png(HeatReportPage(report).compose(), width_px);
}

Result<std::string> heat_report_pdf(const HeatReport& report) {
  return scene_pdf(HeatReportPage(report).compose());
}

}  // namespace lekalo::draw
