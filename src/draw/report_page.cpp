#include "report_page.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "draw/paper/colour.hpp"
#include "lekalo/base/version.hpp"
#include "lekalo/io/text/words.hpp"

namespace lekalo::draw {
namespace {

constexpr Rect kPageBody{12, 10, 186, 277};
constexpr double kBetween = 5;
constexpr Rect kLeft{kPageBody.x, 0, 0.5 * (kPageBody.width - kBetween), 0};
constexpr Rect kRight{kPageBody.x + kLeft.width + kBetween, 0, kLeft.width, 0};
constexpr double kFooter = 4;
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
    const double top = header(sheet);
    const double bottom = kPageBody.bottom() - kFooter;
    choose_rows(bottom - top);
    const double below = height_below();
    const double height = std::min(most_drawing(), bottom - top - below);
    draw_placement(report_, look_, {kPageBody.x, top, kPageBody.width, height}, sheet);
    sections(top + height + 3, sheet);
    footer(sheet);
    return std::move(scene_);
  }

 private:
  [[nodiscard]] std::string name(const char* role) const {
    for (const io::InputRecord& input : report_.document.inputs)
      if (input.role == role) return io::file_name(io::as_utf8(input.file.path));
    return role;
  }

  double header(Sheet& sheet) const {
    const std::string& status = report_.document.status;
    const double badge = 3.4 * kReportBoldWider * io::text_width(status) + 5;
    const double left = kPageBody.right() - badge;
    sheet.path(Rect{left, kPageBody.y, badge, 6.4}.ring(), true, filled(colour_of_status(status)),
               "status-box");
    sheet.text(left + badge / 2, kPageBody.y + 4.5, badge - 4, status,
               {.size = 3.4, .colour = kPaper, .anchor = Anchor::middle, .bold = true, .kind = "status"});
    const double room = left - kPageBody.x - 4;
    sheet.text(kPageBody.x, kPageBody.y + 4.8, room, "Placement of " + name("part"),
               {.size = 5, .bold = true, .kind = "title"});
    sheet.text(kPageBody.x, kPageBody.y + 9.6, kPageBody.width, "in the blank " + name("blank"),
               {.size = 3.4, .colour = kGrey, .kind = "subtitle"});
    return kPageBody.y + 12;
  }

  /// Draws everything below the drawing, and returns where it ends.
  double sections(double top, Sheet& sheet) const {
    const double left =
        draw_proof(report_, kLeft, draw_numbers(report_, look_, kLeft, top, sheet) + 1.5, sheet);
    const double right = draw_contacts(
        report_, look_, kRight, draw_histogram(report_, look_, kRight, top, sheet) + 1.5, contacts_, sheet);
    double y = draw_features(report_, look_, kPageBody, std::max(left, right) + 1.5, rows_, sheet) + 1.5;
    y = draw_inputs(report_, kPageBody, y, sheet) + 1.5;
    return draw_notes(report_, kPageBody, y, lines_, sheet);
  }
  [[nodiscard]] double height_below() const {
    std::vector<Item> items;
    Sheet scratch(items);
    return sections(0, scratch) + 3;
  }
  [[nodiscard]] double most_drawing() const {
    return std::clamp(placement_height(report_, kPageBody.width), kLeastDrawing, kMostDrawing);
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

  void footer(Sheet& sheet) const {
    const io::LocateDocument& d = report_.document;
    sheet.text(kPageBody.x, kPageBody.bottom(), kPageBody.width / 2, std::string("lekalo ") + kVersion,
               {.size = kReportSmall, .colour = kGrey, .kind = "version"});
    sheet.text(kPageBody.right(), kPageBody.bottom(), kPageBody.width / 2,
               fmt::format("method {}, seed {}, work {}", d.method, d.seed, d.work),
               {.size = kReportSmall, .colour = kGrey, .anchor = Anchor::end, .kind = "method"});
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
