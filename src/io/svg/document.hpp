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

/// An element of an SVG file. Those of other namespaces are not kept.
struct SvgElement {
  std::string name;  ///< without prefix
  /// Attributes: SVG's own by name, and of other namespaces the known ones with their usual prefix
  /// ("inkscape:label", "xlink:href"); others are left out.
  std::vector<std::pair<std::string, std::string>> attributes;
  std::string text;  ///< of a style element
  std::size_t line = 0;
  std::vector<std::uint32_t> children;

  /// The value of an attribute, nullptr where there is none.
  [[nodiscard]] const std::string* attribute(std::string_view key) const noexcept;
};

struct SvgDocument {
  std::vector<SvgElement> elements;          ///< in file order; the first is the root
  std::map<std::string, std::uint32_t> ids;  ///< of two elements with one id, the first

  [[nodiscard]] const SvgElement* by_id(const std::string& id) const;
};

/// Reads XML with libexpat. Entities that the file declares itself count, as long as they hold no others; no
/// other file is opened. Fails with the sentence of parse_svg.
[[nodiscard]] Result<SvgDocument> read_svg_document(std::string_view bytes, const std::string& name);

}  // namespace lekalo::io::detail
