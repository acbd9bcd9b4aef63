// SPDX-License-Identifier: Apache-2.0
#pragma once

// For tests: a small robot in simulated time, and a node that hosts its inspector.

#include <array>
#include <atomic>
#include <chrono>
#include <future>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/exec/application.hpp"
#include "armature/remote/inspector.hpp"
#include "armature/ride/node.hpp"
#include "inspection_client.hpp"

namespace armature::remote {

using namespace std::chrono_literals;

struct TestGains {
  double kp = 0.5;
  int steps = 1;
};
ARMATURE_STRUCT(TestGains, (kp, "V/rad", "proportional gain"), (steps, "", "in each cycle"));

/// Goes to a place, a unit in each cycle.
class TestAxis final : public component::Component {
 public:
  using Component::Component;

 private:
  component::Outcome begin_move(double target) {
    if (!(target >= 0.0)) return component::refused("the target is below the axis");
    target_ = target;
    return component::accepted();
  }
  component::Outcome begin_arm() {
    arm_.complete();
    return component::accepted();
  }
  component::Outcome begin_park() { return begin_move(1e6); }
  component::Reason held() {
    return loaded_() ? component::Reason("its load") : component::Reason();
  }
  bool arrived() { return position_ == target_; }
  void brake() { target_ = position_; }
  double sum(const std::vector<double>& values, double factor) {
    double total = 0.0;
    for (const double value : values) total += value;
    return factor * total;
  }
  void note(const std::string& text) { note_.assign(text); }
  void on_update() override {
    if (position_ != target_) position_ += position_ < target_ ? 1.0 : -1.0;
    port_.write(position_);
    both_.write({position_, -position_});
  }

  component::Property<double> gain_{this,
                                    "Gain",
                                    2.5,
                                    "of it all",
                                    "V",
                                    component::range(0.0, 10.0),
                                    component::changeable_while_running};
  component::Property<double> fixed_{this, "Fixed", 1.0, "for the whole run"};
  component::Property<TestGains> gains_{this, "Gains", {}, "a struct", ""};
  component::Attribute<std::string> note_{this, "Note", "", "what was noted"};
  component::OutputPort<double> port_{this, "Position", "where it is", "m"};
  component::OutputPort<std::array<double, 2>> both_{this, "Both", "there and back", "m"};
  component::OutputPort<double> silent_{this, "Silent", "nobody writes it"};
  component::Operation<double(const std::vector<double>&, double)> sum_{
      this,
      "sum",
      component::serve<&TestAxis::sum>,
      "adds them up",
      component::in_own_thread,
      component::args("values", "factor")};
  component::Operation<void(const std::string&)> note_it_{
      this, "note", component::serve<&TestAxis::note>, "notes it", component::in_own_thread};
  component::Command<double> move_{this,
                                   "moveTo",
                                   component::serve<&TestAxis::begin_move>,
                                   "goes there",
                                   component::args("target [m]"),
                                   component::done_when<&TestAxis::arrived>,
                                   component::cancelled_by<&TestAxis::brake>};
  component::Command<> arm_{this, "arm", component::serve<&TestAxis::begin_arm>, "lets it move",
                            component::by_operator};
  component::Property<bool> loaded_{this, "Loaded", false,
                                    "",   "",       component::changeable_while_running};
  component::Command<> park_{this,
                             "park",
                             component::serve<&TestAxis::begin_park>,
                             "goes where it may stop",
                             component::done_when<&TestAxis::arrived>,
                             component::cancelled_by<&TestAxis::brake>};
  component::Holding holding_{this, component::serve<&TestAxis::held>};

  double position_ = 0.0;
  double target_ = 0.0;
};

/// Two axes, a cycle each 10 ms. The thread of the test controls them.
class TestRobot {
 public:
  using Allows = std::function<bool(const ride::AccessQuestion&)>;

  explicit TestRobot(Allows allows = {}) {
    exec::Blueprint blueprint;
    blueprint.name = "bench";
    blueprint.add<TestAxis>("Axis", exec::Activity::periodic(10ms));
    blueprint.add<TestAxis>("left.Axis", exec::Activity::periodic(10ms));
    for (exec::ComponentEntry& entry : blueprint.components) entry.model = "TestAxis";
    exec::ApplicationOptions options;
    options.simulated = true;
    options.before_stop = {{"Axis", "park"}};
    options.attend = [this] { queue_.run(); };
    application_.emplace(std::move(blueprint), std::move(options));
    EXPECT_EQ(application_->start().to_text(), "");
    inspector_.emplace(*application_, queue_,
                       [this](const std::string& text) { told_ += text + "\n"; });
    ride::NodeOptions node_options;
    node_options.allows = std::move(allows);
    node_options.log = [this](const rt::LogRecord& record) {
      const std::lock_guard lock(mutex_);
      log_ += record.message() + "\n";
    };
    node_.emplace(node_options);
    EXPECT_TRUE(node_->add(Inspector::kName, inspector_->service()).ok());
    address_ = node_->listen("tcp://127.0.0.1:0").value().text();
  }
  ~TestRobot() {
    node_.reset();
    queue_.close();
  }

  exec::Application& application() { return *application_; }
  ControlQueue& queue() { return queue_; }
  ride::Node& node() { return *node_; }
  Inspector& inspector() { return *inspector_; }
  const std::string& address() const { return address_; }
  std::string log() {
    const std::lock_guard lock(mutex_);
    return log_;
  }
  /// What the inspector had to tell the operator.
  const std::string& told() const { return told_; }
  void pass(base::Duration time) { application_->run_for(time); }

  /// What `ask` brings, which waits for the robot; simulated time stands still.
  template <typename Ask>
  auto serve(Ask ask) {
    auto answer = std::async(std::launch::async, std::move(ask));
    while (answer.wait_for(100us) != std::future_status::ready) queue_.run();
    return answer.get();
  }

 private:
  ControlQueue queue_;
  std::optional<exec::Application> application_;
  std::optional<Inspector> inspector_;
  std::optional<ride::Node> node_;
  std::string address_;
  std::mutex mutex_;
  std::string log_;
  std::string told_;
};

}  // namespace armature::remote
