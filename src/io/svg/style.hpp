#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "document.hpp"

namespace lekalo::io::detail {

/// The two properties of CSS that decide what is seen; all others are left alone.
struct Visibility {
  std::string display, visibility;  ///< lower case; empty where nothing is said
};

/// The rules of all style elements of a document with those properties.
class StyleSheet {
 public:
  explicit StyleSheet(const SvgDocument& document);

  /// Returns an element's visibility by its attributes, the rules and its style attribute. The later ones of
  /// these override the earlier.
  [[nodiscard]] Visibility of(const SvgElement& element) const;
  /// Sentences about the parts of the style sheets that are not read.
  [[nodiscard]] const std::vector<std::string>& notices() const noexcept { return notices_; }

 private:
  /// The name of an element, its id and a class of it; what is empty stands for any.
  struct Selector {
    std::string element, id, cls;
    friend auto operator<=>(const Selector&, const Selector&) = default;
  };
  /// A property as the last rule of one selector has it, and how many rules there were before.
  struct Said {
    std::string value;
    std::size_t order = 0;
  };
  struct Rule {
    Said display, visibility;
  };
  void read(std::string_view sheet, std::size_t line);
  void read_rule(std::string_view selectors, std::string_view body, std::size_t line);

  std::map<Selector, Rule> rules_;
  std::size_t rules_read_ = 0;
  std::vector<std::string> notices_;
};

/// The property of a style attribute that moves or shapes its element (transform, d, x, ...), if it has one:
/// those are not read.
[[nodiscard]] std::optional<std::string> geometry_in_style(const SvgElement& element);

}  // namespace lekalo::io::detail
