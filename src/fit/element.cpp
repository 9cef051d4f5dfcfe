#include "element.hpp"

#include <cmath>

namespace lekalo::fit {
namespace {

struct Shapes {
  std::array<double, 8> value{}, by_xi{}, by_eta{};
};

/// The functions of the 8-node quadrilateral.
Shapes shapes_at(double x, double y) {
  constexpr std::array<double, 4> kX{-1, 1, 1, -1}, kY{-1, -1, 1, 1};
  Shapes s;
  for (std::size_t i = 0; i < 4; ++i) {
    const double a = kX[i], b = kY[i];
    s.value[i] = (1 + a * x) * (1 + b * y) * (a * x + b * y - 1) / 4;
    s.by_xi[i] = a * (1 + b * y) * (2 * a * x + b * y) / 4;
    s.by_eta[i] = b * (1 + a * x) * (2 * b * y + a * x) / 4;
  }
  for (const std::size_t i : {4U, 6U}) {
    const double b = i == 4 ? -1 : 1;
    s.value[i] = (1 - x * x) * (1 + b * y) / 2;
    s.by_xi[i] = -x * (1 + b * y);
    s.by_eta[i] = b * (1 - x * x) / 2;
  }
  for (const std::size_t i : {5U, 7U}) {
    const double a = i == 5 ? 1 : -1;
    s.value[i] = (1 - y * y) * (1 + a * x) / 2;
    s.by_xi[i] = a * (1 - y * y) / 2;
    s.by_eta[i] = -y * (1 + a * x);
  }
  return s;
}

double mean(const Tensor& t) { return (t[0] + t[1] + t[2]) / 3; }

}  // namespace

double mises_of(const Tensor& s) {
  const double m = mean(s), a = s[0] - m, b = s[1] - m, c = s[2] - m;
  return std::sqrt(1.5 * (a * a + b * b + c * c + 2 * s[3] * s[3]));
}

MaterialAnswer answer_to(const Material& material, const Tensor& strain, const PlasticState& before) {
  const double shear = material.youngs_mpa / (2 * (1 + material.poisson));
  const double bulk = material.youngs_mpa / (3 * (1 - 2 * material.poisson));
  Tensor elastic{};
  for (std::size_t i = 0; i < 4; ++i) elastic[i] = strain[i] - before.strain[i];
  const double volume = elastic[0] + elastic[1] + elastic[2];
  Tensor deviator{};  // of the stress, as if nothing yielded
  for (std::size_t i = 0; i < 3; ++i) deviator[i] = 2 * shear * (elastic[i] - volume / 3);
  deviator[3] = shear * elastic[3];
  const double size = std::sqrt(deviator[0] * deviator[0] + deviator[1] * deviator[1] +
                                deviator[2] * deviator[2] + 2 * deviator[3] * deviator[3]);
  const double radius = std::sqrt(2.0 / 3) * (material.yield_mpa + material.hardening_mpa * before.length);
  MaterialAnswer answer;
  answer.plastic = before;
  answer.yields = material.yield_mpa > 0 && size > radius;
  double scale = 1, along = 0;  // of the deviator, and of the tangent along it
  Tensor normal{};
  if (answer.yields) {
    const double slip = (size - radius) / (2 * shear + 2 * material.hardening_mpa / 3);
    for (std::size_t i = 0; i < 4; ++i) normal[i] = deviator[i] / size;
    for (std::size_t i = 0; i < 3; ++i) answer.plastic.strain[i] += slip * normal[i];
    answer.plastic.strain[3] += 2 * slip * normal[3];
    answer.plastic.length += std::sqrt(2.0 / 3) * slip;
    scale = 1 - 2 * shear * slip / size;
    along = 1 / (1 + material.hardening_mpa / (3 * shear)) - (1 - scale);
  }
  for (std::size_t i = 0; i < 3; ++i) answer.stress[i] = scale * deviator[i] + bulk * volume;
  answer.stress[3] = scale * deviator[3];
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      double t = -2 * shear * along * normal[i] * normal[j];
      if (i < 3 && j < 3) t += bulk - 2 * shear * scale / 3;
      if (i == j) t += (i < 3 ? 2 : 1) * shear * scale;
      answer.tangent[i][j] = t;
    }
  return answer;
}

StrainAt strain_at(const RingMesh& mesh, const MeshElement& element, int point) {
  const double at = 1 / std::sqrt(3.0);
  const Shapes s = shapes_at(point % 2 == 0 ? -at : at, point < 2 ? -at : at);
  double r = 0, r_xi = 0, r_eta = 0, z_xi = 0, z_eta = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    const MeshNode& n = mesh.nodes[static_cast<std::size_t>(element.nodes[i])];
    r += s.value[i] * n.r;
    r_xi += s.by_xi[i] * n.r, r_eta += s.by_eta[i] * n.r;
    z_xi += s.by_xi[i] * n.z, z_eta += s.by_eta[i] * n.z;
  }
  const double area = r_xi * z_eta - r_eta * z_xi;
  StrainAt strain;
  strain.volume = area * r;
  for (std::size_t i = 0; i < 8; ++i) {
    const double by_r = (s.by_xi[i] * z_eta - s.by_eta[i] * z_xi) / area;
    const double by_z = (s.by_eta[i] * r_xi - s.by_xi[i] * r_eta) / area;
    strain.rows[0][2 * i] = by_r;
    strain.rows[1][2 * i + 1] = by_z;
    strain.rows[2][2 * i] = s.value[i] / r;
    strain.rows[3][2 * i] = by_z;
    strain.rows[3][2 * i + 1] = by_r;
  }
  return strain;
}

}  // namespace lekalo::fit
