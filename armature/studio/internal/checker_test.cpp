// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/checker.hpp"

#include <chrono>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::studio::internal {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

/// A checker that answers as a line of shell does.
struct Asked : ::testing::Test {
  static Checker checker(const std::string& answer) {
    return Checker({"/bin/sh", "-c", "n=0; while read line; do n=$((n+1)); " + answer + "; done"});
  }
  /// The result of a request, or `error: ` and why there is none.
  static std::string result(Checker& checker, const std::string& request = R"({"do":"check"})") {
    std::optional<std::string> result;
    checker.ask(request, [&](base::Result<std::string> told) {
      result = told ? told.value() : "error: " + told.error();
    });
    while (!result) {
      checker.take();
      std::this_thread::sleep_for(1ms);
    }
    return *result;
  }
};

TEST_F(Asked, GivesTheResult) {
  Checker checker = Asked::checker(R"(echo '{"id":0,"result":{"n":'$n'}}')");
  EXPECT_EQ(result(checker), R"({"n":1})");
  EXPECT_EQ(result(checker), R"({"n":2})");
}

TEST_F(Asked, SendsTheRequestWithAnId) {
  Checker checker = Asked::checker(R"(echo '{"id":0,"result":'"$line"'}')");
  EXPECT_EQ(result(checker), R"({"id":0,"do":"check"})");
}

TEST_F(Asked, GivesTheErrorAndGoesOn) {
  Checker checker = Asked::checker(R"(echo '{"id":0,"error":"nothing was checked yet"}')");
  EXPECT_EQ(result(checker), "error: nothing was checked yet");
  EXPECT_EQ(result(checker), "error: nothing was checked yet");
}

TEST_F(Asked, WhatLibrariesPrintIsNoAnswer) {
  Checker checker = Asked::checker(R"(echo hello; echo '{"id":0,"result":1}')");
  EXPECT_EQ(result(checker), "1");
}

TEST_F(Asked, ACrashIsToldAndAnotherProcessAnswersTheNext) {
  Checker checker =
      Asked::checker(R"(case $line in *bad*) kill -9 $$;; esac; echo '{"id":0,"result":'$n'}')");
  EXPECT_EQ(result(checker), "1");
  EXPECT_THAT(result(checker, R"({"do":"bad"})"), HasSubstr("a component library has crashed"));
  EXPECT_EQ(result(checker), "1");
}

TEST_F(Asked, ARenewedOneBeginsAnew) {
  Checker checker = Asked::checker(R"(echo '{"id":0,"result":'$n'}')");
  EXPECT_EQ(result(checker), "1");
  checker.renew();
  EXPECT_EQ(result(checker), "1");
}

TEST(CheckerWithoutProgram, TellsWhy) {
  Checker checker({"/nowhere/armature"});
  std::string why;
  checker.ask("{}", [&](const base::Result<std::string>& told) { why = told.error(); });
  EXPECT_THAT(why, HasSubstr("cannot start '/nowhere/armature'"));
}

}  // namespace
}  // namespace armature::studio::internal
