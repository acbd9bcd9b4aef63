// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/ride/node.hpp"
#include "armature/studio/server.hpp"
#include "inspection_client.hpp"
#include "workbench_client.hpp"

namespace armature::studio {

inline constexpr ride::CallOptions kPatient{std::chrono::seconds(60), {}};

/// The number of an operation.
inline ride::Number number_named(const ride::Interface& interface, std::string_view name) {
  const std::string searched = " " + std::string(name) + "(";
  for (const ride::Declaration& one : interface.declarations) {
    if (one.canonical.find(searched) != std::string_view::npos) return one.number();
  }
  ADD_FAILURE() << "no operation " << name;
  return 0;
}

/// Asks a component of the studio without waiting, and whatever it likes.
class RawPlaceholder final : public ride::Placeholder {
 public:
  using Placeholder::ask;
  using Placeholder::Placeholder;
};

/// A browser, as far as the studio sees one.
class Browser {
 public:
  explicit Browser(const std::string& address)
      : peer_(node_.connect(address)), workbench(peer_, "workbench"), run(peer_, "run") {
    EXPECT_TRUE(peer_.wait_until_connected(std::chrono::seconds(10)));
  }

  ride::Peer& peer() { return peer_; }

  /// Until the studio says that it was so long.
  void hold_key(double seconds) {
    for (double held = 0.0; held < seconds;) {
      const auto answer = workbench.hold_key(true, kPatient);
      ASSERT_TRUE(answer) << answer.error();
      held = answer.value();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
  void let_go() { EXPECT_TRUE(workbench.hold_key(false, kPatient)); }
  /// Why it is refused; empty: it is begun.
  std::string begin(const std::string& component, const std::string& command,
                    const std::vector<std::string>& words = {}) {
    const auto begun = run.begin(component, command, words, kPatient);
    return begun ? begun.value().reason : begun.error();
  }
  std::string arm() { return begin("Arming", "arm"); }
  bool keep_jogging(const std::string& axis, const std::string& velocity) {
    const auto kept = run.call("Generator", "keepJogging", {axis, velocity}, kPatient);
    return kept && kept.value().value == "true";
  }
  /// [s] of the application's clock.
  double time() {
    const auto status = run.application(kPatient);
    return status ? status.value().time : NAN;
  }

 private:
  ride::Node node_;
  ride::Peer& peer_;

 public:
  WorkbenchPlaceholder workbench;
  remote::InspectorPlaceholder run;
};

/// What was recorded in a cycle of the head.
struct Moment {
  double time = 0.0;
  std::vector<double> measured;  ///< position of each joint
  std::vector<double> velocity;  ///< that is desired
};

/// The simulated head in a studio. What it did is what its Reporter has written.
class OperatedHead : public ::testing::Test {
 protected:
  OperatedHead() {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ / "page");
    std::filesystem::copy(JANUS, folder_ / "janus", std::filesystem::copy_options::recursive);
    std::ofstream(folder_ / "page/index.html") << "<!doctype html>";
  }
  ~OperatedHead() override {
    if (server_) stop();
    close();
    std::filesystem::remove_all(folder_);
  }

  /// @param grants  of the deployment: `grants: {remote: [Arming.arm]}`
  void open(const std::string& grants = "grants: {remote: [Arming.arm]}\n") {
    std::ofstream(file())
        << "include: ../deployments/pid.yaml\napplication: head\n"
           "libraries: [record]\n"
        << grants
        << "components:\n"
           "  Reporter:\n"
           "    model: Reporter\n"
           "    activity: {periodic: 50 ms, scheduler: other}\n"
           "    properties:\n"
           "      what: [BridgeRef.nAxesSensorPosition, Generator.nAxesDesiredVelocity]\n"
           "      csv: "
        << recording() << "\n";
    ServerOptions options;
    options.file = file();
    options.listen = address();
    options.pages = (folder_ / "page").string();
    options.folder = (folder_ / "left").string();
    options.policy = policy_;
    options.program = PROGRAM;
    options.arguments = {"--library-path", LIBRARIES};
    options.log = [](const rt::LogRecord&) {};
    base::Diagnostics diagnostics;
    server_ = Server::make(options, diagnostics);
    ASSERT_EQ(diagnostics.to_text(), "");
    serve();
  }
  void serve() {
    open_ = true;
    thread_ = std::thread([this] {
      while (open_) server_->serve(std::chrono::milliseconds(10));
    });
  }
  /// The desk is busy with something else.
  void busy() {
    open_ = false;
    if (thread_.joinable()) thread_.join();
  }
  void close() {
    busy();
    server_.reset();
  }

  std::string file() const { return (folder_ / "janus/demo/head.yaml").string(); }
  std::string recording() const { return (folder_ / "head.csv").string(); }
  std::string address() const { return "unix:" + (folder_ / "s").string(); }

  void until(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!condition()) {
      ASSERT_LT(std::chrono::steady_clock::now(), end);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }
  std::string state(Browser& browser) { return browser.workbench.run(kPatient).value().state; }
  void start(Browser& browser, double pace = 1.0) {
    const auto started = browser.workbench.start({true, pace, "", {}}, kPatient);
    ASSERT_TRUE(started) << started.error();
    until([&] { return state(browser) == "running" && !std::isnan(browser.time()); });
    pass(browser, 0.3);
  }
  /// Of the application's clock [s].
  void pass(Browser& browser, double seconds) {
    const double end = browser.time() + seconds;
    until([&] { return !(browser.time() < end); });
  }
  void arm(Browser& browser) {
    ASSERT_TRUE(browser.workbench.take_seat(kPatient));
    browser.hold_key(1.0);
    ASSERT_EQ(browser.arm(), "");
    browser.let_go();
    until([&] {
      return browser.run.call("Arming", "isArmed", {}, kPatient).value().value == "true";
    });
  }
  void stop() {
    if (!thread_.joinable()) serve();
    Browser last(address());
    [[maybe_unused]] const auto stopped = last.workbench.stop(kPatient);
    until([&] { return state(last) == "ended" || state(last) == "none"; });
  }

  /// Ends the run.
  /// @return what was recorded
  std::vector<Moment> recorded() {
    stop();
    std::vector<Moment> moments;
    std::ifstream csv(recording());
    std::string line;
    while (std::getline(csv, line)) {
      if (line.empty() || line[0] == '#' || line.starts_with("time_s")) continue;
      Moment moment;
      std::istringstream cells(line);
      std::vector<double> numbers;
      for (std::string cell; std::getline(cells, cell, ',');) numbers.push_back(std::stod(cell));
      EXPECT_EQ(numbers.size(), 5u) << line;
      if (numbers.size() < 5) break;
      moments.push_back({numbers[0], {numbers[1], numbers[2]}, {numbers[3], numbers[4]}});
    }
    EXPECT_GT(moments.size(), 10u);
    return moments;
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(::testing::TempDir()) / "studio_operated_test";
  std::string policy_;
  std::unique_ptr<Server> server_;
  std::atomic<bool> open_{false};
  std::thread thread_;
};

/// How far a joint is from where it was at first, at most, between two times.
inline double moved(const std::vector<Moment>& moments, double from, double to) {
  std::optional<std::vector<double>> there;
  double most = 0.0;
  for (const Moment& one : moments) {
    if (one.time < from || one.time > to || std::isnan(one.measured[0])) continue;
    if (!there) there = one.measured;
    for (std::size_t i = 0; i < 2; ++i)
      most = std::max(most, std::abs(one.measured[i] - (*there)[i]));
  }
  return most;
}

/// The last time at which a motion was desired; 0: never.
inline double last_motion(const std::vector<Moment>& moments) {
  double last = 0.0;
  for (const Moment& one : moments) {
    for (const double velocity : one.velocity) {
      if (std::abs(velocity) > 1e-9) last = one.time;
    }
  }
  return last;
}

}  // namespace armature::studio
