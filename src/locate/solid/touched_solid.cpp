#include "lekalo/locate/touched_solid.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/limits.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/trig.hpp"
#include "solid_form.hpp"
#include "touch_fit.hpp"

namespace lekalo::locate {
namespace {

using solid::Box;
using solid::Motion;
using solid::TriangleTree;
using solid::Vector;
using Axis = SolidTree::Axis;

constexpr std::array<double Vector::*, 3> kCoordinates{&Vector::x, &Vector::y, &Vector::z};
/// The square root of 3, rounded up: how far a point is off at most for each of its coordinates.
constexpr double kRootOfThree = 1.7321;
/// Each touch is looked at in every cut.
constexpr std::size_t kMostTouches = 5000;
/// A cut takes half of the box at most, and a side is given up for the time being where not even the last
/// part can be proved.
constexpr double kLargestCut = 0.5, kSmallestCut = 1.0 / 64;
constexpr int kMostRounds = 60;
/// Balls beside a touch go down from so many times the mesh by halves, so many of them, each nearer to the
/// touched place than this part of what a touch may be off.
constexpr double kLargestBall = 4, kMostOfTouch = 0.5;
constexpr int kBalls = 16, kKept = 3;
/// Multipliers are whole numbers up to this, so that they take little room in files.
constexpr double kWholeNumbers = 1e9;
/// Sums of terms stay below 0 by this part of the sizes, which is more than the rounding of what they are
/// made of: coordinates, radii and lengths, as shortest decimals of their doubles.
constexpr double kRoom = 0x1p-38;
/// Rounding takes less than this part off a width, or off the coordinates it comes from.
constexpr double kWidthRounding = 0x1p-44;
/// A way that may be so many times as far as a touch may be off the surface is told.
constexpr double kLoose = 8;
/// A ball counts as large beside what touches may be off only where rounding does not decide it.
constexpr double kSurely = 1 + 1e-9;
/// How far a corner may be off is halved so often.
constexpr int kHalvings = 9;

double& side_of(FramedPose& pose, std::size_t axis) {
  return axis < 3 ? pose.at.*kCoordinates[axis] : pose.x.*kCoordinates[axis - 3];
}

/// A ball without surface of the nominal mesh inside, and the touch that stays away from it.
struct Apart {
  std::uint32_t touch = 0;
  SolidBall ball;
  Vector seen;       ///< its centre from the pivot, turned as at the start
  double least = 0;  ///< how far the centres are apart, at least
};

Result<void> check(const TouchStatement& stated, std::size_t touches) {
  const auto number = [](double value, bool positive) {
    return value <= limits::kLargestCoordinate && (positive ? value > 0 : value >= 0);
  };
  for (const auto& [value, positive, name] :
       {std::tuple{stated.ball, false, "the diameter of the probe's ball"},
        {stated.form, true, "the form deviation"},
        {stated.guard, false, "the uncertainty of the touches"},
        {stated.shift, true, "the window of the nominal mesh"},
        {stated.coordinate_error, false, "what coordinates are off"}})
    if (!number(value, positive))
      return failure(ErrorCode::usage, fmt::format("{}, {} mm, must be a number, 0 or above{}", name, value,
                                                   positive ? ", and not 0" : ""));
  if (!(stated.turn >= 0 && stated.turn <= 0.25 * kPi))
    return failure(ErrorCode::usage,
                   "the window of the nominal mesh must have turns from 0 to an eighth of a turn");
  if (!stated.directions.empty() && stated.directions.size() != touches)
    return failure(ErrorCode::usage,
                   fmt::format("there are {} directions for {} touches", stated.directions.size(), touches));
  for (const Vector n : stated.directions)
    if (const double length = norm(n); !(length > 0) || !std::isfinite(length))
      return failure(ErrorCode::usage, fmt::format("({}, {}, {}) is no direction", n.x, n.y, n.z));
  // Touches with a direction are points of the surface.
  if (stated.directions.empty() && stated.ball > 0 && !(0.5 * stated.ball > stated.guard))
    return failure(ErrorCode::usage,
                   fmt::format("a ball of {} mm must have a radius above {:.6g} mm, what the touches are "
                               "uncertain by",
                               stated.ball, stated.guard));
  return {};
}

/// The places where the ball met the blank, as the directions say.
std::vector<Vector> met(std::vector<Vector> centres, const TouchStatement& stated) {
  for (std::size_t k = 0; k < stated.directions.size(); ++k) {
    const Vector n = stated.directions[k];
    centres[k] = centres[k] - 0.5 * stated.ball / norm(n) * n;
  }
  return centres;
}

/// Holds the directions against the outward normals of the mesh where it fits the touches.
Result<void> check_directions(const TriangleTree& nominal, const Motion& motion,
                              const std::vector<Vector>& touches, const std::vector<Vector>& directions,
                              std::vector<std::string>& notices) {
  constexpr double kAskew = 0.7;  // the cosine of 45 degrees, about
  std::size_t inwards = 0, askew = 0, first = 0;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    ask();
    const Vector normal = motion.turned(touched_place(nominal, motion.back(touches[k])).normal);
    const double along = dot(normal, directions[k]) / norm(directions[k]);
    if (along < 0) ++inwards;
    if (along < kAskew && askew++ == 0) first = k;
  }
  if (2 * inwards > directions.size())
    return failure(
        ErrorCode::bad_input,
        fmt::format("{} of {} directions lead into the nominal mesh where it fits the touches best; a "
                    "direction has to lead out of the blank, towards the probe",
                    inwards, directions.size()));
  if (askew > 0)
    notices.push_back(
        fmt::format("{} directions lie more than 45 degrees off that of the nominal surface, the "
                    "first that of touch {}",
                    askew, first + 1));
  return {};
}

/// Takes off a box of motions, cut by cut, what the touches do not allow.
class Enclosure {
 public:
  /// \param numbers  of the touches that count
  Enclosure(const TriangleTree& nominal, const SolidFrame& frame, const std::vector<Vector>& touches,
            std::vector<std::uint32_t> numbers, const TouchStatement& stated)
      : nominal_(nominal),
        frame_(frame),
        touches_(touches),
        numbers_(std::move(numbers)),
        stated_(stated),
        start_(motion_of({frame.start, {}})),
        cell_(frame.window),
        off_(stated.form + stated.guard) {
    far_ = nominal.largest() + frame.reach + stated.ball + stated.shift;
    for (const std::uint32_t k : numbers_) far_ = std::max(far_, norm(touches[k]));
    proof_.pivot = frame.pivot, proof_.quaternion = frame.start;
    for (std::size_t k = 0; k < 6; ++k)
      proof_.low[k] = side_of(cell_.low, k), proof_.high[k] = side_of(cell_.high, k);
  }

  /// False where no motion is left.
  bool run() {
    for (int round = 0; round < kMostRounds; ++round) {
      choose();
      if (!proved(cell_).empty()) return false;
      bool narrower = false;
      for (std::size_t axis = 0; axis < 6; ++axis)
        for (const bool above : {false, true}) narrower = cut(axis, above) || narrower;
      if (!narrower) break;
    }
    return true;
  }

  /// Takes the mesh to the middle of what is left, and bounds how far it may be off there.
  void place() {
    const FramedPose middle = cell_.middle();
    proof_.moved = {frame_.quaternion(middle), frame_.motion(middle).shift};
    const double room = 2 * stated_.coordinate_error + kWidthRounding * nominal_.largest();
    const Vector wider{room, room, room};
    proof_.around = {nominal_.box().low - wider, nominal_.box().high + wider};
    choose();
    const CellView seen = view(cell_);
    std::vector<LinearBound<6>> program = program_of(seen);
    for (std::uint32_t corner = 0; corner < 8; ++corner)
      for (std::size_t axis = 0; axis < 3; ++axis)
        for (const bool above : {false, true}) bound_way(corner, axis, above, seen, program);
  }

  [[nodiscard]] TouchProof take() { return std::move(proof_); }

 private:
  struct Term {
    std::uint32_t row, multiplier;
  };

  [[nodiscard]] PoseForm form_of(const Apart& apart, const CellView& view) const {
    const double l = norm(view.turned.turned(apart.seen) + view.middle.at - touches_[apart.touch]);
    return distance(apart.seen, touches_[apart.touch], l > 0 ? l : 1, apart.least, view);
  }
  [[nodiscard]] CellView view(const SolidCell& cell) const { return {cell, far_, frame_.reach}; }

  /// How far the centre of a ball stays from a touch.
  [[nodiscard]] double least(double radius, bool inside) const {
    const double ball = 0.5 * stated_.ball, error = kRootOfThree * stated_.coordinate_error;
    if (!inside) return radius - ball - off_ - error;
    return radius - off_ - error + (ball > 2 * kSurely * off_ ? ball : 0);
  }

  /// The balls on one side of a touched place, large ones first.
  void add_balls(std::uint32_t touch, const TouchedPlace& at, double side, std::vector<Apart>& found) const {
    int kept = 0;
    for (int k = 0; k < kBalls && kept < kKept; ++k) {
      const double wanted = std::ldexp(kLargestBall * frame_.reach, -k);
      const Vector centre = at.place + side * wanted * at.normal;
      const double rounding = kWidthRounding * (norm(centre) + nominal_.largest());
      const double radius =
          nominal_.nearest(centre)->low - kRootOfThree * stated_.coordinate_error - rounding;
      if (!(radius > 0) || wanted - radius > kMostOfTouch * off_) continue;
      found.push_back({touch,
                       {centre, radius},
                       start_.turned(centre - frame_.pivot),
                       least(radius, nominal_.holds(centre))});
      ++kept;
    }
  }

  /// Chooses, for each touch and each side, the ball that says most about the box.
  void choose() {
    rows_.clear();
    const CellView seen = view(cell_);
    const Motion motion = frame_.motion(seen.middle);
    for (const std::uint32_t k : numbers_) {
      ask(16);
      const TouchedPlace at = touched_place(nominal_, motion.back(touches_[k]));
      for (const double side : {-1.0, 1.0}) {
        std::vector<Apart> found;
        add_balls(k, at, side, found);
        const auto level = [&](const Apart& one) { return form_of(one, seen).tangent(seen).level; };
        const auto best = std::min_element(
            found.begin(), found.end(), [&](const Apart& a, const Apart& b) { return level(a) < level(b); });
        if (best != found.end()) rows_.push_back(*best);
      }
    }
  }

  [[nodiscard]] std::vector<LinearBound<6>> program_of(const CellView& seen) const {
    std::vector<LinearBound<6>> program;
    for (const Apart& row : rows_) program.push_back(form_of(row, seen).tangent(seen));
    ask(program.size());
    return program;
  }

  /// Terms whose weighted sum is below 0 all over the box; none where they are not found.
  /// \param program  of the rows, and of the last form, if there is one
  [[nodiscard]] std::vector<Term> proved(const CellView& seen, const std::vector<LinearBound<6>>& program,
                                         const PoseForm* last = nullptr) const {
    if (program.empty()) return {};
    const LinearSolution<6> solution = solve_cell(program, seen.half);
    if (!(solution.bound < 0)) return {};
    std::vector<Term> terms;
    PoseForm sum;
    for (std::size_t k = 0; k < solution.rows; ++k) {
      const double share = std::round(kWholeNumbers * solution.multiplier[k]);
      if (!(share > 0)) continue;
      const std::uint32_t row = solution.row[k];
      terms.push_back({row, static_cast<std::uint32_t>(share)});
      sum.add(share / kWholeNumbers, row < rows_.size() ? form_of(rows_[row], seen) : *last);
    }
    if (!(sum.most(seen) < -kRoom * far_)) terms.clear();
    return terms;
  }
  [[nodiscard]] std::vector<Term> proved(const SolidCell& cell) const {
    const CellView seen = view(cell);
    return proved(seen, program_of(seen));
  }

  /// Writes the terms of touches down; returns the multiplier of what is none.
  std::uint32_t keep(const std::vector<Term>& terms, std::uint32_t& first, std::uint32_t& count) {
    std::uint32_t other = 0;
    first = static_cast<std::uint32_t>(proof_.terms.size());
    for (const Term& term : terms) {
      if (term.row == rows_.size()) {
        other = term.multiplier;
        continue;
      }
      const Apart& row = rows_[term.row];
      proof_.terms.push_back({row.touch, place_of(row.ball), term.multiplier});
    }
    count = static_cast<std::uint32_t>(proof_.terms.size()) - first;
    return other;
  }

  bool cut(std::size_t axis, bool above) {
    const double low = side_of(cell_.low, axis), high = side_of(cell_.high, axis);
    if (!(low < high)) return false;
    for (double part = kLargestCut; part >= kSmallestCut; part /= 2) {
      const double at = above ? high - part * (high - low) : low + part * (high - low);
      SolidCell off = cell_;
      side_of(above ? off.low : off.high, axis) = at;
      const std::vector<Term> terms = proved(off);
      if (terms.empty()) continue;
      side_of(above ? cell_.high : cell_.low, axis) = at;
      TouchCut& made = proof_.cuts.emplace_back(TouchCut{static_cast<Axis>(axis), above, at});
      (void)keep(terms, made.first, made.count);
      return true;
    }
    return false;
  }

  /// Bounds how far the motions that are left take a corner of the box around the mesh.
  void bound_way(std::uint32_t corner, std::size_t axis, bool above, const CellView& seen,
                 std::vector<LinearBound<6>>& program) {
    const Box& box = proof_.around;
    const Vector at{(corner & 1) != 0 ? box.high.x : box.low.x, (corner & 2) != 0 ? box.high.y : box.low.y,
                    (corner & 4) != 0 ? box.high.z : box.low.z};
    Vector way;
    way.*kCoordinates[axis] = above ? 1 : -1;
    const PoseForm from =
        height(way, start_.turned(at - frame_.pivot), dot(way, motion_of(proof_.moved)(at)), seen);
    const double farthest = std::max(from.most(seen), 0.0) * kSurely + 2 * kRoom * far_;
    TouchWay made{corner, static_cast<Axis>(axis), above, farthest, 0, 0, 0};
    // The box alone is a reason for that.
    std::vector<Term> best{{static_cast<std::uint32_t>(rows_.size()), 1}};
    double low = 0, high = farthest;
    for (int k = 0; k < kHalvings; ++k) {
      const double tried = 0.5 * (low + high);
      PoseForm beyond = from;
      beyond.constant -= tried;
      beyond.size += tried;
      program.push_back(beyond.tangent(seen));
      const std::vector<Term> terms = proved(seen, program, &beyond);
      program.pop_back();
      (terms.empty() ? low : high) = tried;
      if (!terms.empty()) best = terms, made.at = tried;
    }
    made.multiplier = keep(best, made.first, made.count);
    proof_.ways.push_back(made);
  }

  std::uint32_t place_of(const SolidBall& ball) {
    const Vector c = ball.centre;
    const auto [at, added] =
        places_.try_emplace({c.x, c.y, c.z, ball.radius}, static_cast<std::uint32_t>(proof_.balls.size()));
    if (added) proof_.balls.push_back(ball);
    return at->second;
  }

  const TriangleTree& nominal_;
  const SolidFrame& frame_;
  const std::vector<Vector>& touches_;
  std::vector<std::uint32_t> numbers_;
  const TouchStatement& stated_;
  Motion start_;
  SolidCell cell_;
  double off_, far_ = 0;
  std::vector<Apart> rows_;
  TouchProof proof_;
  std::map<std::array<double, 4>, std::uint32_t> places_;
};

/// The heights of the touches over the surface at a pose, less the ball's radius.
std::vector<double> heights(const TriangleTree& nominal, const Motion& motion,
                            const std::vector<Vector>& touches, double radius) {
  std::vector<double> made;
  for (const Vector touch : touches)
    made.push_back(touched_place(nominal, motion.back(touch)).height - radius);
  return made;
}

/// How far a point of the nominal mesh may be off its place: it stays the mean of the corners of the box
/// around that it is, so its way along each axis is that mean of theirs.
double farthest(const TouchProof& proof, const std::array<std::array<double, 3>, 8>& ways, Vector v) {
  const Box& box = proof.around;
  Vector way;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    double share = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double low = box.low.*kCoordinates[axis], size = box.high.*kCoordinates[axis] - low;
      const double part = (v.*kCoordinates[axis] - low) / size;
      share *= (corner >> axis & 1) != 0 ? part : 1 - part;
    }
    way = way + share * Vector{ways[corner][0], ways[corner][1], ways[corner][2]};
  }
  return norm(way);
}

/// Moves the mesh to its place, and gives the triangles their widths.
void widen(const solid::Mesh& nominal, const TouchStatement& stated, TouchedSolid& made) {
  std::array<std::array<double, 3>, 8> ways{};
  for (const TouchWay& one : made.proof.ways) {
    double& most = ways[one.corner][static_cast<std::size_t>(one.axis)];
    most = std::max(most, one.at);
  }
  const Motion motion = motion_of(made.proof.moved);
  made.mesh.triangles = nominal.triangles;
  std::vector<double> of_vertex;
  double far = 0;
  for (const Vector v : nominal.vertices) {
    made.mesh.vertices.push_back(motion(v));
    of_vertex.push_back(farthest(made.proof, ways, v));
    far = std::max({far, norm(v), norm(made.mesh.vertices.back())});
  }
  const double error = kWidthRounding * (far + stated.form) + 4 * kRootOfThree * stated.coordinate_error;
  for (const auto& [a, b, c] : nominal.triangles)
    made.widths.push_back(stated.form + std::max({of_vertex[a], of_vertex[b], of_vertex[c]}) + error);
  made.widest = *std::max_element(made.widths.begin(), made.widths.end());
  made.width_error = 2 * error;
}

/// Names what the touches do not hold.
std::vector<std::string> loose_ways(const TouchProof& proof, double reach, double off) {
  std::vector<std::string> said;
  const auto left = proof.left();
  for (std::size_t k = 0; k < 6; ++k) {
    const double wide = left[k][1] - left[k][0], way = k < 3 ? wide : 2 * reach * wide;
    if (!(way > kLoose * off)) continue;
    const char axis = "xyz"[k % 3];
    said.push_back(
        k < 3 ? fmt::format(
                    "the touches are not shown to hold the blank along {} to better than {:.3g} mm: touch "
                    "more of the sides that look along {}",
                    axis, wide, axis)
              : fmt::format(
                    "the touches are not shown to hold the blank about {} to better than {:.3g} degrees: "
                    "touch more of the sides that a turn about {} moves, far from its axis",
                    axis, 2 * wide * kDegreesPerRadian, axis));
  }
  return said;
}

std::vector<std::string> assumptions_of(const TouchStatement& stated, const TouchProof& proof,
                                        const Vector at, std::size_t left_out) {
  const auto& q = proof.quaternion;
  const Vector p = proof.pivot;
  std::vector<std::string> said{
      fmt::format("the surface of the blank and that of its nominal mesh, at its true place, lie less than "
                  "{} mm from each other, both ways, and what is inside that mesh, so far from its surface, "
                  "is material",
                  stated.form),
      fmt::format("that place is the nominal mesh turned by the quaternion [{:.6g}, {:.6g}, {:.6g}, {:.6g}] "
                  "with its point ({:.6g}, {:.6g}, {:.6g}) at ({:.6g}, {:.6g}, {:.6g}), to within {:.6g} mm "
                  "along each axis and {:.6g} degrees about it",
                  q[0], q[1], q[2], q[3], p.x, p.y, p.z, at.x, at.y, at.z, stated.shift,
                  stated.turn * kDegreesPerRadian),
      !(stated.ball > 0)
          ? fmt::format("each touch lies within {:.6g} mm of the blank's surface", stated.guard)
      : stated.directions.empty()
          ? fmt::format("each touch is the centre of a ball of {} mm that met the blank from outside, to "
                        "within {:.6g} mm",
                        stated.ball, stated.guard)
          : fmt::format(
                "each touch is the centre of a ball of {} mm that met the blank, to within {:.6g} mm, "
                "against the direction beside it",
                stated.ball, stated.guard)};
  if (left_out > 0)
    said.push_back(fmt::format("the {} touches that are left out are none of the surface", left_out));
  return said;
}

}  // namespace

std::array<std::array<double, 2>, 6> TouchProof::left() const {
  std::array<std::array<double, 2>, 6> box{};
  for (std::size_t k = 0; k < 6; ++k) box[k] = {low[k], high[k]};
  for (const TouchCut& cut : cuts) box[static_cast<std::size_t>(cut.axis)][cut.above ? 1 : 0] = cut.at;
  return box;
}

Result<TouchedSolid> touched_solid(const solid::Mesh& nominal, const std::vector<Vector>& centres,
                                   const TouchStatement& as_stated) {
  LEKALO_CHECK(check(as_stated, centres.size()));
  const std::vector<Vector> touches = met(centres, as_stated);
  TouchStatement stated = as_stated;
  if (!stated.directions.empty()) {
    // From here on touches are points of the surface, which rounding takes a little off.
    double far = stated.ball;
    for (const Vector p : centres) far = std::max(far, norm(p));
    stated.ball = 0, stated.coordinate_error += kWidthRounding * far;
  }
  if (touches.empty()) return failure(ErrorCode::bad_input, "there are no touches");
  if (touches.size() > kMostTouches)
    return failure(
        ErrorCode::bad_input,
        fmt::format("these are {} touches, and {} are the most; the points of a scan are meshed, with "
                    "--min-radius MM and without --nominal-blank",
                    touches.size(), kMostTouches));
  const TriangleTree tree(nominal);
  const double radius = 0.5 * stated.ball, most = stated.form + stated.guard;
  SolidFrame frame;
  frame.start = {1, 0, 0, 0};
  frame.pivot = 0.5 * (tree.box().low + tree.box().high);
  frame.reach = 0.5 * norm(tree.box().high - tree.box().low);
  const Vector anywhere{limits::kLargestCoordinate, limits::kLargestCoordinate, limits::kLargestCoordinate};
  frame.window = {{{-1, -1, -1}, frame.pivot - anywhere}, {{1, 1, 1}, frame.pivot + anywhere}};
  FramedPose pose = fitted(tree, frame, touches, radius);

  TouchedSolid made;
  std::vector<std::uint32_t> numbers;
  std::vector<Vector> kept;
  std::vector<double> off = heights(tree, frame.motion(pose), touches, radius);
  for (std::uint32_t k = 0; k < touches.size(); ++k) {
    const bool out = stated.drop_outliers && std::abs(off[k]) > *stated.drop_outliers;
    (out ? made.left_out : numbers).push_back(k);
    if (!out) kept.push_back(touches[k]);
  }
  if (kept.empty()) return failure(ErrorCode::bad_input, "all touches are left out");
  if (!made.left_out.empty()) pose = fitted(tree, frame, kept, radius);
  LEKALO_CHECK(check_directions(tree, frame.motion(pose), touches, stated.directions, made.notices));

  // From here on motions are counted from the fit, and from the middle of the touches.
  const Motion fit = frame.motion(pose);
  frame.start = frame.quaternion(pose);
  Vector middle;
  for (const Vector touch : kept) middle = middle + 1.0 / static_cast<double>(kept.size()) * touch;
  frame.pivot = fit.back(middle);
  for (const Vector v : nominal.vertices) frame.reach = std::max(frame.reach, norm(v - frame.pivot));
  const geom::SinCos half = geom::sincos(0.5 * stated.turn);
  const double x = half.sine / half.cosine;
  const Vector slide{stated.shift, stated.shift, stated.shift};
  frame.window = {{{-x, -x, -x}, middle - slide}, {{x, x, x}, middle + slide}};

  Enclosure enclosure(tree, frame, touches, numbers, stated);
  if (!enclosure.run()) {
    off = heights(tree, frame.motion(frame.window.middle()), kept, radius);
    const auto far = [most](double height) { return !(std::abs(height) < most); };
    const auto worst = static_cast<std::size_t>(
        std::max_element(off.begin(), off.end(),
                         [](double a, double b) { return std::abs(a) < std::abs(b); }) -
        off.begin());
    const Vector p = kept[worst];
    return failure(
        ErrorCode::bad_input,
        fmt::format("no place of the nominal mesh, within {} mm and {:.4g} degrees of the best fit, has all "
                    "touches less than {:.6g} mm, the form deviation and what touches are uncertain by, off "
                    "its surface; at the fit {} of {} are not, the worst, touch {} at ({:.6g}, {:.6g}, "
                    "{:.6g}), by {:.4g} mm: touch it again, say a larger --form, or leave touches out with "
                    "--drop-outliers MM",
                    stated.shift, stated.turn * kDegreesPerRadian, most,
                    std::count_if(off.begin(), off.end(), far), kept.size(), numbers[worst] + 1, p.x, p.y,
                    p.z, std::abs(off[worst])));
  }
  enclosure.place();
  made.proof = enclosure.take();
  widen(nominal, stated, made);
  for (std::string& way : loose_ways(made.proof, frame.reach, most)) made.notices.push_back(std::move(way));
  made.assumptions = assumptions_of(as_stated, made.proof, middle, made.left_out.size());
  return made;
}

}  // namespace lekalo::locate
