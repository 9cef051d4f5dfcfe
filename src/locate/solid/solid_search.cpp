#include "solid_search.hpp"

#include <algorithm>

#include "lekalo/base/parallel.hpp"
#include "solid_climb.hpp"

namespace lekalo::locate {
namespace {

using solid::Vector;

/// So many boxes are halved at a time.
constexpr std::size_t kAtOnce = 4;
/// Contacts are looked for in one box this many times before it is halved.
constexpr int kRounds = 4;
/// So many contacts of one pose are looked at, and so many are made known.
constexpr std::size_t kLooked = 24, kMostNew = 12;
/// A box hands at most this many on to its halves.
constexpr std::size_t kMostKnown = 64;
/// A contact has to lower a bound by this part of the gap to be worth knowing.
constexpr double kWorthKnowing = 1.0 / 64;
/// A climb goes on while it gains this part of the gap.
constexpr double kWorthClimbing = 1e-3;
/// The progress listener is called after this many units of work.
constexpr std::uint64_t kReportEvery = 256;

double value_at(const LinearBound<6>& bound, const Steps& z) {
  double value = bound.level;
  for (std::size_t i = 0; i < 6; ++i) value += bound.slope[i] * z[i];
  return value;
}

}  // namespace

SolidSearch::SolidSearch(const SolidMeter& meter, const SolidOptions& options)
    : meter_(meter), options_(options), bounds_(meter) {
  best_.value = -kInfinity;
}

double SolidSearch::size(const SolidCell& cell) const {
  const double reach = 2 * meter_.frame().reach;
  const Vector at = cell.half.at, x = cell.half.x;
  return std::max({at.x, at.y, at.z, reach * x.x, reach * x.y, reach * x.z});
}

/// Bounds a box by the program of what is known, measures where that is highest, and makes known what it
/// meets there.
void SolidSearch::bound(Node& node, Found& found) const {
  const SolidFrame& frame = meter_.frame();
  const CellView view(frame, node.cell);
  const auto known = [&](std::uint32_t k) -> const KnownSolid& {
    return k < known_.size() ? known_[k] : found.known[k - known_.size()];
  };
  std::vector<SolidRow> rows;
  std::vector<LinearBound<6>> program;
  const auto add = [&](const SolidRow& row) {
    rows.push_back(row);
    program.push_back(row.bound);
  };
  for (const std::uint32_t k : node.known) add(bounds_.row(known(k), view));
  std::vector<SolidContact> contacts;
  FramedPose pose = node.cell.middle;
  LinearSolution<6> solution;
  solution.bound = kInfinity;
  for (int round = 0;; ++round) {
    if (!rows.empty()) {
      solution = solve_cell(program, view.half);
      ++found.work;
      double proved = solution.bound;
      for (std::size_t j = 0; j < solution.rows; ++j)
        proved = std::max(proved, -rows[solution.row[j]].radius);
      node.upper = std::min(node.upper, proved + bounds_.rounding());
      if (closed(node.upper)) return;
      pose = frame.moved(node.cell.middle, solution.z, node.cell);
    }
    if (round == kRounds) break;
    const MeasuredSolid here =
        meter_.measure(pose, std::max(solution.bound, options_.gap), kLooked, contacts);
    ++found.work;
    if (here.value > found.best.value) found.best = here;
    std::stable_sort(contacts.begin(), contacts.end(),
                     [](const SolidContact& a, const SolidContact& b) { return a.distance < b.distance; });
    std::size_t added = 0;
    for (const SolidContact& contact : contacts) {
      if (added == kMostNew) break;
      KnownSolid made = bounds_.known(contact, frame.motion(pose));
      const SolidRow row = bounds_.row(made, view);
      if (!(value_at(row.bound, solution.z) < solution.bound - kWorthKnowing * options_.gap)) continue;
      add(row);
      node.known.push_back(static_cast<std::uint32_t>(known_.size() + found.known.size()));
      found.known.push_back(std::move(made));
      ++added;
    }
    if (added == 0) break;
  }
  // Those that can be the least somewhere in the box are kept, the lowest ones first.
  std::vector<std::pair<double, std::uint32_t>> ranked;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    double lowest = program[k].level;
    for (std::size_t i = 0; i < 6; ++i) lowest -= std::abs(program[k].slope[i]) * view.half[i];
    if (lowest <= node.upper) ranked.emplace_back(program[k].level, node.known[k]);
  }
  std::sort(ranked.begin(), ranked.end());
  if (ranked.size() > kMostKnown) ranked.resize(kMostKnown);
  node.known.clear();
  for (const auto& [level, k] : ranked) node.known.push_back(k);
}

/// Takes over what a box found. Only the thread that runs the search does this, box by box in their order.
void SolidSearch::learn(Node& node, Found& found) {
  ++boxes_;
  work_ += found.work;
  for (KnownSolid& known : found.known) known_.push_back(std::move(known));
  if (!(found.best.value > best_.value)) return;
  best_ = found.best;
  const MeasuredSolid climbed =
      climb(meter_, best_.pose, size(node.cell), kWorthClimbing * options_.gap, options_.run, work_);
  if (climbed.value > best_.value) best_ = climbed;
}

std::array<SolidSearch::Node, 2> SolidSearch::halves(const Node& node) const {
  const double reach = 2 * meter_.frame().reach;
  double Vector::*const axes[] = {&Vector::x, &Vector::y, &Vector::z};
  bool turns = false;
  double Vector::*widest = &Vector::x;
  double most = -1;
  for (double Vector::*const axis : axes) {
    if (node.cell.half.at.*axis > most) most = node.cell.half.at.*axis, widest = axis, turns = false;
    if (reach * node.cell.half.x.*axis > most)
      most = reach * node.cell.half.x.*axis, widest = axis, turns = true;
  }
  std::array<Node, 2> half{node, node};
  for (std::size_t k = 0; k < 2; ++k) {
    FramedPose &middle = half[k].cell.middle, &width = half[k].cell.half;
    double &m = turns ? middle.x.*widest : middle.at.*widest, &w = turns ? width.x.*widest : width.at.*widest;
    w *= 0.5;
    m += k == 0 ? -w : w;
  }
  return half;
}

void SolidSearch::run() {
  const auto lower = [](const Node& a, const Node& b) {
    return a.upper != b.upper ? a.upper < b.upper : a.number > b.number;
  };
  std::vector<Node> open, batch{{meter_.frame().window, kInfinity, 0, {}}};
  std::uint64_t numbers = 1;
  upper_ = -kInfinity;
  finished_ = true;
  for (;;) {
    std::vector<Found> found(batch.size());
    for (Found& one : found) one.best.value = -kInfinity;
    share_out(batch.size(), options_.threads, [&](std::size_t k) { bound(batch[k], found[k]); });
    std::uint32_t base = static_cast<std::uint32_t>(known_.size());
    const std::uint32_t before = base;
    for (std::size_t k = 0; k < batch.size(); ++k) {
      for (std::uint32_t& known : batch[k].known)
        if (known >= before) known += base - before;
      base += static_cast<std::uint32_t>(found[k].known.size());
      learn(batch[k], found[k]);
    }
    for (Node& node : batch) {
      if (closed(node.upper)) {
        upper_ = std::max(upper_, node.upper);
        report(node.cell);
      } else {
        open.push_back(std::move(node));
        std::push_heap(open.begin(), open.end(), lower);
      }
    }
    batch.clear();
    if (open.empty() || closed(open.front().upper)) break;
    if (work_ >= options_.run.work_limit || options_.run.stop_requested()) {
      finished_ = false;
      break;
    }
    while (!open.empty() && batch.size() < 2 * kAtOnce && !closed(open.front().upper)) {
      std::pop_heap(open.begin(), open.end(), lower);
      const Node node = std::move(open.back());
      open.pop_back();
      for (Node& half : halves(node)) {
        half.number = numbers++;
        batch.push_back(std::move(half));
      }
    }
  }
  for (const Node& node : open) upper_ = std::max(upper_, node.upper);
}

void SolidSearch::report(const SolidCell& closed_cell) {
  if (!options_.run.progress) return;
  const auto share = [](Vector part, Vector whole) {
    const auto of = [](double a, double b) { return b > 0 ? a / b : 1.0; };
    return of(part.x, whole.x) * of(part.y, whole.y) * of(part.z, whole.z);
  };
  const FramedPose& whole = meter_.frame().window.half;
  closed_share_ += share(closed_cell.half.at, whole.at) * share(closed_cell.half.x, whole.x);
  if (work_ < next_report_) return;
  next_report_ = work_ + kReportEvery;
  options_.run.progress({work_, std::min(1.0, closed_share_)});
}

}  // namespace lekalo::locate
