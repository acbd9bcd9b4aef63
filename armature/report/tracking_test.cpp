// SPDX-License-Identifier: Apache-2.0
#include "armature/report/tracking.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

namespace armature::report {
namespace {

constexpr double kPeriod = 0.01;
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

Signal signal(const std::string& name, const std::vector<double>& values, double begin_s = 0.0) {
  Signal made{name, "rad", "", {}, values};
  for (std::size_t i = 0; i < values.size(); ++i) {
    made.time_s.push_back(begin_s + static_cast<double>(i) * kPeriod);
  }
  return made;
}

std::vector<double> constant(std::size_t count, double value) {
  return std::vector<double>(count, value);
}

TEST(Joints, AreFoundByTheirControllersPortsInTheOrderOfTheirNumbers) {
  Signals signals;
  for (const char* pid : {"PID10", "PID2", "PID1"}) {
    signals.all.push_back(signal(std::string(pid) + ".Ref", {0.0, 1.0}));
    signals.all.push_back(signal(std::string(pid) + ".Sen", {0.0, 0.5}));
  }
  signals.all.push_back(signal("Other.Ref", {0.0, 1.0}));
  const auto joints = joints_of(signals);
  ASSERT_EQ(joints.size(), 3u);
  EXPECT_EQ(joints[0].name, "1");
  EXPECT_EQ(joints[1].name, "2");
  EXPECT_EQ(joints[2].name, "10");
  EXPECT_EQ(joints[2].measured_from, "PID10.Sen");
  EXPECT_EQ(joints[0].figures.largest, 0.5);
}

TEST(Joints, AreFoundInTheVectorsOfAllJointsIfThereAreNoControllers) {
  Signals signals;
  const std::size_t joints = 3;
  for (std::size_t i = 0; i < 3 * joints; ++i) {
    signals.all.push_back(
        signal("BridgeRef.reference[" + std::to_string(i) + "]", constant(5, 0.1)));
  }
  for (std::size_t i = 0; i < 2 * joints; ++i) {
    signals.all.push_back(signal("Sensor.sensor[" + std::to_string(i) + "]",
                                 constant(5, 0.01 * static_cast<double>(i))));
  }
  const auto found = joints_of(signals);
  ASSERT_EQ(found.size(), joints);
  EXPECT_EQ(found[2].name, "3");
  EXPECT_NEAR(found[2].figures.largest, 0.08, 1e-12);
}

TEST(Joints, AreNoneWithoutPositions) {
  Signals signals;
  signals.all.push_back(signal("PID1.Out", constant(5, 0.1)));
  signals.all.push_back(signal("PID1.Ref", constant(5, 0.1)));
  EXPECT_TRUE(joints_of(signals).empty());
}

TEST(Joints, TheReferenceOfASampleIsTheLastOneUntilThen) {
  Signals signals;
  signals.all.push_back(signal("PID1.Ref", {1.0, 2.0}, 0.015));  // written at 15 and 25 ms
  signals.all.push_back(signal("PID1.Sen", {0.0, 0.0, 0.0, 0.0}));
  const auto joints = joints_of(signals);
  ASSERT_EQ(joints.size(), 1u);
  EXPECT_TRUE(std::isnan(joints[0].desired[1]));
  EXPECT_EQ(joints[0].desired[2], 1.0);
  EXPECT_EQ(joints[0].desired[3], 2.0);
  EXPECT_EQ(joints[0].measured_since_s, 0.02) << "before, nothing was wanted";
}

TEST(Joints, InVectorsAReferenceOfTheSameCycleAnswersTheMeasurement) {
  Signals signals;
  signals.all.push_back(signal("Bridge.reference[0]", {1.0, 2.0, 3.0}));
  signals.all.push_back(signal("Bridge.reference[1]", constant(3, 0.0)));
  signals.all.push_back(signal("Bridge.reference[2]", constant(3, 0.0)));
  signals.all.push_back(signal("Sensor.sensor[0]", {0.0, 1.0, 2.0}));
  signals.all.push_back(signal("Sensor.sensor[1]", constant(3, 1.0)));
  const auto joints = joints_of(signals);
  ASSERT_EQ(joints.size(), 1u);
  EXPECT_TRUE(std::isnan(joints[0].desired[0]));
  EXPECT_EQ(joints[0].desired[1], 1.0);
  EXPECT_EQ(joints[0].figures.largest, 0.0) << "it follows exactly";
}

TEST(Joints, BehindAGapInVectorsTheReferenceOfTheSameCycleCounts) {
  Signals signals;
  signals.all.push_back(signal("Bridge.reference[0]", {1.0, 1.0, 1.0, 5.0, 5.0, 5.0}));
  signals.all.push_back(signal("Bridge.reference[1]", constant(6, 0.0)));
  signals.all.push_back(signal("Bridge.reference[2]", constant(6, 0.0)));
  signals.all.push_back(signal("Sensor.sensor[0]", {1.0, 1.0, 1.0, 5.0, 5.0, 5.0}));
  signals.all.push_back(signal("Sensor.sensor[1]", constant(6, 0.0)));
  for (Signal& each : signals.all) {
    for (std::size_t i = 3; i < 6; ++i) each.time_s[i] += 1.0;  // a restart elsewhere
  }
  EXPECT_EQ(joints_of(signals)[0].figures.largest, 0.0);
}

TEST(Joints, HaveTheRootOfTheMeanSquareOfTheirErrors) {
  Signals signals;
  signals.all.push_back(signal("PID1.Ref", constant(4, 0.0)));
  signals.all.push_back(signal("PID1.Sen", {0.1, -0.1, kNothing, 0.2}));
  EXPECT_NEAR(joints_of(signals)[0].rms, std::sqrt(0.06 / 3.0), 1e-12);
}

TEST(Joints, HowFarTheyMovedAtTheEndIsKnownOfTenSeconds) {
  std::vector<double> measured = constant(1200, 0.3);
  for (std::size_t i = 150; i < 1200; ++i) measured[i] = 0.4;
  measured[700] = 0.45;
  measured[900] = 0.37;
  Signals signals;
  signals.all.push_back(signal("PID1.Ref", constant(1200, 0.4)));
  signals.all.push_back(signal("PID1.Sen", measured));
  ASSERT_TRUE(joints_of(signals)[0].moved_lately);
  EXPECT_NEAR(*joints_of(signals)[0].moved_lately, 0.05, 1e-12);
  for (Signal& each : signals.all) {
    each.time_s.resize(900);
    each.values.resize(900);
  }
  EXPECT_FALSE(joints_of(signals)[0].moved_lately) << "of nine seconds it is not";
}

TEST(Joints, FiguresAreThoseOfTheTimeInWhichAllAreArmed) {
  Signals signals;
  for (const char* pid : {"PID1", "PID2"}) {
    signals.all.push_back(signal(std::string(pid) + ".Ref", constant(100, 1.0)));
    std::vector<double> measured = constant(100, 0.0);  // far away, as long as it is not armed
    std::fill(measured.begin() + 20, measured.begin() + 80, 0.9);
    signals.all.push_back(signal(std::string(pid) + ".Sen", measured));
  }
  signals.all.push_back({"Joint1.Armed", "", "", {0.0, 0.195, 0.8}, {0.0, 1.0, 0.0}});
  signals.all.push_back({"Joint2.Armed", "", "", {0.0, 0.1, 0.805}, {0.0, 1.0, 0.0}});
  const auto joints = joints_of(signals);
  ASSERT_EQ(joints.size(), 2u);
  EXPECT_NEAR(joints[0].figures.largest, 0.1, 1e-12);
  EXPECT_NEAR(joints[0].figures.iae, 59 * kPeriod * 0.1, 1e-9);
  EXPECT_NEAR(joints[0].measured_since_s, 0.2, 1e-9);
}

TEST(Joints, WhatMovedWhileTheyWereBeingArmedIsSaid) {
  Signals signals;
  signals.all.push_back(signal("PID1.Ref", constant(500, 1.0)));
  std::vector<double> measured = constant(500, 1.0);
  measured[0] = 7.0;                                         // long before
  std::fill(measured.begin() + 280, measured.end(), 0.993);  // the brake opened
  std::fill(measured.begin() + 400, measured.end(), 0.5);    // a motion
  signals.all.push_back(signal("PID1.Sen", measured));
  EXPECT_FALSE(joints_of(signals)[0].moved_arming) << "nobody says when it was armed";
  signals.all.push_back({"Joint1.Armed", "", "", {0.0, 3.0}, {0.0, 1.0}});
  ASSERT_TRUE(joints_of(signals)[0].moved_arming);
  EXPECT_NEAR(*joints_of(signals)[0].moved_arming, 0.007, 1e-12);
  signals.all.back() = {"Joint1.Armed", "", "", {0.0, 3.0}, {0.0, 0.0}};
  EXPECT_NEAR(joints_of(signals)[0].moved_arming.value_or(0.0), 6.5, 1e-12) << "never armed";
}

TEST(Joints, ALostSampleIsCountedAndTakesItsTime) {
  Signals signals;
  signals.all.push_back(signal("PID1.Ref", constant(50, 0.1)));
  signals.all.push_back(signal("PID1.Sen", constant(50, 0.0)));
  const double whole = joints_of(signals)[0].figures.itae;
  Signal& measured = signals.all[1];
  for (const std::ptrdiff_t lost : {30, 20, 20}) {
    measured.time_s.erase(measured.time_s.begin() + lost);
    measured.values.erase(measured.values.begin() + lost);
  }
  const auto joints = joints_of(signals);
  EXPECT_EQ(joints[0].missing, 3u);
  EXPECT_NEAR(joints[0].figures.itae, whole, 1e-12);
}

TEST(Joints, ACountOfTheEncoderIsTakenFromTheCardAndTheJoint) {
  Signals signals;
  signals.all.push_back(signal("PID1.Ref", constant(5, 0.1)));
  signals.all.push_back(signal("PID1.Sen", constant(5, 0.0)));
  EXPECT_FALSE(joints_of(signals)[0].rad_per_count) << "nothing says what it is";
  signals.texts["Joint1.PeerName"] = "Card7";
  signals.all.push_back(signal("Joint1.GearRatio", {0.01}));
  signals.all.push_back(signal("Card7.GearRatio", {-1.0}));
  signals.all.push_back(signal("Card7.CountsPerTurn", {2000.0}));
  ASSERT_TRUE(joints_of(signals)[0].rad_per_count);
  EXPECT_NEAR(*joints_of(signals)[0].rad_per_count, 3.14159265e-5, 1e-12);
}

TEST(Joints, RestBeginsTwoSecondsAfterAMotion) {
  std::vector<double> desired = constant(1000, 0.0);
  std::vector<double> measured = constant(1000, 0.0);
  std::fill(desired.begin() + 300, desired.end(), 1.0);  // a step at 3 s
  std::fill(measured.begin() + 300, measured.begin() + 499, 0.5);
  std::fill(measured.begin() + 499, measured.end(), 0.999);
  measured[700] = kNothing;
  Signals signals;
  signals.all.push_back(signal("PID1.Ref", desired));
  signals.all.push_back(signal("PID1.Sen", measured));
  const auto joints = joints_of(signals);
  ASSERT_TRUE(joints[0].at_rest);
  EXPECT_NEAR(*joints[0].at_rest, 0.001, 1e-9);
  EXPECT_EQ(joints[0].figures.largest, 1.0 - 0.5);
  EXPECT_EQ(joints[0].figures.not_finite, 1u);
}

}  // namespace
}  // namespace armature::report
