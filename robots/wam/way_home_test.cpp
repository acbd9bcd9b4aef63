// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/way_home.hpp"

#include <array>
#include <chrono>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/face.hpp"
#include "armature/testing/test_thread.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using component::Outcome;
using testing::DoubleEq;
using testing::ElementsAre;
using Angles = std::vector<double>;

/// Refuses what the test says, and ends what it began when the test says so. One waits.
class Generator : public component::Component {
 public:
  using Component::Component;
  component::Command<const Angles&, double> move_to{this,
                                                    "moveTo",
                                                    component::serve<&Generator::begin>,
                                                    "notes how long it may take",
                                                    component::args("positions", "time"),
                                                    component::may_wait<&Generator::may_wait>(1)};
  std::vector<double> times;
  std::size_t refuses = 0;  ///< so many

 private:
  Outcome may_wait(const Angles&, double) const { return component::accepted(); }
  Outcome begin(const Angles&, double time_s) {
    times.push_back(time_s);
    return times.size() <= refuses ? component::refused("not now") : component::accepted();
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
    face(arm_.generator).connect(face(generator_.move_to));
    component::start(arm_, generator_);
  }
  void begin() {
    ASSERT_TRUE(way_.begin(at(0s)));
    thread_.deliver();
  }
  WayHome::Arm at(base::Duration time) const { return {home_, positions_, base::Time(time)}; }

  component::Outcome begin_motion(const Angles& to, double seconds) {
    const std::array<const void*, 2> places{&to, &seconds};
    return face(generator_.move_to).begin_from(nullptr, places.data());
  }

  const Angles home_{0.0, 0.0};
  const Angles positions_{0.3, 0.4};
  Generator generator_{"generator"};
  Arm arm_{"arm"};
  component::TestThread thread_;
  WayHome way_{arm_.generator};
};

TEST_F(WayHomeTest, TakesTwiceTheTimeThatItsMeanRateWouldNeed) {
  begin();
  EXPECT_THAT(generator_.times, ElementsAre(DoubleEq(2.0)));
  EXPECT_FALSE(way_.follow(at(1s)));
  generator_.move_to.complete();
  EXPECT_TRUE(way_.follow(at(2s)));
  EXPECT_TRUE(way_.done());
}

TEST_F(WayHomeTest, AShortWayIsAskedForInTheTimeThatTheLimitsDemand) {
  generator_.refuses = 1;
  begin();
  EXPECT_FALSE(way_.follow(at(2ms)));
  thread_.deliver();
  EXPECT_THAT(generator_.times, ElementsAre(DoubleEq(2.0), 0.0));
  EXPECT_FALSE(way_.follow(at(4ms))) << "it is under way";
}

TEST_F(WayHomeTest, IsAskedForAgainUntilWhatWentOnBeforeHasComeToRest) {
  generator_.refuses = 1000;
  begin();
  for (const base::Duration time : {2ms, 4ms, 1999ms}) {
    EXPECT_FALSE(way_.follow(at(time)));
    thread_.deliver();
  }
  EXPECT_THAT(generator_.times, ElementsAre(DoubleEq(2.0), 0.0, DoubleEq(2.0), 0.0));
  EXPECT_TRUE(way_.follow(at(2s)));
  EXPECT_FALSE(way_.done());
  EXPECT_EQ(way_.reason(), "not now");
}

/// Its time is that from where the arm is now, not from where another motion ends.
TEST_F(WayHomeTest, WaitsForNoOtherMotionAndIsAskedForAgainUntilThatIsOver) {
  ASSERT_TRUE(begin_motion(home_, 7.0));
  begin();
  for (const base::Duration time : {2ms, 4ms}) {
    EXPECT_FALSE(way_.follow(at(time)));
    thread_.deliver();
    EXPECT_EQ(generator_.move_to.waiting(), 0u);
    EXPECT_FALSE(way_.follow(at(time + 1ms)));
    thread_.deliver();
    EXPECT_EQ(generator_.move_to.waiting(), 1u);
  }
  EXPECT_THAT(generator_.times, ElementsAre(7.0));
  EXPECT_FALSE(way_.follow(at(6ms)));
  thread_.deliver();
  generator_.move_to.complete();
  EXPECT_FALSE(way_.follow(at(8ms)));
  thread_.deliver();
  EXPECT_THAT(generator_.times, ElementsAre(7.0, DoubleEq(2.0)));
  EXPECT_FALSE(way_.follow(at(10ms))) << "it is under way";
}

TEST_F(WayHomeTest, EndsIfAnotherMotionTakesTooLong) {
  ASSERT_TRUE(begin_motion(home_, 7.0));
  begin();
  EXPECT_FALSE(way_.follow(at(2s)));
  thread_.deliver();
  EXPECT_TRUE(way_.follow(at(2s + 2ms)));
  EXPECT_FALSE(way_.done());
  EXPECT_EQ(way_.reason(), "another motion is under way");
  EXPECT_EQ(generator_.move_to.waiting(), 0u) << "it does not begin later";
}

TEST_F(WayHomeTest, HasAnEndIfTheMotionFails) {
  begin();
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
