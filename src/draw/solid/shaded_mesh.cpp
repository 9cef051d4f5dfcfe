#include "shaded_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>

#include "lekalo/base/stop.hpp"

namespace lekalo::draw {
namespace {

using solid::Mesh;
using solid::Triangle;
using solid::Vector;

constexpr double kSmooth = 0.86;  ///< the cosine between normals of triangles that look like one surface
constexpr double kFlat = 1 - 1e-9;
/// At the tip of a fan of more triangles the mean of all stands for the neighbours.
constexpr std::size_t kMostCompared = 64;

Vector unit(Vector v) {
  const double length = norm(v);
  return length > 0 ? 1 / length * v : Vector{0, 0, 1};
}

/// Normals of the triangles, as long as twice their area and of length 1. The edges are measured against the
/// size of the mesh, so that squares of large and of small coordinates stay within doubles.
struct FaceNormals {
  std::vector<Vector> weighted, unit_length;
  explicit FaceNormals(const std::vector<Vector>& places, const std::vector<Triangle>& triangles) {
    const solid::Box box = solid::box_of(places);
    const double size = norm(box.high - box.low), scale = size > 0 ? 1 / size : 0;
    for (const Triangle& t : triangles) {
      const Vector a = places[t[0]];
      weighted.push_back(cross(scale * (places[t[1]] - a), scale * (places[t[2]] - a)));
      unit_length.push_back(unit(weighted.back()));
    }
  }
};

class Shader {
 public:
  Shader(const Mesh& mesh, const solid::Motion& motion)
      : triangles_(mesh.triangles), places_(moved(mesh, motion)), normals_(places_, triangles_) {}

  ShadedMesh shade() && {
    split_vertices();
    find_edges();
    return std::move(made_);
  }

 private:
  struct Corner {
    std::uint32_t triangle = 0, place = 0;
  };

  static std::vector<Vector> moved(const Mesh& mesh, const solid::Motion& motion) {
    std::vector<Vector> places;
    places.reserve(mesh.vertices.size());
    for (const Vector p : mesh.vertices) places.push_back(motion(p));
    return places;
  }

  void split_vertices() {
    std::vector<std::uint32_t> begin(places_.size() + 1);
    for (const Triangle& t : triangles_)
      for (const std::uint32_t v : t) ++begin[v + 1];
    for (std::size_t v = 0; v < places_.size(); ++v) begin[v + 1] += begin[v];
    std::vector<Corner> corners(3 * triangles_.size());
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      for (std::uint32_t k = 0; k < 3; ++k) corners[next[triangles_[t][k]]++] = {t, k};
    made_.triangles = triangles_;
    for (std::uint32_t v = 0; v < places_.size(); ++v) {
      ask(1 + begin[v + 1] - begin[v]);
      split(v, corners.data() + begin[v], corners.data() + begin[v + 1]);
    }
  }

  void split(std::uint32_t vertex, const Corner* first, const Corner* last) {
    const auto made = static_cast<std::uint32_t>(made_.places.size());
    const bool fan = static_cast<std::size_t>(last - first) > kMostCompared;
    Vector mean;
    if (fan) {
      for (const Corner* c = first; c != last; ++c) mean = mean + normals_.weighted[c->triangle];
      mean = unit(mean);
    }
    for (const Corner* c = first; c != last; ++c) {
      const Vector own = normals_.unit_length[c->triangle];
      Vector normal;
      if (fan) {
        normal = dot(own, mean) >= kSmooth ? mean : own;
      } else {
        for (const Corner* other = first; other != last; ++other)
          if (dot(own, normals_.unit_length[other->triangle]) >= kSmooth)
            normal = normal + normals_.weighted[other->triangle];
        normal = unit(normal);
      }
      // A fan's own normals are looked for among the first few.
      std::uint32_t at = made;
      while (at < made_.places.size() && at < made + kMostCompared && !(made_.normals[at] == normal)) ++at;
      if (at == made + kMostCompared) at = static_cast<std::uint32_t>(made_.places.size());
      if (at == made_.places.size()) {
        made_.places.push_back(places_[vertex]);
        made_.normals.push_back(normal);
        made_.from.push_back(vertex);
      }
      made_.triangles[c->triangle][c->place] = at;
    }
  }

  void find_edges() {
    struct Side {
      std::uint32_t a, b, triangle, place;
    };
    std::vector<Side> sides;
    sides.reserve(3 * triangles_.size());
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t a = triangles_[t][k], b = triangles_[t][(k + 1) % 3];
        sides.push_back({std::min(a, b), std::max(a, b), t, k});
      }
    std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
      return std::tie(x.a, x.b, x.triangle) < std::tie(y.a, y.b, y.triangle);
    });
    for (std::size_t k = 0; k < sides.size();) {
      ask(4);
      std::size_t end = k + 1;
      while (end < sides.size() && sides[end].a == sides[k].a && sides[end].b == sides[k].b) ++end;
      const Side side = sides[k];
      const Vector left = normals_.unit_length[side.triangle],
                   right = normals_.unit_length[sides[end - 1].triangle];
      const bool pair = end - k == 2;
      if (!pair || dot(left, right) < kFlat) {
        const Triangle& t = made_.triangles[side.triangle];
        made_.edges.push_back(
            {t[side.place], t[(side.place + 1) % 3], left, right, !pair || dot(left, right) < kSmooth});
      }
      k = end;
    }
  }

  const std::vector<Triangle>& triangles_;
  std::vector<Vector> places_;
  FaceNormals normals_;
  ShadedMesh made_;
};

}  // namespace

ShadedMesh shaded(const Mesh& mesh, const solid::Motion& motion) { return Shader(mesh, motion).shade(); }

}  // namespace lekalo::draw
