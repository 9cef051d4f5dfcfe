#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "lekalo/base/stop.hpp"
#include "lekalo/locate/solid_criterion.hpp"
#include "locate/search/quadratic_step.hpp"
#include "solid_climb.hpp"
#include "solid_deep.hpp"
#include "solid_placement.hpp"

namespace lekalo::locate {
namespace {

using solid::Motion;
using solid::Vector;

constexpr std::size_t kEvenPoints = 600;
/// The first of the equal steps along the area begins here: it is no whole number of small parts of a step,
/// where the areas of triangles often end.
constexpr double kFirstPlace = 0.4142;
/// Multiples of these, less their whole parts, fill a square evenly (Roberts 2018, "The unreasonable
/// effectiveness of quasirandom sequences").
constexpr double kAlong = 0.7548776662466927, kAcross = 0.5698402909980532;

constexpr int kMostEvenSteps = 100;
/// The first steps go up to this part of the part's reach.
constexpr double kFirstEvenReach = 0.05;
/// A step shorter than this ends the search, mm, and so does one that promises this part of the mean square,
/// or of the square of what depths are measured to.
constexpr double kShortestEvenStep = 1e-6, kWorthAnEvenStep = 1e-6;
/// Freedoms that no point sees are held by so much.
constexpr double kHeldFreedom = 1e-9;

/// A point of a triangle, and the allowance that it should have; none aims at the mean of all such points.
struct EvenPoint {
  Vector part;
  std::uint32_t triangle = 0;
  std::optional<double> target;
};

/// Points all over what has a demand, as docs/formats.md says.
std::vector<EvenPoint> even_points(const SolidProblem& problem) {
  const solid::Mesh& part = problem.part;
  const std::vector<std::uint32_t> triangles = demanded(problem, 1).triangles;
  std::vector<double> until;
  double area = 0;
  for (const std::uint32_t t : triangles) {
    const auto& [i, j, k] = part.triangles[t];
    const Vector a = part.vertices[i];
    area += 0.5 * norm(cross(part.vertices[j] - a, part.vertices[k] - a));
    until.push_back(area);
  }
  std::vector<EvenPoint> points;
  for (std::size_t n = 0; n < kEvenPoints; ++n) {
    const double place = (static_cast<double>(n) + kFirstPlace) / kEvenPoints * area;
    const auto found = std::upper_bound(until.begin(), until.end() - 1, place);
    const std::uint32_t t = triangles[static_cast<std::size_t>(found - until.begin())];
    std::array<Vector, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) corner[k] = part.vertices[part.triangles[t][k]];
    std::sort(corner.begin(), corner.end(), [](Vector a, Vector b) {
      return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
    });
    const double count = static_cast<double>(n) + 1;
    const double u = std::sqrt(count * kAlong - std::floor(count * kAlong)),
                 v = count * kAcross - std::floor(count * kAcross);
    const Vector p = corner[0] + u * (1 - v) * (corner[1] - corner[0]) + u * v * (corner[2] - corner[0]);
    points.push_back({p, t, problem.targets.empty() ? std::nullopt : problem.targets[t]});
  }
  return points;
}

/// The allowances of all points at a pose.
class Allowances {
 public:
  Allowances(const std::vector<EvenPoint>& points, const solid::TriangleTree& blank, const Motion& motion)
      : points_(points) {
    double sum = 0;
    for (const EvenPoint& one : points) {
      at_.push_back(NearFace::point_at(blank, motion, one.part, one.triangle));
      if (!one.target) sum += at_.back().far, ++free_;
    }
    if (free_ > 0) mean_ = sum / static_cast<double>(free_);
  }

  [[nodiscard]] double residual(std::size_t k) const {
    return at_[k].far - points_[k].target.value_or(mean_);
  }

  [[nodiscard]] double mean_square() const {
    double sum = 0;
    for (std::size_t k = 0; k < at_.size(); ++k) sum += residual(k) * residual(k);
    return sum / static_cast<double>(at_.size());
  }

  /// The changes of all residuals with a step.
  [[nodiscard]] std::vector<Steps> slopes(const SolidFrame& frame, const Motion& motion) const {
    std::vector<Steps> made;
    Steps mean{};
    for (std::size_t k = 0; k < at_.size(); ++k) {
      SolidContact contact{at_[k].part, at_[k].blank, {}};
      const Vector way = at_[k].placed - at_[k].blank;
      if (const double length = norm(way); length > 0) contact.normal = 1 / length * way;
      made.push_back(row_of(frame, motion, contact).slope);
      if (!points_[k].target)
        for (std::size_t i = 0; i < 6; ++i) mean[i] += made[k][i] / static_cast<double>(free_);
    }
    for (std::size_t k = 0; k < made.size(); ++k)
      if (!points_[k].target)
        for (std::size_t i = 0; i < 6; ++i) made[k][i] -= mean[i];
    return made;
  }

 private:
  const std::vector<EvenPoint>& points_;
  std::vector<FarPoint> at_;
  std::size_t free_ = 0;
  double mean_ = 0;
};

/// The steps from one allowed pose to the next one that is more even.
class Evening {
 public:
  Evening(const SolidProblem& problem, const SolidMeter& meter, double least_margin,
          const SolidOptions& options)
      : meter_(meter),
        options_(options),
        least_(least_margin),
        points_(even_points(problem)),
        poses_(problem, meter, least_margin, options) {}

  /// Returns the best pose that steps lead to, or none where `from` is not allowed.
  std::optional<FramedPose> from(const FramedPose& from, double widest, double give_up) {
    Trust trust{std::min(widest, kFirstEvenReach * meter_.frame().reach)};
    std::optional<DeepPose> here = poses_.looked_at(from, trust.reach);
    if (!here) return std::nullopt;
    most_ = here->deepest + give_up + poses_.slack();
    spare_ = here->at.value - least_;
    double square = mean_square(from);
    for (int step = 0; step < kMostEvenSteps && !poses_.ended() && trust.reach > kShortestEvenStep; ++step) {
      if (options_.run.progress)
        options_.run.progress({poses_.work(), static_cast<double>(step) / kMostEvenSteps});
      double hoped = 0;
      const Steps z = best_step(*here, trust.reach, hoped);
      if (!(hoped > kWorthAnEvenStep * std::max(square, poses_.slack() * poses_.slack()))) break;
      const FramedPose next = meter_.frame().moved(here->at.pose, z);
      const double then = mean_square(next);
      const std::size_t known = poses_.met();
      std::optional<DeepPose> there;
      if (then < square) there = poses_.looked_at(next, trust.reach);
      if (there && there->deepest <= most_) {
        trust.was_better(square - then, hoped, poses_.met() > known);
        here = std::move(there), square = then;
      } else {
        trust.was_no_better(poses_.met() > known);
      }
    }
    return here->at.pose;
  }
  [[nodiscard]] std::uint64_t work() const noexcept { return poses_.work(); }

 private:
  [[nodiscard]] double mean_square(const FramedPose& pose) const {
    return Allowances(points_, meter_.clearance().blank(), meter_.frame().motion(pose)).mean_square();
  }

  /// The step that a model of the squares promises most of, up to `reach`: it keeps all that is known. Sets
  /// how much of the mean square it takes off.
  [[nodiscard]] Steps best_step(const DeepPose& here, double reach, double& hoped) const {
    const SolidFrame& frame = meter_.frame();
    const Motion motion = frame.motion(here.at.pose);
    const Allowances now(points_, meter_.clearance().blank(), motion);
    const double room = room_for_turns(frame, spare_, reach);
    Steps half = frame.trusted(reach);
    for (std::size_t i = 3; i < 6; ++i) half[i] = std::min(half[i], most_turn_in(frame, room));
    std::array<Steps, 6> h{};
    Steps g{};
    const std::vector<Steps> slopes = now.slopes(frame, motion);
    const double share = 1 / static_cast<double>(slopes.size());
    for (std::size_t k = 0; k < slopes.size(); ++k)
      for (std::size_t i = 0; i < 6; ++i) {
        if (!(half[i] > 0)) continue;
        g[i] += share * now.residual(k) * slopes[k][i];
        for (std::size_t j = 0; j < 6; ++j)
          if (half[j] > 0) h[i][j] += share * slopes[k][i] * slopes[k][j];
      }
    for (std::size_t i = 0; i < 6; ++i) h[i][i] += half[i] > 0 ? kHeldFreedom : 1;
    const Steps z = within(half, constrained_step(h, g, rows_at(here, room, half)));
    hoped = -2 * inner(g, z);
    for (std::size_t i = 0; i < 6; ++i) hoped -= z[i] * inner(h[i], z);
    return z;
  }

  /// The dual method may go a little beyond.
  static Steps within(const Steps& half, Steps z) {
    for (std::size_t i = 0; i < 6; ++i) z[i] = std::clamp(z[i], -half[i], half[i]);
    return z;
  }

  /// The rows that a step has to keep: none is to go below 0.
  [[nodiscard]] std::vector<LinearBound<6>> rows_at(const DeepPose& here, double room,
                                                    const Steps& half) const {
    DeepRows known = poses_.rows(here);
    std::vector<LinearBound<6>> rows;
    const auto add = [&](LinearBound<6> row, double above, double unit) {
      row.level = (row.level - above) / unit;
      for (std::size_t i = 0; i < 6; ++i) row.slope[i] = half[i] > 0 ? row.slope[i] / unit : 0;
      rows.push_back(row);
    };
    for (const LinearBound<6>& row : known.places) add(row, meter_.beyond_margins(), kDatumWeight);
    for (const LinearBound<6>& row : known.margins) add(row, least_ + room, 1);
    for (const LinearBound<6>& row : known.depths) add(row, -most_, 1);
    for (std::size_t i = 0; i < 6; ++i)
      for (const double side : {1.0, -1.0}) {
        LinearBound<6> row;
        row.slope[i] = side, row.level = half[i];
        rows.push_back(row);
      }
    return rows;
  }

  const SolidMeter& meter_;
  const SolidOptions& options_;
  double least_, spare_ = 0, most_ = 0;
  std::vector<EvenPoint> points_;
  DeepPoses poses_;
};

}  // namespace

double allowance_deviation(const SolidProblem& problem, const SolidPose& pose) {
  const solid::TriangleTree blank(problem.blank);
  return std::sqrt(Allowances(even_points(problem), blank, motion_of(pose)).mean_square());
}

Result<SolidPlacement> most_even(const SolidProblem& problem, const SolidPlacement& from, double least_margin,
                                 double give_up, const SolidOptions& options) {
  LEKALO_CHECK(check(problem, options));
  LEKALO_CHECK(check_kept(from, least_margin));
  const RunControl nobody;
  const Listening to_the_end(nobody);
  const SolidMeter meter(problem, frame_of(problem), options.threads);
  Evening evening(problem, meter, least_margin, options);
  const auto best =
      evening.from(framed(meter.frame(), from.pose), 0.5 * std::max(problem.shift, options.gap), give_up);
  SolidPlacement made = from;
  if (best) made = placement(meter, *best);
  const bool keeps = made.inside && made.margin >= least_margin;
  if (!keeps || !(allowance_deviation(problem, made.pose) < allowance_deviation(problem, from.pose)))
    made = from;
  else
    made.contacts = holding_contacts(meter, {*best, made.margin, true}, options.gap);
  made.work = from.work + evening.work();
  return made;
}

}  // namespace lekalo::locate
