// The main of all test programs. Called by the name KIND_NAME, a program runs the tests of
// tests/KIND/NAME_test.cpp, of those that a filter leaves.

#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <string>

namespace {

std::filesystem::path file_name(const char* path) { return std::filesystem::path(path).filename(); }

/// Takes all tests of other files than this one out of gtest's filter. Returns whether it has tests.
bool keep_to(const std::string& file) {
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  bool found = false;
  std::string filter = GTEST_FLAG_GET(filter);
  char before = filter.find('-') == std::string::npos ? '-' : ':';
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    for (int j = 0; j < suite.total_test_count(); ++j) {
      const testing::TestInfo& test = *suite.GetTestInfo(j);
      if (file_name(test.file()) == file) {
        found = true;
        continue;
      }
      filter += std::string(1, before) + suite.name() + "." + test.name();
      before = ':';
    }
  }
  GTEST_FLAG_SET(filter, filter);
  return found;
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
