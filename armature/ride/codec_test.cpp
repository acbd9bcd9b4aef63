// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/codec.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "armature/ride/internal/test_bytes.hpp"

namespace armature::ride {

struct Point {
  std::int8_t tag = 0;
  double x = 0;
  friend bool operator==(const Point&, const Point&) = default;
};
inline void encode(Encoder& to, const Point& point) {
  to.put(point.tag);
  to.put(point.x);
}
inline bool decode(Decoder& from, Point& point) {
  return from.take(point.tag) && from.take(point.x);
}

struct Nothing {};
inline void encode(Encoder&, const Nothing&) {}
inline bool decode(Decoder&, Nothing&) { return true; }

namespace {

template <typename T>
std::string encoded(const T& value) {
  Body body;
  Encoder(body).put(value);
  return hex(body.bytes());
}

/// That `value` is these bytes, and these bytes are `value`.
template <typename T>
void expect_golden(const T& value, const std::string& golden) {
  EXPECT_EQ(encoded(value), golden);
  const auto body = bytes_of(golden);
  Decoder from(body);
  T taken{};
  ASSERT_TRUE(from.take(taken)) << golden;
  EXPECT_TRUE(from.ended()) << golden;
  EXPECT_EQ(taken, value);
}

template <typename T>
bool is_taken(const std::string& golden) {
  const auto body = bytes_of(golden);
  Decoder from(body);
  T taken{};
  return from.take(taken) && from.ended();
}

TEST(Codec, EveryScalarHasItsGoldenBytes) {
  expect_golden(true, "01");
  expect_golden(false, "00");
  expect_golden('A', "41");
  expect_golden<std::uint8_t>(0xfe, "fe");
  expect_golden<std::int16_t>(-2, "feff");
  expect_golden<std::uint16_t>(0x1234, "3412");
  expect_golden<std::int32_t>(-3, "fdffffff");
  expect_golden<std::uint32_t>(0x12345678, "78563412");
  expect_golden<std::int64_t>(std::numeric_limits<std::int64_t>::min(), "0000000000000080");
  expect_golden<std::uint64_t>(0x0102030405060708, "0807060504030201");
  expect_golden(0.5f, "0000003f");
  expect_golden(-0.25, "000000000000d0bf");
}

TEST(Codec, TextAndArraysHaveTheirGoldenBytes) {
  expect_golden(std::string("hü"), "0300000068c3bc");
  expect_golden(std::string(), "00000000");
  expect_golden(std::vector<std::int16_t>{1, -1}, "020000000100ffff");
  expect_golden(std::vector<double>{1.0}, "01000000000000000000f03f");
  expect_golden(std::array<std::uint8_t, 3>{1, 2, 3}, "010203");
  expect_golden(std::array<bool, 2>{true, false}, "0100");
  expect_golden(std::vector<std::string>{"a", "bc"},
                "02000000"
                "01000000"
                "61"
                "000000"
                "02000000"
                "6263");
  expect_golden(std::vector<Point>{{1, 1.0}, {2, 0.0}},
                "02000000"
                "01000000"
                "000000000000f03f"
                "02000000"
                "0000000000000000");
  expect_golden(std::array<std::vector<std::uint8_t>, 2>{std::vector<std::uint8_t>{7}, {}},
                "0100000007"
                "000000"
                "00000000");
}

TEST(Codec, FieldsAreAlignedRelativeToTheStart) {
  Body body;
  body.append(bytes_of("aabbcc"));
  Encoder to(body);
  to.put(std::uint8_t{1});
  to.put(std::uint16_t{2});
  to.put(std::uint8_t{3});
  to.put(4.0);
  to.put(std::uint8_t{5});
  to.put(std::uint64_t{6});
  EXPECT_EQ(hex(body.bytes()),
            "aabbcc"
            "0100"
            "0200"
            "03000000"
            "0000000000001040"
            "05000000"
            "0600000000000000");
}

TEST(Codec, PaddingIsIgnored) {
  const auto body = bytes_of("01ffffff02000000");
  Decoder from(body);
  std::uint8_t a = 0;
  std::uint32_t b = 0;
  EXPECT_TRUE(from.take(a) && from.take(b) && from.ended());
  EXPECT_EQ(b, 2u);
}

TEST(Codec, AnEmptyArrayNeedsNoPaddingOfItsElements) {
  expect_golden(std::vector<double>{}, "00000000");
  EXPECT_TRUE((is_taken<std::array<Nothing, 2>>("")));
}

TEST(Codec, FlagsAreNullAndOne) {
  Body body;
  Encoder(body).put_flags({0, 1, 7});
  EXPECT_EQ(hex(body.bytes()), "03000000000101");
  std::vector<std::uint8_t> flags;
  Decoder good(body.bytes());
  EXPECT_TRUE(good.take_flags(flags) && good.ended());
  EXPECT_EQ(flags, (std::vector<std::uint8_t>{0, 1, 1}));
  const auto bad_bytes = bytes_of("020000000102");
  Decoder bad(bad_bytes);
  EXPECT_FALSE(bad.take_flags(flags));
}

TEST(Codec, WhatIsTooShortIsRefused) {
  EXPECT_FALSE(is_taken<bool>(""));
  EXPECT_FALSE(is_taken<std::uint16_t>("01"));
  EXPECT_FALSE(is_taken<double>("00000000000000"));
  EXPECT_FALSE(is_taken<std::string>("0300000061"));
  EXPECT_FALSE(is_taken<std::string>("030000"));
  EXPECT_FALSE((is_taken<std::array<int, 2>>("00000000000000")));
}

TEST(Codec, BytesLeftOverAreSeen) {
  EXPECT_FALSE(is_taken<bool>("0100"));
  EXPECT_FALSE(is_taken<std::string>("0000000000"));
}

TEST(Codec, ABoolIsNullOrOne) {
  EXPECT_FALSE(is_taken<bool>("02"));
  EXPECT_FALSE((is_taken<std::array<bool, 2>>("01ff")));
}

TEST(Codec, ACountThatLiesCostsNoMemory) {
  EXPECT_FALSE(is_taken<std::vector<std::uint8_t>>("ffffffff0102"));
  EXPECT_FALSE(is_taken<std::vector<double>>("0200000000000000000000000000"));
  EXPECT_FALSE(is_taken<std::vector<std::string>>("ffffffff"));
  EXPECT_FALSE(
      is_taken<std::vector<Point>>("08000000"
                                   "0100000000000000"));
  EXPECT_FALSE(is_taken<std::vector<Nothing>>("ffffffff"));
}

TEST(Codec, AfterAFailureNothingIsTaken) {
  const auto body = bytes_of("020000000000");
  Decoder from(body);
  bool flag = false;
  std::uint8_t byte = 0;
  std::vector<std::uint8_t> none;
  std::array<std::uint32_t, 0> nothing{};
  EXPECT_FALSE(from.take(flag));
  EXPECT_FALSE(from.take(byte));
  EXPECT_FALSE(from.take(none));
  EXPECT_FALSE(from.take(nothing));
  EXPECT_FALSE(from.ended());
  EXPECT_EQ(from.remaining(), 0u);
}

TEST(Codec, TextIsUtf8) {
  EXPECT_TRUE(is_taken<std::string>("04000000f09f9880"));
  EXPECT_FALSE(is_taken<std::string>("01000000ff"));
  EXPECT_FALSE(is_taken<std::string>("02000000c080")) << "overlong";
  EXPECT_FALSE(is_taken<std::string>("03000000eda080")) << "surrogate";
  EXPECT_FALSE(is_taken<std::string>("04000000f4908080")) << "above U+10FFFF";
  EXPECT_FALSE(is_taken<std::string>("02000000c361")) << "no continuation";
  EXPECT_FALSE(is_taken<std::string>("03000000f09f98")) << "ends early";
}

TEST(Codec, TextCanBeLookedAtWhereItLies) {
  const auto body = bytes_of("026869000200000068690000");
  Decoder from{std::span<const std::byte>(body).subspan(4)};
  std::string_view text;
  ASSERT_TRUE(from.take(text));
  EXPECT_EQ(text, "hi");
}

TEST(Codec, NotANumberStaysWhatItIs) {
  const auto body = bytes_of("0000c07f");
  Decoder from(body);
  float value = 0;
  ASSERT_TRUE(from.take(value));
  EXPECT_TRUE(std::isnan(value));
}

TEST(Body, KeepsItsMemory) {
  Body body;
  body.append(bytes_of("0102030405"));
  body.erase_front(2);
  EXPECT_EQ(hex(body.bytes()), "030405");
  const std::byte* const memory = body.data();
  body.clear();
  body.append(bytes_of("06"));
  EXPECT_EQ(body.data(), memory);
  body.shrink(1);
  EXPECT_EQ(hex(body.bytes()), "06");
  body.clear();
  body.shrink(1);
  EXPECT_EQ(body.capacity(), 0u);
}

TEST(Codec, ABodyIsHandedOnUnseen) {
  Body body;
  Encoder(body).put(std::string("abc"));
  Decoder unseen(body.bytes());
  Body other;
  Encoder(other).put_body(unseen.take_rest());
  EXPECT_TRUE(unseen.ended());
  EXPECT_TRUE(unseen.take_rest().empty());
  Decoder decoder(other.bytes());
  std::string text;
  EXPECT_TRUE(decoder.take(text) && decoder.ended());
  EXPECT_EQ(text, "abc");
}

}  // namespace
}  // namespace armature::ride
