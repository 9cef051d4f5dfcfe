#include "layout_words.hpp"

#include "lekalo/jobs/show.hpp"
#include "option_words.hpp"

namespace lekalo::cli {

void add_layout_source(Form& form, LayoutWords& w, bool required) {
  OptionAdder{form}(
      "layout", w.path, "FILE",
      "A layout, a job or placements of a nesting program, a drawing, regions: told apart by content")
      .required = required;
  OptionAdder{form, "Reading"}("--instance", w.instance, "FILE",
                               "Of placements: the file of the items, when not where they say");
  add_drawings_reading(form, w);
}

void add_drawings_reading(Form& form, LayoutWords& w) {
  const OptionAdder add(form, "Reading");
  add("--units", w.units, list_of(kUnits, "|"), "Of files that do not say theirs [mm]");
  add("--chord-tolerance", w.chords, "MM", "How far chords lie from the arcs of drawings [0.01]");
  add("--join", w.join, "MM", "Loose ends of drawings this near to each other are joined [0.01]");
  add("--repair", w.repair, "MM", "Mends of drawings move no outline further; the rest is set aside [0.2]");
  add("--strict", w.strict, "Refuse a drawing of which anything would be mended or set aside");
  add("--layers", w.layers, "NAME", "Layers of a drawing that hold parts [all that are shown]").delimiter =
      ',';
  add("--layer-rules", w.layer_rules, "FILE",
      "What the layers of drawings are: cut, mark, engrave, bend or ignore [outlines, and marks on them]");
}

void add_layout_outputs(Form& form, LayoutWords& w) {
  const OptionAdder add(form, "Output");
  add("--picture", w.picture, "FILE", "Draw it: .svg, .png or .pdf");
  add("--json", w.json, "Print the report as JSON on stdout");
}

Result<LayoutSource> to_layout_source(const LayoutWords& w) {
  LayoutSource source{w.path, w.instance, {}, w.layer_rules};
  source.parts.drawing.take = w.layers;
  WordReader reader;
  if (!w.units.empty()) reader.choice("--units", w.units, kUnits, source.parts.unit.emplace());
  constexpr const char* kLength = "a length up to 1000 mm, as 0.2 or 1/64in";
  reader.length("--chord-tolerance", w.chords, 0x1p-16, 1000.0, kLength, source.parts.chord_tolerance);
  reader.length("--join", w.join, 0.0, 1000.0, kLength, source.parts.drawing.join_tolerance);
  reader.length("--repair", w.repair, 0.0, 1000.0, kLength, source.parts.drawing.repair);
  source.parts.drawing.strict = w.strict;
  if (!reader.complaint().empty()) return failure(ErrorCode::usage, reader.complaint());
  return source;
}

Result<void> fine_picture(const std::string& path) {
  if (path.empty() || jobs::picture_form(path)) return {};
  return failure(
      ErrorCode::usage,
      fmt::format("--picture {}: the name has to end in .svg, .png or .pdf, which says what is drawn", path));
}

}  // namespace lekalo::cli
