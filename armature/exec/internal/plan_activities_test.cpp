// SPDX-License-Identifier: Apache-2.0
// What activities may say, and which priorities fit together.
#include <string>

#include <gtest/gtest.h>

#include "armature/exec/internal/test_components.hpp"

namespace armature::exec {
namespace {

std::string problems_with(const Activity& activity) {
  Blueprint blueprint;
  blueprint.add<Probe>("A", activity);
  return problems_of(blueprint);
}

TEST(PlanActivities, APeriodIsAboveZero) {
  EXPECT_EQ(problems_with(Activity::periodic(0ms)),
            "error: the activity of 'A' needs a period above 0\n");
}

TEST(PlanActivities, RealTimePrioritiesAreOneToNinetyNine) {
  Activity activity = Activity::triggered(1);
  for (const int priority : {100, -5}) {
    activity.priority = priority;
    EXPECT_EQ(problems_with(activity), "error: the activity of 'A' has the priority " +
                                           std::to_string(priority) +
                                           "; real-time priorities are 1 .. 99, 99 most urgent\n");
  }
  for (const int priority : {1, 99}) {
    activity.priority = priority;
    EXPECT_EQ(problems_with(activity), "");
  }
}

TEST(PlanActivities, SchedulingInRealTimeNeedsAPriority) {
  Activity activity = Activity::periodic(10ms);
  activity.scheduler = Activity::Scheduler::kRealtime;
  EXPECT_EQ(problems_with(activity),
            "error: the activity of 'A' is scheduled in real time and needs a priority (give it "
            "one, priority: 1..99, 99 is the most urgent)\n");
}

TEST(PlanActivities, SchedulingByDeadlineNeedsAPeriodAndABudget) {
  Activity activity = Activity::triggered();
  activity.scheduler = Activity::Scheduler::kDeadline;
  EXPECT_EQ(problems_with(activity),
            "error: the activity of 'A' is scheduled by deadline but not periodic (give it a "
            "period, or the scheduler realtime with a priority)\n"
            "error: the activity of 'A' is scheduled by deadline and needs a budget (declare the "
            "execution time of a cycle: budget: 200 us)\n");
  activity = Activity::periodic(10ms);
  activity.scheduler = Activity::Scheduler::kDeadline;
  activity.budget = 1ms;
  EXPECT_EQ(problems_with(activity), "");
}

TEST(PlanActivities, ABudgetFitsIntoThePeriod) {
  Activity activity = Activity::periodic(1ms);
  activity.budget = 2ms;
  EXPECT_EQ(problems_with(activity),
            "error: the activity of 'A' has a budget above its period (give it a shorter budget or "
            "a longer period)\n");
}

TEST(PlanPriorities, AConsumerIsNotMoreUrgentThanItsProducer) {
  Blueprint blueprint;
  blueprint.add<Probe>("Producer", Activity::triggered(50));
  blueprint.add<Probe>("Consumer", Activity::triggered(60));
  blueprint.connect("Producer.Out", "Consumer.In");
  EXPECT_EQ(
      problems_of(blueprint),
      "warning: 'Consumer' (priority 60) is triggered by 'Producer' (priority 50) but is more "
      "urgent: it interrupts its producer [priority_inversion] (give the consumer at most the "
      "producer's "
      "priority)\n");
  for (const int priority : {50, 49}) {
    blueprint.components[1].activity.priority = priority;
    EXPECT_EQ(problems_of(blueprint), "");
  }
}

TEST(PlanPriorities, TheProducersThreadCountsAlsoIfItOnlyHostsTheProducer) {
  Blueprint blueprint;
  blueprint.add<Probe>("Host", Activity::triggered(50));
  blueprint.add<Probe>("Guest");
  blueprint.add<Probe>("Consumer", Activity::triggered(60));
  blueprint.connect("Host.Out", "Guest.In");
  blueprint.connect("Guest.Out", "Consumer.In");
  EXPECT_EQ(problems_of(blueprint),
            "warning: 'Consumer' (priority 60) is triggered by 'Guest' (priority 50) but is more "
            "urgent: it interrupts its producer [priority_inversion] (give the consumer at most "
            "the producer's "
            "priority)\n");
}

TEST(PlanPriorities, DataThatIsOnlyReadInvertsNothing) {
  Blueprint blueprint;
  blueprint.add<Probe>("Producer", Activity::triggered(50));
  blueprint.add<Probe>("Consumer", Activity::periodic(1ms, 60));
  blueprint.connect("Producer.Out", "Consumer.Look");
  EXPECT_EQ(problems_of(blueprint), "");
}

}  // namespace
}  // namespace armature::exec
