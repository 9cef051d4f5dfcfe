// What burns, in which order, and what holds: over generated sheets, with formulas of the test's own.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <queue>
#include <sstream>

#include "lekalo/nc/profile.hpp"
#include "support/cases.hpp"
#include "support/profile_parts.hpp"

namespace lekalo::nc::nc_cut_order_test {
namespace {

using cases::Real;

/// The motions from one pierce on.
struct Chain {
  std::uint64_t placement = 0;
  bool outline = false;
  std::string contour;
  std::vector<rs274::Step> steps;

  [[nodiscard]] rs274::Point pierce() const { return steps.front().from; }
  [[nodiscard]] rs274::Point end() const { return steps.back().to; }
};

std::vector<Chain> chains_of(const std::string& program) {
  std::map<std::size_t, std::size_t> chain_of_line;
  std::vector<Chain> chains;
  std::istringstream lines(program);
  std::string line, contour;
  unsigned long long id = 0;
  bool on = false;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    if (line.rfind("(PLACEMENT ", 0) == 0) {
      contour = line;
      std::sscanf(line.c_str(), "(PLACEMENT %llu", &id);
    }
    if (line == "M3" || line == "M4" || line.rfind("M3 ", 0) == 0 || line.rfind("M4 ", 0) == 0) {
      on = true;
      chains.push_back({id, contour.find("OUTLINE") != std::string::npos, contour, {}});
    }
    if (line == "M5") on = false;
    if (on) chain_of_line[number] = chains.size() - 1;
  }
  for (const rs274::Step& step : rs274::Reader().read(program))
    if (const auto found = chain_of_line.find(step.line); found != chain_of_line.end()) {
      EXPECT_GE(step.code, 1);
      chains[found->second].steps.push_back(step);
    }
  return chains;
}

Real distance_to(rs274::Point p, const Chain& chain) {
  Real least = 1e9L;
  for (const rs274::Step& step : chain.steps) least = std::min(least, cases::distance_to_step(p, step));
  return least;
}

ProfileOptions burning(Random& random) {
  ProfileOptions o;
  o.post = posts()[random.below(3)];
  o.process = random.below(2) == 0 ? Process::laser : Process::plasma;
  o.unit = random.below(4) == 0 ? LengthUnit::inch : LengthUnit::millimetre;
  o.kerf_mm = random.uniform(0.15, 1);
  o.tolerance_mm = std::min(0.02, 0.2 * o.kerf_mm);
  o.lead = random.below(2) == 0 ? LeadShape::arc : LeadShape::line;
  o.pierce_diameter_mm = random.uniform(1, 2.5) * o.kerf_mm;
  o.lead_in_mm = random.uniform(1, 3) * o.pierce_diameter_mm;
  o.heat_spread_mm = random.below(2) == 0 ? 0 : random.uniform(5, 60);
  o.feed_mm_per_min = 1000, o.speed = 500;
  return o;
}

/// Discs and leads against parts and against what was cut before.
void expect_clear(const std::vector<Chain>& chains, const std::vector<ProfilePart>& parts,
                  const ProfileOptions& options) {
  const Real kerf = options.kerf_mm, disc = options.pierce_diameter_mm, rounding = 1e-9L;
  for (std::size_t c = 0; c < chains.size(); ++c) {
    const Chain& chain = chains[c];
    for (const ProfilePart& part : parts)
      ASSERT_LE(cases::depth_of_kerf(chain.pierce(), part.region, disc), options.tolerance_mm + rounding)
          << "pierce of " << chain.contour << " in placement " << part.id;
    for (std::size_t before = 0; before < c; ++before) {
      if (chains[before].contour == chain.contour) continue;
      ASSERT_GE(distance_to(chain.pierce(), chains[before]), (disc + kerf) / 2 - rounding)
          << chain.contour << " pierces the kerf of " << chains[before].contour;
      for (int k = 0; k <= 8 && rs274::distance(chain.steps[0].to, chain.end()) < 1e-12L; ++k)
        ASSERT_GE(distance_to(chain.steps[0].at(Real(k) / 8), chains[before]), kerf - rounding)
            << "the lead of " << chain.contour << " runs into " << chains[before].contour;
    }
  }
}

/// No motion goes along another: the middle of each lies on no other.
void expect_no_edge_twice(const std::vector<Chain>& chains) {
  for (const Chain& chain : chains)
    for (const rs274::Step& step : chain.steps) {
      std::size_t there = 0;
      for (const Chain& other : chains)
        for (const rs274::Step& against : other.steps)
          there += cases::distance_to_step(step.at(0.5L), against) < 1e-6L ? 1 : 0;
      ASSERT_EQ(there, 1U) << chain.contour;
    }
}

TEST(NcCutOrder, PiercesAndLeadsLieInScrapClearOfPartsAndOfEarlierCuts) {
  const std::size_t count = cases::case_count(25);
  std::size_t written = 0, wide = 0, near = 0;
  for (std::size_t index = 0; index < count; ++index) {
    SCOPED_TRACE(fmt::format("seed {} case {}", cases::seed(), index));
    const std::vector<ProfilePart> parts = cases::random_parts(cases::seed(), index);
    Random random(cases::seed(), 44000 + index);
    const ProfileOptions options = burning(random);
    const auto made = profile_program(parts, "random", options);
    if (!made) {
      ASSERT_EQ(made.error().code, ErrorCode::bad_input) << made.error().message;
      ASSERT_NE(made.error().message.find("a pierce of"), std::string::npos) << made.error().message;
      continue;
    }
    ++written, wide += options.pierce_diameter_mm > 1.2 * options.kerf_mm ? 1 : 0;
    const std::vector<Chain> chains = chains_of(made->text);
    ASSERT_EQ(chains.size(), made->cuts);
    expect_clear(chains, parts, options);
    if (index < 50) expect_no_edge_twice(chains);
    if (options.heat_spread_mm == 0) continue;
    std::size_t nearer = 0;
    for (std::size_t c = 1; c < chains.size(); ++c) {
      // The kerf alone is hot; its lead may be left out of the distance.
      Chain hot = chains[c - 1];
      if (!(rs274::distance(hot.steps.front().from, hot.end()) < 1e-12L)) hot.steps.erase(hot.steps.begin());
      nearer += distance_to(chains[c].pierce(), hot) < options.heat_spread_mm ? 1 : 0;
    }
    EXPECT_EQ(nearer, made->near_starts);
    near += nearer;
  }
  EXPECT_GT(2 * written, count);
  EXPECT_GT(4 * wide, written);
  EXPECT_GT(near, 0U);
}

/// A picture of the sheet in which kerfs are burnt, one cut after the other.
class BurntSheet {
 public:
  BurntSheet(double side, double cell)
      : cells_(static_cast<int>(side / cell)),
        cell_(cell),
        burnt_(static_cast<std::size_t>(cells_) * static_cast<std::size_t>(cells_)) {}

  void burn(const Chain& chain, Real kerf) {
    for (const rs274::Step& step : chain.steps) {
      const int pieces = 1 + static_cast<int>(rs274::distance(step.from, step.to) * 4 / cell_);
      for (int k = 0; k <= pieces; ++k) burn(step.at(Real(k) / pieces), kerf / 2);
    }
  }
  /// Whether a place hangs together with the rim of the sheet.
  [[nodiscard]] bool is_held(geom::Point p) const {
    std::vector<bool> seen(burnt_.size(), false);
    std::queue<std::size_t> open;
    const auto visit = [&](int x, int y) {
      const std::size_t at = at_cell(x, y);
      if (burnt_[at] || seen[at]) return;
      seen[at] = true;
      open.push(at);
    };
    visit(static_cast<int>(p.x / cell_), static_cast<int>(p.y / cell_));
    while (!open.empty()) {
      const auto x = static_cast<int>(open.front()) % cells_, y = static_cast<int>(open.front()) / cells_;
      open.pop();
      if (x == 0 || y == 0 || x == cells_ - 1 || y == cells_ - 1) return true;
      visit(x - 1, y), visit(x + 1, y), visit(x, y - 1), visit(x, y + 1);
    }
    return false;
  }

 private:
  void burn(rs274::Point p, Real radius) {
    const int low_x = static_cast<int>((p.x - radius) / cell_),
              high_x = static_cast<int>((p.x + radius) / cell_);
    const int low_y = static_cast<int>((p.y - radius) / cell_),
              high_y = static_cast<int>((p.y + radius) / cell_);
    for (int y = low_y; y <= high_y; ++y)
      for (int x = low_x; x <= high_x; ++x)
        if (std::hypot((x + 0.5L) * cell_ - p.x, (y + 0.5L) * cell_ - p.y) <= radius)
          burnt_[y * cells_ + x] = true;
  }
  [[nodiscard]] std::size_t at_cell(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(cells_) + static_cast<std::size_t>(x);
  }
  int cells_;
  double cell_;
  std::vector<bool> burnt_;
};

TEST(NcCutOrder, NothingIsCutThatSeveralKerfsHaveFreedTogether) {
  std::size_t crowded = 0;
  for (std::size_t index = 0; index < cases::case_count(4); ++index) {
    SCOPED_TRACE(fmt::format("seed {} case {}", cases::seed(), index));
    Random random(cases::seed(), 33000 + index);
    // Between 1.41 and 1.6 what is left between four corners is a throat that the cells cannot tell.
    const auto kind = random.below(4);
    const double kerf = 1, side = 7,
                 gap = kind == 0   ? 2.8
                       : kind == 1 ? random.uniform(1.6, 1.8)
                                   : random.uniform(1.05, 1.38);
    const auto columns = 2 + random.below(4), rows = 2 + random.below(4);
    std::vector<ProfilePart> parts;
    std::vector<geom::Point> middles;
    for (std::uint64_t i = 0; i < columns; ++i)
      for (std::uint64_t j = 0; j < rows; ++j) {
        if (random.below(8) == 0) continue;
        const double x = 6 + static_cast<double>(i) * (side + gap),
                     y = 6 + static_cast<double>(j) * (side + gap);
        parts.push_back({parts.size() + 1, cases::region_of_contours(cases::box_contour(x, y, side, side))});
        middles.push_back({x + side / 2, y + side / 2});
      }
    ProfileOptions options;
    options.kerf_mm = kerf, options.feed_mm_per_min = 1000;
    options.heat_spread_mm = random.below(2) == 0 ? 0 : 12;
    const auto made = profile_program(parts, "crowd", options);
    ASSERT_TRUE(made) << made.error().message;
    BurntSheet sheet(60, 0.1);
    for (const Chain& chain : chains_of(made->text)) {
      ASSERT_TRUE(sheet.is_held(middles[chain.placement - 1])) << chain.contour << " was loose\n"
                                                               << made->text;
      sheet.burn(chain, kerf);
      ASSERT_FALSE(sheet.is_held(middles[chain.placement - 1]));
    }
    crowded += gap < 2 ? 1 : 0;
  }
  EXPECT_GT(crowded, 0U);
}

// --- joints -----------------------------------------------------------------------------------------

/// Both ends of the kerf at a joint.
struct Gap {
  std::uint64_t placement = 0;
  rs274::Point end, start;
};

rs274::Point start_of_contour(const Chain& chain) {
  // A lead of these tests is one line at a right angle to what follows.
  if (chain.steps.size() == 1) return chain.pierce();
  const rs274::Step &a = chain.steps[0], &b = chain.steps[1];
  const auto way = [](rs274::Point from, rs274::Point to) {
    return rs274::Point{to.x - from.x, to.y - from.y};
  };
  const rs274::Point u = way(a.at(0.999L), a.at(1)), v = way(b.at(0), b.at(0.001L));
  const Real cosine = (u.x * v.x + u.y * v.y) / (std::hypot(u.x, u.y) * std::hypot(v.x, v.y));
  return std::abs(cosine) < 0.05L && !a.arc ? a.to : a.from;
}

std::vector<Gap> gaps_of(const std::vector<Chain>& chains) {
  std::map<std::uint64_t, std::vector<const Chain*>> of;
  for (const Chain& chain : chains)
    if (chain.outline && !(rs274::distance(start_of_contour(chain), chain.end()) < 1e-12L))
      of[chain.placement].push_back(&chain);
  std::vector<Gap> gaps;
  for (const auto& [placement, its] : of)
    for (const Chain* chain : its) {
      Gap gap{placement, chain->end(), start_of_contour(*its[0])};
      for (const Chain* next : its)
        if (rs274::distance(start_of_contour(*next), gap.end) < rs274::distance(gap.start, gap.end))
          gap.start = start_of_contour(*next);
      gaps.push_back(gap);
    }
  return gaps;
}

/// Places of a joint: from the middle of the kerf out into the sheet.
std::vector<rs274::Point> places_of(const Gap& gap, const geom::Region& part, Real kerf, Real width) {
  const Real apart = rs274::distance(gap.end, gap.start);
  const rs274::Point way{(gap.start.x - gap.end.x) / apart, (gap.start.y - gap.end.y) / apart};
  rs274::Point out{-way.y, way.x};
  const rs274::Point middle{(gap.start.x + gap.end.x) / 2, (gap.start.y + gap.end.y) / 2};
  const rs274::Point try_out{middle.x + out.x * kerf / 2, middle.y + out.y * kerf / 2};
  if (cases::distance_to_boundary(try_out, part) < kerf / 2) out = {-out.x, -out.y};
  std::vector<rs274::Point> places;
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; j <= 4; ++j) {
      const Real along = kerf / 2 + width * i / 4, aside = (kerf / 2 + width) * j / 4;
      places.push_back(
          {gap.end.x + along * way.x + aside * out.x, gap.end.y + along * way.y + aside * out.y});
    }
  return places;
}

TEST(NcJoints, MaterialOfTheStatedWidthStaysAndNothingElseIsLeft) {
  std::size_t joints = 0, refused = 0, discs = 0;
  const std::size_t count = cases::case_count(15);
  for (std::size_t index = 0; index < count; ++index) {
    SCOPED_TRACE(fmt::format("seed {} case {}", cases::seed(), index));
    const std::vector<ProfilePart> parts = cases::random_parts(cases::seed(), index);
    Random random(cases::seed(), 22000 + index);
    ProfileOptions options = burning(random);
    options.lead = LeadShape::line, options.heat_spread_mm = 0;
    options.kerf_mm = random.uniform(0.1, 0.4), options.tolerance_mm = 0.01;
    options.pierce_diameter_mm = random.below(2) == 0 ? 0 : random.uniform(1, 2) * options.kerf_mm;
    options.lead_in_mm = random.uniform(1, 2.5);
    options.joints.rule = JointRule::count;
    options.joints.count = 1 + random.below(3);
    options.joints.width_mm = random.uniform(0.2, 0.8);
    const auto made = profile_program(parts, "random", options);
    if (!made) {
      ASSERT_EQ(made.error().code, ErrorCode::bad_input) << made.error().message;
      ++refused;
      continue;
    }
    const std::vector<Chain> chains = chains_of(made->text);
    const std::vector<Gap> gaps = gaps_of(chains);
    ASSERT_EQ(gaps.size(), made->joints);
    ASSERT_EQ(gaps.size(), options.joints.count * made->jointed_parts);
    EXPECT_EQ(made->jointed_parts + made->unheld.size(), parts.size());
    joints += gaps.size(), discs += options.pierce_diameter_mm > 0 ? 1 : 0;
    const Real kerf = options.kerf_mm, width = options.joints.width_mm;
    // Two roundings of a word, of 0.0001 inch at most.
    const Real rounding = 0.006L;
    for (const Gap& gap : gaps) {
      ASSERT_NEAR(double(rs274::distance(gap.end, gap.start) - kerf), double(width), double(rounding));
      const ProfilePart& part = parts[gap.placement - 1];
      for (const rs274::Point p : places_of(gap, part.region, kerf, width)) {
        for (const ProfilePart& other : parts)
          ASSERT_EQ(cases::depth_of_kerf(p, other.region, 0), 0) << "a joint in placement " << other.id;
        for (const Chain& chain : chains) {
          ASSERT_GE(distance_to(p, chain), kerf / 2 - rounding) << chain.contour << " cuts a joint";
          ASSERT_GE(rs274::distance(p, chain.pierce()), Real(options.pierce_diameter_mm) / 2 - rounding);
        }
      }
    }
    for (const ProfilePart& part : parts)
      for (const geom::Edge& edge : part.region.outer) {
        const rs274::Point corner{edge.from.x, edge.from.y};
        Real least = 1e9L;
        for (const Chain& chain : chains)
          if (chain.placement == part.id) least = std::min(least, distance_to(corner, chain));
        for (const Gap& gap : gaps)
          if (gap.placement == part.id)
            least = std::min(least, rs274::distance(corner, gap.end) - (kerf + width));
        ASSERT_LE(least, kerf / 2 + Real(made->left_over_mm) + rounding)
            << "a corner of " << part.id << " is not cut";
      }
  }
  EXPECT_GT(joints, count);
  EXPECT_GT(discs, 0U);
  EXPECT_LT(2 * refused, count);
}

// --- tipping ----------------------------------------------------------------------------------------

/// A part on slats parallel to Y, as points of support: how far its centre of mass lies within their hull.
class StandingPart {
 public:
  explicit StandingPart(const geom::Region& region) : region_(region) {
    Real area = 0;
    cases::each_contour(region, [&](const geom::Contour& contour) {
      std::vector<rs274::Point> ring;
      for (const geom::Edge& edge : contour) {
        const int pieces = edge.kind == geom::EdgeKind::line ? 1 : 200;
        for (int k = 0; k < pieces; ++k) ring.push_back(on(edge, Real(k) / pieces));
      }
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const rs274::Point a = ring[i], b = ring[(i + 1) % ring.size()];
        const Real cross = a.x * b.y - a.y * b.x;
        area += cross / 2;
        centre_.x += (a.x + b.x) * cross / 6, centre_.y += (a.y + b.y) * cross / 6;
      }
      rings_.push_back(std::move(ring));
    });
    centre_.x /= area, centre_.y /= area;
  }

  [[nodiscard]] Real depth(Real phase, Real pitch, std::vector<rs274::Point> supports) const {
    const geom::Box box = geom::bounds(region_.outer);
    for (Real x = phase + pitch * std::floor((box.low.x - phase) / pitch); x <= box.high.x; x += pitch) {
      Real low = 1e9L, high = -1e9L;
      for (const auto& ring : rings_)
        for (std::size_t k = 0; k < ring.size(); ++k) {
          const rs274::Point a = ring[k], b = ring[(k + 1) % ring.size()];
          if ((a.x <= x) == (b.x <= x)) continue;
          const Real y = a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y);
          low = std::min(low, y), high = std::max(high, y);
        }
      if (low <= high) supports.push_back({x, low}), supports.push_back({x, high});
    }
    Real depth = 1e9L;
    bool has_hull = false;
    for (const rs274::Point a : supports)
      for (const rs274::Point b : supports) {
        const Real size = std::hypot(b.x - a.x, b.y - a.y);
        if (size < 1e-9L) continue;
        const auto off = [&](rs274::Point p) {
          return ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / size;
        };
        Real farthest = 0;
        bool is_side = true;
        for (const rs274::Point p : supports)
          is_side = is_side && off(p) > -1e-12L, farthest = std::max(farthest, off(p));
        if (!is_side || farthest < 1e-9L) continue;
        has_hull = true;
        depth = std::min(depth, off(centre_));
      }
    return has_hull ? depth : -1;
  }

  [[nodiscard]] rs274::Point held_at(const Gap& gap, Real kerf, Real width, int which) const {
    const Real apart = rs274::distance(gap.end, gap.start);
    const rs274::Point way{(gap.start.x - gap.end.x) / apart, (gap.start.y - gap.end.y) / apart};
    const rs274::Point middle{(gap.start.x + gap.end.x) / 2, (gap.start.y + gap.end.y) / 2};
    // Outlines are followed clockwise: the part is on the right.
    return {middle.x + way.y * kerf / 2 + which * width / 2 * way.x,
            middle.y - way.x * kerf / 2 + which * width / 2 * way.y};
  }

 private:
  static rs274::Point on(const geom::Edge& edge, Real share) {
    if (edge.kind == geom::EdgeKind::line)
      return {edge.from.x + share * (edge.to.x - edge.from.x),
              edge.from.y + share * (edge.to.y - edge.from.y)};
    const Real angle = share * geom::arc_sweep(edge) * (edge.kind == geom::EdgeKind::arc_ccw ? 1 : -1);
    const Real x = edge.from.x - edge.centre.x, y = edge.from.y - edge.centre.y;
    return {edge.centre.x + std::cos(angle) * x - std::sin(angle) * y,
            edge.centre.y + std::sin(angle) * x + std::cos(angle) * y};
  }
  const geom::Region& region_;
  std::vector<std::vector<rs274::Point>> rings_;
  rs274::Point centre_;
};

TEST(NcJoints, NoPartTipsThatHasNoneAndNoneThatHas) {
  std::size_t stand = 0, held = 0, joints = 0, corners = 0;
  for (std::size_t index = 0; index < cases::case_count(6); ++index) {
    SCOPED_TRACE(fmt::format("seed {} case {}", cases::seed(), index));
    const std::vector<ProfilePart> parts = cases::random_parts(cases::seed(), index);
    Random random(cases::seed(), 11000 + index);
    ProfileOptions options;
    options.kerf_mm = 0.2, options.feed_mm_per_min = 1000, options.lead_in_mm = 1;
    options.joints.rule = JointRule::tipping;
    options.joints.width_mm = 0.5;
    options.joints.slats.pitch_mm = random.uniform(8, 45);
    const auto made = profile_program(parts, "random", options);
    ASSERT_TRUE(made) << made.error().message;
    const std::vector<Gap> gaps = gaps_of(chains_of(made->text));
    joints += gaps.size();
    for (const ProfilePart& part : parts) {
      const StandingPart standing(part.region);
      std::vector<rs274::Point> supports;
      for (const Gap& gap : gaps)
        if (gap.placement == part.id)
          for (const int which : {-1, 1}) supports.push_back(standing.held_at(gap, 0.2L, 0.5L, which));
      const bool unheld = std::find(made->unheld.begin(), made->unheld.end(), part.id) != made->unheld.end();
      if (!supports.empty()) ++held, corners += part.region.outer.size();
      Real least = 1e9L;
      for (int k = 0; k < 60; ++k) {
        const Real phase = random.uniform(0, options.joints.slats.pitch_mm);
        least = std::min(least, standing.depth(phase, options.joints.slats.pitch_mm, supports));
      }
      if (unheld) continue;
      EXPECT_GT(least, 0) << "placement " << part.id << " tips with " << supports.size() / 2 << " joints";
      stand += supports.empty() ? 1 : 0;
    }
  }
  EXPECT_GT(stand, 0U);
  EXPECT_GT(held, 0U);
  EXPECT_LE(joints, 3 * held);
  EXPECT_LT(joints, corners);
}

TEST(NcJoints, ThatAPartTipsIsSaidOfPartsThatDoOrNearlyDo) {
  std::size_t tipping = 0;
  for (std::size_t index = 0; index < cases::case_count(6); ++index) {
    Random random(cases::seed(), 10000 + index);
    const std::vector<ProfilePart> parts = cases::random_parts(cases::seed(), index);
    const double pitch = random.uniform(8, 45);
    const StandingPart standing(parts[0].region);
    if (!tips(parts[0].region, {pitch})) continue;
    ++tipping;
    Real least = 1e9L;
    for (int k = 0; k < 500; ++k) least = std::min(least, standing.depth(pitch * k / 500, pitch, {}));
    // Between two of these places supports move by a five hundredth of the pitch.
    EXPECT_LT(least, 2 * kTippingMargin + 0.02 + pitch / 500) << index;
  }
  EXPECT_GT(tipping, 0U);
}

}  // namespace
}  // namespace lekalo::nc::nc_cut_order_test
