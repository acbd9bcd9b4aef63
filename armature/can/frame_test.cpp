// SPDX-License-Identifier: Apache-2.0
#include "armature/can/frame.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::can {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

// Counted by another program, on the bits as text, with the checksum as a division of big integers.
TEST(FrameBits, AreThoseOfTheRealBitSequence) {
  EXPECT_EQ(frame_bits(data_frame(0x000, {})), 53);
  EXPECT_EQ(frame_bits(data_frame(0x7ff, {})), 50);
  EXPECT_EQ(frame_bits(data_frame(0x123, {0xde, 0xad, 0xbe, 0xef})), 81);
  EXPECT_EQ(frame_bits(data_frame(0x080, {7})), 59);
  EXPECT_EQ(frame_bits(data_frame(0x300, {})), 51);
  EXPECT_EQ(frame_bits(data_frame(0x181, {1, 2, 3, 4, 5, 6, 7, 8})), 120);
  EXPECT_EQ(frame_bits(data_frame(0x000, {0, 0, 0, 0, 0, 0, 0, 0})), 127);
  EXPECT_EQ(frame_bits(data_frame(0x7ff, {255, 255, 255, 255, 255, 255, 255, 255})), 126);
  EXPECT_EQ(frame_bits(data_frame(0x555, {170, 170, 170, 170, 170, 170, 170, 170})), 112);
  EXPECT_EQ(frame_bits(data_frame(0x078, {60, 60, 60, 60, 60, 60, 60, 60})), 131);
  EXPECT_EQ(frame_bits(remote_frame(0x123, 4)), 47);
  EXPECT_EQ(frame_bits(remote_frame(0x7ff, 0)), 50);
  EXPECT_EQ(frame_bits(extended_frame(0, {})), 74);
  EXPECT_EQ(frame_bits(extended_frame(0x1fffffff, {255, 255, 255, 255, 255, 255, 255, 255})), 149);
  EXPECT_EQ(frame_bits(extended_frame(0x12345678, {0x11, 0x22, 0x33})), 92);
  Frame remote = remote_frame(0x1abcdef0, 8);
  remote.extended = true;
  EXPECT_EQ(frame_bits(remote), 68);
}

/// The same sequence of numbers as in the other program.
class Numbers {
 public:
  std::uint32_t next() {
    state_ = state_ * 1664525u + 1013904223u;
    return state_ >> 16;
  }

 private:
  std::uint32_t state_ = 1;
};

TEST(FrameBits, OfAThousandFramesAddUpAsInAnotherProgram) {
  Numbers numbers;
  int total = 0;
  for (int i = 0; i < 1000; ++i) {
    Frame frame;
    frame.extended = (numbers.next() & 1u) != 0;
    const std::uint32_t high = numbers.next();
    const std::uint32_t id = high << 16 | numbers.next();
    frame.id = id & (frame.extended ? Frame::kMostExtended : Frame::kMostStandard);
    frame.size = static_cast<std::uint8_t>(numbers.next() % 9);
    for (std::size_t k = 0; k < frame.size; ++k) {
      frame.data[k] = static_cast<std::uint8_t>(numbers.next());
    }
    total += frame_bits(frame);
  }
  EXPECT_EQ(total, 91306);
}

TEST(FrameBits, OfEightBytesLieBetweenNoStuffBitAndTheWorstCase) {
  std::mt19937 random(7);
  int least = 1000;
  for (int i = 0; i < 20000; ++i) {
    Frame frame;
    frame.id = random() & Frame::kMostStandard;
    frame.size = 8;
    for (auto& byte : frame.data) byte = static_cast<std::uint8_t>(random());
    const int bits = frame_bits(frame);
    ASSERT_GE(bits, 111);
    ASSERT_LE(bits, 135);
    least = std::min(least, bits);
  }
  EXPECT_EQ(least, 111) << "some frame needs no stuff bit";
}

TEST(FrameTime, IsThatOfTheBitsAtTheBitRate) {
  const Frame sync = data_frame(0x080, {7});
  EXPECT_EQ(frame_time(sync, 1'000'000), 59us);
  EXPECT_EQ(frame_time(sync, 500'000), 118us);
  EXPECT_EQ(frame_time(sync, 125'000), 472us);
  EXPECT_EQ(bits_time(1, 83'333), 12000ns) << "12000.048 ns, rounded";
  EXPECT_EQ(bits_time(1, 33'333), 30000ns) << "30000.3 ns, rounded";
}

TEST(Frame, IsEqualByWhatIsOnTheWire) {
  Frame a = data_frame(0x123, {1, 2});
  Frame b = a;
  b.data[5] = 9;
  EXPECT_EQ(a, b) << "beyond the size";
  b.data[1] = 3;
  EXPECT_NE(a, b);
  b = a;
  b.extended = true;
  EXPECT_NE(a, b);
  EXPECT_NE(data_frame(0x123, {}), remote_frame(0x123, 0));
  EXPECT_NE(remote_frame(0x123, 1), remote_frame(0x123, 2));
}

TEST(Frame, WinsTheBusByItsBitsInTheirOrder) {
  Frame remote_extended = extended_frame(0x123 << 18, {});
  remote_extended.kind = FrameKind::kRemote;
  const std::vector<Frame> by_urgency = {
      data_frame(0x000, {}),
      data_frame(0x122, {}),
      data_frame(0x123, {}),
      remote_frame(0x123, 0),
      extended_frame(0x123 << 18, {}),
      remote_extended,
      extended_frame(0x123 << 18 | 1, {}),
      data_frame(0x124, {}),
      extended_frame(0x1fffffff, {}),
  };
  for (std::size_t i = 1; i < by_urgency.size(); ++i) {
    EXPECT_LT(arbitration_word(by_urgency[i - 1]), arbitration_word(by_urgency[i])) << i;
  }
}

TEST(Frame, CanBeSentOnlyIfIdentifierAndSizeFit) {
  EXPECT_TRUE(can_be_sent(data_frame(0x7ff, {})));
  EXPECT_FALSE(can_be_sent(data_frame(0x800, {})));
  EXPECT_TRUE(can_be_sent(extended_frame(0x1fffffff, {})));
  EXPECT_FALSE(can_be_sent(extended_frame(0x20000000, {})));
  EXPECT_FALSE(can_be_sent(remote_frame(1, 9)));
  Frame error;
  error.kind = FrameKind::kError;
  EXPECT_FALSE(can_be_sent(error));
}

TEST(FrameText, IsCandumps) {
  EXPECT_EQ(to_text(data_frame(0x123, {0xde, 0xad})).view(), "123#DEAD");
  EXPECT_EQ(to_text(data_frame(0x001, {})).view(), "001#");
  EXPECT_EQ(to_text(extended_frame(0x123, {1, 2, 3, 4, 5, 6, 7, 8})).view(),
            "00000123#0102030405060708");
  EXPECT_EQ(to_text(remote_frame(0x123, 0)).view(), "123#R");
  EXPECT_EQ(to_text(remote_frame(0x123, 4)).view(), "123#R4");
  Frame error;
  error.kind = FrameKind::kError;
  error.id = error_class::kBusOff;
  error.size = 8;
  EXPECT_EQ(to_text(error).view(), "20000040#0000000000000000");
}

TEST(FrameText, IsReadAsItWasWritten) {
  for (const char* text :
       {"123#DEADBEEF", "000#", "7FF#0011223344556677", "1FFFFFFF#01", "00000000#", "123#R",
        "123#R8", "12345678#R1", "20000040#0000000000000000"}) {
    const auto frame = parse_frame(text);
    ASSERT_TRUE(frame.ok()) << text << ": " << frame.error();
    EXPECT_EQ(to_text(frame.value()).view(), text);
  }
  EXPECT_EQ(parse_frame("7ff#de.ad").value(), data_frame(0x7ff, {0xde, 0xad}));
}

TEST(FrameText, ErrorsSayWhatWasExpected) {
  const auto error_of = [](const char* text) {
    const auto frame = parse_frame(text);
    return frame.ok() ? std::string("none") : frame.error();
  };
  EXPECT_EQ(error_of("123"), "frame '123': expected '#' between identifier and data");
  EXPECT_THAT(error_of("1234#"),
              HasSubstr("expected 3 or 8 hexadecimal digits before '#', found '1234'"));
  EXPECT_THAT(error_of("12g#"), HasSubstr("found '12g'"));
  EXPECT_THAT(error_of("800#"), HasSubstr("identifier of 11 bits, at most 7FF"));
  EXPECT_THAT(error_of("80000000#"), HasSubstr("identifier of 29 bits"));
  EXPECT_THAT(error_of("123##1"), HasSubstr("CAN FD"));
  EXPECT_THAT(error_of("123#1"), HasSubstr("two hexadecimal digits for each byte, found '1'"));
  EXPECT_THAT(error_of("123#.11"), HasSubstr("two hexadecimal digits"));
  EXPECT_THAT(error_of("123#11."), HasSubstr("two hexadecimal digits"));
  EXPECT_THAT(error_of("123#001122334455667788"), HasSubstr("at most 8 bytes"));
  EXPECT_THAT(error_of("123#R9"), HasSubstr("size from 0 to 8 behind 'R', found '9'"));
  EXPECT_THAT(error_of("20000040#R"), HasSubstr("error frame cannot be remote"));
}

}  // namespace
}  // namespace armature::can
