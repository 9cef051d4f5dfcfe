#include "solid_climb.hpp"

#include <algorithm>
#include <utility>

#include "lekalo/base/stop.hpp"
#include "solid_rows.hpp"

namespace lekalo::locate {
namespace {

using solid::Motion;
using solid::Vector;

constexpr int kMostSteps = 100;
/// So many contacts of one pose are looked at, and at a glance.
constexpr std::size_t kContacts = 64, kGlanced = 24, kMissed = 12;
/// Glances lead up first, as long as they gain so many times what a climb goes on for. What they missed is
/// measured, so many times at most.
constexpr int kMostGlances = 24, kMostLeads = 6;
constexpr double kGlancedGain = 16;
/// They end where their steps become shorter than this part of the first.
constexpr double kShortest = 1.0 / 256;

/// The rows of all known contacts at a pose.
std::vector<LinearBound<6>> rows_at(const SolidMeter& meter, const FramedPose& pose, bool inside,
                                    const ContactPool& pool, const std::vector<SolidContact>& contacts) {
  const Motion motion = meter.frame().motion(pose);
  std::vector<LinearBound<6>> rows;
  for (const SolidContact& contact : contacts_at(meter, pose, inside, pool, contacts))
    rows.push_back(row_of(meter.frame(), motion, contact));
  return rows;
}

/// A pose to measure, with the margin that it may have.
struct Lead {
  FramedPose pose;
  double most = kInfinity;
};

/// A pose as glances see it.
struct Glanced {
  FramedPose pose;
  double value = -kInfinity;
  bool inside = false;
  std::vector<LinearBound<6>> rows;
  std::vector<SolidContact> contacts;

  /// Works out what the pose is worth by all contacts that are known by now.
  void weigh(const SolidMeter& meter, const ContactPool& pool) {
    inside = std::all_of(contacts.begin(), contacts.end(),
                         [](const SolidContact& c) { return c.part_triangle != kNoTriangle; });
    rows = rows_at(meter, pose, inside, pool, contacts);
    value = kInfinity;
    for (const LinearBound<6>& row : rows) value = std::min(value, row.level);
  }
};

/// Climbs by what glances and the contacts that are known say, with no measurement, as long as that seems to
/// gain `enough`.
Lead led_up(const SolidMeter& meter, const FramedPose& from, double enough, const RunControl& run,
            double widest, ContactPool& pool, std::uint64_t& work) {
  const SolidFrame& frame = meter.frame();
  Trust trust{widest};
  Glanced here, there;
  const auto look = [&](Glanced& at, const FramedPose& pose, double most) {
    at.pose = pose;
    if (!glanced_unless_stopped(meter, pose, most, kGlanced, run, at.contacts)) return false;
    ++work;
    return true;
  };
  if (!look(here, from, kInfinity)) return {from};
  pool.add(here.contacts);
  Lead lead{from};
  for (int step = 0; step < kMostGlances && trust.reach >= kShortest * widest && !run.stop_requested();
       ++step) {
    if (run.progress) run.progress({work, 0});
    here.weigh(meter, pool);
    lead = {here.pose};
    if (here.rows.empty()) break;
    const LinearSolution<6> solution = solve_cell(here.rows, frame.trusted(trust.reach));
    const double most = std::max(solution.bound, meter.floor() + enough);
    if (here.inside) lead.most = most;
    if (!(solution.bound > here.value + enough)) break;
    if (!look(there, frame.moved(here.pose, solution.z), most)) break;
    const bool added = pool.add(there.contacts);
    there.weigh(meter, pool);
    if (there.inside != here.inside ? there.inside : there.value > here.value) {
      trust.was_better(there.value - here.value, solution.bound - here.value, added);
      std::swap(here, there);
    } else {
      trust.was_no_better(added);
    }
  }
  return lead;
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

MeasuredSolid climb(const SolidMeter& meter, const FramedPose& from, double widest, double enough,
                    const RunControl& run, std::uint64_t& work) {
  const SolidFrame& frame = meter.frame();
  std::vector<SolidContact> here, there;
  ContactPool pool;
  Lead lead{from};
  const RunControl nobody;
  std::optional<Listening> to_the_end;
  if (meter.datums().empty() && meter.nears().empty() && !meter.convex()) {
    lead = led_up(meter, from, kGlancedGain * enough, run, widest, pool, work);
    // They were told of, so there has to be something to show.
    to_the_end.emplace(nobody);
  }
  MeasuredSolid best = meter.measure(lead.pose, lead.most, lead.most < kInfinity ? kMissed : kContacts, here);
  // There is something to show from here on.
  if (!to_the_end) to_the_end.emplace(nobody);
  ++work;
  for (int more = 1; pool.add(here) && best.inside && lead.most < kInfinity && more < kMostLeads; ++more) {
    lead = led_up(meter, best.pose, kGlancedGain * enough, run, widest, pool, work);
    const auto next = measured_unless_stopped(meter, lead.pose, lead.most, kMissed, run, there);
    if (!next) break;
    ++work;
    if (!next->better_than(best)) {
      pool.add(there);
      break;
    }
    best = *next;
    here = there;
  }
  Trust trust{widest};
  for (int step = 0; step < kMostSteps && !run.stop_requested(); ++step) {
    if (run.progress) run.progress({work, static_cast<double>(step) / kMostSteps});
    const auto rows = rows_at(meter, best.pose, best.inside, pool, here);
    if (rows.empty()) break;
    const LinearSolution<6> solution = solve_cell(rows, frame.trusted(trust.reach));
    if (!(solution.bound > best.value + enough)) break;
    const auto next =
        measured_unless_stopped(meter, frame.moved(best.pose, solution.z),
                                std::max(solution.bound, meter.floor() + enough), kContacts, run, there);
    if (!next) break;
    work += 2;
    const bool added = pool.add(there);
    if (next->better_than(best)) {
      trust.was_better(next->value - best.value, solution.bound - best.value, added);
      best = *next;
      here = there;
    } else {
      trust.was_no_better(added);
    }
  }
  return best;
}

std::vector<SolidTouch> holding_contacts(const SolidMeter& meter, const MeasuredSolid& at, double within) {
  const SolidFrame& frame = meter.frame();
  const Motion motion = frame.motion(at.pose);
  std::vector<SolidContact> contacts;
  (void)meter.measure_pairs(at.pose, std::max(at.value, meter.floor()) + within, kContacts, contacts);
  std::vector<SolidTouch> touches;
  if (contacts.empty()) return touches;
  std::vector<LinearBound<6>> rows;
  for (const SolidContact& contact : contacts) rows.push_back(row_of(frame, motion, contact));
  const LinearSolution<6> solution = solve_cell(rows, frame.trusted(within));
  for (std::size_t j = 0; j < solution.rows; ++j) {
    const SolidContact& c = contacts[solution.row[j]];
    if (c.of_place()) continue;
    touches.push_back({meter.number(c.part_triangle), c.blank_triangle, c.part, c.blank, c.distance,
                       solution.multiplier[j]});
  }
  return touches;
}

}  // namespace lekalo::locate
