#include "lekalo/io/layout/layout_export.hpp"
#include "lekalo/io/svg/svg.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>

#include "hpgl_writer.hpp"
#include "lekalo/base/joined_text.hpp"
#include "lekalo/io/drawing/written_drawing.hpp"
#include "lekalo/io/dxf/dxf.hpp"
#include "lekalo/layout/check.hpp"
#include "placed_inside.hpp"
#include "sheet_shapes.hpp"

namespace lekalo::io {
namespace {

using detail::PlacedShape;
using detail::SheetShapes;
using geom::Point;

bool wanted(const ExportRequest& request, const char* layer) {
  return request.only.empty() ||
         std::find(request.only.begin(), request.only.end(), layer) != request.only.end();
}

/// Regions, lines and texts in the file's unit, in the order in which they are drawn: the stock first, labels
/// last.
struct Drawn {
  std::vector<LayeredRegion> regions;
  DrawingExtras extras;
};

class Drawer {
 public:
  Drawer(const ExportRequest& request, double mm_per_unit) : request_(request), scale_(1 / mm_per_unit) {
    drawn_.extras.colours = {{"CUT", 1, 0xd00000},   {"MARK", 5, 0x0000ff},   {"LABEL", 3, 0x008000},
                             {"SHEET", 8, 0x808080}, {"DEFECT", 6, 0xc000c0}, {"ZONE", 30, 0xd07000},
                             {"AREA", 4, 0x009090}};
  }

  Drawn draw(const std::vector<SheetShapes>& sheets) && {
    for (const SheetShapes& sheet : sheets) add({sheet.material}, "SHEET");
    for (const SheetShapes& sheet : sheets) add(sheet.defects, "DEFECT");
    for (const SheetShapes& sheet : sheets) add(sheet.zones, "ZONE");
    for (const SheetShapes& sheet : sheets)
      for (const PlacedShape& part : sheet.parts) add(part.areas, "AREA");
    for (const SheetShapes& sheet : sheets)
      for (const PlacedShape& part : sheet.parts) add({part.region}, "CUT");
    for (const SheetShapes& sheet : sheets)
      for (const PlacedShape& part : sheet.parts) add_inside(part);
    for (const SheetShapes& sheet : sheets) {
      for (const PlacedShape& part : sheet.parts) add_texts(part);
      if (sheets.size() > 1) add_title(sheet);
    }
    return std::move(drawn_);
  }

 private:
  [[nodiscard]] Point scaled(Point p) const { return scale_ == 1 ? p : scale_ * p; }

  void add(const std::vector<geom::Region>& regions, const char* layer) {
    if (!wanted(request_, layer)) return;
    for (geom::Region region : regions) {
      if (scale_ != 1) {
        scale(region.outer);
        for (geom::Contour& hole : region.holes) scale(hole);
      }
      drawn_.regions.push_back({std::move(region), layer, {}});
    }
  }
  void scale(geom::Contour& contour) const {
    for (geom::Edge& edge : contour)
      edge.from = scaled(edge.from), edge.to = scaled(edge.to), edge.centre = scaled(edge.centre);
  }

  /// Adds what lies inside a part, on the layers and in the colours that it had; MARK asks for all of it.
  void add_inside(const PlacedShape& part) {
    if (!wanted(request_, "MARK")) return;
    for (const detail::PlacedMark& mark : part.marks) {
      drawn_.extras.chains.push_back({mark.edges, layer_like(mark.mark->layer, mark.mark->colour)});
      if (scale_ != 1) scale(drawn_.extras.chains.back().edges);
    }
    for (const layout::PartText& text : part.texts) {
      ReadText set;
      set.text = text.text;
      set.at = scaled(text.at), set.height = scale_ * text.height;
      set.degrees = text.degrees, set.width_factor = text.width_factor, set.mirrored = text.mirrored;
      set.anchor = static_cast<ReadText::Anchor>(text.anchor);
      set.layer = layer_like(text.layer, text.colour);
      drawn_.extras.set_texts.push_back(std::move(set));
    }
  }
  static Layer layer_like(const std::string& name, const std::string& colour) {
    Layer layer;
    layer.name = detail::layer_of_inside(name);
    layer.colour = colour;
    return layer;
  }

  void add_texts(const PlacedShape& part) {
    if (!part.grain.empty() && wanted(request_, "MARK"))
      drawn_.extras.lines.push_back({scaled(part.grain.front()), scaled(part.grain.back()), "MARK"});
    if (part.label_height > 0 && wanted(request_, "LABEL"))
      drawn_.extras.texts.push_back({part.label, scaled(part.label_at), scale_ * part.label_height, "LABEL"});
  }

  /// Several sheets stand side by side, so each has its name above it.
  void add_title(const SheetShapes& sheet) {
    if (!wanted(request_, "LABEL")) return;
    const geom::Box box = geom::bounds(sheet.material.outer);
    const double height = std::clamp(0.02 * (box.high.x - box.low.x), 3.0, 30.0);
    drawn_.extras.texts.push_back({sheet.name, scaled({0.5 * (box.low.x + box.high.x), box.high.y + height}),
                                   scale_ * height, "LABEL"});
  }

  const ExportRequest& request_;
  double scale_;
  Drawn drawn_;
};

Result<Exported> drawing(const std::vector<SheetShapes>& sheets, const ExportRequest& request) {
  const bool dxf = request.form == ExportForm::dxf;
  const Drawn drawn = Drawer(request, dxf ? millimetres_per(request.unit) : 1).draw(sheets);
  if (drawn.regions.empty() && drawn.extras.lines.empty() && drawn.extras.texts.empty() &&
      drawn.extras.chains.empty() && drawn.extras.set_texts.empty())
    return failure(ErrorCode::bad_input, "there is nothing to write on the layers asked for");
  LEKALO_TRY(std::string text, dxf ? dxf_drawing(drawn.regions, drawn.extras, request.unit)
                                   : svg_drawing(drawn.regions, drawn.extras));
  return Exported{{{sheets.size() == 1 ? sheets.front().name : "", std::move(text), {}}}, {}};
}

Result<Exported> plotted(const std::vector<SheetShapes>& sheets, const ExportRequest& request) {
  Exported made;
  double tip_off = 0;
  for (const SheetShapes& sheet : sheets) {
    LEKALO_TRY(detail::PlotText plot,
               detail::hpgl_text(sheet, request.only, request.chord_tolerance_mm, request.knife));
    made.files.push_back({sheet.name, std::move(plot.text), {}});
    tip_off = std::max(tip_off, plot.tip_off_mm);
  }
  made.notes.push_back(
      fmt::format("corners lie within {:.3f} mm of where they are (plotter units of {:g} mm), chords within "
                  "{:g} mm of their arcs",
                  0.7072 * detail::kPlotterUnit, detail::kPlotterUnit, request.chord_tolerance_mm));
  if (request.knife)
    made.notes.push_back(fmt::format("the tip of the knife stays within {:.3f} mm of the outlines{}",
                                     tip_off + 0.5e-3,
                                     request.knife->kind == nc::KnifeKind::drag
                                         ? "; before the plot the blade has to point along +x, its axis in "
                                           "front of its tip"
                                         : ""));
  return made;
}

/// Says what a rule of holes did, as the end of a sentence.
std::string holes_cut(std::size_t count, const nc::ProfileOptions& profile, std::size_t rule) {
  const nc::HoleCut& hole = profile.holes[rule];
  const double lead = hole.lead_in_mm.value_or(profile.lead_in_mm);
  return fmt::format("; {} up to {:g} mm in diameter, cut at {:g} mm/min {}",
                     count == 1 ? "1 hole is" : fmt::format("{} holes are", count), hole.up_to_diameter_mm,
                     hole.feed_share * profile.feed_mm_per_min,
                     lead > 0 ? fmt::format("with a lead of {:g} mm", lead) : "without a lead");
}

/// Says what became of pierces, heat and joints, as the end of a sentence.
std::string pierces_and_joints(const nc::ProfileProgram& p, const nc::ProfileOptions& profile) {
  std::string said;
  if (p.crossed_leads > 0)
    said += fmt::format("; {} leads run into a kerf that is there already", p.crossed_leads);
  if (profile.pierce_diameter_mm > 0)
    said += fmt::format("; every pierce of {:g} mm is clear of parts and of earlier cuts",
                        profile.pierce_diameter_mm);
  if (profile.heat_spread_mm > 0 && p.near_starts > 0)
    said += fmt::format("; {} cuts begin nearer than {:g} mm to the cut before, the nearest {:.1f} mm",
                        p.near_starts, profile.heat_spread_mm, p.nearest_start_mm);
  if (profile.joints.wanted())
    said += fmt::format("; joints of {:g} mm: {}, parts that they hold: {}", profile.joints.width_mm,
                        p.joints, p.jointed_parts);
  if (!p.unheld.empty())
    said += fmt::format("; placements that lie in a hole have no joints, because its slug falls: {}",
                        joined_text(p.unheld, ", "));
  return said;
}

/// Says what became of edges that two parts have in common, as the end of a sentence.
std::string edges_in_common(const nc::ProfileProgram& p, const nc::ProfileOptions& profile) {
  if (p.shared_mm == 0) return "";
  if (!profile.common_line)
    return fmt::format(
        "; {:.0f} mm of edges that two parts have in common are cut twice (--common-line cuts "
        "them once)",
        p.shared_mm);
  std::string said = fmt::format(
      "; {:.0f} mm of edges that two parts have in common are cut once, in {} beside both at half a kerf, "
      "within {:.5f} mm",
      p.shared_mm, p.common_lines == 1 ? "1 line" : fmt::format("{} lines", p.common_lines),
      p.common_off_mm + 0.5e-5);
  if (p.starts_in_kerfs > 0)
    said += fmt::format("; {} of them begin in a kerf that is there, for want of room", p.starts_in_kerfs);
  return said;
}

/// Fails for a placement that is to have joints and is not there.
Result<void> check_joints_of(const layout::Document& document, const nc::JointOptions& joints) {
  for (const auto& [id, count] : joints.of)
    if (std::none_of(document.placements.begin(), document.placements.end(),
                     [id = id](const layout::Placement& placement) { return placement.id == id; }))
      return failure(ErrorCode::usage, fmt::format("there is no placement {} to have {} joints", id, count));
  return {};
}

Result<Exported> programmed(const std::vector<SheetShapes>& sheets, const std::string& name,
                            const ExportRequest& request) {
  Exported made;
  for (const SheetShapes& sheet : sheets) {
    const detail::SheetMarks marks(sheet);
    const auto program = nc::profile_program(marks.parts(), name + " " + sheet.name, request.profile);
    if (!program)
      return failure(program.error().code, fmt::format("sheet {}: {}", sheet.name, program.error().message));
    const nc::ProfileProgram& p = *program;
    std::string said = fmt::format(
        "sheet {}: {} cuts, {:.0f} mm, travel {:.0f} mm; the kerf enters no part by more than "
        "{:.5f} mm",
        sheet.name, p.cuts, p.cut_mm, p.travel_mm, p.deepest_mm + 0.5e-5);
    for (std::size_t i = 0; i < p.cuts_by_hole.size(); ++i)
      if (p.cuts_by_hole[i] > 0) said += holes_cut(p.cuts_by_hole[i], request.profile, i);
    if (p.shortened_leads > 0)
      said += fmt::format("; {} leads are shorter for want of room", p.shortened_leads);
    if (p.bare_starts > 0)
      said += fmt::format("; {} cuts have no room for a lead and begin on the contour", p.bare_starts);
    said += edges_in_common(p, request.profile);
    said += pierces_and_joints(p, request.profile);
    if (p.left_over_mm > request.profile.tolerance_mm)
      said += fmt::format(
          "; corners lie up to {:.3f} mm from the kerf and keep that much material, most in placement {}",
          p.left_over_mm, p.left_over_of);
    if (p.marks > 0)
      said += fmt::format("; {} engraved before them, {:.0f} mm",
                          p.marks == 1 ? "1 line or text is" : fmt::format("{} lines and texts are", p.marks),
                          p.engraved_mm);
    if (const std::string left = marks.left_out(p, request.profile.engraving.has_value()); !left.empty())
      said += "; " + left;
    made.notes.push_back(std::move(said));
    made.files.push_back({sheet.name, p.text, p.lines_of_cuts});
  }
  return made;
}

}  // namespace

std::optional<ExportForm> export_form(std::string_view word) noexcept {
  if (word == "dxf") return ExportForm::dxf;
  if (word == "svg") return ExportForm::svg;
  if (word == "hpgl") return ExportForm::hpgl;
  if (word == "gcode") return ExportForm::gcode;
  return std::nullopt;
}

Result<Exported> export_layout(const layout::Document& document, const std::string& name,
                               const ExportRequest& request) {
  LEKALO_TRY(const auto sheets, detail::sheets_to_write(document, request.sheet));
  // Steps 1 and 2 of docs/design/export.md.
  const bool together = request.form == ExportForm::dxf || request.form == ExportForm::svg;
  std::vector<std::string> notes;
  const std::vector<SheetShapes> shapes = detail::sheet_shapes(document, sheets, together, notes);
  const std::vector<layout::Violation> broken = layout::check(document);
  LEKALO_CHECK(check_joints_of(document, request.profile.joints));
  if (request.form == ExportForm::gcode || request.knife)
    for (const layout::Violation& violation : broken)
      if (violation.kind == layout::ViolationKind::overlap &&
          std::find(sheets.begin(), sheets.end(), layout::Sheet{violation.stock, violation.copy}) !=
              sheets.end())
        return failure(
            ErrorCode::bad_input,
            fmt::format("placements {} and {} overlap, so they cannot both be cut; lekalo check says how to "
                        "move them apart",
                        violation.a, violation.b));
  LEKALO_TRY(Exported made, request.form == ExportForm::hpgl    ? plotted(shapes, request)
                            : request.form == ExportForm::gcode ? programmed(shapes, name, request)
                                                                : drawing(shapes, request));
  if (!broken.empty())
    notes.push_back(fmt::format("the layout breaks {} of its rules; lekalo check says which", broken.size()));
  made.notes.insert(made.notes.begin(), notes.begin(), notes.end());
  return made;
}

}  // namespace lekalo::io
