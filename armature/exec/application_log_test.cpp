// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <ios>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/exec/internal/test_components.hpp"

namespace armature::exec {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;

class ApplicationLog : public ::testing::TestWithParam<bool> {
 protected:
  ApplicationOptions options() {
    ApplicationOptions options = patient(GetParam());
    options.log = [this](const rt::LogRecord& record) {
      lines_.push_back(std::string(name_of(record.level)) + " " +
                       std::string(record.component.view()) + ": " + record.message());
    };
    return options;
  }

  std::vector<std::string> lines_;
};
INSTANTIATE_TEST_SUITE_P(InBothKindsOfTime, ApplicationLog, ::testing::Bool(),
                         [](const auto& test) { return test.param ? "Simulated" : "Real"; });

TEST_P(ApplicationLog, LinesOfEveryHookReachTheSinkInTheirOrder) {
  Blueprint blueprint;
  Probe& probe = blueprint.add<Probe>("A", Activity::periodic(1ms));
  for (const char* hook : {"configure", "start", "stop", "cleanup"}) {
    probe.actions[hook] = [&probe, hook] { probe.log_info("in {}", hook); };
  }
  bool said = false;
  probe.actions["update"] = [&] {
    if (!std::exchange(said, true)) probe.log_info("cycle {} at {}", 1, 0.5);
  };
  Application application(std::move(blueprint), options());
  ASSERT_TRUE(application.start().ok());
  EXPECT_TRUE(run_until(application, [&] { return lines_.size() >= 3; }));
  EXPECT_TRUE(application.stop().ok());
  EXPECT_THAT(lines_,
              ElementsAre("info A: in configure", "info A: in start", "info A: cycle 1 at 0.5",
                          "info A: in stop", "info A: in cleanup"));
}

TEST_P(ApplicationLog, AFaultAndItsResetAreTold) {
  Blueprint blueprint;
  Probe& probe = blueprint.add<Probe>("A", Activity::periodic(1ms));
  probe.actions["update"] = [&] { probe.fault("broken"); };
  Application application(std::move(blueprint), options());
  ASSERT_TRUE(application.start().ok());
  EXPECT_TRUE(
      run_until(application, [&] { return probe.state() == component::State::kException; }));
  probe.actions["reset"] = [&] { throw std::runtime_error("still broken"); };
  EXPECT_FALSE(application.reset_component("A"));
  probe.actions.erase("reset");
  EXPECT_TRUE(application.reset_component("A"));
  EXPECT_TRUE(application.stop().ok());
  EXPECT_THAT(lines_, Contains("error A: fault: broken"));
  EXPECT_EQ(std::ranges::count(lines_, "info A: reset"), 1) << "not of the one that failed";
}

TEST_P(ApplicationLog, LinesThatWereDroppedAreToldWhenItStops) {
  Blueprint blueprint;
  Probe& probe = blueprint.add<Probe>("A", Activity::periodic(1ms));
  probe.actions["stop"] = [&] {
    for (int i = 0; i < 1000; ++i) probe.log_info("line");
  };
  Application application(std::move(blueprint), options());
  ASSERT_TRUE(application.start().ok());
  EXPECT_TRUE(application.stop().ok());
  const std::uint64_t dropped = application.thread_statistics()[0].log_lines_dropped;
  EXPECT_GT(dropped, 0u);
  EXPECT_EQ(lines_.size(), 1000 - dropped + 1);
  EXPECT_EQ(lines_.back(), "warning A: " + std::to_string(dropped) +
                               " log lines of this thread were dropped: they came faster than "
                               "they can be printed");
}

TEST_P(ApplicationLog, LinesThatWereDroppedAreToldWhileItRuns) {
  Blueprint blueprint;
  Probe& probe = blueprint.add<Probe>("A", Activity::periodic(1ms));
  bool said = false;
  probe.actions["update"] = [&] {
    if (std::exchange(said, true)) return;
    for (int i = 0; i < 1000; ++i) probe.log_info("line");
  };
  Application application(std::move(blueprint), options());
  ASSERT_TRUE(application.start().ok());
  const auto told = [&] {
    for (const std::string& line : lines_) {
      if (line.find("were dropped") != std::string::npos) return true;
    }
    return false;
  };
  while (!told()) application.run_for(1100ms);
  const std::size_t before = lines_.size();
  EXPECT_TRUE(application.stop().ok());
  EXPECT_EQ(lines_.size(), before) << "and not again";
}

TEST_P(ApplicationLog, AFaultIsLogged) {
  Blueprint blueprint;
  Probe& probe = blueprint.add<Probe>("A", Activity::periodic(1ms));
  probe.throw_in("update");
  Application application(std::move(blueprint), options());
  ASSERT_TRUE(application.start().ok());
  EXPECT_TRUE(run_until(application, [&] { return application.faults() > 0; }));
  EXPECT_TRUE(application.stop().ok());
  EXPECT_THAT(lines_, Contains("error A: fault: exception: thrown in update"));
}

TEST_P(ApplicationLog, AReceiverThatThrowsGetsNoMoreLinesAndItIsTold) {
  Blueprint blueprint;
  Probe& probe = blueprint.add<Probe>("A", Activity::periodic(1ms));
  for (const char* hook : {"configure", "start", "stop"}) {
    probe.actions[hook] = [&probe, hook] { probe.log_info("in {}", hook); };
  }
  ApplicationOptions options = patient(GetParam());
  int lines = 0;
  options.log = [&](const rt::LogRecord&) {
    ++lines;
    throw std::ios_base::failure("the disk is full");
  };
  Application application(std::move(blueprint), options);
  ASSERT_TRUE(application.start().ok());
  application.run_for(30ms);
  const std::string said = application.stop().to_text();
  EXPECT_TRUE(
      said.starts_with("warning: log lines are missing: their receiver threw 'the disk is "
                       "full"))
      << said;
  EXPECT_EQ(lines, 1);
  EXPECT_EQ(probe.state(), component::State::kPreOperational) << "it was stopped and cleaned up";
}

}  // namespace
}  // namespace armature::exec
