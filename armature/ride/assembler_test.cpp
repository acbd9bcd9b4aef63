// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/assembler.hpp"

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "armature/ride/internal/test_bytes.hpp"
#include "armature/ride/memory_share.hpp"

namespace armature::ride::internal {
namespace {

class AssemblerTest : public testing::Test {
 protected:
  AssemblerTest() : assembler_(16) {}
  AssemblerTest(std::size_t most, MemoryShare* share, BodyGate* gate)
      : assembler_(most, share, gate) {}

  void receive(std::span<const std::byte> bytes) {
    const auto room = assembler_.room();
    ASSERT_LE(bytes.size(), room.size());
    std::ranges::copy(bytes, room.begin());
    assembler_.received(bytes.size());
  }
  void receive(const std::string& text) { receive(bytes_of(text)); }
  std::string next() {
    Message message;
    switch (assembler_.next(message)) {
      case Found::kMessage:
        return std::to_string(static_cast<int>(message.header.type)) + "/" +
               std::to_string(message.header.identifier) + ":" + hex(message.body);
      case Found::kNothing:
        return "nothing";
      case Found::kTooLarge:
        return "too large:" + hex(message.body);
      case Found::kNoMemory:
        return "no memory:" + hex(message.body);
      case Found::kBadMagic:
        return "bad magic";
      case Found::kBadLength:
        return "bad length";
      case Found::kTooMany:
        return "too many";
    }
    return "?";
  }

  Assembler assembler_;
};

TEST_F(AssemblerTest, FindsEachMessageOfWhatWasReceived) {
  receive("52494445 00000000 0100 1200 03000000 aabb 52494445 00000000 0300 1000 04000000 5249");
  EXPECT_EQ(next(), "1/3:aabb");
  EXPECT_EQ(next(), "3/4:");
  EXPECT_EQ(next(), "nothing");
  EXPECT_TRUE(assembler_.incomplete());
  receive("4445 00000000 0100 1100 03000000 cc");
  EXPECT_EQ(next(), "1/3:cc");
  EXPECT_EQ(next(), "nothing");
  EXPECT_FALSE(assembler_.incomplete());
}

TEST_F(AssemblerTest, ABodyGoesOnInTheNextOfItsTypeAndIdentifier) {
  receive("52494445 00000000 0380 1200 03000000 aabb");
  receive("52494445 00000000 0480 1100 03000000 11");
  receive("52494445 00000000 0300 1100 04000000 22");
  EXPECT_EQ(next(), "3/4:22") << "of another identifier, so whole";
  EXPECT_EQ(next(), "nothing");
  EXPECT_TRUE(assembler_.incomplete());
  receive("52494445 00000000 0300 1100 03000000 cc");
  EXPECT_EQ(next(), "3/3:aabbcc");
  receive("52494445 00000000 0400 1000 03000000");
  EXPECT_EQ(next(), "4/3:11");
  EXPECT_EQ(next(), "nothing");
  EXPECT_EQ(assembler_.kept(), 0u);
}

TEST_F(AssemblerTest, NoiseIsSeenAtItsFirstByte) {
  receive("47");
  EXPECT_EQ(next(), "bad magic");
  assembler_.reset();
  receive("52494445 00000000 0300 0f00 03000000");
  EXPECT_EQ(next(), "bad length");
}

TEST_F(AssemblerTest, ABodyAboveTheLimitLeavesItsBeginningOnly) {
  receive("52494445 00000000 0280 1a00 03000000 01020304050607080910");
  receive("52494445 00000000 0280 1a00 03000000 11121314151617181920");
  EXPECT_EQ(next(), "nothing");
  EXPECT_LE(assembler_.kept(), 16u);
  receive("52494445 00000000 0200 1100 03000000 21");
  EXPECT_EQ(next(), "too large:0102030405060708");
  EXPECT_EQ(assembler_.kept(), 0u);
}

TEST_F(AssemblerTest, AllBodiesTogetherKeepToTheLimit) {
  receive("52494445 00000000 0280 1a00 03000000 01020304050607080910");
  receive("52494445 00000000 0280 1a00 04000000 11121314151617181920");
  EXPECT_EQ(next(), "nothing");
  EXPECT_LE(assembler_.kept(), 18u) << "of the second its beginning";
  receive("52494445 00000000 0200 1000 03000000");
  EXPECT_EQ(next(), "2/3:01020304050607080910");
  receive("52494445 00000000 0200 1000 04000000");
  EXPECT_EQ(next(), "too large:1112131415161718");
}

TEST_F(AssemblerTest, NotEndlesslyManyBodiesGoOn) {
  for (char i = '0'; i <= '9'; ++i) {
    receive(std::string("52494445 00000000 0180 1000 0") + i + "000000");
    receive(std::string("52494445 00000000 0280 1000 0") + i + "000000");
  }
  EXPECT_EQ(next(), "too many");
}

TEST_F(AssemblerTest, HowBytesAreCutDoesNotMatter) {
  std::mt19937 random(5);
  std::vector<std::byte> stream;
  std::vector<std::string> expected;
  for (std::uint32_t i = 0; i < 500; ++i) {
    Body message;
    std::vector<std::byte> body(random() % 16);
    for (auto& byte : body) byte = static_cast<std::byte>(random());
    append_message(message, {}, Type::kReply, i, body);
    stream.insert(stream.end(), message.bytes().begin(), message.bytes().end());
    expected.push_back("3/" + std::to_string(i) + ":" + hex(body));
  }
  std::vector<std::string> found;
  std::span<const std::byte> left(stream);
  while (!left.empty()) {
    const auto part = left.first(std::min<std::size_t>(left.size(), 1 + random() % 40));
    receive(part);
    left = left.subspan(part.size());
    for (std::string one = next(); one != "nothing"; one = next()) found.push_back(one);
  }
  EXPECT_EQ(found, expected);
}

TEST(LargestMessage, AlwaysHasRoom) {
  Assembler assembler(1 << 20);
  Body message;
  append_message(message, {}, Type::kReply, 1, std::vector<std::byte>(Header::kMostBody));
  Message found;
  for (int i = 0; i < 10; ++i) {
    std::span<const std::byte> left = message.bytes();
    while (!left.empty()) {
      EXPECT_EQ(assembler.next(found), Found::kNothing);
      const auto room = assembler.room();
      const auto part = left.first(std::min({left.size(), room.size(), std::size_t{40'000}}));
      ASSERT_FALSE(part.empty());
      std::ranges::copy(part, room.begin());
      assembler.received(part.size());
      left = left.subspan(part.size());
    }
    ASSERT_EQ(assembler.next(found), Found::kMessage);
    EXPECT_EQ(found.body.size(), Header::kMostBody);
  }
}

/// Admits what begins with "aa".
class Gate final : public BodyGate {
 public:
  bool admits(const Message& first) override {
    ++asked;
    return hex(first.body).starts_with("aa");
  }
  int asked = 0;
};

/// What an assembler borrows: there before it and after it.
struct Bounded {
  Bounded() { EXPECT_TRUE(share_.open(false)); }

  Gate gate_;
  std::shared_ptr<MemoryBound> all_ = std::make_shared<MemoryBound>(400'000, 0);
  MemoryShare share_{all_, 0};
};

class AssemblerWithGate : protected Bounded, public AssemblerTest {
 protected:
  AssemblerWithGate() : AssemblerTest(1 << 20, &share_, &gate_) {}
};

TEST_F(AssemblerWithGate, ABodyThatIsNotAdmittedIsDroppedToItsEndAndNothingElse) {
  receive("52494445 00000000 0180 1200 03000000 bbcc");
  EXPECT_EQ(next(), "nothing");
  receive("52494445 00000000 0180 1200 04000000 aabb");
  receive("52494445 00000000 0180 1200 03000000 ddee 52494445 00000000 0100 1100 03000000 ff");
  EXPECT_EQ(next(), "nothing");
  EXPECT_EQ(gate_.asked, 2) << "for each body once";
  receive("52494445 00000000 0100 1100 04000000 cc");
  EXPECT_EQ(next(), "1/4:aabbcc");
  receive("52494445 00000000 0100 1100 03000000 bb");
  EXPECT_EQ(next(), "1/3:bb") << "a message of one piece needs no memory of others";
  EXPECT_FALSE(assembler_.incomplete());
}

TEST_F(AssemblerWithGate, ABodyThatThereIsNoMemoryForSaysHowItBegan) {
  Body part;
  part.extend(16'000);
  std::ranges::fill(std::span(part.data(), part.size()), std::byte{0xaa});
  constexpr int kLast = 30;
  for (int i = 0; i <= kLast; ++i) {
    Body bytes;
    append_message(bytes, {}, Type::kRequest, 3, part.bytes());
    bytes.data()[9] = i == kLast ? std::byte{0} : std::byte{0x80};
    receive(bytes.bytes());
    EXPECT_EQ(next(), i == kLast ? "no memory:aaaaaaaaaaaaaaaa" : "nothing");
  }
  EXPECT_LE(all_->used(), 400'000u);
}

}  // namespace
}  // namespace armature::ride::internal
