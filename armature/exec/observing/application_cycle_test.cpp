// SPDX-License-Identifier: Apache-2.0
// One cycle of a thread, recorded because somebody asked for it.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/exec/internal/test_components.hpp"

namespace armature::exec {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

/// A Counter and the Gain that it triggers in one thread; nobody triggers the other thread.
class Asked : public ::testing::TestWithParam<bool> {
 protected:
  Asked() {
    Blueprint blueprint;
    counter_ = &blueprint.add<Counter>("Counter", Activity::periodic(1ms));
    blueprint.add<Gain>("Gain", Activity::sequential());
    blueprint.add<Probe>("Idle", Activity::triggered());
    blueprint.connect("Counter.Count", "Gain.In");
    application_.emplace(std::move(blueprint), patient(GetParam()));
    EXPECT_EQ(application_->start().to_text(), "");
  }

  RecordedCycle look(const char* thread = "Counter") {
    const auto found = application_->cycle(thread);
    EXPECT_TRUE(found) << found.error();
    return found ? found.value() : RecordedCycle{};
  }
  /// The first that was recorded after number `before`.
  RecordedCycle look_after(std::uint64_t before) {
    RecordedCycle found = look();
    application_->run_until(application_->now() + 60s, [&] {
      found = look();
      return found.number > before;
    });
    return found;
  }

  Counter* counter_ = nullptr;
  std::optional<Application> application_;
};
INSTANTIATE_TEST_SUITE_P(InBothKindsOfTime, Asked, ::testing::Bool(),
                         [](const auto& test) { return test.param ? "Simulated" : "Real"; });

TEST_P(Asked, HasTheStepsOfItsComponents) {
  EXPECT_EQ(look().number, 0u) << "nobody has asked before";
  const RecordedCycle cycle = look_after(0);
  ASSERT_GT(cycle.number, 0u);
  EXPECT_GT(cycle.time, base::Time{});
  EXPECT_EQ(cycle.left_out, 0u);
  std::vector<std::string> ran;
  base::Duration end{};
  for (const RecordedCycle::Step& step : cycle.steps) {
    ran.push_back(step.component->name());
    EXPECT_GE(step.begin + 1us, end) << "steps do not overlap";
    end = step.begin + step.length;
  }
  EXPECT_THAT(ran, Contains("Counter"));
  EXPECT_THAT(ran, Contains("Gain"));
  EXPECT_LE(end, cycle.length + 1us);
}

TEST_P(Asked, IsTheNextOneOnly) {
  look();
  application_->run_for(20ms);
  const RecordedCycle first = look();
  application_->run_for(20ms);
  const RecordedCycle second = look();
  EXPECT_GE(first.number, 1u);
  if (GetParam()) EXPECT_EQ(first.number, 1u) << "those that came later were asked for by nobody";
  EXPECT_GT(second.number, first.number);
  EXPECT_LE(second.time - first.time, 41ms);
}

TEST_P(Asked, NeverComesFromAThreadThatRunsNone) {
  look("Idle");
  application_->run_for(5ms);
  EXPECT_EQ(look("Idle").number, 0u);
}

TEST_P(Asked, OfAnUnknownThreadIsRefused) {
  EXPECT_THAT(application_->cycle("Countr").error(),
              HasSubstr("unknown thread 'Countr' (did you mean 'Counter'?)"));
}

TEST_P(Asked, EndsWithTheRun) {
  look_after(0);
  application_->stop();
  EXPECT_THAT(application_->cycle("Counter").error(), HasSubstr("does not run"));
}

}  // namespace
}  // namespace armature::exec
