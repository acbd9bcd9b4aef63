// SPDX-License-Identifier: Apache-2.0
// A deployment of the arm on the emulated arm, for what breaks in it.
#pragma once

#include <algorithm>
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

#include "armature/component/interface.hpp"
#include "armature/deploy/deployment.hpp"
#include "robots/wam/emulator/emulator_command.hpp"
#include "robots/wam/wam_hardware.hpp"

namespace armature::wam {

using Vector = std::vector<double>;

inline double largest_apart(const Vector& left, const Vector& right) {
  double most = 0.0;
  for (std::size_t i = 0; i < left.size(); ++i) most = std::max(most, std::abs(left[i] - right[i]));
  return most;
}

/// The application in simulated time, and the arm for which time passes also when nobody asks it
/// for anything any more.
class CampaignArm {
 public:
  static constexpr base::Duration kPeriod = std::chrono::milliseconds(2);
  using WriteBlackBox = std::function<std::string(const exec::BlackBoxReport&)>;

  CampaignArm(const std::string& file, WriteBlackBox write_black_box) {
    deploy::DeploymentOptions options;
    options.library_folders = {LIBRARIES};
    deployment_ = deploy::load_deployment(std::string(WAM "/deployments/") + file, options);
    EXPECT_TRUE(deployment_.ok()) << deployment_.diagnostics.to_text();
    deployment_.options.simulated = true;
    deployment_.options.black_box.write = std::move(write_black_box);
    deployment_.options.log = [this](const rt::LogRecord& record) {
      log += record.message() + "\n";
    };
    application_ =
        std::make_unique<exec::Application>(std::move(deployment_.blueprint), deployment_.options);
  }

  exec::Application& application() { return *application_; }
  WamHardware& hardware() { return static_cast<WamHardware&>(*application_->find("WAM")); }
  EmulatedLink& link() { return *hardware().emulated(); }
  Emulator& emulator() { return link().emulator(); }
  SafetyBoard& board() { return emulator().board(); }
  const ArmSimulation& simulated() { return link().motors().arm(); }
  std::size_t joints() { return emulator().motors(); }

  /// Up to an arm that is active and holds itself; from then on nobody presses keys but the test.
  void start_active() {
    const auto started = application_->start();
    ASSERT_TRUE(started.ok()) << started.to_text();
    application_->run_for(std::chrono::milliseconds(1));  // one cycle in each period from then on
    for (int i = 0; i < 500 && !holds(); ++i) cycle();
    ASSERT_TRUE(holds()) << log;
    ASSERT_EQ(safety_state(), "ACTIVATED");
    set("WAM", "emulated_operator", false);
  }
  void arm() {
    ASSERT_EQ(call("Arming", "arm"), "");
    for (int i = 0; i < 50 && !armed(); ++i) cycle();
    ASSERT_TRUE(armed()) << log;
  }
  /// One period of the application, and as much for the arm.
  void cycle() {
    const base::Time before = emulator().now();
    application_->run_for(kPeriod);
    if (emulator().now() == before) emulator().advance_to(before + kPeriod);
  }

  /// The operator lets it be driven; of the arm, `passes_torques` is what is so.
  bool armed() { return value<bool>("Arming", "armed"); }
  bool passes_torques() { return hardware().torque_path().mode() == TorquePath::Mode::kDriven; }
  bool holds() { return hardware().torque_path().mode() == TorquePath::Mode::kHolding; }
  std::string safety_state() { return text("safety_state"); }
  std::string waits_for() { return text("waits_for"); }
  component::State state(const std::string& component) {
    return application_->find(component)->state();
  }
  std::string reason(const std::string& component) {
    return std::string(application_->find(component)->reason());
  }

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
    ASSERT_TRUE(set) << set.error();
  }

  /// Has `component` write something that its code would not.
  template <typename T>
  void write(const std::string& component, std::string_view port, const T& value) {
    component::Component& writer = *application_->find(component);
    for (component::OutputPortBase* output : component::interface_of(writer).outputs) {
      if (output->name() != port) continue;
      ASSERT_TRUE(application_->run_in_thread_of(writer, [&] { output->write_from(&value); }));
      return;
    }
    FAIL() << component << " has no output " << port;
  }

  /// A command of the emulator, in which N stands for the puck.
  void tell_emulator(std::string command, int puck) {
    if (const auto n = command.find('N'); n != std::string::npos) {
      command.replace(n, 1, std::to_string(puck));
    }
    const auto parsed = parse_emulator_command(command, joints());
    ASSERT_TRUE(parsed) << parsed.error();
    parsed.value().apply({emulator(), link().motors(), numbers()});
  }
  const ArmNumbers& numbers() { return joints() == 4 ? wam4() : wam7(); }

  /// Where the joints really are [rad].
  Vector positions() {
    Vector all;
    for (std::size_t i = 0; i < joints(); ++i) all.push_back(simulated().joint_position(i));
    return all;
  }
  Vector believed() {
    Vector all = value<Vector>("Sensor", "sensor");
    all.resize(joints());
    return all;
  }
  bool any_puck_drives() {
    for (std::size_t i = 0; i < joints(); ++i) {
      const Puck& puck = emulator().puck(i);
      if (puck.state() == PuckState::kReady && puck.mode() != PuckMode::kIdle) return true;
    }
    return false;
  }

  std::string log;

 private:
  std::string text(const char* attribute) {
    return std::string(value<component::Reason>("WAM", attribute).view());
  }

  deploy::Deployment deployment_;
  std::unique_ptr<exec::Application> application_;
};

}  // namespace armature::wam
