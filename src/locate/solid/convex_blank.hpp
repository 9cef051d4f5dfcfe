#pragma once

#include <optional>
#include <vector>

#include "lekalo/solid/motion.hpp"
#include "lekalo/solid/triangle_tree.hpp"

namespace lekalo::locate {

/// A convex blank with few faces. The part is inside where each of its vertices is beyond the plane of every
/// face, and has the least of these heights around it. So nothing but its foremost vertices is looked at.
class ConvexBlank {
 public:
  struct Plane {
    solid::Vector normal;  ///< of length 1, into the material
    solid::Vector place;   ///< the blank's foremost vertex against it
  };
  /// The foremost vertex of the part over a plane.
  struct Foremost {
    const Plane* plane = nullptr;
    solid::Vector part;  ///< in its own frame
    double height = 0;   ///< mm, negative outside
  };

  /// None of a blank that is not convex, or that has many faces. \param tree  of the blank
  [[nodiscard]] static std::optional<ConvexBlank> of(const solid::Mesh& blank,
                                                     const solid::TriangleTree& tree);

  /// The foremost vertices over all planes that have one lower than `most`, the lowest first and at most so
  /// many. \param tree  of the part
  void foremost(const solid::Mesh& part, const solid::TriangleTree& tree, const solid::Motion& motion,
                double most, std::size_t count, std::vector<Foremost>& found) const;

 private:
  std::vector<Plane> planes_;
};

}  // namespace lekalo::locate
