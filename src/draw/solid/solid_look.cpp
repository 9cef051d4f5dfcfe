#include "solid_look.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "draw/paper/printed_number.hpp"
#include "lekalo/base/angle.hpp"
#include "lekalo/base/rounding.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/solid/triangle_tree.hpp"

namespace lekalo::draw {
namespace {

using solid::Vector;

double size_of(const ShadedMesh& part, const ShadedMesh& blank) {
  solid::Box box = solid::box_of(part.places);
  for (const Vector p : blank.places) box.hold(p);
  return norm(box.high - box.low);
}

Vector unit_or(Vector v, Vector other) {
  const double length = norm(v);
  return length > 0 ? 1 / length * v : other;
}

std::optional<SolidFocus> focus_of(const SolidScene& scene, const SolidLook& look) {
  if (!look.touches.empty()) {
    const auto tightest =
        std::min_element(look.touches.begin(), look.touches.end(),
                         [](const auto& a, const auto& b) { return a.distance < b.distance; });
    const auto index = static_cast<std::size_t>(tightest - look.touches.begin());
    return SolidFocus{look.contacts[index], tightest->blank, look.outward(index), tightest->distance, index};
  }
  if (!look.missing()) return std::nullopt;
  const std::vector<std::uint32_t>& from = look.part.surface.from;
  const auto left = [&](std::uint32_t vertex) {
    const double allowance = scene.allowances[vertex];
    return std::isnan(allowance) ? std::numeric_limits<double>::infinity() : allowance;
  };
  const auto worst = std::min_element(from.begin(), from.end(),
                                      [&](std::uint32_t a, std::uint32_t b) { return left(a) < left(b); });
  const auto at = static_cast<std::size_t>(worst - from.begin());
  SolidFocus focus;
  focus.place = look.part.surface.places[at];
  focus.on_blank = solid::TriangleTree(scene.blank).nearest(focus.place)->place;
  focus.distance = scene.allowances[*worst];
  const Vector way = focus.on_blank - focus.place;
  focus.outward = unit_or(focus.distance < 0 ? -way : way, look.part.surface.normals[at]);
  return focus;
}

}  // namespace

SolidLook::SolidLook(const SolidScene& scene) : motion(locate::motion_of(scene.placement.pose)) {
  part.surface = shaded(scene.part, motion);
  blank.surface = shaded(scene.blank);
  size = size_of(part.surface, blank.surface);
  decimals = decimals_for(size);
  table_decimals = std::max(3, decimals - 2);
  if (!scene.unknown.empty()) {
    blank.unknown.resize(blank.surface.triangles.size());
    for (const std::uint32_t triangle : scene.unknown) blank.unknown[triangle] = 1;
  }
  if (!scene.allowances.empty()) {
    std::vector<double> counted = scene.allowances;
    std::erase_if(counted, [](double allowance) { return std::isnan(allowance); });
    as_cast_ = counted.size() < scene.allowances.size();
    const auto [low, high] = std::minmax_element(counted.begin(), counted.end());
    if (!counted.empty()) least = *low, greatest = *high;
    // Rounding of the coordinates shows nothing that is missing.
    const double rounding = 1e-12 * size;
    missing_ = least < scene.least_wanted() - rounding;
    range = colour_range(missing_ ? scene.least_wanted() : least, greatest, rounding, size);
    for (const std::uint32_t vertex : part.surface.from) {
      const double value = value_of(scene.allowances[vertex] + (missing_ ? rounding : 0));
      part.values.push_back(!missing_ && value < 0 ? 0 : value);
    }
  }
  if (scene.placement.inside) touches = scene.placement.contacts;
  for (const locate::SolidTouch& touch : touches) contacts.push_back(motion(touch.part));
  focus = focus_of(scene, *this);
}

Vector SolidLook::outward(std::size_t contact) const {
  const Vector place = contacts[contact], way = touches[contact].blank - place;
  if (norm(way) > 0) return unit_or(way, {});
  // Surfaces that touch have the part's own normal. Numbers of triangles may be those of a file, so the
  // nearest vertex is looked for.
  const std::vector<Vector>& places = part.surface.places;
  const auto nearest = std::min_element(places.begin(), places.end(), [&](Vector a, Vector b) {
    return dot(a - place, a - place) < dot(b - place, b - place);
  });
  return part.surface.normals[static_cast<std::size_t>(nearest - places.begin())];
}

namespace {

/// Says if a ray meets the surface farther than `clear` from where it begins.
bool hidden(const ShadedMesh& mesh, Vector from, Vector direction, double clear) {
  for (const solid::Triangle& t : mesh.triangles) {
    ask();
    const Vector a = mesh.places[t[0]], u = mesh.places[t[1]] - a, v = mesh.places[t[2]] - a;
    const Vector across = cross(direction, v);
    const double determinant = dot(u, across);
    if (determinant == 0) continue;
    const Vector w = from - a;
    const double x = dot(w, across) / determinant;
    if (x < 0 || x > 1) continue;
    const Vector around = cross(w, u);
    const double y = dot(direction, around) / determinant;
    if (y < 0 || x + y > 1) continue;
    if (dot(v, around) / determinant > clear) return true;
  }
  return false;
}

}  // namespace

SpaceView facing(const SolidLook& look) {
  constexpr std::array<std::array<double, 2>, 8> kAround{
      {{1, -2}, {2, -1}, {-1, -2}, {-2, -1}, {2, 1}, {1, 2}, {-2, 1}, {-1, 2}}};
  if (!look.focus) return seen_from({1, -2, 1.2});
  // No view is along an axis, so that a block shows three of its faces.
  std::vector<std::pair<double, Vector>> views;
  for (const double height : {1.2, 2.5, -1.2, -2.5})
    for (const auto& [x, y] : kAround) {
      const Vector towards = unit_or({x, y, height}, {});
      views.emplace_back(dot(towards, look.focus->outward) - (height < 0 ? 0.35 : 0), towards);
    }
  std::stable_sort(views.begin(), views.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  for (std::size_t k = 0; k < 12; ++k)
    if (!hidden(look.part.surface, look.focus->place, views[k].second, 1e-3 * look.size))
      return seen_from(views[k].second);
  return seen_from(views.front().second);
}

std::string clearance_text(const SolidScene& scene, const SolidLook& look) {
  if (!scene.placement.inside) return "not inside";
  return decimal(scene.placement.clearance, look.decimals, Rounding::down) + " mm";
}

const char* scale_words(const SolidScene& scene) {
  return scene.margin ? "left over the demands" : "allowance of the part";
}

std::vector<SolidKey> key_of(const SolidScene& scene, const SolidLook& look) {
  std::vector<SolidKey> key;
  if (look.missing()) {
    const std::string most = short_number_up(scene.least_wanted() - look.least);
    key.push_back({kOutside, 1,
                   scene.margin ? fmt::format("less than demanded, by up to {} mm", most)
                   : scene.min_allowance == 0
                       ? fmt::format("outside the blank, by up to {} mm", most)
                       : fmt::format("less than {} mm, by up to {} mm", scene.min_allowance, most),
                   "missing"});
  }
  if (look.as_cast()) key.push_back({kPlainPart, 1, "no allowance demanded", "key-as-cast"});
  if (scene.allowances.empty()) key.push_back({kPlainPart, 1, "part, placed", "key-part"});
  key.push_back({kGlass, 0.3, "blank, as glass", "key-blank"});
  if (!scene.unknown.empty()) key.push_back({kUnknownGlass, 0.6, "blank, not measured", "key-unknown"});
  return key;
}

std::vector<SolidFigure> figures_of(const SolidScene& scene, const SolidLook& look) {
  const auto length = [&](double mm, Rounding rounding = Rounding::nearest) {
    return decimal(mm, look.decimals, rounding) + " mm";
  };
  std::vector<SolidFigure> figures;
  const auto add_bound = [&](const char* name, const std::optional<double>& bound, const double* reached) {
    figures.push_back({name, bound ? length(*bound, Rounding::up) : "not proved", "upper-bound"});
    if (!bound || reached == nullptr) return;
    const double gap = difference_rounded_up(*bound, *reached);
    figures.push_back({"gap", short_number_up(gap) + (std::isfinite(gap) ? " mm" : ""), "gap"});
  };
  if (scene.margin) {
    const double* const left = scene.margin->is ? &*scene.margin->is : nullptr;
    if (left != nullptr)
      figures.push_back({"left over the demands", length(*left, Rounding::down), "margin"});
    add_bound("proven: no more than", scene.margin->bound, left);
  } else {
    add_bound("proven upper bound", scene.upper_bound,
              scene.placement.inside ? &scene.placement.clearance : nullptr);
  }
  if (scene.min_allowance > 0) figures.push_back({"demanded", length(scene.min_allowance), "min-allowance"});
  if (scene.shortfall > 0)
    figures.push_back({"missing", length(scene.shortfall, Rounding::up), "shortfall", true});
  if (!scene.unknown.empty())
    figures.push_back(
        {"not measured", fmt::format("{} mm²", short_number_up(scene.unknown_area)), "unknown", true});
  const locate::SolidPose& pose = scene.placement.pose;
  figures.push_back({"x", length(pose.shift.x), "x"});
  figures.push_back({"y", length(pose.shift.y), "y"});
  figures.push_back({"z", length(pose.shift.z), "z"});
  auto [w, x, y, z] = pose.quaternion;
  if (w < 0) w = -w, x = -x, y = -y, z = -z;
  const Vector axis{x, y, z};
  const double sine = norm(axis);
  // As many digits as move the rim of the part by less than the last digit of x.
  figures.push_back({"turned by", decimal(2 * std::atan2(sine, w) * kDegreesPerRadian, 7) + "°", "turn-deg"});
  if (sine > 0) {
    const Vector n = 1 / sine * axis;
    figures.push_back({"about the axis",
                       fmt::format("{} {} {}", decimal(n.x, 4), decimal(n.y, 4), decimal(n.z, 4)), "axis"});
  }
  return figures;
}

}  // namespace lekalo::draw
