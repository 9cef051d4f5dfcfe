#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>

#include "io/text/refusal.hpp"
#include "lekalo/base/counted.hpp"
#include "lekalo/base/stop.hpp"
#include "solid_builder.hpp"
#include "text_words.hpp"

namespace lekalo::io {
namespace {

/// A binary file is a header, a number and so many triangles: a normal, three corners, two bytes.
constexpr std::size_t kHeader = 80, kBegin = kHeader + 4, kTriangle = 50, kCorners = 12;

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i)
    word |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
  return word;
}

bool is_binary(std::string_view bytes) { return has_stl_length(bytes) || !begins_as_text(bytes); }

/// Reads a text word by word; the names of solids are what is left of a line.
class TextStl {
 public:
  TextStl(std::string_view bytes, SolidBuilder& made) : words_(bytes), made_(made) {}

  Result<void> read() {
    while (const auto word = words_.next()) {
      if (!is_word(*word, "solid"))
        return refuse_here(fmt::format("{} where 'solid' is wanted", excerpt(*word)));
      made_.begin_group(words_.rest_of_line());
      LEKALO_CHECK(read_solid());
    }
    return {};
  }

 private:
  [[nodiscard]] tl::unexpected<Error> refuse_here(const std::string& sentence) const {
    return refuse_line(made_.name(), words_.line(), sentence);
  }
  [[nodiscard]] tl::unexpected<Error> ends_early() const {
    return refuse(made_.name(),
                  fmt::format("the file ends within its solid, in triangle {}; it is cut off, export it "
                              "again",
                              made_.triangles() + 1));
  }

  Result<void> read_solid() {
    while (true) {
      const auto word = words_.next();
      if (!word) return ends_early();
      if (is_word(*word, "endsolid")) {
        words_.rest_of_line();
        return {};
      }
      if (!is_word(*word, "facet"))
        return refuse_here(fmt::format("{} where 'facet' or 'endsolid' is wanted", excerpt(*word)));
      LEKALO_CHECK(read_facet());
    }
  }

  Result<void> expect(std::string_view wanted) {
    const auto word = words_.next();
    if (!word) return ends_early();
    if (is_word(*word, wanted)) return {};
    return refuse_here(fmt::format("{} where '{}' is wanted", excerpt(*word), wanted));
  }

  Result<void> read_facet() {
    ask();
    if (made_.triangles() == kMostSolidTriangles) return refuse_here(too_many_triangles());
    // Normals are not read: the corners say which way a triangle is turned, and of thin ones they are often
    // nan.
    LEKALO_CHECK(expect("normal"));
    for (int axis = 0; axis < 3; ++axis)
      if (!words_.next()) return ends_early();
    LEKALO_CHECK(expect("outer"));
    LEKALO_CHECK(expect("loop"));
    const auto first = static_cast<std::uint32_t>(made_.vertices());
    for (int corner = 0; corner < 3; ++corner) {
      LEKALO_CHECK(expect("vertex"));
      Millimetres xyz[3];
      for (Millimetres& number : xyz) {
        const auto word = words_.next();
        if (!word) return ends_early();
        const auto read = read_millimetres(*word, made_.unit());
        if (!read)
          return refuse_here(number_sentence(read.error(), *word) +
                             (word->find(',') != std::string_view::npos
                                  ? "; write numbers with a point, not a comma, before their decimals"
                                  : ""));
        number = *read;
      }
      made_.add_vertex({xyz[0].value, xyz[1].value, xyz[2].value},
                       std::max({xyz[0].error, xyz[1].error, xyz[2].error}));
    }
    LEKALO_CHECK(expect("endloop"));
    LEKALO_CHECK(expect("endfacet"));
    made_.add_triangle({first, first + 1, first + 2});
    return {};
  }

  TextWords words_;
  SolidBuilder& made_;
};

Result<void> read_binary(std::string_view bytes, SolidBuilder& made) {
  if (bytes.size() < kBegin)
    return refuse(made.name(), fmt::format("the file ends after {}; a binary STL has {} before its triangles",
                                           counted(bytes.size(), "byte"), kBegin));
  const std::uint32_t count = word_at(bytes, kHeader);
  if (!has_stl_length(bytes))
    return refuse(
        made.name(),
        fmt::format("this binary STL says {}, which take {} bytes, but has {} bytes ({:.6g} triangles); it "
                    "is damaged or no STL, export it again",
                    counted(count, "triangle"), kBegin + kTriangle * std::size_t{count}, bytes.size(),
                    static_cast<double>(bytes.size() - kBegin) / kTriangle));
  if (count > kMostSolidTriangles) return refuse(made.name(), too_many_triangles());
  made.reserve(3 * std::size_t{count}, count);
  const double scale = value_of(made.unit());
  for (std::uint32_t t = 0; t < count; ++t) {
    ask();
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      double xyz[3], error = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t at = kBegin + kTriangle * t + kCorners + 12 * corner + 4 * axis;
        const auto value = static_cast<double>(std::bit_cast<float>(word_at(bytes, at)));
        const auto number = scaled_millimetres(value, scale);
        if (!number)
          return refuse(made.name(),
                        fmt::format("triangle {} (byte {}): {}", t + 1, at, beyond_millimetres(value)));
        xyz[axis] = number->value;
        error = std::max(error, number->error);
      }
      made.add_vertex({xyz[0], xyz[1], xyz[2]}, error);
    }
    made.add_triangle({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return {};
}

}  // namespace

bool has_stl_length(std::string_view bytes) {
  return bytes.size() >= kBegin && bytes.size() - kBegin == kTriangle * std::size_t{word_at(bytes, kHeader)};
}

bool is_stl(std::string_view bytes) {
  if (has_stl_length(bytes)) return true;
  // A binary file of another length is told from a text by what follows, because its header may begin so,
  // too.
  TextWords words(bytes);
  const auto first = words.next();
  if (!first || !is_word(*first, "solid")) return false;
  if (!begins_as_text(bytes)) return true;
  words.rest_of_line();
  const auto second = words.next();
  return !second || is_word(*second, "facet") || is_word(*second, "endsolid");
}

Result<void> read_stl(std::string_view bytes, SolidBuilder& made) {
  if (is_binary(bytes)) {
    LEKALO_CHECK(read_binary(bytes, made));
  } else {
    if (const std::string fault = wrong_characters(bytes); !fault.empty()) return refuse(made.name(), fault);
    LEKALO_CHECK(TextStl(bytes, made).read());
  }
  if (made.triangles() == 0)
    return refuse(made.name(), "there are no triangles in this STL; export it again");
  return {};
}

}  // namespace lekalo::io
