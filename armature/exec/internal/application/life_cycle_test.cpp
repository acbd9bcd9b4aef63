// SPDX-License-Identifier: Apache-2.0
// How components come up and go down, in threads that do not run; what hangs is in
// application_hang_test.cpp.
#include "armature/exec/internal/application/life_cycle.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/waits_for_operator.hpp"
#include "armature/exec/internal/application/test_parts.hpp"

namespace armature::exec::internal {
namespace {

using component::State;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

class LifeCycleTest : public ::testing::Test {
 protected:
  LifeCycleTest() {
    for (std::size_t i = 0; i < 3; ++i) probe(i).journal = &journal_;
  }
  /// A -> B -> C.
  static Blueprint chain() {
    Blueprint blueprint;
    for (const char* name : {"A", "B", "C"}) blueprint.add<Probe>(name, Activity::periodic(10ms));
    blueprint.connect("A.Out", "B.Look");
    blueprint.connect("B.Out", "C.Look");
    return blueprint;
  }
  Probe& probe(std::size_t place) { return static_cast<Probe&>(parts_.component(place)); }
  std::string text() { return diagnostics_.to_text(); }

  PlannedParts parts_{chain()};
  const ApplicationOptions options_ = patient(true);
  Threads threads_{options_, parts_.plan, parts_.engines, parts_.unreachable};
  LifeCycle life_cycle_{
      options_,           parts_.blueprint,       parts_.plan, parts_.roster, threads_,
      parts_.unreachable, std::function<void()>()};
  Journal journal_;
  base::Diagnostics diagnostics_;
};

TEST_F(LifeCycleTest, AllBeginToServeBeforeTheFirstStartsAndStopInReverse) {
  EXPECT_TRUE(life_cycle_.configure(diagnostics_));
  EXPECT_THAT(journal_.take(), ElementsAre("A configure", "B configure", "C configure"));
  EXPECT_TRUE(life_cycle_.start(diagnostics_));
  EXPECT_THAT(journal_.take(), ElementsAre("A activate", "B activate", "C activate", "A start",
                                           "B start", "C start"));
  life_cycle_.stop(diagnostics_);
  EXPECT_THAT(journal_.take(), ElementsAre("C stop", "B stop", "A stop"));
  life_cycle_.clean_up(diagnostics_);
  EXPECT_THAT(journal_.take(), ElementsAre("C cleanup", "B cleanup", "A cleanup"));
  EXPECT_EQ(text(), "");
  EXPECT_THAT(life_cycle_.casualties(), IsEmpty());
}

TEST_F(LifeCycleTest, AllRefusalsToConfigureAreNamed) {
  probe(0).refusals["configure"] = "no cable";
  probe(2).refusals["configure"] = "no power";
  EXPECT_FALSE(life_cycle_.configure(diagnostics_));
  EXPECT_EQ(text(),
            "error: 'A' refuses to configure: no cable\nerror: 'C' refuses to configure: no "
            "power\n");
}

TEST_F(LifeCycleTest, ARefusalToStartLeavesThoseAfterItAsTheyAre) {
  probe(1).refusals["start"] = "too cold";
  ASSERT_TRUE(life_cycle_.configure(diagnostics_));
  EXPECT_FALSE(life_cycle_.start(diagnostics_));
  EXPECT_EQ(text(), "error: 'B' refuses to start: too cold\n");
  EXPECT_EQ(probe(0).state(), State::kRunning);
  EXPECT_EQ(probe(2).state(), State::kStopped);
}

TEST_F(LifeCycleTest, WhoHasFaultedIsACasualty) {
  ASSERT_TRUE(life_cycle_.configure(diagnostics_));
  ASSERT_TRUE(life_cycle_.start(diagnostics_));
  parts_.engine_of(0).fault_members("too hot");
  ASSERT_EQ(life_cycle_.casualties().size(), 1u);
  EXPECT_EQ(life_cycle_.casualties()[0].component, "A");
  EXPECT_EQ(life_cycle_.casualties()[0].reason, "too hot");
}

TEST_F(LifeCycleTest, NobodyCleansUpWhatHangsWhichIsACasualtyToo) {
  ASSERT_TRUE(life_cycle_.configure(diagnostics_));
  parts_.unreachable.give_up(probe(1));
  journal_.take();
  life_cycle_.clean_up(diagnostics_);
  EXPECT_THAT(journal_.take(), ElementsAre("C cleanup", "A cleanup"));
  ASSERT_EQ(life_cycle_.casualties().size(), 1u);
  EXPECT_EQ(life_cycle_.casualties()[0].reason, "its thread hangs");
}

/// Is configured once a person has walked to it.
class Patient final : public component::Component, public component::WaitsForOperator {
 public:
  using Component::Component;
  base::Duration operators_patience() const override { return 300s; }
};

TEST(HookPatience, OfWhatWaitsForItsOperatorIsLongerByThat) {
  const Patient patient("Patient");
  const component::Component other("Other");
  HookPatience patience{.limit = 10s, .meanwhile = {}, .operators_too = true};
  EXPECT_EQ(patience.limit_of(patient), 310s);
  EXPECT_EQ(patience.limit_of(other), 10s);
  patience.limit = base::Duration::max();
  EXPECT_EQ(patience.limit_of(patient), base::Duration::max()) << "for ever";
}

TEST(HookPatience, OnTheWayDownNobodyIsWaitedFor) {
  const Patient patient("Patient");
  const HookPatience patience{.limit = 10s, .meanwhile = {}};
  EXPECT_EQ(patience.limit_of(patient), 10s);
}

}  // namespace
}  // namespace armature::exec::internal
