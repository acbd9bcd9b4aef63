// SPDX-License-Identifier: Apache-2.0
#include "armature/report/effort.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace armature::report {
namespace {

Signal signal(const std::string& name, const std::vector<double>& values) {
  Signal made{name, "", "", {}, values};
  for (std::size_t i = 0; i < values.size(); ++i)
    made.time_s.push_back(0.01 * static_cast<double>(i));
  return made;
}

/// Of two joints: positions, velocities, torques.
Signals data_of_joints(const std::vector<double>& torques1, const std::vector<double>& torques2) {
  Signals signals;
  for (int i = 0; i < 4; ++i) {
    signals.all.push_back(signal("Wam.jointsDataPort[" + std::to_string(i) + "]", {9.0, 9.0}));
  }
  signals.all.push_back(signal("Wam.jointsDataPort[4]", torques1));
  signals.all.push_back(signal("Wam.jointsDataPort[5]", torques2));
  return signals;
}

TEST(Efforts, AreTheTorquesInTheDataOfAllJoints) {
  Signals signals = data_of_joints({1.0, -3.0}, {0.5, 0.25});
  signals.all.push_back(signal("Wam.MaxTorque[0]", {25.0}));
  signals.all.push_back(signal("Wam.MaxTorque[1]", {20.0}));
  const auto efforts = efforts_of(signals);
  ASSERT_EQ(efforts.size(), 2u);
  EXPECT_EQ(efforts[0].joint, "1");
  EXPECT_EQ(efforts[0].signal.unit, "Nm");
  EXPECT_EQ(efforts[0].largest, 3.0);
  EXPECT_EQ(efforts[0].limit, 25.0);
  EXPECT_EQ(efforts[1].signal.name, "Wam.jointsDataPort[5]");
  EXPECT_EQ(efforts[1].limit, 20.0);
}

TEST(Efforts, MayHaveOneLimitForAllOrNone) {
  Signals signals = data_of_joints({1.0, 1.0}, {2.0, 2.0});
  EXPECT_FALSE(efforts_of(signals)[1].limit.has_value());
  signals.all.push_back(signal("Wam.MaxTorque[0]", {7.0}));
  EXPECT_EQ(efforts_of(signals)[1].limit, 7.0);
}

TEST(Efforts, AreElseTheVoltagesOfTheJointsInTheOrderOfTheirNumbers) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Signals signals{
      {signal("Joint10.VoltageActuator", {1.0, none}), signal("Joint2.VoltageActuator", {-12.0}),
       signal("Joint2.MaxVoltage", {12.0}), signal("PID1.Out", {4.0})},
      {}};
  const auto efforts = efforts_of(signals);
  ASSERT_EQ(efforts.size(), 2u);
  EXPECT_EQ(efforts[0].joint, "2");
  EXPECT_EQ(efforts[0].largest, 12.0);
  EXPECT_EQ(efforts[0].limit, 12.0);
  EXPECT_EQ(efforts[1].joint, "10");
  EXPECT_EQ(efforts[1].largest, 1.0);
  EXPECT_FALSE(efforts[1].limit.has_value());
}

}  // namespace
}  // namespace armature::report
