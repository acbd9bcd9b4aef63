// SPDX-License-Identifier: Apache-2.0
#include "armature/websocket/internal/entry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::websocket::internal {
namespace {

using ::testing::HasSubstr;

const Entry kEntry(8080, "token", "pass");

TEST(Entry, KnowsTheNamesOfThisMachineWithItsPort) {
  for (const char* host : {"127.0.0.1:8080", "localhost:8080", "[::1]:8080"}) {
    EXPECT_TRUE(kEntry.knows_host({.host = host})) << host;
  }
  for (const char* host : {"", "127.0.0.1", "127.0.0.1:80", "127.0.0.1:80801", "evil.example:8080",
                           "127.0.0.1:8080.evil.example", "LOCALHOST:8080", "localhost:8080, a"}) {
    EXPECT_FALSE(kEntry.knows_host({.host = host})) << host;
  }
}

TEST(Entry, APageIsItsOwnIfItCameFromTheAddressItAsks) {
  EXPECT_TRUE(kEntry.is_own_page({.host = "localhost:8080", .origin = "http://localhost:8080"}));
  for (const char* origin :
       {"", "null", "http://127.0.0.1:8080", "https://localhost:8080", "http://localhost:8081",
        "http://evil.example", "http://localhost:8080.evil.example"}) {
    EXPECT_FALSE(kEntry.is_own_page({.host = "localhost:8080", .origin = origin})) << origin;
  }
  EXPECT_FALSE(kEntry.is_own_page({.host = "evil.example", .origin = "http://evil.example"}));
}

TEST(Entry, TheTokenIsWholeAndExact) {
  EXPECT_TRUE(kEntry.has_token({.authorization = "Bearer token"}));
  for (const char* given : {"", "token", "Bearer ", "Bearer toke", "Bearer tokens", "Bearer Token",
                            "Basic token", "Bearer pass"}) {
    EXPECT_FALSE(kEntry.has_token({.authorization = given})) << given;
  }
}

TEST(Entry, ThePassIsAmongTheCookiesByItsPort) {
  EXPECT_TRUE(kEntry.has_pass({.cookie = "armature-8080=pass"}));
  EXPECT_TRUE(kEntry.has_pass({.cookie = "a=b; armature-8080=pass; armature-81=x"}));
  for (const char* given : {"", "armature-8080=", "armature-8080=pas", "armature-8080=passs",
                            "armature-8081=pass", "xarmature-8080=pass", "armature-8080=token"}) {
    EXPECT_FALSE(kEntry.has_pass({.cookie = given})) << given;
  }
}

TEST(Entry, NoScriptReadsTheCookieAndNoOtherSiteSendsIt) {
  EXPECT_EQ(kEntry.cookie(), "armature-8080=pass; HttpOnly; SameSite=Strict; Path=/");
}

TEST(Entry, PagesUseWhatComesFromHereOnly) {
  EXPECT_THAT(kEntry.content_policy(), HasSubstr("default-src 'self';"));
  EXPECT_THAT(kEntry.content_policy(), HasSubstr("frame-ancestors 'none'"));
}

}  // namespace
}  // namespace armature::websocket::internal
