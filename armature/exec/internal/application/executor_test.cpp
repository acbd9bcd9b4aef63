// SPDX-License-Identifier: Apache-2.0
// The names of components, and the way to their threads.
#include "armature/exec/internal/application/executor.hpp"

#include <thread>

#include <gtest/gtest.h>

#include "armature/component/host.hpp"
#include "armature/exec/internal/application/test_parts.hpp"

namespace armature::exec::internal {
namespace {

Blueprint one_thread() {
  Blueprint blueprint;
  blueprint.add<Gain>("Gain", Activity::triggered());
  return blueprint;
}

TEST(Executor, WorkIsDoneHereWhileTheThreadDoesNotRunAtTheTimeOfTheApplication) {
  PlannedParts parts(one_thread());
  parts.clock.go_to(base::Time(5s));
  std::thread::id where;
  const component::Component* who = nullptr;
  component::Component& gain = parts.component(0);
  EXPECT_TRUE(parts.executor.run_in_thread_of(gain, [&] {
    where = std::this_thread::get_id();
    who = component::Host::context(gain).running();
  }));
  EXPECT_EQ(where, std::this_thread::get_id());
  EXPECT_EQ(who, &gain) << "it is known as the component's own work";
  EXPECT_EQ(gain.time(), base::Time(5s));
}

TEST(Executor, WorkIsDoneByTheThreadThatRuns) {
  PlannedParts parts(one_thread(), false);
  Engine& engine = parts.engine_of(0);
  engine.begin({});
  std::thread thread([&] { engine.serve(); });
  std::thread::id where;
  EXPECT_TRUE(parts.executor.run_in_thread_of(parts.component(0),
                                              [&] { where = std::this_thread::get_id(); }));
  EXPECT_EQ(where, thread.get_id());
  engine.end();
  thread.join();
}

TEST(Executor, ThereIsNoWayToAThreadThatHangs) {
  PlannedParts parts(one_thread());
  parts.unreachable.give_up(component::Host::context(parts.component(0)));
  bool done = false;
  EXPECT_FALSE(parts.executor.run_in_thread_of(parts.component(0), [&] { done = true; }));
  EXPECT_FALSE(done);
  EXPECT_EQ(not_answered(parts.component(0)), "the thread of 'Gain' did not answer in time");
}

TEST(Executor, NobodyWaitsLongerThanTheLimitNorForAThreadThatHasDied) {
  PlannedParts impatient(one_thread(), false, 1ms);
  impatient.engine_of(0).begin({});  // and nobody serves it
  EXPECT_FALSE(impatient.executor.run_in_thread_of(impatient.component(0), [] {}));
  PlannedParts mourning(one_thread(), false, 1000h);
  mourning.engine_of(0).begin({});
  mourning.death_notice.send(&component::Host::context(mourning.component(0)),
                             "it died of this work");
  EXPECT_FALSE(mourning.executor.run_in_thread_of(mourning.component(0), [] {}));
  impatient.engine_of(0).deliver_leftovers();  // what waits there is freed by who takes it
  mourning.engine_of(0).deliver_leftovers();
}

TEST(Roster, FindsComponentsByNameAndSaysWhichMayBeMeant) {
  PlannedParts parts(one_thread());
  EXPECT_EQ(parts.roster.find("Gain"), &parts.component(0));
  EXPECT_EQ(parts.roster.find("Grain"), nullptr);
  EXPECT_EQ(parts.roster.unknown("Gian"), "unknown component 'Gian' (did you mean 'Gain'?)");
  EXPECT_EQ(&parts.roster.entry_of(parts.component(0)), &parts.blueprint.components[0]);
}

}  // namespace
}  // namespace armature::exec::internal
