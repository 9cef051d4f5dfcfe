#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "drawn_file.hpp"
#include "lekalo/base/double_of_text.hpp"
#include "verify/number/exact.hpp"

namespace lekalo::verify {
namespace {

struct Group {
  int code;
  std::string_view value;
  std::size_t line;            ///< of the value, from 1
  std::string_view letters{};  ///< the value with the blanks around it
};

/// Reads pairs of lines: a code, and its value without blanks around it.
class Groups {
 public:
  explicit Groups(std::string_view text) : rest_(text) {}

  /// Returns false at the end, and at a code that is no number.
  bool next(Group& group) {
    if (rest_.empty()) return false;
    const std::string_view code = take_line();
    const auto [end, error] = std::from_chars(code.data(), code.data() + code.size(), group.code);
    if (error != std::errc{} || end != code.data() + code.size()) return false;
    group.value = take_line();
    group.letters = letters_;
    group.line = line_;
    return true;
  }
  [[nodiscard]] std::size_t line() const { return line_; }

 private:
  std::string_view take_line() {
    ++line_;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    letters_ = line;
    while (!line.empty() && line.back() == ' ') line.remove_suffix(1);
    while (!line.empty() && line.front() == ' ') line.remove_prefix(1);
    return line;
  }

  std::string_view rest_, letters_;
  std::size_t line_ = 0;
};

class DxfReader {
 public:
  explicit DxfReader(const Document& document) : document_(document), groups_(document.bytes) {}

  Result<DrawnFile> read() {
    Group group;
    bool ended = false;
    while (complaint_.empty() && groups_.next(group)) {
      if (ended) complain(group, "it goes on after its end");
      if (group.code == 0) {
        said_once_.clear();
        finish_entity();
        ended = group.value == "EOF";
        begin(group);
      } else {
        take(group);
      }
    }
    if (!ended) complain({0, "", groups_.line()}, "it ends in the middle");
    if (scale_ == 0) complain("it does not say its unit");
    const bool is_plain = std::ranges::none_of(
        document_.bytes, [](char c) { return (static_cast<unsigned char>(c) & 0x80) != 0; });
    if (!is_plain && version_ != "AC1021")
      complain("its letters are UTF-8, which it does not say by $ACADVER AC1021");
    if (!complaint_.empty())
      return failure(ErrorCode::bad_input, fmt::format("{}: {}", document_.name, complaint_));
    for (DrawnLine& line : lines_)
      for (Stroke& edge : line.edges) {
        edge.from = scale_ * edge.from, edge.to = scale_ * edge.to, edge.centre = scale_ * edge.centre;
        edge.radius *= scale_;
      }
    for (DrawnLetters& text : texts_)
      text.at = scale_ * text.at, text.right = scale_ * text.right, text.up = scale_ * text.up;
    return DrawnFile{std::move(lines_), std::move(texts_)};
  }

 private:
  void complain(const std::string& what) {
    if (complaint_.empty()) complaint_ = what;
  }
  void complain(const Group& group, const std::string& what) {
    complain(fmt::format("line {}: {}", group.line, what));
  }

  void begin(const Group& group) {
    entity_ = group.value;
    if (entity_ == "ENDSEC") section_ = "";
    if (section_ == "ENTITIES" && entity_ != "LWPOLYLINE" && entity_ != "CIRCLE" && entity_ != "LINE" &&
        entity_ != "TEXT")
      complain(group, fmt::format("lekalo writes no {}", excerpt(entity_)));
    if (section_ == "BLOCKS" && entity_ != "BLOCK" && entity_ != "ENDBLK")
      complain(group, fmt::format("lekalo writes no {} in a block", excerpt(entity_)));
  }

  void take(const Group& group) {
    if (entity_ == "SECTION" && (section_.empty() || group.code == 2))
      take_section(group);
    else if (section_ == "HEADER")
      take_header(group);
    else if (entity_ == "LAYER")
      take_layer(group);
    else if (section_ == "ENTITIES")
      take_entity(group);
  }

  void take_section(const Group& group) {
    if (group.code != 2 || !section_.empty())
      complain(group, "a section without a name, or with a second one");
    section_ = group.value;
    // Readers take one of two sections of a name.
    if (!sections_.insert(section_).second) complain(group, "a section for the second time");
  }

  void take_header(const Group& group) {
    if (group.code == 9) variable_ = group.value;
    if (variable_ == "$ACADVER" && group.code == 1) version_ = group.value;
    if (variable_ != "$INSUNITS" || group.code != 70) return;
    if (scale_ != 0) complain(group, "it says its unit twice");
    scale_ = group.value == "4" ? 1 : group.value == "1" ? 25.4 : 0;
    if (scale_ == 0) complain(group, "its unit is neither mm nor inch");
  }

  /// A layer that is off, frozen or not printed would hide what is on it.
  void take_layer(const Group& group) {
    constexpr std::array kOfLayers{5, 330, 100, 2, 70, 62, 6};
    if (std::find(kOfLayers.begin(), kOfLayers.end(), group.code) == kOfLayers.end())
      complain(group, fmt::format("lekalo writes no group {} there", group.code));
    if ((group.code == 70 && group.value != "0") || (group.code == 62 && group.value.starts_with("-")))
      complain(group, "a layer is not shown");
  }

  void take_entity(const Group& group) {
    // Readers take one of two layers, colours, counts, letters, heights or widths.
    constexpr std::array kOnce{8, 90, 70, 420, 1, 30, 31, 43};
    if (std::find(kOnce.begin(), kOnce.end(), group.code) != kOnce.end() &&
        !said_once_.insert(group.code).second)
      return complain(group, fmt::format("a second group {}", group.code));
    switch (group.code) {
      case 5:
      case 330:
      case 100:
        return;
      case 8:
        layer_ = group.value;
        return;
      case 90:
        count_ = group.value;
        return;
      case 70:
        closed_ = group.value == "1";
        if (!closed_ && group.value != "0") complain(group, "a polyline of another kind than lekalo writes");
        return;
      case 420:
        take_colour(group);
        return;
      case 1:
        if (entity_ != "TEXT") break;
        letters_ = group.letters;
        return;
      default:
        break;
    }
    if (entity_ == "TEXT" && layer_ == "LABEL") return;
    // Texts that lekalo writes have no group that hides, tilts, mirrors or colours them otherwise.
    constexpr std::array kOfTexts{10, 20, 30, 11, 21, 31, 40, 41, 50, 71, 72, 73};
    if (entity_ == "TEXT" && std::find(kOfTexts.begin(), kOfTexts.end(), group.code) == kOfTexts.end())
      return complain(group, fmt::format("lekalo writes no group {} there", group.code));
    const std::optional<double> number = double_of_text(group.value);
    if (!number) return complain(group, fmt::format("{} is no number", excerpt(group.value)));
    const bool polyline = entity_ == "LWPOLYLINE";
    if (polyline && group.code == 10)
      vertices_.push_back({{*number, 0}, 0});
    else if (group.code == 20 && !vertices_.empty())
      vertices_.back().at.y = *number;
    else if (group.code == 42 && !vertices_.empty())
      vertices_.back().bulge = *number;
    else if (*number == 0 && (polyline ? group.code == 43 : group.code == 30 || group.code == 31))
      return;  // neither width nor height
    else if (!polyline && !numbers_.contains(group.code))
      numbers_[group.code] = *number;
    else
      complain(group, fmt::format("lekalo writes no group {} there", group.code));
  }

  void take_colour(const Group& group) {
    unsigned rgb = 0;
    const auto [end, error] =
        std::from_chars(group.value.data(), group.value.data() + group.value.size(), rgb);
    if (error != std::errc{} || end != group.value.data() + group.value.size() || rgb > 0xffffff)
      return complain(group, "a colour that is none");
    colour_ = fmt::format("#{:06x}", rgb);
  }

  void finish_entity() {
    if (section_ == "ENTITIES") {
      if (entity_ == "LWPOLYLINE") add_polyline();
      if (entity_ == "CIRCLE") add_circle();
      if (entity_ == "LINE") add_line();
      if (entity_ == "TEXT" && layer_ != "LABEL") add_text();
      if (entity_ != "TEXT" && !lines_.empty()) lines_.back().colour = colour_;
    }
    layer_.clear(), colour_.clear(), letters_ = {}, count_ = {}, closed_ = false, vertices_.clear(),
                                     numbers_.clear();
  }

  struct Vertex {
    Place at;
    double bulge = 0;
  };

  void add_polyline() {
    DrawnLine line{layer_, {}, closed_};
    if (vertices_.size() < 2 || count_ != fmt::format("{}", vertices_.size())) {
      complaint_ =
          fmt::format("line {}: a polyline that is not of the vertices that it counts", groups_.line());
      return;
    }
    for (std::size_t i = 0; i + (closed_ ? 0 : 1) < vertices_.size(); ++i) {
      const Place from = vertices_[i].at, to = vertices_[(i + 1) % vertices_.size()].at;
      const double bulge = vertices_[i].bulge;
      if (bulge == 0) {
        line.edges.push_back(line_between(from, to));
        continue;
      }
      // The bulge is the tangent of a quarter of the sweep, positive counter-clockwise.
      const Place centre = 0.5 * (from + to) + (0.25 * (1 / bulge - bulge)) * left_of(to - from);
      line.edges.push_back(arc_about(from, to, centre, bulge > 0));
    }
    lines_.push_back(std::move(line));
  }

  [[nodiscard]] bool has(std::initializer_list<int> codes) {
    const bool all =
        numbers_.size() == codes.size() &&
        std::all_of(codes.begin(), codes.end(), [&](int code) { return numbers_.contains(code); });
    if (!all) complaint_ = fmt::format("line {}: groups are missing in a {}", groups_.line(), entity_);
    return all;
  }

  void add_circle() {
    if (!has({10, 20, 40})) return;
    if (!(numbers_[40] > 0)) {
      complaint_ = fmt::format("line {}: a circle without a radius", groups_.line());
      return;
    }
    const Place centre{numbers_[10], numbers_[20]}, start = centre + Place{numbers_[40], 0};
    lines_.push_back({layer_, {arc_about(start, start, centre, true)}, true});
  }

  /// A text has its place, its height and perhaps an angle, a width, a direction and an anchor, whose place
  /// is the same.
  void add_text() {
    const auto number = [&](int code, double otherwise) {
      const auto found = numbers_.find(code);
      return found == numbers_.end() ? otherwise : found->second;
    };
    const double generation = number(71, 0), across = number(72, 0), height = number(40, 0),
                 width = number(41, 1);
    const bool fine = numbers_.contains(10) && numbers_.contains(20) && height > 0 && width > 0 &&
                      (generation == 0 || generation == 2) && (across == 0 || across == 1 || across == 2) &&
                      number(73, 0) == 0 && number(11, numbers_[10]) == numbers_[10] &&
                      number(21, numbers_[20]) == numbers_[20] && (across == 0 || numbers_.contains(11));
    if (!fine) {
      complaint_ = fmt::format("line {}: a text that lekalo does not write so", groups_.line());
      return;
    }
    const double angle = number(50, 0) * std::numbers::pi / 180;
    const Place along{std::cos(angle), std::sin(angle)};
    constexpr std::array<const char*, 3> kAnchors{"left", "middle", "right"};
    texts_.push_back({layer_,
                      colour_,
                      std::string(letters_),
                      kAnchors[static_cast<std::size_t>(across)],
                      {numbers_[10], numbers_[20]},
                      (generation == 2 ? -height * width : height * width) * along,
                      height * left_of(along)});
  }

  void add_line() {
    if (!has({10, 20, 11, 21})) return;
    lines_.push_back(
        {layer_, {line_between({numbers_[10], numbers_[20]}, {numbers_[11], numbers_[21]})}, false});
  }

  const Document& document_;
  Groups groups_;
  std::string complaint_;
  double scale_ = 0;
  std::string section_, entity_, variable_, version_, layer_, colour_;
  std::set<std::string> sections_;
  std::set<int> said_once_;  ///< codes of this entity's groups that stand once
  std::string_view count_, letters_;
  bool closed_ = false;
  std::vector<Vertex> vertices_;
  std::map<int, double> numbers_;
  std::vector<DrawnLine> lines_;
  std::vector<DrawnLetters> texts_;
};

}  // namespace

Result<DrawnFile> read_dxf(const Document& document) { return DxfReader(document).read(); }

}  // namespace lekalo::verify
