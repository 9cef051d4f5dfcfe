#include <gtest/gtest.h>

#include <atomic>
#include <optional>
#include <vector>

#include "jobs/nest_checked.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/jobs/check.hpp"
#include "lekalo/jobs/nest.hpp"
#include "lekalo/layout/check.hpp"
#include "lekalo/phi/outline_relation.hpp"
#include "support/layout_cases.hpp"

namespace lekalo::jobs::jobs_nest_test {
namespace {

using layout::Document;

/// A sheet of 100 with squares of 10 at (20, 40) and (60, 40), and six wanted in all.
Document wanted_squares() {
  Document document = cases::two_squares();
  document.parts[0].demand = 6;
  return document;
}

/// Both squares in one place.
Document broken_squares() {
  Document document = wanted_squares();
  document.placements[1].at = document.placements[0].at;
  return document;
}

/// Finds these layouts in turn, each as a better one than the last, and ends with the last.
Nester finding(std::vector<Document> documents) {
  return
      [documents](const Document&, const nest::Options& options, const RunControl&) -> Result<nest::Nested> {
        nest::Nested found;
        for (const Document& document : documents) {
          found.document = document;
          if (options.improved) options.improved(found);
        }
        return found;
      };
}

TEST(JobsNest, ALayoutThatBreaksARuleIsNeverTheResult) {
  const auto nested = nest_checked(finding({wanted_squares(), broken_squares()}), wanted_squares(), {}, {});
  ASSERT_FALSE(nested);
  EXPECT_EQ(nested.error().code, ErrorCode::refuted);
  EXPECT_NE(nested.error().message.find("overlap"), std::string::npos) << nested.error().message;
}

TEST(JobsNest, NothingIsToldOfABetterLayoutThatBreaksARuleNorOfLaterOnes) {
  std::vector<Document> told;
  NestOptions options;
  options.improved = [&](const Document& better, std::string_view) -> Result<void> {
    told.push_back(better);
    return {};
  };
  const auto nested = nest_checked(finding({wanted_squares(), broken_squares(), wanted_squares()}),
                                   wanted_squares(), options, {});
  ASSERT_FALSE(nested);
  EXPECT_EQ(nested.error().code, ErrorCode::refuted);
  EXPECT_EQ(told, std::vector<Document>{wanted_squares()});
}

TEST(JobsNest, AFailureOfWhoTakesBetterLayoutsIsItsOwn) {
  int taken = 0;
  NestOptions options;
  options.improved = [&](const Document&, std::string_view) -> Result<void> {
    ++taken;
    return failure(ErrorCode::environment, "the disk is full");
  };
  const auto nested =
      nest_checked(finding({wanted_squares(), wanted_squares()}), wanted_squares(), options, {});
  ASSERT_FALSE(nested);
  EXPECT_EQ(nested.error().message, "the disk is full");
  EXPECT_EQ(taken, 1);
}

TEST(JobsNest, HandsOutTheBytesThatBothChecksConfirmed) {
  std::vector<std::string> told;
  std::optional<NestStanding> standing;
  NestOptions options;
  options.improved = [&](const Document& better, std::string_view bytes) -> Result<void> {
    EXPECT_TRUE(confirm_layout(better, bytes));
    EXPECT_EQ(bytes, io::write_layout(better));
    told.emplace_back(bytes);
    return {};
  };
  options.standing = [&](const NestStanding& now) { standing = now; };
  RunControl control;
  control.work_limit = 100'000;
  const auto nested = nest(wanted_squares(), options, control);
  ASSERT_TRUE(nested) << nested.error().message;
  EXPECT_EQ(nested->document.placements.size(), 6u);
  EXPECT_EQ(nested->bytes, io::write_layout(nested->document));
  EXPECT_TRUE(nested->unplaced.empty());
  EXPECT_EQ(nested->completeness.placed[0].total(), 6);
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.back(), nested->bytes);
  ASSERT_TRUE(standing);
  EXPECT_EQ(standing->sheets, 1u);
  EXPECT_DOUBLE_EQ(standing->density, 0.06);
  Layout again;
  again.document = nested->document;
  EXPECT_TRUE(check(again)->valid());
}

TEST(JobsNest, TheBytesOfTheResultAreTakenOnceWhileTheyAreChecked) {
  std::vector<std::string> taken;
  NestOptions options;
  options.while_checked = [&](std::string_view bytes) -> Result<void> {
    taken.emplace_back(bytes);
    return {};
  };
  const auto nested =
      nest_checked(finding({wanted_squares(), wanted_squares()}), wanted_squares(), options, {});
  ASSERT_TRUE(nested) << nested.error().message;
  EXPECT_EQ(taken, std::vector<std::string>{nested->bytes});
  // A layout that breaks a rule may be taken, and is no result.
  taken.clear();
  const auto broken = nest_checked(finding({broken_squares()}), wanted_squares(), options, {});
  ASSERT_FALSE(broken);
  EXPECT_EQ(broken.error().code, ErrorCode::refuted);
  EXPECT_LE(taken.size(), 1u);
}

TEST(JobsNest, AFailureOfWhoTakesTheBytesIsOneOfNest) {
  NestOptions options;
  options.while_checked = [](std::string_view) -> Result<void> {
    return failure(ErrorCode::environment, "the disk is full");
  };
  const auto nested = nest_checked(finding({wanted_squares()}), wanted_squares(), options, {});
  ASSERT_FALSE(nested);
  EXPECT_EQ(nested.error().message, "the disk is full");
  // That a rule is broken is said first.
  const auto broken = nest_checked(finding({broken_squares()}), wanted_squares(), options, {});
  ASSERT_FALSE(broken);
  EXPECT_EQ(broken.error().code, ErrorCode::refuted);
}

TEST(JobsNest, AStopThatComesDuringTheCheckDoesNotThrowTheLayoutAway) {
  // The stop comes when the search hands its layout over; who stops the command listens on this thread.
  const Document squares = wanted_squares();
  std::atomic<bool> stop{false};
  RunControl outer;
  outer.stop = &stop;
  const Listening listening(outer);
  const Nester found = finding({squares});
  const Nester stopped = [&](const Document& document, const nest::Options& options, const RunControl& run) {
    auto nested = found(document, options, run);
    stop = true;
    return nested;
  };
  const auto nested = nest_checked(stopped, squares, {}, {});
  ASSERT_TRUE(nested) << nested.error().message;
  EXPECT_FALSE(nested->bytes.empty());
}

TEST(JobsNest, ASelectionLeavesDemandLocksAndTheRestAsTheyWere) {
  Document document = wanted_squares();
  NestOptions options;
  options.only = {2};
  RunControl control;
  control.work_limit = 100'000;
  const auto nested = nest(document, options, control);
  ASSERT_TRUE(nested) << nested.error().message;
  EXPECT_EQ(nested->document.parts, document.parts);
  ASSERT_EQ(nested->document.placements.size(), 2u);
  EXPECT_EQ(nested->document.placements[0], document.placements[0]);
  EXPECT_FALSE(nested->document.placements[1].locked);

  options.only = {7};
  EXPECT_EQ(nest(document, options).error().message, "there is no placement 7");
  document.placements[1].locked = true;
  options.only = {2};
  EXPECT_EQ(nest(document, options).error().message, "placement 2 is locked");
}

TEST(JobsNest, AConfirmedLayoutPassesBothChecksAsItsBytes) {
  const Document good = wanted_squares(), broken = broken_squares();
  EXPECT_TRUE(confirm_layout(good, io::write_layout(good)));
  EXPECT_FALSE(confirm_layout(broken, io::write_layout(broken)));
  // The bytes count, not the document that they are said to be.
  const auto other = confirm_layout(good, io::write_layout(broken));
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().message.find("independent checker"), std::string::npos);
  EXPECT_FALSE(confirm_layout(good, "{}"));
}

// ---- rows with edges in common ----------------------------------------------------------------------------

constexpr double kKerf = 0.5, kGap = 4;

/// Six bars, two triangles and a square are wanted on a sheet of 100.
Document wanted_bars() {
  Document document = cases::two_squares();
  document.placements.clear();
  document.rules.gap = document.rules.kerf = geom::grid_from_mm_up(kKerf);
  layout::Part bar = document.parts[0], gusset = bar;
  document.parts[0].demand = 1;
  bar.id = "bar", bar.demand = 6, bar.outline = cases::outline_of({cases::box_loop(0, 0, 40, 8)});
  gusset.id = "gusset", gusset.demand = 2;
  gusset.outline =
      cases::outline_of({{cases::grid_point(3, 2), cases::grid_point(23, 2), cases::grid_point(3, 17)}});
  document.parts.push_back(bar);
  document.parts.push_back(gusset);
  return document;
}

Nested nested_in_rows(const Document& document) {
  NestOptions options;
  options.common_line_gap_mm = kGap;
  RunControl control;
  control.work_limit = 50'000;
  return nest(document, options, control).value();
}

/// How many pairs lie at the kerf; all others keep the gap.
std::size_t pairs_at_the_kerf(const Document& document) {
  std::size_t pairs = 0;
  for (const layout::Placement& a : document.placements)
    for (const layout::Placement& b : document.placements) {
      if (a.id >= b.id || a.copy != b.copy) continue;
      const double apart = phi::edge_distance(placed_outline(document.parts[a.part], a),
                                              placed_outline(document.parts[b.part], b))
                               .distance_mm;
      EXPECT_GE(apart, kKerf - 1e-9);
      if (apart < kKerf + 1e-5)
        ++pairs;
      else
        EXPECT_GE(apart, kGap - 1e-9) << a.id << " and " << b.id;
    }
  return pairs;
}

TEST(JobsNestRows, PartsOfARowKeepTheKerfAndAllOthersTheGap) {
  const Nested nested = nested_in_rows(wanted_bars());
  EXPECT_TRUE(nested.unplaced.empty());
  ASSERT_EQ(nested.document.placements.size(), 9U);
  ASSERT_TRUE(nested.rows);
  EXPECT_GT(nested.rows->most_in_row, 1U);
  EXPECT_LE(nested.rows->material_share, 1.01);
  const std::size_t pairs = pairs_at_the_kerf(nested.document);
  EXPECT_GE(pairs, 4U);
  // The triangles have 25 mm in common, each two bars 40 mm.
  EXPECT_NEAR(nested.rows->shared_mm, 25 + 40 * static_cast<double>(pairs - 1), 1e-3);
  EXPECT_EQ(nested.document.rules, wanted_bars().rules);
  EXPECT_EQ(nested_in_rows(wanted_bars()).bytes, nested.bytes);
}

TEST(JobsNestRows, PartsOfKitsOrWithGrainStandInNoRow) {
  Document document = wanted_bars();
  for (layout::Part& part : document.parts) part.grain = layout::Grain{0, 5};
  EXPECT_EQ(pairs_at_the_kerf(nested_in_rows(document).document), 0U);
  document = wanted_bars();
  document.kits = {{"kit", "", 1, 1, {{1, 6, {}}, {2, 2, {}}}}};
  for (layout::Part& part : document.parts) part.demand = 0;
  const Nested nested = nested_in_rows(document);
  EXPECT_EQ(nested.document.placements.size(), 8U);
  EXPECT_EQ(pairs_at_the_kerf(nested.document), 0U);
  EXPECT_EQ(nested.rows->most_in_row, 1U);
}

TEST(JobsNestRows, ALayoutThatIsThereIsNestedPartByPart) {
  Document document = wanted_bars();
  document.placements = cases::two_squares().placements;
  document.next_id = cases::two_squares().next_id;
  document.parts[0].demand = 2;
  const Nested nested = nested_in_rows(document);
  EXPECT_EQ(pairs_at_the_kerf(nested.document), 0U);
  EXPECT_EQ(nested.document.placements[0].id, document.placements[0].id);
}

TEST(JobsNestRows, PiecesOfRowsThatFindNoRoomAreCountedByPart) {
  Document document = wanted_bars();
  document.parts[1].demand = 60;
  const Nested nested = nested_in_rows(document);
  ASSERT_FALSE(nested.unplaced.empty());
  std::int64_t missing = 0;
  for (const nest::Unplaced& unplaced : nested.unplaced) {
    EXPECT_LT(unplaced.part, document.parts.size());
    missing += unplaced.count;
  }
  EXPECT_EQ(missing + static_cast<std::int64_t>(nested.document.placements.size()), 63);
}

}  // namespace
}  // namespace lekalo::jobs::jobs_nest_test
