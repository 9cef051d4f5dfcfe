#include "io_contour_check.hpp"
#include "lekalo/io/nesting/nesting_files.hpp"

// Jobs and placements of other programs on any bytes: a sentence, or a layout that can be written and read.

namespace {

using namespace lekalo;
using fuzz::must;

void check_sentence_of(const Error& error) {
  must(error.code == ErrorCode::bad_input && error.message.rfind("fuzz.json", 0) == 0);
  must(error.message.find('\n') == std::string::npos);
}

void check_document(const layout::Document& document) {
  const auto again = io::read_layout(io::write_layout(document), "again.json");
  must(again.has_value() && again->document == document);
}

layout::Document two_items() {
  const auto file = io::read_nesting(R"({"strip_height": 10, "items": [
      {"id": 0, "demand": 1, "shape": {"type": "simple_polygon", "data": [[0, 0], [3, 0], [0, 2]]}},
      {"id": 1, "demand": 1, "shape": {"type": "simple_polygon", "data": [[0, 0], [1, 0], [1, 5]]}}]})",
                                     "items.json");
  must(file.has_value());
  return file->document;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto unit = size % 2 == 0 ? std::nullopt : std::optional(LengthUnit::inch);
  if (const auto job = io::read_nesting(bytes, "fuzz.json", unit)) {
    check_document(job->document);
  } else {
    check_sentence_of(job.error());
  }
  const layout::Document items = two_items();
  const auto placed = io::read_placements(bytes, "fuzz.json", items, unit);
  if (!placed) {
    check_sentence_of(placed.error());
    return 0;
  }
  check_document(placed->document);
  const auto written = io::write_placements(placed->document, 0, "items.json");
  must(written.has_value() == !placed->document.placements.empty());
  if (!written) return 0;
  const auto again = io::read_placements(*written, "again.json", items);
  must(again.has_value() && again->document.placements.size() == placed->document.placements.size());
  for (std::size_t i = 0; i < placed->document.placements.size(); ++i)
    must(again->document.placements[i].at == placed->document.placements[i].at);
  return 0;
}
