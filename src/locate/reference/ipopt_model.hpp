#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "lekalo/geom/polygon.hpp"

namespace lekalo::locate {

/// The two nonlinear programs of the localisation article in the variables z = (x, y, theta, s):
///
///   homothety (8)-(10): maximise s = lambda in [0, 1], chi_k(lambda R(theta) v_i + t)       >= 0 for all k,
///   i clearance (5)-(7):  maximise s = phi >= 0,         chi_k(R(theta) v_i + t) - phi        >= 0 for all
///   k, i
///
/// with row k m + i for blank edge k and part vertex i, and exact first and second derivatives.
///
/// Both polygons are moved to the middle of their boxes and divided by half the blank's larger side, because
/// IPOPT's tolerances are absolute: the same blank in metres, or far from the origin, must give the same
/// iterations. So the part shrinks towards its middle, where the article takes the origin of the part's
/// frame.
class NonlinearModel {
 public:
  enum class Stage { homothety, clearance };
  static constexpr std::size_t kVariables = 4;
  using Variables = std::array<double, kVariables>;
  /// The entries of the Hessian of the Lagrangian that are not zero are (theta, theta) and (s, theta).
  static constexpr std::size_t kHessianEntries = 2;

  struct Pose {
    geom::Point translation;
    double theta = 0;
  };

  NonlinearModel(const geom::ConvexPolygon& part, const geom::ConvexPolygon& blank);

  [[nodiscard]] std::size_t rows() const noexcept { return normals_.size() * vertices_.size(); }

  /// \param values  rows() constraint values, each >= 0 where the row holds.
  void constraints(Stage stage, const Variables& z, double* values) const;
  /// \param values  4 rows(), row after row, the columns in the order of the variables.
  void jacobian(Stage stage, const Variables& z, double* values) const;
  /// Gives the second derivatives of the sum of multipliers[r] times constraint r; the objectives are linear.
  void hessian(Stage stage, const Variables& z, const double* multipliers, double* values) const;

  /// Converts the model's translation (of the part's middle, scaled) to a placement in millimetres, and back.
  [[nodiscard]] Pose placement(const Variables& z) const;
  [[nodiscard]] Variables variables(const Pose& placement, double s) const;

 private:
  std::vector<geom::Point> normals_;   // inward unit normals of the blank's edges
  std::vector<double> offsets_;        // chi_k(p) = normals_[k] . p - offsets_[k]
  std::vector<geom::Point> vertices_;  // of the part
  geom::Point part_middle_, blank_middle_;
  double scale_ = 1;
};

}  // namespace lekalo::locate
