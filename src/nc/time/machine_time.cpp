#include "lekalo/nc/machine_time.hpp"

#include <fmt/core.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "lekalo/base/stop.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/nc/program.hpp"
#include "motion_plan.hpp"

namespace lekalo::nc {
namespace {

double value_of(const Decimal& number) {
  double power = 1;
  for (int i = 0; i < number.decimals; ++i) power *= 10;
  return static_cast<double>(number.digits) / power;
}

/// Follows a program, and plans its speeds from stop to stop.
class ProgramClock {
 public:
  ProgramClock(const std::string& name, double dwell_units_per_second, const MachineModel& machine)
      : name_(name), dwell_units_(dwell_units_per_second), machine_(machine) {}

  Result<TimedProgram> time(const Program& program) {
    if (!program.faults.empty()) return refused(program.faults.front().line, program.faults.front().reason);
    for (const Block& block : program.blocks) {
      ask();
      LEKALO_CHECK(act(block));
    }
    stop();
    return std::move(timed_);
  }

 private:
  [[nodiscard]] tl::unexpected<Error> refused(std::size_t line, const std::string& reason) const {
    return failure(ErrorCode::bad_input, fmt::format("{}:{}: {}", name_, line, reason));
  }

  /// The words of a block beside its modes.
  struct Said {
    std::optional<double> x, y, z, i, j, p;
    bool wait = false;
  };

  Result<void> act(const Block& block) {
    Said said;
    for (const Word& word : block.words) {
      const double value = value_of(word.value);
      switch (word.letter) {
        case 'G':
          LEKALO_CHECK(mode(block.line, value, said));
          break;
        case 'M':
          switch_by(block.line, value);
          break;
        case 'X':
          said.x = unit_ * value;
          break;
        case 'Y':
          said.y = unit_ * value;
          break;
        case 'Z':
          said.z = unit_ * value;
          break;
        case 'I':
          said.i = unit_ * value;
          break;
        case 'J':
          said.j = unit_ * value;
          break;
        case 'P':
          said.p = value;
          break;
        case 'F':
          feed_ = unit_ * value / 60;
          break;
        case 'S':
        case 'O':
        case 'T':
        case 'H':
          break;
        default:
          return refused(block.line, fmt::format("a profile program has no word {}", word.letter));
      }
    }
    if (said.wait) return wait(block.line, said);
    if (said.x || said.y || said.z) return move(block.line, said);
    return {};
  }

  Result<void> mode(std::size_t line, double code, Said& said) {
    if (code == 0 || code == 1 || code == 2 || code == 3)
      motion_ = static_cast<int>(code);
    else if (code == 4)
      said.wait = true;
    else if (code == 20 || code == 21)
      unit_ = code == 20 ? kMillimetresPerInch : 1;
    else if (code == 91)
      return refused(line, "a profile program has no G91");
    // Whatever else a profile program says is a mode that it keeps from beginning to end.
    return {};
  }

  /// A machine stands still where it is switched, and where a tool is changed, which is not timed.
  void switch_by(std::size_t line, double code) {
    if (code == 6) return stop();
    const bool on = code == 3 || code == 4;
    if (!on && code != 5) return;
    stop();
    if (on && !is_on_ && !has_z_) timed_.pierces.push_back(line);
    is_on_ = on;
  }

  Result<void> wait(std::size_t line, const Said& said) {
    if (!said.p) return refused(line, "a wait without its time");
    stop();
    timed_.motions.push_back({line, TimedKind::pierce, 0, *said.p / dwell_units_});
    return {};
  }

  Result<void> move(std::size_t line, const Said& said) {
    const SpaceVector from = at_;
    if (said.x) at_[0] = *said.x;
    if (said.y) at_[1] = *said.y;
    if (said.z) at_[2] = *said.z;
    const bool flat = at_[0] != from[0] || at_[1] != from[1];
    if (said.z) {
      // The first height is where the machine is taken to stand: no program says from where it comes.
      if (!std::exchange(has_z_, true)) return {};
      if (motion_ != 0 && from[2] >= 0 && at_[2] < 0) timed_.pierces.push_back(line);
    }
    const double feed = motion_ == 0 ? std::numeric_limits<double>::infinity() : feed_;
    if (!(feed > 0)) return refused(line, "a motion with a feed, and no F before it");
    const TimedKind kind = motion_ == 0 ? TimedKind::travel : flat ? TimedKind::cut : TimedKind::pierce;
    if (motion_ >= 2) {
      if (!said.i || !said.j || said.z) return refused(line, "an arc without I and J, or with Z");
      const PlannedMotion planned = arc(from, {from[0] + *said.i, from[1] + *said.j}, feed);
      if (!(planned.length_mm > 0)) return refused(line, "an arc about a point of it");
      add(line, kind, planned);
      return {};
    }
    SpaceVector way{at_[0] - from[0], at_[1] - from[1], at_[2] - from[2]};
    const double length = std::sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
    if (!(length > 0)) return {};
    for (double& one : way) one /= length;
    add(line, kind, {length, way, way, 0, feed});
    return {};
  }

  [[nodiscard]] PlannedMotion arc(const SpaceVector& from, const std::array<double, 2>& centre,
                                  double feed) const {
    const double side = motion_ == 3 ? 1 : -1;
    const auto from_centre = [&](const SpaceVector& p) {
      return std::array<double, 2>{p[0] - centre[0], p[1] - centre[1]};
    };
    const std::array<double, 2> a = from_centre(from), b = from_centre(at_);
    const double ra = std::sqrt(a[0] * a[0] + a[1] * a[1]), rb = std::sqrt(b[0] * b[0] + b[1] * b[1]);
    if (!(ra > 0 && rb > 0)) return {};
    const double radius = 0.5 * (ra + rb);
    double sweep = side * (geom::direction_angle(b[0], b[1]) - geom::direction_angle(a[0], a[1]));
    if (sweep <= 0) sweep += 2 * std::numbers::pi;
    const auto heading = [&](const std::array<double, 2>& arm, double r) {
      return SpaceVector{-side * arm[1] / r, side * arm[0] / r, 0};
    };
    return {radius * sweep, heading(a, ra), heading(b, rb), radius, feed};
  }

  void add(std::size_t line, TimedKind kind, const PlannedMotion& motion) {
    way_.push_back(motion);
    timed_.motions.push_back({line, kind, motion.length_mm, 0});
  }

  /// Ends the way that is open: its motions get their seconds.
  void stop() {
    if (way_.empty()) return;
    const std::vector<double> seconds = planned_seconds(way_, machine_);
    const std::size_t first = timed_.motions.size() - way_.size();
    for (std::size_t i = 0; i < seconds.size(); ++i) timed_.motions[first + i].seconds = seconds[i];
    way_.clear();
  }

  const std::string& name_;
  double dwell_units_;
  const MachineModel& machine_;
  TimedProgram timed_;
  std::vector<PlannedMotion> way_;  ///< since the last stop; the last of timed_.motions are these
  SpaceVector at_{};
  double unit_ = 1, feed_ = 0;
  int motion_ = 0;
  bool is_on_ = false, has_z_ = false;
};

}  // namespace

Result<TimedProgram> timed_program(std::string_view text, const std::string& name,
                                   double dwell_units_per_second, const MachineModel& machine) {
  return ProgramClock(name, dwell_units_per_second, machine).time(parse_program(text));
}

}  // namespace lekalo::nc
