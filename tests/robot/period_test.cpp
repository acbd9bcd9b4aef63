// SPDX-License-Identifier: Apache-2.0
// Who samples a robot determines its period: of the WAM, of Janus and of an own robot.
#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/deploy/deployment.hpp"
#include "armature/exec/application.hpp"

namespace armature {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

struct Robot {
  const char* name;
  const char* file;
  const char* hardware;  ///< what stands before it
  const char* period;    ///< which its file says
  const char* other;
};

class PeriodOf : public ::testing::TestWithParam<Robot> {
 protected:
  deploy::Deployment load(std::vector<std::string> overrides = {}) {
    deploy::DeploymentOptions options;
    options.library_folders = {LIBRARIES};
    options.document.overrides = std::move(overrides);
    return deploy::load_deployment(std::string(SOURCES "/") + GetParam().file, options);
  }
  static std::string sampled_every(const char* period) {
    return std::string("Sampler.activity.periodic=") + period;
  }
  std::string property(const char* period) {
    return GetParam().hardware + std::string(".Period=") + period;
  }
  /// Both figures and both names.
  std::string contradiction(const char* property, const char* activity) {
    return std::string("'") + GetParam().hardware + "': Period is " + property +
           ", but 'Sampler' runs it every " + activity;
  }
};

TEST_P(PeriodOf, ARobotIsThatOfItsSampler) {
  const deploy::Deployment deployment = load();
  ASSERT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  for (const exec::ComponentEntry& entry : deployment.blueprint.components) {
    if (entry.component->name() != GetParam().hardware) continue;
    ASSERT_TRUE(entry.component->pace().known());
    EXPECT_EQ(entry.component->pace().owner->name(), "Sampler");
  }
}

TEST_P(PeriodOf, APropertyThatAgreesIsAccepted) {
  const deploy::Deployment deployment = load({property(GetParam().period)});
  EXPECT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
}

TEST_P(PeriodOf, ASamplerThatRunsOtherwiseThanThePropertyIsRefusedWithBothFigures) {
  const deploy::Deployment deployment =
      load({sampled_every(GetParam().other), property(GetParam().period)});
  EXPECT_FALSE(deployment.ok());
  EXPECT_THAT(deployment.diagnostics.to_text(),
              HasSubstr(contradiction(GetParam().period, GetParam().other)));
}

TEST_P(PeriodOf, APropertyThatSaysOtherwiseThanTheSamplerIsRefusedWithBothFigures) {
  const deploy::Deployment deployment = load({property(GetParam().other)});
  EXPECT_FALSE(deployment.ok());
  EXPECT_THAT(deployment.diagnostics.to_text(),
              HasSubstr(contradiction(GetParam().other, GetParam().period)));
}

TEST_P(PeriodOf, ASampleBetweenTwoCyclesIsAFaultThatSaysBothFigures) {
  deploy::Deployment deployment = load();
  ASSERT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  deployment.options.simulated = true;
  exec::Application application(std::move(deployment.blueprint), deployment.options);
  const base::Diagnostics started = application.start();
  ASSERT_TRUE(started.ok()) << started.to_text();
  application.run_for(501ms);
  const component::Component& hardware = *application.find(GetParam().hardware);
  ASSERT_EQ(hardware.state(), component::State::kRunning) << hardware.reason();
  ASSERT_TRUE(application.call("Sampler", "trigger", {}));
  application.run_for(1ms);
  EXPECT_EQ(hardware.state(), component::State::kException);
  EXPECT_EQ(hardware.reason(),
            std::string("it is sampled after 0 ms, but its period is ") + GetParam().period);
}

INSTANTIATE_TEST_SUITE_P(Robots, PeriodOf,
                         ::testing::Values(Robot{"Wam", "robots/wam/deployments/npid7.yaml", "WAM",
                                                 "2 ms", "20 ms"},
                                           Robot{"Janus", "robots/janus/deployments/pid.yaml",
                                                 "Joint1", "10 ms", "5 ms"},
                                           Robot{"OwnRobot", "examples/07_own_robot/arm.yaml",
                                                 "Joint1", "10 ms", "5 ms"}),
                         [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace armature
