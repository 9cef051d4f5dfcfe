#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "job.hpp"

namespace lekalo::server {

/// The request `nest [IDS] for SECONDS [seed N]` of docs/protocol.md. Without ids the whole layout is nested,
/// and what is wanted and not there is placed too. With ids only these placements move.
struct NestRequest {
  /// The placements that may move, ascending; empty for the whole layout.
  std::vector<std::uint64_t> ids;
  double seconds = 0;  ///< in [0.1, 3,600]
  std::uint64_t seed = 0;
  friend bool operator==(const NestRequest&, const NestRequest&) = default;
};

/// Reads a request. Returns nothing for a line that is no such request. Fails with bad_input, naming the
/// word, and with usage for ids that are not there or locked.
[[nodiscard]] std::optional<Result<NestRequest>> nest_request(std::string_view line,
                                                              const layout::Document& document);
[[nodiscard]] std::string to_text(const NestRequest& request);

/// Returns the job of a request. It tells of every better layout. At the time asked for, or when it is
/// stopped, it ends with the best layout. Each of these layouts has passed both checks (jobs/nest.hpp).
[[nodiscard]] Job job_of(const NestRequest& request);

}  // namespace lekalo::server
