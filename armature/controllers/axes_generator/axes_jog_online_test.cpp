// SPDX-License-Identifier: Apache-2.0
// The online generator's axis moves while it is held on to, and no faster than a peer allows; in
// simulated cycles of 10 ms, at each of which the limits of the axes are looked at.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/controllers/internal/test_online_generator.hpp"

namespace armature::controllers {
namespace {

using component::CommandStage;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class JoggedOnline : public OnlineGenerator {
 protected:
  JoggedOnline() { start_at({0.25, 0.5}); }
  std::string refusal_of_jog(int axis, double speed) {
    const auto answer = generator.call("jog", axis, speed);
    return answer ? "accepted" : answer.error();
  }
  bool renew(int axis, double speed) {
    return generator.call<bool>("keepJogging", axis, speed).value();
  }
  void hold(int cycles, int axis, double speed) {
    for (int i = 0; i < cycles; ++i) {
      EXPECT_TRUE(renew(axis, speed));
      cycle();
    }
  }
};

TEST_F(JoggedOnline, MovesItsAxisAtTheVelocityAsLongAsItIsRenewed) {
  auto jog = generator.send("jog", 2, -0.2);
  hold(30, 2, -0.2);
  for (int i = 0; i < 100; ++i) {
    hold(1, 2, -0.2);
    EXPECT_NEAR(velocity()[1], -0.2, 1e-9) << "it is there after 0.2 s: V / A + A / J";
  }
  EXPECT_EQ(jog.stage(), CommandStage::kAccepted);
  EXPECT_EQ(desired()[0], 0.25);
}

TEST_F(JoggedOnline, Brakes150MsAfterTheLastRenewal) {
  auto jog = generator.send("jog", 1, 0.2);
  hold(40, 1, 0.2);
  cycle(14);  // the last renewal came before the last cycle of `hold`
  EXPECT_NEAR(velocity()[0], 0.2, 1e-9);
  cycle(2);
  EXPECT_LT(acceleration()[0], 0.0) << "it brakes";
  for (int i = 0; i < 10; ++i) {
    EXPECT_FALSE(renew(1, 0.2)) << "what comes late";
    cycle();
  }
  cycle(20);
  EXPECT_EQ(jog.stage(), CommandStage::kDone);
  EXPECT_THAT(velocity(), Each(0.0));
  EXPECT_FALSE(renew(1, 0.2));
}

TEST_F(JoggedOnline, ARenewalIsForItsOwnJogOnly) {
  auto jog = generator.send("jog", 1, 0.2);
  for (int i = 0; i < 40; ++i) {
    EXPECT_FALSE(renew(2, 0.2));
    EXPECT_FALSE(renew(1, -0.2));
    cycle();
  }
  EXPECT_EQ(jog.stage(), CommandStage::kDone);
  EXPECT_LT(desired()[0], 0.25 + 0.2 * 0.15 + 0.02);
}

TEST_F(JoggedOnline, EndsAtTheLimitOfItsAxis) {
  auto jog = generator.send("jog", 1, -1.0);
  for (int i = 0; i < 300 && jog.stage() == CommandStage::kAccepted; ++i) {
    renew(1, -1.0);
    cycle();
  }
  EXPECT_EQ(jog.stage(), CommandStage::kDone);
  EXPECT_EQ(desired()[0], -0.5);
  EXPECT_EQ(refusal_of_jog(1, -0.1), "axis 1: the axis is at its limit");
  EXPECT_EQ(refusal_of_jog(1, 0.1), "accepted");
}

TEST_F(JoggedOnline, BeginsWhileTheAxesBrake) {
  auto motion = generator.send("moveTo", Vector{4.0, 4.0}, 0.0);
  cycle(100);
  EXPECT_EQ(refusal_of_jog(1, 0.3), "moveTo is under way: cancel it first");
  motion.cancel();
  cycle(5);
  ASSERT_GT(velocity()[0], 0.5);
  auto jog = generator.send("jog", 1, -0.3);
  hold(200, 1, -0.3);
  EXPECT_EQ(jog.stage(), CommandStage::kAccepted);
  EXPECT_NEAR(velocity()[0], -0.3, 1e-9);
  EXPECT_EQ(velocity()[1], 0.0) << "the other came to rest";
  EXPECT_EQ(refusal_of({1.0, 1.0}, 0.0), "a jog is under way: let go of it first");
  jog.cancel();
  cycle(40);
  EXPECT_THAT(velocity(), Each(0.0));
  EXPECT_EQ(refusal_of({1.0, 1.0}, 0.0), "accepted");
}

TEST_F(JoggedOnline, StopAndDisarmEndIt) {
  auto jog = generator.send("jog", 1, 0.5);
  hold(40, 1, 0.5);
  generator.raise("Stop");
  cycle(60);
  EXPECT_EQ(jog.stage(), CommandStage::kFailed);
  EXPECT_THAT(velocity(), Each(0.0));
}

TEST_F(JoggedOnline, RefusesWhatCannotBeWithTheReason) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal_of_jog(0, 0.1), "axis 0: expected 1 to 2");
  EXPECT_EQ(refusal_of_jog(3, 0.1), "axis 3: expected 1 to 2");
  EXPECT_EQ(
      refusal_of_jog(1, 1.1),
      "axis 1: the motion is faster than the limits allow: 1.1 rad/s, expected at most 1 rad/s");
  EXPECT_EQ(refusal_of_jog(1, kNan), "axis 1: a number is not finite: nan");
  EXPECT_EQ(refusal_of_jog(2, 0.0), "axis 2: the velocity is 0");
  cycle(10);
  EXPECT_THAT(desired(), ElementsAre(0.25, 0.5));
}

/// A peer that allows the fastest axis half of its velocity, of which motions leave a tenth.
class OnlineWithALimitOfAPeer : public OnlineGenerator {
 protected:
  OnlineWithALimitOfAPeer() {
    generator.serve<double(const Vector&, const Vector&)>(
        "motionLimitUsed", [](const Vector&, const Vector& velocities) {
          return 2.0 * std::max(std::abs(velocities[0]), std::abs(velocities[1]));
        });
    start_at({0.25, 0.5});
  }
};

TEST_F(OnlineWithALimitOfAPeer, MotionsKeepIt) {
  auto motion = generator.send("moveTo", Vector{2.25, 1.0}, 0.0);
  double fastest = 0.0;
  int cycles = 0;
  for (; motion.stage() == CommandStage::kAccepted && cycles < 1000; ++cycles) {
    cycle();
    fastest = std::max(fastest, std::abs(velocity()[0]));
  }
  EXPECT_EQ(motion.stage(), CommandStage::kDone);
  EXPECT_LE(fastest, 0.45 + 1e-9);
  EXPECT_GE(fastest, 0.44) << "and use it";
  EXPECT_LE(cycles, 486) << "X / V + V / A + A / J is 4.77 s";
}

TEST_F(OnlineWithALimitOfAPeer, AskedForATimeThatIsTooShortItSaysTheShortest) {
  EXPECT_THAT(refusal_of({2.25, 1.0}, 4.0), HasSubstr("it takes 4.7"));
  EXPECT_EQ(refusal_of({2.25, 1.0}, 5.0), "accepted");
}

TEST_F(OnlineWithALimitOfAPeer, JogsKeepIt) {
  const auto answer = generator.call("jog", 1, 0.8);
  ASSERT_FALSE(answer);
  EXPECT_THAT(answer.error(), HasSubstr("0.8 rad/s, expected at most 0.45"));
  EXPECT_TRUE(generator.call("jog", 1, 0.45));
}

TEST_F(OnlineWithALimitOfAPeer, ReferencesAreFollowedWithinIt) {
  generator.write("nAxesReferencePosition", Vector{0.25, 0.5});
  auto follow = generator.send("follow");
  double fastest = 0.0;
  for (int i = 0; i < 900; ++i) {
    generator.write("nAxesReferencePosition", Vector{i < 400 ? 3.0 : 1.0, i < 500 ? 1.0 : 3.0});
    cycle();
    fastest = std::max({fastest, std::abs(velocity()[0]), std::abs(velocity()[1])});
  }
  EXPECT_LE(fastest, 0.45 + 1e-3);
  EXPECT_GE(fastest, 0.44);
  EXPECT_EQ(generator.get<int>("refused_references"), 0);
}

}  // namespace
}  // namespace armature::controllers
