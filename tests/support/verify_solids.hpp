#pragma once

// Meshes and poses for the checker of solids.

#include <array>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "lekalo/solid/mesh.hpp"
#include "verify/solid/solid_clearance.hpp"

namespace lekalo::cases {

/// The mesh as the checker sees it; one that is not closed is the test's mistake.
inline verify::SolidMesh checked(const solid::Mesh& mesh) {
  verify::SolidMesh made;
  for (const solid::Vector p : mesh.vertices) made.near.push_back({p.x, p.y, p.z});
  made.triangles = mesh.triangles;
  made.numbers.resize(mesh.triangles.size());
  std::iota(made.numbers.begin(), made.numbers.end(), 0U);
  auto closed = verify::closed(std::move(made), "mesh");
  if (!closed) throw std::logic_error(closed.error().message);
  return *std::move(closed);
}

inline verify::Decimal decimal(const std::string& text) {
  auto read = verify::parse_decimal(text);
  if (!read) throw std::logic_error("no decimal: " + text);
  return *std::move(read);
}

inline verify::SolidPose solid_pose(const std::array<std::string, 4>& quaternion,
                                    const std::array<std::string, 3>& shift) {
  verify::SolidPose pose;
  for (std::size_t k = 0; k < 4; ++k) pose.quaternion[k] = decimal(quaternion[k]);
  for (std::size_t k = 0; k < 3; ++k) pose.shift[k] = decimal(shift[k]);
  return pose;
}
inline verify::SolidPose unturned(const std::array<std::string, 3>& shift = {"0", "0", "0"}) {
  return solid_pose({"1", "0", "0", "0"}, shift);
}

/// "shown", or the sentence of the fault or of what is open.
inline std::string answer(const verify::SolidMesh& part, const verify::SolidMesh& blank,
                          const verify::SolidPose& pose, const std::string& clearance) {
  const auto pair = verify::SolidPair::make(part, blank, pose);
  if (!pair) return pair.error().message;
  const verify::SolidAnswer said = pair->check(decimal(clearance));
  return said.fault ? "fault: " + *said.fault : (said.open ? "open: " + *said.open : "shown");
}
inline std::string answer(const solid::Mesh& part, const solid::Mesh& blank, const verify::SolidPose& pose,
                          const std::string& clearance) {
  return answer(checked(part), checked(blank), pose, clearance);
}

}  // namespace lekalo::cases
