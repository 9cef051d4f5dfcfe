#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>

#include "lekalo/base/limits.hpp"
#include "lekalo/base/stop.hpp"
#include "solid_text.hpp"
#include "verify/read/text_rows.hpp"

namespace lekalo::verify {
namespace {

constexpr std::size_t kMostProperties = 256, kMostHeaderLines = 2000;

/// The kind of a number in a binary file: bytes, and a letter for signed, unsigned or floating.
struct PlyNumber {
  std::size_t size = 0;
  char kind = 0;
};

std::optional<PlyNumber> number_named(std::string_view name) {
  const std::pair<std::string_view, PlyNumber> names[] = {
      {"char", {1, 's'}},  {"int8", {1, 's'}},    {"uchar", {1, 'u'}},  {"uint8", {1, 'u'}},
      {"short", {2, 's'}}, {"int16", {2, 's'}},   {"ushort", {2, 'u'}}, {"uint16", {2, 'u'}},
      {"int", {4, 's'}},   {"int32", {4, 's'}},   {"uint", {4, 'u'}},   {"uint32", {4, 'u'}},
      {"float", {4, 'f'}}, {"float32", {4, 'f'}}, {"double", {8, 'f'}}, {"float64", {8, 'f'}}};
  for (const auto& [word, number] : names)
    if (word == name) return number;
  return std::nullopt;
}

struct PlyProperty {
  std::string_view name;
  PlyNumber number;
  std::optional<PlyNumber> count;  ///< of a list
};
struct PlyElement {
  std::string_view name;
  std::uint64_t rows{};
  std::vector<PlyProperty> properties;

  /// Returns the place of a property, or how many there are.
  [[nodiscard]] std::size_t find(std::string_view wanted) const {
    const auto at = std::ranges::find(properties, wanted, &PlyProperty::name);
    return static_cast<std::size_t>(at - properties.begin());
  }
};

/// One value of a row; in a text, with its word.
struct PlyValue {
  double number = 0;
  std::string_view word;
};

class PlyReader {
 public:
  explicit PlyReader(SolidMaker& made) : made_(made), lines_(made.document().bytes) {}

  Result<void> read() {
    LEKALO_CHECK(read_header());
    body_ = lines_.rest();
    for (const PlyElement& element : elements_) {
      LEKALO_CHECK(read_element(element));
      if (made_.is_open()) return {};
    }
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const auto& corners = faces_[f];
      if (!body_faces_.empty())
        made_.begin_group(body_faces_[f] < names_.size() ? names_[body_faces_[f]] : "");
      for (const std::uint32_t corner : corners)
        if (corner >= made_.vertices())
          return bad(
              fmt::format("a face names the vertex {} of {}, numbered from 0", corner, made_.vertices()));
      if (const auto fault = made_.add_triangle(corners)) return bad(*fault);
      if (!body_faces_.empty()) made_.set_face(body_faces_[f]);
    }
    return {};
  }

 private:
  [[nodiscard]] tl::unexpected<Error> bad(const std::string& sentence) const {
    return failure(ErrorCode::bad_input, fmt::format("{}: {}", made_.document().name, sentence));
  }
  [[nodiscard]] tl::unexpected<Error> bad_header() const {
    return bad_line(made_.document(), lines_.number(), "this line of the header is not known");
  }
  [[nodiscard]] tl::unexpected<Error> bad_row(const PlyElement& element, std::uint64_t row,
                                              const std::string& sentence) const {
    if (text_) return bad_line(made_.document(), lines_.number(), sentence);
    return bad(fmt::format("{} {}: {}", excerpt(element.name), row, sentence));
  }

  Result<void> read_header() {
    bool has_format = false, has_deviation = false;
    std::size_t comments = 0;
    while (true) {
      const auto line = lines_.next();
      if (!line || lines_.number() > kMostHeaderLines) return bad("the header of this PLY does not end");
      split(*line, words_);
      if (words_.size() > 1 && words_[0] == "comment") {
        by_lekalo_step_ = by_lekalo_step_ || (comments++ == 0 && words_.size() == 3 &&
                                              words_[1] == "lekalo-step" && words_[2] == "1");
        if (by_lekalo_step_ && !has_deviation && words_[1] == "deviation") {
          auto number = words_.size() == 3 ? parse_decimal(words_[2]) : std::nullopt;
          if (!number || sgn(number->digits) < 0 || made_.unit() != SolidUnit::millimetre)
            return bad_header();
          made_.set_deviation(*std::move(number));
          has_deviation = true;
        }
      }
      if (lines_.number() == 1 || words_.empty() || words_[0] == "comment" || words_[0] == "obj_info")
        continue;
      if (words_[0] == "end_header") break;
      if (words_[0] == "format" && words_.size() == 3 && !has_format) {
        has_format = true;
        text_ = words_[1] == "ascii";
        big_ = words_[1] == "binary_big_endian";
        if (!text_ && !big_ && words_[1] != "binary_little_endian") return bad_header();
      } else if (words_[0] == "element" && words_.size() == 3) {
        PlyElement element{words_[1], {}, {}};
        const auto [end, error] =
            std::from_chars(words_[2].data(), words_[2].data() + words_[2].size(), element.rows);
        if (error != std::errc() || end != words_[2].data() + words_[2].size()) return bad_header();
        if (std::ranges::find(elements_, element.name, &PlyElement::name) != elements_.end())
          return bad_header();
        elements_.push_back(std::move(element));
      } else if (words_[0] == "property" && !elements_.empty()) {
        LEKALO_CHECK(read_property(elements_.back()));
      } else {
        return bad_header();
      }
    }
    if (!has_format) return bad("the header of this PLY does not say its format");
    if (by_lekalo_step_ && !has_deviation) return bad("lekalo-step made it, but its header has no deviation");
    return {};
  }

  Result<void> read_property(PlyElement& element) {
    const bool list = words_.size() == 5 && words_[1] == "list";
    if ((!list && words_.size() != 3) || element.properties.size() == kMostProperties) return bad_header();
    const auto number = number_named(words_[words_.size() - 2]);
    const auto count = list ? number_named(words_[2]) : std::nullopt;
    if (!number || (list && (!count || count->kind == 'f')) ||
        element.find(words_.back()) < element.properties.size())
      return bad_header();
    element.properties.push_back({words_.back(), *number, count});
    return {};
  }

  /// Reads the next number of a row, or nothing where the row or the file ends. Of a text it is the word
  /// alone, because words that nobody asked for need not be numbers.
  std::optional<PlyValue> next(PlyNumber number) {
    if (text_) return at_ < words_.size() ? std::optional(PlyValue{0, words_[at_++]}) : std::nullopt;
    if (body_.size() < number.size) return std::nullopt;
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < number.size; ++k)
      bits = bits << 8 | static_cast<unsigned char>(body_[big_ ? k : number.size - 1 - k]);
    body_.remove_prefix(number.size);
    if (number.kind == 'f')
      return PlyValue{number.size == 8 ? std::bit_cast<double>(bits)
                                       : std::bit_cast<float>(static_cast<std::uint32_t>(bits)),
                      {}};
    const auto above = static_cast<unsigned>(64 - 8 * number.size);
    return PlyValue{number.kind == 's'
                        ? static_cast<double>(static_cast<std::int64_t>(bits << above) >> above)
                        : static_cast<double>(bits),
                    {}};
  }

  /// Returns a number from 0 to 2^32 - 1, or nothing where the value is none.
  std::optional<std::uint32_t> whole(PlyValue value) const {
    if (text_) {
      const auto decimal = parse_decimal(value.word);
      if (!decimal) return std::nullopt;
      value.number = approximate(*decimal);
    }
    if (!(value.number >= 0 && value.number < 0x1p32) || value.number != std::floor(value.number))
      return std::nullopt;
    return static_cast<std::uint32_t>(value.number);
  }

  Result<void> read_element(const PlyElement& element) {
    const std::size_t none = element.properties.size();
    const bool is_vertex = element.name == "vertex", is_face = element.name == "face";
    const std::size_t of_body = is_face && by_lekalo_step_ ? element.find("face") : none,
                      name = element.name == "body_face" ? element.find("name") : none,
                      colour = element.name == "body_face" && by_lekalo_step_ ? element.find("colour") : none;
    const std::array<std::size_t, 3> xyz{element.find("x"), element.find("y"), element.find("z")};
    std::size_t corners = element.find("vertex_indices");
    if (corners == none) corners = element.find("vertex_index");
    if (is_vertex)
      for (const std::size_t at : xyz)
        if (at == none || element.properties[at].count)
          return bad("the vertices of this PLY have no x, y and z");
    if (is_face && element.rows > 0 && (corners == none || !element.properties[corners].count))
      return bad("the faces of this PLY have no vertex_indices");
    if (element.name == "tristrips" && element.rows > 0) made_.leave_open("it has strips of triangles");
    if (none == 0) return bad(fmt::format("the element {} has no properties", excerpt(element.name)));
    if (made_.is_open()) return {};

    values_.resize(none);
    for (std::uint64_t row = 0; row < element.rows; ++row) {
      ask();
      if (text_ && !next_row()) return bad_row(element, row, "the file ends here, too early");
      std::array<std::uint32_t, 3> face{};
      std::size_t face_size{};
      for (std::size_t p = 0; p < none; ++p) {
        const PlyProperty& property = element.properties[p];
        if (!property.count) {
          const auto value = next(property.number);
          if (!value) return bad_row(element, row, "the row ends early");
          values_[p] = *value;
          continue;
        }
        const auto said = next(*property.count);
        const auto count = said ? whole(*said) : std::nullopt;
        if (!count) return bad_row(element, row, "the row ends early, or has a list without a length");
        if (p == name) names_.emplace_back();
        for (std::uint32_t k = 0; k < *count; ++k) {
          const auto value = next(property.number);
          if (!value) return bad_row(element, row, "a list ends early");
          if (p == name) names_.back() += static_cast<char>(whole(*value).value_or(0));
          if (!is_face || p != corners || k >= 3) continue;
          const auto corner = whole(*value);
          if (!corner) return bad_row(element, row, "a corner is not the number of a vertex");
          face[k] = *corner;
        }
        if (p == corners) face_size = *count;
        ask(*count / 8);
      }
      if (text_ && at_ != words_.size())
        return bad_row(element, row, "the row has more numbers than it should");
      if (is_face) LEKALO_CHECK(add_face(element, row, face, face_size));
      if (of_body < none && !element.properties[of_body].count) {
        const auto number = whole(values_[of_body]);
        if (!number) return bad_row(element, row, "its face is not a number from 0");
        body_faces_.push_back(*number);
      }
      if (colour < none && !element.properties[colour].count) {
        const auto number = whole(values_[colour]);
        if (!number || *number > 0x1000000) return bad_row(element, row, "its colour is not one");
        made_.add_colour(*number);
      }
      if (is_vertex) LEKALO_CHECK(add_vertex(element, row, xyz));
      if (made_.is_open()) return {};
    }
    return {};
  }

  Result<void> add_face(const PlyElement& element, std::uint64_t row,
                        const std::array<std::uint32_t, 3>& corners, std::size_t size) {
    if (size < 3) return bad_row(element, row, fmt::format("a face has three corners or more, not {}", size));
    if (size > 3)
      made_.leave_open(fmt::format("face {} has {} corners, and only triangles are read", row, size));
    if (faces_.size() == limits::kMostSolidItems)
      return bad_row(element, row, fmt::format("more than {} triangles", limits::kMostSolidItems));
    faces_.push_back(corners);
    return {};
  }

  Result<void> add_vertex(const PlyElement& element, std::uint64_t row,
                          const std::array<std::size_t, 3>& xyz) {
    std::array<double, 3> numbers{};
    std::array<std::string_view, 3> words;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      numbers[axis] = values_[xyz[axis]].number;
      words[axis] = values_[xyz[axis]].word;
    }
    if (const auto fault = text_ ? made_.add_vertex(words.data()) : made_.add_vertex(numbers))
      return bad_row(element, row, *fault);
    return {};
  }

  /// Takes the words of the next line that has some.
  bool next_row() {
    at_ = 0;
    while (const auto line = lines_.next()) {
      ask();
      split(*line, words_);
      if (!words_.empty()) return true;
    }
    return false;
  }

  SolidMaker& made_;
  Lines lines_;
  std::string_view body_;
  bool text_ = false, big_ = false;
  std::vector<PlyElement> elements_;
  std::vector<std::array<std::uint32_t, 3>> faces_;
  /// The words of lekalo-step: the face of each, and the names of those faces.
  bool by_lekalo_step_ = false;
  std::vector<std::uint32_t> body_faces_;
  std::vector<std::string> names_;
  std::vector<PlyValue> values_;
  std::vector<std::string_view> words_;
  std::size_t at_ = 0;
};

}  // namespace

Result<void> read_ply(SolidMaker& made) { return PlyReader(made).read(); }

}  // namespace lekalo::verify
