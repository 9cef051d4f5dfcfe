#include <fmt/core.h>

#include <cmath>

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "drawn_file.hpp"
#include "lekalo/base/double_of_text.hpp"
#include "placed_sheet.hpp"
#include "verify/number/exact.hpp"
#include "verify/number/span.hpp"

namespace lekalo::verify {
namespace {

/// Doubles of a page's size and of what lies at its rim are off by less, mm.
constexpr double kOffPage = 0x1p-19;

using Attributes = std::map<std::string, std::string_view, std::less<>>;

/// Reads numbers and letters of an attribute from front to back.
class Words {
 public:
  explicit Words(std::string_view text) : rest_(text) {}

  [[nodiscard]] bool done() {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == ',')) rest_.remove_prefix(1);
    return rest_.empty();
  }
  /// Returns the character that comes next.
  /// \pre the last done() was false
  char letter() {
    const char c = rest_.front();
    rest_.remove_prefix(1);
    return c;
  }
  double number() {
    if (done()) return bad();
    std::size_t end = 1;
    while (end < rest_.size() && rest_[end] != ' ' && rest_[end] != ',' &&
           (rest_[end] < 'A' || rest_[end] > 'Z'))
      ++end;
    const std::optional<double> value = double_of_text(rest_.substr(0, end));
    rest_.remove_prefix(end);
    return value ? *value : bad();
  }
  [[nodiscard]] bool fine() const { return fine_; }

 private:
  double bad() {
    fine_ = false;
    return 0;
  }
  std::string_view rest_;
  bool fine_ = true;
};

class SvgReader {
 public:
  explicit SvgReader(const Document& document) : name_(document.name), rest_(document.bytes) {}

  Result<DrawnFile> read() {
    while (complaint_.empty()) {
      const std::size_t open = rest_.find('<');
      if (open == std::string_view::npos) break;
      if (!in_text_) refuse_words(rest_.substr(0, open));
      if (texts_open_) texts_.back().text = plain_letters(rest_.substr(0, open));
      rest_.remove_prefix(open + 1);
      const std::size_t close = rest_.find('>');
      if (close == std::string_view::npos) return complained("an element is cut off");
      element(rest_.substr(0, close));
      rest_.remove_prefix(close + 1);
      ++elements_;
    }
    refuse_words(rest_);
    if (depth_ != 0 || !page_) complain("an element is not closed");
    if (complaint_.empty()) look_at_page();
    if (!complaint_.empty()) return complained(complaint_);
    return DrawnFile{std::move(lines_), std::move(texts_)};
  }

 private:
  [[nodiscard]] tl::unexpected<Error> complained(const std::string& what) const {
    return failure(ErrorCode::bad_input, fmt::format("{}: {}", name_, what));
  }
  void complain(const std::string& what) {
    if (complaint_.empty()) complaint_ = fmt::format("{}: {}", what, excerpt(current_));
  }

  void refuse_words(std::string_view between) {
    if (between.find_first_not_of(" \r\n\t") != std::string_view::npos)
      complain("text where lekalo writes none");
  }

  void element(std::string_view text) {
    current_ = text;
    // Other instructions name sheets of styles, and other encodings mean other letters.
    if (elements_ == 0 && text == R"(?xml version="1.0" encoding="UTF-8"?)") return;
    if (text.starts_with("/")) {
      if (open_.empty() || text.substr(1) != open_.back())
        return complain("an element that is not open is closed");
      open_.pop_back();
      --depth_;
      in_text_ = texts_open_ = false;
      return;
    }
    const bool alone = text.ends_with("/");
    if (alone) text.remove_suffix(1);
    if (!alone) ++depth_;
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    Attributes attributes;
    if (!take_attributes(text.substr(end), attributes)) return complain("attributes that cannot be read");
    if (word != "svg" && word != "g" && (open_.empty() || open_.back() != "g"))
      return complain("something is drawn on no layer");
    if (alone && word == "text") complain("a text without letters");
    if (!alone) open_.push_back(word);
    if (word == "svg")
      page(attributes);
    else if (word == "g")
      layer(attributes);
    else if (word == "path")
      path(attributes);
    else if (word == "circle")
      circle(attributes);
    else if (word == "line")
      line(attributes);
    else if (word == "text")
      letters(attributes);
    else
      complain("lekalo writes no such element");
  }

  static bool take_attributes(std::string_view text, Attributes& attributes) {
    for (;;) {
      const std::size_t first = text.find_first_not_of(' ');
      if (first == std::string_view::npos) return true;
      if (first == 0) return false;
      text.remove_prefix(first);
      const std::size_t equals = text.find("=\"");
      if (equals == std::string_view::npos) return false;
      const std::size_t close = text.find('"', equals + 2);
      if (close == std::string_view::npos) return false;
      if (!attributes.emplace(text.substr(0, equals), text.substr(equals + 2, close - equals - 2)).second)
        return false;
      text.remove_prefix(close + 1);
    }
  }

  /// Complains of an attribute that is not one of these.
  void only(const Attributes& attributes, std::initializer_list<std::string_view> known) {
    for (const auto& [key, value] : attributes)
      if (std::find(known.begin(), known.end(), key) == known.end())
        complain(fmt::format("lekalo writes no attribute {} there", excerpt(key)));
  }
  double number(const Attributes& attributes, const char* key, std::string_view unit = "") {
    const auto found = attributes.find(key);
    std::string_view text = found == attributes.end() ? std::string_view() : found->second;
    if (!text.ends_with(unit)) complain(fmt::format("{} is not in {}", key, unit));
    text.remove_suffix(std::min(unit.size(), text.size()));
    const std::optional<double> value = double_of_text(text);
    if (!value) complain(fmt::format("{} is no number", key));
    return value.value_or(0);
  }

  /// A unit of the page is a millimetre, and its corner lies where it says.
  void page(const Attributes& attributes) {
    only(attributes,
         {"xmlns", "xmlns:inkscape", "version", "width", "height", "viewBox", "data-lekalo-corner"});
    const double width = number(attributes, "width", "mm"), height = number(attributes, "height", "mm");
    const auto view = attributes.find("viewBox"), corner = attributes.find("data-lekalo-corner");
    if (view == attributes.end() || page_) return complain("a page without a viewBox, or a second one");
    // A page in another name space is no drawing, and shows nothing.
    if (said(attributes, "xmlns") != "http://www.w3.org/2000/svg" ||
        said(attributes, "xmlns:inkscape") != "http://www.inkscape.org/namespaces/inkscape")
      complain("a page in another name space");
    Words words(view->second);
    const double x = words.number(), y = words.number(), across = words.number(), down = words.number();
    if (!words.fine() || !words.done() || across != width || down != height)
      complain("the page is not as large as its viewBox");
    Words at(corner == attributes.end() ? "0 0" : corner->second);
    const double left = at.number(), low = at.number();
    if (!at.fine() || !at.done() || left != x || low != -y - height)
      complain("the corner of the page is not that of its viewBox");
    page_ = true;
    low_ = {left, low}, high_ = {left + width, low + height};
  }

  /// Readers show nothing beyond the page.
  void look_at_page() {
    const auto is_beyond = [&](Place p) {
      return std::max({low_.x - p.x, low_.y - p.y, p.x - high_.x, p.y - high_.y}) > kOffPage;
    };
    std::vector<Stroke> pieces;
    for (const DrawnLine& line : lines_)
      for (const Stroke& edge : line.edges) add_pieces(edge, kInfinity, pieces);
    for (const Stroke& piece : pieces) {
      // The places of an arc that go farthest along the axes are those nearest to its circle's.
      std::vector<Place> farthest{piece.from, piece.to};
      for (const Place way : {Place{1, 0}, Place{-1, 0}, Place{0, 1}, Place{0, -1}})
        farthest.push_back(nearest_on(piece, piece.centre + piece.radius * way));
      if (std::ranges::any_of(farthest, is_beyond)) return complain("something lies beyond the page");
    }
    for (const DrawnLetters& text : texts_)
      if (is_beyond(text.at)) return complain("a text stands beyond the page");
  }

  void layer(const Attributes& attributes) {
    only(attributes, {"inkscape:groupmode", "inkscape:label", "fill", "stroke", "stroke-width"});
    const auto label = attributes.find("inkscape:label");
    if (depth_ != 2 || label == attributes.end() || said(attributes, "inkscape:groupmode") != "layer")
      return complain("a group that is no layer");
    layer_ = label->second;
    if (said(attributes, "fill") != "none" || !is_colour(said(attributes, "stroke")) ||
        !(number(attributes, "stroke-width") > 0))
      complain("a layer whose lines are not shown as lines");
  }

  static bool is_colour(std::string_view text) {
    return text.size() == 7 && text.front() == '#' &&
           text.find_first_not_of("0123456789abcdef", 1) == std::string_view::npos;
  }
  /// Returns the colour of a line's own; empty where it has its layer's.
  std::string own_colour(const Attributes& attributes) {
    std::string own(said(attributes, "stroke"));
    if (attributes.contains("stroke") && !is_colour(own)) complain("a line in no colour");
    return own;
  }

  void path(const Attributes& attributes) {
    only(attributes, {"d", "stroke", "data-lekalo-arcs"});
    const auto data = attributes.find("d");
    if (data == attributes.end()) return complain("a path without data");
    Words words(data->second);
    DrawnLine drawn{layer_, {}, false, own_colour(attributes)};
    const auto place = [&] {
      const double x = words.number(), y = words.number();
      return Place{x, -y};
    };
    if (words.done() || words.letter() != 'M') return complain("a path that does not begin with M");
    const Place begin = place();
    Place at = begin;
    while (words.fine() && !words.done()) {
      const char letter = words.letter();
      if (drawn.closed || (letter != 'L' && letter != 'A' && letter != 'Z'))
        return complain("a path with other words than M, L, A and a Z at its end");
      if (letter == 'Z') {
        if (at.x != begin.x || at.y != begin.y) drawn.edges.push_back(line_between(at, begin));
        drawn.closed = true;
        continue;
      }
      const Stroke edge = letter == 'L' ? line_between(at, place()) : arc(at, words);
      drawn.edges.push_back(edge);
      at = edge.to;
    }
    if (!words.fine() || drawn.edges.empty()) return complain("path data that cannot be read");
    lines_.push_back(std::move(drawn));
  }

  Stroke arc(Place from, Words& words) {
    const double radius = words.number(), other = words.number(), turned = words.number(),
                 large = words.number(), sweep = words.number(), x = words.number(), y = words.number();
    const Place to{x, -y}, chord = to - from;
    const bool are_flags = (large == 0 || large == 1) && (sweep == 0 || sweep == 1);
    if (radius != other || turned != 0 || !are_flags || !(radius > 0) || !(length(chord) > 0))
      complain("an arc that is not of a circle");
    // The file counts y downwards, where sweep 0 is counter-clockwise.
    const bool ccw = sweep == 0, wide = large != 0;
    const double half = 0.5 * length(chord);
    const double height = std::sqrt(std::max(0.0, radius * radius - half * half));
    const Place centre = 0.5 * (from + to) + (ccw != wide ? height : -height) * unit(left_of(chord));
    return arc_about(from, to, centre, ccw);
  }

  void circle(const Attributes& attributes) {
    only(attributes, {"cx", "cy", "r", "stroke", "data-lekalo-arcs"});
    const Place centre{number(attributes, "cx"), -number(attributes, "cy")},
        start = centre + Place{number(attributes, "r"), 0};
    if (!(start.x > centre.x)) return complain("a circle without a radius");
    lines_.push_back({layer_, {arc_about(start, start, centre, true)}, true, own_colour(attributes)});
  }

  /// Returns an empty text where there is no such attribute.
  static std::string_view said(const Attributes& attributes, const char* key) {
    const auto found = attributes.find(key);
    return found == attributes.end() ? std::string_view() : found->second;
  }

  /// A text on a part has a transformation; a label has a place.
  void letters(const Attributes& attributes) {
    in_text_ = true;
    if (layer_ == "LABEL")
      return only(attributes, {"x", "y", "font-family", "font-size", "text-anchor", "fill", "stroke"});
    only(attributes, {"transform", "font-family", "font-size", "text-anchor", "fill", "stroke"});
    const std::string_view place = said(attributes, "transform"), anchor = said(attributes, "text-anchor");
    if (!place.starts_with("matrix(") || !place.ends_with(")")) return complain("a text without its place");
    Words words(place.substr(7, place.size() - 8));
    std::array<double, 6> m{};
    for (double& number : m) number = words.number();
    if (!words.fine() || !words.done()) return complain("a transformation that cannot be read");
    // Capitals are 0.72 of the font's size.
    const double height = 0.72 * number(attributes, "font-size");
    const char* const known = anchor == "start"    ? "left"
                              : anchor == "middle" ? "middle"
                              : anchor == "end"    ? "right"
                                                   : nullptr;
    // Other fonts may have other letters, and a layer's lines and no areas are drawn.
    if (known == nullptr || !(height > 0) || said(attributes, "font-family") != "sans-serif" ||
        !is_colour(said(attributes, "fill")) || said(attributes, "stroke") != "none")
      return complain("a text that lekalo does not write so");
    // The axes of the element have y down.
    texts_.push_back({layer_,
                      std::string(said(attributes, "fill")),
                      "",
                      known,
                      {m[4], -m[5]},
                      height * Place{m[0], -m[1]},
                      height * Place{-m[2], m[3]}});
    texts_open_ = true;
  }

  /// The letters that are written with entities of XML.
  static std::string plain_letters(std::string_view text) {
    constexpr std::array<std::pair<std::string_view, char>, 5> kEntities{
        {{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}}};
    std::string letters;
    while (!text.empty()) {
      const auto* const known = std::find_if(kEntities.begin(), kEntities.end(),
                                             [&](const auto& one) { return text.starts_with(one.first); });
      letters += known == kEntities.end() ? text.front() : known->second;
      text.remove_prefix(known == kEntities.end() ? 1 : known->first.size());
    }
    return letters;
  }

  void line(const Attributes& attributes) {
    only(attributes, {"x1", "y1", "x2", "y2"});
    lines_.push_back({layer_,
                      {line_between({number(attributes, "x1"), -number(attributes, "y1")},
                                    {number(attributes, "x2"), -number(attributes, "y2")})},
                      false});
  }

  const std::string& name_;
  std::string_view rest_, current_;
  std::vector<std::string_view> open_;  ///< names of the elements that are not closed yet
  std::string complaint_, layer_;
  int depth_ = 0;
  std::size_t elements_ = 0;
  Place low_, high_;  ///< corners of the page, mm, y up
  bool in_text_ = false, texts_open_ = false, page_ = false;
  std::vector<DrawnLine> lines_;
  std::vector<DrawnLetters> texts_;
};

}  // namespace

Result<DrawnFile> read_svg(const Document& document) { return SvgReader(document).read(); }

}  // namespace lekalo::verify
