// What a result, an interval of its certificate and a list of M words may look like, held against the readers
// themselves: the sentence for each that cannot be read.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "verify/locate/document.hpp"
#include "verify/locate/pose_document.hpp"
#include "verify/pocket/program_check.hpp"

namespace lekalo::verify::verify_result_document_test {
namespace {

using Changes = std::vector<std::pair<std::string, std::string>>;

/// The text with the first of each of these replaced.
std::string changed(std::string text, const Changes& changes) {
  for (const auto& [from, to] : changes) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    if (at != std::string::npos) text.replace(at, from.size(), to);
  }
  return text;
}

const std::string kConvex = R"({"format": {"name": "lekalo-locate", "version": 1}, "status": "optimal",
  "units": "mm", "inputs": [{"role": "part", "units": "mm", "points": 4, "dropped": [], "sha256": ""},
  {"role": "blank", "units": "mm", "points": 4, "dropped": [], "sha256": ""}], "mirrored": false, "x": 0, "y": 0,
  "theta": 0, "theta_deg": 0, "clearance": 1, "upper_bound": 1, "gap": 0, "min_allowance": 0, "shortfall": 0,
  "window_deg": [0, 360], "contacts": [], "certificate": [], "certificate_file": null, "alternatives": [],
  "trim": null, "nc": null, "comparison": null, "deviations": null})";

std::string read_convex(const Changes& changes) {
  const std::string text = changed(kConvex, changes);
  const auto root = parse_json(text, "r");
  EXPECT_TRUE(root) << text;
  const auto read = read_result_document(*root, "r");
  return read ? "" : read.error().message;
}

TEST(ResultDocument, OfConvexOutlinesIsReadOrGetsASentence) {
  EXPECT_EQ(read_convex({}), "");
  const std::string format = "r: field format does not say lekalo-locate, version 1";
  EXPECT_EQ(read_convex({{"lekalo-locate", "lekalo-locat"}}), format);
  EXPECT_EQ(read_convex({{"\"lekalo-locate\"", "1"}}), format);
  EXPECT_EQ(read_convex({{": 1}", ": 2}"}}), format);
  EXPECT_EQ(read_convex({{"\"blank\"", "\"part\""}}), "r: inputs name 2 part and 0 blank, not one each");
  EXPECT_EQ(read_convex({{"\"part\"", "\"blank\""}}), "r: inputs name 0 part and 2 blank, not one each");
  EXPECT_EQ(read_convex({{"\"part\"", "\"other\""}}), "r: inputs name 0 part and 1 blank, not one each");
  EXPECT_EQ(read_convex({{"\"blank\"", "\"other\""}}), "r: inputs name 1 part and 0 blank, not one each");
  EXPECT_EQ(read_convex({{R"("part", "units": "mm")", R"("part", "units": "cm")"}}),
            "r: units of an input are neither \"mm\" nor \"inch\"");
  EXPECT_EQ(read_convex({{R"("part", "units": "mm")", R"("part", "units": "inch")"}}), "");
  EXPECT_EQ(read_convex(
                {{"\"trim\": null", R"("trim": {"tolerance": 1, "loss": 1, "contour": [[1, 2], [3, 4]]})"}}),
            "");
  EXPECT_EQ(
      read_convex({{"\"trim\": null", R"("trim": {"tolerance": 1, "loss": 1, "contour": [[1, 2], [3]]})"}}),
      "r: trim.contour[1] is not a list of two numbers");
  const std::string window = "r: field window_deg is not two angles in ascending order";
  EXPECT_EQ(read_convex({{"[0, 360]", "[5, 5]"}}), "");
  for (const char* ends : {"[]", "[5]", "[5, 4]", "[1, 2, 3]"})
    EXPECT_EQ(read_convex({{"[0, 360]", ends}}), window) << ends;
}

std::string read_item(const std::string& text) {
  const auto root = parse_json(text, "item");
  EXPECT_TRUE(root) << text;
  const auto read = read_interval(*root, 7, "c");
  return read ? "" : read.error().message;
}
std::string contact(const std::string& part_vertex, const std::string& blank_edge,
                    const std::string& multiplier) {
  return fmt::format(R"({{"part_vertex": {}, "blank_edge": {}, "multiplier": {}}})", part_vertex, blank_edge,
                     multiplier);
}
std::string with_contact(const std::string& one) {
  const std::string plain = contact("0", "1", "0.5");
  return read_item(R"({"from": 0, "to": 1, "contacts": [)" + plain + ", " + one + ", " + plain + "]}");
}

TEST(ResultDocument, AnIntervalOfACertificateIsReadOrGetsASentence) {
  const std::string c = "c: certificate interval 7: ", one = contact("0", "1", "0.5");
  const auto with = [&](const std::string& from, const std::string& contacts) {
    return read_item(R"({"from": )" + from + R"(, "to": 1, "contacts": )" + contacts + "}");
  };
  const std::string three = "[" + one + ", " + one + ", " + one + "]";
  EXPECT_EQ(with("0", three), "");
  EXPECT_EQ(with("-1.5e-3", three), "");
  EXPECT_EQ(read_item("[1]"), c + "it is not an object with each field once");
  EXPECT_EQ(read_item("5"), c + "it is not an object with each field once");
  EXPECT_EQ(read_item(R"({"from": 0, "from": 0, "to": 1, "contacts": []})"),
            c + "it is not an object with each field once");
  for (const char* no : {"\"0\"", "1e999", "null", "[0]"})
    EXPECT_EQ(with(no, three), c + fmt::format("\"{}\" is not {}", no, decimal_rule())) << no;
  EXPECT_EQ(read_item(R"({"from": 0, "contacts": []})"), c + "\"\" is not " + decimal_rule());
  EXPECT_EQ(with("0", "{}"), c + "it has no list of contacts");
  EXPECT_EQ(with("0", "[" + one + ", " + one + "]"), c + "it has 2 contacts, not three");
  EXPECT_EQ(with("0", "[" + one + ", " + one + ", " + one + ", " + one + "]"),
            c + "it has more than three contacts");

  EXPECT_EQ(with_contact(one), "");
  EXPECT_EQ(with_contact(contact("0", "1", "-0.5")), "");
  EXPECT_EQ(with_contact("[1]"), c + "a contact is not an object with each field once");
  EXPECT_EQ(with_contact(R"({"part_vertex": 0, "part_vertex": 0, "blank_edge": 0, "multiplier": 0})"),
            c + "a contact is not an object with each field once");
  for (const char* no : {"-1", "1.5", "null", "\"1\"", "1e999"}) {
    EXPECT_EQ(with_contact(contact(no, "1", "0.5")), c + fmt::format("part_vertex is \"{}\"", no));
    EXPECT_EQ(with_contact(contact("1", no, "0.5")), c + fmt::format("blank_edge is \"{}\"", no));
  }
  EXPECT_EQ(with_contact(contact("1", "1", "null")), c + "multiplier is \"null\"");
  EXPECT_EQ(with_contact(contact("999999999999999", "999999999999999", "1e16")), "");
  EXPECT_EQ(with_contact(contact("1e15", "1", "0.5")), c + "an index is larger than 1e15");
  EXPECT_EQ(with_contact(contact("1", "1e15", "0.5")), c + "an index is larger than 1e15");
}

const std::string kTriangle =
    R"({"units": "mm", "outer": [{"line": {"from": [0, 0], "to": [9, 0]}}, {"line": {"from": [9, 0], "to": [0, 9]}},
    {"line": {"from": [0, 9], "to": [0, 0]}}]})";
const std::string kRegions =
    R"({"format": {"name": "lekalo-locate", "version": 1}, "status": "optimal",
  "units": "mm", "x": 0, "y": 0, "theta": 0, "theta_deg": 0, "mirrored": false, "mirror": "no", "clearance": 1,
  "upper_bound": 1, "gap": 0, "min_allowance": 0, "shortfall": 0, "window_deg": [0, 360],
  "tolerances": {"part": 0, "blank": 0}, "regions": {"part": )" +
    kTriangle + R"(, "blank": )" + kTriangle +
    R"(}, "contacts": [], "certificate": {}, "certificate_file": null, "locked": null,
  "demands": null, "scan": null, "part_cut": false, "largest_certificate": null, "trim": null, "nc": null,
  "comparison": null, "deviations": null})";

TEST(ResultDocument, OfRegionsIsReadOrGetsASentence) {
  const auto read = [](const Changes& changes) {
    const std::string text = changed(kRegions, changes);
    const auto root = parse_json(text, "r");
    EXPECT_TRUE(root) << text;
    std::string complaint;
    (void)read_region_document(*root, complaint);
    return complaint;
  };
  EXPECT_EQ(read({}), "");
  const std::string format = "field format does not say lekalo-locate, version 1";
  EXPECT_EQ(read({{"lekalo-locate", "lekalo-locat"}}), format);
  EXPECT_EQ(read({{"\"lekalo-locate\"", "1"}}), format);
  EXPECT_EQ(read({{": 1}", ": 2}"}}), format);
  EXPECT_EQ(read({{"[0, 360]", "[5, 5]"}}), "");
  for (const char* ends : {"[]", "[5]", "[5, 4]", "[1, 2, 3]"})
    EXPECT_EQ(read({{"[0, 360]", ends}}), "field window_deg is not two angles in ascending order") << ends;
  for (const char* known : {"yes", "either"})
    EXPECT_EQ(read({{R"("mirror": "no")", fmt::format(R"("mirror": "{}")", known)}}), "");
  EXPECT_EQ(read({{R"("mirror": "no")", R"("mirror": "maybe")"}}),
            "field mirror is none of \"no\", \"yes\", \"either\"");
  EXPECT_EQ(read({{"\"part\": 0", "\"part\": -1"}}), "a tolerance is negative");
  EXPECT_EQ(read({{"\"blank\": 0", "\"blank\": -1"}}), "a tolerance is negative");
  EXPECT_EQ(read({{"\"mirrored\": false", "\"mirrored\": 1"}}), "field mirrored is neither true nor false");
}

/// What is said of a program with this M word that was moved by nothing, where the shop's list is this.
std::string program_with(const std::string& list, const char* word = "M130") {
  const std::string program = fmt::format("G21 G90 G17\nG54\nG0 X1 Y2\n{}\nM30\n", word);
  const LocateInputs inputs{{},
                            {},
                            {},
                            std::nullopt,
                            std::nullopt,
                            Document{"p.nc", program},
                            Document{"moved.nc", program},
                            Document{"list.txt", list}};
  LocateReport report;
  const WrittenNc nc{{}, {}, "coordinates", 1};
  const bool whole = check_program(inputs, nc, {}, report);
  std::string all = whole ? "" : "left open\n";
  for (const std::string& finding : report.findings) all += finding + "\n";
  for (const std::string& note : report.notes) all += note + "\n";
  return all;
}

TEST(ProgramCheck, AListOfMWordsHasOneALine) {
  const std::string allowed = program_with("M130\n"), not_allowed = program_with("");
  EXPECT_NE(allowed, not_allowed);
  EXPECT_EQ(not_allowed.rfind("left open\nthat the program written is p.nc, moved, was not rechecked: ", 0),
            0U)
      << not_allowed;
  for (const char* list : {"M130", "m130", " M 1\t30 \r\n", "# M7\nM130 # or not\n", "; a\nM130;M9",
                           "(a)\nM130 (b)", "M0\n\n\nM130", "M130\nM131\n", "M131\nM130"})
    EXPECT_EQ(program_with(list), allowed) << list;
  for (const char* list : {"M131", "#M130", "M0", "\n", "M1\nM30"})
    EXPECT_EQ(program_with(list), not_allowed) << list;
  EXPECT_EQ(program_with("M0", "M0"), program_with("", "M0"));
  for (const char* list :
       {"N130", "130", "M", "M130x", "M-130", "M99999999999", "M130 M131", "M130\nN1", "x"})
    EXPECT_EQ(
        program_with(list),
        "left open\nthat the program written is p.nc, moved, was not rechecked: list.txt is no list of M "
        "words\n")
        << list;
}

}  // namespace
}  // namespace lekalo::verify::verify_result_document_test
