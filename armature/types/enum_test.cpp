// SPDX-License-Identifier: Apache-2.0
#include "armature/types/enum.hpp"

#include <gtest/gtest.h>

#include "armature/testing/test_types.hpp"

namespace armature::types {
namespace {

class Robot {
 public:
  enum class Mode : std::uint8_t { kOff, kOn };
};
ARMATURE_ENUM(Robot::Mode, kOff, kOn);

const Type& gait() { return type_of<Gait>(); }

TEST(Enum, IsDescribedByItsNamesAndItsInteger) {
  EXPECT_EQ(gait().kind, Kind::kEnum);
  EXPECT_EQ(gait().underlying, &type_of<std::int16_t>());
  EXPECT_EQ(gait().size, 2u);
  EXPECT_EQ(layout_text(gait()), "Gait:int16{standing=0,walking=300,turning_on_the_spot=-2}");
  EXPECT_EQ(enumerator_list(gait()), "standing, walking or turning_on_the_spot");
}

TEST(Enum, AMemberOfAClassHasItsOwnName) { EXPECT_EQ(type_of<Robot::Mode>().name, "Mode"); }

TEST(Enum, NamesAndValuesLeadToEachOther) {
  EXPECT_EQ(name_of(Gait::kTurningOnTheSpot), "turning_on_the_spot");
  EXPECT_EQ(value_named<Gait>("walking"), Gait::kWalking);
  EXPECT_FALSE(value_named<Gait>("kWalking").has_value());
  EXPECT_FALSE(value_named<Gait>("300").has_value());
}

TEST(Enum, AValueThatNoEnumeratorHasIsWrittenAsItsNumber) {
  const Gait odd = static_cast<Gait>(7);
  EXPECT_EQ(name_of(odd), "");
  EXPECT_FALSE(is_enumerator(gait(), &odd));
  EXPECT_EQ(to_text(gait(), &odd), "7");
}

TEST(Enum, TextIsItsName) {
  Gait value = Gait::kStanding;
  ASSERT_TRUE(from_text(gait(), " walking ", &value));
  EXPECT_EQ(value, Gait::kWalking);
  EXPECT_EQ(to_text(gait(), &value), "walking");
}

TEST(Enum, UnknownNamesAreRefusedWithTheKnownOnesAndTheNearest) {
  Gait value = Gait::kWalking;
  const auto misspelt = from_text(gait(), "wlaking", &value);
  ASSERT_FALSE(misspelt);
  EXPECT_EQ(misspelt.error(),
            "expected standing, walking or turning_on_the_spot, found 'wlaking' (did you mean "
            "'walking'?)");
  EXPECT_FALSE(from_text(gait(), "300", &value));
  EXPECT_FALSE(from_text(gait(), "", &value));
  EXPECT_EQ(value, Gait::kWalking);
}

TEST(Enum, BinaryFormIsItsIntegerAndOtherNumbersAreRefused) {
  const std::array<std::byte, 2> walking{std::byte{0x2c}, std::byte{0x01}};
  const std::array<std::byte, 2> seven{std::byte{7}, std::byte{0}};
  Gait value = Gait::kStanding;
  ASSERT_TRUE(decode(gait(), walking.data(), walking.size(), &value));
  EXPECT_EQ(value, Gait::kWalking);
  const auto refused = decode(gait(), seven.data(), seven.size(), &value);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error(),
            "cannot decode Gait: Gait at byte 0 is standing, walking or turning_on_the_spot, but 7 "
            "was found");
  EXPECT_EQ(value, Gait::kWalking);
}

TEST(Enum, EachOfAListIsLookedAt) {
  const std::array<std::byte, 4> two{std::byte{0}, std::byte{0}, std::byte{7}, std::byte{0}};
  std::array<Gait, 2> value{};
  EXPECT_FALSE(decode(type_of<std::array<Gait, 2>>(), two.data(), two.size(), &value));
}

}  // namespace
}  // namespace armature::types
