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

constexpr std::size_t kStlHead = 84, kStlTriangle = 50;

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t k = 4; k-- > 0;) word = word << 8 | static_cast<unsigned char>(bytes[at + k]);
  return word;
}

tl::unexpected<Error> bad(const Document& document, const std::string& sentence) {
  return failure(ErrorCode::bad_input, fmt::format("{}: {}", document.name, sentence));
}

bool is_binary_stl(std::string_view bytes) {
  return bytes.size() >= kStlHead &&
         bytes.size() - kStlHead == kStlTriangle * std::size_t{word_at(bytes, kStlHead - 4)};
}

Result<void> read_binary_stl(SolidMaker& made) {
  const std::string_view bytes = made.document().bytes;
  const std::uint32_t count = word_at(bytes, kStlHead - 4);
  for (std::uint32_t t = 0; t < count; ++t) {
    const auto first = static_cast<std::uint32_t>(made.vertices());
    for (std::size_t corner = 0; corner < 3; ++corner) {
      std::array<double, 3> xyz{};
      for (std::size_t axis = 0; axis < 3; ++axis)
        xyz[axis] =
            std::bit_cast<float>(word_at(bytes, kStlHead + kStlTriangle * t + 12 + 12 * corner + 4 * axis));
      if (const auto fault = made.add_vertex(xyz))
        return bad(made.document(), fmt::format("triangle {}: {}", t + 1, *fault));
    }
    if (const auto fault = made.add_triangle({first, first + 1, first + 2}))
      return bad(made.document(), *fault);
  }
  return {};
}

/// Says whether a text is this word of small letters, in either case.
bool is_word(std::string_view text, std::string_view word) {
  return text.size() == word.size() && std::equal(text.begin(), text.end(), word.begin(), [](char a, char b) {
           return (a | 0x20) == b;  // the cases of a letter differ by this bit
         });
}

/// Reads a text STL, whose words stand on lines of any length.
class TextStl {
 public:
  explicit TextStl(SolidMaker& made) : made_(made), lines_(made.document().bytes) {}

  Result<void> read() {
    while (const auto word = next()) {
      if (!is_word(*word, "solid")) return complain(*word, "'solid'");
      // A name follows, up to the end of the line.
      made_.begin_group(at_ == words_.size() ? std::string_view()
                                             : std::string_view(words_[at_].data(), words_.back().data() +
                                                                                        words_.back().size() -
                                                                                        words_[at_].data()));
      at_ = words_.size();
      LEKALO_CHECK(read_solid());
    }
    return {};
  }

 private:
  std::optional<std::string_view> next() {
    while (at_ == words_.size()) {
      const auto line = lines_.next();
      if (!line) return std::nullopt;
      ask();
      split(*line, words_);
      at_ = 0;
    }
    return words_[at_++];
  }
  [[nodiscard]] tl::unexpected<Error> complain(std::string_view found, std::string_view wanted) const {
    return bad_line(made_.document(), lines_.number(),
                    fmt::format("\"{}\" where {} is wanted", excerpt(found), wanted));
  }
  Result<void> expect(std::string_view wanted) {
    const auto word = next();
    if (!word || !is_word(*word, wanted)) return complain(word.value_or(""), fmt::format("'{}'", wanted));
    return {};
  }

  Result<void> read_solid() {
    while (true) {
      const auto word = next();
      if (word && is_word(*word, "endsolid")) {
        at_ = words_.size();
        return {};
      }
      if (!word || !is_word(*word, "facet")) return complain(word.value_or(""), "'facet' or 'endsolid'");
      LEKALO_CHECK(read_facet());
    }
  }

  Result<void> read_facet() {
    LEKALO_CHECK(expect("normal"));
    for (int axis = 0; axis < 3; ++axis)
      if (!next()) return complain("", "a number");
    LEKALO_CHECK(expect("outer"));
    LEKALO_CHECK(expect("loop"));
    const auto first = static_cast<std::uint32_t>(made_.vertices());
    for (int corner = 0; corner < 3; ++corner) {
      LEKALO_CHECK(expect("vertex"));
      std::array<std::string_view, 3> xyz;
      for (std::string_view& word : xyz) word = next().value_or("");
      if (const auto fault = made_.add_vertex(xyz.data()))
        return bad_line(made_.document(), lines_.number(), *fault);
    }
    LEKALO_CHECK(expect("endloop"));
    LEKALO_CHECK(expect("endfacet"));
    if (const auto fault = made_.add_triangle({first, first + 1, first + 2}))
      return bad_line(made_.document(), lines_.number(), *fault);
    return {};
  }

  SolidMaker& made_;
  Lines lines_;
  std::vector<std::string_view> words_;
  std::size_t at_ = 0;
};

// ---- OBJ --------------------------------------------------------------------------------------------------

class ObjReader {
 public:
  explicit ObjReader(SolidMaker& made) : made_(made), lines_(made.document().bytes) {}

  Result<void> read() {
    while (const auto line = lines_.next()) {
      ask();
      split(line->substr(0, line->find('#')), words_);
      if (words_.empty()) continue;
      const std::string_view word = words_[0];
      if (words_.back().ends_with('\\')) {
        made_.leave_open(fmt::format("line {} goes on in the next one", lines_.number()));
      } else if (word == "v") {
        LEKALO_CHECK(read_vertex());
      } else if (word == "f" || word == "fo") {
        LEKALO_CHECK(read_face());
      } else if (word == "g" || word == "o") {
        made_.begin_group(trimmed(trimmed(*line).substr(word.size())));
      } else if (word == "surf" || word == "bzp" || word == "bsp" || word == "cdp") {
        made_.leave_open(fmt::format("line {} begins a curved surface", lines_.number()));
      }
      if (made_.is_open()) return {};
    }
    return {};
  }

 private:
  [[nodiscard]] tl::unexpected<Error> complain(const std::string& sentence) const {
    return bad_line(made_.document(), lines_.number(), sentence);
  }

  Result<void> read_vertex() {
    // Behind the coordinates stand a weight or a colour.
    const std::size_t count = words_.size() - 1;
    if (count != 3 && count != 4 && count != 6 && count != 7)
      return complain(fmt::format("{} numbers where x, y and z of a vertex are wanted", count));
    if (count == 4) {
      const auto weight = parse_decimal(words_[4]);
      if (!weight || compare(*weight, Decimal{1, 0}) != 0)
        made_.leave_open(fmt::format("the vertex on line {} has a weight", lines_.number()));
    }
    if (const auto fault = made_.add_vertex(&words_[1])) return complain(*fault);
    return {};
  }

  Result<void> read_face() {
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t k = 1; k < words_.size(); ++k) {
      const std::string_view word = words_[k];
      const std::size_t length = std::min(word.find('/'), word.size());
      std::int64_t number = 0;  // as it stays where the word is none
      const char* const end = std::from_chars(word.data(), word.data() + length, number).ptr;
      const auto count = static_cast<std::int64_t>(made_.vertices()),
                 corner = word.starts_with('-') ? count + number : number - 1;
      if (end != word.data() + length ||
          word.substr(length).find_first_not_of("/-0123456789") != std::string_view::npos || corner < 0 ||
          corner >= count)
        return complain(
            fmt::format("\"{}\" is not the number of a vertex that stands before this line", excerpt(word)));
      if (k <= 3) corners[k - 1] = static_cast<std::uint32_t>(corner);
    }
    const std::size_t count = words_.size() - 1;
    if (count < 3) return complain(fmt::format("a face has three corners or more, not {}", count));
    if (count > 3) {
      made_.leave_open(fmt::format("the face on line {} has {} corners, and only triangles are read",
                                   lines_.number(), count));
      return {};
    }
    if (const auto fault = made_.add_triangle(corners)) return complain(*fault);
    return {};
  }

  SolidMaker& made_;
  Lines lines_;
  std::vector<std::string_view> words_;
};

std::string_view first_word(std::string_view bytes) {
  const std::size_t first = bytes.find_first_not_of(" \t\r\n\v\f");
  if (first == std::string_view::npos) return {};
  const std::string_view rest = bytes.substr(first);
  return rest.substr(0, rest.find_first_of(" \t\r\n\v\f"));
}

bool begins_with_vertex(std::string_view bytes) {
  Lines lines(bytes);
  while (const auto line = lines.next()) {
    ask();
    if (line->starts_with("v ") || line->starts_with("v\t")) return true;
  }
  return false;
}

}  // namespace

void split(std::string_view line, std::vector<std::string_view>& words) {
  words.clear();
  while (true) {
    const std::size_t first = line.find_first_not_of(" \t\r\v\f");
    if (first == std::string_view::npos) return;
    line.remove_prefix(first);
    const std::size_t end = std::min(line.find_first_of(" \t\r\v\f"), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

Decimal millimetres_of(SolidUnit unit) {
  switch (unit) {
    case SolidUnit::inch:
      return {254, -1};
    case SolidUnit::metre:
      return {1, 3};
    case SolidUnit::micron:
      return {1, -3};
    case SolidUnit::centimetre:
      return {1, 1};
    case SolidUnit::foot:
      return {3048, -1};
    case SolidUnit::millimetre:
      break;
  }
  return {1, 0};
}

std::optional<std::string> SolidMaker::add_vertex(const std::string_view* words) {
  std::array<Decimal, 3> numbers;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    auto number = parse_decimal(words[axis]);
    if (!number) return fmt::format("\"{}\" is not {}", excerpt(words[axis]), decimal_rule());
    numbers[axis] = *std::move(number);
  }
  return add(std::move(numbers));
}

std::optional<std::string> SolidMaker::add_vertex(const std::array<double, 3>& xyz) {
  if (unit() == SolidUnit::millimetre) return add_near(xyz);
  std::array<Decimal, 3> numbers;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // This one is beyond the sizes in any unit; what is not finite is no decimal.
    if (!(std::abs(xyz[axis]) <= limits::kLargestCoordinate)) return add_near(xyz);
    numbers[axis] = exactly(xyz[axis]);
  }
  return add(std::move(numbers));
}

std::optional<std::string> SolidMaker::add(std::array<Decimal, 3> numbers) {
  const Decimal factor = millimetres_of(unit());
  std::array<double, 3> near{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Decimal& number = numbers[axis];
    number.digits *= factor.digits, number.exponent += factor.exponent;
    near[axis] = approximate(number);
    if (std::abs(near[axis]) < limits::kSmallestCoordinate) near[axis] = 0, number = {};
  }
  if (auto fault = add_near(near)) return fault;
  reading_.mesh.written.push_back(std::move(numbers));
  return std::nullopt;
}

std::optional<std::string> SolidMaker::add_near(const std::array<double, 3>& millimetres) {
  ask();
  constexpr std::size_t kMost = 3 * limits::kMostSolidItems;
  if (vertices() == kMost) return fmt::format("more than {} vertices", kMost);
  std::array<double, 3> near{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double x = millimetres[axis];
    if (!(std::abs(x) <= limits::kLargestCoordinate))
      return fmt::format("the coordinate {} is not within {:g} mm", x, limits::kLargestCoordinate);
    if (std::abs(x) >= limits::kSmallestCoordinate) near[axis] = x;
  }
  reading_.mesh.near.push_back(near);
  return std::nullopt;
}

void SolidMaker::begin_group(std::string_view name) {
  const auto number_of = [&](std::string_view wanted) {
    const auto [at, added] = numbers_.try_emplace(std::string(wanted), reading_.groups.size());
    if (added) reading_.groups.emplace_back(wanted);
    return static_cast<std::uint32_t>(at->second);
  };
  // Those before have none.
  if (reading_.groups.empty()) reading_.group_of.assign(reading_.mesh.triangles.size(), number_of(""));
  group_ = number_of(name);
}

std::optional<std::string> SolidMaker::add_triangle(const std::array<std::uint32_t, 3>& corners) {
  if (reading_.mesh.triangles.size() == limits::kMostSolidItems)
    return fmt::format("more than {} triangles", limits::kMostSolidItems);
  if (!reading_.groups.empty()) reading_.group_of.push_back(group_);
  reading_.mesh.numbers.push_back(static_cast<std::uint32_t>(reading_.mesh.triangles.size()));
  reading_.mesh.triangles.push_back(corners);
  return std::nullopt;
}

namespace {

/// Reads any of the formats; false where it is none of them.
Result<bool> read_by_content(SolidMaker& made) {
  const Document& document = made.document();
  const std::string_view word = first_word(document.bytes);
  if (is_binary_stl(document.bytes)) {
    LEKALO_CHECK(read_binary_stl(made));
  } else if (document.bytes.starts_with("PK\x03\x04")) {
    LEKALO_CHECK(read_three_mf(made));
  } else if (word == "ply") {
    LEKALO_CHECK(read_ply(made));
  } else if (is_word(word, "solid")) {
    LEKALO_CHECK(TextStl(made).read());
  } else if (begins_with_vertex(document.bytes)) {
    LEKALO_CHECK(ObjReader(made).read());
  } else {
    return false;
  }
  return true;
}

}  // namespace

Result<SolidReading> read_solid(const Document& document, SolidUnit unit) {
  SolidMaker made(document, unit);
  LEKALO_TRY(const bool known, read_by_content(made));
  if (!known) made.leave_open("it is none of STL, OBJ, PLY and 3MF");
  SolidReading reading = made.take();
  if (reading.open || !reading.mesh.triangles.empty()) return reading;
  if (first_word(document.bytes) != "ply") return bad(document, "there are no triangles in it");
  reading.open = "it has no faces";
  return reading;
}

Result<SolidReading> read_measured_points(const Document& document, SolidUnit unit) {
  SolidMaker made(document, unit);
  LEKALO_TRY(const bool known, read_by_content(made));
  if (known) return made.take();
  std::vector<std::array<Decimal, 3>> directions;
  const auto take = [&](TextRow&& row) -> Result<void> {
    if (row.count < 3) return bad_line(document, row.line, "no z on this line");
    if (const auto fault = made.add_vertex(std::move(row.numbers)))
      return bad_line(document, row.line, *fault);
    if (row.count == 6) directions.push_back(std::move(row.direction));
    if (!directions.empty() && directions.size() != made.vertices())
      return bad_line(document, row.line, "this point has no direction, or alone has one");
    return {};
  };
  LEKALO_CHECK(read_text_rows(document, take, true));
  SolidReading reading = made.take();
  reading.directions = std::move(directions);
  return reading;
}

}  // namespace lekalo::verify
