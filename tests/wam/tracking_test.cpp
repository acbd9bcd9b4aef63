// SPDX-License-Identifier: Apache-2.0
// The arm's deployments over bus, pucks and safety board: how well they hold and follow.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/wam/arm.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;

/// A tour from home through the arm's range, each motion in 5 s.
std::vector<Vector> tour(std::size_t joints) {
  std::vector<Vector> targets{{0.0, 0.0, 0.0, 1.57, 0.0, 0.0, 0.0},
                              {1.2, 1.0, -0.8, 0.6, -1.5, 0.8, 1.2},
                              {-1.0, -0.9, 0.9, 2.2, 0.6, -0.9, -1.4},
                              {0.0, -1.9, 0.0, 3.0, 0.0, 0.0, 0.0}};
  for (Vector& target : targets) target.resize(joints);
  return targets;
}

struct Tour {
  Vector largest;             ///< error that was measured [rad] of each joint
  Vector really;              ///< largest error of where the joints really were [rad]
  double squares = 0.0;       ///< sum of the measured errors' of all joints [rad^2]
  double largest_step = 0.0;  ///< of a joint's torque from cycle to cycle, of its MaxTorqueGrowth
  int limited = 0;            ///< torques beyond what a puck gives
  int clipped = 0;            ///< in motions, once the arming is over
};

/// Where the joints really were when the pucks heard the last request of positions [rad].
void follow_samples(Arm& arm, Vector& positions) {
  arm.emulator().bus().set_tap([&](const can::WireEvent& event) {
    const bool asks = event.frame.id == identifier(to_group(Group::kArm)) && event.frame.size == 1;
    if (!asks) return;
    arm.hardware().emulated()->motors().advance_to(event.end);
    positions = arm.positions();
  });
}

Tour make_tour(Arm& arm) {
  arm.start_armed();
  arm.run_for(1500ms);
  const int clipped_before = arm.value<int>("WAM", "clipped");
  const auto growth = arm.value<Vector>("WAM", "MaxTorqueGrowth");
  Tour made{Vector(arm.joints(), 0.0), Vector(arm.joints(), 0.0)};
  Vector sampled;
  follow_samples(arm, sampled);
  Vector before(arm.joints());
  std::ranges::copy(arm.hardware().torque_path().joint_torques(), before.begin());
  for (const Vector& target : tour(arm.joints())) {
    EXPECT_EQ(arm.move_to(target, 5.0), "");
    for (int cycle = 0; cycle < 3000; ++cycle) {
      // What the controller is to follow in a cycle was written in the one before.
      const Vector desired = arm.desired();
      arm.cycle();
      const auto positions = arm.value<Vector>("Sensor", "sensor");
      const auto torques = arm.hardware().torque_path().joint_torques();
      for (std::size_t i = 0; i < arm.joints(); ++i) {
        const double error = desired[i] - positions[i];
        made.largest[i] = std::max(made.largest[i], std::abs(error));
        made.really[i] = std::max(made.really[i], std::abs(desired[i] - sampled[i]));
        made.squares += error * error;
        const double grown = std::abs(torques[i]) - std::abs(before[i]);
        made.largest_step = std::max(made.largest_step, grown / growth[i]);
        before[i] = torques[i];
      }
    }
    EXPECT_LT(largest_apart(arm.positions(), target), 0.02);
  }
  for (std::size_t i = 0; i < arm.joints(); ++i) {
    made.limited += static_cast<int>(arm.hardware().driver().motor(i).counters.limited);
  }
  made.clipped = arm.value<int>("WAM", "clipped") - clipped_before;
  EXPECT_TRUE(arm.armed());
  EXPECT_EQ(arm.application().faults(), 0u) << arm.log;
  EXPECT_EQ(arm.application().reactions(), 0u) << arm.log;
  EXPECT_EQ(arm.value<int>("WAM", "lost_answers"), 0);
  EXPECT_EQ(arm.value<int>("WAM", "cycles_without_command"), 0);
  return made;
}

/// The tour of each deployment is made once for all tests.
const Tour& tour_of(int joints, const std::string& controller) {
  static std::map<std::tuple<int, std::string>, Tour> known;
  const auto key = std::make_tuple(joints, controller);
  if (const auto found = known.find(key); found != known.end()) return found->second;
  Arm arm(controller + std::to_string(joints) + ".yaml");
  return known.emplace(key, make_tour(arm)).first->second;
}

class Deployed : public ::testing::TestWithParam<std::tuple<int, const char*>> {
 protected:
  std::string file() const {
    return std::string(std::get<1>(GetParam())) + std::to_string(std::get<0>(GetParam())) + ".yaml";
  }
  const Tour& tour_made() const {
    return tour_of(std::get<0>(GetParam()), std::get<1>(GetParam()));
  }
};
INSTANTIATE_TEST_SUITE_P(Wam, Deployed,
                         ::testing::Combine(::testing::Values(4, 7),
                                            ::testing::Values("npid", "controller_wam",
                                                              "computed_torque", "gravity_pd")),
                         [](const auto& tested) {
                           return std::string(std::get<1>(tested.param)) + "_of_" +
                                  std::to_string(std::get<0>(tested.param)) + "_joints";
                         });

TEST_P(Deployed, TracksMotionsOfFiveSecondsWithinTwoHundredthsOfARadianOverTheBus) {
  for (const double error : tour_made().largest) EXPECT_LT(error, 0.02);
}

TEST_P(Deployed, NoTorqueGrowsFasterThanDeclaredNorBeyondWhatItsPuckGives) {
  EXPECT_LE(tour_made().largest_step, 1.0 + 1e-9);
  EXPECT_EQ(tour_made().limited, 0);
}

TEST_P(Deployed, TheLimiterHasNothingToDoInMotionsOfFiveSeconds) {
  EXPECT_EQ(tour_made().clipped, 0);
}

TEST_P(Deployed, HoldsTheArmForTenSecondsWithinAHundredthOfARadian) {
  Arm arm(file());
  arm.start_armed();
  ASSERT_EQ(arm.move_to(tour(arm.joints())[1], 5.0), "");
  arm.run_for(7s);
  const Vector before = arm.positions();
  double most = 0.0;
  for (int cycle = 0; cycle < 5000; ++cycle) {
    arm.cycle();
    most = std::max(most, largest_apart(arm.positions(), before));
  }
  EXPECT_LT(most, 0.01);
}

TEST_P(Deployed, DisarmedItIsHeldWhereItIsForTenSeconds) {
  Arm arm(file());
  arm.start_armed();
  ASSERT_EQ(arm.move_to(tour(arm.joints())[1], 5.0), "");
  arm.run_for(7s);
  ASSERT_EQ(arm.call("Arming", "disarm"), "");
  const Vector before = arm.positions();
  arm.run_for(10s);
  EXPECT_FALSE(arm.armed());
  EXPECT_LT(largest_apart(arm.positions(), before), 0.01);
}

class ComparedOverTheBus : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Wam, ComparedOverTheBus, ::testing::Values(4, 7));

// What is measured of the wrist has steps of 0.08 and 0.1 mrad, as large as its errors.
TEST_P(ComparedOverTheBus, ComputedTorqueReallyTracksEachJointThreeTimesAsWellAsThePids) {
  const Tour& pids = tour_of(GetParam(), "npid");
  const Tour& computed = tour_of(GetParam(), "computed_torque");
  for (std::size_t i = 0; i < pids.really.size(); ++i) {
    EXPECT_LT(3.0 * computed.really[i], pids.really[i]) << "joint " << i + 1;
  }
}

TEST_P(ComparedOverTheBus, SoItDoesByWhatIsMeasuredOfTheArmAndOfAllJointsTogether) {
  const Tour& pids = tour_of(GetParam(), "npid");
  const Tour& computed = tour_of(GetParam(), "computed_torque");
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT(3.0 * computed.largest[i], pids.largest[i]) << "joint " << i + 1;
  }
  EXPECT_LT(3.0 * std::ranges::max(computed.largest), std::ranges::max(pids.largest));
  EXPECT_LT(3.0 * std::sqrt(computed.squares), std::sqrt(pids.squares));
}

TEST_P(ComparedOverTheBus, TheArmsOwnControllerIsThePidsInAnotherForm) {
  const Tour& pids = tour_of(GetParam(), "npid");
  const Tour& own = tour_of(GetParam(), "controller_wam");
  for (std::size_t i = 0; i < pids.largest.size(); ++i) {
    EXPECT_NEAR(own.largest[i], pids.largest[i], 1e-4) << "joint " << i + 1;
  }
}

}  // namespace
}  // namespace armature::wam
