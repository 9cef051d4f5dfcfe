#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "lekalo/disk/files.hpp"
#include "lekalo/geom/region_check.hpp"
#include "lekalo/io/drawing/drawing_regions.hpp"
#include "lekalo/io/formats/drawing_formats.hpp"
#include "support/shared_data.hpp"

// Drawings of other programs, LEKALO_SHARED_DATA/drawings: what is enclosed is taken, no curve is lost, and
// the loss is what was promised. Run alone it prints a line for each file.

namespace lekalo::io::io_drawing_repair_test {
namespace {

namespace fs = std::filesystem;

TEST(IoDrawingRepair, NoCurveIsLostAndTheLossIsSmall) {
  if (cases::shared_data().empty()) GTEST_SKIP() << "LEKALO_SHARED_DATA is not set";
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(cases::shared_data() + "/drawings"))
    if (entry.path().extension() != ".md" && entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  ASSERT_GE(files.size(), 100u);
  std::vector<double> losses;
  std::size_t wide = 0;  // with a gap that no bridge closes within 0.05 mm
  std::size_t unread = 0, empty = 0;
  const DrawingOptions how;
  for (const fs::path& path : files) {
    const std::string name = path.filename().string();
    SCOPED_TRACE(name);
    const auto bytes = disk::read_file(path.string());
    ASSERT_TRUE(bytes);
    const DrawingFormat* const format = drawing_format_by_content(*bytes);
    const auto drawing = format == nullptr ? Result<Drawing>(failure(ErrorCode::bad_input, "no drawing"))
                                           : format->parse(*bytes, name, std::nullopt);
    if (!drawing) {
      std::printf("%s: %s\n", name.c_str(), drawing.error().message.c_str()), ++unread;
      continue;
    }
    const auto found = make_regions(*drawing, how);
    if (!found) {
      // One sentence says that nothing is enclosed; everything else is a needless no.
      const std::string& says = found.error().message;
      EXPECT_TRUE(says.find("closes a contour") != std::string::npos ||
                  says.find("there are no curves") != std::string::npos)
          << says;
      std::printf("%s: %s\n", name.c_str(), says.c_str()), ++empty;
      continue;
    }
    for (const geom::Region& region : found->regions) {
      const auto fault = geom::fault_of({region});
      EXPECT_FALSE(fault) << *fault;
    }
    std::vector<char> seen(drawing->curves.size(), 0);
    for (const std::uint32_t curve : found->curve_of_edge) seen[curve] = 1;
    for (const Mark& mark : found->marks)
      for (const std::uint32_t curve : mark.curve_of_edge) seen[curve] = 1;
    for (const SetAside& aside : found->set_aside)
      for (const std::uint32_t curve : aside.curves) seen[curve] = 1;
    for (const auto* list : {&found->duplicates, &found->specks, &found->cut_off})
      for (const std::uint32_t curve : *list) seen[curve] = 1;
    for (std::size_t i = 0; i < seen.size(); ++i)
      EXPECT_TRUE(seen[i] != 0 || drawing->layers[drawing->curves[i].layer].hidden) << "curve " << i;
    losses.push_back(found->tolerance);
    wide += std::any_of(found->gaps.begin(), found->gaps.end(),
                        [](const JoinedGap& gap) { return gap.size > 2 * 0.05; })
                ? 1
                : 0;
    EXPECT_LE(found->repaired, how.repair);
    EXPECT_LE(found->tolerance - found->coordinate_error,
              how.repair + how.join_tolerance + how.curve_tolerance);
    std::printf("%s: %zu regions, %zu marks, %zu set aside, %zu cut off, tolerance %.4g\n", name.c_str(),
                found->regions.size(), found->marks.size(), found->set_aside.size(), found->cut_off.size(),
                found->tolerance);
  }
  std::sort(losses.begin(), losses.end());
  const auto small = static_cast<std::size_t>(
      std::count_if(losses.begin(), losses.end(), [](double loss) { return loss <= 0.05; }));
  std::printf(
      "%zu read, %zu enclose nothing, %zu not read; loss: median %.4g, %zu of %zu at most 0.05 mm, "
      "%zu have wider gaps\n",
      losses.size(), empty, unread, losses[losses.size() / 2], small, losses.size(), wide);
  EXPECT_LE(losses[losses.size() / 2], 0.01);
  // A bridge over a gap is half of it away from both ends, whatever its shape.
  EXPECT_GE(static_cast<double>(small), 0.95 * static_cast<double>(losses.size() - wide));
}

}  // namespace
}  // namespace lekalo::io::io_drawing_repair_test
