#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/geom/polygon.hpp"
#include "lekalo/io/drawing/written_drawing.hpp"

namespace lekalo::io {

/// The contours of a drawing in the order in which both writers write them, with their layers.

struct WrittenContour {
  const geom::Contour* edges = nullptr;
  std::size_t layer = 0;  ///< into WrittenDrawing::layers
  bool is_open = false;   ///< it ends elsewhere than it begins
  std::string colour{};   ///< "#0000ff"; empty: that of the layer
};
struct WrittenLine {
  geom::Point from, to;
  std::size_t layer = 0;
};
struct WrittenText {
  std::string text;  ///< clean UTF-8
  geom::Point middle;
  double height = 1;
  std::size_t layer = 0;
};
struct WrittenSetText {
  const ReadText* text = nullptr;
  std::string clean;  ///< its letters as clean UTF-8
  std::size_t layer = 0;
};
struct WrittenDrawing {
  std::vector<WrittenContour> contours;
  std::vector<WrittenLine> lines;
  std::vector<WrittenText> texts;
  std::vector<WrittenSetText> set_texts;
  std::vector<std::string> layers;   ///< in the order of their first contours, lines, texts
  std::vector<LayerColour> colours;  ///< by layer
  geom::Box box;
};

/// `same_name` tells whether two names are one layer. Fails where hole_layers do not match the holes.
[[nodiscard]] Result<WrittenDrawing> written_drawing(const std::vector<LayeredRegion>& regions,
                                                     const DrawingExtras& extras,
                                                     bool (*same_name)(const std::string&,
                                                                       const std::string&));

/// The letters of a UTF-8 text, or nothing where it is none (overlong forms and surrogates are none).
[[nodiscard]] std::optional<std::vector<std::uint32_t>> letters_of(const std::string& text);

/// Tangent of a quarter of the sweep, positive counter-clockwise: the double nearest to that of the circle
/// through the arc's ends whose centre lies level with the arc's; if it has a neighbour that the reader makes
/// the very centre of, that one. \pre an arc, not a full circle
[[nodiscard]] double bulge_of(const geom::Edge& arc);

/// The radius of a full circle; if it has a neighbour from which the reader finds the circle's very first
/// point, that one. \pre a full circle
[[nodiscard]] double radius_of_circle(const geom::Edge& circle);

/// The two halves of an arc. \pre an arc, not a full circle
[[nodiscard]] std::vector<geom::Edge> halves_of(const geom::Edge& arc);

}  // namespace lekalo::io
