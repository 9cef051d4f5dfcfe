#include "lekalo/io/solid/solid_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "io/text/refusal.hpp"
#include "io/text/rows.hpp"
#include "solid_builder.hpp"
#include "text_words.hpp"

namespace lekalo::io {
namespace {

/// In the order in which they are asked; points are what is left.
constexpr std::array<SolidFormat, 5> kSolidFormats{{{&kThreeMfFormat, is_three_mf, read_three_mf},
                                                    {&kPlyFormat, is_ply, read_ply},
                                                    {&kStlFormat, is_stl, read_stl},
                                                    {&kObjFormat, is_obj, read_obj},
                                                    {&kPointsFormat, is_points, read_points}}};

using namespace std::string_view_literals;

/// How files of solids of other kinds begin, and what they are.
constexpr std::pair<std::string_view, const char*> kOtherSolids[] = {
    {"glTF"sv, "this is a glTF model"},
    {"Kaydara FBX"sv, "this is an FBX model"},
    {"# vtk DataFile"sv, "this is a VTK file"},
    {"#VRML"sv, "this is a VRML model"},
    {"OFF"sv, "this is an OFF model"},
    {"COFF"sv, "this is an OFF model"},
    {"DBRep_DrawableShape"sv, "this is a BREP model"},
    {"# .PCD"sv, "these are points in PCD"},
    {"ASTM-E57"sv, "these are points in E57"},
    {"LASF"sv, "these are points in LAS"},
    {"<?xml"sv, "this is XML (AMF, COLLADA or X3D)"},
};

/// IGES has lines of 80 characters, the last eight of which say section and number.
bool is_iges(std::string_view bytes) {
  const std::string_view line = bytes.substr(0, bytes.find_first_of("\r\n"));
  return line.size() == 80 && line[72] == 'S' &&
         line.substr(73).find_first_not_of(" 0123456789") == std::string_view::npos && line[79] == '1';
}

/// Says what a file is that has another kind of solid in it, and the way out; empty for anything else.
std::string other_kind(std::string_view bytes) {
  if (bytes.starts_with("\x1f\x8b"sv))
    return "this file is compressed by gzip; unpack it first: gunzip, or 7-Zip";
  if (bytes.starts_with("ISO-10303-21"sv))
    return "this is a STEP model; make a mesh of it that says how far it is from the model at most: "
           "lekalo-step FILE -o FILE.ply (tools/setup.sh --step installs what that program needs)";
  if (bytes.starts_with("PK\x03\x04"sv) && !is_three_mf(bytes))
    return "this is a ZIP archive; unpack it first, and give the model in it";
  const auto export_it = [](std::string_view what) {
    return fmt::format("{}; export it as STL, PLY or OBJ from the program that it comes from", what);
  };
  for (const auto& [begin, what] : kOtherSolids)
    if (bytes.starts_with(begin)) return export_it(what);
  return is_iges(bytes) ? export_it("this is an IGES model") : std::string();
}

const SolidFormat* format_by_content(std::string_view bytes) {
  // The header of a binary STL may begin as anything, but that its length fits is no chance.
  if (!has_stl_length(bytes) && !other_kind(bytes).empty()) return nullptr;
  for (const SolidFormat& format : kSolidFormats)
    if (format.begins_so(bytes)) return &format;
  return nullptr;
}

/// Says which unit the sizes of a file suggest that is read as mm.
std::string suggestion(const std::vector<solid::Vector>& vertices) {
  constexpr double kSheetOfFeet = 120, kSmallestOfMillimetres = 2;
  bool on_32nds = true, off_halves = false;
  for (const solid::Vector& p : vertices)
    for (const double c : {p.x, p.y, p.z}) {
      on_32nds = on_32nds && c * 32 == std::round(c * 32);
      off_halves = off_halves || c * 2 != std::round(c * 2);
    }
  const solid::Box box = solid::box_of(vertices);
  const solid::Vector size = box.high - box.low;
  const double reach = std::max({size.x, size.y, size.z});
  if (reach <= 0) return {};
  if (reach < kSheetOfFeet && on_32nds && off_halves)
    return "; its sizes suggest inches: --units inch reads it so";
  if (reach < kSmallestOfMillimetres)
    return fmt::format("; it is {:.3g} mm long, and its sizes suggest metres: --units m reads it so", reach);
  return {};
}

}  // namespace

bool is_points(std::string_view bytes) {
  if (!begins_as_text(bytes)) return false;
  // Headers and comments come before the first number, if there are any.
  constexpr std::size_t kMostLines = 1000;
  TextWords words(bytes);
  for (std::size_t line = 0; line < kMostLines; ++line) {
    std::string_view row = words.rest_of_line();
    row = row.substr(0, row.find('#'));
    if (!row.empty() &&
        (row[0] == '-' || row[0] == '+' || row[0] == '.' || (row[0] >= '0' && row[0] <= '9'))) {
      std::size_t numbers = 0;
      while (!row.empty()) {
        const std::size_t end = std::min(row.find_first_of(",; \t"), row.size());
        if (end > 0 && !is_number(row.substr(0, end))) return false;
        numbers += end > 0 ? 1 : 0;
        row.remove_prefix(std::min(end + 1, row.size()));
      }
      return numbers >= 3;
    }
    if (!words.next_line()) return false;
  }
  return false;
}

Result<void> read_points(std::string_view bytes, SolidBuilder& made) {
  if (const std::string fault = wrong_characters(bytes); !fault.empty()) return refuse(made.name(), fault);
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  std::size_t count = 0;  // of the numbers on the lines before
  const auto take = [&](const TextRow& row) -> Result<void> {
    if (made.vertices() == kMostSolidVertices) return refuse_line(made.name(), row.line, too_many_vertices());
    if (count > 0 && row.count != count)
      return refuse_line(
          made.name(), row.line,
          fmt::format("{} numbers where the lines before have {}: give all touches a direction, "
                      "or none",
                      row.count, count));
    count = row.count;
    const auto vector = [&](std::size_t from) {
      return solid::Vector{row.numbers[from].value, row.numbers[from + 1].value, row.numbers[from + 2].value};
    };
    made.add_vertex(vector(0), std::max({row.numbers[0].error, row.numbers[1].error, row.numbers[2].error}));
    if (count < 6) return {};
    if (!(norm(vector(3)) > 0))
      return refuse_line(made.name(), row.line, "the direction 0 0 0 has no length, so it leads nowhere");
    made.add_direction(vector(3));
    return {};
  };
  LEKALO_CHECK(read_text_rows(bytes, made.name(), made.unit(), take, made.notices(), true));
  if (made.vertices() == 0) return refuse(made.name(), "there are no points in this file");
  return {};
}

const char* name_of(SolidUnit unit) noexcept {
  switch (unit) {
    case SolidUnit::inch:
      return "inch";
    case SolidUnit::metre:
      return "m";
    case SolidUnit::micron:
      return "micron";
    case SolidUnit::centimetre:
      return "cm";
    case SolidUnit::foot:
      return "foot";
    case SolidUnit::millimetre:
      break;
  }
  return "mm";
}

const FileFormat* solid_format_by_content(std::string_view bytes) {
  const SolidFormat* const format = format_by_content(bytes);
  return format == nullptr ? nullptr : format->file;
}

bool is_only_solid(std::string_view bytes, const std::string& name) {
  constexpr FileFormat kOthers[] = {
      {"STEP", {".step", ".stp"}}, {"IGES", {".iges", ".igs"}}, {"OFF", {".off"}}};
  if (const FileFormat* const format = solid_format_by_content(bytes))
    return format == &kStlFormat || format == &kObjFormat || format == &kThreeMfFormat;
  return kStlFormat.is_named_so(name) || kObjFormat.is_named_so(name) || kThreeMfFormat.is_named_so(name) ||
         std::any_of(std::begin(kOthers), std::end(kOthers),
                     [&](const FileFormat& other) { return other.is_named_so(name); });
}

Result<SolidFile> parse_solid(std::string_view bytes, const std::string& name, const SolidOptions& options) {
  const SolidFormat* format = format_by_content(bytes);
  if (format == nullptr) {
    if (const std::string other = other_kind(bytes); !other.empty()) return refuse(name, other);
    for (const SolidFormat& one : kSolidFormats)
      if (one.file->is_named_so(name)) format = &one;
  }
  if (format == nullptr)
    return refuse(name,
                  "this is no solid that can be read; STL, PLY, OBJ, 3MF and points in text 'x y z' are");
  SolidBuilder made(name, format->file->name, options.units);
  LEKALO_CHECK(format->read(bytes, made));
  SolidFile file = made.take();
  if (!options.units && !file.deviation && format->file != &kThreeMfFormat)
    file.notices.push_back(fmt::format("{}: the file does not say its unit; it is read as mm{}", name,
                                       suggestion(file.mesh.vertices)));
  return file;
}

}  // namespace lekalo::io
