#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "profile_around.hpp"
#include "profile_path.hpp"
#include "profile_proof.hpp"

namespace lekalo::nc {

/// A place where a cut may begin.
struct Start {
  std::vector<WrittenEdge> lead;  ///< one edge, of a line up to two; or none: pierced on the contour
  std::size_t edge = 0;           ///< the path begins at the first point of this edge
  WrittenPoint pierce, on_contour;
  /// The cuts whose kerf lead or pierce meet, ascending: they should not be there yet.
  std::vector<std::size_t> met;
  double lead_mm = 0;  ///< the length or radius of the lead
  bool behind_joint = false;
  bool from_end = false;  ///< of a line: it is cut from its end to its beginning
  /// Says of a line how much its lead is not the straight way on beyond it; of starts as good the least is
  /// taken.
  std::size_t bends = 0;
  /// The cuts in whose kerf a line without a lead begins. Where one of them is there nothing is pierced.
  std::vector<std::size_t> in_kerf_of{};

  /// How unwelcome the start is when the cuts are there for which `is_there` says so.
  template <class IsThere>
  [[nodiscard]] std::size_t unwelcome(const IsThere& is_there) const {
    constexpr std::size_t kPiercesAPart = 1000;
    if (!in_kerf_of.empty())
      return std::any_of(in_kerf_of.begin(), in_kerf_of.end(), is_there) ? 1 : kPiercesAPart;
    return static_cast<std::size_t>(std::count_if(met.begin(), met.end(), is_there));
  }
};

/// The starts of one cut.
struct Starts {
  /// All with leads of one length, or none with a lead; of a cut with joints one behind each. Empty where a
  /// pierce of the stated diameter has no room.
  std::vector<Start> choices;
};

/// The ground of a joint: a rectangle over the kerf, from the middle of the kerf, where its
/// two ends stand apart, out into the sheet. No other kerf and no pierce may come into it, or the joint would
/// hold on to nothing.
struct JointGround {
  geom::Point corners[4];
};

/// True when a lead and its pierce stay out of these grounds.
[[nodiscard]] bool keeps_off(const std::vector<JointGround>& grounds, const std::vector<WrittenEdge>& lead,
                             WrittenPoint pierce, const ProfileOptions& options);

/// All that leads and pierces have to keep clear of.
struct Surroundings {
  const KerfProof& proof;
  const KerfsAround& kerfs;
  const std::vector<JointGround>& grounds;
};

/// A lead that ends at `at`, where the path goes on in this unit direction; the waste is on the left.
[[nodiscard]] std::vector<WrittenEdge> lead_to(WrittenPoint at, geom::Point direction, double length,
                                               LeadShape shape, const Resolution& resolution);
/// The lengths of leads that are tried for this one, from the longest.
[[nodiscard]] std::vector<double> lead_lengths(double lead_in_mm, const ProfileOptions& options);

/// Step 5 of docs/design/export.md: the longest leads, of full, half or a quarter of `lead_in_mm`, or the
/// shortest that a pierce needs, that stay out of every part, with their pierces. They come from the waste
/// side, at up to kMostStarts places spread over the path, or at more where none of these has room for a
/// pierce. Leads that meet no other kerf go before longer ones. New edges begin in the middle of long ones,
/// which changes `path`, as a curve, by rounding alone.
/// \param own  the number of the cut
inline constexpr std::size_t kMostStarts = 12;
[[nodiscard]] Starts starts_of(std::vector<WrittenEdge>& path, std::size_t own, double lead_in_mm,
                               const Surroundings& around, const ProfileOptions& options);

/// The starts of the rim of a pocket: as of a contour, or where it passes through the end of a line, in the
/// kerf that is there.
[[nodiscard]] Starts pocket_starts_of(std::vector<WrittenEdge>& path, std::size_t own, double lead_in_mm,
                                      const Surroundings& around, const ProfileOptions& options);

/// The starts of a common line: at either of its ends that may come first, with leads in the scrap beyond it,
/// straight on or aslant, or in the kerf into which it runs.
[[nodiscard]] Starts line_starts_of(const Cut& line, std::size_t own, const Surroundings& around,
                                    const ProfileOptions& options);

}  // namespace lekalo::nc
