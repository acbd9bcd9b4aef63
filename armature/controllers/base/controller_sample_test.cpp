// SPDX-License-Identifier: Apache-2.0
// A Sample enables one computation of a Controller.
#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/host.hpp"
#include "armature/component/interface.hpp"
#include "armature/controllers/controller_npid/controller_npid.hpp"
#include "armature/testing/harness.hpp"
#include "armature/testing/test_thread.hpp"

namespace armature::controllers {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class SampledController : public ::testing::Test {
 protected:
  void start() {
    controller.set("joints", 2);
    ASSERT_TRUE(controller.start()) << controller.reason();
  }
  void desire(double first, double second) {
    controller.write("reference", std::vector<double>{first, second, 0.1, 0.2, 0.3, 0.4});
  }

  testing::Harness controller{std::make_unique<ControllerNPID>("Controller")};
};

TEST_F(SampledController, ComputesOnceForEachSample) {
  start();
  desire(1.0, 2.0);
  const std::vector<double> measured{0.5, 0.6, 0.01, 0.02};
  controller.write("sensor", measured);
  EXPECT_EQ(controller.writes("Sen1"), 0u) << "no Sample came";
  EXPECT_EQ(controller.get<int>("sensor_without_sample"), 1);
  controller.raise("Sample");
  EXPECT_EQ(controller.writes("Sen1"), 0u) << "a Sample enables, and computes nothing itself";
  controller.write("sensor", measured);
  EXPECT_EQ(controller.writes("Sen1"), 1u);
  controller.write("sensor", measured);
  EXPECT_EQ(controller.writes("Sen1"), 1u) << "the Sample was used";
  EXPECT_EQ(controller.get<int>("sensor_without_sample"), 2);
  EXPECT_THAT(controller.log(), ElementsAre(HasSubstr("came without a Sample")));
}

TEST_F(SampledController, ASampleFromBeforeItsStartEnablesNothing) {
  start();
  controller.raise("Sample");
  controller.stop();
  ASSERT_TRUE(controller.start()) << controller.reason();
  desire(1.0, 2.0);
  controller.write("sensor", std::vector<double>{0.5, 0.6, 0.01, 0.02});
  EXPECT_EQ(controller.writes("Sen1"), 0u);
}

TEST_F(SampledController, FaultsForANumberThatIsNoneAlsoWithoutASample) {
  start();
  controller.write("sensor", std::vector<double>{0.5, std::nan(""), 0.01, 0.02});
  EXPECT_EQ(controller.state(), component::State::kException);
  EXPECT_EQ(controller.reason(), "sensor has a number that is not finite, expected finite numbers");
}

/// Two controllers that take turns, and what is around them.
class ControllersThatTakeTurns : public ::testing::Test {
 protected:
  struct Around : component::Component {
    using Component::Component;
    component::Event<> sample{this, "Sample", "a sampling period begins"};
    component::OutputPort<std::vector<double>> sensor{this, "sensor", "", "rad",
                                                      component::fixed_size(2)};
    component::OutputPort<std::vector<double>> reference{this, "reference", "", "",
                                                         component::fixed_size(3)};
    component::InputPort<std::vector<double>> act{
        this, "act", "", "V", component::fan_in, component::fixed_size(1)};
  };

  ControllersThatTakeTurns() {
    for (auto* output : component::interface_of(around).outputs) output->prepare();
    for (ControllerNPID* each : {&first, &second}) {
      EXPECT_TRUE(component::Host::configure(*each));
      for (auto* output : component::interface_of(*each).outputs) output->prepare();
      face(around.sample).subscribe(*component::interface_of(*each).handlers.front());
      connect(face(around.sensor), input(*each, "sensor"));
      connect(face(around.reference), input(*each, "reference"));
      connect(act(*each), face(around.act));
    }
    component::start(around, first);
  }
  static void connect(component::OutputPortBase& from, component::InputPortBase& to) {
    from.connect(to, {});
  }
  static component::InputPortBase& input(component::Component& of, std::string_view name) {
    for (auto* each : component::interface_of(of).inputs) {
      if (each->name() == name) return *each;
    }
    throw std::invalid_argument("there is no such input");
  }
  static component::OutputPortBase& act(component::Component& of) {
    for (auto* each : component::interface_of(of).outputs) {
      if (each->name() == "act") return *each;
    }
    throw std::invalid_argument("there is no act");
  }
  std::uint64_t asked(component::Component& of) {
    for (auto* each : component::interface_of(of).outputs) {
      if (each->name() == "Sen1") return each->current_sequence();
    }
    return 0;
  }
  void take_turns() {
    act(second).take_over_from(&act(first));
    component::start(second);
    act(second).take_over_from(nullptr);
    first.stop();
  }
  void measure() { around.sensor.write({0.5, 0.0}); }
  void desire() { around.reference.write({0.5, 0.0, 0.0}); }

  Around around{"around"};
  ControllerNPID first{"first"};
  ControllerNPID second{"second"};
  component::TestThread thread{around, first, second};
};

TEST_F(ControllersThatTakeTurns, TheOneThatTakesOverHasTheSampleThatTheOtherDidNotUse) {
  desire();
  around.sample.raise();
  measure();
  ASSERT_EQ(asked(first), 1u);
  around.sample.raise();
  take_turns();
  measure();
  EXPECT_EQ(asked(second), 1u) << "no cycle is lost";
  measure();
  EXPECT_EQ(asked(second), 1u);
}

}  // namespace
}  // namespace armature::controllers
