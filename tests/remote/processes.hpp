// SPDX-License-Identifier: Apache-2.0
#pragma once

// For tests: applications as deployments have them, each with its part in the network, as if each
// were a process.

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/deploy/deployment.hpp"
#include "armature/platform/clock.hpp"
#include "armature/remote/interface_file.hpp"
#include "armature/remote/network.hpp"

namespace armature::remote::test {

using component::accepted;
using component::Component;
using component::Outcome;
using component::serve;
using component::State;
using std::chrono_literals::operator""s;

/// The one that lives in the other process.
class Axis final : public Component {
 public:
  using Component::Component;

 private:
  void on_update() override {
    position_.write(position_.last() + 1.0);
    if (static_cast<int>(position_.last()) % 10 == 0) tenth_.raise(int(position_.last()), 0.5);
    if (left_ > 0) travel_.report(1.0 - 0.1 * --left_);
  }
  double twice(double x) { return 2.0 * x; }
  void arm() { ++armed_; }
  int armed() { return armed_; }
  int fail(int) { throw std::runtime_error("it broke"); }
  Outcome begin_travel(double target) {
    if (target > 3.0) return component::refused("the target is outside the shaft");
    left_ = target > 2.0 ? 1'000'000 : 10;
    return accepted();
  }
  bool arrived() { return left_ == 0; }
  void halt() { left_ = 0; }
  void take(double wish) { taken_.write(wish); }

  component::OutputPort<double> position_{this, "Position", ""};
  component::OutputPort<double> taken_{this, "Taken", "what came to Wish"};
  component::InputPort<double> wish_{
      this, "Wish", "", "", component::on_data<&Axis::take>, component::may_stay_open};
  component::InputPort<double> closed_{this, "Closed", "", "", component::may_stay_open};
  component::Event<int, double> tenth_{this, "Tenth", ""};
  component::Operation<double(double)> twice_{this, "twice", serve<&Axis::twice>, ""};
  component::Operation<void()> arm_{this, "arm", serve<&Axis::arm>, "", component::by_operator};
  component::Operation<int()> get_armed_{this, "armed", serve<&Axis::armed>, ""};
  component::Operation<int(int)> fail_{this, "fail", serve<&Axis::fail>, ""};
  component::Command<double> travel_{this,
                                     "travel",
                                     serve<&Axis::begin_travel>,
                                     "",
                                     component::done_when<&Axis::arrived>,
                                     component::cancelled_by<&Axis::halt>};
  int left_ = 0;
  int armed_ = 0;
};

/// The one that uses it. Its members are looked at by the test, so they are atomic.
class User final : public Component {
 public:
  using Component::Component;

  std::atomic<double> position{0.0};
  std::atomic<int> tenths{0};
  std::atomic<int> lost{0};
  std::atomic<double> answer{0.0};
  std::atomic<component::CallStatus> status{component::CallStatus::kPending};
  std::atomic<double> target{0.0};  ///< a travel is begun once it is above 0
  std::atomic<bool> cancel{false};
  std::atomic<component::CommandStage> stage{component::CommandStage::kFree};
  std::atomic<double> progress{0.0};
  std::atomic<double> wish{0.0};
  std::atomic<int> updates{0};
  std::atomic<int> timeouts{0};

 private:
  void on_update() override {
    const auto result = twice_(4.0);
    status = result.status;
    if (result.status == component::CallStatus::kTimeout) ++timeouts;
    ++updates;
    answer = result.value;
    if (target > 0.0) travel_ = caller_.send(target.exchange(0.0));
    if (cancel.exchange(false)) travel_.cancel();
    stage = travel_.stage();
    progress = travel_.progress();
    if (wish != 0.0) wish_.write(wish);
  }
  void note(double value) { position = value; }
  void count(int, double) { ++tenths; }
  void count_loss() { ++lost; }

  component::InputPort<double> position_{this,
                                         "Position",
                                         "",
                                         "",
                                         component::on_data<&User::note>,
                                         component::on_lost(component::Reaction::kHold)};
  component::OutputPort<double> wish_{this, "Wish", ""};
  component::EventHandler<int, double> tenth_{this, "Tenth", serve<&User::count>, "",
                                              component::optional};
  component::EventHandler<> peer_lost_{this, "PeerLost", serve<&User::count_loss>, "",
                                       component::optional};
  component::OperationCaller<double(double)> twice_{this, "twice", "", component::optional};
  component::CommandCaller<double> caller_{this, "travel", "", component::optional};
  component::CommandHandle travel_{component::CallStatus::kNotConnected};
};

/// A process: its network and its application.
class Process {
 public:
  /// @param more  models that the test has beside those here
  explicit Process(const std::string& yaml,
                   const std::function<void(component::Registry&)>& more = {}) {
    NetworkOptions options;
    options.log = [this](const rt::LogRecord& record) { log += record.message() + "\n"; };
    network_ = make_network(options);
    deploy::DeploymentOptions how;
    how.models = [&more](component::Registry& models) {
      models.add<Axis>("Axis", "");
      models.add<User>("User", "");
      if (more) more(models);
    };
    how.make_placeholder = [this](const document::Component& written,
                                  std::unique_ptr<Component> prototype) {
      return network_->make_placeholder(written, std::move(prototype));
    };
    how.make_inlets = [this](const std::vector<component::InputPortBase*>& inputs) {
      return base::Result(network_->make_inlets(inputs));
    };
    how.read_interface = read_interface;
    deployment = deploy::parse_deployment(yaml, "test.yaml", how);
  }
  ~Process() {
    network_->leave();
    if (application != nullptr) application->stop();
    application.reset();
  }

  void start() {
    ASSERT_EQ(deployment.diagnostics.to_text(), "");
    exec::ApplicationOptions options = deployment.options;
    options.log = [this](const rt::LogRecord& record) { log += record.message() + "\n"; };
    application = std::make_unique<exec::Application>(std::move(deployment.blueprint), options);
    base::Diagnostics diagnostics;
    network_->open(deployment.document, {}, *application, diagnostics);
    ASSERT_EQ(diagnostics.to_text(), "");
    diagnostics.append(application->start());
    ASSERT_EQ(diagnostics.to_text(), "");
  }
  void serve() {
    network_->serve();
    application->drain_logs();
  }
  std::string address() const { return network_->addresses().front(); }
  template <typename T>
  T& find(std::string_view name) const {
    return dynamic_cast<T&>(*application->find(name));
  }

  deploy::Deployment deployment;
  std::string log;
  std::unique_ptr<Network> network_;
  std::unique_ptr<exec::Application> application;
};

inline std::string server(const std::string& listen = "tcp://127.0.0.1:0",
                          const std::string& more = {}) {
  return "network: {listen: '" + listen + "', policy: " + REMOTE_TESTDATA + "/all.policy" + more +
         "}\ncomponents: {Axis: {model: Axis, activity: {periodic: 2 ms}}}\n";
}

inline std::string client(const std::string& address, const std::string& more = {}) {
  return "components:\n  There: {model: Axis, remote: '" + address +
         "/Axis'}\n  User: {model: User, activity: {periodic: 5 ms}, peers: [There]}\n"
         "connections: [There.Position -> User.Position" +
         more + "]\n";
}

/// Serves until `condition`; the limit is for a test that would hang.
inline bool serve_until(const std::vector<Process*>& all, const std::function<bool()>& condition) {
  const base::Time end = platform::monotonic_now() + 30s;
  while (!condition()) {
    if (platform::monotonic_now() > end) return false;
    for (Process* const one : all) one->serve();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace armature::remote::test
