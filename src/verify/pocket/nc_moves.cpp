#include "nc_moves.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include "lekalo/base/double_of_text.hpp"
#include "lekalo/base/limits.hpp"

namespace lekalo::verify {
namespace {

constexpr double kFarthest = limits::kLargestProgramCoordinate;  // mm
/// The radii at the two ends of an arc may differ by this much.
constexpr double kCircleTolerance = 5e-3;  // mm

struct Block {
  std::size_t line = 0;
  std::vector<double> g;
  std::array<std::optional<double>, 26> words;
  [[nodiscard]] std::optional<double> operator[](char letter) const {
    return words[static_cast<std::size_t>(letter - 'A')];
  }
};

class ProgramReader {
 public:
  explicit ProgramReader(const Document& program) : program_(program) {}

  Result<std::vector<Move>> read() {
    std::string_view rest = program_.bytes;
    for (std::size_t line = 1; !rest.empty() && !ended_ && complaint_.empty(); ++line) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      Block block;
      block.line = line_ = line;
      if (take_apart(rest.substr(0, end), block)) act(block);
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

  bool take_apart(std::string_view text, Block& block) {
    std::size_t at = 0;
    const auto skip_blanks = [&] {
      while (at < text.size() && (text[at] == ' ' || text[at] == '\t' || text[at] == '\r')) ++at;
    };
    for (skip_blanks(); at < text.size(); skip_blanks()) {
      const char c = text[at];
      if (c == '%' || c == ';') return true;
      if (c == '/') return complain("a block that may be skipped is not understood; take out the /");
      if (c == '(') {
        const std::size_t close = text.find(')', at);
        if (close == std::string_view::npos) return complain("a comment is not closed");
        at = close + 1;
        continue;
      }
      const char letter = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
      if (letter < 'A' || letter > 'Z')
        return complain(fmt::format("the character {:?} is not understood", std::string_view(&text[at], 1)));
      ++at;
      skip_blanks();
      const std::size_t begin = at;
      while (at < text.size() && (std::isdigit(static_cast<unsigned char>(text[at])) != 0 ||
                                  text[at] == '.' || text[at] == '-' || text[at] == '+'))
        ++at;
      std::string_view digits = text.substr(begin, at - begin);
      if (!digits.empty() && digits[0] == '+') digits.remove_prefix(1);
      const std::optional<double> value = double_of_text(digits);
      if (!value) return complain(fmt::format("{} is not followed by a plain number", letter));
      if (!keep(letter, *value, block)) return false;
    }
    return true;
  }

  bool keep(char letter, double value, Block& block) {
    if (letter == 'G') {
      block.g.push_back(value);
      return true;
    }
    if (letter == 'M') {
      if (value == 2 || value == 30) ended_ = true;
      if (value == 98 || value == 99) return complain("subprograms are not understood");
      return true;
    }
    if (letter == 'O' || letter == 'N' || letter == 'S' || letter == 'T' || letter == 'H' || letter == 'D' ||
        letter == 'Q')
      return true;
    std::optional<double>& word = block.words[static_cast<std::size_t>(letter - 'A')];
    if (word) return complain(fmt::format("{} is given twice", letter));
    constexpr std::string_view kKnown = "FIJPRXYZ";
    if (kKnown.find(letter) == std::string_view::npos)
      return complain(fmt::format("the word {} is not understood", letter));
    word = value;
    return true;
  }

  void act(const Block& block) {
    bool dwell = false;
    for (const double g : block.g) {
      if (g == 0 || g == 1 || g == 2 || g == 3)
        mode_ = static_cast<int>(g);
      else if (g == 20 || g == 21)
        unit_ = g == 20 ? 25.4 : 1;
      else if (g == 90 || g == 91)
        incremental_ = g == 91;
      else if (g == 90.1 || g == 91.1)
        absolute_centre_ = g == 90.1;
      else if (g == 4)
        dwell = true;
      else if (g == 94 || g == 17 || g == 40 || g == 43 || g == 49 || g == 80 || g == 61 || g == 64 ||
               g == 8 || g == 98 || g == 99 || g == 50 || g == 69 || (g >= 54 && g <= 59))
        continue;
      else
        return void(complain(fmt::format("G{:g} is not understood here", g)));
    }
    if (block['F']) {
      if (!(*block['F'] > 0)) return void(complain("a feed that is not above 0"));
      feed_ = *block['F'] * unit_;
    }
    if (dwell) return;
    if (block['X'] || block['Y'] || block['Z'] || block['I'] || block['J']) move(block);
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
    if (mode_ < 0) return void(complain("a motion before any of G0, G1, G2, G3"));
    if (mode_ != 0 && !(feed_ > 0)) return void(complain("a motion with feed before any F"));
    if (!were_known) {
      if (mode_ > 1) complain("an arc from a place that no block has said");
      return;
    }
    Move move{mode_ == 0, mode_ > 1, mode_ == 3, {from[0], from[1]},     {to[0], to[1]}, {},
              from[2],    to[2],     1,          mode_ == 0 ? 0 : feed_, block.line};
    if (move.arc && !find_centre(block, move)) return;
    if (move.arc || from != to) moves_.push_back(move);
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
    if (!(a > 0 && b > 0 && std::abs(a - b) <= kCircleTolerance && a <= kFarthest))
      return complain(fmt::format("the arc's ends are {:.6g} and {:.6g} mm from its centre", a, b));
    return true;
  }

  bool centre_of_radius(double r, Move& move) {
    const Place chord = move.to - move.from;
    const double half = length(chord) / 2;
    if (!(half > 0)) return complain("an arc given by R ends where it begins");
    if (!(std::abs(r) <= kFarthest && half <= std::abs(r) + kCircleTolerance))
      return complain(
          fmt::format("no arc of radius {:.6g} joins ends {:.6g} mm apart", std::abs(r), 2 * half));
    const double up = std::sqrt(std::max(0.0, r * r - half * half));
    const double side = (move.ccw ? 1 : -1) * (r > 0 ? 1 : -1);
    move.centre = 0.5 * (move.from + move.to) + (side * up / (2 * half)) * left_of(chord);
    return true;
  }

  const Document& program_;
  std::vector<Move> moves_;
  std::string complaint_;
  std::array<double, 3> at_{};
  std::array<bool, 3> known_{};
  double unit_ = 1, feed_ = 0;
  int mode_ = -1;
  bool incremental_ = false, absolute_centre_ = false, ended_ = false;
  std::size_t line_ = 0;
};

}  // namespace

Result<std::vector<Move>> read_moves(const Document& program) { return ProgramReader(program).read(); }

}  // namespace lekalo::verify
