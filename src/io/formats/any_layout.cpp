#include "lekalo/io/formats/any_layout.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>
#include <vector>

#include "io/layout/layout_reader.hpp"
#include "io/nesting/forms.hpp"
#include "io/text/decimal.hpp"
#include "io/text/json_tree.hpp"
#include "lekalo/io/formats/drawing_formats.hpp"

namespace lekalo::io {
namespace {

tl::unexpected<Error> no_layout(const std::string& path) {
  return failure(ErrorCode::bad_input,
                 path +
                     ": no layout; known are \"format\": \"lekalo-layout/1\", jobs of nesting programs "
                     "(strip_height and items; bin_types and item_types; Items and Objects; placements), "
                     "regions (outer or pieces), trees of primitives (shape), " +
                     drawing_names(", ", " and ") + " drawings");
}

/// Reads a file of placements, and the items that `find` has for it.
Result<LayoutFile> read_placed(const detail::JsonTree& tree, const std::string& name,
                               const PartOptions& parts, const FindItems& find) {
  if (!find)
    return failure(ErrorCode::bad_input,
                   name +
                       ": placements whose items are in another file; make one layout of both with lekalo "
                       "export, and give that");
  const Result<ItemsFile> file = find(detail::instance_of_tree(tree, name));
  if (!file) return tl::unexpected(file.error());
  auto items = read_nesting(file->bytes, file->name, parts.unit);
  if (!items) return items;
  auto placed = detail::read_placements_tree(tree, name, std::move(items->document), parts.unit);
  if (placed) placed->notices.insert(placed->notices.begin(), items->notices.begin(), items->notices.end());
  return placed;
}

}  // namespace

Result<LayoutFile> read_any_layout(std::string_view bytes, const std::string& name, const PartOptions& parts,
                                   const FindItems& find) {
  if (kJsonFormat.begins_so(bytes)) {
    const auto tree = detail::JsonTree::parse(bytes, name);
    if (!tree) return tl::unexpected(tree.error());
    const detail::JsonValue root = tree->root();
    if (root.find("format")) return detail::read_layout_tree(*tree, name);
    if (const auto form = detail::form_of(*tree)) {
      return *form == NestingForm::placements ? read_placed(*tree, name, parts, find)
                                              : detail::read_nesting_tree(*tree, name, *form, parts.unit);
    }
    if (!root.find("shape") && !root.find("outer") && !root.find("pieces")) return no_layout(name);
  } else if (drawing_format_by_content(bytes) == nullptr) {
    return no_layout(name);
  }
  auto read = read_parts(bytes, name, parts);
  if (!read) return tl::unexpected(read.error());
  LayoutFile file;
  file.document.parts = std::move(read->parts);
  file.document.stocks = std::move(read->stocks);
  file.notices = std::move(read->notices);
  return file;
}

}  // namespace lekalo::io
