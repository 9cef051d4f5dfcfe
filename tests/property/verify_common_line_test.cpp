// Common lines over generated sheets. Exports hand on what the checker confirms, and of that the formulas of
// this test say the same: no kerf enters a part, parts come out at size, nothing is cut twice, and nothing is
// cut of a part that is loose.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <sstream>

#include "lekalo/base/angle.hpp"
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
          for (const rs274::Step& step : path.steps)
            least = std::min(least, cases::distance_to_step(at, step));
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
            if (&against == &step || is_there || cases::distance_to_step(at, against) > kerf / 5) continue;
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

/// A place of the material: the middle, or near a corner where a hole is in the middle.
rs274::Point place_in(const ProfilePart& part) {
  rs274::Point sum;
  for (const geom::Edge& edge : part.region.outer) sum.x += edge.from.x, sum.y += edge.from.y;
  const Real n = part.region.outer.size(), share = part.region.holes.empty() ? 1 : 0.15L;
  const geom::Point corner = part.region.outer.front().from;
  return {share * sum.x / n + (1 - share) * corner.x, share * sum.y / n + (1 - share) * corner.y};
}

/// A picture of the sheet in which each cell knows the moment at which it is burnt. What hangs together with
/// the border of the picture when all that is burnt later is still there has not been loose by then.
class Picture {
 public:
  static constexpr std::size_t kNever = static_cast<std::size_t>(-1);

  Picture(rs274::Point low, rs274::Point high, Real cell)
      : low_(low),
        cell_(cell),
        columns_(1 + static_cast<int>((high.x - low.x) / cell)),
        rows_(1 + static_cast<int>((high.y - low.y) / cell)),
        burnt_(std::size_t(columns_) * std::size_t(rows_), kNever) {}

  /// Burns a disc at the next moment.
  void burn(rs274::Point p, Real radius) {
    for (int y = row_of(p.y - radius); y <= row_of(p.y + radius); ++y)
      for (int x = column_of(p.x - radius); x <= column_of(p.x + radius); ++x)
        if (std::hypot(low_.x + (x + 0.5L) * cell_ - p.x, low_.y + (y + 0.5L) * cell_ - p.y) <= radius)
          if (std::size_t& moment = burnt_[at(x, y)]; moment == kNever) moment = moments_;
    ++moments_;
  }
  [[nodiscard]] std::size_t burnt_at(rs274::Point p) const { return burnt_[cell_of(p)]; }

  /// The moments at which what lies at these places came loose; kNever for what hangs together with the
  /// border or with another of them in the end.
  [[nodiscard]] std::vector<std::size_t> loose_at(const std::vector<rs274::Point>& places) const {
    std::vector<std::vector<std::size_t>> of_moment(moments_);
    std::vector<std::size_t> up(burnt_.size() + 1);
    std::iota(up.begin(), up.end(), std::size_t{0});
    const std::size_t border = burnt_.size();
    const auto root = [&](std::size_t cell) {
      while (up[cell] != cell) cell = up[cell] = up[up[cell]];
      return cell;
    };
    std::vector<bool> is_there(burnt_.size(), false);
    const auto add = [&](std::size_t cell) {
      is_there[cell] = true;
      const int x = static_cast<int>(cell % std::size_t(columns_)),
                y = static_cast<int>(cell / std::size_t(columns_));
      if (x == 0 || y == 0 || x == columns_ - 1 || y == rows_ - 1) up[root(cell)] = root(border);
      for (const auto& [nx, ny] : {std::pair{x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}})
        if (nx >= 0 && ny >= 0 && nx < columns_ && ny < rows_ && is_there[at(nx, ny)])
          up[root(cell)] = root(at(nx, ny));
    };
    for (std::size_t cell = 0; cell < burnt_.size(); ++cell)
      if (burnt_[cell] == kNever)
        add(cell);
      else
        of_moment[burnt_[cell]].push_back(cell);
    std::vector<std::size_t> loose(places.size(), kNever), in_the_end;
    for (const rs274::Point& place : places) in_the_end.push_back(root(cell_of(place)));
    std::vector<bool> is_open(places.size());
    for (std::size_t i = 0; i < places.size(); ++i)
      is_open[i] = in_the_end[i] != root(border) &&
                   std::count(in_the_end.begin(), in_the_end.end(), in_the_end[i]) == 1;
    for (std::size_t moment = moments_; moment-- > 0;) {
      for (const std::size_t cell : of_moment[moment]) add(cell);
      if (of_moment[moment].empty()) continue;
      for (std::size_t i = 0; i < places.size(); ++i)
        if (is_open[i] && root(cell_of(places[i])) == root(border)) loose[i] = moment, is_open[i] = false;
    }
    return loose;
  }

 private:
  [[nodiscard]] int column_of(Real x) const {
    return std::clamp(static_cast<int>(std::floor((x - low_.x) / cell_)), 0, columns_ - 1);
  }
  [[nodiscard]] int row_of(Real y) const {
    return std::clamp(static_cast<int>(std::floor((y - low_.y) / cell_)), 0, rows_ - 1);
  }
  [[nodiscard]] std::size_t at(int x, int y) const {
    return std::size_t(y) * std::size_t(columns_) + std::size_t(x);
  }
  [[nodiscard]] std::size_t cell_of(rs274::Point p) const { return at(column_of(p.x), row_of(p.y)); }

  rs274::Point low_;
  Real cell_;
  int columns_, rows_;
  std::vector<std::size_t> burnt_;  ///< the moment, by cell
  std::size_t moments_ = 0;
};

/// Says what is wrong with the order of the cuts, or with what is free in the end; empty where nothing is.
/// When a part comes loose, no more of its edges is left to cut than lies between kerfs that meet.
std::string wrong_in_picture(const std::vector<CutPath>& paths, const std::vector<ProfilePart>& parts,
                             const ProfileOptions& options) {
  // A picture is off by a cell or two.
  constexpr Real kCells = 8, kLeftKerfs = 1.5L + 2 / kCells;
  const Real kerf = options.kerf_mm, cell = kerf / kCells;
  rs274::Point low{1e9L, 1e9L}, high{-1e9L, -1e9L};
  for (const CutPath& path : paths)
    for (const rs274::Step& step : path.steps)
      for (const rs274::Point p : {step.from, step.at(0.25L), step.at(0.5L), step.at(0.75L), step.to}) {
        low = {std::min(low.x, p.x - 3 * kerf), std::min(low.y, p.y - 3 * kerf)};
        high = {std::max(high.x, p.x + 3 * kerf), std::max(high.y, p.y + 3 * kerf)};
      }
  Picture picture(low, high, cell);
  for (const CutPath& path : paths)
    for (const rs274::Step& step : path.steps) {
      const int pieces = 1 + static_cast<int>(length_of_step(step) / (kerf / 10));
      for (int k = 0; k <= pieces; ++k) picture.burn(step.at(Real(k) / pieces), kerf / 2);
    }
  std::vector<rs274::Point> places;
  for (const ProfilePart& part : parts) places.push_back(place_in(part));
  const std::vector<std::size_t> loose = picture.loose_at(places);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (loose[i] == Picture::kNever) return fmt::format("placement {} is not free in the end", parts[i].id);
    Real left = 0;
    const auto is_all_cut = [&](const geom::Contour& contour, Real from_corner) {
      for (const geom::Edge& edge : contour) {
        const Real x = edge.to.x - edge.from.x, y = edge.to.y - edge.from.y, length = std::hypot(x, y);
        // The material lies to the left, a cell to the right lies in the kerf.
        for (Real s = from_corner; s < length - from_corner; s += cell) {
          const std::size_t burnt = picture.burnt_at({edge.from.x + s / length * x + cell * y / length,
                                                      edge.from.y + s / length * y - cell * x / length});
          if (burnt == Picture::kNever) return false;
          if (burnt > loose[i]) left += cell;
        }
      }
      return true;
    };
    bool is_cut = is_all_cut(parts[i].region.outer, cell);
    // No kerf comes into the corners of holes.
    for (const geom::Contour& hole : parts[i].region.holes)
      is_cut = is_all_cut(hole, kerf / 2 + 2 * cell) && is_cut;
    if (!is_cut) return fmt::format("placement {} has an edge uncut", parts[i].id);
    if (left > kLeftKerfs * kerf)
      return fmt::format("{:.3f} mm of placement {} are cut when it is loose", double(left), parts[i].id);
  }
  return "";
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
        before = std::min(before, cases::distance_to_step(pierce, step));
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

cases::Points corners_of(const geom::Contour& contour) {
  cases::Points corners;
  for (const geom::Edge& edge : contour) corners.push_back({edge.from.x, edge.from.y});
  return corners;
}

/// The parts where they lie, as the text of a layout.
std::string layout_of(const std::vector<ProfilePart>& parts) {
  cases::Json layout = cases::empty_layout();
  layout["stocks"][0]["outline"] = cases::outline_json(cases::rectangle(-400, -400, 1000, 1000));
  for (const ProfilePart& part : parts) {
    std::vector<cases::Points> holes;
    for (const geom::Contour& hole : part.region.holes) holes.push_back(corners_of(hole));
    const std::string id = "p" + std::to_string(part.id);
    cases::add_part(layout, id, cases::outline_json(corners_of(part.region.outer), holes));
    cases::place(layout, id, 0, 0);
  }
  return layout.dump();
}

/// What the checker finds first, or what it leaves open; empty for a program that it confirms.
std::string first_finding(const std::string& program, const std::vector<ProfilePart>& parts,
                          const ProfileOptions& options) {
  verify::ProfileWords words;
  words.kerf_mm = options.kerf_mm, words.control = options.post.language;
  words.pierce_diameter_mm = options.pierce_diameter_mm, words.common_line = true;
  const std::string layout = layout_of(parts);
  const auto report = verify::verify_profile({"mosaic.nc", program}, {"mosaic.json", layout}, words);
  if (!report) return report.error().message;
  if (!report->findings.empty()) return report->findings.front();
  return report->unchecked.empty() ? "" : report->unchecked.front();
}

/// Rows and grids of rectangles, pairs of right triangles, and rectangles by themselves; each as it lies,
/// turned by a right angle, or freely. Some rectangles have a hole.
class ClusterMaker {
 public:
  ClusterMaker(Random& random, double kerf) : random_(random), kerf_(kerf) {}

  std::vector<ProfilePart> make() {
    const std::size_t count = 1 + random_.below(4);
    for (std::size_t k = 0; k < count; ++k) {
      middle_ = {100.0 * double(k % 2), 100.0 * double(k / 2)};
      turn_ = random_.below(3) == 0 ? 0 : random_.below(2) == 0 ? kPi / 2 : random_.uniform(-kPi, kPi);
      switch (random_.below(4)) {
        case 0:
          add_grid(1, 2 + random_.below(4));
          break;
        case 1:
          add_grid(2 + random_.below(2), 2 + random_.below(3));
          break;
        case 2:
          add_pair();
          break;
        default:
          add_grid(1, 1);
      }
    }
    return std::move(parts_);
  }

 private:
  [[nodiscard]] double side() { return std::round(random_.uniform(5, 14) * kerf_ * 1000) / 1000; }

  void add_grid(std::size_t rows, std::size_t columns) {
    std::vector<double> widths, heights;
    for (std::size_t c = 0; c < columns; ++c)
      widths.push_back(c > 0 && random_.below(2) == 0 ? widths.front() : side());
    for (std::size_t r = 0; r < rows; ++r)
      heights.push_back(r > 0 && random_.below(2) == 0 ? heights.front() : side());
    double y = 0;
    for (const double height : heights) {
      double x = 0;
      for (const double width : widths) {
        std::vector<std::vector<geom::Point>> holes;
        if (std::min(width, height) > 9 * kerf_ && random_.below(3) == 0)
          holes.push_back({{x + 3 * kerf_, y + 3 * kerf_},
                           {x + 3 * kerf_, y + height - 3 * kerf_},
                           {x + width - 3 * kerf_, y + height - 3 * kerf_},
                           {x + width - 3 * kerf_, y + 3 * kerf_}});
        add({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, holes);
        x += width + kerf_;
      }
      y += height + kerf_;
    }
  }

  /// The hypotenuses keep half a kerf from the diagonal.
  void add_pair() {
    const double width = side(), height = side(), along = std::hypot(width, height),
                 off_x = kerf_ / 2 * along / height, off_y = kerf_ / 2 * along / width;
    add({{off_x, 0}, {width, 0}, {width, height - off_y}}, {});
    add({{0, off_y}, {width - off_x, height}, {0, height}}, {});
  }

  void add(const std::vector<geom::Point>& corners, const std::vector<std::vector<geom::Point>>& holes) {
    std::vector<geom::Contour> contours;
    for (const auto& hole : holes) contours.push_back(placed(hole));
    parts_.push_back({parts_.size() + 1, cases::region_of_contours(placed(corners), contours)});
  }
  [[nodiscard]] geom::Contour placed(const std::vector<geom::Point>& corners) const {
    const auto [sine, cosine] = geom::sincos(turn_);
    std::vector<geom::Point> turned;
    for (const geom::Point& corner : corners)
      turned.push_back(middle_ + cosine * corner + sine * geom::perpendicular(corner));
    return cases::ring_contour(turned);
  }

  Random& random_;
  double kerf_;
  geom::Point middle_;
  double turn_ = 0;
  std::vector<ProfilePart> parts_;
};

ProfileOptions random_options(Random& random) {
  ProfileOptions options;
  options.common_line = true, options.feed_mm_per_min = 1000, options.speed = 500;
  options.post = posts()[random.below(posts().size())];
  options.unit = random.below(4) == 0 ? LengthUnit::inch : LengthUnit::millimetre;
  options.kerf_mm = std::round(random.uniform(0.5, 1.2) * 1000) / 1000;
  options.lead_in_mm = random.below(5) == 0 ? 0 : random.uniform(1, 4);
  if (options.lead_in_mm > 0 && random.below(2) == 0)
    options.pierce_diameter_mm = random.uniform(1, 1.6) * options.kerf_mm;
  return options;
}

/// All that the test's own formulas say of a program that the checker confirms.
void expect_true(const ProfileProgram& made, const std::vector<ProfilePart>& parts,
                 const ProfileOptions& options, std::size_t& in_kerfs) {
  const std::vector<CutPath> paths = cut_paths(made.text);
  ASSERT_EQ(paths.size(), made.cuts);
  ASSERT_LE(made.common_off_mm, options.tolerance_mm + 1e-3);
  expect_out_of_parts(paths, parts, options);
  expect_at_size(paths, parts, options, options.tolerance_mm);
  expect_cut_once(paths, options.kerf_mm);
  ASSERT_EQ(wrong_in_picture(paths, parts, options), "");
  if (options.pierce_diameter_mm > 0) expect_pierces_in_scrap(paths, parts, options, in_kerfs);
}

TEST(VerifyCommonLine, OfMosaicsThatAreConfirmedPartsComeOutAtSizeNothingIsCutTwiceOrLoose) {
  const std::size_t count = cases::case_count(30);
  std::size_t written = 0, refused = 0, lines = 0, in_kerfs = 0, discs = 0;
  for (std::size_t index = 0; index < count; ++index) {
    SCOPED_TRACE(fmt::format("seed {} case {}", cases::seed(), index));
    Random random(cases::seed(), 55000 + index);
    const ProfileOptions options = random_options(random);
    if (options.pierce_diameter_mm > 0) ++discs;
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
    if (!first_finding(made->text, parts, options).empty()) {
      ++refused;
      continue;
    }
    ++written, lines += made->common_lines;
    expect_true(*made, parts, options, in_kerfs);
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
  EXPECT_GT(lines, written);
  EXPECT_GT(2 * written, count);
  EXPECT_GT(discs, 0U);
  RecordProperty("refused", static_cast<int>(refused));
}

TEST(VerifyCommonLine, RowsGridsAndPairsAreConfirmedAndTrue) {
  const std::size_t count = cases::case_count(30);
  std::size_t lines = 0, in_kerfs = 0, without_place = 0;
  for (std::size_t index = 0; index < count; ++index) {
    SCOPED_TRACE(fmt::format("seed {} case {}", cases::seed(), index));
    Random random(cases::seed(), 77000 + index);
    const ProfileOptions options = random_options(random);
    const std::vector<ProfilePart> parts = ClusterMaker(random, options.kerf_mm).make();
    const auto made = profile_program(parts, "rows", options);
    if (!made) {
      ASSERT_NE(made.error().message.find("a pierce of"), std::string::npos) << made.error().message;
      ++without_place;
      continue;
    }
    lines += made->common_lines;
    ASSERT_EQ(first_finding(made->text, parts, options), "") << made->text;
    expect_true(*made, parts, options, in_kerfs);
    ASSERT_FALSE(HasFatalFailure()) << made->text;
  }
  EXPECT_GT(lines, count);
  EXPECT_LE(10 * without_place, count) << "a disc has a place beside almost every cluster";
}

/// The blocks of a program: what comes before the cuts, one for each cut, and what comes behind them.
std::vector<std::string> blocks_of(const std::string& program) {
  std::vector<std::string> blocks{""};
  std::istringstream lines(program);
  std::string line;
  bool has_ended = false;
  while (std::getline(lines, line)) {
    if (line.find("PLACEMENT") != std::string::npos || has_ended) blocks.emplace_back();
    blocks.back() += line + "\n";
    has_ended = line == "M5" && blocks.back() != "M5\n";
  }
  return blocks;
}
std::string joined(const std::vector<std::string>& blocks) {
  std::string all;
  for (const std::string& block : blocks) all += block;
  return all;
}

/// Ends the last motion of a cut earlier; empty where it is too short for that.
std::string ended_earlier(const std::string& block, double mm) {
  std::vector<std::string> lines;
  std::istringstream in(block);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  std::vector<std::size_t> motions;
  const auto place = [&](std::size_t i) {
    geom::Point p;
    std::sscanf(lines[i].c_str() + lines[i].find('X'), "X%lf Y%lf", &p.x, &p.y);
    return p;
  };
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (lines[i].find('X') != std::string::npos && lines[i][0] == 'G') motions.push_back(i);
  if (motions.size() < 2) return "";
  const geom::Point from = place(motions[motions.size() - 2]), to = place(motions.back());
  const double length = geom::norm(to - from);
  if (length < mm + 0.01) return "";
  const geom::Point end = to - (mm / length) * (to - from);
  lines[motions.back()] = fmt::format("G1 X{:.4f} Y{:.4f}", end.x, end.y);
  std::string all;
  for (const std::string& line : lines) all += line + "\n";
  return all;
}

TEST(VerifyCommonLine, ChangedOrdersDroppedLinesAndMovedEndsAreRefusedUnlessTheyAreTrue) {
  const std::size_t count = cases::case_count(30);
  std::size_t swaps = 0, swaps_refused = 0, dropped = 0, ended = 0;
  for (std::size_t index = 0; index < count; ++index) {
    SCOPED_TRACE(fmt::format("seed {} case {}", cases::seed(), index));
    Random random(cases::seed(), 99000 + index);
    ProfileOptions options = random_options(random);
    options.unit = LengthUnit::millimetre;
    const bool mosaic = random.below(2) == 0;
    const std::vector<ProfilePart> parts =
        mosaic ? turned_parts(cases::CommonSheetMaker(random, options.kerf_mm, 6 * options.kerf_mm).make(), 0)
               : ClusterMaker(random, options.kerf_mm).make();
    const auto made = profile_program(parts, "changed", options);
    if (!made || !first_finding(made->text, parts, options).empty()) continue;
    const std::vector<std::string> blocks = blocks_of(made->text);
    ASSERT_EQ(joined(blocks), made->text);
    ASSERT_EQ(blocks.size(), made->cuts + 2);
    std::vector<std::size_t> common;
    for (std::size_t b = 1; b <= made->cuts; ++b)
      if (blocks[b].find("COMMON LINE") != std::string::npos) common.push_back(b);
    if (common.empty()) continue;

    for (int k = 0; k < 3; ++k) {
      std::vector<std::string> changed = blocks;
      std::swap(changed[1 + random.below(made->cuts)], changed[1 + random.below(made->cuts)]);
      if (changed == blocks) continue;
      ++swaps;
      const std::string text = joined(changed);
      if (!first_finding(text, parts, options).empty()) {
        ++swaps_refused;
        continue;
      }
      // Some orders are as good as ours.
      ASSERT_EQ(wrong_in_picture(cut_paths(text), parts, options), "") << text;
    }

    const std::size_t one = common[random.below(common.size())];
    std::vector<std::string> changed = blocks;
    changed[one].clear();
    ASSERT_NE(first_finding(joined(changed), parts, options), "") << "without\n" << blocks[one] << made->text;
    ++dropped;

    changed = blocks;
    changed[one] = ended_earlier(blocks[one], random.uniform(2, 3) * options.kerf_mm);
    if (changed[one].empty()) continue;
    const std::string text = joined(changed);
    const std::string found = first_finding(text, parts, options);
    ended += found.empty() ? 0 : 1;
    if (found.empty()) {
      ASSERT_EQ(wrong_in_picture(cut_paths(text), parts, options), "") << text;
    }
  }
  EXPECT_GT(3 * swaps_refused, swaps);
  EXPECT_GT(5 * dropped, count);
  EXPECT_GT(5 * ended, dropped);
}

}  // namespace
}  // namespace lekalo::nc::verify_common_line_test
