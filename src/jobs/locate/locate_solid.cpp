#include "lekalo/jobs/locate_solid.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "handed_out.hpp"
#include "lekalo/base/rounding.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/io/locate/solid_certificate.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "lekalo/locate/solid_criterion.hpp"
#include "lekalo/locate/solid_reference.hpp"
#include "lekalo/solid/symmetry.hpp"
#include "lekalo/verify/verify.hpp"
#include "solid_documents.hpp"
#include "solid_offset.hpp"

namespace lekalo::jobs {
namespace {

using solid::Vector;

/// The file that counts as the blank.
const File& blank_of(const SolidLocateJob& job, const SolidInputs& in) {
  return in.meshed ? in.meshed->mesh : job.blank;
}

io::SolidInputRecord record_of(const char* role, const File& file) {
  return {role, {file.name, io::sha256(file.bytes)}, std::nullopt, 0};
}

std::vector<io::SolidInputRecord> input_records(const SolidLocateJob& job, const SolidInputs& in) {
  std::vector<io::SolidInputRecord> records;
  const File& blank = blank_of(job, in);
  for (const auto& [role, file, read] :
       {std::tuple{"part", &job.part, &in.part}, {"blank", &blank, &in.blank}}) {
    io::SolidInputRecord record = record_of(role, *file);
    record.unit = read->unit, record.triangles = read->triangles, record.deviation = read->deviation;
    records.push_back(std::move(record));
  }
  if (in.meshed) {
    io::SolidInputRecord record = record_of("points", job.blank);
    record.unit = in.meshed->unit, record.points = in.meshed->points;
    records.push_back(std::move(record));
  }
  if (in.nominal) {
    io::SolidInputRecord record = record_of("nominal", *job.nominal);
    record.unit = in.nominal->unit, record.triangles = in.nominal->triangles;
    records.push_back(std::move(record));
  }
  for (const auto& [role, file] : {std::pair{"start", &job.start},
                                   {"features", &job.features},
                                   {"nc", &job.program},
                                   {"allow", &job.allow}})
    if (*file) records.push_back(record_of(role, **file));
  return records;
}

void warn_of_names(const SolidLocateJob& job, std::vector<std::string>& warnings) {
  const auto name_of_file = [](const std::optional<File>& file) { return file ? file->name : std::string(); };
  for (const std::string& name :
       {job.part.name, job.blank.name, name_of_file(job.nominal), name_of_file(job.start),
        name_of_file(job.features), name_of_file(job.program), job.outputs.certificate, job.outputs.program,
        job.outputs.offset})
    if (const auto warning = warning_of_name(name)) warnings.push_back(*warning);
}

/// Part and blank are about as large as each other, as a rule: where one is so many times as large that a
/// unit explains it, the other is most likely in that unit.
void warn_of_units(const SolidLocateJob& job, const SolidInputs& in, std::vector<std::string>& warnings) {
  constexpr double kSuspicious = 15, kMostInches = 45, kLeastMetres = 500, kMostMetres = 2000;
  const auto size = [](const solid::Mesh& mesh) {
    const solid::Box box = box_of(mesh.vertices);
    return box.high - box.low;
  };
  const Vector part = size(in.problem.part), blank = size(in.problem.blank);
  const bool part_is_small = norm(part) < norm(blank);
  const double times = part_is_small ? norm(blank) / norm(part) : norm(part) / norm(blank);
  if (!(times > kSuspicious)) return;
  const std::string& small = part_is_small ? job.part.name : job.blank.name;
  const char* const unit = times < kMostInches                           ? "inches"
                           : times > kLeastMetres && times < kMostMetres ? "metres"
                                                                         : "another unit";
  const auto extent = [](Vector v) { return fmt::format("{:.4g} x {:.4g} x {:.4g} mm", v.x, v.y, v.z); };
  warnings.push_back(
      fmt::format("{} measures {} and {} {}, so {} seems to be in {}; --units is said of both files: convert "
                  "one of them, or give it as 3MF, which says its own unit",
                  job.part.name, extent(part), job.blank.name, extent(blank), small, unit));
}

/// A part that is larger than its blank fits nowhere, so the two are exchanged as a rule.
void warn_of_exchange(const SolidLocateJob& job, const SolidInputs& in, std::vector<std::string>& warnings) {
  if (!in.part.volume || !in.blank.volume || in.demands || !(*in.part.volume > *in.blank.volume)) return;
  warnings.push_back(
      fmt::format("{} has a volume of {:.4g} mm3 and {} only {:.4g}, so it fits nowhere; is --part the "
                  "blank, and --blank the part?",
                  job.part.name, *in.part.volume, job.blank.name, *in.blank.volume));
}

/// A part that begins far from its blank fits nowhere in a small window: then its start is worth a word.
void warn_of_start(const SolidInputs& in, std::vector<std::string>& warnings) {
  const locate::SolidProblem& p = in.problem;
  const solid::Motion motion = motion_of(p.start);
  const solid::Box blank = box_of(p.blank.vertices);
  solid::Box part;
  for (const Vector v : p.part.vertices) part.hold(motion(v));
  const Vector below = blank.low - part.low, above = part.high - blank.high;
  std::string out;
  for (const auto& [axis, by] : {std::pair{'x', std::max(below.x, above.x)},
                                 {'y', std::max(below.y, above.y)},
                                 {'z', std::max(below.z, above.z)}})
    if (by > p.shift) out += fmt::format("{}{:.4g} mm along {}", out.empty() ? "" : ", ", by, axis);
  if (!out.empty())
    warnings.push_back(fmt::format(
        "at the start the part reaches out of the box around the blank by {}, farther than it may "
        "be shifted ({} mm); let it begin elsewhere with --start or --find-start, move a file, or "
        "say --shift",
        out, p.shift));
}

/// The decimals of a pose, or the words of an offset, are within this share of the doubles whose clearance is
/// known, and so is what they do to any point of the part: mm.
double decimals_lose(const locate::SolidPlacement& found, const SolidInputs& in, double share) {
  double far = norm(found.pose.shift);
  for (const Vector p : in.problem.part.vertices) far = std::max(far, norm(p));
  return share * far;
}

/// How far the part is off its datums at most, where the pose is written in decimals or words.
void tell_datums(const locate::SolidPlacement& found, const SolidInputs& in, double share,
                 std::vector<io::SolidDatumRecord>& datums) {
  for (std::size_t k = 0; k < datums.size(); ++k)
    datums[k].off = difference_rounded_up(found.off[k], -decimals_lose(found, in, share));
}

/// How far points with a maximum are from the blank's surface at most; a checker that cuts triangles as
/// coarsely sees as much.
void tell_largest(const locate::SolidPlacement& found, const SolidInputs& in, double share,
                  io::SolidDemandRecord& demands) {
  for (std::size_t k = 0; k < in.near_features.size(); ++k)
    demands.largest[in.near_features[k]] =
        difference_rounded_up(found.far[k], -(decimals_lose(found, in, share) + in.problem.nears[k].slack()));
}

std::optional<double> safe_clearance(const locate::SolidPlacement& found, const SolidInputs& in,
                                     double share) {
  if (!found.inside) return std::nullopt;
  const double of_meshes = difference_rounded_down(found.clearance, decimals_lose(found, in, share));
  const double safe = difference_rounded_down(of_meshes, in.deviation());
  if (!(safe > 0)) return std::nullopt;
  return safe;
}

/// A margin has lost as much as the smallest scale makes of it.
double safe_margin(const locate::SolidPlacement& found, const SolidInputs& in, double share) {
  const double lost = decimals_lose(found, in, share) + in.deviation();
  return difference_rounded_down(found.margin, (1 + 0x1p-49) * lost / in.least_scale());
}

/// The findings of a method. One that proves nothing has neither bound nor proof.
struct Found {
  std::string status = "unproved";
  locate::SolidPlacement best;
  std::optional<double> upper_bound;
  locate::SolidProof proof;
  /// The best before a criterion went on from it, and that with the smallest largest allowance.
  locate::SolidPlacement before = {}, shallowest = {};
};

Result<Found> found_by_method(const SolidInputs& in, const SolidLocateOptions& o, const RunControl& run) {
  // The demands are those of the bodies that the meshes stand for.
  const double off = in.demands ? in.deviation() / in.least_scale() * (1 + 0x1p-51) : in.deviation();
  const double least = difference_rounded_down(in.demands ? 0 : o.min_allowance, off);
  const locate::SolidOptions how{o.gap, least, o.threads, run};
  Found found;
  switch (o.method) {
    case SolidMethod::climb: {
      LEKALO_TRY(found.best, locate::place_solid(in.problem, how));
      break;
    }
    case SolidMethod::icp: {
      LEKALO_TRY(found.best, locate::place_solid_icp(in.problem, how));
      break;
    }
    case SolidMethod::axes: {
      LEKALO_TRY(found.best, locate::place_solid_axes(in.problem, how));
      break;
    }
    case SolidMethod::certified: {
      LEKALO_TRY(locate::SolidResult result, locate::locate_solid(in.problem, how));
      const double bound = difference_rounded_up(result.upper_bound, -off);
      found = {io::name_of(result.status), std::move(result.best), bound, std::move(result.proof)};
      break;
    }
  }
  return found;
}

/// Goes on by the criterion, where the demands are met; they are not given up.
Result<void> choose(const SolidInputs& in, const SolidLocateOptions& o, const RunControl& run,
                    const PhaseListener& phases, Found& found) {
  /// So much of the margin is left to rounding, mm.
  constexpr double kLeft = 1e-6;
  found.before = found.shallowest = found.best;
  if (o.criterion == SolidCriterion::smallest || !found.best.inside || run.stop_requested()) return {};
  const double lost = (1 + 0x1p-49) * (decimals_lose(found.best, in, kWordedLoss) + in.deviation()) /
                      (in.demands ? in.least_scale() : 1),
               demanded = difference_rounded_up(in.demands ? 0 : o.min_allowance, -lost);
  if (!(found.best.margin >= demanded)) return {};
  const double least = std::max(demanded, found.best.margin - o.give_up - kLeft);
  const auto in_phase = [&](const char* name) {
    RunControl choosing = run;
    choosing.progress = begin_phase(phases, name);
    choosing.work_limit -= std::min(found.best.work, choosing.work_limit);
    return locate::SolidOptions{o.gap, 0, o.threads, choosing};
  };
  LEKALO_TRY(found.best, locate::smallest_largest(in.problem, found.best, least,
                                                  in_phase("looking for the smallest largest allowance")));
  found.shallowest = found.best;
  if (o.criterion == SolidCriterion::largest) return {};
  LEKALO_TRY(found.best, locate::most_even(in.problem, found.best, least, o.give_up,
                                           in_phase("looking for the most even allowance")));
  return {};
}

/// The search may have met a crossing where the part nearly touches, and that has no triangles.
std::vector<locate::SolidTouch> with_file_numbers(std::vector<locate::SolidTouch> contacts,
                                                  const SolidInputs& in) {
  std::erase_if(contacts, [&](const locate::SolidTouch& touch) {
    return touch.part_triangle >= in.part.numbers.size() || touch.blank_triangle >= in.blank.numbers.size();
  });
  for (locate::SolidTouch& touch : contacts) {
    touch.part_triangle = in.part.numbers[touch.part_triangle];
    touch.blank_triangle = in.blank.numbers[touch.blank_triangle];
  }
  return contacts;
}

/// Leaves the proof in the document, or makes it a document of its own.
void place_proof(const SolidLocateJob& job, LocatedSolid& made) {
  io::SolidDocument& d = made.document;
  const bool keep = !job.outputs.certificate.empty();
  d.certificate_boxes = io::proof_size(d.proof);
  if (d.proof.trees.empty() || (!keep && d.certificate_boxes <= kInlineProof)) return;
  made.certificate = io::certificate_text(d);
  d.proof = {};
  if (keep)
    d.certificate_file = io::FileRecord{job.outputs.certificate, io::sha256(made.certificate)};
  else
    d.warnings.push_back(
        fmt::format("the certificate has {} boxes, more than the {} that go into a result, and is not kept; "
                    "--certificate FILE keeps it",
                    d.certificate_boxes, kInlineProof));
}

/// Puts the bytes about to be handed out before the independent checker, with the proof also where that is
/// too long to be kept.
Result<verify::LocateReport> rechecked(const SolidLocateJob& job, const SolidInputs& in,
                                       const LocatedSolid& made) {
  const File& blank = blank_of(job, in);
  verify::LocateInputs inputs{
      {"result", made.result}, {job.part.name, job.part.bytes}, {blank.name, blank.bytes}, {}};
  if (in.meshed) inputs.points = {job.blank.name, job.blank.bytes};
  if (job.nominal) inputs.nominal = {job.nominal->name, job.nominal->bytes};
  for (const auto& [file, to] : {std::pair{&job.program, &inputs.program}, {&job.allow, &inputs.allow}})
    if (*file) *to = verify::Document{(*file)->name, (*file)->bytes};
  if (made.document.nc) inputs.written_program = verify::Document{job.outputs.program, made.program};
  std::string with_proof;
  if (!made.certificate.empty()) inputs.certificate = {"certificate", made.certificate};
  if (job.features) inputs.features = {job.features->name, job.features->bytes};
  if (inputs.certificate && !made.document.certificate_file) {
    io::SolidDocument document = made.document;
    document.certificate_file = io::FileRecord{"certificate", io::sha256(made.certificate)};
    with_proof = io::result_json(document);
    inputs.result.bytes = with_proof;
  }
  return verify::verify_locate(inputs);
}

/// The result says, too, what the checker leaves open, as where it does not read the form of a file.
Result<void> self_check(const SolidLocateJob& job, const SolidInputs& in, LocatedSolid& made) {
  made.result = io::result_json(made.document);
  Result<verify::LocateReport> report = rechecked(job, in, made);
  if (report && report->verdict == verify::Verdict::incomplete) {
    std::vector<std::string>& warnings = made.document.warnings;
    warnings.insert(warnings.end(), report->notes.begin(), report->notes.end());
    made.result = io::result_json(made.document);
    report = rechecked(job, in, made);
  }
  const bool proved = made.document.demands ? made.document.demands->margin_bound.has_value()
                                            : made.document.upper_bound.has_value();
  LEKALO_CHECK(held_against(report, proved ? verify::Verdict::confirmed : verify::Verdict::unproved));
  return made.document.offset ? check_offset(made) : Result<void>{};
}

/// Its progress is told as a small part of the whole.
Result<locate::SolidPlacement> found_start(const SolidInputs& in, const SolidLocateOptions& o,
                                           const RunControl& run) {
  constexpr double kShare = 0.001;
  RunControl finding = run;
  if (run.progress)
    finding.progress = [&](const Progress& climbed) {
      run.progress({climbed.work, kShare * climbed.fraction});
    };
  return locate::find_start(in.problem, {o.gap, 0, o.threads, finding});
}

Result<Found> searched(const SolidLocateOptions& o, const RunControl& run, const Stopwatch& stopwatch,
                       const PhaseListener& phases, SolidInputs& in, double& seconds) {
  const auto now = [&] { return stopwatch ? stopwatch() : 0; };
  const double start = now();
  const RunControl nobody;
  std::optional<Listening> to_the_end;
  RunControl searching = run;
  std::uint64_t before = 0;
  if (o.find_start) {
    LEKALO_TRY(const locate::SolidPlacement begin, found_start(in, o, run));
    in.problem.start = begin.pose, before = begin.work;
    searching.work_limit -= std::min(before, searching.work_limit);
    to_the_end.emplace(nobody);
  }
  set_window(o, in);
  LEKALO_TRY(Found found, found_by_method(in, o, searching));
  LEKALO_CHECK(choose(in, o, searching, phases, found));
  found.best.work += before;
  seconds = now() - start;
  return found;
}

/// The margin that was found is told no higher than the criterion has kept to, and the largest allowance no
/// smaller, whatever roundings took.
void tell_choice(const Found& found, const SolidInputs& in, const SolidLocateOptions& o, double share,
                 io::SolidDocument& d) {
  if (o.criterion == SolidCriterion::smallest) return;
  const bool is_even = o.criterion == SolidCriterion::even;
  d.choice = {is_even ? "even" : "largest", o.give_up};
  if (!d.inside()) return;
  const double margin = *d.margin();
  double before = margin;
  if (found.before.inside)
    before = in.demands ? safe_margin(found.before, in, share)
                        : safe_clearance(found.before, in, share).value_or(margin);
  d.choice->margin_found = std::max(margin, std::min(before, difference_rounded_down(margin, -o.give_up)));
  const double largest = locate::largest_allowance(in.problem, d.pose);
  d.choice->largest = difference_rounded_up(largest, -decimals_lose(found.best, in, share));
  if (!is_even) return;
  d.choice->deviation = locate::allowance_deviation(in.problem, d.pose);
  d.choice->largest_found = difference_rounded_up(*d.choice->largest, o.give_up);
  if (found.shallowest.inside)
    d.choice->largest_found =
        std::max(*d.choice->largest_found, locate::largest_allowance(in.problem, found.shallowest.pose));
}

io::SolidDocument document_of(const SolidLocateJob& job, SolidInputs& in, Found&& found) {
  io::SolidDocument d;
  d.method = name_of(job.options.method), d.threads = job.options.threads;
  d.inputs = input_records(job, in);
  d.warnings = job.warnings;
  d.warnings.insert(d.warnings.end(), in.notices.begin(), in.notices.end());
  warn_of_names(job, d.warnings);
  warn_of_units(job, in, d.warnings);
  d.work = found.best.work, d.freedom = job.options.freedom;
  d.start = job.options.find_start ? "found" : job.start ? "file" : "drawn";
  d.window = {in.problem.start, in.pivot, in.problem.shift, in.turn_deg};
  // Poses that differ by such a rotation differ in their clearance by no more than is searched for. Features
  // tell faces apart.
  if (!job.features)
    if (solid::Symmetry of_part = solid::symmetry(in.problem.part, job.options.gap); !of_part.axes.empty())
      d.symmetry = {job.options.gap, std::move(of_part)};
  const double share = job.options.offset ? kWordedLoss : 0x1p-49;
  d.pose = found.best.pose, d.clearance = safe_clearance(found.best, in, share);
  d.min_allowance = job.options.min_allowance;
  d.demands = std::move(in.demands);
  if (d.demands) {
    auto& datums = d.demands->datums;
    tell_datums(found.best, in, share, datums);
    for (const io::SolidDatumRecord& datum : datums)
      if (!datum.kept()) d.clearance.reset();
    tell_largest(found.best, in, share, *d.demands);
    if (!d.demands->keeps_maxima()) d.clearance.reset();
    d.demands->margin_bound = found.upper_bound;
    if (d.inside()) d.demands->margin = safe_margin(found.best, in, share);
  } else {
    d.upper_bound = found.upper_bound;
  }
  tell_choice(found, in, job.options, share, d);
  d.scan = in.scan;
  d.status = found.status;
  const double demanded = d.demands ? 0 : d.min_allowance;
  if (d.status == io::name_of(locate::Status::infeasible) && found.upper_bound &&
      !(*found.upper_bound < demanded))
    d.status = io::name_of(locate::Status::stopped);  // by a rounding
  if (d.status == io::name_of(locate::Status::optimal) && !d.inside())
    d.status = io::name_of(locate::Status::stopped);
  if (d.inside())
    d.contacts = with_file_numbers(std::move(found.best.contacts), in);
  else
    warn_of_exchange(job, in, d.warnings), warn_of_start(in, d.warnings);
  d.proof = std::move(found.proof);
  d.part_numbers = in.part.numbers, d.blank_numbers = in.blank.numbers;
  d.part_turned = in.part.turned, d.blank_turned = in.blank.turned;
  return d;
}

}  // namespace

const char* name_of(SolidMethod method) noexcept {
  switch (method) {
    case SolidMethod::climb:
      return "climb";
    case SolidMethod::icp:
      return "icp";
    case SolidMethod::axes:
      return "axes";
    case SolidMethod::certified:
      break;
  }
  return "certified";
}

Result<LocatedSolid> locate_solid(const SolidLocateJob& job, const RunControl& run,
                                  const Stopwatch& stopwatch, const PhaseListener& phases) {
  LEKALO_TRY(SolidInputs in, read_inputs(job, phases));
  double seconds = 0;
  Result<Found> searching = searched(job.options, run, stopwatch, phases, in, seconds);
  // The meshes are closed, so what is wrong with the problem are the demands.
  if (!searching && searching.error().code == ErrorCode::bad_input && job.features)
    return failure(ErrorCode::bad_input, job.features->name + ": " + searching.error().message);
  LEKALO_TRY(Found found, std::move(searching));
  // The findings are told to the end, whoever asks for the stop, and when: what has been found is not lost.
  const RunControl nobody;
  const Listening to_the_end(nobody);
  std::optional<WordedPose> words;
  const double before = found.best.clearance;
  if (job.options.offset) {
    LEKALO_TRY(words, worded(job, in, found.best));
  }
  const double lost = before - found.best.clearance;
  LocatedSolid made;
  made.document = document_of(job, in, std::move(found));
  made.document.seconds = seconds;
  if (lost > 0)
    made.document.warnings.push_back(
        fmt::format("rounding the pose to what the control reads takes {:.3g} mm off the clearance", lost));
  place_proof(job, made);
  LEKALO_CHECK(add_program(job, made));
  add_offset(job, words, made);
  LEKALO_CHECK(add_pictures(job, in, made));
  // Somebody who has asked for the stop may wait for it or not; what is not checked is not handed out.
  const ProgressListener checking = begin_phase(phases, "checking what was found");
  if (checking) checking({});
  LEKALO_CHECK(self_check(job, in, made));
  if (in.meshed) made.mesh = std::move(in.meshed->mesh.bytes);
  return made;
}

}  // namespace lekalo::jobs
