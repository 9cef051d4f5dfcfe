#include "lekalo/draw/heat_picture.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "draw/paper/colour.hpp"
#include "draw/paper/printed_number.hpp"
#include "draw/paper/scene.hpp"
#include "draw/paper/view.hpp"
#include "heat_unrolled.hpp"
#include "lekalo/io/text/words.hpp"
#include "region_rings.hpp"

namespace lekalo::draw {
namespace {

using geom::Point;
using geom::Ring;

constexpr Rect kHeatPage{0, 0, 250, 160};
constexpr Rect kHeatPlan{6, 20, 172, 86};
constexpr Rect kHeatMap{16, 118, 162, 26};
constexpr Rect kHeatPanel{188, 8, 56, 144};
/// A wall that is farthest off is drawn so far off, mm of paper.
constexpr double kHeatOff = 5;

class HeatComposer {
 public:
  explicit HeatComposer(const HeatPicture& picture)
      : picture_(picture), walls_(picture.columns, picture.spacing, picture.height, picture.tool_diameter) {
    view_ = fitted(picture.stock, kHeatPlan.grown(-3));
  }

  Scene compose() && {
    scene_.width = kHeatPage.width, scene_.height = kHeatPage.height;
    scene_.title = "lekalo heat: " + picture_.name;
    scene_.description = picture_.title[0];
    add(PathItem{{kHeatPage.ring()}, true, filled(kPaper), {"page", ""}});
    text({6, 10}, picture_.title[0], io::fitting_size(picture_.title[0], 4, 176), Anchor::start, kInk, true);
    text({6, 16}, picture_.title[1], io::fitting_size(picture_.title[1], 3.2, 176));
    draw_plan();
    draw_map();
    draw_panel();
    return std::move(scene_);
  }

 private:
  void add(Item item) { scene_.items.push_back(std::move(item)); }
  void text(Point at, const std::string& words, double size, Anchor anchor = Anchor::start,
            Colour colour = kInk, bool bold = false) {
    add(TextItem{at, words, size, anchor, colour, bold, {"text", ""}});
  }

  void draw_plan() {
    const geom::Box& box = picture_.stock;
    Paint stock = filled(kBlankFill);
    stock.stroke = kBlankLine, stock.width = 0.3;
    std::vector<Ring> sides;
    for (const Ring& ring : region_rings(picture_.outline, 0.02 / view_.scale, 5 / view_.scale))
      sides.push_back(on_paper(ring, view_, kHeatPlan));
    if (sides.empty())
      sides = {
          {view_(box.low), view_({box.high.x, box.low.y}), view_(box.high), view_({box.low.x, box.high.y})}};
    add(PathItem{std::move(sides), true, stock, {"stock", "the stock"}});
    Paint pocket = filled(kPaper);
    pocket.stroke = kFaint, pocket.width = 0.2;
    std::vector<Ring> rings;
    for (const Ring& ring : region_rings(picture_.pockets, 0.02 / view_.scale, 5 / view_.scale))
      rings.push_back(on_paper(ring, view_, kHeatPlan));
    add(PathItem{std::move(rings), true, pocket, {"pocket", "the pocket as the program has it"}});
    for (const HeatStretch& stretch : walls_.stretches())
      for (const HeatColumn* column : stretch.columns) {
        const double e = worst(*column);
        const Point way{-column->outward.y, column->outward.x};
        const double half = 0.5 * picture_.spacing * view_.scale;
        const Point at = off(*column, e);
        add(PathItem{
            {{{at.x - half * way.x, at.y + half * way.y}, {at.x + half * way.x, at.y - half * way.y}}},
            false,
            stroked(heat_error_colour(e / picture_.largest_um), 1.1),
            {"wall", fmt::format("{:+.2f} um", e)}});
      }
    walls_.letters([&](const HeatStretch& stretch, std::size_t i, const std::string& letter) {
      const HeatColumn& column = *stretch.columns[i];
      const Point at = view_(column.at);
      text({at.x - 3.2 * column.outward.x, at.y + 3.2 * column.outward.y + 1}, letter, 2.8, Anchor::middle,
           kGrey, true);
    });
    const double length = round_length(40 / view_.scale), on_page = length * view_.scale,
                 y = kHeatPlan.bottom() + 1;
    add(PathItem{{{{6, y - 1.2}, {6, y}, {6 + on_page, y}, {6 + on_page, y - 1.2}}},
                 false,
                 stroked_round(kInk, 0.35),
                 {"scale-bar", ""}});
    text({8.5 + on_page, y}, length_scale(length, length).text_with_unit(length), 2.8);
  }

  /// The error that is farthest from 0 at any height.
  [[nodiscard]] static double worst(const HeatColumn& column) {
    return *std::ranges::max_element(column.errors_um, {}, [](double e) { return std::abs(e); });
  }
  /// The place of a wall on paper when the workpiece is cold.
  [[nodiscard]] Point off(const HeatColumn& column, double error_um) const {
    const Point at = view_(column.at);
    const double by = kHeatOff * error_um / picture_.largest_um;
    return {at.x + by * column.outward.x, at.y - by * column.outward.y};
  }

  void draw_map() {
    text({kHeatMap.x, kHeatMap.y - 2}, "the walls unrolled, from above downwards", 2.8, Anchor::start, kGrey);
    walls_.draw(kHeatMap, picture_.largest_um, scene_.items);
  }

  void draw_panel() {
    double y = kHeatPanel.y + 3.5;
    text({kHeatPanel.x, y}, io::shortened(picture_.name, kHeatPanel.width / 3.8), 3.8, Anchor::start, kInk,
         true);
    y += 3;
    for (const auto& [what, value] : picture_.figures) {
      text({kHeatPanel.x, y += 5}, what, 2.8, Anchor::start, kGrey);
      text({kHeatPanel.right(), y}, value, io::fitting_size(value, 2.8, 0.6 * kHeatPanel.width), Anchor::end);
    }
    y += 9;
    text({kHeatPanel.x, y}, "error of the wall when cold, um", 2.8);
    draw_error_scale({kHeatPanel.x, y + 1.5, kHeatPanel.width, 0}, picture_.largest_um, scene_.items);
    text({kHeatPanel.x, y + 19},
         fmt::format("Walls from above: {:.0f} times as far off.",
                     1000 * kHeatOff / view_.scale / picture_.largest_um),
         2.6, Anchor::start, kGrey);
  }

  const HeatPicture& picture_;
  UnrolledWalls walls_;
  Scene scene_;
  View view_;
};

}  // namespace

std::string heat_svg(const HeatPicture& picture) { return scene_svg(HeatComposer(picture).compose()); }

Result<std::string> heat_png(const HeatPicture& picture, int width_px) {
  return scene_png(HeatComposer(picture).compose(), width_px);
}

}  // namespace lekalo::draw
