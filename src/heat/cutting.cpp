#include "lekalo/heat/cutting.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lekalo::heat {
namespace {

constexpr double kJoulesPerNmm = 1e-3;
/// A rim that is open by less than this is not cut by a rapid but grazed by its rounding, mm2 a mm of path.
constexpr double kGrazed = 1e-3;

tl::unexpected<Error> refused(const std::string& sentence) { return failure(ErrorCode::bad_input, sentence); }

Interval operator*(const Interval& a, double b) { return {a.least * b, a.greatest * b}; }
Interval operator*(const Interval& a, const Interval& b) {
  return {a.least * b.least, a.greatest * b.greatest};  // of what is not below 0
}
void add(const Interval& what, Interval& sum) { sum.least += what.least, sum.greatest += what.greatest; }

class WorkOf {
 public:
  WorkOf(const CuttingConditions& conditions, double bottom_z)
      : c_(conditions), bottom_z_(bottom_z), teeth_per_second_(c_.spindle_rpm / 60 * c_.teeth) {}

  Result<CuttingWork> run(const std::vector<ToolPiece>& pieces) {
    for (const ToolPiece& piece : pieces) {
      made_.seconds = std::max(made_.seconds, piece.start + piece.seconds);
      const std::size_t before = made_.steps.size();
      if (piece.seconds > 0) add_steps(piece);
      if (made_.steps.size() == before) continue;
      if (piece.rapid && volume_since(before) > kGrazed * std::max(piece.length, 1.0))
        return refused(
            fmt::format("line {}: G0 cuts material, which no feed per tooth is known of; move with "
                        "G1 there",
                        piece.line));
      made_.cutting_seconds += piece.seconds;
      Interval work;
      for (std::size_t i = before; i < made_.steps.size(); ++i) add(made_.steps[i].work_j, work);
      const Interval power = work * (1 / piece.seconds);
      Interval& greatest = made_.greatest_power_w;
      greatest = {std::max(greatest.least, power.least), std::max(greatest.greatest, power.greatest)};
      add(work, made_.work_j);
    }
    made_.volume_mm3 = volume_since(0);
    if (made_.steps.empty()) return refused("the program cuts nothing of the stock");
    made_.into_workpiece_j = made_.work_j * c_.share;
    made_.carried_off_j = {made_.work_j.least * (1 - c_.share.greatest),
                           made_.work_j.greatest * (1 - c_.share.least)};
    return std::move(made_);
  }

 private:
  [[nodiscard]] double volume_since(std::size_t first) const {
    double volume = 0;
    for (std::size_t i = first; i < made_.steps.size(); ++i) volume += made_.steps[i].volume_mm3;
    return volume;
  }

  [[nodiscard]] static CutStep step_of(const ToolPiece& piece) {
    CutStep step;
    step.start = piece.start, step.seconds = piece.seconds;
    step.from = piece.from, step.to = piece.to, step.line = piece.line;
    return step;
  }

  void add_step(CutStep step) {
    if (!(step.volume_mm3 > 0 && step.chip_mm > 0)) return;
    step.work_j = specific_force(c_, step.chip_mm) * (step.volume_mm3 * kJoulesPerNmm);
    made_.steps.push_back(std::move(step));
  }

  void add_steps(const ToolPiece& piece) {
    const double feed = piece.length / piece.seconds / teeth_per_second_;
    for (const RimContact& contact : piece.rim) {
      CutStep step = step_of(piece);
      step.low_z = std::max(contact.low_z, bottom_z_), step.high_z = contact.high_z;
      step.begin = contact.begin, step.end = contact.end;
      step.chip_mm = mean_chip(feed, c_.tool_diameter / 2, contact.width, contact.end - contact.begin);
      step.volume_mm3 = contact.width * std::max(0.0, step.high_z - step.low_z) * piece.length;
      add_step(std::move(step));
    }
    const double high = piece.from[2], low = std::max(piece.to[2], bottom_z_);
    if (!(piece.floor_area > 0 && high > low)) return;
    CutStep step = step_of(piece);
    step.floor = true;
    step.low_z = low, step.high_z = high;
    step.chip_mm = (high - piece.to[2]) / piece.seconds / teeth_per_second_;
    step.volume_mm3 = piece.floor_area * (high - low);
    add_step(std::move(step));
  }

  const CuttingConditions& c_;
  double bottom_z_, teeth_per_second_;
  CuttingWork made_;
};

}  // namespace

double mean_chip(double feed_per_tooth, double radius, double width, double arc) noexcept {
  return arc > 0 ? feed_per_tooth * width / (radius * arc) : 0;
}

Interval specific_force(const CuttingConditions& c, double chip) noexcept {
  // A chip below 1 mm needs more where the exponent is larger, one above it less.
  const double a = std::pow(chip, -c.force_exponent.least), b = std::pow(chip, -c.force_exponent.greatest);
  return c.cutting_force * Interval{std::min(a, b), std::max(a, b)} * c.wear;
}

Result<void> check_conditions(const CuttingConditions& c) {
  if (!(c.teeth >= 1))
    return refused(fmt::format(
        "the tool has {} teeth; state how many there are, since chips have no thickness without", c.teeth));
  if (!(c.spindle_rpm > 0 && std::isfinite(c.spindle_rpm)))
    return refused(fmt::format(
        "the spindle turns {:g} times a minute; state its speed, since chips have no thickness without",
        c.spindle_rpm));
  if (!(c.tool_diameter > 0 && std::isfinite(c.tool_diameter)))
    return refused(fmt::format("the tool's diameter is {:g} mm; it has to be above 0", c.tool_diameter));
  if (!(c.cutting_force.least > 0 && c.cutting_force.least <= c.cutting_force.greatest))
    return refused(fmt::format("the cutting force k_c1.1 is {:g} to {:g} N/mm2; it has to be above 0",
                               c.cutting_force.least, c.cutting_force.greatest));
  if (!(c.wear.least >= 1 && c.wear.least <= c.wear.greatest && c.wear.greatest <= 5))
    return refused(
        fmt::format("wear makes the cutting force {:g} to {:g} times as large; it has to be from 1, "
                    "for a sharp edge, to 5",
                    c.wear.least, c.wear.greatest));
  if (!(c.share.least >= 0 && c.share.least <= c.share.greatest && c.share.greatest <= 1))
    return refused(
        fmt::format("the share of the power that heats the workpiece is {:g} to {:g}; it has to be "
                    "from 0 to 1",
                    c.share.least, c.share.greatest));
  return {};
}

Result<CuttingWork> cutting_work(const std::vector<ToolPiece>& pieces, const CuttingConditions& conditions,
                                 double bottom_z) {
  LEKALO_CHECK(check_conditions(conditions));
  return WorkOf(conditions, bottom_z).run(pieces);
}

}  // namespace lekalo::heat
