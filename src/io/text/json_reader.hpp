#pragma once

#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "json_tree.hpp"
#include "lekalo/base/limits.hpp"
#include "lekalo/geom/grid.hpp"

namespace lekalo::io::detail {

/// The longest text of a name or an id, bytes.
inline constexpr std::size_t kLongestText = 1000;
/// The largest of counts, copies and the like.
inline constexpr std::int64_t kLargestCount = limits::kMostCount;

/// Takes values out of a tree and keeps the first fault: "FILE: PATH: what is wrong". After it everything
/// reads as nothing, so that callers look once, at the end or before work that is long.
class JsonReader {
 public:
  /// \param own  fields whose names begin so are the writer's business and never refused
  JsonReader(const JsonTree& tree, std::string name, std::string_view own = "x_")
      : tree_(&tree), name_(std::move(name)), own_(own) {}

  [[nodiscard]] const JsonTree& tree() const noexcept { return *tree_; }
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] bool ok() const noexcept { return !fault_; }
  /// \pre !ok()
  [[nodiscard]] const Error& fault() const noexcept { return *fault_; }
  void refuse(JsonValue at, const std::string& why);
  /// Keeps another reader's fault: refuse adds file and place, take expects that it names them.
  void refuse(JsonValue at, const Error& error) { refuse(at, error.message); }
  void take(Error error) {
    if (ok()) fault_ = std::move(error);
  }

  /// Refuses values that are no objects, and fields that are not known. Fields that begin with `own` are
  /// counted instead.
  bool expect_object(JsonValue value, std::initializer_list<std::string_view> known);
  /// Refuses values that are no lists, and lists of more items.
  bool expect_list(JsonValue value, std::size_t most);
  /// The member; where it is missing, the refusal says what it is for.
  std::optional<JsonValue> need(JsonValue object, std::string_view key, std::string_view what);

  double number(JsonValue value, double low, double high);
  std::int64_t integer(JsonValue value, std::int64_t low, std::int64_t high);
  bool truth(JsonValue value);
  /// Reads a text of at most kLongestText bytes without control characters.
  std::string text(JsonValue value);
  std::string text_not_empty(JsonValue value);
  /// A length in grid steps, from a number of file units of so many millimetres each.
  std::int64_t length(JsonValue value, double low_mm, double high_mm, double mm_per_unit = 1);
  std::int64_t gap(JsonValue value, double mm_per_unit = 1);

  /// Lines like "x_name (3 times)" for all the fields that expect_object counted.
  [[nodiscard]] std::vector<std::string> left_out() const;

 private:
  const JsonTree* tree_;
  std::string name_;
  std::string_view own_;
  std::optional<Error> fault_;
  std::map<std::string, std::size_t, std::less<>> left_out_;
};

}  // namespace lekalo::io::detail
