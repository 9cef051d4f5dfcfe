#pragma once

#include <array>

#include "lekalo/fit/assembly.hpp"
#include "ring_mesh.hpp"

namespace lekalo::fit {

/// Strains and stresses of a body of revolution: rr, zz, around, and rz (strain: the engineer's shear).
using Tensor = std::array<double, 4>;

/// The plastic strain at a point, and its length as von Mises counts it.
struct PlasticState {
  Tensor strain{};  ///< rz: the engineer's shear
  double length = 0;
};

/// The answer of a metal to a strain, docs/design/fit.md, step 4.
struct MaterialAnswer {
  Tensor stress{};
  PlasticState plastic;
  bool yields = false;
  std::array<Tensor, 4> tangent{};
};
[[nodiscard]] MaterialAnswer answer_to(const Material& material, const Tensor& strain,
                                       const PlasticState& before);

/// von Mises' stress.
[[nodiscard]] double mises_of(const Tensor& stress);

/// Gauss points of an element, two by two.
constexpr int kPoints = 4;

/// The strain of an element at a point by the displacements of its nodes (r and z in turn), and the volume
/// that the point stands for, per radian.
struct StrainAt {
  std::array<std::array<double, 16>, 4> rows{};
  double volume = 0;
};
[[nodiscard]] StrainAt strain_at(const RingMesh& mesh, const MeshElement& element, int point);

}  // namespace lekalo::fit
