#include "io_contour_check.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lekalo::fuzz::check_contour(data, size, "fuzz.json");
  return 0;
}
