// SPDX-License-Identifier: Apache-2.0
#pragma once

// A robot as a deployment has it, in simulated time: what tests of its drives ask it and do to it.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "armature/component/interface.hpp"
#include "armature/deploy/deployment.hpp"

namespace armature::testing {

/// The application of a deployment with the components Arming, Generator and Joint1, Joint2, ...,
/// as those that ship. Keeps what it logged, and watches every joint while it runs. Positions in
/// the units of the joints (rad or m). Used by the thread of the test alone.
class DeployedRobot {
 public:
  using Joints = std::vector<double>;

  /// Starts nothing. A deployment with mistakes fails the test.
  explicit DeployedRobot(deploy::Deployment deployment) : deployment_(std::move(deployment)) {
    EXPECT_TRUE(deployment_.ok()) << deployment_.diagnostics.to_text();
    deployment_.options.simulated = true;
    deployment_.options.log = [this](const rt::LogRecord& record) {
      log += record.message() + "\n";
    };
    application_ =
        std::make_unique<exec::Application>(std::move(deployment_.blueprint), deployment_.options);
    while (application_->find(name_of(watched_.size() + 1)) != nullptr) watched_.emplace_back();
  }
  DeployedRobot(const DeployedRobot&) = delete;
  DeployedRobot& operator=(const DeployedRobot&) = delete;

  exec::Application& application() { return *application_; }

  /// Also again, after a stop. Answers what keeps it from running: nothing if it runs.
  std::string start() {
    const auto started = application_->start();
    return started.ok() ? "" : started.to_text();
  }
  void run_for(base::Duration duration) {
    for (base::Duration left = duration; left > base::Duration(0); left -= kLook) {
      application_->run_for(std::min(left, kLook));
      look();
    }
  }

  component::State state(const std::string& component) {
    return application_->find(component)->state();
  }
  std::string reason(const std::string& component) {
    return std::string(application_->find(component)->reason());
  }
  /// Who is out of service, and why; then the log.
  std::string reasons() {
    std::string all;
    for (const auto& entry : application_->blueprint().components) {
      const component::Component& each = *entry.component;
      if (each.state() == component::State::kRunning) continue;
      all += each.name() + ": " + std::string(each.reason()) + "\n";
    }
    return all + log;
  }
  template <typename T>
  T value(const std::string& component, const char* item) {
    const auto value = application_->value_of(component, item);
    EXPECT_TRUE(value) << value.error();
    return value ? *static_cast<const T*>(value.value().data()) : T{};
  }
  /// The operator lets it be driven.
  bool armed() { return value<bool>("Arming", "armed"); }
  /// @param joint  from 1
  double at(std::size_t joint) { return value<double>(name_of(joint), "Position"); }
  /// Of a joint, from where it was first seen.
  double farthest(std::size_t joint) const { return watched_.at(joint - 1).farthest; }
  /// Of a joint [rad/s or m/s], within kLook.
  double fastest(std::size_t joint) const { return watched_.at(joint - 1).fastest; }

  /// Answers why not: nothing if it was done.
  std::string call(const char* component, const char* operation,
                   std::vector<types::Value> arguments = {}) {
    const auto answer = application_->call(component, operation, std::move(arguments));
    return answer ? "" : answer.error();
  }
  /// Until it has ended, for ten seconds at most.
  component::CommandHandle run(const char* component, const char* command,
                               std::vector<types::Value> arguments = {}) {
    auto begun = application_->begin(component, command, std::move(arguments));
    if (!begun) ADD_FAILURE() << begun.error() << "\n" << reasons();
    for (int k = 0; k < 1000 && !begun.value().ended(); ++k) run_for(kLook);
    return std::move(begun).value();
  }
  component::CommandStage arm() { return run("Arming", "arm").stage(); }
  /// @param time  [s] of the motion; 0: as fast as its limits allow
  component::CommandStage move_to(const Joints& target, double time = 0.0) {
    return run("Generator", "moveTo", {types::Value::of(target), types::Value::of(time)}).stage();
  }
  /// Does not wait for its end. Answers why not: nothing if it was begun.
  std::string begin_motion_to(const Joints& target, double time = 0.0) {
    const auto begun = application_->begin("Generator", "moveTo",
                                           {types::Value::of(target), types::Value::of(time)});
    return begun ? "" : begun.error();
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
  /// What an operator does when a cause is gone: resets what faulted, starts what stopped. What
  /// others have to run for comes back in a later round.
  void reset_and_start_everything() {
    for (const auto& entry : application_->blueprint().components) {
      const std::string& name = entry.component->name();
      if (state(name) == component::State::kException) {
        static_cast<void>(application_->reset_component(name));
      }
      if (state(name) == component::State::kStopped) {
        static_cast<void>(application_->start_component(name));
      }
    }
  }

  std::string log;

 private:
  /// No shorter than a period, so that a step of a sampled position is no speed.
  static constexpr base::Duration kLook = std::chrono::milliseconds(10);

  struct Watched {
    double begin = 0.0;
    double last = 0.0;
    double farthest = 0.0;
    double fastest = 0.0;
  };

  static std::string name_of(std::size_t joint) { return "Joint" + std::to_string(joint); }
  void look() {
    const base::Duration passed = application_->now() - looked_;
    for (std::size_t i = 0; i < watched_.size(); ++i) {
      Watched& joint = watched_[i];
      const double position = at(i + 1);
      if (!has_looked_) joint.begin = joint.last = position;
      joint.farthest = std::max(joint.farthest, std::abs(position - joint.begin));
      if (passed < kLook) continue;
      const double speed =
          std::abs(position - joint.last) / std::chrono::duration<double>(passed).count();
      joint.fastest = std::max(joint.fastest, speed);
      joint.last = position;
    }
    has_looked_ = true;
    if (passed >= kLook) looked_ = application_->now();
  }

  deploy::Deployment deployment_;
  std::unique_ptr<exec::Application> application_;
  std::vector<Watched> watched_;
  base::Time looked_{};
  bool has_looked_ = false;
};

}  // namespace armature::testing
