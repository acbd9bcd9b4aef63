// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/protocol/puck_properties.hpp"

#include <iterator>
#include <map>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/realtime_guard.hpp"
#include "robots/wam/protocol/test_golden.hpp"

namespace armature::wam {
namespace {

using ::testing::Optional;

constexpr int kNewest = 255;
const std::map<std::string, PuckKind> kKinds{{"monitor", PuckKind::kMonitor},
                                             {"safety", PuckKind::kSafety},
                                             {"motor", PuckKind::kMotor},
                                             {"force_torque", PuckKind::kForceTorque}};

std::optional<int> golden(const std::map<int, std::optional<int>>& numbers, int version) {
  const auto after = numbers.upper_bound(version);
  return after == numbers.begin() ? std::nullopt : std::prev(after)->second;
}

TEST(PuckProperties, EveryNumberOfEveryFirmwareIsAsInTheTable) {
  const auto kinds = golden_numbers();
  ASSERT_EQ(kinds.size(), kKinds.size());
  for (const auto& [kind, properties] : kinds) {
    ASSERT_GE(properties.size(), 11u) << kind;
    for (const auto& [name, numbers] : properties) {
      const auto property = parse_property(name);
      ASSERT_TRUE(property) << name;
      for (int version = 0; version <= kNewest; ++version) {
        EXPECT_EQ(number_of(kKinds.at(kind), version, *property), golden(numbers, version))
            << kind << ' ' << name << ' ' << version;
      }
    }
  }
}

TEST(PuckProperties, AKindHasNoPropertyThatTheTableHasNot) {
  const auto kinds = golden_numbers();
  for (const auto& [kind, properties] : kinds) {
    std::set<Property> known;
    for (const auto& [name, numbers] : properties) known.insert(parse_property(name).value());
    for (std::size_t i = 0; i < kProperties; ++i) {
      const auto property = static_cast<Property>(i);
      if (known.contains(property)) continue;
      EXPECT_EQ(number_of(kKinds.at(kind), kNewest, property), std::nullopt)
          << kind << ' ' << to_text(property);
    }
  }
}

TEST(PuckProperties, ANumberLeadsBackToItsProperty) {
  for (const int version : {36, 50, 61, 64, 65, 118, 125, 132, 175}) {
    for (std::size_t i = 0; i < kProperties; ++i) {
      const auto property = static_cast<Property>(i);
      const auto number = number_of(PuckKind::kMotor, version, property);
      if (!number) continue;
      EXPECT_THAT(property_of(PuckKind::kMotor, version, *number), Optional(property))
          << to_text(property) << ' ' << version;
    }
  }
  EXPECT_EQ(property_of(PuckKind::kMotor, 175, 127), std::nullopt);
  EXPECT_EQ(property_of(PuckKind::kMonitor, 12, 48), std::nullopt);
}

TEST(PuckProperties, TheSameNumberIsAnotherPropertyOnTheSafetyBoard) {
  EXPECT_EQ(property_of(PuckKind::kMotor, 175, 42), Property::kT);
  EXPECT_EQ(property_of(PuckKind::kSafety, 200, 42), Property::kZero);
}

TEST(PuckProperties, WideOnesAreThoseWithRoomForTwoNumbers) {
  for (const Property property :
       {Property::kP, Property::kDp, Property::kE, Property::kOt, Property::kCt, Property::kM,
        Property::kMech, Property::kCts, Property::kIoff, Property::kHallh, Property::kJp,
        Property::kJofst}) {
    EXPECT_TRUE(is_wide(PuckKind::kMotor, 175, property)) << to_text(property);
  }
  for (const Property property : {Property::kVers, Property::kStat, Property::kT, Property::kMt,
                                  Property::kIpnm, Property::kPidx, Property::kPoles}) {
    EXPECT_FALSE(is_wide(PuckKind::kMotor, 175, property)) << to_text(property);
  }
  EXPECT_FALSE(is_wide(PuckKind::kMotor, 61, Property::kIoff)) << "MPE has the next number";
  EXPECT_TRUE(is_wide(PuckKind::kMotor, 65, Property::kIoff));
  EXPECT_TRUE(is_wide(PuckKind::kSafety, 200, Property::kPen)) << "its bits do not fit into 16";
}

TEST(PuckProperties, NamesLeadBackToTheirProperties) {
  for (std::size_t i = 0; i < kProperties; ++i) {
    const auto property = static_cast<Property>(i);
    EXPECT_EQ(parse_property(to_text(property)), property);
  }
  EXPECT_EQ(parse_property("AP"), Property::kP);
  EXPECT_EQ(parse_property("ap"), std::nullopt);
}

TEST(PuckProperties, LookingUpIsRealTime) {
  testing::RealtimeGuard guard;
  EXPECT_EQ(guard.watch([] {
    static_cast<void>(number_of(PuckKind::kMotor, 175, Property::kP));
    static_cast<void>(property_of(PuckKind::kMotor, 175, 48));
    static_cast<void>(is_wide(PuckKind::kMotor, 175, Property::kP));
  }),
            0u)
      << guard.report();
}

}  // namespace
}  // namespace armature::wam
