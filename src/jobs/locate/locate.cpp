#include "lekalo/jobs/locate.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "handed_out.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/edge_distance.hpp"
#include "lekalo/geom/region_index.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "lekalo/locate/allowance.hpp"
#include "lekalo/verify/verify.hpp"
#include "locate_checked.hpp"
#include "locate_documents.hpp"
#include "locate_inputs.hpp"

namespace lekalo::jobs {
namespace {

io::FileRecord record_of(const File& file) { return {file.name, io::sha256(file.bytes)}; }

std::vector<io::InputRecord> input_records(const LocateJob& job, const LocateInputs& in) {
  std::vector<io::InputRecord> records;
  for (const auto& [role, file, read] :
       {std::tuple{"part", &job.part, &in.part}, {"blank", &job.blank, &in.blank}}) {
    io::InputRecord record{role, record_of(*file), std::nullopt, 0, {}};
    if (const auto& contour = read->contour)
      record.unit = contour->unit, record.points = contour->points.size(), record.dropped = contour->dropped;
    records.push_back(std::move(record));
  }
  for (const auto& [role, file] : {std::pair{"nc", &job.program},
                                   {"allow", &job.allow},
                                   {"features", &job.features},
                                   {"last-result", &job.earlier}})
    if (*file) records.push_back({role, record_of(**file), std::nullopt, 0, {}});
  return records;
}

void warn_of_names(const LocateJob& job, std::vector<std::string>& warnings) {
  const auto name_of_file = [](const std::optional<File>& file) { return file ? file->name : std::string(); };
  for (const std::string& name :
       {job.part.name, job.blank.name, name_of_file(job.program), name_of_file(job.earlier),
        job.outputs.program, job.outputs.certificate, job.outputs.deviations})
    if (const auto warning = warning_of_name(name)) warnings.push_back(*warning);
}

io::DemandRecord record_of(const locate::Demands& asked, locate::DemandResult&& r) {
  io::DemandRecord record;
  record.minimum = asked.minimum, record.features = asked.features;
  record.criterion = asked.criterion, record.give_up = asked.give_up;
  record.margin = r.margin, record.margin_bound = r.margin_bound;
  record.margin_found = r.margin_found, record.margin_gap = r.margin_gap;
  record.largest = r.largest, record.deviation = r.deviation;
  record.second = std::move(r.second);
  if (record.second && record.second->proof) record.second->proof->grown.clear();
  record.curve = std::move(r.curve);
  record.grown_for = r.proof.grown_for, record.shift = r.proof.shift, record.bound = r.proof.bound;
  return record;
}

/// The checker knows the criteria of lekalo, and not those that somebody added.
bool leaves_choice_open(const io::LocateDocument& d) {
  return d.demands && d.demands->margin_found >= 0 && !verify::knows_criterion(d.demands->criterion.name);
}

io::LocateDocument document_of(const LocateJob& job, const LocateInputs& in, Search&& search) {
  const locate::Problem& p = in.problem;
  locate::Found& found = search.found;
  io::LocateDocument d;
  d.status = search.status, d.method = name_of(job.options.method), d.seconds = search.seconds;
  d.inputs = input_records(job, in);
  d.warnings = job.warnings;
  for (const io::ReadOutline* read : {&in.part, &in.blank})
    d.warnings.insert(d.warnings.end(), read->notices.begin(), read->notices.end());
  d.seed = job.options.seed, d.work = found.work;
  d.placement = found.best, d.mirrored = found.mirrored, d.upper_bound = found.upper_bound;
  d.min_allowance = job.options.min_allowance, d.shortfall = found.shortfall;
  d.window_from_deg = job.options.window_from_deg, d.window_to_deg = job.options.window_to_deg;
  d.contacts = std::move(found.contacts), d.proof = std::move(found.proof);
  if (d.convex()) {
    warn_of_names(job, d.warnings);
    d.alternatives = std::move(found.alternatives), d.alternatives_complete = found.alternatives_complete;
    d.trim = in.blank.contour->trim;
    return d;
  }
  d.part = p.part.regions, d.part_tolerance = p.part.tolerance, d.part_cut = in.part_cut;
  d.part_drawing = in.part.drawing, d.blank_drawing = in.blank.drawing;
  d.blank = p.blank.regions, d.blank_tolerance = p.blank.tolerance, d.scan = in.blank.scan;
  d.mirror = p.mirror, d.locked = p.locked;
  if (found.demands) d.demands = record_of(*p.demands, std::move(*found.demands));
  if (leaves_choice_open(d))
    d.warnings.push_back(fmt::format(
        "the checker does not know the criterion {}: what it keeps of the margin is rechecked, its "
        "choice is not",
        d.demands->criterion.name));
  return d;
}

void clear(io::LocateDocument& d) {
  if (d.convex())
    d.proof = locate::AngleProof{};
  else
    d.proof = locate::PoseProof{};
}

/// Leaves the proof in the document, or makes it a document of its own.
void place_proof(const LocateJob& job, Located& made) {
  io::LocateDocument& d = made.document;
  const bool keep = !job.outputs.certificate.empty();
  const std::size_t size = d.certificate_intervals = io::proof_size(d);
  if (size == 0 || (!keep && size <= kInlineProof)) return;
  made.certificate = io::certificate_text(d);
  if (d.demands && d.demands->second && d.demands->second->proof)
    d.demands->second->proof->certificate.clear();
  if (const std::size_t first = io::proof_size(d); !keep && first <= kInlineProof) {
    d.certificate_intervals = first;
    d.warnings.push_back(fmt::format(
        "the certificates have {} cells, more than the {} that go into a result, so that of largest "
        "allowances is not kept; --certificate FILE keeps it",
        size, kInlineProof));
    return;
  }
  clear(d);
  if (keep) {
    d.certificate_file = io::FileRecord{job.outputs.certificate, io::sha256(made.certificate)};
    return;
  }
  d.warnings.push_back(
      fmt::format("the certificate has {} {}, more than the {} that go into a result, and is not kept; "
                  "--certificate FILE keeps it",
                  size, d.convex() ? "intervals" : "cells", kInlineProof));
}

/// Puts the bytes about to be handed out before the independent checker. Where a proof was made it has to
/// hold, also one that is too long to be kept.
Result<void> self_check(const LocateJob& job, const Located& made) {
  verify::LocateInputs inputs{
      {"result", made.result}, {job.part.name, job.part.bytes}, {job.blank.name, job.blank.bytes}, {}};
  for (const auto& [file, to] : {std::pair{&job.features, &inputs.features},
                                 {&job.program, &inputs.program},
                                 {&job.allow, &inputs.allow},
                                 {&job.earlier, &inputs.earlier}})
    if (*file) *to = verify::Document{(*file)->name, (*file)->bytes};
  if (!made.program.empty()) inputs.written_program = verify::Document{job.outputs.program, made.program};
  if (made.document.deviations) inputs.deviations = verify::Document{job.outputs.deviations, made.deviations};
  std::string with_proof;
  if (!made.certificate.empty()) inputs.certificate = {"certificate", made.certificate};
  if (inputs.certificate && !made.document.certificate_file) {
    io::LocateDocument document = made.document;
    document.certificate_file = io::FileRecord{"certificate", io::sha256(made.certificate)};
    with_proof = io::result_json(document);
    inputs.result.bytes = with_proof;
  }
  const Result<verify::LocateReport> report = verify::verify_locate(inputs);
  const auto wanted = job.options.method != LocateMethod::certified ? verify::Verdict::unproved
                      : leaves_choice_open(made.document)           ? verify::Verdict::incomplete
                                                                    : verify::Verdict::confirmed;
  return held_against(report, wanted);
}

/// The search rounds a clearance down by more than the written pose loses, so that a part that just fits
/// seems to miss its demand by some last digits. The checker reads the same digits exactly: the demand is
/// claimed where it confirms the claim, and only there.
void claim_what_just_fits(const LocateJob& job, io::LocateDocument& d) {
  const bool just = d.convex() && d.status == io::name_of(locate::Status::optimal) && d.shortfall > 0 &&
                    d.upper_bound && *d.upper_bound >= d.min_allowance;
  if (!just) return;
  Located claim;
  claim.document = d;
  claim.document.placement.clearance = d.min_allowance;
  claim.document.shortfall = 0;
  const io::LocateDocument claimed = claim.document;
  place_proof(job, claim);
  claim.result = io::result_json(claim.document);
  if (self_check(job, claim)) d = claimed;
}

/// Raises the bound of a search over poses by a share of its distance from what was found. The search bounds
/// a large cell by a chord where the checker, which halves the cell, takes the arc: where such cells are left
/// when the work ends, the checker may need a bound that is looser by what its halves are wide.
void loosen_bound(double share, double found_bound, io::LocateDocument& d) {
  d.upper_bound = found_bound + share * std::max(found_bound - d.placement.clearance, 0.0);
  const bool infeasible = *d.upper_bound < d.min_allowance;
  d.status = io::name_of(infeasible ? locate::Status::infeasible : locate::Status::stopped);
  d.warnings.push_back(
      fmt::format("the bound {} was found, and the checker proves {}; more --work brings them together",
                  found_bound, *d.upper_bound));
}

/// Does the same for the bound of a margin, by a share of what lies between it and the margin found, or of a
/// few gaps where that is closed.
///
/// A bound of the certificate below 0 says that the demands cannot be met, and one above 0 counts by the
/// least scale on top of the margin that the part was grown for.
void loosen_margin_bound(double share, const io::DemandRecord& found, io::LocateDocument& d) {
  double least_scale = 1;
  for (const locate::Feature& f : found.features) least_scale = std::min(least_scale, f.scale);
  const double by = share * std::max(found.margin_bound - found.margin, 4 * found.margin_gap);
  io::DemandRecord& demands = *d.demands;
  demands.bound = found.bound + by, demands.shift = found.shift + by;
  demands.margin_bound = found.margin_bound + by / (found.margin_bound < 0 ? 1 : least_scale);
  if (found.margin_bound < 0 && demands.margin_bound >= 0)
    demands.margin_bound = std::max(0.0, demands.bound / least_scale);
  // The checker encloses what is written and adds it up again.
  for (int step = 0; step < 4; ++step)
    demands.margin_bound = std::nextafter(demands.margin_bound, std::numeric_limits<double>::infinity());
  d.status = io::name_of(demands.margin_bound < 0 ? locate::Status::infeasible : locate::Status::stopped);
  d.warnings.push_back(
      fmt::format("the bound {} of the margin was found, and the checker proves {}; more --work brings them "
                  "together",
                  found.margin_bound, demands.margin_bound));
}

void add_comparison(const LocateInputs& in, io::LocateDocument& d) {
  if (!in.earlier) return;
  const locate::ConvexOutline &part = *in.problem.part.convex, &blank = *in.problem.blank.convex;
  const locate::Placement& last = in.earlier->placement;
  const io::InputRecord* const last_part = in.earlier->input("part");
  io::ComparisonRecord c;
  c.same_part = last_part != nullptr && last_part->file.sha256 == d.inputs.front().file.sha256;
  if (!c.same_part) d.warnings.push_back("the earlier result was made from another part file");
  const locate::PlacementShift shift = locate::placement_shift(part.polygon.vertices(), last, d.placement);
  c.dx = shift.dx, c.dy = shift.dy, c.dtheta = shift.dtheta, c.largest_shift = shift.largest;
  c.last_clearance = last.clearance;
  c.last_pose_clearance = safe_clearance(part, blank, last);
  d.comparison = c;
}

/// One line for every probed point; index counts from 0 in file order.
std::string deviations_csv(const geom::Ring& probed, const std::vector<double>& deviations) {
  std::string text = "index,x,y,deviation\n";
  for (std::size_t k = 0; k < probed.size(); ++k) {
    text += fmt::format("{},{},{},{}\n", k, probed[k].x, probed[k].y, deviations[k]);
  }
  return text;
}

void add_deviations(const LocateJob& job, const LocateInputs& in, Located& made) {
  if (job.outputs.deviations.empty()) return;
  const geom::Ring& probed = in.blank.contour->points;
  const std::vector<double> deviations =
      locate::deviations(probed, in.problem.part.convex->polygon.vertices(), made.document.placement);
  const auto [least, greatest] = std::minmax_element(deviations.begin(), deviations.end());
  made.deviations = deviations_csv(probed, deviations);
  made.document.deviations = io::DeviationsRecord{
      {job.outputs.deviations, io::sha256(made.deviations)}, deviations.size(), *least, *greatest};
}

/// Lowers the clearance of a placement to the low end of the checker's enclosure, less what the written
/// decimals may be off. Returns false where that is no less, and where the checker knows better: then the
/// claim was a mistake.
bool lower_to_proved(const io::LocateDocument& d, bool mirrored, locate::Placement& at) {
  const std::string part = io::regions_json(d.part), blank = io::regions_json(d.blank);
  const auto proved =
      verify::verify_clearance({"part", part}, {"blank", blank}, {at.x, at.y, at.theta, mirrored});
  const double tolerances = d.part_tolerance + d.blank_tolerance;
  if (!proved || !(at.clearance <= proved->high - tolerances)) return false;
  const geom::Box box = geom::RegionIndex(d.part).bounds();
  const double far =
      std::max({-box.low.x, -box.low.y, box.high.x, box.high.y, std::abs(at.x), std::abs(at.y)});
  const double low = proved->low - tolerances - geom::kEdgeDistanceError * (far + tolerances);
  if (!(low < at.clearance)) return false;
  at.clearance = low;
  return true;
}

/// Does that for every placement of the result. A part that touches its blank is placed by the search to some
/// last digits, while the checker encloses what sticks out to 1e-9 mm.
bool lower_clearances(io::LocateDocument& d) {
  bool lowered = lower_to_proved(d, d.mirrored, d.placement);
  if (!d.demands) {
    d.shortfall = std::max(0.0, d.min_allowance - d.placement.clearance);
    return lowered;
  }
  for (locate::TradeOff& point : d.demands->curve)
    lowered = lower_to_proved(d, point.mirrored, point.at) || lowered;
  return lowered;
}

/// Claims less where the checker refused what was found: first the clearances that it proves, then also the
/// least of a few looser bounds. The result with that is left in `made`. Where nothing helps, the refusal is
/// that of the result as it was found.
Result<void> check_with_safer_claims(const LocateJob& job, const LocateInputs& in, Result<void> refused,
                                     Located& made) {
  io::LocateDocument found = made.document;
  const bool by_poses = !found.convex() && (found.demands || found.upper_bound) &&
                        job.options.method == LocateMethod::certified;
  if (!by_poses || refused.error().code != ErrorCode::refuted) return refused;
  const auto holds = [&] {
    made.result = io::result_json(made.document);
    return self_check(job, made).has_value();
  };
  bool confirmed = false;
  if (lower_clearances(found)) {
    made.document = found;
    confirmed = holds();
  }
  for (double share = 0x1p-10; !confirmed && share <= 1; share *= 4) {
    made.document = found;
    if (found.demands) {
      loosen_margin_bound(share, *found.demands, made.document);
    } else {
      loosen_bound(share, *found.upper_bound, made.document);
    }
    confirmed = holds();
  }
  if (!confirmed) return refused;
  LEKALO_CHECK(add_pictures(job, in, made));
  made.result = io::result_json(made.document);
  return self_check(job, made);
}

}  // namespace

const char* name_of(LocateMethod method) noexcept {
  switch (method) {
    case LocateMethod::certified:
      return "certified";
    case LocateMethod::ipopt:
      return "ipopt";
    case LocateMethod::icp:
      break;
  }
  return "icp";
}

Result<Located> locate_checked(const Searcher& searcher, const LocateJob& job) {
  LEKALO_TRY(const LocateInputs in, read_inputs(job));
  LEKALO_TRY(Search search, searcher(in.problem, job.options));
  Located made;
  made.document = document_of(job, in, std::move(search));
  claim_what_just_fits(job, made.document);
  place_proof(job, made);
  add_comparison(in, made.document);
  add_deviations(job, in, made);
  LEKALO_CHECK(add_program(job, made));
  LEKALO_CHECK(add_pictures(job, in, made));
  made.result = io::result_json(made.document);
  Result<void> checked = self_check(job, made);
  if (!checked) checked = check_with_safer_claims(job, in, std::move(checked), made);
  LEKALO_CHECK(checked);
  return made;
}

Result<Located> locate(const LocateJob& job, const RunControl& run, const Stopwatch& stopwatch,
                       const std::atomic<bool>* interrupt) {
  const RunControl nobody;
  RunControl interrupted;
  interrupted.stop = interrupt;
  std::optional<Listening> to_the_end;
  return locate_checked(
      [&](const locate::Problem& problem, const LocateOptions& options) {
        // The search looks at the control itself, and ends with its best so far. That is then proved and
        // told, whoever has asked for the stop; and a time that is up meanwhile is no reason to lose it.
        auto search = [&] {
          const Listening listening(nobody);
          return searched(problem, options, run, stopwatch);
        }();
        if (interrupt != nullptr && !interrupted.stop_requested())
          to_the_end.emplace(interrupted);
        else if (run.stop_requested())
          to_the_end.emplace(nobody);
        return search;
      },
      job);
}

}  // namespace lekalo::jobs
