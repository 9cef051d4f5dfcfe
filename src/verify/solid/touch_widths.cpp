#include "touch_widths.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "certificate_leaf.hpp"
#include "certificate_tables.hpp"
#include "lekalo/base/stop.hpp"

namespace lekalo::verify {
namespace {

constexpr std::array<std::string_view, 6> kAxes{"x", "y", "z", "turn_x", "turn_y", "turn_z"};

Both as_both(Fraction exact) {
  Both made{std::move(exact)};
  made.near = enclosed(made.exact);
  return made;
}
Both3 point(const std::array<Decimal, 3>& p) { return {both(p[0]), both(p[1]), both(p[2])}; }

class TouchCheck {
 public:
  TouchCheck(const SolidMesh& nominal, const SolidReading& touches, const WrittenSolidScan& scan,
             std::vector<std::string>& findings)
      : nominal_(nominal),
        points_(touches.mesh),
        directions_(touches.directions),
        scan_(scan),
        said_(*scan.touches),
        findings_(findings),
        moved_(said_.moved),
        frame_{nominal, nominal, SolidMotion({said_.quaternion, {}}), point(said_.pivot), {}},
        is_out_(touches.mesh.near.size(), 0) {}

  /// Says whether all of the proof holds.
  bool run() {
    const std::size_t before = findings_.size();
    if (said_.directions == directions_.empty())
      find("scan.touches.directions is {}, but the touches have {}", said_.directions,
           directions_.empty() ? "none" : "some");
    else
      place_touches();
    check_left_out();
    check_around();
    check_balls();
    if (findings_.size() == before) check_cuts();
    if (findings_.size() == before) check_ways();
    return findings_.size() == before;
  }

  /// How far the motions that are left may take a point of the nominal mesh from where it was put.
  [[nodiscard]] Span way_of(std::uint32_t vertex, const Vec3& put) const {
    Vec3 at;
    for (std::size_t axis = 0; axis < 3; ++axis) at[axis] = nominal_.enclosed(vertex, axis);
    Vec3 way{};
    for (std::size_t corner = 0; corner < 8; ++corner) {
      Span share = just(1);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Span low = around_[0][axis].near, size = around_[1][axis].near - low;
        const Span part = (at[axis] - low) / size;
        share = share * ((corner >> axis & 1) != 0 ? part : just(1) - part);
      }
      for (std::size_t axis = 0; axis < 3; ++axis) way[axis] = way[axis] + share * farthest_[corner][axis];
    }
    return length(way) + length(moved_(at) - put);
  }

 private:
  template <class... Args>
  void find(fmt::format_string<Args...> format, Args&&... args) {
    findings_.push_back(fmt::format(format, std::forward<Args>(args)...));
  }

  void check_left_out() {
    for (const std::size_t number : scan_.left_out) {
      if (number >= is_out_.size())
        find("scan.left_out names touch {} of {}", number, is_out_.size());
      else
        is_out_[number] = 1;
    }
  }

  /// The nominal mesh lies in the box whose corners the ways are of.
  void check_around() {
    for (std::size_t end = 0; end < 2; ++end) around_[end] = point(said_.around[end]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Fraction &low = around_[0][axis].exact, &high = around_[1][axis].exact;
      bool within = low < high;
      for (std::uint32_t v = 0; v < nominal_.near.size() && within; ++v) {
        const Fraction at = nominal_.exact(v, axis);
        within = low <= at && at <= high;
      }
      if (!within) find("scan.touches.around does not hold the nominal mesh along {}", kAxes[axis]);
    }
  }

  /// The places that stand for the touches: with directions those where the ball met the blank, to within a
  /// part of the ball by which other balls then have to stay nearer.
  void place_touches() {
    constexpr unsigned long kPlaces = 128, kRoom = 120;
    const Fraction off = to_fraction(said_.form) + to_fraction(scan_.guard),
                   ball = to_fraction(said_.ball) / 2;
    for (std::uint32_t k = 0; k < points_.near.size(); ++k) {
      ask();
      Ball& touch = touches_.emplace_back();
      touch.radius = as_both(off);
      Exact3 at{points_.exact(k, 0), points_.exact(k, 1), points_.exact(k, 2)};
      if (said_.directions) {
        Exact3 n;
        for (std::size_t axis = 0; axis < 3; ++axis) n[axis] = to_fraction(directions_[k][axis]);
        const Fraction squared = dot(n, n);
        if (sgn(squared) == 0) return find("the direction of touch {} is 0", k);
        // The root of p / q is that of p q, over q.
        const Integer root = whole_root((squared.get_num() * squared.get_den()) << (2 * kPlaces));
        Fraction inverse(squared.get_den() << kPlaces, root);
        inverse.canonicalize();
        at = at - n * Fraction(ball * inverse);
        touch.radius = as_both(off - ball / Fraction(Integer(1) << kRoom));
      }
      for (std::size_t axis = 0; axis < 3; ++axis) touch.centre[axis] = as_both(at[axis]);
    }
  }

  void check_balls() {
    const PlacedSolid body(nominal_);
    const Fraction ball = said_.directions ? Fraction(0) : Fraction(to_fraction(said_.ball) / 2),
                   off = to_fraction(said_.form) + to_fraction(scan_.guard);
    if (sgn(ball) > 0 && ball <= to_fraction(scan_.guard))
      find("scan.touches.ball is not larger than twice what touches are uncertain by");
    for (std::size_t k = 0; k < said_.balls.size(); ++k) {
      ask();
      const auto& [x, y, z, r] = said_.balls[k];
      Ball one{point({x, y, z}), both(r)};
      if (const auto fault = nearer(body, one))
        find("scan.touches.balls[{}] is not what it has to be: {}", k, *fault);
      // Its centre and a touch stay farther apart than this and `off` together.
      Fraction least = one.radius.exact - 2 * off;
      if (!body.holds(as<Span>(one.centre), as<Fraction>(one.centre)))
        least -= ball;
      else if (ball > 2 * off)
        least += ball;
      one.radius = as_both(std::move(least));
      balls_.push_back(std::move(one));
    }
  }

  /// Returns the terms of a row; none where it has no multiplier above 0, or names what is not there.
  std::vector<LeafTerm> terms_of(const WrittenTouches::Cut& cut, const std::string& name) {
    std::vector<LeafTerm> terms;
    for (const auto& [touch, ball, multiplier] : cut.terms) {
      if (touch >= touches_.size() || ball >= balls_.size() || is_out_[touch] != 0) {
        find("{} has a term of touch {} and ball {}, which are not there, or left out", name, touch, ball);
        return {};
      }
      if (sgn(multiplier.digits) == 0) continue;
      LeafTerm& term = terms.emplace_back();
      term.part_ball = &balls_[ball], term.blank_ball = &touches_[touch];
      term.multiplier = both(multiplier);
    }
    return terms;
  }

  void check_cuts() {
    for (std::size_t k = 0; k < 6; ++k) {
      box_.low[k] = both(said_.box[k][0]), box_.high[k] = both(said_.box[k][1]);
      if (box_.high[k].exact < box_.low[k].exact)
        return find("scan.touches.{} is not in ascending order", kAxes[k]);
    }
    for (std::size_t k = 0; k < said_.cuts.size(); ++k) {
      ask();
      const WrittenTouches::Cut& cut = said_.cuts[k];
      const std::string name = fmt::format("scan.touches.cuts[{}]", k);
      const Both at = both(cut.at);
      if (at.exact < box_.low[cut.axis].exact || box_.high[cut.axis].exact < at.exact)
        return find("{} cuts {} outside of the box that is left", name, kAxes[cut.axis]);
      PoseBox off = box_;
      (cut.above ? off.low : off.high)[cut.axis] = at;
      const std::vector<LeafTerm> terms = terms_of(cut, name);
      if (terms.empty() || !proves(terms, off, frame_))
        return find("{}: its terms do not prove that no motion is {} {} {}", name,
                    cut.above ? "above" : "below", kAxes[cut.axis], nearest(at.exact));
      (cut.above ? box_.high : box_.low)[cut.axis] = at;
    }
  }

  void check_ways() {
    std::array<std::array<std::array<bool, 2>, 3>, 8> seen{};
    for (std::size_t k = 0; k < said_.ways.size(); ++k) {
      ask();
      const auto& [corner, multiplier, cut] = said_.ways[k];
      const std::string name = fmt::format("scan.touches.ways[{}]", k);
      Ball at;
      for (std::size_t axis = 0; axis < 3; ++axis) at.centre[axis] = around_[corner >> axis & 1][axis];
      const Fraction from = moved_(as<Fraction>(at.centre))[cut.axis], sign = cut.above ? 1 : -1;
      HalfSpace beyond;
      beyond.normal[cut.axis] = as_both(sign);
      beyond.level = as_both(sign * from + to_fraction(cut.at));
      std::vector<LeafTerm> terms = terms_of(cut, name);
      if (sgn(multiplier.digits) > 0) {
        LeafTerm& last = terms.emplace_back();
        last.kind = LeafTerm::Kind::plane;
        last.part_ball = &at, last.plane = &beyond, last.multiplier = both(multiplier);
      }
      if (sgn(cut.at.digits) < 0 || terms.empty() || !proves(terms, box_, frame_))
        return find("{}: its terms do not prove that corner {} goes no farther than {} mm along {}", name,
                    corner, approximate(cut.at), kAxes[cut.axis]);
      seen[corner][cut.axis][cut.above ? 1 : 0] = true;
      Span& most = farthest_[corner][cut.axis];
      const Span is = enclosed(cut.at);
      most = {std::max(most.low, is.low), std::max(most.high, is.high)};
    }
    for (std::size_t corner = 0; corner < 8; ++corner)
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (!seen[corner][axis][0] || !seen[corner][axis][1])
          return find("scan.touches.ways does not say how far corner {} goes along {}", corner, kAxes[axis]);
  }

  const SolidMesh &nominal_, &points_;
  const std::vector<std::array<Decimal, 3>>& directions_;
  const WrittenSolidScan& scan_;
  const WrittenTouches& said_;
  std::vector<std::string>& findings_;
  SolidMotion moved_;
  LeafFrame frame_;
  std::vector<char> is_out_;
  std::array<Both3, 2> around_;
  std::vector<Ball> balls_, touches_;
  PoseBox box_;
  std::array<Vec3, 8> farthest_{};
};

}  // namespace

std::optional<ScanWidths> touch_widths(const SolidMesh& nominal, const SolidMesh& blank,
                                       const SolidReading& touches, const WrittenSolidScan& scan,
                                       std::vector<std::string>& findings) {
  if (nominal.triangles.size() != blank.triangles.size()) {
    findings.push_back(fmt::format("the blank has {} triangles, and the nominal mesh {}",
                                   blank.triangles.size(), nominal.triangles.size()));
    return std::nullopt;
  }
  TouchCheck check(nominal, touches, scan, findings);
  if (!check.run()) return std::nullopt;
  constexpr std::uint32_t kNowhere = 0xffffffff;
  std::vector<std::uint32_t> place(nominal.near.size(), kNowhere);
  std::vector<Span> way(nominal.near.size());
  const Span form = enclosed(scan.touches->form);
  ScanWidths made;
  made.widest = made.unknown_area = just(0);
  for (std::size_t t = 0; t < nominal.triangles.size(); ++t) {
    Span width = just(0);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = nominal.triangles[t][k], put = blank.triangles[t][k];
      if (place[v] == kNowhere) {
        ask();
        place[v] = put;
        way[v] = check.way_of(v, {blank.enclosed(put, 0), blank.enclosed(put, 1), blank.enclosed(put, 2)});
      }
      if (place[v] != put) {
        findings.push_back(
            fmt::format("triangle {} of the blank does not hang together as that of the nominal "
                        "mesh does",
                        blank.numbers[t]));
        return std::nullopt;
      }
      width = {std::max(width.low, way[v].low), std::max(width.high, way[v].high)};
    }
    width = form + width;
    made.of.push_back(width);
    made.widest = {std::max(made.widest.low, width.low), std::max(made.widest.high, width.high)};
  }
  return made;
}

}  // namespace lekalo::verify
