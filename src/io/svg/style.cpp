#include "style.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>

#include "io/text/decimal.hpp"
#include "scanner.hpp"

namespace lekalo::io::detail {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n\f";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) + 1 - first);
}

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

/// Calls visit(part) for the parts between separators, blanks removed.
template <class Visit>
void split(std::string_view text, char separator, const Visit& visit) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(separator), text.size());
    if (const std::string_view part = trimmed(text.substr(0, end)); !part.empty()) visit(part);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

std::string without_comments(std::string_view text) {
  std::string out;
  while (true) {
    const std::size_t begin = text.find("/*");
    out += text.substr(0, begin);
    if (begin == std::string_view::npos) return out;
    const std::size_t end = text.find("*/", begin + 2);
    if (end == std::string_view::npos) return out;
    text.remove_prefix(end + 2);
  }
}

constexpr std::array<std::string_view, 12> kGeometry{"transform", "translate", "rotate", "scale", "d",  "x",
                                                     "y",         "cx",        "cy",     "r",     "rx", "ry"};

/// Reads the declarations between braces or of a style attribute.
struct Declarations {
  Look look;
  /// A property that moves or shapes, if there is one.
  std::string geometry;
};
Declarations declarations(std::string_view text) {
  Declarations found;
  split(text, ';', [&](std::string_view one) {
    const std::size_t colon = one.find(':');
    if (colon == std::string_view::npos) return;
    const std::string property = lower(trimmed(one.substr(0, colon)));
    std::string value = lower(trimmed(one.substr(colon + 1)));
    if (const std::size_t mark = value.find('!'); mark != std::string::npos)
      value = std::string(trimmed(std::string_view(value).substr(0, mark)));
    for (std::size_t i = 0; i < kProperties.size(); ++i)
      if (property == kProperties[i]) found.look.says[i] = value;
    const bool shapes = std::find(kGeometry.begin(), kGeometry.end(), property) != kGeometry.end();
    if (shapes && value != "none" && value != "auto") found.geometry = property;
  });
  return found;
}

/// Returns the classes of an element.
std::vector<std::string> classes_of(const SvgElement& element) {
  std::vector<std::string> classes;
  const std::string* said = element.attribute("class");
  if (said == nullptr) return classes;
  std::string blanks = *said;
  for (char& c : blanks)
    if (c == '\t' || c == '\n' || c == '\r') c = ' ';
  split(blanks, ' ', [&](std::string_view one) { classes.emplace_back(one); });
  return classes;
}

/// The letters of "#rgb" as those of "#rrggbb".
std::string in_full(std::string_view hex) {
  std::string full = "#";
  for (const char c : hex.substr(1, 3)) full += std::string(2, c);
  return full;
}

/// Reads "rgb(255, 0, 0)" or "rgb(100%, 0%, 0%)"; empty where it is neither.
std::string of_rgb_function(std::string_view paint) {
  SvgScanner scanner(paint.substr(paint.find('(') + 1));
  std::string word = "#";
  for (int channel = 0; channel < 3; ++channel) {
    auto value = scanner.number();
    if (!value) return {};
    double share = value->value;
    if (scanner.peek() == '%') share *= 2.55, scanner.advance(1);
    scanner.skip_comma();
    word += fmt::format("{:02x}", static_cast<int>(std::clamp(share, 0.0, 255.0) + 0.5));
  }
  return word;
}

}  // namespace

std::string colour_word(std::string_view paint) {
  // The colours by which laser and plotter users work have names; other names stand as they are.
  constexpr std::pair<std::string_view, const char*> kNames[] = {
      {"black", "#000000"},  {"white", "#ffffff"},   {"red", "#ff0000"},  {"lime", "#00ff00"},
      {"blue", "#0000ff"},   {"yellow", "#ffff00"},  {"cyan", "#00ffff"}, {"aqua", "#00ffff"},
      {"green", "#008000"},  {"magenta", "#ff00ff"}, {"gray", "#808080"}, {"grey", "#808080"},
      {"orange", "#ffa500"}, {"fuchsia", "#ff00ff"}};
  paint = trimmed(paint);
  if (paint.empty() || paint == "none" || paint == "transparent" || paint.starts_with("url(")) return {};
  if (paint[0] == '#' && paint.size() == 4) return in_full(paint);
  if (paint.starts_with("rgb(")) {
    std::string word = of_rgb_function(paint);
    if (!word.empty()) return word;
  }
  for (const auto& [name, rgb] : kNames)
    if (paint == name) return rgb;
  return std::string(paint);
}

StyleSheet::StyleSheet(const SvgDocument& document) {
  for (const SvgElement& element : document.elements)
    if (element.name == "style") read(without_comments(element.text), element.line);
}

void StyleSheet::read(std::string_view sheet, std::size_t line) {
  while (true) {
    const std::size_t open = sheet.find('{');
    if (open == std::string_view::npos) return;
    const std::string_view head = trimmed(sheet.substr(0, open));
    // Rules within rules (@media) are skipped as a whole.
    std::size_t end = open + 1;
    for (int depth = 1; end < sheet.size() && depth > 0; ++end)
      depth += sheet[end] == '{' ? 1 : sheet[end] == '}' ? -1 : 0;
    const std::size_t close = end > open + 1 && sheet[end - 1] == '}' ? end - 1 : end;
    const std::string_view body = sheet.substr(open + 1, close - open - 1);
    if (head.find('@') != std::string_view::npos) {
      if (body.find("display") != std::string_view::npos || body.find("visibility") != std::string_view::npos)
        notices_.push_back(fmt::format("style sheet of line {}: {} is not read", line, excerpt(head)));
    } else {
      read_rule(head, body, line);
    }
    sheet.remove_prefix(end);
  }
}

void StyleSheet::read_rule(std::string_view selectors, std::string_view body, std::size_t line) {
  const Declarations found = declarations(body);
  if (!found.geometry.empty()) {
    notices_.push_back(fmt::format("style sheet of line {}: {} of {} is not read", line, found.geometry,
                                   excerpt(selectors)));
  }
  const auto& says = found.look.says;
  if (std::all_of(says.begin(), says.end(), [](const std::string& value) { return value.empty(); })) return;
  split(selectors, ',', [&](std::string_view selector) {
    const std::string_view all = selector;
    Selector rule;
    const std::size_t end = std::min(selector.find_first_of(".#"), selector.size());
    rule.element = selector.substr(0, end);
    if (rule.element == "*") rule.element.clear();
    selector.remove_prefix(end);
    bool plain = rule.element.find_first_of(" \t\n>+~:[") == std::string::npos;
    while (plain && !selector.empty()) {
      const char mark = selector[0];
      const std::size_t stop = std::min(selector.find_first_of(".#", 1), selector.size());
      std::string& part = mark == '.' ? rule.cls : rule.id;
      plain = part.empty() && stop > 1 &&
              selector.substr(1, stop - 1).find_first_of(" \t\n>+~:[") == std::string_view::npos;
      part = selector.substr(1, stop - 1);
      selector.remove_prefix(stop);
    }
    if (!plain) {
      // Colours that are not found out take nothing away.
      if (found.look[Property::display].empty() && found.look[Property::visibility].empty()) return;
      notices_.push_back(
          fmt::format("style sheet of line {}: the selector {} is not read", line, excerpt(all)));
      return;
    }
    Rule& known = rules_[std::move(rule)];
    const std::size_t order = rules_read_++;
    for (std::size_t i = 0; i < says.size(); ++i)
      if (!says[i].empty()) known[i] = {says[i], order};
  });
}

Look StyleSheet::of(const SvgElement& element) const {
  Look all;
  for (std::size_t i = 0; i < kProperties.size(); ++i)
    if (const std::string* said = element.attribute(kProperties[i])) all.says[i] = lower(trimmed(*said));
  const std::string* id = element.attribute("id");
  std::vector<std::string> classes = classes_of(element);
  classes.emplace_back();
  // An id outweighs a class, a class the name of an element, and a later rule an earlier one.
  std::array<std::pair<int, std::size_t>, kProperties.size()> taken;
  taken.fill({-1, 0});
  const auto look = [&](const Selector& selector, int weight) {
    const auto rule = rules_.find(selector);
    if (rule == rules_.end()) return;
    for (std::size_t i = 0; i < kProperties.size(); ++i) {
      const Said& said = rule->second[i];
      const std::pair rank{weight, said.order};
      if (!said.value.empty() && rank > taken[i]) all.says[i] = said.value, taken[i] = rank;
    }
  };
  for (const std::string& cls : classes)
    for (const std::string& name : {element.name, std::string()}) {
      const int weight = (cls.empty() ? 0 : 10) + (name.empty() ? 0 : 1);
      look({name, {}, cls}, weight);
      if (id != nullptr && !id->empty()) look({name, *id, cls}, weight + 100);
    }
  if (const std::string* style = element.attribute("style")) {
    const Look said = declarations(without_comments(*style)).look;
    for (std::size_t i = 0; i < kProperties.size(); ++i)
      if (!said.says[i].empty()) all.says[i] = said.says[i];
  }
  return all;
}

std::optional<std::string> geometry_in_style(const SvgElement& element) {
  const std::string* style = element.attribute("style");
  if (style == nullptr) return std::nullopt;
  const Declarations found = declarations(without_comments(*style));
  if (found.geometry.empty()) return std::nullopt;
  return found.geometry;
}

}  // namespace lekalo::io::detail
