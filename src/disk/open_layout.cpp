#include "lekalo/disk/open_layout.hpp"

#include <fmt/core.h>

#include <filesystem>
#include <optional>
#include <utility>

#include "lekalo/disk/files.hpp"
#include "lekalo/io/text/excerpt.hpp"

namespace lekalo::disk {
namespace {

namespace fs = std::filesystem;

/// The file that `said` means, as seen from the file that says it.
std::optional<std::string> found_near(const fs::path& from, const fs::path& said) {
  const fs::path folder = from.parent_path();
  for (const fs::path& candidate : {folder / said, folder / ".." / said, folder / said.filename()}) {
    std::error_code error;
    if (fs::is_regular_file(candidate, error)) return candidate.string();
  }
  return std::nullopt;
}

/// The file of items that the user names, or else the one that the placements in `path` name.
Result<std::string> path_of_items(const std::string& path, const std::string& instance,
                                  const Result<std::string>& said) {
  if (!instance.empty() || !said) return instance.empty() ? said : instance;
  // A path from elsewhere would let a file name any other on the machine.
  const auto found = fs::path(*said).is_absolute() ? std::nullopt : found_near(path, *said);
  if (found) return *found;
  return failure(ErrorCode::bad_input,
                 fmt::format("{}: the file of its items, {}, is neither beside it nor in the folder above; "
                             "name it with --instance",
                             path, io::excerpt(*said)));
}

}  // namespace

io::FindItems items_near(std::string path, std::string instance) {
  return [path = std::move(path),
          instance = std::move(instance)](const Result<std::string>& said) -> Result<io::ItemsFile> {
    LEKALO_TRY(const std::string items, path_of_items(path, instance, said));
    LEKALO_TRY(std::string bytes, read_file(items));
    return io::ItemsFile{items, std::move(bytes)};
  };
}

Result<io::AnyLayout> open_layout(const std::string& path, const OpenOptions& options) {
  LEKALO_TRY(const std::string bytes, read_file(path));
  return io::read_any_layout(bytes, path, options.parts, items_near(path, options.instance));
}

}  // namespace lekalo::disk
