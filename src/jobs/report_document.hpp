#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lekalo/jobs/file.hpp"
#include "lekalo/jobs/simulate.hpp"
#include "lekalo/verify/simulate.hpp"

namespace lekalo::jobs {

/// A file as reports name it: its role, its name and the digest of its bytes.
[[nodiscard]] nlohmann::ordered_json file_record(const char* role, const File& file);

/// The records of `first`, and after them those of the programs that ran before.
[[nodiscard]] nlohmann::ordered_json records_with_earlier(nlohmann::ordered_json first,
                                                          const std::vector<EarlierProgram>& earlier);

/// The checker's figures under their names in docs/formats.md.
[[nodiscard]] nlohmann::ordered_json report_fields(const verify::SimulateReport& report);

/// The text of a finished document; bytes that are not UTF-8 become U+FFFD.
[[nodiscard]] std::string document_text(const nlohmann::ordered_json& document);

}  // namespace lekalo::jobs
