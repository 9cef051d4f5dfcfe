#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/point.hpp"
#include "lekalo/geom/polygon.hpp"
#include "pixels.hpp"

namespace lekalo::draw {

/// A drawing as a list of primitives in painting order: millimetres of paper, origin top left, y down. Built
/// once; SVG and PNG are two ways to write it.

/// How outlines are filled and drawn; an absent fill is alpha 0, an absent line is width 0.
struct Paint {
  Colour fill;
  double fill_alpha = 0;
  Colour stroke;
  double width = 0;
  double dash = 0;     ///< length of dashes and of the gaps between them; 0: solid
  bool round = false;  ///< ends and corners of the line
};
[[nodiscard]] inline Paint with_fill(Paint paint, Colour colour, double alpha = 1) {
  paint.fill = colour, paint.fill_alpha = alpha;
  return paint;
}
[[nodiscard]] inline Paint filled(Colour colour, double alpha = 1) { return with_fill({}, colour, alpha); }
[[nodiscard]] inline Paint stroked(Colour colour, double width, double dash = 0) {
  Paint paint;
  paint.stroke = colour, paint.width = width, paint.dash = dash;
  return paint;
}
[[nodiscard]] inline Paint stroked_round(Colour colour, double width) {
  Paint paint = stroked(colour, width);
  paint.round = true;
  return paint;
}

/// Says what a primitive shows, for people who look into the file and for tests: becomes class and title in
/// SVG.
struct Meaning {
  std::string kind, title;
};

struct PathItem {
  std::vector<geom::Ring> lines;
  bool closed = false;
  Paint paint;
  Meaning meaning;
};

struct DotItem {
  geom::Point centre;
  double radius = 1;
  Paint paint;
  Meaning meaning;
};

enum class Anchor { start, middle, end };

struct TextItem {
  geom::Point at;  ///< on the baseline
  std::string text;
  double size = 3;
  Anchor anchor = Anchor::start;
  Colour colour;
  bool bold = false;
  Meaning meaning;
};

/// A picture of pixels, stretched over its place.
struct ImageItem {
  geom::Point at;  ///< its top left corner
  double width = 0, height = 0;
  Pixels pixels;
  Meaning meaning;
};

/// Everything up to the matching ClipEnd is drawn inside these closed lines only.
struct ClipBegin {
  std::vector<geom::Ring> lines;
};
struct ClipEnd {};

using Item = std::variant<PathItem, DotItem, TextItem, ImageItem, ClipBegin, ClipEnd>;

struct Scene {
  double width = 0, height = 0;
  std::string title, description;
  std::vector<Item> items;
};

[[nodiscard]] std::string scene_svg(const Scene& scene);
/// PNG bytes, `width_px` wide (100 to 20000, else ErrorCode::usage). ErrorCode::environment when the drawing
/// library fails.
[[nodiscard]] Result<std::string> scene_png(const Scene& scene, int width_px);
/// PDF bytes, a page for the scene and each of `more`, which have its size; text as text, no date.
/// ErrorCode::environment when the drawing library fails.
[[nodiscard]] Result<std::string> scene_pdf(const Scene& scene, const std::vector<Scene>& more = {});

}  // namespace lekalo::draw
