// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/wire.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "armature/ride/interface.hpp"
#include "armature/ride/internal/test_bytes.hpp"

namespace armature::ride {
namespace {

template <typename... Fields>
std::string message(Priority priority, Type type, std::uint32_t identifier,
                    const Fields&... fields) {
  Body body;
  body.extend(Header::kSize);
  Encoder to(body);
  (to.put(fields), ...);
  finish_message(body, 0, priority, type, identifier);
  return hex(body.bytes());
}

TEST(Numbers, AreThoseOfTheCanonicalDeclarations) {
  EXPECT_EQ(number_of("void setVelocity(float,float)"), 0x66e299dfu);
  EXPECT_EQ(number_of("int setThreshold(unsigned int,unsigned int,unsigned int)"), 0x22f17958u);
  EXPECT_EQ(number_of("void start()"), 0xdcab56acu);
  EXPECT_EQ(number_of("event ObjectPosition{int,int}"), 0x714c2b59u);
  EXPECT_EQ(number_of("void moveTo(Array<double>,double)"), 0xd53a44a9u);
}

TEST(Digest, IsThatOfTheSortedDeclarations) {
  static constexpr Declaration kSome[] = {{"void start()"}, {"event ObjectPosition{int,int}"}};
  EXPECT_EQ(digest({"Vision", kSome}), number_of("event ObjectPosition{int,int};void start()"));
  EXPECT_EQ(digest({"Nothing", {}}), number_of(""));
}

TEST(Message, EveryTypeHasItsGoldenBytes) {
  EXPECT_EQ(
      message({7}, Type::kCommand, 3, number_of("void setVelocity(float,float)"), 0.5f, -0.25f),
      "52494445"
      "07000000"
      "0100"
      "1c00"
      "03000000"
      "df99e266"
      "0000003f"
      "000080be");
  EXPECT_EQ(message({0}, Type::kRequest, 3,
                    number_of("int setThreshold(unsigned int,unsigned int,unsigned int)"), 9u, 1u,
                    2u, 3u),
            "52494445"
            "00000000"
            "0200"
            "2400"
            "03000000"
            "5879f122"
            "09000000"
            "01000000"
            "02000000"
            "03000000");
  EXPECT_EQ(message({0}, Type::kReply, 9, -1),
            "52494445"
            "00000000"
            "0300"
            "1400"
            "09000000"
            "ffffffff");
  EXPECT_EQ(message({255}, Type::kEvent, 17, number_of("event ObjectPosition{int,int}"), 320, 240),
            "52494445"
            "ff000000"
            "0400"
            "1c00"
            "11000000"
            "592b4c71"
            "40010000"
            "f0000000");
  EXPECT_EQ(
      message({0}, Type::kControl, 9, Control{Code::kNoSuchOperation, 2, 3, 0x12345678, "no"}),
      "52494445"
      "00000000"
      "0500"
      "2600"
      "09000000"
      "02000000"
      "02000000"
      "03000000"
      "78563412"
      "02000000"
      "6e6f");
}

TEST(Header, IsReadAsItWasWritten) {
  for (const Header& header : {Header{7, Type::kCommand, false, 28, 3},
                               Header{255, Type::kEvent, true, 65535, 0xffffffff}}) {
    std::byte bytes[Header::kSize];
    write_header(bytes, header);
    EXPECT_EQ(read_header(bytes), header);
  }
}

TEST(Header, NeedsTheMagic) {
  EXPECT_TRUE(read_header(bytes_of("52494445070000000100100003000000").data()).has_value());
  EXPECT_FALSE(read_header(bytes_of("52494446070000000100100003000000").data()).has_value());
}

TEST(Control, IsTakenAsItWasPut) {
  Body body;
  Encoder(body).put(Control{Code::kFailed, 1, 2, 3, "it did not"});
  Control control;
  Decoder from(body.bytes());
  ASSERT_TRUE(from.take(control) && from.ended());
  EXPECT_EQ(control.code, Code::kFailed);
  EXPECT_EQ(control.type, 1u);
  EXPECT_EQ(control.recipient, 2u);
  EXPECT_EQ(control.operation, 3u);
  EXPECT_EQ(control.text, "it did not");
}

TEST(LargeMessage, GoesOnInTheNextOfTheSameTypeAndIdentifier) {
  Body wire;
  wire.append(bytes_of("aa"));
  wire.extend(Header::kSize);
  std::byte* const body = wire.extend(2 * Header::kMostBody + 1);
  for (std::size_t i = 0; i <= 2 * Header::kMostBody; ++i)
    body[i] = static_cast<std::byte>(i % 251);
  finish_message(wire, 1, {5}, Type::kReply, 77);

  ASSERT_EQ(wire.size(), 1 + 2 * Header::kMostLength + Header::kSize + 1);
  const std::byte* at = wire.data() + 1;
  EXPECT_EQ(read_header(at), (Header{5, Type::kReply, true, 65535, 77}));
  EXPECT_EQ(read_header(at + 65535), (Header{5, Type::kReply, true, 65535, 77}));
  EXPECT_EQ(read_header(at + 2 * 65535), (Header{5, Type::kReply, false, 17, 77}));
  EXPECT_EQ(at[65535 + 16], static_cast<std::byte>(Header::kMostBody % 251));
  EXPECT_EQ(wire.bytes().back(), static_cast<std::byte>(2 * Header::kMostBody % 251));
}

TEST(LargeMessage, IsTheSameWhereverItsBodyLay) {
  for (const std::size_t size : {Header::kMostBody + 1, 2 * Header::kMostBody,
                                 2 * Header::kMostBody + 1, 40 * Header::kMostBody - 1}) {
    Body body;
    body.extend(size);
    for (std::size_t i = 0; i < size; ++i) body.data()[i] = static_cast<std::byte>(i * i % 251);
    Body appended;
    append_message(appended, {7}, Type::kRequest, 3, body.bytes());
    Body finished;
    finished.extend(Header::kSize);
    finished.append(body.bytes());
    finish_message(finished, 0, {7}, Type::kRequest, 3);
    EXPECT_TRUE(std::ranges::equal(finished.bytes(), appended.bytes())) << size;
  }
}

TEST(LargeMessage, ThatJustFitsIsOne) {
  Body wire;
  wire.extend(Header::kMostLength);
  finish_message(wire, 0, {}, Type::kReply, 1);
  EXPECT_EQ(wire.size(), Header::kMostLength);
  EXPECT_EQ(read_header(wire.data()), (Header{0, Type::kReply, false, 65535, 1}));
}

}  // namespace
}  // namespace armature::ride
