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

deploy::Deployment load(std::vector<std::string> overrides) {
  deploy::DeploymentOptions options;
  options.library_folders = {LIBRARIES};
  options.document.overrides = std::move(overrides);
  return deploy::load_deployment(EXAMPLES "/12_cia402/position.yaml", options);
}

std::string mistakes(std::vector<std::string> overrides) {
  return load(std::move(overrides)).diagnostics.to_text();
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
