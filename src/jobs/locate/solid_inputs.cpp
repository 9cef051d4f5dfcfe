#include "solid_inputs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/counted.hpp"
#include "lekalo/base/limits.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/solid/crossing.hpp"
#include "point_blank.hpp"
#include "touched_blank.hpp"

namespace lekalo::jobs {
namespace {

using locate::SolidFreedom;
using locate::SolidPose;
using solid::Vector;

/// Stands for all turns.
constexpr double kAllTurnsDeg = 180;

enum class FileKind : std::uint8_t { outline, scan, points, solid };

FileKind kind_of(const File& file) {
  if (io::is_only_solid(file.bytes, file.name)) return FileKind::solid;
  const io::FileFormat* const format = io::solid_format_by_content(file.bytes);
  if (format == &io::kPlyFormat) return FileKind::scan;
  return format == &io::kPointsFormat ? FileKind::points : FileKind::outline;
}

tl::unexpected<Error> refuse_points(const std::string& name, const char* way_out) {
  return failure(ErrorCode::bad_input,
                 fmt::format("{}: points are not a closed surface, so nothing says where the material is; {}",
                             name, way_out));
}

tl::unexpected<Error> refuse_pair(const std::string& solid, const std::string& outline) {
  return failure(ErrorCode::bad_input,
                 fmt::format("{} is a solid and {} is none; give both as solids (STL, PLY, OBJ, 3MF), the "
                             "blank as points \"x y z\" too, or both as outlines in the plane",
                             solid, outline));
}

/// Refuses a surface that goes through itself: nobody can say of it what is inside.
Result<void> refuse_crossings(const std::string& name, const solid::Mesh& mesh,
                              const std::vector<std::uint32_t>& numbers, std::vector<std::string>& notices) {
  const solid::Crossings found = solid::crossings(mesh);
  const auto where = [&](const solid::Crossing& crossing) {
    return fmt::format(
        "({:.6g}, {:.6g}, {:.6g}), on triangle {}{}", crossing.place.x, crossing.place.y, crossing.place.z,
        numbers[crossing.triangle] + 1,
        crossing.other ? fmt::format(" through triangle {}", numbers[*crossing.other] + 1) : "");
  };
  if (found.changing)
    return failure(
        ErrorCode::bad_input,
        fmt::format("{}: the surface crosses itself at {}, and beyond that nothing says which side "
                    "is material; unite bodies that overlap, or mend the mesh, in the program that "
                    "it comes from",
                    name, where(*found.changing)));
  if (found.first)
    notices.push_back(
        fmt::format("{}: {}, the first at {}; what lies between is nowhere {} mm thick as far as was looked, "
                    "and all surfaces count as they are",
                    name,
                    counted(found.edges, "edge goes through another triangle or ends on it",
                            "edges go through other triangles or end on them"),
                    where(*found.first), found.depth));
  if (!found.complete)
    notices.push_back(fmt::format(
        "{}: too many of its triangles lie on each other to look at all of them for crossings", name));
  return {};
}

/// A mesh stands for a body as it was drawn, or for a surface through measured points, of which all that is
/// proved rests on the odd count, and so on no side of its sheets.
enum class Surface : std::uint8_t { drawn, measured };

/// Closes the mesh of a file that was read.
Result<void> close_solid(const File& file, io::SolidFile parsed, Surface surface, solid::Mesh& mesh,
                         double& error, ReadSolid& read, std::vector<std::string>& notices) {
  error = parsed.coordinate_error, read.unit = parsed.unit;
  read.triangles = parsed.mesh.triangles.size(), read.deviation = parsed.deviation;
  Result<solid::ClosedMesh> closed = solid::closed_mesh(std::move(parsed.mesh));
  if (!closed) return failure(closed.error().code, fmt::format("{}: {}", file.name, closed.error().message));
  for (const std::string& notice : closed->notices) notices.push_back(file.name + ": " + notice);
  if (surface == Surface::drawn)
    LEKALO_CHECK(refuse_crossings(file.name, closed->mesh, closed->numbers, notices));
  read.volume = 0;
  for (const solid::Shell& shell : closed->shells)
    if (shell.depth && read.volume)
      *read.volume += shell.volume;
    else
      read.volume.reset();
  mesh = std::move(closed->mesh);
  read.numbers = std::move(closed->numbers);
  read.turned = std::move(closed->turned);
  return {};
}

/// A blank of points is meshed first, or a nominal mesh moved to them; so is one whose mesh does not close,
/// from its corners, if that has a name.
Result<void> read_blank(const SolidLocateJob& job, const PhaseListener& phases, SolidInputs& in) {
  if (job.nominal) return move_nominal(job, in);
  LEKALO_TRY(io::SolidFile parsed, io::parse_solid(job.blank.bytes, job.blank.name, {job.options.units}));
  in.notices.insert(in.notices.end(), parsed.notices.begin(), parsed.notices.end());
  const bool points = parsed.mesh.triangles.empty() && !parsed.mesh.vertices.empty();
  if (!points) {
    io::SolidFile kept = job.outputs.mesh.empty() ? io::SolidFile{} : parsed;
    const Surface surface = job.options.scan ? Surface::measured : Surface::drawn;
    Result<void> closed = close_solid(job.blank, std::move(parsed), surface, in.problem.blank,
                                      in.problem.blank_coordinate_error, in.blank, in.notices);
    if (closed) {
      if (!job.outputs.mesh.empty())
        in.notices.push_back(
            fmt::format("{} closes as it is, so {} is not written", job.blank.name, job.outputs.mesh));
      return {};
    }
    if (job.outputs.mesh.empty()) return closed;
    in.notices.push_back(fmt::format("{}; it is meshed anew from its corners", closed.error().message));
    parsed = std::move(kept);
  }
  if (!parsed.directions.empty())
    in.notices.push_back(
        fmt::format("{}: the last three of six numbers on each line, directions or colours, are "
                    "not used",
                    job.blank.name));
  LEKALO_CHECK(mesh_points(job, parsed, phases, in));
  LEKALO_TRY(io::SolidFile meshed,
             io::parse_solid(in.meshed->mesh.bytes, in.meshed->mesh.name, {io::SolidUnit::millimetre}));
  // Nobody can mend its surface where points of two sides lie close.
  std::vector<std::string> unsaid;
  LEKALO_CHECK(close_solid(in.meshed->mesh, std::move(meshed), Surface::measured, in.problem.blank,
                           in.problem.blank_coordinate_error, in.blank, unsaid));
  in.problem.blank_coordinate_error = parsed.coordinate_error;
  return {};
}

/// Finds the triangles of each feature in the part as its file has them.
Result<void> read_features(const SolidLocateJob& job, const io::SolidFile& part, SolidInputs& in) {
  if (!job.features) return {};
  LEKALO_TRY(const io::SolidFeatureFile file,
             io::parse_solid_features(job.features->bytes, job.features->name, part.unit));
  io::SolidDemandRecord& demands = in.demands.emplace();
  demands.minimum.reset();
  if (!file.as_cast) demands.minimum = std::max(job.options.min_allowance, file.minimum.value_or(0));
  LEKALO_TRY(demands.features, io::find_solid_features(file, part));
  demands.largest.resize(demands.features.size());
  LEKALO_TRY(in.problem.datums, io::find_solid_datums(file, demands.features, part));
  for (const io::SolidDatumSpec& datum : file.datums)
    demands.datums.push_back({datum.name, datum.datum.within, 0});
  return {};
}

/// Tells which triangles that were placed have a maximum, or are finished.
void set_nears(SolidInputs& in) {
  const auto& features = in.demands->features;
  std::vector<std::optional<std::size_t>> feature_of(in.part.triangles);
  for (std::size_t k = 0; k < features.size(); ++k)
    if (features[k].within())
      for (const std::uint32_t t : features[k].triangles) feature_of[t] = k;
  std::vector<std::vector<std::uint32_t>> triangles(features.size());
  for (std::uint32_t t = 0; t < in.part.numbers.size(); ++t)
    if (const auto feature = feature_of[in.part.numbers[t]]) triangles[*feature].push_back(t);
  for (std::size_t k = 0; k < features.size(); ++k) {
    if (triangles[k].empty()) continue;
    in.problem.nears.push_back({std::move(triangles[k]), *features[k].within(), features[k].rim});
    in.near_features.push_back(k);
  }
}

/// Gives the triangles that were placed the demands of their features.
Result<void> set_demands(const SolidLocateJob& job, SolidInputs& in) {
  if (!in.demands) return {};
  std::optional<locate::SolidDemand> others;
  if (in.demands->minimum) others = {*in.demands->minimum, 1};
  std::vector<std::optional<locate::SolidDemand>> of_file(in.part.triangles, others);
  std::vector<std::optional<double>> targets(in.part.triangles);
  for (const io::SolidFeature& feature : in.demands->features)
    for (const std::uint32_t t : feature.triangles) of_file[t] = feature.demand, targets[t] = feature.target;
  for (const std::uint32_t number : in.part.numbers) {
    in.problem.demands.push_back(of_file[number]);
    in.problem.targets.push_back(targets[number]);
  }
  set_nears(in);
  const auto& demands = in.problem.demands;
  if (std::any_of(demands.begin(), demands.end(), [](const auto& one) { return one.has_value(); })) return {};
  return failure(ErrorCode::bad_input,
                 fmt::format("{}: all of the part is as cast or finished, so no placement is better than "
                             "another; leave triangles that demand an allowance",
                             job.features->name));
}

Result<void> read_start(const std::optional<File>& file, SolidPose& start) {
  if (!file) return {};
  LEKALO_TRY(const io::WrittenResult earlier, io::read_result(file->bytes, file->name));
  if (!earlier.solid_pose)
    return failure(ErrorCode::bad_input,
                   fmt::format("{}: this is a result for outlines in the plane; a solid starts from a result "
                               "for solids",
                               file->name));
  start = *earlier.solid_pose;
  double square = 0;
  for (const double q : start.quaternion) square += q * q;
  const Vector at = start.shift;
  if (std::abs(square - 1) < 1e-6 &&
      std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}) <= limits::kLargestCoordinate)
    return {};
  return failure(
      ErrorCode::bad_input,
      fmt::format("{}: the pose ({}, {}, {}) mm with the quaternion [{}, {}, {}, {}] is out of all "
                  "measure",
                  file->name, at.x, at.y, at.z, start.quaternion[0], start.quaternion[1], start.quaternion[2],
                  start.quaternion[3]));
}

/// The pose with the part turned about the vertical through the place of one of its points.
SolidPose turned_about_vertical(const SolidPose& pose, Vector pivot, double degrees) {
  if (degrees == 0) return pose;
  const geom::SinCos half = geom::sincos(0.5 * degrees * kDegree);
  const double c = half.cosine, s = half.sine;
  const auto [w, x, y, z] = pose.quaternion;
  SolidPose turned{{c * w - s * z, c * x - s * y, c * y + s * x, c * z + s * w}, {}};
  turned.shift = motion_of(pose)(pivot) - motion_of(turned).turned(pivot);
  return turned;
}

/// An angle whose tangent, as the search computes it, is not below that of the angle in degrees, which the
/// result states.
double radians_up(double degrees) {
  if (degrees == 0) return 0;
  if (degrees == kAllTurnsDeg) return locate::SolidProblem::kAllTurns;
  return std::min(degrees * kDegree * (1 + 0x1p-50) + 4 * geom::kSinCosError, 0.5 * kPi);
}

/// How far the pivot may be from its place at the start, along any axis, while the part is inside the blank:
/// a corner of it that demands something lies in the blank's box then. In tenths of a millimetre.
double shift_within_blank(const locate::SolidProblem& p, Vector pivot) {
  constexpr double kTenths = 10;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < p.part.triangles.size(); ++t)
    if (p.demands.empty() || p.demands[t])
      for (const std::uint32_t v : p.part.triangles[t])
        nearest = std::min(nearest, norm(p.part.vertices[v] - pivot));
  const solid::Box blank = box_of(p.blank.vertices);
  const Vector at = motion_of(p.start)(pivot), below = at - blank.low, above = blank.high - at;
  const double most = nearest + std::max({below.x, below.y, below.z, above.x, above.y, above.z});
  return (std::floor(kTenths * most) + 1) / kTenths;
}

/// Gives the blank's triangles their widths.
Result<void> read_scan(const SolidScanOptions& how, SolidInputs& in) {
  /// A point is off by so much at most for each of its coordinates: the square root of 3, rounded up.
  constexpr double kDiagonal = 1.7321;
  locate::SolidProblem& p = in.problem;
  locate::SolidScan scan;
  scan.coordinate_error = p.blank_coordinate_error;
  scan.guard = how.coverage_factor * how.uncertainty + kDiagonal * scan.coordinate_error;
  scan.min_radius = how.min_radius, scan.max_dip = how.max_dip, scan.underside = how.underside;
  LEKALO_TRY(locate::GuaranteedSolid made, locate::guaranteed_solid(p.blank, scan));
  if (!in.left_out.empty())
    made.assumptions.push_back(
        fmt::format("the {} points that are left out are none of the surface", in.left_out.size()));
  in.scan = io::SolidScanRecord{scan.guard,
                                scan.min_radius,
                                scan.max_dip,
                                scan.underside,
                                made.widest,
                                made.unknown.size(),
                                made.unknown_area,
                                std::move(in.left_out),
                                std::move(made.assumptions)};
  in.unknown = std::move(made.unknown);
  p.blank_widths = std::move(made.widths);
  p.blank_width_error = made.width_error;
  return {};
}

Result<void> read_part(const SolidLocateJob& job, SolidInputs& in) {
  LEKALO_TRY(io::SolidFile parsed, io::parse_solid(job.part.bytes, job.part.name, {job.options.units}));
  if (parsed.mesh.triangles.empty() && !parsed.mesh.vertices.empty())
    return refuse_points(job.part.name, "export the part as STL, PLY or OBJ with triangles");
  in.notices.insert(in.notices.end(), parsed.notices.begin(), parsed.notices.end());
  LEKALO_CHECK(read_features(job, parsed, in));
  LEKALO_CHECK(close_solid(job.part, std::move(parsed), Surface::drawn, in.problem.part,
                           in.problem.part_coordinate_error, in.part, in.notices));
  return set_demands(job, in);
}

}  // namespace

Result<bool> are_solids(const File& part, const File& blank) {
  const FileKind of_part = kind_of(part), of_blank = kind_of(blank);
  if (of_part != FileKind::solid && of_blank != FileKind::solid && of_part != FileKind::scan) return false;
  if (of_part == FileKind::points)
    return refuse_points(part.name, "export the part as STL, PLY or OBJ with triangles");
  if (of_part == FileKind::outline) return refuse_pair(blank.name, part.name);
  if (of_blank == FileKind::outline) return refuse_pair(part.name, blank.name);
  return true;
}

double SolidInputs::deviation() const noexcept {
  if (!part.deviation && !blank.deviation) return 0;
  // Rounded up: the numbers are the doubles nearest to those of the files.
  return (part.deviation.value_or(0) + blank.deviation.value_or(0)) * (1 + 0x1p-51) + 0x1p-1074;
}

double SolidInputs::least_scale() const noexcept {
  double least = 1;
  for (const auto& demand : problem.demands)
    if (demand) least = std::min(least, demand->scale);
  return least;
}

Result<SolidInputs> read_inputs(const SolidLocateJob& job, const PhaseListener& phases) {
  SolidInputs in;
  LEKALO_CHECK(read_part(job, in));
  LEKALO_CHECK(read_blank(job, phases, in));
  if (job.options.scan && !job.nominal) LEKALO_CHECK(read_scan(*job.options.scan, in));
  if (in.meshed && !job.nominal) LEKALO_CHECK(hold_against_points(job, in));
  LEKALO_CHECK(read_start(job.start, in.problem.start));
  const solid::Box box = box_of(in.problem.part.vertices);
  in.pivot = 0.5 * (box.low + box.high);
  in.problem.freedom = job.options.freedom;
  return in;
}

void set_window(const SolidLocateOptions& o, SolidInputs& in) {
  constexpr double kUsualShift = 5;
  locate::SolidProblem& p = in.problem;
  if (o.freedom == SolidFreedom::six) in.turn_deg = o.tilt_deg;
  if (o.freedom == SolidFreedom::c_xyz && o.window_to_deg - o.window_from_deg >= 2 * kAllTurnsDeg) {
    in.turn_deg = kAllTurnsDeg;
  } else if (o.freedom == SolidFreedom::c_xyz) {
    const double middle = 0.5 * (o.window_from_deg + o.window_to_deg);
    in.turn_deg = std::max(o.window_to_deg - middle, middle - o.window_from_deg);
    p.start = turned_about_vertical(p.start, in.pivot, middle);
  }
  p.turn = radians_up(in.turn_deg);
  const bool all = in.turn_deg == kAllTurnsDeg;
  p.shift = o.shift.value_or(all ? shift_within_blank(p, in.pivot) : kUsualShift);
}

}  // namespace lekalo::jobs
