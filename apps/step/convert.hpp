#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "body_mesh.hpp"
#include "lekalo/base/error.hpp"
#include "lekalo/solid/mesh.hpp"

namespace lekalo::step {

/// A STEP file as triangles, and how far they are from its faces at most.
struct Converted {
  solid::Mesh mesh;
  std::vector<std::uint32_t> face_of_triangle;
  std::vector<FaceRecord> faces;
  double deviation = 0;  ///< mm
  std::size_t solids = 0;
  std::vector<std::string> notices;
};

/// Reads a STEP file and triangulates its solids so finely that no point of a triangle is farther than the
/// deviation from its face, and back, or as near as they come.
///
/// Fails with bad_input and one sentence: no STEP, no solids, a face of which nothing can be proved, a
/// surface that does not close.
[[nodiscard]] Result<Converted> convert(const std::string& path, double deviation);

/// The file of a mesh (docs/formats.md, Meshes of STEP files).
/// \param sha256  of the STEP file
[[nodiscard]] std::string written(const Converted& converted, std::string_view name, std::string_view sha256);

}  // namespace lekalo::step
