#include "moved_program.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/double_of_text.hpp"
#include "lekalo/base/stop.hpp"
#include "nc_program.hpp"
#include "verify/number/interval.hpp"

namespace lekalo::verify {
namespace {

/// Motions are computed in doubles. This many times the largest number is far above what their rounding makes
/// of places, and of centres that two ends and a radius give.
constexpr double kReading = 1e-12;
/// Feeds and heights are the same words in both programs.
constexpr double kSame = 1e-12;

struct Map {
  double cosine = 1, sine = 0, x = 0, y = 0;
  [[nodiscard]] Place operator()(Place p) const {
    return {cosine * p.x - sine * p.y + x, sine * p.x + cosine * p.y + y};
  }
};

Map map_of(double x, double y, double theta) {
  const RoundedTurn turn = rounded_turn(theta);
  return {turn.cosine, turn.sine, x, y};
}

double apart(Place a, Place b) { return length(a - b); }
bool same(double a, double b) { return std::abs(a - b) <= kSame * (1 + std::abs(a)); }
bool same_ends(const Move& move) { return move.from.x == move.to.x && move.from.y == move.to.y; }

double largest_of(const std::vector<Move>& moves) {
  double largest = 1;
  for (const Move& move : moves)
    for (const Place& p : {move.from, move.to, move.centre})
      largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  return largest;
}

/// A line in capitals without comments.
std::string code_without_comments(std::string_view line) {
  std::string code;
  int depth = 0;
  for (const char c : line) {
    if (c == ';' && depth == 0) break;
    depth += c == '(' ? 1 : 0;
    if (depth == 0 && c != '\r') code += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    depth -= c == ')' && depth > 0 ? 1 : 0;
  }
  return code;
}

/// The number behind ` X` and its like.
std::optional<double> number_behind(const std::string& line, const std::string& word) {
  const std::size_t at = line.find(word);
  if (at == std::string::npos) return std::nullopt;
  const std::size_t begin = at + word.size(),
                    end = std::min(line.find_first_not_of("0123456789.-", begin), line.size());
  return double_of_text(std::string_view(line).substr(begin, end - begin));
}

/// Under G93 the chords of an arc share its time: each says F, so many times that of the arc.
bool shares_time(std::string arc, std::string chord, bool first, double chords) {
  const auto take_feed = [](std::string& words) -> std::optional<double> {
    const std::size_t at = words.starts_with('F') ? 0 : words.find(" F") + 1;
    const std::size_t end = words.find(' ', at);
    if (words.empty() || words[at] != 'F' || end == std::string::npos) return std::nullopt;
    const auto feed = double_of_text(std::string_view(words).substr(at + 1, end - at - 1));
    words.erase(at, end + 1 - at);
    return feed;
  };
  const auto whole = take_feed(arc), share = take_feed(chord);
  return whole && share && same(*whole * chords, *share) && chord == (first ? arc : "");
}

/// The frame that lines put into a program make, and the program without them.
struct Framed {
  std::string rest;
  /// For each line whether the frame is in force.
  std::vector<bool> in_force;
  std::optional<double> x, y, degrees;  ///< mm and degrees
  bool steady = true;                   ///< it is the same wherever it is said
};

class FrameReader {
 public:
  FrameReader(bool g68, std::size_t work_offset) : g68_(g68), work_offset_(work_offset) {}

  Framed read(std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      const std::string_view line = text.substr(0, end);
      take(line, code_without_comments(line));
      framed_.in_force.push_back(turned_ && framed_.x.has_value());
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    return std::move(framed_);
  }

 private:
  void take(std::string_view line, const std::string& code) {
    if (code.find("G20") != std::string::npos) unit_ = 25.4;
    if (code.find("G21") != std::string::npos) unit_ = 1;
    const std::size_t frame = code.find(g68_ ? "G52 X" : "G10 L2 ");
    if (frame != std::string::npos && code.find("G52 X0 Y0") != frame) {
      set_frame(code);
      framed_.rest += code.substr(0, frame) + "\n";
    } else if (g68_ && code.starts_with("G68 X0 Y0 R")) {
      turn(number_behind(code, " R"));
      framed_.rest += "\n";
    } else if (g68_ && (code == "G69" || code == "G80 G69" || code == "G52 X0 Y0")) {
      turned_ = false;
      framed_.rest += "\n";
    } else {
      framed_.rest += std::string(line) + "\n";
    }
  }

  void set_frame(const std::string& code) {
    framed_.steady = framed_.steady && !framed_.x;
    const auto x = number_behind(code, " X"), y = number_behind(code, " Y");
    if (x && y) framed_.x = unit_ * *x, framed_.y = unit_ * *y;
    if (g68_) return;
    framed_.steady = framed_.steady && number_behind(code, " P") == static_cast<double>(work_offset_);
    turn(number_behind(code, " R"));
  }

  void turn(std::optional<double> degrees) {
    framed_.steady = framed_.steady && degrees && (!framed_.degrees || framed_.degrees == degrees);
    framed_.degrees = degrees;
    turned_ = true;
  }

  bool g68_;
  std::size_t work_offset_;
  Framed framed_;
  double unit_ = 1;
  bool turned_ = false;
};

class ProgramCheck {
 public:
  explicit ProgramCheck(const ProgramClaim& claim)
      : claim_(claim),
        exact_(map_of(approximate(claim.x), approximate(claim.y), approximate(claim.theta))),
        rounding_(approximate(claim.rounding)) {}

  ProgramVerdict run() {
    if (claim_.mode == "coordinates") {
      const auto original = read(claim_.original), written = read(claim_.written);
      if (original && written) compare(*original, *written, exact_);
    } else if (claim_.mode == "offset" || claim_.mode == "g68") {
      compare_frames();
    } else {
      fault(fmt::format("there is no mode \"{}\"", excerpt(claim_.mode)));
    }
    return verdict_;
  }

 private:
  void fault(std::string sentence) {
    if (!verdict_.fault) verdict_.fault = std::move(sentence);
  }

  /// Returns nothing where a program is not understood.
  std::optional<NcProgram> read(Document program) {
    // The byte order mark of UTF-8 is no part of a program.
    if (program.bytes.starts_with("\xEF\xBB\xBF")) program.bytes.remove_prefix(3);
    Result<NcProgram> found =
        read_program(program, {.control = claim_.control, .judged = false, .allowed_m = claim_.allowed_m});
    if (found) return *std::move(found);
    if (!verdict_.open) verdict_.open = found.error().message;
    return std::nullopt;
  }

  void compare(const NcProgram& original, const NcProgram& written, const Map& map) {
    limit_ = rounding_ + kReading * (largest_of(original.moves) + largest_of(written.moves));
    std::size_t next = 0;
    for (const NcEvent& event : original.events) {
      ask();
      if (verdict_.fault) return;
      if (next == written.events.size())
        return fault(fmt::format("it ends before line {} of the original", event.line));
      const NcEvent& other = written.events[next];
      check_said(event, written, other);
      if (event.upright && !other.upright)
        next = compare_chords(*event.upright, event, written, next, map);
      else
        compare_event(original, event, written, other, map), ++next;
    }
    if (next < written.events.size() && !verdict_.fault)
      fault(fmt::format("its line {} does something that the original does not", written.events[next].line));
  }

  /// The written program has to say what the original says of its motions: else the control decides.
  void check_said(const NcEvent& event, const NcProgram& written, const NcEvent& other) {
    if (other.first_move == other.end_move && !other.upright) return;
    // Lines that stand for an arc of another plane need none.
    const bool turns = other.first_move < other.end_move && written.moves[other.first_move].arc;
    // Other modes stand in the words of events, which are the same.
    struct Shown {
      words::Group group;
      bool matters;
      const char* name;
    };
    for (const auto& [group, matters, name] : {Shown{words::Group::unit, true, "a unit"},
                                               {words::Group::distance, true, "a G90 or G91"},
                                               {words::Group::plane, turns, "a plane"},
                                               {words::Group::centre, turns, "a G90.1 or G91.1"}})
      if (matters && event.said.has(group) && !other.said.has(group))
        fault(fmt::format("its line {} moves before {}, which the original says", other.line, name));
  }

  void compare_event(const NcProgram& original, const NcEvent& a, const NcProgram& written, const NcEvent& b,
                     const Map& map) {
    if (a.words != b.words)
      return fault(fmt::format("its line {} says \"{}\" besides places, where the original has \"{}\"",
                               b.line, excerpt(b.words), excerpt(a.words)));
    if (!same_offset(a, b))
      return fault(fmt::format("its line {} runs in another work offset than the original", b.line));
    const bool upright = a.upright && b.upright;
    if (a.upright.has_value() != b.upright.has_value() ||
        (!upright && a.end_move - a.first_move != b.end_move - b.first_move))
      return fault(fmt::format("its line {} makes other motions than the original", b.line));
    if (upright) return compare_upright(*a.upright, *b.upright, b.line, map);
    for (std::size_t k = 0; k < a.end_move - a.first_move; ++k)
      compare_move(original.moves[a.first_move + k], written.moves[b.first_move + k], map);
  }

  /// Lines that set a frame may select the offset that the result names where the original selects none.
  [[nodiscard]] bool same_offset(const NcEvent& a, const NcEvent& b) const {
    const auto number = static_cast<int>(claim_.work_offset);
    const int named = number <= 6 ? 530 + 10 * number : 590 + number - 6;
    return a.offset == b.offset || (a.offset == 0 && b.offset == named && claim_.mode != "coordinates");
  }

  void compare_move(const Move& a, const Move& b, const Map& map) {
    const bool alike = a.rapid == b.rapid && a.arc == b.arc && a.ccw == b.ccw && a.turns == b.turns &&
                       (!a.arc || same_ends(a) == same_ends(b)) && same(a.feed, b.feed) &&
                       same(a.from_z, b.from_z) && same(a.to_z, b.to_z);
    if (!alike) return fault(fmt::format("its motion in line {} is another than the original's", b.line));
    double off = std::max(apart(map(a.from), b.from), apart(map(a.to), b.to));
    if (a.arc) off = std::max(off, apart(map(a.centre), b.centre));
    off_by(off, b.line);
  }

  void off_by(double off, std::size_t line) {
    if (!(off <= limit_))
      fault(fmt::format("its motion in line {} is {:.3g} mm off the original's, moved", line, off));
  }

  /// An arc that no turn took out of its plane.
  void compare_upright(const NcArc& a, const NcArc& b, std::size_t line, const Map& map) {
    if (a.plane != b.plane || a.ccw != b.ccw || a.turns != b.turns)
      return fault(fmt::format("its arc in line {} is another than the original's", line));
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0})
      off_by(off_of(spot_at(a, share), spot_at(b, share), map), line);
  }

  static double off_of(const Spot& a, const Spot& b, const Map& map) {
    return std::hypot(apart(map({a[0], a[1]}), {b[0], b[1]}), a[2] - b[2]);
  }

  /// Holds the lines that stand for an arc against it, at their ends and their middles. Returns the event
  /// behind them.
  std::size_t compare_chords(const NcArc& arc, const NcEvent& event, const NcProgram& written,
                             std::size_t first, const Map& map) {
    std::size_t end = first;
    const auto move_of = [&](std::size_t k) -> const Move& {
      return written.moves[written.events[k].first_move];
    };
    for (bool there = false; !there && end < written.events.size(); ++end) {
      const NcEvent& chord = written.events[end];
      if (!same_offset(event, chord) || chord.end_move - chord.first_move != 1 || move_of(end).arc ||
          move_of(end).rapid)
        break;
      there = off_of(arc.to, {move_of(end).to.x, move_of(end).to.y, move_of(end).to_z}, map) <= limit_;
    }
    const std::size_t count = end - first;
    if (count == 0) fault(fmt::format("its line {} is no chord of an arc", written.events[first].line));
    for (std::size_t k = 0; k < count && !verdict_.fault; ++k) {
      const NcEvent& chord = written.events[first + k];
      const Move& move = move_of(first + k);
      const auto at = [&](double part) {
        return spot_at(arc, (static_cast<double>(k) + part) / static_cast<double>(count));
      };
      const Spot from{move.from.x, move.from.y, move.from_z}, to{move.to.x, move.to.y, move.to_z};
      const Spot middle{(from[0] + to[0]) / 2, (from[1] + to[1]) / 2, (from[2] + to[2]) / 2};
      off_by(std::max({off_of(at(0), from, map), off_of(at(0.5), middle, map), off_of(at(1), to, map)}),
             chord.line);
      if (!(event.by_time ? shares_time(event.words, chord.words, k == 0, static_cast<double>(count))
                          : chord.words == (k == 0 ? event.words : "")))
        fault(fmt::format("its line {} says \"{}\" beside a chord", chord.line, excerpt(chord.words)));
    }
    return std::max(end, first + 1);
  }

  /// The frame that the lines put in make, and whether they are all that was put in.
  void compare_frames() {
    const Framed framed = FrameReader(claim_.mode == "g68", claim_.work_offset).read(claim_.written.bytes);
    const auto original = read(claim_.original);
    const auto written = read({claim_.written.name, framed.rest});
    if (!original || !written) return;
    if (original->moves.empty() && !framed.x) return compare(*original, *written, {});
    if (!framed.x || !framed.y || !framed.degrees) return fault("it sets no frame");
    if (!framed.steady)
      return fault("it sets its frame in two ways, or another work offset than the result says");
    compare(*original, *written, {});
    for (const Move& move : written->moves)
      if (!(move.line <= framed.in_force.size() && framed.in_force[move.line - 1]) &&
          !(move.rapid && same_ends(move)))
        return fault(fmt::format("its line {} moves outside its frame", move.line));
    const Map map = map_of(*framed.x, *framed.y, *framed.degrees * kPi / 180);
    const double turned = std::hypot(map.cosine - exact_.cosine, map.sine - exact_.sine);
    for (const Move& move : original->moves) {
      const double radius =
          move.arc ? std::max(apart(move.from, move.centre), apart(move.to, move.centre)) : 0;
      double off = std::max(apart(exact_(move.from), map(move.from)), apart(exact_(move.to), map(move.to)));
      // Another direction moves a point of a circle by its radius more than the middle.
      if (move.arc) off = std::max(off, apart(exact_(move.centre), map(move.centre)) + turned * radius);
      if (!(off <= limit_)) return fault(fmt::format("its frame puts line {} {:.3g} mm off", move.line, off));
    }
  }

  const ProgramClaim& claim_;
  Map exact_;
  double rounding_, limit_ = 0;
  ProgramVerdict verdict_;
};

}  // namespace

ProgramVerdict check_moved_program(const ProgramClaim& claim) { return ProgramCheck(claim).run(); }

}  // namespace lekalo::verify
