// SPDX-License-Identifier: Apache-2.0
// What is kept of an application's last seconds when a component faults.
#include "armature/exec/black_box.hpp"

#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/exec/internal/test_components.hpp"

namespace armature::exec {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Le;
using ::testing::SizeIs;

struct Kept {
  std::vector<BlackBoxReport> reports;
  std::vector<std::string> lines;

  ApplicationOptions options(bool simulated) {
    ApplicationOptions options = patient(simulated);
    options.black_box.write = [this](const BlackBoxReport& report) {
      reports.push_back(report);
      return "report " + std::to_string(reports.size());
    };
    options.log = [this](const rt::LogRecord& record) { lines.push_back(record.message()); };
    return options;
  }
};

/// Of one channel, as "time [ms]: value".
std::vector<std::string> samples(const BlackBoxReport& report, const std::string& channel) {
  std::vector<std::string> texts;
  for (const auto& sample : report.samples) {
    const auto& of = report.channels[sample.channel];
    if (of.name != channel) continue;
    types::Value value = of.shape;
    EXPECT_TRUE(
        types::decode(value.type(), sample.value.data(), sample.value.size(), value.data()));
    texts.push_back(std::to_string(sample.time.time_since_epoch() / 1ms) + ": " +
                    std::string(value.text()));
  }
  return texts;
}

std::vector<std::string> happenings(const BlackBoxReport& report) {
  std::vector<std::string> texts;
  for (const auto& each : report.happenings) {
    texts.push_back(std::to_string(each.time.time_since_epoch() / 1ms) + " " + each.component +
                    " " + each.kind + (each.item.empty() ? "" : " " + each.item) +
                    (each.text.empty() ? "" : ": " + each.text));
  }
  return texts;
}

/// Source counts every 10 ms, Double doubles it and breaks at its `fault_at`th.
Blueprint chain(int fault_at, const Activity& of_double = Activity::sequential()) {
  Blueprint blueprint;
  blueprint.add<Counter>("Source", Activity::periodic(10ms, 50));
  blueprint.add<Gain>("Double", of_double).throw_at = fault_at;
  blueprint.add<Sink>("Sink", Activity::periodic(20ms, 30));
  blueprint.connect("Source.Count", "Double.In");
  blueprint.connect("Double.Out", "Sink.In");
  return blueprint;
}

TEST(BlackBoxOfAnApplication, HasThePortsUpToTheFaultAndAMomentAfterAndNamesIt) {
  Kept kept;
  Application application(chain(5), kept.options(true));
  ASSERT_TRUE(application.start().ok());
  application.run_for(1s);
  ASSERT_THAT(kept.reports, SizeIs(1));
  const BlackBoxReport& report = kept.reports.front();
  EXPECT_EQ(report.component, "Double");
  EXPECT_EQ(report.reason, "exception: broken tooth");
  EXPECT_EQ(report.time, base::Time(50ms));
  EXPECT_EQ(report.incomplete, "");
  const std::vector<std::string> counts = samples(report, "Source.Count");
  ASSERT_THAT(counts, SizeIs(AllOf(Ge(24u), Le(26u))));  // 0.2 s more
  EXPECT_EQ(counts[0], "10: 1");
  EXPECT_EQ(counts[4], "50: 5");
  EXPECT_EQ(samples(report, "Double.Out")[4], "50: 8") << "its last";
  EXPECT_EQ(samples(report, "Source.Tick")[4], "50: 5") << "how often it was raised";
  EXPECT_THAT(kept.lines, Contains("report 1"));
}

TEST(BlackBoxOfAnApplication, HasStatesFaultsAndReactions) {
  Kept kept;
  Application application(chain(5), kept.options(true));
  ASSERT_TRUE(application.start().ok());
  application.run_for(1s);
  ASSERT_THAT(kept.reports, SizeIs(1));
  const auto all = happenings(kept.reports.front());
  EXPECT_THAT(all, Contains("0 Source state: Running"));
  EXPECT_THAT(all, Contains("50 Double state: Exception"));
  EXPECT_THAT(all, Contains("50 Double fault: exception: broken tooth"));
  EXPECT_THAT(all, Contains(HasSubstr("Sink reaction: ")));
}

TEST(BlackBoxOfAnApplication, HasWhatToolsDid) {
  Kept kept;
  Application application(chain(20), kept.options(true));
  ASSERT_TRUE(application.start().ok());
  application.run_for(30ms);
  ASSERT_TRUE(application.set_property("Double", "Factor", types::Value::of(3.0)));
  ASSERT_TRUE(application.call("Double", "scale", {types::Value::of(2.0)}));
  application.run_for(1s);
  ASSERT_THAT(kept.reports, SizeIs(1));
  const auto all = happenings(kept.reports.front());
  EXPECT_THAT(all, Contains("30 Double property set Factor: 3"));
  EXPECT_THAT(all, Contains("30 Double operation called scale"));
}

TEST(BlackBoxOfAnApplication, IsWrittenAtTheEndIfTheFaultEndsTheRun) {
  Kept kept;
  ApplicationOptions options = kept.options(true);
  options.on_fault = OnFault::kStopAll;
  Application application(chain(5), std::move(options));
  ASSERT_TRUE(application.start().ok());
  EXPECT_EQ(application.run_for(1s), RunEnd::kFaulted);
  EXPECT_THAT(kept.reports, IsEmpty());
  EXPECT_TRUE(application.stop().ok());
  ASSERT_THAT(kept.reports, SizeIs(1));
  EXPECT_EQ(samples(kept.reports[0], "Source.Count").back(), "50: 5");
  EXPECT_THAT(happenings(kept.reports[0]), Contains("50 Source state: Stopped"));
}

TEST(BlackBoxOfAnApplication, WithoutAFaultNothingIsWritten) {
  Kept kept;
  Application application(chain(0), kept.options(true));
  ASSERT_TRUE(application.start().ok());
  application.run_for(1s);
  EXPECT_TRUE(application.stop().ok());
  EXPECT_THAT(kept.reports, IsEmpty());
}

TEST(BlackBoxOfAnApplication, TwoSimulatedRunsHaveTheSame) {
  const auto run = [] {
    Kept kept;
    Application application(chain(70, Activity::triggered(40)), kept.options(true));
    EXPECT_TRUE(application.start().ok());
    application.run_for(2s);
    EXPECT_THAT(kept.reports, SizeIs(1));
    std::vector<std::string> all = happenings(kept.reports.at(0));
    for (const auto& channel : kept.reports.at(0).channels) {
      for (const std::string& text : samples(kept.reports[0], channel.name)) {
        all.push_back(channel.name + " " + text);
      }
    }
    return all;
  };
  const auto first = run();
  EXPECT_EQ(first, run());
  EXPECT_THAT(first, Contains("Source.Count 700: 70"));
}

TEST(BlackBoxOfAnApplication, KeepsNoMoreThanItsMemoryAndHistory) {
  Kept kept;
  ApplicationOptions options = kept.options(true);
  options.black_box.history = 500ms;
  Application application(chain(200), std::move(options));
  ASSERT_TRUE(application.start().ok());
  application.run_for(5s);
  ASSERT_THAT(kept.reports, SizeIs(1));
  const auto counts = samples(kept.reports[0], "Source.Count");
  EXPECT_THAT(counts, SizeIs(AllOf(Ge(50u), Le(52u))));
  EXPECT_THAT(counts, Contains("2000: 200"));

  Kept small;
  ApplicationOptions little = small.options(true);
  little.black_box.memory = 1000;
  Application coarse(chain(200), std::move(little));
  ASSERT_TRUE(coarse.start().ok());
  coarse.run_for(5s);
  ASSERT_THAT(small.reports, SizeIs(1));
  EXPECT_THAT(samples(small.reports[0], "Source.Count"), SizeIs(AllOf(Ge(4u), Le(60u))));
  EXPECT_THAT(samples(small.reports[0], "Double.Out"), Contains("2000: 398"));
}

TEST(BlackBoxOfAnApplication, InSimulatedTimeMoreMemoryHasMorePictures) {
  const auto pictures_with = [](std::size_t memory) {
    Kept kept;
    Blueprint blueprint = chain(200);
    for (int i = 0; i < 100; ++i) {  // enough values for several milliseconds
      blueprint.add<Counter>("More" + std::to_string(i), Activity::periodic(10ms, 50));
    }
    ApplicationOptions options = kept.options(true);
    options.black_box.history = 1s;
    options.black_box.memory = memory;
    Application application(std::move(blueprint), std::move(options));
    EXPECT_TRUE(application.start().ok());
    application.run_for(3s);
    EXPECT_THAT(kept.reports, SizeIs(1));
    return samples(kept.reports.at(0), "Source.Count").size();
  };
  EXPECT_LE(pictures_with(64u << 10), 60u);
  EXPECT_GE(pictures_with(4u << 20), 100u) << "each cycle of a second";
}

TEST(BlackBoxOfAnApplication, OfManyFaultsAFewAreWritten) {
  Kept kept;
  Blueprint blueprint;
  Probe& probe = blueprint.add<Probe>("Probe", Activity::periodic(10ms));
  probe.throw_in("update");
  Application application(std::move(blueprint), kept.options(true));
  ASSERT_TRUE(application.start().ok());
  for (int i = 0; i < 10; ++i) {
    application.run_for(500ms);
    ASSERT_TRUE(application.reset_component("Probe"));
    ASSERT_TRUE(application.start_component("Probe"));
  }
  EXPECT_THAT(kept.reports, SizeIs(4));
  EXPECT_THAT(kept.lines, Contains("report 4; from now on only faults of another kind are kept"));
}

TEST(BlackBoxOfAnApplication, AFaultOfAnotherKindIsWrittenHoweverManyThereWereBefore) {
  Kept kept;
  Blueprint blueprint;
  blueprint.add<Probe>("Probe", Activity::periodic(10ms));
  Application application(std::move(blueprint), kept.options(true));
  ASSERT_TRUE(application.start().ok());
  component::Component& probe = *application.find("Probe");
  const auto fault = [&](const std::string& why) {
    ASSERT_TRUE(application.run_in_thread_of(probe, [&] { probe.fault(why); }));
    application.run_for(500ms);
    ASSERT_TRUE(application.reset_component("Probe"));
    ASSERT_TRUE(application.start_component("Probe"));
  };
  for (int i = 0; i < 10; ++i) fault("puck " + std::to_string(i) + " is silent");
  EXPECT_THAT(kept.reports, SizeIs(4));
  for (int i = 0; i < 3; ++i) fault("E-stop");
  ASSERT_THAT(kept.reports, SizeIs(5));
  EXPECT_EQ(kept.reports.back().reason, "E-stop");
}

TEST(BlackBoxOfAnApplication, WhatTheOperatorStopsIsNoFault) {
  Kept kept;
  Application application(chain(0), kept.options(true));
  ASSERT_TRUE(application.start().ok());
  for (int i = 0; i < 5; ++i) {
    application.run_for(100ms);
    component::Component& middle = *application.find("Double");
    ASSERT_TRUE(application.run_in_thread_of(middle, [&] { middle.stop_because("a reaction"); }));
    application.run_for(500ms);
    for (const char* name : {"Double", "Sink"}) ASSERT_TRUE(application.start_component(name));
  }
  EXPECT_GT(application.reactions(), 0u);
  EXPECT_THAT(kept.reports, IsEmpty());
}

TEST(BlackBoxOfAnApplication, AWriterThatThrowsIsToldAndNothingElseHappens) {
  Kept kept;
  ApplicationOptions options = kept.options(true);
  options.black_box.write = [](const BlackBoxReport&) -> std::string {
    throw std::runtime_error("no disk");
  };
  Application application(chain(5), std::move(options));
  ASSERT_TRUE(application.start().ok());
  EXPECT_EQ(application.run_for(1s), RunEnd::kTimeUp);
  EXPECT_THAT(kept.lines, Contains("black box: no disk"));
}

TEST(BlackBoxOfAnApplication, InRealTimeItIsReadWhileTheThreadsGoOn) {
  Kept kept;
  Application application(chain(20, Activity::triggered(40)), kept.options(false));
  ASSERT_TRUE(application.start().ok());
  ASSERT_TRUE(run_until(application, [&] { return !kept.reports.empty(); }));
  application.stop();
  const BlackBoxReport& report = kept.reports.front();
  EXPECT_EQ(report.component, "Double");
  EXPECT_THAT(happenings(report), Contains(HasSubstr("Double fault: exception: broken tooth")));
  bool last_before_the_fault = false;
  for (const std::string& text : samples(report, "Double.Out")) {
    last_before_the_fault |= text.ends_with(": 38");
  }
  EXPECT_TRUE(last_before_the_fault);
}

}  // namespace
}  // namespace armature::exec
