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

TEST(Places, OfPartsOutliveTheirComposite) {
  Places places =
      Places::parse(R"({"boxes": {"G": [8, 8], "G.A": [16, 16], "G.B.C": [24, 24], "GA": [0, 0]}})")
          .value();
  places.dissolve("G");
  EXPECT_EQ(places.to_text(),
            "{\"boxes\": {\n  \"A\": [16, 16],\n  \"B.C\": [24, 24],\n  \"GA\": [0, 0]\n}}\n");
}

TEST(Places, WhatIsNoPlaceIsRefused) {
  for (const char* text : {"[", "[]", "{}", R"({"boxes": []})", R"({"boxes": {"A": 1}})",
                           R"({"boxes": {"A": [1]}})", R"({"boxes": {"A": [1, "2"]}})"}) {
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
