// SPDX-License-Identifier: Apache-2.0
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/check.hpp"
#include "armature/component/checking/check_of_threads.hpp"
#include "armature/component/face.hpp"
#include "armature/exec/internal/test_components.hpp"

namespace armature::exec {
namespace {

using component::Check;
using testing::ElementsAre;

/// Has a test check.
class Checking final : public component::Component {
 public:
  using Component::Component;
  std::function<void(Check&)> look;
  component::InputPort<double> in{this, "In", "of anybody", "rad", component::may_stay_open};
  component::OutputPort<double> out{this, "Out", "to anybody", "rad"};
  component::OperationCaller<double(double)> scale{this, "scale", "of a peer", component::optional};
  component::EventHandler<std::int64_t> tick{this, "Tick", component::serve<&Checking::on_tick>,
                                             "of a peer", component::optional};

 private:
  void on_check(Check& check) const override {
    if (look) look(check);
  }
  void on_tick(std::int64_t) {}
};

/// A part that finds every number but one wrong.
class Part final : public component::Checked {
 public:
  explicit Part(component::Component* owner) : Checked(owner) {}
  void check(Check& check) const override {
    if (number != 7) check.error("is " + std::to_string(number), "make it 7");
  }
  int number = 0;
};

TEST(PlanChecks, WhatAComponentFindsWrongIsAMistakeAtItsPlace) {
  Blueprint blueprint;
  blueprint.add<Checking>("C").look = [](Check& check) {
    check.error("shakes", "hold it");
    check.warning("is odd");
  };
  blueprint.components.back().where = {"arm.yaml", 3, 5};
  EXPECT_EQ(problems_of(blueprint),
            "arm.yaml:3:5: error: 'C': shakes (hold it)\n"
            "arm.yaml:3:5: warning: 'C': is odd\n");
}

TEST(PlanChecks, SoIsWhatAPartOfItFinds) {
  Blueprint blueprint;
  Part part(&blueprint.add<Sink>("S"));
  blueprint.connect("Counter.Count", "S.In");
  blueprint.add<Counter>("Counter", Activity::periodic(1ms));
  EXPECT_EQ(problems_of(blueprint), "error: 'S': is 0 (make it 7)\n");
  part.number = 7;
  EXPECT_EQ(problems_of(blueprint), "");
}

TEST(PlanChecks, AComponentSeesItsPeriodPeersAndWiring) {
  Blueprint blueprint;
  const Counter& counter = blueprint.add<Counter>("Counter", Activity::periodic(2ms));
  Checking& checking = blueprint.add<Checking>("Checking");
  const Gain& gain = blueprint.add<Gain>("Gain");
  blueprint.connect("Counter.Count", "Checking.In");
  blueprint.connect("Checking.Out", "Gain.In");
  blueprint.add_peer("Checking", "Gain");
  blueprint.add_peer("Checking", "Counter");
  int looks = 0;
  checking.look = [&](Check& check) {
    ++looks;
    EXPECT_EQ(checking.period(), 2ms);
    EXPECT_EQ(check.components().size(), 3U);
    EXPECT_THAT(check.peers(), ElementsAre(&gain, &counter));
    EXPECT_THAT(check.writers_of(checking.in), ElementsAre(&face(counter.count)));
    EXPECT_THAT(check.readers_of(checking.out), ElementsAre(&face(gain.in)));
    EXPECT_THAT(check.writers_of(gain.in), ElementsAre(&face(checking.out)));
    EXPECT_EQ(check.target_of(checking.scale), &face(gain.scale));
    EXPECT_EQ(check.source_of(checking.tick), &face(counter.tick));
  };
  EXPECT_EQ(problems_of(blueprint), "");
  EXPECT_EQ(looks, 1);
}

TEST(PlanChecks, WhatIsNotConnectedIsSeenAsSuch) {
  Blueprint blueprint;
  Checking& checking = blueprint.add<Checking>("Checking");
  checking.look = [&](Check& check) {
    EXPECT_TRUE(check.peers().empty());
    EXPECT_TRUE(check.writers_of(checking.in).empty());
    EXPECT_TRUE(check.readers_of(checking.out).empty());
    EXPECT_EQ(check.target_of(checking.scale), nullptr);
    EXPECT_EQ(check.source_of(checking.tick), nullptr);
  };
  EXPECT_EQ(problems_of(blueprint), "");
}

TEST(PlanChecks, ThePlanKnowsWhoDrivesHardware) {
  Blueprint blueprint;
  Checking& checking = blueprint.add<Checking>("C");
  checking.look = [](Check& check) { check.drives_hardware("can0"); };
  base::Diagnostics diagnostics;
  const Plan plan = make_plan(blueprint, diagnostics);
  ASSERT_EQ(plan.hardware.size(), 1U);
  EXPECT_EQ(plan.hardware[0].component, &checking);
  EXPECT_EQ(plan.hardware[0].bus, "can0");
}

TEST(PlanChecks, AComponentKnowsWhatItsThreadIs) {
  Blueprint blueprint;
  const Counter& slow = blueprint.add<Counter>("Slow", Activity::periodic(10ms));
  const auto look = [&](bool real_time) {
    return [&slow, real_time](Check& check) {
      const auto* threads = component::CheckOfThreads::of(check);
      ASSERT_NE(threads, nullptr);
      EXPECT_EQ(threads->is_real_time(), real_time);
      EXPECT_FALSE(threads->shares_thread_with(slow));
    };
  };
  blueprint.add<Checking>("Other", Activity::periodic(10ms)).look = look(false);
  Activity urgent = Activity::periodic(2ms, 80);
  urgent.scheduler = Activity::Scheduler::kRealtime;
  blueprint.add<Checking>("Urgent", urgent).look = look(true);
  urgent.scheduler = Activity::Scheduler::kDeadline;
  urgent.priority = 0;
  urgent.budget = 200us;
  blueprint.add<Checking>("Deadline", urgent).look = look(true);
  Activity together = Activity::periodic(10ms);
  together.thread = "shared";
  const Checking& one = blueprint.add<Checking>("One", together);
  blueprint.add<Checking>("Two", together).look = [&one](Check& check) {
    EXPECT_TRUE(component::CheckOfThreads::of(check)->shares_thread_with(one));
  };
  EXPECT_EQ(problems_of(blueprint), "");
}

TEST(PlanChecks, AnExceptionIsAMistakeOfTheComponent) {
  Blueprint blueprint;
  blueprint.add<Checking>("C").look = [](Check&) { throw std::runtime_error("divided by 0"); };
  EXPECT_EQ(problems_of(blueprint), "error: 'C': its check failed: divided by 0\n");
}

TEST(PlanChecks, NobodyIsAskedAboutWiringThatNobodyMeant) {
  Blueprint blueprint;
  blueprint.add<Checking>("C").look = [](Check& check) { check.error("should not be asked"); };
  blueprint.connect("C.Out", "Nobody.In");
  const std::string problems = problems_of(blueprint);
  EXPECT_NE(problems, "");
  EXPECT_THAT(problems, testing::Not(testing::HasSubstr("should not be asked")));
}

TEST(PlanChecks, AnApplicationDoesNotStartWithWhatAComponentRefuses) {
  Blueprint blueprint;
  blueprint.add<Checking>("C").look = [](Check& check) { check.error("shakes"); };
  Application application(std::move(blueprint), patient(true));
  EXPECT_EQ(application.start().to_text(), "error: 'C': shakes\n");
  EXPECT_FALSE(application.running());
}

}  // namespace
}  // namespace armature::exec
