// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "armature/deploy/internal/component_templates.hpp"

namespace armature::deploy::internal {
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
  target_link_libraries(@name@_test PRIVATE armature::exec GTest::gtest_main)
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
  position_ = 0.0;
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

#include <chrono>
#include <optional>
#include <utility>

#include <gtest/gtest.h>

#include "armature/exec/application.hpp"

namespace @name@ {
namespace {

using namespace std::chrono_literals;
using armature::exec::Activity;
using armature::types::Value;

/// What the tests put in.
class Source final : public Component {
 public:
  using Component::Component;
  double value = 0.0;

 private:
  void on_update() override { output_.write(value); }
  OutputPort<double> output_{this, "Value", "as the test says", "rad"};
};

/// A @Name@ behind a source, in simulated time.
class @Name@Test : public ::testing::Test {
 protected:
  void start(double share, double goal) {
    armature::exec::Blueprint blueprint;
    blueprint.add<Source>("Source", Activity::periodic(10ms)).value = goal;
    blueprint.add<@Name@>("Followed", Activity::periodic(10ms));
    blueprint.connect("Source.Value", "Followed.Goal");
    armature::exec::ApplicationOptions options;
    options.simulated = true;
    application_.emplace(std::move(blueprint), std::move(options));
    const auto diagnostics = application_->start();
    ASSERT_TRUE(diagnostics.ok()) << diagnostics.to_text();
    ASSERT_TRUE(application_->set_property("Followed", "Share", Value::of(share)).ok());
  }

  double position() {
    const auto value = application_->value_of("Followed", "Position");
    return value.ok() ? *value.value().get_if<double>() : -1.0;
  }

  std::optional<armature::exec::Application> application_;
};

TEST_F(@Name@Test, ReachesItsGoal) {
  start(0.5, 2.0);
  application_->run_for(1s);
  EXPECT_NEAR(position(), 2.0, 1e-9);
}

TEST_F(@Name@Test, StaysWithAShareOfZero) {
  start(0.0, 2.0);
  application_->run_for(1s);
  EXPECT_EQ(position(), 0.0);
}

TEST_F(@Name@Test, BeginsWhereItIsTold) {
  start(0.0, 2.0);
  const auto result = application_->call("Followed", "beginAt", {Value::of(0.5)});
  ASSERT_TRUE(result.ok()) << result.error();
  application_->run_for(100ms);
  EXPECT_EQ(position(), 0.5);
}

}  // namespace
}  // namespace @name@
)";

constexpr std::string_view kDeployment = R"(# armature run --sim --for 1s @name@.yaml
application: @name@
libraries: [build/lib/armature/lib@name@.so]
components:
  Leader:   {model: @Name@, activity: {periodic: 10 ms}}
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
| `@name@_test.cpp` | its test, in simulated time |
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

}  // namespace armature::deploy::internal
