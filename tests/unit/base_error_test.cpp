#include "lekalo/base/error.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace lekalo::base_error_test {
namespace {

Result<int> half(int n) {
  if (n % 2 != 0) return failure(ErrorCode::bad_input, "odd");
  return n / 2;
}

Result<int> quarter(int n) {
  LEKALO_TRY(const int first, half(n));
  LEKALO_TRY(const int second, half(first));
  return second;
}

TEST(PassedOn, AValueIsTaken) { EXPECT_EQ(quarter(12).value(), 3); }

TEST(PassedOn, AnErrorLeavesTheFunctionAsItIs) {
  for (const int n : {5, 6}) {
    const auto result = quarter(n);
    ASSERT_FALSE(result) << n;
    EXPECT_EQ(result.error().code, ErrorCode::bad_input);
    EXPECT_EQ(result.error().message, "odd");
  }
}

TEST(PassedOn, AValueIsAssignedToWhatIsThere) {
  const auto last_of = [](int a, int b) -> Result<int> {
    int last = 0;
    LEKALO_TRY(last, half(a));
    LEKALO_TRY(last, half(b));
    return last;
  };
  EXPECT_EQ(last_of(2, 8).value(), 4);
}

TEST(PassedOn, AValueThatCannotBeCopiedIsMoved) {
  const auto taken = []() -> Result<int> {
    LEKALO_TRY(const auto held, Result<std::unique_ptr<int>>(std::make_unique<int>(7)));
    return *held;
  };
  EXPECT_EQ(taken().value(), 7);
}

TEST(PassedOn, WhatHasANameKeepsItsValue) {
  const Result<std::string> named = std::string("kept");
  const auto taken = [&]() -> Result<std::size_t> {
    LEKALO_TRY(const auto copy, named);
    return copy.size();
  };
  EXPECT_EQ(taken().value(), 4);
  EXPECT_EQ(*named, "kept");
}

TEST(PassedOn, ACheckIsOneStatementAndLooksOnce) {
  int calls = 0;
  const auto looked = [&](int n, bool look) -> Result<void> {
    const auto counted = [&] { return ++calls, half(n); };
    if (look)
      LEKALO_CHECK(counted());
    else
      calls += 100;
    return {};
  };
  EXPECT_TRUE(looked(2, true));
  EXPECT_EQ(calls, 1);
  EXPECT_FALSE(looked(3, true));
  EXPECT_EQ(calls, 2);
  EXPECT_TRUE(looked(3, false));
  EXPECT_EQ(calls, 102);
}

TEST(PassedOn, AnErrorOfAnyKindGoesOn) {
  const auto word = [](bool known) -> tl::expected<int, std::string> {
    if (!known) return tl::unexpected<std::string>("unknown");
    return 1;
  };
  const auto asked = [&](bool known) -> tl::expected<int, std::string> {
    LEKALO_CHECK(word(known));
    LEKALO_TRY(const int value, word(known));
    return value;
  };
  EXPECT_EQ(asked(true).value(), 1);
  EXPECT_EQ(asked(false).error(), "unknown");
}

}  // namespace
}  // namespace lekalo::base_error_test
