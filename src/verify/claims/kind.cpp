#include <algorithm>
#include <array>
#include <utility>

#include "lekalo/verify/claims.hpp"
#include "verify/read/json.hpp"

namespace lekalo::verify {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

std::string_view without_blanks(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(kBlanks);
  return first == std::string_view::npos ? std::string_view() : text.substr(first);
}

/// Returns the value of a member, with no text where it is not there or there twice.
Json member(Json object, std::string_view key) {
  Json found;
  if (!object.is_object() || !find_members(object, {&key, 1}, {&found, 1})) return {};
  return found;
}

Result<Kind> kind_of_json(const Document& document) {
  LEKALO_TRY(const Json root, parse_json(document.bytes, document.name));
  const Json format = member(root, "format");
  if (format.is_string()) return json_text(format) == "lekalo-layout/1" ? Kind::layout : Kind::unknown;
  if (format.text.empty())
    return member(root, "placements").is_array() && !member(root, "strip_height").text.empty()
               ? Kind::placements
               : Kind::unknown;
  const Json name = member(format, "name");
  if (!name.is_string()) return Kind::unknown;
  constexpr std::array<std::pair<std::string_view, Kind>, 13> kFormats{
      {{"lekalo-locate", Kind::placement},
       {"lekalo-nest", Kind::nest_report},
       {"lekalo-order", Kind::order_report},
       {"lekalo-check", Kind::check_report},
       {"lekalo-show", Kind::show_report},
       {"lekalo-pocket", Kind::pocket_report},
       {"lekalo-simulate", Kind::simulate_report},
       {"lekalo-fit", Kind::fit_report},
       {"lekalo-heat", Kind::heat_report},
       {"lekalo-quote", Kind::quote_report},
       {"lekalo-verify", Kind::verify_report},
       {"lekalo-stock", Kind::stock_book},
       {"lekalo-certificate", Kind::certificate}}};
  const std::string text = json_text(name);
  const auto* const known =
      std::find_if(kFormats.begin(), kFormats.end(), [&](const auto& f) { return f.first == text; });
  return known == kFormats.end() ? Kind::unknown : known->second;
}

/// Returns the line without blanks around it, and takes it off the text.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  std::string_view line = without_blanks(text.substr(0, end));
  line = line.substr(0, line.find_last_not_of(kBlanks) + 1);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

/// DXF begins with a section, after comments.
bool is_dxf(std::string_view text) {
  for (;;) {
    const std::string_view code = take_line(text), value = take_line(text);
    if (code == "999") continue;
    return code == "0" && value == "SECTION";
  }
}

/// A program begins with the tape's mark, a comment or a word, after empty lines.
bool is_program(std::string_view text) {
  const char first = text.front();
  if (first == '%' || first == '(' || first == ';') return true;
  if (std::string_view("GMNOTSFXYZIJgmnotsfxyzij").find(first) == std::string_view::npos) return false;
  text.remove_prefix(1);
  const std::size_t number = text.find_first_of("+-.0123456789");
  return number != std::string_view::npos && number == text.find_first_not_of(" \t");
}

/// Drawings have layers, which pictures lack.
Kind kind_of_markup(std::string_view text) {
  constexpr std::size_t kHead = 65536;
  const std::string_view head = text.substr(0, kHead);
  const bool svg = head.find("<svg") != std::string_view::npos;
  if (svg && text.find("inkscape:groupmode=\"layer\"") != std::string_view::npos) return Kind::svg;
  return svg || head.find("<html") != std::string_view::npos ? Kind::picture : Kind::unknown;
}

}  // namespace

Result<Kind> kind_of(const Document& document) {
  const std::string_view bytes = document.bytes;
  if (bytes.starts_with("\x89PNG") || bytes.starts_with("%PDF")) return Kind::picture;
  const std::string_view text = without_blanks(bytes);
  if (text.empty()) return Kind::unknown;
  if (text.front() == '{' || text.front() == '[') return kind_of_json(document);
  if (text.front() == '<') return kind_of_markup(text);
  if (text.starts_with("IN;")) return Kind::hpgl;
  if (is_dxf(text)) return Kind::dxf;
  return is_program(text) ? Kind::program : Kind::unknown;
}

std::string_view name_of(Kind kind) noexcept {
  constexpr std::array<std::string_view, 21> kNames{
      "a placement",           "a layout",          "placements on a strip", "a report of nest",
      "a report of an order",  "a report of check", "a report of show",      "a report of pocket",
      "a report of simulate",  "a result of fit",   "a result of heat",      "a quote",
      "a report of verify",    "a stock",           "a certificate",         "an NC program",
      "a DXF drawing",         "an SVG drawing",    "an HPGL plot",          "a picture",
      "none of lekalo's files"};
  return kNames[static_cast<std::size_t>(kind)];
}

}  // namespace lekalo::verify
