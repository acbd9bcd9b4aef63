// SPDX-License-Identifier: Apache-2.0
// The deployments that are tables 1 and 3 of paper 1, as OROCOS files, and the order of a cycle.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "tests/janus/experiment.hpp"

namespace armature::janus {
namespace {

using namespace std::chrono_literals;

/// The Reporter of the table records; what it writes is not looked at here.
const std::vector<std::string> kElsewhere = {"Reporter.file=" + ::testing::TempDir() +
                                             "armature_table_test"};

Figures run_table(const std::string& file, const std::vector<std::string>& overrides) {
  Robot robot(file, overrides);
  const Figures figures = run_experiment(robot);
  EXPECT_EQ(robot.application().faults(), 0u);
  EXPECT_EQ(robot.application().reactions(), 0u);
  EXPECT_EQ(robot.value<int>("Cards", "lost_answers"), 0);
  for (std::size_t i = 0; i < kJoints; ++i) {
    std::printf("%s: joint %zu: IAE %.7f largest %.7f rad\n", file.c_str(), i + 1,
                figures.joints[i].iae, figures.joints[i].largest);
  }
  return figures;
}

TEST(TableOne, PassesTheCheckWithoutAWarningThatItDoesNotAccept) {
  for (const char* file : {"orocos/table1.xml", "orocos/table3.xml"}) {
    const deploy::Deployment table = Robot::load(file, {});
    EXPECT_TRUE(table.ok()) << table.diagnostics.to_text();
    EXPECT_THAT(table.diagnostics.to_text(), ::testing::Not(::testing::HasSubstr("warning")));
  }
}

TEST(TableOne, HasItsModelsActivitiesPrioritiesAndPeriods) {
  struct Row {
    const char *name, *model;
    int priority;
    base::Duration period;
  };
  const deploy::Deployment table = Robot::load("orocos/table1.xml", {});
  EXPECT_EQ(table.document.priorities, document::Priorities::kRtai);
  for (const Row& row : std::vector<Row>{{"Sampler", "Sampler", 1, 10ms},
                                         {"aic01", "AIC", 0, 0ms},
                                         {"aic02", "AIC", 0, 0ms},
                                         {"Joint1", "Joint", 0, 0ms},
                                         {"Joint2", "Joint", 0, 0ms},
                                         {"Sensor", "Sensor2Mux", 2, 0ms},
                                         {"BridgeRef", "BridgeRef", 97, 0ms},
                                         {"Generator", "nAxisGenPos", 98, 10ms},
                                         {"Controller", "Controller2PID", 3, 0ms},
                                         {"pid1", "PID", 0, 0ms},
                                         {"pid2", "PID", 0, 0ms},
                                         {"Actuator", "Actuator2Demux", 3, 0ms},
                                         {"Reporter", "FileReporting", 100, 10ms},
                                         {"TaskBrowser", "TaskBrowser", 255, 0ms}}) {
    const auto found = std::ranges::find(table.document.components, std::string(row.name),
                                         &document::Component::name);
    ASSERT_NE(found, table.document.components.end()) << row.name;
    using Kind = document::Activity::Kind;
    const Kind kind = row.period > 0ms   ? Kind::kPeriodic
                      : row.priority > 0 ? Kind::kTriggered
                                         : Kind::kSequential;
    EXPECT_EQ(found->model, row.model) << row.name;
    EXPECT_EQ(found->activity.kind, kind) << row.name;
    EXPECT_EQ(found->activity.priority, row.priority) << row.name;
    if (row.period > 0ms) {
      EXPECT_EQ(found->activity.period, row.period) << row.name;
    }
  }
}

/// With the control in one thread, and Arming after Generator: the schedule of pid.yaml.
std::vector<std::string> in_one_thread() {
  std::vector<std::string> settings = kElsewhere;
  for (const char* one : {"Sensor", "Controller", "Actuator"}) {
    settings.push_back(std::string(one) + ".activity={sequential: true}");
  }
  settings.emplace_back("Arming.activity.priority=99");
  return settings;
}

TEST(TableOne, WithTheScheduleOfTheOtherDeploymentsHasTheSameFiguresToTheBit) {
  for (const auto& [table, other] : std::map<std::string, std::string>{
           {"orocos/table1.xml", "pid.yaml"}, {"orocos/table3.xml", "pid_feed_forward.yaml"}}) {
    const Figures first = run_table(table, in_one_thread());
    const Figures second = run_table(other, {});
    for (std::size_t i = 0; i < kJoints; ++i) {
      EXPECT_EQ(first.joints[i].iae, second.joints[i].iae) << table << ", joint " << i + 1;
      EXPECT_EQ(first.joints[i].itae, second.joints[i].itae) << table << ", joint " << i + 1;
      EXPECT_EQ(first.joints[i].ise, second.joints[i].ise) << table << ", joint " << i + 1;
      EXPECT_EQ(first.joints[i].itse, second.joints[i].itse) << table << ", joint " << i + 1;
      EXPECT_EQ(first.joints[i].largest, second.joints[i].largest) << table << ", joint " << i + 1;
    }
  }
}

// With the threads of the table a joint looks whether its voltage has settled before the Act of
// that sample, not after it: it is let go one sample later, and hangs elsewhere by a few counts.
TEST(TableOne, WithItsOwnThreadsReachesTheFiguresOfThePaper) {
  const Figures pid = run_table("orocos/table1.xml", kElsewhere);
  const Figures both = run_table("orocos/table3.xml", kElsewhere);
  for (std::size_t i = 0; i < kJoints; ++i) {
    EXPECT_LE(pid.joints[i].largest, 0.01) << "joint " << i + 1;
    EXPECT_LE(pid.joints[i].iae, 0.0213) << "joint " << i + 1;
    EXPECT_LE(both.joints[i].iae, 0.1 * pid.joints[i].iae) << "joint " << i + 1;
  }
}

/// Who of figure 20 ran in the cycle at 500 ms, in order.
std::vector<std::string> cycle_of(const std::string& file,
                                  const std::vector<std::string>& overrides) {
  constexpr base::Time kCycle = base::Time{} + 500ms;
  std::vector<std::string> order;
  Robot robot(file, overrides, [&](exec::ApplicationOptions& options) {
    options.timeline.share = 1e6;  // every step
    options.timeline.sink = [&](const exec::TimelineSlice& slice) {
      const bool step = slice.kind == exec::TimelineSlice::Kind::kStep;
      if (!step || slice.cycle_time != kCycle) return;
      const std::string name(slice.component);
      const std::vector<std::string> figure = {"Joint1", "Joint2", "Sensor", "Controller",
                                               "Actuator"};
      const bool shown = std::ranges::find(figure, name) != figure.end();
      if (shown && (order.empty() || order.back() != name)) order.push_back(name);
    };
  });
  robot.start_armed();
  robot.run_for(2s);
  robot.application().stop();
  return order;
}

/// Figure 20: both joints measure, then Sensor, Controller and Actuator compute, then both joints
/// actuate. Before the first joint measures, components may note that a Sample came; a joint whose
/// write others answer goes on after them.
void expect_order_of_figure_20(const std::vector<std::string>& order) {
  SCOPED_TRACE(::testing::PrintToString(order));
  const auto first = std::find(order.begin(), order.end(), "Joint1");
  const auto second = std::find(first, order.end(), "Joint2");
  ASSERT_NE(second, order.end());
  EXPECT_EQ(std::count(first, second, "Controller"), 0) << "before both joints were measured";
  EXPECT_EQ(std::count(first, second, "Actuator"), 0) << "before both joints were measured";
  std::vector<std::string> then;
  for (auto at = second + 1; at != order.end(); ++at) {
    if (*at != "Joint2" && std::ranges::find(then, *at) == then.end()) then.push_back(*at);
  }
  EXPECT_THAT(then, ::testing::ElementsAre("Sensor", "Controller", "Actuator", "Joint1"));
  const auto drives = std::find(second, order.end(), "Actuator");
  EXPECT_NE(std::find(drives, order.end(), "Joint2"), order.end()) << "it actuates, too";
}

TEST(Cycle, HasTheOrderOfFigureTwentyWithTheThreadsOfTableOne) {
  expect_order_of_figure_20(cycle_of("orocos/table1.xml", kElsewhere));
}

TEST(Cycle, HasTheOrderOfFigureTwentyInOneThread) {
  expect_order_of_figure_20(cycle_of("pid.yaml", {}));
}

TEST(TableOne, RefusesAnotherNumberOfJointsThanThatInTheNameOfAModel) {
  const deploy::Deployment table = Robot::load("orocos/table1.xml", {"Sensor.joints=3"});
  EXPECT_FALSE(table.ok());
  EXPECT_THAT(table.diagnostics.to_text(),
              ::testing::HasSubstr(
                  "'Sensor' has joints 2 by its model 'Sensor2Mux', found '3' (leave out joints"));
}

}  // namespace
}  // namespace armature::janus
