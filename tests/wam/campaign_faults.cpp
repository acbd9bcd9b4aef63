// SPDX-License-Identifier: Apache-2.0
#include "tests/wam/campaign_faults.hpp"

#include <chrono>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

#include "armature/can/frame.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;

Puck& any_puck(CampaignArm& arm, Random& random) {
  return arm.emulator().puck(random() % arm.joints());
}

/// Dead for that many cycles.
std::function<void(CampaignArm&, Random&)> die_for(int cycles) {
  return [cycles](CampaignArm& arm, Random& random) {
    Puck& puck = any_puck(arm, random);
    puck.set_dead(true);
    for (int i = 0; i < cycles; ++i) arm.cycle();
    puck.set_dead(false);
  };
}

void answer_late(CampaignArm& arm, Random& random, int cycles) {
  Puck& puck = any_puck(arm, random);
  puck.delay_replies(1500us);
  for (int i = 0; i < cycles; ++i) arm.cycle();
  puck.delay_replies({});
}

/// The host computes, or sleeps, and the arm hears nothing of it.
void be_silent(CampaignArm& arm, Random&) {
  arm.emulator().advance_to(arm.emulator().now() + 150ms);
}

void restart_puck(CampaignArm& arm, Random& random) {
  Puck& puck = any_puck(arm, random);
  puck.set_power(false);
  arm.cycle();
  puck.set_power(true);
}

/// The board takes such a jump of the lower arm for a velocity.
void lose_zero(CampaignArm& arm, Random& random) {
  const Puck& puck = any_puck(arm, random);
  arm.link().station().send(set_frame(
      to_node(puck.node()), arm.hardware().driver().arm().position_number, puck.counts() + 20000));
}

/// Of a puck of the lower arm, where they are far from being right.
void tell_wrong_middle_bits(CampaignArm& arm, Random& random) {
  int node = node_for(OfPuck::kLowerArm, arm, random);
  const auto nearly_right = [&] {
    const auto counts = arm.emulator().puck(static_cast<std::size_t>(node - 1)).counts();
    return (counts >> 8 & 0xff) < 16;  // they become 1
  };
  for (int i = 0; i < 4 && nearly_right(); ++i) node = node % 4 + 1;
  ASSERT_FALSE(nearly_right());
  arm.tell_emulator("fault puck N wrong-byte 1", node);
}

/// Somebody who sends frames, as many as there is room for.
class Garbage {
 public:
  using Make = std::function<can::Frame(unsigned)>;

  Garbage(CampaignArm& arm, Make make)
      : station_(arm.emulator().bus().add_station("garbage")), make_(std::move(make)) {
    can::BusOptions options;
    options.own_frames = true;
    options.on_news = [this] { take_news(); };
    base::Diagnostics diagnostics;
    EXPECT_TRUE(station_.open(options, diagnostics)) << diagnostics.to_text();
    for (int i = 0; i < 2; ++i) send();
  }
  void end() { station_.close(); }

 private:
  void send() { station_.send(make_(n_++)); }
  /// Each that got through makes room for another.
  void take_news() {
    can::Arrival arrival;
    while (station_.receive(arrival) == can::ReceiveStatus::kReceived) {
      if (arrival.own) send();
    }
  }

  can::VirtualStation& station_;
  Make make_;
  unsigned n_ = 0;
};

can::Frame garbage_frame(std::uint32_t id, std::uint8_t size, unsigned n) {
  can::Frame frame;
  frame.id = id;
  frame.size = size;
  for (std::uint8_t i = 0; i < size; ++i) frame.data[i] = static_cast<std::uint8_t>(37 * n + i);
  return frame;
}

/// Whose frames begin at a random moment of a cycle.
Breakage flooded(const char* name, const Breakage& promised, Garbage::Make make) {
  auto garbage = std::make_shared<std::unique_ptr<Garbage>>();
  return {.name = name,
          .happens = [=](CampaignArm& arm,
                         Random&) { *garbage = std::make_unique<Garbage>(arm, make); },
          .after = promised.after,
          .said = promised.said,
          .ends =
              [=](CampaignArm& arm) {
                (*garbage)->end();
                if (!promised.brakes) arm.board().estop();
              },
          .brakes = promised.brakes};
}

/// The n-th of what is on the way from the generator to the arm.
std::string component_on_the_way(CampaignArm& arm, std::size_t n) {
  std::vector<std::string> names{"Generator", "BridgeRef", "Controller",
                                 "Actuator",  "Sensor",    "Arming"};
  for (std::size_t joint = 1; joint <= arm.joints(); ++joint) {
    const std::string pid = "PID" + std::to_string(joint);
    if (arm.application().find(pid) != nullptr) names.push_back(pid);
  }
  return names[n % names.size()];
}

void throw_in(CampaignArm& arm, const std::string& component) {
  arm.application().run_in_thread_of(*arm.application().find(component),
                                     [] { throw std::runtime_error("out of order"); });
}

/// At the n-th place of the way to the arm, where it is used at once, and not written over by the
/// next good one.
void write_no_number(CampaignArm& arm, Random& random) {
  const double none = random() % 2 == 0 ? std::numeric_limits<double>::quiet_NaN()
                                        : std::numeric_limits<double>::infinity();
  const auto with_none = [&](std::size_t size) {
    Vector all(size, 0.0);
    all[random() % arm.joints()] = none;
    return all;
  };
  switch (random() % 5) {
    case 0:
      return arm.write("WAM", "jointsDataPort", with_none(3 * arm.joints()));
    case 1:
      return arm.write("Sensor", "sensor", with_none(2 * arm.joints()));
    case 2:
      return arm.write("BridgeRef", "reference", with_none(3 * arm.joints()));
    case 3:
      return arm.write("Controller", "act", with_none(arm.joints()));
    default:
      ASSERT_TRUE(arm.application().stop_component("Generator"));
      for (const char* part : {"Position", "Velocity", "Acceleration"}) {
        arm.write("Generator", std::string("nAxesDesired") + part, with_none(arm.joints()));
      }
  }
}

/// In the place of the controller's torques, which would come first.
void send_no_number(CampaignArm& arm, Random& random) {
  ASSERT_TRUE(arm.application().stop_component("Controller"));
  arm.cycle();
  Vector torques(arm.joints(), 0.0);
  torques[random() % arm.joints()] = std::numeric_limits<double>::quiet_NaN();
  arm.write("Actuator", "Torque", torques);
}

}  // namespace

int node_for(OfPuck puck, CampaignArm& arm, Random& random) {
  const auto joints = static_cast<int>(arm.joints());
  const int first = puck == OfPuck::kWrist ? 5 : 1;
  const int last = puck == OfPuck::kLowerArm ? 4 : joints;
  return first + static_cast<int>(random() % static_cast<unsigned>(last - first + 1));
}

void break_arm(const Breakage& breakage, CampaignArm& arm, Random& random) {
  if (breakage.happens) return breakage.happens(arm, random);
  arm.tell_emulator(breakage.command, node_for(breakage.puck, arm, random));
}

std::vector<Breakage> breakages() {
  const auto puts_right = [](CampaignArm& arm) {
    for (std::size_t i = 0; i < arm.joints(); ++i) {
      arm.emulator().puck(i).set_dead(false);
      arm.emulator().puck(i).delay_replies({});
    }
    arm.board().estop();
  };
  const auto stop = [](const char* component) {
    return [component](CampaignArm& arm, Random&) {
      ASSERT_TRUE(arm.application().stop_component(component));
    };
  };
  return {
      {.name = "OneReplyLost", .command = "fault puck N lose 1"},
      // Who owes an answer is left out of the next request: three cycles without a position.
      {.name = "TwoRepliesLost",
       .command = "fault puck N lose 2",
       .after = After::kFault,
       .said = "is silent"},
      {.name = "ThreeRepliesLost",
       .command = "fault puck N lose 3",
       .after = After::kFault,
       .said = "is silent"},
      {.name = "AReplyLostOfEachPuck",
       .happens =
           [](auto& arm, auto&) {
             for (std::size_t i = 0; i < arm.joints(); ++i) arm.emulator().puck(i).lose_replies(1);
           }},
      {.name = "LateReply",
       .happens = [](auto& arm, auto& random) { answer_late(arm, random, 1); }},
      {.name = "LateReplies",
       .happens = [](auto& arm, auto& random) { answer_late(arm, random, 4); },
       .after = After::kFault,
       .said = "is silent"},
      {.name = "DeadPuck",
       .command = "fault puck N silent",
       .after = After::kLost,
       .said = "is silent, and may drive on",
       .ends = puts_right},
      // Nobody knows whether it hears.
      {.name = "PuckThatIsAlwaysLate",
       .command = "fault puck N delay 1.5",
       .after = After::kLost,
       .said = "is silent, and may drive on",
       .ends = puts_right},
      {.name = "AnswerOfAWrongLength", .command = "fault puck N wrong-length 1"},
      {.name = "AnswersThatComeTwice", .command = "fault puck N twice 10"},
      // Of a position these are other numbers.
      {.name = "WristTellsWrongUpperBits",
       .command = "fault puck N wrong-property 1",
       .puck = OfPuck::kWrist},
      {.name = "WristTellsWrongMiddleBits",
       .command = "fault puck N wrong-byte 1",
       .puck = OfPuck::kWrist},
      {.name = "LowerArmTellsWrongUpperBits",
       .command = "fault puck N wrong-property 1",
       .puck = OfPuck::kLowerArm,
       .after = After::kFault,
       .said = "velocity fault"},
      {.name = "LowerArmTellsWrongMiddleBits",
       .happens = tell_wrong_middle_bits,
       .after = After::kFault,
       .said = "velocity fault"},
      {.name = "BusOffOfAPuck", .command = "fault puck N bus-off"},
      {.name = "PuckThatComesBackInTime", .happens = die_for(1)},
      {.name = "PuckThatComesBackTooLate",
       .happens = die_for(10),
       .after = After::kFault,
       .said = "is silent"},
      {.name = "VelocityFault",
       .command = "fault board velocity",
       .after = After::kFault,
       .said = "velocity fault"},
      {.name = "TorqueFault",
       .command = "fault board torque",
       .after = After::kFault,
       .said = "torque fault"},
      {.name = "HeartbeatFault",
       .command = "fault board heartbeat",
       .after = After::kFault,
       .said = "heartbeat fault"},
      {.name = "VoltageFault",
       .command = "fault board voltage",
       .after = After::kFault,
       .said = "voltage fault"},
      {.name = "FaultThatTheBoardDoesNotName",
       .command = "fault board other",
       .after = After::kFault,
       .said = "does not name"},
      {.name = "WeakSupply",
       .command = "fault board supply 25",
       .after = After::kFault,
       .said = "voltage fault",
       .ends = [](auto& arm) { arm.board().set_supply(48.0); }},
      {.name = "HeartbeatLostByASilentHost",
       .happens = be_silent,
       .after = After::kFault,
       .said = "heartbeat fault"},
      {.name = "HeartbeatLostByAnUnpluggedHost",
       .happens = [](auto& arm, auto&) { arm.link().station().set_dead(true); },
       .after = After::kFault,
       .said = "is silent",
       .ends = [](auto& arm) { arm.link().station().set_dead(false); }},
      {.name = "HeartbeatLostByACutBus",
       .command = "fault bus cut",
       .after = After::kLost,
       .said = "is silent",
       .ends =
           [](auto& arm) {
             arm.emulator().bus().set_cut(false);
             arm.board().estop();
           },
       .brakes = false},
      {.name = "BusOff",
       .happens = [](auto& arm, auto&) { arm.link().station().force_bus_off(); },
       .after = After::kFault,
       .said = "the bus is off or unplugged"},
      {.name = "SilentBoard",
       .command = "fault board silent",
       .after = After::kFault,
       .said = "the safety board is silent",
       .ends = [](auto& arm) { arm.board().set_dead(false); }},
      {.name = "BoardLosesAnswers", .command = "fault board lose 2"},
      {.name = "BoardLosesAllAnswers",
       .command = "fault board lose 1000",
       .after = After::kFault,
       .said = "the safety board is silent",
       .ends = [](auto& arm) { arm.board().lose_replies(0); }},
      {.name = "BoardIsLate",
       .command = "fault board delay 5",
       .ends = [](auto& arm) { arm.board().delay_replies({}); }},
      {.name = "BoardIsTooLate",
       .command = "fault board delay 20",
       .after = After::kFault,
       .said = "the safety board is silent",
       .ends = [](auto& arm) { arm.board().delay_replies({}); }},
      {.name = "AFrameLost", .command = "fault bus lose 1"},
      {.name = "ManyFramesLost",
       .command = "fault bus lose 40",
       .after = After::kFault,
       .said = "is silent"},
      {.name = "FramesDestroyed", .command = "fault bus corrupt 5"},
      {.name = "ManyFramesDestroyed",
       .command = "fault bus corrupt 40",
       .after = After::kFault,
       .said = "the bus is off or unplugged"},
      {.name = "EmergencyStop",
       .happens = [](auto& arm, auto&) { arm.board().estop(); },
       .after = After::kLost,
       .said = "E-stop, positions are lost"},
      {.name = "ShiftIdle",
       .happens = [](auto& arm, auto&) { arm.board().shift_idle(); },
       .after = After::kIdled,
       .said = "the operator has idled the arm"},
      {.name = "PuckRestarts", .happens = restart_puck, .after = After::kLost, .said = "is silent"},
      {.name = "PuckLosesItsZero",
       .happens = lose_zero,
       .after = After::kLost,
       .said = "told a position that cannot be",
       // The board does not know of it, so the pucks are told where home is only after E-stop.
       .ends = [](auto& arm) { arm.board().estop(); }},
      flooded("GarbageOfLittleUrgency", {},
              [](unsigned n) { return garbage_frame(0x7f0 + n % 8, 8, n); }),
      flooded("GarbageForTheHost", {},
              [](unsigned n) {
                return garbage_frame(n % 2 == 0 ? 0x7e3 : 0x7e6, static_cast<std::uint8_t>(n % 9),
                                     n);
              }),
      flooded("GarbageOfGreatUrgency",
              {.after = After::kLost, .said = "is silent", .brakes = false},
              [](unsigned n) { return garbage_frame(0x010 + n % 8, 8, n); }),
      {.name = "AComponentThrows",
       .happens = [](auto& arm,
                     auto& random) { throw_in(arm, component_on_the_way(arm, random())); },
       .after = After::kHeld},
      {.name = "TheHardwareThrows",
       .happens = [](auto& arm, auto&) { throw_in(arm, "WAM"); },
       .after = After::kFault,
       .said = "out of order"},
      {.name = "TheSamplerThrows",
       .happens = [](auto& arm, auto&) { throw_in(arm, "Sampler"); },
       .after = After::kHeld},
      // Away from home nothing would be held without it: that is refused.
      {.name = "SamplerStops",
       .happens =
           [](auto& arm, auto&) {
             for (int i = 0; i < 2000 && arm.application().held().empty(); ++i) arm.cycle();
             EXPECT_FALSE(arm.application().stop_component("Sampler"));
           }},
      {.name = "ANumberIsNone", .happens = write_no_number, .after = After::kHeld},
      {.name = "ATorqueIsNoNumber",
       .happens = send_no_number,
       .after = After::kHeld,
       .said = "a torque is not a finite number"},
      {.name = "TorquesStayAway",
       .happens = stop("Controller"),
       .after = After::kHeld,
       .said = "torques have stopped coming"},
      {.name = "ReferenceGoesStale", .happens = stop("Generator"), .after = After::kBrakes},
      {.name = "Disarmed",
       .happens = [](auto& arm, auto&) { EXPECT_EQ(arm.call("Arming", "disarm"), ""); },
       .after = After::kHeld,
       .said = "the operator disarmed it"},
      {.name = "Stopped",
       .happens = [](auto& arm, auto&) { EXPECT_EQ(arm.call("Arming", "stop"), ""); },
       .after = After::kBrakes},
  };
}

}  // namespace armature::wam
