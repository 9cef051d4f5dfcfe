#include "panel.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "draw/paper/colour.hpp"
#include "draw/paper/colour_scale.hpp"
#include "draw/paper/printed_number.hpp"
#include "lekalo/base/angle.hpp"
#include "lekalo/base/rounding.hpp"
#include "lekalo/io/text/words.hpp"

namespace lekalo::draw {
namespace {

using geom::Point;

constexpr double kBody = 3.1;       ///< font size, mm of paper
constexpr double kSmall = 2.7;      ///< of captions and ticks
constexpr double kBoldWider = 1.1;  ///< bold letters against plain ones
constexpr double kLine = 4.7;       ///< from baseline to baseline

Rect rectangle_around_text(double x, double baseline, double width, double size) {
  return {x, baseline - size, width, 1.45 * size};
}

class Panel {
 public:
  Panel(const LocatePicture& picture, const PictureOfRings& rings, const Located& shapes, const Rect& room,
        std::vector<Item>& items)
      : picture_(picture), rings_(rings), shapes_(shapes), room_(room), items_(items), y_(room.y) {
    const geom::Box box = joined(geom::bounds(shapes.blank), geom::bounds(shapes.part));
    decimals_ = decimals_for(std::max(box.high.x - box.low.x, box.high.y - box.low.y));
  }

  void draw() {
    heading();
    verdict();
    numbers();
    rule();
    allowance_key();
    legend();
  }
  [[nodiscard]] double end() const { return y_; }

 private:
  void text(double x, const std::string& words, double size, Colour colour, Anchor anchor = Anchor::start,
            bool bold = false, const char* kind = "") {
    items_.push_back(TextItem{{x, y_}, words, size, anchor, colour, bold, {kind, ""}});
  }
  void path(const geom::Ring& line, bool closed, const Paint& paint, const char* kind = "") {
    items_.push_back(PathItem{{line}, closed, paint, {kind, ""}});
  }

  void heading() {
    y_ += 4.5;
    text(room_.x, io::shortened(picture_.title, room_.width / (5.0 * kBoldWider)), 5.0, kInk, Anchor::start,
         true, "title");
    y_ += 1.2;
    name("part", picture_.part_name);
    name("blank", picture_.blank_name);
  }
  void name(const char* what, const std::string& path) {
    constexpr double kIndent = 11;
    y_ += kLine;
    text(room_.x, what, kBody, kGrey);
    text(room_.x + kIndent, io::shortened(io::file_name(path), (room_.width - kIndent) / kBody), kBody, kInk,
         Anchor::start, false, "name");
  }

  void verdict() {
    y_ += 8;
    const std::string status = io::shortened(picture_.status, 0.45 * room_.width / kBody);
    const double width = kBody * kBoldWider * io::text_width(status) + 4;
    if (!status.empty()) {
      path(rectangle_around_text(room_.x, y_, width, kBody).ring(), true,
           filled(colour_of_status(picture_.status)), "status-box");
      text(room_.x + width / 2, status, kBody, kPaper, Anchor::middle, true, "status");
    }
    if (!picture_.method.empty()) {
      const double left = room_.x + width + 3;
      text(left, io::shortened("method " + picture_.method, (room_.right() - left) / kBody), kBody, kGrey,
           Anchor::start, false, "method");
    }
    y_ += 7.5;
    text(room_.x, "minimum allowance", kBody, kGrey);
    y_ += 8;
    const double clearance = picture_.result.clearance;
    const std::string words = length(clearance, Rounding::down);
    text(room_.x, words, io::fitting_size(words, 7.0, room_.width / kBoldWider),
         clearance < 0 ? kOutside : kInk, Anchor::start, true, "clearance");
    y_ += 2.5;
  }

  [[nodiscard]] std::string length(double mm, Rounding rounding = Rounding::nearest) const {
    const std::string number = decimal(mm, decimals_, rounding);
    return std::isfinite(mm) ? number + " mm" : number;
  }
  void row(const char* what, const std::string& value, const char* kind, Colour colour = kInk) {
    y_ += kLine;
    text(room_.x, what, kBody, kGrey);
    const double width = room_.width - kBody * (io::text_width(what) + 1);
    text(room_.right(), value, io::fitting_size(value, kBody, width), colour, Anchor::end, false, kind);
  }

  void numbers() {
    const locate::Placement& result = picture_.result;
    if (picture_.upper_bound) {
      row("proven upper bound", length(*picture_.upper_bound, Rounding::up), "upper-bound");
      const double gap = difference_rounded_up(*picture_.upper_bound, result.clearance);
      row("gap", short_number_up(gap) + (std::isfinite(gap) ? " mm" : ""), "gap");
    } else {
      row("proven upper bound", "not proved", "upper-bound");
    }
    if (picture_.min_allowance > 0) {
      row("demanded", length(picture_.min_allowance), "min-allowance");
    }
    if (picture_.shortfall > 0) {
      row("missing", length(picture_.shortfall, Rounding::up), "shortfall", kOutside);
    }
    y_ += 1.5;
    row("x", length(result.x), "x");
    row("y", length(result.y), "y");
    // As many digits as move the rim of the part by less than the last digit of x.
    row("angle", decimal(result.theta * kDegreesPerRadian, 7) + "°", "theta-deg");
  }

  void rule() {
    y_ += 2.8;
    path({{room_.x, y_}, {room_.right(), y_}}, false, stroked(kRule, 0.3), "rule");
  }

  void allowance_key() {
    if (shapes_.samples.empty()) return;
    if (shapes_.greatest >= -shapes_.rounding) scale();
    if (shapes_.sticks_out()) outside_key();
  }
  void scale() {
    y_ = draw_colour_scale({shapes_.low, shapes_.high}, "allowance along the contour",
                           {room_.x, y_, room_.width, 0}, kBody, kSmall, items_) +
         0.6;
  }
  void outside_key() {
    y_ += kLine;
    const geom::Ring line{{room_.x, y_ - 1.1}, {room_.x + 9, y_ - 1.1}};
    path(line, false, stroked(kOutsideBase, 2.2), "key");
    path(line, false, stroked(kOutside, 2.2, 1.6), "key");
    const std::string words =
        fmt::format("outside the blank, by up to {} mm", short_number_up(-shapes_.least));
    text(room_.x + 11, words, io::fitting_size(words, kSmall, room_.width - 11), kOutside, Anchor::start,
         false, "outside");
  }

  void legend() {
    y_ += 1.2;
    const double second = room_.x + room_.width / 2;
    y_ += kLine;
    swatch(room_.x, kBlankFill, kBlankLine, "blank");
    swatch(second, kPaper, kInk, "part, placed");
    if (rings_.draw_start) {
      y_ += kLine;
      path({{room_.x, y_ - 1.0}, {room_.x + 6, y_ - 1.0}}, false, stroked(kStartLine, 0.35, 1.3), "key");
      const locate::Placement& start = rings_.start;
      const bool own = start.x == 0 && start.y == 0 && start.theta == 0;
      text(room_.x + 8, own ? "part, where its own coordinates put it" : "part, where it started", kSmall,
           kInk);
    }
    if (rings_.contacts.empty()) return;
    y_ += kLine;
    path({{room_.x + 0.8, y_ - 1.0}, {room_.x + 6, y_ - 1.0}}, false, stroked(kInk, 0.5), "key");
    Paint dot = filled(kPaper);
    dot.stroke = kInk;
    dot.width = 0.4;
    items_.push_back(DotItem{{room_.x + 0.8, y_ - 1.0}, 0.8, dot, {"key", ""}});
    text(room_.x + 8, "contact: part vertex v, blank edge e", kSmall, kInk);
  }
  void swatch(double x, Colour fill, Colour line, const char* what) {
    Paint paint = filled(fill);
    paint.stroke = line;
    paint.width = 0.3;
    path(Rect{x, y_ - 2.3, 6, 2.6}.ring(), true, paint, "key");
    text(x + 8, what, kSmall, kInk);
  }

  const LocatePicture& picture_;
  const PictureOfRings& rings_;
  const Located& shapes_;
  Rect room_;
  std::vector<Item>& items_;
  double y_;
  int decimals_ = 6;
};

}  // namespace

double draw_panel(const LocatePicture& picture, const PictureOfRings& rings, const Located& shapes,
                  const Rect& room, std::vector<Item>& items) {
  Panel panel(picture, rings, shapes, room, items);
  panel.draw();
  return panel.end();
}

}  // namespace lekalo::draw
