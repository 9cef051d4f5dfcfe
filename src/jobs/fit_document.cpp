#include "fit_document.hpp"

#include <algorithm>
#include <cmath>

#include "jobs/document/report_document.hpp"
#include "lekalo/base/version.hpp"

namespace lekalo::jobs {
namespace {

/// Figures stand to 1e-6 of their unit (um, MPa, N): far below what the elements know, far above rounding.
double shown(double value) {
  const double rounded = std::round(value * 1e6) / 1e6;
  return rounded == 0 ? 0.0 : rounded;
}
double um(double mm) { return shown(1000 * mm); }

void write_limits(io::JsonWriter& json, const char* key, const fit::Limits& limits) {
  json.key(key).list({limits.lower_um, limits.upper_um});
}

void write_rings(io::JsonWriter& json, const fit::Assembly& assembly) {
  json.key("rings").begin_list();
  for (std::size_t i = 0; i < assembly.rings.size(); ++i) {
    const fit::Ring& ring = assembly.rings[i];
    json.begin_object().fields({{"name", fit::ring_name(i)},
                                {"inner_diameter_mm", ring.inner_diameter},
                                {"outer_diameter_mm", ring.outer_diameter},
                                {"length_mm", ring.length},
                                {"middle_mm", ring.middle},
                                {"material", ring.material.name},
                                {"youngs_mpa", ring.material.youngs_mpa},
                                {"poisson", ring.material.poisson},
                                {"yield_mpa", ring.material.yield_mpa},
                                {"hardening_mpa", ring.material.hardening_mpa},
                                {"expansion_per_k", ring.material.expansion_per_k}});
    json.end();
  }
  json.end();
}

/// The row of a surface that begins at row `first` of the shaft; null beyond its ends.
std::optional<double> growth_at(const std::vector<fit::Growth>& surface, std::size_t row,
                                std::size_t first = 0) {
  const bool there = row >= first && row - first < surface.size();
  return there ? std::optional(um(surface[row - first].diameter)) : std::nullopt;
}

void write_profile(io::JsonWriter& json, const fit::Pressed& pressed) {
  const fit::RingGrowth &shaft = pressed.rings.front(), &hub = pressed.rings[1],
                        &outside = pressed.rings.back();
  std::size_t first = 0;  // of the hub
  while (shaft.outer[first].z < hub.inner.front().z) ++first;
  json.key("profile").begin_list();
  for (std::size_t i = 0; i < shaft.outer.size(); ++i) {
    json.begin_object().fields({{"z_mm", shown(shaft.outer[i].z)},
                                {"bore_um", growth_at(shaft.inner, i)},
                                {"shaft_um", growth_at(shaft.outer, i)},
                                {"hub_bore_um", growth_at(hub.inner, i, first)},
                                {"hub_um", growth_at(outside.outer, i, first)}});
    json.end();
  }
  json.end();
}

void write_case(io::JsonWriter& json, const FitJob& job, const Fitted& made, const FitCase& one) {
  const fit::SeatLoad& seat = one.pressed.seats.front();
  const fit::RingGrowth& shaft = one.pressed.rings.front();
  json.begin_object().fields(
      {{"interference_um", um(one.interference)},
       {"state", fit::name_of(one.pressed.state)},
       {"pressure_mpa", shown(seat.pressure_mpa)},
       {"middle_pressure_mpa", shown(seat.middle_mpa)},
       {"touching_mm", shown(seat.touching_mm)},
       {"hub_outer_growth_um", um(fit::in_middle(one.pressed.rings.back().outer).diameter)}});
  json.field("shaft_bore_closure_um",
             shaft.inner.empty() ? std::nullopt : std::optional(-um(fit::in_middle(shaft.inner).diameter)));
  json.key("seats").list(one.pressed.seats, [&](const fit::SeatLoad& s) {
    const auto index = static_cast<std::size_t>(&s - one.pressed.seats.data());
    json.object({{"interference_um", um(one.pressed.interference[index])},
                 {"force_n", shown(s.force_n)},
                 {"pressure_mpa", shown(s.pressure_mpa)}});
  });
  json.key("stresses").list(one.pressed.rings, [&](const fit::RingGrowth& ring) {
    json.object({{"yields", ring.yields},
                 {"plastic_part", shown(ring.plastic_part)},
                 {"middle_mises_mpa", shown(ring.middle_mises_mpa)},
                 {"largest_mises_mpa", shown(ring.largest_mises_mpa)}});
  });
  json.key("din_7190");
  if (one.din)
    json.object({{"state", fit::name_of(one.din->state)},
                 {"pressure_mpa", shown(one.din->pressure_mpa)},
                 {"hub_outer_growth_um", um(one.din->hub_outer_growth)}});
  else
    json.value(nullptr);
  json.key("released")
      .object({{"hub_bore_growth_um", um(fit::in_middle(one.released.rings[1].inner).diameter)},
               {"hub_outer_growth_um", um(fit::in_middle(one.released.rings.back().outer).diameter)},
               {"shaft_growth_um", um(fit::in_middle(one.released.rings.front().outer).diameter)}});
  json.key("press_force_n");
  if (job.friction)
    json.list({shown((*job.friction)[0] * seat.force_n), shown((*job.friction)[1] * seat.force_n)});
  else
    json.value(nullptr);
  const auto shrink = job.clearance_um ? fit::shrink_difference(made.assembly.rings[1], one.interference,
                                                                *job.clearance_um / 1000)
                                       : std::nullopt;
  json.field("shrink_difference_k", shrink ? std::optional(shown(*shrink)) : std::nullopt);
  write_profile(json, one.pressed);
  json.end();
}

void write_correction(io::JsonWriter& json, const FitJob& job, const Fitted& made) {
  json.key("correction");
  if (!made.corrected) {
    json.value(nullptr);
    return;
  }
  const fit::Corrected& c = *made.corrected;
  json.begin_object().fields(
      {{"surface", fit::name_of(c.surface)}, {"nominal_mm", c.nominal}, {"case", made.cases.size() / 2}});
  json.key("remains").begin_list();
  for (std::size_t i = 0; i < c.variations.size(); ++i)
    json.object({{"interference_um", um(made.cases[i].interference)},
                 {"before_um", um(c.variations[i].before)},
                 {"after_um", um(c.variations[i].after)}});
  json.end().key("profile").begin_list();
  for (std::size_t i = 0; i < c.profile.size(); ++i)
    json.object({{"z_mm", shown(c.profile[i].z)},
                 {"diameter_mm", shown(c.profile[i].diameter)},
                 {"pressed_um", um(c.growths[i])}});
  json.end();
  json.key("turning");
  if (made.program.empty())
    json.value(nullptr);
  else
    json.object({{"control", job.turning.control == fit::Lathe::fanuc ? "fanuc" : "linuxcnc"},
                 {"x", job.turning.radius ? "radius" : "diameter"},
                 {"feed_mm_per_min", job.turning.feed_mm_per_min},
                 {"spindle_rpm", job.turning.spindle_rpm}});
  json.end();
}

}  // namespace

std::string fit_json(const FitJob& job, const Fitted& made, std::uint64_t work) {
  io::JsonWriter json = begin_document("lekalo-fit");
  json.fields({{"status", "computed"}, {"units", "mm"}}).key("inputs").begin_list().end();
  if (!made.table.empty() || !made.drawing.empty() || !made.program.empty()) {
    json.key("outputs").begin_list();
    if (!made.table.empty()) write_file(json, "profile", {job.table_as, made.table});
    if (!made.drawing.empty()) write_file(json, "drawing", {job.drawing_as, made.drawing});
    if (!made.program.empty()) write_file(json, "program", {job.program_as, made.program});
    json.end();
  }
  json.key("warnings").begin_list().end();
  json.fields({{"seed", 0}, {"work", work}, {"version", kVersion}});
  json.field("diameter_mm", made.assembly.rings.front().outer_diameter);
  json.key("fit");
  if (made.named) {
    json.begin_object().fields({{"hole", made.named->hole}, {"shaft", made.named->shaft}});
    write_limits(json, "hole_limits_um", made.named->hole_limits);
    write_limits(json, "shaft_limits_um", made.named->shaft_limits);
    json.end();
  } else {
    json.value(nullptr);
  }
  json.key("roughness_um");
  job.roughness_um ? json.list({(*job.roughness_um)[0], (*job.roughness_um)[1]}) : json.value(nullptr);
  json.key("friction");
  job.friction ? json.list({(*job.friction)[0], (*job.friction)[1]}) : json.value(nullptr);
  json.field("clearance_um", job.clearance_um);
  write_rings(json, made.assembly);
  json.key("cases").begin_list();
  for (const FitCase& one : made.cases) write_case(json, job, made, one);
  json.end();
  write_correction(json, job, made);
  json.key("run").object({});
  return end_document(json);
}

}  // namespace lekalo::jobs
