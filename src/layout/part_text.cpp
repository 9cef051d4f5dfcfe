#include "lekalo/layout/part_text.hpp"

#include <string_view>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/line_font.hpp"
#include "lekalo/geom/trig.hpp"

namespace lekalo::layout {
namespace {

using geom::Point;

/// A rectangle stands for a letter that the font lacks.
LineLetter missing_letter() {
  constexpr int kWidth = 16, kSide = 3;
  return {kWidth,
          {{{kSide, 0},
            {kWidth - kSide, 0},
            {kWidth - kSide, kLineFontCapital},
            {kSide, kLineFontCapital},
            {kSide, 0}}}};
}

template <class Take>
void each_letter(const PartText& text, const Take& take) {
  for (std::string_view rest = text.text; !rest.empty();) take(line_letter(take_code_point(rest)));
}

/// The length of the line in units of the font.
double length_in_units(const PartText& text) {
  int width = 0;
  each_letter(text, [&](const std::optional<LineLetter>& letter) {
    width += letter ? letter->width : missing_letter().width;
  });
  return width;
}

double left_share(TextAnchor anchor) {
  return anchor == TextAnchor::left ? 0 : anchor == TextAnchor::middle ? 0.5 : 1;
}

/// The map from the units of the font to the part's frame.
class Setting {
 public:
  explicit Setting(const PartText& text)
      : at_(text.at),
        unit_(text.height / kLineFontCapital),
        across_(unit_ * text.width_factor * (text.mirrored ? -1 : 1)) {
    const auto [sine, cosine] = geom::sincos(text.degrees * kDegree);
    along_ = {cosine, sine};
    begin_ = -left_share(text.anchor) * length_in_units(text);
  }

  [[nodiscard]] Point operator()(double x, double y) const {
    const double right = across_ * (begin_ + x), up = unit_ * y;
    return at_ + Point{along_.x * right - along_.y * up, along_.y * right + along_.x * up};
  }

 private:
  Point at_, along_;
  double unit_, across_, begin_ = 0;
};

}  // namespace

bool has_all_letters(const PartText& text) {
  bool all = true;
  each_letter(text, [&](const std::optional<LineLetter>& letter) { all = all && letter.has_value(); });
  return all;
}

std::vector<geom::Ring> text_strokes(const PartText& text) {
  const Setting set(text);
  std::vector<geom::Ring> strokes;
  double begin = 0;
  each_letter(text, [&](const std::optional<LineLetter>& known) {
    const LineLetter letter = known ? *known : missing_letter();
    for (const auto& points : letter.strokes) {
      geom::Ring& stroke = strokes.emplace_back();
      for (const auto& [x, y] : points) stroke.push_back(set(begin + x, y));
    }
    begin += letter.width;
  });
  return strokes;
}

double text_length(const PartText& text) {
  return length_in_units(text) * text.height / kLineFontCapital * text.width_factor;
}

Point text_middle(const PartText& text) {
  return Setting(text)(0.5 * length_in_units(text), 0.5 * kLineFontCapital);
}

}  // namespace lekalo::layout
