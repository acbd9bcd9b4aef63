// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/places.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace armature::studio::internal {
namespace {

TEST(Places, AreSortedOnTheGridALineForEachBox) {
  Places places;
  places.set("Joint{1..7}", 101, 51);
  places.set("Arm", -3, 4000);
  const std::string text =
      "{\"boxes\": {\n  \"Arm\": [0, 4000],\n  \"Joint{1..7}\": [104, 48]\n}}\n";
  EXPECT_EQ(places.to_text(), text);
  EXPECT_EQ(Places::parse(text).value().to_text(), text);
}

TEST(Places, GoWithTheirBox) {
  Places places = Places::parse(R"({"boxes": {"A": [8, 8], "B": [16, 16]}})").value();
  places.rename("A", "C");
  places.rename("nobody", "D");
  places.remove("B");
  EXPECT_EQ(places.to_text(), "{\"boxes\": {\n  \"C\": [8, 8]\n}}\n");
}

TEST(Places, HaveWhatMovesRobotsALineForEach) {
  Places places;
  places.move_by("Model", "Sensor.Positions");
  places.move_by("Arm.Robot", "Arm.Sensor.Positions");
  const std::string text =
      "{\"boxes\": {\n},\n\"robots\": {\n  \"Arm.Robot\": \"Arm.Sensor.Positions\",\n"
      "  \"Model\": \"Sensor.Positions\"\n}}\n";
  EXPECT_EQ(places.to_text(), text);
  EXPECT_EQ(Places::parse(text).value().to_text(), text);
  EXPECT_FALSE(places.empty());
}

TEST(Places, WhatMovesARobotGoesWithItsComponents) {
  Places places;
  places.move_by("Model", "Sensor.Positions");
  places.move_by("Other", "SensorArray.Positions");
  places.rename("Sensor", "Encoders");
  places.rename("Model", "Robot");
  EXPECT_EQ(places.to_text(),
            "{\"boxes\": {\n},\n\"robots\": {\n  \"Other\": \"SensorArray.Positions\",\n"
            "  \"Robot\": \"Encoders.Positions\"\n}}\n");
  places.remove("Encoders");
  places.move_by("Other", "");
  EXPECT_TRUE(places.empty());
}

TEST(Places, OfPartsOutliveTheirComposite) {
  Places places =
      Places::parse(R"({"boxes": {"G": [8, 8], "G.A": [16, 16], "G.B.C": [24, 24], "GA": [0, 0]}})")
          .value();
  places.dissolve("G");
  EXPECT_EQ(places.to_text(),
            "{\"boxes\": {\n  \"A\": [16, 16],\n  \"B.C\": [24, 24],\n  \"GA\": [0, 0]\n}}\n");
}

TEST(Places, WhatMovesARobotOutlivesItsComposite) {
  Places places;
  places.move_by("Arm.Model", "Arm.Sensor.Positions");
  places.dissolve("Arm");
  EXPECT_EQ(places.to_text(),
            "{\"boxes\": {\n},\n\"robots\": {\n  \"Model\": \"Sensor.Positions\"\n}}\n");
}

TEST(Places, WhatIsNoPlaceIsRefused) {
  for (const char* text :
       {"[", "[]", "{}", R"({"boxes": []})", R"({"boxes": {"A": 1}})", R"({"boxes": {"A": [1]}})",
        R"({"boxes": {"A": [1, "2"]}})", R"({"boxes": {}, "robots": []})",
        R"({"boxes": {}, "robots": {"A": 1}})"}) {
    EXPECT_FALSE(Places::parse(text).ok()) << text;
  }
  EXPECT_TRUE(Places::parse("").value().empty());
}

TEST(Places, WhatIsBeyondAnyCanvasIsAtItsOrigin) {
  Places places;
  places.set("A", std::numeric_limits<double>::infinity(), 1e300);
  EXPECT_EQ(places.to_text(), "{\"boxes\": {\n  \"A\": [0, 0]\n}}\n");
}

}  // namespace
}  // namespace armature::studio::internal
