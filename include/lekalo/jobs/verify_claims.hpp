#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/jobs/file.hpp"
#include "lekalo/jobs/simulate.hpp"
#include "lekalo/jobs/verify.hpp"
#include "lekalo/verify/claims.hpp"

namespace lekalo::jobs {

/// The words said beside a file that does not name what it was made from. What is not needed is empty.
struct Beside {
  /// The layout that a layout, an export or a profile program was made from.
  std::optional<File> layout;
  /// The pocket that a program clears, with the tool and what ran before.
  std::optional<File> pocket;
  std::optional<double> tool_diameter;  ///< mm
  verify::SimulateOptions machining;    ///< its tool does not count
  std::vector<EarlierProgram> after;
  verify::ExportWords export_words;
  std::optional<verify::ProfileWords> profile;  ///< of a program that cuts the parts of `layout`
};

struct VerifiedClaims {
  verify::ClaimReport report;
  std::string status;  ///< "confirmed", "confirmed for the stated regions", "incomplete" or "refuted"
  std::string json;    ///< the report as a document, format lekalo-verify (docs/formats.md)
};

/// Rechecks what lekalo writes besides placements (verify() has those): whatever verify::kind_of tells. Every
/// file that it names has to be there.
///
/// Errors: ErrorCode::usage where the file names too little to be judged alone, with the words to add;
/// bad_input for pictures, for files that lekalo did not write, and for files that are not there or cannot be
/// read.
[[nodiscard]] Result<VerifiedClaims> verify_claims(const File& result, const Beside& beside,
                                                   const FileFinder& find);

}  // namespace lekalo::jobs
