// SPDX-License-Identifier: Apache-2.0
// What the driver does when something goes wrong.
#include <chrono>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/wam/driver/test_hosted_bench.hpp"
#include "robots/wam/driver/wam_driver.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;

/// Active, with a torque on motor 1.
struct Driving : Hosted {
  explicit Driving(std::size_t count = kMostMotors) : Hosted(count) {
    start_active();
    torques[0] = 0.01;
    run(2);
    EXPECT_EQ(puck(1).torque(), 27);
    log.clear();
  }
  const WamCounters& counters(int node) {
    return driver->motor(static_cast<std::size_t>(node - 1)).counters;
  }
  /// No torque gets through any more, and the heartbeat goes on.
  void expect_quiet() {
    log.clear();
    run(5);
    int heartbeats = 0;
    for (const auto& frame : take_own()) {
      if (frame.find("401#") != 0) continue;
      EXPECT_EQ(frame, "401#AA00000000000000");
      ++heartbeats;
    }
    EXPECT_EQ(heartbeats, 5);
    EXPECT_FALSE(driver->active());
  }
};

// ---- Faults of the board

TEST(WamDriverFaults, AVelocityFaultIsNamedAndTheArmCanGoOn) {
  Driving bench;
  const std::int32_t counts = bench.puck(2).counts();
  bench.rotors.set_state(3, bench.rotors.angle(3), -18.0 * 1.2 / 0.35);
  EXPECT_LE(bench.cycles_until_fault(100), 40);
  EXPECT_EQ(bench.driver->fault(), WamFault::kIdled) << "the cause is asked for";
  bench.expect_quiet();
  EXPECT_EQ(bench.driver->fault(), WamFault::kVelocity);
  EXPECT_EQ(bench.driver->pendant().value().level(Monitor::kVelocity), Level::kFault);
  EXPECT_EQ(bench.board().mode(), BoardMode::kIdle);
  EXPECT_TRUE(bench.board().zeroed());
  EXPECT_EQ(bench.puck(2).counts(), counts);
  EXPECT_EQ(bench.driver->motor(1).counts, counts);

  bench.rotors.set_state(3, bench.rotors.angle(3), 0.0);
  bench.board().shift_idle();
  bench.board().shift_activate();
  bench.run(60);
  EXPECT_EQ(bench.driver->board_mode(), BoardMode::kActive);
  EXPECT_FALSE(bench.driver->active()) << "not before the operator has acknowledged";
  EXPECT_EQ(bench.puck(1).torque(), 0);
  EXPECT_TRUE(bench.driver->acknowledge());
  EXPECT_EQ(bench.driver->fault(), WamFault::kNone);
  bench.run(2);
  EXPECT_TRUE(bench.driver->active());
  EXPECT_EQ(bench.puck(1).torque(), 27);
}

TEST(WamDriverFaults, ATorqueBeyondTheBoardsLimitIsNamed) {
  Driving bench;
  bench.tell("00A#B000E803");  // TL2 1000
  bench.torques[0] = -0.5;
  bench.run(60);
  EXPECT_EQ(bench.driver->fault(), WamFault::kTorque);
  bench.expect_quiet();
}

TEST(WamDriverFaults, EveryMonitorHasItsName) {
  for (const auto& [monitor, fault] : {std::pair{Monitor::kVelocity, WamFault::kVelocity},
                                       std::pair{Monitor::kTorque, WamFault::kTorque},
                                       std::pair{Monitor::kVoltage, WamFault::kVoltage},
                                       std::pair{Monitor::kHeartbeat, WamFault::kHeartbeat},
                                       std::pair{Monitor::kOther, WamFault::kOther}}) {
    Driving bench;
    bench.board().fail(monitor);
    bench.run(50);
    EXPECT_EQ(bench.driver->fault(), fault) << to_text(monitor);
    bench.expect_quiet();
  }
}

TEST(WamDriverFaults, TheOperatorsIdleIsNoFaultOfTheBoard) {
  Driving bench;
  bench.board().shift_idle();
  bench.run(60);
  EXPECT_EQ(bench.driver->fault(), WamFault::kIdled);
  bench.expect_quiet();
  EXPECT_TRUE(bench.driver->acknowledge());
  bench.run(60);
  EXPECT_EQ(bench.driver->fault(), WamFault::kNone);
}

TEST(WamDriverFaults, AHostThatStopsIsNoticedByTheBoard) {
  Driving bench;
  bench.advance(150ms);
  EXPECT_EQ(bench.board().pendant().level(Monitor::kHeartbeat), Level::kFault);
  EXPECT_EQ(bench.board().mode(), BoardMode::kIdle);
  EXPECT_TRUE(bench.rotors.braked(0));
  bench.run(50);
  EXPECT_EQ(bench.driver->fault(), WamFault::kHeartbeat);
}

TEST(WamDriverFaults, EstopInMotionIsNamedAndNeedsANewStart) {
  Driving bench;
  bench.board().estop();
  EXPECT_LE(bench.cycles_until_fault(100), 3);
  EXPECT_EQ(bench.driver->fault(), WamFault::kPuckSilent) << "before the board was asked";
  bench.run(2);
  EXPECT_EQ(bench.driver->fault(), WamFault::kEstop);
  bench.expect_quiet();
  EXPECT_FALSE(bench.driver->acknowledge());

  bench.board().reset();
  bench.board().shift_idle();
  bench.board().shift_activate();
  bench.run(500);
  EXPECT_EQ(bench.driver->fault(), WamFault::kEstop) << "nothing goes on by itself";
  bench.board().shift_idle();
  EXPECT_EQ(bench.connect(), WamProgress::kDone) << bench.said();
  EXPECT_FALSE(bench.startup->record().zeroed);
  EXPECT_EQ(bench.zero(), WamProgress::kDone) << bench.said();
  bench.driver->start(bench.now());
  bench.run(5);
  EXPECT_EQ(bench.driver->fault(), WamFault::kNone);
  EXPECT_EQ(bench.driver->reading(), WamReading::kComplete);
}

TEST(WamDriverFaults, EstopAtAnyMomentOfACycleStopsTheTorques) {
  for (base::Duration moment{}; moment < 2ms; moment += 100us) {
    Driving bench;
    const base::Time next = bench.now() + Hosted::kPeriod;
    bench.driver->begin_reading(bench.now());
    bench.advance(moment);
    bench.board().estop();
    bench.driver->poll(bench.now());
    bench.driver->set_torque(0, 0.01, bench.now());
    bench.driver->send_torques(bench.now());
    bench.emulator->advance_to(next);
    EXPECT_TRUE(bench.rotors.braked(0)) << moment.count();
    bench.run(6);
    EXPECT_EQ(bench.driver->fault(), WamFault::kEstop) << moment.count();
    bench.expect_quiet();
  }
}

TEST(WamDriverFaults, ASilentBoardStopsTheTorques) {
  Driving bench;
  bench.board().set_dead(true);
  bench.run(100);
  EXPECT_EQ(bench.driver->fault(), WamFault::kBoardSilent);
  bench.expect_quiet();
  bench.board().set_dead(false);
  bench.run(60);
  EXPECT_EQ(bench.driver->fault(), WamFault::kBoardSilent);
  EXPECT_TRUE(bench.driver->acknowledge());
  bench.run(60);
  EXPECT_EQ(bench.driver->fault(), WamFault::kNone);
}

TEST(WamDriverFaults, ALostAnswerOfTheBoardIsNoFault) {
  Driving bench;
  bench.board().lose_replies(2);
  bench.run(200);
  EXPECT_TRUE(bench.driver->active());
  EXPECT_EQ(bench.driver->watch_counters().missed, 2u);
}

TEST(WamDriverFaults, ALateAnswerOfTheBoardIsNotTakenForAnother) {
  Driving bench;
  bench.board().delay_replies(26ms);  // MODE comes when PEN is asked for
  bench.run(20);
  bench.board().delay_replies({});
  bench.run(100);
  EXPECT_GE(bench.driver->watch_counters().unexpected, 1u);
  EXPECT_EQ(bench.driver->watch_counters().malformed, 0u);
  EXPECT_TRUE(bench.driver->active());
}

// ---- Faults of the pucks

TEST(WamDriverFaults, ASilentPuckIsNamedInThreeCycles) {
  Driving bench;
  bench.puck(3).set_dead(true);
  EXPECT_EQ(bench.cycles_until_fault(100), 3);
  EXPECT_EQ(bench.driver->fault(), WamFault::kPuckSilent);
  EXPECT_EQ(bench.driver->fault_node(), 3);
  bench.expect_quiet();
  EXPECT_EQ(bench.driver->fault(), WamFault::kPuckSilent) << "the board is still active";
  bench.puck(3).set_dead(false);
  bench.run(5);
  EXPECT_EQ(bench.driver->fault(), WamFault::kPuckSilent);
  EXPECT_TRUE(bench.driver->acknowledge());
  bench.run(5);
  EXPECT_EQ(bench.driver->fault(), WamFault::kNone);
}

TEST(WamDriverFaults, ASilentPuckIsSeenAtTheDeadline) {
  Driving bench;
  bench.puck(3).set_dead(true);
  const base::Time begin = bench.now();
  EXPECT_EQ(bench.read(), WamReading::kIncomplete);
  EXPECT_EQ(bench.now() - begin, 1400us);
  EXPECT_FALSE(bench.driver->motor(2).fresh);
  EXPECT_TRUE(bench.driver->motor(3).fresh);
}

TEST(WamDriverFaults, ALostAnswerCostsTwoReadingsOfThatPuckAlone) {
  Driving bench;
  bench.puck(3).lose_replies(1);
  EXPECT_EQ(bench.read(), WamReading::kIncomplete);
  EXPECT_EQ(bench.driver->motor(2).cycles_without, 1);
  bench.log.clear();
  EXPECT_EQ(bench.read(), WamReading::kIncomplete);
  EXPECT_THAT(bench.take_own(),
              ElementsAre("001#30", "002#30", "004#30", "005#30", "006#30", "007#30"));
  EXPECT_EQ(bench.driver->motor(2).cycles_without, 2);
  EXPECT_TRUE(bench.driver->motor(1).fresh);
  EXPECT_EQ(bench.read(), WamReading::kComplete);
  EXPECT_EQ(bench.driver->motor(2).cycles_without, 0);
  EXPECT_TRUE(bench.driver->active());
  EXPECT_EQ(bench.counters(3), (WamCounters{.missed = 1}));
}

TEST(WamDriverFaults, AFrameThatTheWireLosesIsCounted) {
  Driving bench;
  bench.emulator->bus().lose_next(1, can::Filter{.id = 0x463});
  bench.run(3);
  EXPECT_EQ(bench.counters(3).missed, 1u);
  EXPECT_EQ(bench.driver->reading(), WamReading::kComplete);
}

TEST(WamDriverFaults, ALateAnswerIsNotTakenForThatToTheNextRequest) {
  Driving bench;
  bench.torques[0].reset();
  const std::int32_t before = bench.driver->motor(2).counts;
  bench.puck(3).delay_replies(3ms);
  bench.run(1);
  bench.rotors.set_state(2, bench.rotors.angle(2) + 1.0, 0.0);
  bench.puck(3).delay_replies({});
  EXPECT_EQ(bench.counters(3).missed, 1u);
  bench.run(1);
  EXPECT_EQ(bench.driver->motor(2).counts, before) << "the late one came, and was not used";
  EXPECT_FALSE(bench.driver->motor(2).fresh);
  bench.run(1);
  EXPECT_EQ(bench.counters(3).late, 1u);
  EXPECT_TRUE(bench.driver->motor(2).fresh);
  EXPECT_EQ(bench.driver->motor(2).counts, bench.puck(3).counts());
  EXPECT_NE(bench.driver->motor(2).counts, before);
}

TEST(WamDriverFaults, APuckThatIsAlwaysLateIsSilent) {
  for (const base::Duration late :
       {base::Duration(1500us), base::Duration(2ms), base::Duration(2500us), base::Duration(3ms)}) {
    Driving bench;
    bench.puck(3).delay_replies(late);
    bench.cycles_until_fault(100);
    EXPECT_EQ(bench.driver->fault(), WamFault::kPuckSilent) << late.count();
    EXPECT_EQ(bench.driver->fault_node(), 3);
  }
}

TEST(WamDriverFaults, AnAnswerThatComesTwiceIsUsedOnce) {
  Driving bench;
  bench.puck(3).spoil_replies(ReplySpoil::kTwice, 10);
  bench.run(10);
  EXPECT_TRUE(bench.driver->active());
  EXPECT_EQ(bench.counters(3).late, 10u);
  EXPECT_EQ(bench.counters(3).missed, 0u);
}

TEST(WamDriverFaults, AnAnswerOfAWrongLengthIsNone) {
  Driving bench;
  bench.puck(3).spoil_replies(ReplySpoil::kWrongLength, 1);
  bench.run(3);
  EXPECT_EQ(bench.counters(3).malformed, 1u);
  EXPECT_EQ(bench.counters(3).missed, 1u);
  EXPECT_TRUE(bench.driver->active());
}

TEST(WamDriverFaults, APositionThatCannotBeIsNotUsed) {
  Driving bench;
  bench.torques[0].reset();
  bench.run(6);
  const std::int32_t before = bench.driver->motor(2).counts;
  bench.tell("00A#B7006400");  // the board is to look away
  bench.tell("003#B000000F0000");
  EXPECT_EQ(bench.read(), WamReading::kIncomplete);
  EXPECT_EQ(bench.driver->motor(2).counts, before);
  EXPECT_EQ(bench.counters(3).jumps, 1u);
  bench.tell("003#B000E08F0000");  // home again
  EXPECT_EQ(bench.read(), WamReading::kComplete);
  EXPECT_EQ(bench.driver->fault(), WamFault::kNone);
}

TEST(WamDriverFaults, AQuarterOfATurnIsTheMostThatAMotorMoves) {
  Driving bench;
  bench.tell("00A#B7006400");
  const std::int32_t before = bench.driver->motor(2).counts;
  const auto set = [&](std::int32_t counts) {
    const auto frame = set_frame(to_node(3), 48, counts);
    bench.tell(std::string(can::to_text(frame).view()));
    return bench.read();
  };
  EXPECT_EQ(set(before + 1024), WamReading::kComplete);
  EXPECT_EQ(set(before + 2049), WamReading::kIncomplete);
}

TEST(WamDriverFaults, WhatMovedWhileAPuckWasSilentIsNoJump) {
  Driving bench;
  bench.puck(3).set_dead(true);
  bench.cycles_until_fault(10);
  bench.tell("00A#B7006400");  // the board is to look away
  bench.rotors.set_state(2, bench.rotors.angle(2) + 20.0, 0.0);
  bench.run(10);
  bench.puck(3).set_dead(false);
  EXPECT_TRUE(bench.driver->acknowledge());
  bench.run(4);
  EXPECT_EQ(bench.driver->fault(), WamFault::kNone);
  EXPECT_EQ(bench.driver->motor(2).counts, bench.puck(3).counts());
}

TEST(WamDriverFaults, WhatMovedWhileNoCyclesWereRunIsNoJump) {
  Driving bench;
  bench.tell("00A#B7006400");
  bench.advance(12ms);
  bench.rotors.set_state(2, bench.rotors.angle(2) + 20.0, 0.0);
  bench.run(4);
  EXPECT_EQ(bench.driver->fault(), WamFault::kNone);
  EXPECT_EQ(bench.driver->motor(2).counts, bench.puck(3).counts());
}

TEST(WamDriverFaults, APuckThatHasLostItsZeroIsNamed) {
  Driving bench;
  bench.tell("00A#B7006400");
  bench.tell("003#B00000000000");
  bench.cycles_until_fault(10);
  EXPECT_EQ(bench.driver->fault(), WamFault::kPositionJump);
  EXPECT_EQ(bench.driver->fault_node(), 3);
  bench.expect_quiet();
  EXPECT_FALSE(bench.driver->acknowledge()) << "its positions are wrong for good";
}

/// Which would have its positions believed after Shift+Idle.
TEST(WamDriverFaults, ALostZeroIsNamedAlsoWhereTheBoardTakesItForAVelocity) {
  for (const int node : {1, 2, 3, 4}) {
    Driving bench;
    const auto frame = set_frame(to_node(node), 48, bench.puck(node).counts() + 20000);
    bench.tell(std::string(can::to_text(frame).view()));
    bench.run(20);
    EXPECT_EQ(bench.board().pendant().level(Monitor::kVelocity), Level::kFault);
    EXPECT_EQ(bench.driver->fault(), WamFault::kPositionJump) << node;
    EXPECT_EQ(bench.driver->fault_node(), node);
    EXPECT_FALSE(bench.board().zeroed());
    EXPECT_FALSE(bench.driver->acknowledge());
  }
}

TEST(WamDriverFaults, AWrongPositionThatTheBoardTakesForAVelocityIsAVelocityFaultIfItIsOver) {
  Driving bench;
  bench.puck(3).spoil_replies(ReplySpoil::kWrongProperty, 1);  // of a position its upper bits
  bench.run(20);
  EXPECT_EQ(bench.counters(3).jumps, 1u);
  EXPECT_EQ(bench.driver->fault(), WamFault::kVelocity);
  EXPECT_TRUE(bench.board().zeroed());
}

TEST(WamDriverFaults, APuckThatHearsNobodyHasItsPowerCut) {
  Driving bench;
  bench.torques[2] = 0.01;
  bench.run(2);
  bench.puck(3).set_dead(true);
  bench.run(3);
  EXPECT_FALSE(bench.driver->needs_power_cut()) << "the board has not answered yet";
  bench.run(3);
  EXPECT_EQ(bench.puck(3).torque(), 27) << "it goes on as it was told last";
  ASSERT_TRUE(bench.driver->needs_power_cut());
  EXPECT_EQ(bench.driver->cut_power(bench.now()), can::SendStatus::kSent);
  bench.run(3);
  EXPECT_EQ(bench.board().mode(), BoardMode::kEstop);
  EXPECT_TRUE(bench.rotors.braked(2));
  EXPECT_EQ(bench.driver->fault(), WamFault::kPowerCut);
  EXPECT_EQ(bench.driver->fault_node(), 3);
  bench.expect_quiet();
  EXPECT_EQ(bench.driver->fault(), WamFault::kPowerCut);
  EXPECT_FALSE(bench.driver->acknowledge());
}

TEST(WamDriverFaults, NoPowerIsCutForAPuckThatAnswersAgainNorWithoutABoard) {
  Driving bench;
  bench.puck(3).set_dead(true);
  bench.run(4);
  bench.puck(3).set_dead(false);
  bench.run(4);
  EXPECT_EQ(bench.driver->fault(), WamFault::kPuckSilent);
  EXPECT_FALSE(bench.driver->needs_power_cut());

  Driving unplugged;
  unplugged.host.set_dead(true);
  unplugged.run(10);
  EXPECT_EQ(unplugged.driver->fault(), WamFault::kPuckSilent);
  EXPECT_EQ(unplugged.driver->fault_node(), kEveryNode);
  EXPECT_FALSE(unplugged.driver->needs_power_cut());
}

// ---- Faults of the bus

TEST(WamDriverFaults, BusOffStopsTheTorquesAndTheBusComesBack) {
  Driving bench;
  bench.host.force_bus_off();
  EXPECT_EQ(bench.driver->begin_reading(bench.now()), WamReading::kNoBus);
  EXPECT_EQ(bench.driver->fault(), WamFault::kNoBus);
  bench.advance(20ms);
  bench.run(2);
  EXPECT_EQ(bench.driver->reading(), WamReading::kComplete);
  EXPECT_EQ(bench.driver->fault(), WamFault::kNoBus);
  bench.expect_quiet();
  EXPECT_EQ(bench.driver->bus_counters().bus_lost, 1u);
  EXPECT_TRUE(bench.driver->acknowledge());
  bench.run(3);
  EXPECT_TRUE(bench.driver->active());
  EXPECT_EQ(bench.puck(1).torque(), 27);
}

TEST(WamDriverFaults, BusOffThatIsOverBeforeTheNextReadingIsNotOverlooked) {
  Driving bench;
  bench.host.force_bus_off();
  bench.host.restart();
  bench.advance(20ms);
  EXPECT_EQ(bench.read(), WamReading::kNoBus);
  EXPECT_EQ(bench.driver->fault(), WamFault::kNoBus);
}

TEST(WamDriverFaults, AHostThatIsOffTheBusForLongIsNoticedByTheBoard) {
  Driving bench;
  bench.emulator->bus().set_cut(true);
  bench.run(100);
  EXPECT_EQ(bench.board().mode(), BoardMode::kIdle);
  EXPECT_EQ(bench.board().pendant().level(Monitor::kHeartbeat), Level::kFault);
  EXPECT_NE(bench.driver->fault(), WamFault::kNone);
}

TEST(WamDriverFaults, TheFirstFaultStaysUntilItIsAcknowledged) {
  Driving bench;
  bench.puck(3).set_dead(true);
  bench.run(5);
  bench.board().shift_idle();
  bench.run(60);
  EXPECT_EQ(bench.driver->fault(), WamFault::kPuckSilent);
  EXPECT_STREQ(to_text(bench.driver->fault()), "puck silent");
}

}  // namespace
}  // namespace armature::wam
