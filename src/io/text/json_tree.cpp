#include "json_tree.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "decimal.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/io/text/excerpt.hpp"
#include "lekalo/io/text/json_events.hpp"

namespace lekalo::io::detail {

const char* name_of(JsonKind kind) noexcept {
  switch (kind) {
    case JsonKind::null:
      return "null";
    case JsonKind::boolean:
      return "true or false";
    case JsonKind::integer:
    case JsonKind::number:
      return "a number";
    case JsonKind::text:
      return "a text";
    case JsonKind::list:
      return "a list";
    case JsonKind::object:
      return "an object";
  }
  return "?";
}

std::optional<JsonValue> JsonValue::find(std::string_view key) const noexcept {
  if (kind() != JsonKind::object) return std::nullopt;
  for (const JsonValue item : *this)
    if (item.key() == key) return item;
  return std::nullopt;
}

std::string JsonValue::path() const {
  std::string text;
  JsonValue value = tree_->root();
  while (value.at_ != at_) {
    std::size_t index = 0;
    for (const JsonValue item : value) {
      ask();
      if (at_ >= tree_->nodes_[item.at_].end) {
        ++index;
        continue;
      }
      if (value.kind() == JsonKind::list) {
        text += fmt::format("[{}]", index);
      } else {
        text += (text.empty() ? "" : ".") + plain_key(item.key());
      }
      value = item;
      break;
    }
  }
  return text;
}

std::string plain_key(std::string_view key) {
  const bool plain = !key.empty() && key.size() <= 40 && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
  return plain ? std::string(key) : excerpt(key);
}

/// Appends each value that the parser finds to the flat list.
class JsonTreeBuilder final : public JsonEvents {
 public:
  JsonTreeBuilder(std::string_view bytes, const std::string& name, std::size_t deepest)
      : name_(name), deepest_(deepest) {
    tree.texts_.reserve(bytes.size() / 4);
  }

  bool null() override { return add(JsonKind::null, 0); }
  bool boolean(bool value) override { return add(JsonKind::boolean, value ? 1 : 0); }
  bool integer(std::int64_t value) override {
    return add(JsonKind::integer, static_cast<std::uint64_t>(value));
  }
  bool number(double value, std::string_view text) override {
    if (const auto beyond = beyond_limits(text)) {
      fault = Error{ErrorCode::bad_input,
                    fmt::format("{}{}: {}", name_, place_of_next(), number_sentence(*beyond, text))};
      return false;
    }
    return add(JsonKind::number, std::bit_cast<std::uint64_t>(value));
  }
  bool text(std::string_view value) override {
    const std::uint64_t at = keep(value);
    return add(JsonKind::text, at << 32U | value.size());
  }
  bool begin_object() override { return open(JsonKind::object); }
  bool begin_list() override { return open(JsonKind::list); }
  bool key(std::string_view value) override {
    key_ = keep(value);
    key_size_ = static_cast<std::uint32_t>(value.size());
    return true;
  }
  bool end_list() override {
    close();
    return true;
  }
  bool end_object() override {
    if (!keys_differ(open_.back())) return false;
    close();
    return true;
  }
  void broken(const JsonBreak& at) override {
    const std::string why = at.number_too_large
                                ? fmt::format("the number {} is out of range", excerpt(at.token))
                            : at.ends_early ? "the file ends too early; it may be cut off"
                                            : fmt::format("this is not JSON from {} on", excerpt(at.token));
    fault = Error{ErrorCode::bad_input, fmt::format("{}, line {}: {}", name_, at.line, why)};
  }

  std::optional<Error> fault;
  JsonTree tree;

 private:
  std::uint32_t keep(std::string_view text) {
    const auto at = static_cast<std::uint32_t>(tree.texts_.size());
    tree.texts_ += text;
    return at;
  }

  bool add(JsonKind kind, std::uint64_t bits) {
    const auto at = static_cast<std::uint32_t>(tree.nodes_.size());
    tree.nodes_.push_back({kind, at + 1, key_, key_size_, bits});
    if (!open_.empty()) ++tree.nodes_[open_.back()].bits;
    return true;
  }

  bool open(JsonKind kind) {
    if (open_.size() == deepest_) {
      fault = Error{ErrorCode::bad_input, fmt::format("{}: {}: lists and objects are more than {} deep here",
                                                      name_, path(), deepest_)};
      return false;
    }
    add(kind, 0);
    open_.push_back(static_cast<std::uint32_t>(tree.nodes_.size() - 1));
    return true;
  }

  void close() {
    tree.nodes_[open_.back()].end = static_cast<std::uint32_t>(tree.nodes_.size());
    open_.pop_back();
  }

  /// The standard leaves open which of two equal keys counts.
  bool keys_differ(std::uint32_t object) {
    keys_.clear();
    tree.nodes_[object].end = static_cast<std::uint32_t>(tree.nodes_.size());
    for (const JsonValue item : JsonValue(tree, object)) keys_.push_back(item.key());
    std::sort(keys_.begin(), keys_.end());
    const auto twice = std::adjacent_find(keys_.begin(), keys_.end());
    if (twice == keys_.end()) return true;
    const std::string at = path();
    fault = Error{ErrorCode::bad_input, fmt::format("{}{}: the key {} stands twice in one object", name_,
                                                    at.empty() ? "" : ": " + at, excerpt(*twice))};
    return false;
  }

  /// The path of the innermost list or object that is open.
  [[nodiscard]] std::string path() const {
    std::string text;
    for (std::size_t i = 1; i < open_.size(); ++i) {
      const JsonTree::Node &outer = tree.nodes_[open_[i - 1]], &inner = tree.nodes_[open_[i]];
      if (outer.kind == JsonKind::list) {
        text += fmt::format("[{}]", outer.bits - 1);
      } else {
        text += (text.empty() ? "" : ".") +
                plain_key(std::string_view(tree.texts_).substr(inner.key, inner.key_size));
      }
    }
    return text;
  }

  /// ": " and the path of the value that comes next; empty for that of the whole document.
  [[nodiscard]] std::string place_of_next() const {
    if (open_.empty()) return "";
    const JsonTree::Node& outer = tree.nodes_[open_.back()];
    const std::string around = path();
    if (outer.kind == JsonKind::list) return fmt::format(": {}[{}]", around, outer.bits);
    return ": " + around + (around.empty() ? "" : ".") +
           plain_key(std::string_view(tree.texts_).substr(key_, key_size_));
  }

  const std::string& name_;
  std::size_t deepest_;
  std::vector<std::uint32_t> open_;
  std::vector<std::string_view> keys_;
  std::uint32_t key_ = 0, key_size_ = 0;
};

Result<JsonTree> JsonTree::parse(std::string_view bytes, const std::string& name, std::size_t deepest) {
  if (bytes.size() > kLargestJson)
    return failure(ErrorCode::bad_input, fmt::format("{}: is larger than {} MiB; split it into several files",
                                                     name, kLargestJson >> 20U));
  JsonTreeBuilder builder(bytes, name, deepest);
  const bool parsed = parse_json(bytes, builder);
  if (builder.fault) return tl::unexpected(std::move(*builder.fault));
  if (!parsed) return failure(ErrorCode::bad_input, fmt::format("{}: this is not JSON", name));
  return std::move(builder.tree);
}

}  // namespace lekalo::io::detail
