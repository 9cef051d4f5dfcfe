#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "contour_number.hpp"
#include "lekalo/geom/edge_distance.hpp"
#include "picture_text.hpp"
#include "written_contours.hpp"

namespace lekalo::io {
namespace {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;

/// Height of an arc's centre over its chord, in radii, below which the arc is half a turn; and above which
/// its radius says well enough where the centre is.
constexpr double kHalfTurn = 0x1p-46, kClearlyNoHalfTurn = 0x1p-8;
/// A radius this much too small is enlarged to half the chord by every reader, beyond the doubt that its own
/// rounding leaves.
constexpr double kTooSmall = 1 - 0x1p-40;
/// What rounding leaves below 0 does not move the page; mm.
constexpr double kNoMatter = 0x1p-20;
constexpr double kStrokeMm = 0.2;

bool same_name(const std::string& a, const std::string& b) { return a == b; }

Result<void> check_name(const std::string& name) {
  const auto letters = letters_of(name);
  const bool fine =
      letters && !letters->empty() && std::all_of(letters->begin(), letters->end(), [](std::uint32_t c) {
        return c >= 0x20 && !(c >= 0x7f && c < 0xa0) && c != 0xfffe && c != 0xffff;
      });
  if (fine) return {};
  return failure(
      ErrorCode::usage,
      fmt::format("{} cannot be the name of a layer in an SVG drawing: it is empty, not UTF-8 or holds a "
                  "control character",
                  excerpt(name)));
}

class SvgWriter {
 public:
  explicit SvgWriter(const WrittenDrawing& drawing) : drawing_(drawing) {}

  std::string write() {
    // Whole millimetres, so that readers place the page exactly.
    const Point low{std::min(0.0, std::floor(drawing_.box.low.x + kNoMatter)),
                    std::min(0.0, std::floor(drawing_.box.low.y + kNoMatter))};
    const Point high{std::max(low.x + 1, std::ceil(drawing_.box.high.x)),
                     std::max(low.y + 1, std::ceil(drawing_.box.high.y))};
    text_ = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
        "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" version=\"1.1\" width=\"{0}mm\" "
        "height=\"{1}mm\" viewBox=\"{2} {3} {0} {1}\">\n",
        high.x - low.x, high.y - low.y, low.x, upright(high.y));
    for (std::size_t i = 0; i < drawing_.contours.size(); ++i) {
      const std::size_t layer = drawing_.contours[i].layer;
      if (i == 0 || drawing_.contours[i - 1].layer != layer) {
        if (i > 0) text_ += "</g>\n";
        text_ += fmt::format(
            "<g inkscape:groupmode=\"layer\" inkscape:label=\"{}\" fill=\"none\" stroke=\"#000000\" "
            "stroke-width=\"{}\">\n",
            detail::xml_text(drawing_.layers[layer]), kStrokeMm);
      }
      write(*drawing_.contours[i].edges);
    }
    return std::move(text_) + "</g>\n</svg>\n";
  }

 private:
  /// SVG counts y downwards.
  static double upright(double y) { return 0.0 - y; }

  template <class... Values>
  void append(fmt::format_string<Values...> form, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), form, std::forward<Values>(values)...);
  }

  void write(const geom::Contour& contour) {
    const Edge& first = contour.front();
    if (first.kind != EdgeKind::line && first.from == first.to) {
      append("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"/>\n", first.centre.x, upright(first.centre.y),
             radius_of_circle(first));
      return;
    }
    append("<path d=\"M{} {}", first.from.x, upright(first.from.y));
    for (std::size_t i = 0; i < contour.size(); ++i) {
      if (contour[i].kind == EdgeKind::line) {
        // The last line is what Z draws.
        if (i + 1 < contour.size()) append("L{} {}", contour[i].to.x, upright(contour[i].to.y));
      } else {
        write_arc(contour[i], true);
      }
    }
    text_ += "Z\"/>\n";
  }

  void write_arc(const Edge& arc, bool may_halve) {
    const geom::Curve curve = make_curve(arc);
    const Point chord = arc.to - arc.from, middle = 0.5 * (arc.from + arc.to);
    const double half = 0.5 * norm(chord);
    // Of the centre over the chord: what lies along the chord is the difference of the radii.
    const double height = std::abs(cross(chord, arc.centre - middle)) / (2 * half);
    const bool half_turn = height <= kHalfTurn * curve.radius;
    const bool unclear = !half_turn && height < kClearlyNoHalfTurn * curve.radius;
    const bool wide = std::abs(bulge_of(arc)) > kLargestBulge;
    if (may_halve && (unclear || wide)) {
      for (const Edge& part : halves_of(arc)) write_arc(part, false);
      return;
    }
    const double radius = half_turn ? kTooSmall * half : std::sqrt(half * half + height * height);
    append("A{0} {0} 0 {1} {2} {3} {4}", radius, curve.beyond_half ? 1 : 0,
           arc.kind == EdgeKind::arc_ccw ? 0 : 1, arc.to.x, upright(arc.to.y));
  }

  const WrittenDrawing& drawing_;
  std::string text_;
};

}  // namespace

Result<std::string> svg_drawing(const std::vector<LayeredRegion>& regions) {
  const auto drawing = written_drawing(regions, same_name);
  if (!drawing) return tl::unexpected(drawing.error());
  for (const std::string& name : drawing->layers)
    if (auto fine = check_name(name); !fine) return tl::unexpected(fine.error());
  return SvgWriter(*drawing).write();
}

}  // namespace lekalo::io
