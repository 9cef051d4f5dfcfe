#include "lekalo/io/open_layout.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "contour_number.hpp"
#include "json_tree.hpp"
#include "layout_reader.hpp"
#include "lekalo/io/files.hpp"
#include "nesting_forms.hpp"

namespace lekalo::io {
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

bool looks_like_json(std::string_view bytes) {
  const std::size_t begin = bytes.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  return begin != std::string_view::npos && (bytes[begin] == '{' || bytes[begin] == '[');
}

/// DXF begins with the number of a group, SVG with a tag.
bool looks_like_drawing(std::string_view bytes) {
  const std::size_t begin = bytes.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  return begin != std::string_view::npos &&
         (bytes[begin] == '<' || (bytes[begin] >= '0' && bytes[begin] <= '9'));
}

tl::unexpected<Error> no_layout(const std::string& path) {
  return failure(ErrorCode::bad_input,
                 path +
                     ": no layout; known are \"format\": \"lekalo-layout/1\", jobs of nesting programs "
                     "(strip_height and items; bin_types and item_types; Items and Objects; placements), "
                     "regions (outer or pieces), trees of primitives (shape), DXF and SVG drawings");
}

/// Reads a file of placements, and the file of their items from the disk.
Result<LayoutFile> open_placements(const detail::JsonTree& tree, const std::string& path,
                                   const OpenOptions& options) {
  std::string instance = options.instance;
  if (instance.empty()) {
    const auto said = detail::instance_of_tree(tree, path);
    if (!said) return tl::unexpected(said.error());
    // A path from elsewhere would let a file name any other on the machine.
    const auto found = fs::path(*said).is_absolute() ? std::nullopt : found_near(path, *said);
    if (!found)
      return failure(
          ErrorCode::bad_input,
          fmt::format("{}: the file of its items, {}, is neither beside it nor in the folder above; "
                      "name it with --instance",
                      path, excerpt(*said)));
    instance = *found;
  }
  const auto bytes = read_file(instance);
  if (!bytes) return tl::unexpected(bytes.error());
  auto items = read_nesting(*bytes, instance, options.parts.unit);
  if (!items) return items;
  auto placed = detail::read_placements_tree(tree, path, std::move(items->document), options.parts.unit);
  if (placed) placed->notices.insert(placed->notices.begin(), items->notices.begin(), items->notices.end());
  return placed;
}

using OpenPlacements = Result<LayoutFile>(const detail::JsonTree& tree, const std::string& name,
                                          const OpenOptions& options);

Result<LayoutFile> read_any(std::string_view bytes, const std::string& name, const OpenOptions& options,
                            OpenPlacements& placements) {
  if (looks_like_json(bytes)) {
    const auto tree = detail::JsonTree::parse(bytes, name);
    if (!tree) return tl::unexpected(tree.error());
    const detail::JsonValue root = tree->root();
    if (root.find("format")) return detail::read_layout_tree(*tree, name);
    if (const auto form = detail::form_of(*tree)) {
      return *form == NestingForm::placements
                 ? placements(*tree, name, options)
                 : detail::read_nesting_tree(*tree, name, *form, options.parts.unit);
    }
    if (!root.find("shape") && !root.find("outer") && !root.find("pieces")) return no_layout(name);
  } else if (!looks_like_drawing(bytes)) {
    return no_layout(name);
  }
  auto parts = read_parts(bytes, name, options.parts);
  if (!parts) return tl::unexpected(parts.error());
  LayoutFile file;
  file.document.parts = std::move(parts->parts);
  file.document.stocks = std::move(parts->stocks);
  file.notices = std::move(parts->notices);
  return file;
}

Result<LayoutFile> refuse_placements(const detail::JsonTree&, const std::string& name, const OpenOptions&) {
  return failure(ErrorCode::bad_input,
                 name +
                     ": placements whose items are in another file; make one layout of both with lekalo "
                     "export, and give that");
}

}  // namespace

Result<LayoutFile> open_layout(const std::string& path, const OpenOptions& options) {
  const auto bytes = read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  return read_any(*bytes, path, options, open_placements);
}

Result<LayoutFile> read_any_layout(std::string_view bytes, const std::string& name,
                                   const PartOptions& parts) {
  return read_any(bytes, name, {{}, parts}, refuse_placements);
}

}  // namespace lekalo::io
