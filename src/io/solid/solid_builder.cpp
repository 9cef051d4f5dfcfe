#include "solid_builder.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/text/refusal.hpp"
#include "lekalo/base/counted.hpp"

namespace lekalo::io {

DecimalFactor decimal_factor(SolidUnit unit) noexcept {
  switch (unit) {
    case SolidUnit::inch:
      return decimal_factor(LengthUnit::inch);
    case SolidUnit::metre:
      return {1, 3};
    case SolidUnit::micron:
      return {1, -3};
    case SolidUnit::centimetre:
      return {1, 1};
    case SolidUnit::foot:
      return {3048, -1};
    case SolidUnit::millimetre:
      break;
  }
  return {};
}

std::string too_many_vertices() {
  return fmt::format("more than {} vertices; thin the mesh or the scan out first", kMostSolidVertices);
}
std::string too_many_triangles() {
  return fmt::format("more than {} triangles; thin the mesh out first", kMostSolidTriangles);
}

SolidBuilder::SolidBuilder(const std::string& name, std::string_view format, std::optional<SolidUnit> asked)
    : asked_(asked) {
  file_.name = name;
  file_.format = format;
  file_.unit = asked.value_or(SolidUnit::millimetre);
  unit_ = decimal_factor(file_.unit);
}

std::string SolidBuilder::set_unit(SolidUnit unit) {
  file_.unit = unit;
  unit_ = decimal_factor(unit);
  if (asked_.value_or(unit) == unit) return {};
  return fmt::format(
      "the file says {}, but {} was asked for; leave --units out, or give the other file in {}, too",
      name_of(unit), name_of(*asked_), name_of(unit));
}

Result<void> SolidBuilder::set_deviation(double millimetres) {
  if (file_.unit != SolidUnit::millimetre)
    return refuse(file_.name,
                  "lekalo-step made it in mm; leave --units out, or give the other file in mm, too");
  file_.deviation = millimetres;
  return {};
}

void SolidBuilder::reserve(std::size_t vertices, std::size_t triangles) {
  file_.mesh.vertices.reserve(vertices);
  file_.mesh.triangles.reserve(triangles);
}

void SolidBuilder::add_vertex(solid::Vector p, double error) {
  file_.mesh.vertices.push_back(p);
  file_.coordinate_error = std::max(file_.coordinate_error, error);
}

void SolidBuilder::begin_group(std::string_view name) {
  const auto group = [&](std::string_view wanted) {
    if (const auto found = number_of_group_.find(wanted); found != number_of_group_.end())
      return found->second;
    const auto number = static_cast<std::uint32_t>(file_.groups.size());
    file_.groups.emplace_back(wanted);
    number_of_group_.emplace(wanted, number);
    return number;
  };
  if (file_.groups.empty()) {
    if (name.empty()) return;
    if (triangles() > 0) group("");
  }
  group_ = group(name);
  file_.group_of_triangle.resize(triangles(), 0);
}

void SolidBuilder::add_triangle(solid::Triangle corners) {
  file_.mesh.triangles.push_back(corners);
  if (!file_.groups.empty()) file_.group_of_triangle.push_back(group_);
}

std::string SolidBuilder::add_face(std::span<const std::uint32_t> corners) {
  std::string wrong = cutter_.cut(file_.mesh.vertices, corners, file_.mesh.triangles);
  if (!file_.groups.empty()) file_.group_of_triangle.resize(triangles(), group_);
  return wrong;
}

void SolidBuilder::tell(std::string_view notice) {
  file_.notices.push_back(fmt::format("{}: {}", file_.name, notice));
}

SolidFile SolidBuilder::take() {
  if (cutter_.faces() > 0)
    tell(fmt::format(
        "{} of more than three corners {} cut into triangles; corners lie up to {:.2g} mm off a plane",
        counted(cutter_.faces(), "face"), cutter_.faces() == 1 ? "is" : "are", cutter_.unevenness()));
  return std::move(file_);
}

}  // namespace lekalo::io
