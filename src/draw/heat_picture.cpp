#include "lekalo/draw/heat_picture.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "draw/paper/colour.hpp"
#include "draw/paper/printed_number.hpp"
#include "draw/paper/scene.hpp"
#include "draw/paper/view.hpp"
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
constexpr int kHeatBands = 32;
constexpr int kHeatLetters = 4;  // for each contour
/// The pocket is too small, as it is to be, too large.
constexpr Colour kHeatSmall{0, 84, 148}, kHeatNone{238, 238, 232}, kHeatLarge{190, 70, 0};

Colour heat_between(Colour a, Colour b, double share) {
  const auto mixed = [&](std::uint8_t x, std::uint8_t y) {
    return static_cast<std::uint8_t>(std::lround(x + share * (y - x)));
  };
  return {mixed(a.red, b.red), mixed(a.green, b.green), mixed(a.blue, b.blue)};
}

/// \param share  of the largest error, from -1 to 1; in bands, so that equal colours are equal
Colour heat_colour(double share) {
  const double banded = std::round(std::clamp(share, -1.0, 1.0) * kHeatBands) / kHeatBands;
  return banded < 0 ? heat_between(kHeatNone, kHeatSmall, -banded)
                    : heat_between(kHeatNone, kHeatLarge, banded);
}

/// Columns that follow one another on one contour, and how far along it each of them is, mm.
struct HeatStretch {
  std::vector<const HeatColumn*> columns;
  std::vector<double> along;
  [[nodiscard]] double length() const { return along.back(); }
};

class HeatComposer {
 public:
  explicit HeatComposer(const HeatPicture& picture) : picture_(picture) {
    const double apart = picture.tool_diameter + 2 * picture.spacing;
    for (const HeatColumn& column : picture.columns) {
      const double way =
          stretches_.empty() ? 0 : geom::norm(column.at - stretches_.back().columns.back()->at);
      if (stretches_.empty() || way > apart) {
        stretches_.emplace_back().along.push_back(0);
      } else {
        stretches_.back().along.push_back(stretches_.back().length() + way);
      }
      stretches_.back().columns.push_back(&column);
      for (const double z : column.z) low_z_ = std::min(low_z_, z), high_z_ = std::max(high_z_, z);
    }
    low_z_ -= picture.height / 2, high_z_ += picture.height / 2;
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
    add(PathItem{
        {{view_(box.low), view_({box.high.x, box.low.y}), view_(box.high), view_({box.low.x, box.high.y})}},
        true,
        stock,
        {"stock", "the stock"}});
    Paint pocket = filled(kPaper);
    pocket.stroke = kFaint, pocket.width = 0.2;
    std::vector<Ring> rings;
    for (const Ring& ring : region_rings(picture_.pockets, 0.02 / view_.scale, 5 / view_.scale))
      rings.push_back(on_paper(ring, view_, kHeatPlan));
    add(PathItem{std::move(rings), true, pocket, {"pocket", "the pocket as the program has it"}});
    for (const HeatStretch& stretch : stretches_)
      for (const HeatColumn* column : stretch.columns) {
        const double e = worst(*column);
        const Point way{-column->outward.y, column->outward.x};
        const double half = 0.5 * picture_.spacing * view_.scale;
        const Point at = off(*column, e);
        add(PathItem{
            {{{at.x - half * way.x, at.y + half * way.y}, {at.x + half * way.x, at.y - half * way.y}}},
            false,
            stroked(heat_colour(e / picture_.largest_um), 1.1),
            {"wall", fmt::format("{:+.2f} um", e)}});
      }
    letters([&](const HeatStretch& stretch, std::size_t i, const std::string& letter) {
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

  /// Calls draw(stretch, column, letter) for the places that have letters.
  template <class F>
  void letters(F draw) const {
    char letter = 'A';
    for (const HeatStretch& stretch : stretches_)
      for (int k = 0; k < kHeatLetters && letter <= 'Z'; ++k, ++letter) {
        const double along = stretch.length() * k / kHeatLetters;
        const auto at = std::ranges::lower_bound(stretch.along, along - 1e-9);
        draw(stretch, static_cast<std::size_t>(at - stretch.along.begin()), std::string(1, letter));
      }
  }

  void draw_map() {
    double whole = 0;
    const double gap = 3 * picture_.spacing;
    for (const HeatStretch& stretch : stretches_) whole += stretch.length() + picture_.spacing + gap;
    const double x_scale = kHeatMap.width / (whole - gap), y_scale = kHeatMap.height / (high_z_ - low_z_);
    const auto y_of = [&](double z) { return kHeatMap.y + y_scale * (high_z_ - z); };
    double begin = kHeatMap.x;
    std::vector<double> begins;
    for (const HeatStretch& stretch : stretches_) {
      begins.push_back(begin);
      for (std::size_t i = 0; i < stretch.columns.size(); ++i) {
        const HeatColumn& column = *stretch.columns[i];
        for (std::size_t k = 0; k < column.z.size(); ++k) {
          const Rect cell{begin + x_scale * stretch.along[i], y_of(column.z[k] + picture_.height / 2),
                          x_scale * picture_.spacing * 1.02, y_scale * picture_.height * 1.02};
          add(PathItem{{cell.ring()},
                       true,
                       filled(heat_colour(column.errors_um[k] / picture_.largest_um)),
                       {"place", fmt::format("X {:.2f} Y {:.2f} Z {:.2f}: {:+.2f} um", column.at.x,
                                             column.at.y, column.z[k], column.errors_um[k])}});
        }
      }
      begin += x_scale * (stretch.length() + picture_.spacing + gap);
    }
    text({kHeatMap.x, kHeatMap.y - 2}, "the walls unrolled, from above downwards", 2.8, Anchor::start, kGrey);
    for (const double z : {high_z_, low_z_})
      text({kHeatMap.x - 1, y_of(z) + (z == high_z_ ? 2 : 0)}, fmt::format("{:.4g}", z), 2.6, Anchor::end);
    text({kHeatMap.x - 1, (y_of(high_z_) + y_of(low_z_)) / 2 + 1}, "Z", 2.6, Anchor::end, kGrey);
    letters([&](const HeatStretch& stretch, std::size_t i, const std::string& letter) {
      const auto number = static_cast<std::size_t>(&stretch - stretches_.data());
      text({begins[number] + x_scale * (stretch.along[i] + picture_.spacing / 2), kHeatMap.bottom() + 4},
           letter, 2.8, Anchor::middle, kGrey, true);
    });
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
    constexpr int kSteps = 2 * kHeatBands;
    const double width = kHeatPanel.width / (kSteps + 1);
    for (int k = 0; k <= kSteps; ++k)
      add(PathItem{{Rect{kHeatPanel.x + k * width, y + 1.5, 1.02 * width, 4}.ring()},
                   true,
                   filled(heat_colour(static_cast<double>(k - kHeatBands) / kHeatBands)),
                   {"scale", ""}});
    const std::string most = fmt::format("{:.3g}", picture_.largest_um);
    text({kHeatPanel.x, y + 9}, "-" + most, 2.6);
    text({kHeatPanel.centre().x, y + 9}, "0", 2.6, Anchor::middle);
    text({kHeatPanel.right(), y + 9}, "+" + most, 2.6, Anchor::end);
    text({kHeatPanel.x, y + 13}, "pocket too small", 2.6, Anchor::start, kGrey);
    text({kHeatPanel.right(), y + 13}, "too large", 2.6, Anchor::end, kGrey);
    text({kHeatPanel.x, y + 19},
         fmt::format("Walls from above: {:.0f} times as far off.",
                     1000 * kHeatOff / view_.scale / picture_.largest_um),
         2.6, Anchor::start, kGrey);
  }

  const HeatPicture& picture_;
  std::vector<HeatStretch> stretches_;
  double low_z_ = HUGE_VAL, high_z_ = -HUGE_VAL;
  Scene scene_;
  View view_;
};

}  // namespace

std::string heat_svg(const HeatPicture& picture) { return scene_svg(HeatComposer(picture).compose()); }

Result<std::string> heat_png(const HeatPicture& picture, int width_px) {
  return scene_png(HeatComposer(picture).compose(), width_px);
}

}  // namespace lekalo::draw
