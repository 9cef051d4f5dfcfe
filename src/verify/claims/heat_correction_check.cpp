#include "heat_correction_check.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lekalo/base/limits.hpp"
#include "verify/heat/wall_places.hpp"
#include "verify/read/known_fields.hpp"

namespace lekalo::verify {
namespace {

/// Pieces of the path are this part of the tool's diameter.
constexpr double kPieceOfTool = 0.125;
/// The most that a corrected program may go into the cold workpiece, um, and leave of the largest error.
constexpr double kMostInto = 1, kMostOfBefore = 0.2;
/// Distances may round to the other side of a limit, mm.
constexpr double kRoundedDistance = 1e-9;
/// Between places of walls, and in corners, the path may be moved by so many times as much, and by this, mm.
constexpr double kTimesMoved = 2, kMovedBesides = 1e-3;
/// A rapid beside walls may meet so much more of them, mm of path.
constexpr double kMoreRapid = 0.1;
/// So much more may be left between passes that are moved, mm across.
constexpr double kMoreUncut = 5e-3;

/// The tool at a place once: how far beyond the place to which the program comes, um, in which direction, and
/// the displacement of the workpiece in each case, um.
struct CorrectedVisit {
  double seconds{}, beyond{};
  std::array<double, 2> towards{};
  std::vector<double> moved;  ///< along X and Y, case by case
};
struct CorrectedWall {
  std::array<double, 3> at{};
  std::vector<CorrectedVisit> visits;
};

class CorrectionCheck : private HeldFigures {
 public:
  CorrectionCheck(const HeatCorrectionJob& job, const CutHistory& history, ReportFields& fields)
      : job_(job), history_(history), fields_(fields) {}

  Result<std::vector<std::string>> run(std::string& complaint) {
    LEKALO_TRY(const CutHistory corrected,
               cut_history(job_.corrected, *job_.followed.pocket, job_.options, job_.followed.earlier,
                           kPieceOfTool * job_.options.tool_diameter));
    read(corrected);
    if (complaint_.empty()) LEKALO_CHECK(check_walls(corrected));
    if (complaint_.empty()) check_errors();
    if (complaint_.empty()) LEKALO_CHECK(check_pocket());
    if (complaint.empty()) complaint = complaint_;
    return std::move(claims_.findings);
  }

 private:
  void read(const CutHistory& corrected) {
    ReportFields c(fields_.get("correction"), "correction", complaint_);
    if (!complaint_.empty()) return;
    if (!(c.number("finish_mm") > 0)) c.complain("field correction.finish_mm is not above 0");
    (void)c.index("rounds");
    ReportFields booked(c.get("booked"), c.name("booked"), complaint_);
    if (!complaint_.empty()) return;
    hold_booked(booked, booked_work(corrected, job_.stock, job_.cutting, job_.options.top));
    booked.refuse_others();
    c.each("walls", [&](Json item, const std::string& path) {
      ReportFields w(item, path, complaint_);
      if (!complaint_.empty()) return;
      CorrectedWall wall{w.numbers<3>("at_mm"), {}};
      w.each("visits",
             [&](Json visit, const std::string& at) { wall.visits.push_back(read_visit(visit, at)); });
      w.refuse_others();
      walls_.push_back(std::move(wall));
    });
    c.refuse_others();
    if (walls_.empty()) c.complain("field correction.walls is empty");
  }

  CorrectedVisit read_visit(Json item, const std::string& path) {
    ReportFields v(item, path, complaint_);
    CorrectedVisit visit;
    if (!complaint_.empty()) return visit;
    visit.seconds = v.number("seconds");
    v.each("moved_um",
           [&](Json number, const std::string& at) { visit.moved.push_back(v.number_of(number, at)); });
    if (visit.moved.size() != 2 * job_.cases)
      v.complain(fmt::format("field {} has {} numbers, and is to have {}", v.name("moved_um"),
                             visit.moved.size(), 2 * job_.cases));
    v.refuse_others();
    return visit;
  }

  /// Every place that the corrected program cuts is there once, with every visit.
  Result<void> check_walls(const CutHistory& corrected) {
    const Document& file = *job_.followed.pocket;
    LEKALO_TRY(const Json root, parse_json(file.bytes, file.name));
    std::string fault;
    const Shape pocket = read_shape(root, file.name, fault);
    if (!fault.empty()) return failure(ErrorCode::bad_input, fault);
    const double reach = job_.options.tool_diameter / 2 + job_.options.stock_to_leave;
    const auto places_of = [&](const CutHistory& history) {
      return WallPlaces(wall_stations(pocket, job_.spacing), history, job_.options.top, job_.stock.thickness,
                        reach, job_.spacing);
    };
    WallPlaces before = places_of(history_), after = places_of(corrected);
    if (before.heights() != after.heights()) {
      find("correction: the corrected program is not as deep as the program");
      return {};
    }
    std::vector<std::vector<std::size_t>> listed(after.stations() * after.heights());
    for (std::size_t i = 0; i < walls_.size(); ++i) {
      const auto& at = walls_[i].at;
      if (const auto which = after.find(at[0], at[1], at[2]))
        listed[which->station * after.heights() + which->height].push_back(i);
      else
        find(fmt::format("correction.walls[{}].at_mm is no place of a wall", i));
    }
    for (std::size_t s = 0; s < after.stations(); ++s) {
      if (claims_.findings.size() > kMostFaults) return {};
      before.go_to(s), after.go_to(s);
      for (std::size_t h = 0; h < after.heights(); ++h) {
        const std::vector<std::size_t>& here = listed[s * after.heights() + h];
        const WallPlaces::Cut cut = after.cut(h);
        if (!cut.near_limit && cut.is_cut == here.empty())
          find(fmt::format(
              "correction.walls has {} place at X {:.6f} Y {:.6f}, height {}, which the corrected "
              "program {}",
              here.empty() ? "no" : "a", after.station(s).x, after.station(s).y, h,
              cut.is_cut ? "cuts" : "does not cut"));
        if (here.size() > 1) find(fmt::format("correction.walls[{}] is there twice", here[1]));
        for (const std::size_t i : here) check_visits(i, h, before, after);
      }
    }
    return {};
  }

  void check_visits(std::size_t i, std::size_t height, const WallPlaces& before, const WallPlaces& after) {
    double nearest = HUGE_VAL;
    for (const WallPlaces::Visit& visit : before.visits(height, kRoundedDistance))
      nearest = std::min(nearest, visit.distance);
    if (!std::isfinite(nearest)) {
      find(fmt::format("correction.walls[{}] is a place that the program does not cut", i));
      return;
    }
    const auto holds = [](const WallPlaces::Visit& visit, const CorrectedVisit& said) {
      return visit.start - verify::kShown <= said.seconds && said.seconds <= visit.end + verify::kShown;
    };
    const std::vector<WallPlaces::Visit> wide = after.visits(height, kRoundedDistance);
    for (std::size_t k = 0; k < walls_[i].visits.size(); ++k) {
      CorrectedVisit& said = walls_[i].visits[k];
      const auto found =
          std::find_if(wide.begin(), wide.end(), [&](const auto& visit) { return holds(visit, said); });
      if (found == wide.end()) {
        find(fmt::format("correction.walls[{}].visits[{}].seconds: the tool does not cut the place then", i,
                         k));
        continue;
      }
      said.beyond = 1000 * (nearest - found->distance), said.towards = found->towards;
      most_beyond_ = std::max(most_beyond_, said.beyond);
      most_moved_ = std::max(most_moved_, std::abs(said.beyond));
    }
    for (const WallPlaces::Visit& visit : after.visits(height, -kRoundedDistance))
      if (std::none_of(walls_[i].visits.begin(), walls_[i].visits.end(),
                       [&](const CorrectedVisit& said) { return holds(visit, said); }))
        find(fmt::format("correction.walls[{}].visits has none at {:.3f} s, when the tool is there", i,
                         visit.start));
    if (walls_[i].visits.empty()) find(fmt::format("correction.walls[{}].visits is empty", i));
  }

  /// Returns the errors after the correction. At each place the visit counts that goes deepest.
  [[nodiscard]] ErrorSummary left(std::size_t which, double part) const {
    std::vector<double> errors;
    for (const CorrectedWall& wall : walls_) {
      double most = -HUGE_VAL;
      for (const CorrectedVisit& visit : wall.visits)
        most = std::max(most, visit.beyond - part * (visit.moved[2 * which] * visit.towards[0] +
                                                     visit.moved[2 * which + 1] * visit.towards[1]));
      errors.push_back(most);
    }
    return summary_of(errors);
  }

  void check_errors() {
    IntervalSummary over{
        {HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, -HUGE_VAL}};
    const auto take = [](CheckedRange& range, double value) {
      range = {std::min(range.least, value), std::max(range.greatest, value)};
    };
    for (std::size_t which = 0; which < job_.cases; ++which)
      for (const double part : {job_.parts.least, 1.0, job_.parts.greatest}) {
        const ErrorSummary s = left(which, part);
        take(over.least, s.least), take(over.most, s.most), take(over.mean, s.mean);
        take(over.largest, s.largest());
      }
    const double within = kWithin * (1 + job_.parts.greatest);
    const ErrorSummary middle = left(job_.cases / 2, 1);
    hold_summary(fields_, "after_correction_um", middle, within, true, over);
    if (!(job_.greatest_before > 0)) {
      if (job_.corrected.bytes != job_.followed.program->bytes)
        find("correction: without heat the corrected program has to be the program");
      return;
    }
    const auto forbid = [&](bool is, const std::string& what) {
      if (is) find("after_correction_um: the corrected program " + what);
    };
    forbid(over.most.greatest > kMostInto + within,
           fmt::format("goes {:.3f} um into the cold workpiece, and {:g} um are allowed", over.most.greatest,
                       kMostInto));
    forbid(middle.largest() > kMostOfBefore * job_.before + within,
           fmt::format("leaves {:.3f} um of {:.3f} um, more than a fifth", middle.largest(), job_.before));
    forbid(!(middle.largest() < job_.scaled + within),
           fmt::format("leaves {:.3f} um, and a scaling {:.3f} um", middle.largest(), job_.scaled));
    forbid(over.largest.greatest > job_.greatest_before + within,
           fmt::format("may leave {:.3f} um, and the program {:.3f} um", over.largest.greatest,
                       job_.greatest_before));
  }

  /// The corrected program is judged as any other: it leaves the pocket where it is moved out, and nowhere
  /// else, and leaves nothing uncut but by what it is moved.
  Result<void> check_pocket() {
    const auto judged = [&](const Document& program) {
      return simulate(program, *job_.followed.pocket, job_.options, job_.followed.earlier);
    };
    LEKALO_TRY(const SimulateReport before, judged(*job_.followed.program));
    LEKALO_TRY(const SimulateReport after, judged(job_.corrected));
    const double allowed = before.gouge_mm + kTimesMoved * most_beyond_ / 1000 + kMovedBesides;
    if (after.gouge_mm > allowed)
      find(
          fmt::format("correction: the corrected program leaves the pocket by {:.6f} mm, and its finishing "
                      "passes are moved by {:.6f} mm",
                      after.gouge_mm, most_beyond_ / 1000));
    const double wide = before.uncut_width_mm + kTimesMoved * most_moved_ / 1000 + kMoreUncut;
    if (after.uncut_width_mm > wide)
      find(fmt::format(
          "correction: the corrected program leaves a spot {:.4f} mm wide, and the program {:.4f} mm",
          after.uncut_width_mm, before.uncut_width_mm));
    if (after.rapid_cut_mm > before.rapid_cut_mm + kMoreRapid)
      find(fmt::format("correction: rapids of the corrected program meet material over {:.3f} mm of path",
                       after.rapid_cut_mm));
    return {};
  }

  const HeatCorrectionJob& job_;
  const CutHistory& history_;
  ReportFields& fields_;
  std::vector<CorrectedWall> walls_;
  double most_beyond_ = 0, most_moved_ = 0;  ///< um
};

}  // namespace

Result<std::vector<std::string>> correction_faults(const HeatCorrectionJob& job, const CutHistory& history,
                                                   ReportFields& fields, std::string& complaint) {
  return CorrectionCheck(job, history, fields).run(complaint);
}

}  // namespace lekalo::verify
