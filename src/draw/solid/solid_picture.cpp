#include "lekalo/draw/solid_picture.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "draw/paper/colour_scale.hpp"
#include "draw/paper/printed_number.hpp"
#include "draw/paper/report_sheet.hpp"
#include "draw/paper/scene.hpp"
#include "draw/paper/view.hpp"
#include "lekalo/io/text/words.hpp"
#include "section.hpp"
#include "solid_drawing.hpp"

namespace lekalo::draw {
namespace {

using geom::Point;
using solid::Vector;

constexpr Rect kSolidPage{0, 0, 240, 180};
constexpr Rect kSolidDrawing{6, 6, 166, 168};
constexpr Rect kSolidPanel{177, 6, 57, 168};
constexpr double kFigure = 2.7;   ///< font size
constexpr double kSections = 46;  ///< their height under the drawing

class SolidComposer {
 public:
  SolidComposer(const SolidScene& scene, double pixels_per_mm, unsigned threads)
      : scene_(scene),
        look_(scene),
        facing_(facing(look_)),
        fine_(pixels_per_mm),
        threads_(threads),
        sheet_(page_.items) {}

  Scene compose() && {
    page_.width = kSolidPage.width, page_.height = kSolidPage.height;
    page_.title = fmt::format("lekalo locate: {} in {}", io::file_name(scene_.part_name),
                              io::file_name(scene_.blank_name));
    page_.description = scene_.status + "; minimum allowance " + clearance_text(scene_, look_);
    page_.items.push_back(PathItem{{kSolidPage.ring()}, true, filled(kPaper), {"page", ""}});
    Rect room = kSolidDrawing;
    if (look_.focus) {
      room.height -= kSections + 4;
      draw_sections({room.x, room.bottom() + 4, room.width, kSections});
    }
    Rect image = room;
    if (!look_.contacts.empty()) image.x += kContactLabel, image.width -= 2 * kContactLabel;
    const SpaceView view = fitted(look_, facing_, image, fine_);
    std::vector<ContactMark> marks = draw_solids(look_, view, image, fine_, threads_, sheet_);
    draw_axes(view, {room.x + 9, room.bottom() - 12}, sheet_);
    draw_scale_bar(view.scale / fine_, {room.x + 1, room.bottom() - 0.6}, 36, sheet_);
    if (look_.focus && look_.contacts.empty()) {
      const ScreenPoint at = view(look_.focus->place);
      page_.items.push_back(DotItem{
          {image.x + at.x / fine_, image.y + at.y / fine_}, 2.2, stroked(kOutside, 0.4), {"focus", ""}});
    }
    draw_contact_lengths(look_, std::move(marks), room, sheet_);
    draw_panel();
    return std::move(page_);
  }

 private:
  /// The section through the focus and, beside it, the place itself in a scale that shows the distance.
  void draw_sections(const Rect& room) {
    const SolidFocus& focus = *look_.focus;
    const Vector beside = cross(focus.outward, {0, 0, 1});
    SpaceView view = seen_from(norm(beside) > 0.2 ? beside : cross(focus.outward, {1, 0, 0}));
    // The section is seen from the viewer's side.
    if (dot(view.towards, facing_.towards) < 0) view = seen_from(-view.towards);
    const double width = (room.width - 6) / 2;
    const Rect left{room.x, room.y, width, room.height - 5},
        right{room.right() - width, room.y, width, left.height};
    SpaceView whole = fitted(look_, view, left, fine_);
    through_focus(whole);
    draw_section(whole, left, false);
    SpaceView close = view;
    const double seen = std::clamp(14 * std::abs(focus.distance), 1e-5 * look_.size, 0.25 * look_.size);
    close.scale = fine_ * right.width / seen;
    close.centre = focus.place;
    close.x = fine_ * right.width / 2, close.y = fine_ * right.height / 2;
    draw_section(close, right, true);
    sheet_.text(left.x, room.bottom(), left.width,
                focus.contact ? fmt::format("section through contact {}", *focus.contact + 1)
                              : std::string("section where most is missing"),
                {.size = kReportSmall, .colour = kGrey, .kind = "caption"});
    sheet_.text(right.x, room.bottom(), right.width,
                fmt::format("the same place, {} times larger", short_number_up(close.scale / whole.scale)),
                {.size = kReportSmall, .colour = kGrey, .kind = "caption"});
  }
  /// Moves the plane of a fitted view into the focus, so that what is seen keeps its place.
  void through_focus(SpaceView& view) const {
    const ScreenPoint at = view(look_.focus->place);
    view.centre = look_.focus->place;
    view.x = at.x, view.y = at.y;
  }
  void draw_section(const SpaceView& view, const Rect& frame, bool close) {
    const int columns = static_cast<int>(std::lround(fine_ * frame.width)),
              rows = static_cast<int>(std::lround(fine_ * frame.height));
    page_.items.push_back(
        ImageItem{{frame.x, frame.y},
                  frame.width,
                  frame.height,
                  section_picture(look_.part.surface, look_.blank.surface, view, columns, rows),
                  {"section", ""}});
    sheet_.path(frame.ring(), true, stroked(kRule, 0.3), "frame");
    const SolidFocus& focus = *look_.focus;
    const auto on_page = [&](Vector p) {
      const ScreenPoint s = view(p);
      return Point{frame.x + s.x / fine_, frame.y + s.y / fine_};
    };
    const Point at = on_page(focus.place);
    draw_scale_bar(view.scale / fine_, {frame.right() - 28, frame.bottom() + 5}, 16, sheet_);
    if (!close) {
      page_.items.push_back(DotItem{at, 2.2, stroked(kOutside, 0.4), {"focus", ""}});
      return;
    }
    // The blank may be far outside of what is shown.
    const Segment line = clipped({at, on_page(focus.on_blank)}, frame).value_or(Segment{at, at});
    const Point to = line.b;
    sheet_.path({at, to}, false, stroked_round(kOutside, 0.4), "distance");
    for (const Point end : {at, to})
      page_.items.push_back(DotItem{end, 0.6, filled(kOutside), {"distance", ""}});
    const std::string words = decimal(std::abs(focus.distance), look_.table_decimals) +
                              (focus.distance < 0 ? " mm outside" : " mm");
    const double half = 0.5 * kReportBody * kReportBoldWider * io::text_width(words);
    const Point label{frame.right() - half - 3, frame.y + 5};
    sheet_.path({to, {label.x, label.y + 1}}, false, stroked(kOutside, 0.2), "leader");
    sheet_.path(Rect{label.x - half - 0.8, label.y - 3, 2 * half + 1.6, 4}.ring(), true,
                filled(kPaper, 0.85));
    sheet_.text(label.x, label.y, frame.width, words,
                {.size = kReportBody,
                 .colour = kOutside,
                 .anchor = Anchor::middle,
                 .bold = true,
                 .kind = "distance"});
  }

  void draw_panel() {
    const Rect& room = kSolidPanel;
    double y = room.y + 4.5;
    sheet_.text(room.x, y, room.width, io::file_name(scene_.part_name),
                {.size = 4.4, .bold = true, .kind = "title"});
    y += 4.6;
    sheet_.text(room.x, y, room.width, "in " + io::file_name(scene_.blank_name),
                {.colour = kGrey, .kind = "name"});
    y += 3.4;
    const double badge = kReportBody * kReportBoldWider * io::text_width(scene_.status) + 4;
    sheet_.path(Rect{room.x, y, badge, 4.6}.ring(), true, filled(colour_of_status(scene_.status)),
                "status-box");
    sheet_.text(room.x + badge / 2, y + 3.35, badge, scene_.status,
                {.colour = kPaper, .anchor = Anchor::middle, .bold = true, .kind = "status"});
    sheet_.text(room.x + badge + 2.5, y + 3.35, room.width - badge - 2.5, "method " + scene_.method,
                {.size = kReportSmall, .colour = kGrey, .kind = "method"});
    y += 10;
    sheet_.text(room.x, y, room.width, "minimum allowance", {.colour = kGrey});
    y += 7;
    sheet_.text(room.x, y, room.width, clearance_text(scene_, look_),
                {.size = 6.4,
                 .colour = scene_.placement.inside ? kInk : kOutside,
                 .bold = true,
                 .kind = "clearance"});
    y += 2;
    for (const SolidFigure& figure : figures_of(scene_, look_)) {
      y += kReportLine + 0.3;
      const double named = kFigure * io::text_width(figure.what) + 2;
      sheet_.text(room.x, y, room.width, figure.what, {.size = kFigure, .colour = kGrey});
      sheet_.text(room.right(), y, room.width - named, figure.value,
                  {.size = kFigure,
                   .colour = figure.bad ? kOutside : kInk,
                   .anchor = Anchor::end,
                   .kind = figure.kind});
    }
    y += 3.5;
    sheet_.rule(room.x, room.right(), y);
    y = draw_solid_key(scene_, look_, {room.x, y, room.width, 0}, sheet_) + 3;
    for (const std::string& note : scene_.notes) {
      const auto lines = static_cast<std::size_t>(std::max(0.0, (room.bottom() - y) / kReportSmallLine));
      if (lines == 0) break;
      y = sheet_.paragraph(room, y + kReportSmall, note,
                           {.size = kReportSmall, .colour = kGrey, .kind = "note"}, kReportSmallLine,
                           std::min<std::size_t>(4, lines)) -
          kReportSmall + 0.8;
    }
  }

  const SolidScene& scene_;
  SolidLook look_;
  SpaceView facing_;
  double fine_;  ///< pixels of a millimetre of paper
  unsigned threads_;
  Scene page_;
  Sheet sheet_;
};

}  // namespace

Result<std::string> solid_png(const SolidScene& scene, int width_px, unsigned threads) {
  // A larger page has larger letters and the same pixels of the solids.
  const double fine = std::clamp(width_px, 100, 4000) / kSolidPage.width;
  return scene_png(SolidComposer(scene, fine, threads).compose(), width_px);
}

}  // namespace lekalo::draw
