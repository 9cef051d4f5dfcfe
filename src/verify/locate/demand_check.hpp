#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cover_tree.hpp"
#include "feature_file.hpp"
#include "verify/shape/shape.hpp"

namespace lekalo::verify {

/// The demands of one feature of a part as a result writes them (docs/formats.md, "demands").
struct WrittenFeature {
  std::string name;
  std::vector<std::size_t> edges;
  Span minimum, scale;
  std::optional<Span> maximum, finished;
  FeatureNumbers numbers;  ///< the same, to be held against the file of features

  /// The allowance that none of its points may exceed, if there is one.
  [[nodiscard]] const std::optional<Span>& most() const { return finished ? finished : maximum; }
};

/// The answer to the second criterion as a result writes it, with the numbers of its certificate.
struct WrittenSecond {
  Decimal margin, found, bound, gap, kept;
  struct Proof {
    Decimal grown_for;
    Span most, shift, bound;
  };
  std::optional<Proof> proof;
};

/// A placement of the trade-off curve.
struct WrittenTradeOff {
  Decimal x, y, theta, theta_deg;
  bool mirrored = false;
  Span clearance, margin, largest;
};

struct WrittenDemands {
  Span minimum;
  std::vector<WrittenFeature> features;
  std::string criterion;
  Decimal minimum_as_written, give_up, margin_as_written, margin_found, margin_gap, margin_bound_as_written,
      largest_as_written;
  Span margin, margin_bound, largest;
  Span grown_for, shift, bound;
  std::optional<WrittenSecond> second;
  std::vector<WrittenTradeOff> curve;
};
[[nodiscard]] WrittenDemands read_demands(Json value, std::string& complaint);

/// Rechecks the claims that a result makes about its demands: at the placement, edge by edge, and about all
/// placements.
class DemandCheck {
 public:
  /// \param off  the true outlines of part and blank together may be this far from those written
  DemandCheck(const WrittenDemands& demands, const Shape& part, const Shape& placed_part, const Shape& blank,
              Span off, std::vector<std::string>& findings);

  /// A margin that is not negative promises that every minimum, with its share of the margin, every maximum
  /// and the largest allowance hold at the placement.
  void check_placement();

  /// A margin below 0 promises that no more is missing: no point within an edge's minimum of it sticks out of
  /// the blank by more, nor is a maximum exceeded by more. Returns false where that is not shown and not
  /// refuted.
  [[nodiscard]] bool check_missing();

  /// The gap that one criterion left to the next one is kept at the placement, as far as the result says so.
  /// \param optimal  whether the result claims that the gaps are closed
  void check_criteria(bool optimal);

  /// True if the placement was chosen by a criterion that is not known, so that check_criteria leaves open
  /// whether it is the one that the criterion looks for.
  [[nodiscard]] bool leaves_choice_open() const;

  /// Returns by how much each side of the part is grown for a margin. A certificate is checked with these
  /// growths and with the caps, `shift` added to each. The certificate of largest allowances has one more
  /// cap, for all sides that are not finished.
  [[nodiscard]] std::vector<double> growth(Span grown_for) const;
  [[nodiscard]] std::vector<CoverTree::Cap> caps(Span shift, const std::optional<Span>& most = {}) const;
  /// Returns a number that the distance of p from the grown part does not exceed.
  [[nodiscard]] double off_grown_part(const Vec& p, Span grown_for) const;
  /// Checks that the `bound` of the certificate makes margin_bound a bound of the margin.
  void check_bound();
  /// Checks that the bound of the second certificate makes its `bound` one of largest allowances. \pre there
  /// is one
  void check_largest_bound();

 private:
  template <class... Args>
  void find(fmt::format_string<Args...> format, Args&&... args) {
    findings_.push_back(fmt::format(format, std::forward<Args>(args)...));
  }
  /// A side of the placed part along which it is finished, and the width that may stick out.
  struct Rim {
    std::size_t side = 0;
    double by = 0;
  };
  [[nodiscard]] std::vector<Rim> rims() const;
  [[nodiscard]] std::vector<std::size_t> sides_of(const WrittenFeature& feature) const;
  [[nodiscard]] bool any_cap() const;
  [[nodiscard]] double least_scale() const;
  [[nodiscard]] std::vector<std::size_t> unfinished_sides() const;
  void check_minima();
  void check_material();
  [[nodiscard]] bool keeps(const Side& side, Span needed) const;
  [[nodiscard]] bool sticks_out_less(const Side& side, double by, double most, std::size_t& looked) const;
  [[nodiscard]] bool grown_sticks_out(std::size_t side, Span by, double more_than) const;
  [[nodiscard]] bool is_depth_kept(const std::vector<std::size_t>& sides, double most, bool& refuted) const;
  void check_depth(const std::vector<std::size_t>& sides, double most, const std::string& whose);
  [[nodiscard]] bool beside_finished(const Side& piece, const std::vector<Rim>& rims,
                                     std::size_t& looked) const;

  const WrittenDemands& d_;
  const Shape& part_;
  const Shape& placed_;
  const Shape& blank_;
  Span off_;
  std::vector<std::string>& findings_;
  std::vector<std::vector<std::size_t>> sides_of_edge_;
  std::vector<const WrittenFeature*> feature_of_edge_;  ///< nullptr where the edge has no feature
};

}  // namespace lekalo::verify
