#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lekalo/base/parallel.hpp"
#include "lekalo/solid/mesh.hpp"
#include "lekalo/solid/motion.hpp"

namespace lekalo::locate {

/// The surface of a placed part with the allowance at its vertices: the distance to the surface of the blank,
/// less its widths, and negative outside its material. Long edges of the part are cut, since the allowance in
/// the middle of a large triangle is not that at its corners.
struct MeasuredPart {
  solid::Mesh mesh;  ///< the part's surface, in its own frame; its first vertices are the part's
  std::vector<std::uint32_t> numbers;  ///< the triangle of the part in which each of its triangles lies
  /// mm, at each vertex; rounded down.
  std::vector<double> allowances;
};

/// \param part, blank  closed
/// \param widths  of the blank's triangles, mm, or none (SolidProblem::blank_widths)
/// \param triangles  edges are cut until there are about this many, and never above four times as many
/// The same for any number of threads. The allowance between the vertices is not known.
[[nodiscard]] MeasuredPart measured_part(const solid::Mesh& part, const solid::Mesh& blank,
                                         const solid::Motion& blank_from_part, std::size_t triangles = 40'000,
                                         unsigned threads = kUsualThreads,
                                         const std::vector<double>& widths = {});

/// The distance of each point from the surface of the placed part, mm, rounded down: above 0 outside the
/// part, where material is to be cut, and below 0 inside, where it is missing. The same for any number of
/// threads.
[[nodiscard]] std::vector<double> deviations_from(const solid::Mesh& part,
                                                  const solid::Motion& blank_from_part,
                                                  const std::vector<solid::Vector>& points,
                                                  unsigned threads = kUsualThreads);

}  // namespace lekalo::locate
