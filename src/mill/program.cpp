#include "lekalo/mill/program.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/nc/program_writer.hpp"

namespace lekalo::mill {
namespace {

using geom::EdgeKind;
using geom::Point;
using Count = nc::WrittenPoint;

/// Ends rounded to a ten thousandth of an inch are up to 1.8 um off, more than kWritingError.
constexpr int kLeastInchDecimals = 5;

int decimals_of(const ProgramOptions& o) {
  const int decimals = o.post.decimals.of(o.unit);
  return o.unit == LengthUnit::inch ? std::max(decimals, kLeastInchDecimals) : decimals;
}

/// Step 6 of docs/design/pocket-program.md, whose numbers stand below.
class Writer {
 public:
  explicit Writer(const ProgramOptions& o)
      : o_(o), out_(o.post, o.unit, decimals_of(o)), step_(millimetres_per(o.unit)) {
    for (int i = 0; i < decimals_of(o); ++i) step_ /= 10;
  }

  std::string write(const PocketPath& path, std::vector<std::size_t>* move_of_line) {
    const auto lines_are_of = [&](std::size_t move) {
      if (move_of_line != nullptr) move_of_line->resize(out_.line_count(), move);
    };
    if (move_of_line != nullptr) move_of_line->clear();
    begin();
    lines_are_of(kNoMove);
    for (std::size_t i = 0; i < path.moves.size(); ++i) {
      ask();
      if (at_)
        follow(path.moves[i]);
      else
        first(path.moves[i]);
      lines_are_of(i);
    }
    std::string text = end();
    lines_are_of(kNoMove);
    return text;
  }

 private:
  /// Step 6.1.
  void begin() {
    out_.begin();
    for (const std::string& words : o_.comments) out_.comment(words);
    out_.lines(o_.post.pocket.modes, {{"{offset}", fmt::format("G{}", 53 + o_.work_offset)}});
    if (o_.tool_number > 0) out_.lines(o_.post.tool_change, {{"{tool}", std::to_string(o_.tool_number)}});
    if (o_.spindle > 0) out_.line(fmt::format("S{:.0f} M3", o_.spindle));
    if (o_.coolant != Coolant::off) out_.line(o_.coolant == Coolant::mist ? "M7" : "M8");
  }

  /// Step 6.6.
  std::string end() {
    if (o_.coolant != Coolant::off) out_.line("M9");
    if (o_.spindle > 0) out_.line("M5");
    return out_.finish(o_.post.pocket.end);
  }

  /// Step 6.3.
  [[nodiscard]] std::int64_t count(double mm) const {
    return static_cast<std::int64_t>(std::floor(mm / step_ + 0.5));
  }
  [[nodiscard]] Count count(Point p) const { return {count(p.x), count(p.y)}; }
  [[nodiscard]] Point place(Count c) const {
    return {static_cast<double>(c.x) * step_, static_cast<double>(c.y) * step_};
  }
  [[nodiscard]] std::string place_words(Count c) const {
    std::string words;
    if (!at_ || c.x != at_->x) words += " X" + out_.number(c.x);
    if (!at_ || c.y != at_->y) words += " Y" + out_.number(c.y);
    return words;
  }

  /// Step 6.2: the tool goes up before it goes across, because nobody knows where it stands.
  void first(const PathMove& move) {
    z_ = count(move.z);
    out_.line("G0 Z" + out_.number(z_));
    const Count to = count(move.to);
    out_.line("G0" + place_words(to));
    at_ = to, exact_ = move.to;
  }

  void follow(const PathMove& move) {
    const Point from = exact_;
    if (move.kind == PathMove::Kind::rapid)
      rapid(move);
    else if (move.shape == EdgeKind::line)
      straight(move.to, move.z, move);
    else
      arcs(from, move);
    exact_ = move.to;
  }

  /// Step 6.2: the tool goes up, across, down.
  void rapid(const PathMove& move) {
    const std::int64_t z = count(move.z);
    const Count to = count(move.to);
    const std::string across = place_words(to);
    if (z > z_) out_.line("G0 Z" + out_.number(z));
    if (!across.empty()) out_.line("G0" + across);
    if (z < z_) out_.line("G0 Z" + out_.number(z));
    z_ = z, at_ = to;
  }

  [[nodiscard]] std::string feed_words(const PathMove& move) {
    const double mm = move.feed > 0                         ? move.feed
                      : move.kind == PathMove::Kind::plunge ? o_.plunge_feed_mm_per_min
                      : move.kind == PathMove::Kind::link   ? o_.link_feed_mm_per_min
                      : move.kind == PathMove::Kind::entry || move.kind == PathMove::Kind::slot
                          ? o_.feed_mm_per_min / 2
                          : o_.feed_mm_per_min;
    if (mm == feed_) return {};
    feed_ = mm;
    return out_.feed(mm, 3);
  }

  void straight(Point to, double z, const PathMove& move) {
    const Count rounded = count(to);
    const std::int64_t depth = count(z);
    std::string words = place_words(rounded);
    if (depth != z_) words += " Z" + out_.number(depth);
    if (words.empty()) return;
    out_.line("G1" + words + feed_words(move));
    at_ = rounded, z_ = depth;
  }

  /// The arc is written in equal parts of about half a turn at most, so that rounding can make no full circle
  /// of a short one.
  void arcs(Point from, const PathMove& move) {
    const geom::Edge arc = arc_of(move, from);
    const double sweep = arc_sweep(arc), pieces = std::max(1.0, std::ceil(sweep / 3.2));
    const double turn = move.shape == EdgeKind::arc_ccw ? sweep : -sweep;
    const double depth = static_cast<double>(z_) * step_;
    for (double i = 0; i < pieces; ++i) part_of_arc({arc, turn, depth, &move}, i / pieces, (i + 1) / pieces);
  }

  struct Arc {
    geom::Edge edge;
    double turn = 0;  ///< rad, the sweep; negative clockwise
    double from_z = 0;
    const PathMove* move = nullptr;

    [[nodiscard]] Point at(double share) const {
      if (share <= 0) return edge.from;
      if (share >= 1) return edge.to;
      const auto [sine, cosine] = geom::sincos(turn * share);
      const Point out = edge.from - edge.centre;
      return edge.centre + cosine * out + sine * geom::perpendicular(out);
    }
  };

  /// Steps 6.4 and 6.5: the arc between two shares of its sweep. Of the centres on the grid near its own it
  /// gets the one whose circle, as the control draws it between the written ends, keeps nearest to the arc.
  void part_of_arc(const Arc& arc, double begin, double end) {
    const Point to = arc.at(end);
    const double z = end >= 1 ? arc.move->z : arc.from_z + end * (arc.move->z - arc.from_z);
    const double middle = 0.5 * (begin + end);
    const double sagitta = norm(arc.at(middle) - 0.5 * (arc.at(begin) + to));
    const Count stop = count(to);
    std::array<Point, 5> meant;
    for (std::size_t i = 0; i < meant.size(); ++i)
      meant[i] = arc.at(begin + (end - begin) * (static_cast<double>(i) / 4));
    const Point first = place(*at_), last = place(stop);
    // A line between the rounded ends is off by the height of the arc and by what an end was moved.
    const double moved = std::max(norm(first - meant.front()), norm(last - meant.back()));
    if (sagitta + moved <= 0.99 * kWritingError || sagitta < 0.25 * step_) return straight(to, z, *arc.move);
    const Count about = count(arc.edge.centre - first);
    const double sweep = std::abs(arc.turn) * (end - begin);
    Count best;
    double least = HUGE_VAL;
    constexpr std::int64_t kAround = 2;
    for (std::int64_t dy = -kAround; dy <= kAround && !(*at_ == stop); ++dy)
      for (std::int64_t dx = -kAround; dx <= kAround; ++dx) {
        const Count offset{about.x + dx, about.y + dy};
        if (offset.x == 0 && offset.y == 0) continue;
        const Point centre = first + place(offset);
        const double radius = norm(first - centre), other = norm(last - centre);
        double fault = std::abs(radius - other);
        for (const Point p : meant)
          fault = std::max({fault, std::abs(norm(p - centre) - radius), std::abs(norm(p - centre) - other)});
        // Rounding may have swapped the ends of a small arc, which would make it nearly a circle.
        const double swept = geom::arc_sweep({arc.edge.kind, first, last, centre});
        if (fault < least && swept < sweep + 1) least = fault, best = offset;
      }
    if (!(least <= 0.8 * kWritingError)) {
      // No circle on this grid keeps to the arc. Shorter arcs bind it less by their ends, and have a quarter
      // of the height, so that lines will do in the end.
      part_of_arc(arc, begin, middle);
      return part_of_arc(arc, middle, end);
    }
    std::string words = arc.turn > 0 ? "G3" : "G2";
    words += out_.pair('X', 'Y', stop);
    const std::int64_t depth = count(z);
    if (depth != z_) words += " Z" + out_.number(depth);
    words += out_.pair('I', 'J', best);
    out_.line(words + feed_words(*arc.move));
    at_ = stop, z_ = depth;
  }

  const ProgramOptions& o_;
  nc::ProgramWriter out_;
  double step_;      ///< mm, a unit of the last decimal
  double feed_ = 0;  ///< mm/min, the last one written
  std::optional<Count> at_;
  Point exact_;
  std::int64_t z_ = 0;
};

}  // namespace

std::string program_of(const PocketPath& path, const ProgramOptions& options,
                       std::vector<std::size_t>* move_of_line) {
  return Writer(options).write(path, move_of_line);
}

}  // namespace lekalo::mill
