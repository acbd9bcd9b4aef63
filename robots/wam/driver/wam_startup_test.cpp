// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/driver/wam_startup.hpp"

#include <chrono>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/wam/driver/test_hosted_bench.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

/// The host's frames and when they began.
std::vector<can::WireEvent> own(const Bench& bench) {
  std::vector<can::WireEvent> events;
  for (const can::WireEvent& event : bench.log) {
    if (event.sender == &bench.host) events.push_back(event);
  }
  return events;
}
std::string text(const can::Frame& frame) { return std::string(can::to_text(frame).view()); }

/// The frames of a list that are in it, in its order.
std::vector<std::string> only(const std::vector<std::string>& frames, const char* data) {
  std::vector<std::string> found;
  for (const auto& frame : frames) {
    if (frame.find(data) != std::string::npos) found.push_back(frame);
  }
  return found;
}

// ---- Finding the arm

TEST(WamStartup, InEstopOnlyTheBoardIsThereAndTheOperatorIsWaitedFor) {
  Hosted bench;
  EXPECT_EQ(bench.connect(), WamProgress::kWaitingForIdle);
  EXPECT_EQ(bench.startup->board_mode(), BoardMode::kEstop);
  for (const auto& answer : bench.take_others()) EXPECT_THAT(answer, HasSubstr("546#"));
  EXPECT_EQ(bench.talk_for(10s), WamProgress::kWaitingForIdle);
  EXPECT_THAT(only(bench.take_own(), "#85"), IsEmpty()) << "nobody was woken";
}

TEST(WamStartup, WhenTheOperatorHasActedItGoesOn) {
  Hosted bench;
  EXPECT_EQ(bench.connect(), WamProgress::kWaitingForIdle);
  bench.talk_for(700ms);
  bench.board().reset();
  bench.board().shift_idle();
  EXPECT_EQ(bench.talk_for(300ms), WamProgress::kTalking);
  EXPECT_EQ(bench.talk(), WamProgress::kDone) << bench.said();
  EXPECT_EQ(bench.startup->record().pucks[6].units_per_nm, 17474);
  EXPECT_FALSE(bench.startup->record().zeroed);
}

TEST(WamStartup, ReadsWhatThePucksAre) {
  Hosted bench;
  bench.power_up();
  ASSERT_EQ(bench.connect(), WamProgress::kDone) << bench.said();
  const WamRecord& record = bench.startup->record();
  EXPECT_EQ(record.motors, 7u);
  EXPECT_EQ(record.board_version, 200);
  EXPECT_EQ(record.pucks[0],
            (PuckRecord{1, 175, kAbsoluteEncoder, 4096, 2700, 4860, 1, {0, 1, 4}}));
  EXPECT_EQ(record.pucks[5],
            (PuckRecord{6, 175, kAbsoluteEncoder, 4096, 6500, 3900, 2, {0, 2, 4}}));
  EXPECT_EQ(record.position_number, 48);
  EXPECT_EQ(record.torque_number, 42);
  EXPECT_EQ(record.board_mode_number, 8);
  EXPECT_EQ(record.pendant_number, 43);
  EXPECT_EQ(record.zero_number, 42);
  EXPECT_THAT(bench.said(), IsEmpty());
}

TEST(WamStartup, TheStepsAreInTheirOrder) {
  Hosted bench;
  bench.power_up();
  ASSERT_EQ(bench.connect(), WamProgress::kDone) << bench.said();
  ASSERT_EQ(bench.zero(), WamProgress::kDone) << bench.said();
  const auto sent = bench.take_own();
  const auto place = [&](const char* frame) {
    const auto found = std::ranges::find(sent, frame);
    EXPECT_NE(found, sent.end()) << frame;
    return found - sent.begin();
  };
  const std::vector<std::ptrdiff_t> places{
      place("01F#05"), place("00A#A0002D000000"), place("00A#9F002D000000"),
      place("00A#08"), place("007#850002000000"), place("007#5A"),
      place("001#44"), place("007#56"),           place("404#880000000000"),
      place("00A#2A"), place("00A#B70005000000")};
  EXPECT_TRUE(std::ranges::is_sorted(places)) << ::testing::PrintToString(places);
}

TEST(WamStartup, WakesOneAfterTheOtherAndIsSilentForASecond) {
  Hosted bench;
  bench.power_up();
  ASSERT_EQ(bench.connect(), WamProgress::kDone) << bench.said();
  const auto events = own(bench);
  std::size_t last = 0;
  std::vector<std::string> woken;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const std::string frame = text(events[i].frame);
    if (frame.find("#850002000000") == std::string::npos) continue;
    if (!woken.empty()) {
      EXPECT_GE(events[i].begin - events[i - 1].begin, 10ms) << frame;
      EXPECT_EQ(i, last + 1) << "nothing is sent between";
    }
    woken.push_back(frame.substr(0, 3));
    last = i;
  }
  EXPECT_THAT(woken, ElementsAre("001", "002", "003", "004", "005", "006", "007"));
  EXPECT_GE(events[last + 1].begin - events[last].end, 1s);
  EXPECT_EQ(text(events[last + 1].frame), "001#05");
}

TEST(WamStartup, PucksThatAreAwakeAreNotWokenAgain) {
  Hosted bench;
  bench.wake_up();
  const base::Time begin = bench.now();
  ASSERT_EQ(bench.connect(), WamProgress::kDone) << bench.said();
  EXPECT_THAT(only(bench.take_own(), "#850002"), IsEmpty());
  EXPECT_LT(bench.now() - begin, 1s);
}

TEST(WamStartup, PutsLimitsBackWithPausesBetween) {
  Hosted bench;
  bench.power_up();
  bench.tell("00A#AE000040");  // VL2 4 m/s, left by an earlier program
  bench.tell("00A#B000FF7F");  // TL2
  bench.log.clear();
  ASSERT_EQ(bench.connect(), WamProgress::kDone) << bench.said();
  EXPECT_EQ(bench.board().properties().get(Property::kVl2), 4096);
  EXPECT_EQ(bench.board().properties().get(Property::kTl2), 5204);
  base::Time last = base::Time::min();
  int writes = 0;
  for (const can::WireEvent& event : own(bench)) {
    const std::string frame = text(event.frame);
    if (frame.find("00A#A0") != 0 && frame.find("00A#9F") != 0) continue;
    ++writes;
    if (last != base::Time::min()) {
      EXPECT_GE(event.begin - last, 10ms) << frame;
    }
    last = event.begin;
  }
  EXPECT_EQ(writes, 8);
}

TEST(WamStartup, PucksAreIdleAfterwards) {
  Hosted bench;
  bench.wake_up();
  bench.tell("400#88000200");
  ASSERT_EQ(bench.connect(), WamProgress::kDone) << bench.said();
  for (int node = 1; node <= 7; ++node) EXPECT_EQ(bench.puck(node).mode(), PuckMode::kIdle);
}

// ---- Zeroing

TEST(WamStartup, WritesTheHomePositionInThisOrder) {
  Hosted bench;
  bench.power_up();
  ASSERT_EQ(bench.connect(), WamProgress::kDone) << bench.said();
  bench.log.clear();
  ASSERT_EQ(bench.zero(), WamProgress::kDone) << bench.said();
  auto sent = bench.take_own();
  ASSERT_THAT(sent, SizeIs(20));
  sent.resize(10);
  EXPECT_THAT(sent,
              ElementsAre("00A#2A", "00A#B70005000000", "001#B00000000000", "002#B0001F70FFFF",
                          "003#B000E08F0000", "004#B0008870FFFF", "005#B00000000000",
                          "006#B00000000000", "007#B00000000000", "00A#AA0001000000"));
  EXPECT_TRUE(bench.startup->record().zeroed);
  EXPECT_TRUE(bench.board().zeroed());
  EXPECT_EQ(bench.puck(2).counts(), -36833);
  EXPECT_EQ(bench.board().pendant().level(Monitor::kVelocity), Level::kSafe);
}

TEST(WamStartup, ZeroedPositionsAreLeftAlone) {
  Hosted bench;
  bench.wake_up();
  bench.tell("002#B00010000000");
  bench.tell("00A#AA0001000000");
  ASSERT_EQ(bench.connect(), WamProgress::kDone) << bench.said();
  EXPECT_TRUE(bench.startup->record().zeroed);
  bench.log.clear();
  ASSERT_EQ(bench.zero(), WamProgress::kDone) << bench.said();
  EXPECT_THAT(bench.take_own(), ElementsAre("00A#2A", "00A#B70005000000", "00A#05"));
  EXPECT_EQ(bench.puck(2).counts(), 16);
}

TEST(WamStartup, AZeroThatThePuckDidNotTakeIsFound) {
  Hosted bench;
  bench.power_up();
  ASSERT_EQ(bench.connect(), WamProgress::kDone) << bench.said();
  bench.emulator->bus().lose_next(1, can::Filter{.id = 0x003});
  EXPECT_EQ(bench.zero(), WamProgress::kFailed);
  EXPECT_THAT(bench.said(), HasSubstr("WAM on bus 'can0.host': puck 3 is at 0 counts after it was "
                                      "set to 36832 (keep the arm still meanwhile"));
  EXPECT_FALSE(bench.startup->record().zeroed);
}

TEST(WamStartup, ABoardThatDoesNotTakeZeroIsFound) {
  Hosted bench;
  bench.power_up();
  ASSERT_EQ(bench.connect(), WamProgress::kDone) << bench.said();
  bench.startup->zero(bench.now());
  while (text(bench.log.back().frame) != "00A#B70005000000") {
    bench.startup->poll(bench.now());
    bench.emulator->advance_to_next_event(bench.startup->deadline());
  }
  bench.emulator->bus().lose_next(1, can::Filter{.id = 0x00a});
  EXPECT_EQ(bench.talk(), WamProgress::kFailed);
  EXPECT_THAT(bench.said(), HasSubstr("the safety board did not take ZERO 1, it has 0"));
}

TEST(WamStartup, APuckThatHadToBeWokenHasLostItsPositionWhateverTheBoardSays) {
  Hosted bench;
  bench.wake_up();
  bench.tell("00A#AA0001000000");
  bench.tell("004#850000000000");  // back to its monitor
  ASSERT_EQ(bench.connect(), WamProgress::kDone) << bench.said();
  EXPECT_FALSE(bench.startup->record().zeroed);
  bench.advance(1ms);
  EXPECT_FALSE(bench.board().zeroed()) << "another host is not to believe it either";
  ASSERT_EQ(bench.connect(), WamProgress::kDone) << bench.said();
  EXPECT_FALSE(bench.startup->record().zeroed);
  ASSERT_EQ(bench.zero(), WamProgress::kDone) << bench.said();
  EXPECT_EQ(bench.puck(4).counts(), -36728);
  EXPECT_TRUE(bench.startup->record().zeroed);
  bench.log.clear();
  ASSERT_EQ(bench.zero(), WamProgress::kDone) << bench.said();
  EXPECT_THAT(bench.take_own(), Not(Contains(HasSubstr("004#B0")))) << "once";
}

// ---- Other arms

TEST(WamStartup, AnArmWithFourJointsIsTwoFramesLess) {
  Hosted bench(4);
  bench.power_up();
  ASSERT_EQ(bench.connect(), WamProgress::kDone) << bench.said();
  ASSERT_EQ(bench.zero(), WamProgress::kDone) << bench.said();
  const auto sent = bench.take_own();
  EXPECT_THAT(sent, Not(Contains("007#5A"))) << "there is no wrist to tell from gimbals";
  EXPECT_THAT(sent, Not(Contains("005#B00000000000")));
  EXPECT_EQ(bench.startup->record().motors, 4u);
}

TEST(WamStartup, AnotherNumberOfPucksIsRefused) {
  Hosted seven(Emulator::standard(7), 4);
  seven.power_up();
  EXPECT_EQ(seven.connect(), WamProgress::kFailed);
  EXPECT_THAT(seven.said(), HasSubstr("found nodes 1, 2, 3, 4, 5, 6, 7, 10, expected motor pucks "
                                      "at exactly nodes 1 to 4"));
  Hosted five(Emulator::standard(7), 4);
  five.power_up();
  five.puck(6).set_dead(true);
  five.puck(7).set_dead(true);
  EXPECT_EQ(five.connect(), WamProgress::kFailed);
  EXPECT_THAT(five.said(), HasSubstr("found nodes 1, 2, 3, 4, 5, 10, expected"));
}

TEST(WamStartup, APuckThatBootsLateIsWaitedFor) {
  auto config = Emulator::standard(7);
  config.pucks[6].boot_time = 3s;
  Hosted bench(config);
  bench.power_up();
  EXPECT_EQ(bench.connect(), WamProgress::kDone) << bench.said();
}

TEST(WamStartup, GimbalsAreRefused) {
  auto config = Emulator::standard(7);
  config.pucks[6].poles = 8;
  Hosted bench(config);
  bench.power_up();
  EXPECT_EQ(bench.connect(), WamProgress::kFailed);
  EXPECT_THAT(bench.said(), HasSubstr("the motor of puck 7 has 8 poles, expected 6"));
}

class OldFirmware : public ::testing::TestWithParam<int> {};

TEST_P(OldFirmware, IsAskedByItsOwnNumbers) {
  Hosted bench(Emulator::standard(4, GetParam()));
  bench.power_up();
  ASSERT_EQ(bench.connect(), WamProgress::kDone) << bench.said();
  ASSERT_EQ(bench.zero(), WamProgress::kDone) << bench.said();
  const WamRecord& record = bench.startup->record();
  const bool old = GetParam() < 61;
  EXPECT_EQ(record.position_number, old ? 26 : 48);
  EXPECT_EQ(record.torque_number, old ? 9 : 42);
  EXPECT_EQ(record.pucks[3],
            (PuckRecord{4, GetParam(), kAbsoluteEncoder, 4096, 2700, 4320, 4, {0, 1, 4}}));
  EXPECT_EQ(bench.puck(2).counts(), -36833);
}

INSTANTIATE_TEST_SUITE_P(Versions, OldFirmware, ::testing::Values(55, 64, 120, 130));

TEST(WamStartup, FirmwareOfTwoGenerationsIsRefused) {
  auto config = Emulator::standard(4);
  config.pucks[2].version = 55;
  Hosted bench(config);
  bench.power_up();
  EXPECT_EQ(bench.connect(), WamProgress::kFailed);
  EXPECT_THAT(bench.said(), HasSubstr("puck 3 has firmware 55 and puck 1 175, which have different "
                                      "numbers for P (give all pucks the same firmware)"));
}

TEST(WamStartup, FirmwareThatIsTooOldIsRefused) {
  Hosted bench(Emulator::standard(4, 32));
  bench.power_up();
  EXPECT_EQ(bench.connect(), WamProgress::kFailed);
  EXPECT_THAT(bench.said(), HasSubstr("puck 1 with firmware 32 has no property IPNM"));
}

TEST(WamStartup, AVersionThatIsNotTrueIsFoundOut) {
  auto config = Emulator::standard(4, 130);
  for (auto& puck : config.pucks) puck.told_version = 64;  // PIDX would be 68 then, which is CTS
  Hosted bench(config);
  bench.power_up();
  EXPECT_EQ(bench.connect(), WamProgress::kFailed);
  EXPECT_THAT(bench.said(), HasSubstr("puck 1 has CTS 0, expected above 0"));
}

}  // namespace
}  // namespace armature::wam
