// The drawings of other programs and people, held against what ezdxf and svgelements find in them
// (tests/corpus/drawings.csv, written by tests/support/drawings_oracle.py).

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "lekalo/disk/files.hpp"
#include "lekalo/io/formats/any_layout.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "support/shared_data.hpp"

namespace lekalo::io {
namespace {

struct Row {
  std::string file, sha256, verdict;
};

/// Cells may stand in quotes, which double inside.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

std::vector<Row> rows() {
  std::ifstream in(cases::source_dir() + "/tests/corpus/drawings.csv");
  std::vector<Row> rows;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    const auto cells = cells_of(line);
    if (cells.size() != 9) ADD_FAILURE() << line;
    rows.push_back({cells[0], cells[1], cells[2]});
  }
  return rows;
}

class Drawings : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = cases::shared_data();
    if (folder_.empty()) GTEST_SKIP() << "the drawings are kept outside the project, and are not here";
  }
  [[nodiscard]] std::string bytes_of(const Row& row) const {
    const auto bytes = disk::read_file(folder_ + "/" + row.file);
    EXPECT_TRUE(bytes.has_value()) << row.file;
    return bytes.value_or("");
  }
  std::string folder_;
};

TEST_F(Drawings, GiveLayoutsWhereTheyEncloseSomethingAndOneSentenceElsewhere) {
  std::size_t enclosing = 0, given = 0, parts = 0, marks = 0, files = 0;
  for (const Row& row : rows()) {
    SCOPED_TRACE(row.file);
    const std::string bytes = bytes_of(row);
    EXPECT_EQ(sha256(bytes).substr(0, 16), row.sha256) << "another file than the table was made from";
    const auto read = read_any_layout(bytes, row.file);
    ++files;
    if (!read) {
      EXPECT_EQ(read.error().code, ErrorCode::bad_input);
      EXPECT_EQ(read.error().message.find('\n'), std::string::npos);
      EXPECT_EQ(read.error().message.rfind(row.file, 0), 0u) << read.error().message;
    }
    if (row.verdict == "encloses") {
      ++enclosing;
      given += read ? 1 : 0;
      if (!read) std::printf("no layout: %s\n", read.error().message.c_str());
    } else if (row.verdict != "unknown" && row.verdict != "beyond") {
      ASSERT_FALSE(read.has_value()) << "nothing is enclosed";
    }
    if (read)
      for (const layout::Part& part : read->document.parts) {
        parts += static_cast<std::size_t>(part.demand);
        marks += part.marks.size() * static_cast<std::size_t>(part.demand);
      }
  }
  std::printf("%zu files, %zu enclose something, %zu layouts, %zu pieces, %zu marks\n", files, enclosing,
              given, parts, marks);
  EXPECT_GE(files, 120u);
  EXPECT_GE(static_cast<double>(given), 0.98 * static_cast<double>(enclosing));
}

}  // namespace
}  // namespace lekalo::io
