#include "io_drawing_check.hpp"
#include "lekalo/io/svg/svg.hpp"

// parse_svg on any bytes: a sentence, or a sound drawing. Bytes that do not begin as XML are lines of
// attributes, in a document around them: random bytes hardly ever are XML.

namespace {

std::string quoted(std::string_view text) {
  std::string out;
  for (const char c : text)
    if (c != '<' && c != '&' && c != '"' && static_cast<unsigned char>(c) < 0x80) out += c;
  return out;
}

std::string document_around(std::string_view bytes) {
  std::string lines[6];
  for (std::string& line : lines) {
    const std::size_t end = std::min(bytes.find('\n'), bytes.size());
    line = quoted(bytes.substr(0, end));
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
  }
  const auto& [path, transform, view_box, size, points, style] = lines;
  return "<svg viewBox=\"" + view_box + "\" width=\"" + size + "\" preserveAspectRatio=\"" + style +
         "\"><style>" + style + "</style><g transform=\"" + transform + "\"><path id=\"a\" d=\"" + path +
         "\"/><polygon points=\"" + points + "\"/><rect x=\"1\" width=\"" + size + "\" height=\"3\" rx=\"" +
         size + "\"/><ellipse rx=\"" + size + "\" ry=\"2\"/><use href=\"#a\" transform=\"" + transform +
         "\" style=\"" + style + "\"/></g></svg>";
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lekalo;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto unit = size % 3 == 0 ? std::optional(LengthUnit::inch) : std::nullopt;
  const bool is_xml = size > 0 && (bytes[0] == '<' || bytes[0] == '\xef' || bytes[0] == '\xff');
  const auto drawing = is_xml ? io::parse_svg(bytes, "fuzz.svg", unit)
                              : io::parse_svg(document_around(bytes), "fuzz.svg", unit);
  if (drawing) {
    fuzz::check_drawing(*drawing);
  } else {
    fuzz::check_sentence(drawing.error(), "fuzz.svg");
  }
  return 0;
}
