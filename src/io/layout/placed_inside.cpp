#include "placed_inside.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <string_view>

#include "lekalo/io/layout/layout_export.hpp"
#include "lekalo/io/text/excerpt.hpp"
#include "lekalo/layout/part_text.hpp"

namespace lekalo::io::detail {
namespace {

constexpr std::size_t kLongestLayer = 255;

bool same_ignoring_case(std::string_view a, std::string_view b) {
  const auto folded = [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return folded(x) == folded(y); });
}

}  // namespace

std::string layer_of_inside(const std::string& layer) {
  std::string name = layer;
  for (char& c : name)
    if (std::string_view("<>/\\\":;?*|,=`").find(c) != std::string_view::npos) c = '_';
  const std::size_t first = name.find_first_not_of(' ');
  name = first == std::string::npos ? "" : name.substr(first, name.find_last_not_of(' ') - first + 1);
  const bool is_own = std::any_of(std::begin(kExportLayers), std::end(kExportLayers),
                                  [&](const char* own) { return same_ignoring_case(own, name); });
  return name.empty() || name.size() > kLongestLayer || is_own ? kInsideLayer : name;
}

std::vector<geom::Contour> stroke_chains(const layout::PartText& text) {
  std::vector<geom::Contour> chains;
  for (const geom::Ring& stroke : layout::text_strokes(text)) {
    geom::Contour chain;
    for (std::size_t i = 0; i + 1 < stroke.size(); ++i)
      if (!(stroke[i] == stroke[i + 1]))
        chain.push_back({geom::EdgeKind::line, stroke[i], stroke[i + 1], {}});
    if (!chain.empty()) chains.push_back(std::move(chain));
  }
  return chains;
}

SheetMarks::SheetMarks(const SheetShapes& sheet) : layers_(sheet.parts.size()) {
  for (const PlacedShape& shape : sheet.parts) parts_.push_back({shape.placement->id, shape.region});
  for (std::size_t p = 0; p < sheet.parts.size(); ++p) {
    for (const PlacedMark& mark : sheet.parts[p].marks)
      add(p, mark.mark->layer, mark.mark->role, true, {mark.edges});
    for (const layout::PartText& text : sheet.parts[p].texts)
      add(p, text.layer, text.role, layout::has_all_letters(text), stroke_chains(text));
  }
}

void SheetMarks::add(std::size_t part, const std::string& layer, layout::MarkRole role, bool has_letters,
                     std::vector<geom::Contour> lines) {
  if (role == layout::MarkRole::bend) {
    ++never_[{layer, "bends"}];
  } else if (role == layout::MarkRole::cut) {
    ++never_[{layer, "to be cut through, but bounding nothing"}];
  } else if (!has_letters) {
    ++never_[{layer, "with letters that the font of single lines lacks"}];
  } else {
    parts_[part].marks.push_back({std::move(lines)});
    layers_[part].push_back(layer);
  }
}

std::string SheetMarks::left_out(const nc::ProfileProgram& program, bool engraves) const {
  auto counts = never_;
  if (!engraves)
    for (const std::vector<std::string>& of_part : layers_)
      for (const std::string& layer : of_part) ++counts[{layer, "without words for engraving"}];
  for (const nc::MarkLeftOut& one : program.marks_left_out)
    ++counts[{layers_[one.part][one.mark], "out of their part or into another"}];
  if (counts.empty()) return "";
  std::string list;
  std::size_t all = 0;
  for (const auto& [what, count] : counts) {
    all += count;
    list += fmt::format("{}{} on layer {} ({})", list.empty() ? "" : ", ", count, excerpt(what.first),
                        what.second);
  }
  return fmt::format(
      "{} not cut: {}",
      all == 1 ? "1 line or text on the parts is" : fmt::format("{} lines and texts on the parts are", all),
      list);
}

}  // namespace lekalo::io::detail
