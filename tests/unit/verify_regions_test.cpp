// The checker on hand-made results for regions: what is true is confirmed, each claim made slightly false is
// found.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "lekalo/verify/verify.hpp"
#include "verify/shape/shape_distance.hpp"
#include "verify/shape/shape_inside.hpp"

namespace lekalo::verify::verify_regions_test {
namespace {

/// The file of a region as a result writes it.
std::string file_of(const std::string& result, const std::string& role) {
  const std::size_t begin = result.find('{', result.find("\"" + role + "\":", result.find("\"regions\"")));
  std::size_t end = begin;
  for (int depth = 0; end < result.size(); ++end) {
    depth += result[end] == '{' ? 1 : result[end] == '}' ? -1 : 0;
    if (depth == 0) break;
  }
  return result.substr(begin, end + 1 - begin);
}

/// A ring of radii 5 and 10 in a ring of radii 4 and 12 about (100, 50): its clearance there is 1 mm.
struct Rings {
  std::string status = "optimal", mirror = "no", mirrored = "false";
  std::string x = "100", y = "50", theta = "0", theta_deg = "0", clearance = "1", upper = "1.001",
              gap = "0.001";
  std::string part_radius = "10", tolerances = R"({"part": 0, "blank": 0})";
  std::string contacts =
      R"([{"part_edge": 0, "blank_edge": 0, "part_at": [10, 0], "blank_at": [112, 50], "distance": 2, "multiplier": 1}])";
  std::string tree = leaf();
  std::string box = R"("theta": [0, 6.2831853071795872], "x": [88, 112], "y": [38, 62])";
  std::string part_file = "[]", pivot = "[0, 5]";

  static std::string circle(const std::string& x, const std::string& y, double radius) {
    const double from = std::stod(x) + radius;
    return fmt::format(
        R"([{{"arc": {{"from": [{0}, {1}], "to": [{0}, {1}], "centre": [{2}, {1}], "ccw": true}}}}])", from,
        y, x);
  }
  /// One cell for all poses: proves far less than the bound claimed.
  static std::string leaf() {
    return R"({"contacts": [[0, 5, 0, 100, 50, 4, 0.5], [0, -5, 0, 100, 50, 4, 0.5]]})";
  }
  [[nodiscard]] std::string part() const {
    return fmt::format(R"({{"units": "mm", "outer": {}, "holes": [{}]}})",
                       circle("0", "0", std::stod(part_radius)), circle("0", "0", 5));
  }
  [[nodiscard]] std::string text() const {
    const std::string blank = fmt::format(R"({{"units": "mm", "outer": {}, "holes": [{}]}})",
                                          circle("100", "50", 12), circle("100", "50", 4));
    return fmt::format(
        R"({{"format": {{"name": "lekalo-locate", "version": 1}}, "status": "{}", "units": "mm",
 "x": {}, "y": {}, "theta": {}, "theta_deg": {}, "mirrored": {}, "mirror": "{}", "clearance": {}, "upper_bound": {},
 "gap": {}, "min_allowance": 0, "shortfall": 0, "window_deg": [0, 360], "tolerances": {},
 "regions": {{"part": {}, "blank": {}}}, "contacts": {},
 "certificate": {{"pivot": {}, "trees": [{{"mirrored": false, {}, "nodes": [{}]}}]}}, "certificate_file": null,
 "locked": null, "demands": null, "scan": null, "part_cut": false, "largest_certificate": null,
 "trim": null, "nc": null, "comparison": null, "deviations": null}})",
        status, x, y, theta, theta_deg, mirrored, mirror, clearance, upper, gap, tolerances, part(), blank,
        contacts, pivot, box, tree);
  }
  [[nodiscard]] Result<LocateReport> report() const { return report_of(text()); }
  [[nodiscard]] Result<LocateReport> report_of(const std::string& result) const {
    const std::string part = part_file == "[]" ? file_of(result, "part") : part_file;
    return verify_locate({{"result.json", result},
                          {"part.json", part},
                          {"blank.json", file_of(result, "blank")},
                          std::nullopt});
  }
  [[nodiscard]] std::string first_finding() const {
    const auto checked = report();
    if (!checked) return "bad input: " + checked.error().message;
    return checked->findings.empty() ? "" : checked->findings.front();
  }
};

TEST(VerifyRegions, TheClearanceOfRingsIsKnownToTheLastDigits) {
  Rings rings;
  rings.clearance = "0.9999999999999", rings.gap = "0.0010000000001";
  auto report = rings.report();
  ASSERT_TRUE(report.has_value()) << report.error().message;
  EXPECT_NEAR(std::stod(report->clearance_low), 1, 1e-13);
  EXPECT_NEAR(std::stod(report->clearance_high), 1, 1e-13);
  for (const std::string& finding : report->findings)
    EXPECT_EQ(finding.find("clearance 0.9"), std::string::npos) << finding;
  rings.clearance = "1.0000000000001";
  EXPECT_NE(rings.first_finding().find("clearance 1.0000000000001 mm is above"), std::string::npos)
      << rings.first_finding();
}

TEST(VerifyRegions, AHoleUnderMaterialIsSeen) {
  Rings rings;
  rings.part_radius = "9";
  rings.x = "105";  // the part's hole has left the blank's: its material lies over it
  EXPECT_NE(rings.first_finding().find("sticks out of the blank by more"), std::string::npos)
      << rings.first_finding();
}

TEST(VerifyRegions, TouchingIsClearanceZeroOnlyWhereItIsProved) {
  Rings rings;
  rings.x = "101", rings.clearance = "0", rings.gap = "1.001";
  const auto found = [&] {
    const auto report = rings.report();
    std::string all = report ? "" : report.error().message;
    if (report)
      for (const std::string& finding : report->findings)
        if (finding.find("clearance is") == 0) all += finding;
    return all;
  };
  EXPECT_EQ(found(), "");
  rings.clearance = "1e-300";
  EXPECT_NE(found(), "");
  // Turned by anything there are no fractions, and what may be less than 0 is not 0.
  rings.clearance = "0", rings.theta = "1e-200";
  EXPECT_NE(found().find("meets the outline of the blank, or cannot be told from doing so"),
            std::string::npos)
      << found();
}

TEST(VerifyRegions, EveryFalseClaimIsFound) {
  const std::vector<std::pair<std::function<void(Rings&)>, std::string>> table{
      {[](Rings& r) { r.box = R"("theta": [0, 6.28], "x": [80, 120], "y": [30, 70])"; },
       "does not cover the window"},
      {[](Rings& r) { r.box = R"("theta": [0, 6.2831853071795872], "x": [89, 120], "y": [30, 70])"; },
       "the box of the pivot does not cover the blank"},
      // A pivot in the part's hole may be 5 mm beyond the blank.
      {[](Rings& r) {
         r.pivot = "[0, 0]", r.box = R"("theta": [0, 6.2831853071795872], "x": [84, 116], "y": [34, 66])";
       },
       "the box of the pivot does not cover the blank"},
      {[](Rings& r) { r.tree = R"(["x", 100], )" + Rings::leaf(); }, "the subdivision ends early"},
      {[](Rings& r) { r.tree = Rings::leaf() + ", " + Rings::leaf(); },
       "one more than the subdivision needs"},
      {[](Rings& r) { r.tree = R"({"contacts": [[0, 5, 0, 100, 50, 4, -1]]})"; }, "multiplier is negative"},
      {[](Rings& r) { r.tree = R"({"contacts": [[0, 5, 0, 100, 50, 4, 0]]})"; }, "sum to nothing"},
      {[](Rings& r) { r.tree = R"({"contacts": []})"; }, "sum to nothing"},
      {[](Rings& r) { r.tree = R"(["z", 100])"; }, "neither a split nor a leaf"},
      {[](Rings& r) { r.tree = R"({"contacts": [[0, 5, 0, 100, 50, 1e999, 1]]})"; }, "not seven numbers"},
      {[](Rings& r) { r.theta_deg = "1"; }, "theta_deg is 1"},
      {[](Rings& r) { r.gap = "0.1"; }, "gap is not upper_bound less clearance"},
      {[](Rings& r) { r.mirror = "yes"; }, "which was not allowed"},
      {[](Rings& r) { r.status = "infeasible"; }, "status is infeasible"},
      {[](Rings& r) { r.status = "fine"; }, "no status of a result"},
      {[](Rings& r) { r.tolerances = R"({"part": -1, "blank": 0})"; }, "tolerance is negative"},
      {[](Rings& r) { r.tolerances = R"({"part": 0.1, "blank": 0})"; }, "clearance 1 mm is above"},
      {[](Rings& r) {
         r.contacts =
             R"([{"part_edge": 0, "blank_edge": 0, "part_at": [10, 1], "blank_at": [112, 50], "distance": 2, "multiplier": 1}])";
       },
       "part_at is not on edge 0 of the part"},
      {[](Rings& r) {
         r.contacts =
             R"([{"part_edge": 0, "blank_edge": 0, "part_at": [10, 0], "blank_at": [112, 50], "distance": 2.1, "multiplier": 1}])";
       },
       "apart, not 2.1"},
      {[](Rings& r) { r.part_file = R"({"units": "mm", "outer": )" + Rings::circle("0", "0", 9) + "}"; },
       "the part used is not what part.json means: it has other edges"},
  };
  for (const auto& [falsify, expected] : table) {
    Rings rings;
    rings.box = R"("theta": [0, 6.2831853071795872], "x": [80, 120], "y": [30, 70])";
    falsify(rings);
    const auto report = rings.report();
    std::string all = report ? "" : report.error().message;
    if (report)
      for (const std::string& finding : report->findings) all += finding + "\n";
    EXPECT_NE(all.find(expected), std::string::npos) << expected << "\n" << all;
  }
}

/// A disc of 11 in a disc of 12 with a hole of 0.1 in its middle: no placement has more clearance than -0.1,
/// and the balls that prove it overlap by much more.
std::string pinned(const std::string& upper, const std::string& tolerance, const std::string& reach = "13") {
  const std::string outside = R"({"contacts": [[0, 0, 11, %, 988, 1]]})";
  const auto leaf = [&](const std::string& at) {
    std::string text = outside;
    return text.replace(text.find('%'), 1, at);
  };
  const std::string nodes = R"(["x", 7], ["x", -7], )" + leaf("-1000, 0") + R"(, ["y", 7], ["y", -7], )" +
                            leaf("0, -1000") + R"(, {"contacts": [[0, 0, 11, 0, 0, 0.1, 1]]}, )" +
                            leaf("0, 1000") + ", " + leaf("1000, 0");
  return fmt::format(
      R"({{"format": {{"name": "lekalo-locate", "version": 1}}, "status": "infeasible", "units": "mm", "x": 0, "y": 0,
 "theta": 0, "theta_deg": 0, "mirrored": false, "mirror": "no", "clearance": -0.5, "upper_bound": {}, "gap": {},
 "min_allowance": 0, "shortfall": 0.5, "window_deg": [0, 360], "tolerances": {{"part": {}, "blank": {}}},
 "regions": {{"part": {{"units": "mm", "outer": {}}}, "blank": {{"units": "mm", "outer": {}, "holes": [{}]}}}},
 "contacts": [], "certificate": {{"pivot": [0, 0], "trees": [{{"mirrored": false, "theta": [0, 6.2831853071795872],
 "x": [-{}, {}], "y": [-{}, {}], "nodes": [{}]}}]}}, "certificate_file": null,
 "locked": null, "demands": null, "scan": null, "part_cut": false, "largest_certificate": null,
 "trim": null, "nc": null, "comparison": null, "deviations": null}})",
      upper, std::stod(upper) + 0.5, tolerance, tolerance, Rings::circle("0", "0", 11),
      Rings::circle("0", "0", 12), Rings::circle("0", "0", 0.1), reach, reach, reach, reach, nodes);
}

/// What a result says nothing of it says with a null. Taken out, nobody knows what was claimed.
TEST(VerifyRegions, FieldsThatAreNullHaveToBeThere) {
  const std::string whole = Rings().text();
  for (const std::string key : {"locked", "demands", "scan", "largest_certificate", "certificate_file",
                                "trim", "nc", "comparison", "deviations"}) {
    std::string text = whole;
    const std::string field = fmt::format("\"{}\": null", key);
    const std::size_t at = text.find(field);
    ASSERT_NE(at, std::string::npos) << key;
    text.replace(at, field.size(), "\"warnings\": []");
    const auto report = Rings().report_of(text);
    ASSERT_FALSE(report) << key;
    EXPECT_NE(report.error().message.find(fmt::format("field {} is missing", key)), std::string::npos)
        << report.error().message;
  }
}

TEST(VerifyRegions, AWordThatNoRegionHasIsRefused) {
  const std::string outer = R"({"units": "mm", "name": "ring", )";
  for (const auto& [word, told] : std::vector<std::pair<std::string, std::string>>{
           {R"("islandss": [], )", "field islandss is not one of a region file"},
           {R"("date": 5, )", ""},
           {"", ""}}) {
    Rings rings;
    rings.part_file =
        outer + word + file_of(rings.text(), "part").substr(std::string(R"({"units": "mm", )").size());
    const auto report = rings.report();
    ASSERT_TRUE(report) << report.error().message;
    std::string all;
    for (const std::string& finding : report->findings) all += finding + "\n";
    EXPECT_NE(all.find(told), std::string::npos) << all;
    EXPECT_EQ(all.find("the part used is not") == std::string::npos, told.empty()) << all;
  }
}

TEST(VerifyRegions, HowADrawingWasReadIsSaidOfDrawingsAlone) {
  const auto with_drawings = [](const std::string& drawings) {
    std::string text = Rings().text();
    return text.insert(text.find("\"locked\""), "\"drawings\": " + drawings + ", ");
  };
  const auto all_of = [](const Result<LocateReport>& report) {
    std::string all = report ? "" : report.error().message;
    if (report)
      for (const std::string& finding : report->findings) all += finding + "\n";
    return all;
  };
  const std::string known = R"({"layers": [], "join": 0.01, "set_aside": []})";
  const std::string word = "it is no drawing";
  EXPECT_EQ(all_of(Rings().report_of(with_drawings(R"({"part": null, "blank": null})"))).find(word),
            std::string::npos);
  EXPECT_NE(all_of(Rings().report_of(with_drawings(R"({"part": 1, "blank": null})"))).find(word),
            std::string::npos);
  EXPECT_NE(all_of(Rings().report_of(with_drawings(R"({"part": null, "blank": )" + known + "}"))).find(word),
            std::string::npos);
  EXPECT_NE(all_of(Rings().report_of(with_drawings(R"({"part": null})"))).find("drawings.blank is missing"),
            std::string::npos);
}

TEST(VerifyRegions, ABallInTheBlanksHoleProvesNoMoreThanItsRadius) {
  const auto verdict = [](const std::string& upper, const std::string& tolerance) {
    const std::string text = pinned(upper, tolerance);
    const auto report = verify_locate({{"r", text},
                                       {"part.json", file_of(text, "part")},
                                       {"blank.json", file_of(text, "blank")},
                                       std::nullopt});
    EXPECT_TRUE(report.has_value()) << report.error().message;
    if (report && report->verdict == Verdict::refuted) {
      EXPECT_NE(report->findings.front().find("its contacts do not prove"), std::string::npos)
          << report->findings.front();
    }
    return report ? report->verdict : Verdict::unproved;
  };
  EXPECT_EQ(verdict("-0.099", "0"), Verdict::confirmed);
  // A part that sticks out by less than 0.099 may have its pivot as much beyond the blank.
  const std::string small = pinned("-0.099", "0", "12.09");
  const auto near = verify_locate({{"r", small},
                                   {"part.json", file_of(small, "part")},
                                   {"blank.json", file_of(small, "blank")},
                                   std::nullopt});
  ASSERT_TRUE(near.has_value());
  ASSERT_FALSE(near->findings.empty());
  EXPECT_NE(near->findings[0].find("the box of the pivot does not cover the blank"), std::string::npos);
  EXPECT_EQ(verdict("-0.101", "0"), Verdict::refuted);
  EXPECT_EQ(verdict("-0.4", "0"), Verdict::refuted);
  // The tolerances of part and blank come on top.
  EXPECT_EQ(verdict("-0.079", "0.01"), Verdict::confirmed);
  EXPECT_EQ(verdict("-0.081", "0.01"), Verdict::refuted);
}

/// A disc of 11 in one of 12, its x locked far from the origin, where steps of doubles are 1.2e-10 mm.
/// \returns the least bound that the nodes prove over a range of x
double least_proved(const std::string& at, const std::string& from, const std::string& to,
                    const std::string& nodes) {
  const auto proves = [&](double upper) {
    const std::string text = fmt::format(
        R"({{"format": {{"name": "lekalo-locate", "version": 1}}, "status": "optimal", "units": "mm", "x": {0}, "y": 0,
 "theta": 0, "theta_deg": 0, "mirrored": false, "mirror": "no", "clearance": 0.5, "upper_bound": {1}, "gap": {2},
 "min_allowance": 0, "shortfall": 0, "window_deg": [0, 0], "tolerances": {{"part": 0, "blank": 0}},
 "regions": {{"part": {{"units": "mm", "outer": {3}}}, "blank": {{"units": "mm", "outer": {4}}}}},
 "contacts": [], "certificate": {{"pivot": [0, 0], "trees": [{{"mirrored": false, "theta": [0, 0],
 "x": [{5}, {6}], "y": [0, 0], "nodes": [{7}]}}]}}, "certificate_file": null,
 "locked": {{"x": {0}, "y": 0}}, "demands": null, "scan": null, "part_cut": false, "largest_certificate": null,
 "trim": null, "nc": null, "comparison": null, "deviations": null}})",
        at, upper, upper - 0.5, Rings::circle("0", "0", 11), Rings::circle("1000000", "0", 12), from, to,
        nodes);
    const auto report = verify_locate({{"r", text},
                                       {"part.json", file_of(text, "part")},
                                       {"blank.json", file_of(text, "blank")},
                                       std::nullopt});
    EXPECT_TRUE(report.has_value()) << report.error().message;
    if (!report) return false;
    for (const std::string& finding : report->findings)
      EXPECT_NE(finding.find("its contacts do not prove"), std::string::npos) << finding;
    return report->verdict == Verdict::confirmed;
  };
  double low = 0.9, high = 1.1;
  EXPECT_FALSE(proves(low));
  EXPECT_TRUE(proves(high));
  while (0.5 * (low + high) != low && 0.5 * (low + high) != high)
    (proves(0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
  return high;
}

/// What a split leaves out, were it one step of a double, no other leaf would prove: each half needs what it
/// would need alone. The left leaf proves less the further right the part is, the right one the other way.
TEST(VerifyRegions, TheHalvesOfACellCoverAllOfIt) {
  const std::string left = R"({"contacts": [[0, 0, 11, 998988, 0, 1000, 1]]})";
  const std::string right = R"({"contacts": [[0, 0, 11, 1001012, 0, 1000, 1]]})";
  const std::string from = "999999.9999999997", to = "1000000.0000000003";
  // A double, and decimals between two of them.
  for (const std::string at : {"1000000", "999999.99999999995", "1000000.00000000007"}) {
    const double low = least_proved(at, from, at, left), high = least_proved(at, at, to, right);
    const std::string split = fmt::format(R"(["x", {}], {}, {})", at, left, right);
    EXPECT_EQ(least_proved(at, from, to, split), std::max(low, high)) << at;
  }
}

constexpr double kTurn = 6.283185307179586;

Span at(double value) { return {value, value}; }
Vec at(double x, double y) { return {at(x), at(y)}; }

Shape shape_of(const std::string& text) {
  std::string complaint;
  const auto json = parse_json(text, "shape");
  EXPECT_TRUE(json.has_value());
  Shape shape = read_shape(*json, "shape", complaint);
  EXPECT_EQ(complaint, "");
  return shape;
}

TEST(VerifyRegions, PointsOnGrazingRaysAreDecided) {
  // Level with corners, with the top of an arc and with its centre.
  const Shape keyhole = shape_of(R"({"units": "mm", "outer": [
    {"arc": {"from": [3, -4], "to": [-3, -4], "centre": [0, 0], "ccw": true}},
    {"line": {"from": [-3, -4], "to": [-3, -12]}}, {"line": {"from": [-3, -12], "to": [3, -12]}},
    {"line": {"from": [3, -12], "to": [3, -4]}}]})");
  for (const auto& [x, y, inside] : {std::tuple{0.0, 0.0, true},
                                     {-9.0, 5.0, false},
                                     {0.0, -4.0, true},
                                     {0.0, 4.5, true},
                                     {-20.0, 5.0, false},
                                     {-8.0, -4.0, false},
                                     {8.0, -4.0, false},
                                     {2.0, -12.5, false},
                                     {-2.0, -11.5, true},
                                     {-7.0, 0.0, false}}) {
    const auto answer = holds(keyhole, at(x, y));
    ASSERT_TRUE(answer.has_value()) << x << ' ' << y;
    EXPECT_EQ(*answer, inside) << x << ' ' << y;
  }
  // The middle of a regular 24-gon: rays along and across the axes run into corners.
  std::string corners;
  for (int k = 0; k < 24; ++k)
    corners +=
        fmt::format("{}{{\"line\": {{\"from\": [{:.6f}, {:.6f}], \"to\": [{:.6f}, {:.6f}]}}}}",
                    k == 0 ? "" : ", ", 40 * std::cos(k * kTurn / 24), 40 * std::sin(k * kTurn / 24),
                    40 * std::cos((k + 1) % 24 * kTurn / 24), 40 * std::sin((k + 1) % 24 * kTurn / 24));
  EXPECT_EQ(holds(shape_of(R"({"units": "mm", "outer": [)" + corners + "]}"), at(0, 0)),
            std::optional<bool>(true));
  EXPECT_LE(signed_distance(at(0, 3), keyhole).low, 2);
  EXPECT_GE(signed_distance(at(0, 3), keyhole).high, 2);
}

/// A plate in a blank of its own outline, which begins elsewhere and runs the other way. Its files are no
/// drawings, so that at best the regions as stated are confirmed.
struct OwnOutline {
  std::string certificate = "same outline", upper = "0", clearance = "0", gap = "0", x = "0",
              tolerances = R"({"part": 0, "blank": 0})";
  std::string corner = "30", part_file = "[]", blank_file = "[]";

  [[nodiscard]] std::string text() const {
    const auto line = [](const std::string& a, const std::string& b) {
      return fmt::format(R"({{"line": {{"from": [{}], "to": [{}]}}}})", a, b);
    };
    const std::string part =
        fmt::format("[{}, {}, {}]", line("0, 0", "30, 0"), line("30, 0", "0, 20"), line("0, 20", "0, 0"));
    const std::string far = corner + ", 0";
    const std::string blank =
        fmt::format("[{}, {}, {}]", line("0, 20", far), line(far, "0, 0"), line("0, 0", "0, 20"));
    return fmt::format(
        R"({{"format": {{"name": "lekalo-locate", "version": 1}}, "status": "optimal", "units": "mm",
 "x": {}, "y": 0, "theta": 0, "theta_deg": 0, "mirrored": false, "mirror": "no", "clearance": {},
 "upper_bound": {}, "gap": {}, "min_allowance": 0, "shortfall": 0, "window_deg": [0, 360], "tolerances": {},
 "regions": {{"part": {{"units": "mm", "outer": {}, "holes": []}},
 "blank": {{"units": "mm", "outer": {}, "holes": []}}}}, "contacts": [], "certificate": "{}",
 "certificate_file": null, "locked": null, "demands": null, "scan": null, "part_cut": false, "largest_certificate": null,
 "trim": null, "nc": null, "comparison": null, "deviations": null}})",
        x, clearance, upper, gap, tolerances, part, blank, certificate);
  }
  [[nodiscard]] Result<LocateReport> report_of(const std::string& result) const {
    return verify_locate(
        {{"result.json", result}, {"part.dxf", part_file}, {"blank.dxf", blank_file}, std::nullopt});
  }
  [[nodiscard]] Verdict verdict() const {
    const auto report = report_of(text());
    EXPECT_TRUE(report.has_value()) << (report ? "" : report.error().message);
    return report ? report->verdict : Verdict::unproved;
  }
};

TEST(VerifyRegions, APartInItsOwnOutlineHasNothingToSpare) {
  EXPECT_EQ(OwnOutline{}.verdict(), Verdict::stated_regions);
  OwnOutline more;
  more.clearance = "1e-300", more.upper = "1e-300";
  EXPECT_EQ(more.verdict(), Verdict::refuted);
  OwnOutline less;
  less.clearance = "-2", less.upper = "-1", less.gap = "1";
  EXPECT_EQ(less.verdict(), Verdict::refuted);
  OwnOutline other;
  other.corner = "30.000000000000004";
  EXPECT_EQ(other.verdict(), Verdict::refuted);
  OwnOutline shifted;
  shifted.x = "1e-12";
  EXPECT_EQ(shifted.verdict(), Verdict::refuted);
  OwnOutline word;
  word.certificate = "no doubt";
  EXPECT_EQ(word.verdict(), Verdict::refuted);
}

TEST(VerifyRegions, TolerancesCountButForOneFile) {
  OwnOutline drawn;
  drawn.tolerances = R"({"part": 0.01, "blank": 0.01})";
  EXPECT_EQ(drawn.verdict(), Verdict::refuted);
  drawn.certificate = "same file";
  EXPECT_EQ(drawn.verdict(), Verdict::stated_regions);
  drawn.blank_file = "[ ]";
  EXPECT_EQ(drawn.verdict(), Verdict::refuted);
  drawn.certificate = "same outline", drawn.clearance = "-0.0201", drawn.upper = "0.0201",
  drawn.gap = "0.0402";
  EXPECT_NE(drawn.verdict(), Verdict::stated_regions);  // its shortfall is missing
}

/// The result of the plate with some of its text exchanged.
struct Changed {
  OwnOutline own = {};
  std::vector<std::pair<std::string, std::string>> changes = {};

  [[nodiscard]] Result<LocateReport> report() const {
    std::string text = own.text();
    for (const auto& [from, to] : changes) {
      const std::size_t at = text.find(from);
      EXPECT_NE(at, std::string::npos) << from;
      if (at != std::string::npos) text.replace(at, from.size(), to);
    }
    return own.report_of(text);
  }
  [[nodiscard]] std::string found() const {
    const auto checked = report();
    if (!checked) return checked.error().message;
    std::string all;
    for (const std::string& finding : checked->findings) all += finding + "\n";
    return all;
  }
  [[nodiscard]] bool has(const std::string& words) const { return found().find(words) != std::string::npos; }
};

TEST(VerifyRegions, OneFileIsOneOnlyIfItWasReadAlike) {
  const std::string different = "part and blank are different files or were cut";
  const auto of = [](const std::string& part, const std::string& blank) {
    Changed c;
    c.own.certificate = "same file";
    c.own.tolerances = fmt::format(R"({{"part": {}, "blank": {}}})", part, blank);
    return c;
  };
  EXPECT_EQ(of("0.5", "0.5").found(), "");
  EXPECT_EQ(of("0", "0").found(), "");
  for (const char* other : {"0.25", "0.50000000000000000000000001", "0.49999999999999999999999999"}) {
    EXPECT_TRUE(of("0.5", other).has(different)) << other;
    EXPECT_TRUE(of(other, "0.5").has(different)) << other;
  }
  Changed file = of("0.5", "0.5");
  file.own.blank_file = "[ ]";
  EXPECT_TRUE(file.has(different));
  Changed cut = of("0.5", "0.5");
  cut.changes = {{R"("part_cut": false)", R"("part_cut": true)"}};
  EXPECT_TRUE(cut.has(different));
  // The same outline of two files proves nothing of the file.
  Changed outline = of("0", "0");
  outline.own.certificate = "same outline", outline.own.blank_file = "[ ]";
  EXPECT_EQ(outline.found(), "");
  // What is not one file has nothing to spare for its tolerances.
  const std::string touches = "clearance is 0 mm, but the placed part meets the outline of the blank";
  EXPECT_FALSE(of("0.5", "0.5").has(touches));
  EXPECT_TRUE(file.has(touches));
  Changed larger = of("0.5", "0.5"), said = of("0.5", "0.5");
  larger.own.corner = "40", said.own.certificate = "same outline";
  EXPECT_TRUE(larger.has(touches));
  EXPECT_TRUE(said.has(touches));
  // Moved by anything the part does not lie in its file, and tolerances count; it sticks out by 0.5 and 1
  // more.
  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{"\"x\": 0", "\"x\": 0.5"},
                                                        {"\"y\": 0", "\"y\": 0.5"},
                                                        {"\"theta\": 0", "\"theta\": 0.02"},
                                                        {"\"mirrored\": false", "\"mirrored\": true"}}) {
    for (const char* word : {"same file", "same outline"}) {
      Changed moved = of("100", "100");
      moved.own.certificate = word;
      moved.changes = {{from, to}};
      const std::string all = moved.found();
      const std::size_t at = all.find("the exact one is between -2");
      EXPECT_NE(at, std::string::npos) << from << all;
    }
  }
  // Drawings of which other layers were asked for are not surely the same.
  const std::string drawings =
      R"("drawings": {"part": %, "blank": {"layers": [], "join": 0.01, "set_aside": []}}, "locked")";
  for (const bool same : {true, false}) {
    Changed drawn = of("0.5", "0.5");
    std::string text = drawings;
    text.replace(text.find('%'), 1,
                 same ? R"({"layers": [], "join": 0.01, "set_aside": []})"
                      : R"({"layers": ["a"], "join": 0.01, "set_aside": []})");
    drawn.changes = {{"\"locked\"", text}};
    const auto report = drawn.report();
    ASSERT_TRUE(report) << report.error().message;
    std::string notes;
    for (const std::string& note : report->notes) notes += note;
    EXPECT_EQ(notes.find("read from the file in the same way") == std::string::npos, same) << notes;
    // Nothing is read where there are no tolerances, or where only the outlines are said to be the same.
    for (const char* word : {"same file", "same outline"}) {
      drawn.own.certificate = word;
      drawn.own.tolerances =
          word == std::string("same file") ? R"({"part": 0, "blank": 0})" : R"({"part": 0.5, "blank": 0.5})";
      const auto other = drawn.report();
      ASSERT_TRUE(other) << other.error().message;
      for (const std::string& note : other->notes)
        EXPECT_EQ(note.find("read from the file in the same way"), std::string::npos) << word << note;
    }
  }
}

TEST(VerifyRegions, TheBoundOfAnOwnOutlineIsWhatTolerancesMayBe) {
  const auto of = [](const std::string& part, const std::string& blank, const std::string& upper) {
    Changed c;
    c.own.tolerances = fmt::format(R"({{"part": {}, "blank": {}}})", part, blank);
    c.own.clearance = "-1", c.own.upper = upper, c.own.gap = fmt::format("{}", std::stod(upper) + 1);
    c.changes = {{"\"shortfall\": 0", "\"shortfall\": 1"}};
    return c;
  };
  const std::string below = "which a part in its own outline may have";
  EXPECT_FALSE(of("0.5", "0.25", "0.75000001").has(below));
  EXPECT_TRUE(of("0.5", "0.25", "0.74999999").has(below));
  EXPECT_TRUE(of("0", "0.25", "0.2").has(below));
  EXPECT_TRUE(of("0.25", "0", "0.2").has(below));
  EXPECT_FALSE(of("0", "0", "0").has(below));
  EXPECT_TRUE(of("0", "0", "-0.5").has(below));
  // A part that touches has nothing to spare for the tolerance of either.
  for (const char* tolerances : {R"({"part": 0.25, "blank": 0})", R"({"part": 0, "blank": 0.25})"}) {
    Changed touching;
    touching.own.tolerances = tolerances;
    EXPECT_TRUE(touching.has("clearance is 0 mm, but the placed part meets the outline of the blank"))
        << touching.found();
  }
}

TEST(VerifyRegions, TheAngleMayBeOffTheWindowByARounding) {
  const auto outside = [](const std::string& window, const std::string& theta) {
    Changed c;
    c.changes = {{"\"window_deg\": [0, 360]", "\"window_deg\": " + window},
                 {"\"theta\": 0", "\"theta\": " + theta}};
    return c.has("outside the window");
  };
  EXPECT_FALSE(outside("[0, 0]", "6.981317007977318843199475836590e-17"));
  EXPECT_FALSE(outside("[0, 0]", "-6.981317007977318857162109852544e-17"));
  EXPECT_TRUE(outside("[0, 0]", "1e-16"));
  EXPECT_TRUE(outside("[0, 0]", "-1e-16"));
  EXPECT_FALSE(outside("[0, 90]", "1"));
  EXPECT_TRUE(outside("[0, 90]", "1.6"));
  EXPECT_TRUE(outside("[10, 90]", "0.1"));
  EXPECT_FALSE(outside("[0, 360]", "7"));
  EXPECT_TRUE(outside("[0, 359]", "7"));
}

TEST(VerifyRegions, DerivedNumbersMayBeOffByARounding) {
  const auto with = [](const std::string& upper, const std::string& gap,
                       const std::string& more = "\"nc\": null") {
    Changed c;
    c.own.upper = upper, c.own.gap = gap;
    c.changes = {{"\"nc\": null", more}};
    return c;
  };
  const std::string words = "gap is not upper_bound less clearance";
  EXPECT_EQ(with("1", "1.0000000000000028").found(), "");
  EXPECT_EQ(with("1", "0.9999999999999972").found(), "");
  EXPECT_TRUE(with("1", "1.0000000000000038").has(words));
  EXPECT_TRUE(with("1", "0.9999999999999962").has(words));
  EXPECT_EQ(with("0", "5e-324").found(), "");
  EXPECT_EQ(with("0", "-5e-324").found(), "");
  EXPECT_TRUE(with("0", "1e-322").has(words));
  const auto shortfall = [](const std::string& allowance, const std::string& missing) {
    Changed c;
    c.changes = {{"\"min_allowance\": 0", "\"min_allowance\": " + allowance},
                 {"\"shortfall\": 0", "\"shortfall\": " + missing}};
    return c;
  };
  const std::string missing = "shortfall is not min_allowance less clearance";
  EXPECT_FALSE(shortfall("1", "1").has(missing));
  EXPECT_TRUE(shortfall("1", "0.9").has(missing));
  EXPECT_FALSE(shortfall("-1", "0").has(missing));
  EXPECT_TRUE(shortfall("-1", "1e-400").has(missing));
  EXPECT_TRUE(shortfall("-1", "-1e-400").has(missing));
  const auto program = [&](const std::string& kept, const std::string& rounding) {
    return with(
               "0", "0",
               fmt::format(
                   R"("nc": {{"clearance": {}, "rounding_mm": {}, "mode": "coordinates", "work_offset": 1}})",
                   kept, rounding))
        .has("is above clearance less its rounding");
  };
  EXPECT_FALSE(program("0", "0"));
  EXPECT_FALSE(program("-0.25", "0.25"));
  EXPECT_TRUE(program("-0.24999999", "0.25"));
  EXPECT_TRUE(program("-0.5", "-0.25"));
  EXPECT_FALSE(program("5e-324", "0"));
  EXPECT_TRUE(program("1e-322", "0"));
}

TEST(VerifyRegions, ContactsLieOnTheirEdgesAsFarApartAsWritten) {
  const auto with = [](const std::string& part_at, const std::string& blank_at, const std::string& distance,
                       int part_edge = 0) {
    Changed c;
    c.changes = {
        {"\"contacts\": []", fmt::format(R"("contacts": [{{"part_edge": {}, "blank_edge": 1, "part_at": [{}],
      "blank_at": [{}], "distance": {}, "multiplier": 1}}])",
                                         part_edge, part_at, blank_at, distance)}};
    return c.found();
  };
  // A millionth of the blank's width of 30 mm.
  EXPECT_EQ(with("9, 0", "5, 0", "4"), "");
  EXPECT_EQ(with("9, -0.000029", "5, 0", "4.000029"), "");
  EXPECT_EQ(with("9, 0", "5, -0.000029", "3.999971"), "");
  EXPECT_NE(with("9, -0.000031", "5, 0", "4").find("part_at is not on edge 0 of the part"),
            std::string::npos);
  EXPECT_NE(with("9, 0", "5, -0.000031", "4").find("blank_at is not on edge 1 of the blank"),
            std::string::npos);
  EXPECT_NE(with("9, 0", "5, 0", "4.000031").find("mm apart, not 4.000031"), std::string::npos);
  EXPECT_NE(with("9, 0", "5, 0", "3.999969").find("mm apart, not 3.999969"), std::string::npos);
  // What joins an arc to its ends belongs to it: their distances from the centre are 6 and 4 mm.
  const auto on_arc = [](const std::string& part_at) {
    Changed c;
    c.changes = {
        {R"("outer": [{"line": {"from": [0, 0], "to": [30, 0]}}, {"line": {"from": [30, 0], "to": [0, 20]}}, {"line": {"from": [0, 20], "to": [0, 0]}}])",
         R"("outer": [{"arc": {"from": [6, 0], "to": [-4, 0], "centre": [0, 0], "ccw": true}}, {"line": {"from": [-4, 0], "to": [6, 0]}}])"},
        {"\"contacts\": []", R"("contacts": [{"part_edge": 0, "blank_edge": 1, "part_at": [)" + part_at +
                                 R"(], "blank_at": [5, 0], "distance": 0, "multiplier": 1}])"}};
    return c.has("part_at is not on edge 0 of the part");
  };
  EXPECT_FALSE(on_arc("0, 5"));
  EXPECT_FALSE(on_arc("5.5, 0"));
  EXPECT_FALSE(on_arc("-4.5, 0"));
  EXPECT_TRUE(on_arc("0, 0"));
  // The edges before and behind it are others.
  EXPECT_NE(with("0, 9", "5, 0", "10").find("part_at is not on edge 0 of the part"), std::string::npos);
  EXPECT_EQ(with("0, 9", "0, 0", "9", 2), "");
  EXPECT_NE(with("15, 10", "15, 0", "10", 2).find("part_at is not on edge 2 of the part"), std::string::npos);
}

TEST(VerifyRegions, ALockedShiftTurnsAboutThePartsOrigin) {
  const auto words = [](const std::string& pivot, const std::string& locked) {
    Rings rings;
    rings.pivot = pivot;
    std::string text = rings.text();
    const std::string null = "\"locked\": null";
    text.replace(text.find(null), null.size(), "\"locked\": " + locked);
    const auto report = rings.report_of(text);
    std::string all = report ? "" : report.error().message;
    if (report)
      for (const std::string& finding : report->findings) all += finding + "\n";
    return all;
  };
  const std::string origin = "the pivot of the certificate is not the part's origin",
                    elsewhere = "the placement is not where it is locked";
  for (const char* locked : {R"({"x": 100, "y": null})", R"({"x": null, "y": 50})"}) {
    for (const char* pivot : {"[0, 5]", "[5, 0]", "[1e-400, 0]", "[0, -1e-400]"})
      EXPECT_NE(words(pivot, locked).find(origin), std::string::npos) << pivot << locked;
    EXPECT_EQ(words("[0, 0]", locked).find(origin), std::string::npos) << locked;
    EXPECT_EQ(words("[0, 0]", locked).find(elsewhere), std::string::npos) << locked;
  }
  EXPECT_EQ(words("[0, 5]", "null").find(origin), std::string::npos);
  EXPECT_EQ(words("[0, 5]", R"({"x": null, "y": null})").find(origin), std::string::npos);
  EXPECT_NE(words("[0, 0]", R"({"x": 100.5, "y": null})").find(elsewhere), std::string::npos);
  EXPECT_NE(words("[0, 0]", R"({"x": null, "y": 49.5})").find(elsewhere), std::string::npos);
}

TEST(VerifyRegions, EveryWayThatThePartMayLieHasItsTree) {
  const auto words = [](const std::string& mirror, const std::string& tree) {
    Rings rings;
    rings.mirror = mirror;
    std::string text = rings.text();
    const std::string plain = "\"trees\": [{\"mirrored\": false";
    text.replace(text.find(plain), plain.size(), "\"trees\": [{\"mirrored\": " + tree);
    const auto report = rings.report_of(text);
    std::string all = report ? "" : report.error().message;
    if (report)
      for (const std::string& finding : report->findings) all += finding + "\n";
    return all;
  };
  const std::string plain = "the certificate has no tree for the part as it is",
                    mirrored = "the certificate has no tree for the mirrored part";
  for (const auto& [mirror, tree, plain_missing, mirrored_missing] : {std::tuple{"no", "false", false, false},
                                                                      {"no", "true", true, false},
                                                                      {"yes", "true", false, false},
                                                                      {"yes", "false", false, true},
                                                                      {"either", "true", true, false},
                                                                      {"either", "false", false, true}}) {
    EXPECT_EQ(words(mirror, tree).find(plain) != std::string::npos, plain_missing) << mirror << tree;
    EXPECT_EQ(words(mirror, tree).find(mirrored) != std::string::npos, mirrored_missing) << mirror << tree;
  }
  for (const auto& [mirror, is, allowed] : {std::tuple{"no", "false", true},
                                            {"no", "true", false},
                                            {"yes", "true", true},
                                            {"yes", "false", false},
                                            {"either", "true", true},
                                            {"either", "false", true}}) {
    Rings rings;
    rings.mirror = mirror, rings.mirrored = is;
    const auto report = rings.report();
    std::string all;
    for (const std::string& finding : report->findings) all += finding;
    EXPECT_EQ(all.find("which was not allowed") == std::string::npos, allowed) << mirror << is;
  }
}

TEST(VerifyRegions, ACertificateMayStandInItsOwnFile) {
  const std::string whole = pinned("-0.099", "0");
  const std::size_t begin = whole.find("\"certificate\": ") + 15,
                    end = whole.find(", \"certificate_file\": null");
  const std::string certificate = whole.substr(begin, end - begin);
  const auto report_of = [&](const std::string& here, const std::string& file,
                             const std::optional<std::string>& there) {
    std::string text = whole;
    text.replace(begin, end + 26 - begin, here + ", \"certificate_file\": " + file);
    const std::string part = file_of(text, "part"), blank = file_of(text, "blank");
    LocateInputs inputs{{"r", text}, {"part.json", part}, {"blank.json", blank}, {}};
    if (there) inputs.certificate = {"c.json", *there};
    return verify_locate(inputs);
  };
  const std::string named = R"({"path": "c.json", "sha256": ""})",
                    document = "{\"certificate\": " + certificate + "}";
  EXPECT_EQ(report_of("null", named, document)->verdict, Verdict::confirmed);
  EXPECT_EQ(report_of(certificate, "null", std::nullopt)->verdict, Verdict::confirmed);
  EXPECT_EQ(report_of(certificate, named, "{}")->verdict, Verdict::confirmed);
  for (const auto& report :
       {report_of("null", named, std::nullopt), report_of("null", "null", document),
        report_of("null", named, "{}"), report_of("null", named, "{\"certificate\": null}")}) {
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->verdict, Verdict::unproved);
  }
  const auto broken = report_of("null", named, "{");
  ASSERT_FALSE(broken);
  EXPECT_EQ(broken.error().message.find("c.json: "), 0U) << broken.error().message;
}

}  // namespace
}  // namespace lekalo::verify::verify_regions_test
