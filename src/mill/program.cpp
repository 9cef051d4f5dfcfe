#include "lekalo/mill/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "lekalo/geom/trig.hpp"
#include "lekalo/nc/decimal.hpp"

namespace lekalo::mill {
namespace {

using geom::EdgeKind;
using geom::Point;
using nc::Post;

/// Whole units of the last decimal.
struct Count {
  std::int64_t x = 0, y = 0;
  friend bool operator==(const Count&, const Count&) = default;
};

std::string plain(const std::string& words) {
  constexpr std::size_t kLongest = 60;
  std::string text;
  for (const char c : words) {
    const bool lower = c >= 'a' && c <= 'z';
    const bool kept = (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-';
    const char put = lower ? static_cast<char>(c - 'a' + 'A') : kept ? c : ' ';
    if ((put == ' ' && (text.empty() || text.back() == ' ')) || text.size() >= kLongest) continue;
    text += put;
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

class Writer {
 public:
  explicit Writer(const ProgramOptions& o) : o_(o), inch_(o.unit == LengthUnit::inch) {
    decimals_ = inch_ ? 5 : o.post == Post::fanuc ? 3 : 4;
    unit_ = inch_ ? kMillimetresPerInch : 1;
    step_ = unit_;
    for (int i = 0; i < decimals_; ++i) step_ /= 10;
  }

  std::string write(const PocketPath& path, std::vector<std::size_t>* move_of_line) {
    move_of_line_ = move_of_line;
    begin();
    for (const PathMove& move : path.moves) {
      move_ = static_cast<std::size_t>(&move - path.moves.data());
      if (!at_)
        first(move);
      else
        follow(move);
    }
    move_ = kNoMove;
    end();
    return std::move(text_);
  }

 private:
  void line(const std::string& words) {
    text_ += words;
    text_ += '\n';
    if (move_of_line_ != nullptr) move_of_line_->push_back(move_);
  }
  void comment(const std::string& words) {
    const std::string text = plain(words);
    if (!text.empty()) line("(" + text + ")");
  }

  void begin() {
    const bool fanuc = o_.post == Post::fanuc, grbl = o_.post == Post::grbl;
    if (fanuc) line("%"), line("O0001");
    for (const std::string& words : o_.comments) comment(words);
    line(fmt::format("{} G17 G90 G40 G49 G80 G94", inch_ ? "G20" : "G21"));
    if (!fanuc) line("G91.1");
    line(fmt::format("G{}", 53 + o_.work_offset));
    // Exact path: blending would leave the path that was judged.
    if (o_.post == Post::linuxcnc) line("G61");
    if (o_.tool_number > 0) {
      if (grbl) {
        comment(fmt::format("tool {}", o_.tool_number));
      } else {
        line(fmt::format("T{} M6", o_.tool_number));
        line(fmt::format("G43 H{}", o_.tool_number));
      }
    }
    if (o_.spindle > 0) line(fmt::format("S{:.0f} M3", o_.spindle));
    if (o_.coolant != Coolant::off) line(o_.coolant == Coolant::mist ? "M7" : "M8");
  }

  void end() {
    if (o_.coolant != Coolant::off) line("M9");
    if (o_.spindle > 0) line("M5");
    line("M30");
    if (o_.post == Post::fanuc) line("%");
  }

  [[nodiscard]] std::int64_t count(double mm) const {
    return static_cast<std::int64_t>(std::floor(mm / step_ + 0.5));
  }
  [[nodiscard]] Count count(Point p) const { return {count(p.x), count(p.y)}; }
  [[nodiscard]] Point place(Count c) const {
    return {static_cast<double>(c.x) * step_, static_cast<double>(c.y) * step_};
  }
  [[nodiscard]] std::string number(std::int64_t n) const { return nc::format_decimal(n, decimals_); }
  [[nodiscard]] std::string place_words(Count c) const {
    std::string words;
    if (!at_ || c.x != at_->x) words += " X" + number(c.x);
    if (!at_ || c.y != at_->y) words += " Y" + number(c.y);
    return words;
  }

  /// Up before across.
  void first(const PathMove& move) {
    z_ = count(move.z);
    line("G0 Z" + number(z_));
    const Count to = count(move.to);
    line("G0" + place_words(to));
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

  void rapid(const PathMove& move) {
    const std::int64_t z = count(move.z);
    const Count to = count(move.to);
    const std::string across = place_words(to);
    if (z > z_) line("G0 Z" + number(z));
    if (!across.empty()) line("G0" + across);
    if (z < z_) line("G0 Z" + number(z));
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
    return inch_ ? fmt::format(" F{:.3f}", mm / unit_) : fmt::format(" F{:.1f}", mm);
  }

  void straight(Point to, double z, const PathMove& move) {
    const Count rounded = count(to);
    const std::int64_t depth = count(z);
    std::string words = place_words(rounded);
    if (depth != z_) words += " Z" + number(depth);
    if (words.empty()) return;
    line("G1" + words + feed_words(move));
    at_ = rounded, z_ = depth;
  }

  /// In equal parts of less than half a turn, so that rounding can make no full circle of a short one.
  void arcs(Point from, const PathMove& move) {
    const geom::Edge arc = arc_of(move, from);
    const double sweep = arc_sweep(arc), pieces = std::max(1.0, std::ceil(sweep / 3.2));
    const double turn = move.shape == EdgeKind::arc_ccw ? sweep : -sweep;
    const double depth = static_cast<double>(z_) * step_;
    for (double i = 0; i < pieces; ++i)
      part_of_arc({arc, turn, depth, &move}, i / pieces, (i + 1) / pieces, 0);
  }

  struct Arc {
    geom::Edge edge;
    double turn = 0;  ///< the sweep, negative clockwise
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

  /// The arc between two shares of its sweep. Of the centres on the grid near its own the one whose circle,
  /// as the control draws it between the written ends, keeps nearest to the arc.
  void part_of_arc(const Arc& arc, double begin, double end, int halved) {
    const Point to = arc.at(end);
    const double z = end >= 1 ? arc.move->z : arc.from_z + end * (arc.move->z - arc.from_z);
    const double middle = 0.5 * (begin + end);
    const double sagitta = norm(arc.at(middle) - 0.5 * (arc.at(begin) + to));
    const Count stop = count(to);
    if (sagitta < 0.5 * step_) return straight(to, z, *arc.move);
    std::array<Point, 5> meant;
    for (std::size_t i = 0; i < meant.size(); ++i)
      meant[i] = arc.at(begin + (end - begin) * (static_cast<double>(i) / 4));
    const Point first = place(*at_), last = place(stop);
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
        // Rounding may have swapped the ends of a small one, which would make it nearly a circle.
        const double swept = geom::arc_sweep({arc.edge.kind, first, last, centre});
        if (fault < least && swept < sweep + 1) least = fault, best = offset;
      }
    if (!(least <= 0.8 * kWritingError)) {
      // No circle on this grid: shorter arcs, whose ends bind it less, or lines where it is that small.
      if (sagitta < 0.7 * kWritingError || halved > 8) return straight(to, z, *arc.move);
      part_of_arc(arc, begin, middle, halved + 1);
      return part_of_arc(arc, middle, end, halved + 1);
    }
    std::string words = arc.turn > 0 ? "G3" : "G2";
    words += fmt::format(" X{} Y{}", number(stop.x), number(stop.y));
    const std::int64_t depth = count(z);
    if (depth != z_) words += " Z" + number(depth);
    words += fmt::format(" I{} J{}", number(best.x), number(best.y));
    line(words + feed_words(*arc.move));
    at_ = stop, z_ = depth;
  }

  const ProgramOptions& o_;
  bool inch_;
  int decimals_ = 4;
  double unit_ = 1, step_ = 1e-4, feed_ = 0;
  std::optional<Count> at_;
  Point exact_;
  std::int64_t z_ = 0;
  std::string text_;
  std::size_t move_ = kNoMove;
  std::vector<std::size_t>* move_of_line_ = nullptr;
};

}  // namespace

std::string program_of(const PocketPath& path, const ProgramOptions& options,
                       std::vector<std::size_t>* move_of_line) {
  return Writer(options).write(path, move_of_line);
}

}  // namespace lekalo::mill
