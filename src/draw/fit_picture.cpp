#include "lekalo/draw/fit_picture.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "draw/paper/colour.hpp"
#include "draw/paper/scene.hpp"

namespace lekalo::draw {
namespace {

constexpr double kFitWidth = 250, kFitHeight = 160, kFitLeft = 28, kFitRight = 242, kFitTop = 22,
                 kFitBottom = 150, kFitBetween = 9;
constexpr std::array<Colour, 3> kFitCurves{{{0, 114, 178}, {0, 158, 115}, {213, 94, 0}}};

struct FitRange {
  double low = HUGE_VAL, high = -HUGE_VAL;
  void take(double value) { low = std::min(low, value), high = std::max(high, value); }
};

class FitComposer {
 public:
  explicit FitComposer(const FitPicture& picture) : picture_(picture) {
    for (const FitPanel& panel : picture.panels)
      for (const auto& curve : panel.curves)
        for (const geom::Point& p : curve) along_.take(p.x);
  }

  Scene compose() {
    scene_.width = kFitWidth, scene_.height = kFitHeight, scene_.title = picture_.title;
    add(PathItem{{{{0, 0}, {kFitWidth, 0}, {kFitWidth, kFitHeight}, {0, kFitHeight}}},
                 true,
                 filled(kPaper),
                 {"page", ""}});
    text({kFitLeft, 9}, picture_.title, 4, Anchor::start, kInk, true);
    for (std::size_t i = 0; i < picture_.words.size(); ++i)
      text({kFitLeft + 72 * static_cast<double>(i), 16}, picture_.words[i], 3, Anchor::start,
           kFitCurves[i % kFitCurves.size()], true);
    const double each = (kFitBottom - kFitTop) / static_cast<double>(picture_.panels.size());
    for (std::size_t i = 0; i < picture_.panels.size(); ++i)
      panel(picture_.panels[i], kFitTop + each * static_cast<double>(i) + kFitBetween,
            kFitTop + each * static_cast<double>(i + 1));
    text({(kFitLeft + kFitRight) / 2, kFitHeight - 3}, "along the axis, mm", 3, Anchor::middle, kInk);
    return std::move(scene_);
  }

 private:
  void add(Item item) { scene_.items.push_back(std::move(item)); }
  void text(geom::Point at, const std::string& words, double size, Anchor anchor, Colour colour,
            bool bold = false) {
    add(TextItem{at, words, size, anchor, colour, bold, {"text", ""}});
  }
  [[nodiscard]] double x_of(double z) const {
    return kFitLeft + (z - along_.low) / (along_.high - along_.low) * (kFitRight - kFitLeft);
  }
  void line(geom::Point a, geom::Point b, Paint paint) {
    add(PathItem{{{a, b}}, false, paint, {"line", ""}});
  }

  void panel(const FitPanel& panel, double top, double bottom) {
    FitRange range;
    range.take(0);
    for (const auto& curve : panel.curves)
      for (const geom::Point& p : curve) range.take(p.y);
    if (range.high == range.low) range.high += 1;
    const auto y_of = [&](double value) {
      return bottom - (value - range.low) / (range.high - range.low) * (bottom - top);
    };
    text({kFitLeft, top - 2}, panel.title, 3, Anchor::start, kInk);
    for (const double value : {range.low, range.high, 0.0}) {
      line({kFitLeft, y_of(value)}, {kFitRight, y_of(value)}, stroked(kFaint, 0.15));
      // Beside 0 a figure would lie on its own.
      if (value != 0 && std::abs(y_of(value) - y_of(0)) < 3) continue;
      text({kFitLeft - 1.5, y_of(value) + 1}, fmt::format("{:.3g}", value), 2.6, Anchor::end, kInk);
    }
    for (const double z : {along_.low, picture_.hub_from, 0.0, picture_.hub_to, along_.high})
      text({x_of(z), bottom + 3.4}, fmt::format("{:.4g}", z), 2.6, Anchor::middle, kInk);
    for (const double z : {picture_.hub_from, picture_.hub_to})
      line({x_of(z), top}, {x_of(z), bottom}, stroked(kFaint, 0.25, 1.2));
    for (std::size_t i = 0; i < panel.curves.size(); ++i) {
      geom::Ring points;
      for (const geom::Point& p : panel.curves[i]) points.push_back({x_of(p.x), y_of(p.y)});
      add(PathItem{
          {points}, false, stroked_round(kFitCurves[i % kFitCurves.size()], 0.5), {"curve", panel.title}});
    }
  }

  const FitPicture& picture_;
  FitRange along_;
  Scene scene_;
};

}  // namespace

std::string fit_svg(const FitPicture& picture) { return scene_svg(FitComposer(picture).compose()); }

Result<std::string> fit_png(const FitPicture& picture, int width_px) {
  return scene_png(FitComposer(picture).compose(), width_px);
}

}  // namespace lekalo::draw
