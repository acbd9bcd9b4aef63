// SPDX-License-Identifier: Apache-2.0
// `armature studio ADDRESS`, asked as a page asks it, with an application of another process.
#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "armature/platform/child_process.hpp"
#include "armature/ride/node.hpp"
#include "armature/studio/server.hpp"
#include "inspection_client.hpp"
#include "workbench_client.hpp"

namespace armature::studio {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr ride::CallOptions kPatient{60s, {}};

constexpr const char* kWave =
    "application: wave\n"
    "libraries: [wave]\n"
    "components:\n"
    "  Source: {model: Source, activity: {periodic: 10 ms}}\n"
    "  Filter: {model: LowPass, activity: sequential, properties: {Weight: 0.25}}\n"
    "  Watcher: {model: Watcher, activity: {periodic: 200 ms}}\n"
    "connections:\n"
    "  - Source.Position -> Filter.Raw\n"
    "  - Filter.Filtered -> Watcher.Value\n";

/// An application that another process runs, a studio that has its address open, and somebody who
/// uses that.
class AnApplicationElsewhere : public ::testing::Test {
 protected:
  AnApplicationElsewhere() {
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "page");
    std::ofstream(folder_ / "page/index.html") << "<!doctype html>";
    std::ofstream(file()) << kWave;
    std::ofstream(folder_ / "policy") << "allow local read,command,configure *\n";
    run();
    open();
  }
  ~AnApplicationElsewhere() override {
    seen_.reset();
    workbench_.reset();
    user_.reset();
    open_ = false;
    if (thread_.joinable()) thread_.join();
    server_.reset();
    application_.reset();
    fs::remove_all(folder_);
  }

  std::string file() const { return (folder_ / "wave.yaml").string(); }
  std::string address() const { return "unix:" + (folder_ / "robot").string(); }

  void run() {
    fs::remove(folder_ / "robot");
    auto started = platform::ChildProcess::start(
        {PROGRAM, "run", file(), "--library-path", WAVE_LIBRARY, "--sim", "--pace", "1", "--listen",
         address(), "--policy", (folder_ / "policy").string()},
        {.log = (folder_ / "log").string()});
    ASSERT_TRUE(started);
    application_.emplace(std::move(started.value()));
    until([&] { return fs::exists(folder_ / "robot"); });
  }
  void open() {
    ServerOptions options;
    options.file = address();
    options.elsewhere = true;
    options.listen = "unix:" + (folder_ / "s").string();
    options.pages = (folder_ / "page").string();
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
    seen_.emplace(peer, "run");
  }

  void until(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + 60s;
    while (!condition()) {
      ASSERT_LT(std::chrono::steady_clock::now(), end);
      std::this_thread::sleep_for(5ms);
    }
  }
  RunState state() { return workbench_->run(kPatient).value(); }
  void until_running() {
    until([&] { return state().state == "running"; });
  }
  json described() { return json::parse(workbench_->check(kPatient).value()); }

  const fs::path folder_ = fs::path(::testing::TempDir()) / "studio_elsewhere_test";
  std::optional<platform::ChildProcess> application_;
  std::unique_ptr<Server> server_;
  std::atomic<bool> open_{false};
  std::thread thread_;
  std::optional<ride::Node> user_;
  std::optional<WorkbenchPlaceholder> workbench_;
  std::optional<remote::InspectorPlaceholder> seen_;
};

TEST_F(AnApplicationElsewhere, IsShownWithoutItsFile) {
  const ProjectState project = workbench_->project(kPatient).value();
  EXPECT_EQ(project.elsewhere, address());
  EXPECT_THAT(project.files, IsEmpty());
  EXPECT_EQ(project.notice, "");
  const json all = described();
  EXPECT_EQ(all["application"], "wave");
  ASSERT_EQ(all["components"].size(), 3u);
  EXPECT_EQ(all["components"][1]["name"], "Filter");
  EXPECT_EQ(all["components"][1]["properties"][0]["value"], "0.25");
  ASSERT_EQ(all["connections"].size(), 2u);
  EXPECT_EQ(all["connections"][0]["from"], "Source.Position");
  EXPECT_EQ(all["connections"][0]["to"], "Filter.Raw");
}

TEST_F(AnApplicationElsewhere, IsWatchedAndItsLogIsRead) {
  until_running();
  EXPECT_TRUE(state().simulated);
  const remote::Watch watch = seen_->watch({"Source.Position"}, 0.01, kPatient).value();
  const auto value = [&] { return seen_->watched(watch.handle, kPatient).value().values.at(0); };
  const double first = value();
  until([&] { return value() != first; });
  until([&] { return state().log_end > 1; });
  const auto lines = workbench_->log(0, kPatient).value();
  EXPECT_THAT(lines.at(0), HasSubstr("info    Watcher: "));
  EXPECT_NE(lines.at(0), lines.at(1));
}

TEST_F(AnApplicationElsewhere, IsNeitherEditedNorStartedNorStopped) {
  until_running();
  const std::string why = "this application runs at " + address();
  const Edit edit{{{"remove", {"Filter"}}}, {}, false};
  EXPECT_THAT(workbench_->edit(edit, kPatient).error(), HasSubstr(why));
  EXPECT_THAT(workbench_->save(kPatient).error(), HasSubstr(why));
  EXPECT_THAT(workbench_->start({true, 1.0, "", {}}, kPatient).error(), HasSubstr(why));
  EXPECT_THAT(workbench_->stop(kPatient).error(), HasSubstr(why));
  EXPECT_THAT(workbench_->text(file(), kPatient).error(), HasSubstr(why));
  EXPECT_FALSE(application_->exit_code());
}

TEST_F(AnApplicationElsewhere, IsNotStoppedByAnEmergencyStopThatFindsNothingToDisarm) {
  until_running();
  const auto pressed = workbench_->emergency_stop(kPatient);
  EXPECT_THAT(pressed.error(), HasSubstr("nothing that runs is armed by an operator"));
  EXPECT_THAT(pressed.error(), HasSubstr("is not stopped from here"));
  EXPECT_FALSE(application_->exit_code());
}

TEST_F(AnApplicationElsewhere, ThatIsKilledIsToldAndComesBack) {
  until_running();
  const RunState before = state();
  application_->send(SIGKILL);
  until([&] { return state().state == "lost"; });
  EXPECT_THAT(workbench_->project(kPatient).value().notice, HasSubstr("is not there"));
  EXPECT_EQ(described()["components"].size(), 3u) << "it is shown as it was";
  EXPECT_FALSE(seen_->components(kPatient));
  std::ofstream(file()) << std::string(kWave).replace(0, 17, "application: tide\n");
  run();
  until_running();
  EXPECT_GT(state().number, before.number);
  EXPECT_EQ(workbench_->project(kPatient).value().notice, "");
  EXPECT_EQ(described()["application"], "tide");
  EXPECT_TRUE(seen_->components(kPatient));
}

TEST_F(AnApplicationElsewhere, IsReadAnewWhenAsked) {
  until_running();
  ASSERT_TRUE(seen_->change("Filter", "stop", kPatient));
  ASSERT_TRUE(seen_->write("Filter.Weight", "0.5", kPatient));
  EXPECT_EQ(described()["components"][1]["properties"][0]["value"], "0.25");
  ASSERT_TRUE(workbench_->reload(kPatient));
  until([&] { return described()["components"][1]["properties"][0]["value"] == "0.5"; });
}

}  // namespace
}  // namespace armature::studio
