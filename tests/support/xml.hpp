#pragma once

#include <cctype>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// A small strict XML reader for tests: elements, attributes, text, the five entities and numbers; no DTD, no
/// comments, no CDATA. Throws std::runtime_error with the place of the first fault.
namespace lekalo::test {

struct XmlElement {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;                ///< directly inside, without that of children
  std::vector<std::size_t> below;  ///< children, indices into XmlDocument::elements
  std::size_t depth = 0;

  [[nodiscard]] std::string operator[](const std::string& attribute) const {
    const auto found = attributes.find(attribute);
    return found == attributes.end() ? "" : found->second;
  }
};

class XmlDocument {
 public:
  explicit XmlDocument(std::string_view source) : source_(source) {
    if (source_.substr(0, 5) == "<?xml") at_ = source_.find("?>") + 2;
    blanks();
    element(0);
    blanks();
    if (at_ != source_.size()) fail("something follows the root element");
  }
  /// In document order; the first is the root.
  std::vector<XmlElement> elements;

  [[nodiscard]] std::vector<XmlElement> of(const std::string& name, const std::string& kind = "") const {
    std::vector<XmlElement> found;
    for (const XmlElement& e : elements) {
      if (e.name == name && (kind.empty() || e["class"] == kind)) found.push_back(e);
    }
    return found;
  }
  /// Text of the first element of this name below `parent`, "" when there is none.
  [[nodiscard]] std::string child_text(const XmlElement& parent, const std::string& name) const {
    for (const std::size_t child : parent.below) {
      if (elements[child].name == name) return elements[child].text;
    }
    return "";
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw std::runtime_error("XML, byte " + std::to_string(at_) + ": " + why);
  }
  [[nodiscard]] char peek() const {
    if (at_ >= source_.size()) fail("the text ends");
    return source_[at_];
  }
  void expect(char c) {
    if (peek() != c) fail(std::string("expected ") + c);
    ++at_;
  }
  void blanks() {
    while (at_ < source_.size() && std::isspace(static_cast<unsigned char>(source_[at_])) != 0) ++at_;
  }
  std::string name() {
    std::string text;
    while (std::isalnum(static_cast<unsigned char>(peek())) != 0 || peek() == '-' || peek() == ':') {
      text += source_[at_++];
    }
    if (text.empty()) fail("expected a name");
    return text;
  }
  std::string character() {
    const auto byte = static_cast<unsigned char>(peek());
    if (byte < 0x20 && byte != '\n' && byte != '\t' && byte != '\r') fail("a control character");
    if (byte != '&') return std::string(1, source_[at_++]);
    const std::size_t end = source_.find(';', at_);
    if (end == std::string_view::npos) fail("an entity without end");
    const std::string_view entity = source_.substr(at_ + 1, end - at_ - 1);
    static const std::map<std::string_view, std::string> kKnown{{"amp", "&"},   {"lt", "<"},   {"gt", ">"},
                                                                {"quot", "\""}, {"apos", "'"}, {"#39", "'"}};
    const auto found = kKnown.find(entity);
    if (found == kKnown.end()) fail("an unknown entity");
    at_ = end + 1;
    return found->second;
  }
  void element(std::size_t depth) {
    expect('<');
    const std::size_t self = elements.size();
    elements.push_back({name(), {}, "", {}, depth});
    for (blanks(); peek() != '>' && peek() != '/'; blanks()) attribute(self);
    if (peek() == '/') {
      ++at_;
      expect('>');
      return;
    }
    expect('>');
    while (true) {
      if (peek() != '<') {
        elements[self].text += character();
      } else if (source_.substr(at_, 2) == "</") {
        at_ += 2;
        if (name() != elements[self].name) fail("the end does not match <" + elements[self].name + ">");
        expect('>');
        return;
      } else {
        elements[self].below.push_back(elements.size());
        element(depth + 1);
      }
    }
  }
  void attribute(std::size_t self) {
    const std::string key = name();
    expect('=');
    expect('"');
    std::string value;
    while (peek() != '"') {
      if (peek() == '<') fail("< in an attribute");
      value += character();
    }
    expect('"');
    if (!elements[self].attributes.emplace(key, value).second) fail("attribute " + key + " twice");
  }

  std::string_view source_;
  std::size_t at_ = 0;
};

}  // namespace lekalo::test
