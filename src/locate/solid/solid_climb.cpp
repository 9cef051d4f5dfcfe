#include "solid_climb.hpp"

#include <limits>
#include <set>
#include <utility>

#include "lekalo/base/stop.hpp"
#include "locate/search/cell_program.hpp"

namespace lekalo::locate {
namespace {

using solid::Motion;
using solid::Vector;

constexpr int kMostSteps = 100;
/// A step that found new contacts is tried again with them, so many times, before it is made smaller.
constexpr int kMostTries = 3;
/// So many contacts of one pose are looked at.
constexpr std::size_t kContacts = 64;

LinearBound<6> row_of(const SolidFrame& frame, const Motion& motion, const SolidContact& contact) {
  const Vector n = 1 / contact.demand.scale * contact.normal,
               g = 1 / frame.reach * cross(motion.turned(contact.part - frame.pivot), n);
  return {{n.x, n.y, n.z, g.x, g.y, g.z}, contact.margin()};
}

/// The pairs of triangles that were near at some pose, in the order of their numbers.
using Pool = std::set<std::pair<std::uint32_t, std::uint32_t>>;

bool add(Pool& pool, const std::vector<SolidContact>& contacts) {
  bool added = false;
  for (const SolidContact& c : contacts)
    if (c.part_triangle != kNoTriangle)
      added = pool.insert({c.part_triangle, c.blank_triangle}).second || added;
  return added;
}

/// A pair of triangles says how to get away from the blank's surface on the side where the part is. Where
/// that is outside, it is the opposite of what helps, and the crossings say what does.
bool on_the_inner_side(const solid::Mesh& blank, const SolidContact& contact) {
  const auto& [i, j, k] = blank.triangles[contact.blank_triangle];
  const Vector a = blank.vertices[i];
  return dot(contact.normal, cross(blank.vertices[j] - a, blank.vertices[k] - a)) <= 0;
}

/// The rows of all known contacts at a pose.
std::vector<LinearBound<6>> rows_at(const SolidMeter& meter, const MeasuredSolid& at, const Pool& pool,
                                    const std::vector<SolidContact>& contacts) {
  const Motion motion = meter.frame().motion(at.pose);
  std::vector<LinearBound<6>> rows;
  for (const SolidContact& contact : contacts)
    if (contact.part_triangle == kNoTriangle) rows.push_back(row_of(meter.frame(), motion, contact));
  for (const auto& [part, blank] : pool) {
    const SolidContact contact = meter.contact(motion, part, blank);
    if (contact.directed() && (at.inside || on_the_inner_side(meter.blank(), contact)))
      rows.push_back(row_of(meter.frame(), motion, contact));
  }
  return rows;
}

template <class Found, class Look>
std::optional<Found> unless_stopped(const RunControl& run, const Look& look) {
  RunControl until_stop;
  until_stop.stop = run.stop;
  const Listening listening(until_stop);
  try {
    return look();
  } catch (const Stopped&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<MeasuredSolid> measured_unless_stopped(const SolidMeter& meter, const FramedPose& pose,
                                                     double most, std::size_t count, const RunControl& run,
                                                     std::vector<SolidContact>& contacts) {
  return unless_stopped<MeasuredSolid>(run, [&] { return meter.measure(pose, most, count, contacts); });
}

std::optional<double> glanced_unless_stopped(const SolidMeter& meter, const FramedPose& pose, double most,
                                             std::size_t count, const RunControl& run,
                                             std::vector<SolidContact>& contacts) {
  return unless_stopped<double>(run, [&] { return meter.glance(pose, most, count, contacts); });
}

MeasuredSolid climb(const SolidMeter& meter, const FramedPose& from, double trust, double enough,
                    const RunControl& run, std::uint64_t& work) {
  const SolidFrame& frame = meter.frame();
  std::vector<SolidContact> here, there;
  Pool pool;
  MeasuredSolid best = meter.measure(from, kInfinity, kContacts, here);
  // There is something to show from here on.
  const RunControl nobody;
  const Listening to_the_end(nobody);
  ++work;
  add(pool, here);
  const double widest = trust;
  int tries = 0;
  for (int step = 0; step < kMostSteps && !run.stop_requested(); ++step) {
    if (run.progress) run.progress({work, static_cast<double>(step) / kMostSteps});
    const auto rows = rows_at(meter, best, pool, here);
    if (rows.empty()) break;
    const LinearSolution<6> solution = solve_cell(rows, frame.trusted(trust));
    if (!(solution.bound > best.value + enough)) break;
    const auto next =
        measured_unless_stopped(meter, frame.moved(best.pose, solution.z),
                                std::max(solution.bound, meter.floor() + enough), kContacts, run, there);
    if (!next) break;
    work += 2;
    const bool added = add(pool, there);
    if (next->better_than(best)) {
      const double gained = next->value - best.value, hoped = solution.bound - best.value;
      best = *next;
      here = there;
      if (gained < 0.25 * hoped && !added) trust *= 0.5;
      if (gained > 0.75 * hoped) trust = std::min(widest, 2 * trust);
      tries = 0;
    } else if (!added || ++tries == kMostTries) {
      trust *= 0.25;
      tries = 0;
    }
  }
  return best;
}

std::vector<SolidTouch> holding_contacts(const SolidMeter& meter, const MeasuredSolid& at, double within) {
  const SolidFrame& frame = meter.frame();
  const Motion motion = frame.motion(at.pose);
  std::vector<SolidContact> contacts;
  (void)meter.measure(at.pose, std::max(at.value, meter.floor()) + within, kContacts, contacts);
  std::vector<SolidTouch> touches;
  if (contacts.empty()) return touches;
  std::vector<LinearBound<6>> rows;
  for (const SolidContact& contact : contacts) rows.push_back(row_of(frame, motion, contact));
  const LinearSolution<6> solution = solve_cell(rows, frame.trusted(within));
  for (std::size_t j = 0; j < solution.rows; ++j) {
    const SolidContact& c = contacts[solution.row[j]];
    if (c.datum != kNoTriangle) continue;
    touches.push_back(
        {c.part_triangle, c.blank_triangle, c.part, c.blank, c.distance, solution.multiplier[j]});
  }
  return touches;
}

}  // namespace lekalo::locate
