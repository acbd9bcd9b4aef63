// SPDX-License-Identifier: Apache-2.0
#include "armature/report/timeline.hpp"

#include <gmock/gmock.h>

namespace armature::report {
namespace {

using ::testing::HasSubstr;

/// A trace, written by hand as `armature run --trace` does.
class Trace {
 public:
  void add(const std::string& name, double begin_us, double length_us, int thread = 1) {
    text_ += text_.empty() ? "" : ",\n";
    text_ += R"({"ph":"X","name":")" + name + R"(","cat":")" + (name == "cycle" ? name : "step") +
             R"(","ts":)" + std::to_string(begin_us) + R"(,"dur":)" + std::to_string(length_us) +
             R"(,"pid":1,"tid":)" + std::to_string(thread) + "}";
  }
  void add_cycle(double begin_us, double length_us) {
    add("cycle", begin_us, length_us);
    add("Sampler", begin_us, 1);
    add("Joint1", begin_us + 1, 0.4 * length_us);
    add("Joint1", begin_us + 0.6 * length_us, 0.2 * length_us);
    add("cycle", begin_us + length_us + 5, 10, 2);
    add("Generator", begin_us + length_us + 5, 10, 2);
  }
  std::string without_end() const {
    return R"([{"ph":"M","name":"thread_name","pid":1,"tid":1,"args":{"name":"fast"}},)"
           "\n" +
           text_;
  }
  std::string text() const { return without_end() + "\n]\n"; }

 private:
  std::string text_;
};

Timeline parse(const std::string& text) {
  const auto parsed = parse_trace(text, "trace.json");
  EXPECT_TRUE(parsed) << parsed.error();
  return parsed ? find_timeline(parsed.value()) : Timeline{};
}

TEST(Timeline, ShowsTheCycleOfMedianLengthWithWhatFollowsItInOtherThreads) {
  Trace trace;
  double begin = 1000.0;
  for (const double length : {900.0, 100.0, 120.0, 5000.0, 110.0, 130.0, 125.0}) {
    trace.add_cycle(begin, length);
    begin += 10000.0;
  }
  const Timeline timeline = parse(trace.text());
  EXPECT_EQ(timeline.cycles, 7u);
  EXPECT_NEAR(timeline.length_us, 130.0, 1e-6);
  EXPECT_NEAR(timeline.end_us, 130.0 + 15.0, 1e-6);
  ASSERT_EQ(timeline.lanes.size(), 3u);
  EXPECT_EQ(timeline.lanes[0].component, "Sampler");
  EXPECT_EQ(timeline.lanes[0].thread, "fast");
  EXPECT_EQ(timeline.lanes[1].component, "Joint1");
  ASSERT_EQ(timeline.lanes[1].bars.size(), 2u);
  EXPECT_NEAR(timeline.lanes[1].bars[1].begin_us, 78.0, 1e-6);
  EXPECT_EQ(timeline.lanes[2].component, "Generator");
}

TEST(Timeline, OneCycleAloneIsThatCycle) {
  Trace trace;
  trace.add_cycle(1000.0, 200.0);
  const Timeline timeline = parse(trace.text());
  EXPECT_EQ(timeline.lanes.size(), 2u) << "what follows is not known to belong to it";
  EXPECT_NEAR(timeline.length_us, 200.0, 1e-6);
}

TEST(Timeline, CyclesWithoutStepsAreNotShown) {
  Trace trace;
  for (int k = 0; k < 20; ++k) trace.add("cycle", 1000.0 + k * 10000.0, 300.0);
  trace.add_cycle(301000.0, 100.0);
  trace.add_cycle(311000.0, 100.0);
  const Timeline timeline = parse(trace.text());
  EXPECT_EQ(timeline.cycles, 22u);
  EXPECT_NEAR(timeline.length_us, 100.0, 1e-6);
}

TEST(Timeline, ATraceThatWasCutOffIsReadAsFarAsItGoes) {
  Trace trace;
  for (int k = 0; k < 5; ++k) trace.add_cycle(1000.0 + k * 10000.0, 100.0);
  const std::string text = trace.without_end();
  const Timeline timeline = parse(text.substr(0, text.size() - 20));
  EXPECT_EQ(timeline.cycles, 5u);
  EXPECT_EQ(timeline.lanes.size(), 3u);
}

TEST(Timeline, TheListMayBeInAnObject) {
  Trace trace;
  trace.add_cycle(1000.0, 100.0);
  EXPECT_EQ(parse(R"({"traceEvents":)" + trace.text() + "}").lanes.size(), 2u);
}

TEST(Timeline, OfAnEmptyTraceIsEmpty) {
  EXPECT_TRUE(parse(R"({"traceEvents":[]})").lanes.empty());
  EXPECT_TRUE(parse("[]").lanes.empty());
}

TEST(Timeline, WhatIsNoTraceIsRefusedByItsName) {
  for (const char* text : {"{}", "not json", "", R"({"traceEvents": 5})"}) {
    const auto parsed = parse_trace(text, "folder/trace.json");
    ASSERT_FALSE(parsed) << text;
    EXPECT_THAT(parsed.error(), HasSubstr("folder/trace.json: expected a trace"));
  }
  for (const char* event : {R"({"ph":"X","name":"a","ts":"soon","dur":1})",
                            R"({"ph":"X","ts":1,"dur":1})", R"({"ph":1})", "5"}) {
    EXPECT_FALSE(parse_trace(std::string("[") + event + "]", "trace.json")) << event;
  }
}

}  // namespace
}  // namespace armature::report
