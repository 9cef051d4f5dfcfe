#include "drawing_check.hpp"

#include <algorithm>

#include "verify/shape/shape_distance.hpp"
#include "verify/shape/stretch.hpp"

namespace lekalo::verify {
namespace {

constexpr std::size_t kMostDrawingWork = 10'000'000;

std::string text_of(const Vec& p) { return fmt::format("({}, {})", p.x.low, p.y.low); }

class DrawingCheck {
 public:
  DrawingCheck(const WrittenDrawing& written, const Shape& used, double reach)
      : written_(written), used_(used), reach_(reach), outline_(all_of(written, used, reach)) {}

  DrawingVerdict run(const ReadDrawing& drawing) {
    std::set<std::string> taken;
    for (const std::string& layer : written_.layers) taken.insert(key_of(layer));
    std::vector<CurvePiece> shown;
    std::vector<std::string> layers;
    for (const DrawnCurve& curve : drawing.curves) {
      if (taken.empty() ? curve.hidden : taken.count(key_of(curve.layer)) == 0) continue;
      check_curve(curve);
      if (!verdict_.fault.empty()) return verdict_;
      for (const CurvePiece& piece : curve.pieces) shown.push_back(piece), layers.push_back(curve.layer);
    }
    CurvePieces all(std::move(shown));
    check_outline(all, layers);
    for (const std::vector<Side>* const sides : {&written_.marks, &written_.set_aside_curves})
      if (verdict_.fault.empty()) check_loose(all, *sides);
    return verdict_;
  }

 private:
  /// Everything that the result has of the drawing.
  static CurvePieces all_of(const WrittenDrawing& written, const Shape& used, double reach) {
    std::vector<CurvePiece> pieces = pieces_of(used);
    const double more = std::max(0.0, written.loose_error - reach);
    for (const std::vector<Side>* const sides : {&written.marks, &written.set_aside_curves})
      for (const Side& side : *sides) pieces.push_back({side, 0, more});
    return CurvePieces(std::move(pieces));
  }

  /// Marks are no invention either.
  void check_loose(CurvePieces& shown, const std::vector<Side>& sides) {
    const double reach = std::max(reach_, written_.loose_error);
    for (const Side& side : sides) {
      const auto far = shown.first_not_within({{side, 0, 0}}, reach, work_, kMostDrawingWork);
      if (!far) continue;
      for (const Vec& p : points_of(side))
        if (shown.surely_away(p, reach)) {
          verdict_.fault = fmt::format(
              "a mark, or what was set aside, about {} runs along no curve that counts", text_of(p));
          return;
        }
      leave_open(fmt::format("a mark, or what was set aside, about {} is not shown to run along a curve",
                             text_of(*far)));
    }
  }

  void leave_open(std::string sentence) {
    if (verdict_.open.empty()) verdict_.open = std::move(sentence);
  }

  void check_curve(const DrawnCurve& curve) {
    const auto far = outline_.first_not_within(curve.pieces, reach_, work_, kMostDrawingWork);
    if (!far || was_set_aside(curve)) return;
    for (const CurvePiece& piece : curve.pieces)
      for (const Vec& p : points_of(piece.side))
        if (outline_.surely_away(p, reach_ + piece.off)) {
          verdict_.fault =
              fmt::format("a curve of layer {} about {} is neither of its outlines nor a mark nor set aside",
                          excerpt(curve.layer), text_of(p));
          return;
        }
    leave_open(fmt::format("a curve of layer {} about {} is not shown to be of its outlines",
                           excerpt(curve.layer), text_of(*far)));
  }

  [[nodiscard]] bool was_set_aside(const DrawnCurve& curve) const {
    return std::any_of(written_.set_aside.begin(), written_.set_aside.end(), [&](const Vec& place) {
      return std::all_of(curve.pieces.begin(), curve.pieces.end(), [&](const CurvePiece& piece) {
        return farthest(piece.side, place) <= written_.join * 1.000001 + reach_;
      });
    });
  }

  void check_outline(CurvePieces& shown, const std::vector<std::string>& layers) {
    for (const Side& side : used_.sides) {
      const auto far = shown.first_not_within({{side, 0, 0}}, reach_, work_, kMostDrawingWork);
      // A line that joins an arc to its end has no layer of its own.
      if (side.written) {
        std::set<std::string>& of_edge = verdict_.layers.emplace_back();
        shown.each_near(points_of(side).back(), reach_, [&](std::size_t k) { of_edge.insert(layers[k]); });
      }
      if (!far) continue;
      for (const Vec& p : points_of(side))
        if (shown.surely_away(p, reach_)) {
          verdict_.fault = fmt::format("its outline about {} runs along no curve that counts", text_of(p));
          return;
        }
      leave_open(fmt::format("its outline about {} is not shown to run along a curve", text_of(*far)));
    }
  }

  const WrittenDrawing& written_;
  const Shape& used_;
  double reach_;
  CurvePieces outline_;
  std::size_t work_ = 0;
  DrawingVerdict verdict_;
};

}  // namespace

WrittenDrawing read_written_drawing(Json value, const std::string& path, std::string& complaint) {
  WrittenDrawing written;
  Fields fields(value, path, complaint);
  fields.each("layers", [&](Json item, const std::string& at) {
    if (!item.is_string()) return fields.complain(at + " is not a text");
    written.layers.push_back(json_text(item));
  });
  written.join = enclosed(fields.number("join")).high;
  fields.each("set_aside", [&](Json item, const std::string& at) {
    std::vector<Span> numbers;
    if (item.is_array()) {
      JsonItems items(item);
      while (const auto number = items.next()) numbers.push_back(enclosed(fields.number_of(*number, at)));
    }
    if (numbers.size() != 2) return fields.complain(at + " is not two numbers");
    written.set_aside.push_back({numbers[0], numbers[1]});
  });
  const auto loose = [&](const char* key) {
    const Json edges = fields.get(key);
    return edges.text.empty() ? std::vector<Side>() : read_loose_edges(edges, path + "." + key, complaint);
  };
  written.marks = loose("marks"), written.set_aside_curves = loose("set_aside_curves");
  if (!fields.get("loose_error").text.empty())
    written.loose_error = enclosed(fields.number("loose_error")).high;
  if (written.join < 0 || written.loose_error < 0)
    fields.complain(path + ": a distance below 0 is none, in join or loose_error");
  return written;
}

DrawingVerdict check_drawing(const WrittenDrawing& written, const ReadDrawing& drawing, const Shape& used,
                             double reach) {
  return DrawingCheck(written, used, reach).run(drawing);
}

}  // namespace lekalo::verify
