// SPDX-License-Identifier: Apache-2.0
// Simulated drives of the examples: by voltage, and in each other way.
#include "armature/testing/drive_conformance.hpp"

namespace armature::testing {
namespace {

DriveCase own_robot() {
  return {.name = "Voltage",
          .file = EXAMPLES "/07_own_robot/arm.yaml",
          .library_folders = {ROBOT_LIBRARY, EXAMPLE_LIBRARY},
          .hardware = {"Drive1", "Drive2", "Drive3"},
          .away = {0.8, 0.5, -0.5}};
}

DriveCase drive_by(const std::string& way) {
  return {.name = way,
          .file = EXAMPLES "/11_drives/" + way + ".yaml",
          .library_folders = {ROBOT_LIBRARY, EXAMPLE_LIBRARY},
          .hardware = {"Drive1", "Drive2"},
          .away = {1.0, -0.8}};
}

INSTANTIATE_TEST_SUITE_P(Examples, DriveConformance,
                         ::testing::Values(own_robot(), drive_by("torque"), drive_by("velocity"),
                                           drive_by("position")),
                         by_name);

}  // namespace
}  // namespace armature::testing
