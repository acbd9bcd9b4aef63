// SPDX-License-Identifier: Apache-2.0
// What generated structs are on the wire: golden bytes, and every type there and back.
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/types/type.hpp"
#include "chassis_client.hpp"
#include "chassis_service.hpp"
#include "directory_client.hpp"
#include "directory_service.hpp"
#include "everything_client.hpp"
#include "everything_service.hpp"
#include "odd_names_types.hpp"
#include "tests/idl/bytes.hpp"
#include "vision_client.hpp"
#include "vision_service.hpp"

namespace armature::idl {
namespace {

everything::Singles singles() {
  return {true,
          'c',
          200,
          -300,
          60000,
          -70000,
          4000000000,
          std::numeric_limits<std::int64_t>::min(),
          std::numeric_limits<std::uint64_t>::max(),
          0.5f,
          -0.25,
          "grün",
          {true, 1.5}};
}

everything::Lists lists() {
  return {{1, 0, 1},
          {'a', 'b'},
          {1, 255},
          {-1, 2},
          {3},
          {-4, 5},
          {6},
          {-7},
          {8, 9, 10},
          {0.5f},
          {},
          {"a", "", "bc"},
          {{true, 0.5}, {false, 2.0}}};
}

everything::Fixed fixed() {
  return {{true, false, true},
          {'x', 'y', 'z'},
          {1, 2, 3},
          {-1, -2, -3},
          {1, 2, 3},
          {-1, -2, -3},
          {1, 2, 3},
          {-1, -2, -3},
          {1, 2, 3},
          {0.5f, 1.0f, 1.5f},
          {0.5, 1.0, 1.5},
          {"one", "two"},
          {{{true, 1.0}, {false, 2.0}}}};
}

everything::Choices choices() {
  return {everything::Mode::kHoldPosition,
          everything::Small::kLeast,
          everything::Short::kLeast,
          everything::UnsignedShort::kMode_2,
          everything::Int::kLeast,
          everything::UnsignedInt::kGreatest,
          everything::Long::kAfterLeast,
          {everything::Mode::kPosition, everything::Mode::kIdle},
          {everything::Int::kZero, everything::Int::kClass},
          geometry::Frame::kFloor};
}

template <typename T>
std::string text_of(const T& value) {
  return types::to_text(types::type_of<T>(), &value);
}

template <typename T>
void expect_there_and_back(const T& value) {
  T taken{};
  ASSERT_TRUE(transfer(value, taken));
  EXPECT_EQ(text_of(taken), text_of(value));
  EXPECT_TRUE(refuses_every_beginning(value));
}

TEST(GeneratedTypes, SinglesGoThereAndBack) { expect_there_and_back(singles()); }
TEST(GeneratedTypes, ListsGoThereAndBack) { expect_there_and_back(lists()); }
TEST(GeneratedTypes, EmptyListsGoThereAndBack) { expect_there_and_back(everything::Lists{}); }
TEST(GeneratedTypes, FixedArraysGoThereAndBack) { expect_there_and_back(fixed()); }
TEST(GeneratedTypes, AnEventOfAllOfThemGoesThereAndBack) {
  expect_there_and_back(everything::Everything{singles(), lists(), fixed()});
}

TEST(GeneratedTypes, EnumerationsGoThereAndBack) { expect_there_and_back(choices()); }

TEST(GeneratedTypes, AnEnumerationHasTheBytesOfItsInteger) {
  EXPECT_EQ(encoded(choices()),
            "05 80 00 80 "              // byte, char, short
            "ff ff 00 00 "              // unsigned short, padding
            "00 00 00 80 "              // int
            "ff ff ff ff "              // unsigned int
            "01 00 00 00 00 00 00 80 "  // long
            "02 00 00 00 04 00 00 00 "  // two bytes, padding
            "00 00 00 00 07 00 00 00 "  // two of int
            "01");
}

TEST(GeneratedTypes, AnEnumerationTakesOnlyItsEnumerators) {
  everything::Mode mode = everything::Mode::kPosition;
  for (int number = 0; number < 256; ++number) {
    const bool known = number == 0 || number == 4 || number == 5;
    EXPECT_EQ(transfer(static_cast<std::uint8_t>(number), mode), known) << number;
  }
  EXPECT_EQ(mode, everything::Mode::kHoldPosition);
  std::vector<everything::Mode> modes;
  EXPECT_TRUE(transfer(std::vector<std::uint8_t>{4, 0}, modes));
  EXPECT_FALSE(transfer(std::vector<std::uint8_t>{4, 1}, modes));
}

TEST(GeneratedTypes, EnumeratorsHaveTheirNamesInTexts) {
  const auto names = [](const types::Type& type) {
    std::vector<std::string> all;
    for (const types::Enumerator& each : type.enumerators) all.push_back(each.name);
    return all;
  };
  using ::testing::ElementsAre;
  EXPECT_THAT(names(types::type_of<everything::Mode>()),
              ElementsAre("idle", "position", "hold_position"));
  EXPECT_THAT(names(types::type_of<odd_names::value_>()),
              ElementsAre("k", "kk", "a_b", "ab", "a_1", "a1", "k_k"));
  EXPECT_THAT(names(types::type_of<odd_names::enum_>()),
              ElementsAre("encode", "enum", "default", "event", "import", "interface"));
}

TEST(GeneratedTypes, ACommandHasTheGoldenBytesOfTheProtocol) {
  ride::Body body;
  ride::Encoder to(body);
  to.put(chassis::kChassisDeclarations[0].number());
  to.put(0.5f);
  to.put(-0.25f);
  ride::Body message;
  ride::append_message(message, ride::Priority{7}, ride::Type::kCommand, 3, body.bytes());
  EXPECT_EQ(hexadecimal(message.bytes()),
            "52 49 44 45 07 00 00 00 01 00 1c 00 03 00 00 00 "
            "df 99 e2 66 00 00 00 3f 00 00 80 be");
}

TEST(GeneratedTypes, AnEventHasTheBytesOfItsMembers) {
  EXPECT_EQ(encoded(vision::ObjectPosition{320, -2}), "40 01 00 00 fe ff ff ff");
}

TEST(GeneratedTypes, EightBytesAreAlignedOnFour) {
  EXPECT_EQ(encoded(everything::Inner{true, 1.0}), "01 00 00 00 00 00 00 00 00 00 f0 3f");
}

TEST(GeneratedTypes, SinglesHaveTheseBytes) {
  EXPECT_EQ(encoded(singles()),
            "01 63 c8 00 "              // bool, char, byte, padding
            "d4 fe 60 ea "              // short, unsigned short
            "90 ee fe ff "              // int
            "00 28 6b ee "              // unsigned int
            "00 00 00 00 00 00 00 80 "  // long
            "ff ff ff ff ff ff ff ff "  // unsigned long
            "00 00 00 3f "              // float
            "00 00 00 00 00 00 d0 bf "  // double
            "05 00 00 00 67 72 c3 bc 6e "
            "01 00 00 "  // the bool within, padding
            "00 00 00 00 00 00 f8 3f");
}

TEST(GeneratedTypes, AnArrayIsCountedUnlessItsSizeIsKnown) {
  const chassis::Route route{"r", {{1.0, 2.0, 0.0}}};
  EXPECT_EQ(encoded(route),
            "01 00 00 00 72 00 00 00 01 00 00 00 "
            "00 00 00 00 00 00 f0 3f 00 00 00 00 00 00 00 40 00 00 00 00 00 00 00 00");
  EXPECT_EQ(encoded(chassis::Bumped{{true, false, false, true}}), "01 00 00 01");
}

TEST(GeneratedTypes, ABoolOfTwoIsRefused) {
  everything::Lists one;
  one.b = {1};
  ride::Body body;
  ride::Encoder(body).put(one);
  everything::Lists taken;
  EXPECT_TRUE(ride::Decoder(body.bytes()).take(taken));
  body.data()[4] = std::byte{2};
  EXPECT_FALSE(ride::Decoder(body.bytes()).take(taken));
}

TEST(GeneratedTypes, NumbersAreThoseOfTheProtocol) {
  EXPECT_EQ(event_number(static_cast<const vision::ObjectPosition*>(nullptr)), 0x714c2b59u);
  EXPECT_EQ(vision::kVisionDeclarations[1].canonical,
            "int setThreshold(unsigned int,unsigned int,unsigned int)");
  EXPECT_EQ(vision::kVisionDeclarations[1].number(), 0x22f17958u);
  EXPECT_EQ(vision::kVisionDeclarations[2].number(), 0xdcab56acu);
  EXPECT_EQ(chassis::kChassisDeclarations[0].number(), 0x66e299dfu);
}

TEST(GeneratedTypes, TheInterfaceSaysWhoMayDoWhat) {
  using ride::Access;
  const auto access = [](std::string_view begin) {
    for (const ride::Declaration& each : vision::kVisionDeclarations) {
      if (each.canonical.starts_with(begin)) return each.access;
    }
    throw std::runtime_error("there is no such declaration");
  };
  EXPECT_EQ(access("int setThreshold"), Access::kConfigure);
  EXPECT_EQ(access("void start"), Access::kCommand);
  EXPECT_EQ(access("event ObjectPosition"), Access::kRead);
  EXPECT_EQ(vision::kVision.name, "Vision");
}

TEST(GeneratedTypes, TheDigestIsThatOfTheLibrary) {
  EXPECT_EQ(ride::digest(chassis::kChassisService_),
            base::fnv1a("event Bumped{Array<bool,4>};"
                        "int setGains(Array<double,3>,Array<double,3>,Array<String>)"));
}

TEST(GeneratedTypes, ToolsSeeUnitsAndDocumentation) {
  const types::Type& type = types::type_of<geometry::Pose>();
  ASSERT_EQ(type.fields.size(), 3u);
  EXPECT_EQ(type.name, "Pose");
  EXPECT_EQ(type.fields[0].unit, "m");
  EXPECT_EQ(type.fields[2].unit, "rad");
  EXPECT_EQ(type.fields[2].doc, "counter-clockwise, from the first axis");
}

}  // namespace
}  // namespace armature::idl
