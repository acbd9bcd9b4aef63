// SPDX-License-Identifier: Apache-2.0
// The server behind `armature studio`, asked as a page asks it, with the program's own checks and
// runs.
#include "armature/studio/server.hpp"

#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/platform/child_process.hpp"
#include "armature/ride/node.hpp"
#include "inspection_client.hpp"
#include "workbench_client.hpp"

namespace armature::studio {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kFlatOut = std::numeric_limits<double>::infinity();
constexpr ride::CallOptions kPatient{60s, {}};

constexpr const char* kDeployment =
    "application: bar\n"
    "libraries: [wave]\n"
    "components:\n"
    "  Source: {model: Source, activity: {periodic: 10 ms}}\n";

/// A folder with a deployment, a studio that has it open, and somebody who uses it.
class Opened : public ::testing::Test {
 protected:
  Opened() {
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "page");
    std::ofstream(folder_ / "page/index.html") << "<!doctype html>";
    std::ofstream(file()) << kDeployment;
    open();
  }
  ~Opened() override {
    if (workbench_) {
      [[maybe_unused]] const auto stopped = workbench_->stop(kPatient);
      until_over();
    }
    close();
    fs::remove_all(folder_);
  }

  std::string file() const { return (folder_ / "bar.yaml").string(); }
  std::string on_disk() const {
    std::ostringstream text;
    text << std::ifstream(file()).rdbuf();
    return text.str();
  }

  void open(const std::string& policy = {}) {
    ServerOptions options;
    options.file = file();
    options.listen = "unix:" + (folder_ / "s").string();
    options.pages = (folder_ / "page").string();
    options.policy = policy;
    options.folder = (folder_ / "left").string();
    options.program = PROGRAM;
    options.arguments = {"--library-path", WAVE_LIBRARY};
    options.log = [](const rt::LogRecord&) {};
    base::Diagnostics diagnostics;
    server_ = Server::make(options, diagnostics);
    ASSERT_EQ(diagnostics.to_text(), "");
    open_ = true;
    thread_ = std::thread([this] {
      while (open_) server_->serve(10ms);
    });
    user_.emplace();
    ride::Peer& peer = user_->connect(options.listen);
    ASSERT_TRUE(peer.wait_until_connected(10s));
    workbench_.emplace(peer, "workbench");
    run_.emplace(peer, "run");
  }
  void close() {
    run_.reset();
    workbench_.reset();
    user_.reset();
    open_ = false;
    if (thread_.joinable()) thread_.join();
    server_.reset();
  }

  Outcome edit(const std::string& name, std::vector<std::string> words) {
    return workbench_->edit({{{name, std::move(words)}}, {}, false}, kPatient).value();
  }
  /// What the check finds in the texts as they are now.
  std::string findings() {
    while (true) {
      const ProjectState state = workbench_->project(kPatient).value();
      if (state.checked == state.version) return workbench_->check(kPatient).value();
      std::this_thread::sleep_for(5ms);
    }
  }
  void until(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + 60s;
    while (!condition()) {
      ASSERT_LT(std::chrono::steady_clock::now(), end) << log();
      std::this_thread::sleep_for(5ms);
    }
  }
  std::string state() { return workbench_->run(kPatient).value().state; }
  void until_over() {
    until([&] { return state() == "ended" || state() == "none"; });
  }
  std::string log() {
    std::string text;
    const auto lines = workbench_->log(0, kPatient);
    for (const std::string& line : lines ? lines.value() : std::vector<std::string>{}) {
      text += line + '\n';
    }
    return text;
  }
  void start(double pace = 1.0) {
    const auto started = workbench_->start({true, pace, "", {}}, kPatient);
    ASSERT_TRUE(started) << started.error();
    until([&] { return state() == "running"; });
  }

  const fs::path folder_ = fs::path(::testing::TempDir()) / "studio_server_test";
  std::unique_ptr<Server> server_;
  std::atomic<bool> open_{false};
  std::thread thread_;
  std::optional<ride::Node> user_;
  std::optional<WorkbenchPlaceholder> workbench_;
  std::optional<remote::InspectorPlaceholder> run_;
};

TEST_F(Opened, AnApplicationIsAssembledCheckedSavedAndRun) {
  EXPECT_THAT(findings(), HasSubstr(R"("ok":true)"));
  EXPECT_TRUE(edit("add", {"Filter", "LowPass"}).done);
  EXPECT_THAT(findings(), HasSubstr("LowPass"));
  const auto fitting = workbench_->fitting("Source", "Position", kPatient);
  ASSERT_TRUE(fitting) << fitting.error();
  EXPECT_THAT(fitting.value(), HasSubstr(R"("component":"Filter")"));
  EXPECT_TRUE(edit("connect", {"Source.Position", "Filter.Raw"}).done);
  EXPECT_THAT(findings(), HasSubstr(R"("ok":true)"));
  EXPECT_FALSE(workbench_->start({true, kFlatOut, "", {}}, kPatient)) << "it is not saved";
  EXPECT_EQ(on_disk(), kDeployment);
  EXPECT_TRUE(workbench_->save(kPatient).value().done);
  EXPECT_THAT(on_disk(), HasSubstr("Source.Position -> Filter.Raw"));
  start();
  EXPECT_FALSE(workbench_->start({true, kFlatOut, "", {}}, kPatient)) << "it runs";
  const auto watch = run_->watch({"Filter.Filtered"}, 0.01, kPatient);
  ASSERT_TRUE(watch) << watch.error();
  until([&] {
    const auto values = run_->watched(watch.value().handle, kPatient);
    return values && values.value().values.at(0) > 0.01;
  });
  EXPECT_EQ(run_->change("Source", "stop", kPatient).error(), "");
  EXPECT_EQ(run_->write("Source.Frequency", "3 Hz", kPatient).error(), "");
  EXPECT_TRUE(run_->set_pace({1.0, true}, kPatient));
  EXPECT_TRUE(run_->step(kPatient));
  EXPECT_TRUE(workbench_->stop(kPatient));
  until_over();
  EXPECT_EQ(workbench_->run(kPatient).value().exit_code, 0) << log();
}

TEST_F(Opened, MistakesAreToldWithWhatMendsThem) {
  const Outcome outcome = workbench_
                              ->write(1, file(),
                                      "application: bar\nlibraries: [wave]\n"
                                      "components:\n  Source: {model: Sourc}\n",
                                      kPatient)
                              .value();
  EXPECT_TRUE(outcome.done);
  const std::string found = findings();
  EXPECT_THAT(found, HasSubstr(R"("found":"Sourc","by":"Source")"));
  const Outcome refused = edit("connect", {"Source.Position", "Nobody.Raw"});
  EXPECT_FALSE(refused.done);
  EXPECT_THAT(refused.diagnostics, HasSubstr(R"("severity":"error")"));
  EXPECT_TRUE(workbench_->undo(kPatient).value().done);
  EXPECT_THAT(findings(), HasSubstr(R"("ok":true)"));
  EXPECT_FALSE(workbench_->undo(kPatient).value().done);
}

TEST_F(Opened, EverybodyHearsOfAChange) {
  std::atomic<int> version{0};
  const auto heard = workbench_->on_ProjectChanged(
      [&](const ProjectChanged& change) { version = change.version; });
  until([&] {
    edit("place", {"Source", std::to_string(8 * (version + 1)), "8"});
    return version > 1;
  });
  EXPECT_THAT(workbench_->places(kPatient).value(), HasSubstr("\"Source\""));
}

TEST_F(Opened, ModelsAreThoseThatAreFound) {
  const auto models = workbench_->models(kPatient);
  ASSERT_TRUE(models) << models.error();
  EXPECT_THAT(models.value(), HasSubstr("LowPass"));
}

TEST_F(Opened, WhatIsNotSavedOutlivesAStudioThatIsKilled) {
  EXPECT_TRUE(edit("add", {"Filter", "LowPass"}).done);
  close();
  open();
  const ProjectState state = workbench_->project(kPatient).value();
  EXPECT_THAT(state.notice, HasSubstr("is here again"));
  EXPECT_TRUE(state.files.at(0).changed);
  EXPECT_THAT(workbench_->text(file(), kPatient).value(), HasSubstr("Filter: {model: LowPass"));
  EXPECT_FALSE(workbench_->text("/etc/hostname", kPatient));
}

TEST_F(Opened, OnlyADescriptionThatTheDeploymentNamesIsShown) {
  const std::string urdf = "<robot name=\"r\"><link name=\"base\"/></robot>\n";
  const std::string named = (folder_ / "named.urdf").string();
  const std::string other = (folder_ / "other.urdf").string();
  for (const std::string& path : {named, other}) std::ofstream(path) << urdf;
  const auto describe = [&](const std::string& path) {
    findings();
    return workbench_->description(path, kPatient);
  };
  EXPECT_FALSE(describe(named)) << "nobody names it yet";
  EXPECT_TRUE(edit("library", {"robot"}).done);
  EXPECT_TRUE(edit("add", {"Robot", "Robot"}).done);
  EXPECT_TRUE(edit("set", {"Robot.robot_description", named}).done);
  EXPECT_EQ(describe(named).value(), urdf);
  EXPECT_THAT(describe(other).error(), HasSubstr("is no robot's description of this deployment"));
  EXPECT_TRUE(edit("set", {"Robot.robot_description", file()}).done);
  EXPECT_THAT(describe(file()).error(), HasSubstr("expected <robot>"));
  EXPECT_FALSE(describe(named)) << "nobody names it any more";
}

TEST_F(Opened, ACycleOfARunIsRecordedForWhoAsks) {
  start();
  remote::Cycle cycle;
  until([&] {
    const auto found = run_->cycle("Source", kPatient);
    if (found) cycle = found.value();
    return cycle.number > 0;
  });
  ASSERT_FALSE(cycle.steps.empty());
  EXPECT_EQ(cycle.steps.front().component, "Source");
  EXPECT_LE(cycle.steps.front().begin + cycle.steps.front().length, cycle.length + 0.01);
}

TEST_F(Opened, WhatPagesWatchIsOneWatchOfTheRun) {
  start();
  ride::Node other;
  remote::InspectorPlaceholder second(other.connect("unix:" + (folder_ / "s").string()), "run");
  std::vector<std::int32_t> handles;
  for (int i = 0; i < 12; ++i) {  // of its own the run has 16 at most
    for (remote::InspectorPlaceholder* page : {&*run_, &second}) {
      const auto watch = page->watch({"Source.Position", "Source.Frequency"}, 0.01, kPatient);
      ASSERT_TRUE(watch) << watch.error();
      EXPECT_EQ(watch.value().items.at(1).item, "Source.Frequency");
      handles.push_back(watch.value().handle);
    }
  }
  until([&] { return run_->watched(handles[0], kPatient).value().values.at(1) > 0.0; });
  for (const std::int32_t handle : handles) {
    if (handle != handles.back()) EXPECT_TRUE(run_->end_watch(handle, kPatient).value());
  }
  EXPECT_FALSE(run_->watched(handles[0], kPatient)) << "it has ended";
  until([&] {
    const auto values = second.watched(handles.back(), kPatient);
    return values && values.value().values.at(1) > 0.0;
  });
  EXPECT_THAT(run_->watch({"Nobody.x"}, 0.01, kPatient).error(), HasSubstr("Nobody"));
}

TEST_F(Opened, WhatIsSetForARunIsInIt) {
  const auto standing = workbench_->start({true, 1.0, "", {"Source.Frequency=7"}}, kPatient);
  ASSERT_FALSE(standing);
  EXPECT_THAT(standing.error(), ::testing::HasSubstr("overrides are the operator's"));
  ASSERT_TRUE(workbench_->take_seat(kPatient));
  const auto started = workbench_->start({true, 1.0, "", {"Source.Frequency=7"}}, kPatient);
  ASSERT_TRUE(started) << started.error();
  until([&] { return state() == "running"; });
  const auto values = run_->read({"Source.Frequency"}, kPatient);
  ASSERT_TRUE(values) << values.error();
  EXPECT_EQ(values.value().at(0).value, "7");
}

TEST_F(Opened, ARunOutlivesTheStudioAndIsFoundAgain) {
  start();
  const int process = server_->running();
  close();
  EXPECT_TRUE(platform::process_lives(process));
  open();
  until([&] { return state() == "running"; });
  EXPECT_EQ(server_->running(), process);
  EXPECT_TRUE(run_->components(kPatient));
  EXPECT_TRUE(workbench_->stop(kPatient));
  until_over();
  EXPECT_FALSE(platform::process_has_argument(process, "run"));
}

TEST_F(Opened, ARunThatDiesIsToldAndTheStudioGoesOn) {
  start();
  ::kill(server_->running(), SIGKILL);
  until_over();
  EXPECT_EQ(workbench_->run(kPatient).value().exit_code, 128 + SIGKILL);
  EXPECT_THAT(run_->components(kPatient).error(), HasSubstr("nothing runs"));
  EXPECT_TRUE(edit("add", {"Filter", "LowPass"}).done);
}

TEST_F(Opened, StopWaitsForNothingThatTheStudioIsAbout) {
  start();
  const int process = server_->running();
  open_ = false;  // the desk is busy for ever
  thread_.join();
  EXPECT_FALSE(workbench_->stop({100ms, {}})) << "nobody answers";
  until([&] { return !platform::process_has_argument(process, "run"); });
  open_ = true;
  thread_ = std::thread([this] {
    while (open_) server_->serve(10ms);
  });
  until_over();
  EXPECT_EQ(workbench_->run(kPatient).value().exit_code, 0) << log();
}

TEST_F(Opened, AnEmergencyStopOfWhatNobodyArmsStopsTheRun) {
  EXPECT_THAT(workbench_->emergency_stop(kPatient).error(), HasSubstr("nothing runs"));
  start();
  const auto stopped = workbench_->emergency_stop(kPatient);
  ASSERT_TRUE(stopped) << stopped.error();
  EXPECT_TRUE(stopped.value().disarmed.empty());
  EXPECT_THAT(stopped.value().stopped, HasSubstr("nothing that runs is armed"));
  until_over();
  EXPECT_EQ(workbench_->run(kPatient).value().exit_code, 0) << log();
}

TEST_F(Opened, WhoMayOnlyLookChangesAndCommandsNothing) {
  start();
  EXPECT_TRUE(workbench_->stop(kPatient));
  until_over();
  close();
  const std::string policy = (folder_ / "studio.policy").string();
  std::ofstream(policy) << "allow local:* read workbench,run\n";
  open(policy);
  EXPECT_TRUE(workbench_->project(kPatient));
  const auto refused = workbench_->edit({{{"add", {"Filter", "LowPass"}}}, {}, false}, kPatient);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error(), HasSubstr("may not configure 'workbench'"));
  EXPECT_FALSE(workbench_->start({true, 1.0, "", {}}, kPatient));
}

TEST_F(Opened, ARunIsCommandedByThoseOnlyWhoMay) {
  start();
  close();
  const std::string policy = (folder_ / "studio.policy").string();
  std::ofstream(policy) << "allow local:* read run\nallow local:* read,command workbench\n";
  open(policy);
  until([&] { return state() == "running" && run_->components(kPatient); });
  for (const auto& refused : {run_->write("Source.Frequency", "3 Hz", kPatient).error(),
                              run_->change("Source", "stop", kPatient).error(),
                              run_->set_pace({1.0, true}, kPatient).error()}) {
    EXPECT_THAT(refused, HasSubstr("may not configure 'run'"));
  }
  EXPECT_THAT(run_->begin("Source", "anything", {}, kPatient).error(),
              HasSubstr("may not command 'run'"));
  EXPECT_TRUE(run_->read({"Source.Frequency"}, kPatient));
}

TEST_F(Opened, WhoMayCommandAndNotConfigureSetsNothingForARun) {
  close();
  const std::string policy = (folder_ / "studio.policy").string();
  std::ofstream(policy) << "allow local:* read,command workbench,run\n";
  open(policy);
  const auto refused = workbench_->start({true, 1.0, "", {"Source.Frequency=7"}}, kPatient);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error(), HasSubstr("may not configure 'workbench'"));
  EXPECT_EQ(state(), "none");
  start();
}

TEST_F(Opened, OneStudioHasADeployment) {
  ServerOptions options;
  options.file = file();
  options.listen = "unix:" + (folder_ / "t").string();
  options.pages = (folder_ / "page").string();
  options.folder = (folder_ / "left").string();
  options.program = PROGRAM;
  base::Diagnostics diagnostics;
  EXPECT_EQ(Server::make(options, diagnostics), nullptr);
  EXPECT_THAT(diagnostics.to_text(), HasSubstr("another studio has '" + file() + "' open"));
}

}  // namespace
}  // namespace armature::studio
