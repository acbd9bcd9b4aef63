// SPDX-License-Identifier: Apache-2.0
#include "tests/drives/campaign_faults.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

#include "armature/can/frame.hpp"
#include "drives/canopen/cob_id.hpp"
#include "drives/canopen/nmt.hpp"

namespace armature::cia402 {
namespace {

using namespace std::chrono_literals;

using Happens = std::function<void(CampaignArm&, Random&)>;

std::size_t any_joint(Random& random) { return random() % CampaignArm::kJoints; }
EmulatedDrive& any_drive(CampaignArm& arm, Random& random) { return arm.drive(any_joint(random)); }
std::string numbered(const char* name, std::size_t joint) {
  return name + std::to_string(joint + 1);
}

/// What any drive does or has from now on.
Happens drive_does(void (*act)(EmulatedDrive&)) {
  return [act](CampaignArm& arm, Random& random) { act(any_drive(arm, random)); };
}
void mend(CampaignArm& arm) {
  for (std::size_t i = 0; i < CampaignArm::kJoints; ++i) {
    EmulatedDrive& drive = arm.drive(i);
    drive.set_deaf_to_sync(false);
    drive.set_frozen(false);
    drive.set_powerless(false);
    drive.device().set_stuck_pdos(false);
    drive.device().set_silent_heartbeat(false);
    arm.drives().station(i).set_dead(false);
  }
  arm.drives().bus().set_cut(false);
}

// --- on the bus ----------------------------------------------------------------------------------

can::Filter only(std::uint32_t id) { return {.id = id, .mask = 0x7ff}; }
canopen::NodeId any_node(Random& random) {
  return static_cast<canopen::NodeId>(any_joint(random) + 1);
}

Happens loses_answers(std::uint64_t count) {
  return [count](CampaignArm& arm, Random& random) {
    arm.drives().bus().lose_next(count, only(canopen::cob_id::transmit_pdo(1, any_node(random))));
  };
}
Happens loses_targets(std::uint64_t count) {
  return [count](CampaignArm& arm, Random& random) {
    arm.drives().bus().lose_next(count, only(canopen::cob_id::receive_pdo(1, any_node(random))));
  };
}
Happens loses_syncs(std::uint64_t count) {
  return [count](CampaignArm& arm, Random&) {
    arm.drives().bus().lose_next(count, only(canopen::cob_id::kSync));
  };
}

/// Another program on the bus says one thing.
void somebody_says(CampaignArm& arm, const can::Frame& frame) {
  can::VirtualStation& station = arm.drives().bus().add_station("somebody");
  base::Diagnostics diagnostics;
  ASSERT_TRUE(station.open({}, diagnostics)) << diagnostics.to_text();
  station.send(frame);
}
/// A control word that takes away what an enabled drive has.
can::Frame control_word(canopen::NodeId node, std::uint8_t word) {
  return can::data_frame(canopen::cob_id::sdo_request(node),
                         {0x2b, 0x40, 0x60, 0x00, word, 0, 0, 0});
}
void somebody_switches_off(CampaignArm& arm, Random& random) {
  constexpr std::array<std::uint8_t, 3> kWords{0x00, 0x02, 0x06};
  somebody_says(arm, control_word(any_node(random), kWords[random() % kWords.size()]));
}
/// The host's next control word enables it again, before the drive has said how it is.
void somebody_disables_for_less_than_a_cycle(CampaignArm& arm, Random& random) {
  somebody_says(arm, control_word(any_node(random), 0x07));
}
Happens somebody_commands(canopen::NmtCommand command) {
  return [command](CampaignArm& arm, Random& random) {
    somebody_says(arm, canopen::nmt_frame(command, any_node(random)));
  };
}

// --- drives --------------------------------------------------------------------------------------

void reboot(CampaignArm& arm, Random& random) {
  any_drive(arm, random).reboot(arm.drives().bus().now());
}
/// Another drive is in its place, which was exchanged too fast for its host to miss it.
void reboot_as_another(CampaignArm& arm, Random& random) {
  EmulatedDrive& drive = any_drive(arm, random);
  drive.reboot(arm.drives().bus().now());
  drive.set_identity({.vendor = 77, .product = 1, .revision = 1, .serial = 1});
}
/// Drives may be set up to start themselves; their PDOs are then those of their makers.
void reboot_and_start(CampaignArm& arm, Random& random) {
  const std::size_t joint = any_joint(random);
  arm.drive(joint).reboot(arm.drives().bus().now());
  somebody_says(arm, canopen::nmt_frame(canopen::NmtCommand::kStart,
                                        static_cast<canopen::NodeId>(joint + 1)));
}
void shift_encoder(CampaignArm& arm, Random& random) {
  std::uniform_real_distribution<double> by(0.1, 0.5);
  const double sign = random() % 2 == 0 ? 1.0 : -1.0;
  any_drive(arm, random).shift_encoder(sign * by(random));
}
/// The operator is quicker than the arm that brakes.
void fail_and_be_reset(CampaignArm& arm, Random& random) {
  const std::size_t joint = any_joint(random);
  arm.drive(joint).fail(0x2310);
  const auto cycles = 1 + random() % 20;
  for (std::size_t i = 0; i < cycles; ++i) arm.cycle();
  EXPECT_EQ(arm.call("Bus", "resetDrive", {types::Value::of(static_cast<int>(joint + 1))}), "");
}
void reset_a_sound_drive(CampaignArm& arm, Random& random) {
  const auto node = static_cast<int>(any_joint(random) + 1);
  EXPECT_EQ(arm.call("Bus", "resetDrive", {types::Value::of(node)}), "");
}

/// Nobody can know it as long as the joint is to stand: it is found when it is told to move.
Happens at_rest(void (*act)(EmulatedDrive&)) {
  return [act](CampaignArm& arm, Random& random) {
    arm.run_for(3200ms);
    const std::size_t joint = any_joint(random);
    act(arm.drive(joint));
    Vector target = arm.target();
    target[joint] += target[joint] > 0.0 ? -0.3 : 0.3;
    EXPECT_EQ(arm.move_to(target, 1.0), "");
  };
}

/// Fast and slow, far and hardly at all: what watches a drive has nothing to find.
void move_at_random(CampaignArm& arm, Random& random) {
  constexpr std::array<double, 3> kWays{0.002, 0.05, 1.0};  // rad
  arm.run_for(3200ms);
  for (int motion = 0; motion < 4; ++motion) {
    const double most = kWays[random() % kWays.size()];
    std::uniform_real_distribution<double> way(-most, most);
    Vector target = arm.target();
    for (double& angle : target) angle = std::clamp(angle + way(random), -1.2, 1.2);
    const double seconds = random() % 2 == 0 ? 0.0 : 2.5;
    EXPECT_EQ(arm.move_to(target, seconds), "");
    arm.run_for(3s);
  }
}
/// Of the joint that still has the longest way to go, as long as it is four times what it may be
/// off by.
Happens in_motion(void (*act)(EmulatedDrive&)) {
  return [act](CampaignArm& arm, Random& random) {
    const Vector now = arm.positions();
    const auto way = [&](std::size_t joint) { return std::abs(arm.target()[joint] - now[joint]); };
    std::size_t furthest = 0;
    for (std::size_t joint = 1; joint < CampaignArm::kJoints; ++joint) {
      if (way(joint) > way(furthest)) furthest = joint;
    }
    if (way(furthest) < 0.2) return at_rest(act)(arm, random);
    act(arm.drive(furthest));
  };
}

// --- the application -----------------------------------------------------------------------------

Happens stops(const char* component) {
  return [component](CampaignArm& arm, Random&) {
    ASSERT_TRUE(arm.application().stop_component(component));
  };
}
void throw_in(CampaignArm& arm, const std::string& component) {
  arm.application().run_in_thread_of(*arm.application().find(component),
                                     [] { throw std::runtime_error("out of order"); });
}
/// Of what is on the way from the generator to the drives, whose other users stop.
void component_throws(CampaignArm& arm, Random& random) {
  const std::size_t joint = any_joint(random);
  const std::array<std::string, 7> names{"BridgeRef",
                                         "Controller",
                                         "Actuator",
                                         "Sensor",
                                         "Arming",
                                         numbered("Joint", joint),
                                         numbered("Drive", joint)};
  throw_in(arm, names[random() % names.size()]);
}
/// Where it is used at once, and not written over by the next good one.
Happens writes(double number) {
  return [number](CampaignArm& arm, Random& random) {
    Vector all(3 * CampaignArm::kJoints, 0.0);
    all[any_joint(random)] = number;
    switch (random() % 3) {
      case 0:
        all.resize(2 * CampaignArm::kJoints);
        return arm.write("Sensor", "sensor", all);
      case 1:
        return arm.write("BridgeRef", "reference", all);
      default:
        all.resize(CampaignArm::kJoints);
        return arm.write("Controller", "act", all);
    }
  };
}
/// In place of the generator's, which is silent from then on.
void absurd_reference(CampaignArm& arm, Random& random) {
  ASSERT_TRUE(arm.application().stop_component("Generator"));
  Vector all = arm.believed();
  for (double& position : all) position = random() % 2 == 0 ? 1e9 : -1e9;
  arm.write("Generator", "nAxesDesiredPosition", all);
  arm.write("Generator", "nAxesDesiredVelocity", Vector(all.size(), 1e9));
  arm.write("Generator", "nAxesDesiredAcceleration", Vector(all.size(), -1e9));
}
void absurd_reference_until_disarmed(CampaignArm& arm, Random& random) {
  absurd_reference(arm, random);
  arm.run_for(std::chrono::milliseconds(2 + random() % 500));
  EXPECT_EQ(arm.call("Arming", "disarm"), "");
}
void disarm(CampaignArm& arm, Random&) { EXPECT_EQ(arm.call("Arming", "disarm"), ""); }
void brake(CampaignArm& arm, Random&) { EXPECT_EQ(arm.call("Arming", "stop"), ""); }

// --- what is promised ----------------------------------------------------------------------------

const std::vector<std::string> kNotAsTold{"to the bit", "the same values", "was told",
                                          "the drive failed"};

std::vector<Breakage> of_drives() {
  return {
      {.name = "NothingBreaks", .happens = move_at_random, .after = After::kGoesOn},
      {.name = "DriveFails",
       .happens = drive_does([](EmulatedDrive& drive) { drive.fail(0x2310); }),
       .said = {"the drive failed with error code 8976"}},
      {.name = "EmergencyWithoutAFault",
       .happens = drive_does([](EmulatedDrive& drive) { drive.device().report(0x4210, 0x09); }),
       .after = After::kGoesOn},
      {.name = "DriveHearsNoSync",
       .happens = drive_does([](EmulatedDrive& drive) { drive.set_deaf_to_sync(true); }),
       .said = {"the drive did not answer", "the drive failed"},
       .ends = mend},
      {.name = "HeartbeatLost",
       .happens =
           drive_does([](EmulatedDrive& drive) { drive.device().set_silent_heartbeat(true); }),
       .said = {"heartbeat is missing"},
       .ends = mend},
      {.name = "PdosStuck",
       .happens = drive_does([](EmulatedDrive& drive) { drive.device().set_stuck_pdos(true); }),
       .said = {"the drive did not answer"},
       .ends = mend},
      {.name = "StatusAndPositionFrozen",
       .happens = in_motion([](EmulatedDrive& drive) { drive.set_frozen(true); }),
       .said = kNotAsTold,
       .ends = mend},
      {.name = "StatusAndPositionFrozenAtRest",
       .happens = at_rest([](EmulatedDrive& drive) { drive.set_frozen(true); }),
       .said = kNotAsTold,
       .ends = mend},
      {.name = "DriveDoesNotObey",
       .happens = in_motion([](EmulatedDrive& drive) { drive.set_powerless(true); }),
       .said = kNotAsTold,
       .ends = mend},
      {.name = "DriveDoesNotObeyAtRest",
       .happens = at_rest([](EmulatedDrive& drive) { drive.set_powerless(true); }),
       .said = kNotAsTold,
       .ends = mend},
      {.name = "DriveDoesNotObeyWhereverItIs",
       .happens = drive_does([](EmulatedDrive& drive) { drive.set_powerless(true); }),
       .after = After::kStoppedOnceSeen,
       .said = kNotAsTold,
       .ends = mend},
      {.name = "FrozenWhereverItIs",
       .happens = drive_does([](EmulatedDrive& drive) { drive.set_frozen(true); }),
       .after = After::kStoppedOnceSeen,
       .said = kNotAsTold,
       .ends = mend},
      {.name = "EncoderJumps",
       .happens = shift_encoder,
       .said = {"says that it moved", "the drive failed"}},
      {.name = "DriveReboots", .happens = reboot, .after = After::kLost, .said = {"rebooted"}},
      {.name = "DriveRebootsAsAnother",
       .happens = reboot_as_another,
       .after = After::kLost,
       .said = {"rebooted"}},
      {.name = "DriveRebootsAndStartsItself",
       .happens = reboot_and_start,
       .after = After::kLost,
       .said = {"rebooted"}},
      {.name = "DriveIsResetInMotion",
       .happens = fail_and_be_reset,
       .said = {"the drive failed with error code 8976", "switched off by itself"}},
      {.name = "SoundDriveIsReset", .happens = reset_a_sound_drive, .after = After::kGoesOn},
  };
}

std::vector<Breakage> of_the_bus() {
  return {
      {.name = "OneAnswerLost", .happens = loses_answers(1), .after = After::kGoesOn},
      {.name = "TwoAnswersLost", .happens = loses_answers(2), .after = After::kGoesOn},
      {.name = "ManyAnswersLost",
       .happens = loses_answers(20),
       .said = {"the drive did not answer", "no sample", "not measured"}},
      {.name = "OneTargetLost", .happens = loses_targets(1), .after = After::kGoesOn},
      {.name = "OneSyncLost", .happens = loses_syncs(1), .after = After::kGoesOn},
      {.name = "ManySyncsLost",
       .happens = loses_syncs(20),
       .said = {"the drive did not answer", "the drive failed"}},
      {.name = "DriveIsDeadOnTheBus",
       .happens = [](CampaignArm& arm,
                     Random& random) { arm.drives().station(any_joint(random)).set_dead(true); },
       .said = {"the drive did not answer"},
       .ends = mend},
      {.name = "BusOff",
       .happens = [](CampaignArm& arm, Random&) { arm.host().station().force_bus_off(); },
       .after = After::kLost,
       .said = {"the bus of the drive is gone"}},
      {.name = "BusOffOfADrive",
       .happens = [](CampaignArm& arm,
                     Random& random) { arm.drives().station(any_joint(random)).force_bus_off(); },
       .after = After::kLost,
       .said = {"the drive did not answer"}},
      {.name = "BusIsCut",
       .happens = [](CampaignArm& arm, Random&) { arm.drives().bus().set_cut(true); },
       .said = {"the drive did not answer", "the bus of the drive is gone"},
       .ends = mend},
      {.name = "SomebodySwitchesADriveOff",
       .happens = somebody_switches_off,
       .said = {"switched off by itself"}},
      {.name = "SomebodyDisablesADriveForLessThanACycle",
       .happens = somebody_disables_for_less_than_a_cycle,
       .after = After::kGoesOn},
      {.name = "SomebodyStopsADrive",
       .happens = somebody_commands(canopen::NmtCommand::kStop),
       .after = After::kLost,
       .said = {"the drive did not answer"}},
      {.name = "SomebodyResetsADrive",
       .happens = somebody_commands(canopen::NmtCommand::kResetNode),
       .after = After::kLost,
       .said = {"rebooted"}},
  };
}

std::vector<Breakage> of_the_application() {
  return {
      {.name = "ANumberIsNone",
       .happens = writes(std::numeric_limits<double>::quiet_NaN()),
       .said = {"not finite", "no number", "nan"}},
      {.name = "ANumberIsInfinite",
       .happens = writes(std::numeric_limits<double>::infinity()),
       .said = {"not finite", "no number", "inf"}},
      {.name = "ReferenceIsAbsurdAndSilentThen",
       .happens = absurd_reference,
       .after = After::kRests},
      {.name = "ReferenceIsAbsurdUntilDisarmed",
       .happens = absurd_reference_until_disarmed,
       .said = {}},
      {.name = "GeneratorStops", .happens = stops("Generator"), .after = After::kBrakes},
      {.name = "ControllerStops", .happens = stops("Controller"), .said = {}},
      {.name = "ActuatorStops", .happens = stops("Actuator"), .said = {}},
      {.name = "SamplerStops", .happens = stops("Sampler"), .said = {}},
      {.name = "HostStops", .happens = stops("Bus"), .said = {"the bus of the drive is gone"}},
      {.name = "AComponentThrows", .happens = component_throws, .said = {"out of order"}},
      {.name = "TheHostThrows",
       .happens = [](CampaignArm& arm, Random&) { throw_in(arm, "Bus"); },
       .said = {"out of order"}},
      {.name = "EmergencyStop", .happens = disarm, .said = {}},
      {.name = "OperatorBrakes", .happens = brake, .after = After::kBrakes},
  };
}

}  // namespace

std::vector<Breakage> breakages() {
  std::vector<Breakage> all = of_drives();
  for (const auto& more : {of_the_bus(), of_the_application()}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

}  // namespace armature::cia402
