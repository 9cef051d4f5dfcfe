#include "ply_points.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "io/contour/contour_points.hpp"
#include "lekalo/base/stop.hpp"

namespace lekalo::io {
namespace {

enum class Encoding { ascii, little_endian, big_endian };
enum class Scalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct Property {
  std::string name;
  Scalar type = Scalar::float32;
  std::optional<Scalar> count;  ///< of a list
};
struct Element {
  std::string name;
  std::uint64_t rows = 0;
  std::vector<Property> properties;
};

constexpr std::size_t kMostHeaderLines = 2000, kMostProperties = 256;

std::optional<Scalar> scalar_named(std::string_view name) {
  constexpr std::pair<std::string_view, Scalar> kNames[] = {
      {"char", Scalar::int8},      {"int8", Scalar::int8},       {"uchar", Scalar::uint8},
      {"uint8", Scalar::uint8},    {"short", Scalar::int16},     {"int16", Scalar::int16},
      {"ushort", Scalar::uint16},  {"uint16", Scalar::uint16},   {"int", Scalar::int32},
      {"int32", Scalar::int32},    {"uint", Scalar::uint32},     {"uint32", Scalar::uint32},
      {"float", Scalar::float32},  {"float32", Scalar::float32}, {"double", Scalar::float64},
      {"float64", Scalar::float64}};
  for (const auto& [word, type] : kNames)
    if (word == name) return type;
  return std::nullopt;
}

std::size_t size_of(Scalar type) {
  switch (type) {
    case Scalar::int8:
    case Scalar::uint8:
      return 1;
    case Scalar::int16:
    case Scalar::uint16:
      return 2;
    case Scalar::int32:
    case Scalar::uint32:
    case Scalar::float32:
      return 4;
    case Scalar::float64:
      return 8;
  }
  return 8;
}

template <class T>
double as_double(std::uint64_t bits) {
  T value{};
  if constexpr (sizeof(T) == 1) {
    value = std::bit_cast<T>(static_cast<std::uint8_t>(bits));
  } else if constexpr (sizeof(T) == 2) {
    value = std::bit_cast<T>(static_cast<std::uint16_t>(bits));
  } else if constexpr (sizeof(T) == 4) {
    value = std::bit_cast<T>(static_cast<std::uint32_t>(bits));
  } else {
    value = std::bit_cast<T>(bits);
  }
  return static_cast<double>(value);
}

double scalar_value(const char* bytes, Scalar type, bool big) {
  const std::size_t size = size_of(type);
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < size; ++i)
    bits |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << (8 * (big ? size - 1 - i : i));
  switch (type) {
    case Scalar::int8:
      return as_double<std::int8_t>(bits);
    case Scalar::uint8:
      return as_double<std::uint8_t>(bits);
    case Scalar::int16:
      return as_double<std::int16_t>(bits);
    case Scalar::uint16:
      return as_double<std::uint16_t>(bits);
    case Scalar::int32:
      return as_double<std::int32_t>(bits);
    case Scalar::uint32:
      return as_double<std::uint32_t>(bits);
    case Scalar::float32:
      return as_double<float>(bits);
    case Scalar::float64:
      return as_double<double>(bits);
  }
  return 0;
}

void split_words(std::string_view line, std::vector<std::string_view>& words) {
  words.clear();
  while (true) {
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return;
    line.remove_prefix(first);
    const std::size_t end = std::min(line.find_first_of(" \t\r"), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& name, LengthUnit unit)
      : rest_(bytes), name_(name), unit_(unit) {}

  Result<void> read(bool wants_z, const std::function<Result<void>(const PlyPoint&, std::size_t)>& take,
                    std::vector<std::string>& notices) {
    LEKALO_CHECK(read_header());
    LEKALO_CHECK(find_coordinates(wants_z));
    for (const Element& element : elements_) {
      if (element.name != "vertex") {
        if (element.rows > 0)
          notices.push_back(fmt::format("{}: {} of the element {} are ignored", name_, element.rows,
                                        excerpt(element.name)));
      }
    }
    for (const Element& element : elements_) {
      if (element.name == "vertex") {
        return encoding_ == Encoding::ascii ? read_ascii(element, take) : read_binary(element, take);
      }
      LEKALO_CHECK(skip(element));
    }
    return refuse(name_, "there is no element vertex in this PLY");
  }

 private:
  std::optional<std::string_view> next_line() {
    if (rest_.empty()) return std::nullopt;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++line_;
    return line;
  }
  [[nodiscard]] tl::unexpected<Error> refuse_here(const std::string& sentence) const {
    return refuse_line(name_, line_, sentence);
  }

  Result<void> read_header() {
    bool has_format = false;
    while (true) {
      const auto line = next_line();
      if (!line) return refuse(name_, "the header of this PLY has no end_header");
      if (line_ > kMostHeaderLines) return refuse_here("the header of this PLY does not end");
      split_words(*line, words_);
      if (line_ == 1) {
        if (words_.size() != 1 || words_[0] != "ply")
          return refuse(name_, "this is no PLY file: the first line is not 'ply'");
        continue;
      }
      if (words_.empty() || words_[0] == "comment" || words_[0] == "obj_info") continue;
      if (words_[0] == "end_header") break;
      LEKALO_CHECK(words_[0] == "format"     ? read_format(has_format)
                   : words_[0] == "element"  ? read_element()
                   : words_[0] == "property" ? read_property()
                                             : Result<void>(refuse_here(fmt::format(
                                                   "unknown word {} in the header", excerpt(words_[0])))));
    }
    if (!has_format) return refuse(name_, "the header of this PLY has no format line");
    for (const Element& element : elements_)
      if (element.properties.empty())
        return refuse(name_, fmt::format("the element {} has no properties", excerpt(element.name)));
    return {};
  }

  Result<void> read_format(bool& has_format) {
    if (std::exchange(has_format, true)) return refuse_here("a second format line");
    if (words_.size() != 3 || words_[2] != "1.0")
      return refuse_here("a format line is 'format ascii 1.0' (or binary_little_endian, binary_big_endian)");
    if (words_[1] == "ascii") {
      encoding_ = Encoding::ascii;
    } else if (words_[1] == "binary_little_endian") {
      encoding_ = Encoding::little_endian;
    } else if (words_[1] == "binary_big_endian") {
      encoding_ = Encoding::big_endian;
    } else {
      return refuse_here(fmt::format("unknown format {}", excerpt(words_[1])));
    }
    return {};
  }

  Result<void> read_element() {
    Element element;
    const bool counted = words_.size() == 3 && [&] {
      const auto [end, error] =
          std::from_chars(words_[2].data(), words_[2].data() + words_[2].size(), element.rows);
      return error == std::errc() && end == words_[2].data() + words_[2].size();
    }();
    if (!counted) return refuse_here("an element line is 'element NAME COUNT'");
    element.name = std::string(words_[1]);
    for (const Element& other : elements_)
      if (other.name == element.name)
        return refuse_here(fmt::format("the element {} is declared twice", excerpt(element.name)));
    if (elements_.size() == kMostProperties) return refuse_here("too many elements");
    elements_.push_back(std::move(element));
    return {};
  }

  Result<void> read_property() {
    if (elements_.empty()) return refuse_here("a property before the first element");
    std::vector<Property>& properties = elements_.back().properties;
    if (properties.size() == kMostProperties) return refuse_here("too many properties");
    Property property;
    const bool list = words_.size() == 5 && words_[1] == "list";
    if (!list && words_.size() != 3)
      return refuse_here("a property line is 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
    const auto type = scalar_named(words_[list ? 3 : 1]);
    if (!type) return refuse_here(fmt::format("unknown type {}", excerpt(words_[list ? 3 : 1])));
    property.type = *type;
    if (list) {
      property.count = scalar_named(words_[2]);
      if (!property.count || *property.count == Scalar::float32 || *property.count == Scalar::float64)
        return refuse_here(fmt::format("{} cannot count the items of a list", excerpt(words_[2])));
    }
    property.name = std::string(words_.back());
    properties.push_back(std::move(property));
    return {};
  }

  Result<void> find_coordinates(bool wants_z) {
    for (const Element& element : elements_) {
      if (element.name != "vertex") continue;
      for (const Property& property : element.properties)
        if (property.count)
          return refuse(name_, fmt::format("the vertices have a list ({}); only plain numbers can be read",
                                           excerpt(property.name)));
      constexpr std::string_view kAxes[] = {"x", "y", "z"};
      for (std::size_t axis = 0; axis < (wants_z ? 3U : 2U); ++axis) {
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
          if (element.properties[i].name != kAxes[axis]) continue;
          if (column_[axis])
            return refuse(name_, fmt::format("the vertices have two properties {}", kAxes[axis]));
          column_[axis] = i;
        }
        if (!column_[axis])
          return refuse(name_, fmt::format("the vertices of this PLY have no property {}", kAxes[axis]));
      }
      if (element.rows > kMostScanPoints)
        return refuse(name_,
                      fmt::format("{} vertices; at most {} can be read", element.rows, kMostScanPoints));
      return {};
    }
    return refuse(name_, "there is no element vertex in this PLY");
  }

  [[nodiscard]] tl::unexpected<Error> ends_early(const Element& element, std::uint64_t row) const {
    return refuse(name_, fmt::format("the file ends in row {} of {} of the element {}", row, element.rows,
                                     excerpt(element.name)));
  }

  Result<void> skip(const Element& element) {
    for (std::uint64_t row = 0; row < element.rows; ++row) {
      ask();
      if (encoding_ == Encoding::ascii) {
        if (!next_line()) return ends_early(element, row);
        continue;
      }
      for (const Property& property : element.properties) {
        std::uint64_t items = 1;
        if (property.count) {
          const std::size_t size = size_of(*property.count);
          if (rest_.size() < size) return ends_early(element, row);
          const double count = scalar_value(rest_.data(), *property.count, encoding_ == Encoding::big_endian);
          if (!(count >= 0))
            return refuse(name_, fmt::format("row {} of the element {} has a list of {} items", row,
                                             excerpt(element.name), count));
          items = static_cast<std::uint64_t>(count);
          rest_.remove_prefix(size);
        }
        const std::uint64_t bytes = items * size_of(property.type);  // below 2^35
        if (rest_.size() < bytes) return ends_early(element, row);
        rest_.remove_prefix(static_cast<std::size_t>(bytes));
      }
    }
    return {};
  }

  Result<void> read_ascii(const Element& element,
                          const std::function<Result<void>(const PlyPoint&, std::size_t)>& take) {
    for (std::uint64_t row = 0; row < element.rows; ++row) {
      const auto line = next_line();
      if (!line) return ends_early(element, row);
      split_words(*line, words_);
      if (words_.size() != element.properties.size())
        return refuse_here(
            fmt::format("{} numbers where a vertex has {}", words_.size(), element.properties.size()));
      PlyPoint point;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!column_[axis]) continue;
        const auto number = read_millimetres(words_[*column_[axis]], unit_);
        if (!number) return refuse_here(number_sentence(number.error(), words_[*column_[axis]]));
        point.xyz[axis] = number->value;
        point.error = std::max(point.error, number->error);
      }
      LEKALO_CHECK(take(point, static_cast<std::size_t>(row)));
    }
    return {};
  }

  Result<void> read_binary(const Element& element,
                           const std::function<Result<void>(const PlyPoint&, std::size_t)>& take) {
    std::size_t stride = 0;
    std::vector<std::size_t> at;
    for (const Property& property : element.properties) {
      at.push_back(stride);
      stride += size_of(property.type);
    }
    if (rest_.size() / stride < element.rows) return ends_early(element, rest_.size() / stride);
    for (std::size_t row = 0; row < element.rows; ++row) {
      ask();
      PlyPoint point;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!column_[axis]) continue;
        const double value =
            scalar_value(rest_.data() + at[*column_[axis]], element.properties[*column_[axis]].type,
                         encoding_ == Encoding::big_endian);
        const double scaled = value * millimetres_per(unit_);
        if (!(std::abs(scaled) <= kLargestMillimetres)) {
          return refuse(name_, fmt::format("vertex {}: {} is not a finite number up to {:g} mm", row, value,
                                           kLargestMillimetres));
        }
        if (std::abs(scaled) >= kSmallestMillimetres) {
          point.xyz[axis] = scaled;
          // 25.4 is within 2^-53 of its size of the double, the product rounds once more.
          if (unit_ == LengthUnit::inch) point.error = std::max(point.error, std::abs(scaled) * 0x1p-51);
        } else if (value != 0) {
          point.error = std::max(point.error, kSmallestMillimetres);
        }
      }
      rest_.remove_prefix(stride);
      LEKALO_CHECK(take(point, row));
    }
    return {};
  }

  std::string_view rest_;
  const std::string& name_;
  LengthUnit unit_;
  std::size_t line_ = 0;
  Encoding encoding_ = Encoding::ascii;
  std::vector<Element> elements_;
  std::array<std::optional<std::size_t>, 3> column_;
  std::vector<std::string_view> words_;
};

}  // namespace

Result<void> read_ply_points(std::string_view bytes, const std::string& name, LengthUnit unit, bool wants_z,
                             const std::function<Result<void>(const PlyPoint&, std::size_t)>& take,
                             std::vector<std::string>& notices) {
  return PlyReader(bytes, name, unit).read(wants_z, take, notices);
}

}  // namespace lekalo::io
