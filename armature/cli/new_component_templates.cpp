// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "armature/cli/component_templates.hpp"

namespace armature::cli {
namespace {

constexpr std::string_view kBuild = R"(cmake_minimum_required(VERSION 3.25)
project(@name@ LANGUAGES CXX)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE RelWithDebInfo)
endif()

find_package(armature 0.1 REQUIRED)

# build/lib/armature/lib@name@.so, which @name@.yaml names
armature_component_library(NAME @name@ SOURCES @name@.cpp)

enable_testing()
add_test(NAME @name@_deployment
         COMMAND armature::program run --sim --for 1s ${PROJECT_SOURCE_DIR}/@name@.yaml)
find_package(GTest)
if(GTest_FOUND)
  add_executable(@name@_test @name@_test.cpp @name@.cpp)
  target_link_libraries(@name@_test PRIVATE armature::testing GTest::gtest_main)
  add_test(NAME @name@_test COMMAND @name@_test)
else()
  message(STATUS "No GoogleTest (Debian: libgtest-dev), so @name@_test is not built")
endif()
)";

constexpr std::string_view kHeader = R"(#pragma once

#include "armature/component/author.hpp"

namespace @name@ {

using namespace armature::component;

/// Follows its input smoothly: each update goes a part of the way that is left. A first component to
/// change into your own.
class @Name@ final : public Component {
 public:
  using Component::Component;

 private:
  Outcome on_start() override;
  void on_update() override;
  void on_stop() override;
  void begin_at(double position);

  double position_ = 0.0;

  Property<double> share_{this, "Share", 0.5, "part of the way that one update goes", "",
                          range(0.0, 1.0), changeable_while_running};
  Property<double> start_{this, "Start", 0.0, "where it begins", "rad"};
  InputPort<double> goal_{this, "Goal", "where to go", "rad", may_stay_open};
  OutputPort<double> output_{this, "Position", "where it is", "rad"};
  Operation<void(double)> begin_at_{this,
                                    "beginAt",
                                    serve<&@Name@::begin_at>,
                                    "jumps to a position",
                                    in_own_thread,
                                    args("position [rad]")};
};

}  // namespace @name@
)";

constexpr std::string_view kSource = R"(#include "@name@.hpp"

namespace @name@ {

Outcome @Name@::on_start() {
  position_ = start_;
  return accepted();
}

// Runs in real time: it must not allocate, lock, wait or do input and output. log_... may be used.
void @Name@::on_update() {
  if (const Reading<double> goal = goal_.read()) position_ += share_ * (goal.value - position_);
  output_.write(position_);
}

void @Name@::on_stop() { log_info("stopped at {} rad", position_); }

void @Name@::begin_at(double position) { position_ = position; }

}  // namespace @name@

ARMATURE_COMPONENT_LIBRARY(@name@, registry) {
  registry.add<@name@::@Name@>("@Name@", "follows its input smoothly");
}
)";

constexpr std::string_view kTest = R"(#include "@name@.hpp"

#include <memory>

#include <gtest/gtest.h>

#include "armature/testing/harness.hpp"
#include "armature/testing/realtime_guard.hpp"

namespace @name@ {
namespace {

class @Name@Test : public ::testing::Test {
 protected:
  armature::testing::Harness follower_{std::make_unique<@Name@>("follower")};
};

TEST_F(@Name@Test, ReachesItsGoal) {
  ASSERT_TRUE(follower_.start()) << follower_.reason();
  follower_.write("Goal", 2.0);
  follower_.run_cycles(100);
  EXPECT_NEAR(follower_.output<double>("Position"), 2.0, 1e-9);
}

TEST_F(@Name@Test, BeginsWhereItIsTold) {
  follower_.set("Share", 0.0);
  ASSERT_TRUE(follower_.start()) << follower_.reason();
  ASSERT_TRUE(follower_.call("beginAt", 0.5));
  follower_.run_cycles();
  EXPECT_EQ(follower_.output<double>("Position"), 0.5);
}

TEST_F(@Name@Test, IsRealTime) {
  ASSERT_TRUE(follower_.start()) << follower_.reason();
  follower_.write("Goal", 2.0);
  const armature::testing::RealtimeGuard guard;
  follower_.run_cycles(10);
  EXPECT_EQ(guard.violations(), 0u) << guard.report();
}

}  // namespace
}  // namespace @name@
)";

constexpr std::string_view kDeployment = R"(# armature run --sim --for 1s @name@.yaml
application: @name@
libraries: [build/lib/armature/lib@name@.so]
components:
  Leader:   {model: @Name@, activity: {periodic: 10 ms}, properties: {Start: 90 deg}}
  Follower: {model: @Name@, activity: {periodic: 10 ms}, properties: {Share: 0.2}}
connections:
  - Leader.Position -> Follower.Goal
)";

constexpr std::string_view kReadme = R"(# @Name@

A component library for Armature. Build it and run its tests, then run the deployment:

```sh
cmake -S . -B build && cmake --build build && ctest --test-dir build
armature run --sim --for 1s @name@.yaml
```

If Armature is not installed in /usr or /usr/local, tell CMake where: `-DCMAKE_PREFIX_PATH=/opt/armature`.

| file | what it has |
| --- | --- |
| `@name@.hpp`, `@name@.cpp` | the component `@Name@`: a property, two ports, an operation |
| `@name@_test.cpp` | its test: the component alone, on a bench |
| `@name@.yaml` | a deployment of two of them; leave out `--sim` to run in real time |

`armature models --library-path build/lib/armature @Name@` describes the component, `armature graph @name@.yaml` draws the
deployment, `armature check @name@.yaml` finds mistakes in it.
)";

constexpr std::string_view kIgnore = "build/\n";

constexpr std::array<FileTemplate, 7> kTemplates = {{
    {"CMakeLists.txt", kBuild},
    {"@name@.hpp", kHeader},
    {"@name@.cpp", kSource},
    {"@name@_test.cpp", kTest},
    {"@name@.yaml", kDeployment},
    {"README.md", kReadme},
    {".gitignore", kIgnore},
}};

}  // namespace

std::span<const FileTemplate> component_templates() { return kTemplates; }

}  // namespace armature::cli
