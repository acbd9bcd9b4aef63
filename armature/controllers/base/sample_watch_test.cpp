// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/base/sample_watch.hpp"

#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/host.hpp"
#include "armature/controllers/sampler/sampler.hpp"
#include "armature/exec/application.hpp"

namespace armature::controllers {
namespace {

using namespace std::chrono_literals;
using component::State;

/// Takes samples, and watches them.
class Watched final : public component::Component {
 public:
  using Component::Component;
  base::Duration period = 10ms;
  int samples = 0;

 private:
  component::Outcome on_start() override {
    watch_.begin(period);
    return component::accepted();
  }
  void on_sample() {
    ++samples;
    if (const auto wrong = watch_.sample(*this)) fault(*wrong);
  }
  component::EventHandler<> sample_{this, "Sample", component::serve<&Watched::on_sample>, "begins",
                                    component::optional};
  SampleWatch watch_;
};

/// What the clock says counts, as nobody periodic samples it.
class SampleWatchOfTheClock : public ::testing::Test {
 protected:
  SampleWatchOfTheClock() {
    component::Host::assign_context(sampled, context);
    watch.begin(10ms);
    sample_after(0ms);
  }
  /// What is wrong, if anything.
  std::string sample_after(base::Duration interval) {
    now += interval;
    context.cycle_time = now;
    const auto wrong = watch.sample(sampled);
    return wrong ? std::string(wrong->view()) : "";
  }
  bool all_are_right(int count, base::Duration even, base::Duration odd) {
    bool right = true;
    for (int k = 0; k < count; ++k) right = sample_after(k % 2 == 0 ? even : odd).empty() && right;
    return right;
  }
  base::Time now = base::time_from_ns(0);
  component::ExecutionContext context{"test"};
  component::Component sampled{"Joint"};
  SampleWatch watch;
};

TEST_F(SampleWatchOfTheClock, ThreeInARowThatAreTooLongAreAFaultWithBothFigures) {
  EXPECT_EQ(sample_after(13ms), "");
  EXPECT_EQ(sample_after(13ms), "");
  EXPECT_EQ(sample_after(13ms), "it is sampled after 13 ms, but its period is 10 ms");
}

TEST_F(SampleWatchOfTheClock, ThreeInARowThatAreTooShortAreAFault) {
  EXPECT_TRUE(all_are_right(2, 7ms, 7ms));
  EXPECT_EQ(sample_after(7ms), "it is sampled after 7 ms, but its period is 10 ms");
}

TEST_F(SampleWatchOfTheClock, OneThatIsRightBeginsTheCountAnew) {
  for (int k = 0; k < 10; ++k) {
    EXPECT_TRUE(all_are_right(2, 13ms, 13ms));
    EXPECT_EQ(sample_after(10ms), "");
  }
}

TEST_F(SampleWatchOfTheClock, AThreadThatWakesLateNowAndThenHasNoWrongPeriod) {
  EXPECT_TRUE(all_are_right(20, 17ms, 3ms));
}

TEST_F(SampleWatchOfTheClock, WhatComesAtOnceSinceTheThreadWasHeldUpIsNoWrongPeriod) {
  EXPECT_EQ(sample_after(50ms), "");
  EXPECT_TRUE(all_are_right(4, 0ms, 0ms));
  EXPECT_TRUE(all_are_right(10, 10ms, 10ms));
}

TEST_F(SampleWatchOfTheClock, InSimulatedTimeHalfAPeriodOffIsAFaultAtOnce) {
  context.simulated = true;
  EXPECT_EQ(sample_after(10ms), "");
  EXPECT_EQ(sample_after(15ms), "it is sampled after 15 ms, but its period is 10 ms");
}

TEST_F(SampleWatchOfTheClock, InAnotherThreadThanThatOfThePeriodNothingIsMeasuredInRealTime) {
  const component::Component owner("Sampler");
  component::Host::set_pace(sampled, {.period = 10ms, .owner = &owner});
  EXPECT_TRUE(all_are_right(10, 30ms, 30ms));
}

/// Sampled in the thread that determines the period.
class SampleWatchOfCycles : public ::testing::Test {
 protected:
  void start(base::Duration sampled_every, base::Duration period) {
    exec::Blueprint blueprint;
    blueprint.add<Sampler>("Sampler", exec::Activity::periodic(sampled_every));
    watched = &blueprint.add<Watched>("Watched");
    watched->period = period;
    blueprint.add_peer("Watched", "Sampler");
    exec::ApplicationOptions options;
    options.simulated = true;
    application = std::make_unique<exec::Application>(std::move(blueprint), std::move(options));
    EXPECT_EQ(application->start().to_text(), "");
  }
  Watched* watched = nullptr;
  std::unique_ptr<exec::Application> application;
};

TEST_F(SampleWatchOfCycles, ASampleInEachCycleIsRight) {
  start(10ms, 10ms);
  application->run_for(1s);
  EXPECT_EQ(watched->state(), State::kRunning);
  EXPECT_EQ(watched->samples, 100);
}

TEST_F(SampleWatchOfCycles, HalfAPeriodOffIsAFaultAtOnce) {
  start(20ms, 10ms);
  application->run_for(1s);
  EXPECT_EQ(watched->state(), State::kException);
  EXPECT_EQ(watched->samples, 2);
  EXPECT_EQ(watched->reason(), "it is sampled after 20 ms, but its period is 10 ms");
}

TEST_F(SampleWatchOfCycles, ASecondSampleInACycleIsAFault) {
  start(10ms, 10ms);
  application->run_for(105ms);
  EXPECT_EQ(watched->state(), State::kRunning);
  ASSERT_TRUE(application->call("Sampler", "trigger", {}));
  application->run_for(1ms);
  EXPECT_EQ(watched->state(), State::kException);
  EXPECT_EQ(watched->reason(), "it is sampled after 0 ms, but its period is 10 ms");
}

}  // namespace
}  // namespace armature::controllers
