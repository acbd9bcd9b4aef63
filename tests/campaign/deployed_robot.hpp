// SPDX-License-Identifier: Apache-2.0
// A deployment in simulated time, for campaigns of what breaks in it.
#pragma once

#include <algorithm>
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

namespace armature::campaign {

using Vector = std::vector<double>;

inline double largest_apart(const Vector& left, const Vector& right) {
  double most = 0.0;
  for (std::size_t i = 0; i < left.size(); ++i) most = std::max(most, std::abs(left[i] - right[i]));
  return most;
}

/// The application, and what tests ask it and do to it.
class DeployedRobot {
 public:
  using WriteBlackBox = std::function<std::string(const exec::BlackBoxReport&)>;

  DeployedRobot(const std::string& file, std::vector<std::string> overrides,
                WriteBlackBox write_black_box) {
    deploy::DeploymentOptions options;
    options.library_folders = {LIBRARIES};
    options.document.overrides = std::move(overrides);
    deployment_ = deploy::load_deployment(file, options);
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
  component::State state(const std::string& component) {
    return application_->find(component)->state();
  }
  std::string reason(const std::string& component) {
    return std::string(application_->find(component)->reason());
  }
  /// The operator lets it be driven.
  bool armed() { return value<bool>("Arming", "armed"); }

  std::string call(const char* component, const char* operation,
                   std::vector<types::Value> arguments = {}) {
    const auto answer = application_->call(component, operation, std::move(arguments));
    return answer ? "" : answer.error();
  }
  std::string move_to(const Vector& positions, double time) {
    target_ = positions;
    return call("Generator", "moveTo", {types::Value::of(positions), types::Value::of(time)});
  }
  /// Of the last motion.
  const Vector& target() const { return target_; }
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

  /// What an operator does when a cause is gone: resets what faulted, starts what stopped.
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
  Vector target_;
  deploy::Deployment deployment_;
  std::unique_ptr<exec::Application> application_;
};

}  // namespace armature::campaign
