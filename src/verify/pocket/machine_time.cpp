#include "machine_time.hpp"

#include <algorithm>

#include "lekalo/base/stop.hpp"
#include "verify/number/span.hpp"

namespace lekalo::verify {
namespace {

constexpr double kJunctionDeviation = 0.01;  // mm
/// Curvature is averaged over this much path.
constexpr double kWindow = 0.5;  // mm
/// Less of a turn is none, and as fast as any.
constexpr double kStraight = 1e-300;
/// Arcs are cut into pieces of at most this length, or a 32nd of the radius if that is longer.
constexpr double kLongest = 0.25;  // mm

using Direction = MachineClock::Direction;
using Piece = MachineClock::Piece;

double dot(Direction a, Direction b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

double turn_between(Direction a, Direction b) {
  const Direction c{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  return std::abs(angle_between({1, 0}, {dot(a, b), std::sqrt(dot(c, c))}));
}

/// \param first_piece  becomes the number of the first piece of each move
std::vector<Piece> pieces_of(const std::vector<Move>& moves, const SimulateOptions& o,
                             std::vector<std::size_t>& first_piece) {
  std::vector<Piece> pieces;
  for (const Move& move : moves) {
    ask();
    first_piece.push_back(pieces.size());
    const double feed = (move.rapid ? o.rapid_feed : move.feed) / 60;
    const double rise = move.to_z - move.from_z;
    std::vector<Stroke> strokes;
    if (move.arc) {
      const double radius = verify::length(move.from - move.centre);
      const double longest = std::max(kLongest, radius / 32);
      for (int turn = 1; turn < move.turns; ++turn)
        add_arc(move.from, move.from, move.centre, move.ccw, longest, strokes);
      add_arc(move.from, move.to, move.centre, move.ccw, longest, strokes);
    } else {
      strokes.push_back({false, true, move.from, move.to, {}, 0});
    }
    double flat = 0;
    for (const Stroke& s : strokes) flat += verify::length(s);
    const double whole = std::sqrt(flat * flat + rise * rise);
    if (!(whole > 0)) continue;
    for (const Stroke& s : strokes) {
      const double share = flat > 0 ? verify::length(s) / flat : 1;
      if (!(share > 0)) continue;
      const Place in = flat > 0 ? heading(s, s.from) : Place{}, out = flat > 0 ? heading(s, s.to) : Place{};
      const double level = flat / whole, up = rise / whole;
      // Across the axis of a helix of slope up / level the acceleration is (v level)^2 / radius.
      const double limit = s.arc ? o.acceleration * s.radius / (level * level) : kInfinity;
      pieces.push_back(
          {share * whole, feed, {level * in.x, level * in.y, up}, {level * out.x, level * out.y, up}, limit});
    }
  }
  return pieces;
}

/// The angle by which the path has turned up to a length of path.
class Turned {
 public:
  explicit Turned(const std::vector<Piece>& pieces) {
    double s = 0, turn = 0;
    Direction before = pieces.front().first;
    for (const Piece& piece : pieces) {
      turn += turn_between(before, piece.first);
      at_.push_back(s), before_.push_back(turn);
      s += piece.length, turn += turn_between(piece.first, piece.last);
      at_.push_back(s), before_.push_back(turn);
      before = piece.last;
    }
  }
  [[nodiscard]] double operator()(double s) const {
    if (s <= at_.front()) return 0;
    if (s >= at_.back()) return before_.back();
    const auto k = static_cast<std::size_t>(std::upper_bound(at_.begin(), at_.end(), s) - at_.begin());
    return before_[k - 1] + (s - at_[k - 1]) / (at_[k] - at_[k - 1]) * (before_[k] - before_[k - 1]);
  }

 private:
  std::vector<double> at_, before_;
};

}  // namespace

/// Step 11 of docs/design/simulate.md.
MachineClock::MachineClock(const std::vector<Move>& moves, const SimulateOptions& o)
    : acceleration_(o.acceleration), pieces_(pieces_of(moves, o, first_piece_)) {
  first_piece_.push_back(pieces_.size());
  if (pieces_.empty()) return;
  const Turned turned(pieces_);
  const double a = acceleration_;
  square_.assign(pieces_.size() + 1, 0.0);
  double s = 0;
  for (std::size_t i = 1; i < pieces_.size(); ++i) {
    s += pieces_[i - 1].length;
    const double cosine = dot(pieces_[i - 1].last, pieces_[i].first);
    // The sine of half the angle between the two directions at the corner.
    const double half = std::sqrt(std::max(0.0, 0.5 * (1 + cosine)));
    const double bend = turned(s + kWindow / 2) - turned(s - kWindow / 2);
    const double radius = std::min(kJunctionDeviation * half / std::max(1 - half, kStraight),
                                   kWindow / std::max(bend, kStraight));
    const double slower = std::min(pieces_[i - 1].feed, pieces_[i].feed);
    square_[i] =
        std::min({slower * slower, a * radius, pieces_[i - 1].square_limit, pieces_[i].square_limit});
  }
  for (std::size_t i = 1; i < square_.size(); ++i)
    square_[i] = std::min(square_[i], square_[i - 1] + 2 * a * pieces_[i - 1].length);
  for (std::size_t i = square_.size() - 1; i-- > 0;)
    square_[i] = std::min(square_[i], square_[i + 1] + 2 * a * pieces_[i].length);
  for (std::size_t i = 0; i < pieces_.size(); ++i) begins_.push_back(begins_.back() + seconds_of(i));
}

double MachineClock::top_square(std::size_t i) const {
  const Piece& p = pieces_[i];
  return std::min(
      {p.feed * p.feed, p.square_limit, 0.5 * (square_[i] + square_[i + 1] + 2 * acceleration_ * p.length)});
}

double MachineClock::seconds_of(std::size_t i) const {
  const Piece& p = pieces_[i];
  const double top = top_square(i), v = std::sqrt(top), a = acceleration_;
  const double ramps = (2 * top - square_[i] - square_[i + 1]) / (2 * a);
  return (2 * v - std::sqrt(square_[i]) - std::sqrt(square_[i + 1])) / a +
         std::max(0.0, p.length - ramps) / v;
}

double MachineClock::seconds_at(std::size_t move, double share) const {
  const std::size_t first = first_piece_[move], end = first_piece_[move + 1];
  if (first == end) return begins_[first];
  double whole = 0;
  for (std::size_t i = first; i < end; ++i) whole += pieces_[i].length;
  double way = share * whole;
  std::size_t i = first;
  for (; i + 1 < end && way > pieces_[i].length; ++i) way -= pieces_[i].length;
  const double length = pieces_[i].length, a = acceleration_, all = seconds_of(i);
  way = std::clamp(way, 0.0, length);
  const double top = top_square(i), v = std::sqrt(top);
  const double up = (top - square_[i]) / (2 * a), down = (top - square_[i + 1]) / (2 * a);
  double seconds = 0;
  if (way < up)
    seconds = (std::sqrt(square_[i] + 2 * a * way) - std::sqrt(square_[i])) / a;
  else if (way > length - down)
    seconds = all - (std::sqrt(square_[i + 1] + 2 * a * (length - way)) - std::sqrt(square_[i + 1])) / a;
  else
    seconds = (v - std::sqrt(square_[i])) / a + (way - up) / v;
  return begins_[i] + std::clamp(seconds, 0.0, all);
}

double machine_seconds(const std::vector<Move>& moves, const SimulateOptions& o) {
  return MachineClock(moves, o).seconds();
}

}  // namespace lekalo::verify
