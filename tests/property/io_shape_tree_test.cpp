// The law of io/shape_tree.hpp: a point is in the result exactly when the Boolean of its being in the
// primitives says so. The primitives are judged from their definitions alone, in coordinates of their own.

#include "lekalo/io/shape/shape_tree.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "support/boolean_cases.hpp"
#include "support/cases.hpp"

namespace lekalo::io::io_shape_tree_test {
namespace {

using geom::Point;

/// Where a point lies in a shape, and how far it is from all edges drawn (at least).
struct Judged {
  bool inside = false;
  double distance = 0;
};
using Judge = std::function<Judged(Point)>;

struct Tree {
  std::string json;
  Judge judge;
  bool bounded = true;
};

double to_segment(Point p, Point a, Point b) {
  const Point d = b - a;
  const double t = std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0);
  return norm(p - (a + t * d));
}

class TreeMaker {
 public:
  explicit TreeMaker(Random& random) : random_(random) {}

  Tree tree(int depth) {
    if (depth == 0 || random_.below(4) == 0) return primitive();
    switch (random_.below(5)) {
      case 0:
        return boolean("union", depth, [](bool a, bool b) { return a || b; });
      case 1:
        return boolean("intersection", depth, [](bool a, bool b) { return a && b; });
      case 2:
      case 3:
        return boolean("difference", depth, [](bool a, bool b) { return a && !b; });
      default:
        return mapped(depth);
    }
  }

 private:
  /// On a coarse grid half of the time, so that edges coincide.
  double coordinate(double size) {
    return random_.below(2) == 0 ? std::floor(random_.uniform(-size, size)) : random_.uniform(-size, size);
  }
  double length() {
    return random_.below(2) == 0 ? 1 + static_cast<double>(random_.below(8)) : random_.uniform(0.5, 9);
  }

  Tree polygon_like(std::string json, std::vector<Point> corners) {
    const auto judge = [corners](Point p) {
      Judged j{false, 1e300};
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Point a = corners[i], b = corners[(i + 1) % corners.size()];
        j.distance = std::min(j.distance, to_segment(p, a, b));
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
          j.inside = !j.inside;
      }
      return j;
    };
    return {std::move(json), judge};
  }

  Tree primitive() {
    const Point c{coordinate(10), coordinate(10)};
    const double w = length(), h = length();
    switch (random_.below(7)) {
      case 0:
        return {fmt::format(R"({{"circle": {{"centre": [{}, {}], "radius": {}}}}})", c.x, c.y, w),
                [=](Point p) {
                  return Judged{norm(p - c) < w, std::abs(norm(p - c) - w)};
                }};
      case 1:
        return polygon_like(
            fmt::format(R"({{"rectangle": {{"corner": [{}, {}], "size": [{}, {}]}}}})", c.x, c.y, w, h),
            {c, {c.x + w, c.y}, {c.x + w, c.y + h}, {c.x, c.y + h}});
      case 2: {
        const double r = 0.5 * std::min(w, h) * (random_.below(3) == 0 ? 1 : random_.uniform(0.1, 0.9));
        return {
            fmt::format(R"({{"rounded_rectangle": {{"centre": [{}, {}], "size": [{}, {}], "radius": {}}}}})",
                        c.x, c.y, w, h, r),
            [=](Point p) {
              // Signed distance: that of the rectangle r smaller, less r.
              const double x = std::abs(p.x - c.x) - (0.5 * w - r), y = std::abs(p.y - c.y) - (0.5 * h - r);
              const double out = norm(Point{std::max(x, 0.0), std::max(y, 0.0)});
              const double d = (out > 0 ? out : std::max(x, y)) - r;
              return Judged{d < 0, std::abs(d)};
            }};
      }
      case 3: {
        const Point to = c + Point{length(), coordinate(5)};
        return {fmt::format(R"({{"slot": {{"from": [{}, {}], "to": [{}, {}], "width": {}}}}})", c.x, c.y,
                            to.x, to.y, w),
                [=](Point p) {
                  const double d = to_segment(p, c, to) - 0.5 * w;
                  return Judged{d < 0, std::abs(d)};
                }};
      }
      case 4: {
        const std::size_t sides = 3 + random_.below(6);
        const double angle = random_.below(2) == 0 ? 0 : random_.uniform(-400, 400);
        std::vector<Point> corners;
        for (std::size_t k = 0; k < sides; ++k) {
          const double turn = (angle / 360 + static_cast<double>(k) / static_cast<double>(sides)) * 2 *
                              3.14159265358979323846;
          corners.push_back(c + Point{w * std::cos(turn), w * std::sin(turn)});
        }
        return polygon_like(
            fmt::format(
                R"({{"regular_polygon": {{"sides": {}, "centre": [{}, {}], "radius": {}, "corner_deg": {}}}}})",
                sides, c.x, c.y, w, angle),
            corners);
      }
      case 5: {
        const std::vector<Point> corners{c, c + Point{w, 0.25 * h}, c + Point{0.5 * w, h},
                                         c + Point{0.4 * w, 0.4 * h}};
        std::string list;
        for (const Point p : corners) list += fmt::format("{}[{}, {}]", list.empty() ? "" : ", ", p.x, p.y);
        return polygon_like(fmt::format(R"({{"polygon": [{}]}})", list), corners);
      }
      default: {
        const Point to = c + Point{coordinate(5) + 0.5, coordinate(5)};
        Tree tree{
            fmt::format(R"({{"half_plane": {{"from": [{}, {}], "to": [{}, {}]}}}})", c.x, c.y, to.x, to.y),
            [=](Point p) {
              const double d = cross(to - c, p - c) / norm(to - c);
              return Judged{d > 0, std::abs(d)};
            },
            false};
        return tree;
      }
    }
  }

  Tree boolean(const char* word, int depth, bool (*fold)(bool, bool)) {
    std::vector<Judge> judges;
    std::string list;
    bool all = true, any = false, first = true;
    const std::size_t count = 2 + random_.below(3);
    for (std::size_t i = 0; i < count; ++i) {
      const Tree one = tree(depth - 1);
      if (i == 0) first = one.bounded;
      all = all && one.bounded;
      any = any || one.bounded;
      judges.push_back(one.judge);
      list += (i == 0 ? "" : ", ") + one.json;
    }
    const std::string name(word);
    const bool bounded = name == "union" ? all : name == "intersection" ? any : first;
    const auto judge = [judges, fold](Point p) {
      Judged j = judges[0](p);
      for (std::size_t i = 1; i < judges.size(); ++i) {
        const Judged next = judges[i](p);
        j = {fold(j.inside, next.inside), std::min(j.distance, next.distance)};
      }
      return j;
    };
    return {fmt::format(R"({{"{}": [{}]}})", word, list), judge, bounded};
  }

  Tree mapped(int depth) {
    const Tree child = tree(depth - 1);
    const Point c{coordinate(5), coordinate(5)};
    const Judge judge = child.judge;
    switch (random_.below(4)) {
      case 0:
        return {fmt::format(R"({{"move": {{"by": [{}, {}], "shape": {}}}}})", c.x, c.y, child.json),
                [=](Point p) { return judge(p - c); }, child.bounded};
      case 1: {
        const double degrees =
            random_.below(2) == 0 ? 30.0 * static_cast<double>(random_.below(12)) : random_.uniform(-90, 90);
        const double turn = -degrees / 180 * 3.14159265358979323846, cosine = std::cos(turn),
                     sine = std::sin(turn);
        return {fmt::format(R"({{"rotate": {{"by_deg": {}, "about": [{}, {}], "shape": {}}}}})", degrees, c.x,
                            c.y, child.json),
                [=](Point p) {
                  const Point q = p - c;
                  return judge(c + Point{cosine * q.x - sine * q.y, sine * q.x + cosine * q.y});
                },
                child.bounded};
      }
      case 2: {
        if (random_.below(2) == 0) {
          return {fmt::format(R"({{"mirror": {{"flip": "y", "shape": {}}}}})", child.json),
                  [=](Point p) {
                    return judge({p.x, -p.y});
                  },
                  child.bounded};
        }
        const Point to = c + Point{coordinate(5) + 0.5, coordinate(5)};
        return {fmt::format(R"({{"mirror": {{"from": [{}, {}], "to": [{}, {}], "shape": {}}}}})", c.x, c.y,
                            to.x, to.y, child.json),
                [=](Point p) {
                  const Point d = to - c, foot = c + (dot(p - c, d) / dot(d, d)) * d;
                  return judge(2 * foot - p);
                },
                child.bounded};
      }
      default: {
        const double factor = random_.uniform(0.5, 2);
        return {fmt::format(R"({{"scale": {{"by": {}, "about": [{}, {}], "shape": {}}}}})", factor, c.x, c.y,
                            child.json),
                [=](Point p) {
                  const Judged j = judge(c + (1 / factor) * (p - c));
                  return Judged{j.inside, j.distance * factor};
                },
                child.bounded};
      }
    }
  }

  Random& random_;
};

TEST(ShapeTreeLaws, MembershipIsTheBooleanOfThePrimitives) {
  const std::size_t count = cases::case_count(2000);
  std::size_t read = 0, empty = 0, points_inside = 0;
  for (std::size_t i = 0; i < count; ++i) {
    Random random(cases::seed(), 31000 + i);
    const Tree tree = TreeMaker(random).tree(1 + static_cast<int>(random.below(4)));
    SCOPED_TRACE(fmt::format("tree {} seed {}: {}", i, cases::seed(), tree.json));
    const auto file = parse_shape_tree(R"({"shape": )" + tree.json + "}", "tree");
    if (!tree.bounded) {
      // It may still be bounded or empty; what has no end is refused.
      if (!file) continue;
    }
    const bool nothing = !file && file.error().message.find("nothing is left") != std::string::npos;
    ASSERT_TRUE(file || nothing) << file.error().message;
    (nothing ? empty : read) += 1;
    const cases::Membership membership(file ? file->regions : std::vector<geom::Region>{});
    const double tolerance = file ? file->tolerance : 1e-8;
    ASSERT_LT(tolerance, 1e-3);
    Random points(cases::seed(), 77000 + i);
    for (int k = 0; k < 400; ++k) {
      const double size = k % 2 == 0 ? 12 : 60;
      const Point p{points.uniform(-size, size), points.uniform(-size, size)};
      const Judged judged = tree.judge(p);
      if (judged.distance <= tolerance + 1e-9) continue;
      points_inside += judged.inside ? 1 : 0;
      ASSERT_EQ(membership.contains(p), judged.inside)
          << fmt::format("({}, {}), {} from edges", p.x, p.y, judged.distance);
    }
  }
  EXPECT_GE(read, count / 2);
  EXPECT_GE(points_inside, 5 * count);
  RecordProperty("read", static_cast<int>(read));
  RecordProperty("empty", static_cast<int>(empty));
}

TEST(ShapeTreeLaws, TheSameBytesGiveTheSameRegions) {
  for (std::size_t i = 0; i < std::min<std::size_t>(cases::case_count(50), 1000); ++i) {
    Random random(cases::seed(), 31000 + i);
    const Tree tree = TreeMaker(random).tree(3);
    const auto a = parse_shape_tree(R"({"shape": )" + tree.json + "}", "tree");
    const auto b = parse_shape_tree(R"({"shape": )" + tree.json + "}", "tree");
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) continue;
    ASSERT_EQ(a->regions, b->regions);
  }
}

}  // namespace
}  // namespace lekalo::io::io_shape_tree_test
