// SPDX-License-Identifier: Apache-2.0
#include "armature/replay/comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::replay {
namespace {

using record::McapRecording;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

base::Time at_ms(int ms) { return base::Time{} + std::chrono::milliseconds(ms); }

/// Three cycles of a loop: Joint -> PID -> Joint.
McapRecording loop() {
  McapRecording recording;
  recording.channels = {{"Joint.Position", "", "", "", ""},
                        {"Joint.Voltage", "", "", "", ""},
                        {"PID.Out", "", "", "", ""}};
  for (std::uint32_t cycle = 1; cycle <= 3; ++cycle) {
    for (record::ChannelId channel = 0; channel < 3; ++channel) {
      recording.samples.push_back({channel, at_ms(10 * static_cast<int>(cycle)), cycle,
                                   "{\"value\":" + std::to_string(cycle) + "}"});
    }
  }
  return recording;
}
const std::vector<Flow> kFlows = {{"Joint.Position", "PID.Sen"}, {"PID.Out", "Joint.In"}};
const std::vector<std::string> kOrder = {"Joint", "PID"};

record::RecordedSample& sample(McapRecording& recording, std::size_t cycle, std::size_t channel) {
  return recording.samples.at(3 * (cycle - 1) + channel);
}

TEST(Comparison, OfEqualRecordingsCountsSamplesAndChannels) {
  const Comparison found = compare(loop(), loop(), {});
  EXPECT_EQ(found.equal, 9u);
  EXPECT_EQ(found.channels, 3u);
  EXPECT_EQ(found.missing, 0u);
  EXPECT_FALSE(found.first(kFlows, kOrder).has_value());
}

TEST(Comparison, LooksAtChannelsOfInterestAlone) {
  McapRecording is = loop();
  sample(is, 2, 0).json = "{\"value\":7}";
  sample(is, 3, 2).json = "{\"value\":8}";
  const std::set<std::string> channels = {"PID.Out"};
  const Comparison found = compare(loop(), is, {.channels = &channels});
  EXPECT_EQ(found.equal, 2u);
  EXPECT_EQ(found.different, 1u);
  ASSERT_EQ(found.differences.size(), 1u);
  EXPECT_EQ(found.differences[0].channel, "PID.Out");
}

TEST(Comparison, LeavesTimesAloneIfItIsTold) {
  McapRecording is = loop();
  for (record::RecordedSample& one : is.samples) one.time += std::chrono::microseconds(3);
  EXPECT_EQ(compare(loop(), is, {}).different, 9u);
  EXPECT_EQ(compare(loop(), is, {.times = false}).equal, 9u);
}

TEST(Comparison, TellsTheEarliestDifference) {
  McapRecording is = loop();
  sample(is, 3, 0).json = "{\"value\":7}";
  sample(is, 2, 2).json = "{\"value\":8}";
  const auto first = compare(loop(), is, {}).first(kFlows, kOrder);
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(first->channel, "PID.Out");
  EXPECT_EQ(first->time, at_ms(20));
  EXPECT_EQ(first->sequence, 2u);
  EXPECT_EQ(first->was, "{\"value\":2}");
  EXPECT_EQ(first->is, "{\"value\":8}");
}

TEST(Comparison, TellsWhatIsUpstreamAlsoInALoop) {
  McapRecording is = loop();
  sample(is, 2, 1).json = "{\"value\":7}";  // the voltage follows from what the PID says
  sample(is, 2, 2).json = "{\"value\":8}";
  EXPECT_EQ(compare(loop(), is, {}).first(kFlows, kOrder)->channel, "PID.Out");
  sample(is, 2, 0).json = "{\"value\":9}";  // now all of it differs: the first in order
  EXPECT_EQ(compare(loop(), is, {}).first(kFlows, kOrder)->channel, "Joint.Position");
}

TEST(Comparison, TellsOfASampleThatOneOfThemLacks) {
  McapRecording is = loop();
  is.samples.erase(is.samples.begin() + 5);
  const auto first = compare(loop(), is, {}).first(kFlows, kOrder);
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(first->channel, "PID.Out");
  EXPECT_EQ(first->is, "no such sample");
  EXPECT_EQ(compare(is, loop(), {}).first(kFlows, kOrder)->was, "no such sample");
}

TEST(Comparison, WhatTheRecorderLostIsNeitherEqualNorDifferent) {
  McapRecording was = loop();
  was.samples.erase(was.samples.begin() + 5);
  ComparisonOptions options;
  options.losses = true;
  const Comparison found = compare(was, loop(), options);
  EXPECT_FALSE(found.first(kFlows, kOrder).has_value());
  EXPECT_EQ(found.equal, 8u);
  EXPECT_EQ(found.missing, 1u);
}

TEST(Comparison, LooksAtAllSamplesOfAChannelThatNobodyCounts) {
  McapRecording was = loop();
  for (auto& one : was.samples) one.sequence = 0;
  const McapRecording same = was;
  McapRecording is = was;
  sample(is, 3, 0).json = "{\"value\":7}";
  EXPECT_EQ(compare(was, same, {}).equal, 9u);
  const auto first = compare(was, is, {}).first(kFlows, kOrder);
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(first->time, at_ms(30));
  is = was;
  is.samples.erase(is.samples.begin() + 3);
  EXPECT_EQ(compare(was, is, {}).first(kFlows, kOrder)->is, "no such sample");
}

TEST(Comparison, EndsWithARecordingThatWasCutOff) {
  McapRecording was = loop();
  was.samples.resize(7);
  was.closed = false;
  const Comparison found = compare(was, loop(), {});
  EXPECT_FALSE(found.first(kFlows, kOrder).has_value());
  EXPECT_EQ(found.equal, 6u) << "of the last time some may be missing";
}

TEST(Comparison, NamesChannelsThatAreNotThereAnyMore) {
  McapRecording is = loop();
  for (auto& channel : is.channels) {
    if (channel.name == "PID.Out") channel.name = "PID.Output";
  }
  EXPECT_THAT(compare(loop(), is, {}).only_recorded, ElementsAre("PID.Out"));
  EXPECT_THAT(compare(loop(), loop(), {}).only_recorded, IsEmpty());
}

}  // namespace
}  // namespace armature::replay
