#include "new_command.hpp"

#include <fmt/core.h>

#include "layout_input.hpp"
#include "order_input.hpp"
#include "outputs.hpp"
#include "summary.hpp"

namespace lekalo::cli {

Result<int> run_new(const NewOptions& o) {
  LEKALO_TRY(const jobs::Layout input, read_order_input(o.order, {{"--output", o.output}}));
  LEKALO_CHECK(deliver(o.output, jobs::layout_bytes(input)));
  std::string said = notes(input.notices);
  if (!o.output.empty())
    said += fmt::format("{} on {}\nWritten: {}\n", counted(input.document.parts.size(), "part"),
                        counted(input.document.stocks.size(), "stock"), o.output);
  tell(said);
  return 0;
}

}  // namespace lekalo::cli
