#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>
#include <set>
#include <sstream>

#include "e2e/lies.hpp"
#include "lekalo/base/random.hpp"
#include "support/cases.hpp"

/// Every field and every input of what lekalo writes is changed in turn, and `lekalo verify` has to notice.
/// The oracle of a kind says which changes leave every claim true: those of information, those within the
/// decimals that docs/formats.md allows, and those after which another part of the program, which shares
/// nothing with the checker, finds the same. LEKALO_CASES changes of each kind are drawn; 100000 are all of
/// them.
namespace lekalo::test {
namespace {

using Oracle = std::function<bool(const Lie&)>;

class VerifyLies : public testing::Test {
 protected:
  void keep(const Words& words, const std::string& file = "") const {
    const Ran ran = run(folder_.path(), words);
    ASSERT_EQ(ran.status, 0) << ran.err;
    if (!file.empty()) write_bytes(folder_ / file, ran.out);
  }

  /// Tells one change after the other about `file`, and restores it. Changes of information, and those that
  /// leave the very document, have to be confirmed or refused for their form; of all others at most a tenth
  /// may be harmless. \param information  the change is of a field that is no claim, or of none; it may run
  /// the program \param harmless  the oracle: the change leaves every claim true; it may run the program
  void tell(const std::string& file, const std::vector<Lie>& all, const Words& verify,
            const Oracle& information, const Oracle& harmless) const {
    const std::string before = read_bytes(folder_ / file);
    ASSERT_EQ(run(folder_.path(), verify).status, 0);
    std::vector<std::size_t> order(all.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    Random random(cases::seed());
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    order.resize(std::min(order.size(), cases::case_count(40)));
    std::size_t told = 0, let_pass = 0;
    for (const std::size_t i : order) {
      const std::string changed = all[i].bytes();
      if (changed == before) continue;
      write_bytes(folder_ / file, changed);
      const Ran ran = run(folder_.path(), verify);
      const std::string what =
          file + all[i].path + " " + all[i].how + ": " + std::to_string(ran.status) + "\n" + ran.err;
      if (ran.status == 1 || ran.status == 3 || ran.status == 4) {
        ++told;
        continue;
      }
      ASSERT_EQ(ran.status, 0) << what;
      if (information(all[i])) continue;
      ++told;
      ++let_pass;
      EXPECT_TRUE(harmless(all[i])) << what;
    }
    write_bytes(folder_ / file, before);
    std::cout << file << ": " << told << " lies told, " << let_pass << " of them harmless and confirmed\n";
    if (told >= 200) {
      EXPECT_LE(static_cast<double>(let_pass), 0.1 * static_cast<double>(told)) << file;
    }
  }

  /// Every file that is used is exchanged for another, and taken away.
  void exchange(const std::vector<std::string>& files, const Words& verify) const {
    for (const std::string& file : files) {
      const std::string before = read_bytes(folder_ / file);
      for (const std::string& other : {before + "\n", std::string("{}"), std::string()}) {
        write_bytes(folder_ / file, other);
        const int status = run(folder_.path(), verify).status;
        EXPECT_TRUE(status == 3 || status == 4) << file << ": " << status;
      }
      fs::remove(folder_ / file);
      EXPECT_EQ(run(folder_.path(), verify).status, 3) << file;
      write_bytes(folder_ / file, before);
    }
  }

  void nest() const {
    write_bytes(folder_ / "given.json",
                read_bytes(fs::path(cases::source_dir()) / "examples/orders/frames.json"));
    keep({"nest", "given.json", "--work", "3000", "--threads", "1", "-o", "nested.json", "--json"},
         "report.json");
  }

  void pocket() const {
    write_bytes(
        folder_ / "pocket.json",
        R"({"outer": [{"line": {"from": [0, 0], "to": [40, 0]}}, {"line": {"from": [40, 0], "to": [40, 24]}},
                {"line": {"from": [40, 24], "to": [0, 24]}}, {"line": {"from": [0, 24], "to": [0, 0]}}]})");
    keep({"pocket", "pocket.json", "--tool", "10", "--depth", "2", "-o", "p.ngc", "--json"}, "pocketed.json");
    keep({"simulate", "p.ngc", "--pocket", "pocket.json", "--tool", "10", "--json"}, "simulated.json");
  }
  TemporaryFolder folder_;
};

bool begins(const Lie& lie, std::initializer_list<const char*> paths) {
  return std::any_of(paths.begin(), paths.end(),
                     [&](const char* path) { return lie.path.starts_with(path); });
}
bool is_last_place(const Lie& lie) { return lie.how == std::string("last place"); }

/// One step of the layout's grid: what a layout counts by.
double next_step(double value) { return value + 0x1p-20; }

const Oracle kNever = [](const Lie&) { return false; };

TEST_F(VerifyLies, OfALayoutAreNoticed) {
  nest();
  const auto document = [&] {
    return run(folder_.path(), {"export", "nested.json", "--format", "layout"}).out;
  };
  const std::string before = document();
  tell(
      "nested.json", lies_of_json(read_bytes(folder_ / "nested.json"), next_step),
      {"verify", "nested.json", "--layout", "given.json"},
      [&](const Lie& lie) {
        return lie.path.ends_with("/name") || lie.path == "/next_id" || document() == before;
      },
      [&](const Lie& lie) {
        // A placement may be called and lie as it likes while no rule is broken.
        return lie.path.starts_with("/placements") &&
               run(folder_.path(), {"check", "nested.json"}).status == 0;
      });
}

TEST_F(VerifyLies, OfAReportOfNestAreNoticed) {
  nest();
  const Words verify{"verify", "report.json"};
  tell(
      "report.json", lies_of_json(read_bytes(folder_ / "report.json")), verify,
      [](const Lie& lie) {
        return begins(lie, {"/seed", "/work", "/version", "/run", "/warnings", "/merges"});
      },
      [](const Lie& lie) {
        // A remnant that is moved by the last place of a double is on no step of the grid, but where it is 0.
        return lie.path.ends_with("/density") && is_last_place(lie);
      });
  exchange({"nested.json", "given.json"}, verify);
}

TEST_F(VerifyLies, OfAReportOfCheckAreNoticed) {
  nest();
  keep({"check", "nested.json", "--json"}, "check.json");
  const Words verify{"verify", "check.json"};
  tell(
      "check.json", lies_of_json(read_bytes(folder_ / "check.json")), verify,
      [](const Lie& lie) {
        return begins(lie, {"/seed", "/work", "/version", "/run", "/warnings", "/checked_by"});
      },
      kNever);
  exchange({"nested.json"}, verify);
}

const Oracle kVersion = [](const Lie& lie) { return lie.path == "/version"; };

/// The last place of an option may be lost in the rounding of every figure that is made with it; the depth is
/// compared within the program's decimals, regions within the rounding of their reading, and a list of no
/// holes may be left out.
const Oracle kOption = [](const Lie& lie) {
  if (lie.path == "/regions/holes") return lie.how == std::string("deleted");
  return is_last_place(lie) &&
         begins(lie, {"/tool_mm", "/stock_to_leave_mm", "/step_over", "/top_mm", "/acceleration_mm_per_s2",
                      "/rapid_mm_per_min", "/depth_mm", "/floor_stock_mm", "/regions"});
};

TEST_F(VerifyLies, OfAReportOfPocketAreNoticed) {
  pocket();
  const Words verify{"verify", "pocketed.json"};
  tell("pocketed.json", lies_of_json(read_bytes(folder_ / "pocketed.json")), verify, kVersion, kOption);
  exchange({"pocket.json", "p.ngc"}, verify);
}

/// The oracles of three kinds do not know yet which changes are harmless (the order of outlines, signs of 0),
/// so their walks run with the long counts alone, where they show what is open.
bool walks_in_full() { return std::getenv("LEKALO_CASES") != nullptr; }

TEST_F(VerifyLies, OfAReportOfSimulateAreNoticed) {
  if (!walks_in_full()) GTEST_SKIP() << "LEKALO_CASES runs it";
  pocket();
  const Words verify{"verify", "simulated.json"};
  tell("simulated.json", lies_of_json(read_bytes(folder_ / "simulated.json")), verify, kVersion, kOption);
  exchange({"pocket.json", "p.ngc"}, verify);
}

/// Numbers and words of a text, for oracles.
struct Token {
  std::string word;
  double number = 0;
  bool numeric = false;
};

std::vector<Token> tokens_of(const std::string& text) {
  std::vector<Token> tokens;
  const std::string digits = "-.0123456789e";
  for (std::size_t at = 0; at < text.size();) {
    const bool number = std::string("-.0123456789").find(text[at]) != std::string::npos;
    std::size_t end = at + 1;
    while (number && end < text.size() && digits.find(text[end]) != std::string::npos &&
           !(text[end] == '-' && text[end - 1] != 'e'))
      ++end;
    const std::string word = text.substr(at, end - at);
    at = end;
    if (word.find_first_of(" \n\r") != std::string::npos) continue;
    char* stop = nullptr;
    const double value = std::strtod(word.c_str(), &stop);
    tokens.push_back({word, value, number && *stop == 0});
  }
  return tokens;
}

bool same_tokens(const std::string& a, const std::string& b, double within) {
  const std::vector<Token> one = tokens_of(a), other = tokens_of(b);
  return one.size() == other.size() &&
         std::equal(one.begin(), one.end(), other.begin(), [&](const Token& p, const Token& q) {
           return p.numeric && q.numeric ? std::abs(p.number - q.number) <= within : p.word == q.word;
         });
}

/// Takes everything from `begin` to the next `end`, both with it, out of a text.
std::string without(std::string text, const std::string& begin, const std::string& end) {
  for (std::size_t at = 0; (at = text.find(begin, at)) != std::string::npos;) {
    const std::size_t stop = text.find(end, at + begin.size());
    if (stop == std::string::npos) break;
    text.erase(at, stop + end.size() - at);
  }
  return text;
}

/// The claims of a drawing as a text: layers, places, unit.
std::string claims_of_dxf(const std::string& text) {
  std::string claims, entity, section, variable;
  std::istringstream lines(text);
  std::string code, value;
  while (std::getline(lines, code) && std::getline(lines, value)) {
    const int group = std::atoi(code.c_str());
    if (code.find_first_not_of(" 0123456789") != std::string::npos) claims += "? ";
    if (group == 0) entity = value;
    if (group == 0 && (value == "SECTION" || value == "ENDSEC")) section.clear();
    if (entity == "SECTION" && group == 2) section = value;
    if (group == 9) variable = value;
    if (section == "HEADER" && variable == "$INSUNITS" && group == 70) claims += value + " ";
    if (section == "TABLES" && entity == "LAYER" && (group == 70 || group == 62))
      claims += group == 70 ? value : value.substr(0, 1) == "-" ? "off" : "";
    if (section != "ENTITIES" || entity == "TEXT") continue;
    const std::set<int> kClaims{0, 8, 10, 20, 30, 11, 21, 31, 40, 42, 70, 90};
    if (kClaims.contains(group)) claims += code + " " + value + "\n";
  }
  return claims;
}

std::string claims_of(const std::string& form, std::string text) {
  if (form == "dxf") return claims_of_dxf(text);
  if (form == "hpgl") return without(without(without(text, "LB", "\x03;"), "SI", ";"), "LO", ";");
  text = without(text, "<text", "</text>");
  for (const char* attribute :
       {" stroke=\"", " stroke-width=\"", " fill=\"", " xmlns=\"", " xmlns:inkscape=\"", " version=\""})
    text = without(text, attribute, "\"");
  return without(text, "<?", "?>");
}

/// A cut, by places on it at most 0.2 mm apart, and the words of the program that are not motions.
struct CutPlaces {
  std::vector<std::array<double, 2>> places;
  std::multiset<std::string> words;
};

CutPlaces cuts_of(const std::string& text) {
  CutPlaces cuts;
  std::map<char, double> at;
  bool on = false;
  std::istringstream lines(without(text, "(", ")"));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::map<char, double> given;
    std::string motion;
    for (std::string word; words >> word;) {
      const char letter = word[0];
      if (word == "G4") break;
      if (word == "M3" || word == "M4") on = true;
      if (word == "M5") on = false;
      if (std::string("XYIJ").find(letter) != std::string::npos)
        given[letter] = std::strtod(word.c_str() + 1, nullptr);
      else if (word == "G0" || word == "G1" || word == "G2" || word == "G3")
        motion = word;
      else if (std::string("FS").find(letter) == std::string::npos)
        cuts.words.insert(word);
    }
    const double x = at['X'], y = at['Y'];
    for (const char axis : {'X', 'Y'})
      if (given.contains(axis)) at[axis] = given[axis];
    if (!on || (!given.contains('X') && !given.contains('Y'))) continue;
    if (motion == "G0") cuts.words.insert("a rapid that cuts");
    const double u = at['X'], v = at['Y'], cx = x + given['I'], cy = y + given['J'];
    const bool arc = given.contains('I') || given.contains('J');
    const double radius = std::hypot(x - cx, y - cy), first = std::atan2(y - cy, x - cx);
    double turn = std::atan2(v - cy, u - cx) - first;
    if (motion == "G3" && turn < 0) turn += 8 * std::atan(1.0);
    if (motion == "G2" && turn > 0) turn -= 8 * std::atan(1.0);
    const double length = arc ? radius * std::abs(turn) : std::hypot(u - x, v - y);
    const int pieces = static_cast<int>(std::clamp(std::ceil(length / 0.2), 1.0, 1e5));
    for (int k = 0; k <= pieces; ++k) {
      const double t = static_cast<double>(k) / pieces;
      if (arc)
        cuts.places.push_back(
            {cx + radius * std::cos(first + t * turn), cy + radius * std::sin(first + t * turn)});
      else
        cuts.places.push_back({x + t * (u - x), y + t * (v - y)});
    }
  }
  return cuts;
}

/// Every place of one is within a fifth of a millimetre of a place of the other, and the other words are the
/// same.
bool same_cuts(const CutPlaces& a, const CutPlaces& b) {
  const auto all_near = [](const CutPlaces& one, const CutPlaces& other) {
    std::set<std::pair<long, long>> cells;
    for (const auto& [x, y] : other.places)
      for (const long dx : {-1, 0, 1})
        for (const long dy : {-1, 0, 1}) cells.emplace(std::lround(x / 0.1) + dx, std::lround(y / 0.1) + dy);
    return std::all_of(one.places.begin(), one.places.end(), [&](const auto& p) {
      return cells.contains({std::lround(p[0] / 0.1), std::lround(p[1] / 0.1)});
    });
  };
  return a.words == b.words && all_near(a, b) && all_near(b, a);
}

TEST_F(VerifyLies, OfAProfileProgramAreNoticed) {
  if (!walks_in_full()) GTEST_SKIP() << "LEKALO_CASES runs it";
  nest();
  keep({"export", "nested.json", "--format", "gcode", "--kerf", "0.3", "--feed", "2000", "--lead-in", "2",
        "--sheet", "steel 2 mm#1", "-o", "cut.nc"});
  const std::string before = read_bytes(folder_ / "cut.nc");
  std::vector<Lie> all = lies_of_text(before);
  // The last place is a hundredth of what the kerf may enter a part by.
  std::erase_if(all, is_last_place);
  tell(
      "cut.nc", all,
      {"verify", "cut.nc", "--layout", "nested.json", "--kerf", "0.3", "--sheet", "steel 2 mm#1"},
      [&](const Lie& lie) { return same_cuts(cuts_of(lie.bytes()), cuts_of(before)); }, kNever);
}

TEST_F(VerifyLies, OfExportsAreNoticed) {
  if (!walks_in_full()) GTEST_SKIP() << "LEKALO_CASES runs it";
  nest();
  for (const std::string form : {"dxf", "svg", "hpgl"}) {
    Words words{"export", "nested.json", "--format", form, "-o", "out"};
    Words verify{"verify", "out", "--layout", "nested.json"};
    if (form == "hpgl") {
      words = words + Words{"--sheet", "steel 2 mm#1"};
      verify = verify + Words{"--sheet", "steel 2 mm#1"};
    }
    keep(words);
    const std::string claims = claims_of(form, read_bytes(folder_ / "out"));
    tell(
        "out", lies_of_text(read_bytes(folder_ / "out")), verify,
        [&](const Lie& lie) { return same_tokens(claims_of(form, lie.bytes()), claims, 0); },
        [&](const Lie& lie) { return same_tokens(claims_of(form, lie.bytes()), claims, 2e-6); });
  }
}

}  // namespace
}  // namespace lekalo::test
