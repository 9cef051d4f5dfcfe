#include "nc_moves.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include "lekalo/base/double_of_text.hpp"
#include "lekalo/base/limits.hpp"
#include "nc_words.hpp"

namespace lekalo::verify {
namespace {

constexpr double kFarthest = limits::kLargestProgramCoordinate;  // mm
/// The radii at the two ends of an arc may differ by this much.
constexpr double kCircleTolerance = 5e-3;  // mm
/// LinuxCNC refuses arcs of a smaller radius, and arcs by R whose ends are further apart than the diameter
/// and twice this.
constexpr double kRadiusTolerance = 5e-5 * 25.4;  // mm
/// LinuxCNC takes an arc by R for a half circle from this half chord over the radius on.
constexpr double kHalfCircle = 1 - 1e-12;
/// LinuxCNC takes ends closer than 1e-6 rad, seen from the centre, for one point, and the arc for a full
/// turn.
constexpr double kSmallestSweep = 2e-6;
/// LinuxCNC reads no longer lines, and no more M words in one. More digits of N than these fit no integer.
constexpr std::size_t kLongestLine = 252, kMostMWords = 4, kMostDigitsOfN = 9;

struct Block {
  std::size_t line = 0;
  std::vector<const Code*> codes;
  std::array<std::optional<double>, 26> words;
  [[nodiscard]] std::optional<double> operator[](char letter) const {
    return words[static_cast<std::size_t>(letter - 'A')];
  }
  [[nodiscard]] const Code* code(Group group) const {
    for (const Code* each : codes)
      if (each->group == group) return each;
    return nullptr;
  }
  [[nodiscard]] bool has_axis() const { return (*this)['X'] || (*this)['Y'] || (*this)['Z']; }
  [[nodiscard]] bool empty() const {
    return codes.empty() && std::ranges::none_of(words, [](const auto& word) { return word.has_value(); });
  }
};

bool is_arc(const Code* code) {
  return code != nullptr && (code->tenths == kClockwise || code->tenths == kCounterClockwise);
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_count(double value) { return value >= 0 && value == std::floor(value); }

/// LinuxCNC runs some comments. Those that run code, open files or end the program are not understood.
bool acts(std::string_view comment) {
  const std::size_t comma = comment.find(',');
  if (comma == std::string_view::npos) return false;
  std::string keyword;
  for (const char c : comment.substr(0, comma))
    if (c != ' ' && c != '\t') keyword += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  constexpr std::array<std::string_view, 8> kActing{"PY",         "PYTHON",  "ABORT",     "PROBEOPEN",
                                                    "PROBECLOSE", "LOGOPEN", "LOGAPPEND", "LOGCLOSE"};
  return std::ranges::find(kActing, keyword) != kActing.end();
}

class ProgramReader {
 public:
  ProgramReader(const Document& program, double top) : program_(program), top_(top) {}

  Result<std::vector<Move>> read() {
    std::string_view rest = program_.bytes;
    for (std::size_t line = 1; !rest.empty() && complaint_.empty(); ++line) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      line_ = line;
      read_line(rest.substr(0, end));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    if (!complaint_.empty())
      return failure(ErrorCode::bad_input, fmt::format("{}:{}: {}", program_.name, line_, complaint_));
    return std::move(moves_);
  }

 private:
  bool complain(const std::string& sentence) {
    if (complaint_.empty()) complaint_ = sentence;
    return false;
  }

  void read_line(std::string_view text) {
    if (text.size() > kLongestLine)
      return void(complain(fmt::format("the line is longer than {} bytes", kLongestLine)));
    if (text.ends_with('\r')) text.remove_suffix(1);
    for (const char c : text) {
      if (c == '\r') return void(complain("a carriage return inside a line; line ends are LF or CR LF"));
      if ((static_cast<unsigned char>(c) < ' ' && c != '\t') || c == 127)
        return void(complain("a control character inside a line"));
    }
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return;
    if (text[first] == '%') return tape_mark(text.substr(first));
    Block block;
    block.line = line_;
    if (take_apart(text, block) && !block.empty()) {
      if (ended_) return void(complain("words after the end of the program"));
      act(block);
      any_words_ = true;
    }
    any_text_ = true;
  }

  /// As LinuxCNC has it, a program that begins with % ends at the next one.
  void tape_mark(std::string_view text) {
    if (text.find_last_not_of(" \t") != 0) return void(complain("% does not stand alone on its line"));
    if (any_text_ && !begun_by_mark_) return void(complain("% after a beginning without %"));
    if (any_text_) ended_ = true;
    begun_by_mark_ = any_text_ = true;
  }

  bool take_apart(std::string_view text, Block& block) {
    std::size_t at = 0;
    const auto skip_blanks = [&] {
      while (at < text.size() && (text[at] == ' ' || text[at] == '\t')) ++at;
    };
    for (skip_blanks(); at < text.size(); skip_blanks()) {
      const char c = text[at];
      if (c == ';') return take_comment(text.substr(at + 1));
      if (c == '/') return complain("a block that may be skipped is not understood; take out the /");
      if (c == '(') {
        const std::size_t close = text.find(')', at);
        if (close == std::string_view::npos) return complain("a comment is not closed");
        if (text.substr(at + 1, close - at - 1).find('(') != std::string_view::npos)
          return complain("a comment inside a comment");
        if (!take_comment(text.substr(at + 1, close - at - 1))) return false;
        at = close + 1;
        continue;
      }
      const char letter = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
      if (letter < 'A' || letter > 'Z')
        return complain(fmt::format("the character {:?} is not understood", std::string_view(&text[at], 1)));
      ++at;
      skip_blanks();
      const std::size_t begin = at;
      while (at < text.size() &&
             (is_digit(text[at]) || text[at] == '.' || text[at] == '-' || text[at] == '+'))
        ++at;
      std::string_view digits = text.substr(begin, at - begin);
      if (letter == 'N' || letter == 'O') {
        if (!take_name(letter, digits, block)) return false;
        continue;
      }
      if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
      const std::optional<double> value = double_of_text(digits);
      if (!value) return complain(fmt::format("{} is not followed by a plain number", letter));
      if (!keep(letter, *value, block)) return false;
    }
    return true;
  }

  bool take_comment(std::string_view text) {
    return !acts(text) || complain("a comment that acts on the control is not understood");
  }

  /// N names a block and O a program, and neither does anything. O words at other places call or branch.
  bool take_name(char letter, std::string_view digits, Block& block) {
    if (digits.empty() || !std::ranges::all_of(digits, is_digit))
      return complain(fmt::format("{} is not followed by a plain number", letter));
    if (!block.empty()) return complain(fmt::format("{} does not begin its block", letter));
    if (letter == 'N' && digits.size() > kMostDigitsOfN)
      return complain(fmt::format("N has more than {} digits", kMostDigitsOfN));
    if (letter == 'O' && any_words_) return complain("subprograms are not understood");
    block.words[static_cast<std::size_t>(letter - 'A')] = 0;
    return true;
  }

  bool keep(char letter, double value, Block& block) {
    if (block['O']) return complain("words beside the number of the program");
    if (letter == 'G' || letter == 'M') {
      const Code* code = code_of(letter, value);
      if (code == nullptr) return complain(fmt::format("{}{:g} is not understood here", letter, value));
      if (const Code* other = block.code(code->group))
        return complain(fmt::format("{} and {} exclude each other", name_of(*other), name_of(*code)));
      block.codes.push_back(code);
      return true;
    }
    std::optional<double>& word = block.words[static_cast<std::size_t>(letter - 'A')];
    if (word) return complain(fmt::format("{} is given twice", letter));
    if (kTakenLetters.find(letter) == std::string_view::npos &&
        kFreeLetters.find(letter) == std::string_view::npos)
      return complain(fmt::format("the word {} is not understood", letter));
    word = value;
    return true;
  }

  /// Refuses blocks whose words do not fit together.
  bool fits(const Block& block) {
    const Code* motion = block.code(Group::motion);
    if (block.code(Group::dwell) != nullptr && (motion != nullptr || block.has_axis()))
      return complain("a dwell beside a motion; give it a block of its own");
    for (const char letter : kTakenLetters) {
      if (!block[letter]) continue;
      auto takers = std::ranges::count_if(
          block.codes, [&](const Code* code) { return code->takes.find(letter) != std::string_view::npos; });
      if (motion == nullptr && block.has_axis() && motion_ != nullptr &&
          motion_->takes.find(letter) != std::string_view::npos)
        ++takers;
      const bool axis = letter == 'X' || letter == 'Y' || letter == 'Z';
      if (takers == 0)
        return complain(axis ? "a motion before any of G0, G1, G2, G3"
                             : fmt::format("no word of the block takes {}", letter));
      if (takers > 1) return complain(fmt::format("two words of the block take {}", letter));
    }
    for (const Group group : {Group::dwell, Group::output})
      if (const Code* code = block.code(group); code != nullptr && !block['P'])
        return complain(fmt::format("{} without P", name_of(*code)));
    if (std::ranges::count(block.codes, 'M', &Code::letter) > static_cast<std::ptrdiff_t>(kMostMWords))
      return complain(fmt::format("more than {} M words in a block", kMostMWords));
    for (const char letter : {'P', 'Q', 'S'})
      if (block[letter] && !(*block[letter] >= 0)) return complain(fmt::format("{} is below 0", letter));
    for (const char letter : {'T', 'H'})
      if (block[letter] && !is_count(*block[letter]))
        return complain(fmt::format("{} is not a whole number from 0 on", letter));
    if (block.code(Group::output) != nullptr && !is_count(*block['P']))
      return complain("P is not a whole number from 0 on");
    return true;
  }

  /// The words act in LinuxCNC's order, wherever they stand in the block.
  void act(const Block& block) {
    if (!fits(block)) return;
    if (block.code(Group::feed_mode) != nullptr) feed_ = 0;  // G94 takes back the F before it
    const Code* unit = block.code(Group::unit);
    const double new_unit = unit == nullptr ? unit_ : unit->tenths == 200 ? 25.4 : 1;
    if (block['F']) {
      if (!(*block['F'] > 0)) return void(complain("a feed that is not above 0"));
      if (new_unit != unit_)
        return void(complain("a feed beside a change of its unit; give it a block of its own"));
      feed_ = *block['F'] * unit_;
    }
    unit_ = new_unit;
    if (!change_tool(block) || !change_offsets(block)) return;
    if (const Code* code = block.code(Group::distance)) incremental_ = code->tenths == 910;
    if (const Code* code = block.code(Group::centre)) absolute_centre_ = code->tenths == 901;
    if (const Code* code = block.code(Group::motion)) motion_ = code;
    if (block.has_axis() || is_arc(block.code(Group::motion))) move(block);
    if (const Code* code = block.code(Group::stop)) ended_ = code->tenths == 20 || code->tenths == 300;
  }

  /// The report is of one tool. Nobody knows where it stands after a change.
  bool change_tool(const Block& block) {
    const bool changes = block.code(Group::tool_change) != nullptr;
    if ((changes || block['T']) && has_cut_) return complain("a change of the tool after the first cut");
    if (changes) known_ = {};
    return true;
  }

  /// Offsets move what the words for axes mean.
  bool change_offsets(const Block& block) {
    const Code* work = block.code(Group::work_offset);
    const Code* length = block.code(Group::tool_length);
    const bool other_work = work != nullptr && work != work_offset_;
    const bool other_length = length != nullptr && (length != tool_length_ || block['H'] != tool_length_of_);
    if ((other_work || other_length) && known_[0] && known_[1] && known_[2])
      return complain(fmt::format("{} after the first motion changes where the program's places are",
                                  name_of(other_work ? *work : *length)));
    if (other_work) known_ = {};
    if (other_length) known_[2] = false;
    if (work != nullptr) work_offset_ = work;
    if (length != nullptr) tool_length_ = length, tool_length_of_ = block['H'];
    return true;
  }

  void move(const Block& block) {
    std::array<double, 3> to = at_;
    const std::array<char, 3> axes{'X', 'Y', 'Z'};
    const bool were_known = known_[0] && known_[1] && known_[2];
    for (std::size_t i = 0; i < 3; ++i) {
      const auto word = block[axes[i]];
      if (!word) continue;
      if (incremental_ && !known_[i])
        return void(complain(fmt::format("a step of {} from a place that no block has said", axes[i])));
      to[i] = *word * unit_ + (incremental_ ? at_[i] : 0);
      known_[i] = true;
      if (!(std::abs(to[i]) <= kFarthest))
        return void(complain(fmt::format("{} is farther than {} mm from the origin", axes[i], kFarthest)));
    }
    const std::array<double, 3> from = std::exchange(at_, to);
    const bool rapid = motion_->tenths == kRapid;
    if (!rapid && !(feed_ > 0)) return void(complain("a motion with feed before any F"));
    if (!were_known) return arrive(rapid);
    Move move{rapid,
              is_arc(motion_),
              motion_->tenths == kCounterClockwise,
              {from[0], from[1]},
              {to[0], to[1]},
              {},
              from[2],
              to[2],
              1,
              rapid ? 0 : feed_,
              block.line};
    if (move.arc && !find_centre(block, move)) return;
    if (!move.arc && from == to) return;
    has_cut_ = has_cut_ || !rapid || std::min(move.from_z, move.to_z) < top_;
    moves_.push_back(move);
  }

  /// Nobody sees what a motion from an unknown place cuts, so it may only be one that cuts nothing.
  void arrive(bool rapid) {
    if (!rapid)
      complain(is_arc(motion_) ? "an arc from a place that no block has said"
                               : "a motion with feed from a place that no block has said");
    else if (known_[2] && at_[2] < top_)
      complain(fmt::format("G0 below Z {:g} from a place that no block has said", top_));
  }

  bool find_centre(const Block& block, Move& move) {
    const auto i = block['I'], j = block['J'], r = block['R'], p = block['P'];
    if (p) {
      if (!(*p >= 1 && *p <= 10000 && *p == std::floor(*p)))
        return complain("P of an arc is not a number of turns");
      move.turns = static_cast<int>(*p);
    }
    if (r) {
      if (i || j) return complain("an arc with a radius and a centre");
      return centre_of_radius(*r * unit_, move);
    }
    if (!i && !j) return complain("an arc without I, J or R");
    if (absolute_centre_ && !(i && j)) return complain("an absolute centre needs both I and J");
    const Place given{i.value_or(0) * unit_, j.value_or(0) * unit_};
    move.centre = absolute_centre_ ? given : move.from + given;
    const double a = length(move.from - move.centre), b = length(move.to - move.centre);
    if (!(a >= kRadiusTolerance && b >= kRadiusTolerance && std::abs(a - b) <= kCircleTolerance &&
          a <= kFarthest))
      return complain(fmt::format("the arc's ends are {:.6g} and {:.6g} mm from its centre", a, b));
    return turns_clearly(move);
  }

  bool centre_of_radius(double r, Move& move) {
    const Place chord = move.to - move.from;
    const double half = length(chord) / 2;
    if (!(half > 0)) return complain("an arc given by R ends where it begins");
    if (!(std::abs(r) <= kFarthest && half <= std::abs(r) + kRadiusTolerance))
      return complain(
          fmt::format("no arc of radius {:.6g} joins ends {:.6g} mm apart", std::abs(r), 2 * half));
    const bool half_circle = half > kHalfCircle * std::abs(r);
    const double up = half_circle ? 0 : std::sqrt(std::max(0.0, r * r - half * half));
    const double side = (move.ccw ? 1 : -1) * (r > 0 ? 1 : -1);
    move.centre = 0.5 * (move.from + move.to) + (side * up / (2 * half)) * left_of(chord);
    return turns_clearly(move);
  }

  /// Between ends that differ and can hardly be told apart from the centre, one control runs a full turn and
  /// another none.
  bool turns_clearly(const Move& move) {
    const bool full = move.from.x == move.to.x && move.from.y == move.to.y;
    return full ||
           std::abs(angle_between(move.from - move.centre, move.to - move.centre)) >= kSmallestSweep ||
           complain("an arc of nearly no turn or a full one; give a full turn the same end as start");
  }

  const Document& program_;
  double top_;
  std::vector<Move> moves_;
  std::string complaint_;
  std::array<double, 3> at_{};
  std::array<bool, 3> known_{};
  double unit_ = 1, feed_ = 0;
  const Code *motion_ = nullptr, *work_offset_ = nullptr, *tool_length_ = nullptr;
  std::optional<double> tool_length_of_;
  bool incremental_ = false, absolute_centre_ = false, has_cut_ = false;
  bool any_text_ = false, any_words_ = false, begun_by_mark_ = false, ended_ = false;
  std::size_t line_ = 0;
};

}  // namespace

Result<std::vector<Move>> read_moves(const Document& program, double top) {
  return ProgramReader(program, top).read();
}

}  // namespace lekalo::verify
