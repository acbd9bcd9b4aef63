// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "armature/deploy/deployment.hpp"
#include "tests/wam/bench_arm.hpp"

namespace armature::wam {

using Vector = std::vector<double>;

/// One of the arm's controllers, from its deployment, on the simulated arm in simulated time.
class Robot {
 public:
  struct Config {
    int joints = 7;
    std::string controller;  ///< npid, computed_torque or gravity_pd
    std::vector<std::string> overrides{};
  };
  static constexpr base::Duration kPeriod = std::chrono::milliseconds(2);

  explicit Robot(const Config& config) : joints_(static_cast<std::size_t>(config.joints)) {
    deploy::DeploymentOptions options;
    options.library_folders = {LIBRARIES};
    options.document.overrides = config.overrides;
    options.models = [](component::Registry& models) {
      models.add<BenchArm>("BenchArm", "the simulated arm");
      models.add<BenchActuator>("BenchActuator", "its motors");
    };
    deployment_ =
        deploy::parse_deployment(text_for(config), WAM "/deployments/control/bench.yaml", options);
    EXPECT_TRUE(deployment_.ok()) << deployment_.diagnostics.to_text();
    deployment_.options.simulated = true;
    application_ =
        std::make_unique<exec::Application>(std::move(deployment_.blueprint), deployment_.options);
    if (!deployment_.ok()) return;
    const auto started = application_->start();
    EXPECT_TRUE(started.ok()) << started.to_text();
    application_->run_for(std::chrono::milliseconds(1));  // from here on, one cycle in each run
  }

  exec::Application& application() { return *application_; }
  BenchArm& bench() { return static_cast<BenchArm&>(*application_->find("Sensor")); }
  std::size_t joints() const { return joints_; }

  template <typename T>
  T value(const char* component, const char* item) {
    const auto value = application_->value_of(component, item);
    EXPECT_TRUE(value) << value.error();
    return *static_cast<const T*>(value.value().data());
  }
  template <typename T>
  void set(const char* component, const char* property, const T& value) {
    const auto set = application_->set_property(component, property, types::Value::of(value));
    EXPECT_TRUE(set) << set.error();
  }
  base::Result<void> call(const char* component, const char* operation) {
    const auto answer = application_->call(component, operation, {});
    if (!answer) return base::Error{answer.error()};
    return {};
  }
  Vector positions() {
    Vector all;
    for (std::size_t i = 0; i < joints_; ++i) all.push_back(bench().arm().joint_position(i));
    return all;
  }
  void cycle() { application_->run_for(kPeriod); }

 private:
  static std::string text_for(const Config& config) {
    const std::string joints = std::to_string(config.joints);
    const bool compensates = config.controller == "npid";
    return "application: wam-on-the-bench\ninclude: " + config.controller + joints + ".yaml\n" +
           "components:\n  Sensor: {model: BenchArm, peers: [Sampler], properties: {joints: " +
           joints + ", robot_description: \"${description}\", compensates_gravity: " +
           (compensates ? "true" : "false") +
           "}}\n  Actuator: {model: BenchActuator, peers: [Sampler], properties: {joints: " +
           joints + "}}\nconnections:\n  - Actuator.torque -> Sensor.torque\n";
  }

  std::size_t joints_;
  deploy::Deployment deployment_;
  std::unique_ptr<exec::Application> application_;
};

}  // namespace armature::wam
