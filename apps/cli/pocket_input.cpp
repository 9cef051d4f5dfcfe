#include "pocket_input.hpp"

#include <utility>

#include "lekalo/disk/files.hpp"
#include "lekalo/io/formats/outline_file.hpp"

namespace lekalo::cli {

Result<jobs::PocketOutline> read_pocket_outline(const PocketOptions& o) {
  LEKALO_TRY(std::string bytes, disk::read_file(o.pocket));
  ShapeOptions how = o.shape;
  if (!how.layers.empty()) {
    how.layers.insert(how.layers.end(), o.island_layers.begin(), o.island_layers.end());
    how.layers.insert(how.layers.end(), o.open_layers.begin(), o.open_layers.end());
  }
  LEKALO_TRY(io::ReadOutline read, io::read_outline(bytes, o.pocket, how));
  return jobs::PocketOutline{{o.pocket, std::move(bytes)},
                             std::move(read.outline.regions),
                             std::move(read.outline.labels),
                             std::move(read.open),
                             std::move(read.notices)};
}

}  // namespace lekalo::cli
