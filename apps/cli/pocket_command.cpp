#include "pocket_command.hpp"

#include <fmt/format.h>

#include "lekalo/geom/region_check.hpp"
#include "lekalo/io/files.hpp"
#include "lekalo/io/region_json.hpp"
#include "outputs.hpp"

namespace lekalo::cli {

Result<int> run_pocket(const PocketOptions& o) {
  if (Result<void> good = check_outputs({{"-o", o.output}}, {{"pocket", o.pocket}}); !good)
    return tl::unexpected(good.error());
  const Result<std::string> bytes = io::read_file(o.pocket);
  if (!bytes) return tl::unexpected(bytes.error());
  const Result<io::RegionFile> file = io::parse_regions(*bytes, o.pocket);
  if (!file) return tl::unexpected(file.error());
  if (const auto fault = geom::fault_of(file->regions))
    return failure(ErrorCode::bad_input, fmt::format("{}: {}", o.pocket, *fault));
  const Result<mill::PocketPath> path = mill::pocket_path(file->regions, o.path);
  if (!path) return failure(path.error().code, fmt::format("{}: {}", o.pocket, path.error().message));
  if (Result<void> done = deliver(o.output, mill::program_of(*path, o.path)); !done)
    return tl::unexpected(done.error());
  return 0;
}

}  // namespace lekalo::cli
