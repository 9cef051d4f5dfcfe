#include "rims.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "lekalo/base/stop.hpp"
#include "triangle_distance.hpp"

namespace lekalo::verify {
namespace {

/// A piece is cut where more of it lies in the rim than this part of the width, and is kept where it comes no
/// nearer than so much of it.
constexpr double kWorthACut = 1 - 0x1p-12, kNearly = 1 - 0x1p-11;
/// A piece is halved before it is cut by a triangle that is so many times smaller, with its rim; and one that
/// was cut so often is kept.
constexpr double kMuchLonger = 4;
constexpr int kMostCuts = 48;
/// Corners of pieces are off by less than this part of the largest coordinate: each cut moves them by some
/// roundings.
constexpr double kOff = 0x1p-45;

Box3 box_of(const Triangle3& t) {
  Box3 box = verify::box_of(t[0]);
  box.hold(verify::box_of(t[1]));
  box.hold(verify::box_of(t[2]));
  return box;
}
Near3 between(const Near3& a, const Near3& b, double share) {
  return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])};
}
double apart(const Near3& a, const Near3& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }
double far(const Near3& p, const Triangle3& from) {
  const Vec3 at = just(p);
  return distance({at, at, at}, from).high;
}

}  // namespace

SolidMesh part_of(const SolidMesh& mesh, const std::vector<std::uint32_t>& triangles) {
  SolidMesh made;
  std::vector<std::uint32_t> becomes(mesh.near.size(), 0xffffffff);
  for (const std::uint32_t t : triangles) {
    std::array<std::uint32_t, 3> corners = mesh.triangles[t];
    for (std::uint32_t& v : corners) {
      if (becomes[v] == 0xffffffff) {
        becomes[v] = static_cast<std::uint32_t>(made.near.size());
        made.near.push_back(mesh.near[v]);
        if (!mesh.written.empty()) made.written.push_back(mesh.written[v]);
      }
      v = becomes[v];
    }
    made.triangles.push_back(corners);
    made.numbers.push_back(mesh.numbers[t]);
  }
  return made;
}

/// Takes off a triangle what lies in one rim: the points near one triangle of the face are convex, so a piece
/// lies in the rim if its corners are near the same one.
class Rims::Cut {
 public:
  using Piece = std::array<Near3, 3>;
  Cut(const Rim& rim, double off, std::vector<Piece>& rest) : rim_(rim), off_(off), rest_(rest) {}

  void take_off(const Piece& piece, int cuts = 0) {
    ask();
    if (piece[0] == piece[1] || piece[1] == piece[2] || piece[2] == piece[0]) return;
    const Triangle3 at{just(piece[0]), just(piece[1]), just(piece[2])};
    const BoxTree one({box_of(at)});
    const double width = rim_.width;
    double limit = width;
    double nearest = kInfinity, deepest = kInfinity;  // of the piece, and of its corners
    bool in_rim = false;
    int most = 0;
    std::uint32_t by = 0;
    one.visit_pairs(rim_.placed.tree(), limit, [&](std::uint32_t, std::uint32_t g) {
      const Triangle3 face = rim_.placed.triangle(g);
      nearest = std::min(nearest, distance(at, face, width).low);
      int all = 0, well = 0;
      for (const Near3& corner : piece) {
        const double from = far(corner, face) + off_;
        deepest = std::min(deepest, from);
        all += from < width ? 1 : 0, well += from < kWorthACut * width ? 1 : 0;
      }
      if (well > most) most = well, by = g;
      in_rim = all == 3;
      if (in_rim) limit = -kInfinity;
    });
    if (in_rim) return;
    if (nearest >= kNearly * width || cuts == kMostCuts) return rest_.push_back(piece);
    const auto longest = [](const Piece& t) {
      return std::max({apart(t[0], t[1]), apart(t[1], t[2]), apart(t[2], t[0])});
    };
    const Triangle3 face = rim_.placed.triangle(by);
    const auto low = [](const Vec3& p) { return Near3{p[0].low, p[1].low, p[2].low}; };
    // A cut begins at a corner: it takes off little of a piece that lies deeper in the rim between two of
    // them.
    if (2 * (width - deepest) < width - nearest ||
        longest(piece) > kMuchLonger * (width + longest({low(face[0]), low(face[1]), low(face[2])})))
      return halve(piece, cuts);
    cut(piece, face, cuts);
  }

 private:
  void halve(const Piece& piece, int cuts) {
    std::size_t k = 0;
    for (std::size_t side = 1; side < 3; ++side)
      if (apart(piece[side], piece[(side + 1) % 3]) > apart(piece[k], piece[(k + 1) % 3])) k = side;
    const Near3 &a = piece[k], &b = piece[(k + 1) % 3], &c = piece[(k + 2) % 3], m = between(a, b, 0.5);
    take_off({a, m, c}, cuts + 1);
    take_off({m, b, c}, cuts + 1);
  }

  void cut(const Piece& piece, const Triangle3& face, int cuts) {
    std::array<bool, 3> in{};
    for (std::size_t k = 0; k < 3; ++k) in[k] = far(piece[k], face) + off_ < kWorthACut * rim_.width;
    /// The last place in the rim on the way from one corner to another that is not in it.
    const auto last = [&](const Near3& from, const Near3& to) {
      if (far(to, face) + off_ < rim_.width) return to;
      double inside = 0, outside = 1;
      for (int step = 0; step < 50; ++step) {
        const double middle = 0.5 * (inside + outside);
        (far(between(from, to, middle), face) + off_ < rim_.width ? inside : outside) = middle;
      }
      return between(from, to, inside);
    };
    const bool two_are_in = in[0] + in[1] + in[2] == 2;
    std::size_t k = 0;
    while (in[k] == two_are_in) ++k;
    const Near3 &a = piece[k], &b = piece[(k + 1) % 3], &c = piece[(k + 2) % 3];
    if (two_are_in) return take_off({a, last(b, a), last(c, a)}, cuts + 1);
    const Near3 p = last(a, b), q = last(a, c);
    take_off({p, b, c}, cuts + 1);
    take_off({p, c, q}, cuts + 1);
  }

  const Rim& rim_;
  double off_;
  std::vector<Piece>& rest_;
};

void Rims::add(const std::vector<std::uint32_t>& triangles, double width) {
  rims_.push_back(std::make_unique<const Rim>(part_of(part_, triangles), width));
}

double Rims::off() const {
  double most = 0;
  for (const auto& p : part_.near) most = std::max({most, std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
  return kOff * most;
}

bool Rims::spare(std::uint32_t triangle) const {
  Triangle3 at{};
  ExactTriangle exact;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      at[k][axis] = part_.enclosed(part_.triangles[triangle][k], axis);
      exact[k][axis] = part_.exact(part_.triangles[triangle][k], axis);
    }
  const BoxTree one({box_of(at)});
  return std::ranges::all_of(rims_, [&](const auto& rim) {
    bool apart = true;
    double limit = rim->width;
    one.visit_pairs(rim->placed.tree(), limit, [&](std::uint32_t, std::uint32_t g) {
      if (distance(at, rim->placed.triangle(g), rim->width).low >= rim->width) return;
      const Fraction width(rim->width);
      apart = exact_distance(exact, rim->placed.exact_triangle(g)).squared >= width * width;
      if (!apart) limit = -kInfinity;
    });
    return apart;
  });
}

bool Rims::spare(const Exact3& point) const {
  const Vec3 at = verify::enclosed(point);
  const BoxTree one({verify::box_of(at)});
  return std::ranges::all_of(rims_, [&](const auto& rim) {
    bool apart = true;
    double limit = rim->width;
    one.visit_pairs(rim->placed.tree(), limit, [&](std::uint32_t, std::uint32_t g) {
      if (distance({at, at, at}, rim->placed.triangle(g), rim->width).low >= rim->width) return;
      const Fraction width(rim->width);
      apart = exact_squared_distance(point, rim->placed.exact_triangle(g)) >= width * width;
      if (!apart) limit = -kInfinity;
    });
    return apart;
  });
}

SolidMesh Rims::rest(const std::vector<std::uint32_t>& triangles) const {
  SolidMesh made;
  std::map<Near3, std::uint32_t> known;
  std::vector<Cut::Piece> pieces, rest;
  for (const std::uint32_t t : triangles) {
    pieces.clear();
    const auto& [a, b, c] = part_.triangles[t];
    pieces.push_back({part_.near[a], part_.near[b], part_.near[c]});
    for (const auto& rim : rims_) {
      rest.clear();
      Cut cut(*rim, off(), rest);
      for (const Cut::Piece& piece : pieces) cut.take_off(piece);
      std::swap(pieces, rest);
    }
    for (const Cut::Piece& piece : pieces) {
      std::array<std::uint32_t, 3> corners{};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [at, added] = known.try_emplace(piece[k], static_cast<std::uint32_t>(made.near.size()));
        if (added) made.near.push_back(piece[k]);
        corners[k] = at->second;
      }
      made.triangles.push_back(corners);
      made.numbers.push_back(part_.numbers[t]);
    }
  }
  return made;
}

}  // namespace lekalo::verify
