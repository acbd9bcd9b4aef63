// SPDX-License-Identifier: Apache-2.0
#include "armature/runner/internal/program_options.hpp"

#include <chrono>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::runner::internal {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

TEST(ProgramOptions, AreReadWithTheirValuesBehindABlankOrAnEqualsSign) {
  const auto read = parse_options({"--sim", "--for", "250 ms", "--pace=0.5", "--out", "folder",
                                   "--statistics", "--log-json", "--realtime=off"});
  ASSERT_TRUE(read.ok()) << read.error();
  const RunOptions& run = read.value().run;
  EXPECT_TRUE(run.simulated);
  EXPECT_EQ(run.duration, base::Duration(250ms));
  EXPECT_EQ(run.rate, 0.5);
  EXPECT_EQ(run.output_folder, "folder");
  EXPECT_TRUE(run.statistics);
  EXPECT_TRUE(read.value().json);
  EXPECT_EQ(run.realtime, exec::RealtimeMode::kOff);
}

TEST(ProgramOptions, WithoutAnyItRunsInRealTimeUntilStopped) {
  const auto read = parse_options({});
  ASSERT_TRUE(read.ok());
  EXPECT_FALSE(read.value().run.simulated);
  EXPECT_FALSE(read.value().run.duration);
  EXPECT_EQ(read.value().run.realtime, exec::RealtimeMode::kPrefer);
  EXPECT_TRUE(read.value().run.urges());
}

TEST(ProgramOptions, ThatAreWrongAreNamed) {
  const auto error = [](const std::vector<std::string>& words) {
    const auto read = parse_options(words);
    return read.ok() ? std::string() : read.error();
  };
  EXPECT_THAT(error({"--simm"}), HasSubstr("unknown option '--simm' (did you mean '--sim'?)"));
  EXPECT_EQ(error({"--for"}), "--for needs a value");
  EXPECT_EQ(error({"--for", "0s"}), "--for: '0s' must be a duration above 0, for example 10s");
  EXPECT_EQ(error({"--sim", "--pace", "-1"}), "--pace: '-1' must be a number above 0");
  EXPECT_EQ(error({"--realtime=now"}), "--realtime: 'now' must be off, prefer or require");
  EXPECT_EQ(error({"--pace", "2"}), "--pace needs --sim");
  EXPECT_EQ(error({"--sim=yes"}), "--sim takes no value");
}

}  // namespace
}  // namespace armature::runner::internal
