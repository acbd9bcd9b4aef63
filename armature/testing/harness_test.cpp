// SPDX-License-Identifier: Apache-2.0
#include "armature/testing/harness.hpp"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/realtime_guard.hpp"

namespace armature::testing {
namespace {

using component::Outcome;
using component::State;
using std::chrono::milliseconds;

/// Uses one of everything.
class Heater final : public component::Component {
 public:
  using Component::Component;

 private:
  Outcome on_start() override {
    return limit_() > 0.0 ? component::accepted() : component::refused("Limit is not positive");
  }
  void on_update() override {
    ++cycles_;
    if (measured_.read().stale) log_warning("measurement is {} old", 1);
    const auto ambient = read_ambient_();
    if (ambient) ambient_seen_.assign(ambient.value);
    seconds_.write(static_cast<double>(base::to_ns(time())) * 1e-9);
    shares_.write(share_of_zone_);
  }
  void regulate(double measured) {
    power_.write(gain_() * (wanted_.read().value - measured));
    if (measured > limit_()) too_hot_.raise(measured);
  }
  double gain_at(double factor) {
    if (factor < 0.0) throw std::runtime_error("a factor is not negative");
    return factor * gain_();
  }
  Outcome begin_ramp(double target) {
    target_ = target;
    return target > limit_() ? component::refused("above the limit") : component::accepted();
  }
  bool ramp_is_over() { return cycles_ >= 3; }
  void supply_failed(int code) { log_error("supply failed with {}", code); }

  int cycles_ = 0;
  double target_ = 0.0;
  std::vector<double> share_of_zone_{0.25, 0.75};
  component::Property<double> gain_{this, "Gain", 1.0, "proportional gain", "W"};
  component::Property<double> limit_{this, "Limit", 90.0, "highest temperature"};
  component::Property<std::string> label_{this, "Label", "", "what people call it"};
  component::Property<int> zones_{this, "Zones", 2, "number of zones"};
  component::Attribute<double> ambient_seen_{this, "Ambient", 0.0, "of the last cycle"};
  component::InputPort<double> wanted_{this, "Wanted", "wanted temperature"};
  component::InputPort<double> measured_{
      this,
      "Measured",
      "measured temperature",
      "",
      component::on_data<&Heater::regulate>,
      component::max_age(milliseconds(5), component::Reaction::kStop)};
  component::InputPort<std::vector<double>> profile_{this, "Profile", "of each zone", "",
                                                     component::size_of(zones_)};
  component::OutputPort<double> power_{this, "Power", "heating power", "W"};
  component::OutputPort<double> seconds_{this, "Seconds", "time of the cycle", "s"};
  component::OutputPort<std::vector<double>> shares_{this, "Shares", "of each zone", "",
                                                     component::size_of(zones_)};
  component::Event<double> too_hot_{this, "TooHot", "above the limit"};
  component::Operation<double(double)> gain_at_{this, "GainAt", component::serve<&Heater::gain_at>,
                                                "scaled gain"};
  component::Command<double> ramp_{this, "Ramp", component::serve<&Heater::begin_ramp>,
                                   "heats up slowly", component::done_when<&Heater::ramp_is_over>};
  component::OperationCaller<double()> read_ambient_{this, "ReadAmbient", "ambient temperature",
                                                     component::optional};
  component::EventHandler<int> on_failure_{this, "SupplyFailed",
                                           component::serve<&Heater::supply_failed>,
                                           "the supply tells", component::optional};
};

class HarnessTest : public ::testing::Test {
 protected:
  Harness heater_{std::make_unique<Heater>("heater")};
};

/// The text of the error that `code` ends with.
template <typename Code>
std::string error_of(Code&& code) {
  try {
    code();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(HarnessTest, AHandlerRunsWhenTheTestWrites) {
  heater_.set("Gain", 2.0);
  ASSERT_TRUE(heater_.start());
  heater_.write("Wanted", 50.0);
  heater_.write("Measured", 20.0);
  EXPECT_EQ(heater_.output<double>("Power"), 60.0);
  EXPECT_EQ(heater_.writes("Power"), 1u);
}

TEST_F(HarnessTest, WhatWasWrittenBeforeStartIsThereAtStart) {
  heater_.write("Wanted", 50.0);
  ASSERT_TRUE(heater_.start());
  heater_.write("Measured", 20.0);
  EXPECT_EQ(heater_.output<double>("Power"), 30.0);
}

TEST_F(HarnessTest, ARefusedStartSaysWhy) {
  heater_.set("Limit", -1);
  EXPECT_EQ(heater_.start().reason(), "Limit is not positive");
  EXPECT_EQ(heater_.state(), State::kStopped);
}

TEST_F(HarnessTest, ACycleTakesOnePeriodOfTheTestsClock) {
  ASSERT_TRUE(heater_.start());
  heater_.run_cycles(3);
  EXPECT_DOUBLE_EQ(heater_.output<double>("Seconds"), 0.003);
  EXPECT_EQ(heater_.writes("Seconds"), 3u);
}

TEST_F(HarnessTest, DataAgesAsTimePasses) {
  ASSERT_TRUE(heater_.start());
  heater_.write("Measured", 20.0);
  heater_.advance(milliseconds(4));
  EXPECT_EQ(heater_.state(), State::kRunning);
  heater_.advance(milliseconds(2));
  EXPECT_EQ(heater_.state(), State::kStopped);
  EXPECT_THAT(heater_.reason(), ::testing::HasSubstr("input 'Measured'"));
}

TEST_F(HarnessTest, PropertiesAreSetByValueOrAsText) {
  heater_.set("Gain", 3);
  EXPECT_EQ(heater_.get<double>("Gain"), 3.0);
  heater_.set("Label", "the left one");
  EXPECT_EQ(heater_.get<std::string>("Label"), "the left one");
}

TEST_F(HarnessTest, OperationsReturnTheirResult) {
  ASSERT_TRUE(heater_.start());
  EXPECT_EQ(heater_.call<double>("GainAt", 3.0).value(), 3.0);
}

TEST_F(HarnessTest, AnExceptionInAnOperationIsItsErrorAndTheComponentsFault) {
  ASSERT_TRUE(heater_.start());
  EXPECT_THAT(heater_.call<double>("GainAt", -1.0).error(),
              ::testing::HasSubstr("a factor is not negative"));
  EXPECT_EQ(heater_.state(), State::kException);
}

TEST_F(HarnessTest, ACommandIsFollowedToItsEnd) {
  ASSERT_TRUE(heater_.start());
  const component::CommandHandle ramp = heater_.send("Ramp", 60.0);
  EXPECT_EQ(ramp.stage(), component::CommandStage::kAccepted);
  heater_.run_cycles(3);
  EXPECT_EQ(ramp.stage(), component::CommandStage::kDone);
  EXPECT_EQ(heater_.send("Ramp", 100.0).reason(), "above the limit");
  EXPECT_EQ(heater_.call("Ramp", 100.0).error(), "above the limit");
}

TEST_F(HarnessTest, EventsAreRecordedWithTheirArguments) {
  ASSERT_TRUE(heater_.start());
  const auto& alarms = heater_.record<double>("TooHot");
  heater_.write("Measured", 95.0);
  heater_.write("Measured", 80.0);
  ASSERT_EQ(alarms.size(), 1u);
  EXPECT_EQ(std::get<0>(alarms[0]), 95.0);
}

TEST_F(HarnessTest, EventsOfPeersAreRaisedByTheTest) {
  ASSERT_TRUE(heater_.start());
  heater_.raise("SupplyFailed", 7);
  EXPECT_EQ(heater_.log(), std::vector<std::string>{"error: supply failed with 7"});
}

TEST_F(HarnessTest, OperationsOfPeersAreServedByTheTest) {
  double ambient = 18.0;
  heater_.serve<double()>("ReadAmbient", [&] { return ambient; });
  ASSERT_TRUE(heater_.start());
  heater_.run_cycles();
  EXPECT_EQ(heater_.get<double>("Ambient"), 18.0);
}

TEST_F(HarnessTest, VectorsKeepTheirConfiguredSize) {
  EXPECT_EQ(error_of([&] {
              heater_.write("Profile", std::vector{1.0, 2.0, 3.0});
            }),
            "'heater': 'Profile' was configured for vectors of another size");
  heater_.write("Profile", std::vector{1.0, 2.0});
  EXPECT_EQ(error_of([&] { heater_.write("Profile", std::vector{1.0}); }),
            "'heater': 'Profile' was configured for vectors of another size");
}

TEST_F(HarnessTest, OutputsHaveTheSizeThatTheyDeclare) {
  ASSERT_TRUE(heater_.start());
  heater_.run_cycles();
  EXPECT_EQ(heater_.output<std::vector<double>>("Shares"), (std::vector{0.25, 0.75}));
}

TEST_F(HarnessTest, AWrongNameIsToldWithTheRightOne) {
  EXPECT_EQ(error_of([&] { heater_.write("Wantd", 1.0); }),
            "'heater' has no input 'Wantd'; did you mean 'Wanted'?");
}

TEST_F(HarnessTest, AWrongTypeIsToldWithTheRightOne) {
  EXPECT_EQ(error_of([&] { heater_.write("Wanted", 1); }),
            "'heater': 'Wanted' is of type double, not int32");
  EXPECT_EQ(error_of([&] { heater_.output<int>("Power"); }),
            "'heater': 'Power' is of type double, not int32");
  EXPECT_EQ(error_of([&] { heater_.record<int>("TooHot"); }),
            "'heater': 'TooHot' is void(double), not void(int32)");
}

TEST_F(HarnessTest, ARefusedPropertyIsAnError) {
  EXPECT_THAT(error_of([&] { heater_.set("Gain", "much"); }),
              ::testing::StartsWith("'heater': property 'Gain': "));
}

TEST_F(HarnessTest, NothingOfItDisturbsTheGuard) {
  ASSERT_TRUE(heater_.start());
  heater_.serve<double()>("ReadAmbient", [] { return 18.0; });
  const auto& alarms = heater_.record<double>("TooHot");
  const RealtimeGuard guard;
  heater_.write("Wanted", 50.0);
  heater_.write("Measured", 95.0);
  heater_.run_cycles(3);
  const component::CommandHandle ramp = heater_.send("Ramp", 60.0);
  heater_.raise("SupplyFailed", 7);
  EXPECT_EQ(guard.violations(), 0u) << guard.report();
  EXPECT_EQ(alarms.size(), 1u);
}

}  // namespace
}  // namespace armature::testing
