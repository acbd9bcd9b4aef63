// SPDX-License-Identifier: Apache-2.0
// What is asked of the system and what it grants; what is not permitted here is skipped, saying so.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "armature/exec/internal/test_components.hpp"

namespace armature::exec {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr bool kSanitized = std::string_view(ARMATURE_SANITIZER) != "";

ApplicationOptions with(RealtimeMode mode) {
  ApplicationOptions options = patient(false);
  options.realtime = mode;
  return options;
}

const Verdict::Line& line_of(const Application& application, const std::string& subject) {
  for (const Verdict::Line& line : application.verdict().lines) {
    if (line.subject == subject) return line;
  }
  throw std::out_of_range("no line of " + subject);
}

std::vector<std::string> subjects(const Application& application) {
  std::vector<std::string> subjects;
  for (const Verdict::Line& line : application.verdict().lines) subjects.push_back(line.subject);
  return subjects;
}

std::string all_refusals(const Verdict::Line& line) {
  std::string text;
  for (const std::string& refusal : line.refusals) text += refusal + "; ";
  return text;
}

TEST(Realtime, SwitchedOffAsksForNothing) {
  Blueprint blueprint;
  Activity activity = Activity::periodic(1ms, 80);
  activity.cpus = {0};
  blueprint.add<Probe>("A", activity);
  Application application(std::move(blueprint), with(RealtimeMode::kOff));
  ASSERT_TRUE(application.start().ok());
  EXPECT_EQ(application.verdict().to_text(),
            "A: asked for the ordinary scheduler, got the ordinary scheduler\n");
}

TEST(Realtime, InSimulatedTimeThereIsNothingToAskFor) {
  Blueprint blueprint;
  blueprint.add<Probe>("A", Activity::periodic(1ms, 80));
  ApplicationOptions options = with(RealtimeMode::kRequire);
  options.simulated = true;
  Application application(std::move(blueprint), options);
  EXPECT_EQ(application.start().to_text(), "");
  EXPECT_THAT(application.verdict().lines, IsEmpty());
}

TEST(Realtime, PreferredSaysForEachThingWhatWasAskedAndGranted) {
  Blueprint blueprint;
  blueprint.add<Probe>("A", Activity::periodic(1ms, 10));
  Application application(std::move(blueprint), with(RealtimeMode::kPrefer));
  ASSERT_TRUE(application.start().ok()) << "whatever was granted";
  EXPECT_THAT(subjects(application),
              ::testing::ElementsAre("memory", "idle states", "kernel", "clock", "A"));
  EXPECT_EQ(line_of(application, "memory").requested, "locked");
  EXPECT_EQ(line_of(application, "idle states").requested, "held off");
  EXPECT_EQ(line_of(application, "kernel").requested, "PREEMPT_RT");
  EXPECT_EQ(line_of(application, "clock").requested, "a resolution of 1 us or better");
  EXPECT_EQ(line_of(application, "A").requested, "SCHED_FIFO priority 10");
  for (const Verdict::Line& line : application.verdict().lines) {
    EXPECT_FALSE(line.granted.empty()) << line.subject;
    EXPECT_EQ(line.refusals.empty(), line.granted == line.requested || line.subject == "clock")
        << line.subject << ": " << line.granted;
  }
}

TEST(Realtime, RequiredStartsNothingWithoutAllOfIt) {
  Journal journal;
  Blueprint blueprint;
  Activity activity = Activity::periodic(1ms, 10);
  activity.cpus = {1000};
  Probe& probe = blueprint.add<Probe>("A", activity);
  probe.journal = &journal;
  Application application(std::move(blueprint), with(RealtimeMode::kRequire));
  const std::string text = application.start().to_text();
  EXPECT_THAT(text, HasSubstr("error: real time is required but not available:\n"));
  EXPECT_THAT(text, HasSubstr("A: asked for SCHED_FIFO priority 10 on CPU 1000, got "));
  EXPECT_THAT(text, HasSubstr("refused: CPU 1000: "));
  EXPECT_FALSE(application.running());
  EXPECT_THAT(journal.take(), ::testing::ElementsAre("A configure", "A cleanup"));
}

TEST(Realtime, AThreadGetsItsPriorityAndItsCpu) {
  Blueprint blueprint;
  Activity activity = Activity::periodic(1ms, 42);
  activity.cpus = {0};
  Probe& probe = blueprint.add<Probe>("A", activity);
  Application application(std::move(blueprint), with(RealtimeMode::kPrefer));
  ASSERT_TRUE(application.start().ok());
  const Verdict::Line& line = line_of(application, "A");
  if (!line.refusals.empty()) GTEST_SKIP() << all_refusals(line);
  EXPECT_EQ(line.granted, "SCHED_FIFO priority 42 on CPU 0");
  int policy = -1;
  sched_param parameters{};
  int cpu = -1;
  ASSERT_TRUE(application.run_in_thread_of(probe, [&] {
    policy = ::sched_getscheduler(0);
    ::sched_getparam(0, &parameters);
    cpu = ::sched_getcpu();
  }));
  EXPECT_EQ(policy, SCHED_FIFO);
  EXPECT_EQ(parameters.sched_priority, 42);
  EXPECT_EQ(cpu, 0);
}

TEST(Realtime, AThreadIsScheduledByDeadline) {
  Blueprint blueprint;
  Activity activity = Activity::periodic(10ms);
  activity.scheduler = Activity::Scheduler::kDeadline;
  activity.budget = 1ms;
  Probe& probe = blueprint.add<Probe>("A", activity);
  Application application(std::move(blueprint), with(RealtimeMode::kPrefer));
  ASSERT_TRUE(application.start().ok());
  const Verdict::Line& line = line_of(application, "A");
  if (!line.refusals.empty()) GTEST_SKIP() << all_refusals(line);
  EXPECT_EQ(line.granted, "SCHED_DEADLINE");
  int policy = -1;
  ASSERT_TRUE(application.run_in_thread_of(probe, [&] { policy = ::sched_getscheduler(0); }));
  constexpr int kDeadline = 6;  // SCHED_DEADLINE, which <sched.h> does not know yet
  EXPECT_EQ(policy, kDeadline);
}

TEST(Realtime, IdleStatesAreHeldOffWhileItRuns) {
  const auto holds = [] {
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
      std::error_code gone;
      if (std::filesystem::read_symlink(entry, gone) == "/dev/cpu_dma_latency") return true;
    }
    return false;
  };
  Blueprint blueprint;
  blueprint.add<Probe>("A", Activity::periodic(1ms));
  Application application(std::move(blueprint), with(RealtimeMode::kPrefer));
  ASSERT_TRUE(application.start().ok());
  const Verdict::Line& line = line_of(application, "idle states");
  if (!line.refusals.empty()) GTEST_SKIP() << all_refusals(line);
  EXPECT_TRUE(holds());
  EXPECT_TRUE(application.stop().ok());
  EXPECT_FALSE(holds());
}

long page_faults_of_this_thread() {
  rusage usage{};
  ::getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_minflt + usage.ru_majflt;
}

/// Takes memory in advance, and touches it long after.
class LateToucher final : public component::Component {
 public:
  using Component::Component;
  std::atomic<int> cycles{0};
  long faults_before = 0;
  long faults = -1;

 private:
  component::Outcome on_configure() override {
    buffer_.reserve(kBytes);
    return component::accepted();
  }
  void on_update() override {
    if (++cycles == 10) faults_before = page_faults_of_this_thread();
    if (cycles < 10 || cycles > 100) return;
    for (std::size_t i = 0; i < kBytes / 100; i += 512) buffer_.push_back('x');
    touch_stack();
    if (cycles == 100) faults = page_faults_of_this_thread() - faults_before;
  }
  static void touch_stack() {
    volatile char here[96 * 1024];
    for (std::size_t i = 0; i < sizeof here; i += 1024) here[i] = 1;
  }

  static constexpr std::size_t kBytes = 4u << 20;
  std::vector<char> buffer_;
};

TEST(Realtime, MemoryThatWasTakenBeforeIsThereWithoutAPageFault) {
  if (kSanitized) GTEST_SKIP() << "sanitizers never lock memory";
  Blueprint blueprint;
  auto& toucher = blueprint.add<LateToucher>("A", Activity::periodic(1ms));
  Application application(std::move(blueprint), with(RealtimeMode::kPrefer));
  ASSERT_TRUE(application.start().ok());
  const Verdict::Line& line = line_of(application, "memory");
  if (!line.refusals.empty()) GTEST_SKIP() << all_refusals(line);
  EXPECT_TRUE(run_until(application, [&] { return toucher.cycles > 100; }));
  EXPECT_TRUE(application.stop().ok());
  EXPECT_EQ(toucher.faults, 0);
}

/// Starts an application where there is no room for a stack; prints what that says.
[[noreturn]] void start_without_room() {
  Journal journal;
  Blueprint blueprint;
  blueprint.add<Probe>("A", Activity::periodic(1ms)).journal = &journal;
  Application application(std::move(blueprint), with(RealtimeMode::kOff));
  rlimit before{};
  ::getrlimit(RLIMIT_AS, &before);
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  rlimit tight = before;
  tight.rlim_cur = pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) + 400 * 1024;
  ::setrlimit(RLIMIT_AS, &tight);
  const std::string text = application.start().to_text();
  ::setrlimit(RLIMIT_AS, &before);
  const bool clean = !application.running() && journal.take().back() == "A cleanup";
  const bool starts_again = application.start().ok();
  std::fprintf(stderr, "%s%s%s", text.c_str(), clean ? "clean, " : "",
               starts_again ? "starts again" : "");
  std::_Exit(0);
}

TEST(RealtimeDeathTest, AThreadThatTheSystemDoesNotGiveIsAnErrorAndNothingIsLeft) {
  if (kSanitized) GTEST_SKIP() << "sanitizers need all the address space there is";
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // a fresh process: no stacks to use again
  EXPECT_EXIT(start_without_room(), ::testing::ExitedWithCode(0),
              "^error: cannot start the thread 'A': Resource temporarily unavailable\n"
              "clean, starts again$");
}

TEST(Verdict, IsCompleteWithoutRefusalsAndSaysEachOne) {
  Verdict verdict;
  verdict.lines.push_back({"memory", "locked", "locked", {}});
  EXPECT_TRUE(verdict.complete());
  verdict.lines.push_back({"A", "SCHED_FIFO priority 80", "the ordinary scheduler", {"no", "no"}});
  EXPECT_FALSE(verdict.complete());
  EXPECT_EQ(verdict.to_text(),
            "memory: asked for locked, got locked\n"
            "A: asked for SCHED_FIFO priority 80, got the ordinary scheduler\n"
            "  refused: no\n"
            "  refused: no\n");
}

}  // namespace
}  // namespace armature::exec
