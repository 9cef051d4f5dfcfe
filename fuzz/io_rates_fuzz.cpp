// Any bytes as a file of rates: one sentence, or rates in their ranges, each material of which is found.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "lekalo/io/layout/rates_file.hpp"
#include "require.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lekalo;
  const auto rates = io::read_rates(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz.json");
  if (!rates) {
    require(rates.error().code == ErrorCode::bad_input && rates.error().message.starts_with("fuzz.json"));
    return 0;
  }
  require(rates->currency.size() == 3 && rates->decimals >= 0 && rates->decimals <= 4);
  require(rates->per_hour >= 0 && rates->per_hour <= 1'000'000'000 * io::kOneInMillionths);
  require(rates->setup_once_ms >= 0 && rates->setup_per_sheet_ms >= 0);
  for (std::size_t axis = 0; axis < 3; ++axis)
    require(rates->machine.rapid_mm_per_min[axis] >= 1 && rates->machine.acceleration_mm_per_s2[axis] >= 1);
  require(!rates->materials.empty());
  for (const io::MaterialRate& rate : rates->materials) {
    const auto found = io::find_rate(*rates, {rate.material, rate.thickness}, rate.sheet);
    require(found && (*found)->material == rate.material && (*found)->thickness == rate.thickness);
  }
  return 0;
}
