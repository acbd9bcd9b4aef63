// SPDX-License-Identifier: Apache-2.0
#include "armature/websocket/internal/entry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::websocket::internal {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const Entry kEntry({.port = 8080}, "token", "pass");
const Entry kEncrypted({{"robot.lab", "[fe80::1]"}, 8443, true}, "token", "pass");

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

TEST(Entry, WithACertificateItHasTheNamesOfThatAndNoOthers) {
  for (const char* host : {"robot.lab:8443", "[fe80::1]:8443"}) {
    EXPECT_TRUE(kEncrypted.knows_host({.host = host})) << host;
  }
  for (const char* host : {"robot.lab", "localhost:8443", "127.0.0.1:8443", "a.robot.lab:8443"}) {
    EXPECT_FALSE(kEncrypted.knows_host({.host = host})) << host;
  }
  EXPECT_TRUE(
      kEncrypted.is_own_page({.host = "robot.lab:8443", .origin = "https://robot.lab:8443"}));
  EXPECT_FALSE(
      kEncrypted.is_own_page({.host = "robot.lab:8443", .origin = "http://robot.lab:8443"}));
}

TEST(Entry, BrowsersLeaveOutTheUsualPort) {
  const Entry usual({{"robot.lab"}, 443, true}, "token", "pass");
  EXPECT_TRUE(usual.knows_host({.host = "robot.lab"}));
  EXPECT_FALSE(usual.knows_host({.host = "robot.lab:443"}));
  EXPECT_EQ(usual.url("0.0.0.0"), "https://robot.lab/#token");
}

TEST(Entry, IsOpenedByTheNameItListensAtIfThatIsOneOfIts) {
  EXPECT_EQ(kEntry.url("[::1]"), "http://[::1]:8080/#token");
  EXPECT_EQ(kEncrypted.url("[fe80::1]"), "https://[fe80::1]:8443/#token");
  EXPECT_EQ(kEncrypted.url("0.0.0.0"), "https://robot.lab:8443/#token");
}

TEST(Entry, ACookieFromAnEncryptedAddressGoesToNoOther) {
  EXPECT_THAT(kEncrypted.cookie(), HasSubstr("; Secure"));
  EXPECT_THAT(kEntry.cookie(), Not(HasSubstr("Secure")));
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
