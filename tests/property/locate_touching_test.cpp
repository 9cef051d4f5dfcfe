// Parts that touch their blank along edges, corners and arcs, with demands on some of their edges. No result
// is refused by the check before it is handed out, wherever the work ends.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/angle.hpp"
#include "lekalo/geom/pose.hpp"
#include "lekalo/jobs/locate.hpp"
#include "support/cases.hpp"
#include "support/json.hpp"

namespace lekalo::locate_touching_test {
namespace {

using cases::Json;
using geom::Point;

/// A line, or an arc about `centre` that runs counter-clockwise.
struct Stretch {
  Point from, to;
  std::optional<Point> centre = {};
};
using Outline = std::vector<Stretch>;

Outline polygon(const std::vector<Point>& corners) {
  Outline outline;
  for (std::size_t k = 0; k < corners.size(); ++k)
    outline.push_back({corners[k], corners[(k + 1) % corners.size()]});
  return outline;
}
Outline box(double x, double y) { return polygon({{0, 0}, {x, 0}, {x, y}, {0, y}}); }

/// An outline in the corner of the coordinates, as wide and as high as that.
Outline outline_of(std::size_t kind, double x, double y) {
  switch (kind) {
    case 0:
      return box(x, y);
    case 1:  // an angle
      return polygon({{0, 0}, {x, 0}, {x, y / 2}, {x / 4, y / 2}, {x / 4, y}, {0, y}});
    case 2:  // with a notch
      return polygon(
          {{0, 0}, {x, 0}, {x, y}, {x / 2, y}, {x / 2, y / 4}, {x / 4, y / 4}, {x / 4, y}, {0, y}});
    case 3:
      return polygon({{0, 0}, {x, 0}, {x / 4, y}});
    case 4:
      return polygon({{x / 8, 0}, {x, 0}, {x, y / 2}, {x / 2, y}, {0, y}});
    case 5:  // a tongue
      return {{{0, 0}, {x - y / 2, 0}},
              {{x - y / 2, 0}, {x - y / 2, y}, Point{x - y / 2, y / 2}},
              {{x - y / 2, y}, {0, y}},
              {{0, y}, {0, 0}}};
    default:  // a sector
      return {{{0, 0}, {y, 0}}, {{y, 0}, {0, y}, Point{0, 0}}, {{0, y}, {0, 0}}};
  }
}

/// Moves what lies beyond `from` outwards, so that what lies before it stays where it was.
Outline stretched(const Outline& outline, Point from, Point by) {
  const auto moved = [&](Point p) {
    return Point{p.x > from.x ? p.x + by.x : p.x, p.y > from.y ? p.y + by.y : p.y};
  };
  Outline out;
  for (const Stretch& s : outline) out.push_back({moved(s.from), moved(s.to)});
  return out;
}

Json json(const Outline& outline, const geom::BlankFromPart& pose) {
  const auto at = [&](Point p) {
    p = pose(p);
    return Json{p.x, p.y};
  };
  Json edges = Json::array();
  for (const Stretch& s : outline) {
    Json edge{{"from", at(s.from)}, {"to", at(s.to)}};
    if (s.centre) edge["centre"] = at(*s.centre), edge["ccw"] = !pose.mirrored;
    edges.push_back(s.centre ? Json{{"arc", edge}} : Json{{"line", edge}});
  }
  return edges;
}

struct Case {
  Json part, blank, features;
  jobs::LocateOptions options;
  std::uint64_t work = 0;
};

Case case_of(std::uint64_t index) {
  Random random(cases::seed(), 6000 + index);
  const auto one_in = [&](std::uint64_t n) { return random.below(n) == 0; };
  const auto round = [&](double from, double to) { return std::round(2 * random.uniform(from, to)) / 2; };
  const auto any = [&]() -> double {
    constexpr std::array kNumbers{0.5, 1.0, 1.0, 2.0, 5.0, 10.0, 1e-9, 1e-6, 1e-3, 0.1, 40.0, 1e3, 1e6};
    return one_in(3) ? random.uniform(0, 8) : kNumbers[random.below(kNumbers.size())];
  };
  const auto angle = [&] {
    return one_in(3) ? random.uniform(-kPi, kPi) : static_cast<double>(random.below(8)) * kPi / 4;
  };
  const auto shift = [&] {
    return one_in(2) ? Point{0, 0} : Point{round(-100, 100), random.uniform(-100, 100)};
  };
  Case c;
  const std::size_t kind = random.below(7);
  const double x = round(20, 100), y = round(10, 20);
  const Outline part = outline_of(kind, x, y);
  const auto more = [&] { return one_in(2) ? 0.0 : any(); };
  const bool own_form = kind < 5 && one_in(2);
  const Outline blank = own_form ? stretched(part, {round(0, x), round(0, y)}, {more(), more()})
                                 : box((kind == 6 ? y : x) + more(), y + more());
  const double part_turn = one_in(2) ? 0 : angle(), blank_turn = one_in(2) ? 0 : angle();
  const bool mirrored = one_in(4);
  const auto part_pose = geom::BlankFromPart::from_angle(part_turn, shift(), mirrored);
  const auto blank_pose = geom::BlankFromPart::from_angle(blank_turn, shift());
  c.part = {{"units", "mm"}, {"outer", json(part, part_pose)}};
  c.blank = {{"units", "mm"}, {"outer", json(blank, blank_pose)}};
  std::size_t edges = part.size();
  if (kind == 0 && one_in(2)) {
    const auto bore = [&](double r) {
      const Point rim{x / 2 + r, y / 2};
      return Outline{{rim, rim, Point{x / 2, y / 2}}};
    };
    const double r = random.uniform(1, y / 2 - 1);
    ++edges;
    c.part["holes"] = {json(bore(r), part_pose)};
    if (!own_form && one_in(2)) c.blank["holes"] = {json(bore(one_in(2) ? r : 0.5 * r), blank_pose)};
  }
  c.features = {{"units", "mm"}, {"features", Json::array()}};
  if (one_in(4)) c.features["minimum"] = any();
  for (std::size_t next = random.below(edges), k = 0; next < edges && k < 3; ++k) {
    Json numbers = Json::array();
    const std::size_t end = one_in(2) ? next + 1 : next + 1 + random.below(edges - next);
    for (; next < end; ++next) numbers.push_back(static_cast<int>(next));
    Json f{{"name", "f" + std::to_string(k)}, {"edges", numbers}};
    if (one_in(2)) {
      f["finished"] = any();
    } else {
      const double minimum = one_in(2) ? 0 : any();
      f["minimum"] = minimum;
      if (one_in(3)) f["maximum"] = minimum + any();
      if (one_in(4)) f["scale"] = any();
    }
    c.features["features"].push_back(f);
    next += random.below(2);
  }
  jobs::LocateOptions& o = c.options;
  if (!one_in(3)) {
    const double middle = std::remainder(blank_turn - (mirrored ? -part_turn : part_turn), 2 * kPi) / kDegree;
    const double width = one_in(2) ? 0 : 3;
    o.window_from_deg = middle - width, o.window_to_deg = middle + width;
  }
  if (mirrored) o.mirror = one_in(2) ? locate::Mirror::yes : locate::Mirror::either;
  if (one_in(3)) o.gap = std::pow(10, -static_cast<double>(random.below(7)));
  if (one_in(8)) o.locked.x = 0;
  if (one_in(8)) o.locked.y = 0;
  o.criterion = locate::criteria()[random.below(locate::criteria().size())];
  if (one_in(4)) o.give_up = any();
  if (one_in(8)) o.trade_off = 2 + random.below(2);
  constexpr std::array kWorks{1, 10, 50, 100, 300, 1000, 2000};
  c.work = kWorks[random.below(kWorks.size())];
  return c;
}

TEST(LocateTouching, NoResultIsRefusedByItsCheck) {
  std::size_t placed = 0;
  for (std::uint64_t i = 0; i < cases::case_count(30); ++i) {
    const Case c = case_of(i);
    jobs::LocateJob job{.part = {"part.json", c.part.dump()}, .blank = {"blank.json", c.blank.dump()}};
    job.features = jobs::File{"features.json", c.features.dump()};
    job.options = c.options;
    RunControl run;
    run.work_limit = c.work;
    const auto made = jobs::locate(job, run);
    placed += made ? 1 : 0;
    if (made || made.error().code != ErrorCode::refuted) continue;
    ADD_FAILURE() << "case " << i << ", seed " << cases::seed() << ", work " << c.work << ", window "
                  << c.options.window_from_deg << ' ' << c.options.window_to_deg << "\npart " << c.part.dump()
                  << "\nblank " << c.blank.dump() << "\nfeatures " << c.features.dump() << '\n'
                  << made.error().message;
  }
  EXPECT_GT(placed, 0U);
}

}  // namespace
}  // namespace lekalo::locate_touching_test
