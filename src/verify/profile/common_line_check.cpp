#include "common_line_check.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "lekalo/base/stop.hpp"

namespace lekalo::verify {
namespace {

/// Words have three decimals of a millimetre or more.
constexpr double kWordRounding = 2e-3;  // mm
/// No more of a contour may be without a cut beside it, as a share of the kerf.
constexpr double kMostOpenKerfs = 1.0 / 16;
constexpr double kSameWay = 0.2;  ///< the sine of the angle below which two cuts run one way
/// A cut may go over the end of another, and some way beyond it.
constexpr double kMostTwice = 2;
/// A part that hangs on by less than a quarter of a kerf is taken for loose: kerfs so near to each other
/// meet.
constexpr double kLooseKerfs = 1.25;
/// So much of its edges may be left to cut of a part when its last kerfs meet: half a kerf where they meet at
/// a right angle, more in blunt corners.
constexpr double kMostAfterLoose = 1.5;
constexpr double kLoosePiece = 20;  // mm
constexpr std::size_t kMostCommonSteps = 2'000'000'000;

StrokeIndex index_of(const Strokes& strokes) {
  StrokeExtent extent;
  extent.add(strokes);
  StrokeIndex index(extent.low, extent.high, 1 + length(extent.high - extent.low) / 300);
  for (std::uint32_t i = 0; i < strokes.size(); ++i) index.add(i, strokes[i]);
  return index;
}

}  // namespace

CommonLineCheck::CommonLineCheck(const std::vector<const CutChain*>& cuts,
                                 const std::vector<ShallowCut>& shallow,
                                 const std::vector<CommonContour>& contours, const ProfileWords& words)
    : cuts_(cuts), shallow_(shallow), contours_(contours), words_(words), half_(0.5 * words.kerf_mm) {
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    for (const Stroke& edge : cuts[c]->edges) add_pieces(edge, kInfinity, pieces_);
    cut_of_piece_.resize(pieces_.size(), c);
  }
  for (const CommonContour& contour : contours)
    edges_.insert(edges_.end(), contour.ring->pieces.begin(), contour.ring->pieces.end());
  index_ = index_of(pieces_);
  edge_index_ = index_of(edges_);
  add_parts();
}

/// A place well inside of each part: from the middles of its edges inwards, by halves of its size.
void CommonLineCheck::add_parts() {
  for (std::size_t i = 0; i < contours_.size(); ++i) {
    if (!contours_[i].is_hole) parts_.push_back({fmt::format("placement {}", contours_[i].part), {}, {}, {}});
    parts_.back().contours.push_back(i);
  }
  for (Part& part : parts_) {
    const ContourRing& outline = *contours_[part.contours[0]].ring;
    part.extent.add(outline.pieces);
    const double size = length(part.extent.high - part.extent.low);
    double most = 0;
    for (const Stroke& edge : outline.pieces) {
      ask();
      const Place middle = at_share(edge, 0.5);
      const Place inwards = (outline.area() < 0 ? -1.0 : 1.0) * left_of(heading(edge, middle));
      for (double far = 0.5 * size; far > 1e-3 * half_; far *= 0.5) {
        const Place p = middle + far * inwards;
        if (!outline.encloses(p) ||
            std::any_of(part.contours.begin() + 1, part.contours.end(),
                        [&](std::size_t hole) { return contours_[hole].ring->encloses(p); }))
          continue;
        if (const double deep = distance_of(part, p); deep > most) most = deep, part.inside = p;
      }
    }
  }
}

double CommonLineCheck::distance_of(const Part& part, Place p) const {
  double least = kInfinity;
  for (const std::size_t contour : part.contours)
    least = std::min(least, contours_[contour].ring->distance_of(p));
  return least;
}

/// The place of the part's edges that is nearest to a place within reach; one that is far off for others.
Place CommonLineCheck::nearest_of(const Part& part, Place p) const {
  Place nearest{kInfinity, kInfinity};
  double least = kInfinity;
  for (const std::size_t contour : part.contours) {
    const ContourRing& ring = *contours_[contour].ring;
    for (const std::uint32_t i : ring.near(p, reach())) {
      const Place on = nearest_on(ring.pieces[i], p);
      if (const double apart = length(on - p); apart < least) least = apart, nearest = on;
    }
  }
  return nearest;
}

void CommonLineCheck::judge(ClaimReport& report) {
  check_sizes(report);
  check_once(report);
  check_leads(report);
  check_free(report);
  check_loose(report);
}

/// A cut so near to a contour runs beside it.
double CommonLineCheck::reach() const { return half_ + words_.tolerance_mm + kWordRounding; }

double CommonLineCheck::beside_up_to(const Stroke& edge, double from) const {
  const double whole = length(edge);
  const Place way = heading(edge, edge.from), at = edge.from + from * way;
  std::vector<std::uint32_t> near;
  index_.near(at, reach(), near);
  double most = from;
  for (const std::uint32_t i : near) {
    const auto is_beside = [&](double s) { return distance(edge.from + s * way, pieces_[i]) <= reach(); };
    // Places near to a straight cut are a convex set.
    if (pieces_[i].arc || !is_beside(from)) continue;
    if (is_beside(whole)) return whole;
    double beside = from, open = whole;
    while (open - beside > 1e-3 * half_) {
      const double middle = 0.5 * (beside + open);
      (is_beside(middle) ? beside : open) = middle;
    }
    most = std::max(most, beside);
  }
  return most;
}

/// The middle of the nearest cut is half a kerf from each place of each contour, where half a kerf has room
/// beside it. That no cut comes nearer is asked of every cut anyway.
void CommonLineCheck::check_sizes(ClaimReport& report) {
  const double step = kMostOpenKerfs * words_.kerf_mm;
  for (const CommonContour& contour : contours_) {
    const bool right = std::signbit(contour.ring->area()) == contour.is_hole;
    bool is_told = false;
    for (const Stroke& piece : contour.ring->pieces) {
      const double whole = length(piece);
      for (double s = 0.5 * std::min(step, whole); s < whole && !is_told; s += step) {
        ask();
        if (!piece.arc) s = beside_up_to(piece, s);
        const Place at = piece.arc ? at_share(piece, s / whole) : piece.from + s * heading(piece, piece.from);
        const Place middle = at + (right ? -half_ : half_) * left_of(heading(piece, at));
        if (!(contour.ring->distance_of(middle) >= half_ - 1e-7)) continue;
        const double apart = index_.nearest(at, pieces_);
        if (apart <= reach()) continue;
        is_told = true;
        report.findings.push_back(
            apart > 2 * words_.kerf_mm
                ? fmt::format("{} is not cut near ({:.4f}, {:.4f})", contour.name, at.x, at.y)
                : fmt::format("{} is {:.4f} mm from the middle of the nearest cut near ({:.4f}, {:.4f}), and "
                              "half the kerf is {:g} mm",
                              contour.name, apart, at.x, at.y, half_));
      }
    }
  }
  report.notes.push_back(
      fmt::format("the middle of a cut is half a kerf beside every contour, within {:.4f} mm",
                  words_.tolerance_mm + kWordRounding));
}

/// No cut goes along another, or along itself, within the tolerance for more than kMostTwice kerfs.
void CommonLineCheck::check_once(ClaimReport& report) const {
  const double step = 0.25 * words_.kerf_mm, same = words_.tolerance_mm;
  std::vector<std::uint32_t> near;
  double twice = 0;
  for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
    const Stroke& piece = pieces_[i];
    const int samples = std::max(1, static_cast<int>(std::ceil(length(piece) / step)));
    const double each = length(piece) / samples;
    if (i > 0 && cut_of_piece_[i] != cut_of_piece_[i - 1]) twice = 0;
    for (int k = 0; k < samples; ++k) {
      ask();
      const Place at = at_share(piece, (k + 0.5) / samples), way = heading(piece, at);
      near.clear();
      index_.near(at, same, near);
      const bool is_there = std::any_of(near.begin(), near.end(), [&](std::uint32_t j) {
        if (j == i || !(length(pieces_[j]) > 0)) return false;
        const Place on = nearest_on(pieces_[j], at);
        return length(on - at) <= same && std::abs(cross(way, heading(pieces_[j], on))) < kSameWay;
      });
      twice = is_there ? twice + each : 0;
      if (!(twice > kMostTwice * words_.kerf_mm)) continue;
      report.findings.push_back(fmt::format("line {}: what it cuts near ({:.4f}, {:.4f}) is cut twice",
                                            cuts_[cut_of_piece_[i]]->line, at.x, at.y));
      return;
    }
  }
}

/// Says whether an edge but for its beginning, looked at every kerf, is so near to contours.
bool CommonLineCheck::all_within(const Stroke& edge, double near) const {
  Strokes pieces;
  add_pieces(edge, words_.kerf_mm, pieces);
  return std::all_of(pieces.begin(), pieces.end(), [&](const Stroke& piece) {
    ask();
    return edge_index_.nearest(piece.to, edges_) <= near;
  });
}

/// Cuts run beside parts, but for a lead of one or two lines. The disc of a pierce is clear of parts, and it
/// and the lead are clear of the kerfs before; a cut that begins in one of these pierces nothing.
void CommonLineCheck::check_leads(ClaimReport& report) const {
  const double disc = 0.5 * words_.pierce_diameter_mm;
  std::vector<std::uint32_t> near;
  const auto meets_before = [&](const Stroke& piece, double by, std::size_t cut) {
    near.clear();
    index_.near(at_share(piece, 0.5), 0.5 * length(piece) + by, near);
    return std::any_of(near.begin(), near.end(), [&](std::uint32_t j) {
      if (cut_of_piece_[j] >= cut) return false;
      std::vector<Place> crossings;
      add_crossings(piece, pieces_[j], crossings);
      return !crossings.empty() || !(distance_apart(piece, pieces_[j]) >= by - 1e-7);
    });
  };
  for (std::size_t c = 0; c < cuts_.size(); ++c) {
    const CutChain& cut = *cuts_[c];
    // A line goes over the middle of a crossing, which is farther from the parts around it than half a kerf.
    const double beside = 3 * half_ + words_.tolerance_mm;
    bool is_beside = false, leaves = false;
    for (std::size_t e = 0; e < cut.edges.size(); ++e) {
      is_beside = is_beside || edge_index_.nearest(cut.edges[e].to, edges_) <= beside;
      leaves = leaves || (e >= 2 && !all_within(cut.edges[e], beside));
    }
    if (leaves || !is_beside) {
      report.findings.push_back(fmt::format("line {}: the cut leaves the parts", cut.line));
      return;
    }
    if (words_.pierce_diameter_mm == 0) continue;
    const Place pierce = cut.edges[0].from;
    if (meets_before({false, true, pierce, pierce, {}, 0}, words_.tolerance_mm + kWordRounding, c)) continue;
    if (!(edge_index_.nearest(pierce, edges_) >= disc - words_.tolerance_mm - 1e-7))
      report.findings.push_back(
          fmt::format("line {}: the pierce of {} mm enters a part", cut.line, words_.pierce_diameter_mm));
    const bool has_lead = edge_index_.nearest(pierce, edges_) > reach();
    if (meets_before({false, true, pierce, pierce, {}, 0}, disc + half_, c) ||
        (has_lead && meets_before(cut.edges[0], 2 * half_, c)))
      report.findings.push_back(
          fmt::format("line {}: the pierce or its lead meets a kerf that is there before it", cut.line));
  }
}

/// In the end the kerfs close round every part, and between any two that are near each other.
void CommonLineCheck::check_free(ClaimReport& report) const {
  LooseCheck kerfs(words_.kerf_mm);
  for (std::size_t c = 0; c < cuts_.size(); ++c) kerfs.add(cuts_[c]->edges, c);
  for (std::size_t a = 0; a < parts_.size(); ++a) {
    if (!kerfs.parted_at(parts_[a].inside)) {
      report.findings.push_back(parts_[a].name + " still hangs on after the last cut");
      return;
    }
    for (std::size_t b = 0; b < a; ++b) {
      const Place gap{std::max(parts_[a].extent.low.x - parts_[b].extent.high.x,
                               parts_[b].extent.low.x - parts_[a].extent.high.x),
                      std::max(parts_[a].extent.low.y - parts_[b].extent.high.y,
                               parts_[b].extent.low.y - parts_[a].extent.high.y)};
      if (std::max(gap.x, gap.y) > 2 * words_.kerf_mm) continue;
      if (kerfs.steps() > kMostCommonSteps) {
        report.unchecked.push_back("cuts: they are too many to look whether all parts are free in the end");
        return;
      }
      if (kerfs.parted_at(parts_[a].inside, parts_[b].inside)) continue;
      report.findings.push_back(
          fmt::format("{} and {} still hang together after the last cut", parts_[b].name, parts_[a].name));
      return;
    }
  }
}

/// Nothing is cut of a part that is loose, but for what the kerfs that freed it have all but cut.
void CommonLineCheck::check_loose(ClaimReport& report) const {
  LooseCheck held(kLooseKerfs * words_.kerf_mm);
  for (std::size_t c = 0; c < cuts_.size(); ++c) held.add(cuts_[c]->edges, c);
  const StrokeIndex index = index_of(held.pieces());
  for (const Part& part : parts_) {
    if (held.steps() > kMostCommonSteps) {
      report.unchecked.push_back(
          "order: the cuts are too many to look for parts that several kerfs free together");
      return;
    }
    const std::optional<LooseCheck::Moment> loose = held.parted_at(part.inside);
    if (!loose) continue;
    std::string finding = cut_when_loose(part, held, index, *loose);
    if (finding.empty()) finding = passed_when_loose(part, held.cut_of(loose->piece));
    if (!finding.empty()) {
      report.findings.push_back(std::move(finding));
      return;
    }
  }
}

std::string CommonLineCheck::cut_when_loose(const Part& part, const LooseCheck& held,
                                            const StrokeIndex& index, LooseCheck::Moment loose) const {
  const double meeting = kLooseKerfs * words_.kerf_mm, step = words_.kerf_mm / 8;
  Strokes around;
  for (const std::size_t contour : part.contours)
    for (const Stroke& edge : contours_[contour].ring->pieces) add_pieces(edge, kLoosePiece, around);
  std::vector<std::uint32_t> beside, near;
  for (const Stroke& edge : around) {
    near.clear();
    index.near(at_share(edge, 0.5), 0.5 * length(edge) + reach(), near);
    beside.insert(beside.end(), near.begin(), near.end());
  }
  std::sort(beside.begin(), beside.end());
  beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
  const auto was_cut = [&](Place p, double within) {
    near.clear();
    index.near(p, within, near);
    return std::any_of(near.begin(), near.end(), [&](std::uint32_t i) {
      if (i > loose.piece) return false;
      const Stroke& before = held.pieces()[i];
      return distance(p, i < loose.piece ? before : until(before, at_share(before, loose.share))) <= within;
    });
  };
  double after = 0;
  for (const std::uint32_t i : beside) {
    if (i < loose.piece) continue;
    const Stroke& piece = held.pieces()[i];
    const double begin = i == loose.piece ? loose.share : 0, whole = (1 - begin) * length(piece);
    const int samples = std::max(1, static_cast<int>(std::ceil(whole / step)));
    for (int k = 0; k < samples; ++k) {
      ask();
      const auto at = [&](double part_of) {
        return at_share(piece, begin + (1 - begin) * part_of / samples);
      };
      const Place middle = at(k + 0.5), edge = nearest_of(part, middle);
      // An edge in a kerf that is there already is not cut again.
      if (!(length(edge - middle) <= reach()) || was_cut(edge, reach())) continue;
      // Round a corner a cut goes on, and the edge does not.
      const double passed = length(nearest_of(part, at(k + 1.0)) - nearest_of(part, at(k)));
      after += std::min(passed, whole / samples);
      if (was_cut(middle, meeting) && after <= kMostAfterLoose * words_.kerf_mm) continue;
      return fmt::format("line {}: {} is cut near ({:.4f}, {:.4f}) when the kerfs before have made it loose",
                         cuts_[held.cut_of(i)]->line, part.name, middle.x, middle.y);
    }
  }
  return "";
}

/// Passes that do not reach the bottom come before the cut that makes their part loose.
std::string CommonLineCheck::passed_when_loose(const Part& part, std::size_t cut) const {
  for (const ShallowCut& pass : shallow_) {
    if (pass.through_before <= cut) continue;
    Strokes pieces;
    for (const Stroke& edge : pass.chain->edges) add_pieces(edge, words_.kerf_mm, pieces);
    for (const Stroke& piece : pieces) {
      ask();
      if (!(distance_of(part, piece.to) <= reach())) continue;
      return fmt::format("line {}: {} is cut near ({:.4f}, {:.4f}) when the kerfs before have made it loose",
                         pass.chain->line, part.name, piece.to.x, piece.to.y);
    }
  }
  return "";
}

}  // namespace lekalo::verify
