// A region file as a pocket, with a tool from the first bytes: no crash, and what is written the checker
// reads and finds within the walls.

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/geom/region_check.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "lekalo/mill/pocket.hpp"
#include "lekalo/mill/program.hpp"
#include "lekalo/mill/ramps.hpp"
#include "lekalo/mill/relief.hpp"
#include "lekalo/verify/simulate.hpp"
#include "require.hpp"

namespace {

/// Passes ahead of stretches that are said to be hot, and ramps in them, whether they are or not: none may
/// leave the pocket.
lekalo::mill::PocketPath with_passes(const lekalo::mill::PocketPath& path,
                                     const std::vector<lekalo::geom::Region>& pockets,
                                     const lekalo::mill::PocketOptions& options, unsigned seed) {
  using namespace lekalo;
  Random random(seed, 1);
  auto relief = mill::Relief::make(path, pockets, options);
  require(relief.has_value());
  const auto loads = [&](const mill::PocketPath& of) {
    std::vector<std::vector<mill::MoveLoad>> made(of.moves.size());
    for (auto& of_move : made)
      for (int piece = 0; piece < 4; ++piece) {
        const double degrees = random.below(4) == 0 ? 180 * random.uniform() : 0;
        of_move.push_back({random.uniform(), degrees, degrees * random.uniform()});
      }
    return made;
  };
  for (int round = 0; relief->improve(loads(relief->path())); ++round) require(round < 10000);
  return mill::with_ramps(relief->path(), loads(relief->path()), options).path;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lekalo;
  if (size < 4) return 0;
  mill::PocketOptions options;
  options.tool_diameter = 2 + data[0] % 16;
  options.step_over = 0.1 + 0.05 * (data[1] % 8);
  options.stock_to_leave = 0.25 * (data[1] / 64);
  options.step_down = data[2] % 3 == 0 ? 0.5 : 0;
  options.method = static_cast<mill::Method>(data[3] % 8 < 6 ? 0 : data[3] % 8 - 5);
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 4, size - 4);
  const auto file = io::parse_regions(bytes, "pocket.json");
  if (!file || geom::fault_of(file->regions)) return 0;
  double extent = 0;
  for (const geom::Region& region : file->regions) {
    const geom::Box box = geom::bounds(region.outer);
    extent = std::max({extent, box.high.x - box.low.x, box.high.y - box.low.y});
  }
  if (!(extent < 4 * options.tool_diameter)) return 0;  // larger pockets take longer, which is no fault
  std::vector<mill::EarlierCut> before;
  if (data[2] % 5 == 0 && options.method == mill::Method::fronts) {
    mill::PocketOptions first = options;
    first.tool_diameter *= 1.5;
    if (const auto path = mill::pocket_path(file->regions, first))
      before = mill::cuts_of(*path, first.tool_diameter);
  }
  const auto path = mill::pocket_path(file->regions, options, before);
  if (!path) {
    require(!path.error().message.empty());
    return 0;
  }
  const mill::PocketPath relieved =
      options.method == mill::Method::fronts ? with_passes(*path, file->regions, options, data[0]) : *path;
  const std::string program = mill::program_of(relieved, {});
  if (data[2] % 16 != 0) return 0;  // the judgement takes longer than the path
  verify::SimulateOptions machining;
  machining.tool_diameter = options.tool_diameter;
  machining.stock_to_leave = options.stock_to_leave;
  machining.spacing = 2;
  const auto report = verify::simulate({"p.ngc", program}, {"pocket.json", bytes}, machining);
  if (!report)
    return 0;  // pockets beyond what the checker takes; a program it cannot read is tested elsewhere
  require(options.method != mill::Method::fronts || report->gouge_mm < 0.05);
  return 0;
}
