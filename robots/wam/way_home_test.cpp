// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/way_home.hpp"

#include <chrono>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/test_thread.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using component::Outcome;
using testing::DoubleEq;
using testing::ElementsAre;
using Angles = std::vector<double>;

/// Refuses what the test says, and ends what it began when the test says so.
class Generator : public component::Component {
 public:
  using Component::Component;
  component::Command<const Angles&, double> move_to{
      this, "moveTo", component::serve<&Generator::begin>, "notes how long it may take",
      component::args("positions", "time")};
  std::vector<double> times;
  std::vector<bool> refusals;

 private:
  Outcome begin(const Angles&, double time_s) {
    times.push_back(time_s);
    const bool refused = times.size() <= refusals.size() && refusals[times.size() - 1];
    return refused ? component::refused("not now") : component::accepted();
  }
};

class Arm : public component::Component {
 public:
  using Component::Component;
  WayHome::Generator generator{this, "moveTo", "moves the joints", component::optional};
};

class WayHomeTest : public testing::Test {
 protected:
  WayHomeTest() : thread_(arm_, generator_) {
    arm_.generator.connect(generator_.move_to);
    component::start(arm_, generator_);
  }
  WayHome::Arm at(base::Duration time) const { return {home_, positions_, base::Time(time)}; }

  const Angles home_{0.0, 0.0};
  const Angles positions_{0.3, 0.4};
  Generator generator_{"generator"};
  Arm arm_{"arm"};
  component::TestThread thread_;
  WayHome way_{arm_.generator};
};

TEST_F(WayHomeTest, TakesTwiceTheTimeThatItsMeanRateWouldNeed) {
  ASSERT_TRUE(way_.begin(at(0s)));
  EXPECT_THAT(generator_.times, ElementsAre(DoubleEq(2.0)));
  EXPECT_FALSE(way_.follow(at(1s)));
  generator_.move_to.complete();
  EXPECT_TRUE(way_.follow(at(2s)));
  EXPECT_TRUE(way_.done());
}

TEST_F(WayHomeTest, AShortWayIsAskedForInTheTimeThatTheLimitsDemand) {
  generator_.refusals = {true};
  ASSERT_TRUE(way_.begin(at(0s)));
  EXPECT_THAT(generator_.times, ElementsAre(DoubleEq(2.0), 0.0));
}

TEST_F(WayHomeTest, IsRefusedIfTheGeneratorRefusesBothWays) {
  generator_.refusals = {true, true};
  EXPECT_EQ(way_.begin(at(0s)).reason(), "not now");
}

TEST_F(WayHomeTest, HasAnEndIfTheMotionFails) {
  ASSERT_TRUE(way_.begin(at(0s)));
  generator_.move_to.fail("in the way");
  EXPECT_TRUE(way_.follow(at(1s)));
  EXPECT_FALSE(way_.done());
  EXPECT_EQ(way_.reason(), "in the way");
}

TEST(WayHome, IsRefusedWithoutAGenerator) {
  Arm arm("arm");
  WayHome way(arm.generator);
  const Angles home{0.0};
  EXPECT_EQ(way.begin({home, home, {}}).reason(), "it has no peer with a command moveTo");
}

}  // namespace
}  // namespace armature::wam
