#include "profile_moves.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "lekalo/base/double_of_text.hpp"
#include "verify/number/exact.hpp"

namespace lekalo::verify {
namespace {

/// The G and M words of profile programs in every dialect, in tenths. Those that stand for a mode which a
/// program keeps from its first line to its last are only read over.
constexpr std::array kModesPassedOver{170, 400, 490, 540, 610, 800, 900, 911, 940};

constexpr double kMostTools = 9999;

constexpr const char* kNothingCut = "before it the beam or tool goes into the material where nothing is cut";

/// The ends of an arc lie on one circle but for the rounding of its words, which have three decimals of a
/// millimetre or four of an inch: each of four places is off by half a step along both axes at most.
constexpr double kArcRounding = 5e-3, kArcRoundingOfInches = 7.5e-3;  // mm

struct Block {
  std::map<char, double> words;
  std::vector<int> g, m;  ///< tenths
  std::size_t line;
  [[nodiscard]] bool has(char letter) const { return words.contains(letter); }
};

class ProfileReader {
 public:
  ProfileReader(const Document& document, words::Control control)
      : name_(document.name), rest_(document.bytes), control_(control), unsaid_(control, "program") {}

  Result<ProfileProgram> read() {
    while (!rest_.empty()) {
      ++line_;
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      std::string_view text = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      if (text.ends_with('\r')) text.remove_suffix(1);
      Block block;
      block.line = line_;
      if (text == "%") tape_mark();
      if (text == "%" || !take_apart(text, block)) continue;
      if (ended_)
        complain("words after the end of the program");
      else
        act(block);
    }
    if (!ended_) complain("the program does not end with M2 or M30");
    if (on_) complain("the beam or spindle is on at the end");
    if (pierced_) complain(kNothingCut);
    if (!complaint_.empty()) return failure(ErrorCode::bad_input, fmt::format("{}:{}", name_, complaint_));
    return ProfileProgram{std::move(chains_), std::move(unsaid_)};
  }

 private:
  void complain(const std::string& what) {
    if (complaint_.empty()) complaint_ = fmt::format("{}: {}", line_, what);
  }

  /// A control reads from the first mark to the second.
  void tape_mark() {
    if (line_ == 1)
      marked_ = true;
    else if (!marked_ || !ended_)
      complain("% neither begins the program nor ends it");
  }

  /// Returns false for a line without words, and after a complaint.
  bool take_apart(std::string_view text, Block& block) {
    for (std::size_t at = 0; at < text.size();) {
      const char letter = text[at];
      if (letter == ' ') {
        ++at;
        continue;
      }
      if (letter == ';') break;
      if (letter == '(') {
        const std::size_t close = text.find(')', at);
        if (close == std::string_view::npos) return complain("a comment is not closed"), false;
        at = close + 1;
        continue;
      }
      const std::size_t end = std::min(text.find_first_not_of("+-.0123456789", at + 1), text.size());
      const std::optional<double> value = double_of_text(text.substr(at + 1, end - at - 1));
      at = end;
      if (!value || !keep(letter, *value, block)) {
        complain(fmt::format("lekalo writes no such word into a profile program: {}", excerpt(text)));
        return false;
      }
    }
    return !block.words.empty() || !block.g.empty() || !block.m.empty();
  }

  static bool keep(char letter, double value, Block& block) {
    if (letter == 'G' || letter == 'M') {
      const double tenths = value * 10;
      // Controls know no G-0.
      if (tenths != std::nearbyint(tenths) || std::signbit(value) || !(tenths < 1000)) return false;
      (letter == 'G' ? block.g : block.m).push_back(static_cast<int>(tenths));
      return true;
    }
    if (letter == 'T' || letter == 'H')
      return value == std::nearbyint(value) && value >= 1 && value <= kMostTools &&
             block.words.emplace(letter, value).second;
    return std::string_view("XYZIJFSPO").find(letter) != std::string_view::npos &&
           block.words.emplace(letter, value).second;
  }

  void act(const Block& block) {
    bool dwell = false, motion = block.has('X') || block.has('Y') || block.has('Z');
    for (const int code : block.g) {
      if (code <= 30 && code % 10 == 0) {
        motion_ = code;
        motion = true;
      } else if (code == 200 || code == 210) {
        if (known_x_ || known_y_) complain("the unit changes on the way");
        scale_ = code == 200 ? 25.4 : 1;
        said_.take(*words::word_at('G', code, words::Control::linuxcnc));
      } else if (code == 40) {
        dwell = true;
      } else if (code == 430) {
        take_length(block);
      } else if (std::find(kModesPassedOver.begin(), kModesPassedOver.end(), code) !=
                 kModesPassedOver.end()) {
        if (code == 490 && tool_ != 0) complain("the length of the tool is dropped");
        said_.take(*words::word_at('G', code, words::Control::linuxcnc));
      } else {
        complain(fmt::format("lekalo writes no G{:g} into a profile program", 0.1 * code));
      }
    }
    for (const int code : block.m) {
      if (code == 60)
        change_tool(block);
      else
        switch_by(code);
    }
    if (block.has('T') != is_among(60, block.m) || block.has('H') != is_among(430, block.g))
      complain("a tool or its length without M6 or G43, or these without a number");
    if (block.has('P') != dwell) complain("a wait without its time, or a time without a wait");
    if (block.has('O') && (block.words.size() > 1 || !block.g.empty() || line_ > 2))
      complain("a number of a program where none is");
    // LinuxCNC reads no such number: the program is another control's, with that one's modes.
    if (block.has('O') && control_ == words::Control::linuxcnc)
      unsaid_ = UnsaidModes(words::Control::fanuc, "program");
    if (dwell && motion) complain("a wait beside a motion");
    if (motion) move(block);
  }

  static bool is_among(int code, const std::vector<int>& codes) {
    return std::find(codes.begin(), codes.end(), code) != codes.end();
  }

  /// A change of tools leaves the axes where the machine wants them.
  void change_tool(const Block& block) {
    if (on_) complain("a tool is changed while the spindle turns");
    if (block.has('T')) tool_ = static_cast<int>(block.words.at('T'));
    known_x_ = known_y_ = going_on_ = false;
    z_.reset();
    due_ = Due::length;
  }

  void take_length(const Block& block) {
    if (due_ != Due::length || (block.has('H') && block.words.at('H') != tool_))
      complain("the length is not that of a tool that was changed to right before");
    said_.take(*words::word_at('G', 430, words::Control::linuxcnc));
    due_ = Due::lift;
  }

  void switch_by(int code) {
    if (code == 30 || code == 40) {
      // One program has one word for it; a spindle that goes down turns clockwise.
      if ((on_by_ != 0 && on_by_ != code) || (z_ && code == 40)) return complain("M4 where M3 is meant");
      on_by_ = code;
      on_ = true;
      if (!z_ || *z_ < 0) pierced_ = at_;
    } else if (code == 50)
      on_ = false;
    else if (code == 20 || code == 300)
      ended_ = true;
    else
      return complain(fmt::format("lekalo writes no M{:g} into a profile program", 0.1 * code));
    going_on_ = false;
  }

  void move(const Block& block) {
    if (scale_ == 0) return complain("a motion before G20 or G21");
    if (motion_ < 0) return complain("a motion without G0, G1, G2 or G3");
    const auto word = [&](char letter, double otherwise) {
      const auto found = block.words.find(letter);
      return found == block.words.end() ? otherwise : scale_ * found->second;
    };
    unsaid_.look(block.line, said_, {.with_feed = true, .arcs = true});
    const bool arc = motion_ >= 20;
    if (arc != (block.has('I') && block.has('J')) || (!arc && (block.has('I') || block.has('J'))))
      return complain("an arc without I and J, or these without an arc");
    const Place from = at_, to{word('X', at_.x), word('Y', at_.y)};
    const bool flat = block.has('X') || block.has('Y'), was_known = known_x_ && known_y_;
    if (flat && block.has('Z')) return complain("a motion in X or Y and Z at once");
    if (due_ == Due::length || (due_ == Due::lift && flat))
      return complain("a changed tool moves before its length is taken and it is lifted");
    due_ = Due::nothing;
    known_x_ = known_x_ || block.has('X'), known_y_ = known_y_ || block.has('Y');
    if (block.has('Z')) z_ = scale_ * block.words.at('Z');
    const bool cuts = on_ && (!z_ || *z_ < 0);
    at_ = to;
    if (!flat) {
      if (cuts && motion_ == 0) complain("a rapid motion down into the material");
      if (cuts) pierced_ = at_;
      going_on_ = false;
      return;
    }
    if (!on_ && z_ && *z_ < 0) complain("a tool that stands still goes through the material");
    if (!cuts) {
      if (pierced_ && (to.x != pierced_->x || to.y != pierced_->y)) complain(kNothingCut);
      going_on_ = false;
      return;
    }
    pierced_.reset();
    if (!was_known) return complain("a cut from a place that is not known");
    const Place centre = from + Place{word('I', 0), word('J', 0)};
    const double unequal = std::abs(length(from - centre) - length(to - centre));
    if (arc && !(unequal <= (scale_ > 1 ? kArcRoundingOfInches : kArcRounding) && length(from - centre) > 0))
      return complain("an arc whose ends do not lie on one circle");
    if (arc && from.x == to.x && from.y == to.y) return complain("an arc of a whole turn");
    if (!going_on_) chains_.push_back({{}, line_, false, z_ ? -*z_ : 0, tool_});
    going_on_ = true;
    CutChain& chain = chains_.back();
    chain.rapid = chain.rapid || motion_ == 0;
    Stroke edge{arc, motion_ == 30, from, to, centre, 0};
    edge.radius = 0.5 * (length(from - centre) + length(to - centre));
    chain.edges.push_back(edge);
  }

  const std::string& name_;
  std::string_view rest_;
  std::string complaint_;
  std::size_t line_ = 0;
  SaidGroups said_;
  words::Control control_;
  UnsaidModes unsaid_;
  double scale_ = 0;
  std::optional<double> z_;  ///< once an axis Z has been named
  /// The place where the beam came on, or the tool went down, and has cut nothing yet.
  std::optional<Place> pierced_;
  enum class Due { nothing, length, lift };
  Due due_ = Due::nothing;  ///< what has to come next, after a tool was changed
  int tool_ = 0;
  int motion_ = -1, on_by_ = 0;
  bool marked_ = false, on_ = false, ended_ = false, known_x_ = false, known_y_ = false, going_on_ = false;
  Place at_;
  std::vector<CutChain> chains_;
};

}  // namespace

Result<ProfileProgram> read_profile(const Document& program, words::Control control) {
  return ProfileReader(program, control).read();
}

}  // namespace lekalo::verify
