#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "placed_solid.hpp"
#include "solid_features.hpp"
#include "solid_near.hpp"
#include "verify/number/both.hpp"
#include "verify/read/json.hpp"

namespace lekalo::verify {

struct Ball {
  Both3 centre;
  Both radius;
};
/// Says what of a surface comes nearer to the ball's centre than its radius, less the triangle's width.
/// \pre the ball does not lie in the width of a triangle
[[nodiscard]] std::optional<std::string> nearer(const PlacedSolid& body, const Ball& ball);

/// A point of a triangle of the part, as a ball of radius 0.
struct PartPoint {
  Ball ball;
  std::uint32_t triangle{};
};
/// A point of a datum.
struct DatumPoint {
  const SolidDatum* datum = nullptr;
  const Both3* place = nullptr;
};
/// The half-space n . p >= level; the triangles of the blank may reach out of it by their widths.
struct HalfSpace {
  Both3 normal;
  Both level;
};

/// The balls and half-spaces of a certificate, and whether they are what they have to be of the meshes. One
/// is looked at when it is used for the first time.
class CertificateTables {
 public:
  /// Complains of rows that are none. The text behind the certificate, and the meshes, outlive this.
  CertificateTables(Json certificate, const SolidMesh& part, const SolidMesh& blank,
                    const std::vector<SolidDatum>& datums, std::vector<std::string>& findings,
                    std::string& complaint);

  [[nodiscard]] std::size_t part_balls() const { return part_balls_.size(); }
  [[nodiscard]] std::size_t blank_balls() const { return blank_balls_.size(); }
  [[nodiscard]] std::size_t planes() const { return planes_.size(); }
  [[nodiscard]] std::size_t part_points() const { return part_points_.size(); }
  [[nodiscard]] std::size_t datum_points() const { return datum_points_.size(); }
  [[nodiscard]] std::size_t directions() const { return directions_.size(); }
  [[nodiscard]] std::size_t bodies() const { return bodies_.size(); }

  /// A ball in the closed material of the part; nothing, and once a finding, where it is not that.
  [[nodiscard]] const Ball* part_ball(std::size_t number);
  /// A ball within which the blank has no material: either its centre is not in the blank, and every triangle
  /// is as far from it as the radius less the triangle's width, or the width of one triangle has all of it.
  [[nodiscard]] const Ball* blank_ball(std::size_t number);
  /// A point v0 + u (v1 - v0) + v (v2 - v0) of a triangle.
  [[nodiscard]] const PartPoint* part_point(std::size_t number);
  [[nodiscard]] const DatumPoint* datum_point(std::size_t number);
  /// Any three numbers.
  [[nodiscard]] const Both3* direction(std::size_t number);
  /// A body that stays away from the blank's surface.
  [[nodiscard]] const FarBody* body(std::size_t number);
  /// A half-space that holds the blank.
  [[nodiscard]] const HalfSpace* plane(std::size_t number);

 private:
  /// A row as it is written; once it was looked at, the thing is there, unless it is not what it has to be.
  template <class Thing>
  struct Row {
    Json written;
    bool seen = false;
    std::unique_ptr<const Thing> thing = {};
  };
  template <std::size_t Count, class Thing>
  static void read(Json list, const char* key, bool has_radius, std::vector<Row<Thing>>& rows,
                   std::string& complaint);
  /// Makes the thing of a row by make(written, thing), which says why it is not what it has to be.
  template <class Thing, class Make>
  const Thing* look(Row<Thing>& row, const char* key, std::size_t number, const Make& make);

  PlacedSolid part_, blank_;
  const std::vector<SolidDatum>& datums_;
  std::vector<std::string>& findings_;
  std::vector<Row<Ball>> part_balls_, blank_balls_;
  std::vector<Row<HalfSpace>> planes_;
  std::vector<Row<PartPoint>> part_points_;
  std::vector<Row<DatumPoint>> datum_points_;
  std::vector<Row<Both3>> directions_;
  std::vector<Row<FarBody>> bodies_;
};

/// Returns a whole number from 0 to below a count, or nothing where it is none.
[[nodiscard]] std::optional<std::size_t> index_below(const Decimal& number, std::size_t count);

}  // namespace lekalo::verify
