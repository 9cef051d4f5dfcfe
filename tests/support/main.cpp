// The main of all test programs. Called by the name KIND_NAME, a program runs the tests of
// tests/KIND/NAME_test.cpp, of those that a filter leaves.

#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <string>

namespace {

std::filesystem::path file_name(const char* path) { return std::filesystem::path(path).filename(); }

/// Leaves in gtest's filter the tests that are written in this file alone. Returns whether it has tests.
bool keep_to(const std::string& file) {
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  std::string own, others;
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    std::string own_here, others_here;
    for (int j = 0; j < suite.total_test_count(); ++j) {
      const testing::TestInfo& test = *suite.GetTestInfo(j);
      (file_name(test.file()) == file ? own_here : others_here) +=
          std::string(":") + suite.name() + "." + test.name();
    }
    const std::string whole = std::string(":") + suite.name() + ".*";
    own += others_here.empty() ? whole : own_here;
    others += own_here.empty() ? whole : others_here;
  }
  if (own.empty()) return false;
  // The filter is printed, so that the shorter list is the better one; a given one is kept.
  const std::string given = GTEST_FLAG_GET(filter);
  if (given == "*") {
    GTEST_FLAG_SET(filter, own.substr(1));
  } else if (!others.empty()) {
    others[0] = given.find('-') == std::string::npos ? '-' : ':';
    GTEST_FLAG_SET(filter, given + others);
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const std::string called = file_name(argv[0]).string();
  const std::string file = called.substr(called.find('_') + 1) + "_test.cpp";
  if (!keep_to(file)) {
    std::cerr << called << ": there are no tests of " << file << " here\n";
    return 1;
  }
  return RUN_ALL_TESTS();
}
