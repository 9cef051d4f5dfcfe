#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "document.hpp"

namespace lekalo::io::detail {

/// The properties of CSS that decide what is seen, and in which colour; all others are left alone.
enum class Property { display, visibility, stroke, fill, stroke_dasharray, fill_rule };
inline constexpr std::array<std::string_view, 6> kProperties{"display", "visibility",       "stroke",
                                                             "fill",    "stroke-dasharray", "fill-rule"};

/// The values of those properties, lower case; empty where nothing is said.
struct Look {
  std::array<std::string, kProperties.size()> says;
  [[nodiscard]] const std::string& operator[](Property property) const {
    return says[static_cast<std::size_t>(property)];
  }
};

/// The colour of a paint as "#0000ff", or the word that stands there; empty for none, and for a gradient or
/// pattern.
[[nodiscard]] std::string colour_word(std::string_view paint);

/// The rules of all style elements of a document with those properties.
class StyleSheet {
 public:
  explicit StyleSheet(const SvgDocument& document);

  /// Returns an element's own look by its attributes, the rules and its style attribute. The later ones of
  /// these override the earlier.
  [[nodiscard]] Look of(const SvgElement& element) const;
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
  using Rule = std::array<Said, kProperties.size()>;
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
