#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "job.hpp"

namespace lekalo::server {

/// `nest [IDS] for SECONDS [seed N]`: the nester on the whole layout, which also places what is wanted and
/// not there, or on these placements alone, everything else staying; see docs/protocol.md.
struct NestRequest {
  std::vector<std::uint64_t> ids;  ///< ascending; none: the whole layout
  double seconds = 0;              ///< in [0.1, 3,600]
  std::uint64_t seed = 0;
  friend bool operator==(const NestRequest&, const NestRequest&) = default;
};

/// Returns nothing for a line that is no such request. Fails with bad_input, naming the word, and with usage
/// for ids that are not there or locked.
[[nodiscard]] std::optional<Result<NestRequest>> nest_request(std::string_view line,
                                                              const layout::Document& document);
[[nodiscard]] std::string to_text(const NestRequest& request);

/// Tells of every better layout, and ends at the time asked for, or when it is stopped, with the best: each
/// of them after both checks (jobs/nest.hpp).
[[nodiscard]] Job job_of(const NestRequest& request);

}  // namespace lekalo::server
