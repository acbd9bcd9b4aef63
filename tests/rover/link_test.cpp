// SPDX-License-Identifier: Apache-2.0
// The rover in several processes, with a network whose delays are simulated, in simulated time.
#include <chrono>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "tests/rover/linked.hpp"

namespace armature::rover {
namespace {

using namespace std::chrono_literals;

constexpr double kDegree = std::numbers::pi / 180.0;
const std::vector<std::string> kOne{"rover.yaml"};
const std::vector<std::string> kTwo{"robot.yaml", "pilot.yaml"};
const std::vector<std::string> kThree{"chassis.yaml", "vision.yaml", "pilot.yaml"};

/// The worst of the last 15 s of 45 s on the circle.
Following on_circle(Linked& rover) {
  rover.run_for(3s);
  rover.go(BallWay::kCircle);
  const std::vector<Sight> sights = rover.watch(45s);
  return following({sights.end() - 300, sights.end()});
}

TEST(SimulatedLink, FollowsWithDelaysThatVaryAndStalls) {
  for (const std::uint32_t seed : {1U, 100U, 1000U}) {
    Linked rover(kTwo, {.least = 0ms, .most = 100ms, .stalls = 0.01, .stall = 300ms}, seed);
    const Following found = on_circle(rover);
    EXPECT_LE(found.bearing_rad, 12 * kDegree) << found.bearing_rad / kDegree;
    EXPECT_LE(found.distance_error_m, 0.5) << found.distance_error_m;
    EXPECT_GE(rover.chassis_of_pilot().most_under_way(), 2U);
    std::printf("bearing %.2f distance %.3f under way %zu given %zu refused %lld failures %lld\n",
                found.bearing_rad / kDegree, found.distance_error_m,
                rover.chassis_of_pilot().most_under_way(), rover.chassis_of_pilot().given(),
                static_cast<long long>(rover.of_pilot<std::int64_t>("Follow", "Refused")),
                static_cast<long long>(rover.of_pilot<std::int64_t>("Follow", "Failures")));
  }
}

TEST(SimulatedLink, OneProcessAndThreeHaveTheSameFigures) {
  Linked one(kOne);
  Linked three(kThree);
  const Following of_one = on_circle(one);
  const Following of_three = on_circle(three);
  std::printf("one %.3f m %.3f deg, three %.3f m %.3f deg\n", of_one.distance_error_m,
              of_one.bearing_rad / kDegree, of_three.distance_error_m,
              of_three.bearing_rad / kDegree);
  EXPECT_NEAR(of_three.distance_error_m, of_one.distance_error_m, 0.05 * of_one.distance_error_m);
  EXPECT_NEAR(of_three.bearing_rad, of_one.bearing_rad, 0.05 * of_one.bearing_rad);
}

}  // namespace
}  // namespace armature::rover
