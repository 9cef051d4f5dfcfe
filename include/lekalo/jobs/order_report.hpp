#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "lekalo/jobs/nest.hpp"
#include "lekalo/jobs/order.hpp"

namespace lekalo::jobs {

/// The sums of one layout of an order, or of all of them.
struct OrderFigures {
  std::int64_t placed = 0, missing = 0;      ///< pieces
  std::size_t sheets = 0;                    ///< in use
  double parts_area = 0, material_area = 0;  ///< of the sheets in use, mm^2
  double cost = 0;
  /// The share of the material in use that the parts cover, in [0, 1].
  [[nodiscard]] double density() const noexcept { return material_area > 0 ? parts_area / material_area : 0; }
};
[[nodiscard]] OrderFigures figures_of(const Nested& nested);
[[nodiscard]] OrderFigures sum_of(const std::vector<OrderFigures>& figures);

/// A layout of an order that was nested.
struct NestedMaterial {
  MaterialLayout given;
  Nested nested;
  std::string written_as;  ///< the name of the file that nested.bytes go to; empty: none
};

/// The figures of an order of several layouts as "lekalo-order" JSON (docs/cli.md), ending in a line end.
/// \param cpu_seconds  processor time of the run as the caller measured it
[[nodiscard]] std::string order_json(const std::vector<NestedMaterial>& layouts, const NestOptions& options,
                                     double cpu_seconds);

}  // namespace lekalo::jobs
