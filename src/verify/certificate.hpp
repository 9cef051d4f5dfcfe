#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "edge_lines.hpp"
#include "exact.hpp"
#include "interval.hpp"
#include "outline.hpp"
#include "span.hpp"

namespace lekalo::verify {

/// Part vertex against blank edge, as written: file order, nothing trusted.
struct WrittenContact {
  std::size_t part_vertex = 0, blank_edge = 0;
  double multiplier = 0;  ///< the nearest double
};

struct WrittenInterval {
  std::string_view from, to;  ///< radians; texts that parse_decimal accepts
  std::array<WrittenContact, 3> contacts;
};

/// The angles that a certificate must cover.
struct Window {
  Decimal from_deg, to_deg;
  [[nodiscard]] bool full_circle() const { return compare(to_deg - from_deg, Decimal{36, 1}) >= 0; }
};

/// A written multiplier may differ from the one computed anew by this much; it is for reading only.
inline constexpr double kMultiplierTolerance = 1e-6;

/// Checks a certificate interval by interval, in order, and keeps the largest bound. For three edges e1, e2,
/// e3 the numbers e2 x e3, e3 x e1, e1 x e2 make the sum of (number x edge) zero; when they agree in sign
/// they weigh the three distances so that the shift of the part cancels, and what remains is K + A cos + B
/// sin with exact integers K, A, B over one irrational divisor.
///
/// An interval's bound is enclosed in doubles first; only one that may raise the largest so far is computed
/// with MPFR. About 4 us an interval.
class CertificateCheck {
 public:
  CertificateCheck(const Outline& part, EdgeLines& edges, mpfr_prec_t precision,
                   std::vector<std::string>& findings);

  void add(const WrittenInterval& interval);
  /// After the last interval: is the window covered?
  void finish(const Window& window);

  [[nodiscard]] std::size_t intervals() const { return count_; }
  /// Encloses the largest bound, integer units; nothing when no interval could be used.
  [[nodiscard]] const std::optional<Interval>& bound() const { return bound_; }
  /// The interval it comes from.
  [[nodiscard]] std::size_t worst() const { return worst_; }

 private:
  struct Sinusoid {
    Integer constant, cosine, sine;  ///< K, A, B
    std::array<Integer, 3> weights;  ///< not negative, not all zero
    std::array<const EdgeLine*, 3> edges{};
  };
  struct FlatTurn {
    std::string angle;
    Span cosine, sine;
    double nearest = 0;
  };

  void say(const std::string& sentence);
  void check_order(const WrittenInterval& interval);
  [[nodiscard]] std::optional<Sinusoid> sinusoid(const WrittenInterval& interval);
  [[nodiscard]] static bool weigh(Sinusoid& s);
  [[nodiscard]] bool balance(const WrittenInterval& interval, Sinusoid& s);
  void check_multipliers(const WrittenInterval& interval, const Sinusoid& s);
  /// At or above the bound over the interval; infinite when doubles cannot tell.
  [[nodiscard]] double flat_bound(const WrittenInterval& interval, const Sinusoid& s);
  [[nodiscard]] const FlatTurn& flat_turn(std::string_view angle);
  [[nodiscard]] Interval exact_bound(const WrittenInterval& interval, const Sinusoid& s) const;

  const Outline& part_;
  EdgeLines& edges_;
  mpfr_prec_t precision_;
  std::vector<std::string>& findings_;
  std::size_t count_ = 0, worst_ = 0, complaints_ = 0;
  std::optional<Interval> bound_;
  std::string first_from_, last_from_, reach_;  ///< texts; reach_ is the largest `to` so far
  std::array<FlatTurn, 2> flat_turns_;          ///< an interval's `to` is nearly always the next one's `from`
};

}  // namespace lekalo::verify
