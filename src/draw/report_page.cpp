#include "report_page.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "draw/paper/colour.hpp"
#include "lekalo/io/text/words.hpp"

namespace lekalo::draw {
namespace {

constexpr double kLeastDrawing = 70, kUsualDrawing = 92, kMostDrawing = 150;  ///< heights, mm

class Page {
 public:
  explicit Page(const Report& report) : report_(report), look_(look_of(report)) {}

  Scene compose() && {
    scene_.width = kReportPage.width, scene_.height = kReportPage.height;
    const locate::Placement& p = report_.document.placement;
    scene_.title = fmt::format("Placement report: {} in {}", name("part"), name("blank"));
    scene_.description = fmt::format("{}; minimum allowance {} mm at x {} mm, y {} mm, angle {} rad",
                                     report_.document.status, p.clearance, p.x, p.y, p.theta);
    scene_.items.push_back(PathItem{{kReportPage.ring()}, true, filled(kPaper), {"page", ""}});
    Sheet sheet(scene_.items);
    const double top = draw_report_header("Placement of " + name("part"), "in the blank " + name("blank"),
                                          report_.document.status, sheet);
    const double bottom = kReportFrame.bottom() - kReportFooter;
    choose_rows(bottom - top);
    const double below = height_below();
    const double height = std::min(most_drawing(), bottom - top - below);
    draw_placement(report_, look_, {kReportFrame.x, top, kReportFrame.width, height}, sheet);
    sections(top + height + 3, sheet);
    const io::LocateDocument& d = report_.document;
    draw_report_footer(fmt::format("method {}, seed {}, work {}", d.method, d.seed, d.work), sheet);
    return std::move(scene_);
  }

 private:
  [[nodiscard]] std::string name(const char* role) const {
    for (const io::InputRecord& input : report_.document.inputs)
      if (input.role == role) return io::file_name(io::as_utf8(input.file.path));
    return role;
  }

  /// Draws everything below the drawing, and returns where it ends.
  double sections(double top, Sheet& sheet) const {
    const double left = draw_proof(report_.proof, kReportLeft,
                                   draw_numbers(report_, look_, kReportLeft, top, sheet) + 1.5, sheet);
    const double right =
        draw_contacts(report_, look_, kReportRight,
                      draw_histogram(report_, look_, kReportRight, top, sheet) + 1.5, contacts_, sheet);
    double y = draw_features(report_, look_, kReportFrame, std::max(left, right) + 1.5, rows_, sheet) + 1.5;
    y = draw_inputs(files(), kReportFrame, y, sheet) + 1.5;
    return draw_notes(notes(), kReportFrame, y, lines_, sheet);
  }
  [[nodiscard]] std::vector<ReportFile> files() const {
    std::vector<ReportFile> files;
    for (const io::InputRecord& input : report_.document.inputs) {
      std::string words = io::as_utf8(input.file.path);
      if (input.unit)
        words +=
            fmt::format(", {} points in {}", input.points, *input.unit == LengthUnit::inch ? "inch" : "mm");
      files.push_back({input.role, words, input.file.sha256});
    }
    return files;
  }
  [[nodiscard]] ReportNotes notes() const {
    return {report_.document.warnings, report_.assumptions,
            fmt::format("Allowance along the outline: distance to the blank's boundary; minima rounded down, "
                        "maxima up, both within {} mm; means and shares from points at most {} mm apart.",
                        short_number_up(report_.tolerance), short_number_up(report_.step))};
  }
  [[nodiscard]] double height_below() const {
    std::vector<Item> items;
    Sheet scratch(items);
    return sections(0, scratch) + 3;
  }
  [[nodiscard]] double most_drawing() const {
    return std::clamp(placement_height(report_, kReportFrame.width), kLeastDrawing, kMostDrawing);
  }
  /// Keeps as much of the lists as leaves the drawing its usual height.
  void choose_rows(double room) {
    constexpr std::size_t kFewest = 3;
    while (height_below() + std::min(kUsualDrawing, most_drawing()) > room) {
      std::size_t& most = lines_ >= rows_ ? lines_ : rows_;
      if (most <= kFewest) break;
      --most;
    }
  }

  const Report& report_;
  ReportLook look_;
  Scene scene_;
  std::size_t rows_ = 14, lines_ = 14, contacts_ = 6;
};

}  // namespace

ReportLook look_of(const Report& report) {
  ReportLook look;
  look.least = report.edges.front().least.allowance, look.greatest = look.least;
  for (const locate::EdgeAllowance& edge : report.edges) {
    look.least = std::min(look.least, edge.least.allowance);
    look.greatest = std::max(look.greatest, edge.most.allowance);
  }
  double size = 0;
  for (const auto* shape : {&report.shapes.part, &report.shapes.blank}) {
    for (const geom::Region& region : *shape) {
      const geom::Box box = geom::bounds(region.outer);
      size = std::max({size, box.high.x - box.low.x, box.high.y - box.low.y});
    }
  }
  look.range = colour_range(look.least, look.greatest, 0, size);
  look.decimals = decimals_for(size);
  look.table_decimals = std::max(3, look.decimals - 2);
  return look;
}

std::string contact_letter(std::size_t index) {
  return index < 26 ? std::string(1, static_cast<char>('A' + index)) : std::string();
}

std::string length_text(double mm, int decimals, Rounding rounding) {
  return decimal(mm, decimals, rounding) + " mm";
}

Scene report_page(const Report& report) { return Page(report).compose(); }

std::string report_svg(const Report& report) { return scene_svg(report_page(report)); }
Result<std::string> report_png(const Report& report, int width_px) {
  return scene_png(report_page(report), width_px);
}
Result<std::string> report_pdf(const Report& report) { return scene_pdf(report_page(report)); }

}  // namespace lekalo::draw
