// verify_locate on results written by hand or by the solver of support/verify_cases.hpp, which shares nothing
// with lekalo: true ones are confirmed, and whatever digit is falsified, the lie is found.

#include <gtest/gtest.h>

#include <functional>

#include "support/verify_cases.hpp"

namespace lekalo::verify_locate_test {
namespace {

using namespace verify_cases;
using verify::Verdict;

void expect_verdict(Verdict verdict, const Files& files, const std::string& what) {
  const auto report = check(files);
  ASSERT_TRUE(report) << what << ": " << report.error().message;
  EXPECT_EQ(report->verdict, verdict) << what << ":\n" << findings(report);
}

void expect_finding(const Files& files, const std::string& words, const std::string& what) {
  const auto report = check(files);
  ASSERT_TRUE(report) << what << ": " << report.error().message;
  EXPECT_EQ(report->verdict, Verdict::refuted) << what;
  EXPECT_NE(findings(report).find(words), std::string::npos) << what << ":\n" << findings(report);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(VerifyLocate, ConfirmsTheSixPublishedExamples) {
  for (const Case& c : examples()) {
    const auto report = check(write(c));
    ASSERT_TRUE(report) << c.name << ": " << report.error().message;
    EXPECT_EQ(report->verdict, Verdict::confirmed) << c.name << ":\n" << findings(report);
    EXPECT_NEAR(std::stod(report->clearance_low), c.optimum, 2e-7) << c.name;
    EXPECT_LE(report->clearance_low, report->clearance_high);
    EXPECT_GE(std::stod(report->bound_high), c.optimum - 1e-9);
    EXPECT_GT(report->intervals, 64U);
  }
}

TEST(VerifyLocate, KnowsTheExactClearanceToTheThirtiethDigit) {
  for (const Case& c : examples()) {
    Files files = write(c);
    const auto report = check(files);
    ASSERT_TRUE(report);
    ASSERT_NE(report->clearance_low, report->clearance_high);
    files["clearance"] = report->clearance_low;
    files["gap"] = text_of(std::stod(files["upper_bound"]) - std::stod(files["clearance"]));
    expect_verdict(Verdict::confirmed, files, c.name);
    files["clearance"] = report->clearance_high;
    expect_finding(files, "the exact minimum allowance", c.name);
  }
}

TEST(VerifyLocate, FindsNoMoreClearanceAtAPublishedPoseThanTheArticleClaims) {
  // The article prints phi* above what its printed pose has.
  Files files = write(examples()[1]);
  set_pose(files, -60.768149, 62.430262, -4.189957);
  files["contacts"] = "[]";
  files["clearance"] = "0.429455";
  expect_finding(files, "0.42936", "published");
}

struct Tampering {
  const char* what;
  const char* finding;
  std::function<void(Files&, const Solution&)> change;
};

const std::vector<Tampering>& tamperings() {
  const auto move = [](std::string& points, double dx) {
    // The first coordinate of the file.
    const std::size_t end = points.find(',');
    points = "[[" + text_of(std::stod(points.substr(2, end - 2)) + dx) + points.substr(end);
  };
  static const std::vector<Tampering> table{
      {"clearance up by 1e-12", "the exact minimum allowance",
       [](Files& f, const Solution&) {
         f["clearance"] = text_of(std::stod(check(f)->clearance_high) + 1e-12);
         f["gap"] = text_of(std::stod(f["upper_bound"]) - std::stod(f["clearance"]));
       }},
      {"first interval removed", "less than the full circle",
       [](Files& f, const Solution&) { f.certificate.erase(f.certificate.begin()); }},
      {"an inner interval removed", "nothing covers the angles",
       [](Files& f, const Solution&) { f.certificate.erase(f.certificate.begin() + 30); }},
      {"last interval removed", "less than the full circle",
       [](Files& f, const Solution&) { f.certificate.pop_back(); }},
      {"all intervals removed", "it has no intervals",
       [](Files& f, const Solution&) { f.certificate.clear(); }},
      {"the circle cut short by 4e-16", "less than the full circle",
       [](Files& f, const Solution&) { f.certificate.back().to = "6.2831853071795864"; }},
      {"a hole of 1e-25", "nothing covers the angles",
       [](Files& f, const Solution&) { f.certificate[20].from += "0000000000000000000000001"; }},
      {"two intervals exchanged", "before the one in front",
       [](Files& f, const Solution&) { std::swap(f.certificate[10], f.certificate[11]); }},
      {"an interval turned around", "it runs backwards",
       [](Files& f, const Solution&) { std::swap(f.certificate[12].from, f.certificate[12].to); }},
      {"a part vertex replaced by the one opposite", "certificate interval 25",
       [](Files& f, const Solution&) {
         auto& vertex = f.certificate[25].contacts[1].part_vertex;
         vertex = std::to_string((std::stoul(vertex) + 5) % 10);
       }},
      {"three neighbouring blank edges", "interval 40: the inward normals of its blank edges do not balance",
       [](Files& f, const Solution&) {
         for (const std::size_t j : {0U, 1U, 2U})
           f.certificate[40].contacts[j].blank_edge = std::to_string(j);
       }},
      {"the same edge three times", "parallel",
       [](Files& f, const Solution&) {
         for (auto& contact : f.certificate[5].contacts) contact.blank_edge = "3";
       }},
      {"a part vertex that does not exist", "part vertex 99 does not exist",
       [](Files& f, const Solution&) { f.certificate[7].contacts[1].part_vertex = "99"; }},
      {"a blank edge that does not exist", "blank edge 4711 does not exist",
       [](Files& f, const Solution&) { f.certificate[7].contacts[2].blank_edge = "4711"; }},
      {"a multiplier changed by 1e-5", "multiplier",
       [](Files& f, const Solution&) {
         std::string& m = f.certificate[9].contacts[0].multiplier;
         m = text_of(std::stod(m) + 1e-5);
       }},
      {"upper_bound lowered by 1e-12", "upper_bound",
       [](Files& f, const Solution&) {
         f["upper_bound"] = text_of(std::stod(check(f)->bound_high) - 1e-12);
         f["gap"] = text_of(std::stod(f["upper_bound"]) - std::stod(f["clearance"]));
       }},
      {"upper_bound null", "upper_bound is null",
       [](Files& f, const Solution&) { f["upper_bound"] = f["gap"] = "null"; }},
      {"x moved by 1e-6", "the exact minimum allowance",
       [](Files& f, const Solution& s) { f["x"] = text_of(s.x + 1e-6); }},
      {"y moved by 1e-6", "the exact minimum allowance",
       [](Files& f, const Solution& s) { f["y"] = text_of(s.y - 1e-6); }},
      {"theta turned by 1e-3", "the exact minimum allowance",
       [](Files& f, const Solution& s) { set_pose(f, s.x, s.y, s.theta + 1e-3); }},
      {"sign of theta", "the exact minimum allowance",
       [](Files& f, const Solution& s) { set_pose(f, s.x, s.y, s.theta == 0 ? -1e-3 : -s.theta); }},
      {"theta_deg changed in its 12th digit", "theta_deg",
       [](Files& f, const Solution&) { f["theta_deg"] = text_of(std::stod(f["theta_deg"]) + 1e-10); }},
      {"gap halved", "gap is written as",
       [](Files& f, const Solution&) { f["gap"] = text_of(std::stod(f["gap"]) / 2); }},
      {"gap null", "only one of upper_bound and gap", [](Files& f, const Solution&) { f["gap"] = "null"; }},
      {"shortfall from nothing", "shortfall is 0.5",
       [](Files& f, const Solution&) { f["shortfall"] = "0.5"; }},
      {"min_allowance out of reach, status optimal", "status is optimal, but upper_bound",
       [](Files& f, const Solution& s) {
         f["min_allowance"] = "10";
         f["shortfall"] = text_of(10 - s.clearance);
       }},
      {"shortfall too small", "shortfall is written as",
       [](Files& f, const Solution&) {
         f["min_allowance"] = "10";
         f["shortfall"] = "1";
         f["status"] = "\"infeasible\"";
       }},
      {"infeasible that is not", "status is infeasible, but upper_bound",
       [](Files& f, const Solution&) { f["status"] = "\"infeasible\""; }},
      {"unproved, with a certificate", "status is unproved",
       [](Files& f, const Solution&) { f["status"] = "\"unproved\""; }},
      {"a corner of the blank moved by 1", "", [move](Files& f, const Solution&) { move(f.blank, 1); }},
      {"a corner of the part moved by 1", "", [move](Files& f, const Solution&) { move(f.part, 1); }},
      {"the blank enlarged: more room than the bound allows", "",
       [](Files& f, const Solution&) { f.blank = replaced(f.blank, "[[", "[[30, 100], [") + " "; }},
      {"units inch", "",
       [](Files& f, const Solution&) { f["inputs"] = replaced(f["inputs"], "\"mm\"", "\"inch\""); }},
      {"number of points", "points, the result says 11",
       [](Files& f, const Solution&) {
         const std::size_t at = f["inputs"].find("\"points\": ");
         f["inputs"].replace(at, 12, "\"points\": 11");
       }},
      {"a corner of the blank listed as dropped", "off the straight line",
       [](Files& f, const Solution&) {
         const std::size_t at = f["inputs"].rfind("[]");
         f["inputs"].replace(at, 2, "[4]");
       }},
      {"a corner of the part listed as dropped", "off the straight line",
       [](Files& f, const Solution&) { f["inputs"] = replaced(f["inputs"], "[]", "[0]"); }},
      {"dropped points that do not exist", "not ascending indices",
       [](Files& f, const Solution&) { f["inputs"] = replaced(f["inputs"], "[]", "[500]"); }},
      {"nearly all points dropped", "drops",
       [](Files& f, const Solution&) {
         const std::size_t at = f["inputs"].rfind("[]");
         f["inputs"].replace(at, 2, "[0, 1, 2, 3, 4, 5, 6, 7]");
       }},
      {"the pose outside the window", "outside the window",
       [](Files& f, const Solution& s) {
         const double degrees = s.theta * 57.29577951308232;
         f["window_deg"] = degrees > 10 ? "[0, 9]" : "[11, 20]";
       }},
      {"a contact of the pose replaced", "farther from blank edge",
       [](Files& f, const Solution& s) {
         const Contact& c = s.basis.contacts[0];
         f["contacts"] = "[" + contact_text({(c.part_vertex + 5) % 10, c.blank_edge, 1}).json() + "]";
       }},
      {"a contact of the pose that does not exist", "contact 0: part vertex 77",
       [](Files& f, const Solution&) {
         f["contacts"] = "[" + ContactText{"77", "0", "1"}.json() + "]";
       }},
      {"an alternative with too much clearance", "alternative 0: clearance",
       [](Files& f, const Solution& s) {
         f["alternatives"] =
             fmt::format(R"([{{"x": {}, "y": {}, "theta": {}, "theta_deg": {}, "clearance": {}}}])", s.x, s.y,
                         s.theta, s.theta * 57.29577951308232, s.clearance + 1e-11);
       }},
      {"an NC program that keeps more than the placement", "nc.clearance",
       [](Files& f, const Solution& s) {
         f["nc"] = fmt::format(
             R"({{"clearance": {}, "rounding_mm": 1e-5, "mode": "coordinates", "work_offset": 1}})",
             s.clearance);
       }},
  };
  return table;
}

TEST(VerifyLocate, FindsEveryFalsifiedDigit) {
  ASSERT_GE(tamperings().size(), 25U);
  const std::vector<Case> cases = examples();
  for (const std::size_t which : {0U, 1U, 4U}) {  // ten-cornered blanks; parts either way round
    const Solution solution = solve(cases[which]);
    const Files honest = write(cases[which], solution);
    for (const Tampering& tampering : tamperings()) {
      Files files = honest;
      tampering.change(files, solution);
      const std::string what = cases[which].name + ", " + tampering.what;
      const auto report = check(files);
      if (!report) {
        ADD_FAILURE() << what << ": " << report.error().message;
        continue;
      }
      EXPECT_EQ(report->verdict, Verdict::refuted) << what;
      EXPECT_NE(findings(report).find(tampering.finding), std::string::npos) << what << ":\n"
                                                                             << findings(report);
    }
  }
}

}  // namespace
}  // namespace lekalo::verify_locate_test
