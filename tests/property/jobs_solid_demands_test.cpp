// Random demands by face of random solids: the checker, which rebuilds them from the file, confirms each
// result.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lekalo/jobs/locate_solid.hpp"
#include "support/cases.hpp"
#include "support/solid_cases.hpp"
#include "support/solid_files.hpp"

namespace lekalo::jobs::jobs_solid_demands_test {
namespace {

/// Up to two datums: points of the part lie where they are in its file, more or less.
std::string datums_of(const solid::Mesh& part, Random& random) {
  std::string datums;
  for (std::size_t k = random.below(3); k > 0; --k) {
    const solid::Vector p = part.vertices[random.below(part.vertices.size())],
                        q = p + random.uniform(-0.2, 0.2) * cases::direction(random),
                        n = cases::direction(random);
    const std::string place = fmt::format("[{}, {}, {}]", q.x, q.y, q.z),
                      way = fmt::format("[{}, {}, {}]", n.x, n.y, n.z);
    const std::string on[]{fmt::format(R"("plane": {{"normal": {}, "through": {}}})", way, place),
                           fmt::format(R"("axis": {{"along": {}, "through": {}}})", way, place),
                           fmt::format(R"("point": {})", place)};
    datums += fmt::format(R"({}{{"name": "datum {}", "points": [[{}, {}, {}]], {}, "within": {}}})",
                          datums.empty() ? "" : ", ", k, p.x, p.y, p.z, on[random.below(3)],
                          random.uniform(0.1, 1));
  }
  return datums;
}

/// Triangles dealt out to three features, or to none; one feature may be as cast.
std::string features_of(const solid::Mesh& part, bool as_cast, Random& random) {
  std::vector<std::string> numbers(4);
  for (std::size_t t = 0; t < part.triangles.size(); ++t) {
    std::string& list = numbers[random.below(4)];
    list += (list.empty() ? "" : ", ") + std::to_string(t);
  }
  std::string features;
  // One feature may have a maximum.
  const std::string maximum =
      random.below(3) != 0 ? "" : fmt::format(R"("maximum": {:.3f}, )", random.uniform(1.1, 3));
  // It may be finished, too.
  const std::string rough = random.below(2) == 0 ? R"("as_cast": true)"
                                                 : fmt::format(R"("finished": {:.3f}, "rim": {:.3f})",
                                                               random.uniform(1, 5), random.uniform(0, 0.5));
  for (std::size_t k = 0; k < 3; ++k)
    features += fmt::format(
        R"({}{{"name": "{}", "triangles": [{}], {}}})", k == 0 ? "" : ", ", k, numbers[k],
        k == 2 && as_cast ? rough
                          : fmt::format(R"({}"minimum": {:.3f}, "scale": {:.2f})", k == 0 ? maximum : "",
                                        random.uniform(0, 1), random.uniform(0.5, 2)));
  return fmt::format(R"({{"minimum": {:.3f}, "features": [{}], "datums": [{}]}})", random.uniform(0, 0.5),
                     features, datums_of(part, random));
}

TEST(SolidDemands, EveryResultIsConfirmed) {
  Random random(cases::seed(), 71);
  std::size_t inside = 0, met = 0;
  for (std::uint64_t k = 0; k < cases::case_count(3); ++k) {
    cases::SolidCase pair = k % 4 == 0   ? cases::convex_in_convex(random, 14, random.uniform(0.2, 1.5))
                            : k % 4 == 1 ? cases::turned_part(random, 8)
                            : k % 4 == 2 ? cases::wavy_part(random, 5)
                                         : cases::cored_block(random, 2);
    SCOPED_TRACE(pair.kind);
    SolidLocateJob job;
    // Some triangles look into the material, and are turned round.
    for (solid::Triangle& t : pair.part.triangles)
      if (random.below(4) == 0) std::swap(t[1], t[2]);
    job.part = {"part.stl", solid_files::stl_text(pair.part)};
    // The mesh of a STEP file now and then, which deviates.
    if (random.below(3) == 0)
      job.part = {"part.ply",
                  solid_files::step_mesh(pair.part, fmt::format("{:.4f}", random.uniform(0, 0.1)),
                                         std::vector<std::uint32_t>(pair.part.triangles.size()), {""})};
    job.blank = {"casting.stl", solid_files::stl_binary(pair.blank)};
    job.features = File{"features.json", features_of(pair.part, random.below(2) == 0, random)};
    job.options.gap = 0.1;
    RunControl run;
    run.work_limit = 2000;
    const Result<LocatedSolid> located = locate_solid(job, run);
    ASSERT_TRUE(located.has_value()) << located.error().message;
    const io::SolidDocument& d = located->document;
    ASSERT_TRUE(d.demands.has_value());
    ASSERT_TRUE(d.demands->margin_bound.has_value());
    inside += d.inside() ? 1 : 0;
    met += located->holds() ? 1 : 0;
  }
  if (cases::case_count(3) > 20) {
    EXPECT_GT(inside, 0U);
    EXPECT_GT(met, 0U);
  }
}

}  // namespace
}  // namespace lekalo::jobs::jobs_solid_demands_test
