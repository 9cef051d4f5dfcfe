#include "script_text.hpp"

#include <fmt/core.h>

#include "lekalo/io/text/words.hpp"

namespace lekalo::draw {

std::string script_string(std::string_view text) {
  std::string json;
  for (const char c : io::json_string(text)) json += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return json;
}

std::string script_colour(Colour c) { return fmt::format("\"#{:02x}{:02x}{:02x}\"", c.red, c.green, c.blue); }

void put_text(std::string& page, std::string_view place, std::string_view text) {
  page.replace(page.find(place), place.size(), text);
}

}  // namespace lekalo::draw
