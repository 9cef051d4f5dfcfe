#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <string_view>

#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/layout/check.hpp"
#include "lekalo/layout/session.hpp"
#include "lekalo/phi/outline_relation.hpp"
#include "support/cases.hpp"
#include "support/layout_cases.hpp"
#include "support/layout_commands.hpp"

namespace lekalo::layout::layout_commands_test {
namespace {

using geom::GridPoint;

constexpr std::size_t kParts = 14;
constexpr int kSteps = 200;  ///< commands of a session
/// A session is worth many cases of other tests.
std::size_t session_count() { return std::max<std::size_t>(1, cases::case_count(8 * 25) / 25); }

using cases::some_command;
using cases::some_feature_command;
using cases::some_id;
using cases::some_job_command;
using cases::some_vector;

TEST(LayoutCommands, StrictSessionsNeverBreakARule) {
  for (std::size_t i = 0; i < session_count(); ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i << " seed " << cases::seed());
    Session session(cases::random_layout(cases::seed(), i, kParts));
    if (session.document().placements.empty()) continue;
    Random random(cases::seed(), 100 + i);
    for (int step = 0; step < 25; ++step) {
      const Command command = some_command(session.document(), random);
      SCOPED_TRACE(to_text(command, session.document()));
      const auto change = session.apply(command);
      if (!change) continue;
      const auto violations = check(session.document());
      ASSERT_TRUE(violations.empty()) << name_of(violations[0].kind) << " " << violations[0].a << " "
                                      << violations[0].b << " by " << violations[0].amount_mm;
    }
  }
}

/// FNV-1a, for telling whether two builds did the same.
class Digest {
 public:
  void add(std::string_view text) {
    for (const char c : text) value_ = (value_ ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

TEST(LayoutCommands, WhatIsUndoneIsAsItWasAndWhatIsRedoneAsItBecame) {
  Digest digest;
  for (std::size_t i = 0; i < session_count(); ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i << " seed " << cases::seed());
    Random kits(cases::seed(), 400 + i);
    const Document first = cases::with_kits(cases::random_layout(cases::seed(), 500 + i, kParts), kits);
    if (first.placements.empty()) continue;
    Session session(first, i % 2 == 0 ? Mode::strict : Mode::free);
    Random random(cases::seed(), 300 + i);
    for (int step = 0; step < kSteps; ++step) {
      if (session.document().placements.empty()) break;
      if (session.can_undo() && random.below(5) == 0) {
        session.undo();
        if (random.below(2) == 0 && session.can_redo()) session.redo();
        continue;
      }
      if (random.below(20) == 0) session.set_mode(random.below(2) == 0 ? Mode::strict : Mode::free);
      const std::uint64_t kind = random.below(8);
      (void)session.apply(kind < 2    ? some_feature_command(session.document(), random)
                          : kind == 2 ? some_job_command(session.document(), random)
                                      : some_command(session.document(), random));
    }
    const Document last = session.document();
    const std::string log = session.log();
    std::size_t undone = 0;
    for (; session.can_undo(); ++undone) session.undo();
    EXPECT_TRUE(session.document() == first);
    // The difference of two states leads from one to the other, whatever came and went between.
    Workspace between(first);
    carry_out(between, difference(first, last));
    EXPECT_TRUE(between.document() == last);
    take_back(between, difference(first, last));
    EXPECT_TRUE(between.document() == first);
    for (; undone > 0; --undone) session.redo();
    EXPECT_TRUE(session.document() == last);
    // Replaying executes the commands anew, from their text.
    const auto replayed = replay(first, log);
    ASSERT_TRUE(replayed.has_value()) << replayed.error().message << "\n" << log;
    EXPECT_TRUE(replayed->document() == last) << log;
    EXPECT_EQ(replayed->log(), log);
    digest.add(log);
    digest.add(io::write_layout(last));
  }
  // test.sh --full compares this line of its builds.
  std::printf("digest of the sessions %016llx\n", static_cast<unsigned long long>(digest.value()));
}

/// Of every feature, the violations that the check of the whole document finds with it.
void check_features(const Workspace& workspace) {
  const std::vector<Violation> all = check(workspace.document());
  for (std::uint32_t stock = 0; stock < workspace.document().stocks.size(); ++stock)
    for (const FeatureKind kind : {FeatureKind::defect, FeatureKind::zone})
      for (std::uint32_t i = 0; i < feature_count(workspace.document().stocks[stock], kind); ++i) {
        std::vector<Violation> expected;
        for (const Violation& v : all) {
          const bool of_defect = v.kind == ViolationKind::defect || v.kind == ViolationKind::defect_gap;
          if (v.stock == stock && v.feature == i &&
              (kind == FeatureKind::defect ? of_defect : v.kind == ViolationKind::quality))
            expected.push_back(v);
        }
        EXPECT_EQ(workspace.violations_with(stock, kind, i), expected);
      }
}

TEST(LayoutCommands, AWorkspaceSaysWhatTheCheckSays) {
  for (std::size_t i = 0; i < session_count(); ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i << " seed " << cases::seed());
    Session session(cases::random_layout(cases::seed(), 900 + i, kParts), Mode::free);
    if (session.document().placements.empty()) continue;
    Random random(cases::seed(), 700 + i);
    for (int step = 0; step < 20; ++step) {
      const std::uint64_t id = some_id(session.document(), random);
      (void)session.apply(MoveCommand{{id}, some_vector(random, 15), std::nullopt});
      if (random.below(4) == 0)
        (void)session.apply(some_job_command(session.document(), random));
      else if (random.below(2) == 0)
        (void)session.apply(some_feature_command(session.document(), random));
      else if (session.can_undo() && random.below(4) == 0)
        session.undo();
      check_features(session.workspace());
      const Placement* const there = session.workspace().find(id);
      if (session.document().placements.empty()) break;
      if (there == nullptr) continue;  // it went with its part or sheet
      const Placement& placement = *there;
      std::vector<Violation> expected;
      for (const Violation& violation : check(session.document()))
        if (violation.a == id || violation.b == id) expected.push_back(violation);
      EXPECT_EQ(session.workspace().violations_of(std::span(&placement, 1)), expected);
      EXPECT_EQ(session.workspace().is_clear(std::span(&placement, 1)), expected.empty());
    }
  }
}

/// The least distance to anything that concerns the part beyond the gap it must keep, in steps.
double least_room(const Workspace& workspace, const Placement& placement) {
  const Sheet sheet{placement.stock, placement.copy};
  const Part& part = workspace.document().parts[placement.part];
  const geom::GridRegion outline = placed_outline(part, placement);
  const phi::Scene& scene = workspace.scene(sheet);
  double least = std::numeric_limits<double>::infinity();
  for (const phi::BodyIndex body : scene.near(bounds(outline), geom::kGridLimit, ~0U)) {
    if (workspace.placement_of(sheet, body) == placement.id || !workspace.concerns(part, sheet, body))
      continue;
    const phi::Body& other = scene.body(body);
    const double distance =
        phi::edge_distance(outline, scene.outline(other.shape), other.at).distance_mm * geom::kGridPerMm;
    // A zone may lie in an area of the part that does not mind it, where edges may cross.
    if ((other.layers & kZoneLayer) != 0 && !part.areas.empty()) continue;
    least = std::min(least, distance - static_cast<double>(workspace.gap_to(part, sheet, body)));
  }
  return least;
}

TEST(LayoutCommands, SlidingEndsWithinTwoStepsOfTheGap) {
  std::size_t slides = 0;
  double largest = 0;
  const std::size_t wanted = cases::case_count(400);
  for (std::size_t i = 0; slides < wanted; ++i) {
    SCOPED_TRACE(testing::Message() << "layout " << i << " seed " << cases::seed());
    Session session(cases::random_layout(cases::seed(), 2000 + i, kParts));
    if (session.document().placements.empty()) continue;
    Random random(cases::seed(), 1100 + i);
    for (int step = 0; step < 40; ++step) {
      const std::uint64_t id = some_id(session.document(), random);
      const SlideCommand slide{{id}, some_vector(random, 10)};
      SCOPED_TRACE(to_text(slide, session.document()));
      const auto change = session.apply(slide);
      ASSERT_TRUE(change.has_value()) << change.error().message;
      ++slides;
      const Placement& placement = *session.workspace().find(id);
      EXPECT_TRUE(session.workspace().is_clear(std::span(&placement, 1)));
      if (session.document().parts[placement.part].areas.empty()) {
        const double room = least_room(session.workspace(), placement);
        EXPECT_GE(room, -1e-6);
        EXPECT_LE(room, 2);
        largest = std::max(largest, room);
      }
      if (random.below(3) == 0) (void)session.apply(MoveCommand{{id}, some_vector(random, 30), std::nullopt});
    }
  }
  RecordProperty("largest room, steps", std::to_string(largest));
  std::printf("largest room %.3f steps in %zu slides\n", largest, slides);
}

}  // namespace
}  // namespace lekalo::layout::layout_commands_test
