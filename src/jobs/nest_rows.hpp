#pragma once

#include <cstdint>

#include "lekalo/base/error.hpp"
#include "lekalo/base/run_control.hpp"
#include "lekalo/jobs/nest.hpp"
#include "lekalo/nest/nest.hpp"

namespace lekalo::jobs {

/// Nests rectangles and right triangles in rows that keep the kerf between their parts, where rows cost
/// little material; everything else keeps the gap. The layout has the rules of the document, whose gap is the
/// kerf.
///
/// The trials take work of their own, beside control.work_limit. Documents with kits of such parts, or with
/// placements, are nested part by part. \param gap  in steps, between parts that have no edge in common
[[nodiscard]] Result<nest::Nested> nest_in_rows(const layout::Document& document, std::int64_t gap,
                                                const nest::Options& options, const RunControl& control,
                                                CommonRows& figures);

}  // namespace lekalo::jobs
