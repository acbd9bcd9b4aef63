// SPDX-License-Identifier: Apache-2.0
#include "armature/sim/world.hpp"

#include <chrono>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/realtime_guard.hpp"

namespace armature::sim {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

/// A cart on a floor, which a wheel without friction in its bearing drives along x.
const std::string kCart = R"(<mujoco>
  <option timestep="0.5"/>
  <worldbody>
    <geom type="plane" size="5 5 1" friction="0 0 0"/>
    <body name="cart" pos="0 0 0.05"><freejoint/>
      <geom type="box" size="0.1 0.1 0.02" mass="1" pos="0 0 0.03" contype="0" conaffinity="0"/>
      <geom type="sphere" size="0.05" pos="-0.1 0 0" friction="0 0 0" mass="0.01"/>
      <geom type="sphere" size="0.05" pos="0.1 0.1 0" friction="0 0 0" mass="0.01"/>
      <geom type="sphere" size="0.05" pos="0.1 -0.1 0" friction="0 0 0" mass="0.01"/>
      <body name="wheel"><joint name="axle" axis="0 1 0" damping="0"/>
        <geom type="cylinder" size="0.05 0.02" zaxis="0 1 0" mass="0.2" friction="1 0.005 0.0001"/>
      </body>
    </body>
  </worldbody>
</mujoco>)";

World make_world(base::Duration inner_step = 1ms) {
  auto made = World::parse(kCart, "cart", {.inner_step = inner_step});
  EXPECT_TRUE(made) << made.error();
  return std::move(made).value();
}

TEST(World, AWheelDrivesItsCartByItsContact) {
  World world = make_world();
  const std::size_t axle = *world.find_joint("axle");
  const std::size_t cart = *world.find_body("cart");
  world.step(200ms);  // it settles
  const double begin = world.pose(cart).position[0];
  const double angle = world.position(axle);
  world.set_effort(axle, 0.005);
  ASSERT_EQ(world.step(1s), PlantStatus::kGood);
  const double way = world.pose(cart).position[0] - begin;
  EXPECT_GT(way, 0.02);
  EXPECT_NEAR(way, 0.05 * (world.position(axle) - angle), 0.1 * way);
  EXPECT_GT(world.velocity(axle), 0.0);
  EXPECT_EQ(world.time(), 1200ms);
}

TEST(World, ABodyIsPutSomewhereAndRestsThere) {
  World world = make_world();
  const std::size_t cart = *world.find_body("cart");
  world.set_effort(*world.find_joint("axle"), 0.05);
  world.step(500ms);
  world.set_effort(*world.find_joint("axle"), 0.0);
  EXPECT_TRUE(world.place(cart, {{1.0, 2.0, 0.05}, {0.6, 0.0, 0.0, 0.8}}));
  EXPECT_EQ(world.pose(cart).position[1], 2.0);
  EXPECT_DOUBLE_EQ(world.pose(cart).orientation[3], 0.8);
  EXPECT_FALSE(world.place(*world.find_body("wheel"), {}));
}

TEST(World, WhatIsLeftOfAnInnerStepIsMadeUpFor) {
  World world = make_world(2ms);
  world.step(3ms);
  EXPECT_EQ(world.time(), 2ms);
  world.step(1ms);
  EXPECT_EQ(world.time(), 4ms);
}

TEST(World, TwiceTheSame) {
  World first = make_world();
  World second = make_world();
  for (World* world : {&first, &second}) {
    world->set_effort(*world->find_joint("axle"), 0.02);
    world->step(2s);
  }
  EXPECT_EQ(first.pose(1).position, second.pose(1).position);
  EXPECT_EQ(first.pose(1).orientation, second.pose(1).orientation);
}

TEST(World, ANumberThatIsNoneStopsItsTime) {
  World world = make_world();
  world.set_effort(*world.find_joint("axle"), 1e300);
  EXPECT_EQ(world.step(1s), PlantStatus::kDiverged);
  EXPECT_LT(world.time(), 1s);
}

TEST(World, AllocatesNothing) {
  World world = make_world();
  testing::RealtimeGuard guard;
  EXPECT_EQ(guard.watch([&] { world.step(100ms); }), 0U) << guard.report();
}

TEST(World, MistakesAreNamed) {
  const auto empty = World::parse("", "arena", {});
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error(), "arena: the file is empty, expected an MJCF description");
  const auto timeless = World::parse(kCart, "arena", {.inner_step = 0ms});
  ASSERT_FALSE(timeless);
  EXPECT_THAT(timeless.error(), HasSubstr("expected more than 0"));
  const World world = make_world();
  EXPECT_FALSE(world.find_joint("no"));
  EXPECT_FALSE(world.find_body("no"));
}

}  // namespace
}  // namespace armature::sim
