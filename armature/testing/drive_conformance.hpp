// SPDX-License-Identifier: Apache-2.0
#pragma once

// What every kind of drive promises, whatever its driver: a test instantiates the suite with a
// deployment of it in simulated time.
//
//     INSTANTIATE_TEST_SUITE_P(Mine, DriveConformance, testing::Values(DriveCase{
//         .name = "MyDrive", .file = "simulated.yaml", .hardware = {"Drive1", "Drive2"},
//         .away = {0.5, -0.5}}), by_name);
//
// The deployment has the components Arming, Generator and Sensor, as those that ship.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "armature/component/interface.hpp"
#include "armature/deploy/deployment.hpp"
#include "armature/testing/deployed_robot.hpp"
#include "armature/testing/drive_case.hpp"

namespace armature::testing {

/// The contract of hardware below Arming, to be instantiated for each kind.
class DriveConformance : public ::testing::TestWithParam<DriveCase> {
 protected:
  using Joints = DriveCase::Joints;

  static constexpr base::Duration kStep = std::chrono::milliseconds(2);
  static constexpr base::Duration kLook = std::chrono::milliseconds(10);
  static constexpr double kAtRest = 0.01;        ///< [rad/s or m/s]
  static constexpr double kStill = 0.005;        ///< by which what stands may move
  static constexpr double kArmingMotion = 0.01;  ///< by which what is armed may

  DriveConformance() : robot_(load()) {}

  DeployedRobot& robot() { return robot_; }
  exec::Application& application() { return robot_.application(); }

  void start() {
    ASSERT_EQ(robot_.start(), "");
    run_for(std::chrono::milliseconds(100));
    GetParam().prepare(application());
    run_for(std::chrono::milliseconds(100));
  }
  /// Asks for it; what becomes of it is seen after at most eight seconds.
  void ask_to_arm() {
    const auto asked = application().begin("Arming", "arm", {});
    ASSERT_TRUE(asked) << asked.error() << "\n" << reasons();
    for (int k = 0; k < 4000 && !armed() && !asked.value().ended(); ++k) run_for(kStep);
    run_for(kStep);
  }
  void start_armed() {
    ASSERT_NO_FATAL_FAILURE(start());
    ASSERT_NO_FATAL_FAILURE(ask_to_arm());
    ASSERT_TRUE(armed()) << reasons();
  }
  /// On its way to `away`, with at least a third of the way behind it.
  void start_in_motion() {
    ASSERT_NO_FATAL_FAILURE(start_armed());
    const double way = apart(positions(), GetParam().away);
    ASSERT_EQ(move_to(GetParam().away), "");
    for (int k = 0; k < 5000 && apart(positions(), GetParam().away) > 0.66 * way; ++k) {
      run_for(kStep);
    }
    ASSERT_LT(apart(positions(), GetParam().away), 0.7 * way) << reasons();
    ASSERT_GT(fastest_within(std::chrono::milliseconds(20)), 0.05) << "it moves";
  }

  void run_for(base::Duration duration) {
    for (base::Duration passed{}; passed < duration; passed += kStep) {
      const base::Time before = GetParam().time ? GetParam().time(application()) : base::Time{};
      robot_.run_for(kStep);
      if (GetParam().pass) GetParam().pass(application(), before + kStep);
    }
  }
  bool armed() { return robot_.armed(); }
  Joints positions() {
    return GetParam().positions ? GetParam().positions(application()) : believed();
  }
  Joints believed() {
    Joints all = robot_.value<Joints>("Sensor", "sensor");
    all.resize(GetParam().away.size());
    return all;
  }
  static double apart(const Joints& left, const Joints& right) {
    double most = 0.0;
    for (std::size_t i = 0; i < std::min(left.size(), right.size()); ++i) {
      most = std::max(most, std::abs(left[i] - right[i]));
    }
    return most;
  }
  /// By which joints that are not driven may move meanwhile.
  static double stillness(base::Duration meanwhile) {
    return kStill + GetParam().sinks * std::chrono::duration<double>(meanwhile).count();
  }
  /// Of all joints, per second.
  double fastest_within(base::Duration duration) {
    const Joints before = positions();
    run_for(duration);
    return apart(before, positions()) / std::chrono::duration<double>(duration).count();
  }
  std::string move_to(const Joints& target) {
    return robot_.begin_motion_to(target, GetParam().motion_time);
  }
  void move_and_arrive(const Joints& target) {
    ASSERT_EQ(move_to(target), "");
    for (int k = 0; k < 10'000 && apart(believed(), target) > 0.5 * GetParam().arrives_within;
         ++k) {
      run_for(kStep);
    }
    run_for(std::chrono::milliseconds(500));
    EXPECT_LT(apart(believed(), target), GetParam().arrives_within) << reasons();
    EXPECT_TRUE(armed()) << reasons();
  }

  /// A brake that is closed hides a motor that drives against it, until one of them gives way.
  void expect_no_power() {
    if (GetParam().powered) {
      EXPECT_FALSE(GetParam().powered(application())) << "a drive is on\n" << reasons();
      return;
    }
    for (const auto& entry : application().blueprint().components) {
      const std::string& name = entry.component->name();
      const auto on = application().value_of(name, "switched_on");
      const bool is_on = on && *static_cast<const bool*>(on.value().data());
      EXPECT_FALSE(is_on) << name << " is on";
    }
  }

  /// It comes to rest in time, is not armed, has no power, and stays so.
  void expect_rest() {
    const double at_rest =
        (kAtRest + GetParam().sinks) * std::chrono::duration<double>(kLook).count();
    base::Duration passed{}, moved{};
    for (Joints last = positions(); passed < GetParam().rests_within; last = positions()) {
      run_for(kLook);
      passed += kLook;
      if (apart(last, positions()) > at_rest) moved = passed;
    }
    EXPECT_FALSE(armed()) << reasons();
    const Joints rest = positions();
    run_for(std::chrono::milliseconds(500));
    EXPECT_LT(apart(rest, positions()), stillness(std::chrono::milliseconds(500))) << reasons();
    EXPECT_FALSE(armed()) << reasons();
    expect_no_power();
    RecordProperty("moves_for_ms", static_cast<int>(moved / std::chrono::milliseconds(1)));
  }
  /// The cause is gone: nothing moves before somebody arms, and then all is as before.
  void expect_service_again() {
    const base::Time since = application().now();
    Joints rest = positions();
    if (!GetParam().begins_again) put_back_into_service();
    if (GetParam().begins_again) {
      GetParam().mend(application());
      EXPECT_TRUE(application().stop().ok());
      ASSERT_NO_FATAL_FAILURE(start());
      rest = positions();
    }
    // What it did while nobody measured it is seen now.
    if (!GetParam().positions) rest = positions();
    run_for(std::chrono::milliseconds(200));
    EXPECT_FALSE(armed()) << "nothing arms itself\n" << reasons();
    EXPECT_LT(apart(rest, positions()), stillness(application().now() - since)) << "nothing moves";
    rest = positions();
    ASSERT_NO_FATAL_FAILURE(ask_to_arm());
    ASSERT_TRUE(armed()) << reasons();
    EXPECT_LT(apart(rest, positions()), kArmingMotion) << "arming moves nothing";
    if (GetParam().begins_again) return move_and_arrive(GetParam().away);
    Joints target = believed();
    target[0] += target[0] < GetParam().away[0] ? 0.1 : -0.1;
    move_and_arrive(target);
  }
  /// What the operator does when a cause is gone: resets what faulted, starts what stopped.
  void put_back_into_service() {
    for (int round = 0; round < 4; ++round) {
      GetParam().mend(application());
      robot_.reset_and_start_everything();
      for (const auto& entry : application().blueprint().components) {
        confirm_position(entry.component->name());
      }
      run_for(std::chrono::milliseconds(50));
    }
  }
  /// The operator has looked where the joint is.
  void confirm_position(const std::string& name) {
    const auto exact = application().value_of(name, "position_exact");
    if (!exact || *static_cast<const bool*>(exact.value().data())) return;
    static_cast<void>(
        application().set_property(name, "position_confirmed", types::Value::of(true)));
  }
  /// Until it is stopped.
  void stop_hardware(const std::string& component) {
    ASSERT_TRUE(application().stop_component(component));
    const auto runs = [&] { return robot_.state(component) == component::State::kRunning; };
    for (int k = 0; k < 15'000 && !GetParam().stops_at_once && runs(); ++k) run_for(kStep);
    ASSERT_FALSE(runs()) << reasons();
  }
  void throw_in(const std::string& component) {
    application().run_in_thread_of(*application().find(component),
                                   [] { throw std::runtime_error("out of order"); });
  }
  /// In place of the generator, which stops.
  void desire(double position, double rest) {
    ASSERT_TRUE(application().stop_component("Generator"));
    component::Component& generator = *application().find("Generator");
    for (component::OutputPortBase* output : component::interface_of(generator).outputs) {
      if (!output->name().starts_with("nAxesDesired")) continue;
      const Joints all(GetParam().away.size(),
                       output->name() == "nAxesDesiredPosition" ? position : rest);
      ASSERT_TRUE(application().run_in_thread_of(generator, [&] { output->write_from(&all); }));
    }
  }
  std::string reasons() { return robot_.reasons(); }

 private:
  static deploy::Deployment load() {
    deploy::DeploymentOptions options;
    options.library_folders = GetParam().library_folders;
    options.document.overrides = GetParam().overrides;
    return deploy::load_deployment(GetParam().file, options);
  }

  DeployedRobot robot_;
};

// --- arming --------------------------------------------------------------------------------------

TEST_P(DriveConformance, NothingIsArmedAndNothingMovesBeforeTheOperatorArms) {
  ASSERT_NO_FATAL_FAILURE(start());
  const Joints rest = positions();
  run_for(std::chrono::seconds(2));
  EXPECT_FALSE(armed());
  expect_no_power();
  EXPECT_LT(apart(rest, positions()), stillness(std::chrono::seconds(2)));
}

TEST_P(DriveConformance, ArmingMovesNothing) {
  ASSERT_NO_FATAL_FAILURE(start());
  const Joints rest = positions();
  ASSERT_NO_FATAL_FAILURE(ask_to_arm());
  ASSERT_TRUE(armed()) << reasons();
  run_for(std::chrono::seconds(1));
  EXPECT_LT(apart(rest, positions()), kArmingMotion);
  EXPECT_TRUE(armed()) << reasons();
}

TEST_P(DriveConformance, AMotionArrivesAndBack) {
  ASSERT_NO_FATAL_FAILURE(start_armed());
  const Joints begin = believed();
  ASSERT_NO_FATAL_FAILURE(move_and_arrive(GetParam().away));
  EXPECT_LT(apart(positions(), GetParam().away), GetParam().arrives_within) << "really";
  ASSERT_NO_FATAL_FAILURE(move_and_arrive(begin));
}

TEST_P(DriveConformance, HardwareThatDoesNotRunIsNotArmed) {
  for (const std::string& hardware : GetParam().hardware) {
    SCOPED_TRACE(hardware);
    if (!application().running()) {
      ASSERT_NO_FATAL_FAILURE(start());
    }
    ASSERT_NO_FATAL_FAILURE(stop_hardware(hardware));
    run_for(std::chrono::milliseconds(20));
    const Joints rest = positions();
    static_cast<void>(application().begin("Arming", "arm", {}));
    run_for(std::chrono::seconds(3));
    EXPECT_FALSE(armed()) << reasons();
    const double most = 2.0 * kArmingMotion + GetParam().sinks * 3.1;
    EXPECT_LT(apart(rest, positions()), most) << reasons();
    expect_no_power();
    put_back_into_service();
  }
}

// --- what ends a motion --------------------------------------------------------------------------

TEST_P(DriveConformance, DisarmedInMotionItRests) {
  ASSERT_NO_FATAL_FAILURE(start_in_motion());
  ASSERT_TRUE(application().call("Arming", "disarm", {}));
  expect_rest();
  expect_service_again();
}

TEST_P(DriveConformance, HardwareThatStopsInMotionEndsIt) {
  if (!GetParam().stops_at_once) GTEST_SKIP() << "its orderly stop is a motion of its own";
  ASSERT_NO_FATAL_FAILURE(start_in_motion());
  ASSERT_NO_FATAL_FAILURE(stop_hardware(GetParam().hardware.back()));
  expect_rest();
  expect_service_again();
}

TEST_P(DriveConformance, HardwareThatThrowsInMotionEndsIt) {
  ASSERT_NO_FATAL_FAILURE(start_in_motion());
  throw_in(GetParam().hardware.front());
  expect_rest();
  expect_service_again();
}

TEST_P(DriveConformance, SilenceInMotionEndsIt) {
  ASSERT_NO_FATAL_FAILURE(start_in_motion());
  if (GetParam().silence) {
    GetParam().silence(application());
  } else {
    ASSERT_NO_FATAL_FAILURE(stop_hardware(GetParam().hardware.front()));
  }
  expect_rest();
  expect_service_again();
}

TEST_P(DriveConformance, AFaultInMotionEndsIt) {
  ASSERT_NO_FATAL_FAILURE(start_in_motion());
  if (GetParam().fail) {
    GetParam().fail(application());
  } else {
    throw_in(GetParam().hardware.back());
  }
  expect_rest();
  expect_service_again();
}

TEST_P(DriveConformance, AReferenceThatIsNoNumberEndsIt) {
  ASSERT_NO_FATAL_FAILURE(start_in_motion());
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  ASSERT_NO_FATAL_FAILURE(desire(kNone, kNone));
  run_for(GetParam().rests_within);
  EXPECT_LT(fastest_within(std::chrono::milliseconds(100)), 0.01) << reasons();
}

TEST_P(DriveConformance, AnAbsurdReferenceIsBrakedFrom) {
  ASSERT_NO_FATAL_FAILURE(start_in_motion());
  const Joints begin = positions();
  ASSERT_NO_FATAL_FAILURE(desire(1e9, 1e9));
  run_for(std::chrono::seconds(4));
  EXPECT_LT(fastest_within(std::chrono::milliseconds(100)), 0.01) << reasons();
  EXPECT_LT(apart(begin, positions()), GetParam().brakes_within) << reasons();
}

// --- restart -------------------------------------------------------------------------------------

TEST_P(DriveConformance, StoppedInMotionItRestsAndIsNotArmedWhenItStartsAgain) {
  ASSERT_NO_FATAL_FAILURE(start_in_motion());
  EXPECT_TRUE(application().stop().ok());
  ASSERT_NO_FATAL_FAILURE(start());
  expect_rest();
  put_back_into_service();
  GetParam().prepare(application());
  ASSERT_NO_FATAL_FAILURE(ask_to_arm());
  EXPECT_TRUE(armed()) << reasons();
}

}  // namespace armature::testing
