#include "pocket_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "earlier_programs.hpp"
#include "hot_cuts.hpp"
#include "interrupt.hpp"
#include "judged_program.hpp"
#include "lekalo/base/version.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/draw/voxel_pictures.hpp"
#include "lekalo/io/locate/result_json.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "lekalo/mill/floz_field.hpp"
#include "lekalo/mill/fragments.hpp"
#include "outputs.hpp"
#include "pocket_input.hpp"
#include "simulate_report.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

/// The path begins where the checker finds that the programs cut.
Result<CutBefore> cut_before(const PocketOptions& o) {
  Result<EarlierPrograms> programs = read_earlier(o.after);
  if (!programs) return tl::unexpected(programs.error());
  CutBefore before{std::move(*programs), {}};
  for (const verify::EarlierProgram& earlier : before.programs.programs()) {
    const auto stretches = verify::cut_stretches(earlier.program, 0);
    if (!stretches) return tl::unexpected(stretches.error());
    for (const verify::CutStretch& s : *stretches) {
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

Result<mill::PocketPath> planned(const char* what, const std::vector<geom::Region>& pockets,
                                 const mill::PocketOptions& options,
                                 const std::vector<mill::EarlierCut>& before) {
  ProgressLine line(what, kOnCtrlC);
  return mill::pocket_path(pockets, options, before, [&](const Progress& p) { line.show(p); });
}

/// A larger tool that has cut what this program cuts with it.
Result<CutBefore> supposed_before(const PocketOptions& o) {
  if (!(o.rest_of > o.path.tool_diameter))
    return failure(ErrorCode::bad_input,
                   fmt::format("--rest {:g}: the tool before is to be larger than this one, {:g} mm",
                               o.rest_of, o.path.tool_diameter));
  PocketOptions first = o;
  first.path.tool_diameter = o.rest_of;
  const Result<PocketInput> input = read_pocket_input(first);
  if (!input) return tl::unexpected(input.error());
  const Result<mill::PocketPath> path = planned("planning the tool before", input->extended, first.path, {});
  if (!path)
    return failure(path.error().code,
                   fmt::format("{}: --rest {:g}: {}", o.pocket, o.rest_of, path.error().message));
  CutBefore before;
  before.cuts = mill::cuts_of(*path, o.rest_of);
  before.programs.files = {{"the program of the tool before", o.rest_of}};
  before.programs.texts = {mill::program_of(*path, {})};
  return before;
}

std::string report_json(const PocketOptions& o, const PocketInput& input, const CutBefore& before,
                        const JudgedProgram& judged) {
  const verify::SimulateReport& r = judged.report;
  using Json = nlohmann::ordered_json;
  Json inputs{{{"role", "pocket"}, {"path", o.pocket}, {"sha256", io::sha256(input.bytes)}}};
  inputs.insert(inputs.end(), before.programs.inputs.begin(), before.programs.inputs.end());
  Json json{{"format", {{"name", "lekalo-pocket"}, {"version", 1}}},
            {"units", "mm"},
            {"inputs", std::move(inputs)},
            {"outputs", {{{"role", "program"}, {"path", o.output}, {"sha256", io::sha256(judged.text)}}}},
            {"tool_mm", o.path.tool_diameter},
            {"step_over", o.path.step_over},
            {"depth_mm", o.path.depth},
            {"stock_to_leave_mm", o.path.stock_to_leave}};
  if (o.rest_of > 0) json["rest_of_mm"] = o.rest_of;
  json.update(report_fields(r));
  json["hot_cuts"] = hot_cuts(r, o.path.step_over);
  json["ramps"] = ramps(judged.ramps);
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
Result<void> add_images(const PocketOptions& o, const PocketInput& input, disk::AtomicFiles& files,
                        std::vector<std::string>& written) {
  constexpr std::size_t kNodes = 500;
  const Result<field::FieldGrid> grid = mill::floz_field(input.extended, o.path, kNodes);
  if (!grid) return tl::unexpected(grid.error());
  const auto pictures = draw::voxel_pngs(field::voxel_images(*grid));
  if (!pictures) return tl::unexpected(pictures.error());
  const Result<std::string> value = draw::value_png(*grid);
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
  std::vector<NamedPath> inputs{{"pocket", o.pocket}};
  for (const EarlierFile& file : o.after) inputs.push_back({"--after", file.path});
  if (Result<void> good =
          check_outputs({{"-o", o.output}, {"--picture", o.picture}, {"--animation", o.animation}}, inputs);
      !good)
    return tl::unexpected(good.error());
  const Result<PocketInput> input = read_pocket_input(o);
  if (!input) return tl::unexpected(input.error());
  const Result<CutBefore> before = o.rest_of > 0 ? supposed_before(o) : cut_before(o);
  if (!before) return tl::unexpected(before.error());
  const Result<mill::PocketPath> path = planned("planning the path", input->extended, o.path, before->cuts);
  if (!path) return failure(path.error().code, fmt::format("{}: {}", o.pocket, path.error().message));
  o.program.comments = comments_of(o);
  const Result<JudgedProgram> judged = judged_program(*path, *input, *before, o);
  if (!judged) return tl::unexpected(judged.error());
  const std::string& program = judged->text;
  const verify::SimulateReport& report = judged->report;
  disk::AtomicFiles files;
  std::vector<std::string> written{o.output, o.picture, o.animation};
  CutPictures pictures{o.picture, o.animation, {}};
  if (o.path.method != mill::Method::fronts && !o.path.whole) {
    Result<std::vector<geom::Region>> fragments = mill::convex_fragments(input->extended);
    if (!fragments) return tl::unexpected(fragments.error());
    pictures.fragments = std::move(*fragments);
  }
  if (Result<void> done = add_cut_pictures(pictures, o.pocket, input->pockets, o.path.tool_diameter,
                                           o.path.stock_to_leave, report, files);
      !done)
    return tl::unexpected(done.error());
  if (!o.images.empty())
    if (Result<void> done = add_images(o, *input, files, written); !done) return tl::unexpected(done.error());
  if (!o.output.empty())
    if (Result<void> done = files.add(o.output, program); !done) return tl::unexpected(done.error());
  if (Result<void> done = files.commit(); !done) return tl::unexpected(done.error());
  if (o.json || o.output.empty()) {
    if (Result<void> done = print(o.json ? report_json(o, *input, *before, *judged) : program); !done)
      return tl::unexpected(done.error());
  }
  std::string text;
  for (const std::string& notice : input->notices) text += notice + "\n";
  if (o.rest_of > 0)
    text += fmt::format(
        "Supposed: a tool of {:g} mm has cut all that lekalo pocket cuts with it (--after FILE:{:g} "
        "takes the program that ran)\n",
        o.rest_of, o.rest_of);
  text += ramp_notices(ramps(judged->ramps));
  text += hot_cut_notices(hot_cuts(report, o.path.step_over));
  text += report_rows(report);
  for (const std::string& name : written)
    if (!name.empty()) text += fmt::format("Written: {}\n", name);
  tell(text);
  return 0;
}

}  // namespace lekalo::cli
