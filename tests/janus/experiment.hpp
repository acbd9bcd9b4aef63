// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "armature/base/seconds.hpp"
#include "armature/control/error_metrics.hpp"
#include "armature/deploy/deployment.hpp"
#include "robots/janus/simulated_janus.hpp"

namespace armature::janus {

using Vector = std::vector<double>;

/// A motion of paper 1's experiment (table 2).
struct Motion {
  std::chrono::seconds at;
  Vector positions;
  double time;
};
inline const std::vector<Motion> kTable2 = {
    {std::chrono::seconds(5), {1.0, 1.0}, 10.0}, {std::chrono::seconds(17), {2.0, 2.0}, 9.0},
    {std::chrono::seconds(28), {3.0, 1.0}, 8.0}, {std::chrono::seconds(38), {1.0, 3.0}, 7.0},
    {std::chrono::seconds(47), {4.0, 4.0}, 5.0}, {std::chrono::seconds(54), {0.0, 0.0}, 5.0}};

/// A deployment of Janus in simulated time, from its files.
class Robot {
 public:
  using Adjust = std::function<void(exec::ApplicationOptions&)>;
  explicit Robot(const std::string& file, std::vector<std::string> overrides = {},
                 const Adjust& adjust = {})
      : deployment_(load(file, std::move(overrides))) {
    EXPECT_TRUE(deployment_.ok()) << deployment_.diagnostics.to_text();
    deployment_.options.simulated = true;
    if (adjust) adjust(deployment_.options);
    application_ =
        std::make_unique<exec::Application>(std::move(deployment_.blueprint), deployment_.options);
  }

  static deploy::Deployment load(const std::string& file, std::vector<std::string> overrides) {
    deploy::DeploymentOptions options;
    options.library_folders = {LIBRARIES};
    options.document.overrides = std::move(overrides);
    options.document.overrides.emplace_back("description=" JANUS "/janus.urdf");
    return deploy::load_deployment(std::string(JANUS "/deployments/") + file, options);
  }

  exec::Application& application() { return *application_; }
  const document::Document& document() const { return deployment_.document; }
  void start() {
    const auto started = application_->start();
    ASSERT_TRUE(started.ok()) << started.to_text();
  }
  void run_for(base::Duration duration) { application_->run_for(duration); }
  /// Where a sample was lost, the operator has looked.
  void confirm_positions() {
    for (const char* card : {"AIC1", "AIC2", "aic01", "aic02", "AIC1.Card", "AIC2.Card"}) {
      const bool known = application_->find(card) != nullptr;
      if (!known || value<bool>(card, "position_exact")) continue;
      ASSERT_TRUE(application_->set_property(card, "position_confirmed", types::Value::of(true)));
    }
  }
  /// Also waits until it is done.
  void arm() {
    confirm_positions();
    call("Arming", "arm");
    for (int k = 0; k < 300 && !value<bool>("Arming", "armed"); ++k) {
      run_for(std::chrono::milliseconds(10));
    }
    ASSERT_TRUE(value<bool>("Arming", "armed"));
  }
  void start_armed() {
    start();
    run_for(std::chrono::milliseconds(105));
    arm();
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
  component::State state(const char* component) { return application_->find(component)->state(); }
  std::string reason(const char* component) {
    return std::string(application_->find(component)->reason());
  }

 private:
  deploy::Deployment deployment_;
  std::unique_ptr<exec::Application> application_;
};

/// What came out of a run of the experiment.
struct Figures {
  std::array<control::ErrorMetrics::Figures, kJoints> joints;
  /// The largest error from two seconds after a motion to the next [rad].
  std::array<double, kJoints> at_rest{};
};

/// 60 s with the motions of table 2. The error of a sample is what the controllers saw: desired
/// minus measured position, Ref - Sen.
inline Figures run_experiment(Robot& robot) {
  using namespace std::chrono_literals;
  constexpr base::Duration kPeriod = 10ms;
  auto metrics = control::ErrorMetrics::make({.joints = kJoints, .period = kPeriod}).value();
  Figures figures;
  const bool of_table = robot.application().find("pid1") != nullptr;  // paper 1 writes them small
  const char* const pids[] = {of_table ? "pid1" : "PID1", of_table ? "pid2" : "PID2"};
  robot.start_armed();
  const base::Time begin = robot.application().now();
  std::size_t next = 0;
  base::Time rest_from = base::Time::max();
  for (base::Time now = begin; now < begin + 60s; now = robot.application().now()) {
    if (next < kTable2.size() && now >= begin + kTable2[next].at) {
      const Motion& motion = kTable2[next++];
      EXPECT_EQ(robot.move_to(motion.positions, motion.time), "");
      rest_from = now + base::from_seconds(motion.time + 2.0);
    }
    robot.run_for(kPeriod);
    const std::array<double, kJoints> errors{
        robot.value<double>(pids[0], "Ref") - robot.value<double>(pids[0], "Sen"),
        robot.value<double>(pids[1], "Ref") - robot.value<double>(pids[1], "Sen")};
    metrics.step(errors);
    const bool resting =
        now > rest_from && (next == kTable2.size() || now < begin + kTable2[next].at);
    for (std::size_t i = 0; resting && i < kJoints; ++i) {
      figures.at_rest[i] = std::max(figures.at_rest[i], std::abs(errors[i]));
    }
  }
  for (std::size_t i = 0; i < kJoints; ++i) figures.joints[i] = metrics.of(i);
  return figures;
}

}  // namespace armature::janus
