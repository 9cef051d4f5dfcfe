#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/io/nesting/nesting_files.hpp"
#include "lekalo/layout/check.hpp"
#include "lekalo/layout/completeness.hpp"
#include "options/options.hpp"
#include "outputs.hpp"

namespace lekalo::cli {

/// A layout as the commands that take one read it.
struct LayoutInput {
  std::string path, sha256;
  std::string text;  ///< the layout as `lekalo` writes it, or the file's own bytes where it is a layout
  layout::Document document;
  std::vector<std::string> notices;
  std::optional<io::NestingForm> form;  ///< of a job or placements of another program
  std::string instance_name;            ///< what placements of this would name as the file of their items
};

/// "1 part", "2 parts".
[[nodiscard]] std::string counted(std::size_t count, const char* one);

/// Reads any file that holds a layout or a job (io/open_layout.hpp), after a look at the outputs
/// (check_outputs), which may replace neither it nor `others`.
[[nodiscard]] Result<LayoutInput> read_layout_input(const LayoutSource& source,
                                                    const std::vector<NamedPath>& outputs,
                                                    std::vector<NamedPath> others = {});

/// "note: ..." lines.
[[nodiscard]] std::string notes(const std::vector<std::string>& notices);

/// The fields every command's JSON begins with.
[[nodiscard]] nlohmann::ordered_json begin_layout_json(const char* format, const std::string& status,
                                                       const LayoutInput& input);
[[nodiscard]] std::string dumped(const nlohmann::ordered_json& json);

/// The picture in the form that the path's ending says; the ending was checked with the options.
[[nodiscard]] Result<std::string> picture_bytes(const std::string& path, const std::string& name,
                                                const layout::Document& document,
                                                const layout::Completeness& completeness,
                                                const std::vector<layout::Violation>& violations);

/// Lines for people: sheets, parts, kits.
[[nodiscard]] std::string completeness_text(const layout::Document& document,
                                            const layout::Completeness& completeness);

}  // namespace lekalo::cli
