#include "solid_meter.hpp"

#include <limits>

namespace lekalo::locate {
namespace {

using solid::Motion;
using solid::NearPair;
using solid::Vector;

/// So many vertices of each mesh are looked at where they cross.
constexpr std::size_t kSamples = 96;
/// The deepest crossings of one pose are used, at most this many.
constexpr std::size_t kMostCrossings = 16;
/// Points nearer to each other than this part of the coordinates give no direction.
constexpr double kNoDirection = 0x1p-40;
/// The square root of 3, rounded up: how far a point is off at most for each of its coordinates.
constexpr double kDiagonal = 1.7321;

/// Vertices as far from each other as can be: each is the farthest from those before.
std::vector<Vector> spread_vertices(const solid::Mesh& mesh) {
  std::vector<Vector> chosen;
  std::vector<double> apart(mesh.vertices.size(), std::numeric_limits<double>::infinity());
  std::size_t next = 0;
  while (chosen.size() < std::min(kSamples, mesh.vertices.size())) {
    chosen.push_back(mesh.vertices[next]);
    for (std::size_t k = 0; k < apart.size(); ++k) {
      const Vector way = mesh.vertices[k] - chosen.back();
      apart[k] = std::min(apart[k], dot(way, way));
    }
    next = static_cast<std::size_t>(std::max_element(apart.begin(), apart.end()) - apart.begin());
  }
  return chosen;
}

}  // namespace

SolidMeter::SolidMeter(const SolidProblem& problem, const SolidFrame& frame)
    : frame_(frame),
      part_(problem.part),
      blank_(problem.blank),
      widths_(problem.blank_widths),
      clearance_(problem.part, problem.blank, problem.blank_widths),
      of_part_(spread_vertices(problem.part)),
      of_blank_(spread_vertices(problem.blank)),
      part_error_(kDiagonal * problem.part_coordinate_error),
      blank_error_(kDiagonal * problem.blank_coordinate_error),
      width_error_(problem.blank_width_error) {
  if (!widths_.empty()) narrowest_ = *std::min_element(widths_.begin(), widths_.end());
  far_ = 2 * (clearance_.part().largest() + clearance_.blank().largest()) + norm(frame.window.middle().at) +
         norm(frame.window.half().at);
}

SolidContact SolidMeter::contact(const Motion& motion, const NearPair& pair) const {
  const Vector out = pair.part - pair.blank;
  const double distance = norm(out);
  SolidContact made{motion.back(pair.part), pair.blank, {}, 0, pair.part_triangle, pair.blank_triangle};
  if (distance > kNoDirection * far_) made.normal = 1 / distance * out;
  made.distance = distance - width(pair.blank_triangle);
  return made;
}

SolidContact SolidMeter::contact(const Motion& motion, std::uint32_t part_triangle,
                                 std::uint32_t blank_triangle) const {
  return contact(motion, clearance_.pair(motion, part_triangle, blank_triangle));
}

MeasuredSolid SolidMeter::measure(const FramedPose& pose, double most, std::size_t count,
                                  std::vector<SolidContact>& contacts) const {
  const Motion motion = frame_.motion(pose);
  std::vector<NearPair> pairs;
  const double error = part_error_ + blank_error_;
  clearance_.nearest_by_piece(motion, most + error, count, pairs);
  contacts.clear();
  MeasuredSolid measured{pose, most, true};
  for (const NearPair& pair : pairs) measured.value = std::min(measured.value, pair.low - error);
  for (const NearPair& pair : pairs) {
    const SolidContact made = contact(motion, pair);
    if (made.directed()) contacts.push_back(made);
  }
  measured.inside = measured.value > 0 && clearance_.inside(motion);
  if (measured.inside) return measured;
  add_crossings(motion, pairs, contacts);
  measured.value = -kNoDirection * far_;
  for (const SolidContact& made : contacts) measured.value = std::min(measured.value, made.distance);
  return measured;
}

void SolidMeter::add_crossings(const Motion& motion, const std::vector<NearPair>& pairs,
                               std::vector<SolidContact>& contacts) const {
  std::vector<SolidContact> crossing;
  const auto add = [&](Vector part, Vector blank, double depth) {
    if (!(depth > kNoDirection * far_)) return;
    crossing.push_back({part, blank, 1 / depth * (blank - motion(part)), -depth, kNoTriangle, kNoTriangle});
  };
  const auto sticks_out = [&](Vector a) {
    const Vector q = motion(a);
    if (clearance_.blank().holds(q)) return;
    const auto near = clearance_.blank().nearest(q);
    add(a, near->place, norm(q - near->place));
  };
  const auto sticks_in = [&](Vector b) {
    const Vector p = motion.back(b);
    if (!clearance_.part().holds(p)) return;
    const auto near = clearance_.part().nearest(p);
    add(near->place, b, norm(p - near->place));
  };
  for (const Vector a : of_part_) sticks_out(a);
  for (const Vector b : of_blank_) sticks_in(b);
  for (const NearPair& pair : pairs) {
    if (pair.low > 0) continue;
    for (const std::uint32_t k : part_.triangles[pair.part_triangle]) sticks_out(part_.vertices[k]);
    for (const std::uint32_t k : blank_.triangles[pair.blank_triangle]) sticks_in(blank_.vertices[k]);
  }
  const auto deeper = [](const SolidContact& a, const SolidContact& b) {
    if (a.distance != b.distance) return a.distance < b.distance;
    return a.part.x != b.part.x ? a.part.x < b.part.x : a.part.y < b.part.y;
  };
  std::sort(crossing.begin(), crossing.end(), deeper);
  const auto same = [](const SolidContact& a, const SolidContact& b) {
    return a.part == b.part && a.blank == b.blank;
  };
  crossing.erase(std::unique(crossing.begin(), crossing.end(), same), crossing.end());
  if (crossing.size() > kMostCrossings) crossing.resize(kMostCrossings);
  contacts.insert(contacts.end(), crossing.begin(), crossing.end());
}

}  // namespace lekalo::locate
