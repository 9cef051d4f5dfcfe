#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/nc_words.hpp"
#include "lekalo/verify/claims.hpp"
#include "lekalo/verify/simulate.hpp"
#include "report_fields.hpp"

namespace lekalo::verify {

/// Reads what a report says of the tool, the stock and the machine that a program was followed for.
inline void read_machining(ReportFields& fields, SimulateOptions& options) {
  options.tool_diameter = fields.number("tool_mm");
  options.stock_to_leave = fields.number("stock_to_leave_mm");
  options.step_over = fields.number("step_over");
  options.top = fields.number("top_mm");
  options.acceleration = fields.number("acceleration_mm_per_s2");
  options.rapid_feed = fields.number("rapid_mm_per_min");
  const auto control = words::control_named(fields.text("control"));
  if (!control) fields.complain("field control is none that programs are read for");
  options.control = control.value_or(options.control);
}

/// The files of a report on a program that was followed.
struct FollowedFiles {
  std::optional<Document> program, pocket, stock;
  std::vector<EarlierProgram> earlier;
};

/// Finds them by their roles. \pre as many files as names. \param with_stock  there may be a file of the
/// stock
inline void read_followed(ReportFields& fields, const std::vector<NamedFile>& names,
                          const std::vector<Document>& files, FollowedFiles& followed,
                          bool with_stock = false) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& role = names[i].role;
    if (role == "after")
      followed.earlier.push_back({files[i], names[i].tool_mm});
    else if (role == "program" && !followed.program)
      followed.program = files[i];
    else if (role == "pocket" && !followed.pocket)
      followed.pocket = files[i];
    else if (with_stock && role == "stock" && !followed.stock)
      followed.stock = files[i];
    else
      fields.complain(fmt::format(
          "the files that it names have the role \"{}\" twice, or no such report has it", excerpt(role)));
  }
  if (!followed.program) fields.complain("it names no file with the role \"program\"");
  if (!followed.pocket) fields.complain("it names no file with the role \"pocket\"");
}

}  // namespace lekalo::verify
