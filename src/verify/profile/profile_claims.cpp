#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "common_line_check.hpp"
#include "contour_ring.hpp"
#include "engraved_marks.hpp"
#include "joint_check.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/verify/claims.hpp"
#include "loose_check.hpp"
#include "profile_moves.hpp"
#include "verify/drawn/placed_sheet.hpp"
#include "verify/layout/layout_document.hpp"
#include "verify/number/span.hpp"
#include "verify/pocket/stroke_index.hpp"

namespace lekalo::verify {
namespace {

/// A contour of a placed part that is to be cut.
struct Wanted {
  std::uint64_t part = 0;
  std::size_t hole = 0;  ///< 0 for the outer contour, else the number of the hole
  ContourRing ring;
  bool cut = false;
  [[nodiscard]] std::string name() const {
    return hole == 0 ? fmt::format("the outline of placement {}", part)
                     : fmt::format("hole {} of placement {}", hole, part);
  }
};

/// The closed part of a chain and the lead before it.
struct Loop {
  ContourRing ring;
  std::size_t of = 0;  ///< the contour that it follows
};

constexpr std::size_t kFollowsNothing = static_cast<std::size_t>(-1);

/// A cut, and what it follows.
struct Followed {
  std::size_t line = 0;
  std::size_t of = kFollowsNothing;   ///< the contour
  bool through = false;               ///< down to the bottom
  bool closed = false;                ///< all round, and not a stretch between joints
  std::optional<std::size_t> loop{};  ///< its place among the loops, where it is one that cuts through
};

class ProfileCheck {
 public:
  ProfileCheck(const PlacedSheet& sheet, const ProfileWords& words)
      : half_(0.5 * words.kerf_mm), words_(words) {
    std::vector<Strokes> all;
    for (const PlacedSheet::Part& part : sheet.parts) {
      for (std::size_t i = 0; i < part.contours.size(); ++i) {
        wanted_.push_back({part.id, i, ContourRing({part.contours[i]}, 0.1 * half_), false});
        all.push_back(part.contours[i]);
      }
      parts_.emplace_back(part.id, ContourRing(part.contours, 0.1 * half_));
    }
    marks_.emplace(sheet);
    all_.emplace(all, 0.1 * half_);
  }

  ClaimReport checked(const std::vector<CutChain>& chains) {
    for (const CutChain& chain : chains) deepest_ = std::max(deepest_, chain.depth);
    stretches_.resize(wanted_.size());
    std::vector<CutChain> cuts;
    for (const CutChain& chain : chains) {
      if (!chain.rapid && marks_->follows(chain)) {
        check_engraving(chain);
        continue;
      }
      cuts.push_back(chain);
      is_any_cut_ = is_any_cut_ || is_through(chain);
      if (chain.tool != cuts[0].tool)
        report_.findings.push_back(fmt::format("line {}: tool {} cuts, and line {} cuts with tool {}",
                                               chain.line, chain.tool, cuts[0].line, cuts[0].tool));
      if (chain.rapid) report_.findings.push_back(fmt::format("line {}: a rapid motion cuts", chain.line));
      keep_out(chain);
      if (!words_.common_line) followed_.push_back(follow(chain));
    }
    if (words_.common_line) {
      check_common_lines(cuts);
    } else {
      check_joints(cuts);
      for (const Wanted& wanted : wanted_)
        if (!wanted.cut) report_.findings.push_back(wanted.name() + " is not cut");
      if (check_order()) check_loose(cuts);
      check_pierces(cuts);
    }
    report_.notes.push_back(
        fmt::format("{} cuts along {} contours of {} parts were rechecked for a kerf of {} mm", cuts.size(),
                    wanted_.size(), parts_.size(), words_.kerf_mm));
    if (by_power_)
      report_.notes.push_back("how deep the beam engraves follows from its power, which was not rechecked");
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

  /// A part that was cut out may have moved, so that its marks come before. What is as deep as the cuts is
  /// one.
  void check_engraving(const CutChain& chain) {
    if (chain.depth > 0 && chain.depth >= deepest_ - kRounding)
      report_.findings.push_back(
          fmt::format("line {}: a mark is engraved as deep as parts are cut out", chain.line));
    by_power_ = chain.depth == 0;
    if (words_.common_line && is_any_cut_)
      report_.findings.push_back(fmt::format("line {}: a mark is engraved after parts were cut", chain.line));
    for (const Loop& loop : loops_)
      if (loop.ring.encloses(chain.edges[0].from)) {
        report_.findings.push_back(
            fmt::format("line {}: a mark is engraved after {} was cut", chain.line, wanted_[loop.of].name()));
        return;
      }
  }

  /// The contour that the closed part of a chain follows, or its stretch between joints.
  Followed follow(const CutChain& chain) {
    Followed followed{chain.line, kFollowsNothing, is_through(chain), false};
    const Place end = chain.edges.back().to;
    const auto first = std::find_if(chain.edges.begin(), chain.edges.end(),
                                    [&](const Stroke& s) { return s.from.x == end.x && s.from.y == end.y; });
    if (first == chain.edges.end()) {
      followed.of = follow_stretch(chain);
      return followed;
    }
    followed.closed = true;
    Loop loop{ContourRing({Strokes(first, chain.edges.end())}, 0.1 * half_), 0};
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
      if (!follows(loop.ring, wanted_[i])) continue;
      followed.of = i;
      if (!followed.through) return followed;
      wanted_[i].cut = true;
      loop.of = i;
      followed.loop = loops_.size();
      loops_.push_back(std::move(loop));
      return followed;
    }
    report_.findings.push_back(fmt::format("line {}: the cut follows no contour of a part", chain.line));
    return followed;
  }

  /// A pass that does not reach the bottom cuts nothing out: others come after it, or it leaves joints as
  /// tabs.
  [[nodiscard]] bool is_through(const CutChain& chain) const { return chain.depth >= deepest_ - kRounding; }

  /// The contour beside which a chain goes from its first edge on, or from its second, after a lead.
  std::size_t follow_stretch(const CutChain& chain) {
    if (words_.joint_width_mm == 0) {
      report_.findings.push_back(fmt::format("line {}: the cut is not closed", chain.line));
      return kFollowsNothing;
    }
    for (std::size_t begin = 0; begin < std::min<std::size_t>(2, chain.edges.size()); ++begin) {
      Strokes edges(chain.edges.begin() + static_cast<std::ptrdiff_t>(begin), chain.edges.end()), pieces;
      for (const Stroke& edge : edges) add_pieces(edge, kInfinity, pieces);
      for (std::size_t i = 0; i < wanted_.size(); ++i) {
        const ContourRing& ring = wanted_[i].ring;
        if (!ring.is_near(edges[0].from, half_ + slack()) ||
            ring.encloses(edges[0].from) != (wanted_[i].hole != 0) ||
            !std::all_of(pieces.begin(), pieces.end(),
                         [&](const Stroke& piece) { return stays_near(piece, ring); }))
          continue;
        if (is_through(chain)) stretches_[i].push_back({chain.line, std::move(edges)});
        return i;
      }
    }
    report_.findings.push_back(fmt::format("line {}: the cut follows no contour of a part", chain.line));
    return kFollowsNothing;
  }

  /// Contours that are cut in stretches have joints between them, and nothing else enters these.
  void check_joints(const std::vector<CutChain>& chains) {
    std::vector<FoundJoint> joints;
    std::size_t held = 0;
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
      if (wanted_[i].cut || stretches_[i].empty()) continue;
      FoundJoints found = joints_of_contour(stretches_[i], wanted_[i].ring, wanted_[i].hole != 0,
                                            wanted_[i].name(), words_, slack());
      wanted_[i].cut = true;
      ++held;
      report_.findings.insert(report_.findings.end(), found.findings.begin(), found.findings.end());
      joints.insert(joints.end(), found.joints.begin(), found.joints.end());
    }
    if (words_.joint_width_mm == 0) return;
    for (const CutChain& chain : chains) {
      if (!is_through(chain)) continue;
      const Place pierce = chain.edges[0].from;
      Strokes pieces;
      for (const Stroke& edge : chain.edges) add_pieces(edge, kInfinity, pieces);
      for (const FoundJoint& joint : joints) {
        ask();
        const bool kerf_leaves = std::all_of(pieces.begin(), pieces.end(), [&](const Stroke& piece) {
          return leaves_joint(piece, half_, joint);
        });
        if (kerf_leaves && leaves_joint(line_between(pierce, pierce),
                                        std::max(half_, 0.5 * words_.pierce_diameter_mm), joint))
          continue;
        report_.findings.push_back(
            fmt::format("line {}: what is burnt enters the joint behind line {}", chain.line, joint.line));
        break;
      }
    }
    report_.notes.push_back(
        fmt::format("joints of {} mm that were rechecked: {}, contours with joints: {}; whether parts would "
                    "tip without them, "
                    "or need more, was not",
                    words_.joint_width_mm, joints.size(), held));
  }

  /// Cuts that parts share follow no contour all round.
  void check_common_lines(const std::vector<CutChain>& chains) {
    std::vector<const CutChain*> through;
    std::vector<ShallowCut> shallow;
    for (const CutChain& chain : chains)
      if (is_through(chain))
        through.push_back(&chain);
      else
        shallow.push_back({&chain, through.size()});
    if (through.empty()) {
      report_.findings.push_back("nothing is cut");
      return;
    }
    std::vector<CommonContour> contours;
    for (const Wanted& wanted : wanted_)
      contours.push_back({wanted.part, wanted.hole != 0, wanted.name(), &wanted.ring});
    CommonLineCheck(through, shallow, contours, words_).judge(report_);
  }

  /// The disc of a pierce lies clear of every part, and it and the lead are clear of the kerfs before.
  void check_pierces(const std::vector<CutChain>& chains) {
    if (words_.pierce_diameter_mm == 0) return;
    const double radius = 0.5 * words_.pierce_diameter_mm;
    StrokeExtent extent;
    for (const CutChain& chain : chains) extent.add(chain.edges);
    StrokeIndex index(extent.low, extent.high, 1 + length(extent.high - extent.low) / 300);
    Strokes there;
    std::vector<std::size_t> cut_of_piece;
    std::vector<std::uint32_t> near;
    for (std::size_t c = 0; c < chains.size(); ++c) {
      const CutChain& chain = chains[c];
      const Place pierce = chain.edges[0].from;
      if (!(all_->distance_of(pierce) >= radius - words_.tolerance_mm - kRounding))
        report_.findings.push_back(
            fmt::format("line {}: the pierce of {} mm enters a part", chain.line, words_.pierce_diameter_mm));
      Strokes led;
      const Followed& own = followed_[c];
      if (own.of != kFollowsNothing && !is_beside(pierce, wanted_[own.of].ring))
        add_pieces(chain.edges[0], kInfinity, led);
      bool meets = false;
      const auto look = [&](const Stroke& piece, double reach) {
        ask();
        near.clear();
        index.near(at_share(piece, 0.5), 0.5 * length(piece) + reach, near);
        for (const std::uint32_t i : near) {
          // Stretches of one contour begin beside each other: their joints are looked at instead.
          const Followed& before = followed_[cut_of_piece[i]];
          if (before.of == own.of && !before.closed && !own.closed) continue;
          std::vector<Place> crossings;
          add_crossings(piece, there[i], crossings);
          meets = meets || !crossings.empty() || !(distance_apart(piece, there[i]) >= reach - kRounding);
        }
      };
      look(line_between(pierce, pierce), radius + half_);
      for (const Stroke& piece : led) look(piece, 2 * half_);
      if (meets)
        report_.findings.push_back(
            fmt::format("line {}: the pierce or its lead meets a kerf that is there before it", chain.line));
      Strokes pieces;
      for (const Stroke& edge : chain.edges) add_pieces(edge, kInfinity, pieces);
      for (const Stroke& piece : pieces) {
        index.add(static_cast<std::uint32_t>(there.size()), piece);
        there.push_back(piece);
        cut_of_piece.push_back(c);
      }
    }
    report_.notes.push_back(
        fmt::format("{} pierces of {} mm were rechecked", chains.size(), words_.pierce_diameter_mm));
  }

  [[nodiscard]] bool is_beside(Place p, const ContourRing& ring) const {
    return ring.distance_of(p) <= half_ + slack();
  }

  /// Looks for parts that several kerfs surround together: they are as loose as those that one does. Passes
  /// that do not reach the bottom free nothing, and are cut in what is loose no more than others are.
  void check_loose(const std::vector<CutChain>& chains) {
    LooseCheck loose(2 * half_);
    std::vector<std::size_t> through_before;
    std::size_t through = 0;
    for (std::size_t c = 0; c < chains.size(); ++c) {
      through_before.push_back(through);
      if (!followed_[c].through) continue;
      loose.add(chains[c].edges, followed_[c].of);
      ++through;
    }
    if (!loose.kerfs_meet()) return;
    for (std::size_t c = 0; c < followed_.size(); ++c) {
      const Followed& cut = followed_[c];
      if (cut.of == kFollowsNothing) continue;
      if (loose.steps() > kMostLooseSteps) {
        report_.unchecked.push_back(
            "order: the cuts are too many to look for parts that several kerfs free together");
        return;
      }
      if (!loose.is_loose(wanted_[cut.of].ring.pieces[0].from, through_before[c], cut.of)) continue;
      report_.findings.push_back(fmt::format("line {}: {} is cut when the kerfs before it have made it loose",
                                             cut.line, wanted_[cut.of].name()));
      return;
    }
  }

  /// All of the loop lies within half a kerf of the contour, it runs on its waste side, and it is there
  /// wherever the middle of the kerf could be half a kerf from the contour.
  [[nodiscard]] bool follows(const ContourRing& loop, const Wanted& wanted) const {
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
  [[nodiscard]] bool stays_near(const Stroke& piece, const ContourRing& ring) const {
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

  [[nodiscard]] bool is_everywhere(const ContourRing& loop, const Wanted& wanted) const {
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

  /// A part that a loop encloses would be loose after it, so that nothing is cut there any more, be it a pass
  /// that does not reach the bottom. No contour comes near a loop of another, while the loops of neighbours
  /// may share a line. Returns false after a finding.
  bool check_order() {
    std::size_t before = 0;
    for (const Followed& cut : followed_) {
      for (std::size_t i = 0; cut.of != kFollowsNothing && i < before; ++i) {
        const Loop& first = loops_[i];
        if (first.of == cut.of || !first.ring.encloses(wanted_[cut.of].ring.pieces[0].from)) continue;
        report_.findings.push_back(fmt::format("line {}: {} is cut after {}, which encloses it", cut.line,
                                               wanted_[cut.of].name(), wanted_[first.of].name()));
        return false;
      }
      if (cut.loop) before = *cut.loop + 1;
    }
    return true;
  }

  /// The rounding of doubles where a program goes, mm.
  static constexpr double kRounding = 1e-7;
  static constexpr double kSampling = 1;  // mm
  static constexpr std::size_t kMostLooseSteps = 2'000'000'000;

  double half_;
  const ProfileWords& words_;
  std::vector<Wanted> wanted_;
  std::vector<std::pair<std::uint64_t, ContourRing>> parts_;
  std::optional<ContourRing> all_;
  std::optional<EngravedMarks> marks_;
  std::vector<Loop> loops_;
  double deepest_ = 0;
  bool is_any_cut_ = false;
  bool by_power_ = false;                               ///< marks are engraved without a Z
  std::vector<Followed> followed_;                      ///< by cut
  std::vector<std::vector<ContourStretch>> stretches_;  ///< by contour
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
  const std::vector<std::string>& unsaid = read.unsaid.sentences();
  report.unchecked.insert(report.unchecked.end(), unsaid.begin(), unsaid.end());
  return report;
}

}  // namespace lekalo::verify
