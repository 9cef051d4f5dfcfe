#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "draw/paper/colour.hpp"
#include "draw/paper/printed_number.hpp"
#include "draw/paper/scene.hpp"
#include "draw/paper/view.hpp"
#include "lekalo/base/angle.hpp"
#include "lekalo/geom/pose.hpp"
#include "lekalo/geom/region_index.hpp"
#include "lekalo/io/text/words.hpp"
#include "picture_scene.hpp"
#include "region_rings.hpp"

namespace lekalo::draw {
namespace {

using geom::Point;
using geom::Ring;

constexpr Rect kRegionDrawing{6, 6, 168, 142};
constexpr Rect kRegionPanel{182, 8, 62, 144};
constexpr double kRegionSag = 0.01;  ///< of an arc's chord, mm of paper
constexpr double kSampleStep = 0.5;  ///< along the part's outline, mm of paper
constexpr double kRegionBand = 1.3;  ///< width of the coloured outline, mm of paper

class RegionComposer {
 public:
  RegionComposer(const LocatePicture& picture, const PictureOfRegions& regions)
      : picture_(picture),
        regions_(regions),
        blank_(regions.blank),
        pose_(geom::BlankFromPart::from_angle(picture.result.theta, {picture.result.x, picture.result.y},
                                              picture.mirrored)),
        scene_(empty_scene(picture)) {
    choose_view();
    measure();
  }

  Scene compose() && {
    draw_blank();
    draw_part();
    draw_contacts();
    draw_panel();
    return std::move(scene_);
  }

 private:
  void choose_view() {
    geom::Box box = blank_.bounds();
    const double rough = norm(box.high - box.low) / 200;
    for (const Ring& ring : placed_rings(rough, 4 * rough)) box = joined(box, geom::bounds(ring));
    view_ = fitted(box, kRegionDrawing);
  }

  [[nodiscard]] std::vector<Ring> placed_rings(double sag, double step) const {
    std::vector<Ring> rings = region_rings(regions_.part, sag, step);
    for (Ring& ring : rings)
      for (Point& p : ring) p = pose_(p);
    return rings;
  }

  /// Allowance along the placed outline.
  void measure() {
    outline_ = placed_rings(kRegionSag / view_.scale, kSampleStep / view_.scale);
    for (const Ring& ring : outline_) {
      std::vector<double>& values = allowance_.emplace_back();
      for (const Point& p : ring) {
        const double distance = blank_.nearest(p).distance;
        values.push_back(blank_.contains(p) ? distance : -distance);
        low_ = std::min(low_, values.back()), high_ = std::max(high_, values.back());
      }
    }
    scale_low_ = std::max(0.0, low_);
    if (!(high_ > scale_low_)) high_ = scale_low_ + 1;
  }

  [[nodiscard]] Ring paper(const Ring& ring) const {
    Ring out;
    for (const Point& p : ring) out.push_back(view_(p));
    return out;
  }

  void draw_blank() {
    const Paint paint = with_fill(stroked_round(kBlankLine, 0.3), kBlankFill);
    std::vector<Ring> lines;
    for (const Ring& ring : region_rings(regions_.blank, kRegionSag / view_.scale, 1e300))
      lines.push_back(paper(ring));
    scene_.items.push_back(PathItem{std::move(lines), true, paint, {"blank", "blank"}});
  }

  void draw_part() {
    std::vector<Ring> lines;
    for (const Ring& ring : outline_) lines.push_back(paper(ring));
    scene_.items.push_back(PathItem{std::move(lines), true, filled(kPaper, 0.55), {"part", "placed part"}});
    for (std::size_t r = 0; r < outline_.size(); ++r) {
      const std::size_t n = outline_[r].size();
      // Stretches of one colour in one stroke.
      for (std::size_t k = 0; k < n;) {
        const int colour = step_of(r, k);
        Ring stretch{view_(outline_[r][k])};
        do {
          ++k;
          stretch.push_back(view_(outline_[r][k % n]));
        } while (k < n && step_of(r, k) == colour);
        scene_.items.push_back(
            PathItem{{std::move(stretch)},
                     false,
                     stroked_round(colour < 0 ? kOutside : scale_colour(colour), kRegionBand),
                     {colour < 0 ? "outside" : "allowance", ""}});
      }
    }
  }
  /// -1 where the part sticks out.
  [[nodiscard]] int step_of(std::size_t ring, std::size_t k) const {
    const double value = allowance_[ring][k];
    return value < 0 ? -1 : scale_step(value, scale_low_, high_);
  }

  void draw_contacts() {
    for (const locate::Touch& contact : regions_.contacts) {
      const Point a = view_(pose_(contact.part)), b = view_(contact.blank);
      const Paint dot = filled(kInk);
      scene_.items.push_back(PathItem{
          {{a, b}}, false, stroked_round(kInk, 0.4), {"contact", fmt::format("{} mm", contact.distance)}});
      scene_.items.push_back(DotItem{a, 0.7, dot, {"contact-part", ""}});
      scene_.items.push_back(DotItem{b, 0.7, dot, {"contact-blank", ""}});
      scene_.items.push_back(
          DotItem{0.5 * (a + b), 2.4, stroked_round(kOutside, 0.35), {"contact-ring", ""}});
    }
  }

  void text(const std::string& words, double size, Colour colour, bool bold = false,
            double x = kRegionPanel.x) {
    scene_.items.push_back(TextItem{{x, y_},
                                    io::clean_text(words),
                                    io::fitting_size(words, size, kRegionPanel.right() - x),
                                    Anchor::start,
                                    colour,
                                    bold,
                                    {}});
  }
  void line(const std::string& name, const std::string& value) {
    text(name, 3, kGrey);
    scene_.items.push_back(TextItem{
        {kRegionPanel.right(), y_}, value, io::fitting_size(value, 3.2, 36), Anchor::end, kInk, false, {}});
    y_ += 5;
  }

  void draw_panel() {
    const locate::Placement& p = picture_.result;
    const int decimals = decimals_for(norm(blank_.bounds().high - blank_.bounds().low));
    text("Placement", 5, kInk, true);
    y_ += 6;
    text(io::shortened(io::file_name(picture_.part_name), kRegionPanel.width / 3) + " in", 3, kGrey);
    y_ += 4.2;
    text(io::shortened(io::file_name(picture_.blank_name), kRegionPanel.width / 3), 3, kGrey);
    y_ += 7;
    text(picture_.status, 4, picture_.status == "optimal" ? kGood : kDoubt, true);
    y_ += 7;
    line("x", decimal(p.x, decimals) + " mm");
    line("y", decimal(p.y, decimals) + " mm");
    line("angle", decimal(p.theta * 180 / kPi, decimals) + "°");
    if (picture_.mirrored) line("mirrored", "in x, before turning");
    y_ += 2;
    line("minimum allowance", decimal(p.clearance, decimals, Rounding::down) + " mm");
    if (picture_.upper_bound)
      line("proved: none above", decimal(*picture_.upper_bound, decimals, Rounding::up) + " mm");
    if (regions_.margin) line("margin of the demands", decimal(*regions_.margin, decimals, Rounding::down));
    if (regions_.margin_bound)
      line("proved: none above", decimal(*regions_.margin_bound, decimals, Rounding::up));
    if (picture_.min_allowance > 0) line("demanded", decimal(picture_.min_allowance, decimals) + " mm");
    if (picture_.shortfall > 0) line("missing", decimal(picture_.shortfall, decimals, Rounding::up) + " mm");
    y_ += 6;
    draw_scale();
    y_ = kRegionPanel.bottom() - 10;
    text("grey: blank; coloured line: the part's outline,", 2.6, kGrey);
    y_ += 3.6;
    text("in the colour of the material over it; ring: contact", 2.6, kGrey);
  }

  void draw_scale() {
    text("allowance along the outline, mm", 3, kGrey);
    y_ += 3;
    const double height = 42;
    for (int k = 0; k < kColourSteps; ++k) {
      const double top = y_ + height * (kColourSteps - 1 - k) / kColourSteps;
      const Rect bar{kRegionPanel.x, top, 6, height / kColourSteps + 0.05};
      scene_.items.push_back(PathItem{{bar.ring()}, true, filled(scale_colour(k)), {"scale", ""}});
    }
    constexpr int kTicks = 4;
    for (int k = 0; k <= kTicks; ++k) {
      const double value = scale_low_ + (high_ - scale_low_) * k / kTicks;
      const double at = y_ + height * (kTicks - k) / kTicks;
      scene_.items.push_back(TextItem{
          {kRegionPanel.x + 8, at + 1}, fmt::format("{:.3f}", value), 2.8, Anchor::start, kInk, false, {}});
    }
    if (low_ < 0) {
      const Rect bar{kRegionPanel.x, y_ + height + 2, 6, 3};
      scene_.items.push_back(PathItem{{bar.ring()}, true, filled(kOutside), {"scale", ""}});
      scene_.items.push_back(TextItem{{kRegionPanel.x + 8, y_ + height + 4.6},
                                      fmt::format("sticks out, up to {:.3f}", -low_),
                                      2.8,
                                      Anchor::start,
                                      kInk,
                                      false,
                                      {}});
    }
    y_ += height;
  }

  const LocatePicture& picture_;
  const PictureOfRegions& regions_;
  geom::RegionIndex blank_;
  geom::BlankFromPart pose_;
  View view_;
  std::vector<Ring> outline_;                   ///< of the placed part, blank frame
  std::vector<std::vector<double>> allowance_;  ///< at its points
  double low_ = 1e300, high_ = -1e300, scale_low_ = 0;
  double y_ = kRegionPanel.y + 3;
  Scene scene_;
};

}  // namespace

Scene composed_regions(const LocatePicture& picture, const PictureOfRegions& regions) {
  return RegionComposer(picture, regions).compose();
}

}  // namespace lekalo::draw
