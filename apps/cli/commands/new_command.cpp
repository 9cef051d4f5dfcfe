#include "new_command.hpp"

#include <fmt/core.h>

#include "layout_input.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/jobs/material.hpp"
#include "lekalo/layout/material_words.hpp"
#include "order_input.hpp"
#include "outputs.hpp"
#include "summary.hpp"

namespace lekalo::cli {

Result<int> run_new(const NewOptions& o) {
  LEKALO_TRY(const std::vector<jobs::MaterialLayout> layouts,
             read_order_input(o.order, {{"--output", o.output}}));
  LEKALO_CHECK(several_need_files(layouts, o.output));
  disk::AtomicFiles files;
  std::string said;
  for (const jobs::MaterialLayout& one : layouts) {
    const layout::Document& document = one.layout.document;
    const std::string bytes = jobs::layout_bytes(one.layout), path = jobs::path_with(o.output, one.file_word);
    said += notes(one.layout.notices);
    if (path.empty()) {
      LEKALO_CHECK(print(bytes));
      continue;
    }
    LEKALO_CHECK(files.add(path, bytes));
    if (layouts.size() > 1) said += layout::words_of(one.material) + ": ";
    said += fmt::format("{} on {}\nWritten: {}\n", counted(document.parts.size(), "part"),
                        counted(document.stocks.size(), "stock"), path);
  }
  LEKALO_CHECK(files.commit());
  tell(said);
  return 0;
}

}  // namespace lekalo::cli
