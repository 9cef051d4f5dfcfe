#include "lekalo/jobs/pocket.hpp"

#include <fmt/core.h>

#include <cstddef>

#include "jobs/document/earlier_documents.hpp"
#include "lekalo/draw/voxel_pictures.hpp"
#include "lekalo/mill/floz_field.hpp"
#include "lekalo/mill/fragments.hpp"
#include "pocket_ground.hpp"
#include "pocket_judge.hpp"
#include "pocket_report.hpp"
#include "simulate_picture.hpp"

namespace lekalo::jobs {
namespace {

/// The programs of earlier tools, for the checker, and what they have cut, for the path.
struct CutBefore {
  std::vector<EarlierProgram> programs;
  std::vector<mill::EarlierCut> cuts;
};

/// The path begins where the checker finds that the programs cut, because only it reads programs.
Result<CutBefore> cut_by_programs(const PocketJob& job) {
  CutBefore before{job.after, {}};
  for (const EarlierProgram& earlier : job.after) {
    LEKALO_TRY(const auto stretches, verify::cut_stretches({earlier.program.name, earlier.program.bytes}, 0));
    for (const verify::CutStretch& s : stretches) {
      const geom::EdgeKind kind = !s.arc  ? geom::EdgeKind::line
                                  : s.ccw ? geom::EdgeKind::arc_ccw
                                          : geom::EdgeKind::arc_cw;
      before.cuts.push_back({{kind, {s.from_x, s.from_y}, {s.to_x, s.to_y}, {s.centre_x, s.centre_y}},
                             -s.high_z,
                             earlier.tool_diameter});
    }
  }
  return before;
}

/// Supposes that a larger tool has cut what this job would cut with it.
Result<CutBefore> cut_by_larger_tool(const PocketJob& job, const io::ReadOutline& outline,
                                     const PhaseListener& phases) {
  PocketOptions first = job.options;
  if (!(first.rest_of > first.path.tool_diameter))
    return failure(ErrorCode::bad_input,
                   fmt::format("--rest {:g}: the tool before is to be larger than this one, {:g} mm",
                               first.rest_of, first.path.tool_diameter));
  first.path.tool_diameter = first.rest_of;
  LEKALO_TRY(const PocketGround ground, pocket_ground(job.pocket.name, outline, first));
  const Result<mill::PocketPath> path =
      mill::pocket_path(ground.extended, first.path, {}, begin_phase(phases, "planning the tool before"));
  if (!path)
    return failure(path.error().code,
                   fmt::format("{}: --rest {:g}: {}", job.pocket.name, first.rest_of, path.error().message));
  return CutBefore{{{{"the program of the tool before", mill::program_of(*path, {})}, first.rest_of}},
                   mill::cuts_of(*path, first.rest_of)};
}

std::vector<std::string> comments_of(const PocketJob& job) {
  const std::string& name = job.pocket.name;
  const mill::PocketOptions& path = job.options.path;
  return {"lekalo pocket " + name.substr(name.find_last_of('/') + 1),
          fmt::format("tool {:g} mm depth {:g} mm stock to leave {:g} mm", path.tool_diameter, path.depth,
                      path.stock_to_leave)};
}

Result<void> add_pictures(const PocketJob& job, const PocketGround& ground, Pocketed& made) {
  if (!job.picture && !job.animation) return {};
  const mill::PocketOptions& path = job.options.path;
  draw::PocketPicture picture =
      cut_picture_of(job.pocket.name, ground.pockets, path.tool_diameter, path.stock_to_leave, made.report);
  if (path.method != mill::Method::fronts && !path.whole) {
    LEKALO_TRY(picture.fragments, mill::convex_fragments(ground.extended));
  }
  LEKALO_TRY(made.picture, drawn(picture, job.picture));
  if (job.animation) made.animation = draw::pocket_animation(picture);
  return {};
}

/// The source's model in pictures.
Result<void> add_images(const PocketJob& job, const PocketGround& ground, Pocketed& made) {
  if (!job.images) return {};
  constexpr std::size_t kNodes = 500;
  LEKALO_TRY(const field::FieldGrid grid, mill::floz_field(ground.extended, job.options.path, kNodes));
  LEKALO_TRY(const auto pictures, draw::voxel_pngs(field::voxel_images(grid)));
  LEKALO_TRY(const std::string value, draw::value_png(grid));
  made.images = {{"-A.png", pictures[0]},
                 {"-B.png", pictures[1]},
                 {"-C.png", pictures[2]},
                 {"-D.png", pictures[3]},
                 {"-value.png", value}};
  return {};
}

/// \pre the comments of the program are those of this job
Result<Pocketed> made_and_judged(const PocketJob& job, const PhaseListener& phases) {
  LEKALO_TRY(io::ReadOutline outline, pocket_outline(job));
  LEKALO_TRY(const PocketGround ground, pocket_ground(job.pocket.name, outline, job.options));
  LEKALO_TRY(const CutBefore before,
             job.options.rest_of > 0 ? cut_by_larger_tool(job, outline, phases) : cut_by_programs(job));
  Result<mill::PocketPath> path = mill::pocket_path(ground.extended, job.options.path, before.cuts,
                                                    begin_phase(phases, "planning the path"));
  if (!path) return failure(path.error().code, job.pocket.name + ": " + path.error().message);
  LEKALO_TRY(JudgedProgram judged,
             judged_program(std::move(*path), job, ground, earlier_documents(before.programs), phases));
  Pocketed made;
  made.program = std::move(judged.text);
  made.report = std::move(judged.report);
  made.hot_cuts = hot_cuts(made.report, job.options.path.step_over);
  made.ramps = reported_ramps(judged.ramps);
  made.notices = std::move(outline.notices);
  const std::string supposed = job.options.rest_of > 0 ? before.programs.front().program.bytes : "";
  made.json = pocket_json(job, made, outline, ground.document, supposed);
  LEKALO_CHECK(add_pictures(job, ground, made));
  LEKALO_CHECK(add_images(job, ground, made));
  return made;
}

}  // namespace

Result<Pocketed> pocket(PocketJob job, const PhaseListener& phases) {
  job.options.program.comments = comments_of(job);
  return made_and_judged(job, phases);
}

}  // namespace lekalo::jobs
