#include "xml.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <system_error>
#include <utility>

#include "lekalo/base/stop.hpp"

namespace lekalo::verify {
namespace {

constexpr std::size_t kDeepestElement = 600;

bool is_white(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

class XmlReader {
 public:
  XmlReader(std::string_view text, XmlTaker& taker) : text_(text), taker_(taker) {
    if (text_.substr(0, 3) == "\xEF\xBB\xBF") text_.remove_prefix(3);
  }

  /// Returns whether there is a root and it ends.
  bool read() {
    while (at_ < text_.size()) {
      ask();
      if (text_[at_] != '<') {
        const std::size_t end = std::min(text_.find('<', at_), text_.size());
        if (!open_.empty()) taker_.text(resolved(text_.substr(at_, end - at_)));
        if (!good_) return false;
        at_ = end;
      } else if (begins("<!--")) {
        skip_to("-->");
      } else if (begins("<![CDATA[")) {
        const std::size_t begin = at_ + 9;
        skip_to("]]>");
        if (good_ && !open_.empty()) taker_.text(text_.substr(begin, at_ - 3 - begin));
      } else if (begins("<?")) {
        skip_to("?>");
      } else if (begins("<!")) {
        skip_declaration();
      } else if (begins("</")) {
        at_ += 2;
        if (open_.empty() || name() != open_.back()) return false;
        skip_blanks();
        if (!take('>')) return false;
        if (end_is_last()) return true;
      } else {
        ++at_;
        if (open_.size() == kDeepestElement) return false;
        XmlElement element;
        const bool empty = read_tag(element);
        if (!good_) return false;
        open_.push_back(element.name);
        taker_.begin(std::move(element));
        if (empty && end_is_last()) return true;
      }
    }
    return false;
  }

 private:
  /// Closes the element that is open; the root is the last.
  bool end_is_last() {
    taker_.end();
    open_.pop_back();
    return open_.empty();
  }
  [[nodiscard]] bool begins(std::string_view with) const { return text_.substr(at_, with.size()) == with; }
  void skip_to(std::string_view end) {
    const std::size_t found = text_.find(end, at_);
    good_ = found != std::string_view::npos;
    at_ = good_ ? found + end.size() : text_.size();
  }
  /// A document type may not declare anything of its own.
  void skip_declaration() {
    const std::size_t end = text_.find('>', at_);
    good_ = end != std::string_view::npos && text_.substr(at_, end - at_).find('[') == std::string_view::npos;
    at_ = good_ ? end + 1 : text_.size();
  }
  void skip_blanks() {
    while (at_ < text_.size() && is_white(text_[at_])) ++at_;
  }
  bool take(char c) {
    const bool there = at_ < text_.size() && text_[at_] == c;
    if (there) ++at_;
    return there;
  }
  std::string name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_white(text_[at_]) &&
           std::string_view("=/>").find(text_[at_]) == std::string_view::npos)
      ++at_;
    std::string name(text_.substr(begin, at_ - begin));
    if (name.rfind("svg:", 0) == 0) name.erase(0, 4);
    return name;
  }

  /// Returns whether the element ends with its tag.
  bool read_tag(XmlElement& element) {
    element.name = name();
    good_ = !element.name.empty();
    while (good_) {
      skip_blanks();
      if (take('>')) return false;
      if (take('/')) {
        good_ = take('>');
        return true;
      }
      std::string key = name();
      skip_blanks();
      if (key.empty() || !take('=')) return good_ = false;
      skip_blanks();
      const char quote = at_ < text_.size() ? text_[at_] : '\0';
      if (quote != '"' && quote != '\'') return good_ = false;
      const std::size_t begin = ++at_, end = text_.find(quote, begin);
      if (end == std::string_view::npos) return good_ = false;
      element.attributes.emplace_back(std::move(key), resolved(text_.substr(begin, end - begin)));
      at_ = end + 1;
    }
    return false;
  }

  /// Returns the character that a number names, or ? for one beyond ASCII: those neither draw nor name
  /// anything.
  char character(std::string_view number) {
    const bool hexadecimal = number.starts_with('x');
    if (hexadecimal) number.remove_prefix(1);
    std::uint32_t code = 0;
    const auto [end, error] =
        std::from_chars(number.data(), number.data() + number.size(), code, hexadecimal ? 16 : 10);
    good_ = good_ && !number.empty() && end == number.data() + number.size();
    return error == std::errc() && code < 128 ? static_cast<char>(code) : '?';
  }

  std::string resolved(std::string_view text) {
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
      if (text[at] != '&') {
        out += text[at++];
        continue;
      }
      const std::size_t end = text.find(';', at);
      const std::string_view word = text.substr(at + 1, end == std::string_view::npos ? 0 : end - at - 1);
      constexpr std::pair<std::string_view, char> kNamed[] = {
          {"lt", '<'}, {"gt", '>'}, {"amp", '&'}, {"quot", '"'}, {"apos", '\''}};
      const auto* const named = std::find_if(std::begin(kNamed), std::end(kNamed),
                                             [&](const auto& one) { return one.first == word; });
      if (named != std::end(kNamed)) {
        out += named->second;
      } else if (word.substr(0, 1) == "#") {
        out += character(word.substr(1));
      } else {
        good_ = false;
        return out;
      }
      at = end + 1;
    }
    return out;
  }

  std::string_view text_;
  XmlTaker& taker_;
  std::vector<std::string> open_;  ///< names
  std::size_t at_ = 0;
  bool good_ = true;
};

/// Puts the elements together.
class TreeTaker final : public XmlTaker {
 public:
  XmlElement root;

  void begin(XmlElement element) override { open_.push_back(std::move(element)); }
  void text(std::string_view text) override { open_.back().text += text; }
  void end() override {
    XmlElement done = std::move(open_.back());
    open_.pop_back();
    if (open_.empty())
      root = std::move(done);
    else
      open_.back().children.push_back(std::move(done));
  }

 private:
  std::vector<XmlElement> open_;
};

}  // namespace

Result<void> read_xml(const Document& document, XmlTaker& taker) {
  if (XmlReader(document.bytes, taker).read()) return {};
  return failure(ErrorCode::bad_input,
                 fmt::format("{}: it is no XML that is understood here", document.name));
}

Result<XmlElement> parse_xml(const Document& document) {
  TreeTaker tree;
  LEKALO_CHECK(read_xml(document, tree));
  return std::move(tree.root);
}

}  // namespace lekalo::verify
