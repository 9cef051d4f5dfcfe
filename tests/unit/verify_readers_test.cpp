// The checker's own readers of JSON and contours, at the edges of what they take.

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "verify/read/contour.hpp"
#include "verify/read/fields.hpp"
#include "verify/read/json.hpp"
#include "verify/read/known_fields.hpp"
#include "verify/read/text_rows.hpp"

namespace lekalo::verify::verify_readers_test {
namespace {

std::string refusal(std::string_view json) {
  const auto read = parse_json(json, "j");
  return read ? "" : read.error().message;
}
std::string text_of(const std::string& string) {
  const auto read = parse_json(string, "j");
  return read ? json_text(*read) : "refused";
}

TEST(VerifyReaders, EscapesBecomeTheirLetters) {
  EXPECT_EQ(text_of(R"("\b\f\n\r\t\"\\\/")"), "\b\f\n\r\t\"\\/");
  EXPECT_EQ(text_of(R"("\u0041\u005A\u005a\u007f")"), "AZZ\x7f");
  EXPECT_EQ(text_of(R"("\u0080\u07ff\u07FF")"), "\xC2\x80\xDF\xBF\xDF\xBF");
  EXPECT_EQ(text_of(R"("\u0800\uffff\uFfFf")"), "\xE0\xA0\x80\xEF\xBF\xBF\xEF\xBF\xBF");
  EXPECT_EQ(text_of(R"("\u09aFx")"), "\xE0\xA6\xAFx");
  EXPECT_EQ(text_of("\" \x7f\xC3\xA9\""), " \x7f\xC3\xA9");
}

TEST(VerifyReaders, HexDigitsAreThoseOfHexNumbers) {
  for (int c = 1; c < 256; ++c) {
    const bool hex = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
    EXPECT_EQ(refusal("\"\\u00" + std::string(2, static_cast<char>(c)) + "\"").empty(), hex) << c;
  }
  EXPECT_NE(refusal(R"("\u123")"), "");
  EXPECT_EQ(refusal(R"("\u1234")"), "");
}

TEST(VerifyReaders, TextsHoldNoControlCharacters) {
  for (int c = 0; c < 256; ++c) {
    if (c == '"' || c == '\\') continue;
    EXPECT_EQ(refusal("\"" + std::string(1, static_cast<char>(c)) + "\"").empty(), c >= 0x20) << c;
  }
}

TEST(VerifyReaders, OnlyFourCharactersAreBlanks) {
  for (int c = 0; c < 256; ++c) {
    const std::string one(1, static_cast<char>(c));
    const bool blank = one == " " || one == "\t" || one == "\n" || one == "\r";
    EXPECT_EQ(refusal("[" + one + "]").empty(), blank || (c >= '0' && c <= '9')) << c;
    EXPECT_EQ(refusal("{\"a\"" + one + ":1}").empty(), blank) << c;
  }
}

/// The bytes after a document's last one are not its own.
TEST(VerifyReaders, NothingIsReadBeyondTheDocument) {
  const auto cut = [](std::string_view whole, std::size_t size) {
    const auto read = parse_json(whole.substr(0, size), "j");
    return read ? std::string(read->text) : "refused";
  };
  EXPECT_EQ(cut("12", 1), "1");
  EXPECT_EQ(cut("1 ]", 2), "1");
  EXPECT_EQ(cut("[1]]", 3), "[1]");
  EXPECT_EQ(cut("[1]]", 2), "refused");
  EXPECT_EQ(cut("\"ab\"", 3), "refused");
  EXPECT_EQ(cut("1.5", 2), "refused");
  EXPECT_EQ(cut("-5", 1), "refused");
  EXPECT_EQ(cut("{\"a\":1}}", 7), "{\"a\":1}");
  EXPECT_EQ(cut("{\"a\":1}}", 6), "refused");
  EXPECT_EQ(cut("1,2", 1), "1");
  EXPECT_EQ(cut(" \n 7\n\n5", 5), "7");
  EXPECT_EQ(refusal(std::string_view("[1]]").substr(0, 2)), "j:1: not JSON: a list is not closed");
  EXPECT_EQ(refusal(std::string_view("\"ab\"").substr(0, 3)), "j:1: not JSON: a text is not closed");
}

TEST(VerifyReaders, NumbersHaveTheGrammarOfJson) {
  for (const char* text : {"0", "-0", "10", "9", "0.5", "1.25e9", "1E+2", "1e-2", "90", "0e0"}) {
    EXPECT_EQ(refusal(text), "") << text;
    EXPECT_EQ(parse_json(std::string(" ") + text + "\n", "j")->text, text);
  }
  for (const char* text :
       {"00", "01", "-", "--1", "1.", ".5", "1e", "1e+", "1e+-2", "+1", "1.e2", "0x1", "1-", "- 1"})
    EXPECT_NE(refusal(text), "") << text;
}

TEST(VerifyReaders, AComplaintNamesTheLine) {
  EXPECT_EQ(refusal("[1,\n2,\nx]").rfind("j:3: not JSON: ", 0), 0U);
  EXPECT_EQ(refusal("x").rfind("j:1: ", 0), 0U);
  EXPECT_EQ(refusal("[1]\n\n2").rfind("j:3: not JSON: there is more after the end", 0), 0U);
}

TEST(VerifyReaders, DepthIsCountedInListsAndObjects) {
  const auto nested = [](int depth, const std::string& open, const std::string& close) {
    std::string text;
    for (int i = 0; i < depth; ++i) text += open;
    text += "1";
    for (int i = 0; i < depth; ++i) text += close;
    return refusal(text);
  };
  EXPECT_EQ(nested(64, "[", "]"), "");
  EXPECT_NE(nested(65, "[", "]").find("64 deep"), std::string::npos);
  EXPECT_EQ(nested(64, "{\"a\":", "}"), "");
  EXPECT_NE(nested(65, "{\"a\":", "}").find("64 deep"), std::string::npos);
}

TEST(VerifyReaders, PiecesEndWhereTheyEnd) {
  const auto root = parse_json(R"([ -1.5e3,"a\"]\\" ,[[],{}],{"b":[1],"c":{"d":"}"}} , null,true])", "j");
  ASSERT_TRUE(root);
  std::vector<std::string> pieces;
  for (JsonItems items(*root); const auto item = items.next();) pieces.emplace_back(item->text);
  const std::vector<std::string> wanted{"-1.5e3", R"("a\"]\\")", "[[],{}]", R"({"b":[1],"c":{"d":"}"}})",
                                        "null",   "true"};
  EXPECT_EQ(pieces, wanted);
  EXPECT_EQ(count_items(*root), 6U);
  EXPECT_EQ(count_items(*parse_json("[]", "j")), 0U);
  EXPECT_EQ(parse_json("\xEF\xBB\xBF[1]", "j")->text, "[1]");
  EXPECT_NE(refusal("\xEF\xBB[1]"), "");
  EXPECT_NE(refusal("[1]\xEF\xBB\xBF"), "");
}

TEST(VerifyReaders, KindsOfValuesAreToldByTheirFirstLetter) {
  const auto kind = [](std::string_view text) {
    const Json v{text};
    return std::array{v.is_object(), v.is_array(),  v.is_string(), v.is_null(),
                      v.is_bool(),   v.is_number(), v.is_true()};
  };
  EXPECT_EQ(kind("{}"), (std::array{true, false, false, false, false, false, false}));
  EXPECT_EQ(kind("[]"), (std::array{false, true, false, false, false, false, false}));
  EXPECT_EQ(kind("\"\""), (std::array{false, false, true, false, false, false, false}));
  EXPECT_EQ(kind("null"), (std::array{false, false, false, true, false, false, false}));
  EXPECT_EQ(kind("true"), (std::array{false, false, false, false, true, false, true}));
  EXPECT_EQ(kind("false"), (std::array{false, false, false, false, true, false, false}));
  for (const char* number : {"0", "9", "-1", "5"})
    EXPECT_EQ(kind(number), (std::array{false, false, false, false, false, true, false})) << number;
  for (const char* other : {"", "/", ":"})
    EXPECT_EQ(kind(other), (std::array{false, false, false, false, false, false, false})) << other;
}

TEST(VerifyReaders, MembersAreFoundOnce) {
  const std::array<std::string_view, 2> keys{"a", "b"};
  std::array<Json, 2> found{Json{"old"}, Json{"old"}};
  ASSERT_TRUE(find_members(*parse_json(R"({"b": 2, "c": 3, "c": 4})", "j"), keys, found));
  EXPECT_EQ(found[0].text, "");
  EXPECT_EQ(found[1].text, "2");
  EXPECT_FALSE(find_members(*parse_json(R"({"b": 2, "b": 2})", "j"), keys, found));
}

TEST(VerifyReaders, IndicesAreWholeNumbersBelow1e15) {
  const auto index = [](const std::string& text) {
    std::string complaint;
    const std::string object = "{\"n\": " + text + "}";  // which the pieces look into
    Fields fields(*parse_json(object, "j"), "at", complaint);
    const std::size_t value = fields.index("n");
    return complaint.empty() ? std::to_string(value) : complaint;
  };
  EXPECT_EQ(index("0"), "0");
  EXPECT_EQ(index("1.50e1"), "15");
  EXPECT_EQ(index("999999999999999"), "999999999999999");
  for (const char* text : {"1e15", "-1", "0.5", "\"1\"", "1e500", "null", "-1e-3"})
    EXPECT_EQ(index(text).rfind("field at.n is ", 0), 0U) << text;
}

TEST(VerifyReaders, TheFirstComplaintIsKept) {
  std::string complaint;
  Fields fields(*parse_json(R"({"a": 1, "b": "x", "l": [1, [2]]})", "j"), "", complaint);
  EXPECT_TRUE(fields.number("a").digits == 1);
  EXPECT_EQ(fields.text("b"), "x");
  EXPECT_FALSE(fields.number_or_null("a") == std::nullopt);
  EXPECT_TRUE(complaint.empty());
  std::vector<std::string> names;
  fields.each("l", [&](Json, const std::string& name) { names.push_back(name); });
  EXPECT_EQ(names, (std::vector<std::string>{"l[0]", "l[1]"}));
  (void)fields.number("b");
  EXPECT_EQ(complaint.rfind("field b is \"x\", not a decimal number", 0), 0U) << complaint;
  const std::string first = complaint;
  (void)fields.text("a");
  fields.each("a", [](Json, const std::string&) {});
  EXPECT_EQ(complaint, first);
  complaint.clear();
  Fields(*parse_json("[]", "j"), "", complaint);
  EXPECT_EQ(complaint, "it is not an object");
  complaint.clear();
  Fields(*parse_json("[]", "j"), "here", complaint);
  EXPECT_EQ(complaint, "here is not an object");
  complaint.clear();
  (void)Fields(*parse_json("{}", "j"), "here", complaint).number("n");
  EXPECT_EQ(complaint, "field here.n is missing");
}

/// A complaint of words that nobody knows, made after `earlier`.
std::string complaint_of(void (*refuse)(Json, std::string&), const std::string& json,
                         std::string earlier = "") {
  refuse(*parse_json(json, "j"), earlier);
  return earlier;
}

TEST(VerifyReaders, WordsOfARegionFileAreKnown) {
  const auto complaint = [](const std::string& json) { return complaint_of(refuse_unknown_words, json); };
  EXPECT_EQ(complaint(R"({"outer": [{"line": {"from": [1], "to": [2]}}], "name": "a", "date": 5})"), "");
  EXPECT_EQ(complaint(R"({"pieces": [{"outer": [], "holes": [[{"arc": {"ccw": true}}]], "islands": []}]})"),
            "");
  EXPECT_EQ(complaint(R"({"outlet": []})"), "field outlet is not one of a region file");
  EXPECT_EQ(complaint(R"({"outlet": {}})"), "field outlet is not one of a region file");
  EXPECT_EQ(complaint(R"({"outer": [{"line": {}}, {"lime": {}}]})"),
            "field outer[1].lime is not one of a region file");
  EXPECT_EQ(complaint(R"({"outer": {"line": {"from": 1, "from": 2}}})"),
            "field outer.line.from is given twice");
  // The first complaint is kept.
  EXPECT_EQ(complaint(R"({"outer": [{"a": 1}, {"b": 2}], "holes": [{"c": 3}], "outlet": []})"),
            "field outer[0].a is not one of a region file");
  EXPECT_EQ(complaint_of(refuse_unknown_words, R"({"outlet": []})", "before"), "before");
  EXPECT_EQ(complaint_of(refuse_unknown_words, R"({"outer": [{"a": 1}]})", "before"), "before");
}

TEST(VerifyReaders, WordsOfOtherFilesAreKnown) {
  EXPECT_EQ(complaint_of(refuse_unknown_words_of_tree, R"({"name": "a", "shape": {"any": 1}})"), "");
  EXPECT_EQ(complaint_of(refuse_unknown_words_of_tree, R"({"shade": {}})"),
            "field shade is not one of a tree of primitives");
  EXPECT_EQ(complaint_of(refuse_unknown_fields, R"({"x": 1, "trim": {"loss": 1}, "run": {"any": 1}})"), "");
  EXPECT_EQ(complaint_of(refuse_unknown_fields, R"({"x": 1, "trim": {"lost": 1}})"),
            "field trim.lost is not one of a placement");
  EXPECT_EQ(complaint_of(refuse_unknown_fields, R"({"x": 1, "y": 1, "x": 1})"), "field x is given twice");
  EXPECT_EQ(complaint_of(refuse_unknown_fields, R"({"wide": 1})", "before"), "before");
  const auto in_report = [](const std::string& json, const std::string& key) {
    std::string complaint;
    refuse_unknown_fields(*parse_json(json, "j"), key, complaint);
    return complaint;
  };
  EXPECT_EQ(in_report(R"({"join": 1})", "drawing"), "");
  EXPECT_EQ(in_report(R"({"join": 1})", "regions"), "field regions.join is not one of a placement");
  EXPECT_EQ(in_report(R"({"guard": 1})", "scan"), "");
  EXPECT_EQ(in_report(R"({"guard": 1})", "drawing"), "field drawing.guard is not one of a placement");
}

// ---- contours ---------------------------------------------------------------------------------------------

/// "x,y;" of every point in its unit, or the message.
std::string contour(const std::string& name, const std::string& bytes) {
  const auto read = read_contour({name, bytes});
  if (!read) return read.error().message;
  std::string text;
  if (read->unit) text += *read->unit == LengthUnit::inch ? "inch " : "mm ";
  for (std::size_t i = 0; i < read->size(); ++i)
    text += fmt::format("{},{};", approximate(read->x[i]), approximate(read->y[i]));
  return text;
}
const std::string kThree = "1,2;3,4;5,7;";

TEST(VerifyReaders, PointsStandInLinesInManyWays) {
  for (const char* text : {"1 2\n3 4\n5 7", "1 2\n3 4\n5 7\n", "1,2\n3,4\n5,7\n", "1;2\n3 ; 4\n5 ,7\n",
                           "\t1 2 \r\n3\t4\r\n5 7\r\n",
                           "\xEF\xBB\xBF"
                           "1 2\n3 4\n5 7\n",
                           "# c\n; c\n% c\n// c\n\n \n1 2\n3 4\n5 7\n", "x y\n1 2\n3 4\n5 7\n",
                           "1 2 # first\n3 4 9\n5 7 0\n", "1,2,\n3,4,0\n5,7,0\n"})
    EXPECT_EQ(contour("c.csv", text),
              text == std::string("1,2,\n3,4,0\n5,7,0\n") ? "c.csv:1: \"\" is not " + decimal_rule() : kThree)
        << text;
  EXPECT_EQ(contour("c.txt", "+1 2\n3 4\n5 7"), kThree);
  EXPECT_EQ(contour("c.xyz", "-.5 2\n3 4\n5 7"), "-0.5,2;3,4;5,7;");
  EXPECT_EQ(contour("C.XYZ", ".5 2\n3 4\n5 7"), "0.5,2;3,4;5,7;");
}

TEST(VerifyReaders, OneHeaderLineIsPassedOver) {
  EXPECT_EQ(contour("c.csv", "x y\nx y\n1 2\n3 4\n5 7"), "c.csv:2: \"x\" is not " + decimal_rule());
  EXPECT_EQ(contour("c.csv", "1 2\nx y\n3 4\n5 7"), "c.csv:2: \"x\" is not " + decimal_rule());
  EXPECT_EQ(contour("c.csv", "-\n1 2\n3 4\n5 7"), kThree) << "a sign alone begins no number";
  EXPECT_EQ(contour("c.csv", ".\n1 2\n3 4\n5 7"), kThree);
  for (int c = '!'; c < 256; ++c) {
    const std::string first(1, static_cast<char>(c));
    if (first == "#" || first == ";" || first == "%") continue;
    const bool number = c >= '0' && c <= '9';
    const std::string read = contour("c.csv", first + "\n1 2\n3 4\n5 7");
    EXPECT_EQ(read, number ? "c.csv:1: 1 fields where a point needs x and y: " + first : kThree) << c;
  }
}

/// One number alone is no head of a table, whatever it begins with.
TEST(VerifyReaders, ANumberBeginsWithASignAPointOrADigit) {
  for (const char* first : {"5", "+5", "-5", ".5", "+.5", "-.5"})
    EXPECT_EQ(contour("c.csv", first + std::string("\n1 2\n3 4\n5 7")),
              std::string("c.csv:1: 1 fields where a point needs x and y: ") + first);
  for (const char* first : {"x5", "+x5", "--5", "..5"})
    EXPECT_EQ(contour("c.csv", first + std::string("\n1 2\n3 4\n5 7")), kThree) << first;
}

TEST(VerifyReaders, AMistypedPointIsNoHeader) {
  const std::string no = "c.csv:1: \"O.5\" is not " + decimal_rule();
  EXPECT_EQ(contour("c.csv", "O.5 3\n1 2\n3 4\n5 7"), no);
  EXPECT_EQ(contour("c.csv", "O.5,3,0\n1 2\n3 4\n5 7"), no);
  EXPECT_EQ(contour("c.csv", "O.5 3 0 1\n1 2\n3 4\n5 7"), kThree) << "no point has four numbers";
  for (const char* head : {"x y z", "x,5,y,", "Part 12, contour", "X 1; Y 2", "\"X [mm]\";\"Y [mm]\""})
    EXPECT_EQ(contour("c.csv", head + std::string("\n1 2\n3 4\n5 7")), kThree) << head;
}

/// After the first line a comment is no header: a word there is refused, and a comment passed over.
TEST(VerifyReaders, CommentsBeginInFourWays) {
  for (const char* mark : {"#", ";", "%", "//"})
    EXPECT_EQ(contour("c.csv", fmt::format("1 2\n{} 9 9\n3 4\n5 7", mark)), kThree) << mark;
  EXPECT_EQ(contour("c.csv", "1 2\n/ 9\n3 4\n5 7"), "c.csv:2: \"/\" is not " + decimal_rule());
}

TEST(VerifyReaders, ARowKnowsWhetherAnEmptyLineStandsBeforeIt) {
  std::string gaps;
  ASSERT_TRUE(
      read_text_rows({"c.csv", "1 2\n\n# c\n3 4\n5 6\n# c\n\n7 8\n"}, [&](TextRow&& row) -> Result<void> {
        gaps += row.after_a_gap ? '1' : '0';
        return {};
      }));
  EXPECT_EQ(gaps, "0101");
}

// A direction beside a point is one of space.
TEST(VerifyReaders, SixFieldsAreAPointOfSpaceWithADirection) {
  const auto fields = [](const std::string& line, bool in_space) {
    std::size_t count = 0;
    const auto read = read_text_rows(
        {"p.xyz", line + "\n"},
        [&](TextRow&& row) -> Result<void> {
          count = row.count;
          return {};
        },
        in_space);
    return read ? std::to_string(count) : read.error().message;
  };
  EXPECT_EQ(fields("1 2 3 0 0 1", true), "6");
  EXPECT_EQ(fields("1 2 3 0 0 1", false), "p.xyz:1: 6 fields where a point needs x and y: 1 2 3 0 0 1");
  for (const char* line : {"1", "1 2 3 4", "1 2 3 4 5", "1 2 3 4 5 6 7"})
    for (const bool in_space : {false, true})
      EXPECT_NE(fields(line, in_space).find("fields where a point needs x and y"), std::string::npos) << line;
  for (const bool in_space : {false, true}) {
    EXPECT_EQ(fields("1 2", in_space), "2");
    EXPECT_EQ(fields("1 2 3", in_space), "3");
  }
}

TEST(VerifyReaders, AContourHasThreePointsAndAPointTwoOrThreeFields) {
  EXPECT_EQ(contour("c.csv", "1 2\n3 4\n"), "c.csv: 2 points; a contour has at least 3");
  EXPECT_EQ(contour("c.csv", "1 2\n3\n"), "c.csv:2: 1 fields where a point needs x and y: 3");
  EXPECT_EQ(contour("c.csv", "1 2 3 4\n"), "c.csv:1: 4 fields where a point needs x and y: 1 2 3 4");
  EXPECT_EQ(contour("c", "1 2\n"), "c: the name does not end in .csv, .txt, .xyz, .json or .dxf");
  EXPECT_EQ(contour("a.TXT", "1 2\n3 4\n5 7"), kThree);
  EXPECT_EQ(contour("a.b.Csv", "1 2\n3 4\n5 7"), kThree);
  EXPECT_EQ(contour("c.jsonx", "[]"), "c.jsonx: the name does not end in .csv, .txt, .xyz, .json or .dxf");
}

/// A list may be a contour that is misspelt; single values are for people.
TEST(VerifyReaders, JsonContoursHoldNoListsThatNobodyKnows) {
  const auto with = [](const std::string& member) {
    return contour("c.json", R"({"points": [[1, 2], [3, 4], [5, 7]], )" + member + "}");
  };
  EXPECT_EQ(with(R"("name": "a", "date": 5, "checked": true)"), kThree);
  EXPECT_EQ(with(R"("hols": [])"), "c.json: field hols is not one of a contour");
  EXPECT_EQ(with(R"("made": {})"), "c.json: field made is not one of a contour");
  const auto first = [](const std::string& edge) {
    return contour("c.json", R"({"outer": [)" + edge + R"(, {"line": {"from": [3, 4], "to": [5, 7]}},
                               {"line": {"from": [5, 7], "to": [1, 2]}}]})");
  };
  EXPECT_EQ(first(R"({"line": {"from": [1, 2], "to": [3, 4]}})"), kThree);
  EXPECT_EQ(first(R"({"line": {"from": [1, 2], "to": [3, 4], "bulge": 1}})"),
            "c.json: edge 0 has more than two ends");
  EXPECT_NE(first(R"({"line": {"from": [1, 2], "to": [3, 4]}, "arc": 1})").find("edge 0"), std::string::npos);
}

TEST(VerifyReaders, JsonContoursArePointsOrLines) {
  EXPECT_EQ(contour("c.json", "[[1, 2], [3, 4], [5, 7]]"), kThree);
  EXPECT_EQ(contour("c.json", R"({"units": "inch", "points": [[1, 2], [3, 4], [5, 7]]})"), "inch " + kThree);
  EXPECT_EQ(
      contour("c.json", R"({"units": "mm", "points": [[1, 2], [3, 4], [5, 7]], "holes": [], "islands": []})"),
      "mm " + kThree);
  const auto lines = [](const std::string& third, const std::string& last) {
    return contour("c.json", R"({"outer": [{"line": {"from": [1, 2], "to": [3, 4]}}, {"line": {"from": )" +
                                 third + R"(, "to": [5, 7]}}, {"line": {"from": [5, 7], "to": )" + last +
                                 "}}]}");
  };
  EXPECT_EQ(lines("[3, 4]", "[1, 2]"), kThree);
  // A millionth apart is together, and more is not.
  EXPECT_EQ(lines("[3.000001, 4]", "[1, 2]"), "1,2;3.000001,4;5,7;");
  EXPECT_EQ(lines("[3, 3.999999]", "[1, 2.000001]"), "1,2;3,3.999999;5,7;");
  EXPECT_EQ(lines("[3.0000010001, 4]", "[1, 2]"), "c.json: edge 1 does not begin where edge 0 ends");
  EXPECT_EQ(lines("[3, 3.9999989]", "[1, 2]"), "c.json: edge 1 does not begin where edge 0 ends");
  EXPECT_EQ(lines("[3, 4]", "[1, 2.1]"), "c.json: edge 0 does not begin where edge 2 ends");
}

TEST(VerifyReaders, JsonContoursAreRefusedWithTheirReason) {
  const auto refused = [](const std::string& text) { return contour("c.json", text).substr(8); };
  EXPECT_EQ(refused("7"), "neither a list of points nor an object");
  EXPECT_EQ(refused(R"({"points": [[1, 2]], "holes": [1]})"),
            "the contour has holes or islands, which are not read here");
  EXPECT_EQ(refused(R"({"points": [[1, 2]], "islands": {}})"),
            "the contour has holes or islands, which are not read here");
  EXPECT_EQ(refused(R"({"points": 5})"), "the points are not a list");
  EXPECT_EQ(refused(R"({"outer": 5})"), "field \"outer\" is not a list");
  EXPECT_EQ(refused(R"({"points": [], "units": "mm"})"), "0 points; a contour has at least 3");
  EXPECT_EQ(refused(R"({"points": [], "units": 5})"), "units are 5, not \"mm\" or \"inch\"");
  EXPECT_EQ(refused(R"([[1]])"), "point 0 is not a list of two numbers");
  EXPECT_EQ(refused(R"([[1, 2, 3]])"), "point 0 is not a list of two numbers");
  EXPECT_EQ(refused(R"([7])"), "point 0 is not a list of two numbers");
  EXPECT_EQ(refused(R"([[1, 2], [1, "2"]])"), "point 1: \"\"2\"\" is not " + decimal_rule());
  for (const char* edge : {"7", "{}", R"({"line": 7})", R"({"arc": {}})"})
    EXPECT_EQ(refused(fmt::format(R"({{"outer": [{}]}})", edge)),
              "edge 0 of \"outer\" is not a line; arcs are not read here");
  EXPECT_EQ(refused(R"({"outer": [{"line": {"from": [1, 2], "from": [1, 2], "to": [3, 4]}}]})"),
            "edge 0 gives an end twice");
  EXPECT_EQ(refused(R"({"outer": [{"line": {"from": [1, 2], "to": [3, 4]}, "line": {}}]})"),
            "edge 0 of \"outer\" is not a line; arcs are not read here");
  EXPECT_EQ(refused(R"({"points": 5, "units": "mm"})"), "the points are not a list");
  EXPECT_EQ(refused(R"({"outer": [{"line": {"from": [1, 2]}}]})"), "point 0 is not a list of two numbers");
}

std::string dxf(const std::string& entities, const std::string& header = "") {
  return "0\nSECTION\n2\nHEADER\n" + header + "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + entities +
         "0\nENDSEC\n0\nEOF\n";
}
std::string polyline(const std::string& pairs, const std::string& flag = "70\n1\n") {
  return "0\nLWPOLYLINE\n" + flag + pairs;
}
const std::string kPairs = "10\n1\n20\n2\n10\n3\n20\n4\n10\n5\n20\n7\n";
std::string line(const std::string& x, const std::string& y, const std::string& u, const std::string& v) {
  return "0\nLINE\n10\n" + x + "\n20\n" + y + "\n11\n" + u + "\n21\n" + v + "\n";
}

TEST(VerifyReaders, PolylinesOfDxfAreRead) {
  EXPECT_EQ(contour("c.dxf", dxf(polyline(kPairs))), kThree);
  EXPECT_EQ(contour("c.DXF", dxf(polyline(kPairs, "70\n129\n"), "9\n$INSUNITS\n70\n4\n")), "mm " + kThree);
  EXPECT_EQ(contour("c.dxf", dxf(polyline(kPairs), "9\n$INSUNITS\n70\n1\n9\n$OTHER\n70\n4\n")),
            "inch " + kThree);
  EXPECT_EQ(contour("c.dxf", dxf(polyline(kPairs), "9\n$INSUNITS\n70\n0\n")), kThree);
  EXPECT_EQ(contour("c.dxf", dxf(polyline(kPairs + "42\n0\n210\n0\n220\n0.0\n230\n1.0\n999\nwords\n"))),
            kThree);
  EXPECT_EQ(contour("c.dxf", dxf(polyline(kPairs + "10\n1.0\n20\n2.00\n", ""))), "1,2;3,4;5,7;1,2;")
      << "it returns";
  EXPECT_EQ(contour("c.dxf", dxf(polyline(kPairs + "10\n1\n20\n3\n", ""))),
            "c.dxf:12: the LWPOLYLINE is not closed");
  EXPECT_EQ(contour("c.dxf", dxf(polyline(kPairs + "10\n2\n20\n2\n", "70\n128\n"))),
            "c.dxf:12: the LWPOLYLINE is not closed");
  EXPECT_EQ(contour("c.dxf", dxf(polyline(kPairs, "70\n10\n"))), "c.dxf:12: the LWPOLYLINE is not closed");
}

TEST(VerifyReaders, PolylinesOfDxfAreRefusedWithTheirLine) {
  EXPECT_EQ(contour("c.dxf", dxf(polyline("20\n2\n10\n1\n"))), "c.dxf:16: a y without its x");
  EXPECT_EQ(contour("c.dxf", dxf(polyline(kPairs + "10\n1\n"))), "c.dxf:12: an x without its y");
  EXPECT_EQ(contour("c.dxf", dxf(polyline(kPairs + "42\n1e-9\n"))),
            "c.dxf:28: a bulge; arcs are not read here");
  for (const char* code : {"210\n1", "220\n-1", "230\n0", "230\n-1"})
    EXPECT_EQ(contour("c.dxf", dxf(polyline(kPairs + code + "\n"))),
              "c.dxf:28: LWPOLYLINE does not lie in the xy plane seen from above")
        << code;
  EXPECT_EQ(contour("c.dxf", dxf(polyline("10\nx\n"))), "c.dxf:16: \"x\" is not " + decimal_rule());
  EXPECT_EQ(contour("c.dxf", dxf(polyline(kPairs), "9\n$INSUNITS\n70\n2\n")),
            "c.dxf:8: $INSUNITS 2 is neither 1 (inch) nor 4 (mm) nor 0 (not said)");
  EXPECT_EQ(contour("c.dxf", dxf("0\nPOINT\n")),
            "c.dxf:12: entity POINT is not read here, only one closed LWPOLYLINE or LINEs");
  EXPECT_EQ(contour("c.dxf", dxf("")),
            "c.dxf: 0 LWPOLYLINE and 0 LINE; a contour is one closed LWPOLYLINE or LINEs alone");
}

TEST(VerifyReaders, GroupCodesAreWholeNumbersTo2000) {
  const auto code = [](const std::string& text) {
    return contour("c.dxf", text + "\nx\n" + dxf(polyline(kPairs)));
  };
  for (const char* fine : {"999", "2000", "0", "1071", "1.0e2"}) EXPECT_EQ(code(fine), kThree) << fine;
  for (const char* bad : {"2001", "-1", "1.5", "x", "1e9"})
    EXPECT_EQ(code(bad), std::string("c.dxf:1: \"") + bad + "\" is not a DXF group code") << bad;
  EXPECT_EQ(contour("c.dxf", "0"), "c.dxf:1: the file ends after a group code");
  EXPECT_EQ(contour("c.dxf", "0\nSECTION\n999\nx\n2\nENTITIES\n" + polyline(kPairs)), kThree)
      << "a comment in between";
}

TEST(VerifyReaders, LinesOfDxfAreOneClosedChainWhateverTheirOrder) {
  const std::string ab = line("1", "2", "3", "4"), bc = line("3", "4", "5", "7"),
                    ca = line("5", "7", "1", "2");
  const std::string cb = line("5", "7", "3", "4"), ac = line("1", "2", "5", "7");
  EXPECT_EQ(contour("c.dxf", dxf(ab + bc + ca)), kThree);
  EXPECT_EQ(contour("c.dxf", dxf(ab + ca + bc)), kThree);
  EXPECT_EQ(contour("c.dxf", dxf(ab + ac + cb)), kThree);
  EXPECT_EQ(contour("c.dxf", dxf(ab + bc)), "c.dxf:22: the chain of LINEs does not come back to its start");
  EXPECT_EQ(contour("c.dxf", dxf(ab + line("3.1", "4", "5", "7") + ca)),
            "c.dxf:12: no LINE continues this one, so the LINEs are not one closed chain");
  EXPECT_EQ(contour("c.dxf", dxf("0\nLINE\n10\n1\n20\n2\n11\n3\n")), "c.dxf:12: the LINE has no two ends");
  EXPECT_EQ(contour("c.dxf", dxf(ab + bc + ca + polyline(kPairs))),
            "c.dxf: 1 LWPOLYLINE and 3 LINE; a contour is one closed LWPOLYLINE or LINEs alone");
}

/// Ends a millionth apart are one, in any direction; the nearest is taken, and of equals the first in the
/// file.
TEST(VerifyReaders, ChainsOfDxfGoOnAtTheNearestEnd) {
  const std::string ab = line("1", "2", "3", "4"), ca = line("5", "7", "1", "2");
  const auto second = [&](const char* x, const char* y) {
    return contour("c.dxf", dxf(ab + line(x, y, "5", "7") + ca));
  };
  EXPECT_EQ(second("3.000001", "4"), "1,2;3.000001,4;5,7;");
  EXPECT_EQ(second("3", "3.999999"), "1,2;3,3.999999;5,7;");
  EXPECT_EQ(second("3.0000006", "4.0000008"), "1,2;3.0000006,4.0000008;5,7;") << "three, four, five";
  EXPECT_EQ(second("3.0000007", "4.0000008").rfind("c.dxf:12: no LINE", 0), 0U);
  EXPECT_EQ(second("3.00000100001", "4").rfind("c.dxf:12: no LINE", 0), 0U);
  EXPECT_EQ(contour("c.dxf", dxf(ab + line("3", "4", "5", "7") + line("5", "7", "1.000001", "2"))), kThree);
  EXPECT_EQ(contour("c.dxf", dxf(ab + line("3", "4", "5", "7") + line("5", "7", "1.0000011", "2"))),
            "c.dxf:32: the chain of LINEs does not come back to its start");
  // Two squares of lines that meet in a point: at (3, 4) three unused ends are near.
  const std::string farther = line("3.0000009", "4", "9", "9"), nearer = line("3.0000001", "4", "5", "7");
  const std::string rest = line("9", "9", "3", "4.0000005") + ca;
  EXPECT_EQ(contour("c.dxf", dxf(ab + farther + nearer + rest)).rfind("c.dxf:", 0), 0U);
  EXPECT_EQ(contour("c.dxf", dxf(ab + line("3", "4", "9", "9") + line("9", "9", "3", "4") +
                                 line("3", "4", "5", "7") + ca)),
            "1,2;3,4;9,9;3,4;5,7;");
  EXPECT_EQ(contour("c.dxf", dxf(ab + line("9", "9", "3", "4") + line("3", "4", "9", "9") +
                                 line("3", "4", "5", "7") + ca)),
            "1,2;3,4;9,9;3,4;5,7;");
}

TEST(VerifyReaders, SectionsOfDxfAreKeptApart) {
  const std::string outline = polyline(kPairs);
  EXPECT_EQ(
      contour("c.dxf", "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n70\n2\n9\n$INSUNITS\n70\n4\n40\n2\n0\nENDSEC\n" +
                           dxf(outline)),
      "mm " + kThree)
      << "the unit is in group 70 of its own variable";
  EXPECT_EQ(contour("c.dxf", "0\nSECTION\n2\nBLOCKS\n0\nCIRCLE\n10\n5\n0\nENDSEC\n" + dxf(outline)), kThree);
  EXPECT_EQ(contour("c.dxf", "0\nSECTION\n2\nENTITIES\n999\nwords\n" + outline), kThree);
  EXPECT_EQ(contour("c.dxf", dxf("0\nLWPOLYLINE\n2\nHEADER\n70\n1\n" + kPairs)), kThree)
      << "a name begins a section only after its word";
  EXPECT_EQ(contour("c.dxf", dxf("0\nLWPOLYLINE\n70\n1\n")), "c.dxf: 0 points; a contour has at least 3");
  EXPECT_EQ(contour("c.dxf", dxf("0\nLWPOLYLINE\n70\n0\n")), "c.dxf:12: the LWPOLYLINE is not closed");
  EXPECT_EQ(contour("c.dxf", dxf("0\nLWPOLYLINE\n70\n0\n10\n1\n20\n2\n")),
            "c.dxf:12: the LWPOLYLINE is not closed");
  EXPECT_EQ(contour("c.dxf", dxf("0\nLWPOLYLINE\n70\n0\n10\n1\n20\n2\n10\n1\n20\n2\n")),
            "c.dxf: 2 points; a contour has at least 3");
}

TEST(VerifyReaders, WhatFollowsTheEntitiesBelongsToNone) {
  const std::string entities = "0\nSECTION\n2\nENTITIES\n" + polyline(kPairs) + "0\nENDSEC\n";
  EXPECT_EQ(contour("c.dxf", entities + "0\nSECTION\n2\nOBJECTS\n70\n0\n0\nENDSEC\n"), kThree);
  std::string windows;
  for (const char c : entities) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(contour("c.dxf", windows), kThree);
}

/// Both ends are as near; the one that stands first in the file is taken, though it lies to the right.
TEST(VerifyReaders, OfEqualEndsTheFirstInTheFileIsTaken) {
  EXPECT_EQ(contour("c.dxf", dxf(line("1", "2", "3", "4") + line("3.0000001", "4", "9", "9") +
                                 line("2.9999999", "4", "5", "7") + line("9", "9", "2.9999999", "4") +
                                 line("5", "7", "1", "2"))),
            "1,2;3.0000001,4;9,9;2.9999999,4;5,7;");
}

TEST(VerifyReaders, AnEndingHasSmallLetters) {
  EXPECT_EQ(ending_of("Part.AZaz@["), ".azaz@[");
  EXPECT_EQ(ending_of("Part"), "");
}

TEST(VerifyReaders, InchesAreTurnedIntoMillimetresExactly) {
  auto read = read_contour({"c.csv", "1 0\n-0.5 4\n5 7"});
  ASSERT_TRUE(read);
  Contour same = *read;
  to_millimetres(same, LengthUnit::millimetre);
  EXPECT_EQ(approximate(same.x[1]), -0.5);
  to_millimetres(*read, LengthUnit::inch);
  EXPECT_EQ(compare(read->x[0], *parse_decimal("25.4")), 0);
  EXPECT_EQ(compare(read->x[1], *parse_decimal("-12.7")), 0);
  EXPECT_EQ(compare(read->y[0], Decimal{}), 0);
  EXPECT_EQ(read->y[0].exponent, 0);
  EXPECT_EQ(compare(read->y[2], *parse_decimal("177.8")), 0);
}

}  // namespace
}  // namespace lekalo::verify::verify_readers_test
