#include "hpgl_writer.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "lekalo/geom/trig.hpp"
#include "lekalo/io/layout/layout_export.hpp"
#include "lekalo/io/text/words.hpp"
#include "lekalo/layout/part_text.hpp"

namespace lekalo::io::detail {
namespace {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;

constexpr double kMostUnits = (1 << 23) - 1;

struct Units {
  std::int64_t x = 0, y = 0;
  friend bool operator==(const Units&, const Units&) = default;
};

class HpglWriter {
 public:
  HpglWriter(const std::vector<std::string>& only, double chord_tolerance,
             const std::optional<nc::KnifeOptions>& knife)
      : only_(only), chord_tolerance_(chord_tolerance) {
    if (!knife) return;
    knife_options_ = *knife;
    knife_options_.step_mm = kPlotterUnit;
    knife_options_.chord_tolerance_mm = chord_tolerance;
    knife_.emplace(knife_options_);
  }

  Result<PlotText> write(const SheetShapes& sheet) {
    text_ = "IN;PA;";
    if (pen("SHEET")) region(sheet.material);
    if (pen("DEFECT"))
      for (const geom::Region& defect : sheet.defects) region(defect);
    if (pen("ZONE"))
      for (const geom::Region& zone : sheet.zones) region(zone);
    // Marks and labels while the parts still hang together.
    if (pen("AREA"))
      for (const PlacedShape& part : sheet.parts)
        for (const geom::Region& area : part.areas) region(area);
    if (pen("MARK"))
      for (const PlacedShape& part : sheet.parts) inside(part);
    if (pen("LABEL"))
      for (const PlacedShape& part : sheet.parts) label(part);
    if (pen("CUT"))
      for (const PlacedShape& part : sheet.parts) cut(part);
    if (!trouble_.empty())
      return failure(ErrorCode::bad_input, fmt::format("sheet {}: {}", sheet.name, trouble_));
    if (too_far_)
      return failure(ErrorCode::bad_input,
                     fmt::format("sheet {}: a coordinate lies beyond {:.0f} mm, further than plotters count",
                                 sheet.name, kMostUnits * kPlotterUnit));
    return PlotText{std::move(text_) + "\nPU;SP0;\n", tip_off_};
  }

 private:
  bool pen(const char* layer) {
    if (!only_.empty() && std::find(only_.begin(), only_.end(), layer) == only_.end()) return false;
    const auto* const found =
        std::find_if(std::begin(kExportLayers), std::end(kExportLayers),
                     [&](const char* known) { return std::string_view(known) == layer; });
    text_ += fmt::format("\nSP{};", found - std::begin(kExportLayers) + 1);
    return true;
  }

  Units units(Point p) {
    const Point scaled = (1 / kPlotterUnit) * p;
    if (!(std::abs(scaled.x) <= kMostUnits && std::abs(scaled.y) <= kMostUnits)) {
      too_far_ = true;
      return {};
    }
    return {std::llround(scaled.x), std::llround(scaled.y)};
  }

  /// Draws what lies inside a part; texts as strokes.
  void inside(const PlacedShape& part) {
    if (!part.grain.empty()) line({part.grain.front(), part.grain.back()});
    for (const PlacedMark& mark : part.marks) line(points_of(mark.edges));
    for (const layout::PartText& text : part.texts)
      for (const geom::Ring& stroke : layout::text_strokes(text)) line(stroke);
  }

  /// Follows the contours of a part with the pen, or so that the knife does.
  void cut(const PlacedShape& part) {
    if (!knife_) return region(part.region);
    for (const geom::Contour& hole : part.region.holes) knife_cut(part, hole);
    knife_cut(part, part.region.outer);
  }

  void knife_cut(const PlacedShape& part, const geom::Contour& contour) {
    const nc::KnifeCut made = knife_->cut(contour);
    tip_off_ = std::max(tip_off_, made.off_mm);
    // A sixteenth is left to whoever measures the written plot.
    const double most = 15.0 / 16 * knife_options_.tolerance_mm;
    if (!(made.off_mm <= most) && trouble_.empty())
      trouble_ = fmt::format(
          "placement {}: the tip of the knife would leave the outline by up to {:.4f} mm, which a tolerance "
          "of "
          "{:.4f} mm allows and {:g} mm do not; allow more, or ask for finer chords",
          part.placement->id, made.off_mm, made.off_mm * 16 / 15 + 5e-5, knife_options_.tolerance_mm);
    for (const std::vector<Point>& stroke : made.strokes) line(stroke);
  }

  /// Holes before the outline.
  void region(const geom::Region& region) {
    for (const geom::Contour& hole : region.holes) line(points_of(hole));
    line(points_of(region.outer));
  }

  std::vector<Point> points_of(const geom::Contour& contour) const {
    std::vector<Point> points{contour.front().from};
    for (const Edge& edge : contour) {
      if (edge.kind != EdgeKind::line) add_arc(edge, points);
      points.push_back(edge.to);
    }
    return points;
  }

  /// Points between the ends. A chord over an angle a lies within r a^2 / 8 of its arc.
  void add_arc(const Edge& arc, std::vector<Point>& points) const {
    const double radius = geom::arc_radius(arc), sweep = geom::arc_sweep(arc);
    const auto pieces =
        static_cast<int>(std::ceil(sweep / std::min(0.5, std::sqrt(8 * chord_tolerance_ / radius))));
    const Point out = arc.from - arc.centre;
    const double begin = geom::direction_angle(out.x, out.y),
                 turn = arc.kind == EdgeKind::arc_ccw ? sweep : -sweep;
    for (int k = 1; k < pieces; ++k) {
      const auto [sine, cosine] = geom::sincos(begin + turn * k / pieces);
      points.push_back(arc.centre + radius * Point{cosine, sine});
    }
  }

  void line(const std::vector<Point>& points) {
    Units at = units(points.front());
    text_ += fmt::format("\nPU{},{};PD", at.x, at.y);
    bool first = true;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const Units next = units(points[i]);
      if (next == at) continue;
      text_ += fmt::format("{}{},{}", first ? "" : ",", next.x, next.y);
      first = false;
      at = next;
    }
    text_ += ';';
  }

  void label(const PlacedShape& part) {
    if (part.label_height == 0) return;
    std::string text;
    for (const char c : clean_text(part.label)) {
      const auto byte = static_cast<unsigned char>(c);
      if ((byte & 0xc0U) == 0x80U) continue;  // the rest of a letter beyond ASCII
      text += byte >= 0x20 && byte < 0x7f ? c : '?';
    }
    const Units at = units(part.label_at);
    // Sizes in centimetres; the label is centred on the pen and ends with the character ETX.
    text_ += fmt::format("\nPU{},{};SI{:.3f},{:.3f};LO5;LB{}\x03;", at.x, at.y, 0.07 * part.label_height,
                         0.1 * part.label_height, text);
  }

  const std::vector<std::string>& only_;
  double chord_tolerance_;
  nc::KnifeOptions knife_options_;
  std::optional<nc::Knife> knife_;
  double tip_off_ = 0;
  std::string trouble_;
  bool too_far_ = false;
  std::string text_;
};

}  // namespace

Result<PlotText> hpgl_text(const SheetShapes& sheet, const std::vector<std::string>& only,
                           double chord_tolerance, const std::optional<nc::KnifeOptions>& knife) {
  return HpglWriter(only, chord_tolerance, knife).write(sheet);
}

}  // namespace lekalo::io::detail
