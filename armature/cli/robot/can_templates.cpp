// SPDX-License-Identifier: Apache-2.0
// A robot whose drives speak a protocol of their own on CAN.
#include <array>

#include "armature/cli/robot/can_host_templates.hpp"
#include "armature/cli/robot/can_link_templates.hpp"
#include "armature/cli/robot/robot_templates.hpp"
#include "armature/cli/robot/shared_templates.hpp"

namespace armature::cli {
namespace {

constexpr std::string_view kCanBuild = R"(cmake_minimum_required(VERSION 3.25)
project(@name@ LANGUAGES CXX)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE RelWithDebInfo)
endif()

find_package(armature 0.1 REQUIRED)

# build/lib/armature/lib@name@.so, which @name@.yaml names
armature_component_library(
  NAME @name@
  SOURCES @name@.cpp @name@_can_host.cpp @name@_drive.cpp @name@_simulated_link.cpp
  LINK armature::can armature::controllers armature::platform armature::sim)

enable_testing()
add_test(NAME @name@_check COMMAND armature::program check ${PROJECT_SOURCE_DIR}/simulated.yaml)
set_tests_properties(@name@_check PROPERTIES FAIL_REGULAR_EXPRESSION "warning:;error:")
add_test(NAME @name@_moves COMMAND armature::program run --sim --for 60s --script ${PROJECT_SOURCE_DIR}/move.lua
                                   ${PROJECT_SOURCE_DIR}/simulated.yaml)
@promises@)";

constexpr std::string_view kCanLibrary = R"(#include "@name@_can_host.hpp"
#include "@name@_drive.hpp"
#include "armature/component/registry.hpp"

ARMATURE_COMPONENT_LIBRARY(@name@, registry) {
  registry.add<@name@::@Name@Drive>("@Name@Drive", "the drive of a joint");
  registry.add<@name@::@Name@Bus>("@Name@Bus", "the drives on a CAN interface");
  registry.add<@name@::Simulated@Name@Bus>("Simulated@Name@Bus", "simulated drives on a simulated bus");
}
)";

constexpr std::string_view kCanSimulated = R"(# armature run --sim --script move.lua simulated.yaml
#
# Simulated drives on a simulated bus, with the arm's dynamics. on_can.yaml is the same arm on a real one.
include: @name@.yaml
grants: {script: [Arming.arm]}  # nobody stands beside a simulated arm
components:
  Bus:
    model: Simulated@Name@Bus
    peers: [Sampler]
    properties: {nodes: [@nodes@], robot_description: "${here}/@name@.urdf", start: [@start@], rotor_inertia: @rotor@}
)";

constexpr std::string_view kCanOnCan = R"(# armature run --browse on_can.yaml
#
# The drives on the CAN interface of this machine. An operator arms: Arming:arm()
include: @name@.yaml
parameters: {bus: can0}
components:
  Bus: {model: @Name@Bus, peers: [Sampler], properties: {bus: "${bus}", nodes: [@nodes@], guardian: on}}
)";

constexpr std::string_view kCanReadme = R"(# @Name@

An arm with @joints@ joints, whose drives speak a protocol of their own on CAN. Build and test it, then move it in simulation:

```sh
cmake -S . -B build && cmake --build build && ctest --test-dir build
armature run --sim --script move.lua --out out recorded.yaml
armature report out
```

If Armature is not installed in /usr or /usr/local, tell CMake where: `-DCMAKE_PREFIX_PATH=/opt/armature`.

| file | what it has |
| --- | --- |
| `@name@_protocol.hpp` | the frames: change them into those of your drives |
| `@name@_can_host.hpp`, `@name@_can_host.cpp` | all drives in one cycle of the bus, with a guardian |
| `@name@_drive.hpp`, `@name@_drive.cpp` | the drive of one joint |
| `@name@_host.hpp` | what the drive of a joint asks of its host |
| `@name@_simulated_link.hpp`, `.cpp`, `@name@_plant.hpp` | simulated drives that speak the protocol |
| `@name@.cpp` | the component library |
| `@name@.urdf` | the description: links, joints, limits |
| `@name@.yaml` | the robot: limits, gains, motions |
| `controller.yaml` | everything between drives and motions |
| `simulated.yaml`, `on_can.yaml` | the drives: simulated, or on a CAN interface |
| `move.lua` | a motion, which asserts that it arrives |
| `promises_test.cpp` | a test of what every drive promises; it needs GoogleTest (Debian: libgtest-dev) |
| `recorded.yaml` | the simulated arm with a recording for `armature report` |

`armature check simulated.yaml` finds mistakes, `armature graph simulated.yaml` draws the wiring.
)";

constexpr std::array<FileTemplate, 14> kFilesOfCan = {{
    {"CMakeLists.txt", kCanBuild},
    {"@name@_host.hpp", kHostTemplate},
    {"@name@_drive.hpp", kDriveTemplate},
    {"@name@_drive.cpp", kDriveSourceTemplate},
    {"@name@_protocol.hpp", kProtocol},
    {"@name@_can_host.hpp", kCanHost},
    {"@name@_can_host.cpp", kCanHostSource},
    {"@name@_plant.hpp", kArmTemplate},
    {"@name@_simulated_link.hpp", kSimulatedLink},
    {"@name@_simulated_link.cpp", kSimulatedLinkSource},
    {"@name@.cpp", kCanLibrary},
    {"simulated.yaml", kCanSimulated},
    {"on_can.yaml", kCanOnCan},
    {"README.md", kCanReadme},
}};

}  // namespace

std::span<const FileTemplate> can_templates() { return kFilesOfCan; }

}  // namespace armature::cli
