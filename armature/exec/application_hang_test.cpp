// SPDX-License-Identifier: Apache-2.0
// Hooks that do not return. Each test lets them go in the end and waits until their threads are
// gone, as a process that goes on would not.
#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/exec/internal/test_components.hpp"

namespace armature::exec {
namespace {

using component::State;
using ::testing::ElementsAre;

/// How many threads of applications there are; others, such as a sanitizer's, do not count.
int application_threads() {
  int count = 0;
  for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task")) {
    std::string name;
    std::getline(std::ifstream(thread.path() / "comm"), name);
    for (const char* ours : {"A", "Stuck", "B", "life cycle"}) count += name == ours ? 1 : 0;
  }
  return count;
}

void wait_for_their_end() {
  while (application_threads() > 0) std::this_thread::yield();
}

/// A place where hooks wait until the test lets them go.
class Trap {
 public:
  void hold() {
    caught_ = true;
    open_.wait(false);
  }
  void open() {
    open_ = true;
    open_.notify_all();
  }
  bool caught() const { return caught_; }

 private:
  std::atomic<bool> caught_{false};
  std::atomic<bool> open_{false};
};

/// Nobody ever joins a thread that was given up, which is what giving up means.
constexpr bool kSeesRaces = std::string_view(ARMATURE_SANITIZER) == "thread";

/// A -> Stuck -> B, each with its own thread, and Neighbour in the thread of Stuck.
class Hang : public ::testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    if (kSeesRaces) GTEST_SKIP() << "races by intent";
  }
  Hang() {
    const char* const names[] = {"A", "Stuck", "B"};
    for (const char* name : names) {
      probes_.push_back(&blueprint_.add<Probe>(name, Activity::periodic(1ms)));
    }
    probes_.push_back(&blueprint_.add<Probe>("Neighbour"));
    blueprint_.connect("A.Out", "Stuck.Look");
    blueprint_.connect("Stuck.Out", "B.Look");
    blueprint_.connect("Stuck.Out", "Neighbour.In");
    for (Probe* probe : probes_) probe->journal = &journal_;
    options_ = patient(GetParam());
  }
  ~Hang() override {
    trap_.open();
    wait_for_their_end();
  }

  Probe& stuck() { return *probes_[1]; }
  /// Makes the hook hang; the application does not wait for it long.
  Application make_application(const char* hook) {
    stuck().actions[hook] = [trap = &trap_] { trap->hold(); };
    options_.hook_limit = 500ms;
    options_.stop_limit = 500ms;
    return Application(std::move(blueprint_), options_);
  }
  std::vector<std::string> journal_of(const std::string& hook) {
    std::vector<std::string> entries = journal_.take();
    std::erase_if(entries, [&](const std::string& entry) { return !entry.ends_with(hook); });
    return entries;
  }

  Trap trap_;
  Journal journal_;
  Blueprint blueprint_;
  std::vector<Probe*> probes_;
  ApplicationOptions options_;
};
INSTANTIATE_TEST_SUITE_P(InBothKindsOfTime, Hang, ::testing::Bool(),
                         [](const auto& test) { return test.param ? "Simulated" : "Real"; });

TEST_P(Hang, InConfigureIsNamedNobodyAfterItIsConfiguredAndTheOthersAreCleanedUp) {
  Application application = make_application("configure");
  EXPECT_EQ(application.start().to_text(),
            "error: 'Stuck' hangs: on_configure did not return within 500 ms, in the thread 'life "
            "cycle'\n");
  EXPECT_TRUE(application.hangs());
  EXPECT_FALSE(application.running());
  EXPECT_THAT(journal_.take(), ElementsAre("A configure", "Stuck configure", "A cleanup"));
  trap_.open();
  wait_for_their_end();
  EXPECT_THAT(journal_.take(), ElementsAre()) << "nor later, when it goes on";
}

TEST_P(Hang, InActivateIsNamedAndTheOthersAreCleanedUp) {
  Application application = make_application("activate");
  EXPECT_EQ(application.start().to_text(),
            "error: 'Stuck' hangs: on_activate did not return within 500 ms, in the thread 'life "
            "cycle'\n");
  EXPECT_THAT(journal_of("cleanup"), ElementsAre("Neighbour cleanup", "B cleanup", "A cleanup"));
}

TEST_P(Hang, InStartIsNamedWhatHadStartedStopsAndNoThreadStaysBehindTheGate) {
  Application application = make_application("start");
  EXPECT_EQ(application.start().to_text(),
            "error: 'Stuck' hangs: on_start did not return within 500 ms, in the thread 'life "
            "cycle'\n");
  while (application_threads() > 1) std::this_thread::yield();
  std::vector<std::string> life = journal_.take();
  life.erase(life.begin(), life.begin() + 8);
  EXPECT_THAT(life, ElementsAre("A start", "Stuck start", "A stop", "Neighbour cleanup",
                                "B cleanup", "A cleanup"));
}

TEST_P(Hang, InStopIsNamedAndTheOthersStopAndAreCleanedUp) {
  Application application = make_application("stop");
  ASSERT_TRUE(application.start().ok());
  EXPECT_FALSE(application.hangs());
  const std::string text = application.stop().to_text();
  if (GetParam()) {
    EXPECT_EQ(text,
              "error: 'Stuck' hangs: on_stop did not return within 500 ms, in the thread 'life "
              "cycle'\n");
  } else {
    EXPECT_EQ(text, "error: 'Stuck' did not stop: its thread 'Stuck' hangs in 'Stuck'\n");
  }
  EXPECT_TRUE(application.hangs());
  const std::vector<std::string> entries = journal_.take();
  std::vector<std::string> end;
  for (const std::string& entry : entries) {
    if (entry.ends_with("stop") || entry.ends_with("cleanup")) end.push_back(entry);
  }
  if (GetParam()) {
    EXPECT_THAT(end, ElementsAre("Neighbour stop", "B stop", "Stuck stop", "A stop",
                                 "Neighbour cleanup", "B cleanup", "A cleanup"));
  } else {
    EXPECT_THAT(end, ElementsAre("Neighbour stop", "B stop", "Stuck stop", "A stop", "B cleanup",
                                 "A cleanup"))
        << "nobody touches what shares the thread that hangs";
  }
}

TEST_P(Hang, InCleanupIsNamedAndTheOthersAreCleanedUp) {
  Application application = make_application("cleanup");
  ASSERT_TRUE(application.start().ok());
  EXPECT_EQ(application.stop().to_text(),
            "error: 'Stuck' hangs: on_cleanup did not return within 500 ms, in the thread 'life "
            "cycle'\n");
  EXPECT_TRUE(application.hangs());
  EXPECT_THAT(journal_of("cleanup"),
              ElementsAre("Neighbour cleanup", "B cleanup", "Stuck cleanup", "A cleanup"));
}

TEST_P(Hang, AnApplicationThatHangsDoesNotStartAgain) {
  Application application = make_application("configure");
  EXPECT_FALSE(application.start().ok());
  EXPECT_EQ(
      application.start().to_text(),
      "error: 'application' cannot be started again: one of its hooks hangs (end the process)\n");
  EXPECT_FALSE(application.start_component("Stuck"));
}

class HangInRealTime : public Hang {};
INSTANTIATE_TEST_SUITE_P(OfAThread, HangInRealTime, ::testing::Values(false),
                         [](const auto&) { return "Real"; });

TEST_P(HangInRealTime, InAnUpdateIsNamedWithItsThreadAndAllOtherThreadsStopInOrder) {
  Application application = make_application("update");
  ASSERT_TRUE(application.start().ok());
  EXPECT_TRUE(run_until(application, [&] { return trap_.caught(); }));
  journal_.take();
  EXPECT_EQ(application.stop().to_text(),
            "error: 'Neighbour' did not stop: its thread 'Stuck' hangs in 'Stuck'\n"
            "error: 'Stuck' did not stop: its thread 'Stuck' hangs in 'Stuck'\n");
  EXPECT_TRUE(application.hangs());
  std::vector<std::string> entries = journal_.take();
  std::erase_if(entries, [](const std::string& entry) { return entry.ends_with("update"); });
  EXPECT_THAT(entries, ElementsAre("B stop", "A stop", "B cleanup", "A cleanup"));
  ASSERT_EQ(application.casualties().size(), 2u);
  EXPECT_EQ(application.casualties()[0].component, "Stuck");
  EXPECT_EQ(application.casualties()[0].reason, "its thread hangs");
  EXPECT_EQ(application.casualties()[1].component, "Neighbour");
}

TEST_P(HangInRealTime, WhenItGoesOnItsComponentsStopThemselves) {
  {
    Application application = make_application("update");
    ASSERT_TRUE(application.start().ok());
    EXPECT_TRUE(run_until(application, [&] { return trap_.caught(); }));
    EXPECT_FALSE(application.stop().ok());
    journal_.take();
  }
  trap_.open();
  wait_for_their_end();
  EXPECT_THAT(journal_.take(), ElementsAre("Neighbour stop", "Stuck stop"))
      << "although the application is gone";
}

TEST_P(HangInRealTime, InAHandlerNamesTheComponentWhoseHandlerItIs) {
  Probe& neighbour = *probes_[3];
  stuck().actions["update"] = [&] { stuck().out.write(1.0); };
  neighbour.actions["in"] = [&] { trap_.hold(); };
  options_.stop_limit = 500ms;
  Application application(std::move(blueprint_), options_);
  ASSERT_TRUE(application.start().ok());
  EXPECT_TRUE(run_until(application, [&] { return trap_.caught(); }));
  EXPECT_EQ(application.stop().to_text(),
            "error: 'Neighbour' did not stop: its thread 'Stuck' hangs in 'Neighbour'\n"
            "error: 'Stuck' did not stop: its thread 'Stuck' hangs in 'Neighbour'\n");
}

TEST_P(HangInRealTime, QuestionsToAThreadThatHangsAreAnsweredSo) {
  Application application = make_application("update");
  ASSERT_TRUE(application.start().ok());
  EXPECT_TRUE(run_until(application, [&] { return trap_.caught(); }));
  EXPECT_EQ(application.value_of("Stuck", "Out").error(),
            "the thread of 'Stuck' did not answer in time");
  EXPECT_EQ(application.stop_component("Stuck").reason(),
            "the thread of 'Stuck' did not answer in time");
  EXPECT_TRUE(application.value_of("A", "Out").ok());
  EXPECT_FALSE(application.stop().ok());
  EXPECT_EQ(application.value_of("Stuck", "Out").error(),
            "the thread of 'Stuck' did not answer in time");
}

/// Does something that does not end, when it is asked to.
class Sleeper final : public component::Component {
 public:
  using Component::Component;
  component::Operation<void()> sleep{this, "sleep", component::serve<&Sleeper::do_sleep>,
                                     "does not return", component::in_own_thread};
  Trap* trap = nullptr;

 private:
  void do_sleep() { trap->hold(); }
};

/// Asks for it at the very end.
class LastWish final : public component::Component {
 public:
  using Component::Component;
  component::OperationCaller<void()> sleep{this, "sleep", "asks the peer"};

 private:
  void on_stop() override { sent_ = sleep.send().sent(); }
  bool sent_ = false;
};

TEST(HangOfLeftovers, IsNamedAndTheStopEnds) {
  if (kSeesRaces) GTEST_SKIP() << "races by intent";
  Trap trap;
  Blueprint blueprint;
  blueprint.add<Sleeper>("Sleeper", Activity::triggered()).trap = &trap;
  blueprint.add<LastWish>("LastWish", Activity::triggered());
  blueprint.add_peer("LastWish", "Sleeper");
  ApplicationOptions options = patient(true);  // sent, but nobody runs any more
  options.stop_limit = 500ms;
  Application application(std::move(blueprint), options);
  ASSERT_EQ(application.start().to_text(), "");
  EXPECT_EQ(
      application.stop().to_text(),
      "error: a message to the thread 'Sleeper', handled after its end, hangs in 'Sleeper'\n");
  EXPECT_TRUE(application.hangs());
  trap.open();
  wait_for_their_end();
}

}  // namespace
}  // namespace armature::exec
