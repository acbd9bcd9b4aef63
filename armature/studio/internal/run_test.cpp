// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/run.hpp"

#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <limits>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/platform/file.hpp"

namespace armature::studio::internal {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Runs of a program that does what a line of shell says.
struct Started : ::testing::Test {
  Started() {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
  }
  ~Started() override { std::filesystem::remove_all(folder); }

  /// What its command says is: `echo` writes its own arguments.
  internal::Run run_of(const std::string& script) {
    const std::string program = folder + "/program";
    EXPECT_TRUE(platform::write_file(program, "#!/bin/sh\n" + script + "\n"));
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    return internal::Run({program, "--library-path", "libraries"}, "arm.yaml", folder);
  }
  static void until(internal::Run& run, const std::function<bool()>& condition) {
    while (!condition()) {
      run.look();
      std::this_thread::sleep_for(1ms);
    }
  }
  static void until_over(internal::Run& run) {
    until(run, [&] { return run.is_over(); });
  }

  const std::string folder = ::testing::TempDir() + "studio_run_test";
};

TEST_F(Started, SaysWhatWasAskedForAndHowItEnded) {
  internal::Run run = run_of("echo \"$@\"; exit 3");
  EXPECT_EQ(run.stage(), RunStage::kNone);
  ASSERT_TRUE(run.start({true, 0.1, "hold", {"joints=2"}, 5}));
  EXPECT_EQ(run.stage(), RunStage::kStarting);
  EXPECT_EQ(run.number(), 1);
  EXPECT_EQ(run.version(), 5);
  until_over(run);
  EXPECT_EQ(run.stage(), RunStage::kEnded);
  EXPECT_EQ(run.exit_code(), 3);
  EXPECT_THAT(run.log(0, 10),
              ElementsAre("run arm.yaml --library-path libraries --listen unix:" + folder +
                          "/run.sock --sim --pace 0.1 --mode hold --set "
                          "joints=2"));
}

TEST_F(Started, AsFastAsPossibleIsNoPaceAndRealTimeNoSimulation) {
  internal::Run run = run_of("echo \"$@\"");
  ASSERT_TRUE(run.start({.simulated = true, .pace = std::numeric_limits<double>::infinity()}));
  until_over(run);
  EXPECT_TRUE(run.log(0, 1).at(0).ends_with("--sim"));
  ASSERT_TRUE(run.start({.simulated = false, .pace = 1.0}));
  until_over(run);
  EXPECT_THAT(run.log(run.log_begin(), 1).at(0), ::testing::Not(HasSubstr("--sim")));
  EXPECT_FALSE(run.start({.simulated = true, .pace = 0.0}));
}

TEST_F(Started, NoWordOfAnOrderBecomesAnOption) {
  internal::Run run = run_of("echo \"$@\"");
  for (const char* setting : {"--listen=tcp://0.0.0.0:1", "-L=there", "joints", "=2", ""}) {
    EXPECT_THAT(run.start({.simulated = true, .pace = 1.0, .overrides = {setting}}).error(),
                HasSubstr("expected NAME=VALUE"))
        << setting;
  }
  EXPECT_THAT(run.start({.simulated = true, .pace = 1.0, .mode = "--arm"}).error(),
              HasSubstr("must not begin with '-'"));
  EXPECT_EQ(run.stage(), RunStage::kNone);
}

TEST_F(Started, OneRunsAtATimeAndStopsInOrder) {
  internal::Run run =
      run_of("trap 'echo stopping; exit 0' TERM; echo ready; while :; do sleep 0.01; done");
  ASSERT_TRUE(run.start({}));
  EXPECT_FALSE(run.start({}));
  until(run, [&] { return run.log_end() == 1; });
  run.set_answers();
  EXPECT_EQ(run.stage(), RunStage::kRunning);
  EXPECT_TRUE(run.stop());
  EXPECT_EQ(run.stage(), RunStage::kStopping);
  until_over(run);
  EXPECT_EQ(run.exit_code(), 0);
  EXPECT_THAT(run.log(0, 10), ElementsAre("ready", "stopping"));
  EXPECT_FALSE(run.stop());
}

TEST_F(Started, AnotherStudioFindsItAgain) {
  int id = 0;
  {
    // The shell keeps the arguments in its command line.
    internal::Run run = run_of("echo $$; while :; do sleep 0.01; done");
    ASSERT_TRUE(run.start({.simulated = true, .pace = 1.0}));
    until(run, [&] { return run.log_end() == 1; });
    id = std::stoi(run.log(0, 1).at(0));
  }
  internal::Run later({folder + "/program"}, "arm.yaml", folder);
  EXPECT_EQ(later.stage(), RunStage::kStarting);
  EXPECT_TRUE(later.is_simulated());
  EXPECT_TRUE(later.look());
  EXPECT_EQ(later.log(0, 1).at(0), std::to_string(id));
  EXPECT_TRUE(later.stop());
  until_over(later);
  EXPECT_EQ(later.exit_code(), -1);
  internal::Run last({folder + "/program"}, "arm.yaml", folder);
  EXPECT_EQ(last.stage(), RunStage::kNone);
}

TEST_F(Started, OfTheLogTheLastLinesAreKept) {
  internal::Run run = run_of("seq 1 10100");
  ASSERT_TRUE(run.start({}));
  until_over(run);
  EXPECT_EQ(run.log_begin(), 100);
  EXPECT_EQ(run.log_end(), 10100);
  EXPECT_THAT(run.log(0, 2), ElementsAre("101", "102"));
  EXPECT_THAT(run.log(10099, 500), ElementsAre("10100"));
  EXPECT_TRUE(run.log(20000, 500).empty());
}

TEST_F(Started, ANoteThatLiesFindsNothing) {
  for (const char* note : {"", "[]", "{}", R"({"process": "1"})", R"({"process": 1})"}) {
    ASSERT_TRUE(platform::write_file(folder + "/run.json", note));
    const internal::Run run({"program"}, "arm.yaml", folder);
    EXPECT_EQ(run.stage(), RunStage::kNone) << note;
  }
}

}  // namespace
}  // namespace armature::studio::internal
