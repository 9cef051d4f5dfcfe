// Any bytes as a file of processes: one sentence, or entries each of which is found and gives a request.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "lekalo/io/layout/process_file.hpp"
#include "require.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lekalo;
  const auto file =
      io::read_processes(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz.json");
  if (!file) {
    require(file.error().code == ErrorCode::bad_input && file.error().message.starts_with("fuzz.json"));
    return 0;
  }
  require(!file->processes.empty());
  for (std::size_t i = 0; i < file->processes.size(); ++i) {
    const io::CutProcess& process = file->processes[i];
    const auto found = io::find_process(*file, process.material, process.thickness_mm, process.kind);
    require(found && *found == i);
    const auto request = io::process_request(process, {}, "");
    require(request && request->form == io::ExportForm::gcode);
    const nc::ProfileOptions& p = request->profile;
    require(p.kerf_mm >= 0.01 && p.kerf_mm <= 100 && p.tolerance_mm <= 0.25 * p.kerf_mm);
    require(p.feed_mm_per_min >= 0.1 && std::isfinite(p.feed_mm_per_min));
    double before = 0;
    for (const nc::HoleCut& hole : p.holes) {
      require(hole.up_to_diameter_mm > before && hole.feed_share * p.feed_mm_per_min >= 0.1);
      before = hole.up_to_diameter_mm;
    }
  }
  return 0;
}
