// SPDX-License-Identifier: Apache-2.0
#include "armature/sim/brake.hpp"

#include <chrono>
#include <utility>

#include <gtest/gtest.h>

namespace armature::sim {
namespace {

using namespace std::chrono_literals;

TEST(Brake, HoldsFromTheBeginningUntilItIsReleased) {
  auto made = Plant::parse(
      "<robot name='lift'><link name='base'/>"
      "<joint name='rail' type='prismatic'><parent link='base'/><child link='load'/>"
      "<axis xyz='0 0 1'/><limit lower='-9' upper='9' effort='1' velocity='1'/></joint>"
      "<link name='load'><inertial><mass value='2'/>"
      "<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link></robot>",
      "lift.urdf", {});
  ASSERT_TRUE(made.ok()) << made.error();
  Plant& plant = made.value();
  Brake brake(plant, 0, 20.0);
  EXPECT_TRUE(brake.applied());
  plant.step(1s);
  EXPECT_NEAR(plant.position(0), 0.0, 1e-6);
  brake.release();
  EXPECT_FALSE(brake.applied());
  plant.step(1s);
  EXPECT_NEAR(plant.position(0), -0.5 * 9.81, 1e-3);
  brake.apply();
  EXPECT_TRUE(brake.applied());
}

}  // namespace
}  // namespace armature::sim
