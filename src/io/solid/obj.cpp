#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/text/refusal.hpp"
#include "lekalo/base/counted.hpp"
#include "lekalo/base/stop.hpp"
#include "solid_builder.hpp"
#include "text_words.hpp"

namespace lekalo::io {
namespace {

/// Words that say nothing about the surface: its looks, and curves.
constexpr std::array<std::string_view, 32> kPassedOver{
    "vt",    "vn",     "vp",    "s",        "usemtl",   "mtllib",     "usemap",    "maplib",
    "mg",    "lod",    "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj", "ctech",
    "stech", "cstype", "deg",   "bmat",     "step",     "curv",       "curv2",     "parm",
    "trim",  "hole",   "scrv",  "sp",       "end",      "con",        "cdc",       "res"};
/// Surfaces that are no triangles.
constexpr std::array<std::string_view, 4> kFreeForm{"surf", "bzp", "bsp", "cdp"};

template <std::size_t n>
bool is_among(const std::array<std::string_view, n>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

class ObjReader {
 public:
  ObjReader(std::string_view bytes, SolidBuilder& made) : words_(bytes), made_(made) {}

  Result<void> read() {
    do {
      ask();
      const auto word = next();
      line_ = words_.line();
      if (!word) continue;
      if (*word == "v") {
        LEKALO_CHECK(read_vertex());
      } else if (*word == "f" || *word == "fo") {
        LEKALO_CHECK(read_face());
      } else if (*word == "g" || *word == "o") {
        made_.begin_group(words_.rest_of_line());
      } else if (*word == "l" || *word == "p") {
        ++lines_and_points_;
      } else if (is_among(kFreeForm, *word)) {
        return refuse_here(fmt::format(
            "{} is a curved surface, of which only triangles are read; export a mesh", excerpt(*word)));
      } else if (!is_among(kPassedOver, *word)) {
        ++unknown_;
        if (unknown_ == 1) first_unknown_ = fmt::format("{} on line {}", excerpt(*word), line_);
      }
    } while (end_line());
    if (lines_and_points_ > 0)
      made_.tell(
          fmt::format("{} not read", counted(lines_and_points_, "line or point is", "lines and points are")));
    if (unknown_ > 0)
      made_.tell(
          fmt::format("{} unknown, the first {}; they are not read",
                      counted(unknown_, "line begins with a word that is", "lines begin with words that are"),
                      first_unknown_));
    return {};
  }

 private:
  /// The next word of the line, or of the one that it goes on in after a backslash; a comment has none.
  std::optional<std::string_view> next() {
    while (true) {
      const auto word = words_.next_in_line();
      if (!word || word->front() == '#') return std::nullopt;
      if (*word != "\\") return word;
      if (!words_.next_line()) return std::nullopt;
    }
  }

  /// Passes over what is left of a line, and of those that it goes on in.
  bool end_line() {
    while (words_.rest_of_line().ends_with('\\'))
      if (!words_.next_line()) return false;
    return words_.next_line();
  }

  [[nodiscard]] tl::unexpected<Error> refuse_here(const std::string& sentence) const {
    return refuse_line(made_.name(), line_, sentence);
  }

  Result<void> read_vertex() {
    if (made_.vertices() == kMostSolidVertices) return refuse_here(too_many_vertices());
    Millimetres xyz[3];
    std::size_t count = 0;
    while (const auto word = next()) {
      const bool is_length = count < 3;
      const auto read = read_millimetres(*word, is_length ? made_.unit() : DecimalFactor{});
      if (!read) return refuse_here(number_sentence(read.error(), *word));
      if (is_length) xyz[count] = *read;
      if (count == 3) weight_ = read->value;
      ++count;
    }
    // Behind the coordinates stand a weight or a colour.
    if (count != 3 && count != 4 && count != 6 && count != 7)
      return refuse_here(fmt::format("{} where x, y and z of a vertex are wanted", counted(count, "number")));
    if (count == 4 && weight_ != 1)
      return refuse_here(
          fmt::format("the vertex has the weight {:g}; only 1 means a point, export a mesh", weight_));
    made_.add_vertex({xyz[0].value, xyz[1].value, xyz[2].value},
                     std::max({xyz[0].error, xyz[1].error, xyz[2].error}));
    return {};
  }

  Result<void> read_face() {
    corners_.clear();
    while (const auto word = next()) {
      const std::string_view vertex = word->substr(0, word->find('/'));
      const std::string_view others = word->substr(vertex.size());
      std::int64_t number = 0;
      const auto [end, error] = std::from_chars(vertex.data(), vertex.data() + vertex.size(), number);
      if (error != std::errc() || end != vertex.data() + vertex.size() ||
          others.find_first_not_of("/-0123456789") != std::string_view::npos)
        return refuse_here(
            fmt::format("{} is not the number of a vertex, as 7, -1 or 7/2/3", excerpt(*word)));
      const auto count = static_cast<std::int64_t>(made_.vertices());
      if (number == 0 || number > count || number < -count)
        return refuse_here(fmt::format("vertex {} is not there: {} before this line, numbered from 1", number,
                                       counted(made_.vertices(), "vertex stands", "vertices stand")));
      corners_.push_back(static_cast<std::uint32_t>(number > 0 ? number - 1 : count + number));
    }
    if (corners_.size() < 3)
      return refuse_here(fmt::format("a face has three corners or more, not {}", corners_.size()));
    if (const std::string wrong = made_.add_face(corners_); !wrong.empty()) return refuse_here(wrong);
    if (made_.triangles() > kMostSolidTriangles) return refuse_here(too_many_triangles());
    return {};
  }

  TextWords words_;
  SolidBuilder& made_;
  std::size_t line_ = 1;
  double weight_ = 1;
  std::vector<std::uint32_t> corners_;
  std::size_t lines_and_points_ = 0, unknown_ = 0;
  std::string first_unknown_;
};

}  // namespace

bool is_obj(std::string_view bytes) {
  if (!begins_as_text(bytes)) return false;
  // Comments and words of other formats may stand above the first vertex, but hardly so many.
  constexpr std::size_t kMostLines = 1000;
  TextWords words(bytes);
  for (std::size_t line = 0; line < kMostLines; ++line) {
    const auto word = words.next_in_line();
    if (word && *word == "v") {
      const auto number = words.next_in_line();
      return number && is_number(*number);
    }
    const bool passed_over =
        !word || word->front() == '#' || is_among(kPassedOver, *word) || *word == "g" || *word == "o";
    if (!passed_over || !words.next_line()) return false;
  }
  return false;
}

Result<void> read_obj(std::string_view bytes, SolidBuilder& made) {
  if (const std::string fault = wrong_characters(bytes); !fault.empty()) return refuse(made.name(), fault);
  LEKALO_CHECK(ObjReader(bytes, made).read());
  if (made.triangles() == 0)
    return refuse(made.name(),
                  made.vertices() == 0
                      ? "there are no vertices in this OBJ"
                      : "there are no faces in this OBJ; points are read from PLY and from text 'x y z'");
  return {};
}

}  // namespace lekalo::io
