// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/application/health.hpp"

#include <gtest/gtest.h>

#include "armature/component/host.hpp"
#include "armature/exec/internal/application/test_parts.hpp"

namespace armature::exec::internal {
namespace {

class HealthTest : public ::testing::Test {
 protected:
  HealthTest() { health().begin_to_run(); }

  static Blueprint two_threads() {
    Blueprint blueprint;
    blueprint.add<Counter>("A", Activity::periodic(10ms));
    blueprint.add<Counter>("B", Activity::periodic(10ms));
    return blueprint;
  }
  Health& health() { return parts_.health; }

  PlannedParts parts_{two_threads()};
};

TEST_F(HealthTest, AFaultEndsTheRunOnlyIfAllStopsForIt) {
  EXPECT_TRUE(health().in_good_order());
  EXPECT_EQ(health().end_by_fault(OnFault::kStopAll), std::nullopt);
  health().incidents().component_faulted(parts_.component(0));
  EXPECT_FALSE(health().in_good_order());
  EXPECT_EQ(health().end_by_fault(OnFault::kStopDependents), std::nullopt);
  EXPECT_EQ(health().end_by_fault(OnFault::kStopAll), RunEnd::kFaulted);
}

TEST_F(HealthTest, AReactionEndsItAsSuch) {
  health().incidents().component_stopped_itself(parts_.component(0));
  EXPECT_FALSE(health().in_good_order());
  EXPECT_EQ(health().end_by_fault(OnFault::kStopAll), RunEnd::kStoppedByReaction);
}

TEST_F(HealthTest, WhatBefallsAShadowIsNoIncidentButHasItsBlackBox) {
  parts_.blueprint.components[0].shadow = true;
  health().begin_anew(parts_.blueprint);
  health().incidents().component_faulted(parts_.component(0));
  health().incidents().component_stopped_itself(parts_.component(0));
  EXPECT_TRUE(health().in_good_order());
  EXPECT_EQ(health().incidents().faults(), 0u) << "of which the exit code tells";
  EXPECT_EQ(health().incidents().first(), &parts_.component(0));
  health().incidents().component_stopped_itself(parts_.component(1));
  EXPECT_FALSE(health().in_good_order());
}

TEST_F(HealthTest, WhoLeavesRunsOnAfterAFaultUntilTheNextStart) {
  health().incidents().component_faulted(parts_.component(0));
  health().begin_to_leave();
  EXPECT_EQ(health().end_by_fault(OnFault::kStopAll), std::nullopt);
  EXPECT_TRUE(health().end_of_run());
  EXPECT_FALSE(health().end_of_run()) << "it does not run any more";
  health().begin_anew(parts_.blueprint);
  health().begin_to_run();
  EXPECT_TRUE(health().in_good_order());
  health().incidents().component_faulted(parts_.component(0));
  EXPECT_EQ(health().end_by_fault(OnFault::kStopAll), RunEnd::kFaulted);
}

TEST_F(HealthTest, ADeathEndsTheRunWhateverFaultsMeanAndTakesItsThreadOutOfService) {
  ASSERT_TRUE(component::Host::configure(parts_.component(0)));
  ASSERT_TRUE(component::Host::activate(parts_.component(0)));
  ASSERT_TRUE(component::Host::start(parts_.component(0)));
  health().begin_to_leave();
  parts_.death_notice.send(&component::Host::context(parts_.component(0)), "it divided by nothing");
  EXPECT_TRUE(parts_.death_notice.is_about(component::Host::context(parts_.component(0))));
  EXPECT_FALSE(parts_.death_notice.is_about(component::Host::context(parts_.component(1))));
  health().take_leave_of_the_dead(parts_.engines);
  EXPECT_TRUE(health().died());
  EXPECT_TRUE(health().hangs());
  EXPECT_EQ(health().end_by_fault(OnFault::kKeepRunning), RunEnd::kFaulted);
  EXPECT_TRUE(parts_.unreachable.includes(parts_.component(0)));
  EXPECT_FALSE(parts_.unreachable.includes(parts_.component(1)));
  EXPECT_EQ(parts_.component(0).reason(), "it divided by nothing");
  EXPECT_FALSE(parts_.death_notice.is_about(component::Host::context(parts_.component(0))))
      << "it was taken";
}

TEST_F(HealthTest, TheDeathOfAThreadThatRunsNoComponentEndsTheRunToo) {
  parts_.death_notice.send(nullptr, "the stack overflowed");
  health().take_leave_of_the_dead(parts_.engines);
  EXPECT_TRUE(health().hangs());
  EXPECT_FALSE(parts_.unreachable.any());
}

TEST_F(HealthTest, AComponentThatHangsAloneLeavesItsThreadToTheOthers) {
  parts_.unreachable.give_up(parts_.component(0));
  EXPECT_TRUE(health().hangs());
  EXPECT_FALSE(health().died());
  EXPECT_TRUE(parts_.unreachable.includes(parts_.component(0)));
  EXPECT_FALSE(parts_.unreachable.includes(component::Host::context(parts_.component(0))));
}

}  // namespace
}  // namespace armature::exec::internal
