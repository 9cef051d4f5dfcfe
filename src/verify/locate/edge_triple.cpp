#include "edge_triple.hpp"

#include <algorithm>
#include <cmath>

namespace lekalo::verify {
EdgeTriple::EdgeTriple(const std::array<const EdgeLine*, 3>& three) : edges(three) {
  bool positive = false, negative = false;
  for (std::size_t j = 0; j < 3; ++j) {
    weights[j] = cross(edges[(j + 1) % 3]->direction, edges[(j + 2) % 3]->direction);
    positive = positive || sgn(weights[j]) > 0;
    negative = negative || sgn(weights[j]) < 0;
  }
  if (positive == negative) {
    balance = positive ? Balance::opposed : Balance::parallel;
    return;
  }
  balance = Balance::holds;
  std::array<Interval, 3> products{Interval(kRough), Interval(kRough), Interval(kRough)};
  for (std::size_t j = 0; j < 3; ++j) {
    if (negative) weights[j] = -weights[j];
    products[j] = Interval(weights[j], kRough) * edges[j]->short_length;
  }
  const Interval sum = products[0] + products[1] + products[2];
  for (std::size_t j = 0; j < 3; ++j) shares[j] = (products[j] / sum).low_double();
}

double EdgeTriple::disagreement(const std::array<double, 3>& multipliers) const {
  double largest = 0;
  for (std::size_t j = 0; j < 3; ++j) largest = std::max(largest, std::abs(shares[j] - multipliers[j]));
  return largest;
}

double EdgeTriple::sensitivity(const Interval& roundoff) const {
  Interval sum(kRough), products(kRough);
  for (std::size_t j = 0; j < 3; ++j) {
    sum = sum + Interval(weights[j], kRough) * edges[j]->short_length;
    products = products + edges[j]->short_length * edges[(j + 1) % 3]->short_length;
  }
  return 2 * (roundoff * products / sum).high_double();
}

EdgeTriple intended_triple(const std::array<const EdgeLine*, 3>& written,
                           const std::array<double, 3>& multipliers, double tolerance, EdgeLines& edges) {
  const auto fits = [&](const EdgeTriple& triple) {
    return triple.balance == EdgeTriple::Balance::holds && triple.disagreement(multipliers) <= tolerance;
  };
  EdgeTriple as_written(written);
  if (fits(as_written)) return as_written;
  const Outline& blank = edges.outline();
  for (std::size_t j = 0; j < 3; ++j) {
    if (!(std::abs(multipliers[j]) <= tolerance)) continue;
    const Point& along = written[(j + 1) % 3]->direction;
    for (const Point& across : {Point{-along.y, along.x}, Point{along.y, -along.x}}) {
      const std::size_t corner = lowest_corner(blank, across, 0);
      for (const std::size_t side : {corner, corner + blank.hull.size() - 1}) {
        std::array<const EdgeLine*, 3> three = written;
        three[j] = &edges.along_hull(side);
        EdgeTriple replaced(three);
        if (fits(replaced)) return replaced;
      }
    }
  }
  return as_written;
}

}  // namespace lekalo::verify
