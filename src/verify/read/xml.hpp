#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/verify/verify.hpp"

namespace lekalo::verify {

/// An element of a small XML document: enough for drawings. Names keep their prefix, but for `svg:`.
struct XmlElement {
  std::string name, text;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<XmlElement> children;

  [[nodiscard]] std::string_view get(std::string_view key) const {
    for (const auto& [name_of, value] : attributes)
      if (name_of == key) return value;
    return {};
  }
};

/// Takes the elements of a document in their order.
class XmlTaker {
 public:
  virtual ~XmlTaker() = default;
  /// An element begins, with its name and attributes alone.
  virtual void begin(XmlElement element) = 0;
  /// Text of the element that is open.
  virtual void text(std::string_view) {}
  virtual void end() = 0;
};

/// Hands over the elements of a document as parse_xml reads it, up to a fault.
[[nodiscard]] Result<void> read_xml(const Document& document, XmlTaker& taker);

/// Reads UTF-8 with the five entities of XML and numbers of characters. bad_input for all else, entities of a
/// document's own among it, and for elements nested deeper than 600.
[[nodiscard]] Result<XmlElement> parse_xml(const Document& document);

}  // namespace lekalo::verify
