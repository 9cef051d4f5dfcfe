#include "refusal.hpp"

#include <utility>

namespace lekalo::io {

namespace {

using namespace std::string_view_literals;

/// How files of other kinds begin, and what they are, with the way out.
constexpr std::pair<std::string_view, const char*> kOtherFiles[] = {
    {"AutoCAD Binary DXF"sv, "this is a binary DXF; save it as ASCII DXF (R2000 or later)"},
    {"%PDF-"sv,
     "this is a PDF; open it in a drawing program (Inkscape, for instance) and save it as SVG or DXF"},
    {"%!PS"sv,
     "this is PostScript; open it in a drawing program (Inkscape, for instance) and save it as SVG or DXF"},
    {"\xc5\xd0\xd3\xc6"sv,
     "this is EPS; open it in a drawing program (Inkscape, for instance) and save it as SVG or DXF"},
    {"\x1f\x8b"sv, "this file is compressed by gzip; unpack it first: gunzip, or 7-Zip"},
    {"PK\x03\x04"sv, "this is a ZIP archive; unpack it first, and give the drawing in it"},
    {"ISO-10303-21"sv,
     "this is a STEP model; export the outlines or a face of it as DXF from the CAD program"},
    {"\x89PNG"sv,
     "this is a PNG image, which has no outlines; trace it (Inkscape: Path, Trace Bitmap) and save it as "
     "SVG"},
    {"\xff\xd8\xff"sv,
     "this is a JPEG image, which has no outlines; trace it (Inkscape: Path, Trace Bitmap) and save it as "
     "SVG"},
    {"GIF8"sv,
     "this is a GIF image, which has no outlines; trace it (Inkscape: Path, Trace Bitmap) and save it as "
     "SVG"},
    {"II*\0"sv,
     "this is a TIFF image, which has no outlines; trace it (Inkscape: Path, Trace Bitmap) and save it as "
     "SVG"},
    {"MM\0*"sv,
     "this is a TIFF image, which has no outlines; trace it (Inkscape: Path, Trace Bitmap) and save it as "
     "SVG"},
    {"\xd0\xcf\x11\xe0"sv, "this is a document of an office or CAD program; save its drawing as DXF or SVG"},
    {"glTF"sv, "this is a glTF model; export the outlines of it as DXF"},
};

}  // namespace

std::string wrong_encoding(std::string_view bytes) {
  for (const auto& [begin, sentence] : kOtherFiles)
    if (bytes.starts_with(begin)) return sentence;
  const bool dwg = bytes.size() >= 6 && bytes.starts_with("AC10"sv) && bytes[4] >= '0' && bytes[4] <= '9' &&
                   bytes[5] >= '0' && bytes[5] <= '9' && (bytes.size() == 6 || bytes[6] == '\0');
  if (dwg) return "this is a DWG drawing; save it as ASCII DXF (R2000 or later)";
  const bool bitmap = bytes.size() > 26 && bytes.starts_with("BM"sv) && bytes.substr(6, 4) == "\0\0\0\0"sv;
  if (bitmap)
    return "this is a BMP image, which has no outlines; trace it (Inkscape: Path, Trace Bitmap) and save it "
           "as SVG";
  return wrong_characters(bytes);
}

std::string wrong_characters(std::string_view bytes) {
  const bool zero_first = bytes.size() >= 4 && bytes[0] == '\0' && bytes[2] == '\0';
  const bool zero_second = bytes.size() >= 4 && bytes[1] == '\0' && bytes[3] == '\0';
  if (bytes.starts_with("\xff\xfe"sv) || bytes.starts_with("\xfe\xff"sv) || zero_first || zero_second) {
    return "this is text in UTF-16; save it as UTF-8 (or plain ASCII)";
  }
  if (bytes.find('\0') != std::string_view::npos) return "this is not a text file, it holds zero bytes";
  return {};
}

Result<LengthUnit> agree_on_unit(const std::string& name, std::optional<LengthUnit> file_says,
                                 const std::string& where, std::optional<LengthUnit> user_says) {
  const auto word = [](LengthUnit unit) { return unit == LengthUnit::inch ? "inch" : "mm"; };
  if (file_says && user_says && *file_says != *user_says) {
    return refuse(name, fmt::format("{} says {}, but {} was asked for; leave --units out or correct the file",
                                    where, word(*file_says), word(*user_says)));
  }
  return file_says ? *file_says : user_says.value_or(LengthUnit::millimetre);
}

}  // namespace lekalo::io
