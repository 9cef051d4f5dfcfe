#include "document.hpp"

#include <expat.h>
#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <memory>

#include "io/text/decimal.hpp"
#include "lekalo/base/stop.hpp"

namespace lekalo::io::detail {
namespace {

constexpr char kSeparator = '|';
constexpr std::string_view kSvg = "http://www.w3.org/2000/svg";
constexpr std::pair<std::string_view, std::string_view> kPrefixes[] = {
    {"http://www.inkscape.org/namespaces/inkscape", "inkscape:"},
    {"http://www.w3.org/1999/xlink", "xlink:"},
};
/// The most elements within each other; groups and uses that draw have a smaller limit of their own.
constexpr std::size_t kDeepestXml = 512;
/// The most characters of an entity, because programs abbreviate addresses with entities. Expat stops by
/// itself where entities make the file a hundred times larger.
constexpr int kLongestEntity = 4096;

struct QualifiedName {
  std::string_view space, local;
};
QualifiedName split(const char* text) {
  const std::string_view all(text);
  const std::size_t at = all.rfind(kSeparator);
  if (at == std::string_view::npos) return {{}, all};
  return {all.substr(0, at), all.substr(at + 1)};
}

class Builder {
 public:
  Builder(XML_Parser parser, std::string name) : parser_(parser), name_(std::move(name)) {
    XML_SetUserData(parser, this);
    XML_SetElementHandler(parser, &Builder::start, &Builder::end);
    XML_SetCharacterDataHandler(parser, &Builder::characters);
    XML_SetEntityDeclHandler(parser, &Builder::entity);
  }

  SvgDocument document;
  /// The sentence, if we stopped the parser.
  std::string refused;

 private:
  static Builder& self(void* user) { return *static_cast<Builder*>(user); }

  static void XMLCALL start(void* user, const XML_Char* name, const XML_Char** attributes) {
    self(user).start_element(name, attributes);
  }
  static void XMLCALL end(void* user, const XML_Char*) { self(user).end_element(); }
  static void XMLCALL characters(void* user, const XML_Char* text, int length) {
    Builder& b = self(user);
    if (b.skipping_ > 0 || b.open_.empty()) return;
    SvgElement& element = b.document.elements[b.open_.back()];
    if (element.name == "style") element.text.append(text, static_cast<std::size_t>(length));
  }
  static void XMLCALL entity(void* user, const XML_Char* name, int, const XML_Char* value, int length,
                             const XML_Char*, const XML_Char*, const XML_Char*, const XML_Char*) {
    // The entity is that of another file, which is never opened.
    if (value == nullptr) return;
    const bool nested =
        std::string_view(value, static_cast<std::size_t>(length)).find('&') != std::string_view::npos;
    if (!nested && length <= kLongestEntity) return;
    self(user).stop(fmt::format("the entity {} {}; save the drawing without it", excerpt(name),
                                nested ? "holds other entities" : "is very long"));
  }

  void stop(const std::string& why) {
    if (!refused.empty()) return;
    refused = fmt::format("{}, line {}: {}", name_, XML_GetCurrentLineNumber(parser_), why);
    XML_StopParser(parser_, XML_FALSE);
  }

  void start_element(const XML_Char* name, const XML_Char** attributes) {
    if (!refused.empty()) return;
    if (++depth_ > kDeepestXml)
      return stop(fmt::format("elements are nested more than {} deep", kDeepestXml));
    if (skipping_ > 0) {
      ++skipping_;
      return;
    }
    const QualifiedName qualified = split(name);
    const bool is_root = document.elements.empty();
    if (is_root && qualified.local != "svg")
      return stop(
          fmt::format("this is XML, but no SVG: its root is {}, not 'svg'", excerpt(qualified.local)));
    // Some programs declare no namespace, so the root's is taken.
    if (is_root) space_ = qualified.space;
    if (is_root && !space_.empty() && space_ != kSvg)
      return stop(fmt::format("this is no SVG: its namespace is {}", excerpt(space_)));
    if (qualified.space != space_) {
      skipping_ = 1;
      return;
    }
    SvgElement element;
    element.name = qualified.local;
    element.line = XML_GetCurrentLineNumber(parser_);
    for (; *attributes != nullptr; attributes += 2) add_attribute(element, attributes[0], attributes[1]);
    const auto index = static_cast<std::uint32_t>(document.elements.size());
    if (const std::string* id = element.attribute("id")) document.ids.emplace(*id, index);
    if (!open_.empty()) document.elements[open_.back()].children.push_back(index);
    document.elements.push_back(std::move(element));
    open_.push_back(index);
  }

  static void add_attribute(SvgElement& element, const XML_Char* name, const XML_Char* value) {
    const QualifiedName qualified = split(name);
    if (qualified.space.empty()) {
      element.attributes.emplace_back(qualified.local, value);
      return;
    }
    for (const auto& [space, prefix] : kPrefixes)
      if (qualified.space == space)
        element.attributes.emplace_back(std::string(prefix) + std::string(qualified.local), value);
  }

  void end_element() {
    --depth_;
    if (skipping_ > 0) {
      --skipping_;
    } else if (!open_.empty()) {
      open_.pop_back();
    }
  }

  XML_Parser parser_;
  std::string name_, space_;
  std::vector<std::uint32_t> open_;
  std::size_t depth_ = 0, skipping_ = 0;
};

}  // namespace

const std::string* SvgElement::attribute(std::string_view key) const noexcept {
  for (const auto& [name_of, value] : attributes)
    if (name_of == key) return &value;
  return nullptr;
}

const SvgElement* SvgDocument::by_id(const std::string& id) const {
  const auto found = ids.find(id);
  return found == ids.end() ? nullptr : &elements[found->second];
}

/// Step 1 of docs/design/svg.md.
Result<SvgDocument> read_svg_document(std::string_view bytes, const std::string& name) {
  const auto refuse = [&](const std::string& why) {
    return failure(ErrorCode::bad_input, fmt::format("{}: {}", name, why));
  };
  if (bytes.empty()) return refuse("the file is empty");
  if (bytes.starts_with("\x1f\x8b"))
    return refuse("this SVG is compressed (.svgz); unpack it with gunzip first");
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(
      XML_ParserCreateNS(nullptr, kSeparator), &XML_ParserFree);
  const auto no_memory = [] { return failure(ErrorCode::environment, "out of memory for the XML parser"); };
  if (parser == nullptr) return no_memory();
  // The seed of expat's hash tables may be any number, because nothing depends on their order.
  XML_SetHashSalt(parser.get(), 1);
  Builder builder(parser.get(), name);
  // The text is given to expat in chunks, because expat counts in int.
  constexpr std::size_t kChunk = std::size_t{1} << 16;
  for (std::size_t at = 0;; at += kChunk) {
    ask(1024);
    const std::string_view chunk = bytes.substr(at, kChunk);
    const bool last = at + chunk.size() == bytes.size();
    const XML_Status status =
        XML_Parse(parser.get(), chunk.data(), static_cast<int>(chunk.size()), last ? 1 : 0);
    if (!builder.refused.empty()) return failure(ErrorCode::bad_input, builder.refused);
    if (status != XML_STATUS_OK) {
      if (XML_GetErrorCode(parser.get()) == XML_ERROR_NO_MEMORY) return no_memory();
      return failure(ErrorCode::bad_input,
                     fmt::format("{}, line {}: this is not well-formed XML from here on ({})", name,
                                 XML_GetCurrentLineNumber(parser.get()),
                                 XML_ErrorString(XML_GetErrorCode(parser.get()))));
    }
    if (last) break;
  }
  return std::move(builder.document);
}

}  // namespace lekalo::io::detail
