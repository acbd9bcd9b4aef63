// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/base/sample_input.hpp"

#include <chrono>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/interface.hpp"
#include "armature/controllers/base/actuator.hpp"
#include "armature/controllers/base/sensor.hpp"
#include "armature/controllers/sampler/sampler.hpp"
#include "armature/exec/application.hpp"
#include "armature/exec/plan.hpp"

namespace armature::controllers {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

class FakeSensor final : public Sensor {
 public:
  using Sensor::Sensor;

 private:
  component::Outcome on_configure() override {
    measured_.assign(2 * static_cast<std::size_t>(joints_.get()), 0.0);
    return component::accepted();
  }
  void sample_now() override {
    measured_[0] += 1.0;
    sensor_.write(measured_);
  }
  std::vector<double> measured_;
};

/// Acts on what the sensor measures, without a controller between.
class Follower final : public Actuator {
 public:
  using Actuator::Actuator;
  int sampled = 0, acted = 0;

 private:
  void actuate(const std::vector<double>& /*act*/) override {}
  void on_sensor(const std::vector<double>& /*measured*/) {
    ++acted;
    if (take_sample()) ++sampled;
  }
  component::InputPort<std::vector<double>> sensor_{this, "sensor", "measured", "rad",
                                                    component::on_data<&Follower::on_sensor>};
};

class SampleInputTest : public ::testing::Test {
 protected:
  SampleInputTest() {
    blueprint.add<Sampler>("Sampler", exec::Activity::periodic(10ms));
    blueprint.add<FakeSensor>("Sensor");
    follower = &blueprint.add<Follower>("Actuator");
    blueprint.connect("Sensor.sensor", "Actuator.sensor");
    blueprint.connect("Writer.Out", "Actuator.act");
    auto& writer = blueprint.add<ActWriter>("Writer", exec::Activity::periodic(10ms));
    static_cast<void>(writer);
    for (auto& entry : blueprint.components) {
      for (auto* property : component::interface_of(*entry.component).mandatory) {
        EXPECT_TRUE(property->set(types::Value::of(1)));
      }
    }
  }
  class ActWriter final : public component::Component {
   public:
    using Component::Component;

   private:
    void on_update() override { out_.write(act_); }
    std::vector<double> act_{0.0};
    component::OutputPort<std::vector<double>> out_{this, "Out", "nothing", "V",
                                                    component::fixed_size(1)};
  };
  std::string problems() {
    base::Diagnostics diagnostics;
    exec::make_plan(blueprint, diagnostics);
    return diagnostics.to_text();
  }
  void run() {
    exec::ApplicationOptions options;
    options.simulated = true;
    exec::Application application(std::move(blueprint), options);
    const auto started = application.start();
    ASSERT_TRUE(started.ok()) << started.to_text();
    application.run_for(995ms);
    EXPECT_EQ(follower->acted, 99);
    EXPECT_EQ(follower->sampled, 99) << "each time in the same cycle";
  }

  exec::Blueprint blueprint;
  Follower* follower = nullptr;
};

TEST_F(SampleInputTest, TheEventOfAPeerBeginsASample) {
  blueprint.add_peer("Sensor", "Sampler");
  blueprint.add_peer("Actuator", "Sampler");
  EXPECT_EQ(problems(), "");
  run();
}

TEST_F(SampleInputTest, ThePortBeginsOneToo) {
  blueprint.connect("Sampler.SamplePort", "Actuator.SamplePort");
  blueprint.connect("Sampler.SamplePort", "Sensor.SamplePort");
  EXPECT_EQ(problems(), "");
  run();
}

TEST_F(SampleInputTest, WhoseDataTriggersOthersIsConnectedAfterThem) {
  blueprint.connect("Sampler.SamplePort", "Sensor.SamplePort");
  blueprint.connect("Sampler.SamplePort", "Actuator.SamplePort");
  EXPECT_THAT(problems(), HasSubstr("'Sensor': it is sampled before 'Actuator', which its data "
                                    "triggers (connect SamplePort to 'Actuator' first)"));
}

TEST_F(SampleInputTest, WhomItsDataTriggersIsNotToldByTheEventLater) {
  blueprint.connect("Sampler.SamplePort", "Sensor.SamplePort");
  blueprint.add_peer("Actuator", "Sampler");
  EXPECT_THAT(problems(), HasSubstr("'Sensor': it is sampled before 'Actuator'"));
}

TEST_F(SampleInputTest, TheEventAndThePortAreOneTooMany) {
  blueprint.add_peer("Sensor", "Sampler");
  blueprint.add_peer("Actuator", "Sampler");
  blueprint.connect("Sampler.SamplePort", "Actuator.SamplePort");
  EXPECT_THAT(problems(), HasSubstr("'Actuator': it is sampled by the event Sample and by the port "
                                    "SamplePort, expected one of them"));
}

TEST_F(SampleInputTest, NobodyIsAMistake) {
  blueprint.add_peer("Actuator", "Sampler");
  EXPECT_THAT(problems(), HasSubstr("'Sensor': nobody samples it"));
}

}  // namespace
}  // namespace armature::controllers
