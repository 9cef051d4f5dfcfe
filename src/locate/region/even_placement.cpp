#include "even_placement.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "lekalo/geom/trig.hpp"
#include "locate/search/quadratic_step.hpp"

namespace lekalo::locate {
namespace {

using geom::BlankFromPart;
using geom::Point;

constexpr int kMostSteps = 60;
/// A step shorter than this ends the search, mm.
constexpr double kShortest = 1e-7;

using Vector3 = std::array<double, 3>;

/// The allowances of all samples at a pose, signed, with how they change.
class Measurement {
 public:
  Measurement(const EvenSamples& samples, const phi::RegionClearance& clearance, const BlankFromPart& pose)
      : samples_(samples.samples) {
    std::uint32_t likely = 0;
    double length = 0, sum = 0;
    for (const EvenSamples::Sample& sample : samples_) {
      const Point q = pose(sample.at);
      const auto nearest = clearance.blank().nearest(q, likely);
      likely = nearest.edge;
      const bool inside = clearance.blank().contains(q);
      allowance_.push_back(inside ? nearest.distance : -nearest.distance);
      const double d = allowance_.back();
      normal_.push_back(nearest.distance > 0 ? (1 / d) * (q - nearest.point) : Point{});
      if (!sample.has_target) length += sample.length, sum += sample.length * d;
    }
    mean_ = length > 0 ? sum / length : 0;
  }

  [[nodiscard]] double deviation() const {
    double length = 0, sum = 0;
    for (std::size_t k = 0; k < samples_.size(); ++k)
      length += samples_[k].length, sum += samples_[k].length * residual(k) * residual(k);
    return length > 0 ? std::sqrt(sum / length) : 0;
  }

  [[nodiscard]] double residual(std::size_t k) const {
    return allowance_[k] - (samples_[k].has_target ? samples_[k].target : mean_);
  }

  /// Returns the slopes with respect to (x, y, turn), the turn in units of 1 / reach about `pivot`.
  [[nodiscard]] Vector3 slope(std::size_t k, const BlankFromPart& pose, Point pivot, double reach) const {
    const Point p = pose.rotate(samples_[k].at - pivot);
    return {normal_[k].x, normal_[k].y, dot(normal_[k], geom::perpendicular(p)) / reach};
  }

 private:
  const std::vector<EvenSamples::Sample>& samples_;
  std::vector<double> allowance_;
  /// The direction in which the allowance grows.
  std::vector<Point> normal_;
  double mean_ = 0;
};

}  // namespace

void EvenSamples::add(const geom::Edge& edge, double step, const std::optional<double>& target) {
  const bool line = edge.kind == geom::EdgeKind::line;
  const double sweep = line ? 0 : geom::arc_sweep(edge);
  const double length = line ? norm(edge.to - edge.from) : sweep * geom::arc_radius(edge);
  const auto count = static_cast<int>(std::clamp(std::ceil(length / step), 1.0, 1000.0));
  for (int i = 0; i < count; ++i) {
    const double t = (i + 0.5) / count;
    Point at = (1 - t) * edge.from + t * edge.to;
    if (!line) {
      const geom::SinCos turn = geom::sincos((edge.kind == geom::EdgeKind::arc_ccw ? t : -t) * sweep);
      const Point out = edge.from - edge.centre;
      at = edge.centre +
           Point{turn.cosine * out.x - turn.sine * out.y, turn.sine * out.x + turn.cosine * out.y};
    }
    samples.push_back({at, length / count, target.value_or(0), target.has_value()});
  }
}

double deviation_at(const EvenSamples& samples, const phi::RegionClearance& clearance,
                    const BlankFromPart& pose) {
  return Measurement(samples, clearance, pose).deviation();
}

EvenPose most_even(const EvenSamples& samples, const phi::RegionClearance& clearance,
                   const std::vector<LocalCap>& caps, const Placement& start, bool mirrored, double give_up,
                   const std::array<bool, 3>& free, const AngleWindow& window,
                   const std::function<bool(const Placement&)>& allowed) {
  const geom::Box box = clearance.part().bounds();
  const Point pivot = 0.5 * (box.low + box.high);
  const double reach = std::max(0.5 * norm(box.high - box.low), 1e-9);
  const auto pose_of = [&](const Placement& p) {
    return BlankFromPart::from_angle(p.theta, {p.x, p.y}, mirrored);
  };
  EvenPose best{start, deviation_at(samples, clearance, pose_of(start))};
  if (samples.samples.empty()) return best;  // all of the part is finished
  const double floor = clearance.at(pose_of(start)).distance - give_up;
  double trust = 0.05 * reach;
  for (int step = 0; step < kMostSteps && trust > kShortest; ++step) {
    const BlankFromPart pose = pose_of(best.at);
    const Measurement here(samples, clearance, pose);
    std::array<Vector3, 3> h{};
    Vector3 g{};
    Vector3 mean_slope{};
    double length = 0;
    for (std::size_t k = 0; k < samples.samples.size(); ++k) {
      if (samples.samples[k].has_target) continue;
      const Vector3 s = here.slope(k, pose, pivot, reach);
      length += samples.samples[k].length;
      for (std::size_t i = 0; i < 3; ++i) mean_slope[i] += samples.samples[k].length * s[i];
    }
    double total = 0;
    for (std::size_t k = 0; k < samples.samples.size(); ++k) {
      const EvenSamples::Sample& sample = samples.samples[k];
      Vector3 s = here.slope(k, pose, pivot, reach);
      for (std::size_t i = 0; i < 3; ++i)
        s[i] = free[i] ? s[i] - (sample.has_target ? 0 : mean_slope[i] / length) : 0;
      for (std::size_t i = 0; i < 3; ++i) {
        g[i] += sample.length * here.residual(k) * s[i];
        for (std::size_t j = 0; j < 3; ++j) h[i][j] += sample.length * s[i] * s[j];
      }
      total += sample.length;
    }
    for (std::size_t i = 0; i < 3; ++i) h[i][i] += 1e-9 * total;
    std::vector<CellRow> rows;
    std::vector<phi::RegionContact> contacts;
    // A step should not take side * (distance - from) below 0.
    const auto add_rows = [&](double side, double from) {
      for (const phi::RegionContact& contact : contacts) {
        if (!(contact.distance > 0)) continue;
        const Point n = (side / contact.distance) * (pose(contact.part) - contact.blank);
        const Point p = pose.rotate(contact.part - pivot);
        rows.push_back(
            {{n.x, n.y, dot(n, geom::perpendicular(p)) / reach}, side * (contact.distance - from)});
      }
    };
    (void)clearance.at(pose, 2 * trust, &contacts);
    add_rows(1, floor);
    for (const LocalCap& cap : caps) {
      (void)clearance.deepest(pose, cap.edges, 0.125 * trust, 2 * trust, contacts);
      add_rows(-1, cap.most);
    }
    for (std::size_t i = 0; i < 3; ++i)
      for (const double side : {1.0, -1.0}) {
        CellRow row;
        row.slope[i] = side, row.level = free[i] ? trust : 0;
        rows.push_back(row);
      }
    const Vector3 z = constrained_step(h, g, rows);
    Placement next = best.at;
    next.theta = std::clamp(next.theta + (free[2] ? z[2] / reach : 0), window.from, window.to);
    // The pivot moves by (z0, z1) while the part turns about it.
    const Point to = pose(pivot) + Point{z[0], z[1]};
    const Point turned = BlankFromPart::from_angle(next.theta, {}, mirrored).rotate(pivot);
    if (free[0]) next.x = to.x - turned.x;
    if (free[1]) next.y = to.y - turned.y;
    const double deviation = deviation_at(samples, clearance, pose_of(next));
    if (deviation < best.deviation && allowed(next)) {
      best = {next, deviation};
    } else {
      trust *= 0.5;
    }
  }
  return best;
}

}  // namespace lekalo::locate
