#include "ply.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <utility>

#include "io/text/refusal.hpp"
#include "lekalo/base/stop.hpp"

namespace lekalo::io {
namespace {

constexpr std::size_t kMostHeaderLines = 2000, kMostProperties = 256;

std::optional<PlyScalar> scalar_named(std::string_view name) {
  constexpr std::pair<std::string_view, PlyScalar> kNames[] = {
      {"char", PlyScalar::int8},      {"int8", PlyScalar::int8},       {"uchar", PlyScalar::uint8},
      {"uint8", PlyScalar::uint8},    {"short", PlyScalar::int16},     {"int16", PlyScalar::int16},
      {"ushort", PlyScalar::uint16},  {"uint16", PlyScalar::uint16},   {"int", PlyScalar::int32},
      {"int32", PlyScalar::int32},    {"uint", PlyScalar::uint32},     {"uint32", PlyScalar::uint32},
      {"float", PlyScalar::float32},  {"float32", PlyScalar::float32}, {"double", PlyScalar::float64},
      {"float64", PlyScalar::float64}};
  for (const auto& [word, type] : kNames)
    if (word == name) return type;
  return std::nullopt;
}

std::size_t size_of(PlyScalar type) {
  switch (type) {
    case PlyScalar::int8:
    case PlyScalar::uint8:
      return 1;
    case PlyScalar::int16:
    case PlyScalar::uint16:
      return 2;
    case PlyScalar::int32:
    case PlyScalar::uint32:
    case PlyScalar::float32:
      return 4;
    case PlyScalar::float64:
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

double scalar_value(const char* bytes, PlyScalar type, bool big) {
  const std::size_t size = size_of(type);
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < size; ++i)
    bits |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << (8 * (big ? size - 1 - i : i));
  switch (type) {
    case PlyScalar::int8:
      return as_double<std::int8_t>(bits);
    case PlyScalar::uint8:
      return as_double<std::uint8_t>(bits);
    case PlyScalar::int16:
      return as_double<std::int16_t>(bits);
    case PlyScalar::uint16:
      return as_double<std::uint16_t>(bits);
    case PlyScalar::int32:
      return as_double<std::int32_t>(bits);
    case PlyScalar::uint32:
      return as_double<std::uint32_t>(bits);
    case PlyScalar::float32:
      return as_double<float>(bits);
    case PlyScalar::float64:
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

}  // namespace

std::optional<std::string_view> PlyFile::next_line() {
  if (rest_.empty()) return std::nullopt;
  const std::size_t end = std::min(rest_.find('\n'), rest_.size());
  const std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  ++line_;
  return line;
}

tl::unexpected<Error> PlyFile::refuse_here(const std::string& sentence) const {
  return refuse_line(name_, line_, sentence);
}

tl::unexpected<Error> PlyFile::refuse_row(const PlyElement& element, std::size_t row,
                                          const std::string& sentence) const {
  if (encoding_ == Encoding::ascii) return refuse_here(sentence);
  return refuse(name_, fmt::format("{} {}: {}",
                                   element.name == "vertex" || element.name == "face" ? element.name
                                                                                      : excerpt(element.name),
                                   row, sentence));
}

tl::unexpected<Error> PlyFile::ends_early(const PlyElement& element, std::uint64_t row) const {
  return refuse(name_, fmt::format("the file ends in row {} of {} of the element {}", row, element.rows,
                                   excerpt(element.name)));
}

Result<void> PlyFile::read_header() {
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
    if (words_.empty() || words_[0] == "obj_info") continue;
    if (words_[0] == "comment") {
      const char* const begin = words_.size() > 1 ? words_[1].data() : words_.back().data();
      comments_.emplace_back(begin,
                             words_.size() > 1 ? words_.back().data() + words_.back().size() - begin : 0);
      continue;
    }
    if (words_[0] == "end_header") break;
    LEKALO_CHECK(words_[0] == "format"     ? read_format(has_format)
                 : words_[0] == "element"  ? read_element()
                 : words_[0] == "property" ? read_property()
                                           : Result<void>(refuse_here(fmt::format(
                                                 "unknown word {} in the header", excerpt(words_[0])))));
  }
  if (!has_format) return refuse(name_, "the header of this PLY has no format line");
  for (const PlyElement& element : elements_)
    if (element.properties.empty())
      return refuse(name_, fmt::format("the element {} has no properties", excerpt(element.name)));
  return {};
}

Result<void> PlyFile::read_format(bool& has_format) {
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

Result<void> PlyFile::read_element() {
  PlyElement element;
  const bool counted = words_.size() == 3 && [&] {
    const auto [end, error] =
        std::from_chars(words_[2].data(), words_[2].data() + words_[2].size(), element.rows);
    return error == std::errc() && end == words_[2].data() + words_[2].size();
  }();
  if (!counted) return refuse_here("an element line is 'element NAME COUNT'");
  element.name = std::string(words_[1]);
  for (const PlyElement& other : elements_)
    if (other.name == element.name)
      return refuse_here(fmt::format("the element {} is declared twice", excerpt(element.name)));
  if (elements_.size() == kMostProperties) return refuse_here("too many elements");
  elements_.push_back(std::move(element));
  return {};
}

Result<void> PlyFile::read_property() {
  if (elements_.empty()) return refuse_here("a property before the first element");
  std::vector<PlyProperty>& properties = elements_.back().properties;
  if (properties.size() == kMostProperties) return refuse_here("too many properties");
  PlyProperty property;
  const bool list = words_.size() == 5 && words_[1] == "list";
  if (!list && words_.size() != 3)
    return refuse_here("a property line is 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
  const auto type = scalar_named(words_[list ? 3 : 1]);
  if (!type) return refuse_here(fmt::format("unknown type {}", excerpt(words_[list ? 3 : 1])));
  property.type = *type;
  if (list) {
    property.count = scalar_named(words_[2]);
    if (!property.count || *property.count == PlyScalar::float32 || *property.count == PlyScalar::float64)
      return refuse_here(fmt::format("{} cannot count the items of a list", excerpt(words_[2])));
  }
  property.name = std::string(words_.back());
  properties.push_back(std::move(property));
  return {};
}

const PlyElement* PlyFile::element(std::string_view name) const noexcept {
  for (const PlyElement& element : elements_)
    if (element.name == name) return &element;
  return nullptr;
}

std::size_t PlyFile::most_rows(const PlyElement& element) const noexcept {
  std::size_t least = 0;  // bytes of a row: those of its numbers, or a digit and a blank for each
  for (const PlyProperty& property : element.properties)
    least += encoding_ == Encoding::ascii ? 2 : size_of(property.count.value_or(property.type));
  return static_cast<std::size_t>(std::min<std::uint64_t>(element.rows, rest_.size() / least + 1));
}

Result<PlyFile::Axes> PlyFile::axes_of(const PlyElement& vertices, bool wants_z) const {
  constexpr std::string_view kAxes[] = {"x", "y", "z"};
  Axes axes;
  for (std::size_t axis = 0; axis < (wants_z ? 3U : 2U); ++axis) {
    for (std::size_t i = 0; i < vertices.properties.size(); ++i) {
      if (vertices.properties[i].name != kAxes[axis]) continue;
      if (axes[axis]) return refuse(name_, fmt::format("the vertices have two properties {}", kAxes[axis]));
      if (vertices.properties[i].count)
        return refuse(name_, fmt::format("the property {} of the vertices is a list", kAxes[axis]));
      axes[axis] = i;
    }
    if (!axes[axis])
      return refuse(name_, fmt::format("the vertices of this PLY have no property {}", kAxes[axis]));
  }
  return axes;
}

Result<std::string_view> PlyFile::next_words(const PlyElement& element, std::uint64_t row) {
  const auto line = next_line();
  if (!line) return ends_early(element, row);
  split_words(*line, words_);
  begins_.clear();
  std::size_t at = 0;
  for (const PlyProperty& property : element.properties) {
    begins_.push_back(at);
    if (!property.count) {
      ++at;
      continue;
    }
    std::uint64_t items = 0;
    if (at < words_.size()) {
      const std::string_view word = words_[at];
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), items);
      if (error != std::errc() || end != word.data() + word.size())
        return refuse_here(fmt::format("{} where the number of items of the list {} is wanted", excerpt(word),
                                       excerpt(property.name)));
    }
    at += 1 + static_cast<std::size_t>(std::min<std::uint64_t>(items, words_.size() + 1));
  }
  if (at != words_.size()) {
    const bool lists = std::any_of(element.properties.begin(), element.properties.end(),
                                   [](const PlyProperty& property) { return property.count.has_value(); });
    if (lists)
      return refuse_here(fmt::format("{} than the lists of this row of the element {} have",
                                     at < words_.size() ? "more numbers" : "fewer numbers",
                                     excerpt(element.name)));
    return refuse_here(fmt::format("{} numbers where a {} has {}", words_.size(),
                                   element.name == "vertex" ? "vertex" : "row", at));
  }
  return *line;
}

Result<std::string_view> PlyFile::next_row(const PlyElement& element, std::uint64_t row) {
  ask();
  if (encoding_ == Encoding::ascii) return next_words(element, row);
  begins_.clear();
  std::size_t at = 0;
  for (const PlyProperty& property : element.properties) {
    begins_.push_back(at);
    std::uint64_t items = 1;
    if (property.count) {
      const std::size_t size = size_of(*property.count);
      if (rest_.size() - at < size) return ends_early(element, row);
      const double count = scalar_value(rest_.data() + at, *property.count, is_big());
      if (!(count >= 0))
        return refuse(name_, fmt::format("row {} of the element {} has a list of {} items", row,
                                         excerpt(element.name), count));
      items = static_cast<std::uint64_t>(count);
      at += size;
    }
    const std::uint64_t bytes = items * size_of(property.type);  // below 2^35
    if (rest_.size() - at < bytes) return ends_early(element, row);
    at += static_cast<std::size_t>(bytes);
  }
  row_ = rest_.substr(0, at);
  rest_.remove_prefix(at);
  return row_;
}

std::optional<std::uint32_t> PlyFile::index_in_row(const PlyElement& element, std::size_t property) const {
  double number = -1;
  if (encoding_ == Encoding::ascii) {
    const std::string_view word = words_[begins_[property]];
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  } else {
    number = scalar_value(row_.data() + begins_[property], element.properties[property].type, is_big());
  }
  if (!(number >= 0 && number < 0x1p32) || number != std::floor(number)) return std::nullopt;
  return static_cast<std::uint32_t>(number);
}

Result<void> PlyFile::skip(const PlyElement& element) {
  for (std::uint64_t row = 0; row < element.rows; ++row) {
    ask();
    if (encoding_ == Encoding::ascii) {
      if (!next_line()) return ends_early(element, row);
    } else {
      LEKALO_CHECK(next_row(element, row));
    }
  }
  return {};
}

Result<void> PlyFile::read_points(const PlyElement& element, const Axes& axes, DecimalFactor unit,
                                  const TakePoint& take) {
  const double scale = value_of(unit);
  for (std::size_t row = 0; row < element.rows; ++row) {
    LEKALO_TRY(const std::string_view bytes, next_row(element, row));
    PlyPoint point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!axes[axis]) continue;
      const std::size_t begin = begins_[*axes[axis]];
      tl::expected<Millimetres, NumberFault> number;
      if (encoding_ == Encoding::ascii) {
        number = read_millimetres(words_[begin], unit);
        if (!number) return refuse_here(number_sentence(number.error(), words_[begin]));
      } else {
        const double value =
            scalar_value(bytes.data() + begin, element.properties[*axes[axis]].type, is_big());
        number = scaled_millimetres(value, scale);
        if (!number) return refuse_row(element, row, beyond_millimetres(value));
      }
      point.xyz[axis] = number->value;
      point.error = std::max(point.error, number->error);
    }
    LEKALO_CHECK(take(point, row));
  }
  return {};
}

Result<void> PlyFile::read_lists(const PlyElement& element, std::size_t property, const TakeList& take) {
  const PlyProperty& list = element.properties[property];
  if (list.type == PlyScalar::float32 || list.type == PlyScalar::float64)
    return refuse(name_, fmt::format("the items of the list {} are no whole numbers", excerpt(list.name)));
  std::vector<std::int64_t> items;
  for (std::size_t row = 0; row < element.rows; ++row) {
    LEKALO_TRY(const std::string_view bytes, next_row(element, row));
    items.clear();
    const std::size_t begin = begins_[property];
    if (encoding_ == Encoding::ascii) {
      const std::size_t end = property + 1 < begins_.size() ? begins_[property + 1] : words_.size();
      for (std::size_t at = begin + 1; at < end; ++at) {
        const std::string_view word = words_[at];
        const auto [stop, error] =
            std::from_chars(word.data(), word.data() + word.size(), items.emplace_back());
        if (error != std::errc() || stop != word.data() + word.size())
          return refuse_here(fmt::format("{} is not a whole number", excerpt(word)));
      }
    } else {
      const std::size_t end = property + 1 < begins_.size() ? begins_[property + 1] : bytes.size();
      const std::size_t size = size_of(list.type);
      for (std::size_t at = begin + size_of(*list.count); at < end; at += size)
        items.push_back(static_cast<std::int64_t>(scalar_value(bytes.data() + at, list.type, is_big())));
    }
    LEKALO_CHECK(take(items, row));
  }
  return {};
}

}  // namespace lekalo::io
