// The first line of the bytes is a pocket, the rest a program. Whatever is not refused has figures that make
// sense, and the same ones again.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "lekalo/verify/simulate.hpp"
#include "require.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lekalo::verify;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::size_t end = std::min(bytes.find('\n'), bytes.size());
  SimulateOptions options;
  options.tool_diameter = 6;
  options.spacing = 0.5;
  const Document pocket{"pocket.json", bytes.substr(0, end)};
  const Document program{"p.ngc", bytes.substr(std::min(end + 1, bytes.size()))};
  const auto report = simulate(program, pocket, options);
  if (!report) {
    require(report.error().code == lekalo::ErrorCode::bad_input && !report.error().message.empty());
    return 0;
  }
  require(report->coverage_percent >= -1e-6 && report->coverage_percent <= 100 + 1e-6);
  require(report->coverage_low_percent <= report->coverage_percent + 1e-6);
  require(report->gouge_mm >= -1e-9 && report->uncut_mm2 >= 0 && report->reachable_mm2 >= 0);
  require(report->engagement_max_deg <= 180 + 1e-6 && report->engagement_peak_deg <= 180 + 1e-6);
  require(report->engagement_p95_deg <= report->engagement_peak_deg + 1e-9);
  require(report->air_percent >= 0 && report->air_percent <= 100 + 1e-9 && report->seconds >= 0);
  require(std::isfinite(report->length_mm) && std::isfinite(report->seconds));
  const auto again = simulate(program, pocket, options);
  require(again && again->engagement_p95_deg == report->engagement_p95_deg &&
          again->uncut_mm2 == report->uncut_mm2);
  return 0;
}
