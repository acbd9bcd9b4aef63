// SPDX-License-Identifier: Apache-2.0
#include "armature/can/candump.hpp"

#include <chrono>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/can/virtual_bus.hpp"

namespace armature::can {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr const char* kLog =
    "(1436509052.249713) can0 123#DEADBEEF\n"
    "(1436509052.449847) can1 0000007B#R\n"
    "(1436509052.650004) can0 20000040#0000000000000000\n"
    "(1436509052.650004001) can0 181#R4\n";

std::vector<LogEntry> parsed(const std::string& text) {
  base::Diagnostics diagnostics;
  auto entries = parse_candump(text, "a.log", diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.to_text();
  return entries;
}

std::string errors_of(const std::string& text) {
  base::Diagnostics diagnostics;
  EXPECT_THAT(parse_candump(text, "a.log", diagnostics), IsEmpty());
  EXPECT_FALSE(diagnostics.ok());
  return diagnostics.to_text();
}

TEST(Candump, IsReadAndWrittenBackTheSame) {
  const auto entries = parsed(kLog);
  ASSERT_THAT(entries, SizeIs(4));
  EXPECT_EQ(entries[0].time, base::time_from_ns(1436509052'249713000));
  EXPECT_EQ(entries[0].bus, "can0");
  EXPECT_EQ(entries[0].frame, data_frame(0x123, {0xde, 0xad, 0xbe, 0xef}));
  EXPECT_TRUE(entries[1].frame.extended);
  EXPECT_EQ(entries[1].frame.kind, FrameKind::kRemote);
  EXPECT_EQ(entries[2].frame.kind, FrameKind::kError);
  EXPECT_EQ(entries[2].frame.id, error_class::kBusOff);
  EXPECT_EQ(entries[3].time - entries[2].time, 1ns);
  EXPECT_EQ(to_text(entries), kLog);
}

TEST(Candump, EmptyLinesDirectionsAndOtherLineEndsDoNotMatter) {
  const auto entries = parsed("\r\n(1.5) can0 001#\r\n\n  (0000000002.000000)   can0  002#01 T");
  ASSERT_THAT(entries, SizeIs(2));
  EXPECT_EQ(entries[0].time, base::Time(1500ms));
  EXPECT_EQ(to_text(entries[1]), "(0000000002.000000) can0 002#01");
  EXPECT_THAT(parsed(""), IsEmpty());
}

TEST(Candump, EveryErrorHasItsLineAndSaysWhatWasExpected) {
  const std::string errors =
      errors_of("(1.5) can0 001#\n1.5 can0 001#\n\n(1.5) can0\n(1.5) can0 9#");
  EXPECT_THAT(errors, HasSubstr("a.log:2: error: expected a time such as (1436509052.249713), "
                                "found '1.5'"));
  EXPECT_THAT(errors, HasSubstr("a.log:4: error: expected a bus and a frame"));
  EXPECT_THAT(errors, HasSubstr("a.log:5: error: frame '9#': expected 3 or 8"));
}

TEST(Candump, TimesThatAreNoneAreErrors) {
  for (const char* time :
       {"()", "(1)", "(.5)", "(1.)", "(1.0000000001)", "(-1.5)", "(1.5", "(a.5)"}) {
    EXPECT_THAT(errors_of(std::string(time) + " can0 001#"), HasSubstr("expected a time")) << time;
  }
  EXPECT_THAT(errors_of("(9223372036.0) can0 001#"), HasSubstr("before the year 2262"));
  EXPECT_THAT(errors_of("(9999999999999999999.0) can0 001#"), HasSubstr("expected a time"));
  EXPECT_THAT(errors_of("(1.5) can0 001# X"), HasSubstr("expected the end of the line"));
  EXPECT_THAT(errors_of("(1.5) can0 001# T X"), HasSubstr("expected the end of the line"));
}

TEST(LogPlayer, GivesEachFrameAtItsTime) {
  base::Time now(1s);
  LogPlayer player("can0", parsed(kLog), [&now] { return now; });
  Arrival arrival;
  EXPECT_EQ(player.receive(arrival), ReceiveStatus::kDown);
  EXPECT_EQ(player.send(data_frame(1, {})), SendStatus::kDown);
  base::Diagnostics diagnostics;
  ASSERT_TRUE(player.open({}, diagnostics)) << diagnostics.to_text();
  ASSERT_EQ(player.receive(arrival), ReceiveStatus::kReceived);
  EXPECT_EQ(arrival.time, base::Time(1s));
  EXPECT_EQ(arrival.frame, data_frame(0x123, {0xde, 0xad, 0xbe, 0xef}));
  now = base::Time(1s + 400'291us);
  EXPECT_EQ(player.receive(arrival), ReceiveStatus::kNothing) << "the error frame is not asked for";
  EXPECT_FALSE(player.finished());
  now += 1ns;
  ASSERT_EQ(player.receive(arrival), ReceiveStatus::kReceived);
  EXPECT_EQ(arrival.frame, remote_frame(0x181, 4));
  EXPECT_EQ(arrival.time, now);
  EXPECT_TRUE(player.finished());
  EXPECT_EQ(player.counters().received, 2u);
  EXPECT_EQ(player.counters().error_frames, 1u);
}

TEST(LogPlayer, StartsAgainWhenItIsOpenedAgain) {
  base::Time now(1s);
  LogPlayer player("", parsed("(5.0) can0 001#\n(6.0) can1 002#\n"), [&now] { return now; });
  base::Diagnostics diagnostics;
  Arrival arrival;
  for (int round = 0; round < 2; ++round) {
    ASSERT_TRUE(player.open({}, diagnostics)) << diagnostics.to_text();
    ASSERT_EQ(player.receive(arrival), ReceiveStatus::kReceived);
    EXPECT_EQ(arrival.frame.id, 1u);
    EXPECT_EQ(arrival.time, now);
    EXPECT_EQ(player.receive(arrival), ReceiveStatus::kNothing);
    player.close();
    now += 10s;
  }
}

TEST(LogPlayer, ABusThatIsNotInTheLogIsAnError) {
  LogPlayer player("can7", parsed(kLog), [] { return base::Time{}; });
  base::Diagnostics diagnostics;
  EXPECT_FALSE(player.open({}, diagnostics));
  EXPECT_THAT(diagnostics.to_text(), HasSubstr("bus 'can7' is not in the log"));
}

TEST(LogWriter, WritesWhatWasOnAVirtualBus) {
  base::Time now(1s);
  VirtualBus bus("can0", 1'000'000, [&now] { return now; });
  LogWriter writer(bus.name());
  bus.set_tap([&](const WireEvent& event) { writer.add(event.end, event.frame); });
  base::Diagnostics diagnostics;
  VirtualStation& host = bus.add_station("host");
  ASSERT_TRUE(host.open({}, diagnostics) && bus.add_station("card").open({}, diagnostics));
  bus.advance_to(now);
  host.send(data_frame(0x080, {7}));
  host.send(data_frame(0x300, {}));
  bus.advance_to(now + 1ms);
  EXPECT_EQ(writer.text(), "(0000000001.000059) can0 080#07\n(0000000001.000110) can0 300#\n");
  EXPECT_EQ(parsed(writer.text()), writer.entries());
}

}  // namespace
}  // namespace armature::can
