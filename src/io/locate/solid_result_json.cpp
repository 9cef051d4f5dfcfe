#include "lekalo/io/locate/solid_result_json.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/rounding.hpp"
#include "lekalo/base/version.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/io/locate/solid_certificate.hpp"
#include "result_lines.hpp"
#include "touch_proof.hpp"

namespace lekalo::io {
namespace {

using detail::line_of;
using detail::lines;
using detail::list_of_lines;

void write(JsonWriter& json, solid::Vector p) { json.list({p.x, p.y, p.z}); }

void write(JsonWriter& json, const SolidInputRecord& input) {
  json.begin_object().fields(
      {{"role", input.role}, {"path", input.file.path}, {"sha256", input.file.sha256}});
  if (input.unit) json.field("units", name_of(*input.unit));
  if (input.role == "points")
    json.field("points", input.points);
  else if (input.unit)
    json.field("triangles", input.triangles);
  if (input.deviation) json.field("deviation", *input.deviation);
  json.end();
}

void write(JsonWriter& json, const SolidWindow& window) {
  json.begin_object().key("quaternion").list(window.start.quaternion);
  const solid::Vector& at = window.start.shift;
  json.fields({{"x", at.x}, {"y", at.y}, {"z", at.z}});
  write(json.key("pivot"), window.pivot);
  json.fields({{"shift", window.shift}, {"turn_deg", window.turn_deg}}).end();
}

/// Endless ones have null for their number.
void write(JsonWriter& json, const std::optional<SolidSymmetryRecord>& symmetry) {
  if (!symmetry) return void(json.value(nullptr));
  const auto number = [](std::uint32_t count) { return count > 0 ? std::optional(count) : std::nullopt; };
  const solid::Symmetry& found = symmetry->found;
  json.begin_object().fields({{"tolerance", symmetry->tolerance}, {"rotations", number(found.rotations)}});
  write(json.key("centre"), found.centre);
  json.key("axes").begin_list();
  for (const solid::SymmetryAxis& axis : found.axes) {
    write(json.begin_object().key("direction"), axis.direction);
    json.field("turns", number(axis.turns)).end();
  }
  json.end().end();
}

void write(JsonWriter& json, const locate::SolidTouch& touch) {
  write(json.begin_object().key("part_point"), touch.part);
  write(json.key("blank_point"), touch.blank);
  json.fields({{"part_triangle", touch.part_triangle},
               {"blank_triangle", touch.blank_triangle},
               {"distance", touch.distance},
               {"multiplier", touch.multiplier}});
  json.end();
}

void write(JsonWriter& json, const SolidScanRecord& scan) {
  json.begin_object().fields(
      {{"guard", scan.guard}, {"min_radius", scan.min_radius}, {"max_dip", scan.max_dip}});
  json.key("underside");
  if (scan.underside)
    json.object({{"z", scan.underside->z}, {"flat", scan.underside->flat}});
  else
    json.value(nullptr);
  // Other blanks have none, and not the word either.
  if (scan.touches) write_touches(json.key("touches"), *scan.touches);
  json.fields(
      {{"widest", scan.widest}, {"unknown_triangles", scan.unknown_triangles}, {"proved", scan.proved()}});
  json.key("left_out").list(scan.left_out);
  json.key("assumptions").list(scan.assumptions);
  json.end();
}

void write(JsonWriter& json, const SolidFeature& feature, double largest) {
  std::optional<double> minimum, scale;
  if (feature.demand) minimum = feature.demand->minimum, scale = feature.demand->scale;
  json.begin_object().fields({{"name", feature.name},
                              {"triangles", feature.triangles.size()},
                              {"minimum", minimum},
                              {"scale", scale},
                              {"as_cast", !feature.demand && !feature.finished}});
  // Others have none, and not the words either.
  if (feature.within())
    json.fields({{feature.finished ? "finished" : "maximum", *feature.within()}, {"largest", largest}});
  if (feature.rim > 0) json.field("rim", feature.rim);
  if (feature.target) json.field("target", *feature.target);
  json.end();
}

void write(JsonWriter& json, const SolidDemandRecord& demands) {
  std::optional<double> gap;
  if (demands.margin && demands.margin_bound)
    gap = difference_rounded_up(*demands.margin_bound, *demands.margin);
  json.begin_object().field("minimum", demands.minimum);
  list_of_lines(json.key("features"), demands.features, [&](const SolidFeature& one) {
    write(json, one, demands.largest[static_cast<std::size_t>(&one - demands.features.data())]);
  });
  list_of_lines(json.key("datums"), demands.datums, [&](const SolidDatumRecord& one) {
    json.begin_object().fields({{"name", one.name}, {"within", one.within}, {"off", one.off}});
    if (!one.kept()) json.field("missed", one.missed());
    json.end();
  });
  json.fields({{"margin", demands.margin}, {"margin_bound", demands.margin_bound}, {"margin_gap", gap}})
      .end();
}

void write(JsonWriter& json, const SolidChoiceRecord& choice) {
  json.begin_object().fields({{"criterion", choice.criterion},
                              {"give_up", choice.give_up},
                              {"margin_found", choice.margin_found},
                              {"largest", choice.largest}});
  if (choice.criterion == "even")
    json.fields({{"largest_found", choice.largest_found}, {"deviation", choice.deviation}});
  json.end();
}

void write(JsonWriter& json, const std::optional<OffsetRecord>& offset) {
  if (!offset) return void(json.value(nullptr));
  json.begin_object().fields(
      {{"control", offset->control}, {"axes", offset->axes}, {"work_offset", offset->work_offset}});
  json.key("output").object({{"path", offset->output.path}, {"sha256", offset->output.sha256}});
  json.end();
}

void write_head(JsonWriter& json, const SolidDocument& d) {
  line_of(json, "format").object({{"name", "lekalo-locate"}, {"version", 1}});
  lines(json, {{"status", d.status}, {"units", "mm"}});
  list_of_lines(line_of(json, "inputs"), d.inputs, [&](const SolidInputRecord& one) { write(json, one); });
  list_of_lines(line_of(json, "warnings"), d.warnings, [&](const std::string& one) { json.value(one); });
  lines(json, {{"seed", 0}, {"work", d.work}, {"version", kVersion}, {"method", d.method}});
  lines(json, {{"freedom", io::name_of(d.freedom)}, {"start", d.start}});
  write(line_of(json, "window"), d.window);
  write(line_of(json, "symmetry"), d.symmetry);
}

void write_placement(JsonWriter& json, const SolidDocument& d) {
  std::optional<double> gap;
  if (d.upper_bound && d.clearance) gap = difference_rounded_up(*d.upper_bound, *d.clearance);
  line_of(json, "quaternion").list(d.pose.quaternion);
  const solid::Vector& at = d.pose.shift;
  lines(json, {{"x", at.x},
               {"y", at.y},
               {"z", at.z},
               {"inside", d.inside()},
               {"clearance", d.clearance},
               {"upper_bound", d.upper_bound},
               {"gap", gap},
               {"min_allowance", d.min_allowance},
               {"shortfall", d.shortfall()}});
  line_of(json, "demands");
  if (d.demands)
    write(json, *d.demands);
  else
    json.value(nullptr);
  // Others have none, and not the word either.
  if (d.choice) write(line_of(json, "choice"), *d.choice);
  list_of_lines(line_of(json, "contacts"), d.contacts,
                [&](const locate::SolidTouch& one) { write(json, one); });
  line_of(json, "scan");
  if (d.scan)
    write(json, *d.scan);
  else
    json.value(nullptr);
  lines(json, {{"unknown_area_mm2", d.scan ? d.scan->unknown_area : 0}});
}

void write_proof(JsonWriter& json, const SolidDocument& d) {
  line_of(json, "certificate");
  if (d.proof.trees.empty())
    json.value(nullptr);
  else
    write_solid_certificate(json, d.proof, {d.part_numbers, d.blank_numbers, d.part_turned, d.blank_turned});
  line_of(json, "certificate_file");
  if (d.certificate_file)
    json.object({{"path", d.certificate_file->path},
                 {"sha256", d.certificate_file->sha256},
                 {"boxes", d.certificate_boxes}});
  else
    json.value(nullptr);
}

}  // namespace

double SolidWindow::farthest_turn_deg(locate::SolidFreedom freedom) const noexcept {
  constexpr double kAllTurns = 180, kHundredths = 100;
  if (freedom != locate::SolidFreedom::six || turn_deg == 0 || turn_deg == kAllTurns) return turn_deg;
  // Rotations are counted by tan(angle / 2), along each axis, so those at the corners have the root of 3
  // times as much.
  const geom::SinCos half = geom::sincos(0.5 * turn_deg * kDegree);
  const double turn = 2 * geom::direction_angle(half.cosine, std::sqrt(3.0) * half.sine);
  return std::ceil(kHundredths * turn * kDegreesPerRadian) / kHundredths;
}

double SolidDatumRecord::missed() const noexcept { return kept() ? 0 : difference_rounded_up(off, within); }

bool SolidDemandRecord::keeps_maxima() const noexcept {
  for (std::size_t k = 0; k < features.size(); ++k)
    if (const auto within = features[k].within(); within && largest[k] > *within) return false;
  return true;
}

std::optional<double> SolidDocument::shortfall() const noexcept {
  if (!clearance) return std::nullopt;
  if (demands) return std::max(0.0, 0.0 - *demands->margin);
  return std::max(0.0, difference_rounded_up(min_allowance, *clearance));
}

std::string result_json(const SolidDocument& d) {
  JsonWriter json(JsonLayout::spaced);
  json.begin_object();
  write_head(json, d);
  write_placement(json, d);
  write_proof(json, d);
  detail::write_nc(line_of(json, "nc"), d.nc);
  write(line_of(json, "offset"), d.offset);
  line_of(json, "run").object({{"seconds", d.seconds}, {"threads", d.threads}});
  json.line(0).end();
  return json.take() + "\n";
}

std::string certificate_text(const SolidDocument& d) {
  return solid_certificate_json(d.proof, {d.part_numbers, d.blank_numbers, d.part_turned, d.blank_turned});
}

const char* name_of(locate::SolidFreedom freedom) noexcept {
  switch (freedom) {
    case locate::SolidFreedom::xyz:
      return "xyz";
    case locate::SolidFreedom::c_xyz:
      return "c-xyz";
    case locate::SolidFreedom::six:
      break;
  }
  return "six";
}

}  // namespace lekalo::io
