#include "moved_program.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/double_of_text.hpp"
#include "lekalo/base/stop.hpp"
#include "nc_block.hpp"
#include "nc_flow.hpp"
#include "nc_program.hpp"
#include "verify/number/interval.hpp"

namespace lekalo::verify {
namespace {

using words::Group;

/// Motions are computed in doubles. This many times the largest number is far above what their rounding makes
/// of places, and of centres that two ends and a radius give.
constexpr double kReading = 1e-12;
/// Feeds and heights are the same words in both programs.
constexpr double kSame = 1e-12;

struct Map {
  double cosine = 1, sine = 0, x = 0, y = 0, z = 0;
  [[nodiscard]] Place operator()(Place p) const {
    return {cosine * p.x - sine * p.y + x, sine * p.x + cosine * p.y + y};
  }
};

Map map_of(double x, double y, double theta) {
  const RoundedTurn turn = rounded_turn(theta);
  return {turn.cosine, turn.sine, x, y};
}

Map map_of(const ProgramClaim& claim) {
  const double x = approximate(claim.x), y = approximate(claim.y);
  if (!claim.solid) return map_of(x, y, approximate(claim.theta));
  const double a = approximate(claim.solid->turn[0]), b = approximate(claim.solid->turn[1]);
  const double square = a * a + b * b;
  return {(a * a - b * b) / square, 2 * a * b / square, x, y, approximate(claim.solid->z)};
}

double apart(Place a, Place b) { return length(a - b); }
bool same(double a, double b) { return std::abs(a - b) <= kSame * (1 + std::abs(a)); }
bool same_ends(const Move& move) { return move.from.x == move.to.x && move.from.y == move.to.y; }

/// The byte order mark of UTF-8 is no part of a program.
Document without_mark(Document program) {
  if (program.bytes.starts_with("\xEF\xBB\xBF")) program.bytes.remove_prefix(3);
  return program;
}

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
    depth -= c == ')' ? 1 : 0;  // a line with one too many is not understood
  }
  return code;
}

/// The numbers of words that have these letters, in this order, and are no more.
std::optional<std::vector<double>> numbers_of(std::string_view words, std::string_view letters) {
  std::vector<double> numbers;
  for (const char letter : letters) {
    if (!words.starts_with(std::string{' ', letter})) return std::nullopt;
    const std::size_t end = std::min(words.find_first_not_of("0123456789.-", 2), words.size());
    const auto number = double_of_text(words.substr(2, end - 2));
    if (!number) return std::nullopt;
    numbers.push_back(*number);
    words.remove_prefix(end);
  }
  if (words.find_first_not_of(" \t") != std::string_view::npos) return std::nullopt;
  return numbers;
}

/// Under G93 the chords of an arc share its time: each says F, so many times that of the arc.
bool shares_time(std::string arc, std::string chord, bool first, double chords) {
  const auto take_feed = [](std::string& words) -> std::optional<double> {
    const std::size_t at = words.starts_with('F') ? 0 : words.find(" F") + 1;
    const std::size_t end = words.find(' ', at);
    if (words[at] != 'F') return std::nullopt;
    const auto feed = double_of_text(std::string_view(words).substr(at + 1, end - at - 1));
    words.erase(at, end + 1 - at);
    return feed;
  };
  const auto whole = take_feed(arc), share = take_feed(chord);
  return whole && share && same(*whole * chords, *share) && chord == (first ? arc : "");
}

constexpr const char* kTwoWays = "it sets its frame in two ways, or another work offset than the result says";

/// The frame that lines put into a program make, and the program without them.
struct Framed {
  std::string rest;
  /// For each line whether the frame is in force whenever it runs.
  std::vector<bool> in_force;
  std::optional<Place> shift;  ///< mm
  double height = 0;           ///< mm
  std::optional<double> degrees;
  std::optional<std::string> fault;
};

class FrameReader {
 public:
  explicit FrameReader(const ProgramClaim& claim)
      : claim_(claim), g68_(claim.mode == "g68"), lines_(claim.control, claim.allowed_m) {}

  Result<Framed> read(const Document& program) {
    LEKALO_TRY(const std::vector<NcLine> order, lines_in_order(program, claim_.control));
    for (std::string_view text = program.bytes; !text.empty();) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      framed_.rest += divided(text.substr(0, end)).first + "\n";
      framed_.in_force.push_back(true);
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    for (const NcLine& line : order) {
      take(line);
      if (!turned_ || !shifted_) framed_.in_force[line.number - 1] = false;
    }
    return std::move(framed_);
  }

 private:
  /// A line up to the words of a frame, and these.
  [[nodiscard]] std::pair<std::string, std::string> divided(std::string_view line) const {
    const std::string code = code_without_comments(line);
    std::size_t at = code.find(g68_ ? "G52 " : "G10 L2 ");
    if (g68_) at = std::min({at, code.find("G68 "), code.find("G69")});
    if (at == std::string::npos) return {std::string(line), ""};
    return {code.substr(0, at), code.substr(at)};
  }

  void take(const NcLine& line) {
    const auto [before, words] = divided(line.text);
    NcBlock block;
    // The rest is read again, and says so.
    if (!lines_.read(before, line.in_subprogram, block)) return;
    if (const words::Word* code = block.code(Group::unit)) unit_ = code->tenths == 200 ? 25.4 : 1;
    if (const words::Word* code = block.code(Group::plane)) level_ = code->tenths == 170;
    if (const words::Word* code = block.code(Group::distance)) absolute_ = code->tenths == 900;
    if (block.code(Group::rotation) != nullptr) turned_ = false;
    const bool alone = before.find('/') == std::string::npos;
    if (!words.empty() && !(alone && set_frame(words)))
      fault(
          fmt::format("its line {} sets a frame beside other words, or where unit, plane or G90 are not said",
                      line.number));
  }

  /// False where the words are not these alone, or depend on what is not said.
  bool set_frame(std::string_view words) {
    const std::string_view rest = words.substr(g68_ ? 3 : 6);
    if (!g68_) {
      const auto n = numbers_of(rest, claim_.solid ? "PXYZR" : "PXYR");
      if (n && (*n)[0] != static_cast<double>(claim_.work_offset)) fault(kTwoWays);
      if (!n || !shift({(*n)[1], (*n)[2]}, claim_.solid ? (*n)[3] : 0)) return false;
      turn(n->back());
      return true;
    }
    if (words.starts_with("G69")) {
      turned_ = false;
      return numbers_of(rest, "").has_value();
    }
    if (words.starts_with("G68")) {
      const auto n = numbers_of(rest, "XYR");
      if (!n || (*n)[0] != 0 || (*n)[1] != 0 || !level_ || !absolute_) return false;
      turn((*n)[2]);
      return true;
    }
    const auto n = numbers_of(rest, claim_.solid ? "XYZ" : "XY");
    if (n && framed_.shift && std::ranges::all_of(*n, [](double each) { return each == 0; })) {
      shifted_ = false;
      return true;
    }
    return n && absolute_ && shift({(*n)[0], (*n)[1]}, claim_.solid ? (*n)[2] : 0);
  }

  bool shift(Place by, double height) {
    if (framed_.shift) fault(kTwoWays);
    framed_.shift = unit_ * by, framed_.height = unit_ * height;
    shifted_ = true;
    return unit_ != 0;
  }

  void turn(double degrees) {
    if (!shifted_ || (framed_.degrees && framed_.degrees != degrees)) fault(kTwoWays);
    framed_.degrees = degrees;
    turned_ = true;
  }

  void fault(std::string sentence) {
    if (!framed_.fault) framed_.fault = std::move(sentence);
  }

  const ProgramClaim& claim_;
  bool g68_;
  NcLines lines_;
  Framed framed_;
  double unit_ = 0;  ///< mm; 0 before it is said
  bool level_ = false, absolute_ = false, turned_ = false, shifted_ = false;
};

class ProgramCheck {
 public:
  explicit ProgramCheck(const ProgramClaim& claim)
      : claim_(claim),
        original_(without_mark(claim.original)),
        written_(without_mark(claim.written)),
        exact_(map_of(claim)),
        rounding_(approximate(claim.rounding)) {}

  ProgramVerdict run() {
    if (claim_.mode == "coordinates") {
      const auto original = read(original_), written = read(written_);
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
  std::optional<NcProgram> read(const Document& program) {
    return kept(read_program(program, {.control = claim_.control,
                                       .judged = false,
                                       .allowed_m = claim_.allowed_m,
                                       .heights_apart = claim_.solid && claim_.mode == "coordinates"}));
  }

  template <class T>
  std::optional<T> kept(Result<T> found) {
    if (found) return *std::move(found);
    if (!verdict_.open) verdict_.open = found.error().message;
    return std::nullopt;
  }

  void compare(const NcProgram& original, const NcProgram& written, const Map& map) {
    limit_ =
        rounding_ + kReading * (largest_of(original.moves) + largest_of(written.moves) + std::abs(map.z));
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
    if (next < written.events.size())
      fault(fmt::format("its line {} does something that the original does not", written.events[next].line));
  }

  /// The written program has to say what the original says of its motions: else the control decides.
  void check_said(const NcEvent& event, const NcProgram& written, const NcEvent& other) {
    if (other.first_move == other.end_move) return;
    // Lines that stand for an arc of another plane need none.
    const bool turns = written.moves[other.first_move].arc;
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
    for (std::size_t k = 0; k < a.heights.size(); ++k)
      off_by(std::abs(a.heights[k] + map.z - b.heights[k]), b.line);
    if (!same_offset(a, b))
      return fault(fmt::format("its line {} runs in another work offset than the original", b.line));
    if (a.upright) return compare_upright(*a.upright, *b.upright, b.line, map);
    if (b.upright || a.end_move - a.first_move != b.end_move - b.first_move)
      return fault(fmt::format("its line {} makes other motions than the original", b.line));
    for (std::size_t k = 0; k < a.end_move - a.first_move; ++k)
      compare_move(original.moves[a.first_move + k], written.moves[b.first_move + k], map);
  }

  /// Lines that set a frame may select the offset that the result names where the original selects none.
  [[nodiscard]] bool same_offset(const NcEvent& a, const NcEvent& b) const {
    return a.offset == b.offset ||
           (a.offset == 0 && b.offset == named_offset() && claim_.mode != "coordinates");
  }
  [[nodiscard]] int named_offset() const {
    const auto number = static_cast<int>(claim_.work_offset);
    return number < 7 ? 530 + 10 * number : 584 + number;
  }

  void compare_move(const Move& a, const Move& b, const Map& map) {
    const bool alike =
        a.rapid == b.rapid && a.arc == b.arc && a.ccw == b.ccw && a.turns == b.turns &&
        (!a.arc || same_ends(a) == same_ends(b)) && same(a.feed, b.feed) &&
        (claim_.solid ? alike_in_height(a, b) : same(a.from_z, b.from_z) && same(a.to_z, b.to_z));
    if (!alike) return fault(fmt::format("its motion in line {} is another than the original's", b.line));
    double off = std::max(apart(map(a.from), b.from), apart(map(a.to), b.to));
    if (a.arc) off = std::max(off, apart(map(a.centre), b.centre));
    off_by(claim_.solid ? std::hypot(off, off_in_height(a, b, map)) : off, b.line);
  }

  /// A tool that cuts has to be at a height that the program says. Others may be anywhere, and their steps
  /// are words.
  static bool alike_in_height(const Move& a, const Move& b) {
    return a.to_z_said == b.to_z_said && (a.to_z_said || a.rapid);
  }
  static double off_in_height(const Move& a, const Move& b, const Map& map) {
    const double from = a.from_z_said ? std::abs(a.from_z + map.z - b.from_z) : 0;
    return a.to_z_said ? std::max(from, std::abs(a.to_z + map.z - b.to_z)) : from;
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
    return std::hypot(apart(map({a[0], a[1]}), {b[0], b[1]}), a[2] + map.z - b[2]);
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
    for (std::size_t k = 0; k < count; ++k) {
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
    const auto original = read(original_);
    const auto framed = kept(FrameReader(claim_).read(written_));
    const auto written = framed ? read({written_.name, framed->rest}) : std::nullopt;
    if (!original || !written) return;
    const bool any = framed->shift || framed->degrees;
    if (original->moves.empty() && !any) return compare(*original, *written, {});
    if (!framed->shift || !framed->degrees) return fault("it sets no frame");
    if (framed->fault) return fault(*framed->fault);
    compare(*original, *written, {});
    for (const NcEvent& event : written->events)
      for (std::size_t k = event.first_move; k < event.end_move; ++k)
        check_framed(event, written->moves[k], *framed);
    const Map map = map_of(framed->shift->x, framed->shift->y, *framed->degrees * kPi / 180);
    const double turned = std::hypot(map.cosine - exact_.cosine, map.sine - exact_.sine);
    for (const Move& move : original->moves) {
      const double radius =
          move.arc ? std::max(apart(move.from, move.centre), apart(move.to, move.centre)) : 0;
      double off = std::max(apart(exact_(move.from), map(move.from)), apart(exact_(move.to), map(move.to)));
      // Another direction moves a point of a circle by its radius more than the middle.
      if (move.arc) off = std::max(off, apart(exact_(move.centre), map(move.centre)) + turned * radius);
      off = std::hypot(off, framed->height - exact_.z);
      if (!(off <= limit_)) return fault(fmt::format("its frame puts line {} {:.3g} mm off", move.line, off));
    }
  }

  /// A rapid to the first place, whose beginning nobody knows, may come before the frame.
  void check_framed(const NcEvent& event, const Move& move, const Framed& framed) {
    const bool in_frame =
        framed.in_force[move.line - 1] && (claim_.mode == "g68" || event.offset == named_offset());
    if (!in_frame && !(move.rapid && same_ends(move)))
      fault(fmt::format("its line {} moves outside its frame", move.line));
  }

  const ProgramClaim& claim_;
  Document original_, written_;
  Map exact_;
  double rounding_, limit_ = 0;
  ProgramVerdict verdict_;
};

}  // namespace

ProgramVerdict check_moved_program(const ProgramClaim& claim) { return ProgramCheck(claim).run(); }

}  // namespace lekalo::verify
