#include "solid_rows.hpp"

#include <algorithm>

namespace lekalo::locate {
namespace {

using solid::Motion;
using solid::Vector;

/// So many points that are to be near the blank's surface are kept.
constexpr std::size_t kMostPoints = 128;

/// A pair of triangles says how to get away from the blank's surface on the side where the part is. Where
/// that is outside, it is the opposite of what helps, and the crossings say what does.
bool on_the_inner_side(const solid::Mesh& blank, const SolidContact& contact) {
  const auto& [i, j, k] = blank.triangles[contact.blank_triangle];
  const Vector a = blank.vertices[i];
  return dot(contact.normal, cross(blank.vertices[j] - a, blank.vertices[k] - a)) <= 0;
}

}  // namespace

LinearBound<6> row_of(const SolidFrame& frame, const Motion& motion, const SolidContact& contact) {
  const Vector n = 1 / contact.demand.scale * contact.normal,
               g = 1 / frame.reach * cross(motion.turned(contact.part - frame.pivot), n);
  return {{n.x, n.y, n.z, g.x, g.y, g.z}, contact.margin()};
}

bool ContactPool::add(const std::vector<SolidContact>& contacts) {
  bool added = false;
  for (const SolidContact& c : contacts) {
    const auto same = [&](const SolidContact& o) { return o.part == c.part && o.normal == c.normal; };
    const auto same_point = [&](const SolidContact& o) { return o.near == c.near && o.part == c.part; };
    if (c.part_triangle != kNoTriangle) {
      added = pairs.insert({c.part_triangle, c.blank_triangle}).second || added;
    } else if (c.of_plane && std::none_of(over_planes.begin(), over_planes.end(), same)) {
      over_planes.push_back(c);
      added = true;
    } else if (c.near != kNoTriangle && points.size() < kMostPoints &&
               std::none_of(points.begin(), points.end(), same_point)) {
      points.push_back(c);
      added = true;
    }
  }
  return added;
}

std::vector<SolidContact> contacts_at(const SolidMeter& meter, const FramedPose& pose, bool inside,
                                      const ContactPool& pool, const std::vector<SolidContact>& met) {
  const Motion motion = meter.frame().motion(pose);
  std::vector<SolidContact> made;
  for (const SolidContact& contact : met)
    if (contact.part_triangle == kNoTriangle && !contact.of_plane && contact.near == kNoTriangle)
      made.push_back(contact);
  for (const SolidContact& contact : pool.over_planes)
    made.push_back(SolidMeter::over_plane(motion, contact));
  for (const SolidContact& point : pool.points)
    if (const auto contact = meter.near_contact(motion, point.near, point.part, point.demanded_triangle))
      made.push_back(*contact);
  for (const auto& [part, blank] : pool.pairs) {
    const SolidContact contact = meter.contact(motion, part, blank);
    if (contact.directed() && (inside || on_the_inner_side(meter.blank(), contact))) made.push_back(contact);
  }
  return made;
}

}  // namespace lekalo::locate
