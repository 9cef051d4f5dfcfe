#include "common_line_check.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "lekalo/base/stop.hpp"
#include "loose_check.hpp"

namespace lekalo::verify {
namespace {

/// Words have three decimals of a millimetre or more.
constexpr double kWordRounding = 2e-3;  // mm
constexpr double kLongestSample = 1;    // mm
constexpr double kSameWay = 0.2;        ///< the sine of the angle below which two cuts run one way
constexpr double kAskedKerfs = 2.5;  ///< a stretch of a cut that is longer has to belong to a part that holds
/// A cut may go over the end of another, and some way beyond it.
constexpr double kMostTwice = 2;
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
                                 const std::vector<CommonContour>& contours, const ProfileWords& words)
    : cuts_(cuts), contours_(contours), words_(words), half_(0.5 * words.kerf_mm) {
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    for (const Stroke& edge : cuts[c]->edges) add_pieces(edge, kInfinity, pieces_);
    cut_of_piece_.resize(pieces_.size(), c);
  }
  for (std::size_t i = 0; i < contours.size(); ++i) {
    edges_.insert(edges_.end(), contours[i].ring->pieces.begin(), contours[i].ring->pieces.end());
    contour_of_edge_.resize(edges_.size(), i);
  }
  index_ = index_of(pieces_);
  edge_index_ = index_of(edges_);
}

void CommonLineCheck::judge(ClaimReport& report) {
  check_sizes(report);
  check_once(report);
  check_leads(report);
  check_loose(report);
}

/// A cut so near to a contour runs beside it.
double CommonLineCheck::reach() const { return half_ + words_.tolerance_mm + kWordRounding; }

/// The middle of the nearest cut is half a kerf from each place of each contour, where half a kerf has room
/// beside it. That no cut comes nearer is asked of every cut anyway.
void CommonLineCheck::check_sizes(ClaimReport& report) {
  const double step = std::min(kLongestSample, words_.kerf_mm);
  double farthest = 0;
  for (const CommonContour& contour : contours_) {
    const bool right = std::signbit(contour.ring->area()) == contour.is_hole;
    bool is_told = false;
    for (const Stroke& piece : contour.ring->pieces) {
      const int samples = static_cast<int>(std::ceil(length(piece) / step));
      for (int k = 0; k < samples && !is_told; ++k) {
        ask();
        const Place at = at_share(piece, (k + 0.5) / samples);
        const Place middle = at + (right ? -half_ : half_) * left_of(heading(piece, at));
        if (!(contour.ring->distance_of(middle) >= half_ - 1e-7)) continue;
        const double apart = index_.nearest(at, pieces_);
        farthest = std::max(farthest, std::abs(apart - half_));
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
  report.notes.push_back(fmt::format(
      "the middle of a cut is half a kerf beside every contour, within {:.4f} mm", farthest + 5e-5));
}

/// No cut goes along another, or along itself, within the tolerance for more than kMostTwice kerfs.
void CommonLineCheck::check_once(ClaimReport& report) const {
  const double step = 0.25 * words_.kerf_mm, same = words_.tolerance_mm;
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
    const Stroke& piece = pieces_[i];
    const int samples = std::max(1, static_cast<int>(std::ceil(length(piece) / step)));
    const double each = length(piece) / samples;
    double twice = 0;
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
    for (std::size_t e = 2; e < cut.edges.size(); ++e) {
      ask();
      if (edge_index_.nearest(cut.edges[e].to, edges_) <= 3 * half_ + words_.tolerance_mm) continue;
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

std::vector<std::size_t> CommonLineCheck::contours_beside(Place p) const {
  std::vector<std::uint32_t> near;
  edge_index_.near(p, reach(), near);
  std::vector<std::size_t> beside;
  for (const std::uint32_t i : near)
    if (distance(p, edges_[i]) <= reach()) beside.push_back(contour_of_edge_[i]);
  std::sort(beside.begin(), beside.end());
  beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
  return beside;
}

double CommonLineCheck::Along::length_mm() const {
  double sum = 0;
  for (const Stroke& stroke : strokes) sum += length(stroke);
  return sum;
}

std::vector<CommonLineCheck::Along> CommonLineCheck::stretches() const {
  std::vector<Along> all;
  std::size_t last_cut = cuts_.size();
  for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
    const Stroke& piece = pieces_[i];
    const int samples = std::max(1, static_cast<int>(std::ceil(length(piece) / half_)));
    Place from = piece.from;
    for (int k = 0; k < samples; ++k) {
      ask();
      std::vector<std::size_t> beside = contours_beside(at_share(piece, (k + 0.5) / samples));
      const Place to = k + 1 == samples ? piece.to : at_share(piece, (k + 1.0) / samples);
      if (last_cut != cut_of_piece_[i] || all.back().contours != beside)
        all.push_back({cuts_[cut_of_piece_[i]]->line, {}, std::move(beside)});
      last_cut = cut_of_piece_[i];
      Strokes& strokes = all.back().strokes;
      // Straight pieces become one again, which keeps the question of what is loose short.
      if (!piece.arc && k > 0 && !strokes.empty() && !strokes.back().arc)
        strokes.back().to = to;
      else
        strokes.push_back({piece.arc, piece.ccw, from, to, piece.centre, piece.radius});
      from = to;
    }
  }
  return all;
}

/// Nothing is cut of a part round which the kerfs before have closed. Each cut is looked at in stretches that
/// run beside the same parts, because one cut frees several of them. The last of a part may be so short that
/// the kerfs at its two ends, or with that of a lead, meet already: it is not asked.
void CommonLineCheck::check_loose(ClaimReport& report) const {
  const std::vector<Along> all = stretches();
  LooseCheck loose(words_.kerf_mm);
  for (std::size_t k = 0; k < all.size(); ++k) loose.add(all[k].strokes, k);
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!(all[k].length_mm() > kAskedKerfs * words_.kerf_mm)) continue;
    for (const std::size_t contour : all[k].contours) {
      if (loose.steps() > kMostCommonSteps) {
        report.unchecked.push_back(
            "order: the cuts are too many to look for parts that several kerfs free together");
        return;
      }
      if (!loose.is_loose(contours_[contour].ring->pieces[0].from, k, all.size())) continue;
      report.findings.push_back(fmt::format("line {}: {} is cut when the kerfs before it have made it loose",
                                            all[k].line, contours_[contour].name));
      return;
    }
  }
}

}  // namespace lekalo::verify
