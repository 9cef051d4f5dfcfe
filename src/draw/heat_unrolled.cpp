#include "heat_unrolled.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "draw/paper/colour.hpp"

namespace lekalo::draw {
namespace {

using geom::Point;

/// The pocket is too small, as it is to be, too large.
constexpr Colour kHeatSmall{0, 84, 148}, kHeatNone{238, 238, 232}, kHeatLarge{190, 70, 0};

Colour heat_between(Colour a, Colour b, double share) {
  const auto mixed = [&](std::uint8_t x, std::uint8_t y) {
    return static_cast<std::uint8_t>(std::lround(x + share * (y - x)));
  };
  return {mixed(a.red, b.red), mixed(a.green, b.green), mixed(a.blue, b.blue)};
}

TextItem plain_text(Point at, std::string words, double size, Anchor anchor, Colour colour = kInk,
                    bool bold = false) {
  return {at, std::move(words), size, anchor, colour, bold, {"text", ""}};
}

}  // namespace

Colour heat_error_colour(double share) {
  const double banded = std::round(std::clamp(share, -1.0, 1.0) * kHeatBands) / kHeatBands;
  return banded < 0 ? heat_between(kHeatNone, kHeatSmall, -banded)
                    : heat_between(kHeatNone, kHeatLarge, banded);
}

UnrolledWalls::UnrolledWalls(const std::vector<HeatColumn>& columns, double spacing, double height,
                             double tool_diameter)
    : spacing_(spacing), height_(height) {
  const double apart = tool_diameter + 2 * spacing;
  for (const HeatColumn& column : columns) {
    const double way = stretches_.empty() ? 0 : geom::norm(column.at - stretches_.back().columns.back()->at);
    if (stretches_.empty() || way > apart) {
      stretches_.emplace_back().along.push_back(0);
    } else {
      stretches_.back().along.push_back(stretches_.back().length() + way);
    }
    stretches_.back().columns.push_back(&column);
    for (const double z : column.z) low_z_ = std::min(low_z_, z), high_z_ = std::max(high_z_, z);
  }
  // The numbers beside the strips are those of a drawing, and 0 has no sign and no dust.
  const auto rounded = [](double z) { return std::round(z * 1e6) / 1e6 + 0.0; };
  low_z_ = rounded(low_z_ - height / 2), high_z_ = rounded(high_z_ + height / 2);
}

void UnrolledWalls::draw(const Rect& room, double largest_um, std::vector<Item>& items) const {
  double whole = 0;
  const double gap = 3 * spacing_;
  for (const HeatStretch& stretch : stretches_) whole += stretch.length() + spacing_ + gap;
  const double x_scale = room.width / (whole - gap), y_scale = room.height / (high_z_ - low_z_);
  const auto y_of = [&](double z) { return room.y + y_scale * (high_z_ - z); };
  double begin = room.x;
  std::vector<double> begins;
  for (const HeatStretch& stretch : stretches_) {
    begins.push_back(begin);
    for (std::size_t i = 0; i < stretch.columns.size(); ++i) {
      const HeatColumn& column = *stretch.columns[i];
      for (std::size_t k = 0; k < column.z.size(); ++k) {
        const Rect cell{begin + x_scale * stretch.along[i], y_of(column.z[k] + height_ / 2),
                        x_scale * spacing_ * 1.02, y_scale * height_ * 1.02};
        items.push_back(PathItem{{cell.ring()},
                                 true,
                                 filled(heat_error_colour(column.errors_um[k] / largest_um)),
                                 {"place", fmt::format("X {:.2f} Y {:.2f} Z {:.2f}: {:+.2f} um", column.at.x,
                                                       column.at.y, column.z[k], column.errors_um[k])}});
      }
    }
    begin += x_scale * (stretch.length() + spacing_ + gap);
  }
  for (const double z : {high_z_, low_z_})
    items.push_back(plain_text({room.x - 1, y_of(z) + (z == high_z_ ? 2 : 0)}, fmt::format("{:.4g}", z), 2.6,
                               Anchor::end));
  items.push_back(
      plain_text({room.x - 1, (y_of(high_z_) + y_of(low_z_)) / 2 + 1}, "Z", 2.6, Anchor::end, kGrey));
  letters([&](const HeatStretch& stretch, std::size_t i, const std::string& letter) {
    const auto number = static_cast<std::size_t>(&stretch - stretches_.data());
    items.push_back(
        plain_text({begins[number] + x_scale * (stretch.along[i] + spacing_ / 2), room.bottom() + 4}, letter,
                   2.8, Anchor::middle, kGrey, true));
  });
}

void draw_error_scale(const Rect& room, double largest_um, std::vector<Item>& items) {
  constexpr int kSteps = 2 * kHeatBands;
  const double width = room.width / (kSteps + 1);
  for (int k = 0; k <= kSteps; ++k)
    items.push_back(PathItem{{Rect{room.x + k * width, room.y, 1.02 * width, 4}.ring()},
                             true,
                             filled(heat_error_colour(static_cast<double>(k - kHeatBands) / kHeatBands)),
                             {"scale", ""}});
  const double y = room.y + 7.5;
  const std::string most = fmt::format("{:.3g}", largest_um);
  items.push_back(plain_text({room.x, y}, "-" + most, 2.6, Anchor::start));
  items.push_back(plain_text({room.centre().x, y}, "0", 2.6, Anchor::middle));
  items.push_back(plain_text({room.right(), y}, "+" + most, 2.6, Anchor::end));
  items.push_back(plain_text({room.x, y + 4}, "pocket too small", 2.6, Anchor::start, kGrey));
  items.push_back(plain_text({room.right(), y + 4}, "too large", 2.6, Anchor::end, kGrey));
}

}  // namespace lekalo::draw
