#pragma once

#include <string>
#include <vector>

#include "lekalo/geom/polygon.hpp"
#include "lekalo/locate/placement.hpp"

namespace lekalo::cli {

/// Signed distances of probed points from the placed part's contour, millimetres: positive outside (material
/// to cut), negative inside (material that is missing). Within 1e-14 of the largest coordinate; for people,
/// not for decisions.
struct Deviations {
  std::vector<double> signed_mm;  ///< one per point, in order
  [[nodiscard]] double least() const;
  [[nodiscard]] double greatest() const;
};

/// \param probed  blank frame; \param part  part frame, at least three points. Cost: O(n m).
[[nodiscard]] Deviations measure_deviations(const geom::Ring& probed, const geom::Ring& part,
                                            const locate::Placement& placement);

/// `index,x,y,deviation` with a header line; index counts from 0 in file order.
[[nodiscard]] std::string deviations_csv(const geom::Ring& probed, const Deviations& deviations);

}  // namespace lekalo::cli
