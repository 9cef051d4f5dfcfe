#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "draw/paper/labels.hpp"
#include "lekalo/geom/pose.hpp"
#include "region_rings.hpp"
#include "report_page.hpp"

namespace lekalo::draw {
namespace {

using geom::Point;
using geom::Ring;

constexpr double kReportBand = 1.5;      ///< width of the coloured band inside the outline, mm of paper
constexpr double kThinReportBand = 0.9;  ///< of the coloured line on parts that have no room for the band
constexpr double kReportSag = 0.01;      ///< of an arc's chord, mm of paper
constexpr double kRoomSide = 16, kRoomTop = 8;  ///< around the shapes, for labels
constexpr double kStrip = 8;                    ///< for scale bar and legend, at the bottom of the frame
constexpr std::size_t kMostContactMarks = 12;   ///< contacts with a letter
constexpr Colour kMissingFill{250, 190, 196};

enum Level : int { kSticksOut = -2, kTooThin = -1 };  ///< else a step of the colour scale

/// Gives the box around the blank and the placed part.
geom::Box bounds_of(const Report& report) {
  geom::Box box = geom::bounds(report.shapes.blank.front().outer);
  for (const geom::Region& region : report.shapes.blank) box = joined(box, geom::bounds(region.outer));
  for (const locate::EdgeAllowance& edge : report.edges)
    for (const locate::OutlinePoint& p : edge.samples) box = joined(box, {p.in_blank, p.in_blank});
  return box;
}

class Drawing {
 public:
  Drawing(const Report& report, const ReportLook& look, const Rect& frame, Sheet& sheet)
      : report_(report), look_(look), frame_(frame), sheet_(sheet), items_(sheet.items()) {
    const locate::Placement& p = report.document.placement;
    pose_ = geom::BlankFromPart::from_angle(p.theta, {p.x, p.y}, report.document.mirrored);
    choose_view();
    for (Ring& ring : region_rings(report.shapes.part, kReportSag / view_.scale, 1e300)) {
      std::transform(ring.begin(), ring.end(), ring.begin(), pose_);
      part_.push_back(on_paper(ring, view_, frame_));
    }
    for (const Ring& ring : region_rings(report.shapes.blank, kReportSag / view_.scale, 1e300))
      blank_.push_back(on_paper(ring, view_, frame_));
  }

  void draw() {
    shapes();
    items_.push_back(PathItem{{frame_.ring()}, true, stroked(kRule, 0.3), {"frame", ""}});
    contacts();
    labels();
    strip();
  }

 private:
  void choose_view() {
    const Rect room{frame_.x + kRoomSide, frame_.y + kRoomTop, frame_.width - 2 * kRoomSide,
                    frame_.height - 2 * kRoomTop - kStrip};
    view_ = fitted(bounds_of(report_), room);
  }

  /// Twice the area over the perimeter: less than the width of a long shape.
  [[nodiscard]] bool is_thin() const {
    double length = 0;
    for (const locate::EdgeAllowance& edge : report_.edges) length += edge.length;
    return !(2 * geom::area(report_.shapes.part) / length * view_.scale > 2 * kReportBand);
  }

  void shapes() {
    const bool thin = is_thin(), sticks_out = report_.document.placement.clearance < 0;
    items_.push_back(ClipBegin{{frame_.ring()}});
    // The blank is painted over the part, so what it leaves uncovered of the part is what is missing.
    if (sticks_out) items_.push_back(PathItem{part_, true, filled(kMissingFill), {"part-outside", ""}});
    items_.push_back(PathItem{blank_, true, filled(kBlankFill), {"blank", "blank"}});
    items_.push_back(ClipBegin{blank_});
    items_.push_back(PathItem{part_, true, filled(kPaper), {"part", "part at the result"}});
    items_.push_back(ClipEnd{});
    bands(thin ? kThinReportBand : 2 * kReportBand);
    if (!thin) {
      // The half of the band outside the part is painted over. (A clip along the part for every piece of the
      // band would say the outline hundreds of times in a PDF.)
      items_.push_back(ClipBegin{outside_part()});
      items_.push_back(PathItem{{frame_.ring()}, true, filled(kPaper), {"outside", ""}});
      items_.push_back(PathItem{blank_, true, filled(kBlankFill), {"blank-around", ""}});
      items_.push_back(ClipEnd{});
    }
    items_.push_back(PathItem{blank_, true, stroked(kBlankLine, 0.25), {"blank-outline", ""}});
    items_.push_back(PathItem{part_, true, stroked(kInk, thin ? 0.1 : 0.2), {"part-outline", ""}});
    items_.push_back(ClipEnd{});
  }

  /// The frame less the part: its outline runs against the frame's, so that they cancel inside.
  [[nodiscard]] std::vector<Ring> outside_part() const {
    std::vector<Ring> rings = part_;
    Ring frame = frame_.ring();
    const bool same = (geom::signed_area(part_.front()) > 0) == (geom::signed_area(frame) > 0);
    if (same) std::reverse(frame.begin(), frame.end());
    rings.push_back(std::move(frame));
    return rings;
  }

  [[nodiscard]] int level_of(double allowance, double demanded) const {
    if (allowance < demanded) return allowance < 0 ? kSticksOut : kTooThin;
    return scale_step(allowance, look_.range.low, look_.range.high);
  }

  struct Stop {
    Point at;
    int level;
  };
  /// Points along a contour and the level from each to the next; closer ones are drawn as one, at the lowest
  /// level.
  [[nodiscard]] std::vector<Stop> stops(std::size_t first, std::size_t last) const {
    constexpr double kNear = 0.15;
    std::vector<Stop> found;
    for (std::size_t edge = first; edge < last; ++edge) {
      const auto& samples = report_.edges[edge].samples;
      for (std::size_t k = 0; k + 1 < samples.size(); ++k) {
        const double allowance = std::min(samples[k].allowance, samples[k + 1].allowance);
        const Stop stop{view_(samples[k].in_blank), level_of(allowance, report_.demanded[edge])};
        if (!found.empty() && norm(stop.at - found.back().at) < kNear) {
          found.back().level = std::min(found.back().level, stop.level);
        } else {
          found.push_back(stop);
        }
      }
    }
    return found;
  }

  /// A contour in pieces of one colour, each drawn a little into the next so that no seam shows.
  void band(std::size_t first, std::size_t last, double width) {
    const std::vector<Stop> around = stops(first, last);
    const auto next = [&](std::size_t k) { return k + 1 == around.size() ? 0 : k + 1; };
    struct BandPiece {
      Ring line;
      int level;
    };
    std::vector<BandPiece> pieces;
    for (std::size_t k = 0; k < around.size(); ++k) {
      if (pieces.empty() || pieces.back().level != around[k].level)
        pieces.push_back({{around[k].at}, around[k].level});
      pieces.back().line.push_back(around[next(k)].at);
    }
    constexpr double kInto = 0.4;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const Ring& following = pieces[k + 1 == pieces.size() ? 0 : k + 1].line;
      const Point begin = following[0], along = following[1] - begin;
      const double length = norm(along);
      if (length > 0) pieces[k].line.push_back(begin + std::min(1.0, kInto / length) * along);
    }
    for (BandPiece& piece : pieces) {
      const bool out = piece.level == kSticksOut;
      if (out)
        items_.push_back(
            PathItem{{piece.line}, false, stroked(kOutsideBase, width), {"allowance-outside-base", ""}});
      const Colour colour = piece.level < 0 ? kOutside : scale_colour(piece.level);
      const char* const kind =
          out ? "allowance-outside" : (piece.level < 0 ? "allowance-too-thin" : "allowance");
      items_.push_back(
          PathItem{{std::move(piece.line)}, false, stroked(colour, width, out ? 1.6 : 0), {kind, ""}});
    }
  }
  void bands(double width) {
    std::size_t first = 0;
    const auto add = [&](const geom::Contour& contour) {
      band(first, first + contour.size(), width);
      first += contour.size();
    };
    for (const geom::Region& region : report_.shapes.part) {
      add(region.outer);
      for (const geom::Contour& hole : region.holes) add(hole);
    }
  }

  void contacts() {
    for (std::size_t k = 0; k < report_.contacts.size(); ++k) {
      const locate::Touch& contact = report_.contacts[k];
      const Point a = view_(pose_(contact.part)), b = view_(contact.blank);
      Paint line = stroked(kInk, 0.4);
      line.round = true;
      items_.push_back(
          PathItem{{{a, b}},
                   false,
                   line,
                   {"contact", fmt::format("contact {}: {} mm", contact_letter(k), contact.distance)}});
      Paint dot = filled(kPaper);
      dot.stroke = kInk;
      dot.width = 0.3;
      items_.push_back(DotItem{a, 0.6, dot, {"contact-part", ""}});
      items_.push_back(DotItem{b, 0.35, filled(kInk), {"contact-blank", ""}});
    }
  }

  /// Labels what is missing first, for that decides.
  void labels() {
    std::vector<Label> labels;
    for (const locate::MissingPlace& place : report_.missing) {
      const Point at = view_(place.in_blank);
      items_.push_back(DotItem{at, 0.8, with_fill(stroked(kOutside, 0.4), kPaper), {"missing-place", ""}});
      labels.push_back(
          {at, away_from_middle(at),
           length_text(place.depth, std::max(3, look_.table_decimals - 1), Rounding::up) + " missing",
           "missing-label", kOutside, true});
    }
    for (std::size_t k = 0; k < std::min(report_.contacts.size(), kMostContactMarks); ++k) {
      const Point a = view_(pose_(report_.contacts[k].part)), b = view_(report_.contacts[k].blank);
      const Point out = norm(b - a) > 1e-6 ? b - a : away_from_middle(b);
      labels.push_back({b, out, contact_letter(k), "contact-label", kInk, true});
    }
    Obstacles obstacles;
    for (const std::vector<Ring>* rings : {&blank_, &part_})
      for (const Ring& ring : *rings)
        if (ring.size() > 1) obstacles.lines.push_back(ring);
    for (const locate::Touch& contact : report_.contacts) around(view_(pose_(contact.part)), obstacles);
    for (const locate::MissingPlace& place : report_.missing) around(view_(place.in_blank), obstacles);
    Rect room = frame_.grown(-1);
    room.height -= kStrip;
    place_labels(labels, kReportBody, obstacles, room, items_);
  }
  [[nodiscard]] Point away_from_middle(Point at) const {
    const Point out = at - view_.at;
    return norm(out) > 1 ? out : Point{1, -1};
  }
  static void around(Point at, Obstacles& obstacles) {
    obstacles.lines.push_back(Rect{at.x - 0.8, at.y - 0.8, 1.6, 1.6}.ring());
  }

  void strip() {
    const double y = frame_.bottom() - 2.6, left = frame_.x + 3;
    const double length = round_length(35 / view_.scale), paper = length * view_.scale;
    items_.push_back(PathItem{{{{left, y - 1.2}, {left, y}, {left + paper, y}, {left + paper, y - 1.2}}},
                              false,
                              stroked(kInk, 0.3),
                              {"scale-bar", ""}});
    sheet_.text(left + paper + 2, y, 25, length_scale(length, length).text_with_unit(length),
                {.size = kReportBody, .kind = "scale-bar-label"});
    double x = frame_.x + 68;
    const auto key = [&](Colour fill, Colour line, const std::string& words) {
      Paint paint = filled(fill);
      paint.stroke = line;
      paint.width = 0.25;
      sheet_.path(Rect{x, y - 1.9, 4, 2.2}.ring(), true, paint, "key");
      sheet_.text(x + 5, y, 60, words, {.size = kReportSmall, .kind = "key-words"});
      x += 8 + kReportSmall * io::text_width(words);
    };
    key(kBlankFill, kBlankLine, "blank");
    key(kPaper, kInk, "part, placed");
    if (look_.greatest >= 0) {
      constexpr int kShown = 8;
      for (int k = 0; k < kShown; ++k) {
        const Rect piece{x + k, y - 1.9, kShown - k + 0.0, 2.2};
        sheet_.path(piece.ring(), true, filled(scale_colour(k * (kColourSteps - 1) / (kShown - 1))), "key");
      }
      x += kShown - 4;
      sheet_.text(x + 5, y, 60, "allowance, thin to thick", {.size = kReportSmall, .kind = "key-words"});
      x += 8 + kReportSmall * io::text_width("allowance, thin to thick");
    }
    if (!report_.missing.empty()) key(kMissingFill, kOutside, "material missing");
  }

  const Report& report_;
  const ReportLook& look_;
  Rect frame_;
  Sheet& sheet_;
  std::vector<Item>& items_;
  geom::BlankFromPart pose_;
  View view_;
  std::vector<Ring> part_, blank_;  ///< on paper
};

}  // namespace

double placement_height(const Report& report, double width) {
  const geom::Box box = bounds_of(report);
  const geom::Point size = box.high - box.low;
  return (width - 2 * kRoomSide) * (size.x > 0 ? std::min(size.y / size.x, 10.0) : 10) + 2 * kRoomTop +
         kStrip;
}

void draw_placement(const Report& report, const ReportLook& look, const Rect& frame, Sheet& sheet) {
  Drawing(report, look, frame, sheet).draw();
}

}  // namespace lekalo::draw
