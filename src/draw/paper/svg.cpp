#include <fmt/core.h>

#include <cmath>
#include <iterator>

#include "base64.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/io/text/words.hpp"
#include "printed_number.hpp"
#include "scene.hpp"

namespace lekalo::draw {
namespace {

/// Writes thousandths of a millimetre of paper, without trailing zeros.
std::string number(double value) {
  std::string text = fmt::format("{:.3f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string hex(Colour c) { return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue); }

std::string path_data(const std::vector<geom::Ring>& lines, bool closed) {
  std::string data;
  for (const geom::Ring& line : lines) {
    ask(1 + line.size());
    for (std::size_t i = 0; i < line.size(); ++i) {
      data += i == 0 ? "M" : "L";
      data += number(line[i].x) + " " + number(line[i].y);
    }
    if (closed && !line.empty()) data += "Z";
  }
  return data;
}

std::string paint_attributes(const Paint& paint) {
  std::string text = paint.fill_alpha > 0 ? fmt::format(" fill=\"{}\"", hex(paint.fill)) : " fill=\"none\"";
  if (paint.fill_alpha > 0 && paint.fill_alpha < 1) {
    text += fmt::format(" fill-opacity=\"{}\"", number(paint.fill_alpha));
  }
  if (!(paint.width > 0)) return text;
  text += fmt::format(" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"", hex(paint.stroke),
                      number(paint.width));
  if (paint.round) text += " stroke-linecap=\"round\"";
  if (paint.dash > 0) text += fmt::format(" stroke-dasharray=\"{0} {0}\"", number(paint.dash));
  return text;
}

class Writer {
 public:
  explicit Writer(const Scene& scene) {
    text_ = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}mm\" height=\"{1}mm\" viewBox=\"0 0 {0} {1}\" "
        "role=\"img\" font-family=\"sans-serif\">\n<title>{2}</title>\n<desc>{3}</desc>\n",
        number(scene.width), number(scene.height), io::xml_text(scene.title),
        io::xml_text(scene.description));
    for (const Item& item : scene.items) {
      std::visit([this](const auto& one) { write(one); }, item);
    }
    text_ += "</svg>\n";
  }
  [[nodiscard]] std::string take() && { return std::move(text_); }

 private:
  void write(const PathItem& item) {
    element("path",
            fmt::format(" d=\"{}\"{}", path_data(item.lines, item.closed), paint_attributes(item.paint)),
            item.meaning);
  }
  void write(const DotItem& item) {
    element("circle",
            fmt::format(" cx=\"{}\" cy=\"{}\" r=\"{}\"{}", number(item.centre.x), number(item.centre.y),
                        number(item.radius), paint_attributes(item.paint)),
            item.meaning);
  }
  void write(const TextItem& item) {
    text_ += "<text" + of_kind(item.meaning) +
             fmt::format(" x=\"{}\" y=\"{}\" font-size=\"{}\" fill=\"{}\"", number(item.at.x),
                         number(item.at.y), number(item.size), hex(item.colour));
    if (item.anchor == Anchor::middle) text_ += " text-anchor=\"middle\"";
    if (item.anchor == Anchor::end) text_ += " text-anchor=\"end\"";
    if (item.bold) text_ += " font-weight=\"bold\"";
    text_ += ">" + title(item.meaning) + io::xml_text(item.text) + "</text>\n";
  }
  void write(const ImageItem& item) {
    element("image",
            fmt::format(" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" "
                        "href=\"data:image/png;base64,{}\"",
                        number(item.at.x), number(item.at.y), number(item.width), number(item.height),
                        base64(pixels_png(item.pixels))),
            item.meaning);
  }
  void write(const ClipBegin& item) {
    text_ += fmt::format(
        "<clipPath id=\"clip{0}\"><path d=\"{1}\"/></clipPath>\n<g clip-path=\"url(#clip{0})\">\n", clips_,
        path_data(item.lines, true));
    ++clips_;
  }
  void write(const ClipEnd&) { text_ += "</g>\n"; }

  static std::string of_kind(const Meaning& meaning) {
    return meaning.kind.empty() ? "" : fmt::format(" class=\"{}\"", io::xml_text(meaning.kind));
  }
  static std::string title(const Meaning& meaning) {
    return meaning.title.empty() ? "" : fmt::format("<title>{}</title>", io::xml_text(meaning.title));
  }
  void element(const char* name, const std::string& attributes, const Meaning& meaning) {
    text_ += fmt::format("<{}{}{}", name, of_kind(meaning), attributes);
    text_ += meaning.title.empty() ? "/>\n" : fmt::format(">{}</{}>\n", title(meaning), name);
  }

  std::string text_;
  int clips_ = 0;
};

}  // namespace

std::string scene_svg(const Scene& scene) { return Writer(scene).take(); }

}  // namespace lekalo::draw
