// Common lines over generated sheets. Exports hand on what the checker confirms, and of that the formulas of
// this test say the same: no kerf enters a part, parts come out at size, nothing is cut twice, and nothing is
// cut of a part that is loose.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <queue>
#include <set>
#include <sstream>

#include "lekalo/nc/profile.hpp"
#include "lekalo/verify/claims.hpp"
#include "support/cases.hpp"
#include "support/common_sheets.hpp"
#include "support/layout_texts.hpp"
#include "support/profile_parts.hpp"

namespace lekalo::nc::verify_common_line_test {
namespace {

using cases::Real;

/// The motions from one pierce on.
struct CutPath {
  std::string remark;
  std::vector<rs274::Step> steps;
};

std::vector<CutPath> cut_paths(const std::string& program) {
  std::vector<CutPath> paths;
  std::vector<std::size_t> path_of_line{0};
  std::istringstream lines(program);
  std::string line, remark;
  bool on = false;
  while (std::getline(lines, line)) {
    if (line.find("PLACEMENT") != std::string::npos) remark = line;
    if (line == "M3" || line.rfind("M3 ", 0) == 0 || line.rfind("M4 ", 0) == 0)
      on = true, paths.push_back({remark, {}});
    if (line == "M5") on = false;
    path_of_line.push_back(on ? paths.size() : 0);
  }
  for (const rs274::Step& step : rs274::Reader().read(program))
    if (path_of_line[step.line] > 0) paths[path_of_line[step.line] - 1].steps.push_back(step);
  return paths;
}

Real distance_to_step(rs274::Point p, const rs274::Step& step) {
  const auto point = [](rs274::Point q) { return geom::Point{double(q.x), double(q.y)}; };
  const geom::EdgeKind kind = !step.arc        ? geom::EdgeKind::line
                              : step.sweep > 0 ? geom::EdgeKind::arc_ccw
                                               : geom::EdgeKind::arc_cw;
  return cases::distance_to_edge(p, {kind, point(step.from), point(step.to), point(step.centre)});
}

rs274::Point way_at(const rs274::Step& step, Real part) {
  const rs274::Point a = step.at(std::max<Real>(0, part - 1e-4L)),
                     b = step.at(std::min<Real>(1, part + 1e-4L));
  const Real size = rs274::distance(a, b);
  return {(b.x - a.x) / size, (b.y - a.y) / size};
}

Real length_of_step(const rs274::Step& step) {
  return step.arc ? std::abs(step.sweep) * step.start_radius : rs274::distance(step.from, step.to);
}

/// No kerf is deeper in a part than the tolerance.
void expect_out_of_parts(const std::vector<CutPath>& paths, const std::vector<ProfilePart>& parts,
                         const ProfileOptions& options) {
  for (const CutPath& path : paths)
    for (const rs274::Step& step : path.steps) {
      const int pieces = 1 + static_cast<int>(length_of_step(step) / (0.7L * options.kerf_mm));
      for (int k = 0; k <= pieces; ++k)
        for (const ProfilePart& part : parts)
          ASSERT_LE(cases::depth_of_kerf(step.at(Real(k) / pieces), part.region, options.kerf_mm),
                    options.tolerance_mm + 1e-6L)
              << path.remark << " in placement " << part.id;
    }
}

/// Beside every place of every edge, but for corners, the middle of a cut is half a kerf away.
void expect_at_size(const std::vector<CutPath>& paths, const std::vector<ProfilePart>& parts,
                    const ProfileOptions& options, double stated_off) {
  const Real half = options.kerf_mm / 2, rounding = 1e-3L;
  for (const ProfilePart& part : parts)
    for (const geom::Edge& edge : part.region.outer) {
      const int pieces = 1 + static_cast<int>(geom::norm(edge.to - edge.from) / options.kerf_mm);
      for (int k = 0; k <= pieces; ++k) {
        const double share = double(k) / pieces;
        const rs274::Point at{edge.from.x + share * (edge.to.x - edge.from.x),
                              edge.from.y + share * (edge.to.y - edge.from.y)};
        Real least = 1e9L;
        for (const CutPath& path : paths)
          for (const rs274::Step& step : path.steps) least = std::min(least, distance_to_step(at, step));
        ASSERT_NEAR(double(least), double(half), double(stated_off + 1.5L * rounding))
            << "placement " << part.id << " near " << double(at.x) << ", " << double(at.y);
      }
    }
}

/// Nothing goes along what is cut already, or along itself, for more than two kerfs.
void expect_cut_once(const std::vector<CutPath>& paths, Real kerf) {
  for (const CutPath& path : paths)
    for (const rs274::Step& step : path.steps) {
      const int pieces = 1 + static_cast<int>(length_of_step(step) / (kerf / 5));
      Real twice = 0;
      for (int k = 0; k < pieces; ++k) {
        const Real share = (k + 0.5L) / pieces;
        const rs274::Point at = step.at(share), way = way_at(step, share);
        bool is_there = false;
        for (const CutPath& other : paths)
          for (const rs274::Step& against : other.steps) {
            if (&against == &step || is_there || distance_to_step(at, against) > kerf / 5) continue;
            Real nearest = 1e9L, there = 0;
            for (int m = 0; m <= 200; ++m)
              if (const Real apart = rs274::distance(against.at(m / 200.0L), at); apart < nearest)
                nearest = apart, there = m / 200.0L;
            const rs274::Point along = way_at(against, there);
            is_there = std::abs(way.x * along.y - way.y * along.x) < 0.1L;
          }
        twice = is_there ? twice + length_of_step(step) / pieces : 0;
        ASSERT_LE(twice, 3 * kerf) << path.remark << " goes along another cut near " << double(at.x) << ", "
                                   << double(at.y);
      }
    }
}

/// A picture of the sheet in which kerfs are burnt.
class Picture {
 public:
  Picture(Real side, Real cell)
      : cells_(static_cast<int>(side / cell)),
        cell_(cell),
        burnt_(std::size_t(cells_) * std::size_t(cells_)) {}

  void burn(rs274::Point p, Real radius) {
    for (int y = cell_of(p.y - radius); y <= cell_of(p.y + radius); ++y)
      for (int x = cell_of(p.x - radius); x <= cell_of(p.x + radius); ++x)
        if (std::hypot((x + 0.5L) * cell_ - p.x, (y + 0.5L) * cell_ - p.y) <= radius) burnt_[at(x, y)] = true;
  }
  /// Whether a place hangs together with the rim of the sheet.
  [[nodiscard]] bool is_held(rs274::Point p) const {
    std::vector<bool> seen(burnt_);
    std::queue<std::pair<int, int>> open;
    const auto visit = [&](int x, int y) {
      if (seen[at(x, y)]) return;
      seen[at(x, y)] = true;
      open.emplace(x, y);
    };
    visit(cell_of(p.x), cell_of(p.y));
    while (!open.empty()) {
      const auto [x, y] = open.front();
      open.pop();
      if (x == 0 || y == 0 || x == cells_ - 1 || y == cells_ - 1) return true;
      visit(x - 1, y), visit(x + 1, y), visit(x, y - 1), visit(x, y + 1);
    }
    return false;
  }

 private:
  [[nodiscard]] int cell_of(Real mm) const {
    return std::clamp(static_cast<int>(std::floor(mm / cell_)), 0, cells_ - 1);
  }
  [[nodiscard]] std::size_t at(int x, int y) const {
    return std::size_t(y) * std::size_t(cells_) + std::size_t(x);
  }
  int cells_;
  Real cell_;
  std::vector<bool> burnt_;
};

rs274::Point middle_of(const ProfilePart& part) {
  rs274::Point sum;
  for (const geom::Edge& edge : part.region.outer) sum.x += edge.from.x, sum.y += edge.from.y;
  const Real n = part.region.outer.size();
  return {sum.x / n, sum.y / n};
}

/// When a cut comes to a part, the part is held; in the end none is.
void expect_nothing_cut_loose(const std::vector<CutPath>& paths, const std::vector<ProfilePart>& parts,
                              Real side, const ProfileOptions& options) {
  const Real kerf = options.kerf_mm, reach = kerf / 2 + options.tolerance_mm + 1e-3L;
  Picture picture(side, kerf / 5);
  for (const CutPath& path : paths) {
    std::set<std::size_t> beside;
    for (const rs274::Step& step : path.steps) {
      const int pieces = 1 + static_cast<int>(length_of_step(step) / (kerf / 5));
      for (int k = 0; k <= pieces; ++k) {
        const rs274::Point at = step.at(Real(k) / pieces);
        std::set<std::size_t> now;
        // The last bit between two kerfs is burnt by both of them: what is looked at lies farther on.
        const rs274::Point ahead = step.at(std::min<Real>(1, (k + 12.5L) / pieces));
        for (std::size_t i = 0; i < parts.size(); ++i)
          if (cases::distance_to_boundary(at, parts[i].region) <= reach &&
              cases::distance_to_boundary(ahead, parts[i].region) <= reach && k + 12.5L <= pieces)
            now.insert(i);
        for (const std::size_t i : now) {
          if (beside.contains(i)) continue;
          ASSERT_TRUE(picture.is_held(middle_of(parts[i])))
              << "placement " << parts[i].id << " was loose when " << path.remark << " came to it at "
              << double(at.x) << ", " << double(at.y);
        }
        beside = std::move(now);
        picture.burn(at, kerf / 2);
      }
    }
  }
  for (const ProfilePart& part : parts) ASSERT_FALSE(picture.is_held(middle_of(part))) << part.id;
}

/// Discs of pierces lie in scrap, or the cut begins in a kerf that is there already.
void expect_pierces_in_scrap(const std::vector<CutPath>& paths, const std::vector<ProfilePart>& parts,
                             const ProfileOptions& options, std::size_t& in_kerfs) {
  const Real disc = options.pierce_diameter_mm, kerf = options.kerf_mm;
  for (std::size_t c = 0; c < paths.size(); ++c) {
    const rs274::Point pierce = paths[c].steps.front().from;
    Real before = 1e9L;
    for (std::size_t b = 0; b < c; ++b)
      for (const rs274::Step& step : paths[b].steps)
        before = std::min(before, distance_to_step(pierce, step));
    if (before <= options.tolerance_mm + 1e-3L) {
      ++in_kerfs;
      continue;
    }
    ASSERT_GE(before, (disc + kerf) / 2 - 1e-6L) << paths[c].remark;
    for (const ProfilePart& part : parts)
      ASSERT_LE(cases::depth_of_kerf(pierce, part.region, disc), options.tolerance_mm + 1e-6L)
          << "pierce of " << paths[c].remark << " in placement " << part.id;
  }
}

std::vector<ProfilePart> turned_parts(const cases::CommonSheet& sheet, double turn) {
  const auto [sine, cosine] = geom::sincos(turn);
  const geom::Point middle{sheet.side / 2, sheet.side / 2};
  std::vector<ProfilePart> parts;
  for (const std::vector<geom::Point>& corners : sheet.parts) {
    std::vector<geom::Point> turned;
    for (const geom::Point& corner : corners) {
      const geom::Point out = corner - middle;
      turned.push_back(middle + cosine * out + sine * geom::perpendicular(out));
    }
    parts.push_back({parts.size() + 1, cases::region_of_contours(cases::ring_contour(turned))});
  }
  return parts;
}

/// The parts where they lie, as the text of a layout.
std::string layout_of(const std::vector<ProfilePart>& parts) {
  cases::Json layout = cases::empty_layout();
  layout["stocks"][0]["outline"] = cases::outline_json(cases::rectangle(-200, -200, 600, 600));
  for (const ProfilePart& part : parts) {
    cases::Points corners;
    for (const geom::Edge& edge : part.region.outer) corners.push_back({edge.from.x, edge.from.y});
    const std::string id = "p" + std::to_string(part.id);
    cases::add_part(layout, id, cases::outline_json(corners));
    cases::place(layout, id, 0, 0);
  }
  return layout.dump();
}

bool is_confirmed(const std::string& program, const std::vector<ProfilePart>& parts,
                  const ProfileOptions& options) {
  verify::ProfileWords words;
  words.kerf_mm = options.kerf_mm, words.control = options.post.language;
  words.pierce_diameter_mm = options.pierce_diameter_mm, words.common_line = true;
  const std::string layout = layout_of(parts);
  const auto report = verify::verify_profile({"mosaic.nc", program}, {"mosaic.json", layout}, words);
  if (!report) ADD_FAILURE() << report.error().message;
  return report && report->findings.empty();
}

TEST(VerifyCommonLine, OfWhatIsConfirmedPartsComeOutAtSizeNothingIsCutTwiceOrLoose) {
  const std::size_t count = cases::case_count(30);
  std::size_t written = 0, refused = 0, lines = 0, in_kerfs = 0, discs = 0;
  for (std::size_t index = 0; index < count; ++index) {
    SCOPED_TRACE(fmt::format("seed {} case {}", cases::seed(), index));
    Random random(cases::seed(), 55000 + index);
    ProfileOptions options;
    options.common_line = true, options.feed_mm_per_min = 1000, options.speed = 500;
    options.post = posts()[random.below(posts().size())];
    options.unit = random.below(4) == 0 ? LengthUnit::inch : LengthUnit::millimetre;
    options.kerf_mm = std::round(random.uniform(0.5, 1.2) * 1000) / 1000;
    options.lead_in_mm = random.below(5) == 0 ? 0 : random.uniform(1, 4);
    if (options.lead_in_mm > 0 && random.below(2) == 0) {
      options.pierce_diameter_mm = random.uniform(1, 1.6) * options.kerf_mm;
      ++discs;
    }
    const cases::CommonSheet sheet =
        cases::CommonSheetMaker(random, options.kerf_mm, 6 * options.kerf_mm).make();
    const std::vector<ProfilePart> parts =
        turned_parts(sheet, random.below(2) == 0 ? 0 : random.uniform(-0.4, 0.4));
    const auto made = profile_program(parts, "mosaic", options);
    if (!made) {
      ASSERT_EQ(made.error().code, ErrorCode::bad_input) << made.error().message;
      ASSERT_NE(made.error().message.find("a pierce of"), std::string::npos) << made.error().message;
      continue;
    }
    if (!is_confirmed(made->text, parts, options)) {
      ++refused;
      continue;
    }
    ++written, lines += made->common_lines;
    const std::vector<CutPath> paths = cut_paths(made->text);
    ASSERT_EQ(paths.size(), made->cuts);
    ASSERT_LE(made->common_off_mm, options.tolerance_mm + 1e-3);
    expect_out_of_parts(paths, parts, options);
    expect_at_size(paths, parts, options, options.tolerance_mm);
    expect_cut_once(paths, options.kerf_mm);
    expect_nothing_cut_loose(paths, parts, sheet.side, options);
    if (options.pierce_diameter_mm > 0) expect_pierces_in_scrap(paths, parts, options, in_kerfs);
    if (HasFatalFailure()) {
      ADD_FAILURE() << made->text;
      return;
    }
    // Every shared edge was in two outlines, and is in one cut.
    ProfileOptions apart = options;
    apart.common_line = false;
    const auto twice = profile_program(parts, "mosaic", apart);
    EXPECT_DOUBLE_EQ(twice ? twice->shared_mm : made->shared_mm, made->shared_mm);
  }
  EXPECT_GT(lines, 2 * written);
  EXPECT_GT(3 * written, 2 * count);
  EXPECT_GT(discs, 0U);
  EXPECT_LE(10 * refused, count) << "what is refused is a needless no";
  RecordProperty("refused", static_cast<int>(refused));
  EXPECT_TRUE(count < 200 || in_kerfs > 0);
}

}  // namespace
}  // namespace lekalo::nc::verify_common_line_test
