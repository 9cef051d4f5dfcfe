#include "lekalo/jobs/locate_solid.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "handed_out.hpp"
#include "lekalo/base/rounding.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/draw/solid_picture.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "lekalo/locate/solid_allowance.hpp"
#include "lekalo/solid/triangle_tree.hpp"
#include "lekalo/verify/verify.hpp"
#include "solid_inputs.hpp"

namespace lekalo::jobs {
namespace {

using solid::Vector;

io::SolidInputRecord record_of(const char* role, const File& file) {
  return {role, {file.name, io::sha256(file.bytes)}, std::nullopt, 0};
}

std::vector<io::SolidInputRecord> input_records(const SolidLocateJob& job, const SolidInputs& in) {
  std::vector<io::SolidInputRecord> records;
  for (const auto& [role, file, read] :
       {std::tuple{"part", &job.part, &in.part}, {"blank", &job.blank, &in.blank}}) {
    io::SolidInputRecord record = record_of(role, *file);
    record.unit = read->unit, record.triangles = read->triangles;
    records.push_back(std::move(record));
  }
  if (job.start) records.push_back(record_of("start", *job.start));
  return records;
}

void warn_of_names(const SolidLocateJob& job, std::vector<std::string>& warnings) {
  for (const std::string& name :
       {job.part.name, job.blank.name, job.start ? job.start->name : std::string(), job.outputs.certificate})
    if (const auto warning = warning_of_name(name)) warnings.push_back(*warning);
}

/// Takes off a clearance what the numbers of a text may be off, and the decimals of the pose: these are
/// within half a last place of the doubles whose clearance this is, and turn no point of the part by more.
std::optional<double> safe_clearance(const locate::SolidPlacement& found, const SolidInputs& in) {
  if (!found.inside) return std::nullopt;
  constexpr double kDiagonal = 1.75;  // more than that of a cube
  double far = norm(found.pose.shift);
  for (const Vector p : in.problem.part.vertices) far = std::max(far, norm(p));
  const double errors = kDiagonal * (in.part.coordinate_error + in.blank.coordinate_error) + 0x1p-49 * far;
  const double safe = difference_rounded_down(found.clearance, errors);
  if (!(safe > 0)) return std::nullopt;
  return safe;
}

/// The search of the whole window proves nothing as long as nobody can recheck it.
Result<locate::SolidPlacement> placed(const SolidInputs& in, const SolidLocateOptions& o,
                                      const RunControl& run, io::SolidDocument& d) {
  const locate::SolidOptions how{o.gap, o.min_allowance, o.threads, run};
  d.status = "unproved";
  if (o.method == SolidMethod::climb) return locate::place_solid(in.problem, how);
  LEKALO_TRY(locate::SolidResult found, locate::locate_solid(in.problem, how));
  return std::move(found.best);
}

std::vector<locate::SolidTouch> with_file_numbers(std::vector<locate::SolidTouch> contacts,
                                                  const SolidInputs& in) {
  for (locate::SolidTouch& touch : contacts) {
    touch.part_triangle = in.part.numbers[touch.part_triangle];
    touch.blank_triangle = in.blank.numbers[touch.blank_triangle];
  }
  return contacts;
}

/// One line for each corner of the part.
std::string allowances_csv(const SolidInputs& in, const io::SolidDocument& d) {
  const solid::TriangleTree blank(in.problem.blank);
  const solid::Motion motion = motion_of(d.pose);
  std::string text = "index,x_part,y_part,z_part,x_blank,y_blank,z_blank,allowance_mm,blank_triangle\n";
  std::optional<std::uint32_t> near;
  for (std::size_t k = 0; k < in.problem.part.vertices.size(); ++k) {
    ask();
    const Vector p = in.problem.part.vertices[k], q = motion(p);
    const solid::Nearest nearest = *blank.nearest(q, std::numeric_limits<double>::infinity(), near);
    near = nearest.triangle;
    const double allowance = blank.holds(q) ? nearest.low : -nearest.high;
    text += fmt::format("{},{},{},{},{},{},{},{},{}\n", k, p.x, p.y, p.z, q.x, q.y, q.z, allowance,
                        in.blank.numbers[nearest.triangle]);
  }
  return text;
}

Result<std::string> picture(const SolidLocateJob& job, const SolidInputs& in, const io::SolidDocument& d) {
  locate::MeasuredPart part =
      locate::measured_part(in.problem.part, in.problem.blank, motion_of(d.pose), 40'000, d.threads);
  draw::SolidScene scene;
  scene.part_name = job.part.name, scene.blank_name = job.blank.name;
  scene.status = d.status, scene.method = d.method;
  scene.part = std::move(part.mesh), scene.allowances = std::move(part.allowances);
  scene.blank = in.problem.blank;
  scene.placement = {d.pose, d.inside(), d.clearance.value_or(0), d.contacts, d.work};
  scene.upper_bound = d.upper_bound;
  scene.min_allowance = d.min_allowance, scene.shortfall = d.shortfall().value_or(0);
  return draw::solid_png(scene, 1600, d.threads);
}

Result<void> self_check(const SolidLocateJob& job, const LocatedSolid& made) {
  verify::LocateInputs inputs{
      {"result", made.result}, {job.part.name, job.part.bytes}, {job.blank.name, job.blank.bytes}, {}};
  return held_against(verify::verify_locate(inputs), verify::Verdict::unproved);
}

Result<locate::SolidPlacement> searched(const SolidInputs& in, const SolidLocateOptions& o,
                                        const RunControl& run, const Stopwatch& stopwatch,
                                        io::SolidDocument& d) {
  const auto now = [&] { return stopwatch ? stopwatch() : 0; };
  // The search looks at the control itself, and ends with its best so far.
  const RunControl nobody;
  const Listening listening(nobody);
  const double start = now();
  LEKALO_TRY(locate::SolidPlacement found, placed(in, o, run, d));
  d.seconds = now() - start;
  return found;
}

}  // namespace

const char* name_of(SolidMethod method) noexcept {
  return method == SolidMethod::climb ? "climb" : "certified";
}

Result<LocatedSolid> locate_solid(const SolidLocateJob& job, const RunControl& run,
                                  const Stopwatch& stopwatch) {
  LEKALO_TRY(SolidInputs in, read_inputs(job));
  LocatedSolid made;
  io::SolidDocument& d = made.document;
  LEKALO_TRY(locate::SolidPlacement found, searched(in, job.options, run, stopwatch, d));
  // What was found is told to the end, whoever has asked for the stop.
  const RunControl nobody;
  std::optional<Listening> to_the_end;
  if (run.stop_requested()) to_the_end.emplace(nobody);
  d.method = name_of(job.options.method), d.threads = job.options.threads;
  d.inputs = input_records(job, in);
  d.warnings = job.warnings;
  d.warnings.insert(d.warnings.end(), in.notices.begin(), in.notices.end());
  warn_of_names(job, d.warnings);
  d.work = found.work, d.freedom = job.options.freedom;
  d.window = {in.problem.start, in.pivot, job.options.shift, in.turn_deg};
  d.pose = found.pose, d.clearance = safe_clearance(found, in);
  d.min_allowance = job.options.min_allowance;
  if (d.inside()) d.contacts = with_file_numbers(std::move(found.contacts), in);
  if (job.outputs.allowances) made.allowances = allowances_csv(in, d);
  if (job.outputs.picture) {
    LEKALO_TRY(made.picture, picture(job, in, d));
  }
  made.result = io::result_json(d);
  LEKALO_CHECK(self_check(job, made));
  return made;
}

}  // namespace lekalo::jobs
