#include "lekalo/locate/convex.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "angle_search.hpp"
#include "contact_program.hpp"
#include "lekalo/base/angle.hpp"
#include "lekalo/geom/double_double.hpp"
#include "lekalo/geom/pose.hpp"
#include "lekalo/phi/convex.hpp"
#include "locate/search/search_limits.hpp"
#include "proof.hpp"

namespace lekalo::locate {
namespace {

using geom::DoubleDouble;
using geom::Point;
using geom::Ring;

/// Alternatives take at most this many programs, and at most this many are listed.
constexpr std::uint64_t kAlternativesWork = 200'000;
constexpr std::size_t kMostAlternatives = 64;
/// Only rounding keeps a multiplier below this from 0, and its contact holds nothing.
constexpr double kNoForce = 1e-12;

/// A ring moved so that the middle of its box is the origin. The search then sees numbers of the size of the
/// shape, however far away the shape stands.
struct LocalRing {
  Point origin;
  Ring ring;
};

LocalRing to_local(const geom::ConvexPolygon& polygon) {
  const geom::Box box = geom::bounds(polygon.vertices());
  LocalRing local{{0.5 * box.low.x + 0.5 * box.high.x, 0.5 * box.low.y + 0.5 * box.high.y},
                  polygon.vertices()};
  for (Point& p : local.ring) p = p - local.origin;
  return local;
}

/// Returns how much more than in exact arithmetic the line of an edge of the blank may move at a point of the
/// part, when the part may lie outside: the longest distance over the shortest edge.
double worst_lever(const geom::ConvexPolygon& blank, double reach) {
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < blank.size(); ++k)
    shortest = std::min(shortest, norm(blank[blank.next(k)] - blank[k]));
  return 1 + 2 * reach / shortest;
}

class Localiser {
 public:
  Localiser(const ConvexProblem& problem, const ConvexOptions& options)
      : problem_(problem),
        options_(options),
        part_(to_local(problem.part)),
        blank_(to_local(problem.blank)),
        program_(part_.ring, blank_.ring) {
    // The move to the local frame rounds every coordinate once more.
    const double rounded = kUnit * program_.scale();
    uncertainty_ = {problem.part_coordinate_error + rounded, problem.blank_coordinate_error + rounded,
                    program_.scale()};
  }

  ConvexResult run() {
    AngleSearch search(program_, problem_.window, search_gap(), options_.run);
    ConvexResult result;
    double upper = -std::numeric_limits<double>::infinity();
    search.run([&](const CoverPiece& piece) {
      CoverPiece proved = piece;
      upper = std::max(upper, prove(proved, search.best().value + options_.gap));
      record(proved, result);
    });
    if (options_.keep_certificate && result.certificate_size > options_.certificate_limit)
      result.certificate.clear();
    result.best = placement(search.best());
    result.upper_bound = upper;
    result.contacts = contacts(search.best());
    if (options_.alternatives) add_alternatives(search, result);
    result.work = search.work();
    result.shortfall = std::max(0.0, options_.min_allowance - result.best.clearance);
    const bool closed = result.upper_bound - result.best.clearance <= std::max(options_.gap, least_gap());
    result.status = search.finished() && closed ? Status::optimal : Status::stopped;
    if (result.upper_bound < options_.min_allowance) result.status = Status::infeasible;
    return result;
  }

 private:
  /// Returns how much of the gap may be taken by rounding the pose and proving the bound.
  [[nodiscard]] double taken_by_rounding() const {
    const double far = geom::largest_coordinate(problem_.part.vertices()) +
                       geom::largest_coordinate(problem_.blank.vertices());
    return 8 * kUnit * far + 128 * kUnit * program_.scale() +
           6 * (problem_.part_coordinate_error + problem_.blank_coordinate_error);
  }

  /// Returns the gap that is left to the search.
  [[nodiscard]] double search_gap() const {
    return std::max(options_.gap - taken_by_rounding(), 8 * kUnit * program_.scale());
  }

  /// Returns the smallest gap that doubles can be asked for.
  [[nodiscard]] double least_gap() const { return 2 * taken_by_rounding(); }

  [[nodiscard]] double proved(const CoverPiece& piece) const {
    return proved_bound(piece.basis, piece.from, piece.to, part_.ring, blank_.ring, uncertainty_);
  }

  /// Returns the bound that a piece of the cover proves. The third contact is braced where that proves more.
  double prove(CoverPiece& piece, double enough) const {
    const double bound = proved(piece);
    if (bound <= enough) return bound;
    CoverPiece other = piece;
    other.basis = program_.braced(piece.basis, piece.from);
    const double braced = proved(other);
    if (!(braced < bound)) return bound;
    piece = other;
    return braced;
  }

  void record(const CoverPiece& piece, ConvexResult& result) const {
    CertificateInterval interval{piece.from.theta, piece.to.theta, {}};
    for (std::size_t j = 0; j < 3; ++j)
      interval.contacts[j] = {piece.basis.vertex[j], piece.basis.edge[j],
                              std::max(0.0, piece.basis.lambda[j])};
    ++result.certificate_size;
    if (options_.keep_certificate && result.certificate_size <= options_.certificate_limit)
      result.certificate.push_back(interval);
    if (options_.certificate_sink) options_.certificate_sink(interval);
  }

  /// Returns the pose in the file's coordinates. Its doubles are fixed first, and its clearance is enclosed
  /// at exactly those.
  [[nodiscard]] Placement placement(const AngleSearch::Incumbent& found) const {
    // The place x, y is shift + blank origin - R part origin, in twice the digits.
    const geom::SinCosPair rotation = geom::sincos_double_double(found.angle.theta);
    const DoubleDouble px{part_.origin.x}, py{part_.origin.y};
    const DoubleDouble x =
        geom::two_sum(found.shift.x, blank_.origin.x) - (rotation.cosine * px - rotation.sine * py);
    const DoubleDouble y =
        geom::two_sum(found.shift.y, blank_.origin.y) - (rotation.sine * px + rotation.cosine * py);
    Placement placement{x.hi, y.hi, found.angle.theta, 0};
    const double low =
        phi::clearance_enclosure(problem_.part, problem_.blank, placement.x, placement.y, placement.theta)
            .low;
    // Inside, clearance is a distance between outlines, which move by no more than their points do. Outside
    // it is a distance to the line of an edge, which may move more.
    constexpr double kDiagonal = 1.4142135623730952;
    const double lever = low >= 0 ? 1 : worst_lever(problem_.blank, 4 * program_.scale() + std::abs(low));
    const double errors = kDiagonal *
                          (problem_.part_coordinate_error + lever * problem_.blank_coordinate_error) *
                          (1 + 8 * kUnit);
    // The written decimals of pose and clearance are the shortest that read back, so they are off by half a
    // unit in the last place.
    const double written =
        kUnit * (std::abs(placement.x) + std::abs(placement.y) + std::abs(low) +
                 std::abs(placement.theta) * geom::largest_coordinate(problem_.part.vertices()) * 2);
    placement.clearance = low - errors - written;
    return placement;
  }

  /// Returns what holds the placement: contacts whose multipliers balance in force, and also in moment where
  /// two bounds meet.
  [[nodiscard]] std::vector<Contact> contacts(const AngleSearch::Incumbent& found) const {
    const Basis* rising = nullptr;
    const Basis* falling = nullptr;
    for (const Basis& basis : found.holders) {
      if (!all_touch(basis, found)) continue;
      const double slope = basis.bound.slope_at(found.angle);
      if (slope >= 0 && (rising == nullptr || slope > rising->bound.slope_at(found.angle))) rising = &basis;
      if (slope <= 0 && (falling == nullptr || slope < falling->bound.slope_at(found.angle)))
        falling = &basis;
    }
    // The angle's own basis always touches. The others touch where the search has closed in.
    const Basis* first = rising != nullptr ? rising : (falling != nullptr ? falling : &found.holders.front());
    const Basis* second = falling != nullptr ? falling : first;
    const double up = first->bound.slope_at(found.angle), down = -second->bound.slope_at(found.angle);
    const double weight = up + down > 0 ? down / (up + down) : 1.0;
    std::vector<Contact> merged;
    const auto add = [&](const Basis& basis, double factor) {
      for (std::size_t j = 0; j < 3; ++j) {
        const double multiplier = factor * std::max(0.0, basis.lambda[j]);
        if (!(multiplier > kNoForce)) continue;
        const auto same = std::find_if(merged.begin(), merged.end(), [&](const Contact& contact) {
          return contact.part_vertex == basis.vertex[j] && contact.blank_edge == basis.edge[j];
        });
        if (same != merged.end()) {
          same->multiplier += multiplier;
        } else {
          merged.push_back({basis.vertex[j], basis.edge[j], multiplier});
        }
      }
    };
    add(*first, first == second ? 1.0 : weight);
    if (second != first) add(*second, 1.0 - weight);
    std::sort(merged.begin(), merged.end(), [](const Contact& a, const Contact& b) {
      return a.blank_edge != b.blank_edge ? a.blank_edge < b.blank_edge : a.part_vertex < b.part_vertex;
    });
    return merged;
  }

  /// Says whether the three contacts of a basis are contacts of this placement, but for what cannot be
  /// measured.
  [[nodiscard]] bool all_touch(const Basis& basis, const AngleSearch::Incumbent& found) const {
    const double tolerance = 1e-9 * program_.scale();
    const double c = found.angle.direction.cosine, s = found.angle.direction.sine;
    for (std::size_t j = 0; j < 3; ++j) {
      const Point v = part_.ring[basis.vertex[j]], a = blank_.ring[basis.edge[j]];
      const Point edge = blank_.ring[problem_.blank.next(basis.edge[j])] - a;
      const Point p = Point{c * v.x - s * v.y, s * v.x + c * v.y} + found.shift;
      if (cross(edge, p - a) / norm(edge) > found.value + tolerance) return false;
    }
    return true;
  }

  void add_alternatives(AngleSearch& search, ConvexResult& result) const {
    const double best = search.best().value, at = search.best().angle.theta;
    const AngleSearch::Peaks peaks = search.peaks(best - *options_.alternatives, kAlternativesWork);
    result.alternatives_complete = peaks.complete;
    for (const AngleSearch::Incumbent& peak : peaks.found) {
      if (same_peak(peak.angle.theta, at)) continue;
      if (result.alternatives.size() == kMostAlternatives) {
        result.alternatives_complete = false;
        break;
      }
      result.alternatives.push_back(placement(peak));
    }
  }

  /// Says whether two angles belong to one peak. Both searches close in on a maximum to within the gap, and
  /// at the same maximum their angles agree closely.
  [[nodiscard]] bool same_peak(double a, double b) const {
    const double difference = std::abs(a - b);
    const double apart =
        problem_.window.full_circle() ? std::min(difference, kTurn - difference) : difference;
    return apart < 1e-6;
  }

  const ConvexProblem& problem_;
  const ConvexOptions& options_;
  LocalRing part_, blank_;
  ContactProgram program_;
  Uncertainty uncertainty_;
};

}  // namespace

Result<ConvexResult> locate_convex(const ConvexProblem& problem, const ConvexOptions& options) {
  LEKALO_CHECK(check_limits(problem.window, options.gap, options.min_allowance));
  if (!(problem.part_coordinate_error >= 0) || !(problem.blank_coordinate_error >= 0))
    return failure(ErrorCode::usage, "coordinate errors must not be negative");
  return Localiser(problem, options).run();
}

Touch touch_of(const Contact& contact, const geom::ConvexPolygon& part, const geom::ConvexPolygon& blank,
               const Placement& placement) {
  const auto pose = geom::BlankFromPart::from_angle(placement.theta, {placement.x, placement.y});
  const geom::Point vertex = pose(part[contact.part_vertex]), a = blank[contact.blank_edge];
  const geom::Point along = blank[blank.next(contact.blank_edge)] - a;
  const geom::Point foot = a + (dot(vertex - a, along) / dot(along, along)) * along;
  return {contact.part_vertex,
          contact.blank_edge,
          part[contact.part_vertex],
          foot,
          norm(foot - vertex),
          contact.multiplier,
          {}};
}

}  // namespace lekalo::locate
