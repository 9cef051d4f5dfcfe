// Any bytes as an order in a table: one sentence, or rows that can be made.

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "lekalo/io/formats/order_table.hpp"
#include "require.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lekalo;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto order = io::read_order(bytes, "fuzz.csv");
  if (!order) {
    require(order.error().code == ErrorCode::bad_input && order.error().message.starts_with("fuzz.csv"));
    return 0;
  }
  std::size_t last = 1;
  for (const io::OrderRow& row : order->rows) {
    constexpr std::string_view kPlace = "fuzz.csv: line ";
    require(row.said_in.starts_with(kPlace) && !row.file.empty());
    const std::size_t line = std::stoul(row.said_in.substr(kPlace.size()));
    require(line > last && (!order->is_bill || !row.assembly.empty()));
    require(row.quantity >= 1 && row.quantity <= 1'000'000'000);
    if (row.rotations)  // none is any
      for (const layout::AngleRange& range : *row.rotations) require(std::isfinite(range.from));
    require(!row.grain || std::isfinite(row.grain->degrees));
    last = line;
  }
  return 0;
}
