#include "ipopt_model.hpp"

#include <algorithm>

#include "lekalo/geom/pose.hpp"

namespace lekalo::locate {
namespace {

using geom::BlankFromPart;
using geom::Point;

Point middle(const geom::Ring& ring) {
  const geom::Box box = geom::bounds(ring);
  return box.low + 0.5 * (box.high - box.low);
}

double half_larger_side(const geom::Ring& ring) {
  const geom::Box box = geom::bounds(ring);
  return 0.5 * std::max(box.high.x - box.low.x, box.high.y - box.low.y);
}

double factor_of_vertices(NonlinearModel::Stage stage, const NonlinearModel::Variables& z) {
  return stage == NonlinearModel::Stage::homothety ? z[3] : 1.0;
}

}  // namespace

NonlinearModel::NonlinearModel(const geom::ConvexPolygon& part, const geom::ConvexPolygon& blank)
    : part_middle_(middle(part.vertices())),
      blank_middle_(middle(blank.vertices())),
      scale_(half_larger_side(blank.vertices())) {
  for (const Point v : part.vertices()) vertices_.push_back((1 / scale_) * (v - part_middle_));
  for (std::size_t k = 0; k < blank.size(); ++k) {
    const Point edge = blank[blank.next(k)] - blank[k];
    const Point normal = (1 / norm(edge)) * perpendicular(edge);
    normals_.push_back(normal);
    offsets_.push_back(dot(normal, (1 / scale_) * (blank[k] - blank_middle_)));
  }
}

void NonlinearModel::constraints(Stage stage, const Variables& z, double* values) const {
  const auto pose = BlankFromPart::from_angle(z[2], {z[0], z[1]});
  const double factor = factor_of_vertices(stage, z), phi = stage == Stage::clearance ? z[3] : 0.0;
  for (std::size_t k = 0; k < normals_.size(); ++k) {
    for (const Point v : vertices_) *values++ = dot(normals_[k], pose(factor * v)) - offsets_[k] - phi;
  }
}

void NonlinearModel::jacobian(Stage stage, const Variables& z, double* values) const {
  const auto turn = BlankFromPart::from_angle(z[2], {});
  const double factor = factor_of_vertices(stage, z);
  for (const Point n : normals_) {
    for (const Point v : vertices_) {
      const Point turned = turn.rotate(v);
      *values++ = n.x;
      *values++ = n.y;
      *values++ = factor * dot(n, perpendicular(turned));
      *values++ = stage == Stage::homothety ? dot(n, turned) : -1.0;
    }
  }
}

void NonlinearModel::hessian(Stage stage, const Variables& z, const double* multipliers,
                             double* values) const {
  const auto turn = BlankFromPart::from_angle(z[2], {});
  double by_angle_twice = 0, by_angle_and_s = 0;
  for (const Point n : normals_) {
    for (const Point v : vertices_) {
      const Point turned = turn.rotate(v);
      const double multiplier = *multipliers++;
      by_angle_twice -= multiplier * dot(n, turned);
      by_angle_and_s += multiplier * dot(n, perpendicular(turned));
    }
  }
  values[0] = factor_of_vertices(stage, z) * by_angle_twice;
  values[1] = stage == Stage::homothety ? by_angle_and_s : 0.0;
}

NonlinearModel::Pose NonlinearModel::placement(const Variables& z) const {
  const Point middle_in_blank = blank_middle_ + scale_ * Point{z[0], z[1]};
  return {middle_in_blank - BlankFromPart::from_angle(z[2], {}).rotate(part_middle_), z[2]};
}

NonlinearModel::Variables NonlinearModel::variables(const Pose& placement, double s) const {
  const auto pose = BlankFromPart::from_angle(placement.theta, placement.translation);
  const Point middle_in_model = (1 / scale_) * (pose(part_middle_) - blank_middle_);
  return {middle_in_model.x, middle_in_model.y, placement.theta, s};
}

}  // namespace lekalo::locate
