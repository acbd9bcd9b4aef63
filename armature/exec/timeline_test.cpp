// SPDX-License-Identifier: Apache-2.0
// What an application's threads did when, step by step.
#include "armature/exec/timeline.hpp"

#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/host.hpp"
#include "armature/exec/internal/test_components.hpp"

namespace armature::exec {
namespace {

using ::testing::ElementsAre;
using Kind = TimelineSlice::Kind;

/// Keeps all slices; names are copied since they belong to the application.
struct Kept {
  struct Slice : TimelineSlice {
    std::string thread_text;
    std::string component_text;
    base::Time end() const { return begin + length; }
  };
  std::vector<Slice> slices;

  ApplicationOptions options(bool simulated) {
    ApplicationOptions options = patient(simulated);
    options.timeline.share = 1e6;  // every step, however slow the machine
    options.timeline.sink = [this](const TimelineSlice& slice) {
      Slice kept;
      static_cast<TimelineSlice&>(kept) = slice;
      kept.thread_text = slice.thread_name;
      kept.component_text = slice.component;
      slices.push_back(kept);
    };
    return options;
  }
  std::vector<std::string> texts() const {
    std::vector<std::string> texts;
    for (const Slice& slice : slices) {
      const bool step = slice.kind == Kind::kStep;
      texts.push_back(slice.thread_text + ": " +
                      (step ? "  " + slice.component_text
                            : (slice.kind == Kind::kCycle ? "cycle " : "messages ") +
                                  std::to_string(slice.cycle)));
    }
    return texts;
  }
  std::uint64_t lost() const {
    std::uint64_t sum = 0;
    for (const Slice& slice : slices) sum += slice.kind == Kind::kLost ? slice.missing : 0;
    return sum;
  }
};

/// Source ticks (an event), counts, and its count goes through Double to Sink.
Blueprint loop(const Activity& sink) {
  Blueprint blueprint;
  blueprint.add<Counter>("Source", Activity::periodic(10ms, 50));
  blueprint.add<Gain>("Double");
  blueprint.add<Sink>("Sink", sink);
  blueprint.connect("Source.Count", "Double.In");
  blueprint.connect("Double.Out", "Sink.In");
  blueprint.add_peer("Sink", "Source");
  return blueprint;
}

TEST(TimelineOfAnApplication, HasEachCycleAndWithinItWhoRanInWhichOrder) {
  Kept kept;
  Application application(loop({}), kept.options(true));
  ASSERT_TRUE(application.start().ok());
  application.run_for(20ms);
  application.stop();
  EXPECT_THAT(
      kept.texts(),
      ElementsAre("Source: cycle 1", "Source:   Source", "Source:   Sink", "Source:   Source",
                  "Source:   Double", "Source:   Source", "Source: cycle 2", "Source:   Source",
                  "Source:   Sink", "Source:   Source", "Source:   Double", "Source:   Source"));
  for (const auto& slice : kept.slices) EXPECT_TRUE(slice.detailed || slice.kind == Kind::kStep);
}

TEST(TimelineOfAnApplication, StepsLieWithinTheirCycleOneAfterTheOther) {
  Kept kept;
  Application application(loop({}), kept.options(true));
  ASSERT_TRUE(application.start().ok());
  application.run_for(100ms);
  application.stop();
  base::Time cycle_end{};
  base::Time done{};
  int cycles = 0;
  for (const auto& slice : kept.slices) {
    EXPECT_GE(slice.begin, done);
    if (slice.kind == Kind::kCycle) {
      ++cycles;
      EXPECT_EQ(slice.begin, base::Time(cycles * 10ms));  // the simulated time, exactly
      EXPECT_EQ(slice.cycle_time, slice.begin);
      EXPECT_GT(slice.length, 0ns);
      cycle_end = slice.end();
      done = slice.begin;
    } else {
      EXPECT_LE(slice.end(), cycle_end);
      done = slice.end();
    }
  }
  EXPECT_EQ(cycles, 10);
}

TEST(TimelineOfAnApplication, InSimulatedTimeThreadsThatTakeTurnsAtAnInstantFollowEachOther) {
  Kept kept;
  Application application(loop(Activity::triggered(40)), kept.options(true));
  ASSERT_TRUE(application.start().ok());
  application.run_for(10ms);
  application.stop();
  EXPECT_THAT(kept.texts(), ElementsAre("Source: cycle 1", "Source:   Source", "Source:   Double",
                                        "Source:   Source", "Sink: cycle 1", "Sink:   Sink"));
  const auto& source = kept.slices.front();
  const auto& sink = kept.slices[4];
  EXPECT_EQ(sink.cycle_time, source.cycle_time);
  EXPECT_EQ(sink.begin, source.end());
  EXPECT_NE(sink.thread, source.thread);
}

TEST(TimelineOfAnApplication, InRealTimeNoCycleIsMissingAndNoTwoOfAThreadOverlap) {
  Kept kept;
  Application application(loop(Activity::triggered(40)), kept.options(false));
  ASSERT_TRUE(application.start().ok());
  ASSERT_TRUE(run_until(application, [&] { return kept.slices.size() > 50; }));
  application.stop();
  EXPECT_EQ(kept.lost(), 0u);
  std::map<std::string, std::uint64_t> cycles;
  std::map<std::string, base::Time> done;
  for (const auto& slice : kept.slices) {
    if (slice.kind == Kind::kStep) continue;
    EXPECT_GE(slice.begin, done[slice.thread_text]);
    done[slice.thread_text] = slice.end();
    if (slice.kind != Kind::kCycle) continue;
    EXPECT_EQ(slice.cycle, ++cycles[slice.thread_text]);
  }
  EXPECT_GT(cycles["Source"], 5u);
  EXPECT_GT(cycles["Sink"], 5u);
}

TEST(TimelineOfAnApplication, MessagesBetweenTwoCyclesAreShown) {
  Kept kept;
  Application application(loop({}), kept.options(true));
  ASSERT_TRUE(application.start().ok());
  application.run_for(15ms);
  rt::Signal signal([](rt::Message& message) { static_cast<rt::Signal&>(message).lower(); });
  component::Host::context(*application.find("Source")).raise(signal);
  application.run_for(1ms);
  application.stop();
  ASSERT_FALSE(kept.slices.empty());
  EXPECT_EQ(kept.slices.back().kind, Kind::kMessages);
  EXPECT_EQ(kept.slices.back().begin, base::Time(15ms));
}

TEST(TimelineOfAnApplication, WhatFindsNoRoomIsToldAndHoldsUpNobody) {
  Kept kept;
  Blueprint blueprint;
  auto& talkative = blueprint.add<Probe>("Talkative", Activity::periodic(10ms));
  blueprint.add<Probe>("Listener");
  blueprint.connect("Talkative.Out", "Listener.In");
  constexpr int kWrites = 5'000;
  int written = 0;
  talkative.actions["update"] = [&] {
    for (int i = 0; i < kWrites; ++i, ++written) talkative.out.write(i);
  };
  Application application(std::move(blueprint), kept.options(true));
  ASSERT_TRUE(application.start().ok());
  application.run_for(20ms);
  application.stop();
  EXPECT_EQ(written, 2 * kWrites);
  EXPECT_GT(kept.lost(), static_cast<std::uint64_t>(kWrites));
}

TEST(TimelineOfAnApplication, DoesNotChangeWhatTheApplicationDoes) {
  const auto result = [](ApplicationOptions options) {
    Application application(loop(Activity::triggered(40)), std::move(options));
    EXPECT_TRUE(application.start().ok());
    application.run_for(1s);
    const auto value = application.value_of("Sink", "In");
    EXPECT_TRUE(value.ok());
    const std::string text = std::string(value.value().text());
    application.stop();
    return text;
  };
  Kept kept;
  EXPECT_EQ(result(kept.options(true)), result(patient(true)));
}

TEST(TimelineOfAnApplication, ASinkThatThrowsGetsNoMore) {
  int calls = 0;
  ApplicationOptions options = patient(true);
  options.timeline.sink = [&](const TimelineSlice&) {
    ++calls;
    throw std::runtime_error("full");
  };
  Application application(loop({}), std::move(options));
  ASSERT_TRUE(application.start().ok());
  EXPECT_EQ(application.run_for(100ms), RunEnd::kTimeUp);
  EXPECT_TRUE(application.stop().ok());
  EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace armature::exec
