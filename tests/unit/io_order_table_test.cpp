#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "lekalo/geom/grid.hpp"
#include "lekalo/io/formats/order_table.hpp"

namespace lekalo::io::io_order_table_test {
namespace {

TEST(OrderTable, ColumnsAreFoundByNameInAnyOrderAndCase) {
  const auto table = read_order("Quantity,FILE,name\n3,a.dxf,left\n,b.svg,\n", "o.csv");
  ASSERT_TRUE(table) << table.error().message;
  ASSERT_EQ(table->rows.size(), 2u);
  EXPECT_EQ(table->rows[0].file, "a.dxf");
  EXPECT_EQ(table->rows[0].quantity, 3);
  EXPECT_EQ(table->rows[0].name, "left");
  EXPECT_EQ(table->rows[1].quantity, 1);
  EXPECT_EQ(table->rows[1].said_in, "o.csv: line 3");
  EXPECT_FALSE(table->rows[1].rotations || table->rows[1].may_mirror || table->rows[1].grain);
}

TEST(OrderTable, EverySeparatorGivesTheSameRows) {
  for (const char separator : {',', ';', '\t'}) {
    std::string text =
        "file|quantity|rotations|mirror|grain|priority|name\r\na.dxf|2|0 90|yes|y|5|\"x|y\"\r\n";
    for (char& c : text)
      if (c == '|') c = separator;
    const auto table = read_order(text, "o.csv");
    ASSERT_TRUE(table) << table.error().message;
    const OrderRow& row = table->rows.at(0);
    EXPECT_EQ(row.quantity, 2);
    ASSERT_TRUE(row.rotations);
    EXPECT_EQ(*row.rotations, (std::vector<layout::AngleRange>{{0, 0}, {90, 90}}));
    EXPECT_EQ(row.may_mirror, true);
    EXPECT_EQ(row.grain, (layout::Grain{90, 0}));
    EXPECT_EQ(row.priority, 5);
    EXPECT_EQ(row.name, std::string("x") + separator + "y");
  }
}

TEST(OrderTable, MaterialAndPurposeAreReadAsTheyStand) {
  const auto table = read_order(
      "file;material;thickness;due;customer;label\n"
      "a.dxf;birch plywood;1/4in;2028-02-29;\xD0\x9E\xD1\x80\xD0\xBB\xD0\xBE\xD0\xB2\xD0\xB0;order "
      "7\nb.dxf;;;;;\n",
      "o.csv");
  ASSERT_TRUE(table) << table.error().message;
  EXPECT_TRUE(table->notices.empty());
  const OrderRow &row = table->rows.at(0), &other = table->rows.at(1);
  EXPECT_EQ(row.material, (layout::Material{"birch plywood", geom::grid_from_mm(6.35)}));
  EXPECT_EQ(row.purpose,
            (layout::Purpose{"\xD0\x9E\xD1\x80\xD0\xBB\xD0\xBE\xD0\xB2\xD0\xB0", "2028-02-29", "order 7"}));
  EXPECT_FALSE(other.material.is_said());
  EXPECT_EQ(other.purpose, layout::Purpose{});
}

TEST(OrderTable, QuotesHoldQuotesAndLineEnds) {
  const auto table = read_order("file,name\n\"a \"\"b\"\".dxf\",\"two\nlines\"\nc.dxf,d\n", "o.csv");
  ASSERT_TRUE(table) << table.error().message;
  EXPECT_EQ(table->rows.at(0).file, "a \"b\".dxf");
  EXPECT_EQ(table->rows.at(0).name, "two\nlines");
  EXPECT_EQ(table->rows.at(1).said_in, "o.csv: line 4");
}

TEST(OrderTable, LinesThatEndInACarriageReturnAloneAreCounted) {
  const auto table = read_order("file,quantity\ra.dxf,1\r\rb.dxf,2\r", "o.csv");
  ASSERT_TRUE(table) << table.error().message;
  EXPECT_EQ(table->rows.at(0).said_in, "o.csv: line 2");
  EXPECT_EQ(table->rows.at(1).said_in, "o.csv: line 4");
}

TEST(OrderTable, ColumnsThatNobodyKnowsAreTold) {
  const auto table = read_order(
      "\xEF\xBB\xBF"
      "file,colour\na.dxf,red\n\n,\n",
      "o.csv");
  ASSERT_TRUE(table) << table.error().message;
  EXPECT_EQ(table->rows.size(), 1u);
  ASSERT_EQ(table->notices.size(), 1u);
  EXPECT_NE(table->notices[0].find("'colour'"), std::string::npos);
}

/// The sentence with which a table is refused.
std::string refusal(const std::string& text) {
  const auto table = read_order(text, "o.csv");
  EXPECT_FALSE(table) << text;
  return table ? "" : table.error().message;
}

TEST(OrderTable, EverythingThatIsWrongIsToldAtOnceWithItsLine) {
  const std::string told = refusal("file,quantity,mirror\na.dxf,0,yes\n,2,perhaps\nb.dxf,1,no,4\n");
  for (const char* part : {"line 2: the quantity '0'", "line 3: the mirror 'perhaps'",
                           "line 3: the file is missing", "line 4: 4 cells where 3 columns have names"})
    EXPECT_NE(told.find(part), std::string::npos) << told;
}

TEST(OrderTable, MaterialsAndDaysThatAreNoneAreToldWithTheirLine) {
  const std::string head = "file,thickness,due,customer\na.dxf,";
  for (const auto& [row, told] : std::vector<std::pair<std::string, std::string>>{
           {"thick,,", "line 2: the thickness 'thick' is not a length from 0.001 to 262144 mm"},
           {"0,,", "line 2: the thickness '0' is not a length"},
           {"-2,,", "line 2: the thickness '-2' is not a length"},
           {"300000,,", "line 2: the thickness '300000' is not a length"},
           {"2 furlongs,,", "line 2: the thickness '2 furlongs' is not a length"},
           {"2,1.12.2026,", "line 2: the due '1.12.2026' is not a day, as 2026-12-01"},
           {"2,2026-02-30,", "line 2: the due '2026-02-30' is not a day"},
           {"2,soon,", "line 2: the due 'soon' is not a day"},
           {"2,,\"two\nlines\"",
            "line 2: the customer 'two\\x0alines' is not a text of at most 1,000 bytes on one line"},
           {"2,," + std::string(1001, 'x'), "is not a text of at most 1,000 bytes"}})
    EXPECT_NE(refusal(head + row + "\n").find(told), std::string::npos) << refusal(head + row + "\n");
}

TEST(OrderTable, ATableWithoutFilesOrRowsSaysWhatIsMissing) {
  EXPECT_NE(refusal("name;quantity\na;2\n").find("\"file\" is missing"), std::string::npos);
  EXPECT_NE(refusal("file\n").find("no row follows"), std::string::npos);
  EXPECT_NE(refusal(" \n").find("is empty"), std::string::npos);
  EXPECT_NE(refusal("file\n\"a.dxf\n").find("line 2: a quote is not closed"), std::string::npos);
}

TEST(OrderTable, AThousandWrongRowsAreNotAllTold) {
  std::string text = "file,quantity\n";
  for (int i = 0; i < 1000; ++i) text += "a.dxf,x\n";
  const std::string told = refusal(text);
  EXPECT_LT(told.size(), 2000u);
  EXPECT_NE(told.find("and more"), std::string::npos);
}

TEST(OrderTable, WordsOfAngles) {
  EXPECT_EQ(rotations_of("any"), std::vector<layout::AngleRange>{});
  EXPECT_EQ(rotations_of("0,90, 180")->size(), 3u);
  for (const char* wrong : {"", "a", "0,x", "4000", "nan"}) EXPECT_FALSE(rotations_of(wrong)) << wrong;
  EXPECT_EQ(grain_of("Y"), 90.0);
  EXPECT_EQ(grain_of("-12.5"), -12.5);
  EXPECT_FALSE(grain_of("z"));
  EXPECT_FALSE(quantity_of("2.5"));
  EXPECT_FALSE(quantity_of("1000000001"));
}

}  // namespace
}  // namespace lekalo::io::io_order_table_test
