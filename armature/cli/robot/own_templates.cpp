// SPDX-License-Identifier: Apache-2.0
// A robot whose drives are simulated, without a bus.
#include <array>

#include "armature/cli/robot/robot_templates.hpp"
#include "armature/cli/robot/shared_templates.hpp"

namespace armature::cli {

namespace {

constexpr std::string_view kOwnBuild = R"(cmake_minimum_required(VERSION 3.25)
project(@name@ LANGUAGES CXX)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE RelWithDebInfo)
endif()

find_package(armature 0.1 REQUIRED)

# build/lib/armature/lib@name@.so, which @name@.yaml names
armature_component_library(NAME @name@ SOURCES @name@.cpp @name@_drive.cpp LINK armature::controllers armature::sim)

enable_testing()
add_test(NAME @name@_check COMMAND armature::program check ${PROJECT_SOURCE_DIR}/simulated.yaml)
set_tests_properties(@name@_check PROPERTIES FAIL_REGULAR_EXPRESSION "warning:;error:")
add_test(NAME @name@_moves COMMAND armature::program run --sim --for 60s --script ${PROJECT_SOURCE_DIR}/move.lua
                                   ${PROJECT_SOURCE_DIR}/simulated.yaml)
@promises@)";

constexpr std::string_view kOwnLibrary = R"(#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "@name@_drive.hpp"
#include "@name@_plant.hpp"
#include "armature/component/registry.hpp"

namespace @name@ {

/// The drives, simulated: write a host of your real ones beside it, a class that extends @Name@Host.
class Simulated@Name@ final : public @Name@Host {
 public:
  using @Name@Host::@Name@Host;

 private:
  Outcome on_configure() override {
    auto arm = @Name@Plant::load(file_, start_, rotor_inertia_);
    if (!arm) return refused(arm.error());
    arm_.emplace(std::move(arm).value());
    return accepted();
  }
  Outcome on_start() override {
    now_ = time();
    return accepted();
  }
  void on_stop() override {
    for (std::size_t i = 0; i < arm_->joints(); ++i) arm_->set_power(i, Power::kOff);
  }

  @Name@Sample read(int node) override {
    if (!is_known(node)) return {};
    arm_->step(std::max(time() - now_, armature::base::Duration(0)));
    now_ = time();
    const std::size_t joint = joint_of(node);
    return {.fresh = true,
            .power = static_cast<int>(arm_->power(joint)),
            .position = arm_->position(joint)};
  }
  bool set_torque(int node, LimitedEffort torque) override {
    if (!is_known(node)) return false;
    arm_->set_torque(joint_of(node), torque);
    return true;
  }
  bool set_power(int node, Power power) override {
    if (!is_known(node)) return false;
    arm_->set_power(joint_of(node), power);
    return true;
  }

  bool is_known(int node) const {
    return arm_ && node >= 1 && static_cast<std::size_t>(node) <= arm_->joints();
  }
  static std::size_t joint_of(int node) { return static_cast<std::size_t>(node - 1); }

  Property<std::string> file_{this, "robot_description", "", "the URDF of the arm", "", mandatory};
  Property<std::vector<double>> start_{this, "start", {}, "where each joint begins", "rad", mandatory};
  Property<double> rotor_inertia_{this, "rotor_inertia", 0.0, "of each motor, at its joint", "kg m^2"};
  std::optional<@Name@Plant> arm_;
  armature::base::Time now_{};
};

}  // namespace @name@

ARMATURE_COMPONENT_LIBRARY(@name@, registry) {
  registry.add<@name@::@Name@Drive>("@Name@Drive", "the drive of a joint");
  registry.add<@name@::Simulated@Name@>("Simulated@Name@", "the drives, simulated");
}
)";

constexpr std::string_view kOwnSimulated = R"(# armature run --sim --script move.lua simulated.yaml
#
# The drives are simulated, with the arm's dynamics. Your own differ by this file alone.
include: @name@.yaml
grants: {script: [Arming.arm]}  # nobody stands beside a simulated arm
components:
  Bus: {model: Simulated@Name@, properties: {robot_description: "${here}/@name@.urdf", start: [@start@], rotor_inertia: @rotor@}}
)";

constexpr std::string_view kOwnReadme = R"(# @Name@

An arm with @joints@ joints and simulated drives, to be changed into yours. Build and test it, then move it:

```sh
cmake -S . -B build && cmake --build build && ctest --test-dir build
armature run --sim --script move.lua --out out recorded.yaml
armature report out
```

If Armature is not installed in /usr or /usr/local, tell CMake where: `-DCMAKE_PREFIX_PATH=/opt/armature`.

| file | what it has |
| --- | --- |
| `@name@.urdf` | the description: links, joints, limits |
| `@name@.yaml` | the robot: limits, gains, motions |
| `controller.yaml` | everything between drives and motions |
| `simulated.yaml` | the simulated drives; write `real.yaml` beside it with yours |
| `@name@_host.hpp` | what a host of drives does: extend it |
| `@name@_drive.hpp`, `@name@_drive.cpp` | the drive of one joint |
| `@name@.cpp`, `@name@_plant.hpp` | the simulated drives |
| `move.lua` | a motion, which asserts that it arrives |
| `promises_test.cpp` | a test of what every drive promises; it needs GoogleTest (Debian: libgtest-dev) |
| `recorded.yaml` | the simulated arm with a recording for `armature report` |

`armature check simulated.yaml` finds mistakes, `armature graph simulated.yaml` draws the wiring.
)";

constexpr std::array<FileTemplate, 8> kFilesOfOwn = {{
    {"CMakeLists.txt", kOwnBuild},
    {"@name@_host.hpp", kHostTemplate},
    {"@name@_drive.hpp", kDriveTemplate},
    {"@name@_drive.cpp", kDriveSourceTemplate},
    {"@name@_plant.hpp", kArmTemplate},
    {"@name@.cpp", kOwnLibrary},
    {"simulated.yaml", kOwnSimulated},
    {"README.md", kOwnReadme},
}};

}  // namespace

std::span<const FileTemplate> own_templates() { return kFilesOfOwn; }

}  // namespace armature::cli
