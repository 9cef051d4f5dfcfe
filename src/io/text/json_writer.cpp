#include "lekalo/io/text/json_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <utility>

#include "lekalo/base/assert.hpp"
#include "lekalo/io/text/words.hpp"

namespace lekalo::io {

JsonWriter& JsonWriter::begin(char open, char close) {
  begin_value();
  text_ += open;
  open_ += close;
  first_ = true;
  return *this;
}

JsonWriter& JsonWriter::end() {
  LEKALO_ASSERT(!open_.empty() && !after_key_);
  const char close = open_.back();
  open_.pop_back();
  if (line_ || (layout_ == JsonLayout::indented && !first_)) append_break(2 * open_.size());
  text_ += close;
  first_ = false;
  return *this;
}

JsonWriter& JsonWriter::key(std::string_view name) {
  LEKALO_ASSERT(!open_.empty() && open_.back() == '}' && !after_key_);
  begin_item();
  append_text(name);
  text_ += layout_ == JsonLayout::compact ? ":" : ": ";
  after_key_ = true;
  return *this;
}

JsonWriter& JsonWriter::value(const JsonScalar& scalar) {
  begin_value();
  std::visit(
      [this](auto value) {
        using Value = decltype(value);
        if constexpr (std::is_same_v<Value, std::nullptr_t>)
          text_ += "null";
        else if constexpr (std::is_same_v<Value, std::string_view>)
          append_text(value);
        else if constexpr (std::is_same_v<Value, double>)
          append_number(value);
        else
          fmt::format_to(std::back_inserter(text_), "{}", value);
      },
      scalar.any_);
  return *this;
}

std::string& JsonWriter::raw() {
  begin_value();
  return text_;
}

JsonWriter& JsonWriter::line(std::size_t indent) {
  LEKALO_ASSERT(layout_ == JsonLayout::spaced);
  line_ = indent;
  return *this;
}

JsonWriter& JsonWriter::fields(std::initializer_list<JsonField> fields) {
  for (const JsonField& one : fields) field(one.key, one.value);
  return *this;
}

std::string JsonWriter::take() {
  LEKALO_ASSERT(open_.empty() && !first_);
  first_ = true;
  return std::exchange(text_, {});
}

void JsonWriter::begin_value() {
  if (std::exchange(after_key_, false)) return;
  LEKALO_ASSERT(open_.empty() ? first_ : open_.back() == ']');
  begin_item();
}

void JsonWriter::begin_item() {
  const bool first = std::exchange(first_, false);
  if (!first) text_ += ',';
  if (line_ || (layout_ == JsonLayout::indented && !open_.empty()))
    append_break(2 * open_.size());
  else if (!first && layout_ == JsonLayout::spaced)
    text_ += ' ';
}

void JsonWriter::append_break(std::size_t indent) {
  text_ += '\n';
  text_.append(line_.value_or(indent), ' ');
  line_.reset();
}

void JsonWriter::append_text(std::string_view text) {
  const auto stands_as_it_is = [](char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; };
  if (!std::all_of(text.begin(), text.end(), stands_as_it_is)) {
    text_ += json_string(text);
    return;
  }
  text_ += '"';
  text_ += text;
  text_ += '"';
}

void JsonWriter::append_number(double number) {
  if (layout_ != JsonLayout::spaced) {
    text_ += nlohmann::json(number).dump();
    return;
  }
  LEKALO_ASSERT(std::isfinite(number));
  fmt::format_to(std::back_inserter(text_), "{}", number);
}

}  // namespace lekalo::io
