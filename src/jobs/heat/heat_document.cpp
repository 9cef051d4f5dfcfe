#include "heat_document.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "jobs/document/report_document.hpp"
#include "lekalo/base/version.hpp"
#include "lekalo/io/locate/result_json.hpp"
#include "lekalo/io/shape/region_json.hpp"

namespace lekalo::jobs {
namespace {

using heat::Interval;
using heat::Property;

/// Figures stand to 1e-6 of their unit (um, J, K, MPa, mm, s).
double shown(double value) {
  const double rounded = std::round(value * 1e6) / 1e6;
  return rounded == 0 ? 0.0 : rounded;
}
std::optional<double> shown(const std::optional<double>& value) {
  return value ? std::optional(shown(*value)) : std::nullopt;
}
/// Numbers that are multiplied by lengths stand to 1e-12.
double shown_finely(double value) {
  const double rounded = std::round(value * 1e12) / 1e12;
  return rounded == 0 ? 0.0 : rounded;
}

constexpr std::array<std::pair<const char*, Property>, heat::kProperties> kFigures{
    {{"cutting_force_n_mm2", Property::cutting_force},
     {"force_exponent", Property::force_exponent},
     {"conductivity_w_mk", Property::conductivity},
     {"density_kg_m3", Property::density},
     {"heat_capacity_j_kgk", Property::heat_capacity},
     {"expansion_per_k", Property::expansion},
     {"youngs_mpa", Property::youngs},
     {"poisson", Property::poisson},
     {"yield_mpa", Property::yield},
     {"melting_c", Property::melting},
     {"glass_c", Property::glass},
     {"share", Property::share}}};

void write_interval(io::JsonWriter& json, const char* key, const Interval& value) {
  json.key(key).list({shown(value.least), shown(value.greatest)});
}
/// As it was stated, to the last digit.
void write_stated(io::JsonWriter& json, const char* key, const Interval& value) {
  json.key(key).list({value.least, value.greatest});
}

/// A block, or an outline as it was read and the box about it.
void write_stock(io::JsonWriter& json, const HeatStock& stock) {
  const heat::StockBox& box = stock.box;
  json.key("stock").begin_object().key("low_mm").list({shown(box.low_x), shown(box.low_y)});
  json.key("high_mm").list({shown(box.high_x), shown(box.high_y)}).field("thickness_mm", box.thickness);
  json.key("outline");
  if (!stock.read) {
    json.value(nullptr).end();
    return;
  }
  json.begin_object().key("regions").raw() += io::regions_json(stock.read->outline.regions);
  json.field("tolerance_mm", stock.read->outline.tolerance);
  io::write_record(json.key("drawing"), stock.read->drawing);
  io::write_record(json.key("scan"), stock.read->scan);
  json.end().end();
}

void write_words(io::JsonWriter& json, const HeatJob& job, const HeatFound& found) {
  write_machining(json, job.source.machining);
  json.fields({{"teeth", job.source.cutting.teeth}, {"spindle_rpm", job.source.cutting.spindle_rpm}});
  write_stated(json, "wear", job.source.cutting.wear);
  json.key("material").begin_object().field("name", job.material.name);
  for (const auto& [key, property] : kFigures) {
    const Interval& value = job.material[property];
    if (value == Interval{} && (property == Property::melting || property == Property::glass))
      json.field(key, nullptr);
    else
      write_stated(json, key, value);
  }
  json.end();
  write_stated(json, "film_w_m2k", job.film);
  json.key("holding").begin_object().field("kind", name_of(job.holding)).key("datum_mm");
  if (const auto& datum = job.holding.datum)
    json.list({datum->x, datum->y, datum->z});
  else
    json.value(nullptr);
  json.end();
  json.fields({{"ambient_c", job.ambient_c}, {"voxel_mm", job.pitch}});
  write_stock(json, found.source.stock);
}

void write_measured(io::JsonWriter& json, const HeatJob& job, const HeatFound& found) {
  json.key("measured").begin_list();
  for (std::size_t i = 0; i < job.measured.size(); ++i) {
    const MeasuredTemperature& m = job.measured[i];
    json.begin_object().field("temperature_c", m.celsius).key("at_mm").list({m.at.x, m.at.y, m.at.z});
    json.fields({{"seconds", m.seconds}, {"uncertainty_k", m.uncertainty_k}}).key("rises_k").begin_list();
    for (const HeatCase& one : found.cases) json.value(shown_finely(one.rises_k[i]));
    json.end();
    write_interval(json, "supported_j", found.supported_j[i]);
    json.end();
  }
  json.end().key("calibrated").begin_object().key("share");
  json.list({shown_finely(found.share.least), shown_finely(found.share.greatest)});
  write_interval(json, "into_workpiece_j", found.heat_j);
  json.end();
}

void write_booked(io::JsonWriter& json, const heat::CuttingWork& work) {
  json.key("booked").begin_object().fields({{"seconds", shown(work.seconds)},
                                            {"cutting_seconds", shown(work.cutting_seconds)},
                                            {"volume_mm3", shown(work.volume_mm3)}});
  write_interval(json, "work_j", work.work_j);
  write_interval(json, "into_workpiece_j", work.into_workpiece_j);
  write_interval(json, "carried_off_j", work.carried_off_j);
  write_interval(json, "greatest_power_w", work.greatest_power_w);
  json.end();
}

void write_balance(io::JsonWriter& json, const heat::HeatBook& book, double not_placed_j) {
  json.key("heat_balance")
      .object({{"in_j", shown(book.in)},
               {"stored_j", shown(book.stored)},
               {"lost_j", shown(book.lost)},
               {"removed_j", shown(book.removed)},
               {"not_placed_j", shown(not_placed_j)},
               {"unaccounted_part", shown_finely(book.balance())}});
}

io::JsonWriter& write_errors(io::JsonWriter& json, const char* key, const WallErrors& errors) {
  return json.key(key).begin_object().fields(
      {{"least", shown(errors.least)}, {"most", shown(errors.most)}, {"mean", shown(errors.mean)}});
}
void write_errors(io::JsonWriter& json, const char* key, const WallErrors& errors,
                  const WallIntervals& over) {
  write_errors(json, key, errors).field("largest", shown(errors.largest()));
  json.key("intervals").begin_object();
  write_interval(json, "least", over.least);
  write_interval(json, "most", over.most);
  write_interval(json, "mean", over.mean);
  write_interval(json, "largest", over.largest);
  json.end().end();
}

void write_scaling(io::JsonWriter& json, const UniformScaling& scaling) {
  json.key("uniform_scaling").begin_object().field("factor", shown_finely(scaling.factor));
  json.key("centre_mm").list({shown(scaling.centre[0]), shown(scaling.centre[1])});
  json.key("shift_um").list({shown(scaling.shift_um[0]), shown(scaling.shift_um[1])});
}

void write_case(io::JsonWriter& json, const HeatCase& one) {
  json.begin_object().fields({{"film_w_m2k", one.film}});
  write_errors(json, "wall_error_um", one.errors).end();
  write_scaling(json, one.scaling);
  write_errors(json, "left_um", one.scaling.left).end();
  json.end();
  json.fields({{"warmest_k", shown(one.warmest_k)}, {"stress_mpa", shown(one.stress_mpa)}});
  json.key("stress_at_mm").list({shown(one.stress_at.x), shown(one.stress_at.y), shown(one.stress_at.z)});
  json.fields({{"stress_seconds", shown(one.stress_seconds)},
               {"half_s", shown(one.half_s)},
               {"tenth_s", shown(one.tenth_s)}});
  write_balance(json, one.book, one.not_placed_j);
  json.key("errors_um").begin_list();
  for (const double e : one.errors_um) json.value(shown(e));
  json.end().end();
}

/// The least and the greatest of all cases; none where it takes too long.
void write_waits(io::JsonWriter& json, const std::vector<HeatCase>& cases) {
  json.key("cooling_down").begin_object();
  for (const auto& [key, seconds] :
       {std::pair{"half_s", &HeatCase::half_s}, {"tenth_s", &HeatCase::tenth_s}}) {
    const auto [shortest, longest] = waits_over(cases, seconds);
    json.key(key).list({io::JsonScalar(shown(shortest)), io::JsonScalar(shown(longest))});
  }
  json.end();
}

void write_range(io::JsonWriter& json, const char* key, double middle, const Interval& over) {
  json.key(key).object(
      {{"middle", shown(middle)}, {"least", shown(over.least)}, {"greatest", shown(over.greatest)}});
}

void write_correction(io::JsonWriter& json, const HeatCorrection* made) {
  if (made == nullptr) {
    json.fields({{"after_correction_um", nullptr}, {"correction", nullptr}});
    return;
  }
  write_errors(json, "after_correction_um", made->after, made->after_over);
  const HeatFound& found = made->found;
  json.key("correction").begin_object().fields({{"finish_mm", made->finish}, {"rounds", made->rounds}});
  write_booked(json, found.source.work);
  json.key("walls").begin_list();
  for (std::size_t i = 0; i < found.walls.size(); ++i) {
    const WallPoint& w = found.walls[i];
    json.begin_object().key("at_mm").list({shown(w.x), shown(w.y), shown(w.z)}).key("visits").begin_list();
    for (std::size_t v = 0; v < found.visits[i].size(); ++v) {
      json.begin_object().field("seconds", shown(found.visits[i][v].at)).key("moved_um").begin_list();
      for (const HeatCase& one : found.cases)
        for (const double along : one.moved_um[i][v]) json.value(shown(along));
      json.end().end();
    }
    json.end().end();
  }
  json.end().end();
}

}  // namespace

std::array<std::optional<double>, 2> waits_over(const std::vector<HeatCase>& cases,
                                                std::optional<double> HeatCase::*seconds) {
  std::array<std::optional<double>, 2> over{cases.front().*seconds, cases.front().*seconds};
  for (const HeatCase& one : cases) {
    const std::optional<double>& wait = one.*seconds;
    if (wait && (!over[0] || *wait < *over[0])) over[0] = wait;
    if (over[1] && (!wait || *wait > *over[1])) over[1] = wait;
  }
  return over;
}

const char* name_of(const heat::Holding& holding) noexcept {
  using Held = std::array<bool, heat::kSides>;
  if (holding.held == Held{}) return "free";
  if (holding.held == Held{false, false, false, false, true, false}) return "plate";
  if (holding.held == Held{true, true, false, false, false, false}) return "vice-x";
  if (holding.held == Held{false, false, true, true, false, false}) return "vice-y";
  return "held";
}

std::string heat_json(const HeatJob& job, const HeatFound& found, const std::vector<std::string>& warnings,
                      const CorrectedFile& corrected) {
  io::JsonWriter json = begin_document("lekalo-heat");
  json.fields({{"status", "computed"}, {"units", "mm"}}).key("inputs").begin_list();
  write_file(json, "program", job.source.program);
  write_file(json, "pocket", job.source.pocket);
  if (job.source.stock.outline) write_file(json, "stock", *job.source.stock.outline);
  write_earlier(json, job.source.after);
  json.end();
  if (corrected.correction != nullptr) {
    json.key("outputs").begin_list();
    write_file(json, "corrected", {corrected.name, corrected.correction->program});
    json.end();
  }
  json.key("warnings").list(warnings);
  json.fields({{"seed", 0}, {"work", found.work}, {"version", kVersion}});
  write_words(json, job, found);
  write_booked(json, found.source.work);
  write_measured(json, job, found);
  const HeatCase& middle = found.middle();
  write_errors(json, "wall_error_um", found.errors, found.errors_over);
  write_scaling(json, found.scaling);
  json.key("factors").list({shown_finely(found.factors.least), shown_finely(found.factors.greatest)});
  write_errors(json, "left_um", found.scaling.left, found.scaled_over);
  json.end();
  write_balance(json, found.book, found.not_placed_j);
  write_range(json, "warmest_k", middle.warmest_k, found.warmest_k);
  json.field("limit_c", shown(job.material.limit_c()));
  write_range(json, "stress_mpa", middle.stress_mpa, found.stress_mpa);
  const double yield = job.material[Property::yield].least;
  write_interval(json, "stress_of_yield",
                 {found.stress_mpa.least / yield, found.stress_mpa.greatest / yield});
  write_waits(json, found.cases);
  json.key("sensitivity_um").begin_object();
  write_interval(json, "share", found.sensitivity.share);
  write_interval(json, "force", found.sensitivity.force);
  write_interval(json, "film", found.sensitivity.film);
  json.end();
  json.key("heat_parts")
      .list({shown_finely(found.heat_parts.least), shown_finely(found.heat_parts.greatest)});
  json.key("cases").list(found.cases, [&](const HeatCase& one) { write_case(json, one); });
  json.field("uncut_places", found.uncut);
  json.key("walls").list(found.walls, [&](const WallPoint& w) {
    json.begin_object().key("at_mm").list({shown(w.x), shown(w.y), shown(w.z)});
    json.key("outward").list({shown_finely(w.outward[0]), shown_finely(w.outward[1])});
    json.fields({{"seconds", shown(w.seconds)}, {"error_um", shown(w.error_um)}});
    write_interval(json, "errors_um", w.errors_um);
    json.end();
  });
  write_correction(json, corrected.correction);
  json.key("run").object({});
  return end_document(json);
}

}  // namespace lekalo::jobs
