// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "armature/deploy/deployment.hpp"
#include "robots/wam/wam_hardware.hpp"

namespace armature::wam {

using Vector = std::vector<double>;

/// A deployment of the arm from its file, on the emulated arm, in simulated time.
class Arm {
 public:
  static constexpr base::Duration kPeriod = std::chrono::milliseconds(2);

  using Adjust = std::function<void(exec::ApplicationOptions&)>;
  explicit Arm(const std::string& file, std::vector<std::string> overrides = {},
               const Adjust& adjust = {}) {
    deploy::DeploymentOptions options;
    options.library_folders = {LIBRARIES};
    options.document.overrides = std::move(overrides);
    deployment_ = deploy::load_deployment(std::string(WAM "/deployments/") + file, options);
    EXPECT_TRUE(deployment_.ok()) << deployment_.diagnostics.to_text();
    deployment_.options.simulated = true;
    deployment_.options.log = [this](const rt::LogRecord& record) {
      log += record.message() + "\n";
    };
    if (adjust) adjust(deployment_.options);
    application_ =
        std::make_unique<exec::Application>(std::move(deployment_.blueprint), deployment_.options);
  }

  exec::Application& application() { return *application_; }
  WamHardware& hardware() { return static_cast<WamHardware&>(*application_->find("WAM")); }
  Emulator& emulator() { return hardware().emulated()->emulator(); }
  const ArmSimulation& simulated() { return hardware().emulated()->motors().arm(); }
  std::size_t joints() { return hardware().torque_path().joints(); }

  /// Starts; one cycle in each period from then on.
  void start() {
    const auto started = application_->start();
    ASSERT_TRUE(started.ok()) << started.to_text();
    run_for(std::chrono::milliseconds(1));
  }
  void start_active() {
    start();
    run_for(std::chrono::milliseconds(300));
    ASSERT_EQ(safety_state(), "ACTIVATED");
  }
  void start_armed() {
    start_active();
    arm();
  }
  void arm() {
    ASSERT_EQ(call("Arming", "arm"), "");
    run_for(std::chrono::milliseconds(20));
    ASSERT_TRUE(armed());
  }
  void run_for(base::Duration duration) { application_->run_for(duration); }
  void cycle() { run_for(kPeriod); }

  bool armed() { return value<bool>("Arming", "armed"); }
  std::string safety_state() { return text("safety_state"); }
  std::string waits_for() { return text("waits_for"); }
  std::string call(const char* component, const char* operation,
                   std::vector<types::Value> arguments = {}) {
    const auto answer = application_->call(component, operation, std::move(arguments));
    return answer ? "" : answer.error();
  }
  std::string move_to(const Vector& positions, double time) {
    return call("Generator", "moveTo", {types::Value::of(positions), types::Value::of(time)});
  }
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
  component::State state(const char* component) { return application_->find(component)->state(); }
  std::string reason(const char* component) {
    return std::string(application_->find(component)->reason());
  }

  /// Where the joints really are [rad].
  Vector positions() {
    Vector all;
    for (std::size_t i = 0; i < joints(); ++i) all.push_back(simulated().joint_position(i));
    return all;
  }
  Vector desired() { return value<Vector>("Generator", "nAxesDesiredPosition"); }
  /// What each puck drives its motor with [Nm].
  Vector motor_torques() {
    Vector all;
    for (std::size_t i = 0; i < joints(); ++i) {
      const double units = emulator().puck(i).properties().get(Property::kIpnm);
      const bool drives = emulator().puck(i).mode() == PuckMode::kTorque;
      all.push_back(drives ? emulator().puck(i).torque() / units : 0.0);
    }
    return all;
  }
  bool pucks_are_idle() {
    for (std::size_t i = 0; i < joints(); ++i) {
      if (emulator().puck(i).mode() != PuckMode::kIdle) return false;
    }
    return true;
  }
  /// Time passes for the emulator alone: nobody asks it for anything any more.
  void let_emulator_run(base::Duration time) { emulator().advance_to(emulator().now() + time); }

  std::string log;

 private:
  std::string text(const char* attribute) {
    return std::string(value<component::Reason>("WAM", attribute).view());
  }

  deploy::Deployment deployment_;
  std::unique_ptr<exec::Application> application_;
};

inline double largest_apart(const Vector& left, const Vector& right) {
  double most = 0.0;
  for (std::size_t i = 0; i < left.size(); ++i) most = std::max(most, std::abs(left[i] - right[i]));
  return most;
}

}  // namespace armature::wam
