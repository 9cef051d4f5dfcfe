#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lekalo/disk/files.hpp"
#include "lekalo/io/contour/contour_file.hpp"
#include "support/cases.hpp"
#include "support/io_contours.hpp"
#include "support/json.hpp"
#include "support/places.hpp"

// Files of this folder, many written by a DXF library that is not ours (data/contours/generate.py), with what
// must be found in them; each contour again in every position and writing.

namespace lekalo::io_contours_test {
namespace {

const std::string kFolder = cases::source_dir() + "/tests/corpus/data/contours/";

cases::Json index() { return cases::Json::parse(*disk::read_file(kFolder + "index.json")); }

Result<io::ContourFile> read(const std::string& file) {
  return io::parse_contour(*disk::read_file(kFolder + file), file, std::nullopt);
}

std::vector<std::size_t> indices(const cases::Json& list) {
  std::vector<std::size_t> all;
  for (const cases::Json& one : list) all.push_back(one.get<std::size_t>());
  return all;
}

TEST(IoCorpus, HasCases) { EXPECT_GE(index().size(), 20U); }

TEST(IoCorpus, EachFileIsReadRightOrRefusedWithAClearWord) {
  for (const auto& expected : index()) {
    const std::string name = expected["file"];
    SCOPED_TRACE(name);
    const auto file = read(name);
    const auto contour = file ? io::make_convex(*file) : tl::unexpected(file.error());
    if (expected.contains("refused")) {
      ASSERT_FALSE(contour.has_value());
      EXPECT_NE(contour.error().message.find(expected["refused"].get<std::string>()), std::string::npos)
          << contour.error().message;
      continue;
    }
    ASSERT_TRUE(contour.has_value()) << contour.error().message;
    EXPECT_EQ(contour->reversed, expected["reversed"].get<bool>());
    if (expected.contains("points")) {
      const double scale = expected.contains("inch") ? 25.4 : 1;
      ASSERT_EQ(file->points.size(), expected["points"].size());
      for (std::size_t i = 0; i < file->points.size(); ++i) {
        EXPECT_DOUBLE_EQ(file->points[i].x, scale * expected["points"][i][0].get<double>());
        EXPECT_DOUBLE_EQ(file->points[i].y, scale * expected["points"][i][1].get<double>());
      }
      EXPECT_EQ(contour->dropped, indices(expected["dropped"]));
    } else {
      std::vector<std::size_t> kept = contour->file_index_of_vertex, all(file->points.size());
      std::sort(kept.begin(), kept.end());
      std::iota(all.begin(), all.end(), std::size_t{0});
      EXPECT_EQ(kept, expected["corners"] == "all" ? all : indices(expected["corners"]));
    }
  }
}

/// A motion of the plane: its own inverse is not needed, only that vertices go to vertices.
struct Motion {
  const char* name;
  double cosine, sine;
  bool mirrored;
  geom::Point move;
  bool exact;  ///< rounds nothing

  [[nodiscard]] geom::Point operator()(geom::Point p) const {
    if (mirrored) p.x = -p.x;
    return geom::Point{cosine * p.x - sine * p.y, sine * p.x + cosine * p.y} + move;
  }
};

TEST(IoCorpus, EachContourIsTheSamePolygonTurnedMirroredReversedMovedAndDoubled) {
  const Motion motions[] = {{"as it is", 1, 0, false, {}, true},
                            {"a quarter turn", 0, 1, false, {}, true},
                            {"half a turn", -1, 0, false, {}, true},
                            {"mirrored", 1, 0, true, {}, true},
                            {"mirrored and turned", 0, -1, true, {}, true},
                            {"turned by 0.3", std::cos(0.3), std::sin(0.3), false, {}, false},
                            {"moved", 1, 0, false, {1000.3, -77.7}, false},
                            {"mirrored, turned, moved", std::cos(2), std::sin(2), true, {-3e4, 12.3}, false}};
  for (const auto& expected : index()) {
    if (expected.contains("refused")) continue;
    const std::string name = expected["file"];
    const auto file = read(name);
    ASSERT_TRUE(file.has_value());
    const auto original = io::make_convex(*file);
    ASSERT_TRUE(original.has_value());
    std::vector<std::size_t> kept = original->file_index_of_vertex;
    std::sort(kept.begin(), kept.end());
    const std::size_t n = file->points.size();
    for (const Motion& motion : motions) {
      for (const bool reversed : {false, true}) {
        for (const std::size_t start : {std::size_t{0}, std::size_t{1}, n / 2, n - 1}) {
          for (const std::size_t copies : {1U, 2U}) {
            SCOPED_TRACE(fmt::format("{} {} reversed {} start {} copies {}", name, motion.name, reversed,
                                     start, copies));
            io::ContourFile other = *file;
            std::vector<std::size_t> from;  // index in the original of each point
            for (std::size_t i = 0; i < n; ++i) {
              const std::size_t k = reversed ? (start + n - i) % n : (start + i) % n;
              from.insert(from.end(), copies, k);
            }
            other.points.clear();
            other.places.assign(from.size(), 1);
            for (const std::size_t k : from) other.points.push_back(motion(file->points[k]));
            if (!motion.exact) {
              // Each step of the motion rounds once more.
              other.coordinate_error +=
                  4 * 0x1p-53 *
                  std::max(geom::largest_coordinate(other.points), geom::largest_coordinate(file->points));
            }
            const auto contour = io::make_convex(other);
            ASSERT_TRUE(contour.has_value()) << contour.error().message;
            EXPECT_EQ(contour->reversed, (original->reversed != reversed) != motion.mirrored);
            std::vector<geom::Point> places, wanted;
            for (const std::size_t k : contour->file_index_of_vertex) places.push_back(file->points[from[k]]);
            for (const std::size_t k : kept) wanted.push_back(file->points[k]);
            const auto order = [](geom::Point a, geom::Point b) {
              return a.x != b.x ? a.x < b.x : a.y < b.y;
            };
            std::sort(places.begin(), places.end(), order);
            std::sort(wanted.begin(), wanted.end(), order);
            EXPECT_EQ(places, wanted);
            EXPECT_EQ(contour->dropped.size() + contour->polygon.size(), other.points.size());
          }
        }
      }
    }
  }
}

TEST(IoCorpus, EachContourTrimsToItselfWithinRounding) {
  for (const auto& expected : index()) {
    if (expected.contains("refused")) continue;
    SCOPED_TRACE(expected["file"].get<std::string>());
    const auto file = read(expected["file"]);
    const auto contour = io::make_convex(*file);
    const auto trimmed = io::trim_to_convex(*file, 0);
    ASSERT_TRUE(trimmed.has_value()) << trimmed.error().message;
    const double small = 1e-13 * geom::largest_coordinate(file->points);
    EXPECT_LE(trimmed->loss, small);
    EXPECT_NEAR(geom::signed_area(trimmed->polygon.vertices()),
                geom::signed_area(contour->polygon.vertices()),
                10 * static_cast<double>(contour->polygon.size()) * small *
                    (1 + geom::largest_coordinate(file->points)));
  }
}

}  // namespace
}  // namespace lekalo::io_contours_test
