#include "io_drawing_check.hpp"
#include "lekalo/io/dxf/dxf.hpp"

// parse_dxf on any bytes: a sentence, or a sound drawing.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lekalo;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto unit = size % 2 == 0 ? std::nullopt : std::optional(LengthUnit::inch);
  if (const auto drawing = io::parse_dxf(bytes, "fuzz.dxf", unit)) {
    fuzz::check_drawing(*drawing);
  } else {
    fuzz::check_sentence(drawing.error(), "fuzz.dxf");
  }
  return 0;
}
