// What results for solids say of a mesh's deviation from its body, and of the program that was moved with it.

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <string>
#include <tuple>

#include "support/solid_results.hpp"
#include "verify/solid/solid_mesh.hpp"

namespace lekalo::verify::verify_solid_claims_test {
namespace {

using cases::cube_in_cube;
using cases::Json;
using cases::SolidResultFiles;

bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

// ---- deviations
// ---------------------------------------------------------------------------------------------

/// A cube as a PLY with these lines at the beginning of its header.
std::string ply(const std::string& comments, double half = 5) {
  const solid::Mesh mesh = cases::block({-half, -half, -half}, {half, half, half});
  std::string made = "ply\nformat ascii 1.0\n" + comments +
                     "element vertex 8\nproperty double x\nproperty double y\nproperty double z\n"
                     "element face 12\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& v : mesh.vertices) made += fmt::format("{} {} {}\n", v.x, v.y, v.z);
  for (const auto& t : mesh.triangles) made += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  return made;
}

/// The deviation that a header says, "none", or the refusal.
std::string deviation(const std::string& comments, SolidUnit unit = SolidUnit::millimetre) {
  const auto made = read_solid({"part.ply", ply(comments)}, unit);
  if (!made) return made.error().message;
  return made->deviation ? fmt::format("{}", approximate(*made->deviation)) : "none";
}

TEST(SolidDeviation, IsSaidInTheHeaderOfAMeshByLekaloStep) {
  const std::string by_step = "comment lekalo-step 1\n";
  EXPECT_EQ(deviation(by_step + "comment deviation 0.25\n"), "0.25");
  EXPECT_EQ(deviation(by_step + "comment deviation 0\n"), "0");
  EXPECT_EQ(deviation("comment\n" + by_step + "comment of a screw\ncomment deviation 0.25\n"), "0.25");
  EXPECT_EQ(deviation(by_step + "comment deviation 0.25\ncomment deviation 9\n"), "0.25");
  // Others may say what they want.
  for (const char* other :
       {"", "comment deviation 0.25\n", "comment x\ncomment lekalo-step 1\ncomment deviation 1\n",
        "comment lekalo-step 2\ncomment deviation 1\n", "comment lekalo-step 1 x\ncomment deviation 1\n",
        "comment lekalo-step\ncomment deviation 1\n", "comment other 1\ncomment deviation 1\n",
        "obj_info lekalo-step 1\n"})
    EXPECT_EQ(deviation(other), "none") << other;
  EXPECT_EQ(deviation(by_step), "part.ply: lekalo-step made it, but its header has no deviation");
  for (const char* bad :
       {"comment deviation\n", "comment deviation x\n", "comment deviation -1\n", "comment deviation 1 2\n"})
    EXPECT_EQ(deviation(by_step + bad), "part.ply:4: this line of the header is not known") << bad;
  EXPECT_EQ(deviation(by_step + "comment deviation 0.25\n", SolidUnit::inch),
            "part.ply:4: this line of the header is not known");
}

/// Two triangles with these lines in the header and these rows of vertices and faces.
std::string faces(const std::string& begin, const std::string& of_vertex, const std::string& of_face,
                  const std::string& last, const std::vector<std::string>& rows) {
  std::string made = "ply\nformat ascii 1.0\n" + begin +
                     "element vertex 3\nproperty double x\nproperty double y\nproperty double z\n" +
                     of_vertex + "element face 2\nproperty list uchar int vertex_indices\n" + of_face + last +
                     "end_header\n";
  for (const std::string& row : rows) made += row + "\n";
  const auto read = read_solid({"part.ply", made});
  if (!read) return read.error().message;
  std::string told;
  for (std::size_t t = 0; t < read->face_of.size(); ++t)
    told += fmt::format("{} \"{}\" ", read->face_of[t], read->groups[read->group_of[t]]);
  return told;
}

TEST(SolidDeviation, FacesHaveTheNumbersAndNamesOfTheBody) {
  const std::string by_step = "comment lekalo-step 1\ncomment deviation 0\n", face = "property int face\n",
                    names = "element body_face 2\nproperty list uchar uchar name\n",
                    others = "element other 1\nproperty list uchar uchar name\n";
  const std::vector<std::string> rows{"0 0 0", "1 0 0", "0 1 0", "3 0 1 2 1", "3 0 1 2 2", "2 97 98", "1 99"};
  EXPECT_EQ(faces(by_step, "", face, names, rows), "1 \"c\" 2 \"\" ");
  // Of other programs, of vertices, of other things and as lists they are something else.
  EXPECT_EQ(faces("", "", face, names, rows), "");
  EXPECT_EQ(faces(by_step, "property int face\n", face, names,
                  {"0 0 0 5", "1 0 0 6", "0 1 0 7", "3 0 1 2 1", "3 0 1 2 2", "2 97 98", "1 99"}),
            "1 \"c\" 2 \"\" ");
  EXPECT_EQ(faces(by_step, "", face, others + names,
                  {"0 0 0", "1 0 0", "0 1 0", "3 0 1 2 1", "3 0 1 2 2", "1 100", "2 97 98", "1 99"}),
            "1 \"c\" 2 \"\" ");
  EXPECT_EQ(faces(by_step, "", "property list uchar int face\n", "",
                  {"0 0 0", "1 0 0", "0 1 0", "3 0 1 2 1 1", "3 0 1 2 1 2"}),
            "");
}

SolidResultFiles deviating(const char* part, const char* blank) {
  SolidResultFiles files = cube_in_cube();
  for (const auto& [text, file, half, input] :
       {std::tuple(part, &files.part, 5.0, 0), std::tuple(blank, &files.blank, 6.0, 1)}) {
    if (text == nullptr) continue;
    *file = ply(std::string("comment lekalo-step 1\ncomment deviation ") + text + "\n", half);
    files.result["inputs"][input]["deviation"] = std::stod(text);
  }
  return files;
}

TEST(SolidDeviation, IsTakenOffTheClearance) {
  struct Case {
    const char *part, *blank;
    double left;
  };
  for (const auto& [part, blank, left] :
       {Case{"0.25", nullptr, 0.75}, {nullptr, "0.25", 0.75}, {"0.25", "0.125", 0.625}}) {
    SolidResultFiles files = deviating(part, blank);
    EXPECT_TRUE(says(files.told(), "refuted; the clearance ")) << files.told();
    files.result["clearance"] = left;
    EXPECT_EQ(files.told(), "unproved");
    const auto report = files.report();
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_NEAR(std::stod(report->clearance_low), left, 1e-12);
    EXPECT_NEAR(std::stod(report->clearance_high), 2 - left, 1e-12);
  }
}

TEST(SolidDeviation, IsTheOneOfTheFile) {
  SolidResultFiles files = deviating("0.25", nullptr);
  files.result["clearance"] = 0.75;
  const auto said = [&](Json value) {
    SolidResultFiles other = files;
    if (value.is_null())
      other.result["inputs"][0].erase("deviation");
    else
      other.result["inputs"][0]["deviation"] = std::move(value);
    return other.told();
  };
  EXPECT_EQ(said(0.25), "unproved");
  EXPECT_EQ(
      said(nullptr),
      "refuted; the part is said to deviate by nothing from the body that it stands for, but part.stl says "
      "0.25 mm");
  EXPECT_TRUE(says(said(0.5), "refuted; the part is said to deviate by 0.5 mm from the body"));
  files.part = solid_files::stl_binary(cases::block({-5, -5, -5}, {5, 5, 5}));
  EXPECT_TRUE(says(said(0.25), "but part.stl says nothing"));
  EXPECT_EQ(said(nullptr), "unproved");
}

TEST(SolidDeviation, IsTakenOffTheMargin) {
  const auto with = [](double margin) {
    SolidResultFiles files =
        cases::with_demands({{"minimum", 0}, {"features", Json::array()}}, Json::array(), nullptr, margin, 1);
    files.part = ply("comment lekalo-step 1\ncomment deviation 0.25\n");
    files.result["inputs"][0]["deviation"] = 0.25, files.result["clearance"] = 0.5;
    return files.told();
  };
  EXPECT_EQ(with(0.75), "unproved");
  EXPECT_TRUE(says(with(0.7501), "refuted; the clearance 1.0001 mm is above 1")) << with(0.7501);
}

TEST(SolidDeviation, IsSaidOfPartAndBlankAlone) {
  SolidResultFiles files = cube_in_cube();
  files.result["inputs"].push_back({{"role", "start"}, {"path", "s"}, {"sha256", ""}, {"deviation", 1}});
  EXPECT_TRUE(says(files.told(), "field inputs[2].deviation is said of the file of the role start"))
      << files.told();
}

// ---- programs
// -------------------------------------------------------------------------------------------------

/// The part is turned by half about z and lies at (0.125, -0.25, 0.5), so that 0.5 is left.
struct Written {
  SolidResultFiles files = cube_in_cube();
  std::optional<std::string> program = "G0 X0.125 Y-0.25 Z5.5\nG0 X-0.875 Y-2.25\n";

  Written() {
    Json& r = files.result;
    for (Json* pose : {&r, &r["window"]}) (*pose)["quaternion"] = {0, 0, 0, 1};
    r["x"] = 0.125, r["y"] = -0.25, r["z"] = 0.5, r["clearance"] = 0.5, r["contacts"] = Json::array();
    r["inputs"].push_back({{"role", "nc"}, {"path", "p.nc"}, {"sha256", ""}});
    r["nc"] = {
        {"mode", "coordinates"}, {"scan_frame", "machine"}, {"control", "linuxcnc"},
        {"work_offset", 1},      {"rounding_mm", 0.0625},   {"clearance", 0.4375},
        {"motions", 2},          {"notes", Json::array()},  {"output", {{"path", "out.nc"}, {"sha256", ""}}}};
  }
  [[nodiscard]] std::string told() const {
    const std::string text = files.result.dump();
    LocateInputs inputs{{"result.json", text}, {"part.stl", files.part}, {"blank.stl", files.blank}, {}};
    inputs.program = Document{"p.nc", "G0 X0 Y0 Z5\nG0 X1 Y2\n"};
    if (program) inputs.written_program = Document{"out.nc", *program};
    const auto made = verify_locate(inputs);
    if (!made) return "bad input: " + made.error().message;
    constexpr std::array kNames{"confirmed", "incomplete", "stated regions", "unproved", "refuted"};
    std::string all = kNames[static_cast<std::size_t>(made->verdict)];
    for (const std::string& finding : made->findings) all += "; " + finding;
    return all;
  }
};
std::string written(const char* path, Json value) {
  Written one;
  one.files.result.at(path) = std::move(value);
  return one.told();
}

TEST(SolidProgram, IsTheOriginalMovedAlongAllAxes) {
  EXPECT_EQ(Written{}.told(), "unproved");
  for (const char* other :
       {"G0 X0.625 Y-0.25 Z5.5\nG0 X-0.375 Y-2.25\n", "G0 X0.125 Y0.25 Z5.5\nG0 X-0.875 Y-1.75\n",
        "G0 X0.125 Y-0.25 Z5\nG0 X-0.875 Y-2.25\n", "G0 X0.125 Y-0.25 Z5.5\nG0 X1.125 Y1.75\n"}) {
    Written one;
    one.program = other;
    EXPECT_TRUE(says(one.told(), "refuted; the program out.nc is not p.nc, moved: ")) << one.told();
  }
}

TEST(SolidProgram, KeepsTheClearanceLessItsRounding) {
  EXPECT_TRUE(says(written("/nc/clearance", 0.4376), "refuted; the program's clearance 0.4376 is above"));
  EXPECT_EQ(written("/nc/clearance", 0.25), "unproved");
  EXPECT_TRUE(says(written("/nc/rounding_mm", -0.125), "is above clearance less its rounding"));
  Written exact;
  exact.files.result["nc"]["rounding_mm"] = 0, exact.files.result["nc"]["clearance"] = 0.5;
  EXPECT_EQ(exact.told(), "unproved");
  Written outside;
  for (const char* one : {"clearance", "shortfall"}) outside.files.result[one] = nullptr;
  outside.files.result["inside"] = false;
  EXPECT_TRUE(says(outside.told(), "a program was written, but the part is not in the blank"));
}

TEST(SolidProgram, FollowsNoPartThatLiesTilted) {
  for (const Json& quaternion : {Json{0, 0.001, 0, 1}, Json{0, 0, 0.001, 1}})
    EXPECT_TRUE(says(written("/quaternion", quaternion),
                     "a program was written, but the part lies tilted, which three axes cannot follow"))
        << quaternion;
}

TEST(SolidProgram, IsIncompleteWhereItIsNotThere) {
  Written none;
  none.program.reset();
  EXPECT_EQ(none.told(), "incomplete");
  // What was open before stays open.
  Written unread;
  unread.files.part = "something else\n";
  EXPECT_EQ(unread.told(), "incomplete");
}

}  // namespace
}  // namespace lekalo::verify::verify_solid_claims_test
