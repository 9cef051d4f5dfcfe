#include "placed_inside.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "lekalo/base/line_font.hpp"

namespace lekalo::verify {
namespace {

/// The motion of a piece in doubles.
struct InsideMotion {
  double c, s;
  Place shift;
  bool mirrored;

  explicit InsideMotion(const WrittenPiece& piece)
      : c(std::ldexp(static_cast<double>(piece.turn.c), -52)),
        s(std::ldexp(static_cast<double>(piece.turn.s), -52)),
        shift{std::ldexp(static_cast<double>(piece.at.x), -20),
              std::ldexp(static_cast<double>(piece.at.y), -20)},
        mirrored(piece.mirrored) {}

  [[nodiscard]] Place turned(Place p) const {
    const double x = mirrored ? -p.x : p.x;
    return {c * x - s * p.y, s * x + c * p.y};
  }
  [[nodiscard]] Place operator()(Place p) const { return turned(p) + shift; }
};

/// The layer on which exports write what lies inside a part.
std::string layer_of_export(const std::string& own) {
  constexpr std::array<std::string_view, 7> kTaken{"CUT", "MARK", "LABEL", "SHEET", "DEFECT", "ZONE", "AREA"};
  std::string layer;
  for (const char c : own) {
    const bool is_held = std::string_view("<>/\\\":;?*|,=`").find(c) == std::string_view::npos;
    layer += is_held ? c : '_';
  }
  while (layer.ends_with(' ')) layer.pop_back();
  while (layer.starts_with(' ')) layer.erase(0, 1);
  const bool is_taken = std::find(kTaken.begin(), kTaken.end(), upper_case(layer)) != kTaken.end();
  return layer.empty() || layer.size() > 255 || is_taken ? "INSIDE" : layer;
}

bool is_engraved(const std::string& role) { return role == "mark" || role == "engrave"; }

DrawnLine line_of_mark(const WrittenMark& mark, const InsideMotion& motion) {
  DrawnLine line{layer_of_export(mark.layer), {}, false, mark.colour};
  const std::vector<double>& n = mark.numbers;
  for (std::size_t i = 0; i < n.size();) {
    const Place from = motion({n[i], n[i + 1]}), to = motion({n[i + 2], n[i + 3]});
    if (mark.arcs[line.edges.size()]) {
      line.edges.push_back(
          arc_about(from, to, motion({n[i + 4], n[i + 5]}), (n[i + 6] > 0) != motion.mirrored));
      i += 7;
    } else {
      line.edges.push_back(line_between(from, to));
      i += 4;
    }
  }
  return line;
}

DrawnLetters letters_of(const WrittenText& text, const InsideMotion& motion) {
  const double angle = text.degrees * std::numbers::pi / 180, across = text.height * text.width_factor;
  const Place along{std::cos(angle), std::sin(angle)};
  return {layer_of_export(text.layer),
          text.colour,
          text.text,
          text.anchor,
          motion({text.x, text.y}),
          motion.turned((text.mirrored ? -across : across) * along),
          motion.turned(text.height * left_of(along))};
}

/// The strokes of a text. Letters that the font lacks have none, and exports of strokes draw a rectangle.
std::vector<DrawnLine> strokes_of(const DrawnLetters& letters) {
  std::vector<LineLetter> set;
  int width = 0;
  for (std::string_view rest = letters.text; !rest.empty();) {
    const auto letter = line_letter(take_code_point(rest));
    set.push_back(letter ? *letter : LineLetter{16, {{{3, 0}, {13, 0}, {13, 21}, {3, 21}, {3, 0}}}});
    width += set.back().width;
  }
  double begin = letters.anchor == "left" ? 0 : letters.anchor == "middle" ? -0.5 * width : -width;
  std::vector<DrawnLine> lines;
  for (const LineLetter& letter : set) {
    for (const auto& stroke : letter.strokes) {
      DrawnLine line{letters.layer, {}, false, letters.colour};
      const auto place = [&](const std::pair<int, int>& p) {
        return letters.at + ((begin + p.first) / kLineFontCapital) * letters.right +
               (static_cast<double>(p.second) / kLineFontCapital) * letters.up;
      };
      for (std::size_t i = 0; i + 1 < stroke.size(); ++i)
        if (stroke[i] != stroke[i + 1])
          line.edges.push_back(line_between(place(stroke[i]), place(stroke[i + 1])));
      if (!line.edges.empty()) lines.push_back(std::move(line));
    }
    begin += letter.width;
  }
  return lines;
}

bool has_all_letters(std::string_view text) {
  while (!text.empty())
    if (!line_letter(take_code_point(text))) return false;
  return true;
}

}  // namespace

std::string upper_case(std::string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

std::vector<PlacedInside> placed_inside(const WrittenPart& part, const WrittenPiece& piece) {
  const InsideMotion motion(piece);
  std::vector<PlacedInside> inside;
  for (const WrittenMark& mark : part.marks)
    inside.push_back({is_engraved(mark.role), {line_of_mark(mark, motion)}, {}});
  for (const WrittenText& text : part.texts) {
    DrawnLetters letters = letters_of(text, motion);
    std::vector<DrawnLine> strokes = strokes_of(letters);
    inside.push_back(
        {is_engraved(text.role) && has_all_letters(text.text), std::move(strokes), {std::move(letters)}});
  }
  return inside;
}

void move_by(double by, PlacedInside& inside) {
  const Place shift{by, 0};
  for (DrawnLine& line : inside.lines)
    for (Stroke& edge : line.edges)
      edge.from = edge.from + shift, edge.to = edge.to + shift, edge.centre = edge.centre + shift;
  for (DrawnLetters& letters : inside.letters) letters.at = letters.at + shift;
}

}  // namespace lekalo::verify
