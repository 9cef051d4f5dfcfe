#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "entities.hpp"
#include "io/text/refusal.hpp"

// Reads MLINE: parallel lines along a path.

namespace lekalo::io {

Result<void> DxfEntities::read_mline(DxfBlock& into) {
  /// The groups of one vertex: where it is, in which direction the lines are offset there, and how far each.
  struct Joint {
    BoundedPoint at, across;
    std::vector<Millimetres> offsets;
  };
  constexpr unsigned kClosed = 2;
  std::vector<Joint> joints;
  unsigned flags = 0;
  bool is_first_parameter = false;
  while (at_.next() && at_.code() != 0) {
    LEKALO_TRY(const auto taken, take_common());
    if (taken) continue;
    const int code = at_.code();
    if (code == 71) {
      LEKALO_TRY(flags, whole_number());
    }
    if (code == 31) note_height();
    const bool is_place = code == 11 || code == 21 || code == 13 || code == 23;
    if (code == 74) is_first_parameter = true;
    if (!is_place && code != 41) continue;
    LEKALO_TRY(const auto value, number(code != 13 && code != 23));
    if (code == 11) joints.emplace_back();
    if (joints.empty()) return refuse_entity("has lines before its first vertex; the file is damaged");
    Joint& joint = joints.back();
    if (code == 41) {
      // The first parameter of an element is its offset; the others say where it begins and ends.
      if (is_first_parameter) joint.offsets.push_back(value);
      is_first_parameter = false;
      continue;
    }
    BoundedPoint& point = code == 11 || code == 21 ? joint.at : joint.across;
    (code == 11 || code == 13 ? point.at.x : point.at.y) = value.value;
    point.error = std::max(point.error, value.error);
  }
  if (!at_.ok() || is_out_of_sight(into)) return {};
  if (joints.size() < 2) {
    count_unread(into, "of no length");
    return {};
  }
  const std::size_t elements = joints.front().offsets.size();
  for (const Joint& joint : joints)
    if (joint.offsets.size() != elements)
      return refuse_entity("has another number of lines at each vertex; the file is damaged");
  if (elements == 0) {
    count_unread(into, "without lines");
    return {};
  }
  for (std::size_t element = 0; element < elements; ++element) {
    vertices_.clear();
    for (const Joint& joint : joints) {
      const Millimetres offset = joint.offsets[element];
      const geom::Point at = joint.at.at + offset.value * joint.across.at;
      const double error = joint.at.error + std::abs(offset.value) * joint.across.error +
                           offset.error * (std::abs(joint.across.at.x) + std::abs(joint.across.at.y)) +
                           4 * kUnitRoundoff * (std::abs(at.x) + std::abs(at.y) + std::abs(offset.value));
      vertices_.push_back({{at, error}, {}});
    }
    LEKALO_CHECK(add_polyline(into, {}, (flags & kClosed) != 0));
  }
  return {};
}

}  // namespace lekalo::io
