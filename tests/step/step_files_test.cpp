#include <sys/wait.h>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRepTools.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "convert.hpp"
#include "e2e/cli_run.hpp"
#include "lekalo/base/random.hpp"
#include "lekalo/io/solid/solid_file.hpp"
#include "lekalo/solid/triangle_tree.hpp"
#include "support/cases.hpp"

namespace lekalo::step::step_files_test {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

bool is_full() { return std::getenv("LEKALO_FULL") != nullptr; }

/// OCCT tells of its work on stdout.
void be_quiet() { Message::DefaultMessenger()->ChangePrinters().Clear(); }

void write_step(const TopoDS_Shape& shape, const fs::path& path) {
  be_quiet();
  STEPControl_Writer writer;
  ASSERT_EQ(writer.Transfer(shape, STEPControl_AsIs), IFSelect_RetDone);
  ASSERT_EQ(writer.Write(path.c_str()), IFSelect_RetDone);
}

/// The faces of the solids of a file, in the order of their numbers.
std::vector<TopoDS_Face> faces_of(const fs::path& path) {
  STEPControl_Reader reader;
  EXPECT_EQ(reader.ReadFile(path.c_str()), IFSelect_RetDone);
  reader.TransferRoots();
  std::vector<TopoDS_Face> faces;
  for (TopExp_Explorer solid(reader.OneShape(), TopAbs_SOLID); solid.More(); solid.Next())
    for (TopExp_Explorer face(solid.Current(), TopAbs_FACE); face.More(); face.Next())
      faces.push_back(TopoDS::Face(face.Current()));
  return faces;
}

/// The largest distance from points of a face to its triangles.
double from_face(const TopoDS_Face& face, const solid::TriangleTree& triangles, int steps) {
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0, farthest = 0;
  BRepTools::UVBounds(face, u0, u1, v0, v1);
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  BRepTopAdaptor_FClass2d inside(forward, 1e-9);
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(forward);
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j) {
      const gp_Pnt2d at(u0 + (u1 - u0) * (i + 0.37) / (steps + 1), v0 + (v1 - v0) * (j + 0.37) / (steps + 1));
      if (inside.Perform(at) != TopAbs_IN) continue;
      const gp_Pnt p = surface->Value(at.X(), at.Y());
      farthest = std::max(farthest, triangles.nearest({p.X(), p.Y(), p.Z()})->high);
    }
  return farthest;
}

/// The largest distance from points of so many of its triangles to a face.
double from_triangles(const TopoDS_Face& face, const solid::Mesh& mesh, std::size_t most) {
  constexpr double kShares[][3] = {{1 / 3., 1 / 3., 1 / 3.}, {0.5, 0.5, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}};
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  ShapeAnalysis_Surface surface(BRep_Tool::Surface(forward));
  BRepTopAdaptor_FClass2d inside(forward, 1e-9);
  double farthest = 0;
  const std::size_t step = std::max<std::size_t>(1, mesh.triangles.size() / most);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += step)
    for (const auto& share : kShares) {
      solid::Vector p;
      for (std::size_t k = 0; k < 3; ++k) p = p + share[k] * mesh.vertices[mesh.triangles[t][k]];
      BRepExtrema_DistShapeShape near(BRepBuilderAPI_MakeVertex(gp_Pnt(p.x, p.y, p.z)).Vertex(), face);
      // OCCT misses some feet on a torus, and finds them on its surface.
      const gp_Pnt2d foot = surface.ValueOfUV(gp_Pnt(p.x, p.y, p.z), 1e-7);
      const bool on_face = inside.Perform(foot) != TopAbs_OUT;
      if (near.IsDone() || on_face)
        farthest = std::max(farthest,
                            std::min(near.IsDone() ? near.Value() : 1e300, on_face ? surface.Gap() : 1e300));
    }
  return farthest;
}

struct Sampled {
  double proved = 0, farthest = 0;
};

/// Holds the deviation of each face against a sampling, which finds no more than what was proved.
Sampled check(const fs::path& path, double deviation) {
  const Result<Converted> made = convert(path, deviation);
  EXPECT_TRUE(made.has_value()) << path << ": " << (made ? "" : made.error().message);
  if (!made) return {};
  const std::vector<TopoDS_Face> faces = faces_of(path);
  EXPECT_EQ(faces.size(), made->faces.size());
  std::vector<solid::Mesh> parts(faces.size());
  for (std::size_t t = 0; t < made->mesh.triangles.size(); ++t) {
    solid::Mesh& part = parts[made->face_of_triangle[t]];
    solid::Triangle own{};
    for (std::size_t k = 0; k < 3; ++k) {
      own[k] = static_cast<std::uint32_t>(part.vertices.size());
      part.vertices.push_back(made->mesh.vertices[made->mesh.triangles[t][k]]);
    }
    part.triangles.push_back(own);
  }
  Sampled worst{made->deviation, 0};
  const int steps = is_full() ? 30 : 8;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    if (parts[k].triangles.empty()) continue;
    const solid::TriangleTree tree(parts[k]);
    const double found =
        std::max(from_face(faces[k], tree, steps), from_triangles(faces[k], parts[k], is_full() ? 40 : 4));
    EXPECT_LE(found, made->faces[k].deviation + 1e-9)
        << path << " face " << k << ", a " << made->faces[k].kind << ", proved " << made->faces[k].deviation;
    worst.farthest = std::max(worst.farthest, found);
  }
  return worst;
}

std::vector<std::pair<std::string, TopoDS_Shape>> primitives() {
  return {{"box", BRepPrimAPI_MakeBox(30, 20, 10).Shape()},
          {"cylinder", BRepPrimAPI_MakeCylinder(12, 30).Shape()},
          {"sector", BRepPrimAPI_MakeCylinder(12, 30, 1.0).Shape()},
          {"cone", BRepPrimAPI_MakeCone(15, 0, 20).Shape()},
          {"frustum", BRepPrimAPI_MakeCone(15, 4, 20).Shape()},
          {"sphere", BRepPrimAPI_MakeSphere(18).Shape()},
          {"torus", BRepPrimAPI_MakeTorus(20, 6).Shape()}};
}

TEST(StepFiles, EveryKindOfSurfaceIsWithinItsDeviation) {
  const TemporaryFolder folder;
  for (const auto& [name, shape] : primitives())
    for (const bool as_splines : {false, true}) {
      if (as_splines && !is_full() && name != "cone") continue;
      SCOPED_TRACE(name + (as_splines ? " as splines" : ""));
      const fs::path path = folder / "part.step";
      write_step(as_splines ? BRepBuilderAPI_NurbsConvert(shape).Shape() : shape, path);
      const double kAsked = is_full() ? 0.05 : 0.3;
      const Sampled found = check(path, kAsked);
      EXPECT_LE(found.proved, kAsked);
      // Not a bound that says nothing: of a round body some share of what is proved is found.
      if (found.proved > 1e-6) {
        EXPECT_GE(found.farthest, found.proved / 4) << found.proved;
      }
    }
}

/// The solids of other people's packages are read, or refused because they hold none, or an open one.
TEST(StepFiles, SolidsOfPackagesAreWithinTheirDeviation) {
  if (!is_full()) GTEST_SKIP() << "takes minutes; LEKALO_FULL=1 runs it";
  const TemporaryFolder folder;
  std::vector<fs::path> files;
  for (const char* const place : {"/usr/share/doc/netgen/examples", "/usr/share/opencascade/data"}) {
    if (!fs::exists(place)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(place)) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::size_t read = 0, refused = 0;
  for (const fs::path& file : files) {
    fs::path step = file;
    if (file.extension() == ".brep") {
      TopoDS_Shape shape;
      ASSERT_TRUE(BRepTools::Read(shape, file.c_str(), BRep_Builder()));
      step = folder / (file.stem().string() + ".step");
      write_step(shape, step);
    } else if (file.extension() != ".step") {
      continue;
    }
    const Result<Converted> made = convert(step, 0.1);
    if (!made) {
      ++refused;
      std::printf("%s: %s\n", step.filename().c_str(), made.error().message.c_str());
      EXPECT_TRUE(made.error().message.find("no solid") != std::string::npos ||
                  made.error().message.find("the surface is open") != std::string::npos)
          << step << ": " << made.error().message;
      continue;
    }
    ++read;
    const Sampled found = check(step, 0.1);
    std::printf("%s: proved %.6f, sampled %.6f\n", step.filename().c_str(), found.proved, found.farthest);
  }
  std::printf("%zu read, %zu refused\n", read, refused);
}

/// Runs the program; returns its exit status and what it says.
std::pair<int, std::string> run_program(const TemporaryFolder& folder, const std::string& words) {
  const fs::path program = fs::path(cases::program()).parent_path() / "lekalo-step";
  const std::string line =
      "cd '" + folder.path().string() + "' && '" + program.string() + "' " + words + " 2>says";
  const int status = std::system(line.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128, test::read_bytes(folder / "says")};
}

/// The places behind the numbers of a word's entities, as "#12".
std::vector<std::string> entities_of(const std::string& step, const std::string& word) {
  std::vector<std::string> numbers;
  const std::regex one("(#[0-9]+) *= *" + word + " *\\(");
  for (std::sregex_iterator at(step.begin(), step.end(), one), end; at != end; ++at)
    numbers.push_back((*at)[1]);
  return numbers;
}

/// Gives an entity of a STEP file a colour, by entities from a number on.
std::string styled(int number, const std::string& colour, const std::string& item) {
  return fmt::format(
      "#{0}={1};\n#{2}=FILL_AREA_STYLE_COLOUR('',#{0});\n#{3}=FILL_AREA_STYLE('',(#{2}));\n"
      "#{4}=SURFACE_STYLE_FILL_AREA(#{3});\n#{5}=SURFACE_SIDE_STYLE('',(#{4}));\n"
      "#{6}=SURFACE_STYLE_USAGE(.BOTH.,#{5});\n#{7}=PRESENTATION_STYLE_ASSIGNMENT((#{6}));\n"
      "#{8}=STYLED_ITEM('color',(#{7}),{9});\n",
      number, colour, number + 1, number + 2, number + 3, number + 4, number + 5, number + 6, number + 7,
      item);
}

TEST(StepProgram, FacesHaveTheColoursOfTheFile) {
  const TemporaryFolder folder;
  write_step(BRepPrimAPI_MakeBox(30, 20, 10).Shape(), folder / "plain.step");
  const std::string plain = test::read_bytes(folder / "plain.step");
  const std::vector<std::string> faces = entities_of(plain, "ADVANCED_FACE"),
                                 bodies = entities_of(plain, "MANIFOLD_SOLID_BREP");
  ASSERT_EQ(faces.size(), 6U);
  ASSERT_EQ(bodies.size(), 1U);
  // The context of a representation of shapes is its last word.
  std::smatch context;
  ASSERT_TRUE(std::regex_search(plain, context,
                                std::regex("ADVANCED_BREP_SHAPE_REPRESENTATION *\\([^;]*(#[0-9]+) *\\) *;")));
  const auto with = [&](const std::string& styles, const std::string& items) {
    std::string step = plain;
    step.insert(step.rfind("ENDSEC;"),
                styles + "#9900=MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',(" + items + ")," +
                    context[1].str() + ");\n");
    return step;
  };
  test::write_bytes(folder / "faces.step",
                    with(styled(9000, "COLOUR_RGB('',1.,0.501960784,0.)", faces[1]) +
                             styled(9100, "DRAUGHTING_PRE_DEFINED_COLOUR('cyan')", faces[4]),
                         "#9007,#9107"));
  test::write_bytes(folder / "body.step", with(styled(9000, "COLOUR_RGB('',0.2,0.2,0.2)", bodies[0]) +
                                                   styled(9100, "COLOUR_RGB('',0.,0.,1.)", faces[0]),
                                               "#9007,#9107"));
  const auto colours = [&](const char* name) {
    EXPECT_EQ(run_program(folder, std::string(name) + ".step -o " + name + ".ply").first, 0);
    auto file = io::parse_solid(test::read_bytes(folder / (std::string(name) + ".ply")), "mesh.ply");
    EXPECT_TRUE(file.has_value()) << file.error().message;
    std::vector<std::uint32_t> found = file->colour_of_face;
    std::sort(found.begin(), found.end());
    return found;
  };
  constexpr std::uint32_t kNone = io::SolidFile::kNoColour;
  using Colours = std::vector<std::uint32_t>;
  EXPECT_EQ(colours("plain"), Colours(6, kNone));
  EXPECT_EQ(colours("faces"), (Colours{0x00ffff, 0xff8000, kNone, kNone, kNone, kNone}));
  EXPECT_EQ(colours("body"), (Colours{0x0000ff, 0x333333, 0x333333, 0x333333, 0x333333, 0x333333}));
}

TEST(StepProgram, WritesAMeshThatIsReadWithItsDeviation) {
  const TemporaryFolder folder;
  write_step(BRepPrimAPI_MakeSphere(18).Shape(), folder / "ball.step");
  const auto [status, says] = run_program(folder, "ball.step -o ball.ply --deviation 0.1");
  ASSERT_EQ(status, 0) << says;
  EXPECT_NE(says.find("ball.ply: "), std::string::npos) << says;
  const auto file = io::parse_solid(test::read_bytes(folder / "ball.ply"), "ball.ply");
  ASSERT_TRUE(file.has_value()) << file.error().message;
  EXPECT_TRUE(file->notices.empty());
  ASSERT_TRUE(file->deviation.has_value());
  EXPECT_GT(*file->deviation, 0.01);
  EXPECT_LE(*file->deviation, 0.1);
  // The same bytes again.
  const std::string first = test::read_bytes(folder / "ball.ply");
  ASSERT_EQ(run_program(folder, "ball.step -o ball.ply --deviation 0.1").first, 0);
  EXPECT_EQ(test::read_bytes(folder / "ball.ply"), first);
}

TEST(StepProgram, RefusesWhatIsNoSolid) {
  const TemporaryFolder folder;
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(30, 20, 10).Shape();
  write_step(TopExp_Explorer(box, TopAbs_FACE).Current(), folder / "face.step");
  test::write_bytes(folder / "empty.step", "");
  for (const auto& [words, sentence] : std::vector<std::pair<std::string, std::string>>{
           {"face.step -o a.ply",
            "face.step: there is no solid in this STEP file; export the body as a solid"},
           {"empty.step -o a.ply", "empty.step: this is no STEP file that can be read"},
           {"none.step -o a.ply", "none.step: No such file or directory"},
           {"face.step", "give a STEP file and -o OUT.ply"},
           {"face.step -o a.ply --deviation 0", "--deviation takes a number from 1e-06 to 1000, not '0'"}}) {
    const auto [status, says] = run_program(folder, words);
    EXPECT_EQ(status, 2) << words;
    EXPECT_NE(says.find(sentence), std::string::npos) << words << ": " << says;
    EXPECT_EQ(std::count(says.begin(), says.end(), '\n'), 1) << says;
  }
  EXPECT_FALSE(fs::exists(folder / "a.ply"));
}

/// Whatever is done to a file: a mesh, or one sentence, soon.
TEST(StepProgram, DamagedFilesGiveOneSentence) {
  const TemporaryFolder folder;
  std::vector<std::string> sources;
  for (const auto& [name, shape] : primitives()) {
    const TopoDS_Shape splines = BRepBuilderAPI_NurbsConvert(shape).Shape();
    for (const TopoDS_Shape& one : {shape, splines}) {
      write_step(one, folder / "source.step");
      sources.push_back(test::read_bytes(folder / "source.step"));
    }
  }
  Random random(cases::seed());
  const int count = is_full() ? 2000 : 3;
  for (int k = 0; k < count; ++k) {
    std::string bytes = sources[random.below(sources.size())];
    const std::size_t changes = 1 + random.below(4);
    for (std::size_t change = 0; change < changes; ++change) {
      const std::size_t at = random.below(bytes.size());
      switch (random.below(4)) {
        case 0:
          bytes[at] = static_cast<char>(random.below(256));
          break;
        case 1:
          bytes.erase(at, 1 + random.below(40));
          break;
        case 2:
          bytes.insert(at, bytes.substr(random.below(bytes.size()), 1 + random.below(40)));
          break;
        default:
          if (const std::size_t digit = bytes.find_first_of("0123456789", at); digit != std::string::npos)
            bytes[digit] = static_cast<char>('0' + random.below(10));
      }
    }
    test::write_bytes(folder / "changed.step", bytes);
    const auto [status, says] =
        run_program(folder, "changed.step -o changed.ply --deviation 0.2 --memory 2000 --seconds " +
                                std::string(is_full() ? "10" : "1"));
    EXPECT_TRUE(status == 0 || status == 2) << "case " << k << ": " << status << " " << says;
    EXPECT_TRUE(says.starts_with("lekalo-step: ")) << "case " << k << ": " << says;
    if (status == 2) {
      EXPECT_EQ(std::count(says.begin(), says.end(), '\n'), 1) << "case " << k << ": " << says;
    }
  }
}

}  // namespace
}  // namespace lekalo::step::step_files_test
