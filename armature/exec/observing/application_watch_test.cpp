// SPDX-License-Identifier: Apache-2.0
// Numbers that are looked at again and again while the application runs.
#include <cmath>
#include <optional>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/face.hpp"
#include "armature/exec/internal/test_components.hpp"

namespace armature::exec {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr base::Time at(base::Duration time) { return base::Time(time); }

/// A Counter in one thread, a Gain behind it in another one, and one that nobody writes to.
class Watching : public ::testing::TestWithParam<bool> {
 protected:
  Watching() {
    Blueprint blueprint;
    counter_ = &blueprint.add<Counter>("Counter", Activity::periodic(1ms));
    gain_ = &blueprint.add<Gain>("Gain", Activity::triggered());
    idle_ = &blueprint.add<Probe>("Idle", Activity::periodic(1ms));
    blueprint.connect("Counter.Count", "Gain.In");
    all_ = {of(*gain_, face(gain_->out)), of(*counter_, face(counter_->count)),
            of(*gain_, gain_->factor), of(*idle_, face(idle_->out)), of(*gain_, face(gain_->in))};
    application_.emplace(std::move(blueprint), patient(GetParam()));
    EXPECT_EQ(application_->start().to_text(), "");
  }

  /// @thread the component's, once it runs
  static WatchedNumber of(component::Component& component, const component::PortBase& port) {
    return {&component, &port, nullptr,
            types::NumberPlace::all_in(port.type(), port.current()).front()};
  }
  static WatchedNumber of(component::Component& component,
                          const component::PropertyBase& property) {
    return {&component, nullptr, &property,
            types::NumberPlace::all_in(property.type(), property.data()).front()};
  }
  std::int32_t watch(base::Duration interval = {}) {
    const auto handle = application_->watch(all_, interval);
    EXPECT_TRUE(handle);
    return handle.value();
  }

  Counter* counter_ = nullptr;
  Gain* gain_ = nullptr;
  Probe* idle_ = nullptr;
  std::vector<WatchedNumber> all_;
  std::optional<Application> application_;
};
INSTANTIATE_TEST_SUITE_P(InBothKindsOfTime, Watching, ::testing::Bool(),
                         [](const auto& test) { return test.param ? "Simulated" : "Real"; });

TEST_P(Watching, TellsWhatTheThreadsWroteLast) {
  const std::int32_t handle = watch();
  const RunEnd end = application_->run_until(
      application_->now() + 60s, [&] { return application_->watched(handle)->values[0] >= 10.0; });
  EXPECT_EQ(end, RunEnd::kConditionMet);
  EXPECT_TRUE(application_->set_property("Gain", "Factor", types::Value::of(3.0)));
  application_->run_until(application_->now() + 60s, [&] {
    const WatchSample& sample = *application_->watched(handle);
    return sample.values[2] == 3.0 && sample.values[0] == 3.0 * sample.values[4];
  });
  const WatchSample& sample = *application_->watched(handle);
  EXPECT_EQ(sample.values[0], 3.0 * sample.values[4]);
  EXPECT_GE(sample.values[1], 5.0);
  EXPECT_EQ(sample.values[2], 3.0);
  EXPECT_TRUE(std::isnan(sample.values[3])) << "nobody wrote it";
  EXPECT_GT(sample.times[0], base::Time{});
}

TEST_P(Watching, EndsWithTheRun) {
  const std::int32_t handle = watch();
  application_->run_for(5ms);
  EXPECT_NE(application_->watched(handle), nullptr);
  EXPECT_TRUE(application_->stop().ok());
  EXPECT_EQ(application_->watched(handle), nullptr);
  EXPECT_THAT(application_->watch(all_, 0ms).error(), HasSubstr("does not run"));
  EXPECT_TRUE(application_->start().ok());
  EXPECT_NE(watch(), handle) << "an old handle would be taken for the new one's";
}

TEST_P(Watching, WhoEndsHisLeavesOthersTheirs) {
  const std::int32_t first = watch();
  const std::int32_t second = watch();
  const std::int32_t third = watch();
  application_->end_watch(second);
  application_->end_watch(second);
  EXPECT_EQ(application_->watched(second), nullptr);
  application_->run_until(application_->now() + 60s, [&] {
    return application_->watched(first)->values[1] > 0.0 &&
           application_->watched(third)->values[1] > 0.0;
  });
  EXPECT_GT(application_->watched(first)->values[1], 0.0);
  EXPECT_GT(application_->watched(third)->values[1], 0.0);
}

/// In simulated time, where each cycle is known.
using WatchingInSimulatedTime = Watching;
INSTANTIATE_TEST_SUITE_P(Simulated, WatchingInSimulatedTime, ::testing::Values(true));

TEST_P(WatchingInSimulatedTime, TimesAreThoseOfTheWrites) {
  const std::int32_t handle = watch();
  application_->run_for(7ms);
  const WatchSample& sample = *application_->watched(handle);
  EXPECT_EQ(sample.values[1], 7.0);
  EXPECT_EQ(sample.times[1], at(7ms));
  EXPECT_TRUE(application_->stop_component("Counter"));
  application_->run_for(3ms);
  EXPECT_EQ(application_->watched(handle)->times[1], at(7ms)) << "it is 3 ms old";
}

TEST_P(WatchingInSimulatedTime, WhatNobodyTookIsCountedAndReplaced) {
  const auto handle = application_->watch({of(*counter_, face(counter_->count))}, 0ms);
  application_->run_for(10ms);
  EXPECT_EQ(application_->watched(handle.value())->replaced, 9u);
  application_->run_for(1ms);
  EXPECT_EQ(application_->watched(handle.value())->replaced, 9u);
}

TEST_P(WatchingInSimulatedTime, CopiesNoMoreOftenThanAskedFor) {
  const auto handle = application_->watch({of(*counter_, face(counter_->count))}, 10ms);
  application_->run_for(100ms);
  const WatchSample& sample = *application_->watched(handle.value());
  EXPECT_NEAR(static_cast<double>(sample.replaced), 11.0, 2.0) << "of 100 cycles";
}

}  // namespace
}  // namespace armature::exec
