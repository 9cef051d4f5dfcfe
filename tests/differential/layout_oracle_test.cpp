// layout::check against another library (shapely, tests/support/layout_oracle.py), which places the outlines
// in doubles from the rule of docs/design/layout.md; and against the independent checker, which decides
// exactly.

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "lekalo/disk/files.hpp"
#include "lekalo/disk/open_layout.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/layout/check.hpp"
#include "lekalo/layout/session.hpp"
#include "lekalo/verify/layout.hpp"
#include "support/cases.hpp"
#include "support/crowded_layouts.hpp"
#include "support/json.hpp"
#include "support/layout_cases.hpp"
#include "support/places.hpp"
#include "support/shared_data.hpp"

namespace lekalo::layout_oracle_test {
namespace {

using cases::Json;
using layout::Document;
using layout::Session;
using layout::Violation;
using layout::ViolationKind;

const std::string kOracle = cases::source_dir() + "/tests/support/layout_oracle.py";
const std::string kHides = cases::source_dir() + "/tests/corpus/data/hides/";

/// The interpreter that has shapely; Debian's own is not always the first in the path. Empty: none.
std::string python_with_shapely() {
  for (const char* python : {"python3", "/usr/bin/python3"})
    if (std::system(fmt::format("{} {} probe 2>/dev/null", python, kOracle).c_str()) == 0) return python;
  return {};
}

std::string feature_of(const Document& document, const Violation& v) {
  const layout::Stock& stock = document.stocks[v.stock];
  if (v.kind == ViolationKind::defect || v.kind == ViolationKind::defect_gap)
    return stock.defects[v.feature].id;
  return v.kind == ViolationKind::quality ? stock.zones[v.feature].id : "";
}

/// Layouts to be judged, with what layout::check says of them.
class Cases {
 public:
  void add(const std::string& name, const Document& document) {
    Json violations = Json::array();
    for (const Violation& v : layout::check(document)) {
      const std::string feature = feature_of(document, v);
      const bool directed = v.direction.x != 0 || v.direction.y != 0;
      violations.push_back({{"kind", std::string(layout::name_of(v.kind))},
                            {"a", v.a},
                            {"b", v.b == 0 ? Json(nullptr) : Json(v.b)},
                            {"feature", feature.empty() ? Json(nullptr) : Json(feature)},
                            {"amount_mm", v.amount_mm},
                            {"at", {v.at.x, v.at.y}},
                            {"direction", directed ? Json{v.direction.x, v.direction.y} : Json(nullptr)}});
    }
    cases_.push_back({{"name", name},
                      {"layout", Json::parse(io::write_layout(document))},
                      {"violations", std::move(violations)}});
  }
  [[nodiscard]] std::size_t size() const { return cases_.size(); }

  /// What the oracle says of them all; null where it fails.
  [[nodiscard]] Json judged(const std::string& python) const {
    const auto path = std::filesystem::temp_directory_path() /
                      fmt::format("lekalo-layouts-{}.json", static_cast<unsigned long>(::getpid()));
    std::ofstream(path) << cases_.dump();
    FILE* pipe = popen(fmt::format("{} {} '{}'", python, kOracle, path.string()).c_str(), "r");
    std::string text;
    std::array<char, 65536> buffer{};
    for (std::size_t n = 0; pipe != nullptr && (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
      text.append(buffer.data(), n);
    const bool done = pipe != nullptr && pclose(pipe) == 0;
    std::filesystem::remove(path);
    return done ? Json::parse(text) : Json(nullptr);
  }

 private:
  Json cases_ = Json::array();
};

/// Asks the oracle and fails with its complaints. \return violations that both sides found, by kind
std::map<std::string, std::size_t> agree(const Cases& cases) {
  const std::string python = python_with_shapely();
  EXPECT_FALSE(python.empty()) << "python3-shapely is not installed (tools/setup.sh installs it)";
  if (python.empty()) return {};
  const Json said = cases.judged(python);
  EXPECT_TRUE(said.is_object()) << "layout_oracle.py failed";
  if (!said.is_object()) return {};
  EXPECT_EQ(said["documents"], cases.size());
  for (std::size_t i = 0; i < std::min<std::size_t>(said["complaints"].size(), 20); ++i)
    ADD_FAILURE() << said["complaints"][i].get<std::string>();
  std::printf("%s layouts: found %s, %s relations that hold, %s too close to call\n",
              said["documents"].dump().c_str(), said["found"].dump().c_str(), said["absent"].dump().c_str(),
              said["close"].dump().c_str());
  std::map<std::string, std::size_t> found;
  for (const std::string& kind : said["found"].keys()) found[kind] = said["found"][kind].get<std::size_t>();
  return found;
}

geom::GridPoint middle_of(const geom::GridBox& box) {
  return {(box.low.x + box.high.x) / 2, (box.low.y + box.high.y) / 2};
}

/// Middles of the defects, zones and holes of a stock.
std::vector<geom::GridPoint> bad_places(const layout::Stock& stock) {
  std::vector<geom::GridPoint> places;
  for (const layout::Defect& defect : stock.defects)
    places.push_back(middle_of(bounds(defect.outline.polygon)));
  for (const layout::QualityZone& zone : stock.zones)
    places.push_back(middle_of(bounds(zone.outline.polygon)));
  const geom::GridRegion& outline = stock.outline.polygon;
  for (std::size_t l = 1; l < outline.loops(); ++l) places.push_back(outline.points[outline.loop_starts[l]]);
  return places;
}

/// The layout, and it broken by known amounts: a placement is slid until something stops it, where it has to
/// be valid, then on by an amount; turned; put onto a defect, a zone or a hole.
void add_with_broken_ones(Cases& cases, const std::string& name, const Document& valid, std::size_t breaks) {
  cases.add(name, valid);
  ASSERT_TRUE(layout::check(valid).empty()) << name;
  Random random(cases::seed(), 9900);
  const double amounts[] = {2e-5, 0.01, 0.5, 20};
  for (std::size_t i = 0; i < breaks && !valid.placements.empty(); ++i) {
    const std::uint64_t id = valid.placements[random.below(valid.placements.size())].id;
    Session session(valid, layout::Mode::free);
    const double angle = random.uniform(0, 6.28);
    const geom::SinCos way = geom::sincos(angle);
    const auto by = [&](double mm) { return cases::grid_point(mm * way.cosine, mm * way.sine); };
    const auto slid = session.apply(layout::SlideCommand{{id}, by(1000)});
    ASSERT_TRUE(slid) << slid.error().message;
    EXPECT_TRUE(layout::check(session.document()).empty()) << name << " slid " << id;
    const double amount = amounts[i % 4];
    ASSERT_TRUE(session.apply(layout::MoveCommand{{id}, by(amount), std::nullopt}));
    cases.add(fmt::format("{}, {} moved on by {} mm", name, id, amount), session.document());
    session.undo();
    ASSERT_TRUE(session.apply(layout::RotateCommand{{id}, random.uniform(-180, 180)}));
    if (random.below(2) == 0) {
      ASSERT_TRUE(session.apply(layout::FlipCommand{{id}}));
    }
    cases.add(fmt::format("{}, {} turned", name, id), session.document());
    session.undo();
    const layout::Placement& placement = *session.workspace().find(id);
    const auto places = bad_places(session.document().stocks[placement.stock]);
    if (places.empty()) continue;
    const geom::GridPoint here =
        middle_of(bounds(layout::placed_outline(session.document().parts[placement.part], placement)));
    ASSERT_TRUE(
        session.apply(layout::MoveCommand{{id}, places[random.below(places.size())] - here, std::nullopt}));
    cases.add(fmt::format("{}, {} on a bad place", name, id), session.document());
  }
}

Document committed_layout(const std::string& job, const std::string& commands) {
  const auto file = disk::open_layout(job);
  EXPECT_TRUE(file) << file.error().message;
  const auto log = disk::read_file(commands);
  EXPECT_TRUE(log) << log.error().message;
  if (!file || !log) return {};
  // Strict: a command that broke a rule would be refused.
  const auto session = layout::replay(file->document, *log);
  EXPECT_TRUE(session) << commands << ": " << session.error().message;
  return session ? session->document() : Document{};
}

TEST(LayoutOracle, LayoutsOnSmallHidesAndTheShoes) {
  Cases cases;
  const Document hides = committed_layout(kHides + "small.json", kHides + "small.commands");
  ASSERT_GE(hides.placements.size(), 6U);
  add_with_broken_ones(cases, "small hides", hides, std::min<std::size_t>(cases::case_count(16), 200));
  const std::string shoes = cases::source_dir() + "/examples/layouts/shoes.json";
  add_with_broken_ones(cases, "shoes", committed_layout(shoes, kHides + "shoes.commands"), 8);
  const auto found = agree(cases);
  for (const char* kind : {"overlap", "outside", "defect", "quality"})
    EXPECT_GT(found.count(kind), 0U) << kind;
}

TEST(LayoutOracle, LayoutsOnThePublishedHides) {
  const std::string data = cases::shared_data();
  if (data.empty()) GTEST_SKIP() << "no shared data";
  Cases cases;
  for (const char* name : {"Test1", "Test7", "Test8"}) {
    SCOPED_TRACE(name);
    const Document hide = committed_layout(fmt::format("{}/nesting/leather/ordatasets_{}.json", data, name),
                                           fmt::format("{}{}.commands", kHides, name));
    ASSERT_GE(hide.placements.size(), 4U);
    add_with_broken_ones(cases, name, hide, std::min<std::size_t>(cases::case_count(12), 200));
  }
  const auto found = agree(cases);
  for (const char* kind : {"overlap", "outside"}) EXPECT_GT(found.count(kind), 0U) << kind;
}

TEST(LayoutOracle, PublishedLayoutsOfStrips) {
  const std::string data = cases::shared_data();
  if (data.empty()) GTEST_SKIP() << "no shared data";
  Cases cases;
  for (const char* name : {"albano", "jakobs1", "shirts", "swim"}) {
    const auto file = disk::open_layout(fmt::format("{}/nesting/layouts/{}.json", data, name));
    ASSERT_TRUE(file) << file.error().message;
    cases.add(name, file->document);
    // As they are, they touch and may overlap by rounding; broken ones by a known amount.
    Random random(cases::seed(), 9910);
    for (int i = 0; i < 3; ++i) {
      Session session(file->document, layout::Mode::free);
      const auto& placements = file->document.placements;
      for (const double amount : {1e-4, 1e-2, 1.0, 50.0})
        ASSERT_TRUE(session.apply(layout::MoveCommand{{placements[random.below(placements.size())].id},
                                                      cases::grid_point(amount, -amount),
                                                      std::nullopt}));
      cases.add(fmt::format("{} broken {}", name, i), session.document());
    }
  }
  const auto found = agree(cases);
  EXPECT_GT(found.count("overlap"), 0U);
}

/// Random layouts, valid at first, then disturbed so that every kind of violation comes about.
Document disturbed(std::size_t index) {
  Session session(cases::random_layout(cases::seed(), index, 10), layout::Mode::free);
  Document document = session.document();
  Random random(cases::seed(), 9920 + index);
  for (layout::Part& part : document.parts) {
    if (random.below(3) == 0) part.grain = layout::Grain{random.uniform(0, 180), random.uniform(0, 60)};
    if (random.below(3) == 0) part.tolerated_severity = static_cast<int>(random.below(3));
    if (random.below(2) == 0) part.quality = static_cast<int>(random.below(3));
    if (random.below(4) == 0) part.border_gap = geom::grid_from_mm_up(random.uniform(0, 3));
    if (random.below(2) == 0) part.defect_gap = geom::grid_from_mm_up(random.uniform(0, 15));
    if (random.below(4) == 0) part.rotations = {{10, 100}, {180, 180}};
  }
  for (layout::Stock& stock : document.stocks)
    if (random.below(2) == 0) stock.grain_degrees = random.uniform(0, 180);
  for (layout::Placement& placement : document.placements) {
    const double reach = random.below(2) == 0 ? 0.01 : 25;
    if (random.below(3) == 0)
      placement.at =
          placement.at + cases::grid_point(random.uniform(-reach, reach), random.uniform(-reach, reach));
    if (random.below(6) == 0) placement.rotation = geom::rotation_from_degrees(random.uniform(0, 360));
    if (random.below(6) == 0) placement.mirrored = !placement.mirrored;
    if (random.below(20) == 0) placement.copy = 3;
  }
  return document;
}

TEST(LayoutOracle, RandomLayouts) {
  Cases cases;
  for (std::size_t i = 0; i < std::min<std::size_t>(cases::case_count(120), 2000); ++i)
    cases.add(fmt::format("random {} seed {}", i, cases::seed()), disturbed(i));
  const auto found = agree(cases);
  for (const char* kind : {"overlap", "gap", "outside", "border-gap", "defect", "defect-gap", "quality",
                           "rotation", "mirror", "grain", "stock"})
    EXPECT_GT(found.count(kind), 0U) << kind;
}

using Finding = std::tuple<std::string, std::uint64_t, std::uint64_t, std::string, std::int64_t, std::string>;

/// \return what both find, by kind
std::map<std::string, std::size_t> compare_with_checker(const Document& document) {
  std::map<std::string, std::size_t> seen;
  std::vector<Finding> ours, theirs;
  for (const Violation& v : layout::check(document))
    ours.emplace_back(layout::name_of(v.kind), v.a, v.b, document.stocks[v.stock].id, v.copy,
                      feature_of(document, v));
  const auto verdict = verify::verify_layout({"layout.json", io::write_layout(document)});
  EXPECT_TRUE(verdict) << verdict.error().message;
  if (!verdict) return seen;
  for (const verify::LayoutViolation& v : verdict->violations)
    theirs.emplace_back(verify::name_of(v.kind), v.a, v.b, v.stock, v.copy, v.feature);
  for (const Finding& finding : ours) ++seen[std::get<0>(finding)];
  std::sort(ours.begin(), ours.end());
  std::sort(theirs.begin(), theirs.end());
  EXPECT_EQ(ours, theirs) << io::write_layout(document);
  return seen;
}

TEST(LayoutOracle, TheIndependentCheckerFindsTheSame) {
  std::map<std::string, std::size_t> random, crowded;
  const std::size_t wanted = cases::case_count(600);
  Random source(cases::seed(), 9930);
  for (std::size_t i = 0; i < wanted && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "layout " << i << " seed " << cases::seed());
    for (const auto& [kind, count] : compare_with_checker(disturbed(i))) random[kind] += count;
    const auto file = io::read_layout(cases::crowded(source).dump(), "crowded.json");
    ASSERT_TRUE(file) << file.error().message;
    for (const auto& [kind, count] : compare_with_checker(file->document)) crowded[kind] += count;
  }
  for (const auto& seen : {random, crowded}) {
    EXPECT_EQ(seen.size(), 11U);
    for (const auto& [kind, count] : seen) std::printf("%s %zu  ", kind.c_str(), count);
    std::printf("\n");
  }
}

}  // namespace
}  // namespace lekalo::layout_oracle_test
