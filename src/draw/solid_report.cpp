#include "lekalo/draw/solid_report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "draw/paper/colour.hpp"
#include "draw/paper/printed_number.hpp"
#include "draw/solid/solid_drawing.hpp"
#include "lekalo/base/rounding.hpp"
#include "lekalo/io/text/words.hpp"
#include "report_parts.hpp"
#include "report_words.hpp"

namespace lekalo::draw {
namespace {

constexpr double kCaption = 4;
constexpr double kLeastViews = 90, kMostViews = 150;  ///< heights, mm
constexpr double kFine = 200 / 25.4;                  ///< pixels of a millimetre in a file to be printed

const SpaceView kIsometric = seen_from({1, -1, 1});

/// The words for the poses that were looked at.
std::string window_text(const SolidReport& report) {
  const std::string shift = fmt::format("up to {} mm along each axis", report.shift);
  switch (report.freedom) {
    case locate::SolidFreedom::xyz:
      return shift;
    case locate::SolidFreedom::c_xyz:
      return fmt::format("{} and turned about z by up to {}°", shift, report.turn_deg);
    case locate::SolidFreedom::six:
      break;
  }
  const std::string farther = report.farthest_turn_deg > report.turn_deg
                                  ? fmt::format(" (about some axes up to {:.2f}°)", report.farthest_turn_deg)
                                  : "";
  return fmt::format("{} and turned by up to {}° about any axis{}", shift, report.turn_deg, farther);
}

std::string freedom_text(const SolidReport& report) {
  const std::string shift = fmt::format("±{} mm", report.shift), turn = fmt::format("±{}°", report.turn_deg);
  switch (report.freedom) {
    case locate::SolidFreedom::xyz:
      return "xyz, " + shift;
    case locate::SolidFreedom::c_xyz:
      return fmt::format("c-xyz, {}, {}", shift, turn);
    case locate::SolidFreedom::six:
      break;
  }
  return fmt::format("six, {}, {}", shift, turn);
}

class SolidReportPage {
 public:
  SolidReportPage(const SolidReport& report, double fine, unsigned threads)
      : report_(report), scene_(report.scene), look_(report.scene), fine_(fine), threads_(threads) {}

  Scene compose() && {
    page_.width = kReportPage.width, page_.height = kReportPage.height;
    const std::string part = io::file_name(scene_.part_name), blank = io::file_name(scene_.blank_name);
    page_.title = fmt::format("Placement report: {} in {}", part, blank);
    page_.description = fmt::format("{}; minimum allowance {}", scene_.status, clearance_text(scene_, look_));
    page_.items.push_back(PathItem{{kReportPage.ring()}, true, filled(kPaper), {"page", ""}});
    Sheet sheet(page_.items);
    const double top =
        draw_report_header("Placement of " + part, "in the blank " + blank, scene_.status, sheet);
    const double room = kReportFrame.bottom() - kReportFooter - top;
    // Contacts and notes that find no room are counted on the page.
    while (height_below() + kLeastViews > room && (contacts_ > 3 || lines_ > 3)) {
      std::size_t& most = lines_ >= contacts_ ? lines_ : contacts_;
      --most;
    }
    const double height = std::clamp(room - height_below(), 0.6 * kLeastViews, kMostViews);
    sections(draw_views({kReportFrame.x, top, kReportFrame.width, height}, sheet) + 3, sheet);
    draw_report_footer(fmt::format("method {}, work {}", scene_.method, report_.work), sheet);
    return std::move(page_);
  }

 private:
  /// Heights of the upper and the lower views, as the solids need them at the scale that the widths leave, at
  /// most `room` together.
  [[nodiscard]] std::pair<double, double> view_heights(double room) const {
    solid::Box box = solid::box_of(look_.part.surface.places);
    for (const solid::Vector p : look_.blank.surface.places) box.hold(p);
    const solid::Vector e = box.high - box.low;
    const auto extent = [&](solid::Vector along) {
      return std::abs(along.x) * e.x + std::abs(along.y) * e.y + std::abs(along.z) * e.z;
    };
    constexpr double kMargins = 6;
    const double lower = std::max(e.y, extent(kIsometric.up)),
                 width = std::max({e.x, e.y, extent(kIsometric.right)});
    const double both = std::min(
        room, 2 * kMargins + (e.z + lower) * (kReportLeft.width - kMargins) / std::max(width, 1e-300));
    const double upper = both * std::clamp(e.z / std::max(e.z + lower, 1e-300), 0.25, 0.6);
    return {upper, both - upper};
  }
  /// Returns where they end.
  double draw_views(const Rect& room, Sheet& sheet) {
    struct Shown {
      const char* name;
      SpaceView view;
      Rect image;
    };
    const auto [upper, lower] = view_heights(room.height - 2 * kCaption);
    const double width = kReportLeft.width, right = kReportRight.x, below = room.y + upper + kCaption;
    std::array<Shown, 4> views{{{"from the right", seen_from({1, 0, 0}), {room.x, room.y, width, upper}},
                                {"front", seen_from({0, -1, 0}), {right, room.y, width, upper}},
                                {"isometric", kIsometric, {room.x, below, width, lower}},
                                {"from above", seen_from({0, 0, 1}), {right, below, width, lower}}}};
    double scale = 1e300;
    for (Shown& one : views) {
      one.view = fitted(look_, one.view, one.image, fine_);
      scale = std::min(scale, one.view.scale);
    }
    for (Shown& one : views) {
      one.view.scale = scale;
      draw_contact_numbers(draw_solids(look_, one.view, one.image, fine_, threads_, sheet), sheet);
      sheet.path(one.image.ring(), true, stroked(kRule, 0.25), "view");
      sheet.text(one.image.x + 1, one.image.bottom() + 3, width - 2, one.name,
                 {.size = kReportSmall, .colour = kGrey, .kind = "view-name"});
    }
    draw_axes(views[2].view, {views[2].image.x + 9, views[2].image.bottom() - 10}, sheet);
    draw_scale_bar(scale / fine_, {room.x + 0.5 * width, below + lower + 3}, 0.25 * width, sheet);
    sheet.text(kReportRight.right() - 1, below + lower + 3, 0.7 * width, "first-angle projection, one scale",
               {.size = kReportSmall, .colour = kGrey, .anchor = Anchor::end, .kind = "projection"});
    return below + lower + kCaption;
  }

  /// Draws everything below the views, and returns where it ends.
  double sections(double top, Sheet& sheet) const {
    ReportRows rows(kReportLeft, sheet.heading(kReportLeft, top, "Placement"), sheet);
    rows.add("minimum allowance", clearance_text(scene_, look_), "clearance",
             scene_.placement.inside ? kInk : kOutside, true);
    rows.add("freedom, window", freedom_text(report_), "window");
    for (const SolidFigure& figure : figures_of(scene_, look_))
      rows.add(figure.what, figure.value, figure.kind, figure.bad ? kOutside : kInk, figure.bad);
    const double left = draw_proof(proof(), kReportLeft, rows.end() + 1.5, sheet);
    double right = sheet.heading(kReportRight, top, "What is shown");
    right = draw_solid_key(scene_, look_, {kReportRight.x, right - 1, kReportRight.width, 0}, sheet) + 3;
    right = draw_contacts(right, sheet);
    double y = std::max(left, right) + 1.5;
    y = draw_inputs(files(), kReportFrame, y, sheet) + 1.5;
    return draw_notes(notes(), kReportFrame, y, lines_, sheet);
  }
  [[nodiscard]] double height_below() const {
    std::vector<Item> items;
    Sheet scratch(items);
    return sections(0, scratch) + 3;
  }

  double draw_contacts(double top, Sheet& sheet) const {
    const std::vector<locate::SolidTouch>& contacts = look_.touches;
    if (contacts.empty()) return top;
    double y = sheet.heading(kReportRight, top, "Contacts, mm: where the part is nearest");
    ReportTable table(
        {{"", 0.6, false}, {"distance", 2}, {"x in blank", 2.2}, {"y", 2}, {"z", 2}, {"triangles", 3}},
        kReportRight, sheet);
    y = table.titles(y);
    const std::size_t shown = std::min(contacts.size(), contacts_);
    for (std::size_t k = 0; k < shown; ++k) {
      const locate::SolidTouch& contact = contacts[k];
      const auto place = [&](double mm) { return decimal(mm, look_.table_decimals - 1); };
      y = table.row(y,
                    {fmt::format("{}", k + 1), decimal(contact.distance, look_.table_decimals),
                     place(contact.blank.x), place(contact.blank.y), place(contact.blank.z),
                     fmt::format("{}, {}", contact.part_triangle, contact.blank_triangle)},
                    {.size = kReportSmall, .kind = "contact-row"});
    }
    if (shown < contacts.size()) {
      sheet.text(kReportRight.x, y + kReportLine - 1, kReportRight.width,
                 fmt::format("and {} more", contacts.size() - shown),
                 {.size = kReportSmall, .colour = kGrey, .kind = "more-contacts"});
      y += kReportLine;
    }
    return y;
  }

  /// The figures that count: those of the allowance, or of what is left over the demands.
  [[nodiscard]] const std::optional<double>& bound() const {
    return scene_.margin ? scene_.margin->bound : scene_.upper_bound;
  }
  [[nodiscard]] std::optional<double> reached() const {
    if (scene_.margin) return scene_.margin->is;
    return scene_.placement.inside ? std::optional(scene_.placement.clearance) : std::nullopt;
  }
  [[nodiscard]] std::string none_has() const {
    return fmt::format(
        "no placement moved {}{} leaves more than {} mm {}", window_text(report_),
        scene_.margin && scene_.margin->of_place ? ", of those that keep datums, maxima and finished faces,"
                                                 : "",
        decimal(*bound(), look_.decimals, Rounding::up), scene_.margin ? "over the demands" : "everywhere");
  }
  [[nodiscard]] std::string this_has() const {
    const std::optional<double> is = reached();
    if (!is)
      return scene_.margin && scene_.margin->of_place ? "the best found is not inside the blank, or does not "
                                                        "keep a datum, a maximum or a finished face"
                                                      : "the best found is not inside the blank";
    return fmt::format("this one leaves at least {} mm{}", decimal(*is, look_.decimals, Rounding::down),
                       scene_.margin ? " over them" : "");
  }
  [[nodiscard]] std::string verdict() const {
    if (!bound())
      return fmt::format("Nothing is proved about other placements: the method {} cannot; {}.", scene_.method,
                         this_has());
    if (scene_.status == "infeasible")
      return fmt::format("Proved: {}; {}; {}.",
                         scene_.margin ? std::string("what is demanded cannot be had")
                         : scene_.min_allowance > 0
                             ? fmt::format("the demanded {} mm cannot be had", scene_.min_allowance)
                             : std::string("the part does not fit"),
                         none_has(), this_has());
    if (scene_.status == "optimal" && reached())
      return fmt::format("Proved: {}; {}. So no other is better by more than {} mm.", none_has(), this_has(),
                         short_number_up(difference_rounded_up(*bound(), *reached())));
    return fmt::format("Stopped before the search was complete: {}. Proved so far: {}.", this_has(),
                       none_has());
  }
  [[nodiscard]] std::vector<std::string> proof() const {
    std::vector<std::string> sentences{verdict()};
    const std::string boxes = fmt::format("The proof, {} {} of poses, is in ", report_.certificate_boxes,
                                          report_.certificate_boxes == 1 ? "box" : "boxes");
    const std::string recheck = "lekalo verify rechecks the clearance exactly, with code of its own";
    if (report_.certificate_boxes == 0) {
      sentences.push_back(recheck + ".");
    } else {
      sentences.push_back(
          boxes +
          (report_.certificate_file
               ? fmt::format("{}, SHA-256 {}. ",
                             io::shortened(io::file_name(io::as_utf8(report_.certificate_file->path)), 30),
                             report_.certificate_file->sha256)
               : std::string("the result. ")) +
          recheck + ", and the proof with it.");
    }
    return sentences;
  }
  [[nodiscard]] std::vector<ReportFile> files() const {
    std::vector<ReportFile> files;
    for (const SolidReportFile& input : report_.inputs) {
      std::string words = io::as_utf8(input.file.path);
      if (!input.about.empty()) words += ", " + input.about;
      files.push_back({input.role, words, input.file.sha256});
    }
    return files;
  }
  [[nodiscard]] ReportNotes notes() const {
    ReportNotes notes{report_.warnings, scene_.notes, {}};
    for (const std::string& assumption : report_.assumptions)
      notes.assumptions.push_back(as_sentence(assumption));
    notes.assumptions.push_back("Looked at: placements " + window_text(report_) + " from the start.");
    notes.measured =
        scene_.allowances.empty()
            ? std::string("The allowance was not measured over the surface.")
            : fmt::format(
                  "Colours: {} at {} points of the part, between them drawn straight; the minimum "
                  "above is that of the whole surface.",
                  scene_.margin ? "what the distance to the blank's surface leaves over the demands"
                                : "distance to the blank's surface",
                  scene_.allowances.size());
    return notes;
  }

  const SolidReport& report_;
  const SolidScene& scene_;
  SolidLook look_;
  double fine_;
  unsigned threads_;
  Scene page_;
  std::size_t contacts_ = 12, lines_ = 14;
};

}  // namespace

std::string solid_report_svg(const SolidReport& report, unsigned threads) {
  return scene_svg(SolidReportPage(report, kFine, threads).compose());
}

Result<std::string> solid_report_png(const SolidReport& report, int width_px, unsigned threads) {
  const double fine = std::clamp(width_px, 100, 4000) / kReportPage.width;
  return scene_png(SolidReportPage(report, fine, threads).compose(), width_px);
}

Result<std::string> solid_report_pdf(const SolidReport& report, unsigned threads) {
  return scene_pdf(SolidReportPage(report, kFine, threads).compose());
}

}  // namespace lekalo::draw
