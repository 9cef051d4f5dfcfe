#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lekalo::io {

/// Words as they are written into files and pictures: any bytes become text that XML and JSON hold.

/// The text itself where it is UTF-8, else with a U+FFFD for each piece that is not: the longest that could
/// have begun a character, or a byte.
[[nodiscard]] std::string as_utf8(std::string_view text);
/// JSON text of a string; bytes that are not UTF-8 become U+FFFD.
[[nodiscard]] std::string json_string(std::string_view text);
/// The same JSON in ASCII alone, for headers of HTTP: every other character, and DEL, as \u escapes.
[[nodiscard]] std::string ascii_json(std::string_view json);

/// The text with everything that is not UTF-8 or that XML forbids replaced by U+FFFD; line ends and tabs
/// become blanks.
[[nodiscard]] std::string clean_text(std::string_view text);
/// clean_text with & < > " ' written as XML entities.
[[nodiscard]] std::string xml_text(std::string_view text);

/// Width of the text in multiples of the font size, in a wide sans-serif (others come out narrower): an
/// estimate from above, because the font is the reader's.
[[nodiscard]] double text_width(std::string_view utf8);
/// The font size at which the text is at most `width` wide, at most `size`.
[[nodiscard]] double fitting_size(std::string_view utf8, double size, double width);
/// The text with its middle replaced by an ellipsis until it is at most `width` wide; the end keeps a little
/// more than half, because names differ in their ends.
[[nodiscard]] std::string shortened(std::string_view utf8, double width);
/// The text in lines at most `width` wide, broken at blanks, and inside words that are longer than a line.
/// What finds no room in `most_lines` >= 1 lines ends in an ellipsis.
[[nodiscard]] std::vector<std::string> wrapped(std::string_view utf8, double width, std::size_t most_lines);
/// The part of a path after the last folder.
[[nodiscard]] std::string file_name(std::string_view path);

/// The ending of a file's name in lower case, with its dot; empty without.
[[nodiscard]] std::string ending_of(const std::string& name);

/// The last name of a path without its ending; a name that only begins with a dot has none.
[[nodiscard]] std::string stem_of(const std::string& path);

}  // namespace lekalo::io
