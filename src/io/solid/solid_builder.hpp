#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/decimal.hpp"
#include "lekalo/io/solid/solid_file.hpp"
#include "polygon.hpp"

namespace lekalo::io {

/// Gathers what a reader of solids finds, and counts.
class SolidBuilder {
 public:
  SolidBuilder(const std::string& name, std::string_view format, std::optional<SolidUnit> asked);

  [[nodiscard]] const std::string& name() const noexcept { return file_.name; }
  [[nodiscard]] DecimalFactor unit() const noexcept { return unit_; }
  [[nodiscard]] std::size_t vertices() const noexcept { return file_.mesh.vertices.size(); }
  [[nodiscard]] std::size_t triangles() const noexcept { return file_.mesh.triangles.size(); }

  /// The file says its unit. Returns what is wrong where it was asked to be read in another one, or nothing.
  /// \pre nothing was added
  [[nodiscard]] std::string set_unit(SolidUnit unit);
  /// Fails where the file was asked to be read in another unit than mm.
  [[nodiscard]] Result<void> set_deviation(double millimetres);
  void reserve(std::size_t vertices, std::size_t triangles);
  /// \param error  of each coordinate, mm
  void add_vertex(solid::Vector p, double error);
  /// Adds the direction of the last vertex.
  void add_direction(solid::Vector n) { file_.directions.push_back(n); }
  /// The name of the triangles that follow.
  void begin_group(std::string_view name);
  /// The triangles from `first` on are of a face of a STEP file.
  void set_colours(std::vector<std::uint32_t> of_faces) { file_.colour_of_face = std::move(of_faces); }
  void set_face(std::size_t first, std::uint32_t face) {
    file_.face_of_triangle.resize(first);
    file_.face_of_triangle.resize(triangles(), face);
  }
  /// \pre its vertices were added
  void add_triangle(solid::Triangle corners);
  /// Adds a face of three corners or more as triangles. Returns what is wrong with it, or nothing.
  [[nodiscard]] std::string add_face(std::span<const std::uint32_t> corners);

  void tell(std::string_view notice);
  [[nodiscard]] std::vector<std::string>& notices() noexcept { return file_.notices; }
  [[nodiscard]] SolidFile take();

 private:
  SolidFile file_;
  std::optional<SolidUnit> asked_;
  DecimalFactor unit_;
  std::map<std::string, std::uint32_t, std::less<>> number_of_group_;
  std::uint32_t group_ = 0;
  PolygonCutter cutter_;
};

[[nodiscard]] DecimalFactor decimal_factor(SolidUnit unit) noexcept;

/// Sentences about a file that has too many, with the way out.
[[nodiscard]] std::string too_many_vertices();
[[nodiscard]] std::string too_many_triangles();

/// A format of solids as a value: how its files are told from others, and what reads them.
struct SolidFormat {
  const FileFormat* file;
  bool (*begins_so)(std::string_view bytes);
  Result<void> (*read)(std::string_view bytes, SolidBuilder& made);
};

/// The readers, one for each format.
[[nodiscard]] bool has_stl_length(std::string_view bytes);
[[nodiscard]] bool is_stl(std::string_view bytes);
[[nodiscard]] Result<void> read_stl(std::string_view bytes, SolidBuilder& made);
[[nodiscard]] bool is_obj(std::string_view bytes);
[[nodiscard]] Result<void> read_obj(std::string_view bytes, SolidBuilder& made);
[[nodiscard]] bool is_ply(std::string_view bytes);
[[nodiscard]] Result<void> read_ply(std::string_view bytes, SolidBuilder& made);
[[nodiscard]] bool is_three_mf(std::string_view bytes);
[[nodiscard]] Result<void> read_three_mf(std::string_view bytes, SolidBuilder& made);
[[nodiscard]] bool is_points(std::string_view bytes);
[[nodiscard]] Result<void> read_points(std::string_view bytes, SolidBuilder& made);

}  // namespace lekalo::io
