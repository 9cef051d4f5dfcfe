#include "solid_search.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "lekalo/base/parallel.hpp"
#include "solid_climb.hpp"
#include "solid_start.hpp"

namespace lekalo::locate {
namespace {

using solid::Motion;
using solid::Vector;

constexpr std::array<double Vector::*, 3> kAxes{&Vector::x, &Vector::y, &Vector::z};

/// So many boxes are halved at a time.
constexpr std::size_t kAtOnce = 4;
/// Contacts are looked for in one box this many times before it is halved; once where tan(angle / 2) of the
/// turn from its middle may be more than that, for there the next ones say as little.
constexpr int kRounds = 4;
constexpr double kWide = 0.15;
/// So many contacts of one pose are looked at, or at a glance, and so many are made known.
constexpr std::size_t kLooked = 24, kGlanced = 12, kMostNew = 12;
/// A box hands at most this many on to its halves.
constexpr std::size_t kMostKnown = 64;
/// A contact has to lower a bound by this part of the gap to be worth knowing.
constexpr double kWorthKnowing = 1.0 / 64;
/// A pose is looked at for what leaves it no more than the best has, and this part of the gap.
constexpr double kBetter = 1.0 / 16;
/// A climb goes on while it gains this part of the gap.
constexpr double kWorthClimbing = 1e-3;
/// The width of a side counts so much beside what it does to the terms of a bound.
constexpr double kWidthMatters = 1.0 / 16;
/// The trees over the meshes are told as this part of the whole, and with the first climb as that. How long
/// boxes take is not known before one is closed, so that more would promise an end.
constexpr double kTreesShare = 0.001, kClimbShare = 0.01;

/// Multipliers are whole numbers up to this, so that they take little room in files.
constexpr double kWhole = 1e9;
/// The window is written wider than it is by this part of its coordinates, so that rounding loses no pose of
/// it: the rounding of a form (solid_form.cpp) has room for so much.
constexpr double kOutwards = 0x1p-48;

double value_at(const LinearBound<6>& bound, const Steps& z) {
  double value = bound.level;
  for (std::size_t i = 0; i < 6; ++i) value += bound.slope[i] * z[i];
  return value;
}

}  // namespace

SolidSearch::SolidSearch(const SolidMeter& meter, const SolidOptions& options)
    : meter_(meter), options_(options), bounds_(meter) {
  for (const std::uint8_t chart : meter_.frame().charts) first_.push_back(first_box(chart));
  climb_first();
}

void SolidSearch::climb_first() {
  tell(kTreesShare);
  RunControl climbing = options_.run;
  if (climbing.progress)
    climbing.progress = [this](const Progress& climbed) {
      tell(kTreesShare + climbed.fraction * (kClimbShare - kTreesShare));
    };
  best_ = first_climb(meter_, size(meter_.frame().window), kWorthClimbing * options_.gap, climbing, work_);
  tell(kClimbShare);
}

/// The whole window of a chart. Six half-spaces are known of it that bound the blank, each with the part's
/// foremost vertex, so that every box has a bound; and the contacts in its middle.
SolidSearch::Node SolidSearch::first_box(std::uint8_t chart) {
  Node node;
  node.cell = meter_.frame().window;
  node.cell.low.chart = node.cell.high.chart = chart;
  node.number = static_cast<std::uint32_t>(tree_.size());
  tree_.emplace_back();
  const FramedPose middle = node.cell.middle();
  const Motion motion = meter_.frame().motion(middle);
  std::vector<SolidContact> contacts;
  (void)meter_.measure(middle, kInfinity, kLooked, contacts);
  ++work_;
  for (double Vector::*const axis : kAxes)
    for (const double side : {-1.0, 1.0}) {
      Vector normal;
      normal.*axis = side;
      SolidContact contact = meter_.foremost(motion, normal);
      const auto& of_blank = meter_.blank().vertices;
      contact.of_plane = meter_.convex();
      contact.blank = *std::min_element(of_blank.begin(), of_blank.end(),
                                        [&](Vector a, Vector b) { return side * a.*axis < side * b.*axis; });
      contacts.push_back(contact);
    }
  for (const SolidContact& contact : contacts) {
    auto made = bounds_.known(contact, middle);
    if (!made) continue;
    node.known.push_back(static_cast<std::uint32_t>(known_.size()));
    known_.push_back(std::move(*made));
  }
  return node;
}

double SolidSearch::size(const SolidCell& cell) const {
  const double reach = 2 * meter_.frame().reach;
  const FramedPose half = cell.half();
  const Vector x = reach * half.x;
  return std::max({half.at.x, half.at.y, half.at.z, x.x, x.y, x.z});
}

/// The pose next to one off a datum, on the way to the best one, that keeps all datums. Where allowances do
/// not change across a datum, programs are highest on its border, and all that they lead to lies just beyond
/// it.
std::optional<FramedPose> SolidSearch::drawn_in(const FramedPose& pose) const {
  constexpr double kNearest = 1.0 / 1024;
  if (!best_.inside || best_.pose.chart != pose.chart || meter_.keeps_datums(meter_.frame().motion(pose)))
    return std::nullopt;
  for (double share = kNearest; share < 1; share *= 2) {
    const FramedPose drawn{pose.x + share * (best_.pose.x - pose.x),
                           pose.at + share * (best_.pose.at - pose.at), pose.chart};
    if (meter_.keeps_datums(meter_.frame().motion(drawn))) return drawn;
  }
  return std::nullopt;
}

/// Bounds a box by the program of what is known. Where that is highest and nothing known is in the way of a
/// better pose, it makes known what a glance meets, or a measurement where that is nothing new.
void SolidSearch::bound(Node& node, Found& found) const {
  const CellView view(meter_, node.cell);
  const auto known = [&](std::uint32_t k) -> const KnownSolid& {
    return k < known_.size() ? known_[k] : found.known[k - known_.size()];
  };
  const auto proved = [&](const std::vector<Term>& terms) {
    PoseForm sum, open;
    double least = -kInfinity;
    for (const Term& term : terms) {
      const auto one = bounds_.form(known(term.known), term.choice, view);
      if (!one) return kInfinity;
      (one->open ? open : sum).add(term.multiplier / kWhole, one->form);
      least = std::max(least, one->least);
    }
    return std::max(least, bounds_.most(sum, open, view));
  };
  std::vector<SolidRow> rows;
  std::vector<std::uint32_t> of_row;
  std::vector<LinearBound<6>> program;
  const auto add = [&](const SolidRow& row, std::uint32_t k) {
    rows.push_back(row);
    of_row.push_back(k);
    program.push_back(row.bound);
  };
  for (const std::uint32_t k : node.known)
    if (const auto row = bounds_.row(known(k), view)) add(*row, k);
  node.upper = proved(node.terms);
  std::vector<SolidContact> contacts;
  std::vector<Term> terms;
  FramedPose pose = view.middle;
  LinearSolution<6> solution;
  solution.bound = kInfinity;
  // Says if a row leaves a pose no more than is had, by its term there: smaller boxes say as much then.
  const auto is_in_the_way = [&](const FramedPose& at) {
    const CellView there(meter_, {at, at});
    const double had = best_.inside ? best_.value : meter_.floor();
    // Rows of the place do not count: a program is highest where they are left by as much as boxes are bent.
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (rows[k].choice.kind != SolidTerm::Kind::near &&
          bounds_.level(known(of_row[k]), rows[k].choice, there) <= had)
        return true;
    return false;
  };
  // Makes known what lowers the program where it is highest. Returns how many do.
  const auto learn_contacts = [&] {
    std::stable_sort(contacts.begin(), contacts.end(),
                     [](const SolidContact& a, const SolidContact& b) { return a.margin() < b.margin(); });
    std::size_t added = 0;
    for (const SolidContact& contact : contacts) {
      if (added == kMostNew) break;
      if (contact.of_place() && contact.margin() > solution.bound) continue;
      auto made = bounds_.known(contact, pose);
      if (!made) continue;
      const auto row = bounds_.row(*made, view);
      if (!row || !(value_at(row->bound, solution.z) < solution.bound - kWorthKnowing * options_.gap))
        continue;
      const auto number = static_cast<std::uint32_t>(known_.size() + found.known.size());
      add(*row, number);
      found.known.push_back(std::move(*made));
      ++added;
    }
    return added;
  };
  for (int round = 0;; ++round) {
    if (!rows.empty()) {
      solution = solve_cell(program, view.half);
      ++found.work;
      terms.clear();
      // A row is a term in units of its demand's scale.
      std::array<double, 7> shares{};
      double all = 0;
      for (std::size_t j = 0; j < solution.rows; ++j)
        all += shares[j] = solution.multiplier[j] / rows[solution.row[j]].scale;
      if (!meter_.has_demands() && meter_.datums().empty() && meter_.nears().empty()) all = 1;
      for (std::size_t j = 0; j < solution.rows; ++j)
        if (const double share = std::round(kWhole * shares[j] / all); share > 0)
          terms.push_back(
              {of_row[solution.row[j]], rows[solution.row[j]].choice, static_cast<std::uint32_t>(share)});
      if (const double upper = proved(terms); upper < node.upper) node.upper = upper, node.terms = terms;
      // While no pose is inside, a box may yet prove that there is none.
      if (closed(node.upper) && (best_.inside || node.upper < options_.min_allowance)) return;
      const Steps& z = solution.z;
      const double turn = 0.5 / view.reach;
      pose = node.cell.held({view.middle.x + turn * Vector{z[3], z[4], z[5]},
                             view.middle.at + Vector{z[0], z[1], z[2]}, view.middle.chart});
    }
    if (round == (view.turn > kWide ? 1 : kRounds)) break;
    const double most = std::max(solution.bound, meter_.floor() + options_.gap);
    std::size_t added = 0;
    double met = kInfinity;
    // With datums it is tolerances that are in the way, as a rule, of which contacts know nothing.
    if (meter_.datums().empty()) {
      if (is_in_the_way(pose)) break;
      const auto glanced = glanced_unless_stopped(meter_, pose, most, kGlanced, options_.run, contacts);
      if (!glanced) break;
      ++found.work;
      met = *glanced;
      added = learn_contacts();
    }
    // Beside a noisy surface a measurement takes long, for much is nearly as near as the nearest. What leaves
    // the pose no more than the best has settles it.
    const bool is_noisy = !meter_.widths().empty() && best_.inside && meter_.datums().empty();
    const double first = is_noisy ? std::min(most, best_.value + kBetter * options_.gap) : most;
    if (added == 0 && met > best_.value && is_noisy) {
      met = std::min(met, meter_.probe(pose, first, contacts));
      ++found.work;
      added = learn_contacts();
    }
    if (added == 0 && met > best_.value) {
      auto here = measured_unless_stopped(meter_, pose, first, kLooked, options_.run, contacts);
      if (here && here->inside && here->value >= first && first < most) {
        ++found.work;
        here = measured_unless_stopped(meter_, pose, most, kLooked, options_.run, contacts);
      }
      if (!here) break;
      ++found.work;
      if (here->better_than(found.best)) found.best = *here;
      added = learn_contacts();
      if (const auto drawn = drawn_in(pose)) {
        const auto there = measured_unless_stopped(meter_, *drawn, most, kLooked, options_.run, contacts);
        if (!there) break;
        ++found.work;
        if (there->better_than(found.best)) found.best = *there;
      }
    }
    if (added == 0) break;
  }
  // Those that can be the least somewhere in the box are kept, the lowest ones first.
  std::vector<std::pair<double, std::uint32_t>> ranked;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    double lowest = program[k].level;
    for (std::size_t i = 0; i < 6; ++i) lowest -= std::abs(program[k].slope[i]) * view.half[i];
    if (lowest <= node.upper) ranked.emplace_back(program[k].level, of_row[k]);
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
  if (!found.best.better_than(best_)) return;
  best_ = found.best;
  if (options_.run.stop_requested()) return;
  RunControl climbing;
  climbing.stop = options_.run.stop;
  const MeasuredSolid climbed =
      climb(meter_, best_.pose, size(node.cell), kWorthClimbing * options_.gap, climbing, work_);
  if (climbed.better_than(best_)) best_ = climbed;
}

/// Adds what each side does to the terms of a box's bound, beside which its width is a small part.
void SolidSearch::add_effects(const Node& node, const CellView& view, Steps& matters) const {
  for (double& one : matters) one *= kWidthMatters;
  double all = 0;
  for (const Term& term : node.terms) all += term.multiplier;
  for (const Term& term : node.terms) {
    const auto made = bounds_.form(known_[term.known], term.choice, view);
    if (!made) continue;
    const Steps effects = made->form.effects(view);
    for (std::size_t k = 0; k < 6; ++k) matters[k] += term.multiplier / all * effects[k];
  }
}

/// Halves a box along its widest side; or, while no pose has what is demanded, along the one that changes the
/// terms of its bound most. Wide windows have few sides that matter.
std::array<SolidSearch::Node, 2> SolidSearch::halves(const Node& node) {
  const CellView view(meter_, node.cell);
  Steps matters = view.half;
  if (best_.value < options_.min_allowance) add_effects(node, view, matters);
  const auto widest =
      static_cast<std::size_t>(std::max_element(matters.begin(), matters.end()) - matters.begin());
  std::array<Node, 2> half{node, node};
  const auto along = [&](FramedPose& pose) -> double& {
    return widest < 3 ? pose.at.*kAxes[widest] : pose.x.*kAxes[widest - 3];
  };
  const double middle = 0.5 * (along(half[0].cell.low) + along(half[0].cell.high));
  along(half[0].cell.high) = along(half[1].cell.low) = middle;
  const auto first = static_cast<std::uint32_t>(tree_.size());
  tree_[node.number] = {static_cast<Axis>(widest), middle, first, 0};
  tree_.resize(tree_.size() + 2);
  half[0].number = first;
  half[1].number = first + 1;
  return half;
}

/// Takes over the terms of a box that is divided no more.
void SolidSearch::keep(const Node& node) {
  upper_ = std::max(upper_, node.upper);
  tree_[node.number].first = static_cast<std::uint32_t>(terms_.size());
  tree_[node.number].count = static_cast<std::uint32_t>(node.terms.size());
  terms_.insert(terms_.end(), node.terms.begin(), node.terms.end());
}

void SolidSearch::run() {
  const auto lower = [](const Node& a, const Node& b) {
    return a.upper != b.upper ? a.upper < b.upper : a.number > b.number;
  };
  std::vector<Node> open, batch = std::move(first_);
  // Boxes with turns both ways so wide have no bound.
  for (std::size_t k = 0; k < batch.size();) {
    if (CellView(meter_, batch[k].cell).least_scale >= 0.5) {
      ++k;
      continue;
    }
    auto [low, high] = halves(batch[k]);
    batch[k] = std::move(low);
    batch.push_back(std::move(high));
  }
  upper_ = -kInfinity;
  finished_ = true;
  for (;;) {
    std::vector<Found> found(batch.size());
    for (Found& one : found) one.best.value = -kInfinity;
    share_out(batch.size(), options_.threads, [&](std::size_t k) { bound(batch[k], found[k]); });
    std::uint32_t base = static_cast<std::uint32_t>(known_.size());
    const std::uint32_t before = base;
    for (std::size_t k = 0; k < batch.size(); ++k) {
      const auto renumber = [&](std::uint32_t& known) {
        if (known >= before) known += base - before;
      };
      for (std::uint32_t& known : batch[k].known) renumber(known);
      for (Term& term : batch[k].terms) renumber(term.known);
      base += static_cast<std::uint32_t>(found[k].known.size());
      learn(batch[k], found[k]);
    }
    for (Node& node : batch) {
      if (closed(node.upper)) {
        keep(node);
        count_closed(node.cell);
      } else {
        open.push_back(std::move(node));
        std::push_heap(open.begin(), open.end(), lower);
      }
    }
    tell(kClimbShare + (1 - kClimbShare) * std::min(1.0, closed_share_));
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
      for (Node& half : halves(node)) batch.push_back(std::move(half));
    }
  }
  for (const Node& node : open) keep(node);
}

SolidProof SolidSearch::proof() const {
  const SolidFrame& frame = meter_.frame();
  SolidProof made;
  made.pivot = frame.pivot;
  SolidTree whole;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto wider = [](double& low, double& high, double by) {
      if (by > 0) low -= by, high += by;
    };
    whole.low[k] = frame.window.low.at.*kAxes[k];
    whole.high[k] = frame.window.high.at.*kAxes[k];
    wider(whole.low[k], whole.high[k], kOutwards * meter_.far());
    whole.low[3 + k] = frame.window.low.x.*kAxes[k];
    whole.high[3 + k] = frame.window.high.x.*kAxes[k];
    wider(whole.low[3 + k], whole.high[3 + k], kOutwards * whole.high[3 + k]);
  }
  // Each ball and plane that is used has one place in its table, in the order of their first use.
  using Kind = SolidTerm::Kind;
  using Key = std::array<double, 4>;
  std::map<Key, std::uint32_t> part, points, blank, planes, datum_points, directions;
  std::map<std::array<double, 13>, std::uint32_t> bodies;
  const auto place = [](std::map<Key, std::uint32_t>& places, auto& table, const auto& one, Vector v,
                        double number) {
    const auto [at, added] =
        places.try_emplace({v.x, v.y, v.z, number}, static_cast<std::uint32_t>(table.size()));
    if (added) table.push_back(one);
    return at->second;
  };
  const auto term_of = [&](const Term& term) {
    const KnownSolid& known = known_[term.known];
    SolidTerm written{term.choice.kind, 0, 0, term.multiplier};
    switch (term.choice.kind) {
      case Kind::edges:
        written.part = known.edges->part_edge;
        written.blank = known.edges->blank_edge;
        return written;
      case Kind::datum: {
        const auto [at, u] = std::pair(known.held->point, known.held->direction);
        const Vector numbers{static_cast<double>(at.datum), static_cast<double>(at.point), 0};
        const SolidDatumPoint in_file{at.datum, meter_.datums()[at.datum].points[at.point].number};
        written.part = place(datum_points, made.datum_points, in_file, numbers, 0);
        written.blank = place(directions, made.directions, u, u, 0);
        return written;
      }
      case Kind::near: {
        const SolidPoint& at = known.on_part;
        const SolidBody& body = known.away->body;
        std::array<double, 13> numbers{body.apart};
        std::size_t next = 1;
        for (const Vector v : {body.at, body.a, body.b, body.c})
          for (const double Vector::*axis : kAxes) numbers[next++] = v.*axis;
        const auto [row, added] = bodies.try_emplace(numbers, static_cast<std::uint32_t>(made.bodies.size()));
        if (added) made.bodies.push_back(body);
        written.part = place(points, made.part_points, at, {static_cast<double>(at.triangle), at.u, at.v}, 0);
        written.blank = 6 * row->second + term.choice.part;
        return written;
      }
      case Kind::part_face:
        written.part = known.part_face->triangle;
        break;
      case Kind::point:
      case Kind::point_plane:
      case Kind::point_face: {
        const SolidPoint& at = known.on_part;
        written.part = place(points, made.part_points, at, {static_cast<double>(at.triangle), at.u, at.v}, 0);
        break;
      }
      default: {
        const SolidBall& ball = known.part[term.choice.part].ball;
        written.part = place(part, made.part_balls, ball, ball.centre, ball.radius);
      }
    }
    switch (term.choice.kind) {
      case Kind::face:
      case Kind::point_face:
        written.blank = known.blank_face->triangle;
        break;
      case Kind::plane:
      case Kind::point_plane:
        written.blank = place(planes, made.planes, known.plane, known.plane.normal, known.plane.least);
        break;
      default: {
        const SolidBall& ball = known.blank[term.choice.blank];
        written.blank = place(blank, made.blank_balls, ball, ball.centre, ball.radius);
      }
    }
    return written;
  };
  for (std::uint32_t root = 0; root < frame.charts.size(); ++root) {
    SolidTree tree = whole;
    tree.quaternion = frame.start_of(frame.charts[root]);
    std::vector<std::uint32_t> open{root};
    while (!open.empty()) {
      SolidTree::Node node = tree_[open.back()];
      open.pop_back();
      if (node.axis == Axis::leaf) {
        const auto first = static_cast<std::uint32_t>(tree.terms.size());
        for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
          tree.terms.push_back(term_of(terms_[k]));
        node.first = first;
      } else {
        open.push_back(node.first + 1);
        open.push_back(node.first);
        node.first = 0;
      }
      tree.nodes.push_back(node);
    }
    made.trees.push_back(std::move(tree));
  }
  return made;
}

double SolidSearch::upper() const noexcept {
  // If no pose keeps the datums any bound is proved, and one below all margins of poses inside is told.
  return upper_ > -kInfinity ? upper_ : meter_.floor() - options_.gap;
}

void SolidSearch::tell(double fraction) const {
  if (options_.run.progress) options_.run.progress({work_, fraction});
}

/// Adds the share that a closed box has of the window.
void SolidSearch::count_closed(const SolidCell& closed_cell) {
  const auto share = [](Vector part, Vector whole) {
    const auto of = [](double a, double b) { return b > 0 ? a / b : 1.0; };
    return of(part.x, whole.x) * of(part.y, whole.y) * of(part.z, whole.z);
  };
  const FramedPose whole = meter_.frame().window.half(), closed = closed_cell.half();
  closed_share_ += share(closed.at, whole.at) * share(closed.x, whole.x) /
                   static_cast<double>(meter_.frame().charts.size());
}

}  // namespace lekalo::locate
