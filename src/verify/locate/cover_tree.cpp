#include "cover_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "grown_ball.hpp"
#include "lekalo/base/limits.hpp"
#include "verify/number/interval.hpp"
#include "verify/number/surely.hpp"
#include "verify/shape/shape_distance.hpp"
#include "verify/shape/shape_inside.hpp"

namespace lekalo::verify {
namespace {

/// A leaf whose bound is not good enough over the whole cell is halved, and halved again, at most this often.
constexpr int kMostHalvings = 18;
/// After this many leaves that prove too little the certificate has failed, and the other leaves are only
/// read.
constexpr std::size_t kMostFailures = 3;
/// A certificate that needs more cells than this in all, beyond so many for each leaf, counts as none.
constexpr std::size_t kMostCells = 1'000'000, kMostCellsALeaf = 64;
/// The directions that a cell is split along.
constexpr std::array<std::string_view, 3> kAxes{"theta", "x", "y"};
/// A leaf has at most this many terms.
constexpr std::size_t kMostTerms = 8;

/// Converts degrees to radians.
Span radians(const Decimal& degrees) {
  const Precision wide = 128 + angle_bits(degrees);
  const Interval angle = Interval(degrees, wide) * Interval::pi(wide) / Interval(Integer(180), wide);
  return {angle.low_double(), angle.high_double()};
}

/// Growing a part joins points that are this share of the coordinates and growths apart, and the solver adds
/// a little more than that to its bounds (edge_error in docs/design/boolean.md).
constexpr double kJoined = 0x1p-39 * (1 - 0x1p-10);

double largest_coordinate(const Shape& shape) {
  return std::max({shape.high_x, -shape.low_x, shape.high_y, -shape.low_y});
}

}  // namespace

CoverTree::CoverTree(const Problem& problem, std::vector<std::string>& findings)
    : problem_(problem), findings_(findings), growth_(problem.growth) {
  const double most = growth_.empty() ? 0 : *std::max_element(growth_.begin(), growth_.end());
  if (!(most > 0)) return;
  joined_ = kJoined * std::max(most, largest_coordinate(problem.part));
  for (double& by : growth_)
    if (by > 0) by = (just(by) + just(joined_)).low;
}

void CoverTree::check(Json tree, const std::string& path, std::string& complaint) {
  Fields fields(tree, path, complaint);
  mirrored_ = fields.get("mirrored").is_true();
  const auto range = [&](std::string_view key) {
    std::vector<Decimal> ends;
    fields.each(key, [&](Json item, const std::string& at) { ends.push_back(fields.number_of(item, at)); });
    if (ends.size() != 2)
      return fields.complain(fmt::format("{} is not two numbers", fields.name(key))), Span{};
    for (const Decimal& end : ends)
      if (!(std::abs(approximate(end)) <= limits::kLargestDerived))
        fields.complain(fmt::format("{} is beyond {}", fields.name(key), limits::kLargestDerived));
    return Span{enclosed(ends[0]).low, enclosed(ends[1]).high};
  };
  const Span theta = range("theta"), x = range("x"), y = range("y");
  const Json nodes = fields.get("nodes");
  if (!nodes.is_array()) fields.complain(fmt::format("{} is not a list", fields.name("nodes")));
  if (!complaint.empty()) return;
  const Cell root{{theta.low, x.low, y.low}, {theta.high, x.high, y.high}};
  check_root(root, path);

  std::vector<Cell> open{root};
  JsonItems items(nodes);
  for (std::size_t i = 0; const auto item = items.next(); ++i) {
    const std::string name = fmt::format("{}.nodes[{}]", path, i);
    if (open.empty()) return fields.complain(name + " is one more than the subdivision needs");
    const Cell cell = open.back();
    open.pop_back();
    // The item is ["x", at].
    if (item->is_array()) {
      JsonItems split(*item);
      const auto axis = split.next(), at = split.next();
      const std::string which = axis && axis->is_string() ? json_text(*axis) : "";
      const auto k = static_cast<std::size_t>(std::find(kAxes.begin(), kAxes.end(), which) - kAxes.begin());
      if (k == kAxes.size() || !at || split.next())
        return fields.complain(name + " is neither a split nor a leaf");
      const Span place = enclosed(fields.number_of(*at, name));
      Cell low = cell, high = cell;
      low.high[k] = place.high, high.low[k] = place.low;
      open.push_back(high);
      open.push_back(low);
      continue;
    }
    ++leaves_;
    std::vector<Term> terms;
    Fields leaf(*item, name, complaint);
    if (leaf.size() != 1) leaf.complain(name + " has more than its contacts");
    if (!read_leaf(leaf.get("contacts"), terms, complaint, name)) return;
    if (failed_ == kMostFailures || proved(cell, terms, 0)) continue;
    ++failed_;
    findings_.push_back(
        fmt::format("{}: its contacts do not prove that no placement with theta {} to {} and the pivot at x "
                    "{} to {}, y {} to "
                    "{} has more clearance than {} mm",
                    name, cell.low[0], cell.high[0], cell.low[1], cell.high[1], cell.low[2], cell.high[2],
                    problem_.bound));
  }
  if (!open.empty())
    findings_.push_back(
        fmt::format("{}: the subdivision ends early, {} cells are missing", path, open.size()));
}

/// The root must hold every pose of the window that could have more clearance than the bound.
void CoverTree::check_root(const Cell& root, const std::string& path) {
  const Span from = radians(problem_.window_from_deg), to = radians(problem_.window_to_deg);
  const Span whole = radians(Decimal{36, 1});
  const bool full = root.high[0] - root.low[0] >= whole.high;
  if (!full && !(root.low[0] <= from.low && root.high[0] >= to.high)) {
    findings_.push_back(
        fmt::format("{}: theta from {} to {} does not cover the window", path, root.low[0], root.high[0]));
  }
  // At such a pose the material lies in the blank, or sticks out by less than -bound, and the pivot is within
  // pivot_off of the material.
  const double more = step_up(problem_.pivot_off + std::max(0.0, -problem_.bound));
  const Shape& blank = problem_.blank;
  const auto covers = [&](std::size_t k, const std::optional<Decimal>& locked, double low, double high) {
    if (locked) return root.low[k] <= enclosed(*locked).low && root.high[k] >= enclosed(*locked).high;
    return root.low[k] <= plus(just(low), -more).low && root.high[k] >= plus(just(high), more).high;
  };
  if (!covers(1, problem_.locked_x, blank.low_x, blank.high_x) ||
      !covers(2, problem_.locked_y, blank.low_y, blank.high_y)) {
    findings_.push_back(fmt::format("{}: the box of the pivot does not cover the blank", path));
  }
}

bool CoverTree::read_leaf(Json contacts, std::vector<Term>& terms, std::string& complaint,
                          const std::string& path) {
  const auto complain = [&](std::string_view what) {
    if (complaint.empty()) complaint = fmt::format("{}: {}", path, what);
    return false;
  };
  if (!contacts.is_array()) return complain("it has no list of contacts");
  JsonItems items(contacts);
  while (const auto item = items.next()) {
    if (terms.size() == kMostTerms) return complain("it has more than eight contacts");
    if (!item->is_array()) return complain("a contact is not a list");
    std::array<Json, 8> value;
    std::array<Span, 8> number;
    JsonItems numbers(*item);
    std::size_t cap = problem_.caps.size();
    for (std::size_t k = 0; k < 7; ++k) {
      const auto next = numbers.next();
      const auto decimal = next ? parse_decimal(next->text) : std::nullopt;
      if (!decimal) return complain("a contact is not seven numbers");
      value[k] = *next, number[k] = enclosed(*decimal);
      if (!(number[k].low >= -limits::kLargestDerived && number[k].high <= limits::kLargestDerived))
        return complain("a contact is beyond all bounds");
      const bool may_be_negative = k != 2 && k != 5 && k != 6;
      if (!may_be_negative && sgn(decimal->digits) < 0)
        return complain("a radius or a multiplier is negative");
    }
    Term term;
    if (const auto eighth = numbers.next()) {
      const auto index = parse_decimal(eighth->text);
      if (!index || index->exponent < 0 || sgn(index->digits) < 0 ||
          !(approximate(*index) < static_cast<double>(problem_.caps.size())))
        return complain("a contact names no cap of the demands");
      cap = static_cast<std::size_t>(approximate(*index));
      term.capped = true;
    }
    if (numbers.next()) return complain("a contact has more than eight numbers");
    const Vec part{number[0], number[1]}, blank{number[3], number[4]};
    if (term.capped) {
      term.part_radius = -off_cap(part, problem_.caps[cap]);
      term.blank_radius =
          material_radius(value[3], value[4], value[5], blank, number[5].low) - problem_.caps[cap].most;
    } else {
      term.part_radius = part_radius(value[0], value[1], value[2], part, number[2].low);
      term.blank_radius = blank_radius(value[3], value[4], value[5], blank, number[5].low);
    }
    term.multiplier = number[6];
    term.part = part - problem_.pivot;
    if (mirrored_) term.part.x = {-term.part.x.high, -term.part.x.low};
    term.blank = blank;
    if (is_positive(term.multiplier)) terms.push_back(term);
  }
  return !terms.empty() || complain("its multipliers sum to nothing");
}

/// Returns how much of a ball's radius really lies in the part's material. The result is negative when the
/// ball's centre lies beside the material.
double CoverTree::part_radius(Json x, Json y, Json radius, const Vec& centre, double written) {
  const std::string key = fmt::format("{} {} {}", x.text, y.text, radius.text);
  const auto known = part_radii_.find(key);
  if (known != part_radii_.end()) return known->second;
  const double inside =
      growth_.empty() ? signed_distance(centre, problem_.part).low : grown_radius(centre, written);
  const double real = std::min(written, inside);
  return part_radii_.emplace(key, real).first->second;
}

/// Returns a radius about the centre that surely lies in the grown part, or minus a distance from which it
/// has a point. A way from a point of the part to what is not in the grown part crosses a side, and then goes
/// as far as that side is grown. The radius may be too small, never too large.
double CoverTree::grown_radius(const Vec& centre, double written) const {
  const std::vector<Side>& sides = problem_.part.sides;
  double through = kInfinity, grown = -kInfinity;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const Span d = distance(centre, sides[k]);
    const double by = growth_[k];
    through = std::min(through, (just(d.low) + just(by)).low);
    if (by >= 0) grown = std::max(grown, (just(by) - just(d.high)).low);
  }
  const std::optional<bool> in = holds(problem_.part, centre);
  const bool inside = in && *in;
  double radius = inside && through >= 0 ? std::max(grown, through) : grown;
  if (radius < written) radius = std::max(radius, grown_ball(problem_.part, growth_, centre, written));
  if (radius < 0) radius = std::max(radius, -off_rims(problem_.part, growth_, centre));
  return radius;
}

double CoverTree::off_cap(const Vec& point, const Cap& cap) const {
  double off = kInfinity;
  for (const std::size_t k : cap.sides) off = std::min(off, distance(point, problem_.part.sides[k]).high);
  return off;
}

/// Returns how much of a ball's radius really lies in the blank's material.
double CoverTree::material_radius(Json x, Json y, Json radius, const Vec& centre, double written) {
  const std::string key = fmt::format("{} {} {}", x.text, y.text, radius.text);
  const auto known = material_radii_.find(key);
  if (known != material_radii_.end()) return known->second;
  const double real = std::min(written, signed_distance(centre, problem_.blank).low);
  return material_radii_.emplace(key, real).first->second;
}

double CoverTree::blank_radius(Json x, Json y, Json radius, const Vec& centre, double written) {
  const std::string key = fmt::format("{} {} {}", x.text, y.text, radius.text);
  const auto known = blank_radii_.find(key);
  if (known != blank_radii_.end()) return known->second;
  const double empty = -signed_distance(centre, problem_.blank).high;
  double real = std::min(written, empty);
  if (joined_ > 0) real = (just(real) - just(joined_)).low;
  return blank_radii_.emplace(key, real).first->second;
}

bool CoverTree::proved(const Cell& cell, const std::vector<Term>& terms, int depth) {
  if (++cells_ > kMostCells + kMostCellsALeaf * leaves_) return false;
  const CellBound bound = bound_over(cell, terms);
  if (bound.everywhere <= problem_.bound) return true;
  if (depth == kMostHalvings || bound.in_the_middle > problem_.bound) return false;
  // A cell is halved along its widest direction, where turning counts at the largest lever.
  double lever = 0;
  for (const Term& term : terms) lever = std::max(lever, length(term.part).high);
  const std::array<double, 3> width{(cell.high[0] - cell.low[0]) * lever, cell.high[1] - cell.low[1],
                                    cell.high[2] - cell.low[2]};
  const auto k = static_cast<std::size_t>(std::max_element(width.begin(), width.end()) - width.begin());
  const double middle = cell.low[k] + 0.5 * (cell.high[k] - cell.low[k]);
  Cell low = cell, high = cell;
  low.high[k] = high.low[k] = middle;
  return proved(low, terms, depth + 1) && proved(high, terms, depth + 1);
}

}  // namespace lekalo::verify
