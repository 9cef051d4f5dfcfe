#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"

namespace lekalo::io::detail {

/// A JSON document as one flat list of values in file order: a file of a hundred thousand placements is read
/// in the time that its bytes take, and every value knows its path for messages. Every JSON file that io
/// reads is read through it, but for contours (json_contour.cpp): these hear the parser themselves
/// (json_events.hpp), because they need the decimals of numbers, and their five million points would be half
/// a gigabyte here.

enum class JsonKind : std::uint8_t { null, boolean, integer, number, text, list, object };
/// The kind in words for messages: "a list".
[[nodiscard]] const char* name_of(JsonKind kind) noexcept;

/// The most lists and objects within each other of a document; deeper ones are refused.
inline constexpr std::size_t kDeepestJson = 64;
/// The largest document, bytes; larger ones are refused.
inline constexpr std::size_t kLargestJson = std::size_t{1} << 28;

/// A key as it stands in a path: quoted where it is not plain.
[[nodiscard]] std::string plain_key(std::string_view key);

class JsonTree;

/// One value of a tree, which must outlive it.
class JsonValue {
 public:
  class Iterator {
   public:
    Iterator(const JsonTree& tree, std::uint32_t at) noexcept : tree_(&tree), at_(at) {}
    JsonValue operator*() const noexcept { return {*tree_, at_}; }
    Iterator& operator++() noexcept;
    friend bool operator==(const Iterator& a, const Iterator& b) noexcept { return a.at_ == b.at_; }

   private:
    const JsonTree* tree_;
    std::uint32_t at_;
  };

  JsonValue(const JsonTree& tree, std::uint32_t at) noexcept : tree_(&tree), at_(at) {}
  [[nodiscard]] JsonKind kind() const noexcept;
  [[nodiscard]] bool is_number() const noexcept;  ///< or an integer
  [[nodiscard]] bool truth() const noexcept;      ///< \pre a boolean
  [[nodiscard]] std::int64_t integer() const noexcept;
  [[nodiscard]] double number() const noexcept;          ///< \pre is_number()
  [[nodiscard]] std::string_view text() const noexcept;  ///< \pre a text
  [[nodiscard]] bool text_is(std::string_view what) const noexcept {
    return kind() == JsonKind::text && text() == what;
  }
  /// The number of items of a list or an object; 0 for others.
  [[nodiscard]] std::size_t size() const noexcept;
  [[nodiscard]] Iterator begin() const noexcept;
  [[nodiscard]] Iterator end() const noexcept;
  [[nodiscard]] std::string_view key() const noexcept;  ///< \pre an item of an object
  /// The item of an object under this key; nothing in values that are no objects. Cost: O(its items).
  [[nodiscard]] std::optional<JsonValue> find(std::string_view key) const noexcept;
  /// The path of the value, "parts[3].outline", and "" for the whole document. Cost: O(values before it).
  [[nodiscard]] std::string path() const;

 private:
  const JsonTree* tree_;
  std::uint32_t at_;
};

class JsonTree {
 public:
  /// Fails with ErrorCode::bad_input, naming file and line or path: no JSON, a file that ends too early, a
  /// number beyond doubles or the limits of written numbers (base/limits.hpp), a key that stands twice in one
  /// object, values deeper than `deepest`, a document larger than kLargestJson.
  [[nodiscard]] static Result<JsonTree> parse(std::string_view bytes, const std::string& name,
                                              std::size_t deepest = kDeepestJson);
  /// The value of the whole document, valid until the tree is moved.
  [[nodiscard]] JsonValue root() const noexcept { return {*this, 0}; }

 private:
  friend class JsonValue;
  friend class JsonTreeBuilder;
  struct Node {
    JsonKind kind = JsonKind::null;
    std::uint32_t end = 0;                ///< the node after it and all in it
    std::uint32_t key = 0, key_size = 0;  ///< into texts_
    /// A double, an integer, a truth, the number of items, or a text as (at << 32 | size).
    std::uint64_t bits = 0;
  };
  std::vector<Node> nodes_;
  std::string texts_;
};

inline JsonValue::Iterator& JsonValue::Iterator::operator++() noexcept {
  at_ = tree_->nodes_[at_].end;
  return *this;
}
inline JsonKind JsonValue::kind() const noexcept { return tree_->nodes_[at_].kind; }
inline bool JsonValue::is_number() const noexcept {
  return kind() == JsonKind::integer || kind() == JsonKind::number;
}
inline bool JsonValue::truth() const noexcept { return tree_->nodes_[at_].bits != 0; }
inline std::int64_t JsonValue::integer() const noexcept {
  return static_cast<std::int64_t>(tree_->nodes_[at_].bits);
}
inline double JsonValue::number() const noexcept {
  return kind() == JsonKind::integer ? static_cast<double>(integer())
                                     : std::bit_cast<double>(tree_->nodes_[at_].bits);
}
inline std::string_view JsonValue::text() const noexcept {
  const std::uint64_t bits = tree_->nodes_[at_].bits;
  return std::string_view(tree_->texts_).substr(bits >> 32U, bits & 0xffffffffU);
}
inline std::size_t JsonValue::size() const noexcept {
  return kind() == JsonKind::list || kind() == JsonKind::object ? tree_->nodes_[at_].bits : 0;
}
inline JsonValue::Iterator JsonValue::begin() const noexcept {
  return {*tree_, size() == 0 ? tree_->nodes_[at_].end : at_ + 1};
}
inline JsonValue::Iterator JsonValue::end() const noexcept { return {*tree_, tree_->nodes_[at_].end}; }
inline std::string_view JsonValue::key() const noexcept {
  const JsonTree::Node& node = tree_->nodes_[at_];
  return std::string_view(tree_->texts_).substr(node.key, node.key_size);
}

}  // namespace lekalo::io::detail
