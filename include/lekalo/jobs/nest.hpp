#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/run_control.hpp"
#include "lekalo/jobs/layout.hpp"
#include "lekalo/layout/completeness.hpp"
#include "lekalo/nest/nest.hpp"

namespace lekalo::jobs {

/// Figures of the best layout so far, for those who watch. They are no result: no check confirms them.
struct NestStanding {
  /// The share of the material in use that the parts cover, in [0, 1].
  double density = 0;
  /// How far the parts reach on the last sheet or strip in use.
  double length_mm = 0;
  std::size_t sheets = 0;
  std::int64_t kits_complete = 0, kits_wanted = 0;
};

/// The worth of rows of parts with common edges (docs/design/nest-rows.md).
struct CommonRows {
  double shared_mm = 0;         ///< edges in common in the layout that was found
  double material_share = 1;    ///< of the trial with rows against that without: what they take of the stock
  std::size_t most_in_row = 1;  ///< parts in the longest rows that were taken; 1: none were worth it
};

struct NestOptions {
  std::uint64_t seed = 0;
  unsigned threads = 2;  ///< 1 to 64; changes the speed and nothing else
  /// The number of angles tried of parts that may be turned anyhow, 1 to 360.
  std::size_t angles = 24;
  /// True when the search begins with the placements that are not locked; otherwise they are dropped.
  bool from_given = true;
  /// The left and right pieces of a kit lie no further apart than this, middle to middle, mm; 0 for no limit.
  double pair_distance = 0;
  /// The rest of the last sheet that is worth most.
  nest::Remnant remnant = nest::Remnant::corner;
  /// A value above 0 lets rectangles and right triangles stand in rows, a kerf apart, where that costs little
  /// material; all other gaps are this, mm. The gap of the document's rules is the kerf then. Documents with
  /// placements, and `only`, are nested part by part.
  double common_line_gap_mm = 0;
  /// Ids of the only placements that may move, ascending: everything else stays, and nothing is added. Empty:
  /// all that are not locked, and what is wanted and not there is added.
  std::vector<std::uint64_t> only;
  /// Takes every better layout as it is found, and its bytes, after both checks of it, from the calling
  /// thread. Its failure, like that of a check, ends what is handed out, and nest fails with it at the end.
  /// May be empty: then the checks are not run.
  std::function<Result<void>(const layout::Document& better, std::string_view bytes)> improved;
  /// Called at the same moments; may be empty.
  std::function<void(const NestStanding&)> standing;
  /// Takes the bytes of the result while both checks read them, perhaps from another thread, to put them
  /// where nobody takes them for a result yet: a large file takes the disk as long as the checks take the
  /// processor. Its failure is one of nest. May be empty.
  std::function<Result<void>(std::string_view bytes)> while_checked;
};

struct Nested {
  /// The given document with other placements, in which both checks find no broken rule.
  layout::Document document;
  /// The document as "lekalo-layout/1", as the independent checker read it.
  std::string bytes;
  std::vector<nest::Unplaced> unplaced;  ///< by part
  /// As in nest::Nested; the work is the limit that repeats the run.
  std::uint64_t work = 0, merges = 0;
  layout::Completeness completeness;
  bool searched = true;              ///< as in nest::Nested
  std::optional<CommonRows> rows{};  ///< of NestOptions::common_line_gap_mm
};

/// Places what a layout wants on its stock (nest/nest.hpp), and hands out nothing that breaks a rule: the
/// result, and every layout that goes to `improved`, has passed both checks as the bytes that are handed out.
///
/// `control` stops it early with the best so far, or limits its work; the same document, options and work
/// give the same bytes. Fails as nest::nest does, with ErrorCode::usage for a selection that fine_selection
/// refuses, and with ErrorCode::refuted where a check finds a broken rule.
[[nodiscard]] Result<Nested> nest(const layout::Document& document, const NestOptions& options,
                                  const RunControl& control = {});

/// Fails with ErrorCode::usage for ids that are not there or locked.
[[nodiscard]] Result<void> fine_selection(const layout::Document& document,
                                          const std::vector<std::uint64_t>& ids);

/// The figures as "lekalo-nest" JSON (docs/cli.md), ending in a line end.
/// \param given        what was nested
/// \param written_as   the name of the file that nested.bytes go to; empty: none
/// \param cpu_seconds  processor time of the run as the caller measured it
[[nodiscard]] std::string nest_json(const Layout& given, const NestOptions& options, const Nested& nested,
                                    const std::string& written_as, double cpu_seconds);

}  // namespace lekalo::jobs
