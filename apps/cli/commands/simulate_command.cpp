#include "simulate_command.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "earlier_programs.hpp"
#include "interrupt.hpp"
#include "lekalo/base/version.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/io/locate/result_json.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "outputs.hpp"
#include "simulate_report.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string report_json(const SimulateOptions& o, const std::string& program, const std::string& pocket,
                        const EarlierPrograms& earlier, const verify::SimulateReport& r) {
  Json inputs{{{"role", "program"}, {"path", o.program}, {"sha256", io::sha256(program)}},
              {{"role", "pocket"}, {"path", o.pocket}, {"sha256", io::sha256(pocket)}}};
  inputs.insert(inputs.end(), earlier.inputs.begin(), earlier.inputs.end());
  Json json{{"format", {{"name", "lekalo-simulate"}, {"version", 1}}},
            {"units", "mm"},
            {"inputs", std::move(inputs)},
            {"tool_mm", o.machining.tool_diameter},
            {"stock_to_leave_mm", o.machining.stock_to_leave}};
  json.update(report_fields(r));
  json["version"] = kVersion;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string samples_csv(const verify::SimulateReport& r) {
  std::string text = "x,y,z,length,engagement_deg,line,entry\n";
  for (const verify::EngagementSample& s : r.samples)
    text += fmt::format("{:.5f},{:.5f},{:.5f},{:.5f},{:.3f},{},{}\n", s.x, s.y, s.z, s.length, s.engagement,
                        s.line, s.entry ? 1 : 0);
  return text;
}

}  // namespace

Result<int> run_simulate(const SimulateOptions& o) {
  std::vector<NamedPath> inputs{{"program", o.program}, {"--pocket", o.pocket}};
  for (const EarlierFile& file : o.after) inputs.push_back({"--after", file.path});
  if (Result<void> good = check_outputs(
          {{"--samples", o.samples}, {"--picture", o.picture}, {"--animation", o.animation}}, inputs);
      !good)
    return tl::unexpected(good.error());
  const Result<std::string> program = disk::read_file(o.program);
  if (!program) return tl::unexpected(program.error());
  const Result<std::string> pocket = disk::read_file(o.pocket);
  if (!pocket) return tl::unexpected(pocket.error());
  const Result<EarlierPrograms> earlier = read_earlier(o.after);
  if (!earlier) return tl::unexpected(earlier.error());
  const Result<verify::SimulateReport> report = [&] {
    ProgressLine line("following the program", "Ctrl-C ends it, nothing is written");
    return verify::simulate({o.program, *program}, {o.pocket, *pocket}, o.machining, earlier->programs(),
                            [&](const Progress& progress) { line.show(progress); });
  }();
  if (!report) return tl::unexpected(report.error());
  disk::AtomicFiles files;
  if (!o.samples.empty()) {
    if (Result<void> done = files.add(o.samples, samples_csv(*report)); !done)
      return tl::unexpected(done.error());
  }
  if (!o.picture.empty() || !o.animation.empty()) {
    std::vector<geom::Edge> open;
    const Result<io::RegionFile> regions = io::parse_regions(*pocket, o.pocket, {}, &open);
    if (!regions) return tl::unexpected(regions.error());
    if (Result<void> done =
            add_cut_pictures({o.picture, o.animation, {}}, o.pocket, regions->regions,
                             o.machining.tool_diameter, o.machining.stock_to_leave, *report, files);
        !done)
      return tl::unexpected(done.error());
  }
  if (Result<void> done = files.commit(); !done) return tl::unexpected(done.error());
  if (o.json) {
    if (Result<void> done = print(report_json(o, *program, *pocket, *earlier, *report)); !done)
      return tl::unexpected(done.error());
  }
  tell(report_rows(*report));
  return 0;
}

}  // namespace lekalo::cli
