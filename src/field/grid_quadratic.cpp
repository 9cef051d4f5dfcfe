#include "grid_quadratic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "grid_tiles.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/base/wide.hpp"

/// The quadratic conjunction over tiles. Every segment counts everywhere, but a subtree of the fold whose
/// segments are far is so smooth over a tile that a cubic polynomial stands for it. How far off that
/// may be follows from bounds carried up the tree, and how much of it the result sees from bounds on the
/// subtree's share; docs/design/field.md.
namespace lekalo::field {
namespace {

using geom::Point;

constexpr std::size_t kSmallQuadraticTile = 16;  // nodes along a tile
constexpr std::size_t kFewParts = 7;             // parts of a tree that needs no further division
constexpr std::size_t kQuadraticBlock = 128;
constexpr std::size_t kDeepest = 24;  // a balanced tree over a million segments, and some

// Polynomials may take this share of the stated errors, a part of it for each halving of tiles from kTop to
// kSmallQuadraticTile.
constexpr double kValueShare = 0.5 * kQuadraticGridError, kGradientShare = 0.5 * kQuadraticGridGradientError;
constexpr double kHalvings = 5;

/// d[0] is the value, d[1] and d[2] the gradient, from d[3] the second derivatives and from d[6] the third,
/// by falling power of x: of second order by x twice, by x and y, by y twice.
struct Jet3 {
  std::array<double, 10> d{};
  friend Jet3 operator+(Jet3 a, const Jet3& b) {
    for (std::size_t i = 0; i < a.d.size(); ++i) a.d[i] += b.d[i];
    return a;
  }
  friend Jet3 operator*(double s, Jet3 a) {
    for (double& x : a.d) x *= s;
    return a;
  }
};

/// sqrt(a^2 + b^2): with r that root, r r_i = a a_i + b b_i, and twice more.
Jet3 hypotenuse(const Jet3& a, const Jet3& b) {
  const auto &p = a.d, &q = b.d;
  Jet3 root;
  auto& r = root.d;
  r[0] = std::sqrt(p[0] * p[0] + q[0] * q[0]);
  const double by = 1 / r[0];
  for (std::size_t i = 1; i < 3; ++i) r[i] = by * (p[0] * p[i] + q[0] * q[i]);
  constexpr std::array<std::array<std::size_t, 2>, 3> kPairs{{{1, 1}, {1, 2}, {2, 2}}};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [i, j] = kPairs[k];
    r[3 + k] = by * (p[0] * p[3 + k] + q[0] * q[3 + k] + p[i] * p[j] + q[i] * q[j] - r[i] * r[j]);
  }
  // The third derivative by i, j and k has each first derivative with the second of the other two.
  constexpr std::array<std::array<std::array<std::size_t, 2>, 3>, 4> kTriples{{{{{1, 3}, {1, 3}, {1, 3}}},
                                                                               {{{1, 4}, {1, 4}, {2, 3}}},
                                                                               {{{1, 5}, {2, 4}, {2, 4}}},
                                                                               {{{2, 5}, {2, 5}, {2, 5}}}}};
  for (std::size_t k = 0; k < 4; ++k) {
    double sum = p[0] * p[6 + k] + q[0] * q[6 + k];
    for (const auto& [i, j] : kTriples[k]) sum += p[i] * p[j] + q[i] * q[j] - r[i] * r[j];
    r[6 + k] = by * sum;
  }
  return root;
}

/// The largest first, second and third derivatives along a line, in absolute value (of the third an upper
/// bound).
std::array<double, 3> largest(const Jet3& jet) {
  const auto& d = jet.d;
  return {std::sqrt(d[1] * d[1] + d[2] * d[2]),
          std::abs(d[3] + d[5]) / 2 + std::sqrt((d[3] - d[5]) * (d[3] - d[5]) / 4 + d[4] * d[4]),
          std::sqrt(d[6] * d[6] + 3 * d[7] * d[7] + 3 * d[8] * d[8] + d[9] * d[9])};
}

/// FLOZ and its derivatives at a place beyond the disc that has the segment as diameter.
Jet3 far_floz(const FlozSegment& s, Point at, FlozForm form) {
  const Point d = at - s.middle, n = perpendicular(s.along);
  const double by = 1 / s.length, f = dot(n, d);
  const Jet3 line{{f, n.x, n.y}};
  const Jet3 u{{f * f * by, 2 * by * f * n.x, 2 * by * f * n.y, 2 * by * n.x * n.x, 2 * by * n.x * n.y,
                2 * by * n.y * n.y}};
  const Jet3 t{{dot(d, d) * by - s.length / 4, 2 * by * d.x, 2 * by * d.y, 2 * by, 0, 2 * by}};
  const Jet3 over = hypotenuse(t, u) + t;
  return form == FlozForm::algebraic ? u + over : hypotenuse(line, 0.5 * over);
}

/// A cubic polynomial.
struct Model {
  Point centre;
  Jet3 jet;
  [[nodiscard]] Jet3 at(Point p) const {
    const double x = p.x - centre.x, y = p.y - centre.y;
    const auto& d = jet.d;
    Jet3 moved = jet;
    auto& m = moved.d;
    m[3] = d[3] + d[6] * x + d[7] * y, m[4] = d[4] + d[7] * x + d[8] * y, m[5] = d[5] + d[8] * x + d[9] * y;
    const auto half = [&](std::size_t i) { return 0.5 * (d[i] + m[i]); };
    m[1] = d[1] + half(3) * x + half(4) * y, m[2] = d[2] + half(4) * x + half(5) * y;
    const auto third = [&](std::size_t i) { return (2 * d[i] + m[i]) / 6; };
    m[0] = d[0] + d[1] * x + d[2] * y + third(3) * x * x + 2 * third(4) * x * y + third(5) * y * y;
    return moved;
  }
};

/// The fold as a list: a conjunction comes after its two operands, the left one first.
struct Part {
  enum Kind : std::uint8_t { segment, model, conjunction } kind;
  std::uint32_t number = 0;  ///< of a segment or a model
  std::uint32_t size = 1;    ///< parts of this subtree
};
struct Tree {
  std::vector<Part> parts;
  std::vector<Model> models;
};

/// The knowledge about a subtree over a tile.
struct Bounds {
  double low = 0, high = 0;
  bool smooth = false;  ///< what follows is known
  Jet3 middle;          ///< at the tile's middle
  /// The first four derivatives along any line, relative to the value there, are at most these.
  std::array<double, 4> most{};
};

/// The most that the relative derivatives change along a line.
std::array<double, 3> changes(const Bounds& bounds) {
  std::array<double, 3> change{};
  for (std::size_t k = 0; k < 3; ++k) change[k] = bounds.most[k + 1] + bounds.most[k] * bounds.most[0];
  return change;
}

/// Lowers bounds to the derivatives at the middle and their change, where these are less.
void tighten(Bounds& bounds, double radius) {
  const auto middle = largest((1 / bounds.middle.d[0]) * bounds.middle);
  for (std::size_t k = 3; k-- > 0;)
    bounds.most[k] = std::min(bounds.most[k], middle[k] + radius * changes(bounds)[k]);
}

/// A number not below exp(x). \pre x >= 0
double growth(double x) { return x < 1 ? 1 / (1 - x) : std::numeric_limits<double>::infinity(); }

double conjunction_of(double a, double b) {
  const double sum = a + b + std::sqrt(a * a + b * b);
  return sum > 0 ? 2 * a * b / sum : 0;
}
/// The part of b in (a and b) by their ratio a / b, b (d value / d b) / value: 0 to 1, and growing.
double part_of_second(double ratio) {
  if (!(ratio < 1e100)) return 1;
  const double root = std::sqrt(1 + ratio * ratio);
  return ratio * (ratio + 1 + root) / (2 * root * (root + 1));
}

struct Shares {
  double first = 1, second = 1;  ///< at most
};
Shares shares_of(const Bounds& a, const Bounds& b, double radius, double& ratio_low, double& ratio_high) {
  ratio_low = b.high > 0 ? a.low / b.high : 0;
  ratio_high = b.low > 0 ? a.high / b.low : std::numeric_limits<double>::infinity();
  if (a.smooth && b.smooth) {
    const double middle = a.middle.d[0] / b.middle.d[0], wide = growth((a.most[0] + b.most[0]) * radius);
    ratio_low = std::max(ratio_low, middle / wide), ratio_high = std::min(ratio_high, middle * wide);
  }
  return {1 - part_of_second(ratio_low), part_of_second(ratio_high)};
}

/// With a_k the k-th derivative along a line over a, and D_k = |a_k - b_k|: derivatives of the conjunction q
/// are weighted means of the operands' and, times a factor a^2 b^2 / (r^3 q) that is at most `least` (r^2 =
/// a^2 + b^2),
///   second  D1^2
///   third   3 D1 D2 + 3 D1^2 max a_1
///   fourth  4 D1 D3 + 3 D2^2 + 30 D1^2 max a_2 + 12 D1 D2 max a_1 + 12 D1^2 (max a_1)^2
Bounds both_of(const Bounds& a, const Bounds& b, double radius) {
  Bounds both;
  both.low = conjunction_of(a.low, b.low), both.high = conjunction_of(a.high, b.high);
  both.smooth = a.smooth && b.smooth;
  if (!both.smooth) return both;
  both.middle = a.middle + b.middle + -1.0 * hypotenuse(a.middle, b.middle);
  both.middle.d[0] = conjunction_of(a.middle.d[0], b.middle.d[0]);
  double ratio_low = 0, ratio_high = 0;
  const Shares share = shares_of(a, b, radius, ratio_low, ratio_high);
  const double nearest = ratio_high < 1 ? ratio_high : ratio_low > 1 ? 1 / ratio_low : 1;
  const double least = std::min(kMixing, kMixingSlope * nearest);
  std::array<double, 4> larger{}, apart{};
  for (std::size_t k = 0; k < 4; ++k) {
    larger[k] = std::max(a.most[k], b.most[k]), apart[k] = a.most[k] + b.most[k];
    both.most[k] = std::min(larger[k], share.first * a.most[k] + share.second * b.most[k]);
  }
  // The operands' relative derivatives differ by no more than at the middle, and what they change by.
  const auto differ = largest((1 / a.middle.d[0]) * a.middle + (-1 / b.middle.d[0]) * b.middle);
  const auto of_a = changes(a), of_b = changes(b);
  for (std::size_t k = 0; k < 3; ++k) apart[k] = std::min(apart[k], differ[k] + radius * (of_a[k] + of_b[k]));
  const double one = apart[0], two = apart[1];
  both.most[1] += least * one * one;
  both.most[2] += 3 * least * one * (two + one * larger[0]);
  both.most[3] += least * (4 * one * apart[2] + 3 * two * two + 30 * one * one * larger[1] +
                           12 * one * two * larger[0] + 12 * one * one * larger[0] * larger[0]);
  tighten(both, radius);
  return both;
}

/// One part of a tree as nodes of a tile see it, in single precision.
struct Step {
  Part::Kind kind;
  bool beyond = false;  ///< of the segment's disc, everywhere in the tile
  float x = 0, y = 0, along_x = 0, along_y = 0, length = 1;  ///< of a segment
  std::array<float, 10> d{};                                 ///< of a model
};

struct Jets {
  std::array<float, kQuadraticBlock> value, dx, dy;
};

/// At (x, y) from the segment's middle: sqrt(f^2 + g^2), with g = over / 2.
inline void take_normalised(const Step& s, const Terms& at, float per_length, float x, float y, Jets& to,
                            std::size_t i) {
  const float g = 0.5F * at.over, value = std::sqrt(at.f * at.f + g * g) + kLeast;
  const float scale = g * per_length / (at.root * value), turn = scale * at.u * at.f + at.f / value;
  to.value[i] = value;
  to.dx[i] = scale * 2 * g * x - turn * s.along_y;
  to.dy[i] = scale * 2 * g * y + turn * s.along_x;
}

LEKALO_WIDE void take_near(const Step& s, const float* __restrict x, const float* __restrict y,
                           Jets& __restrict to, std::size_t n) {
  const float per_length = 1 / s.length;
  for (std::size_t i = 0; i < n; ++i) {
    const float dx = x[i] - s.x, dy = y[i] - s.y;
    take_normalised(s, terms(dx, dy, s.along_x, s.along_y, s.length, per_length), per_length, dx, dy, to, i);
  }
}

/// The same where t < 0.
LEKALO_WIDE void take_beyond(const Step& s, const float* __restrict x, const float* __restrict y,
                             Jets& __restrict to, std::size_t n) {
  const float per_length = 1 / s.length, quarter = 0.25F * s.length;
  for (std::size_t i = 0; i < n; ++i) {
    const float dx = x[i] - s.x, dy = y[i] - s.y;
    const float f = s.along_x * dy - s.along_y * dx, u = f * f * per_length;
    const float past = (dx * dx + dy * dy) * per_length - quarter;
    const float root = std::sqrt(u * u + past * past) + kLeast;
    take_normalised(s, {f, u, root + past, root}, per_length, dx, dy, to, i);
  }
}

LEKALO_WIDE void take_algebraic(const Step& s, const float* __restrict x, const float* __restrict y,
                                Jets& __restrict to, std::size_t n) {
  const float per_length = 1 / s.length;
  for (std::size_t i = 0; i < n; ++i) {
    const float dx = x[i] - s.x, dy = y[i] - s.y;
    const Terms at = terms(dx, dy, s.along_x, s.along_y, s.length, per_length);
    const float scale = 2 * per_length / at.root, turn = scale * at.u * at.f + 2 * at.f * per_length;
    to.value[i] = at.u + at.over;
    to.dx[i] = scale * at.over * dx - turn * s.along_y;
    to.dy[i] = scale * at.over * dy + turn * s.along_x;
  }
}

LEKALO_WIDE void take_model(const Step& s, const float* __restrict x, const float* __restrict y,
                            Jets& __restrict to, std::size_t n) {
  const std::array<float, 10> d = s.d;
  for (std::size_t i = 0; i < n; ++i) {
    // Half the change of the second derivatives.
    const float xx = 0.5F * (d[6] * x[i] + d[7] * y[i]), xy = 0.5F * (d[7] * x[i] + d[8] * y[i]),
                yy = 0.5F * (d[8] * x[i] + d[9] * y[i]);
    to.dx[i] = d[1] + (d[3] + xx) * x[i] + (d[4] + xy) * y[i];
    to.dy[i] = d[2] + (d[4] + xy) * x[i] + (d[5] + yy) * y[i];
    constexpr float kThird = 1.0F / 3;
    const float sx = (0.5F * d[3] + kThird * xx) * x[i] + (0.5F * d[4] + kThird * xy) * y[i];
    const float sy = (0.5F * d[4] + kThird * xy) * x[i] + (0.5F * d[5] + kThird * yy) * y[i];
    to.value[i] = d[0] + (d[1] + sx) * x[i] + (d[2] + sy) * y[i];
  }
}

/// Computes as conjunction() does, with the weights 1 - a / r as b^2 / (r (r + a)), and (r + a) (r + b) = (a
/// + b + r)^2 / 2.
LEKALO_WIDE void join(Jets& __restrict a, const Jets& __restrict b, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    const float p = a.value[i], q = b.value[i];
    const float root = std::sqrt(p * p + q * q) + kLeast, by = 1 / (p + q + root);
    const float scale = 2 * by * by / root;
    const float wa = scale * (q * q) * (root + q), wb = scale * (p * p) * (root + p);
    a.value[i] = 2 * p * q * by;
    a.dx[i] = wa * a.dx[i] + wb * b.dx[i];
    a.dy[i] = wa * a.dy[i] + wb * b.dy[i];
  }
}

class QuadraticSampler {
 public:
  QuadraticSampler(const ContourModel& model, FieldGrid& grid)
      : model_(model), grid_(grid), signs_(model, grid.frame) {
    add_all(0, model.segments().size());
  }

  void top_tile(const Tile& tile) const {
    Workspace space;
    divide(tile, all_, std::numeric_limits<double>::infinity(), 0, space);
  }

 private:
  struct Workspace {
    std::array<Tree, 8> kept;  ///< one a depth of division
    std::vector<Bounds> bounds;
    std::vector<Step> steps;
    std::array<float, kQuadraticBlock> x, y, sign;
    std::array<Jets, kDeepest> stack;
  };

  /// Halves the list as folded() does.
  void add_all(std::size_t begin, std::size_t end) {
    const std::size_t before = all_.parts.size();
    if (end - begin == 1) {
      all_.parts.push_back({Part::segment, static_cast<std::uint32_t>(begin)});
      return;
    }
    const std::size_t half = begin + (end - begin) / 2;
    add_all(begin, half);
    add_all(half, end);
    all_.parts.push_back({Part::conjunction, 0, static_cast<std::uint32_t>(all_.parts.size() - before + 1)});
  }

  [[nodiscard]] Bounds of_segment(const FlozSegment& s, Point middle, double radius) const {
    const FlozForm form = model_.options().form;
    const FlozBounds range = floz_bounds(s, middle, radius, form);
    Bounds bounds;
    bounds.low = range.low, bounds.high = range.high;
    const double off = norm(middle - s.middle) - radius;
    bounds.smooth = off > kFarLengths * s.length;
    if (!bounds.smooth) return bounds;
    bounds.middle = far_floz(s, middle, form);
    double power = 1;
    for (std::size_t k = 0; k < 4; ++k) power *= off, bounds.most[k] = kFarDerivatives[k] / power;
    tighten(bounds, radius);
    return bounds;
  }

  static Bounds of_model(const Model& model, Point middle, double radius) {
    Bounds bounds;
    bounds.middle = model.at(middle);
    const double value = bounds.middle.d[0];
    const auto slope = largest((1 / value) * bounds.middle);
    const double bend = slope[1] + radius * slope[2], steep = slope[0] + radius * bend;
    const double reach = value * radius * steep;
    bounds.low = std::max(0.0, value - reach), bounds.high = value + reach;
    bounds.smooth = bounds.low > 0;
    if (!bounds.smooth) return bounds;
    const double by = value / bounds.low;
    bounds.most = {by * steep, by * bend, by * slope[2], 0};
    return bounds;
  }

  /// Copies a subtree, with polynomials for what may be off by `budget` times the shares.
  void keep(const Tree& tree, std::size_t at, double budget, double distance, const Point& middle,
            double radius, const std::vector<Bounds>& all, Tree& kept) const {
    const Part& part = tree.parts[at];
    const Bounds& bounds = all[at];
    if (bounds.smooth && part.kind != Part::model) {
      const double range = std::min(bounds.high / bounds.low, growth(2 * bounds.most[0] * radius));
      const double gradient = bounds.most[3] * radius * radius * radius / 6 * range;
      const double value = gradient * radius / 4;
      if (kHalvings * value <= budget * kValueShare &&
          kHalvings * gradient * distance <= budget * kGradientShare) {
        kept.parts.push_back({Part::model, static_cast<std::uint32_t>(kept.models.size())});
        kept.models.push_back({middle, bounds.middle});
        return;
      }
    }
    if (part.kind != Part::conjunction) {
      kept.parts.push_back(part);
      if (part.kind == Part::model) {
        kept.parts.back().number = static_cast<std::uint32_t>(kept.models.size());
        kept.models.push_back(tree.models[part.number]);
      }
      return;
    }
    const std::size_t right = at - 1, left = right - tree.parts[right].size, before = kept.parts.size();
    double low = 0, high = 0;
    const Shares share = shares_of(all[left], all[right], radius, low, high);
    // The shares of both are 1, so that an error both have is the result's. One that counts little may be off
    // by more, for which the other gives up a little.
    constexpr double kLittle = 1.0 / 16;
    double of_left = budget, of_right = budget;
    if (share.second < kLittle)
      of_right *= kLittle / std::max(share.second, 1e-30), of_left *= 1 - kLittle;
    else if (share.first < kLittle)
      of_left *= kLittle / std::max(share.first, 1e-30), of_right *= 1 - kLittle;
    keep(tree, left, of_left, distance, middle, radius, all, kept);
    keep(tree, right, of_right, distance, middle, radius, all, kept);
    kept.parts.push_back({Part::conjunction, 0, static_cast<std::uint32_t>(kept.parts.size() - before + 1)});
  }

  /// \param distance  no node of the tile is farther from the nearest segment
  void divide(const Tile& tile, const Tree& tree, double distance, std::size_t depth,
              Workspace& space) const {
    const auto [middle, radius] = disc_of(tile, grid_.frame);
    std::vector<Bounds>& bounds = space.bounds;
    bounds.clear();
    for (std::size_t i = 0; i < tree.parts.size(); ++i) {
      const Part& part = tree.parts[i];
      if (part.kind == Part::segment) {
        const FlozSegment& s = model_.segments()[part.number];
        bounds.push_back(of_segment(s, middle, radius));
        distance = std::min(distance, norm(middle - s.middle) + radius + s.length / 2);
      } else if (part.kind == Part::model) {
        bounds.push_back(of_model(tree.models[part.number], middle, radius));
      } else {
        const std::size_t left = i - 1 - tree.parts[i - 1].size;
        bounds.push_back(both_of(bounds[left], bounds[i - 1], radius));
      }
    }
    Tree& kept = space.kept[depth];
    kept.parts.clear(), kept.models.clear();
    keep(tree, tree.parts.size() - 1, 1, distance, middle, radius, bounds, kept);
    if (kept.parts.size() <= kFewParts ||
        (tile.columns <= kSmallQuadraticTile && tile.rows <= kSmallQuadraticTile))
      return fill(tile, middle, kept, space);
    each_quarter(tile, [&](const Tile& part) { divide(part, kept, distance, depth + 1, space); });
  }

  /// The steps of a tree; the longest of its segments.
  double make_steps(const Tree& tree, Point middle, double radius, std::vector<Step>& steps) const {
    steps.clear();
    double longest = 0;
    for (const Part& part : tree.parts) {
      Step step{part.kind};
      if (part.kind == Part::segment) {
        const FlozSegment& s = model_.segments()[part.number];
        const Point at = s.middle - middle;
        step.beyond = norm(at) > 1.001 * (radius + 0.5 * s.length);
        step.x = static_cast<float>(at.x), step.y = static_cast<float>(at.y);
        step.along_x = static_cast<float>(s.along.x), step.along_y = static_cast<float>(s.along.y);
        step.length = static_cast<float>(s.length);
        longest = std::max(longest, s.length);
      } else if (part.kind == Part::model) {
        const Jet3 at = tree.models[part.number].at(middle);
        for (std::size_t k = 0; k < at.d.size(); ++k) step.d[k] = static_cast<float>(at.d[k]);
      }
      steps.push_back(step);
    }
    return longest;
  }

  void run(std::size_t n, Workspace& space) const {
    const bool normalised = model_.options().form == FlozForm::normalised;
    std::size_t top = 0;
    for (const Step& step : space.steps) {
      if (step.kind == Part::conjunction) {
        --top;
        join(space.stack[top - 1], space.stack[top], n);
        continue;
      }
      Jets& to = space.stack[top++];
      const auto take = step.kind == Part::model ? take_model
                        : !normalised            ? take_algebraic
                        : step.beyond            ? take_beyond
                                                 : take_near;
      take(step, space.x.data(), space.y.data(), to, n);
    }
  }

  void fill(const Tile& tile, Point middle, const Tree& tree, Workspace& space) const {
    const GridFrame& frame = grid_.frame;
    const double off = norm(frame.node(tile.column, tile.row) - middle);
    const double longest = make_steps(tree, middle, off, space.steps);
    // Nearer to a segment than this, single precision would not tell the side.
    const auto close = static_cast<float>(2e-3 * off + 1e-4 * std::min(longest, off));
    const Jets& result = space.stack[0];
    const std::size_t rows_at_once = std::max<std::size_t>(1, kQuadraticBlock / tile.columns);
    for (std::size_t j = 0; j < tile.rows; j += rows_at_once)
      for (std::size_t first = 0; first < tile.columns; first += kQuadraticBlock) {
        ask(16);
        const std::size_t columns = std::min(kQuadraticBlock, tile.columns - first),
                          column = tile.column + first;
        const std::size_t rows = std::min(rows_at_once, tile.rows - j);
        for (std::size_t r = 0; r < rows; ++r) {
          const std::size_t row = tile.row + j + r;
          const Point begin = frame.node(column, row) - middle;
          for (std::size_t i = 0; i < columns; ++i) {
            space.x[r * columns + i] = static_cast<float>(begin.x + frame.pitch * static_cast<double>(i));
            space.y[r * columns + i] = static_cast<float>(begin.y);
          }
          signs_.fill(frame, column, row, columns, &space.sign[r * columns]);
        }
        run(rows * columns, space);
        for (std::size_t n = 0; n < rows * columns; ++n) {
          const std::size_t row = tile.row + j + n / columns, i = column + n % columns;
          Jet jet{static_cast<double>(result.value[n]),
                  {static_cast<double>(result.dx[n]), static_cast<double>(result.dy[n])}};
          if (longest > 0 && result.value[n] < close) jet = model_.unsigned_at(frame.node(i, row));
          const std::size_t to = row * frame.columns + i;
          grid_.value[to] = space.sign[n] * static_cast<float>(jet.value);
          grid_.dx[to] = space.sign[n] * static_cast<float>(jet.gradient.x);
          grid_.dy[to] = space.sign[n] * static_cast<float>(jet.gradient.y);
        }
      }
  }

  const ContourModel& model_;
  FieldGrid& grid_;
  Signs signs_;
  Tree all_;
};

}  // namespace

void sample_quadratic(const ContourModel& model, unsigned threads, FieldGrid& grid) {
  const QuadraticSampler sampler(model, grid);
  each_top_tile(grid.frame, threads, [&](const Tile& tile) { sampler.top_tile(tile); });
}

}  // namespace lekalo::field
