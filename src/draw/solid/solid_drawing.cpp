#include "solid_drawing.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "draw/paper/colour_scale.hpp"
#include "draw/paper/printed_number.hpp"

namespace lekalo::draw {
namespace {

using geom::Point;
using solid::Vector;

constexpr std::size_t kMostLabels = 16;

void draw_mark(Point at, bool seen, const Meaning& meaning, Sheet& sheet) {
  Paint paint = filled(kPaper, seen ? 1 : 0.35);
  paint.stroke = kInk, paint.width = seen ? 0.45 : 0.25;
  sheet.items().push_back(DotItem{at, 0.9, paint, meaning});
}

/// Writes the lengths of contacts in a column at each side, so that no label lies on the solids or on another
/// one and no two leaders of a side cross.
class ContactLabels {
 public:
  ContactLabels(const SolidLook& look, const Rect& frame, Sheet& sheet)
      : look_(look), frame_(frame), sheet_(sheet) {}

  void draw(std::vector<ContactMark> marks) {
    // The tightest contacts have labels, if not all can.
    std::stable_sort(marks.begin(), marks.end(),
                     [&](const ContactMark& a, const ContactMark& b) { return distance(a) < distance(b); });
    for (auto mark = marks.rbegin(); mark != marks.rend(); ++mark) dot(*mark);
    if (marks.size() > kMostLabels) marks.resize(kMostLabels);
    std::vector<ContactMark> left, right;
    std::stable_sort(marks.begin(), marks.end(),
                     [](const ContactMark& a, const ContactMark& b) { return a.at.x < b.at.x; });
    for (std::size_t k = 0; k < marks.size(); ++k) (2 * k < marks.size() ? left : right).push_back(marks[k]);
    column(left, frame_.x, Anchor::start);
    column(right, frame_.right(), Anchor::end);
  }

 private:
  [[nodiscard]] double distance(const ContactMark& mark) const {
    return look_.touches[mark.contact].distance;
  }
  void dot(const ContactMark& mark) {
    draw_mark(mark.at, mark.seen,
              {mark.seen ? "contact" : "hidden-contact", std::to_string(mark.contact + 1)}, sheet_);
  }
  void column(std::vector<ContactMark>& marks, double x, Anchor anchor) {
    constexpr double kStep = 5.6;
    std::stable_sort(marks.begin(), marks.end(),
                     [](const ContactMark& a, const ContactMark& b) { return a.at.y < b.at.y; });
    // From above each label goes as near to its mark as those above let it, then from below.
    std::vector<double> y;
    for (const ContactMark& mark : marks) {
      const double least = y.empty() ? frame_.y + 4 : y.back() + kStep;
      y.push_back(std::max(least, mark.at.y + 1));
    }
    // Axes and scale bar stand in the lower left corner.
    double most = frame_.bottom() - (anchor == Anchor::start ? 23 : 2);
    for (std::size_t k = marks.size(); k-- > 0; most = y[k] - kStep) y[k] = std::min(y[k], most);
    const bool at_left = anchor == Anchor::start;
    for (std::size_t k = 0; k < marks.size(); ++k) {
      const std::string words =
          fmt::format("{}: {} mm", marks[k].contact + 1, decimal(distance(marks[k]), look_.table_decimals));
      const bool tightest = look_.focus && look_.focus->contact == marks[k].contact;
      const double width = kContactLabel - 2,
                   drawn = std::min(width, kReportBody * kReportBoldWider * io::text_width(words)) + 1;
      const Point from{at_left ? x + drawn : x - drawn, y[k] - 1}, to = marks[k].at;
      sheet_.path({from, to}, false, stroked(kPaper, 0.7), "leader-halo");
      sheet_.path({from, to}, false, stroked(kInk, 0.22), "leader");
      sheet_.text(x, y[k], width, words,
                  {.colour = marks[k].seen ? kInk : kGrey,
                   .anchor = anchor,
                   .bold = tightest,
                   .kind = "contact-label"});
      dot(marks[k]);
    }
  }

  const SolidLook& look_;
  Rect frame_;
  Sheet& sheet_;
};

}  // namespace

SpaceView fitted(const SolidLook& look, SpaceView view, const Rect& image, double fine) {
  std::vector<Vector> places = look.part.surface.places;
  places.insert(places.end(), look.blank.surface.places.begin(), look.blank.surface.places.end());
  fit(view, places, fine * image.width, fine * image.height, 2 * fine);
  return view;
}

std::vector<ContactMark> draw_solids(const SolidLook& look, const SpaceView& fitted_view, const Rect& image,
                                     double fine, unsigned threads, Sheet& sheet) {
  const int columns = static_cast<int>(std::lround(fine * image.width)),
            rows = static_cast<int>(std::lround(fine * image.height));
  Painting painting = paint(look.part, look.blank, fitted_view, columns, rows, look.contacts, threads);
  sheet.items().push_back(
      ImageItem{{image.x, image.y}, image.width, image.height, std::move(painting.pixels), {"solids", ""}});
  std::vector<ContactMark> marks;
  for (std::size_t k = 0; k < look.contacts.size(); ++k) {
    const ScreenPoint at = fitted_view(look.contacts[k]);
    marks.push_back({k, {image.x + at.x / fine, image.y + at.y / fine}, painting.seen[k]});
  }
  return marks;
}

void draw_contact_lengths(const SolidLook& look, std::vector<ContactMark> marks, const Rect& frame,
                          Sheet& sheet) {
  ContactLabels(look, frame, sheet).draw(std::move(marks));
}

void draw_contact_numbers(const std::vector<ContactMark>& marks, Sheet& sheet) {
  constexpr double kRadius = 1.45;
  for (std::size_t k = marks.size(); k-- > 0;) {
    const ContactMark& mark = marks[k];
    Paint paint = filled(kPaper, mark.seen ? 0.95 : 0.45);
    paint.stroke = mark.seen ? kInk : kGrey, paint.width = mark.seen ? 0.3 : 0.2;
    const std::string number = std::to_string(mark.contact + 1);
    sheet.items().push_back(
        DotItem{mark.at, kRadius, paint, {mark.seen ? "contact" : "hidden-contact", number}});
    sheet.text(mark.at.x, mark.at.y + 0.72, 2 * kRadius, number,
               {.size = 2,
                .colour = mark.seen ? kInk : kGrey,
                .anchor = Anchor::middle,
                .bold = mark.seen,
                .kind = "contact-number"});
  }
}

void draw_axes(const SpaceView& view, Point origin, Sheet& sheet) {
  constexpr double kLength = 7;
  const struct {
    const char* name;
    Vector along;
  } axes[] = {{"x", {1, 0, 0}}, {"y", {0, 1, 0}}, {"z", {0, 0, 1}}};
  for (const auto& [name, along] : axes) {
    const Point way{dot(view.right, along), -dot(view.up, along)};
    if (geom::norm(way) < 0.05) continue;
    const Point tip = origin + kLength * way, beyond = tip + 1.9 / geom::norm(way) * way;
    sheet.path({origin, tip}, false, stroked_round(kGrey, 0.35), "axis");
    sheet.text(beyond.x, beyond.y + 0.85, 5, name,
               {.size = kReportSmall, .colour = kGrey, .anchor = Anchor::middle, .kind = "axis"});
  }
}

void draw_scale_bar(double scale, Point left, double most, Sheet& sheet) {
  const double length = round_length(most / scale), on_page = length * scale;
  sheet.path({{left.x, left.y - 1}, left, {left.x + on_page, left.y}, {left.x + on_page, left.y - 1}}, false,
             stroked_round(kInk, 0.3), "scale-bar");
  sheet.text(left.x + on_page + 1.5, left.y, 30, length_scale(length, length).text_with_unit(length),
             {.size = kReportSmall, .kind = "scale-bar"});
}

double draw_solid_key(const SolidScene& scene, const SolidLook& look, const Rect& room, Sheet& sheet) {
  double y = room.y;
  if (!scene.allowances.empty() && look.greatest >= scene.least_wanted())
    y = draw_colour_scale(look.range, scale_words(scene), {room.x, y, room.width, 0}, kReportBody,
                          kReportSmall, sheet.items()) +
        1;
  for (const SolidKey& key : key_of(scene, look)) {
    y += kReportLine + 0.3;
    Paint paint = filled(key.colour, key.alpha);
    paint.stroke = kBlankLine, paint.width = 0.25;
    sheet.path(Rect{room.x, y - 2.3, 5.5, 2.6}.ring(), true, paint, "key");
    sheet.text(room.x + 7.5, y, room.width - 7.5, key.words, {.size = kReportSmall, .kind = key.kind});
  }
  if (look.contacts.empty()) return y;
  y += kReportLine + 0.3;
  draw_mark({room.x + 1.2, y - 1}, true, {"key", ""}, sheet);
  draw_mark({room.x + 4.3, y - 1}, false, {"key", ""}, sheet);
  sheet.text(room.x + 7.5, y, room.width - 7.5, "contacts, in sight and hidden",
             {.size = kReportSmall, .kind = "key-contact"});
  return y;
}

}  // namespace lekalo::draw
