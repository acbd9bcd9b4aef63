// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "armature/cli/robot/robot_templates.hpp"

namespace armature::cli {
namespace {

constexpr std::string_view kCia402Build = R"(cmake_minimum_required(VERSION 3.25)
project(@name@ LANGUAGES CXX)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
find_package(armature 0.1 REQUIRED)

enable_testing()
add_test(NAME @name@_check COMMAND armature::program check ${PROJECT_SOURCE_DIR}/simulated.yaml)
set_tests_properties(@name@_check PROPERTIES FAIL_REGULAR_EXPRESSION "warning:;error:")
add_test(NAME @name@_moves COMMAND armature::program run --sim --for 60s --script ${PROJECT_SOURCE_DIR}/move.lua
                                   ${PROJECT_SOURCE_DIR}/simulated.yaml)
@promises@)";

constexpr std::string_view kCia402Simulated =
    R"(# armature run --sim --script move.lua simulated.yaml
#
# The drives are emulated in the same process, and move the arm of the description. on_can.yaml is the same arm on a bus.
include: @name@.yaml
libraries: [cia402_arm]
grants: {script: [Arming.arm]}  # nobody stands beside a simulated arm
components:
  Bus:
    model: EmulatedCia402Arm
    peers: [Sampler]
    properties: {nodes: [@nodes@], mode: position, robot_description: "${here}/@name@.urdf", start: [@start@], rotor_inertia: @simulated_rotor@}
)";

constexpr std::string_view kCia402OnCan = R"(# armature run --browse on_can.yaml
#
# The drives on the CAN interface of this machine. An operator arms: Arming:arm()
include: @name@.yaml
parameters: {bus: can0}
components:
  # vendor and product, as in the drives' object 0x1018, are compared if you give them.
  Bus: {model: Cia402Bus, peers: [Sampler], properties: {bus: "${bus}", nodes: [@nodes@], mode: position}}
)";

constexpr std::string_view kCia402Readme = R"(# @Name@

An arm with @joints@ joints, whose drives speak CiA 402 on CANopen. It needs no C++ but for its test. Test it, then move it in simulation:

```sh
cmake -S . -B build && cmake --build build && ctest --test-dir build
armature run --sim --script move.lua --out out recorded.yaml
armature report out
```

| file | what it has |
| --- | --- |
| `@name@.urdf` | the description: links, joints, limits |
| `@name@.yaml` | the robot: limits and motions |
| `controller.yaml` | everything between drives and motions |
| `simulated.yaml`, `on_can.yaml` | the drives: emulated, or on a CAN interface |
| `move.lua` | a motion, which asserts that it arrives |
| `promises_test.cpp` | a test of what every drive promises; it needs GoogleTest (Debian: libgtest-dev) |
| `recorded.yaml` | the simulated arm with a recording for `armature report` |

`armature check simulated.yaml` finds mistakes, `armature graph simulated.yaml` draws the wiring.
)";

constexpr std::array<FileTemplate, 4> kCia402 = {{
    {"CMakeLists.txt", kCia402Build},
    {"simulated.yaml", kCia402Simulated},
    {"on_can.yaml", kCia402OnCan},
    {"README.md", kCia402Readme},
}};

}  // namespace

std::span<const FileTemplate> drive_templates(DriveKind kind) {
  if (kind == DriveKind::kCia402) return kCia402;
  return kind == DriveKind::kCan ? can_templates() : own_templates();
}

}  // namespace armature::cli
