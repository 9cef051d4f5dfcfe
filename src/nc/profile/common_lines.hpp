#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "common_stretch.hpp"
#include "profile_proof.hpp"

namespace lekalo::nc {

/// A closed path around parts that hang together, or around scrap between them: their runs one after the
/// other, each part on the right.
struct CommonRim {
  std::vector<WrittenEdge> path;
  std::vector<std::size_t> parts;  ///< one for each run, in the order of the path
  std::vector<std::size_t> held;   ///< those that hang on by it, until it is cut
  double area = 0;                 ///< negative for a rim that runs clockwise, around its parts
  /// The kerfs of the lines that end there have freed all of it already, and the lines go over it.
  bool is_covered = false;
};

/// A straight cut that goes through one or more common stretches.
struct CommonLine {
  /// The edges of one stretch, with the way to the next behind them.
  struct Link {
    std::vector<WrittenEdge> path;
    std::array<std::size_t, 2> parts{};
    bool holds = true;  ///< parts hang on by it, until it is cut
  };
  std::vector<Link> links;
  /// The lines, by number, into whose kerfs its beginning and its end run.
  std::array<std::vector<std::size_t>, 2> runs_into;

  [[nodiscard]] std::vector<WrittenEdge> path() const;
  void reverse();
};

/// A stretch shorter than so many kerfs holds nothing: the kerfs at its two ends nearly meet, or the lead of
/// a line takes what is between them.
inline constexpr double kHoldingKerfs = 2.5;

struct CommonDrawing {
  std::vector<CommonRim> rims;
  std::vector<CommonLine> lines;
};

/// Steps 2 and 3 of docs/design/common-line.md: what is cut of outlines that have common stretches.
[[nodiscard]] CommonDrawing common_drawing(const std::vector<Cut>& cuts, const CommonStretches& common,
                                           const KerfProof& proof, const ProfileOptions& options);

}  // namespace lekalo::nc
