#include "fit_picture.hpp"

#include <fmt/core.h>

#include "lekalo/draw/fit_picture.hpp"

namespace lekalo::jobs {
namespace {

/// The curve from end to end, each growth times a factor.
std::vector<geom::Point> curve_of(const std::vector<fit::Growth>& surface, double factor) {
  std::vector<geom::Point> points;
  const bool half = surface.empty() || surface.front().z == 0;
  for (auto g = surface.rbegin(); half && g != surface.rend(); ++g)
    points.push_back({-g->z, factor * g->diameter});
  for (const fit::Growth& g : surface) points.push_back({g.z, factor * g.diameter});
  return points;
}

}  // namespace

Result<std::string> drawn_fit(const FitJob& job, const Fitted& made) {
  if (!job.picture) return std::string();
  if (job.picture == PictureForm::pdf) return failure(ErrorCode::usage, "a fit is drawn as SVG or PNG");
  const fit::Assembly& assembly = made.assembly;
  draw::FitPicture picture;
  picture.title =
      (job.fit.empty() ? fmt::format("seat of {:g} mm", assembly.rings[0].outer_diameter) : job.fit) +
      ": growth of diameters x E / (pressure x diameter)";
  picture.hub_to = assembly.rings[1].length / 2, picture.hub_from = -picture.hub_to;
  draw::FitPanel bore{"bore of the shaft", {}}, seat{"surface of the shaft", {}},
      outside{assembly.rings.size() > 2 ? "outside of the outermost ring" : "outside of the hub", {}};
  for (const FitCase& one : made.cases) {
    const fit::Pressed& p = one.pressed;
    const double factor =
        assembly.rings[0].material.youngs_mpa / p.seats[0].pressure_mpa / assembly.rings[0].outer_diameter;
    picture.words.push_back(fmt::format("{:g} um, {}: {:.1f} MPa", 1000 * one.interference,
                                        fit::name_of(p.state), p.seats[0].pressure_mpa));
    bore.curves.push_back(curve_of(p.rings.front().inner, factor));
    seat.curves.push_back(curve_of(p.rings.front().outer, factor));
    outside.curves.push_back(curve_of(p.rings.back().outer, factor));
  }
  if (assembly.rings[0].inner_diameter > 0) picture.panels.push_back(bore);
  picture.panels.push_back(seat);
  picture.panels.push_back(outside);
  if (job.picture == PictureForm::png) return draw::fit_png(picture);
  return draw::fit_svg(picture);
}

}  // namespace lekalo::jobs
