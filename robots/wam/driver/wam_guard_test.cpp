// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/driver/wam_guard.hpp"

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "robots/wam/driver/test_hosted_bench.hpp"

namespace armature::wam {
namespace {

using guardian::Orders;

Orders orders_of(const Hosted& arm) {
  return guard_orders(arm.driver->arm(), "can0", Hosted::kPeriod);
}

/// Sends `frames` as a guardian does, beside the host.
void send(Hosted& arm, const std::vector<can::Frame>& frames) {
  for (const can::Frame& frame : frames) {
    EXPECT_EQ(arm.host.send(frame), can::SendStatus::kSent);
  }
  arm.advance(std::chrono::milliseconds(3));
}

/// The devices of which an answer is in the log.
std::size_t idle_devices(const Hosted& arm, const Orders& orders) {
  std::vector<bool> idle(orders.answers.size());
  for (const can::WireEvent& event : arm.log) {
    for (const guardian::IdleAnswer& answer : orders.answers) {
      bool matches = event.frame.id == answer.frame.id;
      for (std::size_t i = 0; matches && i < answer.mask.size(); ++i) {
        matches = ((event.frame.data[i] ^ answer.frame.data[i]) & answer.mask[i]) == 0;
      }
      if (matches) idle[answer.device] = true;
    }
  }
  return static_cast<std::size_t>(std::ranges::count(idle, true));
}

class WamGuard : public ::testing::TestWithParam<std::size_t> {};

TEST_P(WamGuard, BrakesAnArmThatIsDriven) {
  Hosted arm(GetParam());
  arm.start_active();
  arm.torques.fill(0.05);
  arm.run(20);
  send(arm, orders_of(arm).safe);
  for (std::size_t motor = 0; motor < GetParam(); ++motor) {
    EXPECT_TRUE(arm.rotors.braked(motor)) << motor;
    EXPECT_EQ(arm.emulator->puck(motor).mode(), PuckMode::kIdle) << motor;
  }
}

TEST_P(WamGuard, HasNoFrameThatDrivesAMotorWhateverTheArmDoes) {
  for (const bool driven : {true, false}) {
    Hosted arm(GetParam());
    driven ? arm.start_active() : arm.start();
    const Orders orders = orders_of(arm);
    for (const auto* frames : {&orders.safe, &orders.questions}) {
      for (const can::Frame& frame : *frames) {
        send(arm, {frame});
        for (std::size_t motor = 0; motor < GetParam(); ++motor) {
          EXPECT_EQ(arm.rotors.torque(motor), 0.0);
          EXPECT_EQ(arm.rotors.velocity(motor), 0.0);
        }
      }
    }
    EXPECT_EQ(arm.board().mode(), driven ? BoardMode::kActive : BoardMode::kIdle);
  }
}

TEST_P(WamGuard, HasWhatTheDriverSendsWhenItStops) {
  Hosted arm(GetParam());
  arm.start();
  arm.driver->send_idle();
  arm.advance(std::chrono::milliseconds(3));
  const Orders orders = orders_of(arm);
  ASSERT_FALSE(arm.log.empty());
  for (const can::WireEvent& event : arm.log) {
    EXPECT_EQ(std::ranges::count(orders.safe, event.frame), 1);
  }
}

TEST_P(WamGuard, KnowsThatEveryPuckIsIdleByItsAnswerAndNotBefore) {
  for (const ReplyWidth width : {ReplyWidth::kByType, ReplyWidth::kAlwaysSix}) {
    Emulator::Config config = Emulator::standard(GetParam());
    for (Puck::Config& puck : config.pucks) puck.replies = width;
    Hosted arm(config);
    arm.start_active();
    const Orders orders = orders_of(arm);
    send(arm, orders.questions);
    EXPECT_EQ(idle_devices(arm, orders), 0u);
    send(arm, orders.safe);
    EXPECT_EQ(idle_devices(arm, orders), 0u);
    send(arm, orders.questions);
    EXPECT_EQ(idle_devices(arm, orders), GetParam());
  }
}

TEST_P(WamGuard, ItsOrdersCanBeFollowed) {
  Hosted arm(GetParam());
  arm.start();
  EXPECT_EQ(guardian::problem_of(orders_of(arm)), "");
}

INSTANTIATE_TEST_SUITE_P(Arms, WamGuard, ::testing::Values(4u, 7u), [](const auto& arm) {
  return "With" + std::to_string(arm.param) + "Joints";
});

}  // namespace
}  // namespace armature::wam
