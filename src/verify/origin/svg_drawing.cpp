#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "drawing.hpp"
#include "verify/number/interval.hpp"
#include "verify/read/xml.hpp"

namespace lekalo::verify {
namespace {

constexpr int kDeepestGroup = 32;

Span enclosed(const Fraction& value) {
  const double near = cut_to_double(value);
  return outwards(near, near);
}

/// Reads numbers and words of an attribute one by one.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}
  void skip() {
    while (at_ < text_.size() && std::string_view(" \t\r\n,").find(text_[at_]) != std::string_view::npos)
      ++at_;
  }
  [[nodiscard]] bool done() {
    skip();
    return at_ == text_.size();
  }
  [[nodiscard]] char peek() {
    skip();
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  /// Goes on behind what peek() showed.
  void take() { ++at_; }
  std::string_view word() {
    skip();
    const std::size_t begin = at_;
    while (at_ < text_.size() &&
           (std::isalpha(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '%'))
      ++at_;
    return text_.substr(begin, at_ - begin);
  }
  std::optional<Decimal> number() {
    skip();
    std::size_t end = at_;
    const auto digits = [&] {
      const std::size_t begin = end;
      while (end < text_.size() && text_[end] >= '0' && text_[end] <= '9') ++end;
      return end > begin;
    };
    if (end < text_.size() && (text_[end] == '+' || text_[end] == '-')) ++end;
    const bool whole = digits();
    bool any = whole;
    if (end < text_.size() && text_[end] == '.') ++end, any = digits() || any;
    if (!any) return std::nullopt;
    if (end + 1 < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
      const std::size_t mantissa = end++;
      if (text_[end] == '+' || text_[end] == '-') ++end;
      if (!digits()) end = mantissa;
    }
    const std::string_view number = text_.substr(at_, end - at_);
    at_ = end;
    return parse_decimal(number);
  }
  /// A flag of an arc is one digit, after which the next number may follow at once.
  std::optional<bool> flag() {
    const char c = peek();
    if (c != '0' && c != '1') return std::nullopt;
    ++at_;
    return c == '1';
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

struct Around {
  Affine map;
  std::string layer, group;
  bool hidden_layer = false, hidden = false;
};

class SvgReader {
 public:
  SvgReader(const Document& document, Fraction mm_per_unit, double off)
      : document_(document), fallback_(std::move(mm_per_unit)), maker_(drawing_, off) {}

  Result<ReadDrawing> read() {
    LEKALO_TRY(const XmlElement root, parse_xml(document_));
    index(root);
    if (root.name != "svg") complain("its root is no svg");
    Around around;
    if (complaint_.empty()) read_page(root, around);
    if (!root.get("transform").empty() || shapes(root.get("style"))) not_read("pages that are moved");
    if (document_.bytes.find("<?xml-stylesheet") != std::string_view::npos)
      not_read("style sheets of other files");
    hide(root, around);
    for (const XmlElement& child : root.children) draw(child, around, 0);
    if (!complaint_.empty())
      return failure(ErrorCode::bad_input, fmt::format("{}: {}", document_.name, complaint_));
    return std::move(drawing_);
  }

 private:
  void complain(std::string sentence) {
    if (complaint_.empty()) complaint_ = std::move(sentence);
  }
  void not_read(std::string what) { drawing_.not_read.insert(std::move(what)); }

  void index(const XmlElement& element) {
    layers_are_marked_ = layers_are_marked_ || element.get("inkscape:groupmode") == "layer";
    if (element.name == "style" && hides_or_shapes(element.text)) not_read("style sheets that hide or move");
    if (const std::size_t colon = element.name.find(':'); colon != std::string::npos)
      if (const auto local = element.name.substr(colon + 1);
          draws(local) || local == "style" || local == "svg")
        not_read("elements of SVG behind a prefix");
    if (const std::string_view id = element.get("id"); !id.empty()) by_id_.emplace(std::string(id), &element);
    for (const XmlElement& child : element.children) index(child);
  }

  /// Returns mm in a unit of length; nothing for pixels and numbers alone.
  static std::optional<Fraction> mm_of(std::string_view unit) {
    if (unit == "mm") return Fraction(1);
    if (unit == "cm") return Fraction(10);
    if (unit == "in") return Fraction(127) / Fraction(5);
    if (unit == "pt") return Fraction(127) / Fraction(360);
    if (unit == "pc") return Fraction(127) / Fraction(30);
    if (unit == "Q") return Fraction(1) / Fraction(4);
    return std::nullopt;
  }

  void read_page(const XmlElement& root, Around& around) {
    std::array<std::optional<Fraction>, 2> size;
    bool said = false, pixels = false;
    for (std::size_t k = 0; k < 2; ++k) {
      Scanner scanner(root.get(k == 0 ? "width" : "height"));
      const auto number = scanner.number();
      if (!number) continue;
      const std::string_view unit = scanner.word();
      if (unit == "%") continue;
      const auto mm = mm_of(unit);
      said = said || mm.has_value(), pixels = pixels || !mm;
      if (!mm && !unit.empty() && unit != "px") return complain("its page has a unit that is not known here");
      size[k] = to_fraction(*number) * mm.value_or(fallback_);
    }
    drawing_.says_unit = said;
    if (said && pixels) not_read("pages with two kinds of units");
    if (root.get("viewBox").empty()) {
      if (!size[1]) not_read("pages without a height");
      // Without a view box a unit of the drawing is a pixel of 1/96 inch where the page says its size.
      const Fraction scale = said ? Fraction(127) / Fraction(480) : fallback_;
      return set_page(around, scale, scale, 0, size[1].value_or(Fraction(0)));
    }
    std::array<Fraction, 4> view;
    Scanner scanner(root.get("viewBox"));
    for (Fraction& each : view) {
      const auto number = scanner.number();
      if (!number) return complain("its viewBox is not four numbers");
      each = to_fraction(*number);
    }
    if (!(view[2] > 0 && view[3] > 0)) return complain("its viewBox is empty");
    if (!size[0] && !size[1]) size = {view[2] * fallback_, view[3] * fallback_};
    if (!size[0]) size[0] = *size[1] * view[2] / view[3];
    if (!size[1]) size[1] = *size[0] * view[3] / view[2];
    place_view(root.get("preserveAspectRatio"), view, *size[0], *size[1], around);
  }

  void place_view(std::string_view how, const std::array<Fraction, 4>& view, const Fraction& width,
                  const Fraction& height, Around& around) {
    const bool slice = how.find("slice") != std::string_view::npos;
    Fraction x = width / view[2], y = height / view[3];
    if (how != "none") x = y = slice ? std::max(x, y) : std::min(x, y);
    const auto placed_by = [&](const char* low, const char* high) {
      return how.find(low) != std::string_view::npos    ? Fraction(0)
             : how.find(high) != std::string_view::npos ? Fraction(1)
                                                        : Fraction(1) / Fraction(2);
    };
    const Fraction left = (width - view[2] * x) * placed_by("xMin", "xMax"),
                   top = (height - view[3] * y) * placed_by("YMin", "YMax");
    set_page(around, x, y, left - view[0] * x, height - top + view[1] * y);
  }

  static void set_page(Around& around, const Fraction& sx, const Fraction& sy, const Fraction& x,
                       const Fraction& y) {
    around.map = {{enclosed(sx), just(0)}, {just(0), -enclosed(sy)}, {enclosed(x), enclosed(y)}};
  }

  /// Calls f(name in capitals, value) for all that a style says.
  template <class F>
  static void each_said(std::string_view style, const F& f) {
    while (!style.empty()) {
      const std::string_view one = style.substr(0, style.find(';'));
      const std::size_t colon = one.find(':');
      if (colon != std::string_view::npos) f(key_of(stripped(one.substr(0, colon))), one.substr(colon + 1));
      style.remove_prefix(std::min(one.size() + 1, style.size()));
    }
  }
  static bool says_shape(std::string_view style) {
    constexpr std::string_view kShapes[] = {
        "TRANSFORM", "TRANSLATE", "ROTATE", "SCALE", "OFFSET", "OFFSET-PATH", "ZOOM", "ALL",   "D",
        "X",         "Y",         "CX",     "CY",    "R",      "RX",          "RY",   "WIDTH", "HEIGHT"};
    bool found = false;
    each_said(style, [&](std::string_view name, std::string_view) {
      // Browsers know some names with their maker's prefix, too.
      if (name.starts_with('-')) name.remove_prefix(std::min(name.find('-', 1), name.size() - 1) + 1);
      found = found || std::find(std::begin(kShapes), std::end(kShapes), name) != std::end(kShapes);
    });
    return found;
  }
  /// Says whether a style moves or shapes anything, or may behind a comment or an escape.
  static bool shapes(std::string_view style) {
    return style.find("\\") != std::string_view::npos || style.find("/*") != std::string_view::npos ||
           says_shape(style);
  }
  static std::string without_comments(std::string_view sheet) {
    std::string rules;
    while (true) {
      const std::size_t comment = sheet.find("/*");
      rules += sheet.substr(0, comment);
      const std::size_t end = comment == std::string_view::npos ? comment : sheet.find("*/", comment + 2);
      if (end == std::string_view::npos) break;
      sheet.remove_prefix(end + 2);
    }
    return rules;
  }
  static bool hides_or_shapes(std::string_view sheet) {
    std::string rules = key_of(without_comments(sheet));
    for (char& c : rules)
      if (c == '{' || c == '}') c = ';';
    const auto names = [&](std::string_view word) { return rules.find(word) != std::string::npos; };
    return names("DISPLAY") || names("VISIBILITY") || names("\\") || names("@IMPORT") || says_shape(rules);
  }
  /// Returns the value of a property, in capitals: the last of its style, else the attribute.
  static std::string property(const XmlElement& element, std::string_view name) {
    std::string found;
    each_said(element.get("style"), [&](const std::string& said, std::string_view value) {
      if (said == key_of(name)) found = key_of(stripped(value.substr(0, value.find('!'))));
    });
    return found.empty() ? key_of(element.get(name)) : found;
  }
  static void hide(const XmlElement& element, Around& around) {
    if (property(element, "display") == "NONE") around.hidden_layer = true;
    if (const auto visible = property(element, "visibility"); !visible.empty())
      around.hidden = visible == "HIDDEN" || visible == "COLLAPSE";
  }
  static std::string_view stripped(std::string_view text) {
    while (!text.empty() && std::string_view(" \t\r\n").find(text.front()) != std::string_view::npos)
      text.remove_prefix(1);
    while (!text.empty() && std::string_view(" \t\r\n").find(text.back()) != std::string_view::npos)
      text.remove_suffix(1);
    return text;
  }

  static bool is_group(std::string_view name) { return name == "g" || name == "a"; }
  static bool draws(std::string_view name) {
    return is_group(name) || name == "path" || name == "line" || name == "polyline" || name == "polygon" ||
           name == "rect" || name == "circle" || name == "ellipse" || name == "use";
  }

  void draw(const XmlElement& element, Around around, int depth) {
    if (!complaint_.empty()) return;
    if (depth > kDeepestGroup) return not_read("groups nested too deep");
    if (drawing_.too_large()) return complain("it has too many curves");
    const std::string& name = element.name;
    if (name == "svg" || name == "switch") return not_read(name + " within the page");
    if (!draws(name)) return;
    if (shapes(element.get("style"))) return not_read("styles that move or shape");
    around.map = around.map * read_transform(element.get("transform"));
    hide(element, around);
    if (is_group(name)) {
      const std::string label(element.get("inkscape:label").empty() ? element.get("id")
                                                                    : element.get("inkscape:label"));
      const bool marked = element.get("inkscape:groupmode") == "layer";
      if (layers_are_marked_ ? marked : around.layer.empty()) around.layer = label;
      for (const XmlElement& child : element.children) draw(child, around, depth + 1);
      return;
    }
    if (name == "use") return draw_use(element, around, depth);
    draw_shape(element, around.map);
    maker_.done(around.layer, around.hidden || around.hidden_layer);
  }

  void draw_use(const XmlElement& element, Around around, int depth) {
    std::string_view target = element.get("href").empty() ? element.get("xlink:href") : element.get("href");
    const auto found = target.empty() ? by_id_.end() : by_id_.find(std::string(target.substr(1)));
    if (found == by_id_.end()) return complain("a use of nothing");
    if (found->second->name == "svg" || found->second->name == "symbol")
      return not_read("uses of " + found->second->name);
    around.map = around.map *
                 Affine{{just(1), just(0)}, {just(0), just(1)}, {length(element, "x"), length(element, "y")}};
    draw(*found->second, around, depth + 1);
  }

  Affine read_transform(std::string_view text) {
    Affine map;
    Scanner scanner(text);
    while (!scanner.done()) {
      const std::string word(scanner.word());
      std::vector<Decimal> n;
      if (scanner.peek() != '(') return complain("a transform that is not understood"), map;
      scanner.take();
      while (scanner.peek() != ')')
        if (const auto number = scanner.number())
          n.push_back(*number);
        else
          return complain("a transform that is not understood"), map;
      scanner.take();
      const auto at = [&](std::size_t k) { return verify::enclosed(n[k]); };
      Affine one;
      if (word == "matrix" && n.size() == 6) {
        one = {{at(0), at(1)}, {at(2), at(3)}, {at(4), at(5)}};
      } else if (word == "translate" && (n.size() == 1 || n.size() == 2)) {
        one.shift = {at(0), n.size() == 2 ? at(1) : just(0)};
      } else if (word == "scale" && (n.size() == 1 || n.size() == 2)) {
        one.x = {at(0), just(0)}, one.y = {just(0), at(n.size() - 1)};
      } else if (word == "rotate" && (n.size() == 1 || n.size() == 3)) {
        const Turn turn = turn_by_degrees(to_fraction(n[0]));
        const Span c{turn.cosine.low_double(), turn.cosine.high_double()},
            s{turn.sine.low_double(), turn.sine.high_double()};
        one.x = {c, s}, one.y = {-s, c};
        if (n.size() == 3) one.shift = Vec{at(1), at(2)} - one.direction({at(1), at(2)});
      } else if ((word == "skewX" || word == "skewY") && n.size() == 1) {
        const Turn turn = turn_by_degrees(to_fraction(n[0]));
        const Span c{turn.cosine.low_double(), turn.cosine.high_double()},
            s{turn.sine.low_double(), turn.sine.high_double()};
        const Span slope = s * c / squared(c);
        (word == "skewX" ? one.y.x : one.x.y) = slope;
      } else {
        return complain("a transform that is not understood"), map;
      }
      map = map * one;
    }
    return map;
  }

  Span length(const XmlElement& element, std::string_view key) { return enclosed(fraction(element, key)); }
  /// Returns a length in user units, which are pixels of 1/96 inch where it has a unit of its own.
  Fraction fraction(const XmlElement& element, std::string_view key) {
    const std::string_view text = element.get(key);
    if (text.empty()) return 0;
    Scanner scanner(text);
    const auto number = scanner.number();
    const std::string_view unit = scanner.word();
    if (!number) return complain(fmt::format("{} is no length", key)), Fraction();
    if (unit.empty() || unit == "px") return to_fraction(*number);
    const auto mm = mm_of(unit);
    if (!mm) not_read("lengths in shares of the page or of letters");
    return to_fraction(*number) * mm.value_or(1) * 480 / 127;
  }

  void draw_shape(const XmlElement& element, const Affine& map) {
    const std::string& name = element.name;
    if (name == "path") return draw_path(element.get("d"), map);
    if (name == "line")
      return maker_.line(map, {length(element, "x1"), length(element, "y1")},
                         {length(element, "x2"), length(element, "y2")});
    if (name == "polyline" || name == "polygon")
      return draw_points(element.get("points"), map, name == "polygon");
    if (name == "rect") return draw_rectangle(element, map);
    const Vec centre{length(element, "cx"), length(element, "cy")};
    const Fraction rx = fraction(element, name == "circle" ? "r" : "rx"),
                   ry = fraction(element, name == "circle" ? "r" : "ry");
    if (rx <= 0 || ry <= 0) return;
    if (rx != ry)
      return maker_.ellipse(map, centre, {enclosed(rx), just(0)}, {just(0), enclosed(ry)}, 0, 360);
    const Vec right{just(1), just(0)};
    maker_.arc(map, {centre, enclosed(rx), right, right, Sweep::full, Fraction(0), Fraction(360)});
  }

  void draw_points(std::string_view text, const Affine& map, bool closed) {
    Scanner scanner(text);
    std::vector<Vec> points;
    while (!scanner.done()) {
      const auto x = scanner.number(), y = scanner.number();
      if (!x || !y) return complain("points that are no numbers");
      points.push_back({verify::enclosed(*x), verify::enclosed(*y)});
    }
    for (std::size_t k = 0; k + 1 < points.size(); ++k) maker_.line(map, points[k], points[k + 1]);
    if (closed && points.size() > 2) maker_.line(map, points.back(), points.front());
  }

  void draw_rectangle(const XmlElement& element, const Affine& map) {
    const Fraction width = fraction(element, "width"), height = fraction(element, "height");
    if (width <= 0 || height <= 0) return;
    // A radius that is not given is the other one, and none is above half a side.
    const auto radius = [&](const char* key, const char* otherwise, const Fraction& side) {
      const Fraction given = fraction(element, element.get(key).empty() ? otherwise : key);
      return std::min<Fraction>(given, side / 2);
    };
    const Fraction rx = radius("rx", "ry", width), ry = radius("ry", "rx", height);
    const Fraction left = fraction(element, "x"), low = fraction(element, "y"), right = left + width,
                   top = low + height;
    const bool round = rx > 0 && ry > 0;
    const Fraction in_x = round ? rx : Fraction(0), in_y = round ? ry : Fraction(0);
    const auto at = [](const Fraction& x, const Fraction& y) { return Vec{enclosed(x), enclosed(y)}; };
    maker_.line(map, at(left + in_x, low), at(right - in_x, low));
    maker_.line(map, at(right, low + in_y), at(right, top - in_y));
    maker_.line(map, at(right - in_x, top), at(left + in_x, top));
    maker_.line(map, at(left, top - in_y), at(left, low + in_y));
    if (!round) return;
    const std::array<Vec, 5> ways{{{just(1), just(0)},
                                   {just(0), just(1)},
                                   {just(-1), just(0)},
                                   {just(0), just(-1)},
                                   {just(1), just(0)}}};
    for (std::size_t k = 0; k < 4; ++k) {
      const Fraction x = k == 0 || k == 3 ? Fraction(right - rx) : Fraction(left + rx);
      const Fraction y = k < 2 ? Fraction(top - ry) : Fraction(low + ry);
      const Vec centre = at(x, y);
      maker_.arc(map * Affine{{enclosed(rx), just(0)}, {just(0), enclosed(ry)}, centre},
                 {{just(0), just(0)}, just(1), ways[k], ways[k + 1], Sweep::less, {}, {}});
    }
  }

  void draw_path(std::string_view text, const Affine& map) {
    Scanner scanner(text);
    // The exact places keep relative steps from losing digits.
    std::array<Fraction, 2> at, begin, control;
    char command = '\0', before = '\0';
    const auto vec = [](const std::array<Fraction, 2>& p) { return Vec{enclosed(p[0]), enclosed(p[1])}; };
    bool broken = false;
    const auto number = [&]() -> Fraction {
      const auto value = scanner.number();
      if (!value) return broken = true, Fraction();
      return to_fraction(*value);
    };
    while (!scanner.done() && !broken) {
      const char next = scanner.peek();
      if (std::isalpha(static_cast<unsigned char>(next)) != 0)
        scanner.take(), command = next;
      else if (command == 'M')
        command = 'L';
      else if (command == 'm')
        command = 'l';
      const bool relative = command >= 'a';
      const char upper = relative ? static_cast<char>(command - 'a' + 'A') : command;
      const auto point = [&]() -> std::array<Fraction, 2> {
        const Fraction x = number(), y = number();
        if (!relative) return {x, y};
        return {at[0] + x, at[1] + y};
      };
      const auto mirrored = [&](bool smooth) -> std::array<Fraction, 2> {
        if (!smooth) return at;
        return {2 * at[0] - control[0], 2 * at[1] - control[1]};
      };
      std::array<Fraction, 2> to = at;
      if (upper == 'Z') {
        maker_.line(map, vec(at), vec(begin));
        to = begin;
      } else if (upper == 'M') {
        to = begin = point();
      } else if (upper == 'L') {
        to = point(), maker_.line(map, vec(at), vec(to));
      } else if (upper == 'H' || upper == 'V') {
        const std::size_t axis = upper == 'H' ? 0 : 1;
        const Fraction value = number();
        to[axis] = relative ? Fraction(at[axis] + value) : value;
        maker_.line(map, vec(at), vec(to));
      } else if (upper == 'C' || upper == 'S') {
        const auto first = upper == 'C' ? point() : mirrored(before == 'C' || before == 'S');
        const auto second = point();
        to = point();
        maker_.cubic(map, {vec(at), vec(first), vec(second), vec(to)});
        control = second;
      } else if (upper == 'Q' || upper == 'T') {
        const auto pole = upper == 'Q' ? point() : mirrored(before == 'Q' || before == 'T');
        to = point();
        const auto blend = [&](const std::array<Fraction, 2>& end) -> std::array<Fraction, 2> {
          return {(end[0] + 2 * pole[0]) / 3, (end[1] + 2 * pole[1]) / 3};
        };
        maker_.cubic(map, {vec(at), vec(blend(at)), vec(blend(to)), vec(to)});
        control = pole;
      } else if (upper == 'A') {
        const Fraction rx = number(), ry = number(), turned = number();
        const auto large = scanner.flag(), sweep = scanner.flag();
        to = point();
        // Without the first flag there is no second one either.
        if (!sweep) return complain("an arc of a path without its flags");
        draw_arc(map, at, to, {abs(rx), abs(ry), turned, *large, *sweep});
      } else {
        return complain("a path that is not understood");
      }
      before = upper, at = to;
    }
    if (broken) complain("a path that breaks off");
  }

  /// The numbers of an arc of a path beside its ends.
  struct PathArc {
    Fraction rx, ry, turned_deg;
    bool large = false, sweep = false;
  };
  void draw_arc(const Affine& map, const std::array<Fraction, 2>& at, const std::array<Fraction, 2>& to,
                const PathArc& said) {
    const Vec from{enclosed(at[0]), enclosed(at[1])}, end{enclosed(to[0]), enclosed(to[1])};
    if (at == to) return;
    if (said.rx == 0 || said.ry == 0) return maker_.line(map, from, end);
    const Fraction dx = to[0] - at[0], dy = to[1] - at[1];
    if (said.rx == said.ry)
      return draw_round(map, {from, end, enclosed(said.rx), room_over(dx, dy, said.rx)}, said);
    // On the ellipse's own axes, in its half diameters, from the first end on, it is an arc of radius 1.
    const Turn turn = turn_by_degrees(said.turned_deg);
    const bool straight = said.turned_deg == 0;
    const Span c = straight ? just(1) : Span{turn.cosine.low_double(), turn.cosine.high_double()},
               s = straight ? just(0) : Span{turn.sine.low_double(), turn.sine.high_double()};
    const Span rx = enclosed(said.rx), ry = enclosed(said.ry);
    const Affine axes{{c * rx, s * rx}, {-(s * ry), c * ry}, from};
    const Vec way = end - from, over{(c * way.x + s * way.y) / rx, (c * way.y - s * way.x) / ry};
    const Span square = dot(over, over), room = (just(4) - square) / square;
    const Span exact = straight ? room_over(dx / said.rx, dy / said.ry, 1) : room;
    draw_round(map * axes, {{just(0), just(0)}, over, just(1), exact}, said);
  }

  /// Returns the square of the diameter less that of the chord, in the latter; 0 where the diameter is no
  /// longer.
  static Span room_over(const Fraction& dx, const Fraction& dy, const Fraction& radius) {
    const Fraction square = dx * dx + dy * dy, room = (4 * radius * radius - square) / square;
    return room <= 0 ? just(0) : enclosed(room);
  }

  /// An arc of a circle between two ends.
  struct RoundArc {
    Vec from, to;
    Span radius, room;
  };
  void draw_round(const Affine& map, const RoundArc& round, const PathArc& said) {
    const Vec chord = round.to - round.from, left{-chord.y, chord.x};
    DrawnArc arc;
    // A radius too small for its chord makes half a turn.
    if (round.room.high <= 0) {
      arc.centre = (round.from + round.to) * just(0.5), arc.radius = verify::length(chord) * just(0.5),
      arc.sweep = Sweep::half;
    } else {
      // The centre hangs on the rounding of decimals that hardly reach half a turn.
      if (round.room.low < 1e-6) return not_read("arcs of nearly half a turn in paths");
      const Span up = square_root(round.room) * just(0.5);
      // With y down a sweep runs clockwise as it is seen, which is counter-clockwise in these numbers.
      arc.centre = (round.from + round.to) * just(0.5) + left * (said.large == said.sweep ? -up : up);
      arc.radius = round.radius;
      arc.sweep = said.large ? Sweep::more : Sweep::less;
    }
    const Vec a = unit(round.from - arc.centre), b = unit(round.to - arc.centre);
    arc.first = said.sweep ? a : b, arc.last = said.sweep ? b : a;
    maker_.arc(map, arc);
  }

  const Document& document_;
  Fraction fallback_;
  ReadDrawing drawing_;
  CurveMaker maker_;
  std::map<std::string, const XmlElement*> by_id_;
  bool layers_are_marked_ = false;
  std::string complaint_;
};

}  // namespace

Result<ReadDrawing> read_svg_drawing(const Document& document, const Fraction& mm_per_unit, double off) {
  return SvgReader(document, mm_per_unit, off).read();
}

}  // namespace lekalo::verify
