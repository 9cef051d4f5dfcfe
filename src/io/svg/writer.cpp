#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "io/drawing/exact_arcs.hpp"
#include "io/drawing/written_contours.hpp"
#include "io/text/decimal.hpp"
#include "lekalo/base/angle.hpp"
#include "lekalo/geom/edge_distance.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/io/svg/svg.hpp"
#include "lekalo/io/text/words.hpp"
#include "path.hpp"
#include "stated_arcs.hpp"

namespace lekalo::io {
namespace {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;

/// The height of an arc's centre over its chord, in radii, above which its radius says well enough where the
/// centre is. At half a turn readers take the square root of what rounding left: 1e-8 of the radius.
constexpr double kClearlyNoHalfTurn = 0x1p-8;
/// A coordinate that rounding leaves this little below 0, mm, does not move the page.
constexpr double kNoMatter = 0x1p-20;
/// Lines are this wide, mm, or this share of the page, so that they are seen when all of it is on a screen.
constexpr double kStrokeMm = 0.2, kStrokeOfPage = 0.0007;
/// A wide arc is halved into half turns, and these once more into arcs that a radius tells.
constexpr int kHalvings = 2;
/// A line shorter than this share of its ends' coordinates is no line to a reader, because it is within the
/// errors of their decimals.
constexpr double kShortLine = 0x1p-48;

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
    // The corner has whole millimetres, so that readers place the page exactly.
    const Point low{std::min(0.0, std::floor(drawing_.box.low.x + kNoMatter)),
                    std::min(0.0, std::floor(drawing_.box.low.y + kNoMatter))};
    const Point high{std::max(low.x + 1, std::ceil(drawing_.box.high.x)),
                     std::max(low.y + 1, std::ceil(drawing_.box.high.y))};
    const double page = std::max(high.x - low.x, high.y - low.y);
    stroke_mm_ = std::max(kStrokeMm, std::round(10 * kStrokeOfPage * page) / 10);
    text_ = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
        "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" version=\"1.1\" width=\"{0}mm\" "
        "height=\"{1}mm\" viewBox=\"{2} {3} {0} {1}\"",
        high.x - low.x, high.y - low.y, low.x, upright(high.y));
    if (low != Point{}) append(" {}=\"{} {}\"", detail::kPageCorner, low.x, low.y);
    text_ += ">\n";
    for (std::size_t i = 0; i < drawing_.contours.size(); ++i) {
      const std::size_t layer = drawing_.contours[i].layer;
      enter(layer);
      write(drawing_.contours[i]);
    }
    for (const WrittenLine& line : drawing_.lines) {
      enter(line.layer);
      append("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>\n", line.from.x, upright(line.from.y),
             line.to.x, upright(line.to.y));
    }
    for (const WrittenText& text : drawing_.texts) {
      enter(text.layer);
      // The font's size is more than the height of its capitals, about 0.72 of it.
      append(
          "<text x=\"{}\" y=\"{}\" font-family=\"sans-serif\" font-size=\"{}\" text-anchor=\"middle\" "
          "fill=\"#{:06x}\" stroke=\"none\">{}</text>\n",
          text.middle.x, upright(text.middle.y - 0.5 * text.height), text.height / 0.72,
          drawing_.colours[text.layer].rgb, xml_text(text.text));
    }
    for (const WrittenSetText& text : drawing_.set_texts) write(text);
    if (open_layer_) text_ += "</g>\n";
    return std::move(text_) + "</svg>\n";
  }

 private:
  /// Opens a group for every layer that follows another.
  void enter(std::size_t layer) {
    if (open_layer_ == layer) return;
    if (open_layer_) text_ += "</g>\n";
    open_layer_ = layer;
    append(
        "<g inkscape:groupmode=\"layer\" inkscape:label=\"{}\" fill=\"none\" stroke=\"#{:06x}\" "
        "stroke-width=\"{}\">\n",
        xml_text(drawing_.layers[layer]), drawing_.colours[layer].rgb, stroke_mm_);
  }

  /// SVG counts y downwards.
  static double upright(double y) { return 0.0 - y; }

  template <class... Values>
  void append(fmt::format_string<Values...> form, Values&&... values) {
    text_ += fmt::format(form, std::forward<Values>(values)...);
  }

  void write(const WrittenContour& written) {
    const geom::Contour& contour = *written.edges;
    const std::string colour = written.colour.empty() ? "" : fmt::format(" stroke=\"{}\"", written.colour);
    const Edge& first = contour.front();
    if (first.kind != EdgeKind::line && first.from == first.to) {
      const double radius = radius_of_circle(first);
      append("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"{}", first.centre.x, upright(first.centre.y), radius,
             colour);
      const Point centre{first.centre.x, upright(first.centre.y)};
      keep_exact_arcs(contour, {std::get<Edge>(circle({centre, 0}, {radius, 0}).shape)}, {1});
      text_ += "/>\n";
      return;
    }
    text_ += "<path" + colour + " d=\"";
    const std::size_t begin = text_.size();
    append("M{} {}", first.from.x, upright(first.from.y));
    std::vector<std::size_t> of_edge;
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Edge& edge = contour[i];
      if (edge.kind != EdgeKind::line) {
        of_edge.push_back(write_arc(edge, kHalvings));
        continue;
      }
      of_edge.push_back(1);
      // Z draws the last line, unless readers would take it for rounding.
      const bool last = i + 1 == contour.size() && !written.is_open;
      if (!last || norm(edge.to - edge.from) <= kShortLine * (norm(edge.from) + norm(edge.to)))
        append("L{} {}", edge.to.x, upright(edge.to.y));
    }
    if (!written.is_open) text_ += 'Z';
    const std::vector<Edge> read = edges_read_from(std::string_view(text_).substr(begin));
    text_ += '"';
    keep_exact_arcs(contour, read, of_edge);
    text_ += "/>\n";
  }

  /// The letters run along their baseline by the element's own axes, of which y goes down.
  void write(const WrittenSetText& set) {
    enter(set.layer);
    const ReadText& text = *set.text;
    const auto [sine, cosine] = geom::sincos(text.degrees * kDegree);
    const double across = text.mirrored ? -text.width_factor : text.width_factor;
    constexpr const char* kAnchors[] = {"start", "middle", "end"};
    const std::string colour = text.layer.colour.empty()
                                   ? fmt::format("#{:06x}", drawing_.colours[set.layer].rgb)
                                   : text.layer.colour;
    append(
        "<text transform=\"matrix({} {} {} {} {} {})\" font-family=\"sans-serif\" font-size=\"{}\" "
        "text-anchor=\"{}\" fill=\"{}\" stroke=\"none\">{}</text>\n",
        across * cosine + 0.0, upright(across * sine), sine, cosine, text.at.x, upright(text.at.y),
        text.height / 0.72, kAnchors[static_cast<int>(text.anchor)], colour, xml_text(set.clean));
  }

  static std::vector<Edge> edges_read_from(std::string_view path) {
    std::vector<Edge> read;
    if (const auto segments = detail::read_svg_path(path))
      for (const detail::PathSegment& segment : *segments)
        if (const auto shape = detail::shape_of(segment)) read.push_back(std::get<Edge>(shape->shape));
    return read;
  }

  /// Adds the exact arcs of a contour as an attribute, in the frame of the file, which has y down. `read` are
  /// the edges that a reader makes of what is written, `of_edge` how many of them each edge has become.
  void keep_exact_arcs(const geom::Contour& contour, const std::vector<Edge>& read,
                       const std::vector<std::size_t>& of_edge) {
    std::size_t expected = 0;
    for (const std::size_t count : of_edge) expected += count;
    // A reader makes more or fewer edges of the text, so it could not say which arc is which.
    if (read.size() != expected) return;
    geom::Contour down;
    for (const Edge& edge : contour) {
      const auto turned = [](Point p) { return Point{p.x, upright(p.y)}; };
      const EdgeKind kind = edge.kind == EdgeKind::line      ? EdgeKind::line
                            : edge.kind == EdgeKind::arc_ccw ? EdgeKind::arc_cw
                                                             : EdgeKind::arc_ccw;
      down.push_back({kind, turned(edge.from), turned(edge.to), turned(edge.centre)});
    }
    const std::vector<ExactArc> arcs = exact_arcs_of(down, read, of_edge);
    if (!arcs.empty()) append(" {}=\"{}\"", detail::kExactArcs, detail::exact_arcs_text(arcs));
  }

  /// Writes an arc and returns the number of its pieces.
  std::size_t write_arc(const Edge& arc, int halvings) {
    const geom::Curve curve = make_curve(arc);
    const Point chord = arc.to - arc.from, middle = 0.5 * (arc.from + arc.to);
    const double half = 0.5 * norm(chord);
    // The height of the centre over the chord says how near the arc is to half a turn. The centre's part
    // along the chord is the difference of the radii.
    const double height = std::abs(cross(chord, arc.centre - middle)) / (2 * half);
    const bool unclear = height < kClearlyNoHalfTurn * curve.radius;
    const bool wide = geom::arc_sweep(arc) > kWidestPiece;
    if (halvings > 0 && (unclear || wide)) {
      // The halves of an arc that is nearly a whole circle are nearly half turns.
      std::size_t pieces = 0;
      for (const Edge& part : halves_of(arc)) pieces += write_arc(part, halvings - 1);
      return pieces;
    }
    const double radius = std::sqrt(half * half + height * height);
    append("A{0} {0} 0 {1} {2} {3} {4}", radius, curve.beyond_half ? 1 : 0,
           arc.kind == EdgeKind::arc_ccw ? 0 : 1, arc.to.x, upright(arc.to.y));
    return 1;
  }

  const WrittenDrawing& drawing_;
  double stroke_mm_ = kStrokeMm;
  std::optional<std::size_t> open_layer_;
  std::string text_;
};

}  // namespace

Result<std::string> svg_drawing(const std::vector<LayeredRegion>& regions, const DrawingExtras& extras) {
  LEKALO_TRY(const auto drawing, written_drawing(regions, extras, same_name));
  for (const std::string& name : drawing.layers) LEKALO_CHECK(check_name(name));
  return SvgWriter(drawing).write();
}

}  // namespace lekalo::io
