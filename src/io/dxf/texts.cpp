#include "texts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "entities.hpp"
#include "lekalo/base/angle.hpp"
#include "lekalo/base/limits.hpp"
#include "lekalo/base/line_font.hpp"
#include "lekalo/geom/trig.hpp"
#include "text.hpp"

namespace lekalo::io {
namespace {

using geom::Point;

/// How far letters reach below the baseline, and how far lines of an MTEXT are apart, in heights of capitals.
constexpr double kBelowBaseline = 1.0 / 3, kLinePitch = 5.0 / 3;
/// A drawing without end may still not make lines without end.
constexpr std::size_t kMostLinesOfText = 1000, kLongestLineOfText = 1000;

/// The signs that a TEXT and an MTEXT write as two percent signs and a letter or three figures.
std::string without_percent_codes(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    if (!text.starts_with("%%") || text.size() < 3) {
      out += text.front();
      text.remove_prefix(1);
      continue;
    }
    const char code = text[2];
    if (code >= '0' && code <= '9' && text.size() >= 5) {
      const int number = 100 * (code - '0') + 10 * (text[3] - '0') + (text[4] - '0');
      if (number >= 0x20 && number < 0x7f) out += static_cast<char>(number);
      text.remove_prefix(5);
      continue;
    }
    if (code == 'd' || code == 'D') out += "\u00b0";
    if (code == 'p' || code == 'P') out += "\u00b1";
    if (code == 'c' || code == 'C') out += "\u00d8";
    if (code == '%') out += '%';
    text.remove_prefix(3);
  }
  return out;
}

/// The lines that an MTEXT means: paragraphs, without fonts, colours and sizes; stacked fractions stand on
/// one line.
std::vector<std::string> paragraphs_of(std::string_view text) {
  std::vector<std::string> lines(1);
  while (!text.empty()) {
    const char c = text.front();
    text.remove_prefix(1);
    if (c == '{' || c == '}') continue;
    if (c == '^' && !text.empty()) {
      // A caret and a letter are a control character, of which ^J and ^M end lines.
      if (text.front() == 'J')
        lines.emplace_back();
      else if (text.front() != 'M')
        lines.back() += ' ';
      text.remove_prefix(1);
      continue;
    }
    if (c != '\\' || text.empty()) {
      lines.back() += c;
      continue;
    }
    const char code = text.front();
    text.remove_prefix(1);
    if (code == 'P' || code == 'N' || code == 'X') {
      lines.emplace_back();
    } else if (code == '~') {
      lines.back() += ' ';
    } else if (code == '\\' || code == '{' || code == '}') {
      lines.back() += code;
    } else if (code == 'S') {
      const std::string_view stacked = text.substr(0, std::min(text.find(';'), text.size()));
      for (const char letter : stacked) lines.back() += letter == '^' || letter == '#' ? '/' : letter;
      text.remove_prefix(std::min(stacked.size() + 1, text.size()));
    } else if (std::string_view("ACcfFHpQTW").find(code) != std::string_view::npos) {
      text.remove_prefix(std::min(text.find(';'), text.size() - (text.empty() ? 0 : 1)) +
                         (text.empty() ? 0 : 1));
    }
    // The codes that are left switch strokes under, over and through letters on and off.
  }
  return lines;
}

double width_of(std::string_view text) {
  constexpr double kUsualWidth = 16;
  double width = 0;
  while (!text.empty()) {
    const auto letter = line_letter(take_code_point(text));
    width += letter ? letter->width : kUsualWidth;
  }
  return width / kLineFontCapital;
}

/// Breaks a paragraph at blanks into lines that are at most so wide, where its words are.
void break_into_lines(const std::string& paragraph, double width, std::vector<std::string>& lines) {
  std::string line;
  for (std::size_t begin = 0; begin <= paragraph.size();) {
    const std::size_t end = std::min(paragraph.find(' ', begin), paragraph.size());
    const std::string word = paragraph.substr(begin, end - begin);
    if (!line.empty() && width > 0 && width_of(line + " " + word) > width) {
      lines.push_back(line);
      line = word;
    } else {
      line += (begin == 0 ? "" : " ") + word;
    }
    begin = end + 1;
  }
  lines.push_back(line);
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// Cuts a text between letters where layouts hold no longer ones.
void shorten(std::string& text) {
  if (text.size() <= kLongestLineOfText) return;
  std::size_t end = kLongestLineOfText;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80) --end;
  text.resize(end);
}

/// A text as its lines share it.
std::optional<ReadText> shape_of(const DxfText& text) {
  ReadText read;
  const double along = norm(text.along), area = cross(text.along, text.up);
  if (!(along > 0) || area == 0) return std::nullopt;
  // Slanted letters stand upright, so that their height is what is left across the baseline.
  read.height = std::abs(area) / along;
  read.width_factor = text.width_factor * along / read.height;
  read.mirrored = area < 0;
  const Point right = read.mirrored ? -1.0 * text.along : text.along;
  read.degrees = geom::direction_angle(right.x, right.y) * kDegreesPerRadian;
  read.anchor = text.across == 0   ? ReadText::Anchor::left
                : text.across == 1 ? ReadText::Anchor::middle
                                   : ReadText::Anchor::right;
  read.line = text.line;
  const bool fits = read.height >= limits::kLowestText && read.height <= limits::kHighestText &&
                    read.width_factor >= limits::kNarrowestText && read.width_factor <= limits::kWidestText;
  return fits ? std::optional(read) : std::nullopt;
}

}  // namespace

void place_text(DxfText& text, const Affine& map) {
  const auto turned = [&](Point p) {
    return Point{map.xx * p.x + map.xy * p.y, map.yx * p.x + map.yy * p.y};
  };
  text.at = image(map, text.at);
  text.along = turned(text.along), text.up = turned(text.up);
}

std::vector<ReadText> lines_of_text(const DxfText& text, std::string_view code_page) {
  const std::optional<ReadText> shape = shape_of(text);
  if (!shape) return {};
  const std::string decoded = text_of_name(text.text, code_page);
  std::vector<std::string> lines;
  if (text.has_markup)
    for (const std::string& paragraph : paragraphs_of(decoded))
      break_into_lines(without_percent_codes(paragraph), text.column, lines);
  else
    lines.push_back(without_percent_codes(decoded));
  if (lines.size() > kMostLinesOfText) lines.resize(kMostLinesOfText);
  // The first baseline of an MTEXT is so far above its point; all lines together are so high.
  const double pitch = kLinePitch * text.line_spacing;
  const double high = 1 + pitch * static_cast<double>(lines.size() - 1);
  double baseline = !text.has_markup   ? 0
                    : text.upward == 0 ? -1
                    : text.upward == 1 ? 0.5 * high - 1
                                       : high - 1;
  std::vector<ReadText> read;
  for (const std::string& line : lines) {
    ReadText one = *shape;
    one.text = trimmed(line);
    shorten(one.text);
    one.at = text.at.at + baseline * text.up;
    baseline -= pitch;
    if (!one.text.empty()) read.push_back(std::move(one));
  }
  return read;
}

/// Adds a text whose baseline has this direction, or where that is nothing this angle.
Result<void> DxfEntities::add_text(DxfBlock& into, DxfText text, double degrees, Point direction,
                                   double height) {
  const auto world = plane(0);
  if (!world) {
    count_unread(into, "tilted");
    return {};
  }
  const double length = norm(direction);
  const Point unit = length > 0 ? (1 / length) * direction : direction_of_degrees(degrees).unit;
  // A text may have been written backwards or upside down already.
  const double right = text.along.x < 0 ? -1 : 1, up = text.up.y < 0 ? -1 : 1;
  text.along = (right * height) * unit;
  text.up = (up * height) * Point{-unit.y, unit.x};
  text.pen = pen();
  text.line = common_.line;
  place_text(text, *world);
  ++into.cost, ++cost_;
  if (cost_ > kMostCurves)
    return refuse_entity("is one too many: drawings have no more curves and texts; keep what is to be cut");
  into.texts.push_back(std::move(text));
  return {};
}

Result<void> DxfEntities::read_text(DxfBlock& into) {
  static constexpr Wanted kWanted[] = {{10, true, true},   {20, true, true},  {30, true, false},
                                       {11, true, false},  {21, true, false}, {40, true, true},
                                       {41, false, false}, {50, false, false}};
  Numbers numbers;
  DxfText text;
  int across = 0, upward = 0, generation = 0, hidden = 0;
  while (at_.next() && at_.code() != 0) {
    LEKALO_TRY(const auto taken, take_common());
    if (taken) continue;
    const auto whole = [&](int& to) -> Result<void> {
      LEKALO_TRY(const unsigned value, whole_number());
      to = static_cast<int>(std::min(value, 100U));
      return {};
    };
    if (at_.code() == 1) text.text = at_.value();
    if (at_.code() == 71) LEKALO_CHECK(whole(generation));
    if (at_.code() == 72) LEKALO_CHECK(whole(across));
    // An attribute has its flags where a text has nothing, and its upright anchor one group further.
    if (at_.code() == 70 && common_.type == "ATTRIB") LEKALO_CHECK(whole(hidden));
    if (at_.code() == (common_.type == "ATTRIB" ? 74 : 73)) LEKALO_CHECK(whole(upward));
    const auto* wanted = std::find_if(std::begin(kWanted), std::end(kWanted),
                                      [this](const Wanted& w) { return w.code == at_.code(); });
    if (wanted == std::end(kWanted)) continue;
    LEKALO_TRY(const auto value, number(wanted->is_length));
    numbers.set(wanted->code, value);
    if (wanted->code == 30) note_height();
  }
  if (!at_.ok()) return {};
  if (!numbers.has(10) || !numbers.has(20)) return refuse_entity("has no place; the file is damaged");
  if ((hidden & 1) != 0) common_.invisible = true;
  if (is_out_of_sight(into)) return {};
  const double height = numbers.get(40, {0, 0}).value;
  if (!(height > 0)) {
    count_unread(into, "of no height");
    return {};
  }
  const bool has_second = numbers.has(11) && numbers.has(21);
  const BoundedPoint first = numbers.point(10, 20), second = numbers.point(11, 21);
  Point direction{};
  constexpr int kAligned = 3, kMiddle = 4, kFit = 5;
  if ((across == kAligned || across == kFit) && has_second) {
    // The letters lie between the two points, on the line from one to the other.
    text.at = first;
    direction = second.at - first.at;
    across = upward = 0;
  } else {
    text.at = (across != 0 || upward != 0) && has_second ? second : first;
    if (across == kMiddle) across = 1, upward = 2;
    if (across > 2) across = 0;
  }
  const double degrees = numbers.get(50).value;
  const double drop = upward == 1 ? kBelowBaseline : upward == 2 ? -0.5 : upward == 3 ? -1 : 0;
  const Point unit =
      norm(direction) > 0 ? (1 / norm(direction)) * direction : direction_of_degrees(degrees).unit;
  constexpr int kBackwards = 2, kUpsideDown = 4;
  text.along = {(generation & kBackwards) != 0 ? -1.0 : 1.0, 0};
  text.up = {0, (generation & kUpsideDown) != 0 ? -1.0 : 1.0};
  text.at.at = text.at.at + (drop * height * text.up.y) * Point{-unit.y, unit.x};
  text.across = across;
  text.width_factor = std::max(numbers.get(41, {1, 0}).value, 0.0);
  if (text.width_factor == 0) text.width_factor = 1;
  return add_text(into, std::move(text), degrees, direction, height);
}

Result<void> DxfEntities::read_mtext(DxfBlock& into) {
  DxfText text;
  text.has_markup = true;
  double numbers[80] = {};
  double error = 0;
  bool has_place = false, is_embedded = false, turned_last = false;
  numbers[44] = 1;
  numbers[71] = 1;
  while (at_.next() && at_.code() != 0) {
    // An embedded object says of columns by the same codes.
    if (at_.code() == 101) is_embedded = true;
    LEKALO_TRY(const auto taken, take_common());
    if (taken || is_embedded) continue;
    const int code = at_.code();
    if (code == 1 || code == 3) text.text += at_.value();
    // Behind group 75 columns are described, with angles that are none.
    if (code == 75) is_embedded = true;
    const bool is_length = code == 10 || code == 20 || code == 40 || code == 41;
    if (!is_length && code != 11 && code != 21 && code != 44 && code != 50 && code != 71 && code != 30)
      continue;
    LEKALO_TRY(const auto value, number(is_length));
    numbers[code] = value.value;
    if (code == 10 || code == 20) has_place = true, error = std::max(error, value.error);
    if (code == 50) turned_last = true;
    if (code == 11) turned_last = false;
    if (code == 30) note_height();
  }
  if (!at_.ok()) return {};
  if (!has_place) return refuse_entity("has no place; the file is damaged");
  if (is_out_of_sight(into)) return {};
  if (!(numbers[40] > 0)) {
    count_unread(into, "of no height");
    return {};
  }
  const int attached = std::clamp(static_cast<int>(numbers[71]), 1, 9) - 1;
  text.across = attached % 3, text.upward = attached / 3;
  text.at = {{numbers[10], numbers[20]}, error};
  text.column = std::max(numbers[41], 0.0) / numbers[40];
  text.line_spacing = numbers[44] > 0 ? numbers[44] : 1;
  text.along = {1, 0}, text.up = {0, 1};
  const Point direction = turned_last ? Point{} : Point{numbers[11], numbers[21]};
  return add_text(into, std::move(text), numbers[50], direction, numbers[40]);
}

}  // namespace lekalo::io
