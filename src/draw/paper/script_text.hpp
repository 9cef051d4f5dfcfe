#pragma once

#include <string>
#include <string_view>

#include "scene.hpp"

namespace lekalo::draw {

/// Texts of pages of HTML.

/// JSON that may stand in a script: no tag ends or begins in it, whatever the text says.
[[nodiscard]] std::string script_string(std::string_view text);
/// A colour as JSON, "#rrggbb".
[[nodiscard]] std::string script_colour(Colour colour);
/// Puts a text in the place of the first one that is there.
void put_text(std::string& page, std::string_view place, std::string_view text);

}  // namespace lekalo::draw
