#include "touched_blank.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "lekalo/base/angle.hpp"
#include "lekalo/locate/touched_solid.hpp"

namespace lekalo::jobs {
namespace {

/// A point is off by so much at most for each of its coordinates: the square root of 3, rounded up.
constexpr double kDiagonal = 1.7321;

Result<io::SolidFile> read(const File& file, const SolidLocateJob& job, bool touches, SolidInputs& in) {
  LEKALO_TRY(io::SolidFile parsed, io::parse_solid(file.bytes, file.name, {job.options.units}));
  in.notices.insert(in.notices.end(), parsed.notices.begin(), parsed.notices.end());
  if (parsed.mesh.triangles.empty() == touches) return parsed;
  return failure(
      ErrorCode::bad_input,
      fmt::format("{}: {}", file.name,
                  touches ? "this is a mesh, and --nominal-blank goes with a file of touches: x y z on each "
                            "line, or x y z "
                            "and a direction nx ny nz"
                          : "these are points; --nominal-blank is the mesh of the blank as it should be"));
}

/// The triangles as their file turns them, for who reads the mesh counts corners there.
solid::Mesh as_in_file(solid::Mesh mesh, const std::vector<bool>& turned) {
  for (std::size_t t = 0; t < turned.size(); ++t)
    if (turned[t]) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  return mesh;
}

}  // namespace

Result<void> move_nominal(const SolidLocateJob& job, SolidInputs& in) {
  const SolidScanOptions& scan = *job.options.scan;
  const SolidTouchOptions& touch = *job.options.touch;
  LEKALO_TRY(const io::SolidFile touches, read(job.blank, job, true, in));
  LEKALO_TRY(io::SolidFile nominal, read(*job.nominal, job, false, in));
  ReadSolid& read = in.nominal.emplace();
  read.unit = nominal.unit, read.triangles = nominal.mesh.triangles.size();
  if (nominal.deviation)
    in.notices.push_back(
        fmt::format("{}: its triangles are within {} mm of the STEP model, and --form is said of "
                    "the triangles: it has to have room for that",
                    job.nominal->name, *nominal.deviation));
  const auto named = [](const File& file, const Error& error) {
    return failure(error.code, fmt::format("{}: {}", file.name, error.message));
  };
  const double nominal_error = nominal.coordinate_error;
  Result<solid::ClosedMesh> closed = solid::closed_mesh(std::move(nominal.mesh));
  if (!closed) return named(*job.nominal, closed.error());
  for (const std::string& notice : closed->notices) in.notices.push_back(job.nominal->name + ": " + notice);

  locate::TouchStatement stated;
  stated.ball = touch.ball, stated.form = touch.form;
  stated.guard = scan.coverage_factor * scan.uncertainty + kDiagonal * touches.coordinate_error;
  stated.shift = touch.shift, stated.turn = touch.turn_deg * kDegree;
  stated.drop_outliers = scan.drop_outliers;
  stated.coordinate_error = std::max(nominal_error, touches.coordinate_error);
  stated.directions = touches.directions;
  if (!touches.directions.empty() && touch.ball == 0)
    in.notices.push_back(
        fmt::format("{}: the directions say nothing of points of the surface, as touches are "
                    "without --ball MM",
                    job.blank.name));
  Result<locate::TouchedSolid> made = locate::touched_solid(closed->mesh, touches.mesh.vertices, stated);
  if (!made) return named(job.blank, made.error());
  for (const std::string& notice : made->notices) in.notices.push_back(job.blank.name + ": " + notice);
  if (!made->left_out.empty())
    in.notices.push_back(fmt::format("{}: {} touches lie more than {} mm off and are left out",
                                     job.blank.name, made->left_out.size(), *scan.drop_outliers));

  const solid::Mesh moved = as_in_file(std::move(made->mesh), closed->turned);
  in.meshed =
      MeshedPoints{{job.outputs.mesh, io::ply_text(moved)}, touches.unit, touches.mesh.vertices.size()};
  Result<solid::ClosedMesh> blank = solid::closed_mesh(moved);
  if (!blank) return named(*job.nominal, blank.error());
  if (blank->numbers.size() != moved.triangles.size())
    return failure(
        ErrorCode::bad_input,
        fmt::format("{}: it has triangles so thin that they have no area once they are moved; give "
                    "a mesh without them",
                    job.nominal->name));
  in.blank.triangles = moved.triangles.size();
  in.blank.numbers = std::move(blank->numbers), in.blank.turned = std::move(blank->turned);
  const std::vector<std::uint32_t>& out = made->left_out;
  for (std::size_t k = 0, next = 0; k < touches.mesh.vertices.size(); ++k)
    if (next < out.size() && out[next] == k)
      ++next;
    else
      in.points.push_back(touches.mesh.vertices[k]);
  locate::SolidProblem& p = in.problem;
  p.blank = std::move(blank->mesh);
  p.blank_widths = std::move(made->widths), p.blank_width_error = made->width_error;
  io::SolidScanRecord& record = in.scan.emplace();
  record.guard = stated.guard, record.widest = made->widest;
  record.touches =
      io::SolidTouchRecord{touch.ball, touch.form, !touches.directions.empty(), std::move(made->proof)};
  record.left_out = std::move(made->left_out), record.assumptions = std::move(made->assumptions);
  return {};
}

}  // namespace lekalo::jobs
