#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lekalo/base/error.hpp"

namespace lekalo::io::detail {

/// An element of an SVG file. Elements of other namespaces are not kept.
struct SvgElement {
  std::string name;  ///< without prefix
  /// The attributes: SVG's own by name, and the known ones of other namespaces with their usual prefix
  /// ("inkscape:label", "xlink:href"). Others are left out.
  std::vector<std::pair<std::string, std::string>> attributes;
  std::string text;  ///< of a style element
  std::size_t line = 0;
  std::vector<std::uint32_t> children;

  /// Returns the value of an attribute, or nullptr where there is none.
  [[nodiscard]] const std::string* attribute(std::string_view key) const noexcept;
};

struct SvgDocument {
  std::vector<SvgElement> elements;  ///< in file order; the first is the root
  /// Elements by id; of two with one id, the first.
  std::map<std::string, std::uint32_t> ids;

  [[nodiscard]] const SvgElement* by_id(const std::string& id) const;
};

/// Step 1 of docs/design/svg.md: reads XML with libexpat. Entities that the file declares itself count, as
/// long as they hold no others. No other file is opened. Fails with the sentence of parse_svg.
[[nodiscard]] Result<SvgDocument> read_svg_document(std::string_view bytes, const std::string& name);

}  // namespace lekalo::io::detail
