// SPDX-License-Identifier: Apache-2.0
// What a deployment with drives by CiA 402 is refused for, before anything moves.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/deploy/deployment.hpp"
#include "armature/platform/file.hpp"
#include "drives/cia402/objects.hpp"
#include "drives/cia402_components/emulated_cia402_bus.hpp"

namespace armature::cia402 {
namespace {

using ::testing::HasSubstr;

deploy::Deployment load(std::vector<std::string> overrides, const char* mode = "position") {
  deploy::DeploymentOptions options;
  options.library_folders = {LIBRARIES};
  options.document.overrides = std::move(overrides);
  return deploy::load_deployment(std::string(EXAMPLES "/12_cia402/") + mode + ".yaml", options);
}

std::string mistakes(std::vector<std::string> overrides, const char* mode = "position") {
  return load(std::move(overrides), mode).diagnostics.to_text();
}

/// What the application says against its start.
std::string refusal(std::vector<std::string> overrides) {
  deploy::Deployment deployment = load(std::move(overrides));
  EXPECT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  deployment.options.simulated = true;
  exec::Application application(std::move(deployment.blueprint), deployment.options);
  return application.start().to_text();
}

canopen::Eds eds_of_the_drives() {
  can::VirtualBus bus("can0", 1'000'000, [] { return base::Time{}; });
  const EmulatedDrive drive({}, bus.add_station("drive"), base::Time{});
  canopen::Eds eds = canopen::describe(drive.device().dictionary(), "Armature", "Emulated drive");
  eds.identity = {.vendor = 0x402, .product = 1, .revision = 0, .serial = 0};
  return eds;
}

std::string file_with(const canopen::Eds& eds, const std::string& name) {
  const std::string path = ::testing::TempDir() + name;
  EXPECT_TRUE(platform::write_file(path, canopen::to_text(eds)));
  return path;
}

TEST(Cia402Check, TheSameNodeTwiceIsRefused) {
  EXPECT_THAT(mistakes({"Bus.nodes=[1, 2, 1]"}), HasSubstr("'Bus': nodes has 1 twice"));
  EXPECT_THAT(mistakes({"Bus.nodes=[1, 2, 128]"}), HasSubstr("'Bus': nodes has 128"));
}

TEST(Cia402Check, TwoDrivesWithOneNodeAreRefused) {
  EXPECT_THAT(mistakes({"Drive2.node=1"}),
              HasSubstr("'Bus': drives 'Drive1' and 'Drive2' both have node 1 (give each drive its "
                        "own number)"));
}

TEST(Cia402Check, ABusTooSlowForItsPeriodIsRefused) {
  EXPECT_EQ(mistakes({"Bus.bit_rate=500000"}), "");
  EXPECT_THAT(mistakes({"Bus.bit_rate=250000"}),
              HasSubstr("'Bus': the frames of a cycle of 2 drives take up to 2.236 ms at 250000 "
                        "bit/s, and a cycle has 2 ms (raise bit_rate, lengthen the period, or put "
                        "drives on another bus)"));
}

/// Its joint would take a hundredth of its way for the whole.
TEST(Cia402Check, AGearThatTheDriveHasTakenIntoAccountIsRefused) {
  for (const char* mode : {"torque", "velocity", "position"}) {
    EXPECT_THAT(mistakes({"Joint2.GearRatio=0.01"}, mode),
                HasSubstr("'Joint2': GearRatio is 0.01, expected 1: its hardware tells of the "
                          "shaft behind its own gear"));
  }
  EXPECT_EQ(mistakes({"Joint1.GearRatio=0.5", "Joint2.GearRatio=0.5", "Robot.motor_gear_ratio=[2]"},
                     "velocity"),
            "")
      << "another one, behind";
}

TEST(Cia402Check, AGainOfVelocitiesThatTheAnswersAreTooLateForIsRefused) {
  EXPECT_EQ(mistakes({"Controller.Kp=[83]"}, "velocity"), "");
  EXPECT_THAT(mistakes({"Controller.Kp=[20, 84]"}, "velocity"),
              HasSubstr("Kp of joint 2 is 84 1/s, expected 83.33 at most: it is answered 6 ms "
                        "late"));
  EXPECT_THAT(mistakes({"Sampler.activity.periodic=50 ms"}, "velocity"),
              HasSubstr("Kp of joint 1 is 20 1/s, expected 9.259 at most"));
}

/// Gains are judged by what the Robot says.
TEST(Cia402Check, AnswersThatActLaterThanTheRobotSaysAreRefused) {
  for (const char* mode : {"torque", "velocity"}) {
    EXPECT_THAT(mistakes({"Sampler.activity.periodic=5 ms"}, mode),
                HasSubstr("'Bus': an answer to a sample acts two cycles later, 10 ms, and "
                          "effort_delay of the Robot says so of 0 joints, expected 2 (set "
                          "effort_delay of the Robot to two periods)"));
  }
  EXPECT_EQ(mistakes({"Sampler.activity.periodic=5 ms", "Robot.effort_delay=[10 ms]"}, "velocity"),
            "");
  EXPECT_EQ(mistakes({"Sampler.activity.periodic=5 ms"}), "") << "a drive in mode position";
}

/// Also while it runs.
TEST(Cia402Check, AGainOfVelocitiesCannotBecomeTooLarge) {
  deploy::Deployment deployment = load({}, "velocity");
  ASSERT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  deployment.options.simulated = true;
  exec::Application application(std::move(deployment.blueprint), deployment.options);
  const auto set = [&](double kp) {
    return application.set_property("Controller", "Kp", types::Value::of(std::vector<double>{kp}));
  };
  EXPECT_TRUE(set(40.0));
  EXPECT_FALSE(set(2000.0));
}

TEST(Cia402Check, AnEdsThatIsNotThereIsRefused) {
  EXPECT_THAT(mistakes({"Drive2.eds=missing.eds"}), HasSubstr("EDS of drive 'Drive2'"));
}

TEST(Cia402Check, AnEdsWithoutTheModesTargetIsRefused) {
  canopen::Eds eds = eds_of_the_drives();
  eds.objects.erase(object::kTargetPosition);
  EXPECT_THAT(mistakes({"Bus.eds=" + file_with(eds, "no_target.eds")}),
              HasSubstr("drive 'Drive1': object 0x607A:00 is missing, and each cycle needs it"));
}

TEST(Cia402Check, AnEdsOfAnotherMakerThanTheDeploymentSaysIsRefused) {
  const std::string file = file_with(eds_of_the_drives(), "of_402.eds");
  EXPECT_THAT(mistakes({"Drive2.eds=" + file, "Drive2.vendor=0x99"}),
              HasSubstr("drive 'Drive2': vendor is 0x402, expected 0x99"));
}

TEST(Cia402Start, DrivesThatTheirEdsDescribesStart) {
  EXPECT_EQ(refusal({"Bus.eds=" + file_with(eds_of_the_drives(), "right.eds")}), "");
}

TEST(Cia402Start, AnEdsOfAnotherProductIsRefusedForTheDriveThatItIsOf) {
  canopen::Eds eds = eds_of_the_drives();
  eds.identity.product = 5;
  const std::string text = refusal({"Drive2.eds=" + file_with(eds, "product_5.eds")});
  EXPECT_THAT(text, HasSubstr("drive 'Drive2', node 2: product 0x1018:02 is 0x1, and its EDS says "
                              "0x5"));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("Drive1")));
}

TEST(Cia402Start, AnObjectThatTheDriveHasOtherwiseIsRefused) {
  canopen::Eds eds = eds_of_the_drives();
  eds.objects[object::kRatedTorque].type = canopen::DataType::kUnsigned16;
  EXPECT_THAT(refusal({"Bus.eds=" + file_with(eds, "rated.eds")}),
              HasSubstr("object 0x6076:00 'Motor rated torque' has 4 bytes, and its EDS says "
                        "UNSIGNED16"));
}

TEST(Cia402Start, AnotherMakersDriveIsRefusedWithBothNumbers) {
  const std::string text = refusal({"Drive2.vendor=77"});
  EXPECT_THAT(text, HasSubstr("drive 'Drive2', node 2: vendor is 0x402, expected 0x4D"));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("node 1")));
}

}  // namespace
}  // namespace armature::cia402
