// SPDX-License-Identifier: Apache-2.0
#include "armature/analysis/schedule.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/deploy/internal/test_models.hpp"
#include "armature/platform/file.hpp"

namespace armature::deploy {

using namespace analysis;

using namespace document;
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using namespace std::chrono_literals;
using test::deploy;

/// Deployment of sources; each line is an activity.
Deployment sources(const std::vector<std::string>& activities, int cpus = 1) {
  std::string yaml = "components:\n";
  for (std::size_t i = 0; i < activities.size(); ++i) {
    yaml += "  T" + std::to_string(i) + ": {model: Source, activity: {" + activities[i] + "}}\n";
  }
  DeploymentOptions options;
  options.cpus = cpus;
  return deploy(yaml, options);
}

std::string periodic(int period_us, int priority, int budget_us, const std::string& more = "") {
  return "periodic: " + std::to_string(period_us) + " us, priority: " + std::to_string(priority) +
         ", budget: " + std::to_string(budget_us) + " us" + more;
}

TEST(Schedule, ResponseTimesAreThoseOfTheTextbook) {
  // Burns and Wellings, three tasks: periods 7, 12, 20, times 3, 3, 5 give 3, 6, 20.
  const Deployment deployment =
      sources({periodic(7000, 30, 3000), periodic(12000, 20, 3000), periodic(20000, 10, 5000)});
  ASSERT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  const Schedule& schedule = deployment.schedule;
  ASSERT_EQ(schedule.threads.size(), 3u);
  EXPECT_EQ(schedule.threads[0].response, 3ms);
  EXPECT_EQ(schedule.threads[1].response, 6ms);
  EXPECT_EQ(schedule.threads[2].response, 20ms);
  EXPECT_NEAR(schedule.utilisation(), 3.0 / 7 + 3.0 / 12 + 5.0 / 20, 1e-12);
}

TEST(Schedule, AResponseAfterThePeriodIsAnError) {
  const Deployment deployment =
      sources({periodic(7000, 30, 3000), periodic(12000, 20, 3000), periodic(20000, 10, 5001)});
  EXPECT_THAT(deployment.diagnostics.to_text(),
              AllOf(HasSubstr("app.yaml:4:3: error: thread 'T2' (priority 10) answers within "),
                    HasSubstr("but its period is 20 ms"), HasSubstr("waits for 'T0', 'T1'")));
}

TEST(Schedule, OfModesTheMostExpensiveCounts) {
  const auto with = [](const char* second_budget) {
    DeploymentOptions options;
    options.cpus = 1;
    return deploy(std::string(R"(
components:
  A: {model: Source, activity: {periodic: 10 ms, priority: 50, budget: 1 ms}}
  B: {model: Echo, activity: {sequential: true, budget: 6 ms}}
  C: {model: Echo, activity: {sequential: true, budget: )") +
                      second_budget + R"(}}
connections: [A.Out -> B.In, A.Out -> C.In]
modes: {one: [B], two: [C]}
)",
                  options);
  };
  const Deployment fits = with("8 ms");
  ASSERT_TRUE(fits.ok()) << fits.diagnostics.to_text();
  EXPECT_EQ(fits.schedule.threads.front().cost, 9ms) << "not the sum of both modes";
  EXPECT_THAT(with("10 ms").diagnostics.to_text(), HasSubstr("thread 'A' (priority 50) answers"));
}

TEST(Schedule, AFullCpuIsNotTooFull) {
  EXPECT_TRUE(sources({periodic(10000, 30, 5000), periodic(10000, 20, 5000)}).ok());
  EXPECT_THAT(sources({periodic(10000, 30, 5000), periodic(10000, 20, 5001)}).diagnostics.to_text(),
              HasSubstr("the threads on CPU 0 need 100.0 % of a CPU"));
}

TEST(Schedule, AnEquallyUrgentThreadIsWaitedForOnce) {
  const Deployment deployment = sources({periodic(10000, 30, 1000), periodic(1100, 30, 100)});
  ASSERT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  EXPECT_EQ(deployment.schedule.threads[0].response, 1100us);
  EXPECT_EQ(deployment.schedule.threads[1].response, 1100us);
  EXPECT_THAT(sources({periodic(10000, 30, 1000), periodic(1000, 30, 200)}).diagnostics.to_text(),
              HasSubstr("thread 'T1' (priority 30) answers within 1200 us"));
}

TEST(Schedule, ThreadsOnDifferentCpusDoNotDisturbEachOther) {
  const Deployment deployment = sources(
      {periodic(10000, 30, 9000, ", cpus: [0]"), periodic(10000, 20, 9000, ", cpus: [1]")}, 2);
  ASSERT_TRUE(deployment.diagnostics.empty()) << deployment.diagnostics.to_text();
  EXPECT_EQ(deployment.schedule.threads[1].response, 9ms);
}

TEST(Schedule, ACpuThatTheMachineDoesNotHaveIsAWarning) {
  const Deployment deployment = sources({periodic(10000, 30, 1000, ", cpus: [1, 2]")}, 2);
  EXPECT_TRUE(deployment.ok());
  EXPECT_EQ(deployment.diagnostics.to_text(),
            "app.yaml:2:3: warning: thread 'T0' is to run on CPU 2, but this machine has CPUs 0 to "
            "1 [missing_cpu]\n");
}

TEST(Schedule, AsManyThreadsAsCpusDoNotWait) {
  const Deployment deployment = sources({periodic(10000, 30, 9000), periodic(10000, 20, 9000)}, 2);
  ASSERT_TRUE(deployment.diagnostics.empty()) << deployment.diagnostics.to_text();
  EXPECT_EQ(deployment.schedule.threads[1].response, 9ms);
}

TEST(Schedule, WhereOnlyABoundIsKnownItIsAWarning) {
  const Deployment deployment =
      sources({periodic(10000, 30, 6000), periodic(10000, 25, 6000), periodic(10000, 20, 6000)}, 2);
  EXPECT_TRUE(deployment.ok());
  EXPECT_THAT(deployment.diagnostics.to_text(),
              HasSubstr("app.yaml:4:3: warning: thread 'T2' (priority 20) answers within"));
}

TEST(Schedule, OrdinaryThreadsNeedTheirShareOfTheMachineButWaitForNobodyInParticular) {
  const Deployment deployment =
      sources({periodic(10000, 30, 5000), "periodic: 10 ms, budget: 4 ms"});
  ASSERT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  EXPECT_EQ(deployment.schedule.threads[0].response, 5ms);
  EXPECT_EQ(deployment.schedule.threads[1].response, 0ms);
  EXPECT_FALSE(sources({periodic(10000, 30, 5000), "periodic: 10 ms, budget: 6 ms"}).ok());
}

TEST(Schedule, TheKernelKeepsSomethingFromDeadlineThreads) {
  const std::string deadline = "periodic: 10 ms, scheduler: deadline, budget: ";
  EXPECT_TRUE(sources({deadline + "5 ms", deadline + "4.5 ms"}).ok());
  EXPECT_THAT(sources({deadline + "5 ms", deadline + "4.6 ms"}).diagnostics.to_text(),
              HasSubstr("scheduled by deadline on CPU 0 need 96.0 % of a CPU, but have 95.0 %"));
}

TEST(Schedule, AComponentsTimeCountsInTheThreadThatRunsIt) {
  const Deployment deployment = deploy(R"(
components:
  A: {model: Source, activity: {periodic: 10 ms, priority: 50, budget: 1 ms}}
  B: {model: Echo, activity: {sequential: true, budget: 2 ms}}
  C: {model: Echo, activity: {triggered: true, priority: 40, budget: 3 ms}}
connections:
  - A.Out -> B.In
  - B.Out -> C.In
)");
  ASSERT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  ASSERT_EQ(deployment.schedule.threads.size(), 2u);
  EXPECT_EQ(deployment.schedule.threads[0].cost, 3ms);
  EXPECT_EQ(deployment.schedule.threads[1].cost, 3ms);
  EXPECT_EQ(deployment.schedule.threads[1].period, 10ms);
}

ExecutionTimes some_times() {
  ExecutionTimes times;
  times.application = "demo";
  times.threads["T0"] = {1000, 1200us, 3ms};
  times.components["T0"] = {1000, 1100us, 3ms};
  times.components["arm.joint"] = {1000, 500ns, 1us};
  return times;
}

TEST(ExecutionTimes, TheFileReadsBackAsItWas) {
  base::Diagnostics diagnostics;
  const ExecutionTimes times = some_times();
  const ExecutionTimes back = parse_times(write_times(times), "times.yaml", diagnostics);
  EXPECT_TRUE(diagnostics.empty()) << diagnostics.to_text() << write_times(times);
  EXPECT_EQ(back.application, "demo");
  ASSERT_EQ(back.threads.size(), 1u);
  EXPECT_EQ(back.threads.at("T0").cycles, 1000u);
  EXPECT_EQ(back.threads.at("T0").p999, 1200us);
  EXPECT_EQ(back.threads.at("T0").most, 3ms);
  ASSERT_EQ(back.components.size(), 2u);
  EXPECT_EQ(back.components.at("arm.joint").p999, 500ns);
}

TEST(ExecutionTimes, MistakesInTheFileHaveTheirPlaces) {
  base::Diagnostics diagnostics;
  parse_times("threads:\n  A: {max: 1 ms}\n  B: {p999: 1 m}\n  C: 5\nthread: {}\n", "t.yaml",
              diagnostics);
  const std::string text = diagnostics.to_text();
  EXPECT_THAT(text, HasSubstr("t.yaml:2:3: error: execution time of 'A': it has no 'p999'"));
  EXPECT_THAT(text,
              HasSubstr("t.yaml:3:13: error: execution time of 'B': p999 must be a duration"));
  EXPECT_THAT(text, HasSubstr("t.yaml:4:6: error"));
  EXPECT_THAT(text, HasSubstr("t.yaml:5:1: error: execution times: unknown key 'thread' "
                              "(did you mean 'threads'?)"));
}

/// T0 with an activity, checked against `some_times`.
Schedule measured(const std::string& activity, base::Diagnostics& diagnostics,
                  const ExecutionTimes& times = some_times()) {
  const Deployment deployment = sources({activity, "periodic: 10 ms"});
  EXPECT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  return check_schedule(deployment.blueprint, deployment.plan, times, 1, diagnostics);
}

TEST(ExecutionTimes, MeasuredOnesAreUsedWhereNoneIsDeclared) {
  base::Diagnostics diagnostics;
  const Schedule schedule = measured("periodic: 10 ms", diagnostics);
  EXPECT_EQ(schedule.threads[0].source, ThreadLoad::Source::kMeasured);
  EXPECT_EQ(schedule.threads[0].cost, 1200us);
  EXPECT_EQ(schedule.threads[1].source, ThreadLoad::Source::kUnknown);
  EXPECT_THAT(diagnostics.to_text(),
              HasSubstr("note: the load of these threads is unknown and was not checked: T1"));
}

TEST(ExecutionTimes, ThoseOfComponentsAreUsedWhenTheyRunInOtherThreads) {
  base::Diagnostics diagnostics;
  ExecutionTimes times = some_times();
  times.threads.clear();
  EXPECT_EQ(measured("periodic: 10 ms", diagnostics, times).threads[0].cost, 1100us);
}

TEST(ExecutionTimes, ABudgetThatWasExceededIsAWarning) {
  base::Diagnostics diagnostics;
  const Schedule schedule = measured("periodic: 10 ms, budget: 1 ms", diagnostics);
  EXPECT_EQ(schedule.threads[0].source, ThreadLoad::Source::kDeclared);
  EXPECT_THAT(diagnostics.to_text(), HasSubstr("app.yaml:2:3: warning: thread 'T0' declares a "
                                               "budget of 1 ms, but took 1200 us"));
}

TEST(ExecutionTimes, NobodyIsToldWhatNobodyAskedFor) {
  const Deployment deployment = sources({"periodic: 10 ms"});
  EXPECT_TRUE(deployment.diagnostics.empty()) << deployment.diagnostics.to_text();
  EXPECT_THAT(deployment.schedule.to_text(), HasSubstr("?"));
}

TEST(ExecutionTimes, ThoseOfARunAreMeasured) {
  Deployment deployment = sources({"periodic: 1 ms"});
  deployment.options.simulated = true;
  deployment.options.measure_every = 1;
  exec::Application application(std::move(deployment.blueprint), deployment.options);
  ASSERT_TRUE(application.start().ok());
  application.run_for(100ms);
  const ExecutionTimes times = measured_times(application);
  ASSERT_EQ(times.components.count("T0"), 1u);
  EXPECT_GE(times.components.at("T0").cycles, 99u);
  EXPECT_GT(times.components.at("T0").p999, 0ns);
  EXPECT_LE(times.components.at("T0").p999, times.components.at("T0").most);
}

TEST(ExecutionTimes, AFileThatCannotBeReadIsAnError) {
  DeploymentOptions options;
  options.times_file = "/nowhere/times.yaml";
  EXPECT_THAT(deploy("application: x", options).diagnostics.to_text(),
              HasSubstr("cannot read '/nowhere/times.yaml'"));
}

TEST(LoadTable, ShowsEachThreadInColumns) {
  const Deployment deployment =
      sources({periodic(10000, 80, 120, ", cpus: [0]"), "periodic: 1 s"}, 2);
  EXPECT_EQ(deployment.schedule.to_text(),
            "thread  activity  scheduler    CPUs  period  time             load    answers within\n"
            "T0      periodic  realtime 80  0     10 ms   120 us declared  1.20 %  120 us\n"
            "T1      periodic  other        any   1 s     ?                ?       ?\n"
            "load: at least 1.20 % of one CPU, of 2\n"
            "not known for 1 thread: declare a budget, or measure (run --write-times F, then check "
            "--times F)\n");
}

}  // namespace
}  // namespace armature::deploy
