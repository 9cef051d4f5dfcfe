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

/// A contact of a part vertex with a blank edge as it is written, by file order; nothing in it is trusted.
struct WrittenContact {
  std::size_t part_vertex = 0, blank_edge = 0;
  /// The double nearest to the written number.
  double multiplier = 0;
};

struct WrittenInterval {
  std::string_view from, to;  ///< radians, as texts that parse_decimal accepts
  std::array<WrittenContact, 3> contacts;
};

/// The window of angles that a certificate must cover.
struct Window {
  Decimal from_deg, to_deg;
  [[nodiscard]] bool full_circle() const { return compare(to_deg - from_deg, Decimal{36, 1}) >= 0; }
};

/// A written multiplier may differ from the one computed anew by this much. Where the three edges are nearly
/// parallel it may also differ by what a roundoff of the blank's coordinates does to it. Multipliers are
/// there to be read, and nothing is proved by them.
inline constexpr double kMultiplierTolerance = 1e-6;

/// Steps 5 and 6 of docs/design/verify.md: checks a certificate interval by interval, in order, and keeps the
/// largest bound. With a balanced triple of edges the shift of the part cancels, and what remains of its
/// distances is K + A cos + B sin with exact integers K, A, B over one irrational divisor.
///
/// The bound of an interval is enclosed in doubles first, then with 128 bits. All the bits there are are used
/// only if it may still raise the largest bound so far. An interval takes 2 us where bounds differ, 25 us
/// where they agree to 12 digits.
class CertificateCheck {
 public:
  CertificateCheck(const Outline& part, EdgeLines& edges, Precision precision,
                   std::vector<std::string>& findings);

  void add(const WrittenInterval& interval);
  /// Says after the last interval whether the window is covered.
  void finish(const Window& window);

  [[nodiscard]] std::size_t intervals() const { return count_; }
  /// Encloses the largest bound in integer units. There is none when no interval could be used.
  [[nodiscard]] const std::optional<Interval>& bound() const { return bound_; }
  /// Returns the index of the interval that the largest bound comes from.
  [[nodiscard]] std::size_t worst() const { return worst_; }

 private:
  struct Sinusoid {
    EdgeTriple triple;
    Integer constant, cosine, sine;  ///< K, A, B
  };
  /// A turn in doubles, at first that by 0.
  struct FlatTurn {
    std::string angle = "0";
    Span cosine{1, 1}, sine;
    double nearest = 0;
  };

  void say(const std::string& sentence);
  void check_order(const WrittenInterval& interval);
  [[nodiscard]] std::optional<Sinusoid> sinusoid(const WrittenInterval& interval);
  [[nodiscard]] bool check_triple(const WrittenInterval& interval, const EdgeTriple& triple);
  /// Returns a number at or above the bound over the interval, in units of 2^flat_scale(), or infinity when
  /// doubles cannot tell.
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
  /// A number at or below bound_, in units of 2^flat_scale().
  double flat_bound_ = -kInfinity;
  /// A rough roundoff of a coordinate of the blank.
  Interval roundoff_;
  /// The ends of intervals as texts. `reach_` is the largest `to` so far.
  std::string first_from_, last_from_, reach_;
  // The `to` of one interval is nearly always the `from` of the next, so the last two turns are kept.
  std::array<FlatTurn, 2> flat_turns_;
  std::string last_angle_;
  std::optional<Turn> last_turn_;
};

}  // namespace lekalo::verify
