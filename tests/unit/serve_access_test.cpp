// Who may ask the server, and what is not taken as a token.

#include <gtest/gtest.h>

#include <string>

#include "server/access.hpp"

namespace lekalo::server::serve_access_test {
namespace {

constexpr const char* kToken = "0123456789abcdef0123456789abcdef";

bool refused(const AccessRules& rules, const Credentials& request) {
  return refusal(rules, request).has_value();
}

TEST(Access, AsksForOurNameAndOurPage) {
  const AccessRules open{"127.0.0.1", 8080, false, ""};
  EXPECT_FALSE(refused(open, {"127.0.0.1:8080", "", "", "", "", "", false}));
  EXPECT_FALSE(refused(open, {"localhost:8080", "http://localhost:8080", "", "", "", "", false}));
  for (const char* host : {"", "evil.example:8080", "127.0.0.1", "127.0.0.1:8081", "127.0.0.1:8080.evil"})
    EXPECT_TRUE(refused(open, {host, "", "", "", "", "", false})) << host;
  for (const char* origin : {"http://evil.example", "null", "https://localhost:8080", "http://localhost"})
    EXPECT_TRUE(refused(open, {"localhost:8080", origin, "", "", "", "", false})) << origin;
}

TEST(Access, RefusesWhatABrowserSendsForAnotherSite) {
  const AccessRules open{"127.0.0.1", 8080, false, ""};
  const auto from = [&](const char* site, bool opens_page) {
    return refused(open, {"localhost:8080", "", "", "", "", site, opens_page});
  };
  for (const char* site : {"same-origin", "none"}) EXPECT_FALSE(from(site, false)) << site;
  // Another port of this machine is "same-site", and another program's.
  for (const char* site : {"cross-site", "same-site", "Same-Origin", "x"})
    EXPECT_TRUE(from(site, false)) << site;
  EXPECT_FALSE(from("cross-site", true));  // a link in a letter that somebody follows
}

TEST(Access, AsksForTheToken) {
  const AccessRules locked{"0.0.0.0", 80, true, kToken};
  const std::string token = kToken;
  const auto asks = [&](const std::string& authorization, const std::string& cookie,
                        const std::string& query) {
    return refusal(locked, {"any:80", "", authorization, cookie, query, "", false});
  };
  ASSERT_TRUE(asks("", "", ""));
  EXPECT_FALSE(asks("", "", "")->wrong_token);
  EXPECT_TRUE(asks("Bearer " + token.substr(1), "", "x")->wrong_token);
  EXPECT_TRUE(asks("", "lekalo_token=wrong; lekalo_token=" + token, "")->wrong_token);
  EXPECT_FALSE(asks("", "", token));
  EXPECT_FALSE(asks("Bearer " + token, "", ""));
  EXPECT_FALSE(asks("", "a=b; lekalo_token=" + token, ""));
}

TEST(Access, TakesTokensOf128BitsAlone) {
  EXPECT_TRUE(check_token(kToken));
  EXPECT_TRUE(check_token("3q2-7wDerb7vAAECAwQFBg"));  // 16 bytes in base64 for addresses
  EXPECT_TRUE(check_token(std::string(kToken) + std::string(168, 'g')));
  for (const std::string& token :
       {std::string(), std::string("short"), std::string(kToken).substr(1), std::string(200, 'a'),
        std::string("3q2-7wDerb7vAAECAwQFB"), std::string("3q2+7wDerb7vAAECAwQFBg"),
        std::string("3q2-7wDerb7vAAECAwQFBg=="), std::string(kToken) + " ",
        std::string(kToken) + std::string(169, 'g')}) {
    const Result<void> read = check_token(token);
    ASSERT_FALSE(read) << token;
    EXPECT_EQ(read.error().code, ErrorCode::usage);
  }
}

TEST(Guesses, AreAnsweredSlowerAndSlowerAndOthersAreNotHeldUp) {
  Guesses guesses;
  for (int i = 0; i < 10; ++i) EXPECT_EQ(guesses.wrong("a", 100), 0.0) << i;
  for (int i = 1; i <= 10; ++i) EXPECT_EQ(guesses.wrong("a", 100), double(i));
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(guesses.wrong("a", 100), std::nullopt);
  EXPECT_EQ(guesses.wrong("b", 100), 0.0);
  EXPECT_EQ(guesses.wrong("a", 101), 10.0);  // silence pays, one each second
  EXPECT_EQ(guesses.wrong("a", 200), 0.0);
}

TEST(Guesses, OfManyPeersTakeBoundedMemory) {
  Guesses guesses;
  for (int i = 0; i < 20'000; ++i) static_cast<void>(guesses.wrong(std::to_string(i), 5));
  EXPECT_LE(guesses.peers(), 10'001u);
  static_cast<void>(guesses.wrong("late", 1000));
  EXPECT_EQ(guesses.peers(), 1u);
}

}  // namespace
}  // namespace lekalo::server::serve_access_test
