// SPDX-License-Identifier: Apache-2.0
// What tools do with a running application.
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/host.hpp"
#include "armature/exec/internal/test_components.hpp"

namespace armature::exec {
namespace {

using component::State;
using types::Value;

/// Counter (own thread) -> Gain (own thread) -> Sink (in Gain's thread).
class Control : public ::testing::TestWithParam<bool> {
 protected:
  Control() {
    counter_ = &blueprint_.add<Counter>("Counter", Activity::periodic(1ms));
    gain_ = &blueprint_.add<Gain>("Gain", Activity::triggered());
    sink_ = &blueprint_.add<Sink>("Sink");
    blueprint_.connect("Counter.Count", "Gain.In");
    blueprint_.connect("Gain.Out", "Sink.In");
    application_.emplace(std::move(blueprint_), patient(GetParam()));
    EXPECT_EQ(application_->start().to_text(), "");
  }
  Application& application() { return *application_; }
  bool wait_for_steps(int count) {
    const int before = gain_->steps;
    return run_until(application(), [&] { return gain_->steps >= before + count; });
  }

  Blueprint blueprint_;
  Counter* counter_;
  Gain* gain_;
  Sink* sink_;
  std::optional<Application> application_;
};
INSTANTIATE_TEST_SUITE_P(InBothKindsOfTime, Control, ::testing::Bool(),
                         [](const auto& test) { return test.param ? "Simulated" : "Real"; });

TEST_P(Control, AValueIsReadByTheThreadThatOwnsIt) {
  ASSERT_TRUE(wait_for_steps(3));
  const auto factor = application().value_of("Gain", "Factor");
  ASSERT_TRUE(factor) << factor.error();
  EXPECT_EQ(*factor.value().get_if<double>(), 2.0);
  const auto out = application().value_of("Gain", "Out");
  ASSERT_TRUE(out) << out.error();
  EXPECT_GE(*out.value().get_if<double>(), 6.0);
  EXPECT_TRUE(application().value_of("Sink", "In"));
}

TEST_P(Control, APropertyIsSetBetweenTwoUpdates) {
  ASSERT_TRUE(application().set_property("Gain", "Factor", Value::of(-1.0)));
  EXPECT_EQ(*application().value_of("Gain", "Factor").value().get_if<double>(), -1.0);
  ASSERT_TRUE(wait_for_steps(1));
  EXPECT_LT(*application().value_of("Gain", "Out").value().get_if<double>(), 0.0);
}

TEST_P(Control, ARefusedPropertySaysWhy) {
  EXPECT_EQ(application().set_property("Gain", "Factor", Value::of(1)).error(),
            "property 'Factor' of 'Gain' is a double, not a int32");
}

TEST_P(Control, AnOperationIsCalledWithValues) {
  const auto called = application().call("Gain", "scale", {Value::of(7.0)});
  ASSERT_TRUE(called) << called.error();
  EXPECT_EQ(*called.value()->get_if<double>(), 14.0);
  EXPECT_EQ(application().call("Gain", "scale", {}).error(),
            "'Gain.scale' is double(double); it was called with ()");
}

TEST_P(Control, UnknownNamesAreAnsweredWithTheNearest) {
  const std::string component = "unknown component 'Gian' (did you mean 'Gain'?)";
  EXPECT_EQ(application().value_of("Gian", "Out").error(), component);
  EXPECT_EQ(application().set_property("Gian", "Factor", Value::of(1.0)).error(), component);
  EXPECT_EQ(application().call("Gian", "scale", {}).error(), component);
  EXPECT_EQ(application().start_component("Gian").reason(), component);
  EXPECT_EQ(application().value_of("Gain", "Ount").error(),
            "'Gain' has no property or port 'Ount' (did you mean 'Out'?)");
  EXPECT_EQ(application().set_property("Gain", "Facto", Value::of(1.0)).error(),
            "'Gain' has no property 'Facto' (did you mean 'Factor'?)");
  EXPECT_EQ(application().call("Gain", "move", {}).error(),
            "'Gain' has no operation 'move' (known: scale)");
}

TEST_P(Control, OneComponentStopsAndStartsWhileTheOthersRun) {
  ASSERT_TRUE(wait_for_steps(3));
  EXPECT_TRUE(application().stop_component("Gain"));
  EXPECT_EQ(gain_->state(), State::kStopped);
  const int stopped_at = gain_->steps;
  application().run_for(5ms);
  EXPECT_EQ(gain_->steps, stopped_at);
  EXPECT_EQ(sink_->state(), State::kRunning);
  EXPECT_TRUE(application().start_component("Gain"));
  EXPECT_TRUE(wait_for_steps(1));
  EXPECT_EQ(application().start_component("Gain").reason(), "cannot start while Running");
}

TEST_P(Control, AComponentThatWasCleanedUpIsConfiguredAnewByItsStart) {
  EXPECT_THAT(std::string(application().clean_up_component("Gain").reason()),
              ::testing::HasSubstr("stop it first"));
  ASSERT_TRUE(application().stop_component("Gain"));
  ASSERT_TRUE(application().clean_up_component("Gain"));
  EXPECT_EQ(gain_->state(), State::kPreOperational);
  ASSERT_TRUE(application().start_component("Gain"));
  EXPECT_EQ(gain_->state(), State::kRunning);
  ASSERT_TRUE(wait_for_steps(3));
  EXPECT_TRUE(application().value_of("Sink", "In"));
}

TEST_P(Control, WorkRunsAsTheComponentsCodeAndAnExceptionFaultsIt) {
  std::thread::id where;
  std::string who;
  EXPECT_TRUE(application().run_in_thread_of(*sink_, [&] {
    where = std::this_thread::get_id();
    who = component::Host::context(*sink_).running()->name();
  }));
  EXPECT_EQ(who, "Sink");
  EXPECT_EQ(where == std::this_thread::get_id(), GetParam()) << "simulated time has no threads";
  EXPECT_TRUE(application().run_in_thread_of(*sink_, [] { throw std::runtime_error("tool"); }));
  EXPECT_EQ(sink_->state(), State::kException);
  EXPECT_EQ(application().faults(), 1u);
}

TEST_P(Control, EverythingIsAnsweredAlsoWhenNothingRuns) {
  EXPECT_TRUE(application().stop().ok());
  EXPECT_TRUE(application().value_of("Gain", "Out"));
  EXPECT_TRUE(application().set_property("Gain", "Factor", Value::of(3.0)));
  EXPECT_EQ(application().call("Gain", "scale", {Value::of(1.0)}).error(), "scale: not ready: ");
  EXPECT_EQ(application().find("Sink"), sink_);
  EXPECT_EQ(application().find("Nobody"), nullptr);
}

TEST_P(Control, StatisticsNameEveryThreadInTheOrderOfDeclaration) {
  ASSERT_TRUE(wait_for_steps(20));
  const std::vector<ThreadStatistics> all = application().thread_statistics();
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].name, "Counter");
  EXPECT_GE(all[0].cycles_run, 19u) << "a cycle is counted when it is over";
  EXPECT_GT(all[0].latency_ns.count, 0u);
  EXPECT_EQ(all[1].name, "Gain");
  EXPECT_GT(all[1].cycles_run, 0u);
  EXPECT_EQ(all[1].latency_ns.count, 0u) << "nobody knows when it should have woken";
  EXPECT_EQ(all[2].name, "service");
  EXPECT_EQ(all[2].cycles_run, 0u);
}

TEST(ControlInRealTime, AManyTimesAskedThreadKeepsItsCyclesAndAnswersAll) {
  Blueprint blueprint;
  blueprint.add<Counter>("Counter", Activity::periodic(1ms));
  Application application(std::move(blueprint), patient(false));
  ASSERT_TRUE(application.start().ok());
  for (int i = 0; i < 2000; ++i) {
    const auto value = application.value_of("Counter", "Count");
    ASSERT_TRUE(value) << value.error();
  }
  const base::Time begin = application.now();
  EXPECT_TRUE(run_until(application, [&] { return application.now() - begin > 5ms; }));
  const ThreadStatistics statistics = application.thread_statistics()[0];
  EXPECT_GT(statistics.cycles_run, 0u);
  EXPECT_LE(statistics.cycle_ticks.count, statistics.cycles_run) << "questions are no cycles";
}

}  // namespace
}  // namespace armature::exec
