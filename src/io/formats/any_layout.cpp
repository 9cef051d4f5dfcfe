#include "lekalo/io/formats/any_layout.hpp"

#include <optional>
#include <utility>
#include <vector>

#include "io/layout/layout_reader.hpp"
#include "io/nesting/forms.hpp"
#include "io/text/decimal.hpp"
#include "io/text/json_tree.hpp"
#include "io/text/refusal.hpp"
#include "lekalo/io/formats/drawing_formats.hpp"

namespace lekalo::io {
namespace {

tl::unexpected<Error> no_layout(const std::string& path, std::string_view bytes = {}) {
  if (const std::string other = wrong_encoding(bytes); !other.empty()) return refuse(path, other);
  return failure(ErrorCode::bad_input,
                 path +
                     ": no layout; known are \"format\": \"lekalo-layout/1\", jobs of nesting programs "
                     "(strip_height and items; bin_types and item_types; Items and Objects; placements), "
                     "regions (outer or pieces), trees of primitives (shape), " +
                     drawing_names(", ", " and ") + " drawings");
}

/// Reads a file of placements, and the items that `find` has for it.
Result<AnyLayout> read_placed(const detail::JsonTree& tree, const std::string& name, const PartOptions& parts,
                              const FindItems& find) {
  if (!find)
    return failure(ErrorCode::bad_input,
                   name +
                       ": placements whose items are in another file; make one layout of both with lekalo "
                       "export, and give that");
  const Result<std::string> said = detail::instance_of_tree(tree, name);
  LEKALO_TRY(const ItemsFile file, find(said));
  LEKALO_TRY(LayoutFile items, read_nesting(file.bytes, file.name, parts.unit));
  LEKALO_TRY(LayoutFile placed,
             detail::read_placements_tree(tree, name, std::move(items.document), parts.unit));
  placed.notices.insert(placed.notices.begin(), items.notices.begin(), items.notices.end());
  return AnyLayout{std::move(placed), NestingForm::placements, said.value_or("")};
}

}  // namespace

Result<AnyLayout> read_any_layout(std::string_view bytes, const std::string& name, const PartOptions& parts,
                                  const FindItems& find) {
  if (kJsonFormat.begins_so(bytes)) {
    LEKALO_TRY(const auto tree, detail::JsonTree::parse(bytes, name));
    const detail::JsonValue root = tree.root();
    if (root.find("format")) {
      LEKALO_TRY(LayoutFile layout, detail::read_layout_tree(tree, name));
      return AnyLayout{std::move(layout), std::nullopt, {}};
    }
    if (const auto form = detail::form_of(tree)) {
      if (*form == NestingForm::placements) return read_placed(tree, name, parts, find);
      LEKALO_TRY(LayoutFile job, detail::read_nesting_tree(tree, name, *form, parts.unit));
      return AnyLayout{std::move(job), *form, {}};
    }
    if (!root.find("shape") && !root.find("outer") && !root.find("pieces")) return no_layout(name);
  } else if (drawing_format_by_content(bytes) == nullptr) {
    return no_layout(name, bytes);
  }
  LEKALO_TRY(auto read, read_parts(bytes, name, parts));
  AnyLayout file;
  file.document.parts = std::move(read.parts);
  file.document.stocks = std::move(read.stocks);
  file.notices = std::move(read.notices);
  return file;
}

}  // namespace lekalo::io
