#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "engraved_marks.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/verify/claims.hpp"
#include "profile_moves.hpp"
#include "verify/drawn/placed_sheet.hpp"
#include "verify/layout/layout_document.hpp"
#include "verify/number/span.hpp"
#include "verify/pocket/stroke_index.hpp"

namespace lekalo::verify {
namespace {

using Strokes = std::vector<Stroke>;

/// A line or arc as pieces that are nearly straight: within `off` mm of their chords.
void add_straight(const Stroke& edge, double off, Strokes& pieces) {
  add_pieces(edge, edge.arc ? std::sqrt(8 * edge.radius * off) : kInfinity, pieces);
}

struct Extent {
  Place low{kInfinity, kInfinity}, high{-low.x, -low.y};
  void add(const Strokes& strokes) {
    for (const Stroke& s : strokes) {
      Place from, to;
      box_of(s, from, to);
      low = {std::min(low.x, from.x), std::min(low.y, from.y)};
      high = {std::max(high.x, to.x), std::max(high.y, to.y)};
    }
  }
  [[nodiscard]] bool holds(Place p, double margin) const {
    return std::max({low.x - p.x, p.x - high.x, low.y - p.y, p.y - high.y}) <= margin;
  }
};

/// The pieces of closed contours, the places near them, and which places they enclose.
class Ring {
 public:
  Ring(const std::vector<Strokes>& contours, double off) {
    for (const Strokes& contour : contours)
      for (const Stroke& edge : contour) {
        add_pieces(edge, kInfinity, pieces);
        add_straight(edge, off, straight_);
      }
    extent_.add(pieces);
    index_ = StrokeIndex(extent_.low, extent_.high, 1 + length(extent_.high - extent_.low) / 300);
    for (std::uint32_t i = 0; i < pieces.size(); ++i) index_.add(i, pieces[i]);
  }

  [[nodiscard]] bool is_near(Place p, double margin) const { return extent_.holds(p, margin); }
  [[nodiscard]] double distance_of(Place p) const { return index_.nearest(p, pieces); }
  [[nodiscard]] bool encloses(Place p) const {
    if (!is_near(p, 0)) return false;
    bool in = false;
    for (const Stroke& s : straight_)
      if (crosses_ray_to_the_right({false, true, s.from, s.to, {}, 0}, p)) in = !in;
    return in;
  }
  [[nodiscard]] double area() const {
    double twice = 0;
    for (const Stroke& s : straight_) twice += cross(s.from - extent_.low, s.to - extent_.low);
    return 0.5 * twice;
  }
  [[nodiscard]] std::vector<std::uint32_t> near(Place p, double reach) const {
    std::vector<std::uint32_t> numbers;
    index_.near(p, reach, numbers);
    return numbers;
  }

  Strokes pieces;

 private:
  Strokes straight_;
  Extent extent_;
  StrokeIndex index_;
};

/// A contour of a placed part that is to be cut.
struct Wanted {
  std::uint64_t part = 0;
  std::size_t hole = 0;  ///< 0 for the outer contour, else the number of the hole
  Ring ring;
  bool cut = false;
  [[nodiscard]] std::string name() const {
    return hole == 0 ? fmt::format("the outline of placement {}", part)
                     : fmt::format("hole {} of placement {}", hole, part);
  }
};

/// The closed part of a chain and the lead before it.
struct Loop {
  std::size_t line = 0;
  Ring ring;
  std::size_t of = 0;  ///< the contour that it follows
};

class ProfileCheck {
 public:
  ProfileCheck(const PlacedSheet& sheet, const ProfileWords& words)
      : half_(0.5 * words.kerf_mm), words_(words) {
    std::vector<Strokes> all;
    for (const PlacedSheet::Part& part : sheet.parts) {
      for (std::size_t i = 0; i < part.contours.size(); ++i) {
        wanted_.push_back({part.id, i, Ring({part.contours[i]}, 0.1 * half_), false});
        all.push_back(part.contours[i]);
      }
      parts_.emplace_back(part.id, Ring(part.contours, 0.1 * half_));
    }
    marks_.emplace(sheet);
    all_.emplace(all, 0.1 * half_);
  }

  ClaimReport checked(const std::vector<CutChain>& chains) {
    for (const CutChain& chain : chains) {
      if (!chain.rapid && marks_->follows(chain)) {
        keep_before_cuts(chain);
        continue;
      }
      if (chain.rapid) report_.findings.push_back(fmt::format("line {}: a rapid motion cuts", chain.line));
      keep_out(chain);
      follow(chain);
    }
    for (const Wanted& wanted : wanted_)
      if (!wanted.cut) report_.findings.push_back(wanted.name() + " is not cut");
    check_order();
    report_.notes.push_back(
        fmt::format("{} cuts along {} contours of {} parts were rechecked for a kerf of {} mm",
                    chains.size() - marks_->engravings(), wanted_.size(), parts_.size(), words_.kerf_mm));
    if (std::string note = marks_->note(); !note.empty()) report_.notes.push_back(std::move(note));
    return std::move(report_);
  }

 private:
  /// No part of a cut, its lead among it, comes nearer to an edge of a part than half the kerf less the
  /// tolerance, and it begins outside of all. Then all of it lies outside: docs/design/export.md has the
  /// proof.
  void keep_out(const CutChain& chain) {
    const double least = half_ - words_.tolerance_mm - kRounding;
    Strokes pieces;
    for (const Stroke& edge : chain.edges) add_pieces(edge, 5, pieces);
    for (const Stroke& piece : pieces) {
      ask();
      const double reach = half_ + 0.5 * length(piece) + kRounding;
      for (const std::uint32_t i : all_->near(at_share(piece, 0.5), reach)) {
        const Stroke& edge = all_->pieces[i];
        std::vector<Place> crossings;
        add_crossings(piece, edge, crossings);
        if (distance_apart(piece, edge) >= least && crossings.empty()) continue;
        report_.findings.push_back(fmt::format("line {}: the kerf enters a part near ({:.4f}, {:.4f})",
                                               chain.line, piece.from.x, piece.from.y));
        return;
      }
    }
    for (const auto& [id, ring] : parts_)
      if (ring.encloses(chain.edges[0].from))
        report_.findings.push_back(fmt::format("line {}: the cut begins in placement {}", chain.line, id));
  }

  /// A part that was cut out may have moved, so that its marks come before.
  void keep_before_cuts(const CutChain& chain) {
    for (const Loop& loop : loops_)
      if (loop.ring.encloses(chain.edges[0].from)) {
        report_.findings.push_back(
            fmt::format("line {}: a mark is engraved after {} was cut", chain.line, wanted_[loop.of].name()));
        return;
      }
  }

  /// Finds the contour that the closed part of a chain follows.
  void follow(const CutChain& chain) {
    const Place end = chain.edges.back().to;
    const auto first = std::find_if(chain.edges.begin(), chain.edges.end(),
                                    [&](const Stroke& s) { return s.from.x == end.x && s.from.y == end.y; });
    if (first == chain.edges.end()) {
      report_.findings.push_back(fmt::format("line {}: the cut is not closed", chain.line));
      return;
    }
    Loop loop{chain.line, Ring({Strokes(first, chain.edges.end())}, 0.1 * half_), 0};
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
      if (!follows(loop.ring, wanted_[i])) continue;
      wanted_[i].cut = true;
      loop.of = i;
      loops_.push_back(std::move(loop));
      return;
    }
    report_.findings.push_back(fmt::format("line {}: the cut follows no contour of a part", chain.line));
  }

  /// All of the loop lies within half a kerf of the contour, it runs on its waste side, and it is there
  /// wherever the middle of the kerf could be half a kerf from the contour.
  [[nodiscard]] bool follows(const Ring& loop, const Wanted& wanted) const {
    const Place start = loop.pieces[0].from, corner = wanted.ring.pieces[0].from;
    if (!wanted.ring.is_near(start, half_ + slack())) return false;
    if (wanted.hole == 0 ? !loop.encloses(corner) : !wanted.ring.encloses(start)) return false;
    if (!std::all_of(loop.pieces.begin(), loop.pieces.end(),
                     [&](const Stroke& piece) { return stays_near(piece, wanted.ring); }))
      return false;
    return is_everywhere(loop, wanted);
  }

  [[nodiscard]] double slack() const { return words_.tolerance_mm + std::max(0.02, 0.1 * half_); }

  /// Places within a distance of a line are a convex set, so that of a line only the ends are looked at.
  /// Other pieces are halved until their length does not matter.
  [[nodiscard]] bool stays_near(const Stroke& piece, const Ring& ring) const {
    ask();
    const double reach = half_ + words_.tolerance_mm + kRounding;
    if (!piece.arc)
      for (const std::uint32_t i : ring.near(piece.from, reach))
        if (!ring.pieces[i].arc && distance(piece.from, ring.pieces[i]) <= reach &&
            distance(piece.to, ring.pieces[i]) <= reach)
          return true;
    const Place middle = at_share(piece, 0.5);
    const double there = ring.distance_of(middle), half_length = length(until(piece, middle));
    if (there + half_length <= half_ + slack()) return true;
    if (!(half_length > 1e-6)) return false;
    return stays_near(until(piece, middle), ring) && stays_near(beginning(piece, middle), ring);
  }

  [[nodiscard]] bool is_everywhere(const Ring& loop, const Wanted& wanted) const {
    // The waste lies to the right of an outline that runs counter-clockwise, to the left of such a hole.
    const bool right = std::signbit(wanted.ring.area()) == (wanted.hole != 0);
    for (const Stroke& piece : wanted.ring.pieces) {
      const double whole = length(piece);
      const int samples = static_cast<int>(std::ceil(whole / kSampling));
      for (int k = 0; k < samples; ++k) {
        ask();
        const Place at = at_share(piece, (k + 0.5) / samples);
        const Place left = left_of(heading(piece, at)), middle = at + (right ? -half_ : half_) * left;
        const bool could_be_there = wanted.ring.distance_of(middle) >= half_ - kRounding;
        if (could_be_there && !(loop.distance_of(middle) <= slack())) return false;
      }
    }
    return true;
  }

  /// A part that a loop encloses would be loose after it. No contour comes near a loop of another, while the
  /// loops of neighbours may share a line.
  void check_order() {
    for (auto first = loops_.begin(); first != loops_.end(); ++first)
      for (auto later = std::next(first); later != loops_.end(); ++later)
        if (first->of != later->of && first->ring.encloses(wanted_[later->of].ring.pieces[0].from)) {
          report_.findings.push_back(fmt::format("line {}: {} is cut after {}, which encloses it",
                                                 later->line, wanted_[later->of].name(),
                                                 wanted_[first->of].name()));
          return;
        }
  }

  /// The rounding of doubles where a program goes, mm.
  static constexpr double kRounding = 1e-7;
  static constexpr double kSampling = 1;  // mm

  double half_;
  const ProfileWords& words_;
  std::vector<Wanted> wanted_;
  std::vector<std::pair<std::uint64_t, Ring>> parts_;
  std::optional<Ring> all_;
  std::optional<EngravedMarks> marks_;
  std::vector<Loop> loops_;
  ClaimReport report_;
};

}  // namespace

Result<ClaimReport> verify_profile(const Document& program, const Document& layout,
                                   const ProfileWords& words) {
  LEKALO_TRY(const WrittenLayout written, read_layout(layout));
  LEKALO_TRY(const std::vector<PlacedSheet> sheets, placed_sheets(written, layout.name, words.sheet));
  if (sheets.size() > 1)
    return failure(
        ErrorCode::usage,
        fmt::format("{}: a program cuts one sheet and {} are in use; say which, for example --sheet {}",
                    program.name, sheets.size(), sheets[0].name));
  LEKALO_TRY(const ProfileProgram read, read_profile(program, words.control));
  ClaimReport report = ProfileCheck(sheets[0], words).checked(read.chains);
  report.unchecked = read.unsaid.sentences();
  return report;
}

}  // namespace lekalo::verify
