#pragma once

#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopoDS_Face.hxx>
#include <cstdint>
#include <string>
#include <vector>

#include "face_mesh.hpp"
#include "lekalo/solid/mesh.hpp"

namespace lekalo::step {

/// A face of the file, and how far its triangles are from it at most.
struct FaceRecord {
  std::string name, kind;
  std::uint32_t colour = 0;  ///< 65536 red + 256 green + blue, or io::SolidFile::kNoColour
  double deviation = 0;      ///< mm; infinite where nothing is proved
  std::string fault;         ///< why nothing can be proved, however fine the triangles are; or nothing
};

/// Joins the triangulations of faces to one mesh. Places along an edge are those that the first of its faces
/// has, so that the mesh closes wherever the faces share their edges.
class BodyMesh {
 public:
  /// Adds a face with its triangulation.
  /// \pre the face was triangulated together with all others (BRepMesh)
  void add(const TopoDS_Face& face);
  /// Divides the triangles of the faces that are farther off than asked for, and no others.
  /// \param most  it stops at so many triangles
  void refine(double asked, std::size_t most);
  /// Bounds how far faces and triangles are from each other.
  void bound();

  [[nodiscard]] std::vector<FaceRecord>& faces() noexcept { return records_; }
  [[nodiscard]] std::size_t triangle_count() const;
  /// The triangles, and the face of each.
  [[nodiscard]] std::pair<solid::Mesh, std::vector<std::uint32_t>> mesh() const;

 private:
  [[nodiscard]] std::string fault_of(const TopoDS_Face& face, FaceMesh& mesh);

  FaceMesh::Vertices places_;
  std::vector<Piece> pieces_;
  std::vector<FaceMesh> meshes_;
  std::vector<bool> reversed_;
  std::vector<FaceRecord> records_;
  TopTools_DataMapOfShapeInteger vertices_, edges_;
  struct Edge {
    std::vector<std::uint32_t> vertices;
    std::size_t first_piece = 0;
  };
  std::vector<Edge> along_edges_;
};

}  // namespace lekalo::step
