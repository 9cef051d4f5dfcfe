#include "lekalo/draw/picture.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "draw/paper/colour.hpp"
#include "draw/paper/labels.hpp"
#include "draw/paper/printed_number.hpp"
#include "draw/paper/scene.hpp"
#include "draw/paper/view.hpp"
#include "lekalo/io/text/words.hpp"
#include "panel.hpp"
#include "picture_drawing.hpp"
#include "picture_scene.hpp"

namespace lekalo::draw {
namespace {

using geom::Point;
using geom::Ring;

constexpr Rect kRingDrawing{5, 5, 168, 142};
constexpr Rect kRingPanel{180, 7, 64, 146};
constexpr double kLabelRoom = 12;  ///< around the shapes in the drawing
constexpr double kLabelSize = 2.8;
constexpr std::size_t kMostLabels = 12;  ///< contacts beyond that are drawn without numbers
/// The start is drawn beside the result as long as that makes both at most this much smaller.
constexpr double kSmallestShare = 0.6;

constexpr double kInsetSide = 30, kInsetCaption = 2.6;
constexpr double kAllowanceInInset = 9;  ///< mm of paper
constexpr double kWorthMagnifying = 4;   ///< times the drawing's scale
constexpr double kMostMagnified = 1e6;
constexpr double kFinestRounding = 0.2;  ///< mm of paper: rounding must not show in the inset

class RingComposer {
 public:
  RingComposer(const LocatePicture& picture, const PictureOfRings& rings)
      : picture_(picture),
        rings_(rings),
        shapes_(located(rings, picture.result)),
        contacts_(contact_lines(rings, shapes_)),
        scene_(empty_scene(picture)) {
    choose_view();
  }

  Scene compose() && {
    main_drawing();
    scale_bar();
    const bool start_shown = rings_.draw_start && start_in_main_;
    const double text_end = draw_panel(picture_, rings_, shapes_, kRingPanel, scene_.items);
    const double bottom = kRingPanel.bottom() - kInsetCaption - 1;
    const double side = std::min(kInsetSide, bottom - text_end - 3);
    Rect inset{kRingPanel.x, bottom - side, side, side};
    if (thinnest_scale_ > 0) {
      magnified(inset);
      inset.x = kRingPanel.x + kRingPanel.width / 2 + 1;
    }
    if (rings_.draw_start && !start_shown) overview(inset);
    return std::move(scene_);
  }

 private:
  void choose_view() {
    const Rect room = kRingDrawing.grown(-kLabelRoom);
    const geom::Box box = joined(geom::bounds(shapes_.blank), geom::bounds(shapes_.part));
    view_ = fitted(box, room);
    const View with_start = fitted(joined(box, geom::bounds(shapes_.start)), room);
    start_in_main_ = with_start.scale >= kSmallestShare * view_.scale;
    if (rings_.draw_start && start_in_main_) view_ = with_start;
    choose_magnification();
  }

  /// 0 when the thinnest place can be seen without.
  void choose_magnification() {
    if (shapes_.samples.empty() || !(std::abs(shapes_.least) > shapes_.rounding)) return;
    const double finest = kFinestRounding / shapes_.rounding;
    const double wanted = kAllowanceInInset / std::abs(shapes_.least);
    const double most = std::min(finest, kMostMagnified * view_.scale);
    const double times = std::min(wanted, most) / view_.scale;
    if (times < kWorthMagnifying) return;
    magnification_ = round_length(times);
    thinnest_scale_ = magnification_ * view_.scale;
  }

  void main_drawing() {
    draw_shapes(shapes_, view_, kRingDrawing, scene_.items);
    Obstacles obstacles{
        {on_paper(shapes_.blank, view_, kRingDrawing), on_paper(shapes_.part, view_, kRingDrawing)}, {}};
    if (rings_.draw_start && start_in_main_) {
      draw_start(shapes_, view_, kRingDrawing, scene_.items);
      obstacles.lines.push_back(on_paper(shapes_.start, view_, kRingDrawing));
    }
    draw_contacts(rings_, contacts_, view_, kRingDrawing, scene_.items);
    if (thinnest_scale_ > 0) {
      const Point at = view_(shapes_.samples[shapes_.thinnest].at);
      scene_.items.push_back(
          DotItem{at, kRing, stroked(kOutside, 0.5), {"thinnest", "the thinnest place, magnified beside"}});
      obstacles.filled.push_back(Rect{at.x - kRing, at.y - kRing, 2 * kRing, 2 * kRing}.ring());
    }
    label_contacts(obstacles);
  }

  void label_contacts(const Obstacles& obstacles) {
    if (contacts_.size() > kMostLabels) return;
    std::vector<Label> labels;
    for (const ContactLine& line : contacts_) {
      const Point foot = view_(line.foot), along = view_(line.edge_to) - view_(line.edge_from);
      if (!(geom::norm(along) > 0)) continue;
      Point outward = perpendicular(along);
      if (dot(outward, foot - view_(middle_of_blank())) < 0) outward = -outward;
      const Point vertex = view_(line.vertex);
      const bool sticks_out = dot(outward, vertex - foot) > 0;
      labels.push_back(
          {sticks_out ? vertex : foot, outward, contact_label(rings_, rings_.contacts[line.index])});
    }
    place_labels(labels, kLabelSize, obstacles, kRingDrawing, scene_.items);
  }
  [[nodiscard]] Point middle_of_blank() const {
    const geom::Box box = geom::bounds(shapes_.blank);
    return box.low + 0.5 * (box.high - box.low);
  }

  void scale_bar() {
    const double length = round_length(40 / view_.scale), on_page = length * view_.scale;
    const double x = kRingDrawing.x + 3, y = kPage.bottom() - 6;
    scene_.items.push_back(PathItem{{{{x, y - 1.2}, {x, y}, {x + on_page, y}, {x + on_page, y - 1.2}}},
                                    false,
                                    stroked(kInk, 0.35),
                                    {"scale-bar", ""}});
    scene_.items.push_back(TextItem{{x + on_page + 2.5, y},
                                    length_scale(length, length).text_with_unit(length),
                                    3.1,
                                    Anchor::start,
                                    kInk,
                                    false,
                                    {"scale-bar-label", ""}});
  }

  void frame(const Rect& inset, const std::string& caption) {
    scene_.items.push_back(PathItem{{inset.ring()}, true, stroked(kFaint, 0.25), {"inset", ""}});
    const double room = kRingPanel.width / 2 - 1.5;
    scene_.items.push_back(TextItem{{inset.x, inset.bottom() + kInsetCaption + 1},
                                    caption,
                                    io::fitting_size(caption, kInsetCaption, room),
                                    Anchor::start,
                                    kInk,
                                    false,
                                    {"inset-caption", ""}});
  }

  void magnified(const Rect& inset) {
    const Point thin = shapes_.samples[shapes_.thinnest].at;
    const View close{thin + 0.5 * (shapes_.blank_at_thinnest - thin), inset.centre(), thinnest_scale_};
    draw_shapes(shapes_, close, inset, scene_.items);
    const Paint dot = filled(kInk);
    scene_.items.push_back(PathItem{
        {{close(thin), close(shapes_.blank_at_thinnest)}}, false, stroked(kInk, 0.4), {"thinnest-line", ""}});
    scene_.items.push_back(DotItem{close(thin), 0.6, dot, {}});
    scene_.items.push_back(DotItem{close(shapes_.blank_at_thinnest), 0.6, dot, {}});
    frame(inset, fmt::format("in the ring, ×{}", magnification_));
  }

  void overview(const Rect& inset) {
    const geom::Box result = joined(geom::bounds(shapes_.blank), geom::bounds(shapes_.part));
    const geom::Box before = geom::bounds(shapes_.start);
    const View far = fitted(joined(result, before), inset.grown(-3));
    const Point from = before.low + 0.5 * (before.high - before.low);
    const geom::Box placed = geom::bounds(shapes_.part);
    const Point to = placed.low + 0.5 * (placed.high - placed.low);
    scene_.items.push_back(
        PathItem{{{far(from), far(to)}}, false, stroked(kStartLine, 0.2), {"start-way", ""}});
    const Paint blank = with_fill(stroked(kBlankLine, 0.25), kBlankFill);
    small_shape(shapes_.blank, far, inset, blank, "overview-blank");
    small_shape(shapes_.part, far, inset, stroked(kInk, 0.25), "overview-part");
    small_shape(shapes_.start, far, inset, stroked(kStartLine, 0.35, 0.9), "start");
    frame(inset, fmt::format("start: {} mm away", short_number_up(geom::norm(to - from))));
  }
  /// The shape, or a dot where it would be smaller than one.
  void small_shape(const Ring& ring, const View& view, const Rect& inset, Paint paint, const char* kind) {
    const geom::Box box = geom::bounds(ring);
    const double size = std::max(box.high.x - box.low.x, box.high.y - box.low.y) * view.scale;
    if (size < 2) {
      paint.dash = 0;
      scene_.items.push_back(DotItem{view(box.low + 0.5 * (box.high - box.low)), 0.9, paint, {kind, ""}});
    } else {
      scene_.items.push_back(PathItem{{on_paper(ring, view, inset)}, true, paint, {kind, ""}});
    }
  }

  static constexpr double kRing = 2.4;  ///< around the thinnest place, mm of paper
  const LocatePicture& picture_;
  const PictureOfRings& rings_;
  Located shapes_;
  std::vector<ContactLine> contacts_;
  Scene scene_;
  View view_;
  bool start_in_main_ = false;
  double magnification_ = 0, thinnest_scale_ = 0;
};

Scene composed(const LocatePicture& picture) {
  if (const auto* const regions = std::get_if<PictureOfRegions>(&picture.outlines))
    return composed_regions(picture, *regions);
  return RingComposer(picture, std::get<PictureOfRings>(picture.outlines)).compose();
}

}  // namespace

Scene empty_scene(const LocatePicture& picture) {
  const locate::Placement& p = picture.result;
  Scene scene;
  scene.width = kPage.width, scene.height = kPage.height;
  scene.title = fmt::format("{}: {} in {}", picture.title, io::file_name(picture.part_name),
                            io::file_name(picture.blank_name));
  scene.description = fmt::format("{}; minimum allowance {} mm at x {} mm, y {} mm, angle {} rad",
                                  picture.status, p.clearance, p.x, p.y, p.theta);
  scene.items.push_back(PathItem{{kPage.ring()}, true, filled(kPaper), {"page", ""}});
  return scene;
}

std::string picture_svg(const LocatePicture& picture) { return scene_svg(composed(picture)); }

Result<std::string> picture_png(const LocatePicture& picture, int width_px) {
  return scene_png(composed(picture), width_px);
}

}  // namespace lekalo::draw
