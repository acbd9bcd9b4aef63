// SPDX-License-Identifier: Apache-2.0
#include "robots/rover/plant.hpp"

#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/realtime_guard.hpp"
#include "robots/rover/numbers.hpp"

namespace armature::rover {
namespace {

using namespace std::chrono_literals;

struct Rover {
  explicit Rover(int wheels = 2)
      : plant(std::move(Plant::make({.wheels = wheels, .begin = now}).value())) {
    for (std::size_t i = 0; i < plant->wheels(); ++i) plant->switch_on(i, now);
    drive(0.0, 0.0, 200ms);
    begin = plant->place();
  }
  /// Voltages that are told every 10 ms.
  void drive(double left, double right, base::Duration time) {
    for (const base::Time end = now + time; now < end;) {
      for (std::size_t i = 0; i < plant->wheels(); ++i)
        plant->drive(i, i % 2 == 0 ? left : right, now);
      now += 10ms;
      plant->advance_to(now);
    }
  }
  double way() const { return std::hypot(plant->place().x - begin.x, plant->place().y - begin.y); }

  base::Time now{1s};
  std::unique_ptr<Plant> plant;
  Place begin;
};

TEST(RoverPlant, RestsWhereItBegins) {
  Rover rover;
  rover.drive(0.0, 0.0, 5s);
  EXPECT_NEAR(rover.plant->place().x, kBeginX, 0.002);
  EXPECT_NEAR(rover.plant->place().y, 0.0, 1e-4);
  EXPECT_NEAR(rover.plant->place().heading, 0.0, 1e-3);
  EXPECT_EQ(rover.plant->status(), sim::PlantStatus::kGood);
}

TEST(RoverPlant, DrivesStraightWithLittleSlip) {
  for (const int wheels : {2, 4}) {
    Rover rover(wheels);
    const double angle = rover.plant->wheel_angle(0);
    rover.drive(3.0, 3.0, 2s);
    const double rolled = kWheelRadius * (rover.plant->wheel_angle(0) - angle);
    EXPECT_GT(rover.plant->place().x - rover.begin.x, 0.4) << wheels;
    EXPECT_NEAR(rover.way(), rolled, 0.02 * rolled) << wheels;
    EXPECT_NEAR(rover.plant->place().y, 0.0, 0.01) << wheels;
  }
}

TEST(RoverPlant, TurnsToTheLeftWhenTheRightWheelIsFaster) {
  Rover rover;
  rover.drive(-2.0, 2.0, 1s);
  const double rolled = kWheelRadius * (rover.plant->wheel_angle(1) - rover.plant->wheel_angle(0));
  const double heading = rover.plant->place().heading;
  EXPECT_GT(heading, 0.3);
  EXPECT_NEAR(heading, rolled / kTrack, 0.05 * heading);
  EXPECT_LT(rover.way(), 0.03);
}

TEST(RoverPlant, FourWheelsScrubWhenTheyTurn) {
  Rover rover(4);
  rover.drive(-6.0, 6.0, 1s);
  const double rolled = kWheelRadius * (rover.plant->wheel_angle(1) - rover.plant->wheel_angle(0));
  const double heading = rover.plant->place().heading;
  EXPECT_GT(heading, 0.3);
  EXPECT_LT(heading, 0.97 * rolled / kTrack);
}

TEST(RoverPlant, AWheelSlipsWhenItIsDrivenHarderThanTheFloorHolds) {
  Rover rover;
  rover.drive(12.0, 12.0, 100ms);
  EXPECT_GT(kWheelRadius * rover.plant->wheel_velocity(0), rover.way() / 0.1 + 0.1);
}

TEST(RoverPlant, ADriveThatIsToldNothingStopsAfter100Ms) {
  Rover rover;
  rover.drive(5.0, 5.0, 1s);
  rover.plant->advance_to(rover.now + 80ms);
  EXPECT_TRUE(rover.plant->is_on(0));
  EXPECT_GT(rover.plant->wheel_velocity(0), 5.0);
  rover.plant->advance_to(rover.now + 120ms);
  EXPECT_FALSE(rover.plant->is_on(0));
  rover.plant->advance_to(rover.now + 700ms);
  EXPECT_NEAR(rover.plant->wheel_velocity(0), 0.0, 0.05);
  rover.plant->drive(0, 5.0, rover.now + 700ms);
  rover.plant->advance_to(rover.now + 750ms);
  EXPECT_NEAR(rover.plant->wheel_velocity(0), 0.0, 0.05) << "it is off until it is switched on";
}

TEST(RoverPlant, CountsWhatTheMotorTurns) {
  Rover rover;
  const double angle = rover.plant->wheel_angle(1);
  rover.plant->take_counts(1, rover.now);
  rover.drive(2.0, 4.0, 1s);
  const double turns = (rover.plant->wheel_angle(1) - angle) / (2.0 * std::numbers::pi);
  EXPECT_NEAR(static_cast<double>(rover.plant->take_counts(1, rover.now)),
              turns * kMotor.gear_ratio * kCountsPerTurn, 2.0);
}

TEST(RoverPlant, ABrokenMotorDrivesNothing) {
  Rover rover;
  rover.plant->break_motor(0, true);
  rover.drive(4.0, 4.0, 500ms);
  EXPECT_GT(rover.plant->wheel_velocity(1), 3.0);
  EXPECT_LT(std::abs(rover.plant->wheel_velocity(0)), 2.0);
}

TEST(RoverPlant, WallsHoldIt) {
  Rover rover;
  rover.plant->put({2.5, 0.0, 0.0});
  rover.drive(6.0, 6.0, 3s);
  EXPECT_LT(rover.plant->place().x, 2.95);
  EXPECT_EQ(rover.plant->status(), sim::PlantStatus::kGood);
}

TEST(RoverPlant, TwiceTheSameAndWithoutAllocation) {
  Rover first;
  Rover second;
  first.drive(2.0, 5.0, 2s);
  testing::RealtimeGuard guard;
  EXPECT_EQ(guard.watch([&] { second.drive(2.0, 5.0, 2s); }), 0U) << guard.report();
  EXPECT_EQ(first.plant->place().x, second.plant->place().x);
  EXPECT_EQ(first.plant->place().heading, second.plant->place().heading);
}

TEST(RoverPlant, HasTwoOrFourWheels) {
  const auto made = Plant::make({.wheels = 3});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error(), "the rover has 3 wheels, expected 2 or 4");
}

}  // namespace
}  // namespace armature::rover
