#pragma once

#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopoDS_Face.hxx>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "lekalo/solid/mesh.hpp"

namespace lekalo::step {

/// The triangles of a face, and how far they are from it at most.
struct FaceRecord {
  std::string name, kind;
  double deviation = 0;  ///< mm; infinite where nothing is proved
  std::string fault;     ///< why nothing can be proved, however fine the triangles are; or nothing
};

/// Joins the triangulations of faces to one mesh. Places along an edge are those that the first of its faces
/// has, so that the mesh closes wherever the faces share their edges.
class MeshBuilder {
 public:
  /// Adds a face with its triangulation, and bounds how far the two are from each other.
  /// \pre the face was triangulated together with all others (BRepMesh)
  [[nodiscard]] FaceRecord add(const TopoDS_Face& face);

  [[nodiscard]] const solid::Mesh& mesh() const noexcept { return mesh_; }
  [[nodiscard]] const std::vector<std::uint32_t>& face_of_triangle() const noexcept { return faces_; }

 private:
  solid::Mesh mesh_;
  std::vector<std::uint32_t> faces_;
  std::uint32_t face_ = 0;
  TopTools_DataMapOfShapeInteger vertices_, edges_;
  std::vector<std::vector<std::uint32_t>> along_edges_;
};

}  // namespace lekalo::step
