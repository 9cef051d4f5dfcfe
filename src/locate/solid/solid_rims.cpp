#include "solid_rims.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "lekalo/base/stop.hpp"

namespace lekalo::locate {
namespace {

using solid::Corners;
using solid::Vector;

/// Triangles are cut at this part of a rim, and what comes no nearer than so much less of it is kept.
constexpr double kCutAt = 1 - 0x1p-10, kKeptFrom = 1 - 0x1p-11;
/// A corner has to lie in a rim by more than this part of it to be cut off.
constexpr double kInRim = 1 - 0x1p-12;
/// A piece is halved if it is so many times longer than the triangle that it is cut by, and the rim, are
/// wide; and after so many cuts it is kept.
constexpr double kLong = 4;
/// So is one whose middle lies so many times deeper in a rim than its corners.
constexpr double kDeepBetween = 2;
constexpr int kMostCuts = 48;
/// Cuts move points by less than this part of the coordinates.
constexpr double kRounding = 0x1p-43;

double longest_side(const Corners& t) {
  return std::max({norm(t[1] - t[0]), norm(t[2] - t[1]), norm(t[0] - t[2])});
}

/// The farthest point from a on the way to b that is no farther from a triangle than `within`.
Vector last_within(const Corners& of, Vector a, Vector b, double within) {
  if (solid::distance(of, b) <= within) return b;
  double low = 0, high = 1;
  for (int step = 0; step < 50; ++step) {
    const double middle = 0.5 * (low + high);
    (solid::distance(of, a + middle * (b - a)) <= within ? low : high) = middle;
  }
  return a + low * (b - a);
}

}  // namespace

bool CutPart::Rim::is_apart(const Corners& t, double least) const {
  const solid::Mesh piece{{t[0], t[1], t[2]}, {{0, 1, 2}}};
  return !solid::MeshClearance(piece, face).nearest(solid::Motion{}, least);
}

/// Cuts pieces of one triangle by the triangles of one face.
class CutPart::Cutter {
 public:
  Cutter(const Rim& rim, std::vector<Corners>& kept, std::vector<Corners>& left_out)
      : of_(rim), face_(rim.triangles), rim_(kCutAt * rim.width), kept_(kept), left_out_(left_out) {}

  void cut(const Corners& piece, const std::vector<std::uint32_t>& candidates, int depth = 0) {
    ask();
    if (piece[0] == piece[1] || piece[1] == piece[2] || piece[2] == piece[0]) return;
    const Vector middle = 1.0 / 3 * (piece[0] + piece[1] + piece[2]);
    double reach = 0;
    for (const Vector p : piece) reach = std::max(reach, norm(p - middle));
    std::vector<std::uint32_t> near;
    double of_middle = rim_, of_corners = rim_;
    for (const std::uint32_t g : candidates) {
      const double far = solid::distance(face_[g], middle);
      of_middle = std::min(of_middle, far);
      if (far <= rim_ + reach) near.push_back(g);
    }
    /// The triangle that has most of the corners in its rim, and which ones.
    std::uint32_t best = 0;
    std::array<bool, 3> inside{};
    int most = 0;
    for (const std::uint32_t g : near) {
      std::array<bool, 3> in{};
      int count = 0, within = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double far = solid::distance(face_[g], piece[k]);
        of_corners = std::min(of_corners, far);
        within += far <= rim_ ? 1 : 0;
        in[k] = far < kInRim * rim_, count += in[k] ? 1 : 0;
      }
      if (within == 3) return left_out_.push_back(piece);
      if (count > most) most = count, best = g, inside = in;
    }
    if (near.empty() || depth == kMostCuts || (most == 0 && of_.is_apart(piece, kKeptFrom * rim_)))
      return kept_.push_back(piece);
    // A piece may lie deep in the rims of two triangles, between corners that are hardly in either: what is
    // cut off at a corner is next to nothing then.
    const bool deep_between = rim_ - of_middle > kDeepBetween * (rim_ - of_corners);
    if (most == 0 || deep_between || longest_side(piece) > kLong * (rim_ + longest_side(face_[best])))
      return halve(piece, near, depth);
    cut_off(piece, inside, face_[best], near, depth);
  }

 private:
  void halve(const Corners& piece, const std::vector<std::uint32_t>& near, int depth) {
    std::size_t longest = 0;
    double length = -1;
    for (std::size_t k = 0; k < 3; ++k)
      if (const double one = norm(piece[(k + 1) % 3] - piece[k]); one > length) length = one, longest = k;
    const Vector a = piece[longest], b = piece[(longest + 1) % 3], c = piece[(longest + 2) % 3],
                 m = 0.5 * (a + b);
    cut({a, m, c}, near, depth + 1);
    cut({m, b, c}, near, depth + 1);
  }

  /// The points near one triangle are convex, so all between two of them is near it, too.
  void cut_off(const Corners& piece, const std::array<bool, 3>& inside, const Corners& of,
               const std::vector<std::uint32_t>& near, int depth) {
    const bool two = inside[0] + inside[1] + inside[2] == 2;
    // The corner that is not as the two others comes first.
    std::size_t k = 0;
    while (inside[k] == two) ++k;
    const Vector a = piece[k], b = piece[(k + 1) % 3], c = piece[(k + 2) % 3];
    const Vector ab = two ? last_within(of, b, a, rim_) : last_within(of, a, b, rim_),
                 ac = two ? last_within(of, c, a, rim_) : last_within(of, a, c, rim_);
    const Corners tip{a, ab, ac}, first{ab, b, c}, second{ab, c, ac};
    if (two) {
      left_out_.push_back(first);
      left_out_.push_back(second);
      cut(tip, near, depth + 1);
    } else {
      left_out_.push_back(tip);
      cut(first, near, depth + 1);
      cut(second, near, depth + 1);
    }
  }

  const Rim& of_;
  const std::vector<Corners>& face_;
  double rim_;
  std::vector<Corners>&kept_, &left_out_;
};

bool CutPart::is_clear(Vector point) const {
  return std::all_of(rims_.begin(), rims_.end(), [&](const Rim& rim) {
    const double least = rim.width * (1 + 0x1p-40) + error_;
    const auto near = rim.face.blank().nearest(point, 2 * least);
    return !near || near->low >= least;
  });
}

void CutPart::cut(std::uint32_t triangle, const Corners& corners, std::vector<Corners>& kept,
                  std::vector<Corners>& left_out) const {
  kept = {corners};
  for (std::size_t k = 0; k < rims_.size(); ++k) {
    const Rim& rim = rims_[k];
    if (nears_[k].rim == 0 ||
        std::binary_search(nears_[k].triangles.begin(), nears_[k].triangles.end(), triangle))
      continue;
    std::vector<std::uint32_t> all;
    for (std::uint32_t g = 0; g < rim.triangles.size(); ++g) all.push_back(g);
    std::vector<Corners> rest;
    Cutter cutter(rim, rest, left_out);
    for (const Corners& piece : kept) cutter.cut(piece, all);
    kept = std::move(rest);
  }
}

std::optional<CutPart> CutPart::of(const SolidProblem& problem) {
  if (std::none_of(problem.nears.begin(), problem.nears.end(),
                   [](const SolidNear& one) { return one.rim > 0; }) ||
      problem.demands.empty())
    return std::nullopt;
  CutPart made;
  made.part_ = &problem.part;
  made.nears_ = problem.nears;
  const auto corners_of = [&](std::uint32_t t) {
    const auto& [a, b, c] = problem.part.triangles[t];
    const auto& v = problem.part.vertices;
    return Corners{v[a], v[b], v[c]};
  };
  double size = 0;
  for (const Vector p : problem.part.vertices) size = std::max(size, norm(p));
  made.error_ = kRounding * size;
  for (SolidNear& near : made.nears_) {
    std::sort(near.triangles.begin(), near.triangles.end());
    solid::Mesh face{problem.part.vertices, {}};
    std::vector<Corners> triangles;
    for (const std::uint32_t t : near.triangles) {
      face.triangles.push_back(problem.part.triangles[t]);
      triangles.push_back(corners_of(t));
    }
    made.rims_.push_back({solid::MeshClearance(face, face), std::move(triangles), near.rim});
  }
  made.mesh_.vertices = problem.part.vertices;
  std::map<std::tuple<double, double, double>, std::uint32_t> known;
  const auto vertex_at = [&](Vector p) {
    const auto [at, added] =
        known.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(made.mesh_.vertices.size()));
    if (added) made.mesh_.vertices.push_back(p);
    return at->second;
  };
  for (std::uint32_t v = 0; v < problem.part.vertices.size(); ++v) {
    const Vector p = problem.part.vertices[v];
    known.try_emplace({p.x, p.y, p.z}, v);
  }
  const auto add = [&](const solid::Triangle& t, std::uint32_t number, bool demands, bool clear) {
    made.mesh_.triangles.push_back(t);
    made.numbers_.push_back(number);
    made.demands_.push_back(demands ? problem.demands[number] : std::nullopt);
    made.clear_.push_back(clear);
  };
  bool any = false;
  std::vector<Corners> kept, left_out;
  for (std::uint32_t t = 0; t < problem.part.triangles.size(); ++t) {
    const Corners corners = corners_of(t);
    const Vector middle = 1.0 / 3 * (corners[0] + corners[1] + corners[2]);
    double reach = 0;
    for (const Vector p : corners) reach = std::max(reach, norm(p - middle));
    const bool near =
        problem.demands[t] && std::any_of(made.rims_.begin(), made.rims_.end(), [&](const Rim& rim) {
          return rim.width > 0 && rim.face.blank().nearest(middle, rim.width * (1 + 0x1p-20) + reach);
        });
    if (!near) {
      add(problem.part.triangles[t], t, true, true);
      continue;
    }
    any = true;
    left_out.clear();
    made.cut(t, corners, kept, left_out);
    if (kept.size() == 1 && left_out.empty()) {
      // It is not cut, but may come near.
      const bool clear = std::all_of(made.rims_.begin(), made.rims_.end(), [&](const Rim& rim) {
        return rim.width == 0 || rim.is_apart(corners, rim.width * (1 + 0x1p-40) + made.error_);
      });
      add(problem.part.triangles[t], t, true, clear);
      continue;
    }
    for (const auto* pieces : {&kept, &left_out})
      for (const Corners& piece : *pieces) {
        const solid::Triangle at{vertex_at(piece[0]), vertex_at(piece[1]), vertex_at(piece[2])};
        if (at[0] != at[1] && at[1] != at[2] && at[2] != at[0]) add(at, t, pieces == &kept, false);
      }
  }
  if (!any) return std::nullopt;
  for (std::size_t k = 0; k < made.nears_.size(); ++k) {
    const std::vector<std::uint32_t> of_part = std::move(made.nears_[k].triangles);
    made.nears_[k].triangles.clear();
    for (std::uint32_t piece = 0; piece < made.numbers_.size(); ++piece)
      if (std::binary_search(of_part.begin(), of_part.end(), made.numbers_[piece]))
        made.nears_[k].triangles.push_back(piece);
  }
  return made;
}

}  // namespace lekalo::locate
