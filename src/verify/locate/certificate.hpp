#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "edge_lines.hpp"
#include "edge_triple.hpp"
#include "outline.hpp"
#include "verify/number/exact.hpp"
#include "verify/number/interval.hpp"
#include "verify/number/span.hpp"

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

/// A written multiplier may differ from the one computed anew by this much, and by what a roundoff of the
/// blank's coordinates makes of it where the three edges are nearly parallel. It is for reading; nothing is
/// proved by it.
inline constexpr double kMultiplierTolerance = 1e-6;

/// Checks a certificate interval by interval, in order, and keeps the largest bound. With a balanced triple
/// of edges the shift of the part cancels, and what remains of its distances is K + A cos + B sin with exact
/// integers K, A, B over one irrational divisor.
///
/// An interval's bound is enclosed in doubles first, then with 128 bits, and only if it may still raise the
/// largest so far with all the bits there are. 2 us an interval where bounds differ, 25 us where they agree
/// to 12 digits.
class CertificateCheck {
 public:
  CertificateCheck(const Outline& part, EdgeLines& edges, Precision precision,
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
    EdgeTriple triple;
    Integer constant, cosine, sine;  ///< K, A, B
  };
  struct FlatTurn {
    std::string angle;
    Span cosine, sine;
    double nearest = 0;
  };

  void say(const std::string& sentence);
  void check_order(const WrittenInterval& interval);
  [[nodiscard]] std::optional<Sinusoid> sinusoid(const WrittenInterval& interval);
  [[nodiscard]] bool check_triple(const WrittenInterval& interval, const EdgeTriple& triple);
  /// At or above the bound over the interval, in units of 2^flat_scale(); infinite when doubles cannot tell.
  [[nodiscard]] double flat_bound(const WrittenInterval& interval, const Sinusoid& s);
  [[nodiscard]] const FlatTurn& flat_turn(std::string_view angle);
  [[nodiscard]] bool may_raise_bound(const WrittenInterval& interval, const Sinusoid& s);
  [[nodiscard]] Interval bound_over(const WrittenInterval& interval, const Sinusoid& s, Precision precision);
  [[nodiscard]] Turn turn_at(std::string_view angle, Precision precision);

  const Outline& part_;
  EdgeLines& edges_;
  Precision precision_;
  std::vector<std::string>& findings_;
  std::size_t count_ = 0, worst_ = 0, complaints_ = 0;
  std::optional<Interval> bound_;
  double flat_bound_ = 0;                       ///< at or below bound_, in units of 2^flat_scale()
  Interval roundoff_;                           ///< of a coordinate of the blank, rough
  std::string first_from_, last_from_, reach_;  ///< texts; reach_ is the largest `to` so far
  // An interval's `to` is nearly always the next one's `from`.
  std::array<FlatTurn, 2> flat_turns_;
  std::string last_angle_;
  std::optional<Turn> last_turn_;
};

}  // namespace lekalo::verify
