// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <limits>

#include <gtest/gtest.h>

#include "armature/testing/test_types.hpp"

namespace armature::types {
namespace {

struct Message {
  bool urgent = false;
  std::uint16_t code = 0;
  std::int32_t delta = 0;
  float gain = 0.0f;
  std::vector<double> q;
  std::array<std::uint8_t, 2> pair{};
  std::string text;
  base::FixedText<8> label;
};
ARMATURE_STRUCT(Message, urgent, code, delta, gain, q, pair, text, label);

template <typename T>
std::string hex(const T& value) {
  std::vector<std::byte> bytes;
  encode(type_of<T>(), &value, bytes);
  std::string text;
  for (const std::byte byte : bytes) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    text += kDigits[std::to_integer<unsigned>(byte) >> 4];
    text += kDigits[std::to_integer<unsigned>(byte) & 15];
  }
  return text;
}

std::vector<std::byte> bytes_of(std::initializer_list<int> numbers) {
  std::vector<std::byte> bytes;
  for (const int number : numbers) bytes.push_back(static_cast<std::byte>(number));
  return bytes;
}

template <typename T>
base::Result<std::size_t> decode_into(T& value, const std::vector<std::byte>& bytes) {
  return decode(type_of<T>(), bytes.data(), bytes.size(), &value);
}

/// What `decode` says to bytes that are no `T`; checks that it leaves the value as it was.
template <typename T>
std::string complaint(const std::vector<std::byte>& bytes, const T& before = {}) {
  T value = before;
  const base::Result<std::size_t> result = decode_into(value, bytes);
  EXPECT_EQ(value, before);
  return result ? "none" : result.error();
}

// The binary form is in recordings and on the wire: it never changes.
TEST(Encode, GivesTheGoldenBytes) {
  Message message;
  message.urgent = true;
  message.code = 0x1234;
  message.delta = -2;
  message.gain = 0.5f;
  message.q = {1.0, -2.0};
  message.pair = {7, 255};
  message.text = "hé";
  message.label = "ab";
  EXPECT_EQ(hex(message),
            "01"
            "3412"
            "feffffff"
            "0000003f"
            "02000000"
            "000000000000f03f"
            "00000000000000c0"
            "07ff"
            "0300000068c3a9"
            "020000006162");
}

TEST(Encode, WritesEveryScalarInLittleEndian) {
  EXPECT_EQ(hex(false), "00");
  EXPECT_EQ(hex(std::int8_t{-2}), "fe");
  EXPECT_EQ(hex(std::uint8_t{0x81}), "81");
  EXPECT_EQ(hex(std::int16_t{-2}), "feff");
  EXPECT_EQ(hex(std::uint16_t{0x8123}), "2381");
  EXPECT_EQ(hex(std::uint32_t{0x81234567}), "67452381");
  EXPECT_EQ(hex(std::int64_t{-2}), "feffffffffffffff");
  EXPECT_EQ(hex(std::uint64_t{0x8123456789abcdef}), "efcdab8967452381");
  EXPECT_EQ(hex(-0.25f), "000080be");
  EXPECT_EQ(hex(0.5), "000000000000e03f");
}

TEST(Encode, AppendsToWhatIsThere) {
  std::vector<std::byte> bytes = bytes_of({9});
  const std::uint16_t value = 1;
  encode(type_of<std::uint16_t>(), &value, bytes);
  EXPECT_EQ(bytes, bytes_of({9, 1, 0}));
}

TEST(EncodeTo, WritesAsManyBytesAsEncodedSizeSays) {
  const Everything value = make_everything();
  const Type& type = type_of<Everything>();
  const std::size_t size = encoded_size(type, &value);
  std::vector<std::byte> bytes(size + 1, std::byte{0x5a});
  EXPECT_EQ(encode_to(type, &value, bytes.data()), size);
  EXPECT_EQ(bytes.back(), std::byte{0x5a});
}

TEST(Decode, ReadsEveryKindBack) {
  const Everything value = make_everything();
  std::vector<std::byte> bytes;
  encode(type_of<Everything>(), &value, bytes);
  Everything read;
  read.names = {"old", "names", "that", "go"};
  const base::Result<std::size_t> used = decode_into(read, bytes);
  ASSERT_TRUE(used) << used.error();
  EXPECT_EQ(used.value(), bytes.size());
  EXPECT_EQ(read, value);
}

TEST(Decode, KeepsEveryBitOfAFloatingPointNumber) {
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), -0.0,
                             -std::numeric_limits<double>::infinity(), 5e-324}) {
    std::vector<std::byte> bytes;
    encode(type_of<double>(), &value, bytes);
    double read = 1.0;
    ASSERT_TRUE(decode_into(read, bytes));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(read), std::bit_cast<std::uint64_t>(value));
  }
}

TEST(Decode, ReportsTheBytesItUsedAndIgnoresTheRest) {
  std::uint16_t value = 0;
  const base::Result<std::size_t> used = decode_into(value, bytes_of({1, 2, 3}));
  ASSERT_TRUE(used);
  EXPECT_EQ(used.value(), 2u);
  EXPECT_EQ(value, 0x0201);
}

TEST(Decode, RefusesEveryShortenedMessageAndLeavesTheValueAsItWas) {
  const Everything value = make_everything();
  std::vector<std::byte> bytes;
  encode(type_of<Everything>(), &value, bytes);
  Everything before;
  before.text = "as it was";
  while (!bytes.empty()) {
    bytes.pop_back();
    EXPECT_NE(complaint(bytes, before), "none") << bytes.size();
  }
}

TEST(Decode, SaysWhatIsMissing) {
  EXPECT_EQ(complaint<double>(bytes_of({1, 2, 3})),
            "cannot decode double: double at byte 0 needs 8 bytes, but only 3 remain");
  EXPECT_EQ(complaint<Pose>(std::vector<std::byte>(12)),
            "cannot decode Pose: double at byte 8 needs 8 bytes, but only 4 remain");
  EXPECT_EQ(complaint<std::string>(bytes_of({1, 0})),
            "cannot decode text: text at byte 0 needs 4 bytes, but only 2 remain");
}

TEST(Decode, RefusesACountThatExceedsTheBytesThatRemain) {
  EXPECT_EQ(complaint<std::vector<double>>(bytes_of({1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}), {7.0}),
            "cannot decode vector<double>: vector<double> at byte 0 announces 1 elements, but "
            "only 7 bytes remain");
  EXPECT_EQ(complaint<std::vector<Pose>>(bytes_of({255, 255, 255, 255})),
            "cannot decode vector<Pose>: vector<Pose> at byte 0 announces 4294967295 elements, "
            "but only 0 bytes remain");
  EXPECT_EQ(complaint<std::string>(bytes_of({3, 0, 0, 0, 'a', 'b'})),
            "cannot decode text: text at byte 0 announces 3 elements, but only 2 bytes remain");
  EXPECT_EQ((complaint<std::vector<std::array<std::string, 2>>>(
                bytes_of({2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}))),
            "cannot decode vector<array<text,2>>: vector<array<text,2>> at byte 0 announces 2 "
            "elements, but only 12 bytes remain");
}

TEST(Decode, RefusesABoolThatIsNeitherZeroNorOne) {
  EXPECT_EQ(complaint<bool>(bytes_of({2})),
            "cannot decode bool: bool at byte 0 is 0 or 1, but 2 was found");
  EXPECT_NE((complaint<std::array<bool, 3>>(bytes_of({1, 0, 255}))), "none");
}

TEST(Decode, RefusesTextThatDoesNotFit) {
  EXPECT_EQ(complaint<base::FixedText<2>>(bytes_of({3, 0, 0, 0, 'a', 'b', 'c'})),
            "cannot decode text<2>: text<2> at byte 4 is too short for 3 bytes");
}

TEST(Decode, AcceptsEmptyVectorsAndText) {
  std::vector<std::string> names{"old"};
  ASSERT_TRUE(decode_into(names, bytes_of({0, 0, 0, 0})));
  EXPECT_TRUE(names.empty());
  std::string text = "old";
  ASSERT_TRUE(decode_into(text, bytes_of({0, 0, 0, 0})));
  EXPECT_EQ(text, "");
}

}  // namespace
}  // namespace armature::types
