#include "heat_measured.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "heat_border.hpp"

namespace lekalo::jobs {
namespace {

using heat::Interval;
using heat::Place;

/// A place may be beside what it was measured in by the rounding of decimals, mm.
constexpr double kBesidePlace = 0.01;
/// A place that gets no warmer than this by all heat that there may be says nothing, K.
constexpr double kNoRise = 1e-6;

/// "60 degrees C at X 10 Y 5 Z -3 after 100 s".
std::string words_of(const MeasuredTemperature& m) {
  return fmt::format("{:g} degrees C at X {:g} Y {:g} Z {:g} after {:g} s", m.celsius, m.at.x, m.at.y, m.at.z,
                     m.seconds);
}

/// Returns how deep the tip is, at its lowest, while the tool is over a place; none where it never is.
std::optional<double> lowest_over(const heat::ToolPiece& piece, Place at, double radius) {
  const double dx = piece.to[0] - piece.from[0], dy = piece.to[1] - piece.from[1];
  const double px = at.x - piece.from[0], py = at.y - piece.from[1];
  const double square = dx * dx + dy * dy, along = px * dx + py * dy, off = px * px + py * py;
  double first = 0, last = 1;
  if (square > 0) {
    // The squared distance is off - 2 t along + t^2 square.
    const double root = along * along - square * (off - radius * radius);
    if (!(root > 0)) return std::nullopt;
    first = std::max(first, (along - std::sqrt(root)) / square);
    last = std::min(last, (along + std::sqrt(root)) / square);
    if (!(first < last)) return std::nullopt;
  } else if (!(off < radius * radius)) {
    return std::nullopt;
  }
  const auto tip = [&](double t) { return piece.from[2] + t * (piece.to[2] - piece.from[2]); };
  return std::min(tip(first), tip(last));
}

/// Refuses a place outside of the stock, or one that the tool takes off before a time. \param what  begins
/// the sentence
Result<void> check_place(const std::string& what, Place at, double until, const HeatJob& job,
                         const HeatSource& source, const StockBorder& border) {
  const heat::StockBox& box = source.stock.box;
  const double top = job.source.machining.top;
  if (!(border.inside(at.x, at.y) >= -kBesidePlace && at.z <= top + kBesidePlace &&
        at.z >= top - box.thickness - kBesidePlace))
    return failure(
        ErrorCode::bad_input,
        fmt::format("{}: the place is outside of the stock, which goes from X {:g} Y {:g} Z {:g} to X "
                    "{:g} Y {:g} Z {:g}{}; state it in the program's coordinates, mm",
                    what, box.low_x, box.low_y, top - box.thickness, box.high_x, box.high_y, top,
                    border.is_block() ? "" : " within its outline"));
  const double radius = job.source.machining.tool_diameter / 2 - kBesidePlace;
  for (const heat::ToolPiece& piece : source.pieces) {
    if (piece.start > until) break;
    const std::optional<double> low = lowest_over(piece, at, radius);
    if (low && *low < at.z - kBesidePlace)
      return failure(ErrorCode::bad_input,
                     fmt::format("{}: the place is in the air, since the tool took it off after {:.3f} "
                                 "s; state a place that still stands",
                                 what, piece.start));
  }
  return {};
}

Result<void> check_one(const MeasuredTemperature& m, const HeatJob& job, const HeatSource& source,
                       const StockBorder& border) {
  if (!(m.seconds >= 0 && m.seconds <= source.work.seconds))
    return failure(ErrorCode::bad_input,
                   fmt::format("measured {}: the program takes {:.3f} s; state the time from its start",
                               words_of(m), source.work.seconds));
  return check_place("measured " + words_of(m), m.at, m.seconds, job, source, border);
}

/// Linear along each axis between the middles of voxels, of which each counts by its material; none where
/// there is none.
std::optional<double> warmth_at(Place at, const heat::Body& body, const std::vector<double>& temperatures) {
  const heat::Grid& grid = body.grid();
  const std::array<double, 3> off{(at.x - grid.low.x) / grid.pitch.x - 0.5,
                                  (at.y - grid.low.y) / grid.pitch.y - 0.5,
                                  (at.z - grid.low.z) / grid.pitch.z - 0.5};
  std::array<std::array<std::size_t, 2>, 3> voxel{};
  std::array<double, 3> part{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double most = static_cast<double>(grid.count[axis] - 1), at_axis = std::clamp(off[axis], 0.0, most);
    voxel[axis][0] = static_cast<std::size_t>(at_axis);
    voxel[axis][1] = std::min(voxel[axis][0] + 1, grid.count[axis] - 1);
    part[axis] = at_axis - std::floor(at_axis);
  }
  double sum = 0, whole = 0;
  for (std::size_t n = 0; n < 8; ++n) {
    double weight = 1;
    std::array<std::size_t, 3> v{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t side = n >> axis & 1U;
      v[axis] = voxel[axis][side];
      weight *= side == 1 ? part[axis] : 1 - part[axis];
    }
    const std::size_t cell = grid.cell(v[0], v[1], v[2]);
    weight *= body.share(cell);
    sum += weight * temperatures[cell], whole += weight;
  }
  if (!(whole > 0)) return std::nullopt;
  return sum / whole;
}

/// The least and the greatest rise by all cases.
Interval rise_of(const std::vector<std::vector<double>>& rises, std::size_t place) {
  Interval all{rises.front()[place], rises.front()[place]};
  for (const std::vector<double>& one : rises)
    all = {std::min(all.least, one[place]), std::max(all.greatest, one[place])};
  return all;
}

}  // namespace

Result<void> check_measured(const HeatJob& job, const HeatSource& source) {
  const StockBorder border(source.stock);
  for (const MeasuredTemperature& m : job.measured) LEKALO_CHECK(check_one(m, job, source, border));
  return {};
}

Result<void> check_datum(const HeatJob& job, const HeatSource& source) {
  if (!job.holding.datum) return {};
  const Place at = *job.holding.datum;
  return check_place(fmt::format("the datum X {:g} Y {:g} Z {:g}", at.x, at.y, at.z), at, source.work.seconds,
                     job, source, StockBorder(source.stock));
}

void MeasuredRises::take(const heat::Body& body, const std::vector<double>& temperatures, double begin,
                         double end) {
  for (std::size_t i = 0; i < measured_.size(); ++i) {
    const double seconds = measured_[i].seconds;
    if (seconds <= begin) continue;
    const double now = warmth_at(measured_[i].at, body, temperatures).value_or(before_[i]);
    // The last step may end by rounding before the program does.
    const double part = std::min(1.0, (seconds - begin) / (end - begin));
    found_[i] = before_[i] + part * (now - before_[i]);
    before_[i] = now;
  }
}

Result<MeasuredHeat> measured_heat(const HeatJob& job, const heat::CuttingWork& work,
                                   const std::vector<std::vector<double>>& rises) {
  const Interval share = job.material[heat::Property::share];
  MeasuredHeat made{work.into_workpiece_j, share, share.middle(), {}};
  if (job.measured.empty()) return made;
  const double middle = work.work_j.middle();
  for (std::size_t i = 0; i < job.measured.size(); ++i) {
    const MeasuredTemperature& m = job.measured[i];
    const Interval rise = rise_of(rises, i), stated = work.into_workpiece_j;
    if (!(rise.least * stated.greatest > kNoRise * middle))
      return failure(
          ErrorCode::bad_input,
          fmt::format("measured {}: no heat of the program has come there by then, so that it says "
                      "nothing of the share; leave it out, or state one nearer or later",
                      words_of(m)));
    const double above = m.celsius - job.ambient_c;
    const Interval supported{std::max(0.0, (above - m.uncertainty_k) / rise.greatest * middle),
                             (above + m.uncertainty_k) / rise.least * middle};
    if (!(std::max(supported.least, stated.least) <= std::min(supported.greatest, stated.greatest)))
      return failure(
          ErrorCode::bad_input,
          fmt::format(
              "measured {}: it is from {:.2f} to {:.2f} degrees C warm there by what is stated, and {:g} "
              "K is the uncertainty; look at place, time and surroundings (--ambient), or state share, "
              "force or cooling more widely",
              words_of(m), job.ambient_c + rise.least * stated.least / middle,
              job.ambient_c + rise.greatest * stated.greatest / middle, m.uncertainty_k));
    made.supported_j.push_back(supported);
  }
  std::size_t low = 0, high = 0;
  for (std::size_t i = 0; i < made.supported_j.size(); ++i) {
    if (made.supported_j[i].least > made.supported_j[low].least) low = i;
    if (made.supported_j[i].greatest < made.supported_j[high].greatest) high = i;
  }
  made.heat_j = {std::max(made.heat_j.least, made.supported_j[low].least),
                 std::min(made.heat_j.greatest, made.supported_j[high].greatest)};
  if (!(made.heat_j.least <= made.heat_j.greatest))
    return failure(
        ErrorCode::bad_input,
        fmt::format("measured {}, and {}: the first needs {:.1f} J in the workpiece at least, and the "
                    "second {:.1f} J at most; leave out the one that is wrong, or state more "
                    "uncertainty behind its time, K",
                    words_of(job.measured[low]), words_of(job.measured[high]), made.supported_j[low].least,
                    made.supported_j[high].greatest));
  // Some force of its interval makes the heat with each share that is left.
  made.share = {std::max(share.least, made.heat_j.least / work.work_j.greatest),
                std::min(share.greatest, made.heat_j.greatest / work.work_j.least)};
  made.middle_share = made.heat_j.middle() / middle;
  return made;
}

}  // namespace lekalo::jobs
