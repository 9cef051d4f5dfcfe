#include "heat_layers.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "draw/paper/colour.hpp"
#include "draw/paper/printed_number.hpp"
#include "heat_unrolled.hpp"
#include "lekalo/io/text/words.hpp"
#include "region_rings.hpp"

namespace lekalo::draw {
namespace {

using geom::Point;
using geom::Ring;

constexpr double kLayerText = 2.8, kLayerSmall = 2.4;
constexpr double kLayerTitle = 7.6, kLayerFoot = 9;
/// Images have at least so many pixels across, so that voxels keep sharp borders in any viewer.
constexpr std::size_t kLayerPixels = 480;
/// The longest displacement is drawn at most so long, mm of paper.
constexpr double kLayerOff = 5;

void layer_text(std::vector<Item>& items, Point at, const std::string& words, double size,
                Anchor anchor = Anchor::start, Colour colour = kInk, bool bold = false) {
  items.push_back(TextItem{at, words, size, anchor, colour, bold, {"text", ""}});
}

/// Warm is bright, cold is dark.
Colour warmth_colour(double share) {
  const double step = std::clamp(share, 0.0, 1.0) * (kColourSteps - 1);
  return scale_colour(kColourSteps - 1 - static_cast<int>(std::lround(step)));
}

Pixels pixels_of(const HeatScene& scene, const HeatLayer& layer) {
  const auto [nx, ny] = scene.count;
  const std::size_t each = std::max<std::size_t>(1, (kLayerPixels + nx - 1) / nx);
  Pixels pixels{static_cast<int>(nx * each), static_cast<int>(ny * each), {}};
  pixels.colours.reserve(nx * ny * each * each);
  for (std::size_t row = 0; row < ny * each; ++row)
    for (std::size_t column = 0; column < nx * each; ++column) {
      const double value = layer.values[(ny - 1 - row / each) * nx + column / each];
      pixels.colours.push_back(
          std::isnan(value) ? kPaper : warmth_colour((value - layer.least) / (layer.greatest - layer.least)));
    }
  return pixels;
}

std::vector<Ring> rings_on_paper(const std::vector<geom::Region>& regions, const View& view,
                                 const Rect& room) {
  std::vector<Ring> rings;
  for (const Ring& ring : region_rings(regions, 0.02 / view.scale, 5 / view.scale))
    rings.push_back(on_paper(ring, view, room));
  return rings;
}

Rect map_room(const Rect& room) {
  return {room.x, room.y + kLayerTitle, room.width, room.height - kLayerTitle - kLayerFoot};
}

Ring box_ring(const geom::Box& box) {
  return {box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}};
}

/// Long sides get corners between, so that they may bend.
Ring divided(const Ring& ring, double longest) {
  Ring made;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i], b = ring[(i + 1) % ring.size()];
    const double parts = std::max(1.0, std::ceil(geom::norm(b - a) / longest));
    for (double k = 0; k < parts; ++k) made.push_back(a + (k / parts) * (b - a));
  }
  return made;
}

/// Displacement between the corners of places, linear along both axes, um.
Point moved_at(const HeatScene& scene, Point p) {
  const std::size_t nx = scene.count[0], ny = scene.count[1];
  const auto along = [](double at, double low, double high, std::size_t count) {
    const double off = (at - low) / (high - low) * static_cast<double>(count);
    return std::clamp(off, 0.0, static_cast<double>(count));
  };
  const double x = along(p.x, scene.stock.low.x, scene.stock.high.x, nx),
               y = along(p.y, scene.stock.low.y, scene.stock.high.y, ny);
  const auto i = std::min(static_cast<std::size_t>(x), nx - 1),
             j = std::min(static_cast<std::size_t>(y), ny - 1);
  const double s = x - static_cast<double>(i), t = y - static_cast<double>(j);
  const auto corner = [&](std::size_t a, std::size_t b) {
    return scene.moved_um[(j + b) * (nx + 1) + i + a];
  };
  return (1 - t) * ((1 - s) * corner(0, 0) + s * corner(1, 0)) +
         t * ((1 - s) * corner(0, 1) + s * corner(1, 1));
}

void draw_layer_scale(const HeatLayer& layer, const Rect& room, std::vector<Item>& items) {
  const double y = room.bottom() - kLayerFoot + 2;
  for (int k = 0; k < kColourSteps; ++k) {
    const double x = room.x + room.width * k / kColourSteps;
    items.push_back(PathItem{{Rect{x, y, room.right() - x, 3}.ring()},
                             true,
                             filled(warmth_colour(static_cast<double>(k) / (kColourSteps - 1))),
                             {"scale", ""}});
  }
  const double base = y + 3.6 + kLayerSmall;
  const auto number = [](double value) { return fmt::format("{:.4g}", value); };
  layer_text(items, {room.x, base}, number(layer.least), kLayerSmall);
  layer_text(items, {room.centre().x, base}, number((layer.least + layer.greatest) / 2), kLayerSmall,
             Anchor::middle);
  layer_text(items, {room.right(), base}, number(layer.greatest) + " " + layer.unit, kLayerSmall,
             Anchor::end);
}

/// A bold line, and a grey one below.
void draw_titles(const std::string& title, const std::string& words, const Rect& room,
                 std::vector<Item>& items) {
  layer_text(items, {room.x, room.y + 2.6}, title, io::fitting_size(title, kLayerText, room.width),
             Anchor::start, kInk, true);
  layer_text(items, {room.x, room.y + 6}, words, io::fitting_size(words, kLayerSmall, room.width),
             Anchor::start, kGrey);
}

}  // namespace

void draw_heat_layer(const HeatScene& scene, const HeatLayer& layer, const Rect& room,
                     std::vector<Item>& items) {
  draw_titles(layer.title, layer.most, room, items);
  const Rect map = map_room(room);
  const View view = fitted(scene.stock, map);
  const Point corner = view({scene.stock.low.x, scene.stock.high.y}),
              other = view({scene.stock.high.x, scene.stock.low.y});
  items.push_back(ImageItem{
      corner, other.x - corner.x, other.y - corner.y, pixels_of(scene, layer), {"layer", layer.title}});
  if (!scene.outline.empty())
    items.push_back(PathItem{
        rings_on_paper(scene.outline, view, map), true, stroked(kBlankLine, 0.25), {"stock", "the stock"}});
  items.push_back(PathItem{
      rings_on_paper(scene.pockets, view, map), true, stroked(kPaper, 0.25), {"pocket", "the pocket"}});
  if (layer.greatest > layer.least && !layer.most.empty())
    items.push_back(DotItem{view(layer.most_at), 1.3, stroked(kPaper, 0.4), {"most", layer.most}});
  draw_layer_scale(layer, room, items);
}

void draw_heat_displacement(const HeatScene& scene, const Rect& room, std::vector<Item>& items) {
  const Rect map = map_room(room).grown(-kLayerOff);
  const View view = fitted(scene.stock, map);
  // A displacement of 1 um is so many mm of paper; the number of times is round.
  const double most = std::max(scene.moved_most_um, 1e-6);
  const double times = round_length(kLayerOff / (most / 1000 * view.scale)),
               paper = times / 1000 * view.scale;
  draw_titles(fmt::format("displacement at the end, {:.0f} times", times),
              fmt::format("up to {:.2f} um across; along Z {:+.2f} to {:+.2f} um", scene.moved_most_um,
                          scene.lifted_um[0], scene.lifted_um[1]),
              room, items);
  std::vector<Ring> stock{box_ring(scene.stock)}, pockets;
  if (!scene.outline.empty()) stock = region_rings(scene.outline, 0.02 / view.scale, 5 / view.scale);
  pockets = region_rings(scene.pockets, 0.02 / view.scale, 5 / view.scale);
  const auto drawn = [&](const std::vector<Ring>& rings, bool moved) {
    std::vector<Ring> lines;
    for (const Ring& ring : rings) {
      Ring line;
      for (const Point p : divided(ring, 2 / view.scale)) {
        const Point at = view(p), off = moved ? moved_at(scene, p) : Point{};
        line.push_back({at.x + paper * off.x, at.y - paper * off.y});
      }
      lines.push_back(std::move(line));
    }
    return lines;
  };
  std::vector<Ring> solid = drawn(stock, true), holes = drawn(pockets, true);
  Paint body = filled(kBlankFill);
  body.stroke = kInk, body.width = 0.3;
  items.push_back(PathItem{std::move(solid), true, body, {"moved", "the stock at the end of the program"}});
  Paint hole = filled(kPaper);
  hole.stroke = kInk, hole.width = 0.3;
  items.push_back(PathItem{std::move(holes), true, hole, {"moved", "the pocket at the end of the program"}});
  for (const std::vector<Ring>* rings : {&stock, &pockets})
    items.push_back(PathItem{drawn(*rings, false), true, stroked(kStartLine, 0.2, 1), {"cold", "cold"}});
  const double bar_um = round_length(0.35 * room.width / paper), length = bar_um * paper,
               y = room.bottom() - 4.5;
  items.push_back(
      PathItem{{{{room.x, y - 1.2}, {room.x, y}, {room.x + length, y}, {room.x + length, y - 1.2}}},
               false,
               stroked_round(kInk, 0.35),
               {"scale-bar", ""}});
  layer_text(items, {room.x + length + 2, y}, fmt::format("{:g} um of displacement", bar_um), kLayerSmall);
  layer_text(items, {room.right(), y}, "dashed: cold", kLayerSmall, Anchor::end, kGrey);
}

void draw_heat_strips(const HeatScene& scene, const Rect& room, std::vector<Item>& items) {
  constexpr double kScale = 52, kZ = 10;
  const double width = room.width - kScale - 6 - kZ, x = room.x + kZ,
               high = room.height / static_cast<double>(scene.strips.size());
  double top = room.y;
  for (const auto& [words, walls] : scene.strips) {
    layer_text(items, {x, top + 2.6}, words, io::fitting_size(words, kLayerText, width), Anchor::start, kInk,
               true);
    UnrolledWalls(walls, scene.spacing, scene.height, scene.tool_diameter)
        .draw({x, top + 4, width, high - 10}, scene.largest_um, items);
    top += high;
  }
  const double left = room.right() - kScale;
  layer_text(items, {left, room.y + 2.6}, "error of the wall when cold, um", kLayerText);
  draw_error_scale({left, room.y + 4, kScale, 0}, scene.largest_um, items);
  for (const auto& [words, line] :
       {std::pair{"walls unrolled, from above downwards;", 0}, {"at the middles of all intervals", 1}})
    layer_text(items, {left, room.y + 21 + 3.4 * line}, words, kLayerSmall, Anchor::start, kGrey);
}

}  // namespace lekalo::draw
