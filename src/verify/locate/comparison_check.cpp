#include "comparison_check.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "document.hpp"
#include "verify/number/interval.hpp"
#include "verify/read/fields.hpp"
#include "verify/read/text_rows.hpp"

namespace lekalo::verify {
namespace {

constexpr double kTurn = 6.283185307179586;
/// More pairs of points than these are not looked at.
constexpr double kMostPairs = 1e8;

class ComparisonCheck {
 public:
  ComparisonCheck(const WrittenComparison& c, const WrittenPlacement& now, const WrittenPlacement& last,
                  std::vector<std::string>& findings)
      : c_(c), now_(now), last_(last), findings_(findings) {}

  void run(bool same_part, const RoundedPoints& part) {
    if (c_.same_part != same_part)
      find("comparison.same_part is {}, but the two parts are {}", c_.same_part,
           same_part ? "one file" : "different files");
    check_difference("dx", c_.dx, now_.x, last_.x);
    check_difference("dy", c_.dy, now_.y, last_.y);
    if (compare(c_.last_clearance, last_.clearance) != 0)
      find("comparison.last_clearance is not that of the earlier result");
    check_turn();
    check_shift(part);
  }

 private:
  template <class... Args>
  void find(fmt::format_string<Args...> format, Args&&... args) {
    findings_.push_back(fmt::format(format, std::forward<Args>(args)...));
  }

  void check_difference(const char* field, const Decimal& written, const Decimal& a, const Decimal& b) {
    const double slack = kDerivedTolerance * std::max(std::abs(approximate(a)), std::abs(approximate(b)));
    if (!(std::abs(approximate(written - (a - b))) <= slack))
      find("comparison.{} is {}, but the two differ by {}", field, approximate(written), approximate(a - b));
  }

  void check_turn() {
    const double turned = approximate(now_.theta - last_.theta),
                 left = turned - std::round(turned / kTurn) * kTurn;
    const double dtheta = approximate(c_.dtheta), rounding = 1e-14 * (1 + std::abs(turned));
    // Half a turn is written as one to the left.
    const double off = std::min(std::abs(dtheta - left), std::abs(dtheta - left - kTurn));
    if (!(off <= rounding) || !(std::abs(dtheta) <= kTurn / 2 + rounding))
      find("comparison.dtheta is {}, but the two differ by {}", dtheta, left);
    const double degrees = dtheta * 360 / kTurn;
    if (!(std::abs(approximate(c_.dtheta_deg) - degrees) <= 1e-14 * std::abs(degrees)))
      find("comparison.dtheta_deg is {}, but dtheta means {}", approximate(c_.dtheta_deg), degrees);
  }

  /// No corner of the part moved further than the comparison says.
  void check_shift(const RoundedPoints& part) {
    const RoundedTurn before = rounded_turn(approximate(last_.theta)),
                      now = rounded_turn(approximate(now_.theta));
    const double cosine = now.cosine - before.cosine, sine = now.sine - before.sine;
    const double dx = approximate(now_.x - last_.x), dy = approximate(now_.y - last_.y);
    double most = 0, size = 1;
    for (const auto& [x, y] : part) {
      most = std::max(most, std::hypot(cosine * x - sine * y + dx, sine * x + cosine * y + dy));
      size = std::max({size, std::abs(x), std::abs(y)});
    }
    if (!(most <= approximate(c_.largest_shift) + 1e-14 * (size + most)))
      find("comparison.largest_shift is {} mm, but a corner of the part moved {} mm",
           approximate(c_.largest_shift), most);
  }

  const WrittenComparison& c_;
  const WrittenPlacement &now_, &last_;
  std::vector<std::string>& findings_;
};

/// Returns the distance of a point from a polygon, negative inside.
double outside(double x, double y, const RoundedPoints& polygon) {
  double near = std::numeric_limits<double>::infinity();
  int winding = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const auto& [ax, ay] = polygon[k];
    const auto& [bx, by] = polygon[(k + 1) % polygon.size()];
    const double ux = bx - ax, uy = by - ay, square = ux * ux + uy * uy;
    // A point that is repeated has an edge of no length, of which its beginning is near.
    const double along =
        ((x - ax) * ux + (y - ay) * uy) / std::max(square, std::numeric_limits<double>::min());
    const double t = std::clamp(along, 0.0, 1.0);
    near = std::min(near, std::hypot(x - ax - t * ux, y - ay - t * uy));
    const double side = ux * (y - ay) - uy * (x - ax);
    if (ay <= y && by > y && side > 0) ++winding;
    if (ay > y && by <= y && side < 0) --winding;
  }
  return winding != 0 ? -near : near;
}

}  // namespace

std::optional<WrittenPlacement> check_comparison(const ResultDocument& result, const Document& earlier,
                                                 const RoundedPoints& part,
                                                 std::vector<std::string>& findings) {
  const Result<Json> root = parse_json(earlier.bytes, earlier.name);
  if (!root) return findings.push_back(root.error().message), std::nullopt;
  std::string complaint, last_part;
  Fields fields(*root, "", complaint);
  const WrittenPlacement last{
      fields.number("x"), fields.number("y"), fields.number("theta"), {}, fields.number("clearance")};
  fields.each("inputs", [&](Json item, const std::string& path) {
    Fields input(item, path, complaint);
    if (input.text("role") == "part") last_part = input.text("sha256");
  });
  if (!complaint.empty())
    return findings.push_back(fmt::format("{}: {}", earlier.name, complaint)), std::nullopt;
  ComparisonCheck(*result.comparison, result.best, last, findings).run(last_part == result.part_sha256, part);
  return last;
}

namespace {

/// Holds a table of deviations: a line for each point of the blank, in the order of its file, with the
/// point's number and its place, which is that of the file but for the rounding of inches.
std::optional<std::string> fault_of_table(const Document& table, const RoundedPoints& blank,
                                          const std::vector<double>& off, double slack) {
  Lines lines(table.bytes);
  if (const auto head = lines.next(); !head || *head != "index,x,y,deviation")
    return "its first line is not index,x,y,deviation";
  for (std::size_t k = 0; k < blank.size(); ++k) {
    std::string_view rest = lines.next().value_or("");
    std::array<double, 4> numbers{};
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t end = i < 3 ? rest.find(',') : rest.size();
      const auto number = parse_decimal(rest.substr(0, end));
      if (!number || end == std::string_view::npos)
        return fmt::format("line {} is not four numbers", lines.number());
      numbers[i] = approximate(*number);
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    const auto& [x, y] = blank[k];
    const bool is_point = std::abs(numbers[1] - x) <= 0x1p-52 * std::abs(x) &&
                          std::abs(numbers[2] - y) <= 0x1p-52 * std::abs(y);
    if (numbers[0] != static_cast<double>(k) || !is_point)
      return fmt::format("line {} is not of point {} of the blank", lines.number(), k);
    if (!(std::abs(numbers[3] - off[k]) <= slack))
      return fmt::format("line {} says {} mm, but the point lies {} mm off the part", lines.number(),
                         numbers[3], off[k]);
  }
  if (lines.next()) return fmt::format("it goes on in line {}", lines.number());
  return std::nullopt;
}

}  // namespace

bool check_deviations(const ResultDocument& result, const std::optional<Document>& table,
                      const RoundedPoints& part, const RoundedPoints& blank,
                      std::vector<std::string>& findings, std::vector<std::string>& notes) {
  if (!result.deviations) return true;
  const WrittenDeviations& d = *result.deviations;
  if (d.points != blank.size())
    findings.push_back(
        fmt::format("deviations.points is {}, but the blank has {} points", d.points, blank.size()));
  if (static_cast<double>(part.size()) * static_cast<double>(blank.size()) > kMostPairs) {
    notes.emplace_back("the deviations were not rechecked: there are too many points");
    return false;
  }
  const RoundedTurn turn = rounded_turn(approximate(result.best.theta));
  const double x = approximate(result.best.x), y = approximate(result.best.y);
  double size = 1;
  std::vector<double> off;
  for (const auto& [px, py] : blank) {
    // Distances are the same in the part's frame.
    off.push_back(outside(turn.cosine * (px - x) + turn.sine * (py - y),
                          turn.cosine * (py - y) - turn.sine * (px - x), part));
    size = std::max({size, std::abs(px), std::abs(py)});
  }
  const double slack = 1e-12 * size;
  const auto [least, greatest] = std::minmax_element(off.begin(), off.end());
  if (!(std::abs(approximate(d.least) - *least) <= slack) ||
      !(std::abs(approximate(d.greatest) - *greatest) <= slack))
    findings.push_back(fmt::format(
        "deviations run from {} to {} mm, but the blank's points lie from {} to {} mm off the part",
        approximate(d.least), approximate(d.greatest), *least, *greatest));
  if (!table) {
    notes.emplace_back("the table of deviations was not rechecked: it is not there");
    return false;
  }
  if (const auto fault = fault_of_table(*table, blank, off, slack))
    findings.push_back(fmt::format("{} is not the table of deviations: {}", table->name, *fault));
  return true;
}

}  // namespace lekalo::verify
