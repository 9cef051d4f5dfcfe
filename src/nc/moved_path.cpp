#include "lekalo/nc/moved_path.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <utility>

#include "arc.hpp"
#include "foreign.hpp"
#include "interpreter.hpp"
#include "lekalo/base/angle.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/point.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/nc/dialect.hpp"
#include "modes.hpp"
#include "unfold.hpp"
#include "white_list.hpp"

namespace lekalo::nc {
namespace {

using geom::norm, geom::Point;

/// A node is left out where the way without it stays as near as this, mm.
constexpr double kOnMovedWay = 1e-4;
/// A written arc turns by no more than this, with some rounding.
constexpr double kMostOfATurn = kTurn / 4 + 1e-9;

Point flat(GridPoint p) {
  return {static_cast<double>(p.x) / kGrainsPerMillimetre, static_cast<double>(p.y) / kGrainsPerMillimetre};
}

Grains to_step(double millimetres, Grains step) {
  return steps_nearest(geom::DoubleDouble{millimetres * kGrainsPerMillimetre}, step) * step;
}

/// The decimals with which a moved motion is written: those that the control reads, and those that its own
/// words have.
int moved_decimals(const Motion& motion, const Dialect& post) {
  return std::max({post.decimals.of(motion.unit), motion.x != nullptr ? motion.x->value.decimals : 0,
                   motion.y != nullptr ? motion.y->value.decimals : 0});
}

/// The way of a motion as the program has it.
class WayOfMotion {
 public:
  explicit WayOfMotion(const Motion& motion) : start_(flat(motion.start)), end_(flat(motion.end)) {
    if (motion.kind == MotionKind::line) return;
    const Arc arc = motion_arc(motion);
    is_arc_ = true;
    centre_ = {arc.centre.x.hi / kGrainsPerMillimetre, arc.centre.y.hi / kGrainsPerMillimetre};
    const Point out = start_ - centre_;
    begin_ = geom::direction_angle(out.x, out.y);
    sweep_ = motion.clockwise ? -arc.sweep : arc.sweep;
    first_radius_ = norm(out), last_radius_ = norm(end_ - centre_);
  }

  [[nodiscard]] bool is_arc() const { return is_arc_; }
  [[nodiscard]] double sweep() const { return std::abs(sweep_); }
  [[nodiscard]] double radius() const { return (first_radius_ + last_radius_) / 2; }
  [[nodiscard]] Point at(double share) const {
    if (share >= 1) return end_;
    if (!is_arc_) return start_ + share * (end_ - start_);
    const double radius = first_radius_ + share * (last_radius_ - first_radius_);
    const auto direction = geom::sincos(begin_ + share * sweep_);
    return centre_ + radius * Point{direction.cosine, direction.sine};
  }

 private:
  Point start_, end_, centre_;
  bool is_arc_ = false;
  double begin_ = 0, sweep_ = 0, first_radius_ = 0, last_radius_ = 0;
};

/// A place on a motion's way with where it goes.
struct Knot {
  double share = 0, z = 0;
  Point by;
};

Point between(const Knot& a, const Knot& b, double share) {
  const double t = b.share > a.share ? (share - a.share) / (b.share - a.share) : 0;
  return a.by + t * (b.by - a.by);
}

/// The end of a line or an arc that is written.
struct WrittenEnd {
  GridPoint at;
  double z = 0;
  std::optional<GridPoint> centre;
};

class PathMover {
 public:
  PathMover(std::string_view text, const Program& program, const std::vector<MovedMotion>& motions,
            const Dialect& post)
      : text_(text), program_(program), motions_(motions), post_(post) {}

  std::vector<Edit> edits;
  std::string fault;  ///< of fault_line
  std::size_t fault_line = 0;

  /// Follows one motion; false where it is refused.
  bool follow(const Motion& motion) {
    const Block& block = program_.blocks[motion.block];
    const std::vector<MovedNode> nodes = nodes_of(motion, block.line);
    const bool away = motion.start_known && known_ && here_ != motion.start;
    if (nodes.empty() && !away) return reach(motion.end);
    const bool line = motion.kind == MotionKind::line;
    // A line that says both coordinates ends where it did, wherever it begins.
    const bool says_both = motion.x != nullptr && motion.y != nullptr && !motion.incremental;
    if (nodes.empty() && says_both && (line || motion.kind == MotionKind::cycle)) return reach(motion.end);
    if (motion.kind == MotionKind::cycle) return refuse(block, "a canned cycle");
    if (motion.incremental) return refuse(block, "a motion under G91");
    if (motion.plane != 170) return refuse(block, "an arc of G18 or G19");
    if (motion.turns > 1) return refuse(block, "an arc of several turns");
    const int decimals = moved_decimals(motion, post_);
    const WayOfMotion way(motion);
    const std::vector<Knot> knots = knots_of(motion, way, nodes);
    const std::vector<WrittenEnd> ends = ends_of(motion, way, knots, quantum(motion.unit, decimals));
    if (ends.empty()) return refuse(block, "an arc shorter than the last decimal");
    if (ends.size() > 1 && motion.inverse_time) return refuse(block, "a motion under G93");
    if (ends.size() > 1 && ends_or_pauses(block)) return refuse(block, "a motion beside M0, M1, M2 or M30");
    write(motion, block, ends, decimals);
    return reach(ends.back().at);
  }

 private:
  bool reach(GridPoint at) {
    here_ = at, known_ = true;
    return true;
  }
  bool refuse(const Block& block, const char* what) {
    fault = fmt::format("{} belongs to the path that has to be moved, and is not moved", what);
    fault_line = block.line;
    return false;
  }

  static bool ends_or_pauses(const Block& block) {
    return std::ranges::any_of(block.words, [](const Word& word) {
      const auto number = word.letter == 'M' ? word.value.whole() : std::nullopt;
      return number && (*number <= 2 || *number == 30);
    });
  }

  /// Nodes of a motion that move it; empty where none does.
  [[nodiscard]] std::vector<MovedNode> nodes_of(const Motion& motion, std::size_t line) const {
    const auto found = std::ranges::lower_bound(motions_, line, {}, &MovedMotion::line);
    if (found == motions_.end() || found->line != line || motion.kind == MotionKind::cycle) return {};
    const bool moves = std::ranges::any_of(
        found->nodes, [](const MovedNode& node) { return node.by != std::array<double, 2>{}; });
    return moves ? found->nodes : std::vector<MovedNode>{};
  }

  /// The beginning as it was written, and the nodes; along an arc no two are more than a quarter turn apart.
  [[nodiscard]] std::vector<Knot> knots_of(const Motion& motion, const WayOfMotion& way,
                                           const std::vector<MovedNode>& nodes) const {
    std::vector<Knot> knots{{}};
    if (motion.start_known && known_) knots[0].by = flat(here_) - flat(motion.start);
    const auto add = [&](const Knot& knot) {
      const Knot from = knots.back();
      const double parts =
          way.is_arc() ? std::ceil(way.sweep() * (knot.share - from.share) / kMostOfATurn) : 1;
      for (double k = 1; k < parts; ++k) {
        const double share = from.share + (knot.share - from.share) * k / parts;
        knots.push_back({share, 0, between(from, knot, share)});
      }
      knots.push_back(knot);
    };
    for (const MovedNode& node : nodes)
      if (node.share > knots.back().share) add({node.share, node.z, {node.by[0], node.by[1]}});
    if (knots.back().share < 1) add({1, 0, {}});
    // A helix rises evenly.
    if (way.is_arc())
      for (Knot& knot : knots)
        knot.z = (static_cast<double>(motion.start_z) +
                  knot.share * static_cast<double>(motion.end_z - motion.start_z)) /
                 kGrainsPerMillimetre;
    return knots;
  }

  /// Says where a share of the way goes. \pre it is between these two knots
  static Point moved(const WayOfMotion& way, const std::vector<Knot>& knots, double share) {
    auto after = std::ranges::lower_bound(knots, share, {}, &Knot::share);
    if (after == knots.begin()) ++after;
    if (after == knots.end()) --after;
    return way.at(share) + between(*std::prev(after), *after, share);
  }

  /// Says whether one line serves for all from one knot to another.
  static bool line_fits(const std::vector<Knot>& knots, std::size_t a, std::size_t b) {
    for (std::size_t k = a + 1; k < b; ++k)
      if (norm(knots[k].by - between(knots[a], knots[b], knots[k].share)) > kOnMovedWay) return false;
    return true;
  }

  /// The circle through three places of the moved way that are at most a quarter turn apart.
  struct MovedCircle {
    double radius = 0;
    Point centre;
  };
  static MovedCircle circle_of(const Motion& motion, const WayOfMotion& way, Point from, Point middle,
                               Point to) {
    const Point chord = to - from;
    const double length = norm(chord);
    const Point half = from + 0.5 * chord, left = (1 / length) * Point{-chord.y, chord.x};
    // Above 0 where the way bulges as its turning has it.
    const double bulge = geom::cross(chord, from - middle) / length * (motion.clockwise ? -1 : 1);
    double radius = way.radius();
    if (bulge > kOnMovedWay) radius = (length * length / 4 + bulge * bulge) / (2 * bulge);
    radius = std::max(radius, length / 2);
    const double off = std::sqrt(std::max(0.0, radius * radius - length * length / 4));
    return {radius, half + (motion.clockwise ? -off : off) * left};
  }

  static bool arc_fits(const Motion& motion, const WayOfMotion& way, const std::vector<Knot>& knots,
                       std::size_t a, std::size_t b) {
    if (way.sweep() * (knots[b].share - knots[a].share) > kMostOfATurn) return false;
    const Point from = moved(way, knots, knots[a].share), to = moved(way, knots, knots[b].share);
    if (from.x == to.x && from.y == to.y) return false;
    const MovedCircle circle =
        circle_of(motion, way, from, moved(way, knots, (knots[a].share + knots[b].share) / 2), to);
    for (std::size_t k = a + 1; k < b; ++k)
      if (std::abs(norm(moved(way, knots, knots[k].share) - circle.centre) - circle.radius) > kOnMovedWay)
        return false;
    return true;
  }

  [[nodiscard]] std::vector<WrittenEnd> ends_of(const Motion& motion, const WayOfMotion& way,
                                                const std::vector<Knot>& knots, Grains step) const {
    std::vector<WrittenEnd> ends;
    GridPoint here = motion.start_known && known_ ? here_ : motion.start;
    for (std::size_t a = 0, b = 0; a + 1 < knots.size(); a = b) {
      ask();
      b = a + 1;
      const auto fits = [&](std::size_t to) {
        return way.is_arc() ? arc_fits(motion, way, knots, a, to) : line_fits(knots, a, to);
      };
      while (b + 1 < knots.size() && motion.start_known && fits(b + 1)) ++b;
      if (!motion.start_known) b = knots.size() - 1;
      const Point to = moved(way, knots, knots[b].share);
      WrittenEnd end{{to_step(to.x, step), to_step(to.y, step)}, knots[b].z, {}};
      if (knots[b].share >= 1 && norm(knots[b].by) == 0) end.at = motion.end;
      if (way.is_arc()) {
        if (end.at == here) continue;
        const Point middle = moved(way, knots, (knots[a].share + knots[b].share) / 2);
        // The radius is that of the exact places; the centre lies between those that are written.
        const double radius = circle_of(motion, way, moved(way, knots, knots[a].share), middle, to).radius;
        const Point chord = flat(end.at) - flat(here);
        const double length = norm(chord),
                     off = std::sqrt(std::max(0.0, radius * radius - length * length / 4));
        const Point left = (1 / length) * Point{-chord.y, chord.x};
        const Point centre = flat(here) + 0.5 * chord + (motion.clockwise ? -off : off) * left;
        end.centre = GridPoint{to_step(centre.x, step), to_step(centre.y, step)};
      }
      ends.push_back(end);
      here = end.at;
    }
    return ends;
  }

  void write(const Motion& motion, const Block& block, const std::vector<WrittenEnd>& ends, int decimals) {
    const Grains step = quantum(motion.unit, decimals);
    const auto number = [&](Grains value) {
      int enough = decimals;
      while (enough < kMaxDecimals && value % quantum(motion.unit, enough) != 0) ++enough;
      return format_decimal(value / quantum(motion.unit, enough), enough);
    };
    const bool arc = motion.kind != MotionKind::line;
    const Word* z = nullptr;
    for (const Word& word : block.words)
      if (word.letter == 'Z') z = &word;
    GridPoint here = motion.start_known && known_ ? here_ : motion.start;
    std::vector<std::string> lines;
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const WrittenEnd& end = ends[k];
      std::string words = fmt::format("X{} Y{}", number(end.at.x), number(end.at.y));
      if (z != nullptr && k + 1 == ends.size())
        words += " " + std::string(text_.substr(z->letter_at, z->number_end - z->letter_at));
      else if (z != nullptr)
        words += " Z" + number(to_step(end.z, step));
      if (end.centre) {
        const GridPoint from = motion.absolute_centre ? GridPoint{} : here;
        words += fmt::format(" I{} J{}", number(end.centre->x - from.x), number(end.centre->y - from.y));
      }
      lines.push_back(std::move(words));
      here = end.at;
    }
    const std::string_view replaced = arc ? "XYZIJRP" : "XYZ";
    bool written = false;
    for (const Word& word : block.words) {
      if (replaced.find(word.letter) == std::string_view::npos) continue;
      if (!written) {
        edits.push_back({word.letter_at, word.number_end - word.letter_at, lines.front()});
      } else {
        const std::size_t blank = word.letter_at > block.begin && text_[word.letter_at - 1] == ' ' ? 1 : 0;
        edits.push_back({word.letter_at - blank, word.number_end - word.letter_at + blank, ""});
      }
      written = true;
    }
    std::string more;
    for (std::size_t k = 1; k < lines.size(); ++k) more += program_.line_end + lines[k];
    if (!more.empty()) edits.push_back({block.end, 0, more});
  }

  std::string_view text_;
  const Program& program_;
  const std::vector<MovedMotion>& motions_;
  const Dialect& post_;
  GridPoint here_;  ///< where the tool stands by the written words
  bool known_ = false;
};

/// A program whose path may be moved.
struct ReadPath {
  Program program;
  Interpretation interpretation;
};

Result<ReadPath> read_path(std::string_view text, const std::string& name, words::Control control) {
  if (const auto foreign = foreign_program(text))
    return refusal(name, foreign->line,
                   fmt::format("{} is a word of {} controls, whose programs are not moved", foreign->word,
                               foreign->control));
  const auto unfolded = unfold(text);
  if (!unfolded) return refusal(name, unfolded.error().line, unfolded.error().reason);
  if (!unfolded->uses.empty())
    return refusal(name, unfolded->uses.front().line,
                   "a program with subprograms, variables or expressions is not moved; write it out before");
  ReadPath read{parse_program(text), {}};
  const RewriteOptions options{.control = control};
  std::vector<LineFault> faults = read.program.faults;
  std::ranges::move(refused_words(read.program, control, options.allowed_m), std::back_inserter(faults));
  if (!faults.empty()) return refusal_of_all(name, std::move(faults));
  LEKALO_TRY(read.interpretation, interpret(read.program, name, options, control));
  return read;
}

/// Returns the byte order mark at the beginning of a program, or nothing.
std::string_view mark_of(std::string_view text) {
  return text.starts_with(kByteOrderMark) ? text.substr(0, kByteOrderMark.size()) : std::string_view();
}

}  // namespace

Result<std::string> move_path(std::string_view text, const std::string& name, words::Control control,
                              const std::vector<MovedMotion>& motions) {
  const std::string_view mark = mark_of(text);
  text.remove_prefix(mark.size());
  LEKALO_TRY(const ReadPath read, read_path(text, name, control));
  PathMover mover(text, read.program, motions, post_of(control));
  for (const Motion& motion : read.interpretation.motions)
    if (!mover.follow(motion)) return refusal(name, mover.fault_line, mover.fault);
  return std::string(mark) + apply_edits(text, std::move(mover.edits));
}

Result<MovedRounding> moved_path_rounding(std::string_view text, const std::string& name,
                                          words::Control control) {
  // Either end of a line is half a step off along each axis. The centre of an arc is rounded, too: half way
  // between the ends of a quarter turn that is 1 - cos 45 degrees of it, less than 0.3.
  constexpr double kLine = std::numbers::sqrt2 / 2, kArc = 1.3 * kLine;
  text.remove_prefix(mark_of(text).size());
  LEKALO_TRY(const ReadPath read, read_path(text, name, control));
  const Dialect& post = post_of(control);
  const bool drops = control == words::Control::fanuc || control == words::Control::haas;
  MovedRounding rounding;
  for (const Motion& motion : read.interpretation.motions) {
    const int decimals = moved_decimals(motion, post), read_ones = post.decimals.of(motion.unit);
    const auto step = [&](int places) {
      return static_cast<double>(quantum(motion.unit, places)) / kGrainsPerMillimetre;
    };
    rounding.most =
        std::max(rounding.most, (motion.kind == MotionKind::line ? kLine : kArc) * step(decimals));
    if (drops && decimals > read_ones) rounding.dropped = std::max(rounding.dropped, step(read_ones));
  }
  return rounding;
}

}  // namespace lekalo::nc
