// Solids that are written and read again, polygons that are cut, and mutated files.

#include "lekalo/io/solid/solid_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "io/solid/polygon.hpp"
#include "support/cases.hpp"
#include "support/solid_files.hpp"
#include "support/solids.hpp"
#include "support/three_mf_files.hpp"

namespace lekalo::io::io_solid_test {
namespace {

using solid::Mesh;
using solid::Vector;

Mesh random_mesh(Random& random) {
  const auto count = [&] { return 3 + static_cast<std::uint32_t>(random.below(12)); };
  Mesh mesh = cases::ring(random, count(), count(), random.uniform(5, 500), random.uniform(0.01, 4));
  const std::uint64_t far = random.below(3);
  const Vector by{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  for (Vector& p : mesh.vertices) p = p + (far == 0 ? 0 : far == 1 ? 100 : 1e7) * by;
  return mesh;
}

Mesh in_single_precision(Mesh mesh) {
  for (Vector& p : mesh.vertices)
    for (double* const c : {&p.x, &p.y, &p.z}) *c = static_cast<double>(static_cast<float>(*c));
  return mesh;
}

/// Each triangle with vertices of its own, as an STL has it.
Mesh loose(const Mesh& mesh) {
  Mesh made;
  for (const solid::Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(made.vertices.size());
    for (const std::uint32_t v : t) made.vertices.push_back(mesh.vertices[v]);
    made.triangles.push_back({first, first + 1, first + 2});
  }
  return made;
}

void expect_read(const std::string& bytes, std::string_view format, const Mesh& wanted) {
  const FileFormat* const found = solid_format_by_content(bytes);
  ASSERT_NE(found, nullptr) << format;
  EXPECT_EQ(found->name, format);
  const auto read = parse_solid(bytes, "a", {SolidUnit::millimetre});
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_TRUE(read->mesh.vertices == wanted.vertices) << format;
  EXPECT_TRUE(read->mesh.triangles == wanted.triangles) << format;
}

TEST(SolidFile, EveryFormatReadsBackToTheSameNumbers) {
  for (std::size_t i = 0; i < cases::case_count(40); ++i) {
    SCOPED_TRACE(fmt::format("seed {} case {}", cases::seed(), i));
    Random random(cases::seed(), i);
    const Mesh mesh = random_mesh(random), single = in_single_precision(mesh);
    expect_read(solid_files::stl_text(mesh), "STL", loose(mesh));
    expect_read(solid_files::stl_binary(mesh), "STL", loose(single));
    expect_read(solid_files::obj(mesh), "OBJ", mesh);
    expect_read(three_mf_files::archive(mesh), "3MF", mesh);
    expect_read(solid_files::points(mesh.vertices, " ,;\t"[random.below(4)]), "points", {mesh.vertices, {}});
    for (const solid_files::PlyForm form : solid_files::kPlyForms) {
      for (const bool faces_first : {false, true}) {
        expect_read(solid_files::ply<double>(mesh, form, faces_first), "PLY", mesh);
        if (form != solid_files::PlyForm::text)
          expect_read(solid_files::ply<float>(mesh, form, faces_first), "PLY", single);
      }
      expect_read(solid_files::ply<double>({mesh.vertices, {}}, form), "PLY", {mesh.vertices, {}});
    }
    for (const std::string& bytes : {solid_files::stl_text(mesh), solid_files::obj(mesh)}) {
      const auto closed = solid::closed_mesh(parse_solid(bytes, "a")->mesh);
      ASSERT_TRUE(closed) << closed.error().message;
      ASSERT_EQ(closed->shells.size(), 1u);
      EXPECT_GT(closed->shells[0].volume, 0);
    }
  }
}

TEST(SolidFile, OtherUnitsAreWithinTheErrorThatIsSaid) {
  for (std::size_t i = 0; i < cases::case_count(40); ++i) {
    Random random(cases::seed(), i);
    const Mesh mesh = cases::ring(random, 5, 4, 50, 3);
    for (const auto& [unit, factor] :
         {std::pair(SolidUnit::inch, 25.4L), std::pair(SolidUnit::metre, 1000.L)}) {
      for (const bool binary : {true, false}) {
        const auto read = parse_solid(
            binary ? solid_files::ply<double>(mesh, solid_files::PlyForm::big) : solid_files::obj(mesh), "a",
            {unit});
        ASSERT_TRUE(read) << read.error().message;
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
          const Vector is = read->mesh.vertices[v], was = mesh.vertices[v];
          for (const double Vector::*const c : {&Vector::x, &Vector::y, &Vector::z}) {
            const long double exact = factor * static_cast<long double>(was.*c);
            // A text has the shortest decimal of the double, half a unit in its last place away or less.
            const long double written = binary ? 0 : std::abs(exact) * 0x1p-53L;
            EXPECT_LE(std::abs(static_cast<long double>(is.*c) - exact),
                      static_cast<long double>(read->coordinate_error) + written);
          }
        }
      }
    }
  }
}

/// A flat polygon about the origin, perhaps with dents and corners along straight edges, on a tilted plane.
std::vector<Vector> polygon(Random& random, std::size_t corners, bool with_dents) {
  const Vector u{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  Vector v = cross(u, {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
  v = (norm(u) / norm(v)) * v;
  std::vector<Vector> all;
  for (std::size_t k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(corners);
    const double r = with_dents ? random.uniform(0.2, 1) : 1;
    all.push_back(r * std::cos(angle) * u + r * std::sin(angle) * v);
  }
  return all;
}

Vector area_of(const std::vector<Vector>& p, const solid::Triangle& t) {
  return 0.5 * cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
}

TEST(SolidPolygon, TrianglesCoverThePolygonOnce) {
  for (std::size_t i = 0; i < cases::case_count(300); ++i) {
    SCOPED_TRACE(fmt::format("seed {} case {}", cases::seed(), i));
    Random random(cases::seed(), i);
    const std::size_t n = 4 + random.below(40);
    const std::vector<Vector> corners = polygon(random, n, i % 2 == 0);
    std::vector<std::uint32_t> numbers(n);
    std::iota(numbers.begin(), numbers.end(), 0U);
    std::rotate(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(random.below(n)),
                numbers.end());
    std::vector<solid::Triangle> triangles;
    PolygonCutter cutter;
    EXPECT_EQ(cutter.cut(corners, numbers, triangles), "");
    ASSERT_EQ(triangles.size(), n - 2);
    EXPECT_LT(cutter.unevenness(), 1e-12);
    // All are turned as the polygon is, and their areas make up its own: so they cover it once.
    Vector whole;
    for (std::size_t k = 0; k < n; ++k) whole = whole + 0.5 * cross(corners[k], corners[(k + 1) % n]);
    double sum = 0;
    for (const solid::Triangle& t : triangles) {
      const Vector area = area_of(corners, t);
      EXPECT_GT(dot(area, whole), 0);
      sum += norm(area);
    }
    EXPECT_NEAR(sum, norm(whole), 1e-9 * norm(whole));
  }
}

TEST(SolidPolygon, ARimThatGoesToItsHoleAndBackIsCut) {
  for (std::size_t i = 0; i < cases::case_count(300); ++i) {
    SCOPED_TRACE(fmt::format("seed {} case {}", cases::seed(), i));
    Random random(cases::seed(), i);
    const std::size_t n = 3 + random.below(20), m = 3 + random.below(20);
    std::vector<Vector> corners;
    for (std::size_t k = 0; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n);
      corners.push_back({9 * std::cos(angle), 9 * std::sin(angle), 0});
    }
    for (std::size_t k = 0; k < m; ++k) {  // the other way round, within the circle in a triangle
      const double angle = -2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(m);
      const double r = random.uniform(1, 4);
      corners.push_back({r * std::cos(angle), r * std::sin(angle), 0});
    }
    std::vector<std::uint32_t> rim;
    for (std::uint32_t k = 0; k < n; ++k) rim.push_back(k);
    rim.push_back(0);
    for (std::uint32_t k = 0; k <= m; ++k) rim.push_back(static_cast<std::uint32_t>(n + k % m));
    std::vector<solid::Triangle> triangles;
    PolygonCutter cutter;
    EXPECT_EQ(cutter.cut(corners, rim, triangles), "");
    double sum = 0, whole = 0;
    for (std::size_t k = 0; k < rim.size(); ++k)
      whole += 0.5 * cross(corners[rim[k]], corners[rim[(k + 1) % rim.size()]]).z;
    for (const solid::Triangle& t : triangles) {
      EXPECT_GT(area_of(corners, t).z, 0);
      sum += area_of(corners, t).z;
    }
    EXPECT_NEAR(sum, whole, 1e-9 * whole);
  }
}

/// Bytes are changed, left out, doubled and cut off.
std::string mutated(Random& random, std::string bytes) {
  for (std::uint64_t changes = 1 + random.below(4); changes > 0 && !bytes.empty(); --changes) {
    const std::size_t at = random.below(bytes.size()),
                      length = random.below(std::min<std::size_t>(bytes.size() - at, 60)) + 1;
    switch (random.below(5)) {
      case 0:
        bytes[at] = static_cast<char>(random.below(256));
        break;
      case 1:
        bytes[at] = "0123456789.-+e \n/"[random.below(17)];
        break;
      case 2:
        bytes.erase(at, length);
        break;
      case 3:
        bytes.insert(at, bytes.substr(random.below(bytes.size()), length));
        break;
      default:
        if (random.below(8) == 0)
          bytes.resize(at);
        else
          bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.below(8)));
    }
  }
  return bytes;
}

TEST(SolidFile, MutatedFilesAreReadOrRefusedWithASentence) {
  Random shape(1);
  const Mesh mesh = cases::ring(shape, 4, 3, 50, 3);
  std::vector<std::string> seeds{
      solid_files::stl_text(mesh),
      solid_files::stl_binary(mesh),
      solid_files::obj(mesh),
      solid_files::points(mesh.vertices),
      three_mf_files::archive(mesh),
      "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\ng a b\nf 1 2 3 4 5\nf -1 -2 -3\n"};
  for (const solid_files::PlyForm form : solid_files::kPlyForms)
    seeds.push_back(solid_files::ply<float>(mesh, form, form == solid_files::PlyForm::big));
  constexpr const char* kNames[] = {"a.stl", "a.obj", "a.ply", "a.xyz", "a"};
  std::size_t read = 0;
  const std::size_t count = cases::case_count(2000);
  for (std::size_t i = 0; i < count; ++i) {
    SCOPED_TRACE(fmt::format("seed {} case {}", cases::seed(), i));
    Random random(cases::seed(), i);
    const std::string bytes = mutated(random, seeds[i % seeds.size()]), name = kNames[random.below(5)];
    const auto file = parse_solid(bytes, name);
    if (!file) {
      const std::string& said = file.error().message;
      EXPECT_EQ(said.rfind(name + ": ", 0), 0u) << said;
      EXPECT_LT(said.size(), 400u) << said;
      EXPECT_TRUE(std::all_of(said.begin(), said.end(),
                              [](char c) { return static_cast<unsigned char>(c) >= 0x20; }));
      continue;
    }
    ++read;
    for (const Vector p : file->mesh.vertices)
      for (const double c : {p.x, p.y, p.z}) EXPECT_LE(std::abs(c), 1e9);
    for (const solid::Triangle& t : file->mesh.triangles)
      for (const std::uint32_t v : t) EXPECT_LT(v, file->mesh.vertices.size());
    EXPECT_EQ(file->group_of_triangle.size(), file->groups.empty() ? 0 : file->mesh.triangles.size());
    if (!file->mesh.triangles.empty()) static_cast<void>(solid::closed_mesh(file->mesh));
  }
  EXPECT_GT(read, count / 20);
}

}  // namespace
}  // namespace lekalo::io::io_solid_test
