#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "lekalo/base/error.hpp"
#include "lekalo/io/formats/part_file.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/io/nesting/nesting_files.hpp"

namespace lekalo::io {

/// The file of the items that a file of placements places.
struct ItemsFile {
  std::string name, bytes;
};
/// Finds it; `said` is the name that the placements give, or why they give none.
using FindItems = std::function<Result<ItemsFile>(const Result<std::string>& said)>;

struct AnyLayout : LayoutFile {
  std::optional<NestingForm> form;  ///< of a job or of placements of another program
  std::string instance;             ///< the file of the items, as placements say it
};

/// Reads whatever holds a layout or a part of one, told apart by what is in the bytes, not by their name: a
/// layout (layout_json.hpp), jobs and placements of other nesting programs (nesting_files.hpp), drawings,
/// regions and trees of primitives (part_file.hpp), which give a document of parts, and of sheets where an
/// export of lekalo has them. `name` stands in sentences.
///
/// Opens no file: without `find`, placements, whose items are in another file, are refused. Fails as the
/// readers of these do, and with ErrorCode::bad_input for what is none of them, with the list of what is
/// known.
[[nodiscard]] Result<AnyLayout> read_any_layout(std::string_view bytes, const std::string& name,
                                                const PartOptions& parts = {}, const FindItems& find = {});

}  // namespace lekalo::io
