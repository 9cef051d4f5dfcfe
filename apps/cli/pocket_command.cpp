#include "pocket_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "lekalo/base/version.hpp"
#include "lekalo/geom/offset.hpp"
#include "lekalo/geom/region_index.hpp"
#include "lekalo/io/files.hpp"
#include "lekalo/io/region_json.hpp"
#include "lekalo/io/result_json.hpp"
#include "lekalo/io/voxel_pictures.hpp"
#include "lekalo/mill/feeds.hpp"
#include "lekalo/mill/floz_field.hpp"
#include "lekalo/mill/fragments.hpp"
#include "lekalo/verify/simulate.hpp"
#include "outputs.hpp"
#include "pocket_input.hpp"
#include "simulate_report.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

/// What a machine's axes and a few decimals may take of a wall, mm.
constexpr double kMostGouge = 0.005;

/// What is to be cut after a larger tool, as a pocket of its own.
Result<std::string> rest_document(const PocketInput& input, const PocketOptions& o) {
  const auto places = mill::places_to_cut(input.extended, o.path);
  if (!places) return tl::unexpected(places.error());
  const auto pocket = geom::offset(*places, o.path.tool_diameter / 2 + o.path.stock_to_leave);
  if (!pocket) return tl::unexpected(pocket.error());
  return io::regions_json(pocket->regions);
}

/// The written program, as who does not know how it was made finds it; ErrorCode::refuted where it leaves the
/// pocket or crosses material in rapid motion.
Result<verify::SimulateReport> judgement_of(const std::string& program, const PocketInput& input,
                                            const PocketOptions& o) {
  verify::SimulateOptions machining;
  machining.tool_diameter = o.path.tool_diameter;
  machining.stock_to_leave = o.path.stock_to_leave;
  machining.step_over = o.path.step_over;
  Result<verify::SimulateReport> report =
      verify::simulate({"the program", program}, {"pocket.json", input.document}, machining);
  if (report && o.path.rest_of > 0) {
    // Walls are judged by the pocket, the rest by what the larger tool left, as if it stood in full material.
    const double gouge = report->gouge_mm;
    const Result<std::string> rest = rest_document(input, o);
    if (!rest) return tl::unexpected(rest.error());
    report = verify::simulate({"the program", program}, {"rest.json", *rest}, machining);
    if (report) report->gouge_mm = gouge, report->unreachable.clear();
  }
  if (!report)
    return failure(ErrorCode::refuted,
                   "the independent checker cannot read this program; please report the pocket: " +
                       report.error().message);
  if (report->gouge_mm > kMostGouge || report->rapid_cut_mm > 0)
    return failure(
        ErrorCode::refuted,
        fmt::format("{}: the program found would cut {:.4f} mm into what stays, or {:.3f} mm in rapid "
                    "motion; nothing is written, please report the pocket",
                    o.pocket, report->gouge_mm, report->rapid_cut_mm));
  // Corners of what was added beyond open edges are air.
  const geom::RegionIndex drawn(input.pockets);
  std::erase_if(report->unreachable, [&](const verify::UnreachableSpot& spot) {
    return !drawn.contains({spot.x, spot.y});
  });
  return report;
}

/// What the checker found along each move.
std::vector<std::vector<mill::MoveLoad>> loads_of(const verify::SimulateReport& report,
                                                  const std::vector<std::size_t>& move_of_line,
                                                  std::size_t moves) {
  std::vector<std::vector<mill::MoveLoad>> loads(moves);
  for (const verify::EngagementSample& sample : report.samples)
    if (const std::size_t move = move_of_line[sample.line - 1]; move != mill::kNoMove)
      loads[move].push_back({sample.length, sample.engagement});
  return loads;
}

std::string report_json(const PocketOptions& o, const PocketInput& input, const std::string& program,
                        const verify::SimulateReport& r) {
  using Json = nlohmann::ordered_json;
  Json json{{"format", {{"name", "lekalo-pocket"}, {"version", 1}}},
            {"units", "mm"},
            {"inputs", {{{"role", "pocket"}, {"path", o.pocket}, {"sha256", io::sha256(input.bytes)}}}},
            {"outputs", {{{"role", "program"}, {"path", o.output}, {"sha256", io::sha256(program)}}}},
            {"tool_mm", o.path.tool_diameter},
            {"step_over", o.path.step_over},
            {"depth_mm", o.path.depth},
            {"stock_to_leave_mm", o.path.stock_to_leave}};
  json.update(report_fields(r));
  json["version"] = kVersion;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<std::string> comments_of(const PocketOptions& o) {
  const std::size_t slash = o.pocket.find_last_of('/');
  return {"lekalo pocket " + (slash == std::string::npos ? o.pocket : o.pocket.substr(slash + 1)),
          fmt::format("tool {:g} mm depth {:g} mm stock to leave {:g} mm", o.path.tool_diameter, o.path.depth,
                      o.path.stock_to_leave)};
}

/// The source's model in pictures.
Result<void> add_images(const PocketOptions& o, const PocketInput& input, io::AtomicFiles& files,
                        std::vector<std::string>& written) {
  constexpr std::size_t kNodes = 500;
  const Result<field::FieldGrid> grid = mill::floz_field(input.extended, o.path, kNodes);
  if (!grid) return tl::unexpected(grid.error());
  const auto pictures = io::voxel_pngs(field::voxel_images(*grid));
  if (!pictures) return tl::unexpected(pictures.error());
  const Result<std::string> value = io::value_png(*grid);
  if (!value) return tl::unexpected(value.error());
  const auto add = [&](const char* ending, const std::string& bytes) {
    written.push_back(o.images + ending);
    return files.add(written.back(), bytes);
  };
  const std::array<const char*, 4> endings{"-A.png", "-B.png", "-C.png", "-D.png"};
  for (std::size_t k = 0; k < 4; ++k)
    if (Result<void> done = add(endings[k], (*pictures)[k]); !done) return done;
  return add("-value.png", *value);
}

}  // namespace

Result<int> run_pocket(PocketOptions o) {
  if (Result<void> good = check_outputs(
          {{"-o", o.output}, {"--picture", o.picture}, {"--animation", o.animation}}, {{"pocket", o.pocket}});
      !good)
    return tl::unexpected(good.error());
  const Result<PocketInput> input = read_pocket_input(o);
  if (!input) return tl::unexpected(input.error());
  Result<mill::PocketPath> path = mill::pocket_path(input->extended, o.path);
  if (!path) return failure(path.error().code, fmt::format("{}: {}", o.pocket, path.error().message));
  o.program.comments = comments_of(o);
  std::vector<std::size_t> move_of_line;
  std::string program = mill::program_of(*path, o.program, &move_of_line);
  Result<verify::SimulateReport> judged = judgement_of(program, *input, o);
  if (!judged) return tl::unexpected(judged.error());
  if (o.most_feed) {
    path = mill::with_feeds(*path, loads_of(*judged, move_of_line, path->moves.size()),
                            {o.program.feed_mm_per_min, *o.most_feed, o.path.step_over});
    program = mill::program_of(*path, o.program);
    judged = judgement_of(program, *input, o);
    if (!judged) return tl::unexpected(judged.error());
  }
  io::AtomicFiles files;
  std::vector<std::string> written{o.output, o.picture, o.animation};
  CutPictures pictures{o.picture, o.animation, {}};
  if (o.path.method != mill::Method::fronts && !o.path.whole) {
    Result<std::vector<geom::Region>> fragments = mill::convex_fragments(input->extended);
    if (!fragments) return tl::unexpected(fragments.error());
    pictures.fragments = std::move(*fragments);
  }
  if (Result<void> done = add_cut_pictures(pictures, o.pocket, input->pockets, o.path.tool_diameter,
                                           o.path.stock_to_leave, *judged, files);
      !done)
    return tl::unexpected(done.error());
  if (!o.images.empty())
    if (Result<void> done = add_images(o, *input, files, written); !done) return tl::unexpected(done.error());
  if (!o.output.empty())
    if (Result<void> done = files.add(o.output, program); !done) return tl::unexpected(done.error());
  if (Result<void> done = files.commit(); !done) return tl::unexpected(done.error());
  if (o.json || o.output.empty()) {
    if (Result<void> done = print(o.json ? report_json(o, *input, program, *judged) : program); !done)
      return tl::unexpected(done.error());
  }
  std::string text;
  for (const std::string& notice : input->notices) text += notice + "\n";
  text += report_rows(*judged);
  for (const std::string& name : written)
    if (!name.empty()) text += fmt::format("Written: {}\n", name);
  tell(text);
  return 0;
}

}  // namespace lekalo::cli
