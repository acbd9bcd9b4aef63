// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "armature/deploy/deployment.hpp"
#include "robots/rover/simulated_rover.hpp"

namespace armature::rover {

/// A deployment of the rover in simulated time, from its files.
class Robot {
 public:
  /// @param how  components of other processes are used; none are by default
  explicit Robot(const std::string& file, std::vector<std::string> overrides = {},
                 deploy::DeploymentOptions how = {})
      : deployment_(load(file, std::move(overrides), std::move(how))) {
    EXPECT_TRUE(deployment_.ok()) << deployment_.diagnostics.to_text();
    deployment_.options.simulated = true;
    application_ =
        std::make_unique<exec::Application>(std::move(deployment_.blueprint), deployment_.options);
  }
  static deploy::Deployment load(const std::string& file, std::vector<std::string> overrides,
                                 deploy::DeploymentOptions options = {}) {
    options.library_folders = {LIBRARIES};
    options.document.overrides = std::move(overrides);
    return deploy::load_deployment(file, options);
  }

  exec::Application& application() { return *application_; }
  Plant& plant() { return static_cast<SimulatedRover*>(application_->find("Rover"))->plant(); }

  void start() {
    const auto started = application_->start();
    ASSERT_TRUE(started.ok()) << started.to_text();
    run_for(std::chrono::milliseconds(105));
  }
  void arm() {
    static_cast<void>(application_->call("Arming", "arm", {}));
    for (int k = 0; k < 100 && !value<bool>("Arming", "armed"); ++k) {
      run_for(std::chrono::milliseconds(10));
    }
    ASSERT_TRUE(value<bool>("Arming", "armed"));
  }
  void start_armed() {
    start();
    arm();
  }
  void run_for(base::Duration duration) { application_->run_for(duration); }
  /// A command; what it was refused with.
  std::string set_velocity(float left, float right) {
    const auto answer = application_->call("Chassis.Drive", "setVelocity",
                                           {types::Value::of(left), types::Value::of(right)});
    return answer ? "" : answer.error();
  }
  /// The same, renewed every 100 ms.
  void drive(float left, float right, base::Duration duration) {
    for (base::Duration past{}; past < duration; past += std::chrono::milliseconds(100)) {
      EXPECT_EQ(set_velocity(left, right), "");
      run_for(std::chrono::milliseconds(100));
    }
  }
  void set(const char* component, const char* property, types::Value value) {
    const auto done = application_->set_property(component, property, std::move(value));
    ASSERT_TRUE(done) << done.error();
  }
  template <typename T>
  T value(const char* component, const char* item) {
    const auto value = application_->value_of(component, item);
    EXPECT_TRUE(value) << value.error();
    return *static_cast<const T*>(value.value().data());
  }
  component::State state(const char* component) { return application_->find(component)->state(); }
  std::string reason(const char* component) {
    return std::string(application_->find(component)->reason());
  }
  std::string stop_reason() {
    return std::string(value<base::FixedText<127>>("Chassis.Drive", "stop_reason").view());
  }

  /// Of a wheel, really [m/s].
  double speed(std::size_t wheel) { return 0.05 * plant().wheel_velocity(wheel); }
  bool rests() {
    double fastest = 0.0;
    for (std::size_t i = 0; i < plant().wheels(); ++i) {
      fastest = std::max(fastest, std::abs(speed(i)));
    }
    return fastest < 0.01;
  }

 private:
  deploy::Deployment deployment_;
  std::unique_ptr<exec::Application> application_;
};

inline std::string by_script() { return ROVER "/deployments/by_script.yaml"; }

}  // namespace armature::rover
