#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cover_bound.hpp"
#include "verify/shape/shape.hpp"

namespace lekalo::verify {

/// The certificate of a localisation of regions: a subdivision of a box of poses whose leaves name pairs of
/// balls: a part ball (centre a, radius r) in the part's material, a blank ball (centre c, radius s) in whose
/// inside the blank has no material. For any pose T let D = |T a - c| and d = D - r - s. Then the clearance
/// is at most max(d, -s):
///   D >= r: the point of the part's ball nearest to c is D - r from it, so at most d from what is not
///           material, or -d deep inside the blank ball;
///   D < r:  c itself is a point of the part, and lies s deep in the blank ball.
/// A sum of such d with multipliers m >= 0, sum m = 1, is at least the least of them; hence the clearance of
/// every pose of a leaf is at most max(sum m d, -s of its balls). A centre that lies e beside the material
/// (or beside what is not material) has radius -e: all of this still holds, because a signed distance changes
/// by no more than its point moves.
///
/// With demands (demand_check.hpp) "the part" is the part grown by `growth`, and what is bounded is the least
/// of its clearance and what each cap has left. A cap's term is a point a at most e off the cap's sides and a
/// ball (c, s) in the blank's material: a lies at least s - D deep, so the cap has at most most + e + D - s
/// left.
class CoverTree {
 public:
  /// No point of these sides may lie more than `most` mm inside the blank.
  struct Cap {
    std::vector<std::size_t> sides;
    double most = 0;
  };
  struct Problem {
    /// The part as it is written.
    const Shape& part;
    const Shape& blank;
    Vec pivot;
    /// The pivot is at most this far from the part's material.
    double pivot_off;
    /// The bound that is to be proved, mm.
    double bound;
    Decimal window_from_deg, window_to_deg;
    /// The shifts that are locked; the pivot is then the part's origin.
    std::optional<Decimal> locked_x, locked_y;
    /// Each side of the part is grown by this much or, if it is negative, loses a rim of this width along it.
    /// An empty list grows nothing.
    std::vector<double> growth = {};
    std::vector<Cap> caps = {};
  };
  CoverTree(const Problem& problem, std::vector<std::string>& findings);

  /// Checks one tree; complaints about its form go to `complaint`, what it fails to prove to the findings.
  void check(Json tree, const std::string& path, std::string& complaint);

  [[nodiscard]] std::size_t leaves() const { return leaves_; }

 private:
  using Cell = PoseCell;
  using Term = BallTerm;

  void check_root(const Cell& root, const std::string& path);
  bool read_leaf(Json contacts, std::vector<Term>& terms, std::string& complaint, const std::string& path);
  double part_radius(Json x, Json y, Json radius, const Vec& centre, double written);
  [[nodiscard]] double grown_radius(const Vec& centre, double written) const;
  [[nodiscard]] double off_cap(const Vec& point, const Cap& cap) const;
  double material_radius(Json x, Json y, Json radius, const Vec& centre, double written);
  double blank_radius(Json x, Json y, Json radius, const Vec& centre, double written);
  [[nodiscard]] bool proved(const Cell& cell, const std::vector<Term>& terms, int depth);

  const Problem& problem_;
  std::vector<std::string>& findings_;
  /// The growths that the sides are taken to have, `joined_` more than theirs. Cracks narrower than twice
  /// that are closed so, as those are that a growth leaves just closed, where rounding could prove nothing.
  /// Every point is then within `joined_` of the grown part, and blank balls count as smaller by that.
  std::vector<double> growth_;
  double joined_ = 0;
  bool mirrored_ = false;
  std::size_t leaves_ = 0, failed_ = 0, cells_ = 0;
  /// The radii found so far, by the text of the ball.
  std::map<std::string, double, std::less<>> part_radii_, blank_radii_, material_radii_;
};

}  // namespace lekalo::verify
