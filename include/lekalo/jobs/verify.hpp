#pragma once

#include <functional>
#include <optional>
#include <string>

#include "lekalo/base/error.hpp"
#include "lekalo/jobs/file.hpp"
#include "lekalo/verify/verify.hpp"

namespace lekalo::jobs {

/// Finds a file that a result names: `role` is that of one of its inputs ("part", "blank", "features", "nc",
/// "last-result", "start"), "certificate", or "NC program" or "work offset" for those that were written;
/// `path` as it stands in the result. Without a value: there is no such file. An error: it is there and
/// cannot be read.
using FileFinder =
    std::function<Result<std::optional<File>>(const std::string& role, const std::string& path)>;

struct Verified {
  /// The checker's verdict, findings and notes, and those about the files: one that is not there, or whose
  /// bytes are not those that the result was made from, is a finding, and then the verdict is refuted.
  verify::LocateReport report;
  std::string json;  ///< the report as a document, format lekalo-verify (docs/formats.md)
};

/// Rechecks a result of a localisation against the files that it names: their digests, and everything that
/// verify::verify_locate proves. Every input is used; one that is not there, or no certificate, refutes the
/// result, and nothing else is judged then. The NC program that was written is held against the original,
/// moved; one that is not there may have gone to the machine, and the verdict is incomplete then.
///
/// Errors: bad_input where the result, one of its inputs or the certificate cannot be read, and where two
/// inputs have one role.
[[nodiscard]] Result<Verified> verify(const File& result, const FileFinder& find);

}  // namespace lekalo::jobs
