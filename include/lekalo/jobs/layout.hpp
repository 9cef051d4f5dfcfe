#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/io/formats/any_layout.hpp"
#include "lekalo/io/nesting/nesting_files.hpp"
#include "lekalo/jobs/file.hpp"
#include "lekalo/layout/document.hpp"

namespace lekalo::jobs {

/// A file that a layout was made of, as reports name it.
struct LayoutInput {
  std::string role;    ///< "layout", "part" or "sheet"
  std::string name;    ///< of the file
  std::string sha256;  ///< of its bytes, lower-case hexadecimal
};

/// A layout as all jobs take it. open_layout makes it of a file; a program that has a document already fills
/// in `document` and leaves the rest empty.
struct Layout {
  /// The name of the file, for sentences; empty where there is none.
  std::string name;
  /// The files it was made of: its own, or those of an order (jobs/order.hpp).
  std::vector<LayoutInput> inputs;
  /// The file's own bytes where they are a layout ("lekalo-layout/1"), else empty.
  std::string bytes;
  layout::Document document;
  /// Sentences about what was left out or repaired in reading.
  std::vector<std::string> notices;
  /// The form of a job or of placements of another program.
  std::optional<io::NestingForm> form;
  /// The file of the items that placements of this layout would name.
  std::string instance_name;
};

/// Reads whatever holds a layout or a part of one, told apart by what is in the bytes (io::read_any_layout):
/// layouts, jobs and placements of other nesting programs, drawings, regions, trees of primitives.
///
/// \param parts  how drawings are read; its unit counts for jobs of other programs too
/// \param find   finds the items that a file of placements places; without it such files are refused
///
/// Fails with ErrorCode::bad_input and one sentence that names file, place and number. Cost: O(bytes).
[[nodiscard]] Result<Layout> open_layout(File file, const io::PartOptions& parts = {},
                                         const io::FindItems& find = {});

/// The layout as bytes of "lekalo-layout/1": those of its file where that is one, else those that
/// io::write_layout makes of the document. Cost: O(bytes).
[[nodiscard]] std::string layout_bytes(const Layout& layout);

}  // namespace lekalo::jobs
