// SPDX-License-Identifier: Apache-2.0
// Everything that may break, at random times of a motion, many times over, in simulated time.
// Whatever it is: what the motors get stays within the limits, the head comes to rest within the
// time that was promised, does not move before it is armed again, and then does what it is told.
#include <algorithm>
#include <functional>
#include <random>

#include <gmock/gmock.h>

#include "tests/janus/experiment.hpp"

namespace armature::janus {
namespace {

using namespace std::chrono_literals;
using component::State;

constexpr int kTimes = 40;  ///< each breaks

/// A moving head, and what is always so.
class Head {
 public:
  explicit Head(const std::string& mode) : robot("pid.yaml", {"mode=" + mode}) {
    robot.start_armed();
    EXPECT_EQ(robot.move_to({3.0, 3.0}, 6.0), "");
  }
  SimulatedJanus& janus() {
    return *static_cast<SimulatedJanus*>(robot.application().find("Cards"));
  }
  Simulation& simulation() { return janus().simulation(); }
  void lose(int card, std::uint64_t count) {
    const auto answer = static_cast<std::uint32_t>(0x180 + card);
    simulation().bus().lose_next(count, can::Filter{.id = answer, .mask = 0x7ff});
  }
  bool off() {
    return simulation().card(0).state() != AicState::kOn &&
           simulation().card(1).state() != AicState::kOn;
  }

  /// Time passes for the head, too, when no Sample comes any more.
  void run_for(base::Duration duration) {
    const base::Time end = robot.application().now() + duration;
    while (robot.application().now() < end) {
      robot.run_for(10ms);
      const base::Time now = robot.application().now();
      if (simulation().now() < now) simulation().advance_to(now);
      for (const char* joint : {"Joint1", "Joint2"}) {
        ASSERT_LE(std::abs(robot.value<control::LimitedEffort>(joint, "VoltageActuator")), 12.0);
      }
    }
  }
  Vector positions() { return {janus().position(0), janus().position(1)}; }

  /// What an operator does when the cause is gone.
  void put_back_into_service() {
    exec::Application& application = robot.application();
    for (int round = 0; round < 3; ++round) {
      for (const auto& entry : application.blueprint().components) {
        const std::string& name = entry.component->name();
        if (robot.state(name.c_str()) == State::kException) {
          static_cast<void>(application.reset_component(name));
        }
        if (robot.state(name.c_str()) == State::kStopped) {
          static_cast<void>(application.start_component(name));
        }
      }
      run_for(20ms);
    }
  }

  Robot robot;
};

struct Breakage {
  const char* name;
  std::function<void(Head&, int card)> happens;
  std::function<void(Head&)> ends;
  base::Duration off_within;  ///< 0: the motion goes on
};

class Campaign : public ::testing::TestWithParam<Breakage> {};

TEST_P(Campaign, AtAnyTimeItEndsAsPromised) {
  const Breakage& breakage = GetParam();
  std::mt19937 random(20261121);
  for (int run = 0; run < kTimes; ++run) {
    SCOPED_TRACE("run " + std::to_string(run));
    Head head(run % 2 == 0 ? "synchronous" : "sequential");
    head.run_for(std::chrono::milliseconds(500 + random() % 5000));
    breakage.happens(head, 1 + run / 2 % 2);
    if (breakage.off_within == 0ms) {
      head.run_for(8s);
      ASSERT_NEAR(head.positions()[0], 3.0, 0.03);
      ASSERT_NEAR(head.positions()[1], 3.0, 0.03);
      continue;
    }
    head.run_for(breakage.off_within);
    ASSERT_TRUE(head.off());
    ASSERT_FALSE(head.robot.value<bool>("Joint1", "Armed"));
    ASSERT_FALSE(head.robot.value<bool>("Joint2", "Armed"));
    head.run_for(4s);  // joint 1 has no brake, and may coast
    const Vector rest = head.positions();
    breakage.ends(head);
    head.run_for(100ms);
    head.put_back_into_service();
    head.run_for(1s);
    ASSERT_TRUE(head.off()) << "nothing arms itself";
    ASSERT_NEAR(head.positions()[0], rest[0], 1e-4);
    ASSERT_NEAR(head.positions()[1], rest[1], 2e-3);
    const Vector believed{head.robot.value<double>("Joint1", "Position"),
                          head.robot.value<double>("Joint2", "Position")};
    head.robot.arm();
    ASSERT_EQ(head.robot.move_to({believed[0] * 0.9, believed[1] * 0.9}, 1.0), "");
    head.run_for(3s);
    ASSERT_NEAR(head.robot.value<double>("Joint1", "Position"), believed[0] * 0.9, 2e-3);
    ASSERT_NEAR(head.robot.value<double>("Joint2", "Position"), believed[1] * 0.9, 2e-3);
  }
}

const auto kNothing = [](Head&) {};

INSTANTIATE_TEST_SUITE_P(
    Everything, Campaign,
    ::testing::Values(
        Breakage{"OneReportLost", [](Head& head, int card) { head.lose(card, 1); }, kNothing, 0ms},
        Breakage{"TwoReportsLost", [](Head& head, int card) { head.lose(card, 2); }, kNothing, 0ms},
        Breakage{
            "CardSilent",
            [](Head& head, int card) {
              head.simulation().card(static_cast<std::size_t>(card - 1)).station().set_dead(true);
            },
            [](Head& head) {
              for (std::size_t card = 0; card < kJoints; ++card) {
                head.simulation().card(card).station().set_dead(false);
              }
            },
            200ms},
        Breakage{"BusCut", [](Head& head, int) { head.simulation().bus().set_cut(true); },
                 [](Head& head) { head.simulation().bus().set_cut(false); }, 200ms},
        Breakage{"BusOff", [](Head& head, int) { head.janus().station().force_bus_off(); },
                 kNothing, 200ms},
        Breakage{"CardRestarts",
                 [](Head& head, int card) {
                   base::Diagnostics diagnostics;
                   AicFirmware& firmware =
                       head.simulation().card(static_cast<std::size_t>(card - 1));
                   firmware.power_off();
                   ASSERT_TRUE(firmware.power_on(diagnostics)) << diagnostics.to_text();
                 },
                 kNothing, 200ms},
        Breakage{"GeneratorStops",
                 [](Head& head, int) {
                   ASSERT_TRUE(head.robot.application().stop_component("Generator"));
                 },
                 kNothing, 300ms},
        Breakage{"SamplerStops",
                 [](Head& head, int) {
                   ASSERT_TRUE(head.robot.application().stop_component("Sampler"));
                 },
                 kNothing, 300ms},
        Breakage{"EmergencyStop",
                 [](Head& head, int) { ASSERT_EQ(head.robot.call("Arming", "disarm"), ""); },
                 kNothing, 600ms}),
    [](const auto& breakage) { return std::string(breakage.param.name); });

}  // namespace
}  // namespace armature::janus
