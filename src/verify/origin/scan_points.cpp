#include "scan_points.hpp"

#include <fmt/core.h>

#include <array>
#include <bit>
#include <cstdint>
#include <utility>

#include "verify/read/contour.hpp"
#include "verify/read/text_rows.hpp"

namespace lekalo::verify {
namespace {

constexpr std::size_t kMostPoints = 20'000'000;

class Measured {
 public:
  Measured(LengthUnit unit, const std::optional<Slice>& slice) : unit_(unit), slice_(slice) {}

  /// The point without z is one without a third number.
  void add(std::array<Decimal, 3> numbers, bool begins_contour) {
    for (Decimal& number : numbers)
      if (unit_ == LengthUnit::inch) number.digits *= 254, --number.exponent;
    if (slice_) {
      Decimal off = numbers[2] - slice_->height;
      off.digits = 2 * abs(off.digits);
      if (compare(off, slice_->thickness) > 0) return;
    }
    if (begins_contour || points_.at.empty()) points_.contour_starts.push_back(points_.at.size());
    points_.at.push_back({enclosed(numbers[0]), enclosed(numbers[1])});
  }

  [[nodiscard]] MeasuredPoints take() { return std::move(points_); }

 private:
  LengthUnit unit_;
  const std::optional<Slice>& slice_;
  MeasuredPoints points_;
};

tl::unexpected<Error> bad(const Document& document, const std::string& sentence) {
  return failure(ErrorCode::bad_input, fmt::format("{}: {}", document.name, sentence));
}

// ---- PLY --------------------------------------------------------------------------------------------------

enum class Encoding { ascii, little, big };

struct Scalar {
  std::size_t size = 0;
  enum class Kind { integer, natural, real } kind = Kind::real;
};

std::optional<Scalar> scalar_named(std::string_view name) {
  using Kind = Scalar::Kind;
  struct Named {
    std::string_view first, second;
    Scalar scalar;
  };
  constexpr std::array<Named, 8> kNames{{{"char", "int8", {1, Kind::integer}},
                                         {"uchar", "uint8", {1, Kind::natural}},
                                         {"short", "int16", {2, Kind::integer}},
                                         {"ushort", "uint16", {2, Kind::natural}},
                                         {"int", "int32", {4, Kind::integer}},
                                         {"uint", "uint32", {4, Kind::natural}},
                                         {"float", "float32", {4, Kind::real}},
                                         {"double", "float64", {8, Kind::real}}}};
  for (const Named& one : kNames)
    if (name == one.first || name == one.second) return one.scalar;
  return std::nullopt;
}

struct Property {
  std::string name;
  Scalar type;
  std::optional<Scalar> count;  ///< of a list
};
struct Element {
  std::string name;
  std::size_t rows = 0;
  std::vector<Property> properties;
};

class PlyReader {
 public:
  PlyReader(const Document& document, bool wants_z)
      : document_(document), lines_(document.bytes), wants_z_(wants_z) {}

  Result<void> read(Measured& to) {
    LEKALO_CHECK(read_header());
    // The lines of the header end where the rows begin.
    rest_ = lines_.rest();
    for (const Element& element : elements_) {
      if (element.name == "vertex") return read_vertices(element, to);
      for (std::size_t row = 0; row < element.rows; ++row) LEKALO_CHECK(skip_row(element));
    }
    return bad(document_, "it has no element vertex");
  }

 private:
  static std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    while (!(line = trimmed(line)).empty()) {
      const std::size_t end = std::min(line.find_first_of(" \t\r"), line.size());
      words.push_back(line.substr(0, end));
      line.remove_prefix(end);
    }
    return words;
  }

  Result<void> read_header() {
    bool has_format = false;
    while (const auto line = lines_.next()) {
      const std::vector<std::string_view> words = words_of(*line);
      const auto here = [&](const std::string& sentence) {
        return bad_line(document_, lines_.number(), sentence);
      };
      if (lines_.number() == 1) {
        if (words.size() != 1 || words[0] != "ply") return here("it does not begin with the line ply");
      } else if (words.empty() || words[0] == "comment" || words[0] == "obj_info") {
        continue;
      } else if (words[0] == "end_header") {
        return has_format ? Result<void>() : here("the header has no format");
      } else if (words[0] == "format" && words.size() == 3 && !has_format) {
        has_format = true;
        if (words[1] == "ascii")
          encoding_ = Encoding::ascii;
        else if (words[1] == "binary_little_endian")
          encoding_ = Encoding::little;
        else if (words[1] == "binary_big_endian")
          encoding_ = Encoding::big;
        else
          return here(fmt::format("\"{}\" is no format", excerpt(words[1])));
      } else if (words[0] == "element" && words.size() == 3) {
        const auto rows = parse_decimal(words[2]);
        if (!rows || sgn(rows->digits) < 0 || rows->exponent < 0 || approximate(*rows) > 1e12)
          return here("an element without a count");
        elements_.push_back({std::string(words[1]), static_cast<std::size_t>(approximate(*rows)), {}});
      } else if (words[0] == "property" && !elements_.empty() &&
                 (words.size() == 3 || (words.size() == 5 && words[1] == "list"))) {
        Property property{std::string(words.back()), {}, {}};
        const auto type = scalar_named(words[words.size() - 2]);
        if (words.size() == 5) property.count = scalar_named(words[2]);
        if (!type || (words.size() == 5 && !property.count)) return here("a property of no known type");
        property.type = *type;
        elements_.back().properties.push_back(std::move(property));
      } else {
        return here(fmt::format("the header has a line that is not known: {}", excerpt(*line)));
      }
    }
    return bad(document_, "the header does not end");
  }

  std::optional<std::string_view> bytes_of(std::size_t size) {
    if (rest_.size() < size) return std::nullopt;
    const std::string_view bytes = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return bytes;
  }
  std::string_view line() {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    return line;
  }

  /// Returns the number that the bytes are, exactly.
  [[nodiscard]] std::optional<Decimal> number_of(std::string_view bytes, const Scalar& type) const {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const std::size_t at = encoding_ == Encoding::big ? bytes.size() - 1 - i : i;
      bits |= std::uint64_t{static_cast<unsigned char>(bytes[at])} << (8 * i);
    }
    if (type.kind == Scalar::Kind::real) {
      const double value = type.size == 8 ? std::bit_cast<double>(bits)
                                          : std::bit_cast<float>(static_cast<std::uint32_t>(bits));
      if (!(std::abs(value) <= 1e300)) return std::nullopt;
      return exactly(value);
    }
    auto value = static_cast<double>(bits);
    const double whole = std::ldexp(1.0, static_cast<int>(8 * type.size));
    if (type.kind == Scalar::Kind::integer && value >= whole / 2) value -= whole;
    return exactly(value);
  }

  Result<void> ends_early() const { return bad(document_, "it ends within its rows"); }

  Result<void> skip_row(const Element& element) {
    if (encoding_ == Encoding::ascii) {
      if (rest_.empty()) return ends_early();
      line();
      return {};
    }
    for (const Property& property : element.properties) {
      double items = 1;
      if (property.count) {
        const auto bytes = bytes_of(property.count->size);
        const auto count = bytes ? number_of(*bytes, *property.count) : std::nullopt;
        if (!count || sgn(count->digits) < 0) return ends_early();
        items = approximate(*count);
      }
      if (!(items * static_cast<double>(property.type.size) <= static_cast<double>(rest_.size())))
        return ends_early();
      bytes_of(static_cast<std::size_t>(items) * property.type.size);
    }
    return {};
  }

  Result<void> read_vertices(const Element& element, Measured& to) {
    std::array<std::optional<std::size_t>, 3> column;
    std::size_t stride = 0;
    std::vector<std::size_t> at;
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const Property& property = element.properties[k];
      if (property.count) return bad(document_, "its vertices have lists");
      at.push_back(stride);
      stride += property.type.size;
      for (const std::size_t axis : {0U, 1U, 2U})
        if (property.name == std::string(1, "xyz"[axis])) column[axis] = k;
    }
    if (!column[0] || !column[1] || (wants_z_ && !column[2]))
      return bad(document_, "its vertices lack x, y or a z for the slice");
    for (std::size_t row = 0; row < element.rows; ++row) {
      if (row == kMostPoints) return bad(document_, fmt::format("more than {} points", kMostPoints));
      std::vector<std::string_view> words;
      std::string_view bytes;
      if (encoding_ == Encoding::ascii) {
        words = words_of(line());
        if (words.size() != element.properties.size()) return ends_early();
      } else {
        const auto taken = bytes_of(stride);
        if (!taken) return ends_early();
        bytes = *taken;
      }
      std::array<Decimal, 3> numbers;
      for (std::size_t axis = 0; axis < (wants_z_ ? 3U : 2U); ++axis) {
        const std::size_t k = *column[axis];
        const auto number =
            encoding_ == Encoding::ascii
                ? parse_decimal(words[k])
                : number_of(bytes.substr(at[k], element.properties[k].type.size), element.properties[k].type);
        if (!number) return bad(document_, fmt::format("vertex {} has a coordinate that is no number", row));
        numbers[axis] = *number;
      }
      to.add(std::move(numbers), false);
    }
    return {};
  }

  const Document& document_;
  Lines lines_;
  bool wants_z_;
  Encoding encoding_ = Encoding::ascii;
  std::vector<Element> elements_;
  std::string_view rest_;
};

}  // namespace

Result<MeasuredPoints> read_scan_points(const Document& document, LengthUnit unit,
                                        const std::optional<Slice>& slice) {
  Measured measured(unit, slice);
  if (ending_of(document.name) == ".ply") {
    LEKALO_CHECK(PlyReader(document, slice.has_value()).read(measured));
    return measured.take();
  }
  LEKALO_CHECK(read_text_rows(document, [&](TextRow&& row) -> Result<void> {
    if (slice && row.count < 3)
      return bad_line(document, row.line, "no z on this line, but there is a slice");
    measured.add(std::move(row.numbers), row.after_a_gap && !slice);
    return {};
  }));
  return measured.take();
}

}  // namespace lekalo::verify
