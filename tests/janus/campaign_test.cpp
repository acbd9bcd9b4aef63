// SPDX-License-Identifier: Apache-2.0
// Everything that may break, at random times of a motion, many times over, in simulated time.
// Whatever it is: what the motors get stays within the limits, the head comes to rest within the
// time that was promised, does not move before it is armed again, and then does what it is told.
//
//     JANUS_CAMPAIGN_RUNS=1000 janus_deployed_campaign    as many runs of each
//     JANUS_CAMPAIGN_RUN=16 janus_deployed_campaign       that run of each, such as one that failed
#include <algorithm>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>

#include "armature/component/interface.hpp"
#include "tests/campaign/runs.hpp"
#include "tests/janus/experiment.hpp"

namespace armature::janus {
namespace {

using namespace std::chrono_literals;
using component::State;

/// Unless more are asked for.
constexpr int kRuns = 10;

/// A moving head, and what is always so.
class Head {
 public:
  /// @param its_run  by which modes of the bus and cards take turns
  explicit Head(int its_run)
      : run(its_run), robot("pid.yaml", {run % 2 == 0 ? "mode=synchronous" : "mode=sequential"}) {
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
  bool passes_efforts(const char* joint) {
    return robot.state(joint) == State::kRunning && robot.value<bool>(joint, "Armed");
  }
  Vector positions() { return {janus().position(0), janus().position(1)}; }

  /// From now on somebody sends frames that mean nothing, as many as there is room for.
  void fill_bus_with(std::uint32_t first_identifier) {
    garbage = &simulation().bus().add_station("garbage");
    base::Diagnostics diagnostics;
    ASSERT_TRUE(garbage->open({}, diagnostics)) << diagnostics.to_text();
    simulation().bus().set_tap([this, first_identifier, n = 0u](const can::WireEvent&) mutable {
      send_garbage(first_identifier, n++);
    });
    send_garbage(first_identifier, 0);
    send_garbage(first_identifier, 1);
  }
  void send_garbage(std::uint32_t first_identifier, unsigned n) {
    can::Frame frame;
    frame.id = first_identifier + n % 8;
    frame.size = 8;
    for (std::uint8_t& byte : frame.data) byte = static_cast<std::uint8_t>(37 * n);
    garbage->send(frame);
  }
  void end_garbage() {
    simulation().bus().set_tap({});
    garbage->close();
  }

  /// Has `component` write something that its code would not.
  template <typename T>
  void write(const std::string& component, std::string_view port, const T& value) {
    component::Component& writer = *robot.application().find(component);
    for (component::OutputPortBase* output : component::interface_of(writer).outputs) {
      if (output->name() != port) continue;
      ASSERT_TRUE(
          robot.application().run_in_thread_of(writer, [&] { output->write_from(&value); }));
      return;
    }
    FAIL() << component << " has no output " << port;
  }
  void throw_in(const std::string& component) {
    robot.application().run_in_thread_of(*robot.application().find(component),
                                         [] { throw std::runtime_error("out of order"); });
  }

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

  int card() const { return 1 + run / 2 % 2; }

  const int run;
  Robot robot;
  can::VirtualStation* garbage = nullptr;
};

struct Breakage {
  const char* name;
  std::function<void(Head&, int card)> happens;
  std::function<void(Head&)> ends;
  base::Duration off_within;  ///< 0: the motion goes on
  int runs = kRuns;
};

/// Each component on the way, of both cards, in both modes of the bus.
constexpr int kEachOnTheWay = 11 * 2 * 2;

/// The n-th of what is on the way from the generator to the motors.
std::string component_on_the_way(int n, int card) {
  const std::string number = std::to_string(card);
  const std::string names[] = {"Generator", "BridgeRef",      "Controller",   "PID" + number,
                               "Actuator",  "Joint" + number, "AIC" + number, "Cards",
                               "Sensor",    "Sampler",        "Arming"};
  return names[static_cast<std::size_t>(n) % std::size(names)];
}

/// Writes a number that is none at the n-th place of the way to the motors: where it is used at
/// once, and not written over by the next good one.
void write_no_number(Head& head, int n, int card) {
  const double none = n % 2 == 0 ? std::numeric_limits<double>::quiet_NaN()
                                 : std::numeric_limits<double>::infinity();
  const std::string joint = "Joint" + std::to_string(card);
  switch (n / 2 % 5) {
    case 0:
      return head.write(joint, "Position", none);
    case 1:
      return head.write(joint, "Displacement", none);
    case 2:
      return head.write("Sensor", "sensor", Vector{0.0, none, 0.0, 0.0});
    case 3:
      return head.write("Controller", "act", Vector{0.0, none});
    default:
      ASSERT_TRUE(head.robot.application().stop_component("Generator"));
      for (const char* part : {"Position", "Velocity", "Acceleration"}) {
        head.write("Generator", std::string("nAxesDesired") + part, Vector{none, 0.0});
      }
  }
}

/// A run that fails does not keep the others from being made.
void make_runs(const std::string& name, int in_tests, const std::function<void(int)>& run) {
  campaign::Account account;
  campaign::make_runs("JANUS", name, account, run, in_tests);
  campaign::print_failed(name, account);
}

class Campaign : public ::testing::TestWithParam<Breakage> {};

void break_once(const Breakage& breakage, int run) {
  std::mt19937 random(static_cast<unsigned>(20261121 + run));
  Head head(run);
  head.run_for(std::chrono::milliseconds(500 + random() % 5000));
  breakage.happens(head, head.card());
  if (breakage.off_within == 0ms) {
    head.run_for(8s);
    ASSERT_NEAR(head.positions()[0], 3.0, 0.03);
    ASSERT_NEAR(head.positions()[1], 3.0, 0.03);
    return;
  }
  head.run_for(breakage.off_within);
  ASSERT_TRUE(head.off());
  ASSERT_FALSE(head.passes_efforts("Joint1"));
  ASSERT_FALSE(head.passes_efforts("Joint2"));
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

TEST_P(Campaign, AtAnyTimeItEndsAsPromised) {
  make_runs(GetParam().name, GetParam().runs, [](int run) { break_once(GetParam(), run); });
}

/// The largest acceleration with which a joint of the head moves for so long [rad/s^2].
double largest_acceleration(Head& head, base::Duration duration) {
  double largest = 0.0;
  Vector before = head.positions();
  head.run_for(10ms);
  Vector now = head.positions();
  for (base::Duration passed{}; passed < duration; passed += 10ms) {
    head.run_for(10ms);
    const Vector next = head.positions();
    for (std::size_t i = 0; i < kJoints; ++i) {
      largest = std::max(largest, std::abs(next[i] - 2.0 * now[i] + before[i]) / 1e-4);
    }
    before = now;
    now = next;
  }
  return largest;
}

void lose_reference_once(int run) {
  std::mt19937 random(static_cast<unsigned>(20261122 + run));
  Head head(run);
  // Not while the effort is still limited after arming: who has none cannot brake.
  head.run_for(std::chrono::milliseconds(1200 + random() % 4500));
  ASSERT_TRUE(head.robot.application().stop_component("Generator"));
  ASSERT_LT(largest_acceleration(head, 1s), 10.0) << "twice that of the reference";
  const Vector rest = head.positions();
  head.run_for(1s);
  ASSERT_EQ(head.robot.value<int>("Controller", "brakings"), 1);
  ASSERT_NEAR(head.positions()[0], rest[0], 1e-4);
  ASSERT_NEAR(head.positions()[1], rest[1], 1e-4);
  ASSERT_TRUE(head.robot.application().start_component("Generator"));
  head.run_for(1s);
  ASSERT_NEAR(head.positions()[0], rest[0], 1e-3) << "the old motion is not gone on with";
  ASSERT_NEAR(head.positions()[1], rest[1], 1e-3);
  ASSERT_TRUE(head.robot.value<bool>("Arming", "armed"));
  ASSERT_EQ(head.robot.move_to({1.0, 2.0}, 3.0), "");
  head.run_for(4s);
  ASSERT_NEAR(head.positions()[0], 1.0, 1e-3);
  ASSERT_NEAR(head.positions()[1], 2.0, 1e-3);
}

TEST(CampaignOfReferences, AtAnyTimeTheHeadBrakesSmoothlyAndGoesOnWithoutBeingArmedAgain) {
  make_runs("ReferenceLost", kRuns, lose_reference_once);
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
        Breakage{"GarbageOfLittleUrgency", [](Head& head, int) { head.fill_bus_with(0x7f0); },
                 kNothing, 0ms},
        Breakage{"GarbageOfGreatUrgency", [](Head& head, int) { head.fill_bus_with(0x010); },
                 [](Head& head) { head.end_garbage(); }, 200ms},
        Breakage{"AComponentThrows",
                 [](Head& head, int card) { head.throw_in(component_on_the_way(head.run, card)); },
                 kNothing, 300ms, kEachOnTheWay},
        Breakage{"ANumberIsNone",
                 [](Head& head, int card) { write_no_number(head, head.run, card); }, kNothing,
                 300ms, kEachOnTheWay},
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
