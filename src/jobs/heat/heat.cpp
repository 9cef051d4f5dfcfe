#include "lekalo/jobs/heat.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <span>
#include <utility>

#include "heat_border.hpp"
#include "heat_measured.hpp"
#include "heat_recorder.hpp"
#include "heat_voxels.hpp"
#include "heat_walls.hpp"
#include "lekalo/base/angle.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/trig.hpp"

namespace lekalo::jobs {
namespace {

using heat::Interval;
using heat::Place;
using heat::Property;

/// A program has so many steps in time, and some more for each wait.
constexpr double kSteps = 300, kStepsOfAWait = 15;
constexpr double kShortestStep = 0.2;  // s
/// Steps are so many times shorter where walls are visited, because heat enters all over a step at once.
constexpr double kShorterAtWalls = 4;
/// A voxel takes heat where at least this part of it is material.
constexpr double kSolid = 0.5;
/// Heat looks for material this many half voxels out of the tool.
constexpr int kLooksOut = 6;
constexpr double kMicrometres = 1000;
/// An outline's edge that lies on a side of its box is a side, and no wall that is cut, mm.
constexpr double kOnBorder = 1e-6;
/// Displacements are solved to this part of the load.
constexpr double kSolved = 1e-4;

/// The figures of a material as the solver takes them.
heat::Conductor conductor_of(const heat::Material& m) {
  return {m[Property::conductivity].middle() * 1e-3,
          m[Property::density].middle() * m[Property::heat_capacity].middle() * 1e-9};
}
heat::Elastic elastic_of(const heat::Material& m) {
  return {m[Property::youngs].middle(), m[Property::poisson].middle(), m[Property::expansion].middle()};
}

/// The underside lies on something, and what holds a side covers it.
heat::Films films_of(double film, const heat::Holding& holding) {
  heat::Films films;
  const double each = film * 1e-6;
  films.cut = each;
  for (std::size_t side = 0; side < heat::kSides; ++side)
    films.sides[side] = holding.held[side] || side == of(heat::Side::z_low) ? 0 : each;
  return films;
}

/// The events between two times: heat of cuts, then their material, then walls that the tool is beside.
struct Span {
  double begin = 0, end = 0;  ///< s
  std::vector<const heat::CutStep*> steps;
  std::vector<const heat::ToolPiece*> strokes;
  struct Beside {
    std::size_t place = 0, visit = 0;
    double at = 0;  ///< s
  };
  std::vector<Beside> walls;
};

/// One run with all of the work as heat: everything is in proportion to the share.
struct Run {
  std::vector<double> errors_um, decided;  ///< of each place, and the time of the visit that decided, s
  std::vector<std::vector<std::array<double, 2>>> moved_um;  ///< of each place at each of its visits
  double warmest_k = 0, stress_mpa = 0, not_placed_j = 0;
  Place stress_at;
  double stress_seconds = 0;
  heat::HeatBook book;
  std::optional<double> half_s, tenth_s;
  std::vector<double> rises_k;  ///< at measured places
  std::uint64_t work = 0;
};

class Follower {
 public:
  Follower(const HeatJob& job, const HeatFound& found)
      : job_(job),
        found_(found),
        radius_(job.source.machining.tool_diameter / 2),
        border_(found.source.stock) {
    divide(found.source.pieces, found.source.work.seconds, times_of(found.visits));
    const auto span_of = [&](double at) -> Span& {
      const auto after = std::ranges::upper_bound(spans_, at, {}, &Span::end);
      return after == spans_.end() ? spans_.back() : *after;
    };
    for (const heat::CutStep& s : found.source.work.steps)
      span_of(s.start + s.seconds / 2).steps.push_back(&s);
    for (const heat::ToolPiece& p : found.source.pieces)
      if (std::min(p.from[2], p.to[2]) < job.source.machining.top)
        span_of(p.start + p.seconds / 2).strokes.push_back(&p);
    for (std::size_t i = 0; i < found.visits.size(); ++i)
      for (std::size_t k = 0; k < found.visits[i].size(); ++k)
        span_of(found.visits[i][k].at).walls.push_back({i, k, found.visits[i][k].at});
  }

  [[nodiscard]] std::size_t steps() const { return spans_.size(); }

  /// \param recorder  may be null
  Result<Run> run(double film, const ProgressListener& progress, HeatRecorder* recorder) const {
    heat::Body body(
        found_.grid, border_.is_block() ? std::function<double(Place)>{}
                                        : [&](Place p) { return border_.inside(p.x, p.y) + kOnBorder; });
    heat::Conduction conduction(body, conductor_of(job_.material), films_of(film, job_.holding),
                                job_.threads);
    heat::Expansion expansion(found_.grid, elastic_of(job_.material), job_.holding, job_.threads);
    Run run;
    run.errors_um.assign(found_.walls.size(), -std::numeric_limits<double>::infinity());
    run.decided.resize(found_.walls.size());
    for (const auto& visits : found_.visits) run.moved_um.emplace_back(visits.size());
    run.stress_at = middle_of(0);
    MeasuredRises rises(job_.measured);
    // How far the places of the next step's visits are moved when it begins.
    std::vector<Place> before;
    for (std::size_t n = 0; n < spans_.size(); ++n) {
      ask();
      if (progress) progress({n, static_cast<double>(n) / static_cast<double>(spans_.size())});
      const Span& span = spans_[n];
      LEKALO_CHECK(conduction.step(span.end - span.begin, sources_of(span, body, run)));
      for (const heat::ToolPiece* p : span.strokes)
        body.cut({{p->from[0], p->from[1], p->from[2]}, {p->to[0], p->to[1], p->to[2]}, radius_});
      const std::vector<heat::Changed> changed = body.settle();
      if (!changed.empty()) conduction.follow(body, changed);
      const std::vector<double> temperatures = conduction.temperatures();
      run.warmest_k = std::max(run.warmest_k, *std::ranges::max_element(temperatures));
      rises.take(body, temperatures, span.begin, span.end);
      if (recorder != nullptr) recorder->step(body, temperatures, span.end);
      std::span<const Span::Beside> next;
      if (n + 1 < spans_.size()) next = spans_[n + 1].walls;
      if (span.walls.empty() && next.empty()) continue;
      expansion.follow(body);
      LEKALO_CHECK(expansion.solve(temperatures, kSolved));
      const std::vector<double> stress = expansion.mises();
      if (recorder != nullptr) recorder->stress(stress);
      const auto most = std::ranges::max_element(stress);
      if (*most > run.stress_mpa)
        run.stress_mpa = *most, run.stress_seconds = span.end,
        run.stress_at = middle_of(static_cast<std::size_t>(most - stress.begin()));
      before.resize(span.walls.size());
      for (std::size_t k = 0; k < span.walls.size(); ++k) {
        const auto& [i, visit, at] = span.walls[k];
        const WallPoint& w = found_.walls[i];
        const Place moved =
            between(before[k], moved_at(expansion, w), (at - span.begin) / (span.end - span.begin));
        run.moved_um[i][visit] = {kMicrometres * moved.x, kMicrometres * moved.y};
        // The tool cuts at its place whatever is there, and what it cuts comes from that place less the
        // displacement. The visit counts that goes deepest into the cold workpiece.
        const double error = -kMicrometres * (moved.x * w.outward[0] + moved.y * w.outward[1]);
        if (error > run.errors_um[i]) run.errors_um[i] = error, run.decided[i] = at;
      }
      before.clear();
      for (const Span::Beside& beside : next)
        before.push_back(moved_at(expansion, found_.walls[beside.place]));
    }
    run.rises_k = rises.found();
    run.work = expansion.work();
    // A picture's displacement is no part of the work of the result, which is the same without it.
    if (recorder != nullptr) {
      const std::vector<double> temperatures = conduction.temperatures();
      expansion.follow(body);
      LEKALO_CHECK(expansion.solve(temperatures, kSolved));
      recorder->end(body, temperatures, expansion);
    }
    run.book = conduction.book();
    if (film > 0) LEKALO_CHECK(cool_down(conduction, run));  // else it never does
    run.work += conduction.work();
    return run;
  }

 private:
  [[nodiscard]] Place middle_of(std::size_t cell) const {
    const heat::Grid& grid = found_.grid;
    const std::size_t row = cell / grid.count[0];
    return grid.middle(cell % grid.count[0], row % grid.count[1], row / grid.count[1]);
  }

  static Place moved_at(const heat::Expansion& expansion, const WallPoint& w) {
    return expansion.moved({w.x, w.y, w.z});
  }
  static Place between(Place a, Place b, double t) {
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)};
  }

  /// Goes on without the program, in steps that grow, until little of the heat is left. Between them what is
  /// left falls as a power of a number.
  static Result<void> cool_down(heat::Conduction& conduction, Run& run) {
    constexpr double kFirst = 0.5, kGrowth = 1.25, kHalf = 0.5, kTenth = 0.1;
    const double whole = run.book.stored;
    double at = 0, left = 1;
    for (double step = kFirst; whole > 0 && !run.tenth_s && at < kLongestWait; step *= kGrowth) {
      ask();
      LEKALO_CHECK(conduction.step(step, {}));
      const double now = conduction.book().stored / whole;
      for (const auto& [part, seconds] : {std::pair{kHalf, &run.half_s}, {kTenth, &run.tenth_s}})
        if (now > 0 && now <= part && !*seconds)
          *seconds = at + step * std::log(left / part) / std::log(left / now);
      at += step, left = now;
    }
    return {};
  }

  static std::vector<double> times_of(const std::vector<std::vector<WallVisit>>& visits) {
    std::vector<double> times;
    for (const std::vector<WallVisit>& of_place : visits)
      for (const WallVisit& visit : of_place) times.push_back(visit.at);
    std::ranges::sort(times);
    return times;
  }

  /// Steps have about one length, but for those of visits and just before them, and for waits, in which
  /// nothing happens but that heat spreads. \param visits  in the order of time, s
  void divide(const std::vector<heat::ToolPiece>& pieces, double seconds, const std::vector<double>& visits) {
    double waits = 0;
    for (const heat::ToolPiece& p : pieces)
      if (p.line == 0) waits += p.seconds;
    const double step = std::max(kShortestStep, (seconds - waits) / kSteps);
    double begin = 0;
    const auto end_at = [&](double end) {
      if (end > begin) spans_.push_back({begin, end, {}, {}, {}});
      begin = std::max(begin, end);
    };
    const auto is_near = [&](double from, double to) {
      const auto soon = std::ranges::lower_bound(visits, from);
      return soon != visits.end() && *soon <= to;
    };
    for (const heat::ToolPiece& p : pieces) {
      const double end = p.start + p.seconds;
      if (p.line == 0 && p.seconds > step) {
        end_at(p.start);
        const double parts = std::min(kStepsOfAWait, std::ceil(p.seconds / step));
        for (double k = 1; k <= parts; ++k) end_at(p.start + p.seconds * k / parts);
      } else if (end - begin >= (is_near(begin, end + step) ? step / kShorterAtWalls : step)) {
        end_at(end);
      }
    }
    end_at(seconds);
  }

  [[nodiscard]] std::vector<heat::Source> sources_of(const Span& span, const heat::Body& body,
                                                     Run& run) const {
    Placed placed;
    for (const heat::CutStep* step : span.steps)
      step->floor ? heat_floor(*step, body, placed) : heat_rim(*step, body, placed);
    run.not_placed_j += placed.nowhere;
    std::vector<heat::Source> sources;
    for (const auto& [cell, heat] : placed.joules) sources.push_back({cell, heat / (span.end - span.begin)});
    return sources;
  }

  /// The heat of each voxel, and what found none, J.
  struct Placed {
    std::map<std::size_t, double> joules;
    double nowhere = 0;
  };

  /// Adds heat to the first voxel that is solid enough on the way out of the tool, if there is one.
  bool add(Place from, Place out, double heat, const heat::Body& body, Placed& placed) const {
    const heat::Grid& grid = found_.grid;
    for (int k = 1; k <= kLooksOut; ++k) {
      const Place at{from.x + 0.5 * k * out.x, from.y + 0.5 * k * out.y, from.z + 0.5 * k * out.z};
      const std::array<double, 3> off{(at.x - grid.low.x) / grid.pitch.x, (at.y - grid.low.y) / grid.pitch.y,
                                      (at.z - grid.low.z) / grid.pitch.z};
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (!(off[axis] >= 0 && off[axis] < static_cast<double>(grid.count[axis]))) return false;
      const auto voxel = grid.voxel_of(at);
      const std::size_t cell = grid.cell(voxel[0], voxel[1], voxel[2]);
      if (body.share(cell) < kSolid) continue;
      placed.joules[cell] += heat;
      return true;
    }
    return false;
  }

  /// The foot of a rib takes the heat where nothing stands behind it.
  void heat_rim(const heat::CutStep& step, const heat::Body& body, Placed& placed) const {
    const Place pitch = found_.grid.pitch;
    const double x = (step.from[0] + step.to[0]) / 2, y = (step.from[1] + step.to[1]) / 2;
    const double arc = step.end - step.begin, height = step.high_z - step.low_z;
    const auto parts = [](double whole, double of) {
      return static_cast<std::size_t>(std::max(1.0, std::ceil(whole / of)));
    };
    const std::size_t round = parts(arc * radius_, std::min(pitch.x, pitch.y)), up = parts(height, pitch.z);
    const double heat = step.work_j.middle() / static_cast<double>(round * up);
    for (std::size_t i = 0; i < round; ++i) {
      const auto d =
          geom::sincos(step.begin + arc * (static_cast<double>(i) + 0.5) / static_cast<double>(round));
      const double at_x = x + radius_ * d.cosine, at_y = y + radius_ * d.sine;
      for (std::size_t k = 0; k < up; ++k) {
        const double z = step.low_z + height * (static_cast<double>(k) + 0.5) / static_cast<double>(up);
        if (!add({at_x, at_y, z}, {pitch.x * d.cosine, pitch.y * d.sine, 0}, heat, body, placed) &&
            !add({at_x, at_y, step.low_z}, {0, 0, -pitch.z}, heat, body, placed))
          placed.nowhere += heat;
      }
    }
  }

  /// A disc is nine places of equal parts.
  void heat_floor(const heat::CutStep& step, const heat::Body& body, Placed& placed) const {
    constexpr int kRing = 8;
    const double x = (step.from[0] + step.to[0]) / 2, y = (step.from[1] + step.to[1]) / 2;
    const double heat = step.work_j.middle() / (kRing + 1);
    for (int k = 0; k <= kRing; ++k) {
      const double off = k < kRing ? 0.7 * radius_ : 0;
      const auto d = geom::sincos(k * kTurn / kRing);
      if (!add({x + off * d.cosine, y + off * d.sine, step.low_z}, {0, 0, -found_.grid.pitch.z}, heat, body,
               placed))
        placed.nowhere += heat;
    }
  }

  const HeatJob& job_;
  const HeatFound& found_;
  double radius_;
  StockBorder border_;
  std::vector<Span> spans_;
};

Interval hull(const Interval& a, double b) { return {std::min(a.least, b), std::max(a.greatest, b)}; }

constexpr Interval kNothing{std::numeric_limits<double>::infinity(),
                            -std::numeric_limits<double>::infinity()};

/// Returns the least and the greatest heat, as parts of that of the cases.
Interval heat_parts_of(const Interval& heat, double middle) {
  if (!(middle > 0)) return {1, 1};
  return {heat.least / middle, heat.greatest / middle};
}

/// \param share  the part of the middle work that is the heat of the case
HeatCase case_of(Run& run, double film, double share, const std::vector<WallPoint>& walls) {
  HeatCase one;
  one.film = film;
  for (const double e : run.errors_um) one.errors_um.push_back(share * e);
  one.moved_um = std::move(run.moved_um);
  for (auto& visits : one.moved_um)
    for (auto& moved : visits) moved = {share * moved[0], share * moved[1]};
  one.errors = summary_of(one.errors_um);
  one.scaling = best_scaling(walls, one.errors_um);
  one.warmest_k = share * run.warmest_k, one.stress_mpa = share * run.stress_mpa;
  one.stress_at = run.stress_at, one.stress_seconds = run.stress_seconds;
  one.half_s = run.half_s, one.tenth_s = run.tenth_s;
  one.book = run.book;
  for (double* j : {&one.book.in, &one.book.lost, &one.book.removed, &one.book.stored}) *j *= share;
  one.not_placed_j = share * run.not_placed_j;
  one.rises_k = run.rises_k;
  return one;
}

/// Returns the hull of a figure of all cases at both ends and at the middle of their heat, `of(case, part)`.
template <class F>
Interval over(const HeatFound& found, F of) {
  Interval all = kNothing;
  for (const HeatCase& one : found.cases)
    for (const double part : {found.heat_parts.least, 1.0, found.heat_parts.greatest})
      all = hull(all, of(one, part));
  return all;
}

/// The same of errors, `of(case, part)`.
template <class F>
WallIntervals walls_over(const HeatFound& found, F of) {
  return {over(found, [&](const HeatCase& c, double part) { return of(c, part).least; }),
          over(found, [&](const HeatCase& c, double part) { return of(c, part).most; }),
          over(found, [&](const HeatCase& c, double part) { return of(c, part).mean; }),
          over(found, [&](const HeatCase& c, double part) { return of(c, part).largest(); })};
}

HeatSensitivity sensitivity_of(const HeatFound& found) {
  const double largest = found.middle().errors.largest();
  const auto by = [&](const Interval& figure) {
    if (!(figure.middle() > 0)) return Interval{largest, largest};
    // No figure takes the heat beyond what measurements leave of it.
    const Interval parts{std::max(figure.least / figure.middle(), found.heat_parts.least),
                         std::min(figure.greatest / figure.middle(), found.heat_parts.greatest)};
    return Interval{largest * parts.least, largest * parts.greatest};
  };
  Interval film = kNothing;
  for (const HeatCase& one : found.cases) film = hull(film, one.errors.largest());
  return {by(found.share), by(found.source.work.work_j), film};
}

/// Takes the cases together. \param usual  the run of the middle one
void take(const Run& usual, HeatFound& found) {
  const HeatCase& middle = found.middle();
  for (std::size_t i = 0; i < found.walls.size(); ++i) {
    WallPoint& w = found.walls[i];
    w.error_um = middle.errors_um[i], w.seconds = usual.decided[i];
    w.errors_um = over(found, [&](const HeatCase& c, double part) { return part * c.errors_um[i]; });
  }
  found.errors = middle.errors, found.scaling = middle.scaling;
  found.errors_over = walls_over(found, [](const HeatCase& c, double part) {
    return WallErrors{part * c.errors.least, part * c.errors.most, part * c.errors.mean};
  });
  found.largest_um = found.errors_over.largest;
  found.factors =
      over(found, [](const HeatCase& c, double part) { return 1 + part * (c.scaling.factor - 1); });
  found.scaled_over = walls_over(found, [&](const HeatCase& c, double part) {
    return summary_of(scaled(found.walls, c.errors_um, part, found.scaling));
  });
  found.warmest_k = over(found, [](const HeatCase& c, double part) { return part * c.warmest_k; });
  found.stress_mpa = over(found, [](const HeatCase& c, double part) { return part * c.stress_mpa; });
  found.book = middle.book, found.not_placed_j = middle.not_placed_j;
}

}  // namespace

Result<HeatFound> heat(const HeatJob& job, const PhaseListener& phases) {
  const Interval share = job.material[Property::share];
  HeatSourceJob source = job.source;
  source.cutting.cutting_force = job.material[Property::cutting_force];
  source.cutting.force_exponent = job.material[Property::force_exponent];
  source.cutting.share = share;
  HeatFound found;
  LEKALO_TRY(found.source, heat_source(source, phases));
  const double top = source.machining.top;
  const heat::StockBox& box = found.source.stock.box;
  LEKALO_TRY(found.grid, heat::Grid::divide({box.low_x, box.low_y, top - box.thickness},
                                            {box.high_x, box.high_y, top}, job.pitch));
  LEKALO_CHECK(check_voxels(job, found.source));
  LEKALO_CHECK(check_datum(job, found.source));
  LEKALO_TRY(CutWalls walls, cut_walls(source, found.source, job.pitch));
  found.walls = std::move(walls.points), found.visits = std::move(walls.visits), found.uncut = walls.uncut;
  std::vector<std::pair<double, const char*>> films{{job.film.middle(), "heating"}};
  if (job.film.least < job.film.greatest)
    films = {{job.film.least, "heating, least cooling"},
             {job.film.middle(), "heating, mean cooling"},
             {job.film.greatest, "heating, greatest cooling"}};
  LEKALO_CHECK(check_measured(job, found.source));
  const Follower follower(job, found);
  std::vector<Run> runs;
  std::vector<std::vector<double>> rises;
  std::optional<HeatRecorder> recorder;
  if (job.record) recorder.emplace(found.grid, follower.steps());
  for (const auto& [film, words] : films) {
    const bool usual = runs.size() == films.size() / 2 && recorder;
    LEKALO_TRY(Run run, follower.run(film, begin_phase(phases, words), usual ? &*recorder : nullptr));
    found.work += run.work;
    rises.push_back(run.rises_k);
    runs.push_back(std::move(run));
  }
  LEKALO_TRY(const MeasuredHeat heat, measured_heat(job, found.source.work, rises));
  found.heat_j = heat.heat_j, found.share = heat.share, found.supported_j = heat.supported_j;
  found.heat_parts = heat_parts_of(heat.heat_j, heat.middle_share * found.source.work.work_j.middle());
  for (std::size_t i = 0; i < films.size(); ++i)
    found.cases.push_back(case_of(runs[i], films[i].first, heat.middle_share, found.walls));
  take(runs[films.size() / 2], found);
  if (recorder) {
    found.record = std::move(*recorder).take();
    found.record->scale(heat.middle_share);
  }
  found.sensitivity = sensitivity_of(found);
  if (const double least = job.ambient_c + found.warmest_k.least; least > job.material.limit_c())
    return failure(ErrorCode::bad_input,
                   fmt::format("{}: the workpiece gets {:.0f} degrees C warm at least, and the figures of {} "
                               "hold up to {:.0f}; cut less at a time, cool, or state a smaller share",
                               job.source.program.name, least, job.material.name, job.material.limit_c()));
  return found;
}

}  // namespace lekalo::jobs
