// SPDX-License-Identifier: Apache-2.0
#include "armature/report/velocity.hpp"

#include <gmock/gmock.h>

namespace armature::report {
namespace {

using ::testing::ElementsAre;

Signal signal(const std::string& name, const std::vector<double>& values) {
  Signal made{name, "", "", {}, values};
  for (std::size_t i = 0; i < values.size(); ++i) {
    made.time_s.push_back(0.5 * static_cast<double>(i));
  }
  return made;
}

Joint joint(const std::string& name, const std::vector<double>& desired,
            const std::vector<double>& measured) {
  Joint made;
  made.name = name;
  made.desired = desired;
  made.measured = measured;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    made.time_s.push_back(0.5 * static_cast<double>(i));
  }
  return made;
}

/// A vector of that many elements; each has its index as its value, twice.
void add_vector(const std::string& name, int size, Signals& signals) {
  for (int i = 0; i < size; ++i) {
    const auto value = static_cast<double>(i);
    signals.all.push_back(signal(name + '[' + std::to_string(i) + ']', {value, -value}));
  }
}

TEST(Velocities, AreTheSecondThirdsOfTheVectorsOfAllJoints) {
  Signals signals;
  add_vector("Wam.jointsDataPort", 6, signals);
  add_vector("Bridge.reference", 6, signals);
  const auto velocities = velocities_of(signals, {joint("1", {0, 0}, {0, 0}), joint("2", {}, {})});
  ASSERT_EQ(velocities.size(), 2u);
  EXPECT_EQ(velocities[0].measured.name, "Wam.jointsDataPort[2]");
  EXPECT_EQ(velocities[1].measured.name, "Wam.jointsDataPort[3]");
  EXPECT_EQ(velocities[1].desired.name, "Bridge.reference[3]");
  EXPECT_EQ(velocities[1].measured.unit, "rad/s");
  EXPECT_EQ(velocities[1].largest, 3.0);
}

TEST(Velocities, AreElseTheSlopesOfPositions) {
  const auto velocities =
      velocities_of({}, {joint("1", {0.0, 1.0, 2.0, 3.0}, {0.0, 0.5, 2.0, -1.0})});
  ASSERT_EQ(velocities.size(), 1u);
  EXPECT_THAT(velocities[0].measured.time_s, ElementsAre(0.5, 1.0));
  EXPECT_THAT(velocities[0].measured.values, ElementsAre(2.0, -1.5));
  EXPECT_THAT(velocities[0].desired.values, ElementsAre(2.0, 2.0));
  EXPECT_EQ(velocities[0].measured.name, "");
  EXPECT_EQ(velocities[0].largest, 2.0);
}

TEST(Velocities, OfAJointThatIsCalledByItsNumberAreThoseOfThatNumber) {
  Signals signals;
  add_vector("Wam.jointsDataPort", 9, signals);
  const auto velocities = velocities_of(signals, {joint("3", {0, 0}, {0, 0})});
  EXPECT_EQ(velocities[0].measured.name, "Wam.jointsDataPort[5]");
}

TEST(Velocities, HaveTheLimitOfTheirJointOrOfTheWholeArm) {
  Signals signals;
  add_vector("Wam.jointsDataPort", 6, signals);
  const std::vector<Joint> joints{joint("1", {0, 0}, {0, 0}), joint("2", {0, 0}, {0, 0})};
  EXPECT_FALSE(velocities_of(signals, joints)[0].limit.has_value());
  signals.all.push_back(signal("Wam.MaxVelocity[0]", {2.5}));
  EXPECT_EQ(velocities_of(signals, joints)[1].limit, 2.5) << "one for all";
  signals.all.push_back(signal("Wam.MaxVelocity[1]", {1.5}));
  EXPECT_EQ(velocities_of(signals, joints)[1].limit, 1.5);
  signals.all.push_back(signal("Joint2.MaxVelocity", {3.0}));
  EXPECT_EQ(velocities_of(signals, joints)[1].limit, 3.0);
}

TEST(Velocities, OfTooFewSamplesHaveNoSlope) {
  const auto velocities =
      velocities_of({}, {joint("1", {0.0, 1.0}, {0.0, 1.0}), joint("2", {}, {})});
  ASSERT_EQ(velocities.size(), 2u);
  EXPECT_TRUE(velocities[0].measured.values.empty());
  EXPECT_TRUE(velocities[1].measured.values.empty());
}

}  // namespace
}  // namespace armature::report
